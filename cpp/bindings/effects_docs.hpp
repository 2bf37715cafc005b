// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The longer docstrings of effects and corrected arms, in numpydoc.

namespace bathyal::python {

inline constexpr const char* kEffectRowsDoc =
    R"(The rows at which the function of an effect is evaluated.

Its numbers must follow from each row alone (or, with ``by_difference=True``, from how rows differ
from their neighbours), so that an effect found in one recording means the same in the next.
)";

inline constexpr const char* kEffectDoc =
    R"(An error of an arm that its geometric parameters cannot represent.

Those of the library come from `bathyal.effects.list`; this makes one of your own. It is linear in
its parameters: each moves its site by itself times the numbers that the function gives for it.
Python functions are slow compared with the library's; write one in C++ to make it fast.

Parameters
----------
name : str
    As diagnosis will name it.
function : callable
    ``function(data, joint)`` of the sites "joint" and "link", else ``function(data)``; `data` is an
    EffectRows. Gives what a unit of each parameter does in each row: (N, k) of the sites "joint"
    [rad or m] and "lengths" [share], (N, k, 6) of "link", "base" and "tool" (shift x, y, z [m],
    then turn x, y, z [rad], in that frame; all that lies beyond moves along). Of one parameter (N,)
    and (N, 6) do as well.
parameters : dict of str to str
    Name to unit of each.
joints : "each" or list of int, optional
    Of the sites "joint" and "link": which it may sit in, counted from 0.
site : str
    What it moves: "joint", "link" (the frame of the link that the joint moves, which is also that
    of ``forward(q, links=True)``; small turns), "base", "tool" or "lengths" (all a and d of the
    arm).
needs : list of str
    Covariates without which it is not observable.
words, formula, source : str
    For people.
scales : dict of str to float, optional
    A typical size of each parameter, in its unit; 1e-3 unless given.
by_difference : bool
    Whether it depends on how rows differ from their neighbours and not on the rows themselves: the
    ranges of the training data do not bound it.
period : float
    The shortest length scale of its dependence on joint values [rad] or [m]: in a wider gap of the
    data a corrected arm holds it at its value at the edge. Infinite unless given.
extrapolates : bool
    Whether it follows from physics with known arguments, so that a corrected arm evaluates it
    beyond the training data as within; else it is held there.

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

inline constexpr const char* kExtrapolatesDoc =
    R"(Whether it is extrapolated beyond the training data. True of what follows from physics with
known arguments: compliances under weight, a payload, a scale, a coupling, heat. What follows a
curve that the data alone determine (waves, maps, drifts, play) is held there instead.
`joint_compliance` of an arm without masses follows a curve too: `FoundEffect.extrapolates`.)";

inline constexpr const char* kFoundEffectDoc =
    R"(An effect with its values, as part of a corrected arm.

Parameters
----------
effect : Effect or str
    Or the name of one of `bathyal.effects`.
parameters : dict of str to float
    Values, in the order of the effect's parameters.
joint : int, optional
    Counted from 0.
settings : dict of str to float, optional
    What distinguishes this variant of the effect from others, such as ``{"order": 2}``.
units : dict of str to str, optional
    Of the parameters; the effect's own unless given.
scales : dict of str to float, optional
    Typical sizes of the parameters, above 0; 1e-3 unless given.
cause : str
    Effects of one cause are descriptions of the same thing.

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

inline constexpr const char* kSupportDoc =
    R"(The region that the training data of a corrected arm cover.

Parameters
----------
joints : (2, n) array
    Minimum and maximum of each coordinate [rad] or [m].
gaps : list of (g, 2) arrays, optional
    Of each coordinate, from and to: intervals within its range without data, ascending.
gravity : (2, 3) array, optional
    [m/s²] in the arm's base frame; straight down unless given.
covariates : dict of str to (2, k) array, optional
    Of all others but `session`.
sessions : (s,) array, optional
    Of the training data, ascending.
)";

inline constexpr const char* kCorrectedArmDoc = R"(An arm with the result of a diagnosis.

Rigid geometry, effects with their values, and the support of the training data: the type of
``report.model``. `q` is what the controller records; the effects perturb joints, frames and lengths
from there.

