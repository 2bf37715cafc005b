# SPDX-License-Identifier: BSD-3-Clause
"""Rays and nearest points against Open3D and embreex: ``python -m benchmarks.python.rays``.

Peers, both on Embree, from PyPI (``pip install open3d-cpu embreex``), in the same run, on the same
triangles and rays. Every call starts from numpy arrays in the peer's own precision (float32; ours
float64) and ends with its result structs: Open3D computes ranges, numbers, normals and (u, v) in
the call, embreex ranges, numbers, normals and (u, v), ours ranges, numbers and (u, v), the rest
when first asked for; the last column asks for normals and points as well. embreex has no threads.
Hits are compared before any time is printed: peers decide in float32, so a ray in 10 000 may differ
at the border of a triangle or a shadow, and ranges by a centimetre. Of the nearest points, which
embreex does not have, distances are compared: they may differ by float32's digits.
"""

import argparse
import platform
import statistics
import time

import embreex
import numpy as np
import open3d
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore_scene import EmbreeScene
from open3d.t.geometry import RaycastingScene

import bathyal
from bathyal._core import simd_level

WIDTH = 500.0  # of the seabed [m]
RAYS = 500_000
POINTS = 50_000


def seabed(side, seed=7):
    """A square of 2 (side − 1)² triangles: swell, sand waves, roughness."""
    axis = np.linspace(0.0, WIDTH, side)
    x, y = np.meshgrid(axis, axis)
    z = 2.0 * np.sin(x / 13.0) + 1.5 * np.cos(y / 7.0 + x / 31.0) - 50.0
    z += np.random.default_rng(seed).normal(0.0, 0.05, z.shape)
    vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    right, above, across = corner + 1, corner + side, corner + side + 1
    triangles = np.empty((2 * corner.size, 3), np.int32)
    triangles[0::2] = np.column_stack([corner, right, across])
    triangles[1::2] = np.column_stack([corner, across, above])
    return vertices, triangles


def side_scan():
    """Two fans a ping, 10° to 80° from straight down, square to a straight track."""
    across = np.radians(np.linspace(10.0, 80.0, 500))
    across = np.concatenate([-across[::-1], across])
    pings = RAYS // across.size
    origins = np.zeros((pings, across.size, 3))
    origins[:] = np.linspace((250.0, 20.0, -35.0), (250.0, 480.0, -35.0), pings)[:, None]
    fan = np.column_stack([np.sin(across), np.zeros_like(across), -np.cos(across)])
    return origins.reshape(-1, 3), np.tile(fan, (pings, 1))


def multibeam(seed=3):
    """400 beams over ±65° a ping, from a vehicle that rolls, pitches and yaws."""
    random = np.random.default_rng(seed)
    beams = np.radians(np.linspace(-65.0, 65.0, 400))
    pings = RAYS // beams.size
    track = np.linspace((60.0, 30.0, -30.0), (430.0, 470.0, -32.0), pings)
    roll, pitch, yaw = np.radians(random.normal(0.0, 2.0, (3, pings, 1)))
    tilt = beams + roll
    ahead = np.sin(pitch) * np.cos(tilt)
    yaw = yaw + np.radians(50.0)
    directions = np.stack(
        [
            np.cos(yaw) * ahead + np.sin(yaw) * np.sin(tilt),
            np.sin(yaw) * ahead - np.cos(yaw) * np.sin(tilt),
            -np.cos(pitch) * np.cos(tilt),
        ],
        axis=-1,
    )
    return np.repeat(track, beams.size, axis=0), directions.reshape(-1, 3)


def random_rays(seed=5):
    """Origins anywhere in the water above, directions all round."""
    random = np.random.default_rng(seed)
    origins = random.uniform((0.0, 0.0, -45.0), (WIDTH, WIDTH, -20.0), (RAYS, 3))
    directions = random.normal(size=(RAYS, 3))
    return origins, directions / np.linalg.norm(directions, axis=1)[:, None]


def random_points(low, high, seed=11):
    """Anywhere in the water between two depths."""
    return np.random.default_rng(seed).uniform((0.0, 0.0, low), (WIDTH, WIDTH, high), (POINTS, 3))


