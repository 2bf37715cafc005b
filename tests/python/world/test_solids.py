# SPDX-License-Identifier: BSD-3-Clause
"""Boulders, mines, wrecks, fish: closed bodies of the size asked for."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bathyal

BODIES = {
    "boulder": lambda: bathyal.make_boulder(0.5, seed=3),
    "cylinder": lambda: bathyal.make_mine("cylinder"),
    "sphere": lambda: bathyal.make_mine("sphere"),
    "manta": lambda: bathyal.make_mine("manta"),
    "fish": lambda: bathyal.make_fish(0.4),
    "wreck": lambda: bathyal.make_wreck(50, seed=4),
    "whole wreck": lambda: bathyal.make_wreck(50, seed=4, broken=False, list=-0.5),
}


@pytest.mark.parametrize("name", BODIES)
def test_bodies_are_closed_and_turned_outward(name: str) -> None:
    mesh = BODIES[name]()
    report = bathyal.mesh_report(mesh)
    assert report.closed
    assert report.nonmanifold_edges == report.nonmanifold_vertices == 0
    assert report.zero_area_triangles == 0
    assert report.volume > 0
    if name != "fish":
        assert report.low[2] == pytest.approx(0, abs=1e-12)
    # Each part by itself: a ray from far off meets a front first.
    scene = bathyal.Scene(mesh)
    rng = np.random.default_rng(0)
    away = rng.normal(size=(2000, 3))
    away *= 200 / np.linalg.norm(away, axis=1, keepdims=True)
    target = rng.uniform(report.low, report.high, (2000, 3))
    hits = scene.cast(target + away, -away)
    met = np.isfinite(hits.range)
    assert met.sum() > 100
    assert (np.sum(hits.normal[met] * away[met], axis=1) > -1e-9).all()


def test_boulder_has_the_volume_of_its_sphere_and_each_seed_its_own_shape() -> None:
    for radius in (0.1, 2.0):
        for seed in range(5):
            mesh = bathyal.make_boulder(radius, seed=seed)
            volume = bathyal.mesh_report(mesh).volume
            assert volume == pytest.approx(4 / 3 * math.pi * radius**3, rel=1e-9)
            assert np.ptp(mesh.vertices, axis=0).max() < 3.2 * radius
    one = bathyal.make_boulder(2.0, seed=4)
    assert one.vertices.tobytes() == mesh.vertices.tobytes()
    assert one.vertices.tobytes() != bathyal.make_boulder(2.0, seed=5).vertices.tobytes()


def test_mines_are_as_large_as_asked() -> None:
    def size(mesh):
        return np.ptp(mesh.vertices, axis=0)

    np.testing.assert_allclose(size(bathyal.make_mine()), [2.2, 0.53, 0.53])
    small = bathyal.make_mine("cylinder", length=1.0, diameter=0.3, sides=256)
    np.testing.assert_allclose(size(small), [1.0, 0.3, 0.3])
    volume = math.pi * 0.15**2
    assert bathyal.mesh_report(small).volume == pytest.approx(volume, rel=2e-4)
    ball = bathyal.make_mine("sphere", horns=0, sides=256)
    assert bathyal.mesh_report(ball).volume == pytest.approx(math.pi / 6, rel=3e-4)
    horned = bathyal.make_mine("sphere", horns=5)
    assert bathyal.mesh_report(horned).components == 6
    away = np.linalg.norm(horned.vertices - [0, 0, 0.5], axis=1)
    assert away.max() == pytest.approx(0.61, abs=0.01)
    manta = bathyal.mesh_report(bathyal.make_mine("manta", diameter=2, length=1, sides=256))
    assert manta.volume == pytest.approx(math.pi / 3 * (1 + 0.5 + 0.25), rel=2e-4)


def test_wreck_is_of_its_length_and_leans_as_asked() -> None:
    whole = bathyal.make_wreck(40, broken=False, list=0.0, holes=0, beam=6, depth=4)
    low, high = whole.vertices.min(axis=0), whole.vertices.max(axis=0)
    assert high[0] - low[0] == pytest.approx(40, abs=0.3)
    assert high[1] - low[1] == pytest.approx(6, abs=0.1)
    hull = bathyal.Scene(whole).contains([(0, 0, 0.075), (0, 2.925, 3.0), (0, 0, 2.0)])
    assert hull.tolist() == [True, True, False]  # keel, side, hold
    leaning = bathyal.make_wreck(40, broken=False, list=0.4, holes=0, beam=6, depth=4)
    top = whole.vertices[:, 2].argmax()
    off = leaning.vertices[top, 1] - leaning.vertices[whole.vertices[:, 2].argmin(), 1]
    assert off < -2  # the mast leans to starboard
    holed = bathyal.make_wreck(40, broken=False, list=0.0, holes=20, beam=6, depth=4)
    assert bathyal.mesh_report(holed).volume < bathyal.mesh_report(whole).volume
    broken = bathyal.make_wreck(40, seed=1)
    again = bathyal.make_wreck(40, seed=1)
    assert broken.vertices.tobytes() == again.vertices.tobytes()
    other = bathyal.make_wreck(40, seed=2)
    assert other.vertices.tobytes() != broken.vertices.tobytes()
    assert broken.vertices[:, 0].max() > 20.5  # the bow has moved away


def test_fish_points_along_x_with_its_back_up() -> None:
    fish = bathyal.make_fish(0.8)
    low, high = fish.vertices.min(axis=0), fish.vertices.max(axis=0)
    np.testing.assert_allclose([low[0], high[0]], [-0.4, 0.4])
    nose = fish.vertices[fish.vertices[:, 0].argmax()]
    np.testing.assert_allclose(nose, [0.4, 0, 0], atol=1e-12)
    assert high[2] > -low[2]
    np.testing.assert_allclose(high[1], -low[1])


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: bathyal.make_boulder(0), "radius"),
        (lambda: bathyal.make_boulder(math.nan), "radius"),
        (lambda: bathyal.make_boulder(1, subdivisions=20), "subdivisions"),
        (lambda: bathyal.make_boulder(1, roughness=math.nan), "roughness"),
        (lambda: bathyal.make_mine("torpedo"), "kind"),
        (lambda: bathyal.make_mine(diameter=-1), "diameter"),
        (lambda: bathyal.make_mine(length=math.inf), "length"),
        (lambda: bathyal.make_mine(sides=9), "sides"),
        (lambda: bathyal.make_mine("sphere", horns=-1), "horns"),
        (lambda: bathyal.make_fish(0), "length"),
        (lambda: bathyal.make_fish(1, sides=3), "sides"),
        (lambda: bathyal.make_wreck(math.nan), "length"),
        (lambda: bathyal.make_wreck(10, beam=11), "beam"),
        (lambda: bathyal.make_wreck(40, thickness=1), "thickness"),
        (lambda: bathyal.make_wreck(40, thickness=0), "thickness"),
        (lambda: bathyal.make_wreck(40, spacing=1e-6), "spacing"),
        (lambda: bathyal.make_wreck(40, list=2), "list"),
    ],
)
def test_what_makes_no_body_is_refused_by_name(call, name) -> None:
    with pytest.raises(ValueError, match=f"`{name}`"):
        call()
