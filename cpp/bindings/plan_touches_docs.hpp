// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python {

inline constexpr const char* kTouchForecastDoc =
    R"(What touches will tell of an arm, before it is identified: see `forecast_touches`.)";

inline constexpr const char* kTouchPlanDoc =
    R"(Poses in which to touch, and how right the arm will go afterwards: see `plan_touches`.)";

inline constexpr const char* kForecastTouchesDoc =
    R"(Foretell how right an arm will go that is identified from these touches.

To first order at the nominal arm, with the covariance that `identify_arm` will report with these
priors. What base and tool can do as well (gauge) counts nothing; the arm's size counts.

Parameters
----------
arm : Arm
    Nominal, its tool told to a centimetre or so.
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
    beta [rad]. They hold what touches never tell.
tool_prior : float
    How well the tool is told: standard deviation of each coordinate of its tip [m].
workspace : (S, n) array, optional
    Poses in which the arm must go right [rad] or [m]. Drawn at random within the limits unless
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
    parameters, ``.singular_values``, ``.unseen`` in words, ``.o1``, ``.log_det``.

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
    R"(Choose poses to touch fixed points in, so that the arm found from them goes right everywhere.

Poses drawn over all of the joints' range are brought onto each point by the least joint motion:
every branch of elbow and wrist, the tool in every direction. Of those that may be held the
criterion chooses, greedily and then by exchange (Fedorov 1972, Theory of optimal experiments; Cook,
Nachtsheim 1980, A comparison of algorithms for constructing exact D-optimal designs).

Parameters
----------
arm : Arm
    Nominal, its tool told to a centimetre or so.
count : int
    Touches, 2 or more, of all points together.
points : (k, 3) array, optional
    Where the points stand, in the world [m], roughly. Chosen unless given: where the arm can reach
    from many sides, apart from each other.
num_points : int
    How many are chosen.
known_distances : sequence of (int, int)
    Points 0 … k - 1 whose distance from each other will be measured. Touches alone cannot tell the
    arm from a smaller one.
distance_std : float
    Standard deviation of such a distance [m].
known_points : sequence of int
    Points whose place in the world will be measured.
point_std : float
    Standard deviation of such a place, per axis [m].
feasible : callable, optional
    Which poses may be held: (N, n) array of joint values to (N,) array of bool. It is called a few
    times with many rows.
floor : float, optional
    Height in the world that no joint and no tip may go below [m].
criterion : {"worst_tip", "d_optimal", "o1"}
    "worst_tip": the worst foretold deviation of the tip over the workspace, gauge removed, scale
    included. "d_optimal": the determinant of the parameters' information. "o1": the observability
    index of Borm and Menq (1989, Experimental study of observability of parameter errors in robot
    calibration; 1991, Determination of optimal measurement configurations for robot calibration
    based on observability measure).
candidates : int
    Poses to choose from, for each point; 10⁵ at most.
passes : int
    At most so many rounds of exchange.
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
    ``.warnings``; ``.write("plan.csv")`` for the operator, ``.plot("plan.png")``; its text is a
    paragraph in plain words.

Raises
------
ValueError
    For `count` below 2, a point out of reach (it is named), points that nothing feasible touches,
    a `feasible` that returns something else, options out of range.

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
