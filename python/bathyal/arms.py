# SPDX-License-Identifier: BSD-3-Clause
"""Arms by name, with their limits and where the numbers come from (``arm.source``).

Each function gives a new Arm: nominal geometry of the drawing, from the foot to the flange. A real
arm differs from it by millimetres: see bathyal.identify_arm. Its links have cylinders for
collisions, as thick as the links are about: to centimetres; the meshes of a URDF are nearer.

Examples
--------
>>> import bathyal
>>> bathyal.arms.ur10e()
Arm("UR10e", 6 joints)
>>> bathyal.arms.panda().upper
array([ 2.8973,  1.7628,  2.8973, -0.0698,  2.8973,  3.7525,  2.8973])
"""

from math import atan, inf, pi

from bathyal._core import Arm, with_link_radii

__all__ = [
    "gen3_lite",
    "maevskiy_zanin",
    "panda",
    "reach_alpha_5",
    "reach_bravo_7",
    "ur10",
    "ur10e",
]

_UR_NAMES = [
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
]
_UR_ALPHA = [pi / 2, 0, 0, pi / 2, -pi / 2, 0]
_UR_UPPER = [2 * pi, 2 * pi, pi, 2 * pi, 2 * pi, 2 * pi]
_UR_EFFORT = [330, 330, 150, 56, 56, 56]


def _ur(name: str, a: list[float], d: list[float], velocity: list[float], source: str) -> Arm:
    arm = Arm.from_dh(
        a=a,
        alpha=_UR_ALPHA,
        d=d,
        theta=[0] * 6,
        lower=[-limit for limit in _UR_UPPER],
        upper=_UR_UPPER,
        velocity=velocity,
        effort=_UR_EFFORT,
        names=_UR_NAMES,
        name=name,
        source=source,
    )
    return with_link_radii(arm, [0.075, 0.075, 0.075, 0.06, 0.045, 0.045, 0.045])


def ur10() -> Arm:
    """Universal Robots UR10 (CB3), six joints, base to tool flange.

    The elbow is held within half a turn to either side, as in the maker's ROS description; the
    others turn a whole one.
    """
    return _ur(
        "UR10",
        a=[0, -0.612, -0.5723, 0, 0, 0],
        d=[0.1273, 0, 0, 0.163941, 0.1157, 0.0922],
        velocity=[2 * pi / 3, 2 * pi / 3, pi, pi, pi, pi],
        source="Universal Robots, 'DH parameters for calculations of kinematics and dynamics', "
        "UR10; limits and torques of the user manual and 'Max. joint torques'",
    )


def ur10e() -> Arm:
    """Universal Robots UR10e, six joints, base to tool flange.

    The nominal table of Yukhimets, Gubankov (2023). Limits as of ur10.
    """
    return _ur(
        "UR10e",
        a=[0, -0.6127, -0.5715, 0, 0, 0],
        d=[0.1807, 0, 0, 0.1741, 0.1198, 0.1165],
        velocity=[2 * pi / 3, 2 * pi / 3, pi, pi, pi, pi],
        source="Yukhimets, Gubankov (2023), nominal UR10e; limits and torques of Universal Robots' "
        "user manual and 'Max. joint torques'",
    )


def panda() -> Arm:
    """Franka Emika Panda, seven joints, base to flange (the hand is a tool)."""
    arm = Arm.from_dh(
        a=[0, 0, 0, 0.0825, -0.0825, 0, 0.088, 0],
        alpha=[0, -pi / 2, pi / 2, pi / 2, -pi / 2, pi / 2, pi / 2, 0],
        d=[0.333, 0, 0.316, 0, 0.384, 0, 0, 0.107],
        theta=[0] * 8,
        joint_types=["revolute"] * 7 + ["fixed"],
        convention="modified",
        lower=[-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973, -inf],
        upper=[2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973, inf],
        velocity=[2.175] * 4 + [2.61] * 3 + [inf],
        effort=[87] * 4 + [12] * 3 + [inf],
        names=[f"panda_joint{k}" for k in range(1, 9)],
        name="Panda",
        source="Franka Emika, Robot and interface specifications: Denavit-Hartenberg parameters "
        "(Craig's convention) and limits of the Panda",
    )
    return with_link_radii(arm, [0.09, 0.06, 0.06, 0.06, 0.06, 0.06, 0.05, 0.05, 0.05])


