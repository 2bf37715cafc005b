# SPDX-License-Identifier: BSD-3-Clause
"""Pings against the raw casting of their rays: ``python -m benchmarks.python.sonar_pings``.

On a seabed of 204,800 triangles, in the same interleaved rounds: `Scene.cast` of the paper's rays
(100 × 8,000 pixels a side), and pings of the paper's model, of it with every switch, and of the
other instruments; Open3D and embreex cast the same rays in the same rounds.
"""

import argparse
import statistics
import time

import numpy as np
import open3d

import bathyal
from bathyal._core import simd_level
from benchmarks.python.rays import (
    compare,
    embreex_hits,
    embreex_scene,
    open3d_hits,
    open3d_scene,
)

ALTITUDE = 10.0  # above the highest point [m]


def interleaved(rounds, works, threads):
    """Median seconds of each work; on one thread, of the processor."""
    clock = time.process_time if threads == 1 else time.perf_counter
    taken = {name: [] for name in works}
    for work in works.values():
        work()
    for _ in range(rounds):
        for name, work in works.items():
            start = clock()
            work()
            taken[name].append(clock() - start)
    return {name: statistics.median(seconds) for name, seconds in taken.items()}


def paper_rays(columns=100, rows=8000):
    """Of both cameras, 45° × 0.6°, from the horizontal to 45° down."""
    x = np.tan(np.radians(0.3)) * ((2 * np.arange(columns) + 1) / columns - 1)
    y = np.tan(np.radians(22.5)) * ((2 * np.arange(rows) + 1) / rows - 1)
    x, y = np.meshgrid(x, y, indexing="ij")
    tilt = np.radians(22.5)
    out = np.cos(tilt) + y * np.sin(tilt)
    down = y * np.cos(tilt) - np.sin(tilt)
    rays = np.concatenate(
        [np.stack([x, side * out, down], axis=-1).reshape(-1, 3) for side in (1.0, -1.0)]
    )
    return rays / np.linalg.norm(rays, axis=1)[:, None]


def sonars():
    paper = bathyal.sonars.paper_side_scan()
    real = bathyal.sonars.paper_side_scan(physics="real")
    multibeam = bathyal.sonars.multibeam().replace(
        beams=512, range=60.0, rays_across_beam=1, rays_along_fan=114
    )
    return {
        "paper's model, 2 × 100 × 8,000": paper,
        "paper's model, 2 × 200 × 16,000": paper.replace(
            rays_across_beam=200, rays_along_fan=16000
        ),
        "all physics but multiples": real.replace(multiples=0),
        "all physics": real,
        "side-scan": bathyal.sonars.side_scan(),
        "multibeam, 512 × 114": multibeam,
        "imaging, 512 × 512": bathyal.sonars.imaging(),
    }


def peers(bottom, origin, rays):
    """Casts of Open3D (two threads) and embreex (one), after their hits are compared with ours."""
    truth = bathyal.Scene(bottom).cast(origin, rays)
    single = np.hstack([np.repeat(origin, len(rays), axis=0), rays]).astype(np.float32)
    tensor = open3d.core.Tensor(single)
    scene = open3d_scene(bottom.vertices, bottom.triangles, 2)
    compare("Open3D", truth, *open3d_hits(scene, tensor))
    embree, mesh = embreex_scene(bottom.vertices, bottom.triangles)
    origins, directions = single[:, :3].copy(), single[:, 3:].copy()
    compare("embreex", truth, *embreex_hits(embree, origins, directions))
    return {
        ("Open3D", 2): lambda: scene.cast_rays(tensor),
        ("embreex", 1): lambda _kept=mesh: embree.run(origins, directions, output=True),
    }


def table(threads, rounds, world, layered, pose):
    scene, rays, origin = world.scene, paper_rays(), pose[None, :3, 3].copy()
    works = {"cast": lambda: scene.cast(origin, rays, num_threads=threads)}
    others = peers(scene.meshes[0], origin, rays)
    for (name, their_threads), work in others.items():
        if their_threads == threads:
            works[name] = work
    instruments = sonars()
    motion = {"velocity": [2.0, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 0.02]}
    for name, sonar in instruments.items():
        works[name] = lambda sonar=sonar: sonar.ping(
            world, pose, truth=False, num_threads=threads, **motion
        )
    bent = "all physics but multiples, thermocline"
    instruments[bent] = instruments["all physics but multiples"]
    works[bent] = lambda: instruments[bent].ping(
        layered, pose, truth=False, num_threads=threads, **motion
    )

    taken = interleaved(rounds, works, threads)
    per_ray = taken["cast"] / len(rays)
    model = taken["paper's model, 2 × 100 × 8,000"]
    casts = [f"ours {1e-6 / per_ray:.1f}"] + [
        f"{name} {1e-6 * len(rays) / taken[name]:.1f}" for name, _ in others if name in taken
    ]
    noun = "thread" if threads == 1 else "threads"
    print(f"{threads} {noun}; rays cast alone: {', '.join(casts)} Mray/s\n")
    print("| ping | pings/s | rays | casting | over the paper's model |\n|---|---|---|---|---|")
    for name, sonar in instruments.items():
        seconds = taken[name]
        share = sonar.ray_count * per_ray / seconds
        print(
            f"| {name} | {1.0 / seconds:.1f} | {sonar.ray_count:,} | {100 * share:.0f} % "
            f"| {seconds / model:.2f} |"
        )
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    bottom = bathyal.make_seabed((320.0, 320.0), 1.0, seed=1)
    pose = np.eye(4)
    top = float(bottom.vertices[:, 2].max())
    pose[2, 3] = top + ALTITUDE
    worlds = []
    for _ in range(2):
        worlds.append(bathyal.World())
        worlds[-1].add(bottom, material="sand")
    cast = bathyal.Profile([0, 10, 20, 80], sound_speed=[1520, 1515, 1492, 1490])
    worlds[1].water = bathyal.Water(cast, surface=top + 25.0)
    print(
        f"## Pings against the raw casting of their rays\n\n{len(bottom.triangles):,} triangles.\n"
    )
    for threads in (1, 2):
        table(threads, rounds, *worlds, pose)
    print(
        "Medians of interleaved rounds; one thread of processor time, two of the wall clock. "
        '"Casting" is what as many rays take alone, over the ping: a share for the paper\'s model, '
        "a scale for the others. Published, not run here: Bobkov and others (2014) 5 to 10 pings/s "
        "in the paper's window; DAVE 0.5 Hz with 512 beams of 114 rays on an RTX 2080 Ti, which "
        "sums coherent spectra and is not the same work: ours adds power and draws its speckle; "
        f"OceanSim 41.7 Hz with an image of 512 × 512 on an A6000. SIMD level {simd_level()}."
    )


if __name__ == "__main__":
    main()
