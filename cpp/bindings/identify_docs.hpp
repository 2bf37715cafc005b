// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kTouchesDoc =
    R"(Joint values while the tool's tip touched fixed points.

What Yukhimets and Gubankov (2023) record: the tip is brought to a fixed point in many poses, a few
points in all, and only joint values are read. Where the points lie need not be known.

Parameters
----------
q : (N, n) array
    Joint values, one row a touch [rad]; [m] of sliding joints.
point : (N,) int array
    Label of the point that the row touched, any whole number; of rows that touched a plane, any.
q_deg : (N, n) array
    In place of `q`, in degrees (every column: for arms that only turn).
known_distances : dict
    {(label, label): distance} between touched points [m]. Touches alone do not determine the scale
    of the arm; one such distance does.
distance_std : float
    Standard deviation of those distances [m].
known_points : dict
    {label: (x, y, z)} of touched points, in the world, the frame of ``arm.base`` [m].
point_std : float
    Standard deviation of those coordinates, per axis [m].
planes : dict
    {name: rows} of planes that were touched in many places, not known otherwise.
weights : (N,) array
    1 / variance of a row, up to a factor. Equal when not given.
tool, station : (N,) int array
    Tool of the touch and position of the base, each counted from 0.
covariates : dict
    {name: (N,) or (N, k) array} recorded in addition: temperature, time, payload, direction, gravity …
    nan in rows where it was not recorded.
session : (N,) int array
    Short for the covariate ``session``.
names : dict
    {label: name} of touched points, for reports; a label may have none.

Raises
------
ValueError
    For lengths that differ, numbers that are not finite, values that can only be degrees (give them
    as ``q_deg``), poses that are all equal, one pose for each point, labels without a touch.

Examples
--------
>>> import bathyal
>>> bathyal.Touches([[0, 1, 0.5], [0.2, 0.9, 0.6]], [0, 0])
Touches(2 poses, 3 joints)
)";

inline constexpr const char* kTrackedDoc =
    R"(Joint values and measured positions of the tool's tip.

Parameters
----------
q : (N, n) array
    Joint values [rad]; [m] of sliding joints.
position : (N, 3) array
    Of the tip (a reflector, a prism), in the frame of the instrument [m].
pose : (N, 4, 4) array
    In place of `position`: the whole pose of what the instrument sees, world_from_tool.
q_deg : (N, n) array
    In place of `q`, in degrees (every column).
weights : (N,) array
    1 / variance of a row, up to a factor. Equal when not given.
tool, station : (N,) int array
    Target on the tool, and position of base and instrument, each counted from 0.
covariates : dict
    {name: (N,) or (N, k) array} recorded in addition: temperature, time, payload, direction, gravity …
    nan in rows where it was not recorded.
session : (N,) int array
    Short for the covariate ``session``.

Raises
------
ValueError
    As Touches.

Examples
--------
>>> import bathyal
>>> bathyal.Tracked(q_deg=[[0, 30], [10, 40]], position=[[1, 0, 0], [1.1, 0.1, 0]])
Tracked(2 poses, 2 joints)
)";

inline constexpr const char* kFitParameterDoc = R"(One parameter as estimated by `identify_arm`.

``status`` is "identified"; "gauge" (fixed: base or tool can represent it); "prior" (determined by a
prior, not by the data); "not_identifiable"; "fixed" (on request); "pruned" (reset to nominal on
request). ``trades`` lists the parameters that take part in an unobservable change of it.
)";

inline constexpr const char* kArmFitDoc =
    R"(Result of `identify_arm`: the arm with its uncertainty.

``str(fit)`` describes it in a few lines, ``fit.summary()`` in one paragraph.
)";

inline constexpr const char* kTipCovarianceDoc =
    R"(Covariance of the tip predicted by ``fit.arm``, in the frame of its base.

Gauge freedom does not count, the scale of the arm counts. Infinite on the diagonal where a
direction that neither data nor priors determine moves the tip.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]

Returns
-------
(N, 3, 3) or (3, 3) array
    [m²]
)";

