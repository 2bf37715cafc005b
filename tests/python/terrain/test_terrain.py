# SPDX-License-Identifier: BSD-3-Clause
"""Planes, triangulation, sheets and mesh reports from Python."""

import math
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal

SEABED = Path(__file__).resolve().parents[4] / "shared" / "data" / "seabed"
UTM = np.array([620152.0, 7246504.0, -52.0])


def soundings(seed=0, count=4000, size=10.0, noise=0.02):
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, size, (count, 2))
    return np.c_[xy, 0.3 * np.sin(xy[:, 0]) + noise * rng.normal(size=count)]


def ledge(seed=0):
    rng = np.random.default_rng(seed)
    roof = np.c_[rng.uniform(2, 4, (400, 2)), np.full(400, 1.5)]
    return np.r_[soundings(seed, 10000), roof]


def read_ply(path):
    """Vertices and triangles of the two corals: binary PLY as Open3D writes it."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    counts, fields, element = {}, [], ""
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], {"double": "<f8", "uchar": "u1"}[words[1]]))
    vertex = np.dtype(fields)
    v = np.frombuffer(body, vertex, counts["vertex"])
    faces = np.dtype([("count", "u1"), ("corners", "<u4", 3)])
    f = np.frombuffer(body, faces, counts["face"], counts["vertex"] * vertex.itemsize)
    return np.stack([v["x"], v["y"], v["z"]], axis=1), f["corners"].astype(np.int32)


def coral(name):
    path = SEABED / name
    if not path.exists():
        pytest.skip(f"shared data {name} is not here")
    return read_ply(path)


MCAP = "coral-mcap/mcap_derived.ply"
COLONY = "coral-colony/colony_plot.ply"


# --- fit_plane


def test_fit_plane_takes_clouds_and_arrays_and_unpacks():
    points = np.array([[0, 0, 1.0], [1, 0, 1.0], [0, 1, 1.0], [1, 1, 1.0]]) + UTM
    for cloud in (points, bathyal.PointCloud(points), points.tolist()):
        fit = bathyal.fit_plane(cloud)
        plane, rms = fit
        assert plane.offset == pytest.approx(-51.0, abs=1e-9)
        np.testing.assert_allclose(fit.normal, [0, 0, 1], atol=1e-9)
        assert rms == fit.rms == pytest.approx(0.0, abs=1e-9)
        assert fit.inliers.dtype == bool
        assert fit.inliers.all()
        assert not fit.inliers.flags.writeable
        assert fit.flat


@settings(max_examples=25, deadline=None)
@given(
    slope=st.tuples(st.floats(-1, 1), st.floats(-1, 1)),
    offset=st.tuples(*[st.floats(-1e7, 1e7)] * 3),
    seed=st.integers(0, 2**32 - 1),
)
def test_fit_plane_finds_the_plane_under_a_third_of_gross_errors(slope, offset, seed):
    rng = np.random.default_rng(seed)
    points = np.c_[rng.uniform(-10, 10, (600, 2)), np.zeros(600)]
    points[:, 2] = points[:, :2] @ slope + 0.01 * rng.normal(size=600)
    points[:200, 2] += rng.uniform(1, 10, 200) * rng.choice([-1, 1], 200)
    fit = bathyal.fit_plane(points + offset)
    normal = np.array([-slope[0], -slope[1], 1.0])
    normal /= np.linalg.norm(normal)
    assert np.linalg.norm(np.cross(fit.normal, normal)) < 1e-3
    assert abs(fit.plane.distance([offset])[0]) < 0.01
    assert not fit.inliers[:200].any()


def test_fit_plane_refusals_name_the_argument():
    for points in ([[0, 0, 0]], [[1, 1, 1]] * 4, [[i, 2 * i, 3 * i] for i in range(9)]):
        with pytest.raises(ValueError, match="`points`"):
            bathyal.fit_plane(points)
    with pytest.raises(ValueError, match="clean_cloud"):
        bathyal.fit_plane([[0, 0, 0], [1, 0, 0], [0, 1, math.nan]])
    with pytest.raises(ValueError, match=r"`cloud`: expected real numbers of shape \(N, 3\)"):
        bathyal.fit_plane(np.zeros((5, 2)))
    with pytest.raises(ValueError, match="`tolerance`"):
        bathyal.fit_plane(soundings(), tolerance=-1)
    with pytest.raises(TypeError):
        bathyal.fit_plane(soundings(), tolerence=0.1)


# --- triangulate


def test_triangulate_keeps_what_rides_along_and_shares_the_points():
    points = soundings() + UTM
    cloud = bathyal.PointCloud(
        points,
        attributes={"uncertainty": np.full(len(points), 0.1)},
        crs="EPSG:32602",
        vertical_datum="MLLW",
    )
    mesh = bathyal.triangulate(cloud)
    assert np.shares_memory(mesh.vertices, points)
    assert mesh.crs == "EPSG:32602"
    assert mesh.vertical_datum == "MLLW"
    np.testing.assert_array_equal(mesh.attributes["uncertainty"], cloud.attributes["uncertainty"])
    a, b, c = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    assert mesh.triangles.shape == bathyal.triangulate(points.astype(np.float64)).triangles.shape


@pytest.mark.parametrize("method", ["delaunay", "greedy"])
def test_triangulate_refusals(method):
    if method == "greedy":
        pytest.importorskip("bathyal._pcl")
    for bad in (math.nan, math.inf):
        with pytest.raises(ValueError, match="clean_cloud"):
            bathyal.triangulate([[0, 0, 0], [1, 0, 0], [0, bad, 0]], method=method)
    for points in (
        np.zeros((0, 3)),
        [[0, 0, 0]],
        [[0, 0, 0], [1, 0, 0]],
        [[i, i, 0] for i in range(9)],
    ):
        with pytest.raises(ValueError, match=r"`(points|cloud)`"):
            bathyal.triangulate(points, method=method)
    with pytest.raises(ValueError, match="shape"):
        bathyal.triangulate(np.zeros((4, 4)), method=method)
    with pytest.raises(TypeError):
        bathyal.triangulate(soundings(), method=method, colour="red")


def test_triangulate_names_the_methods_it_knows():
    with pytest.raises(
        ValueError, match='`method`: expected "delaunay" or "greedy", got \'magic\''
    ):
        bathyal.triangulate(soundings(), method="magic")


def test_triangulate_warns_of_sheets_with_where_how_much_and_the_way_out():
    with pytest.warns(bathyal.SheetWarning) as record:
        bathyal.triangulate(ledge() + UTM)
    text = str(record[0].message)
    assert 'method="greedy"' in text
    assert "mesh" in text
    assert "% of its area" in text
    report = record[0].message.report
    assert report.share == pytest.approx(0.04, abs=0.012)
    assert report.patches[0].separation == pytest.approx(1.4, abs=0.15)
    np.testing.assert_allclose(report.patches[0].low[:2], UTM[:2] + 2, atol=0.4)
    assert record[0].filename == __file__


def test_triangulate_is_silent_on_a_height_field():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bathyal.triangulate(soundings(noise=0.05))


def test_greedy_without_its_extension_names_the_remedy(monkeypatch):
    monkeypatch.setitem(sys.modules, "bathyal._pcl", None)  # so that importing it fails
    with pytest.raises(bathyal.Error, match=r"libpcl-dev.*BATHYAL_PCL=ON.*method=\"delaunay\""):
        bathyal.triangulate(soundings(), method="greedy")


def test_greedy_is_the_same_at_utm_and_shares_the_points():
    pytest.importorskip("bathyal._pcl")
    points = soundings()
    here = bathyal.triangulate(points, method="greedy")
    there = bathyal.triangulate(bathyal.PointCloud(points + UTM, crs="EPSG:32602"), method="greedy")
    assert here.triangles.shape[0] > 0.8 * 2 * len(points)
    assert abs(len(here.triangles) - len(there.triangles)) < 0.002 * len(here.triangles)
    assert there.crs == "EPSG:32602"
    assert np.shares_memory(here.vertices, points)


# --- find_sheets


@settings(max_examples=20, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    noise=st.floats(0, 0.1),
    amplitude=st.floats(0, 1),
    wavelength=st.floats(0.5, 20),
    scale=st.sampled_from([1e-3, 1.0, 1e3]),
)
def test_a_noisy_wavy_height_field_is_never_called_several_sheets(
    seed, noise, amplitude, wavelength, scale
):
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, 5, (10000, 2))
    z = amplitude * np.sin(2 * np.pi * xy[:, 0] / wavelength) + noise * rng.normal(size=10000)
    assert not bathyal.find_sheets(scale * np.c_[xy, z])


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), noise=st.floats(0, 0.05), turn=st.floats(0, 6.3))
def test_a_roof_is_always_found_turned_moved_and_shuffled(seed, noise, turn):
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, 5, (10000, 2))
    roof = np.c_[rng.uniform(1, 2, (400, 2)), np.full(400, 1.0)]
    points = np.r_[np.c_[xy, np.zeros(10000)], roof]
    points[:, 2] += noise * rng.normal(size=len(points))
    c, s = math.cos(turn), math.sin(turn)
    moved = points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + UTM
    report = bathyal.find_sheets(moved)
    assert report.patches[0].separation == pytest.approx(1.0, abs=0.05)
    assert report.sheet_area == pytest.approx(1.0, abs=0.3)
    shuffled = bathyal.find_sheets(rng.permutation(moved))
    assert shuffled.sheet_area == pytest.approx(report.sheet_area, rel=0.05)


@pytest.mark.parametrize(("name", "share"), [(MCAP, 0.08), (COLONY, 0.1)])
def test_corals_do_not_pass_unnoticed(name, share):
    vertices, _ = coral(name)
    for points in (vertices, vertices + UTM, vertices * 1000):
        with pytest.warns(bathyal.SheetWarning):
            bathyal.triangulate(points)
        assert bathyal.find_sheets(points).share > share


def test_the_real_survey_is_a_height_field():
    path = SEABED / "jd211" / "jd211_derived_grid.npz"
    if not path.exists():
        pytest.skip("shared data jd211 is not here")
    with np.load(path) as data:
        grid = next(data[name] for name in data.files if data[name].ndim == 2)
    row, column = np.nonzero(np.isfinite(grid))
    points = np.c_[620152.873 + 2 * column, 7246504.912 - 2 * row, grid[row, column]]
    assert len(points) == 1157306
    report = bathyal.find_sheets(points)
    assert report.single_valued
    assert report.spacing == pytest.approx(2.0, rel=0.01)
    fit = bathyal.fit_plane(points)
    assert not fit.flat
    assert fit.relief > 0.3


# --- mesh_report


def shadow_by_cells(vertices, triangles, size):
    """Area under a mesh by the centres of small cells that lie in some triangle's shadow."""
    low = vertices[:, :2].min(axis=0)
    shape = np.ceil(np.ptp(vertices[:, :2], axis=0) / size).astype(int) + 1
    hit = np.zeros(shape, bool)
    for a, b, c in (vertices[triangles][:, :, :2] - low) / size:
        first = np.floor(np.minimum(np.minimum(a, b), c)).astype(int)
        last = np.ceil(np.maximum(np.maximum(a, b), c)).astype(int)
        x, y = np.meshgrid(
            *(np.arange(f, k) for f, k in zip(first, last, strict=True)), indexing="ij"
        )
        sides = [
            (q[0] - p[0]) * (y + 0.5 - p[1]) - (q[1] - p[1]) * (x + 0.5 - p[0])
            for p, q in ((a, b), (b, c), (c, a))
        ]
        inside = np.all([s >= 0 for s in sides], axis=0) | np.all([s <= 0 for s in sides], axis=0)
        hit[x[inside], y[inside]] = True
    return hit.sum() * size**2


