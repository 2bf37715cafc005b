# SPDX-License-Identifier: BSD-3-Clause
"""Generated bottoms: what was asked for is in them, and a tile is a part of the whole."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bathyal

FLAT = {"relief_rms": 0.0}


def grid(mesh: bathyal.TriangleMesh, columns: int) -> np.ndarray:
    return np.asarray(mesh.vertices[:, 2]).reshape(-1, columns)


def spectrum(z: np.ndarray, spacing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Power by wave numbers kx, ky [rad/m] under a window that hides the borders."""
    window = np.outer(np.hanning(z.shape[0]), np.hanning(z.shape[1]))
    power = np.abs(np.fft.fft2((z - z.mean()) * window)) ** 2
    ky, kx = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in z.shape)
    return *np.meshgrid(kx, ky), power


@pytest.mark.parametrize("exponent", [2.5, 3.25, 4.0])
def test_spectrum_of_the_relief_has_the_exponent_asked_for(exponent: float) -> None:
    found = []
    for seed in range(3):
        mesh = bathyal.make_seabed(
            255.5, 0.5, seed=seed, relief_exponent=exponent, relief_longest=64,
            relief_shortest=1.25,
        )  # fmt: skip
        kx, ky, power = spectrum(grid(mesh, 512), 0.5)
        k = np.hypot(kx, ky)
        edges = np.geomspace(2 * np.pi / 32, 2 * np.pi / 2, 13)
        row = np.digitize(k, edges)
        mean = [power[row == i].mean() for i in range(1, 13)]
        found.append(-np.polyfit(np.log(np.sqrt(edges[1:] * edges[:-1])), np.log(mean), 1)[0])
    assert np.mean(found) == pytest.approx(exponent, abs=0.1)


def test_relief_has_the_rms_asked_for_and_no_preferred_direction() -> None:
    squares = []
    slopes = []
    for seed in range(8):
        z = grid(bathyal.make_seabed(400, 1.0, seed=seed, relief_rms=0.3), 401)
        squares.append((z**2).mean())
        slopes.append([(np.diff(z, axis=axis) ** 2).mean() for axis in (0, 1)])
    assert math.sqrt(np.mean(squares)) == pytest.approx(0.3, rel=0.03)
    along, across = np.mean(slopes, axis=0)
    assert along == pytest.approx(across, rel=0.1)


@pytest.mark.parametrize("direction", [0.0, 0.6, 2.0])
def test_ripples_have_the_wavelength_and_direction_asked_for(direction: float) -> None:
    mesh = bathyal.make_seabed(
        63.875, 0.125, seed=4, **FLAT, ripple_height=0.1, ripple_wavelength=1.3,
        ripple_direction=direction,
    )  # fmt: skip
    kx, ky, power = spectrum(grid(mesh, 512), 0.125)
    k = np.hypot(kx, ky)
    near = power * (np.abs(k - 2 * np.pi / 1.3) < 1.5) * (kx > 0 if direction < 1 else ky > 0)
    middle = np.array([(kx * near).sum(), (ky * near).sum()]) / near.sum()
    assert 2 * np.pi / np.hypot(*middle) == pytest.approx(1.3, rel=0.03)
    assert math.atan2(middle[1], middle[0]) == pytest.approx(direction, abs=0.05)


def test_ripples_are_as_high_and_as_asymmetric_as_asked() -> None:
    model = bathyal.SeabedModel(
        **FLAT, ripple_height=0.1, ripple_wavelength=2.0, ripple_asymmetry=0.3,
        ripple_meander=0.0, ripple_defects=0.0,
    )  # fmt: skip
    x = np.linspace(0, 2, 20001)
    z = model.height(x, np.zeros_like(x))
    assert np.ptp(z) == pytest.approx(0.1, rel=1e-6)
    rise = (x[z.argmax()] - x[z.argmin()]) % 2.0  # the current runs along x: stoss, then lee
    assert rise - (2 - rise) == pytest.approx(0.3 * 2, abs=1e-3)


