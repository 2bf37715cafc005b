# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and pages: what must be seen is there, whatever the size and place of the bottom."""

from __future__ import annotations

import base64
import json
import re

import matplotlib.image
import numpy as np
import pytest

import bathyal
from bathyal.view import decimate as decimation
from bathyal.view import figure as figures
from bathyal.view import map as map_figure
from bathyal.view import relief, stations
from bathyal.view import scene3d as views
from bathyal.view.html import write_html
from bathyal.view.palette import GAP, INK, SEGMENTS
from bathyal.view.window import map_window
from tests.support import scenes

RED = np.array([int(GAP[k : k + 2], 16) for k in (1, 3, 5)])


def pixels(figure) -> np.ndarray:
    """(height, width, 3) colours 0 to 255."""
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)


def near(image: np.ndarray, colour: np.ndarray | str, tolerance: int = 12) -> int:
    """How many pixels are of a colour."""
    if isinstance(colour, str):
        colour = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
    return int(np.all(np.abs(image - colour) <= tolerance, axis=-1).sum())


def texts(figure) -> str:
    from matplotlib.text import Text

    return "\n".join(text.get_text() for text in figure.findobj(Text))


# The height image ---------------------------------------------------------------------------------


def test_heights_are_those_of_the_bottom():
    plane = bathyal.Plane((0.1, -0.2, 1.0), -20.0)
    image = relief.height_image(plane, np.array([0.0, 0]), np.array([30.0, 20]), pixels=60)
    x, y = np.meshgrid(image.x, image.y)
    points = np.column_stack([x.ravel(), y.ravel(), image.height.ravel()])
    assert np.abs(plane.distance(points)).max() < 1e-9
    assert image.height.shape == (40, 60)
    assert image.extent == pytest.approx((0, 30, 0, 20))


def test_holes_are_blank_and_only_they():
    surface = scenes.bottom(offset=scenes.UTM)
    low, high = scenes.UTM[:2], scenes.UTM[:2] + np.array([20, 12])
    image = relief.height_image(surface, low, high, pixels=100)
    x = image.x - scenes.UTM[0]
    assert np.isnan(image.height[:, (x > 9.1) & (x < 10.9)]).all()
    assert np.isfinite(image.height[:, (x < 8.9) | (x > 11.1)]).all()


def test_highest_sheet_is_seen():
    floor = bathyal.TriangleMesh([[0, 0, -5], [4, 0, -5], [0, 4, -5]], [[0, 1, 2]])
    roof = bathyal.TriangleMesh([[0, 0, -2], [2, 0, -2], [0, 2, -2]], [[0, 1, 2]])
    surface = bathyal.Scene([floor, roof])
    image = relief.height_image(surface, np.zeros(2), np.full(2, 4.0), pixels=40)
    assert image.height[2, 2] == pytest.approx(-2)
    assert image.height[2, 30] == pytest.approx(-5)


def test_light_comes_from_the_north_west():
    x, y = np.meshgrid(np.arange(20.0), np.arange(20.0))
    facing = relief.Relief(0.3 * (x - y), np.arange(20.0), np.arange(20.0))
    away = relief.Relief(-facing.height, facing.x, facing.y)
    flat = relief.Relief(np.zeros((20, 20)), facing.x, facing.y)
    bright, middle, dark = (relief.shade(r, 1.0)[10, 10] for r in (facing, flat, away))
    assert bright > middle > dark


def test_shade_reaches_the_rim_of_a_hole():
    height = np.add.outer(np.zeros(9), 0.1 * np.arange(9.0))
    height[:, 4] = np.nan
    shaded = relief.shade(relief.Relief(height, np.arange(9.0), np.arange(9.0)), 1.0)
    assert np.isnan(shaded[:, 4]).all()
    assert np.ptp(shaded[:, [3, 5]]) < 1e-12  # one-sided differences give the same slope


@pytest.mark.parametrize(("slope", "stretch"), [(1.0, 1.0), (0.02, 20.0), (1e-4, 50.0), (0, 1.0)])
def test_flat_ground_is_stretched_and_rough_is_not(slope, stretch):
    tilted = np.add.outer(np.arange(9.0), slope * np.abs(np.arange(9.0) - 4))  # a ridge on a slope
    assert relief.exaggeration(relief.Relief(tilted, np.arange(9.0), np.arange(9.0))) == stretch


# The unrolled section -----------------------------------------------------------------------------


