# SPDX-License-Identifier: BSD-3-Clause
"""Mass, inertia and volume of a body, and what no body has."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import bathyal
from tests.support.urdf_cases import joint, links, read_text, robot

NUMBERS = {
    "mass": 2.0,
    "center_of_mass": (0.1, 0.2, 0.3),
    "inertia": np.diag([0.1, 0.2, 0.25]),
    "volume": 1e-3,
    "center_of_buoyancy": (0.0, 0.1, 0.2),
}

BAD = [
    *[({"mass": bad}, "`mass`: expected a finite") for bad in (-1.0, np.nan, np.inf, -np.inf)],
    *[({"volume": bad}, "`volume`: expected a finite") for bad in (-1e-9, np.nan, np.inf)],
    ({"inertia": np.full((3, 3), np.nan)}, "`inertia`: expected finite"),
    ({"inertia": [[1, 1, 0], [0, 1, 0], [0, 0, 1]]}, "`inertia`: expected a symmetric"),
    ({"inertia": np.diag([-1, 1, 1])}, "`inertia`: expected principal moments"),
    ({"inertia": -np.eye(3)}, "`inertia`: expected"),
    ({"inertia": np.diag([1, 1, 3])}, "`inertia`: expected principal moments .*1, 1 and 3"),
]


@pytest.mark.parametrize("make", [bathyal.RigidBody, bathyal.Link])
@pytest.mark.parametrize(("numbers", "says"), BAD)
def test_what_no_body_has_is_refused(make, numbers, says) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(ValueError, match=says):
        make(**numbers)


def test_a_link_has_a_body() -> None:
    link, body = bathyal.Link("hand", **NUMBERS), bathyal.RigidBody(**NUMBERS)
    for name in NUMBERS:
        np.testing.assert_array_equal(getattr(link, name), NUMBERS[name])
        np.testing.assert_array_equal(getattr(link.body, name), getattr(body, name))


def test_copies_are_whole() -> None:
    body = bathyal.RigidBody(**NUMBERS)
    for other in (copy.deepcopy(body), pickle.loads(pickle.dumps(body))):
        for name in NUMBERS:
            np.testing.assert_array_equal(getattr(other, name), getattr(body, name))


def test_two_bodies_turn_about_any_axis_as_one() -> None:
    body = bathyal.RigidBody(**NUMBERS)
    pose = np.array([[0, -1, 0, 0.5], [1, 0, 0, -0.2], [0, 0, 1, 0.1], [0, 0, 0, 1.0]])
    moved = body.in_frame(pose)
    whole = body.combined(moved)

    def about_the_origin(b: bathyal.RigidBody) -> np.ndarray:
        c = b.center_of_mass
        return b.inertia + b.mass * (c @ c * np.eye(3) - np.outer(c, c))

    assert whole.mass == 4.0
    assert whole.volume == 2e-3
    np.testing.assert_allclose(
        about_the_origin(whole), about_the_origin(body) + about_the_origin(moved), atol=1e-15
    )
    with pytest.raises(ValueError, match="`pose`: expected a rigid motion"):
        body.in_frame(np.diag([2, 1, 1, 1]))


INERTIAL = (
    '<link name="hand"><inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="{}"/></inertial></link>'
)


def test_a_urdf_with_an_inertia_that_no_body_has_is_refused(tmp_path: Path) -> None:
    text = robot(links("foot"), INERTIAL, joint("wrist", "foot", "hand"))
    assert read_text(tmp_path, text.format(2)).links[1].mass == 1.0
    with pytest.raises(bathyal.Error, match="`link hand inertia`: expected principal moments"):
        read_text(tmp_path, text.format(3))


def test_a_json_with_a_mass_that_no_body_has_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "arm.json"
    bathyal.arms.reach_alpha_5().save(path)
    content = json.loads(path.read_text())
    content["links"][1] |= {"mass_kg": 1.0, "inertia_kg_m2": np.diag([1, 1, 3]).tolist()}
    path.write_text(json.dumps(content))
    with pytest.raises(bathyal.Error, match="inertia`: expected principal moments"):
        bathyal.read_arm(path)
