# SPDX-License-Identifier: BSD-3-Clause
"""Clones in a scene against one merged mesh: ``python -m benchmarks.python.instances``.

Boulders of 480 triangles on a seabed of 199,712, turned and of 0.3 to 3 m: as instances of one mesh
at poses and scales, and as one mesh with all of them written out, in ours and in Open3D
(``pip install open3d-cpu``), in the same interleaved rounds on the same rays. Hits are compared
before any time is printed: ours against the merged mesh must meet the same row, and at the same
range to 1e-9; Open3D decides in float32. Memory is what hierarchies, instances and the meshes'
arrays hold beyond those of the seabed alone, over the same of the merged mesh.
"""

import argparse
import statistics
import time

import numpy as np
import open3d

import bathyal
from bathyal._core import simd_level
from benchmarks.python.rays import (
    WIDTH,
    compare,
    interleaved,
    open3d_hits,
    open3d_scene,
    random_rays,
    seabed,
    side_scan,
)

CLONES = 1_000
MANY = 100_000


def boulder(rings=16, seed=3):
    """A sphere of 1 m with a rough skin: 2 · rings · (rings − 1) triangles."""
    polar, around = np.meshgrid(
        np.linspace(0.0, np.pi, rings + 1)[1:-1],
        2.0 * np.pi * np.arange(rings) / rings,
        indexing="ij",
    )
    radius = 1.0 + np.random.default_rng(seed).normal(0.0, 0.1, polar.shape)
    x, y = np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around)
    skin = (radius[..., None] * np.stack([x, y, np.cos(polar)], axis=-1)).reshape(-1, 3)
    top, low = len(skin), len(skin) + 1
    here = np.arange(rings)
    beyond = (here + 1) % rings
    triangles = [np.column_stack([np.full(rings, top), here, beyond])]
    for ring in range(rings - 2):
        a, b = here + ring * rings, beyond + ring * rings
        triangles += [np.column_stack([a, a + rings, b + rings])]
        triangles += [np.column_stack([a, b + rings, b])]
    last = (rings - 2) * rings
    triangles.append(np.column_stack([here + last, np.full(rings, low), beyond + last]))
    return bathyal.TriangleMesh(np.vstack([skin, [[0, 0, 1], [0, 0, -1]]]), np.vstack(triangles))


def rotations(quaternion):
    w, x, y, z = (quaternion / np.linalg.norm(quaternion, axis=1)[:, None]).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(rows).transpose(2, 0, 1)


def scattered(bottom, count, seed=11):
    """Poses and scales of the bottom and of `count` boulders half sunk into it."""
    random = np.random.default_rng(seed)
    place = random.uniform(1.0, WIDTH - 1.0, (count, 2))
    down = np.tile([0.0, 0.0, -1.0], (count, 1))
    ground = bathyal.Scene(bottom).cast(np.column_stack([place, np.zeros(count)]), down).point
    poses = np.tile(np.eye(4), (count + 1, 1, 1))
    poses[1:, :3, :3] = rotations(random.normal(size=(count, 4)))
    poses[1:, :3, 3] = ground
    return poses, np.concatenate([[1.0], np.exp(random.uniform(*np.log([0.3, 3.0]), count))])


def merged(meshes, poses, scales):
    rows = zip(meshes, poses, scales, strict=True)
    vertices = [s * m.vertices @ p[:3, :3].T + p[:3, 3] for m, p, s in rows]
    first = np.cumsum([0] + [len(v) for v in vertices])
    triangles = np.vstack([m.triangles + f for m, f in zip(meshes, first[:-1], strict=True)])
    return bathyal.TriangleMesh(np.vstack(vertices), triangles)


def agreement(hits, truth, start):
    """Share of rays with the same row and range to 1e-9; ends the run when it is not nearly all."""
    row = np.searchsorted(start, truth.triangle, side="right") - 1
    same = hits.mesh == np.where(truth.triangle < 0, -1, row)
    same &= np.isclose(hits.range, truth.range, rtol=1e-9, atol=1e-9)
    if same.mean() < 0.9999:
        raise SystemExit(f"instances: {same.mean():.6f} of the hits are those of the merged mesh")
    return same.mean()


def array_bytes(meshes):
    return sum(m.vertices.nbytes + m.triangles.nbytes for m in meshes)