inline constexpr const char* kTipStdDoc =
    R"(Standard deviation of the predicted tip: √trace of `tip_covariance`, all three axes together.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]

Returns
-------
(N,) array or float
    [m]
)";

inline constexpr const char* kIdentifyArmDoc =
    R"(Estimate the geometry of an arm from measured poses.

After Yukhimets, Gubankov (2023). Unknown are each moving joint's row, the tool and, for tracked
poses, the base; what the data do not determine stays at nominal, and is reported.

Parameters
----------
arm : Arm or CorrectedArm
    Nominal. Its tool, where it has one, is where the search for the tool starts. The effects of a
    corrected arm keep their values, each in the rows within its support, and are reported as
    "fixed" parameters; the arm of the fit is the rigid part.
data : Touches or Tracked
parametrization : {"hayati", "dh"}
    "hayati": beta (Hayati, Mirmirani 1985) in place of d where the next axis is nearly parallel.
    "dh": theta, d, a, alpha in every row, as the paper.
nearly_parallel : float
    Axes whose directions have a smaller sine are nearly parallel.
criterion : {"centroid", "pairs"}
    Each touch against the mean of its point, or every pair of a point's touches (the paper's eq
    7-9). They have the same minimum when every point has as many touches, or with `pair_weights`.
pair_weights : bool
    Weigh a point by the number of its touches, as "pairs" always does.
solver : {"levenberg_marquardt", "paper"}
    Ceres' TinySolver, or the paper's eq 17 with its sign mended. They reach the same cost.
max_iterations : int
tool_start : {"auto", "arm", "estimate"}
    Start from the arm's tool, or estimate it (eq 12-16). "auto": the arm's where it has one.
base : {"auto", "free", "fixed"}
    "auto": free for tracked poses, fixed for touches.
fixed : list of str
    Names of parameters to hold at nominal.
length_prior, angle_prior : float
    The maker's tolerance: standard deviation of every a and d [m], of every theta, alpha and beta
    [rad], about nominal. None: no prior.
priors : dict
    {name: std} for single parameters, in their unit.
size_prior : float
    The length prior where the data do not determine the scale (touches without a known distance or
    point) and none is given [m].
noise, rotation_noise : float
    Standard deviation of a touch or a position per axis [m], and of a rotation [rad]. None: from
    the residuals.
loss : {"square", "huber", "cauchy"}
    The last two bound the influence of outliers.
loss_width : float
    Distance from which they do [m]. None: 3 times the robust standard deviation.
prune_sigma : float
    Reset parameters within so many standard deviations of nominal, the least significant first.
num_threads : int
    0 = all. The same result for any.

Returns
-------
ArmFit
    ``.arm .parameters .rms_before .rms_after .rank .std .covariance .scale_source .warnings …``

Raises
------
ValueError
    For another number of joints than the arm's, bad options, names that no parameter has.

Notes
-----
Rank and covariance come from QR and singular values of the Jacobian with its columns in mm and
mrad; singular values below 1e-7 of the largest count as zero. Noise is estimated with 3 Σ(m_i − 1)
− rank degrees of freedom.

Least squares underestimates the scale of the arm, because touches scatter less on a smaller one: by
(degrees of freedom) · (relative std of the scale)². Where known distances or points, or a prismatic
joint, determine the scale, this bias is removed (by the derivatives of consistent touches instead
of scattered ones). Where only a prior determines it, the criterion of the paper is used unchanged:
read ``scale_source``, and do not rely on a small rms.

Examples
--------
>>> import bathyal, numpy as np
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> q = np.random.default_rng(1).uniform(-2, 2, (40, 2))
>>> true = bathyal.Arm.from_dh(a=[0.502, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0.003])
>>> fit = bathyal.identify_arm(arm, bathyal.Tracked(q, true.forward(q)[:, :3, 3]))
>>> a_1 = next(p for p in fit.parameters if p.name == "a_1")
>>> round(a_1.value, 6), a_1.status
(0.502, 'identified')
)";

}  // namespace bathyal::python