def test_unrolled_section_keeps_lengths_and_angles():
    path = bathyal.plan_toolpath(
        scenes.bottom(hole=False), scenes.aims(miss=False), step=0.2, standoff=0.2, offset="plain"
    )
    section = stations.unroll(path)
    assert section.end[-1] == pytest.approx(
        np.linalg.norm(np.diff(path.targets.point[:, :2], axis=0), axis=1).sum()
    )
    np.testing.assert_allclose(section.tool - section.bottom, 0.2 * section.approach, atol=1e-9)
    inside = np.flatnonzero(np.diff(path.segment) == 0)
    steps = np.linalg.norm(np.diff(section.bottom, axis=0), axis=1)
    true = np.linalg.norm(np.diff(path.surface, axis=0), axis=1)
    np.testing.assert_allclose(steps[inside], true[inside], atol=1e-9)


def test_unrolled_section_of_a_rolled_path_runs_from_target_to_target():
    _, _, path = scenes.planned(hole=False, miss=False, standoff=0.2)
    section = stations.unroll(path)
    ends = path.targets.point[:, :2]
    assert section.end[-1] == pytest.approx(np.linalg.norm(np.diff(ends, axis=0), axis=1).sum())
    np.testing.assert_array_equal(section.start[:, :2], ends[:-1])
    moved = np.diff(section.tool, axis=0)[np.diff(path.segment) == 0]
    assert (moved[:, 0] > 0).all(), "the ball rolls on along the section"


def test_runs_cover_the_path_and_stop_at_gaps():
    _, _, path = scenes.planned()
    covered = set()
    for begin, end in stations.runs(path):
        assert not path.gap[begin:end].any()
        covered |= set(range(begin, end + 1))
    assert covered == set(range(len(path)))


# The picture --------------------------------------------------------------------------------------


def test_picture_shows_path_and_gap():
    with_gap = pixels(figures.plan_figure(*scenes.planned()))
    whole = pixels(figures.plan_figure(*scenes.planned(hole=False, miss=False)))
    assert near(with_gap, SEGMENTS[0]) > 300
    assert near(with_gap, SEGMENTS[1]) > 300
    assert near(with_gap, RED) > 300
    assert near(whole, RED) == 0


def test_picture_says_what_it_is_given():
    surface, axes, path = scenes.planned()
    figure = figures.plan_figure(
        surface, axes, path, title="Sand waves", facts={"soundings": "1,025"}, crs="EPSG:32602"
    )
    words = texts(figure)
    for word in ("Sand waves", "soundings", "1,025", "N", "height z [m]", "easting [m]", "5 m"):
        assert word in words
    assert path.warnings
    for warning in path.warnings:
        assert warning.split()[0] in words


def test_north_is_marked_only_in_a_survey_frame():
    figure = figures.plan_figure(*scenes.planned())
    assert "N" not in texts(figure).split("\n")
    assert "x [m]" in texts(figure)


def test_far_coordinates_are_given_by_an_offset():
    surface, axes, path = scenes.planned(offset=scenes.UTM)
    words = texts(figures.plan_figure(surface, axes, path)).replace("\N{THIN SPACE}", " ")
    assert "(+ 620 900 m)" in words
    assert "(+ 7 243 900 m)" in words


@pytest.mark.parametrize(
    ("low", "high", "offset"),
    [(0, 40, 0), (-3, 900, 0), (621_012.0, 621_040.0, 621_000), (-5e6, -4.9e6, -5e6)],
)
def test_tick_offset(low, high, offset):
    assert map_figure.tick_offset(low, high) == offset


def test_small_path_in_a_wide_survey_is_shown_near_and_located():
    x, y = np.meshgrid(np.arange(0, 2001.0, 20), np.arange(0, 2001.0, 20))
    cloud = np.column_stack([x.ravel(), y.ravel(), -50 + 0.001 * x.ravel()])
    surface = bathyal.Scene(bathyal.triangulate(cloud))
    axes = np.array([[1000.0, 1000, -40, 0, 0, -1], [1030, 1010, -40, 0, 0, -1]])
    path = bathyal.plan_toolpath(surface, axes, step=1.0)
    window = map_window(surface, axes, path, 1.5)
    assert not window.whole
    assert np.ptp([window.low[0], window.high[0]]) < 100
    assert "the survey, 2 km × 2 km" in texts(figures.plan_figure(surface, axes, path))


def test_flat_profile_states_its_stretch_and_rough_is_true_to_scale():
    plane = bathyal.Plane((0.005, 0, 1), -20.0)
    axes = np.array([[0.0, 0, -10, 0, 0, -1], [80, 0, -10, 0, 0, -1]])
    flat = figures.plan_figure(plane, axes, bathyal.plan_toolpath(plane, axes, step=1.0))
    assert re.search(r"heights × [125]0*[;)]", texts(flat))
    steep = bathyal.Plane((1.0, 0, 1), -20.0)
    rough = figures.plan_figure(steep, axes, bathyal.plan_toolpath(steep, axes, step=1.0))
    assert "true to scale" in texts(rough)