def cast_rows(bottom, rock, rounds):
    meshes = [bottom, *[rock] * CLONES]
    poses, scales = scattered(bottom, CLONES)
    scene = bathyal.Scene(meshes, poses=poses, scales=scales)
    mesh = merged(meshes, poses, scales)
    whole = bathyal.Scene(mesh)
    peer = open3d_scene(mesh.vertices, mesh.triangles, 2)
    start = np.cumsum([0] + [len(m.triangles) for m in meshes])
    for name, (origins, directions) in (("side-scan", side_scan()), ("random", random_rays())):
        hits, truth = scene.cast(origins, directions), whole.cast(origins, directions)
        agree = agreement(hits, truth, start)
        single = np.concatenate([origins, directions], axis=1).astype(np.float32)
        rays = open3d.core.Tensor(single)
        compare(f"Open3D, {name}", truth, *open3d_hits(peer, rays))
        for threads in (1, 2):
            works = [
                lambda o=origins, d=directions, n=threads: scene.cast(o, d, num_threads=n),
                lambda o=origins, d=directions, n=threads: whole.cast(o, d, num_threads=n),
                lambda r=rays, n=threads: peer.cast_rays(r, nthreads=n),
            ]
            times = interleaved(rounds, works, threads)
            ratio = statistics.median(times[:, 0] / times[:, 1])
            rate = len(origins) / np.median(times, axis=0) / 1e6
            print(
                f"| {name} | {CLONES:,} | {threads} | {ratio:.2f} × | {rate[0]:.1f} "
                f"| {rate[1]:.1f} | {rate[2]:.1f} | {100 * np.mean(hits.mesh > 0):.1f} % "
                f"| {100 * agree:.4f} % |"
            )
    alone = bathyal.Scene(bottom).memory + array_bytes([bottom])
    ours = scene.memory + array_bytes([bottom, rock]) - alone
    theirs = whole.memory + array_bytes([mesh]) - alone
    return ours, theirs


def milliseconds(work, rounds):
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return statistics.median(times)


def many_rows(bottom, rock, rounds):
    """What 10⁵ clones take: to build, to move, to cast at, and in memory."""
    meshes = [bottom, *[rock] * MANY]
    poses, scales = scattered(bottom, MANY)
    scene = bathyal.Scene(meshes, poses=poses, scales=scales)
    moved = poses.copy()
    moved[1:, :3, 3] += np.random.default_rng(1).normal(0.0, 0.3, (MANY, 3))
    origins, directions = side_scan()
    later = scene.with_poses(moved)
    anew = bathyal.Scene(meshes, poses=moved, scales=scales)
    if not np.array_equal(
        later.cast(origins, directions).range, anew.cast(origins, directions).range
    ):
        raise SystemExit("instances: moved and made anew differ")
    for threads in (1, 2):
        options = {"num_threads": threads}
        build = milliseconds(
            lambda o=options: bathyal.Scene(meshes, poses=poses, scales=scales, **o), 3
        )
        move = milliseconds(lambda o=options: scene.with_poses(moved, **o), rounds)
        cast = milliseconds(lambda o=options: scene.cast(origins, directions, **o), 3)
        bytes_each = (scene.memory - bathyal.Scene(bottom).memory) / MANY
        print(
            f"| {MANY:,} | {threads} | {move:.0f} | {build:.0f} "
            f"| {len(origins) / cast / 1e3:.1f} | {bytes_each:.0f} |"
        )


def run(rounds):
    vertices, triangles = seabed(317)
    bottom, rock = bathyal.TriangleMesh(vertices, triangles), boulder()
    print("## Clones in a scene against one merged mesh\n")
    print(
        "| rays | clones | threads | time / merged mesh | clones [Mray/s] | merged mesh "
        "| Open3D, merged | of the rays on clones | same hits |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    ours, theirs = cast_rows(bottom, rock, rounds)
    print(
        f"\nMemory of the {CLONES:,} clones, arrays and hierarchies beyond the seabed's: "
        f"{ours / 1e6:.2f} MB, {100 * ours / theirs:.1f} % of the merged mesh's {theirs / 1e6:.1f} "
        "MB.\n"
    )
    print("| clones | threads | `with_poses` [ms] | build [ms] | side-scan [Mray/s] | [B/clone] |")
    print("|---|---|---|---|---|---|")
    many_rows(bottom, rock, rounds)
    print(
        f"\nRatios and rates are medians of {rounds} interleaved rounds of 500,000 rays; one "
        "thread of processor time, two of the wall clock. `with_poses` moves all clones, from a "
        f"numpy array of poses to the new scene. SIMD level {simd_level()}."
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    run(parser.parse_args().rounds)
