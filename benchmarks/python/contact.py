# SPDX-License-Identifier: BSD-3-Clause
"""Are distances and motion checks right? ``python -m benchmarks.python.contact``.

Distances: random capsules against capsules and each kind of keep-out, and Coal's (PyPI ``coal``) of
the same shapes. Motions: random worlds of balls, boxes and a floor around a Panda on a hull; each
continuous check is compared with dense samples, no joint moving by more than the step between two.
A contact that was missed, found later than the samples by more than 10⁻³ of a row, or reported of a
motion that keeps 1 mm clear, is counted: all three must be 0.
"""

import argparse
import time

import coal
import numpy as np

import bathyal

MOUNT = np.array([[1.0, 0, 0, 0.6], [0, -1, 0, 0], [0, 0, -1, -0.25], [0, 0, 0, 1]])
CLEAR = 1e-3  # [m]


def random_pose(rng, spread):
    quaternion = rng.normal(size=4)
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = rng.uniform(-spread, spread, 3)
    return pose


def transform(pose):
    return coal.Transform3s(pose[:3, :3], pose[:3, 3])


def shapes(rng):
    """(name, keep-out, Coal's shape, Coal's pose) of each kind that Coal has too."""
    pose = random_pose(rng, 0.5)
    size = rng.uniform(0.1, 1.0, 3)
    middle = pose.copy()
    middle[:3, 3] += 0.5 * size[1] * pose[:3, 2]  # Coal's cone: middle in the origin, apex up
    turned = middle.copy()
    turned[:3, 1:3] *= -1
    yield "sphere", bathyal.KeepOut.sphere(size[0], pose[:3, 3]), coal.Sphere(size[0]), pose
    yield "box", bathyal.KeepOut.box(size, pose), coal.Box(*size), pose
    yield (
        "cylinder", bathyal.KeepOut.cylinder(size[0], size[1], pose),
        coal.Cylinder(size[0], size[1]), pose,
    )  # fmt: skip
    yield (
        "cone", bathyal.KeepOut.cone(size[1], pose, radius=size[0]),
        coal.Cone(size[0], size[1]), turned,
    )  # fmt: skip


def distances(pairs):
    rng = np.random.default_rng(2)
    request = coal.DistanceRequest(True)
    worst = {}
    overlapping = 0
    per_shape = 250
    for _ in range(-(-pairs // (4 * per_shape))):
        for name, keepout, shape, pose in shapes(rng):
            a, b = rng.uniform(-2, 2, (2, per_shape, 3))
            radius = rng.uniform(0.01, 0.2, per_shape)
            ours = keepout.capsule_distance(a, b, radius, num_threads=1)
            for i in range(per_shape):
                length = float(np.linalg.norm(b[i] - a[i]))
                z = (b[i] - a[i]) / length
                x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
                x /= np.linalg.norm(x)
                turn = coal.Transform3s(
                    np.column_stack([x, np.cross(z, x), z]), 0.5 * (a[i] + b[i])
                )
                theirs = coal.distance(
                    coal.Capsule(float(radius[i]), length), turn, shape, transform(pose), request,
                    coal.DistanceResult(),
                )  # fmt: skip
                if ours[i] <= 0:
                    overlapping += 1
                    if theirs > 1e-6:
                        raise SystemExit(f"{name}: only ours sees an overlap ({ours[i]}, {theirs})")
                    continue
                worst[name] = max(worst.get(name, 0.0), abs(ours[i] - theirs))
    total = 4 * per_shape * -(-pairs // (4 * per_shape))
    print(f"## Distances against Coal\n\n{total:,} pairs, {overlapping:,} of them overlapping.\n")
    print("| capsule against | largest difference [m] |\n|---|---|")
    for name, value in worst.items():
        print(f"| {name} | {value:.0e} |")


def world(rng, hull):
    keepouts = [
        bathyal.KeepOut.half_space((0, 0, 1), point=(0, 0, -1.3), frame="world", name="floor")
    ]
    for k in range(3):
        center = rng.uniform([0.3, -0.8, -1.2], [1.4, 0.8, 0.2])
        keepouts.append(bathyal.KeepOut.sphere(rng.uniform(0.02, 0.2), center, name=f"ball_{k}"))
        pose = random_pose(rng, 0.0)
        pose[:3, 3] = rng.uniform([0.3, -0.8, -1.2], [1.4, 0.8, 0.2])
        size = rng.uniform(0.005, 0.3, 3)  # thin plates among them
        keepouts.append(bathyal.KeepOut.box(size, pose, name=f"box_{k}"))
    return bathyal.Workspace(
        bathyal.arms.panda(), MOUNT, hull=hull, keepouts=keepouts, radii=rng.uniform(0.01, 0.07)
    )


def motions(count, step):
    from benchmarks.python.workspace import ellipsoid

    rng = np.random.default_rng(3)
    hull = bathyal.Hull(ellipsoid(20, 20))
    missed = late = refused = free = met = samples = 0
    checking = 0.0
    while free + met < count:
        ws = world(rng, hull)
        for _ in range(20):
            start = rng.uniform(ws.arm.lower, ws.arm.upper)
            rows = np.vstack([start, start + rng.uniform(-1, 1, 7)])
            near = ws.clearance(start)
            if min(near.distance, near.self_distance) <= 0 or free + met == count:
                continue
            began = time.perf_counter()
            check = ws.check_motion(rows)
            checking += time.perf_counter() - began
            parts = int(np.ceil(np.abs(rows[1] - rows[0]).max() / step))
            dense = start + np.linspace(0, 1, parts + 1)[:, None] * (rows[1] - start)
            near = ws.clearance(dense)
            least = np.minimum(near.distance, near.self_distance)
            samples += len(dense)
            touching = np.flatnonzero(least <= 0)
            free, met = free + check.free, met + (not check.free)
            missed += bool(check.free and touching.size)
            if not check.free:
                first = touching[0] / parts if touching.size else 1.0
                late += bool(check.contact > first + 1e-3)
                refused += bool(least.min() > CLEAR)
    print(f"\n## Continuous checks against samples every {step:g} rad\n")
    print("| motions | free | contact | samples | missed | late | refused with 1 mm clear |")
    print("|---|---|---|---|---|---|---|")
    print(f"| {count:,} | {free:,} | {met:,} | {samples:,} | {missed} | {late} | {refused} |")
    print(f"\n{1e3 * checking / count:.2f} ms a check, on the mean.")
    if missed or late or refused:
        raise SystemExit("a check is wrong")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=100_000)
    parser.add_argument("--motions", type=int, default=1000)
    parser.add_argument("--step", type=float, default=1e-4)
    arguments = parser.parse_args()
    distances(arguments.pairs)
    motions(arguments.motions, arguments.step)
