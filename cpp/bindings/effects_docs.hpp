// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The longer docstrings of effects and corrected arms, in numpydoc.

namespace bathyal::python {

inline constexpr const char* kEffectRowsDoc = R"(The rows that an effect's function is asked for.

Its numbers must follow from each row alone (or, with ``by_difference=True``, from how rows differ
from their neighbours), so that an effect found in one recording means the same in the next.
)";

inline constexpr const char* kEffectDoc =
    R"(Something that may be wrong with an arm beside its geometry.

Those of the library come from `bathyal.effects.list`; this makes one of your own. It is linear in
its parameters: each moves its site by itself times the numbers that the function gives for it.
Python functions are slow beside the library's; write one in C++ to make it fast.

Parameters
----------
name : str
    As diagnosis will name it.
function : callable
    ``function(data, joint)`` of site "joint", else ``function(data)``; `data` is an EffectRows.
    Gives what a unit of each parameter does in each row: (N, k) of the sites "joint" [rad or m]
    and "lengths" [share], (N, k, 6) of "base" and "tool" (shift x, y, z [m], then turn x, y, z
    [rad] in that frame). Of one parameter (N,) and (N, 6) do as well.
parameters : dict of str to str
    Name to unit of each.
joints : "each" or list of int, optional
    Of site "joint": which it may sit in, counted from 0.
site : str
    What it moves: "joint", "base", "tool" or "lengths" (all a and d of the arm).
needs : list of str
    Covariates without which it cannot be seen.
words, formula, source : str
    For people.
scales : dict of str to float, optional
    An ordinary size of each parameter, in its unit; 1e-3 unless given.
by_difference : bool
    Whether it looks at how rows differ from their neighbours, not at where they lie: the ranges of
    the data that taught it are no bounds to it.
period : float
    The shortest stretch of joint values over which what it does comes and goes [rad] or [m]: in a
    wider gap of the data a corrected arm holds it at the edge. Infinite unless given.

Raises
------
ValueError
    For a name that is empty, no parameters, joints that do not go with the site. Where the
    effect is used: for numbers of another shape, or not finite.
Error
    Where it is used: when the function raises.

Examples
--------
>>> import numpy as np
>>> from bathyal.effects import Effect
>>> def cable(data, joint):
...     return np.sin(data.q[:, 1] + data.q[:, 2])
>>> Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
Effect("cable")
)";

inline constexpr const char* kFoundEffectDoc =
    R"(An effect with its values: what a corrected arm carries.

Parameters
----------
effect : Effect or str
    Or the name of one of `bathyal.effects`.
parameters : dict of str to float
    Values, in the order of the effect's parameters.
joint : int, optional
    Counted from 0.
settings : dict of str to float, optional
    What tells this form of the effect from others, such as ``{"order": 2}``.
units : dict of str to str, optional
    Of the parameters; the effect's own unless given.
scales : dict of str to float, optional
    Ordinary sizes of the parameters, above 0; 1e-3 unless given.
cause : str
    Effects of one cause are words for the same thing.

Raises
------
ValueError
    For no such effect.

Examples
--------
>>> from bathyal.effects import FoundEffect
>>> FoundEffect("joint_harmonic", {"cos": 1e-3, "sin": 0.0}, joint=2, settings={"order": 2})
FoundEffect("joint_harmonic", joint=2, cos=0.001, sin=0)
)";

inline constexpr const char* kSupportDoc = R"(What the data that taught a corrected arm covered.

Parameters
----------
joints : (2, n) array
    Least and greatest of each coordinate [rad] or [m].
gaps : list of (g, 2) arrays, optional
    Of each coordinate, from and to: stretches within its range without data, rising.
gravity : (2, 3) array, optional
    [m/s²] in the arm's base frame; straight down unless given.
covariates : dict of str to (2, k) array, optional
    Of all others but `session`.
sessions : (s,) array, optional
    That were seen, rising.
)";

inline constexpr const char* kCorrectedArmDoc = R"(An arm with what a diagnosis found inside.

Rigid geometry, effects with their values, and the support of the data that taught them; what
``report.model`` is. `q` is what the controller records; the effects move joints, frames and
lengths from there.

