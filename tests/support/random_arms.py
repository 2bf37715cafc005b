# SPDX-License-Identifier: BSD-3-Clause
"""Arms of the catalogue and arms with numbers drawn at random, and poses within their limits."""

import numpy as np
from numpy.typing import NDArray

import bathyal

Array = NDArray[np.float64]
CATALOGUE = [getattr(bathyal.arms, name) for name in bathyal.arms.__all__]


def rigid(random: np.random.Generator) -> Array:
    pose = np.eye(4)
    pose[:3, :3] = np.linalg.qr(random.normal(size=(3, 3)))[0]
    pose[:3, :3] *= np.linalg.det(pose[:3, :3])
    pose[:3, 3] = random.normal(size=3)
    return pose


def random_arm(seed: int, joints: int) -> bathyal.Arm:
    random = np.random.default_rng(seed)
    columns = random.uniform(-1, 1, (5, joints)) * [[1], [3], [1], [3], [0.2]]
    kinds = random.choice(["revolute", "prismatic", "fixed"], joints, p=[0.7, 0.2, 0.1]).tolist()
    kinds[0] = "revolute"
    links = [
        bathyal.Link(
            f"link_{k}",
            mass=random.uniform(0, 5),
            center_of_mass=random.normal(size=3),
            volume=random.uniform(0, 1e-3),
            frame=rigid(random),
        )
        for k in range(joints + 1)
    ]
    a, alpha, d, theta, beta = columns
    return bathyal.Arm.from_dh(
        a, alpha, d, theta, beta=beta, joint_types=kinds, links=links,
        root=rigid(random), flange=rigid(random), base=rigid(random), tool=rigid(random),
    )  # fmt: skip


def poses_of(arm: bathyal.Arm, count: int, seed: int = 0) -> Array:
    random = np.random.default_rng(seed)
    low, high = np.maximum(arm.lower, -3), np.minimum(arm.upper, 3)
    return random.uniform(low, high, (count, arm.size))
