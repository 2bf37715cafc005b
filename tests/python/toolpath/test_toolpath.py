# SPDX-License-Identifier: BSD-3-Clause
"""The tool path as Python sees it, in the order of the bindings: arguments, results, functions."""

import doctest
import inspect

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
import bathyal.toolpath.aims
from tests.support.bottoms import TOUR, down, grid, hills

PLANE = bathyal.Plane((0, 0, 1), -5.0)


@pytest.fixture(scope="module")
def scene():
    return bathyal.Scene(grid(hills))


# Arguments ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("function", [bathyal.find_targets, bathyal.plan_toolpath])
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"surface": grid(hills)}, "`surface`: expected a Scene or a Plane, got TriangleMesh"),
        ({"surface": None}, "`surface`"),
        ({"aims": [1, 2, 3, 0, 0, -1]}, r"`aims`.*shape \(N, 6\)"),
        ({"aims": np.zeros((2, 5))}, "`aims`"),
        ({"aims": [["a"] * 6]}, "`aims`"),
        ({"aims": np.zeros((1, 6))}, "`aims`: expected directions of a length above 0"),
        ({"aims": [[0, 0, np.nan, 0, 0, -1]]}, "`aims`: expected finite numbers, got row 0"),
        ({"world_from_vehicle": np.eye(3)}, "`world_from_vehicle`"),
        ({"world_from_vehicle": 2 * np.eye(4)}, "`world_from_vehicle`: expected a rigid motion"),
        ({"frame": "camera"}, '`frame`: expected "vehicle" or "world", got "camera"'),
        ({"vertical": "up"}, '`vertical`: expected "gravity" or "vehicle"'),
        ({"grazing_angle": 0.0}, "`grazing_angle`"),
        ({"max_range": -1.0}, "`max_range`"),
        ({"num_threads": -1}, "`num_threads`"),
    ],
)
def test_refusals_name_the_argument(function, change, message):
    arguments = {"surface": PLANE, "aims": TOUR, **change}
    surface, aims = arguments.pop("surface"), arguments.pop("aims")
    with pytest.raises(ValueError, match=message):
        function(surface, aims, **arguments)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"orientation": "smooth"}, '`orientation`: expected "blended" or "piecewise_constant"'),
        ({"offset": "round"}, '`offset`: expected "rolling" or "plain", got "round"'),
        ({"missed": "skip"}, '`missed`: expected "leave_out" or "refuse"'),
        *(
            ({name: 0.0}, f"`{name}`")
            for name in ("speed", "acceleration", "angular_rate", "blend_length")
        ),
        *(
            ({name: -1.0}, f"`{name}`")
            for name in (
                "standoff",
                "step",
                "normal_radius",
                "tool_radius",
                "tool_length",
                "contact_tolerance",
            )
        ),
        ({"tool_radius": 1.0, "tool_length": 1.0}, "`tool_length`"),
        ({"speed": float("nan")}, "`speed`"),
    ],
)
def test_plan_refuses_bad_options(change, message):
    with pytest.raises(ValueError, match=message):
        bathyal.plan_toolpath(PLANE, TOUR, **change)


def test_plan_refuses_no_aims_and_no_targets():
    with pytest.raises(ValueError, match="`aims`: expected at least one row, got none"):
        bathyal.plan_toolpath(PLANE, np.zeros((0, 6)))
    with pytest.raises(
        ValueError, match="at least one that meets the bottom, got 1 parallel, 1 behind"
    ):
        bathyal.plan_toolpath(PLANE, [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 1]])
    with pytest.raises(ValueError, match=r"2 hit, 1 behind; row 1 is the first \(behind\)"):
        bathyal.plan_toolpath(
            PLANE, np.vstack([TOUR[:1], [[0, 0, 0, 0, 0, 1]], TOUR[1:2]]), missed="refuse"
        )


