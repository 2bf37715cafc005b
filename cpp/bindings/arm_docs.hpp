// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The longer docstrings of the room arm, in numpydoc.

namespace bathyal::python {

inline constexpr const char* kLinkDoc = R"(What hangs on an arm behind one of its joints.

Link 0 is the foot, before any joint; link k moves with joint k. All numbers but `frame` are given
in the link's own frame.

Parameters
----------
name : str
mass : float
    [kg]; 0 is unknown.
center_of_mass : (3,) array
    [m]
inertia : (3, 3) array, optional
    About the centre of mass [kg m²].
volume : float
    Displaced water [m³]; 0 is unknown.
center_of_buoyancy : (3,) array
    [m]
frame : (4, 4) array, optional
    row_from_link; the frame behind the joint's row itself unless given.
collision, visual : list of Shape
    Outlines in the link's frame.

Raises
------
ValueError
    For what `RigidBody` refuses, and a frame that is not rigid.

Examples
--------
>>> import bathyal
>>> bathyal.Link("forearm", mass=2.5, center_of_mass=(-0.1, 0, 0), volume=1.2e-3)
Link("forearm", mass=2.5)
)";

inline constexpr const char* kDhTableDoc = R"(The Denavit-Hartenberg table of an arm.

base_from_flange = root · row 1 · … · row m · flange, where a row is
Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta) in the standard convention and
Tx(a) Rx(alpha) Ry(beta) Rz(theta) Tz(d) in the modified one.
)";

inline constexpr const char* kArmDoc = R"(A serial arm: its geometry, limits, masses and volumes.

Made by ``Arm.from_dh`` and the functions of ``bathyal.arms``. world_from_tool = base · arm · tool:
`base` (world_from_base) and `tool` (flange_from_tool) are yours to set and the identity until then;
all else stays as it was made. Metres and radians.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> arm
Arm(2 joints)
>>> arm.forward([0.0, 0.0])[:3, 3].round(6)
array([0.9, 0. , 0. ])
)";

inline constexpr const char* kFromDhDoc = R"(An arm from its Denavit-Hartenberg table.

Parameters
----------
a, alpha, d, theta : (m,) arrays
    One value a row [m], [rad]. A turning joint adds its value to theta, a sliding one to d.
beta : (m,) array, optional
    Hayati and Mirmirani's fifth angle (1985), for neighbouring axes that are nearly parallel [rad].
joint_types : list of str, optional
    "revolute" (all, unless given), "prismatic" or "fixed".
convention : str
    "standard", a row is Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta); or "modified" (Craig), a row is
    Tx(a) Rx(alpha) Ry(beta) Rz(theta) Tz(d).
lower, upper, velocity, effort : (m,) arrays, optional
    Limits of each row's joint; infinite unless given. A turning joint without limits wraps.
names : list of str, optional
    Of the rows; "joint_1" and so on unless given.
links : list of Link, optional
    m + 1 of them, the foot first.
root, flange, base, tool : (4, 4) arrays, optional
    What lies before the first row and behind the last, as part of the arm; and the user's
    world_from_base and flange_from_tool.
name, source : str
    Of the arm, and where its numbers come from.

Raises
------
ValueError
    For columns of unequal length, a value that is not finite, crossed limits, no moving joint.

Examples
--------
>>> import bathyal, math
>>> arm = bathyal.Arm.from_dh(a=[0, 0.3], alpha=[math.pi / 2, 0], d=[0.2, 0], theta=[0, 0],
...                           lower=[-1, -2], upper=[1, 2], name="small")
>>> arm.size, arm.joint_names
(2, ['joint_1', 'joint_2'])
>>> arm.within_limits([[0, 0], [0, 3]])
array([ True, False])
)";

inline constexpr const char* kToDhDoc = R"(The Denavit-Hartenberg table, without base and tool.

Parameters
----------
convention : str
    "standard" or "modified". In the modified convention a root that is no more than
    Tx(a) Rx(alpha) Ry(beta) becomes part of the first row; any other stays `root`.

Returns
-------
DhTable
    .a .alpha .d .theta .beta (m,), .joint_types, .root .flange (4, 4)

Examples
--------
>>> import bathyal
>>> bathyal.arms.ur10e().to_dh().a.round(4)
array([ 0.    , -0.6127, -0.5715,  0.    ,  0.    ,  0.    ])
)";

inline constexpr const char* kForwardDoc = R"(Poses of the tool in the world.

Parameters
----------
q : (N, n) or (n,) array
    Joint angles [rad] or [m]. Values beyond the limits are taken: a measured pose may lie there.
links : bool
    Poses of every link instead, in the order of `link_names`.
num_threads : int
    0 is all.

Returns
-------
(N, 4, 4) or (4, 4) array; with `links` (N, L, 4, 4) or (L, 4, 4)
    world_from_tool, world_from_link.

Examples
--------
>>> import bathyal
>>> arm = bathyal.arms.ur10e()
>>> arm.forward([[0, 0, 0, 0, 0, 0]])[0, :3, 3].round(4)
array([-1.1842, -0.2906,  0.0609])
)";

