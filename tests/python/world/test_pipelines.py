# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines and cables: where they lie is a formula on bottoms that are one."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bathyal


def bottom(size: float = 100.0, spacing: float = 0.25, **options) -> bathyal.Scene:
    return bathyal.Scene(bathyal.make_seabed(size, spacing, **{"relief_rms": 0.0, **options}))


@pytest.fixture(scope="module")
def flat() -> bathyal.Scene:
    return bottom()


def wave(height: float, length: float) -> bathyal.Scene:
    """Crests along y at the multiples of the wavelength."""
    x, y = np.arange(-60, 60.01, 0.05), np.array([-5.0, 5.0])
    vertices = [(a, b, height / 2 * np.cos(2 * np.pi * a / length)) for b in y for a in x]
    n = len(x)
    a = np.arange(n - 1)
    triangles = np.vstack([np.c_[a, a + 1, a + 1 + n], np.c_[a, a + 1 + n, a + n]])
    return bathyal.Scene(bathyal.TriangleMesh(vertices, triangles))


def prism(sides: int, diameter: float, length: float) -> float:
    return length * sides / 2 * (diameter / 2) ** 2 * math.sin(2 * math.pi / sides)


def test_pipe_is_closed_and_its_volume_is_that_of_a_cylinder() -> None:
    for sides in (3, 24, 256):
        pipe = bathyal.make_pipeline([(0, 0, 0), (30, 40, 12)], 0.6, sides=sides)
        report = bathyal.mesh_report(pipe.mesh)
        assert report.closed
        assert report.components == 1
        assert report.volume == pytest.approx(prism(sides, 0.6, math.sqrt(2644)), rel=1e-9)
    assert report.volume == pytest.approx(math.pi * 0.09 * math.sqrt(2644), rel=2e-4)
    np.testing.assert_allclose(pipe.kp[[0, -1]], [0, math.sqrt(2644)])


def test_bent_pipe_keeps_its_radius_and_does_not_twist() -> None:
    """On a circle, Pappus: the volume is the section's area times the way of its middle."""
    angle = np.linspace(0, 3, 40)
    route = np.c_[20 * np.cos(angle), 20 * np.sin(angle), 0 * angle]
    pipe = bathyal.make_pipeline(route, 1.0, step=0.1, sides=32)
    assert bathyal.mesh_report(pipe.mesh).volume == pytest.approx(prism(32, 1, 60), rel=1e-3)
    rings = pipe.mesh.vertices[2:].reshape(-1, 32, 3)
    away = np.linalg.norm(rings - pipe.center[:, None], axis=2)
    np.testing.assert_allclose(away, 0.5, rtol=1e-12)
    np.testing.assert_allclose(rings[:, 0, 2], 0.5, atol=1e-9)  # the crown remains the crown
    np.testing.assert_allclose(np.hypot(*pipe.center[:, :2].T), 20, atol=0.01)


def test_pipe_lies_on_a_flat_and_on_a_sloping_bottom(flat: bathyal.Scene) -> None:
    pipe = bathyal.make_pipeline([(-30, 0), (30, 10)], 0.5, flat)
    np.testing.assert_allclose(pipe.center[:, 2], 0.25, atol=1e-9)
    assert pipe.gap.max() < 1e-9
    assert not pipe.span.any()
    slope = bottom(slope=0.3, slope_direction=np.pi / 2)
    across = bathyal.make_pipeline([(-30, 0), (30, 0)], 0.5, slope)
    # A circle touches a slope at R / cos θ over the middle line; five rays know it to 2 %.
    np.testing.assert_allclose(across.center[:, 2], 0.25 / math.cos(0.3), rtol=0.02)


def test_burial_is_the_depth_of_the_underside_and_the_crown_follows(flat: bathyal.Scene) -> None:
    pipe = bathyal.make_pipeline([(-30, 0), (0, 0), (30, 0)], 0.5, flat, burial=[0.0, 1.5, 0.5])
    expected = np.interp(pipe.kp, [0, 30, 60], [0, 1.5, 0.5])
    np.testing.assert_allclose(pipe.burial, expected, atol=1e-9)
    crown = pipe.mesh.vertices[2:].reshape(len(pipe.kp), -1, 3)[:, :, 2].max(axis=1)
    level = [0, 60, -1]  # where rings are upright: at the middle, and nearly at the ends
    np.testing.assert_allclose(crown[level], (0.5 - expected)[level], atol=1e-3)
    whole = bathyal.make_pipeline([(-30, 0), (30, 0)], 0.5, flat, burial=0.8)
    np.testing.assert_allclose(whole.mesh.vertices[:, 2].max(), -0.3, atol=1e-9)
    np.testing.assert_array_equal(whole.gap, 0)