@pytest.mark.parametrize(
    "aims",
    [
        TOUR.tolist(),
        TOUR.astype(np.float32),
        np.asfortranarray(TOUR),
        np.repeat(TOUR, 2, axis=0)[::2],
        np.hstack([TOUR, TOUR])[:, :6],
    ],
)
def test_any_layout_of_aims_works(scene, aims):
    path = bathyal.plan_toolpath(scene, aims)
    assert np.allclose(
        path.position[-1], bathyal.plan_toolpath(scene, TOUR).position[-1], atol=1e-5
    )


def test_read_only_aims_work(scene):
    aims = TOUR.copy()
    aims.setflags(write=False)
    assert len(bathyal.plan_toolpath(scene, aims)) == len(bathyal.plan_toolpath(scene, TOUR))


# Results ------------------------------------------------------------------------------------------


def test_targets_keep_the_contract(scene):
    aims = np.vstack([TOUR, down([[50, 50]]), [[3, 3, 0, 0, 0, 1]]])
    targets = bathyal.find_targets(scene, aims)
    count = len(aims)
    assert len(targets) == count
    assert targets.status.dtype.kind == "U"
    assert targets.status.tolist() == ["hit"] * 4 + ["miss", "behind"]
    for name in ("point", "normal", "barycentric"):
        assert getattr(targets, name).shape == (count, 3)
        assert np.isnan(getattr(targets, name)[4:]).all()
        assert np.isfinite(getattr(targets, name)[:4]).all()
    assert (targets.mesh == [0, 0, 0, 0, -1, -1]).all()
    assert (targets.triangle[4:] == -1).all()
    assert np.isinf(targets.range[4:]).all()
    hits = scene.cast(aims[:, :3], aims[:, 3:])
    assert (targets.triangle == hits.triangle).all()
    assert np.allclose(targets.barycentric.sum(axis=1)[:4], 1.0)
    mesh = scene.meshes[0]
    corners = mesh.vertices[mesh.triangles[targets.triangle[:4]]]
    u, v, w = targets.barycentric[:4].T[:, :, None]
    assert np.allclose(w * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2], targets.point[:4])
    assert np.allclose(np.cos(targets.incidence[:4]), targets.normal[:4, 2])
    assert repr(targets) == "Targets(4 of 6 found)"


@pytest.mark.parametrize("orientation", ["blended", "piecewise_constant"])
def test_paths_keep_the_contract(scene, orientation):
    path = bathyal.plan_toolpath(scene, TOUR, orientation=orientation, standoff=0.1)
    count = len(path)
    assert count > 50
    shapes = {
        "position": (3,),
        "surface": (3,),
        "approach": (3,),
        "travel": (3,),
        "side": (3,),
        "frame": (4, 4),
        "quaternion": (4,),
        "segment": (),
        "mesh": (),
        "triangle": (),
        "gap": (),
        "arc_length": (),
        "time": (),
        "normal_std": (),
        "crossing": (),
        "contact": (),
    }
    for name, tail in shapes.items():
        array = getattr(path, name)
        assert array.shape == (count, *tail), name
        assert not array.flags.writeable, name
    for name in ("segment", "mesh", "triangle"):
        assert getattr(path, name).dtype == np.int32
    for name in ("gap", "crossing", "contact"):
        assert getattr(path, name).dtype == np.bool_
    assert np.allclose(np.linalg.norm(path.position - path.surface, axis=1), 0.1, atol=1e-12)
    assert scene.nearest(path.position).distance.min() >= 0.1
    assert np.allclose(path.side, np.cross(path.approach, path.travel))
    rotation = path.frame[:, :3, :3]
    assert np.allclose(rotation, np.stack([path.travel, -path.side, -path.approach], axis=2))
    assert np.allclose(rotation @ rotation.transpose(0, 2, 1), np.eye(3))
    assert np.allclose(np.linalg.det(rotation), 1.0)
    assert np.allclose(path.frame[:, :3, 3], path.position)
    assert (path.frame[:, 3] == [0, 0, 0, 1]).all()
    x, y, z, w = path.quaternion.T
    assert np.allclose(1 - 2 * (y * y + z * z), rotation[:, 0, 0])
    assert np.allclose(2 * (x * y + z * w), rotation[:, 1, 0])
    assert (np.sum(path.quaternion[1:] * path.quaternion[:-1], axis=1) >= 0).all()
    assert (np.diff(path.time) >= 0).all()
    assert (np.diff(path.segment) >= 0).all()
    assert set(path.segment) == {0, 1, 2}
    assert path.targets.status.tolist() == ["hit"] * 4
    assert isinstance(path.warnings, list)