def test_ripples_fork_at_defects_and_leave_no_step() -> None:
    """Around a dislocation one more crest begins; the height is continuous all the same."""
    options = {**FLAT, "seed": 2, "ripple_height": 0.1, "ripple_meander": 0.0}
    whole, forked = (
        grid(bathyal.make_seabed(20, 0.02, ripple_defects=d, **options), 1001) for d in (0.0, 1.0)
    )
    assert np.abs(forked - whole).max() > 0.08
    steepest = np.abs(np.diff(whole, axis=1)).max()
    assert max(np.abs(np.diff(forked, axis=axis)).max() for axis in (0, 1)) < 3 * steepest


def test_ripples_cover_the_share_asked_for() -> None:
    options = {"ripple_height": 0.1, "ripple_cover": 0.3, "ripple_patch": 10.0}
    shares = [
        (bathyal.make_seabed(400, 0.5, seed=s, **options).attributes["material"] == 1).mean()
        for s in range(3)
    ]
    assert np.mean(shares) == pytest.approx(0.3, abs=0.04)


def test_slope_trench_cliff_and_scour_are_where_they_were_put() -> None:
    def heights(x, y, **options):
        return bathyal.SeabedModel(**FLAT, **options).height(np.atleast_1d(x), np.atleast_1d(y))

    x, y = np.random.default_rng(0).uniform(-50, 50, (2, 100))
    rising = heights(x, y, slope=0.1, slope_direction=np.pi / 2, depth=30.0)
    np.testing.assert_allclose(rising, np.tan(0.1) * y - 30, rtol=1e-12)
    trench = {"trench_depth": 2.0, "trench_direction": np.pi / 2, "trench_point": (3, 0)}
    found = heights([3.0, 3.74, 2.26, 5.01, 0.99], np.arange(5.0), **trench)
    np.testing.assert_allclose(found, [-2, -2, -2, 0, 0], atol=1e-12)
    cliff = {"cliff_height": 4.0, "cliff_point": (0, 5), "cliff_direction": np.pi / 2}
    np.testing.assert_allclose(heights([0, 1, 2], [3.9, 5, 6.1], **cliff), [2, 0, -2], atol=1e-12)
    scour = {"scour_points": [(1, 2), (9, 9)], "scour_depth": 0.5}
    np.testing.assert_allclose(heights([1, 9, 3.1], [2, 9, 2], **scour), [-0.5, -0.5, 0])


def test_boulders_are_as_many_as_asked_and_of_rock() -> None:
    options = {**FLAT, "boulder_density": 0.01, "boulder_radius": 1.0, "boulder_scour": 0.0}
    mesh = bathyal.make_seabed(300, 0.1, seed=1, **options)
    rock = mesh.attributes["material"] == 2
    z = mesh.vertices[:, 2]
    assert (z[~rock] == 0).all()
    assert (z[rock] > 0).all()
    # Mean area of a dome: π · 1.2 · 0.85 · E r², radii r⁻³ from 0.2 to 1: E r² = 2 ln 5 / 24.
    area = np.pi * 1.2 * 0.85 * 2 * math.log(5) / 24
    assert rock.mean() == pytest.approx(1 - math.exp(-0.01 * area), rel=0.15)
    assert 0.5 < z.max() < 0.9


def test_tiles_are_the_whole_byte_for_byte_and_their_triangles_cover_it() -> None:
    options = {
        "seed": 5, "ripple_height": 0.1, "boulder_density": 0.02, "trench_depth": 1.0,
        "cliff_height": 1.0, "edge_meander": 0.5, "ripple_cover": 0.5, "slope": 0.05,
    }  # fmt: skip
    whole = bathyal.make_seabed((60, 40), 0.1, **options)
    rows = {tuple(v[:2]): v.tobytes() for v in whole.vertices}
    model = bathyal.SeabedModel(**options)
    for x in (-15, 15):
        for y in (-10, 10):
            tile = bathyal.make_seabed((30, 20), 0.1, origin=(x, y), **options)
            assert all(rows[tuple(v[:2])] == v.tobytes() for v in tile.vertices)
            again = model.mesh((30, 20), 0.1, origin=(x, y))
            assert again.vertices.tobytes() == tile.vertices.tobytes()
    np.testing.assert_array_equal(
        model.height(whole.vertices[::97, 0], whole.vertices[::97, 1]), whole.vertices[::97, 2]
    )
    report = bathyal.mesh_report(whole)
    assert report.planar_area == pytest.approx(60 * 40, rel=1e-9)
    assert report.inverted_triangles == 0
    assert report.boundary_edges == 2 * (600 + 400)