def test_picture_of_one_target_and_of_an_upright_pair():
    plane = bathyal.Plane((0, 0, 1), -5.0)
    one = [[0, 0, 0, 0, 0, -1]]
    single = figures.plan_figure(plane, one, bathyal.plan_toolpath(plane, one))
    assert near(pixels(single), INK) > 100
    wall = bathyal.Scene(
        bathyal.TriangleMesh(
            [[0, -5, -9], [0, 5, -9], [0, 5, 0], [0, -5, 0]], [[0, 1, 2], [0, 2, 3]]
        )
    )
    pair = [[3.0, 0, -2, -1, 0, 0], [3.0, 0, -7, -1, 0, 0]]
    figures.plan_figure(wall, pair, bathyal.plan_toolpath(wall, pair, step=0.5)).canvas.draw()


def test_png_is_the_same_bytes_and_replaces_whole(tmp_path):
    plan = scenes.planned()
    for name in ("a.png", "b.png"):
        figures.write_png(figures.plan_figure(*plan), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    image = matplotlib.image.imread(tmp_path / "a.png")
    assert image.shape[0] > 1200
    assert image.shape[1] > 1700
    with pytest.raises(OSError, match="nowhere"):
        figures.write_png(figures.plan_figure(*plan), tmp_path / "nowhere" / "plan.png")


# The page -----------------------------------------------------------------------------------------


def numbers(encoded) -> np.ndarray:
    """An array as plotly writes it: text of base64 with its type, or a list."""
    if isinstance(encoded, dict):
        return np.frombuffer(base64.b64decode(encoded["bdata"]), encoded["dtype"])
    return np.array(encoded, float)


def traces(figure) -> list[dict]:
    return json.loads(figure.to_json())["data"]


def test_page_needs_no_network(tmp_path):
    surface, axes, path = scenes.planned()
    file = tmp_path / "plan.html"
    write_html(views.show_plan(surface, axes, path), file, title="a <b>", warnings=path.warnings)
    page = file.read_text()
    for tag in re.findall(r"<(?:script|link|img|iframe)\b[^>]*>", page):
        assert not re.search(r"""(?:src|href)\s*=\s*["']?(?:https?:)?//""", tag)
    assert "Plotly.newPlot" in page
    assert "a &lt;b&gt;" in page
    assert len(page) < 10_000_000


def test_page_carries_every_sample_in_survey_coordinates():
    surface, axes, path = scenes.planned(offset=scenes.UTM)
    figure = views.show_plan(surface, axes, path)
    tables = [
        numbers(trace["customdata"]).reshape(-1, 13)
        for trace in traces(figure)
        if "customdata" in trace
    ]
    rows = np.vstack(tables)
    rows = rows[np.isfinite(rows[:, 0])]
    samples = rows[:, 0].astype(int)
    assert set(samples) == set(range(len(path)))
    np.testing.assert_array_equal(rows[:, 2:5], path.position[samples])
    np.testing.assert_array_equal(rows[:, 5:8], path.approach[samples])
    np.testing.assert_array_equal(rows[:, 8:11], path.travel[samples])


def test_page_draws_about_a_stated_origin():
    surface, axes, path = scenes.planned(offset=scenes.UTM)
    figure = views.show_plan(surface, axes, path)
    assert figure.layout.scene.xaxis.title.text == "x [m] + 621,010"
    bottom = next(trace for trace in traces(figure) if trace["type"] == "mesh3d")
    assert np.abs(numbers(bottom["x"])).max() < 20


def test_gap_is_its_own_stroke():
    surface, axes, path = scenes.planned()
    gap = next(t for t in traces(views.show_plan(surface, axes, path)) if "gap" in t["name"])
    assert gap["line"]["dash"] == "dash"
    x = numbers(gap["x"])
    row = np.flatnonzero(path.gap)[0]
    np.testing.assert_allclose(x[:2], path.position[row : row + 2, 0], atol=1e-5)
    whole = scenes.planned(hole=False, miss=False)
    assert not [t for t in traces(views.show_plan(*whole)) if "gap" in t["name"]]


def test_decimation_keeps_budget_extent_and_overhangs():
    t, p = np.meshgrid(np.linspace(0, np.pi, 200), np.linspace(0, 2 * np.pi, 400))
    t, p = t.ravel(), p.ravel()
    ball = np.column_stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)])
    first = (np.arange(399)[:, None] * 200 + np.arange(199)).ravel()
    triangles = np.vstack(
        [
            np.column_stack([first, first + 1, first + 200]),
            np.column_stack([first + 1, first + 201, first + 200]),
        ]
    ).astype(np.int32)
    vertices, light = decimation.decimate(ball, triangles, 5_000)
    assert 1_500 < len(light) <= 5_500
    radius = np.linalg.norm(vertices, axis=1)
    assert radius.min() > 0.97
    assert radius.max() <= 1 + 1e-12
    assert vertices[:, 2].min() < -0.97
    few = decimation.decimate(ball, triangles[:10], 5_000)
    assert few[1] is not None
    np.testing.assert_array_equal(few[1], triangles[:10])


