# SPDX-License-Identifier: BSD-3-Clause
"""An arm given to Pinocchio, joint by joint, from its table."""

import numpy as np
import pytest
from numpy.typing import NDArray

import bathyal

pin = pytest.importorskip("pinocchio")

Array = NDArray[np.float64]


def _turn(axis: int, angle: float) -> Array:
    pose = np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    pose[i, i] = pose[j, j] = np.cos(angle)
    pose[i, j], pose[j, i] = -np.sin(angle), np.sin(angle)
    return pose


def _shift(x: float, z: float) -> Array:
    pose = np.eye(4)
    pose[0, 3], pose[2, 3] = x, z
    return pose


class PinArm:
    """Base, tool and links included; on a hull that floats freely where one is given."""

    def __init__(self, arm: bathyal.Arm, hull: bathyal.RigidBody | None = None) -> None:
        table = arm.to_dh()
        self.model = pin.Model()
        placement = arm.base @ table.root
        parent = 0
        links = list(arm.links)
        if hull is not None:
            free = pin.JointModelFreeFlyer()
            parent = self.model.addJoint(0, free, pin.SE3.Identity(), "hull")
            for body, pose in ((hull, np.eye(4)), (links[0], placement @ links[0].frame)):
                inertia = pin.Inertia(body.mass, body.center_of_mass, body.inertia)
                self.model.appendBodyToJoint(parent, inertia, pin.SE3(pose))
        for k, kind in enumerate(table.joint_types):
            placement = placement @ _turn(2, table.theta[k]) @ _shift(0, table.d[k])
            twist = _shift(table.a[k], 0) @ _turn(0, table.alpha[k]) @ _turn(1, table.beta[k])
            if kind == "fixed":
                placement = placement @ twist
            else:
                joint = pin.JointModelRZ() if kind == "revolute" else pin.JointModelPZ()
                parent = self.model.addJoint(parent, joint, pin.SE3(placement), f"joint_{k}")
                placement = twist
            link = links[k + 1]
            inertia = pin.Inertia(link.mass, link.center_of_mass, link.inertia)
            self.model.appendBodyToJoint(parent, inertia, pin.SE3(placement @ link.frame))
        tip = placement @ table.flange @ arm.tool
        self.tip = self.model.addFrame(
            pin.Frame("tip", parent, 0, pin.SE3(tip), pin.FrameType.OP_FRAME)
        )
        self.data = self.model.createData()

    def forward(self, q: Array) -> Array:
        pin.framesForwardKinematics(self.model, self.data, q)
        return np.array(self.data.oMf[self.tip].homogeneous)

    def jacobian(self, q: Array, frame: str) -> Array:
        axes = pin.LOCAL_WORLD_ALIGNED if frame == "world" else pin.LOCAL
        columns = pin.computeFrameJacobian(self.model, self.data, q, self.tip, axes)
        return np.array(columns).reshape(6, -1)

    def gravity(self, q: Array, gravity: Array) -> Array:
        self.model.gravity.linear = gravity
        return np.array(pin.computeGeneralizedGravity(self.model, self.data, q))


def urdf_tips(path: str, frame: str, root: str, names: list[str], q: Array) -> Array:
    """root_from_frame of a URDF at each row of q, whose columns are the joints `names`."""
    model = pin.buildModelFromUrdf(path)
    data = model.createData()
    places = [model.idx_qs[model.getJointId(name)] for name in names]
    poses = []
    for row in q:
        full = pin.neutral(model)
        full[places] = row
        pin.framesForwardKinematics(model, data, full)
        root_from_frame = data.oMf[model.getFrameId(root)].actInv(data.oMf[model.getFrameId(frame)])
        poses.append(root_from_frame.homogeneous)
    return np.array(poses)