def test_span_bridges_a_trench_with_the_gap_below() -> None:
    trench = bottom(
        trench_depth=2.0, trench_width=10.0, trench_floor=4.0, trench_direction=np.pi / 2
    )
    pipe = bathyal.make_pipeline([(-30, 0), (30, 0)], 0.5, trench, spans=[(22, 38)])
    np.testing.assert_allclose(pipe.center[:, 2], 0.25, atol=1e-9)
    middle = np.abs(pipe.kp - 30) < 1.9
    np.testing.assert_allclose(pipe.gap[middle], 2.0, atol=1e-9)
    assert pipe.span[(pipe.kp >= 22) & (pipe.kp <= 38)].all()
    assert not pipe.span[(pipe.kp < 22) | (pipe.kp > 38)].any()
    raised = bathyal.make_pipeline([(-30, 0), (30, 0)], 0.5, trench, spans=[(22, 38)], span_gap=0.4)
    assert raised.gap.max() == pytest.approx(2.4, abs=1e-9)
    assert raised.kp[raised.gap.argmax()] == pytest.approx(30, abs=0.01)


def test_span_goes_over_what_rises_between_its_ends() -> None:
    pipe = bathyal.make_pipeline([(-30, 0), (30, 0)], 0.5, wave(2.0, 20.0), spans=[(5, 55)])
    assert np.all(pipe.center[:, 2] - 0.25 >= pipe.bottom - 1e-6)
    inner = np.abs(pipe.kp - 30) < 10  # from crest to crest, straight
    np.testing.assert_allclose(pipe.center[inner, 2], 1.25, atol=0.01)


def test_cable_hangs_in_parabolas_between_crests_and_bears_where_it_rests() -> None:
    height, length, sag = 1.0, 20.0, 30.0
    cable = bathyal.make_cable([(-30, 0), (30, 0)], 0.02, wave(height, length), sag=sag, step=0.05)
    z, x = cable.center[:, 2] - 0.01, cable.center[:, 0]
    assert np.all(z >= cable.bottom - 1e-4)
    bend = np.gradient(np.gradient(z, x), x)
    free = (cable.gap > 0.02) & (np.abs(x) < 25)
    assert free.sum() > 100
    np.testing.assert_allclose(bend[free], 1 / sag, rtol=0.01)
    # It leaves the wave where the tangents agree: solved once more, by hand.
    k = 2 * np.pi / length
    grid = np.linspace(0, length / 2, 200001)
    tangent = height / 2 * k * np.sin(k * grid) - (length / 2 - grid) / sag
    off = grid[np.flatnonzero(np.diff(np.sign(tangent)) != 0)[0]]
    hanging = (x > off + 0.1) & (x < length - off - 0.1)
    assert cable.gap[hanging].min() > 0
    assert cable.gap[(x > 1) & (x < off - 0.1)].max() < 1e-3
    deepest = height / 2 * math.cos(k * off) - (length / 2 - off) ** 2 / (2 * sag)
    assert z[np.abs(x - length / 2).argmin()] == pytest.approx(deepest, abs=2e-3)


def test_pipe_with_tension_without_end_bridges_every_hollow() -> None:
    pipe = bathyal.make_pipeline([(-20, 0), (20, 0)], 0.5, wave(1.0, 10.0), sag=math.inf)
    np.testing.assert_allclose(pipe.center[:, 2], 0.75, atol=2e-3)


@pytest.mark.parametrize("slack", [0.01, 0.05, 0.2])
def test_cable_is_longer_than_its_route_by_its_slack(flat: bathyal.Scene, slack: float) -> None:
    cable = bathyal.make_cable([(-40, 0), (40, 0)], 0.05, flat, slack=slack, seed=2)
    steps = np.linalg.norm(np.diff(cable.center, axis=0), axis=1)
    assert steps.sum() == pytest.approx(80 * (1 + slack), rel=2e-3)
    np.testing.assert_allclose(cable.center[[0, -1], :2], [[-40, 0], [40, 0]], atol=1e-9)
    other = bathyal.make_cable([(-40, 0), (40, 0)], 0.05, flat, slack=slack, seed=3)
    assert np.abs(other.center[:50] - cable.center[:50]).max() > 0.01


