# SPDX-License-Identifier: BSD-3-Clause
"""Cases of sonars of any kind, mounted and placed at random: energy by quadrature, and truth."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import bathyal
from tests.support.sea_cases import at, ball, flat_world, plate, world_of


def placed(rng, place, most):
    """Any heading, pitch and roll up to `most`."""
    pose = at(*place)
    turn = [rng.uniform(-np.pi, np.pi), rng.uniform(-most, most), rng.uniform(-most, most)]
    pose[:3, :3] = Rotation.from_euler("ZYX", turn).as_matrix()
    return pose


def directions(kind, phi, down):
    """Unit vectors in the sonar's frame: φ from the plane across the array, and down in the fan."""
    if kind == "side_scan":  # the array along x, the fan to port
        return np.stack([np.sin(phi), np.cos(phi) * np.cos(down), -np.cos(phi) * np.sin(down)])
    return np.stack([np.cos(phi) * np.cos(down), np.sin(phi), -np.cos(phi) * np.sin(down)])


def axes(sonar):
    """φ of each beam's axis, from port to starboard."""
    return np.linspace(0.5, -0.5, sonar.beams) * sonar.sector if sonar.beams > 1 else np.zeros(1)


def paper_energy(sonar, axis, turn, altitude):
    """∫∫ μ cos θ / R² dΩ over a beam above a flat bottom, by Gauss and Legendre."""
    node, weight = np.polynomial.legendre.leggauss(60)
    if sonar.kind == "echo_sounder":  # a cone, by rings
        off = (node + 1) * sonar.beam_width / 4
        turns = np.linspace(0, 2 * np.pi, 180, endpoint=False)
        ring = np.stack(np.meshgrid(np.sin(off), turns, indexing="ij"))
        local = np.stack(
            [ring[0] * np.cos(ring[1]), ring[0] * np.sin(ring[1]), -np.sqrt(1 - ring[0] ** 2)]
        )
        power = np.clip(-np.einsum("k,kij->ij", turn[2], local), 0, None) ** 3 / altitude**2
        return weight @ (power.mean(axis=1) * 2 * np.pi * np.sin(off)) * sonar.beam_width / 4
    phi = axis + node * sonar.beam_width / 2
    down = sonar.tilt + node * sonar.fan_span / 2
    grid = np.meshgrid(phi, down, indexing="ij")
    z = np.einsum("k,kij->ij", turn[2], directions(sonar.kind, *grid))
    power = np.clip(-z, 0, None) ** 3 / altitude**2 * np.cos(grid[0])
    return weight @ power @ weight * sonar.beam_width * sonar.fan_span / 4


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", ["side_scan", "multibeam", "echo_sounder", "imaging", "scanning"])
def test_energy_of_a_sonar_placed_at_random(name, seed):
    rng = np.random.default_rng(seed)
    sonar = getattr(bathyal.sonars, name)()
    mount = placed(rng, rng.uniform(-1, 1, 3), 0.2)
    wide = {"tilt": max(sonar.tilt, 0.7), "fan_span": min(sonar.fan_span, 0.5)}
    sonar = sonar.replace(
        spreading=True, range=400.0, samples=500, beams=min(sonar.beams, 5), sector=0.4,
        vehicle_from_sonar=mount, head_start=0.0, rays_along_fan=200, rays_across_beam=20,
        beam_width=0.05, axis_tilt=wide["tilt"], **wide,
    ).replace(beams=1 if name in ("side_scan", "scanning", "echo_sounder") else 5)  # fmt: skip
    pose = placed(rng, [3, -2, rng.uniform(10, 25)], 0.05)
    head = pose @ mount
    ping = sonar.ping(flat_world(3000.0), pose)
    paper = [paper_energy(sonar, axis, head[:3, :3], head[2, 3]) for axis in axes(sonar)]
    assert ping.intensity.sum(axis=1) == pytest.approx(paper, rel=5e-3)
    assert ping.altitude == pytest.approx(head[2, 3], rel=1e-6)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", ["side_scan", "multibeam", "echo_sounder", "imaging", "scanning"])
def test_the_truth_of_a_sonar_placed_at_random(name, seed):
    """Points lie on what was hit, at their range, in their sample and in their fan."""
    rng = np.random.default_rng(50 + seed)
    sonar = getattr(bathyal.sonars, name)()
    sonar = sonar.replace(range=60.0, head_start=0.0, beams=min(sonar.beams, 9))
    world = world_of(plate((-300, -300), (300, 300)))
    world.set_material("black", 0.3)
    centre = np.array([*rng.uniform(-12, 12, 2), 1.0])
    world.add(ball(2.0, 60), at(*centre), material="black")
    pose = placed(rng, [14, 14, rng.uniform(6, 12)], 0.15)
    ping, truth = sonar.ping(world, pose), None
    truth = ping.truth
    hit = truth.material >= 0
    assert hit.any()
    assert np.array_equal(hit, ping.intensity > 0)
    assert np.array_equal(hit, np.isfinite(truth.range))

    way = truth.point[hit] - pose[:3, 3]
    r = np.linalg.norm(way, axis=1)
    assert r == pytest.approx(truth.range[hit], abs=1e-3)
    names = np.array(world.materials)[truth.material[hit]]
    on_ball = names == "black"
    out = (truth.point[hit] - centre) / 2.0
    assert np.abs(truth.point[hit][~on_ball][:, 2]).max() < 1e-4
    assert np.all(np.abs(np.linalg.norm(out[on_ball], axis=1) - 1) < 0.003)

    normal = np.where(on_ball[:, None], out, [0.0, 0.0, 1.0])
    cosine = -np.sum(normal * way, axis=1) / r
    off = cosine - np.cos(truth.incidence[hit])
    # a sample takes its angle from the middle of its ray, which covers both angles
    ray = sonar.fan_span / sonar.rays_along_fan + sonar.beam_width / sonar.rays_across_beam
    assert np.abs(off[~on_ball]).max() < 0.5 * ray + 1e-5
    assert np.all(np.abs(off[on_ball]) < 0.05)  # facets

    spacing = ping.range[1] - ping.range[0]
    middle = np.broadcast_to(ping.range, hit.shape)[hit]
    cell = 0.5 * r * np.tan(truth.incidence[hit]) * ray
    assert np.all(np.abs(r - middle) <= 0.501 * spacing + 1.02 * cell + 1e-3)

    local = way @ pose[:3, :3] / r[:, None]
    row = np.nonzero(hit)[0]
    if name == "side_scan":
        side = np.where(row == 0, 1, -1)
        assert np.abs(np.arcsin(local[:, 0])).max() <= sonar.beam_width / 2 + 1e-6
        down = np.arctan2(-local[:, 2], side * local[:, 1])
    else:
        phi = np.arcsin(local[:, 1])
        if name != "echo_sounder":
            assert np.abs(phi - axes(sonar)[row]).max() <= sonar.beam_width / 2 + 1e-6
        down = np.arctan2(-local[:, 2], local[:, 0])
    assert np.abs(down - sonar.tilt).max() <= sonar.fan_span / 2 + 1e-6