def test_mesh_is_the_same_for_any_number_of_threads_and_unlike_another_seed() -> None:
    options = {"ripple_height": 0.1, "boulder_density": 0.02}
    one = bathyal.make_seabed(50, 0.1, seed=1, num_threads=1, **options)
    four = bathyal.make_seabed(50, 0.1, seed=1, num_threads=4, **options)
    assert one.vertices.tobytes() == four.vertices.tobytes()
    assert one.attributes["material"].tobytes() == four.attributes["material"].tobytes()
    other = bathyal.make_seabed(50, 0.1, seed=2, **options)
    assert np.abs(other.vertices[:, 2] - one.vertices[:, 2]).max() > 0.1


def test_middle_is_at_the_origin_and_squares_are_no_larger_than_asked() -> None:
    mesh = bathyal.make_seabed((10, 5), 0.3)
    np.testing.assert_allclose(mesh.vertices[:, :2].min(axis=0), [-5, -2.5], rtol=1e-15)
    np.testing.assert_allclose(mesh.vertices[:, :2].max(axis=0), [5, 2.5], rtol=1e-15)
    assert len(mesh.vertices) == 35 * 18
    assert len(bathyal.make_seabed(1, 10).triangles) == 2


def test_triangles_have_the_middle_material_of_their_corners() -> None:
    mesh = bathyal.TriangleMesh(
        np.random.default_rng(0).uniform(size=(4, 3)),
        [[0, 1, 2], [1, 2, 3]],
        attributes={"material": [0.0, 2.0, 1.0, 2.0]},
    )
    assert bathyal.triangle_material(mesh).tolist() == [1, 2]
    assert bathyal.SeabedModel.materials == ["silt", "sand", "rock"]
    with pytest.raises(ValueError, match="`mesh`"):
        bathyal.triangle_material(bathyal.TriangleMesh(mesh.vertices, mesh.triangles))


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("size", {"size": 0}), ("size", {"size": math.nan}), ("size", {"size": (1, 2, 3)}),
        ("size", {"size": (10, -1)}), ("spacing", {"spacing": 0}),
        ("spacing", {"spacing": math.nan}), ("spacing", {"size": 31623, "spacing": 1}),
        ("spacing", {"size": 1e6, "spacing": 1e-300}), ("origin", {"origin": (math.inf, 0)}),
        ("spacing", {"ripple_height": 0.1, "ripple_wavelength": 0.9}),
        ("relief_rms", {"relief_rms": -1}), ("relief_exponent", {"relief_exponent": math.nan}),
        ("relief_longest", {"relief_longest": 0.1}),
        ("relief_longest", {"relief_longest": 1e9}), ("relief_shortest", {"relief_shortest": 0}),
        ("ripple_asymmetry", {"ripple_asymmetry": 0.5}), ("slope", {"slope": 1.6}),
        ("ripple_cover", {"ripple_cover": 1.1}), ("boulder_density", {"boulder_density": 100}),
        ("boulder_density", {"boulder_density": math.inf}), ("depth", {"depth": math.nan}),
        ("trench_floor", {"trench_floor": 4}), ("trench_point", {"trench_point": (0, 0, 0)}),
        ("cliff_run", {"cliff_run": 0}), ("scour_points", {"scour_points": [(0, math.nan)]}),
        ("scour_points", {"scour_points": [1, 2, 3]}), ("num_threads", {"num_threads": -1}),
    ],
)  # fmt: skip
def test_what_makes_no_bottom_is_refused_by_name(name: str, options: dict) -> None:
    with pytest.raises(ValueError, match=f"`{name}`"):
        bathyal.make_seabed(**{"size": 10, "spacing": 0.5, **options})


def test_places_that_are_none_are_refused() -> None:
    model = bathyal.SeabedModel()
    with pytest.raises(ValueError, match="`y`: expected 2 values"):
        model.height([0.0, 1.0], [0.0])
    for ask in (model.height, model.material):
        with pytest.raises(ValueError, match="`x`: expected finite numbers"):
            ask([0.0, math.nan], [0.0, 1.0])
    assert model.height([], []).shape == (0,)