def test_arrays_outlive_their_path(scene):
    position = bathyal.plan_toolpath(scene, TOUR).position
    points = bathyal.plan_toolpath(scene, TOUR).targets.point
    assert np.isfinite(position).all()
    assert np.allclose(position[0], points[0])


def test_a_path_says_what_it_is_in_one_line():
    assert repr(bathyal.plan_toolpath(PLANE, down([[0, 0], [2, 0]]))) == (
        "ToolPath(2 samples, 2.000 m, 21.0 s)"
    )


def test_write_and_show_hand_the_path_on(monkeypatch):
    calls = []
    for function in ("bathyal.toolpath.paths.write_path", "bathyal.view.scene3d.show_path"):
        monkeypatch.setattr(function, lambda *arguments: calls.append(arguments) or "shown")
    path = bathyal.plan_toolpath(PLANE, TOUR)
    assert path.write("path.csv") is None
    assert path.show() == "shown"
    assert calls == [(path, "path.csv"), (path,)]


# Functions ----------------------------------------------------------------------------------------


def test_aims_of_a_vehicle_are_moved_by_its_pose(scene):
    turn = np.array([[0.8, -0.6, 0, 3], [0.6, 0.8, 0, 1], [0, 0, 1, 20], [0, 0, 0, 1]])
    own = np.hstack([(TOUR[:, :3] - turn[:3, 3]) @ turn[:3, :3], TOUR[:, 3:] @ turn[:3, :3]])
    there = bathyal.plan_toolpath(scene, own, world_from_vehicle=turn)
    here = bathyal.plan_toolpath(scene, TOUR)
    assert np.allclose(there.position, here.position)
    world = bathyal.plan_toolpath(scene, TOUR, world_from_vehicle=turn, frame="world")
    assert (world.position == here.position).all()


@settings(max_examples=20, deadline=None)
@given(
    angle=st.floats(-3, 3),
    shift=st.tuples(*[st.floats(-1e6, 1e6)] * 2, st.floats(-100, 100)),
    seed=st.integers(0, 2**31),
)
def test_a_rigid_motion_about_z_moves_the_path(angle, shift, seed):
    rng = np.random.default_rng(seed)
    rotation = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    shift = np.round(shift)
    aims = down(rng.uniform(0.3, 5.7, (4, 2)))
    mesh = grid(hills, cells=12)
    moved = bathyal.TriangleMesh(mesh.vertices @ rotation.T + shift, mesh.triangles)
    aims_moved = np.hstack([aims[:, :3] @ rotation.T + shift, aims[:, 3:] @ rotation.T])
    here = bathyal.plan_toolpath(bathyal.Scene(mesh), aims, orientation="piecewise_constant")
    there = bathyal.plan_toolpath(
        bathyal.Scene(moved), aims_moved, orientation="piecewise_constant"
    )
    assert np.isclose(here.arc_length[-1], there.arc_length[-1], atol=1e-6)
    for j in range(0, len(here), 7):
        expected = rotation @ here.position[j] + shift
        assert np.linalg.norm(there.position - expected, axis=1).min() < 1e-6


