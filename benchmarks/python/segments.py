# SPDX-License-Identifier: BSD-3-Clause
"""An arm's links over the bottom against Coal: ``python -m benchmarks.python.segments``.

Fourteen capsules a pose, a chain that bends at random, over two million triangles, on one thread.
Coal (PyPI ``coal``) takes one capsule at a time, on a BVHModelOBBRSS of the same triangles, with
shapes, poses, request and results made beforehand; both give distance and nearest points. Distances
are compared before any time is printed: Coal's iterations end within 10⁻⁶ m, and where a capsule
overlaps the bottom its depth is another measure, so only the fact is compared.
"""

import argparse
import platform
import statistics
import time

import coal
import numpy as np

import bathyal
from bathyal._core import simd_level

WIDTH = 500.0  # of the seabed [m]
LINKS = 14
RADIUS = 0.05  # of the capsules [m]


def seabed(side=1001):
    """A square of 2 (side − 1)² triangles over `height`."""
    axis = np.linspace(0.0, WIDTH, side)
    x, y = np.meshgrid(axis, axis)
    xy = np.column_stack([x.ravel(), y.ravel()])
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    right, above, across = corner + 1, corner + side, corner + side + 1
    triangles = np.empty((2 * corner.size, 3), np.int32)
    triangles[0::2] = np.column_stack([corner, right, across])
    triangles[1::2] = np.column_stack([corner, across, above])
    return np.column_stack([xy, height(xy)]), triangles


def height(xy):
    """Swell, sand waves, ripples [m]."""
    x, y = xy.T
    z = 2.0 * np.sin(x / 13.0) + 1.5 * np.cos(y / 7.0 + x / 31.0) - 50.0
    return z + 0.3 * np.sin(1.3 * x) * np.cos(1.7 * y)


def chains(poses, lowest, highest, seed=3):
    """Starts and ends (poses · LINKS, 3) of links of 0.08 to 0.35 m, each bent from the one before.

    The first hangs between two heights above the bottom [m].
    """
    random = np.random.default_rng(seed)
    base = random.uniform(20.0, WIDTH - 20.0, (poses, 2))
    base = np.column_stack([base, height(base) + random.uniform(lowest, highest, poses)])
    heading = random.normal(size=(poses, 3)) - (0.0, 0.0, 0.5)
    points = [base]
    for length in random.uniform(0.08, 0.35, LINKS):
        heading = heading / np.linalg.norm(heading, axis=1)[:, None]
        points.append(points[-1] + length * heading)
        heading = heading + random.normal(0.0, 0.5, (poses, 3))
    joints = np.stack(points, axis=1)
    return joints[:, :-1].reshape(-1, 3), joints[:, 1:].reshape(-1, 3)


def coal_model(vertices, triangles):
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(triangles), len(vertices))
    model.addVertices(vertices)
    model.addTriangles(triangles.astype(np.int64))
    model.endModel()
    return model


def coal_capsules(start, end):
    """Shape and pose of each segment's capsule."""
    capsules = []
    for p, q in zip(start, end, strict=True):
        z = (q - p) / np.linalg.norm(q - p)
        x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x /= np.linalg.norm(x)
        pose = coal.Transform3s(np.column_stack([x, np.cross(z, x), z]), 0.5 * (p + q))
        capsules.append((coal.Capsule(RADIUS, float(np.linalg.norm(q - p))), pose))
    return capsules


def coal_distances(model, capsules, request, results):
    still = coal.Transform3s.Identity()
    return [
        coal.distance(shape, pose, model, still, request, result)
        for (shape, pose), result in zip(capsules, results, strict=True)
    ]


def compare(name, ours, theirs):
    """The largest difference [m]; ends the run when it is not small."""
    apart = ours > RADIUS
    if (theirs[~apart] > 1e-6).any() or (theirs[apart] <= 0.0).any():
        raise SystemExit(f"{name}: one of them sees an overlap, the other none")
    worst = np.abs(ours[apart] - RADIUS - theirs[apart]).max()
    if worst > 1e-5:
        raise SystemExit(f"{name}: a distance is {worst} m off Coal's")
    return worst


def seconds(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def run(rounds, poses):
    vertices, triangles = seabed()
    scene = bathyal.Scene(bathyal.TriangleMesh(vertices, triangles))
    model = coal_model(vertices, triangles)
    request = coal.DistanceRequest(True)
    print("## Segments against Coal\n")
    print(
        "| 14 links | triangles | Coal / ours | Coal / ours with `within` 0.5 m "
        "| ours [µs/pose] | Coal | overlapping | largest difference [mm] |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for name, lowest, highest in (
        ("0 to 1 m above the bottom", 0.0, 1.0),
        ("2 to 4 m above it", 2.0, 4.0),
        ("10 to 20 m above it", 10.0, 20.0),
    ):
        start, end = chains(poses, lowest, highest)
        capsules = coal_capsules(start, end)
        results = [coal.DistanceResult() for _ in capsules]
        ours = scene.nearest_segments(start, end, num_threads=1).distance
        theirs = np.array(coal_distances(model, capsules, request, results))
        worst = compare(name, ours, theirs)
        times = []
        for _ in range(rounds):
            results = [coal.DistanceResult() for _ in capsules]
            times.append(
                [
                    seconds(lambda s=start, e=end: scene.nearest_segments(s, e, num_threads=1)),
                    seconds(lambda c=capsules, r=results: coal_distances(model, c, request, r)),
                    seconds(
                        lambda s=start, e=end: scene.nearest_segments(
                            s, e, within=0.5, num_threads=1
                        )
                    ),
                ]
            )
        times = np.array(times)
        ratio = [statistics.median(times[:, 1] / times[:, i]) for i in (0, 2)]
        per_pose = 1e6 * np.median(times, axis=0) / poses
        print(
            f"| {name} | {len(triangles):,} | {ratio[0]:.1f} × | {ratio[1]:.1f} × "
            f"| {per_pose[0]:.1f} | {per_pose[1]:.0f} | {100 * np.mean(ours <= RADIUS):.1f} % "
            f"| {1e3 * worst:.0e} |"
        )
    print(
        f"\nMedians of {rounds} rounds of {poses:,} poses, one thread, processor time; ratios "
        f"above 1 where ours is faster; `within` has no counterpart in Coal. "
        f"SIMD level {simd_level()}; Coal {coal.__version__}, numpy {np.__version__}, "
        f"Python {platform.python_version()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--poses", type=int, default=300)
    arguments = parser.parse_args()
    run(arguments.rounds, arguments.poses)