An effect is within the support in a row where its own arguments are: within the ranges of the
training data, and in no gap between joint values wider than its period (of harmonics and curves
along one joint, which were fitted together, the shortest). Where an argument lies beyond (a joint,
a temperature, a load) and would change the effect, an effect that follows from physics with known
arguments (`FoundEffect.extrapolates`) is extrapolated. Any other is held constant: a harmonic or
curve along its joint at its average over the training data, because its extrapolation is
undetermined; a smooth effect at its value in the nearest row within. A scale that was found with
waves of the same joint is one curve with them, and held. An effect whose argument is unknown (a NaN
covariate, a session without training data) is omitted, and where all are the result is that of the
rigid arm. Each such call warns once with a `SupportWarning`; `in_support` and `support_reasons`
give the rows.

Every method that computes takes ``covariates``, a dict of name to a number, (N,) or (N, k) array.
An effect that needs a missing one is omitted with the warning where no covariates are given at all,
and refused where some are. `payload` defaults to 0 kg and `gravity` to (0, 0, −9.80665) m/s² in the
base frame of the arm. A base that moved and a tool that was changed follow `session`; a tool that
slipped follows `time`, without it `row` (the place in the record of the training data, counted from
0), and without either has slipped; a clock shift follows the speeds between rows by `time`, and
without it joints are at rest.

Parameters
----------
arm : Arm
    The rigid part, with base and tool.
effects : list of FoundEffect
data : Touches, Tracked or Support
    The training data.

Raises
------
ValueError
    For an effect whose values or settings do not fit the arm, or that needs a covariate that `data`
    does not have; for one that acts by weight on an arm without masses that carried nothing.

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
array([ True, False])
>>> model.support_reasons([0.5, 2.0, 0.5, 0.5, 0.5, 0.5])
'joint 2 at 2 rad, data -0.985816 to 0.976438: cable of joint 4 held'
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
    For other shapes, and for an incomplete set of covariates.

Warns
-----
SupportWarning
    Where effects were extrapolated, held or omitted.
)";

inline constexpr const char* kCorrectedJacobianDoc =
    R"(Geometric Jacobians at the tool centre point.

The derivative of `forward`: analytic for the perturbed chain, with central differences of the
perturbations (step 1e-6 rad or m). Arguments, errors and warnings are those of `forward`, and the
axes of `Arm.jacobian`.

Returns
-------
(N, 6, n) or (6, n) array
    Rows of the linear velocity [m/s] above those of the angular velocity [rad/s].
)";

inline constexpr const char* kCorrectedInverseDoc =
    R"(The joint values to command so that the tool reaches poses.

The rigid arm (`Arm.inverse`, method "damped") is sent to the target minus the effects, until the
corrected tip agrees to the tolerances, 1e-9 m and rad unless given. Arguments and statuses are
those of `Arm.inverse`, with `covariates` as `forward` takes them; errors are those of the corrected
arm.

A pose in the middle of a gap, where an effect held at one edge brings it nearer to the other, is
"singular", with the remaining error. At the edge of the workspace of the rigid arm a pose may be
reported out of reach within the size of the effects.

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
    Where effects were extrapolated, held or omitted at the solution q.
)";

inline constexpr const char* kInSupportDoc =
    R"(Which rows lie within the training data, as far as any effect depends on them.

Parameters
----------
q : (N, n) or (n,) array
covariates : dict, optional
    As of `forward`.

Returns
-------
(N,) array of bool, or bool
    Where it is False some effect is extrapolated, held or omitted: `effects_in_support` says which,
    `support_reasons` why.
)";

inline constexpr const char* kEffectsInSupportDoc =
    R"(Which effects have all that they depend on within the training data, in which row.

Parameters
----------
q : (N, n) or (n,) array
covariates : dict, optional
    As of `forward`.

Returns
-------
(N, E) or (E,) array of bool
    In the order of `effects`.
)";

inline constexpr const char* kSupportReasonsDoc =
    R"(Why rows do not lie within the training data, and what is done there.

Parameters
----------
q : (N, n) or (n,) array
covariates : dict, optional
    As of `forward`.

Returns
-------
list of N str, or str
    Of each row the joints and covariates that lie beyond, each with the effects that depend on it,
    as "joint 2 at 1.7 rad, data -1 to 1: joint_harmonic of joint 2 held"; "" within. Joints count
    from 1.
)";

}  // namespace bathyal::python