@settings(max_examples=20, deadline=None)
@given(
    seed=st.integers(0, 2**31),
    roughness=st.floats(0, 0.2),
    standoff=st.floats(0, 0.3),
    rate=st.floats(0.05, 2),
    blend=st.floats(0.02, 0.5),
)
def test_limits_hold_between_any_two_samples(seed, roughness, standoff, rate, blend):
    rng = np.random.default_rng(seed)
    scene = bathyal.Scene(grid(lambda x, y: roughness * rng.standard_normal(x.shape), cells=20))
    aims = down(rng.uniform(0.3, 5.7, (4, 2)))
    path = bathyal.plan_toolpath(
        scene, aims, standoff=standoff, angular_rate=rate, blend_length=blend, speed=0.2
    )
    step = np.diff(path.time)
    moved = np.linalg.norm(np.diff(path.position, axis=0), axis=1)
    dot = np.abs(np.sum(path.quaternion[1:] * path.quaternion[:-1], axis=1))
    turned = 2 * np.arccos(np.clip(dot, 0, 1))
    assert (moved <= 0.2 * step * (1 + 1e-6) + 1e-9).all()
    assert (turned <= rate * step * (1 + 1e-6) + 1e-7).all()  # arccos near 1 keeps half the digits


def test_a_gap_is_flagged_and_nothing_is_claimed_over_it():
    mesh = grid(hills, cells=12, keep=lambda c, r: (c < 4) | (c > 6))
    path = bathyal.plan_toolpath(bathyal.Scene(mesh), down([[0.5, 3.1], [5.5, 3.1]]), step=0.1)
    assert path.gap.sum() == 1
    j = int(np.flatnonzero(path.gap)[0])
    assert np.allclose(path.surface[[j, j + 1], 0], [2.0, 3.5])
    inside = (path.surface[:, 0] > 2.0 + 1e-9) & (path.surface[:, 0] < 3.5 - 1e-9)
    assert not inside.any()
    assert path.warnings == ["segment 0 crosses a gap"]


def test_a_path_over_utm_coordinates_keeps_millimetres():
    shift = np.array([620152.0, 7246504.0, -52.0])
    here = bathyal.plan_toolpath(bathyal.Scene(grid(hills)), TOUR)
    there = bathyal.plan_toolpath(
        bathyal.Scene(grid(hills, shift=shift)), TOUR + np.concatenate([shift, np.zeros(3)])
    )
    assert len(here) == len(there)
    assert np.abs(there.position - shift - here.position).max() < 1e-6
    assert np.abs(there.approach - here.approach).max() < 1e-4


def test_ten_thousand_aims(scene):
    rng = np.random.default_rng(5)
    path = bathyal.plan_toolpath(scene, down(rng.uniform(0.1, 5.9, (10_000, 2))), blend_length=0.02)
    assert path.segment[-1] == 9998
    assert np.isfinite(path.time).all()


def test_coverage_is_walked_without_a_gap(scene):
    polygon = np.array([[0.5, 0.5], [5.5, 0.7], [5.2, 5.4], [3.0, 2.5], [0.7, 5.3]])
    aims = bathyal.cover_polygon(scene, polygon, 0.4, direction=0.3, margin=0.1)
    assert aims.shape[1] == 6
    path = bathyal.plan_toolpath(scene, aims)
    assert (path.targets.status == "hit").all()
    assert not path.gap.any()
    with pytest.raises(ValueError, match="`polygon`"):
        bathyal.cover_polygon(scene, polygon[:2], 0.4)
    with pytest.raises(ValueError, match="`spacing`"):
        bathyal.cover_polygon(scene, polygon, 0.0)


def test_arguments_are_keywords_with_the_engines_defaults():
    text = bathyal.plan_toolpath.__doc__.splitlines()[0]
    assert "*, world_from_vehicle" in text
    assert "angular_rate: " in text
    assert "= 0.5" in text


def test_examples_in_the_docs():
    runner = doctest.DocTestRunner()
    for thing in (
        bathyal.find_targets,
        bathyal.plan_toolpath,
        bathyal.cover_polygon,
        bathyal.read_aims,
    ):
        text = inspect.getdoc(thing)
        assert ">>>" in text
        test = doctest.DocTestParser().get_doctest(text, {}, thing.__name__, None, 0)
        assert runner.run(test).failed == 0
