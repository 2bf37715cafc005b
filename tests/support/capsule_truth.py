# SPDX-License-Identifier: BSD-3-Clause
"""Distances of capsules and poses of arms in plain numpy: slow, for tests."""

from collections.abc import Callable

import numpy as np

Distance = Callable[[np.ndarray], np.ndarray]


def pose(
    origin: tuple[float, ...] | np.ndarray = (0, 0, 0),
    axis: tuple[float, ...] | np.ndarray = (0, 0, 1),
    angle: float = 0.0,
) -> np.ndarray:
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    result = np.eye(4)
    result[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    result[:3, 3] = origin
    return result


def random_pose(random: np.random.Generator, scale: float = 1.0) -> np.ndarray:
    return pose(random.normal(size=3) * scale, random.normal(size=3), random.uniform(-np.pi, np.pi))


def apply(transform: np.ndarray, points: np.ndarray) -> np.ndarray:
    return np.asarray(points) @ transform[:3, :3].T + transform[:3, 3]


def standard_row(a: float, alpha: float, d: float, theta: float) -> np.ndarray:
    return pose((0, 0, d), (0, 0, 1), theta) @ pose((a, 0, 0), (1, 0, 0), alpha)


def sphere(radius: float) -> Distance:
    return lambda p: np.linalg.norm(p, axis=-1) - radius


def box(size: np.ndarray) -> Distance:
    def distance(p: np.ndarray) -> np.ndarray:
        q = np.abs(p) - np.asarray(size) / 2
        return np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(-1), 0)

    return distance


def cylinder(radius: float, length: float) -> Distance:
    def distance(p: np.ndarray) -> np.ndarray:
        side = np.linalg.norm(p[..., :2], axis=-1) - radius
        q = np.stack([side, np.abs(p[..., 2]) - length / 2], -1)
        return np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(-1), 0)

    return distance


def cone(length: float, radius: float) -> Distance:
    def distance(p: np.ndarray) -> np.ndarray:
        flat = np.stack([np.linalg.norm(p[..., :2], axis=-1), p[..., 2]], -1)
        apex, rim, middle = np.zeros(2), np.array([radius, length]), np.array([0, length])

        def to_segment(a: np.ndarray, b: np.ndarray) -> np.ndarray:
            along = np.clip((flat - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            return np.linalg.norm(flat - a - along[..., None] * (b - a), axis=-1)

        nearest = np.minimum(to_segment(apex, rim), to_segment(rim, middle))
        inside = (flat[..., 1] <= length) & (flat[..., 0] * length <= radius * flat[..., 1])
        return np.where(inside, -nearest, nearest)

    return distance


def half_space() -> Distance:
    return lambda p: p[..., 2]


def least_on_segment(distance: Distance, a: np.ndarray, b: np.ndarray) -> float:
    """Of a distance to a convex body, which is convex itself, on a segment: thirds."""
    low, high = 0.0, 1.0
    for _ in range(100):
        one, two = low + (high - low) / 3, high - (high - low) / 3
        if distance(a + one * (b - a)) < distance(a + two * (b - a)):
            high = two
        else:
            low = one
    return float(min(distance(a + t * (b - a)) for t in (0.0, 1.0, (low + high) / 2)))


def between_segments(p1: np.ndarray, q1: np.ndarray, p2: np.ndarray, q2: np.ndarray) -> float:
    one, two, start = q1 - p1, q2 - p2, p1 - p2
    pairs = []
    normal = np.array([[one @ one, -one @ two], [-one @ two, two @ two]])
    if np.linalg.det(normal) > 1e-14 * normal[0, 0] * normal[1, 1] > 0:
        s, t = np.linalg.solve(normal, [-one @ start, two @ start])
        if 0 <= s <= 1 and 0 <= t <= 1:
            pairs.append((s, t))
    for end in (0.0, 1.0):
        t = (two @ (start + end * one)) / (two @ two) if two @ two > 0 else 0.0
        s = (one @ (end * two - start)) / (one @ one) if one @ one > 0 else 0.0
        pairs += [(end, min(max(t, 0.0), 1.0)), (min(max(s, 0.0), 1.0), end)]
    return float(min(np.linalg.norm(start + s * one - t * two) for s, t in pairs))
