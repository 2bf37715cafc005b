# SPDX-License-Identifier: BSD-3-Clause
"""Pings against the raw casting of their rays: ``python -m benchmarks.python.sonar_pings``.

On a seabed of 204,800 triangles, in the same interleaved rounds: `Scene.cast` of the paper's rays
(100 × 8,000 pixels a side), and pings of the paper's model, of it with every switch, and of the
other instruments. Published, not run here: Bobkov and others (2014) 5 to 10 pings/s in the paper's
window; DAVE 0.5 Hz with 512 beams of 114 rays (RTX 2080 Ti, coherent sums); OceanSim 41.7 Hz with
an image of 512 × 512 (A6000).

The column "casting" is what the rays would take at the cost of one of the paper's rays: a share of
the ping for the paper's model, and only a scale for instruments whose rays are others. A busy
machine slows the two unequally; trust it where several runs agree.
"""

import argparse
import time

import numpy as np

import bathyal
from bathyal._core import simd_level

ALTITUDE = 10.0  # above the highest point [m]


def interleaved(rounds, works, threads):
    """Least seconds of each work; on one thread, of the processor."""
    clock = time.process_time if threads == 1 else time.perf_counter
    best = dict.fromkeys(works, np.inf)
    for work in works.values():
        work()
    for _ in range(rounds):
        for name, work in works.items():
            start = clock()
            work()
            best[name] = min(best[name], clock() - start)
    return best


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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int, default=0, help="0 means all")
    arguments = parser.parse_args()
    threads = arguments.threads

    bottom = bathyal.make_seabed((320.0, 320.0), 1.0, seed=1)
    world = bathyal.World()
    world.add(bottom, material="sand")
    pose = np.eye(4)
    top = float(bottom.vertices[:, 2].max())
    pose[2, 3] = top + ALTITUDE
    layered = bathyal.World()
    layered.add(bottom, material="sand")
    cast = bathyal.Profile([0, 10, 20, 80], sound_speed=[1520, 1515, 1492, 1490])
    layered.water = bathyal.Water(cast, surface=top + 25.0)

    scene, rays, origin = world.scene, paper_rays(), pose[None, :3, 3].copy()
    works = {"cast": lambda: scene.cast(origin, rays, num_threads=threads)}
    instruments = sonars()
    motion = {"velocity": [2.0, 0.0, 0.0], "angular_velocity": [0.0, 0.0, 0.02]}
    for name, sonar in instruments.items():
        works[name] = lambda sonar=sonar: sonar.ping(world, pose, num_threads=threads, **motion)
    bent = "all physics but multiples, thermocline"
    instruments[bent] = instruments["all physics but multiples"]
    works[bent] = lambda: instruments[bent].ping(layered, pose, num_threads=threads, **motion)

    best = interleaved(arguments.rounds, works, threads)
    per_ray = best["cast"] / len(rays)
    model = best["paper's model, 2 × 100 × 8,000"]
    print(
        f"{len(bottom.triangles):,} triangles, simd {simd_level()}, threads {threads}; "
        f"cast {1e-6 / per_ray:.1f} Mray/s"
    )
    print("| ping | pings/s | rays | casting | over the paper's model |\n|---|---|---|---|---|")
    for name, sonar in instruments.items():
        seconds = best[name]
        share = sonar.ray_count * per_ray / seconds
        print(
            f"| {name} | {1.0 / seconds:.1f} | {sonar.ray_count:,} | {100 * share:.0f} % "
            f"| {seconds / model:.2f} |"
        )


if __name__ == "__main__":
    main()