An effect counts in a row where its own arguments lie within the support: in the ranges that taught
it, and in no gap between joint values wider than its period (of waves and curves along one joint,
which were found together, the shortest).
Where one lies beyond (a joint, a temperature, a load) and would change what the effect does, the
effect is held: a wave or curve along its joint at its average over what was taught, for beyond that
it may do anything; what is smooth at what it does in the nearest row within. An effect that needs
what is not known (a NaN covariate, a session that nobody saw) is left out, and where all are the
answer is the rigid arm's. That is never silent: each call warns once with a `SupportWarning`, and
`in_support` gives the rows.

Every method that computes takes ``covariates``, a dict of name to a number, (N,) or (N, k) array. An
effect that needs one that is missing is left out with the warning where no covariates are told at
all, and refused where some are. `payload` counts 0 kg and `gravity` (0, 0, −9.80665) m/s² in the
arm's base frame unless told. A base that moved and a tool that was changed follow `session`; a tool
that slipped follows `time`, and without it has slipped; joints that are late follow the speed that
`time` tells between rows, and without it stand still.

Parameters
----------
arm : Arm
    The rigid part, with base and tool.
effects : list of FoundEffect
data : Touches, Tracked or Support
    What taught them.

Raises
------
ValueError
    For an effect whose values or settings do not fit the arm, or that needs a covariate of which
    `data` say nothing.

Examples
--------
>>> import bathyal, numpy as np
>>> arm = bathyal.arms.ur10e()
>>> q = np.random.default_rng(1).uniform(-1, 1, (50, 6))
>>> def cable(data, joint):
...     return np.sin(data.q[:, 1] + data.q[:, 2])
>>> cable = bathyal.effects.Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
>>> pull = bathyal.effects.FoundEffect(cable, {"pull": 1e-3}, joint=3)
>>> model = bathyal.CorrectedArm(arm, [pull], bathyal.Tracked(q, arm.forward(q)[:, :3, 3]))
>>> model
CorrectedArm("UR10e", 6 joints, cable of joint 4)
>>> float(np.linalg.norm((model.forward(q) - arm.forward(q))[:, :3, 3], axis=1).max().round(4))
0.0001
>>> model.in_support([[0.5] * 6, [0.5, 2.0, 0.5, 0.5, 0.5, 0.5]])
array([[ True],
       [False]])
)";

inline constexpr const char* kCorrectedForwardDoc = R"(Poses of the tool in the world.

Parameters
----------
q : (N, n) or (n,) array
    As the controller records them [rad] or [m].
covariates : dict, optional
    Name to a number for all, (N,) or (N, k) array.
links : bool
    Poses of every link instead, in the order of `link_names`.
num_threads : int
    0 is all.

Returns
-------
(N, 4, 4) or (4, 4) array; with `links` (N, L, 4, 4) or (L, 4, 4)
    world_from_tool, world_from_link.

Raises
------
ValueError
    For other shapes, and for a covariate that an effect needs and that is missing among others.

Warns
-----
SupportWarning
    Where effects were held or left out.
)";

inline constexpr const char* kCorrectedJacobianDoc =
    R"(Geometric Jacobians at the tool centre point.

The derivative of `forward`: of the chain as it stands, of the effects by central differences of what they move (1e-6 rad or m apart). Arguments, errors and warnings are
those of `forward`, and the axes of `Arm.jacobian`.

Returns
-------
(N, 6, n) or (6, n) array
    Rows of the linear velocity [m/s] above those of the angular velocity [rad/s].
)";

inline constexpr const char* kCorrectedInverseDoc =
    R"(What the controller is to be told to bring the tool to poses.

The rigid arm (`Arm.inverse`, method "damped") is sent where the target lies less what the effects
do, until the corrected tip agrees to the tolerances, 1e-9 m and rad unless given. Arguments and
statuses are those of `Arm.inverse`, with `covariates` as `forward` takes them; errors are those of
the corrected arm.

A pose in the middle of a gap, where an effect held at one edge brings it nearer to the other, is
"singular", with the error that is left. On the edge of what the rigid arm reaches a pose may be
called out of reach by as little as the effects amount to.

Returns
-------
InverseResult
    .q (N, n), .status, .error, .position_error, .angle_error, .iterations, .starts.

Raises
------
ValueError
    As `Arm.inverse` and `forward`.

Warns
-----
SupportWarning
    Where effects were held or left out at the q that was found.
)";

inline constexpr const char* kInSupportDoc = R"(Which effects count in which row.

Parameters
----------
q : (N, n) or (n,) array
covariates : dict, optional
    As of `forward`.

Returns
-------
(N, E) or (E,) array of bool
    In the order of `effects`; all False in a row is the rigid arm.
)";

}  // namespace bathyal::python
