# SPDX-License-Identifier: BSD-3-Clause
"""Masked values are refused by the name of the argument, wherever an array comes in."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bathyal
from bathyal.io.formats.vtp import writer as vtp
from bathyal.toolpath import example_aims as examples
from bathyal.view import arm_views
from bathyal.view import figure as figures
from bathyal.view import scene3d as views

GRID = np.array([[x, y, 0.01 * x * y] for x in range(6) for y in range(5)], dtype=float)
MESH = bathyal.triangulate(GRID)
SCENE = bathyal.Scene(MESH)
ARM = bathyal.arms.ur10e()
Q = np.random.default_rng(0).uniform(-1, 1, (40, 6))
AIMS = np.array([[1.1, 1.2, 5, 0, 0, -1], [4.1, 3.3, 5, 0, 0, -1]], float)
POINT = np.arange(40) % 2
TIPS = ARM.forward(Q)[:, :3, 3]
PATH = bathyal.plan_toolpath(SCENE, AIMS)
ZEROS = np.zeros(2)
MODEL_Q = bathyal.Tracked(Q, TIPS)

# What is called with a masked array, by the argument that the refusal names.
Entry = tuple[str, Any, Callable[[Any], object]]
ENTRIES: list[Entry] = [
    ("points", GRID, bathyal.PointCloud),
    ('attributes["u"]', GRID[:, 0], lambda a: bathyal.PointCloud(GRID, attributes={"u": a})),
    ("vertices", MESH.vertices, lambda a: bathyal.TriangleMesh(a, MESH.triangles)),
    ("triangles", MESH.triangles, lambda a: bathyal.TriangleMesh(GRID, a)),
    ('attributes["u"]', GRID[:, 0],
     lambda a: bathyal.TriangleMesh(GRID, MESH.triangles, attributes={"u": a})),
    ("normal", np.array([0.0, 0, 1]), lambda a: bathyal.Plane(a, 1.0)),
    ("points", GRID, bathyal.Plane((0, 0, 1), 0.0).distance),
    ("cloud", GRID, bathyal.triangulate),
    ("cloud", GRID, bathyal.clean_cloud),
    ("cloud", GRID, bathyal.fit_plane),
    ("cloud", GRID, bathyal.find_sheets),
    ("origin", np.zeros(3), lambda a: bathyal.generate_survey(origin=a, length=1.0)),
    ("x", ZEROS, lambda a: bathyal.survey_height(a, ZEROS)),
    ("y", ZEROS, lambda a: bathyal.survey_height(ZEROS, a)),
    ("origins", GRID + 5, lambda a: SCENE.cast(a, GRID * 0 - 1)),
    ("origins", np.ones(3), lambda a: SCENE.cast(a, GRID * 0 - 1)),
    ("directions", GRID * 0 - 1, lambda a: SCENE.cast((1, 1, 5), a)),
    ("from", GRID + 5, lambda a: SCENE.occluded(a, GRID)),
    ("to", GRID, lambda a: SCENE.occluded((1, 1, 5), a)),
    ("points", GRID, SCENE.nearest),
    ("start", GRID + 5, lambda a: SCENE.nearest_segments(a, GRID)),
    ("start", np.ones(3), lambda a: SCENE.nearest_segments(a, GRID)),
    ("end", GRID, lambda a: SCENE.nearest_segments((1, 1, 5), a)),
    ("points", GRID, SCENE.contains),
    ("points", GRID, SCENE.winding_number),
    ("a", GRID[0], lambda a: SCENE.section(a, GRID[9])),
    ("b", GRID[9], lambda a: SCENE.section(GRID[0], a)),
    ("up", np.array([0.0, 0, 1]), lambda a: SCENE.section(GRID[0], GRID[9], a)),
    ("directions", GRID * 0 - 1, lambda a: bathyal.intersect_moller_trumbore(MESH, (1, 1, 5), a)),
    ("aims", AIMS, lambda a: bathyal.find_targets(SCENE, a)),
    ("aims", AIMS, lambda a: bathyal.plan_toolpath(SCENE, a)),
    ("world_from_vehicle", np.eye(4),
     lambda a: bathyal.plan_toolpath(SCENE, AIMS, world_from_vehicle=a)),
    ("polygon", GRID[[0, 4, 29, 25], :2], lambda a: bathyal.cover_polygon(SCENE, a, 1.0)),
    ("q", Q, ARM.forward),
    ("q", Q, ARM.jacobian),
    ("poses", ARM.forward(Q), ARM.inverse),
    ("start", Q[0], lambda a: ARM.inverse(ARM.forward(Q), start=a)),
    ("q", Q, lambda a: bathyal.Touches(a, POINT)),
    ("q_deg", Q, lambda a: bathyal.Touches(q_deg=a, point=POINT)),
    ("point", POINT, lambda a: bathyal.Touches(Q, a)),
    ("position", TIPS, lambda a: bathyal.Tracked(Q, a)),
    ("pose", ARM.forward(Q), lambda a: bathyal.Tracked(Q, pose=a)),
    ("weights", np.ones(40), lambda a: bathyal.Tracked(Q, TIPS, weights=a)),
    ("covariates t", np.ones(40), lambda a: bathyal.Tracked(Q, TIPS, covariates={"t": a})),
    ("session", POINT, lambda a: bathyal.Tracked(Q, TIPS, session=a)),
    ("a", np.ones(6),
     lambda a: bathyal.Arm.from_dh(a=a, alpha=np.ones(6), d=np.ones(6), theta=np.ones(6))),
    ("aims", AIMS, lambda a: examples.write_aims(a, "aims.csv")),
    ("aims", AIMS, lambda a: figures.plan_figure(SCENE, a, PATH, title="")),
    ("aims", AIMS, lambda a: views.show_plan(SCENE, a, PATH)),
    ("q", Q[0], lambda a: arm_views.show_arm(ARM, a)),
    ("points", GRID, lambda a: vtp.write_vtp("points.vtp", a)),
    ("point_data['u']", GRID[:, 0],
     lambda a: vtp.write_vtp("points.vtp", GRID, point_data={"u": a})),
]  # fmt: skip


@pytest.mark.parametrize(("name", "values", "call"), ENTRIES)
def test_a_masked_value_is_refused_by_name(
    name: str, values: Any, call: Callable[[Any], object], tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    masked = np.ma.array(values, mask=np.zeros(np.shape(values), bool))
    masked[(-1,) * masked.ndim] = np.ma.masked
    says = f"`{name}`: expected an array without masked values, got 1 masked of {masked.size}"
    with pytest.raises(ValueError, match=f"^{re.escape(says)}$"):
        call(masked)


def test_masked_rows_in_a_list_are_refused() -> None:
    rows = [np.ma.array(row, mask=False) for row in GRID]
    assert len(bathyal.PointCloud(rows)) == len(GRID)
    rows[3][2] = np.ma.masked
    for points in (rows, tuple(rows), [*GRID[:3].tolist(), [1.0, 2.0, np.ma.masked]]):
        with pytest.raises(ValueError, match="`points`: expected an array without masked values"):
            bathyal.PointCloud(points)


def test_a_masked_array_without_a_masked_value_is_an_array() -> None:
    for mask in (np.ma.nomask, np.zeros(GRID.shape, bool)):
        cloud = bathyal.PointCloud(np.ma.array(GRID, mask=mask))
        np.testing.assert_array_equal(cloud.points, GRID)
    assert np.ma.masked_values(GRID, -9999).shape == GRID.shape
    np.testing.assert_array_equal(
        SCENE.nearest(np.ma.array(GRID + 1)).distance, SCENE.nearest(GRID + 1).distance
    )


def test_bindings_convert_arrays_in_one_place() -> None:
    """So that no new entry point forgets the masks."""
    bindings = Path(__file__).parents[3] / "cpp" / "bindings"
    for source in bindings.glob("*.[ch]pp"):
        if source.name != "arrays.cpp":
            text = source.read_text(encoding="utf-8")
            assert "array::ensure" not in text, source
            assert 'attr("asarray")' not in text, source