def test_mesh_report_of_the_measured_coral():
    vertices, triangles = coral(MCAP)
    report = bathyal.mesh_report(bathyal.TriangleMesh(vertices, triangles))
    assert report.high[2] - report.low[2] == pytest.approx(0.2185397, abs=5e-8)
    assert report.area == pytest.approx(0.2698, abs=5e-5)
    assert report.area_share_inverted == pytest.approx(0.277, abs=5e-4)
    assert (report.components, len(report.boundary_loops), report.closed) == (1, 1, False)
    assert report.planar_area == pytest.approx(shadow_by_cells(vertices, triangles, 5e-4), rel=2e-3)
    # The package that published 2.790366 divides by the area of a concave hull of the coarsened
    # mesh, which is larger than the shadow: ours must be higher, and not by much.
    assert 2.790366 < report.rugosity < 1.2 * 2.790366
    colony = bathyal.mesh_report(bathyal.TriangleMesh(*coral(COLONY)))
    assert (colony.components, colony.closed) == (2, False)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), turn=st.floats(0, 6.3))
def test_mesh_report_does_not_change_with_motion_about_z_or_order(seed, turn):
    rng = np.random.default_rng(seed)
    mesh = bathyal.triangulate(soundings(seed, 300), max_edge=1.0)
    before = bathyal.mesh_report(mesh)
    c, s = math.cos(turn), math.sin(turn)
    moved = mesh.vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + UTM
    after = bathyal.mesh_report(bathyal.TriangleMesh(moved, rng.permutation(mesh.triangles)))
    for name, value in before.as_dict().items():
        if name not in ("low", "high"):
            assert getattr(after, name) == pytest.approx(value, rel=1e-6, abs=1e-9, nan_ok=True), (
                name
            )


def test_mesh_report_reads_well():
    report = bathyal.mesh_report(bathyal.triangulate(soundings()))
    assert "rugosity" in str(report)
    values = report.as_dict()
    assert values["triangle_count"] == report.triangle_count
    assert len(values) == 24
    with pytest.raises(TypeError):
        bathyal.mesh_report(soundings())
