// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kTouchForecastDoc =
    R"(Predicted accuracy of an arm identified from touches: see `forecast_touches`.)";

inline constexpr const char* kTouchPlanDoc =
    R"(Poses in which to touch, and the predicted accuracy of the arm: see `plan_touches`.)";

inline constexpr const char* kForecastTouchesDoc =
    R"(Predict the accuracy of an arm that is identified from these touches.

To first order at the nominal arm, with the covariance that `identify_arm` will report with these
priors. Gauge freedom (what base and tool can represent) does not count; the scale of the arm
counts.

Parameters
----------
arm : Arm
    Nominal, with its tool given to a centimetre or so.
touches : Touches
    Made, or to be made, with the distances and points that are known. Poses that scatter about
    their point are first moved onto it.
parametrization : {"hayati", "dh"}
    As of `identify_arm`.
nearly_parallel : float
    Sine between neighbouring axes below which beta takes the place of d.
noise : float
    Standard deviation of one touch, per axis [m].
length_prior, angle_prior : float
    The maker's tolerances: standard deviation of every a and d [m], and of every theta, alpha and
    beta [rad]. They determine what touches do not.
tool_prior : float
    Accuracy of the given tool: standard deviation of each coordinate of its tip [m].
workspace : (S, n) array, optional
    Poses in which the arm must be accurate [rad] or [m]. Drawn at random within the limits unless
    given.
workspace_poses : int
    How many are drawn.
seed : int
    Of what is drawn.
num_threads : int
    0 for all. The same bytes for any number.

Returns
-------
TouchForecast
    ``.worst_tip_std``, ``.median_tip_std`` [m], ``.tip_std`` (S,), ``.rank`` of ``.free``
    parameters, ``.singular_values``, ``.unseen`` directions, ``.o1``, ``.log_det``.

Raises
------
ValueError
    For another number of joints, several tools or stations, touched planes, options out of range.

Examples
--------
>>> import bathyal, numpy as np
>>> arm = bathyal.arms.ur10e()
>>> touches = bathyal.Touches(np.random.default_rng(1).uniform(-1, 1, (8, 6)), [0] * 8)
>>> forecast = bathyal.forecast_touches(arm, touches)
>>> forecast.rank <= forecast.free < forecast.parameters
True
)";

inline constexpr const char* kPlanTouchesDoc =
    R"(Choose poses to touch fixed points in, so that the arm identified from them is accurate.

Poses drawn over all of the joints' range are moved onto each point by the least joint motion: every
branch of elbow and wrist, the tool in every direction. The criterion selects among the feasible
ones, greedily and then by exchange (Fedorov 1972, Theory of optimal experiments; Cook, Nachtsheim
1980, A comparison of algorithms for constructing exact D-optimal designs).

Parameters
----------
arm : Arm
    Nominal, with its tool given to a centimetre or so.
count : int
    Touches, 2 or more, of all points together.
points : (k, 3) array, optional
    Approximate positions of the points, in the world [m]. Chosen unless given: where the arm can
    reach from many sides, apart from each other.
num_points : int
    How many are chosen.
known_distances : sequence of (int, int)
    Points 0 … k - 1 whose distance from each other will be measured. Touches alone do not determine
    the scale of the arm.
distance_std : float
    Standard deviation of such a distance [m].
known_points : sequence of int
    Points whose position in the world will be measured.
point_std : float
    Standard deviation of such a position, per axis [m].
feasible : callable, optional
    Which poses may be held: (N, n) array of joint values to (N,) array of bool. It is called a few
    times with many rows.
floor : float, optional
    Minimum height in the world of all joints and the tip [m].
criterion : {"worst_tip", "d_optimal", "o1"}
    "worst_tip": the worst predicted deviation of the tip over the workspace, gauge freedom removed,
    scale included. "d_optimal": the determinant of the parameters' information. "o1": the
    observability index of Borm and Menq (1989, Experimental study of observability of parameter
    errors in robot calibration; 1991, Determination of optimal measurement configurations for robot
    calibration based on observability measure).
candidates : int
    Poses to choose from, for each point; 10⁵ at most.
passes : int
    Maximum number of exchange rounds.
parametrization, nearly_parallel, noise, length_prior, angle_prior, tool_prior
    As of `forecast_touches`.
workspace, workspace_poses
    As of `forecast_touches`; poses of the workspace that are drawn must be feasible, too.
seed : int
    Of what is drawn.
num_threads : int
    0 for all. The same bytes for any number.

Returns
-------
TouchPlan
    ``.q`` (N, n), ``.point`` (N,), ``.points`` (k, 3), ``.forecast``, ``.value`` of the criterion,
    ``.warnings``; ``.write("plan.csv")`` for the operator, ``.plot("plan.png")``; its text is one
    paragraph.

Raises
------
ValueError
    For `count` below 2, a point out of reach (it is named), points that nothing feasible touches, a
    `feasible` that returns something else, options out of range.

Examples
--------
>>> import bathyal
>>> arm = bathyal.arms.ur10e()
>>> plan = bathyal.plan_touches(arm, 24, num_points=2, known_distances=[(0, 1)], candidates=200)
>>> plan.q.shape, plan.points.shape
((24, 6), (2, 3))
>>> bool(plan.worst_tip_std < 0.001)
True
)";

}  // namespace bathyal::python