def test_anodes_and_field_joints_change_the_radius_where_they_are() -> None:
    pipe = bathyal.make_pipeline(
        [(0, 0, 0), (60, 0, 0)], 0.6, anode_spacing=20, anode_length=1.0, anode_thickness=0.05,
        joint_spacing=12, joint_length=0.4, joint_recess=0.03,
    )  # fmt: skip
    radius = np.hypot(*(pipe.mesh.vertices[2:, 1:].T)).reshape(len(pipe.kp), -1)
    np.testing.assert_allclose(np.ptp(radius, axis=1), 0, atol=1e-12)
    for at, expected in ((10, 0.35), (30, 0.32), (50, 0.35), (6, 0.27), (18, 0.27), (25, 0.3)):
        assert radius[np.abs(pipe.kp - at).argmin(), 0] == pytest.approx(expected)
    report = bathyal.mesh_report(pipe.mesh)
    assert report.closed
    area = 12 * math.sin(math.pi / 12)
    volume = area * (60 * 0.09 + 3 * (0.35**2 - 0.09) + 5 * 0.4 * (0.27**2 - 0.09))
    assert report.volume == pytest.approx(volume, rel=1e-3)


def test_mesh_is_the_same_for_any_number_of_threads() -> None:
    terrain = bottom(relief_rms=0.3, seed=2)
    one, four = (
        bathyal.make_pipeline([(-40, -20), (0, 9), (40, 0)], 0.5, terrain, num_threads=n)
        for n in (1, 4)
    )
    assert one.mesh.vertices.tobytes() == four.mesh.vertices.tobytes()
    assert one.mesh.attributes["kp"].max() == one.kp[-1]


@pytest.mark.parametrize(
    ("name", "route", "options"),
    [
        ("route", [(0, 0)], {}), ("route", np.empty((0, 2)), {}), ("route", [(0, 0, 0)] * 2, {}),
        ("route", [(0, 0), (math.nan, 1)], {}), ("route", [(0, 0), (0, 0)], {}),
        ("route", [(0, 0), (90, 0)], {}), ("route", [(0, 0), (20, 0), (0.0, 0.1)], {}),
        ("route", [(0, 0), (1e9, 0)], {}), ("diameter", None, {"diameter": 0}),
        ("diameter", None, {"diameter": math.nan}), ("burial", None, {"burial": [1, 2, 3]}),
        ("burial", None, {"burial": -1}), ("burial", None, {"burial": [0, math.nan]}),
        ("spans", None, {"spans": [(5, 3)]}), ("spans", None, {"spans": [(5, 30)]}),
        ("spans", None, {"spans": [(1, 5), (4, 8)]}), ("spans", None, {"spans": [(1, math.nan)]}),
        ("sag", None, {"sag": 0}), ("sag", None, {"sag": math.nan}), ("step", None, {"step": 0}),
        ("step", None, {"step": 1e-9}), ("sides", None, {"sides": 2}),
        ("anode_spacing", None, {"anode_spacing": 0.5}), ("terrain", None, {"terrain": 3}),
        ("joint_recess", None, {"joint_spacing": 10, "joint_recess": 1}),
    ],
)  # fmt: skip
def test_what_makes_no_pipe_is_refused_by_name(flat, name, route, options) -> None:
    given = {"diameter": 0.5, "terrain": flat, **options}
    with pytest.raises(ValueError, match=f"`{name}`"):
        bathyal.make_pipeline([(0, 0), (20, 0)] if route is None else route, **given)


def test_what_needs_a_terrain_is_refused_without_one() -> None:
    route = [(0, 0, 0), (20, 0, 0)]
    for name, options in (("burial", {"burial": 0.1}), ("spans", {"spans": [(1, 2)]})):
        with pytest.raises(ValueError, match=f"`{name}`"):
            bathyal.make_pipeline(route, 0.5, **options)
    with pytest.raises(ValueError, match="`route`"):
        bathyal.make_pipeline([(0, 0), (20, 0)], 0.5)
    with pytest.raises(ValueError, match="`slack`"):
        bathyal.make_cable(route, 0.05, slack=0.5)
    with pytest.raises(ValueError, match="`slack_wavelength`"):
        bathyal.make_cable(route, 0.05, slack=0.1, slack_wavelength=1e-5)


def test_bend_tighter_than_the_radius_is_refused() -> None:
    angle = np.linspace(0, 2, 30)

    def arc(radius: float) -> np.ndarray:
        return radius * np.c_[np.cos(angle), np.sin(angle), 0 * angle]

    bathyal.make_pipeline(arc(1.05), 2.0, step=0.05)
    with pytest.raises(ValueError, match="`route`: expected bends wider than the radius, 1 m"):
        bathyal.make_pipeline(arc(0.9), 2.0, step=0.05)
