# SPDX-License-Identifier: BSD-3-Clause
"""Camera axes from files: what is read, and what is refused with which line."""

import json
import math

import numpy as np
import pytest

import bathyal

POSE = np.array([[0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, -30], [0, 0, 0, 1]], dtype=float)


@pytest.fixture
def write(tmp_path):
    def write_file(text, name="aims.csv"):
        path = tmp_path / name
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text if isinstance(text, str) else json.dumps(text), encoding="utf-8")
        return path

    return write_file


@pytest.mark.parametrize(
    "text",
    [
        "px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0.6,-0.8\n",
        "px [m],py [m],pz [m],dx,dy,dz\n1,2,3,0,0.6,-0.8\n",
        "px(m);py(m);pz(m);dx;dy;dz\n1;2;3;0;0.6;-0.8\n",
        "px_mm\tpy_cm\tpz_km\tdx\tdy\tdz\n1000\t200\t0.003\t0\t0.6\t-0.8\n",
        "px [m] py [m]  pz [m] dx dy dz\n1 2 3 0 0.6 -0.8\n",
        "px,py,pz,dx,dy,dz\n1,2,3,0,0.6,-0.8\n",
        "# a comment\n\nname,dz,dy,dx,pz_m,py_m,px_m\n\n# more\nfirst,-0.8,0.6,0,3,2,1\n",
        "\ufeffPX_M,PY_M,PZ_M,DX,DY,DZ\r\n1, 2, 3, 0, 0.6, -0.8\r\n",
        '"px_m","py_m","pz_m","dx","dy","dz"\n1,2,3,0,0.6,-0.8',
    ],
)
def test_text_headers_say_names_units_and_order(write, text):
    assert np.allclose(bathyal.read_aims(write(text)), [[1, 2, 3, 0, 0.6, -0.8]], atol=1e-15)


def test_pan_turns_from_x_to_y_and_tilt_rises(write):
    text = (
        "px_m,py_m,pz_m,pan_deg,tilt_rad\n0,0,0,90,0\n0,0,0,0,-1.5707963267948966\n0,0,0,180,0.5\n"
    )
    expected = [[0, 1, 0], [0, 0, -1], [-math.cos(0.5), 0, math.sin(0.5)]]
    assert np.allclose(bathyal.read_aims(write(text))[:, 3:], expected, atol=1e-15)


def test_a_header_alone_gives_no_aims(write):
    assert bathyal.read_aims(write("px_m,py_m,pz_m,dx,dy,dz\n")).shape == (0, 6)
    assert bathyal.read_aims(write([], "aims.json")).shape == (0, 6)


def test_text_is_in_the_vehicles_frame_when_a_pose_is_given(write):
    path = write("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,1,0,-1\n")
    assert np.allclose(bathyal.read_aims(path, world_from_vehicle=POSE), [[8, 21, -27, 0, 1, -1]])


@pytest.mark.parametrize(
    "content",
    [
        [[1, 2, 3, 0, 0.6, -0.8]],
        [{"point": [1, 2, 3], "direction": [0, 0.6, -0.8]}],
        {"aims": [[1000, 2000, 3000, 0, 0.6, -0.8]], "unit": "mm", "frame": "world"},
        {
            "aims": [[-18, 9, 33, 0.6, 0, -0.8]],
            "frame": "vehicle",
            "world_from_vehicle": POSE.tolist(),
        },
        {"aims": [[-18, 9, 33, 0.6, 0, -0.8]], "world_from_vehicle": POSE.tolist()},
    ],
)
def test_json_says_unit_frame_and_pose(write, content):
    assert np.allclose(bathyal.read_aims(write(content, "aims.json")), [[1, 2, 3, 0, 0.6, -0.8]])