def gen3_lite() -> Arm:
    """Kinova Gen3 lite, six joints, base to the interface that carries the gripper."""
    upper = [2.68, 2.61, 2.61, 2.57, 2.53, 2.09]
    arm = Arm.from_dh(
        a=[0, 0.28, 0, 0, 0, 0],
        alpha=[pi / 2, pi, pi / 2, pi / 2, pi / 2, 0],
        d=[0.12825 + 0.115, 0.03, 0.02, 0.14 + 0.105, 0.0285 + 0.0285, 0.105],
        theta=[0, pi / 2, pi / 2, pi / 2, pi, pi / 2],
        lower=[-limit for limit in upper],
        upper=upper,
        velocity=[1.6, 1.6, 1.6, 1.3963, 1.6, 1.2218],
        effort=[10, 14, 10, 39, 7, 9],
        names=[f"joint_{k}" for k in range(1, 7)],
        name="Gen3 lite",
        source="Kinova, URDF of the Gen3 lite",
    )
    return with_link_radii(arm, [0.05, 0.045, 0.04, 0.04, 0.035, 0.035, 0.035])


def maevskiy_zanin() -> Arm:
    """The three-joint arm that takes soil samples in Maevskiy, Zanin (2020).

    How thick its links are was not published: 8 cm is assumed.
    """
    arm = Arm.from_dh(
        a=[0.193, 0.552, 0.596],
        alpha=[pi / 2, 0, 0],
        d=[-0.117, 0, 0],
        theta=[0, 0, 0],
        lower=[-pi / 2, -pi / 2, -0.75 * pi],
        upper=[pi / 2, pi, 0.75 * pi],
        name="Maevskiy-Zanin",
        source="Maevskiy, Zanin (2020), Modular control systems for manipulators and "
        "intervention-class AUVs: table of Denavit-Hartenberg parameters and limits",
    )
    return with_link_radii(arm, 0.04)


def reach_alpha_5() -> Arm:
    """Reach Robotics Alpha 5, its four turning joints from the base, E to B; the tool is the jaw.

    q runs from the base outward (axis e, d, c, b of the maker's counting from the jaw).
    """
    arm = Arm.from_dh(
        a=[0.02, 0.15, 0.02, 0],
        alpha=[pi / 2, pi, -pi / 2, 0],
        d=[0.046, 0, 0, -0.19],
        theta=[0, -1.3, -1.3, 0],
        lower=[0, 0, 0, 0],
        upper=[6.2, 3.5, 3.5, 6.0],
        velocity=[0.5, 0.5, 0.5, 1.0],
        effort=[9, 9, 9, 5],
        names=["axis_e", "axis_d", "axis_c", "axis_b"],
        name="Reach Alpha 5",
        source="Kolano (2023), URDF of a BlueROV2 with a Reach Alpha 5",
    )
    return with_link_radii(arm, 0.025)


def reach_bravo_7() -> Arm:
    """Reach Robotics Bravo 7, its six turning joints from the base, G to B; the tool is the jaw.

    The first and last rows of the maker's table are fixed transforms inside the arm.
    """
    bend = atan(5.2 / 290.77)
    arm = Arm.from_dh(
        d=[0.04145, -0.11748, 0, 0, -0.16026, 0, -0.22416, 0],
        theta=[0, pi, -pi / 2 + bend, -pi / 2 - bend, pi, 0, 0, -pi / 2],
        a=[0.0675, 0.046, 0.29082, 0.0408, 0.0408, 0.0408, 0, 0.12],
        alpha=[pi, -pi / 2, 0, -pi / 2, -pi / 2, -pi / 2, pi / 2, 0],
        joint_types=["fixed", *["revolute"] * 6, "fixed"],
        lower=[-inf, 0, 0, 0, 0, 0, -inf, -inf],
        upper=[inf, 6.3, 3.2, 3.2, 6.2, 3.2, inf, inf],
        names=["base", "axis_g", "axis_f", "axis_e", "axis_d", "axis_c", "axis_b", "jaw"],
        name="Reach Bravo 7",
        source="Reach Robotics, kinematic table of the Bravo 7; limits of the maker's ROS "
        "description (axis b turns without end)",
    )
    return with_link_radii(arm, 0.05)
