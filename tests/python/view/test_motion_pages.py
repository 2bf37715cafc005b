# SPDX-License-Identifier: BSD-3-Clause
"""A motion as a page that plays it and as pictures: what is drawn is where the engine says."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pytest
from matplotlib.image import imread

import bathyal
from bathyal.view.motion import AT_REST, Body, Light, Motion, Panel, frames_of
from bathyal.view.motion_frames import moments_of, motion_sheet, write_frames
from bathyal.view.motion_page import LIGHTS, motion_page
from bathyal.view.render import Camera, Drawn, Stage
from bathyal.view.solids import ball, box, capsule, cone, patch, prism
from bathyal.workspace.example import write_example
from bathyal.workspace.motion import Phase, keepout_mesh, motion_of


@pytest.fixture(scope="module")
def scenario(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scene")
    write_example(folder)
    return bathyal.read_scenario(folder / "scenario.yaml")


@pytest.fixture(scope="module")
def path(scenario):
    """From the start to the target, its tip on the bottom at last: 60 rows in 6 s."""
    end = scenario.workspace.check_target(scenario.targets).q[0]
    share = np.linspace(0, 1, 60)[:, None]
    return scenario.q_start + share * (end - scenario.q_start), np.linspace(0, 6, 60)


@pytest.fixture(scope="module")
def motion(scenario, path):
    return motion_of(
        scenario.workspace, *path, target=scenario.targets[0], title="A </script> & <b>",
        wrench=np.column_stack([np.arange(60) * k for k in range(6)]),
        phases=[Phase("approach", 0, 3), Phase("press", 3, 6, contact=True)],
    )  # fmt: skip


def data_of(page):
    text = re.search(r"^const motion = (.*);$", page, re.MULTILINE)[1]
    return json.loads(text)


def unpacked(text):
    return np.frombuffer(base64.b64decode(text), "<f4")


def test_what_moves_on_the_page_is_where_the_engine_places_it(scenario, path, motion):
    data = data_of(motion_page(motion))
    poses = unpacked(data["poses"]).reshape(60, data["carriers"], 12).astype(float)
    (moving,) = data["moving"]
    vertices = unpacked(moving["vertices"]).reshape(-1, 3).astype(float)
    assert sum(count for _, count in moving["carrier"]) == len(vertices)
    frame = 37
    capsules = scenario.workspace.place_capsules(path[0][frame])
    world_from_vehicle = scenario.workspace.vehicle_pose.at(0.0)
    first = 0
    for (carrier, count), one in zip(moving["carrier"], capsules, strict=True):
        pose = poses[frame, carrier]
        own = vertices[first : first + count] @ pose[:9].reshape(3, 3).T + pose[9:] + data["origin"]
        first += count
        start, end = (one[k : k + 3] + world_from_vehicle[:3, 3] for k in (0, 3))
        share = np.clip((own - start) @ (end - start) / np.sum((end - start) ** 2), 0, 1)
        away = np.linalg.norm(own - start - share[:, None] * (end - start), axis=1)
        np.testing.assert_allclose(away, one[6], atol=2e-5)
    assert first == len(vertices)


def test_the_page_needs_no_network_and_is_the_same_twice(motion):
    page = motion_page(motion)
    assert page == motion_page(motion)
    assert not re.search(r"<script[^>]+src=|<link\b|@import|<img[^>]+src=.http", page)
    assert "<title>A &lt;/script&gt; &amp; &lt;b&gt;</title>" in page
    assert page.count("<head>\n") == 1
    assert len(page) < 8_000_000


def test_lights_show_target_and_clearance(scenario, path, motion):
    target, clearance = motion.lights
    assert set(target.state) == {"go"}
    assert target.text[0] == "target free"
    near = scenario.workspace.clearance(path[0]).distance
    touching = scenario.workspace.clearance(path[0], tip_contact=True).distance
    states = np.array(clearance.state)
    before, after = path[1] < 3, path[1] >= 3
    assert near[-1] < 0 < touching[-1]
    np.testing.assert_array_equal(states[before] == "stop", near[before] < 0)
    np.testing.assert_array_equal(states[after] == "stop", touching[after] < 0)
    assert clearance.text[-1].endswith(", tool may touch")
    blind = motion_of(scenario.workspace, *path, target=scenario.targets[0])
    assert blind.lights[1].state[-1] == "stop"
    inside = motion_of(scenario.workspace, *path, target=[0.2, 0, -50.2])
    assert inside.lights[0].state[0] == "stop"
    assert inside.lights[0].text[0] == "target inside the hull"
    assert set(LIGHTS) == {"go", "caution", "stop"}


def test_curves_are_those_of_the_motion(path, motion):
    joints, clearance, force, moment = motion.panels
    np.testing.assert_allclose(joints.curves["joint_2"], np.degrees(path[0][:, 1]))
    assert list(clearance.curves) == ["nearest", "own links"]
    np.testing.assert_array_equal(force.curves["y"], np.arange(60))
    np.testing.assert_array_equal(moment.curves["pitch (y)"], 4 * np.arange(60))
    assert motion.phase_at(3.0) == "approach"
    assert [motion.row_at(moment) for moment in (-1, 0, 0.1, 3, 6, 7)] == [0, 0, 0, 29, 59, 59]
    assert motion.phase_at(6.0) == "press"


def test_a_vehicle_that_moves_takes_hull_and_arm_along(scenario, path):
    pose = np.stack([np.eye(4), np.eye(4)])
    pose[:, :3, 3] = [[0, 0, -50.2], [1, 0, -50.2]]
    moved = scenario.workspace.with_vehicle_pose(bathyal.Trajectory([0, 6], pose))
    motion = motion_of(moved, *path)
    hull = next(body for body in motion.bodies if body.kind == "hull")
    assert hull.carrier != AT_REST
    shift = motion.world_vertices(hull, 59) - motion.world_vertices(hull, 0)
    np.testing.assert_allclose(shift, np.broadcast_to([1, 0, 0], shift.shape), atol=1e-12)
    assert len(data_of(motion_page(motion))["moving"]) == 2  # and the beam, which is glass


def test_long_motions_are_thinned_and_bad_ones_refused(scenario, path):
    q, time = path
    assert len(motion_of(scenario.workspace, q, time, most_frames=7).time) == 7
    assert frames_of(np.array([0.0, 0.1, 5, 6]), 3).tolist() == [0, 2, 3]
    with pytest.raises(ValueError, match=r"`time`: expected one for each of 60 rows, got 59"):
        motion_of(scenario.workspace, q, time[1:])


@pytest.mark.parametrize(
    ("keepout", "inside"),
    [
        (bathyal.KeepOut.sphere(0.3, (1, 2, 3)), (1, 2, 3)),
        (bathyal.KeepOut.box((1, 2, 3)), (0, 0, 0)),
        (bathyal.KeepOut.cylinder(0.2, 1.0), (0, 0, 0)),
        (bathyal.KeepOut.cone(1.0, angle=1.0), (0, 0, 0.5)),
    ],
)
def test_keep_outs_are_drawn_where_they_are(keepout, inside):
    mesh = bathyal.TriangleMesh(*keepout_mesh(keepout, 1.0))
    hull = bathyal.Hull(mesh)
    assert hull.report.closed
    assert hull.contains([inside])[0]
    distance = keepout.distance(mesh.vertices)
    assert np.abs(distance).max() < 1e-9


def test_half_spaces_are_drawn_as_a_square_of_their_border():
    keepout = bathyal.KeepOut.half_space((0, 0, 1), point=(0, 0, -2))
    vertices, triangles = keepout_mesh(keepout, 3.0)
    np.testing.assert_allclose(vertices[:, 2], -2)
    assert triangles.shape == (2, 3)


@pytest.mark.parametrize(
    ("mesh", "volume"),
    [
        (box(np.array([1.0, 2, 3])), 6.0),
        (ball(np.zeros(3), 1.0), 4.19),
        (capsule(np.zeros(3), np.array([0, 0, 2.0]), 0.5), 2.09),
        (prism(np.zeros(3), np.array([0, 2.0, 0]), 0.5), 1.57),
        (cone(np.zeros(3), np.array([2.0, 0, 0]), 0.5), 0.52),
    ],
    ids=["box", "ball", "capsule", "prism", "cone"],
)
def test_solids_are_closed_with_normals_outwards(mesh, volume):
    report = bathyal.Hull(bathyal.TriangleMesh(*mesh)).report
    assert report.closed
    assert not report.inside_out
    assert report.volume == pytest.approx(volume, rel=0.05)


def looked_at(bodies, moving=()):
    camera = Camera(np.array([0.0, -10, 0]), np.zeros(3), 0.5)
    return Stage(bodies, camera, (60, 40)).picture(moving)


def test_near_bodies_hide_far_ones_and_glass_lets_them_through():
    red = Drawn(*ball(np.array([0, 0, 0.0]), 1.0), "#ff0000")
    blue = Drawn(*ball(np.array([0, -3.0, 0]), 0.5), "#0000ff")
    picture = looked_at([red])
    assert picture.shape == (40, 60, 3)
    assert picture[20, 30, 0] > 100 > picture[20, 30, 2]
    assert picture[0, 0].min() > 200  # the water behind
    assert looked_at([red], [blue])[20, 30, 2] > 100 > looked_at([red], [blue])[20, 30, 0]
    glass = Drawn(blue.vertices, blue.triangles, "#0000ff", opacity=0.4)
    mixed = looked_at([red, glass])[20, 30].astype(int)
    assert mixed[0] > 50
    assert mixed[2] > 50
    np.testing.assert_array_equal(looked_at([red], [glass]), looked_at([red, glass]))


def test_bodies_cast_shadows():
    floor = Drawn(*patch(np.array([0, 0, -1.0]), np.array([0, 0, 1.0]), 6.0), "#ffffff")
    roof = Drawn(*patch(np.array([0, 0, 3.0]), np.array([0, 0, 1.0]), 9.0), "#ffffff")
    lit, dark = looked_at([floor])[32, 30], looked_at([floor, roof])[32, 30]
    assert lit.min() > dark.max() + 30
    np.testing.assert_array_equal(looked_at([floor], [roof]), looked_at([floor, roof]))
    np.testing.assert_array_equal(looked_at([roof], [floor]), looked_at([floor, roof]))


def test_frames_and_the_sheet_are_written(motion, tmp_path):
    files = write_frames(motion, tmp_path / "frames", count=3, size=(160, 100))
    assert [file.name for file in files] == ["0001.png", "0002.png", "0003.png"]
    pictures = [imread(file) for file in files]
    assert pictures[0].shape[:2] == (146, 160)
    assert not np.array_equal(pictures[0][:100], pictures[2][:100])
    with pytest.raises(ValueError, match="`count`: expected 1 to 999, got 0"):
        write_frames(motion, tmp_path, count=0)
    sheet = motion_sheet(motion)
    assert len(sheet.axes) == 6 + 4
    assert len(moments_of(motion, 6)) == 6
    phases = [(name, k, k + 1) for k, name in enumerate("abcde")]
    assert moments_of(Motion(**{**vars(motion), "phases": phases}), 6) == [0, 9, 19, 29, 39, 49]


def test_a_motion_of_no_body_and_one_frame_is_drawn():
    body = Body("hull", "hull", *box(np.ones(3)), colour="#d9a521")
    light = Light("clearance", ["go"], ["clear"])
    motion = Motion(
        np.zeros(1),
        np.zeros((1, 0, 4, 4)),
        [body],
        [Panel("a", {"b": np.zeros(1)})],
        lights=[light],
    )
    data = data_of(motion_page(motion))
    assert data["moving"] == []
    assert data["time"] == [0.0]