def test_a_given_pose_serves_aims_of_the_vehicle_and_leaves_those_of_the_world(write):
    row = [[1, 2, 3, 1, 0, -1]]
    moved = [[8, 21, -27, 0, 1, -1]]

    def read(content):
        return bathyal.read_aims(write(content, "aims.json"), world_from_vehicle=POSE)

    assert np.allclose(read(row), moved)
    assert np.allclose(read({"aims": row, "frame": "vehicle"}), moved)
    assert np.allclose(read({"aims": row, "frame": "world"}), row)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("\n", "line 1: expected a header"),
        ("1,2,3,0,0,-1\n", "line 1: expected a header"),
        ("px_m,py_m,pz_m,dx,dy\n1,2,3,0,0\n", "line 1.*none for dz"),
        (
            "px_m,py_m,pz_ft,dx,dy,dz\n",
            "line 1: `pz_ft`: expected a unit among m, cm, mm, km, got ft",
        ),
        ("px_m,px_m,py_m,pz_m,dx,dy,dz\n", "`px_m`: expected each column once"),
        ("px_m,py_m,pz_m,pan,tilt\n", "`pan`: expected a unit among deg, rad, got none"),
        ("px_m,py_m,pz_m,dx_m,dy,dz\n", "`dx_m`"),
        ("# c\npx_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0,-1\n\n1,2,x,0,0,-1\n", "line 5: `pz_m`.*got x"),
        ("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0\n", "line 2: `dz`.*got nothing"),
        ("px_m;py_m;pz_m;dx;dy;dz\n1,5;2;3;0;0;-1\n", "line 2: `px_m`.*got 1,5"),
        ("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0,-1\n1,2,nan,0,0,-1\n", "line 3: expected finite"),
        ("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0,0\n", "line 2: expected a direction"),
        (b"px_m,py_m\xff\xfe\x00", "expected text"),
    ],
)
def test_broken_text_is_refused_with_its_line(write, text, message):
    with pytest.raises(bathyal.Error, match=message):
        bathyal.read_aims(write(text))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "the file is empty"),
        (" ", "line 1: not JSON"),
        ('[[1, 2,\n3, 0, 0 "a"]]', "line 2: not JSON"),
        ("[" * 100000, "not JSON"),
        ({"aims": 3}, "`aims`: expected a list, got int"),
        ({}, "`aims`: expected a list"),
        ("3", "`aims`: expected a list, got int"),
        ([[1, 2, 3, 0, 0]], "aim 0: expected six numbers"),
        ([[1, 2, 3, 0, 0, -1], [1, 2, 3, 0, 0, "x"]], "aim 1: expected six numbers"),
        ([[1, 2, 3, 0, 0, True]], r"`aims\[0\]\[5\]`: expected a number"),
        ([{"point": [1, 2], "direction": [0, 0, 1]}], "aim 0: expected six numbers"),
        ("[[1, 2, 3, 0, 0, NaN]]", "aim 0: expected finite"),
        ([[1, 2, 3, 0, 0, 0]], "aim 0: expected a direction"),
        ({"aims": [], "unit": "ft"}, "`unit`: expected one of m, cm, mm, km, got 'ft'"),
        ({"aims": [], "frame": "camera"}, "`frame`"),
        ({"aims": [[1, 2, 3, 0, 0, 1]], "frame": "vehicle"}, "`world_from_vehicle`: expected"),
        (
            {"aims": [], "world_from_vehicle": [[1, 0], [0, 1]]},
            "`world_from_vehicle`: expected shape",
        ),
    ],
)
def test_broken_json_is_refused(write, content, message):
    with pytest.raises(bathyal.Error, match=message):
        bathyal.read_aims(write(content, "aims.json"))


def test_the_callers_mistakes(write, tmp_path):
    path = write("px_m,py_m,pz_m,dx,dy,dz\n1,2,3,0,0,-1\n")
    with pytest.raises(FileNotFoundError):
        bathyal.read_aims(tmp_path / "absent.csv")
    with pytest.raises(ValueError, match=r"`path`: expected a \.csv"):
        bathyal.read_aims(write("", "aims.xlsx"))
    for pose in (
        np.eye(3),
        np.diag([2.0, 1, 1, 1]),
        np.diag([-1.0, 1, 1, 1]),
        "pose",
        np.full((4, 4), np.nan),
    ):
        with pytest.raises(ValueError, match="`world_from_vehicle`"):
            bathyal.read_aims(path, world_from_vehicle=pose)