def hull_points(seed=13):
    """Those of a hull, 2 000 a pose, that follows a track some metres above the bottom."""
    hull = np.random.default_rng(seed).normal(size=(2000, 3))
    hull *= np.array([2.0, 0.6, 0.5]) / np.linalg.norm(hull, axis=1)[:, None]
    track = np.linspace((60.0, 30.0, -44.0), (430.0, 470.0, -42.0), POINTS // len(hull))
    return (track[:, None] + hull).reshape(-1, 3)


def open3d_scene(vertices, triangles, threads):
    scene = RaycastingScene(nthreads=threads)
    scene.add_triangles(
        open3d.core.Tensor(vertices.astype(np.float32)),
        open3d.core.Tensor(triangles.astype(np.uint32)),
    )
    # The hierarchy is built by the first question.
    scene.cast_rays(open3d.core.Tensor([[0.0, 0.0, 0.0, 0.0, 0.0, 1.0]], open3d.core.float32))
    return scene


def embreex_scene(vertices, triangles):
    scene = EmbreeScene()
    mesh = EmbreeMesh(scene, vertices.astype(np.float32), triangles)
    scene.run(np.zeros((1, 3), np.float32), np.array([[0, 0, 1]], np.float32))
    return scene, mesh


def seconds(work, clock):
    start = clock()
    work()
    return clock() - start


def interleaved(rounds, works, threads):
    """Seconds of each work in every round, one after the other.

    On one thread, of the processor: what a core does is asked, and a busy machine must not answer.
    """
    clock = time.process_time if threads == 1 else time.perf_counter
    for work in works:
        work()
    return np.array([[seconds(work, clock) for work in works] for _ in range(rounds)])


def compare(name, ours, their_range, their_triangle):
    """Share of rays that agree; ends the run when it is not nearly all of them."""
    met = np.isfinite(their_range)
    same = met == np.isfinite(ours.range)
    close = np.abs(np.where(met, their_range, 0.0) - np.where(same & met, ours.range, 0.0)) < 0.01
    agree = np.mean(same & (close | ~met))
    numbers = np.mean(ours.triangle[met] == their_triangle[met])
    if agree < 0.9999 or numbers < 0.995:
        raise SystemExit(f"{name}: {agree:.6f} of the hits agree, {numbers:.6f} of the triangles")
    return agree


def open3d_hits(scene, rays):
    found = scene.cast_rays(rays)
    return found["t_hit"].numpy(), found["primitive_ids"].numpy().astype(np.int64)


def embreex_hits(scene, origins, directions):
    found = scene.run(origins, directions, output=1)
    met = found["primID"] >= 0
    return np.where(met, found["tfar"], np.inf), found["primID"].astype(np.int64)


def cast_rows(scenes, count, rounds):
    ours, by_open3d, by_embreex = scenes
    for name, rays in (
        ("side-scan", side_scan()),
        ("multibeam", multibeam()),
        ("random", random_rays()),
    ):
        origins, directions = rays
        single = np.concatenate(rays, axis=1).astype(np.float32)
        origins32, directions32 = origins.astype(np.float32), directions.astype(np.float32)
        tensor = open3d.core.Tensor(single)
        hits = ours.cast(origins, directions)
        agree = compare(f"Open3D, {name}", hits, *open3d_hits(by_open3d, tensor))
        compare(f"embreex, {name}", hits, *embreex_hits(by_embreex, origins32, directions32))

        def everything(origins=origins, directions=directions, threads=1):
            found = ours.cast(origins, directions, num_threads=threads)
            return found.range, found.triangle, found.normal, found.point

        for threads in (1, 2):
            works = [
                lambda o=origins, d=directions, n=threads: ours.cast(o, d, num_threads=n).range,
                lambda t=tensor, n=threads: by_open3d.cast_rays(t, nthreads=n),
                lambda n=threads: everything(threads=n),
            ]
            if threads == 1:
                works.append(lambda o=origins32, d=directions32: by_embreex.run(o, d, output=1))
            times = interleaved(rounds, works, threads)
            rate = len(origins) / np.median(times, axis=0) / 1e6
            ratio = [statistics.median(times[:, i] / times[:, 0]) for i in range(len(works))]
            embreex_ratio = f"{ratio[3]:.2f} ×" if threads == 1 else "—"
            embreex_rate = f"{rate[3]:.1f}" if threads == 1 else "—"
            print(
                f"| {name} | {count:,} | {threads} | {ratio[1]:.2f} × | {embreex_ratio} "
                f"| {rate[0]:.1f} | {rate[1]:.1f} | {embreex_rate} | {rate[2]:.1f} "
                f"| {100 * agree:.4f} % |"
            )


def nearest_rows(ours, by_open3d, count, rounds):
    rows = []
    for name, points in (
        ("within 2 m of the bottom", random_points(-52.0, -48.0)),
        ("5 to 25 m above it", random_points(-45.0, -25.0)),
        ("a hull on its way", hull_points()),
    ):
        tensor = open3d.core.Tensor(points.astype(np.float32))
        foot = by_open3d.compute_closest_points(tensor)["points"].numpy()
        difference = np.linalg.norm(points - foot, axis=1) - ours.nearest(points).distance
        worst = np.abs(difference).max()
        if worst > 1e-3:
            raise SystemExit(f"nearest, {name}: a distance is {worst} m off Open3D's")
        for threads in (1, 2):
            times = interleaved(
                rounds,
                [
                    lambda p=points, n=threads: ours.nearest(p, num_threads=n).distance,
                    lambda t=tensor, n=threads: by_open3d.compute_closest_points(t, nthreads=n),
                ],
                threads,
            )
            ratio = statistics.median(times[:, 1] / times[:, 0])
            rate = POINTS / np.median(times, axis=0) / 1e6
            rows.append(
                f"| {name} | {count:,} | {threads} | {ratio:.2f} × | {rate[0]:.2f} "
                f"| {rate[1]:.2f} | {1e3 * worst:.3f} |"
            )
    return rows


def build_rows(mesh, vertices, triangles, rounds):
    rows = []
    for threads in (1, 2):
        times = interleaved(
            rounds,
            [
                lambda n=threads: bathyal.Scene(mesh, num_threads=n),
                lambda n=threads: open3d_scene(vertices, triangles, n),
            ],
            threads,
        )
        ratio = statistics.median(times[:, 1] / times[:, 0])
        milliseconds = 1e3 * np.median(times, axis=0)
        memory = bathyal.Scene(mesh).memory / len(triangles)
        rows.append(
            f"| {len(triangles):,} | {threads} | {ratio:.2f} × | {milliseconds[0]:.0f} "
            f"| {milliseconds[1]:.0f} | {memory:.1f} |"
        )
    return rows


def run(rounds):
    print("## Rays and nearest points\n")
    print(
        "| rays | triangles | threads | ours / Open3D | ours / embreex | ours [Mray/s] "
        "| Open3D | embreex | ours with normals and points | same hits |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    nearest, builds = [], []
    for side in (317, 1001):
        vertices, triangles = seabed(side)
        mesh = bathyal.TriangleMesh(vertices, triangles)
        by_embreex, keep_alive = embreex_scene(vertices, triangles)
        scenes = (bathyal.Scene(mesh), open3d_scene(vertices, triangles, 2), by_embreex)
        cast_rows(scenes, len(triangles), rounds)
        del keep_alive
        nearest += nearest_rows(scenes[0], scenes[1], len(triangles), max(3, rounds // 3))
        builds += build_rows(mesh, vertices, triangles, max(3, rounds // 3))
    print(
        "\n| nearest points | triangles | threads | ours / Open3D | ours [M/s] | Open3D "
        "| largest difference [mm] |"
    )
    print("|---|---|---|---|---|---|---|")
    print("\n".join(nearest))
    print(
        "\n| build, triangles | threads | ours / Open3D | ours [ms] | Open3D [ms] "
        "| ours [B/triangle] |"
    )
    print("|---|---|---|---|---|---|")
    print("\n".join(builds))
    print(
        f"\nRates and times are medians of {rounds} interleaved rounds of {RAYS:,} rays, "
        f"nearest points and builds of {max(3, rounds // 3)} ({POINTS:,} points), ratios "
        "medians of each round's, above 1 where ours is faster. One thread: processor time; two: "
        "the wall clock. Open3D's build takes float32 arrays over and asks one ray. "
        f"SIMD level {simd_level()}; Open3D {open3d.__version__}, embreex {embreex.__version__}, "
        f"numpy {np.__version__}, Python {platform.python_version()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    run(parser.parse_args().rounds)