inline constexpr const char* kJacobianDoc = R"(Geometric Jacobians at the tool centre point.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]
frame : str
    Axes along which the velocities are given: "world" or "tool".
num_threads : int
    0 is all.

Returns
-------
(N, 6, n) or (6, n) array
    Rows of the linear velocity [m/s] above those of the angular velocity [rad/s].

Examples
--------
>>> import bathyal
>>> bathyal.arms.panda().jacobian([0, 0, 0, -1.5, 0, 1.5, 0]).shape
(6, 7)
)";

inline constexpr const char* kManipulabilityDoc = R"(How far poses are from a singularity.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]
kind : str
    "yoshikawa", √det(J Jᵀ) (Yoshikawa 1985); "smallest" singular value; "inverse_condition",
    smallest over largest: 0 singular, 1 isotropic.
part : str
    Which rows count: "all" (which mixes metres and radians), "linear" or "angular".
num_threads : int
    0 is all.

Returns
-------
(N,) array or float
    With fewer joints than rows, of the singular values that there are.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
>>> round(arm.manipulability([0.3, 1.5707963], part="linear"), 6)
0.2
)";

inline constexpr const char* kStaticsDoc = R"(Joint torques that hold the arm still.

The drives carry Jᵀ · wrench, the weight of every link and of the payload, less the buoyancy of the
volumes given. Masses and volumes are those of `links`; unknown ones are 0.

Parameters
----------
q : (N, n) or (n,) array
    [rad] or [m]
wrench : (6,) or (N, 6) array, optional
    Force and moment that the tool exerts on its surroundings at the tool centre point [N, N m].
frame : str
    Axes along which the wrench is given: "world" or "tool".
gravity : (3,) array
    In the arm's base frame [m/s²]: turn it with the vehicle.
water_density : float
    [kg/m³]; 0 in air.
payload, payload_volume : float
    Mass [kg] and displaced volume [m³] carried by the tool.
payload_center, payload_center_of_buoyancy : (3,) array
    In the tool's frame [m]; the second is as the first unless given.
num_threads : int
    0 is all.

Returns
-------
(N, n) or (n,) array
    [N m], of sliding joints [N], positive along the coordinate.

Examples
--------
>>> import bathyal
>>> arm = bathyal.Arm.from_dh(a=[0.5], alpha=[1.5707963267948966], d=[0], theta=[0],
...                           root=[[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
>>> arm.statics([0.0], payload=2.0).round(3)
array([9.807])
)";

inline constexpr const char* kInverseDoc = R"(Joint angles that bring the tool to poses.

Damped least squares (Sugihara 2011) within the limits, from `start` and then from poses drawn
within the limits, those first whose tool lies nearest. The result of a pose does not depend on the
others, nor on the number of threads.

Parameters
----------
poses : (N, 4, 4) or (4, 4) array
    world_from_tool. With task "position" also (N, 3) or (3,) places.
start : (n,) or (N, n) array, optional
    Where the search begins, within the limits; the answer stays near it where it can, also by whole
    turns. Unless given, near the middle of the limits.
task : str
    "pose"; "position", the tool centre point alone; "position_axis", and one axis of the tool.
method : str
    "damped"; or "pseudo_inverse" (also "jacobian_inverse", what it is where J is square), the
    stepping of Maevskiy and Zanin (2020): the way cut into equal `steps`, each by J⁺, without
    limits, damping or a second start; whole turns are taken off at its end.
axis : (3,) array
    Of "position_axis", in the tool's frame: it is to point as that of the target does.
position_tolerance, angle_tolerance : float, optional
    [m], [rad]. 1e-6 unless given; with "pseudo_inverse" 1e-2, as in the paper.
max_iterations : int
    Of one start.
max_starts : int
    Tried at most, the given one among them.
candidates : int
    The search goes on until so many starts have reached; the one nearest to `start` is taken.
centering_steps : int, optional
    Steps that a redundant arm, having reached, takes towards the middle of its limits. Unless
    given, 0 from a start, which it would leave, else 10.
steps : int
    Of "pseudo_inverse". As all counts here 10⁶ at most.
seed : int
    Of the drawn starts.
num_threads : int
    0 is all.

Returns
-------
InverseResult
    .q (N, n), .status, .error, .position_error, .angle_error, .iterations, .starts. Statuses:
    "reached"; "limit", reached only beyond the limits; "singular", the search was stuck though the
    pose lies within reach; "out_of_reach".

Examples
--------
>>> import bathyal
>>> arm = bathyal.arms.ur10e()
>>> q = [0.3, -1.2, 1.4, -0.5, 1.0, 0.2]
>>> found = arm.inverse(arm.forward(q), start=[0.2, -1, 1, 0, 1, 0])
>>> found.status, found.q.round(5)
('reached', array([ 0.3, -1.2,  1.4, -0.5,  1. ,  0.2]))
>>> arm.inverse([3.0, 0, 0], task="position").status
'out_of_reach'
)";

}  // namespace bathyal::python