def test_shows_in_jupyter():
    surface, _, path = scenes.planned()
    cloud = bathyal.PointCloud(surface.meshes[0].vertices)
    for shown in (path.show(), surface.meshes[0].show(), cloud.show()):
        assert "application/vnd.plotly.v1+json" in shown._repr_mimebundle_() or shown.to_json()
        assert len(shown.data) >= 1
    assert "1,025 soundings" in cloud.show().layout.title.text


def test_large_cloud_is_thinned_and_says_so():
    points = np.random.default_rng(0).uniform(0, 50, (300_000, 3))
    shown = bathyal.PointCloud(points).show()
    assert len(shown.data[0].x) <= views.POINT_BUDGET
    assert "one in 3 shown" in shown.layout.title.text


def test_a_view_shows_a_small_survey_whole_and_of_a_large_one_what_lies_about_the_path():
    surface, axes, path = scenes.planned()
    whole = views.show_plan(surface, axes, path).layout.title.text
    assert whole == f"{len(surface.meshes[0].triangles):,} triangles shown"
    x, y = np.meshgrid(np.arange(-60, 80.0), np.arange(-60, 80.0))
    wide = bathyal.Scene(bathyal.triangulate(np.c_[x.ravel(), y.ravel(), np.full(x.size, -30.0)]))
    path = bathyal.plan_toolpath(wide, axes[:3], step=0.5)
    figure = views.show_plan(wide, axes[:3], path)
    assert "around the path (the survey has 38,642)" in figure.layout.title.text
    bottom = next(trace for trace in traces(figure) if trace["type"] == "mesh3d")
    edges = [numbers(bottom[axis]) for axis in "xy"]
    for low, high in ((edge.min(), edge.max()) for edge in edges):  # a whole rectangle of cells
        assert low > -40
        assert high < 110
    count = (np.ptp(edges[0]) + 1) * (np.ptp(edges[1]) + 1)
    assert len(edges[0]) == count


def test_the_camera_sees_the_whole_box():
    for shape in ((20, 12, 1), (1, 1, 3), (4, 1, 1), (1, 4, 0.01)):
        aspect = views._aspect(np.array(shape, float), 1)
        eye = np.array([views._eye(aspect)[name] for name in "xyz"])
        back = eye / np.linalg.norm(eye)
        right = np.cross([0, 0, 1], back)
        right /= np.linalg.norm(right)
        half = np.array([aspect[name] for name in "xyz"]) / 2
        for signs in np.ndindex(2, 2, 2):
            corner = half * (2 * np.array(signs) - 1)
            depth = (eye - corner) @ back
            height = abs(corner @ np.cross(back, right)) / depth
            width = abs(corner @ right) / depth
            assert height < np.tan(np.radians(22.5))
            assert width < 4 / 3 * np.tan(np.radians(22.5))


def test_an_axis_that_misses_is_in_the_picture():
    surface, axes, path = scenes.planned(miss=False)
    axes = np.vstack([axes, [21.5, 6, -20, 0, 0, -1]])
    path = bathyal.plan_toolpath(surface, axes, step=0.2)
    figure = views.show_plan(surface, axes, path)
    lost = next(t for t in traces(figure) if t["name"] == "camera axis without target")
    x = numbers(lost["x"])
    low, high = figure.layout.scene.xaxis.range
    assert low <= x[:2].min() <= x[:2].max() == 21.5 <= high


def test_the_section_goes_on_from_segment_to_segment_unless_a_gap_parts_them():
    _, _, path = scenes.planned(hole=False, miss=False, step=0.7)
    whole = stations.unroll(path)
    np.testing.assert_array_equal(whole.end[:-1], whole.begin[1:])
    known = path.targets.point[:, :2]
    lengths = np.linalg.norm(np.diff(known, axis=0), axis=1)
    np.testing.assert_allclose(whole.end - whole.begin, lengths, atol=1e-9)
    axes = np.insert(scenes.aims(miss=False), 1, [60.0, 3, -20, 0, 0, -1], axis=0)
    parted = stations.unroll(bathyal.plan_toolpath(scenes.bottom(hole=False), axes, step=0.7))
    assert len(parted.begin) == 2
    assert parted.begin[1] == pytest.approx(np.linalg.norm(known[1] - known[0]))
    assert parted.end[0] == 0.0
