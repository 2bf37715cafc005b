# SPDX-License-Identifier: BSD-3-Clause
"""The room soundings as Python sees it: readers, writers, cleaning, generated surveys."""

from __future__ import annotations

import inspect
import math
import os
import struct
import subprocess
import sys
import threading
from pathlib import Path

import bathyal
import numpy as np
import pytest
from bathyal import _core
from hypothesis import given, settings
from hypothesis import strategies as st

DATA = Path(__file__).resolve().parents[2] / ".." / "shared" / "data"

finite = st.floats(allow_nan=False, allow_infinity=False)
tables = st.integers(1, 5).flatmap(
    lambda width: st.lists(
        st.lists(finite, min_size=width, max_size=width), min_size=1, max_size=20
    )
)


@pytest.fixture
def write(tmp_path: Path):
    def write_file(content: str | bytes, name: str = "f.xyz") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write_file


# Text tables


@settings(max_examples=200, deadline=None)
@given(
    rows=tables,
    separator=st.sampled_from([" ", ",", ";", "\t", " , ", "  ", "\t "]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    last=st.booleans(),
    style=st.sampled_from(["{!r}", '"{!r}"', "{:+.17e}"]),
)
def test_text_reads_back_what_python_wrote(tmp_path_factory, rows, separator, end, last, style):
    if len(rows[0]) == 1 and separator.strip(" ") in (",", ";", "\t"):
        separator = " "
    text = end.join(separator.join(style.format(v) for v in row) for row in rows)
    path = tmp_path_factory.mktemp("text") / "f.txt"
    path.write_bytes((text + (end if last else "")).encode())
    table = _core.read_text_table(path).table
    expected = np.array(rows)
    np.testing.assert_array_equal(table.view(np.uint64), expected.view(np.uint64))


@settings(max_examples=100, deadline=None)
@given(text=st.text(alphabet="0123456789.eE+-,;\t nan\n\r\"'#x", max_size=60))
def test_any_text_gives_numbers_or_an_error(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("text") / "f.txt"
    path.write_bytes(text.encode())
    try:
        table = _core.read_text_table(path)
    except bathyal.Error as error:
        assert str(path) in str(error)
    else:
        assert table.table.shape == (len(table), table.table.shape[1])
        assert len(table) > 0


def test_leading_columns_lie_in_one_array_and_the_rest_in_their_own(write):
    path = write("x,y,z,u,i\n1,2,3,.1,7\n4,5,6,.2,8\n")
    table = _core.read_text_table(path, leading=3)
    np.testing.assert_array_equal(table.table, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_array_equal(table.extra, [[0.1, 0.2], [7, 8]])
    assert table.names == ["x", "y", "z", "u", "i"]
    assert (table.separator, table.decimal, table.grid) == (",", ".", False)
    assert not table.table.flags.writeable
    cloud = bathyal.PointCloud(table.table)
    assert np.shares_memory(cloud.points, table.table)


def test_columns_are_chosen_by_index_and_name(write):
    path = write("id;East;North;Depth\nP1;1,5;2;3\nP2;4;5;6,25\n")
    table = _core.read_text_table(path, columns=["depth", 1], decimal=",")
    np.testing.assert_array_equal(table.table, [[3, 1.5], [6.25, 4]])
    assert table.names == ["Depth", "East"]
    with pytest.raises(ValueError, match=r"`columns`: expected one of .*\"East\".*got \"z\""):
        _core.read_text_table(path, columns=["z"])
    with pytest.raises(ValueError, match="indices below 4, got 4"):
        _core.read_text_table(path, columns=[4], header_lines=1)


MALFORMED = {
    "empty": (b"", "the file is empty"),
    "blank": (b"\n\n   \n", "no row of numbers in 3 lines"),
    "comments": (b"# a\n// b\n", "no row of numbers"),
    "words": (b"the quick brown fox\n", "1 look like a header"),
    "short row": (b"1 2 3\n4 5\n", r":2: expected 3 columns, got 2"),
    "long row": (b"1,2,3\n4,5,6\n7,8,9,10\n", r":3: expected 3 columns, got 4"),
    "word in row": (b"1 2 3\n4 five 6\n", r":2: expected a number in column 1, got \"five\""),
    "empty field": (b"1,2,3\n4,,6\n", r":2: expected a number in column 1.*empty_is_nan"),
    "hex": (b"1 2 3\n0x1F 2 3\n", r":2: .*0x1F"),
    "two points": (b"1 2 3\n1.2.3 2 3\n", r":2: .*1\.2\.3"),
    "bare sign": (b"1 2 3\n- 2 3\n", r":2: "),
    "bare exponent": (b"1 2 3\n1e 2 3\n", r":2: "),
    "thousands": (b"1,234;5,678\n", r":1: .*say which with `decimal`"),
    "mixed separators": (b"1 2,3\n4 5,6\n", r":1: "),
    "open quote": (b'1,2\n"3,4\n', r":2: a quote"),
    "png": (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", r"not text: byte \\x1a at offset 6"),
    "zeros": (b"\0" * 100, r"not text: byte \\x00 at offset 0"),
    "binary later": (b"1 2 3\n" * 20000 + b"\0\0\n", r":20001: not text.*at offset 120000"),
    "utf-16": ("1 2 3\n".encode("utf-16"), "UTF-16"),
    "gzip": (b"\x1f\x8b\x08\x00abc", r"not text: byte \\x1f at offset 0"),
    "cyrillic": ("1 2 3\n4 5 шесть\n".encode(), r":2: .*got \"шесть\""),
    "latin-1": (b"1 2 3\n4 5 \xe9\n", r":2: .*\\xe9"),
    "long line": (b"1 2\n3" + b" " * 2_000_000 + b"4\n", r":2: a line of more than 1 MiB"),
    "long number": (b"1 2\n" + b"9" * 2_000_000 + b" 4\n", r":2: a line of more than 1 MiB"),
    "no line end": (b"1" * 6_000_000, r":1: a line of more than 1 MiB"),
    "grid, short": (
        b"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n",
        "3 numbers for 2 × 2 cells",
    ),
    "grid, long": (
        b"ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n",
        "more numbers than",
    ),
    "grid, huge": (
        b"ncols 2000000000\nnrows 2000000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
        "1 numbers for",
    ),
    "grid, no corner": (b"ncols 1\nnrows 1\ncellsize 1\n1\n", "lacks xllcorner"),
    "grid, negative": (
        b"ncols -1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
        "ncols is -1",
    ),
    "grid, nan": (b"ncols nan\nnrows 1\n1\n", "ncols is not finite"),
    "grid, no data": (
        b"ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n-9999\n",
        "no cell of the grid has a value",
    ),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_malformed_text_is_refused_with_path_and_line(write, name):
    content, pattern = MALFORMED[name]
    path = write(content)
    with pytest.raises(bathyal.Error, match=pattern) as error:
        _core.read_text_table(path)
    assert str(error.value).startswith(str(path))


def test_paths_that_cannot_be_read_are_named(tmp_path):
    missing = tmp_path / "глубины.xyz"
    with pytest.raises(bathyal.Error, match=r"глубины\.xyz: No such file"):
        _core.read_text_table(missing)
    with pytest.raises(bathyal.Error, match="Is a directory"):
        _core.read_text_table(tmp_path)
    with pytest.raises(bathyal.Error, match=r"\\xff: No such file"):
        _core.read_text_table(os.fsencode(tmp_path) + b"/\xff")
    with pytest.raises(TypeError):
        _core.read_text_table(None)
    locked = tmp_path / "locked.xyz"
    locked.write_text("1 2 3\n")
    locked.chmod(0)
    if os.geteuid() != 0:
        with pytest.raises(bathyal.Error, match="Permission denied"):
            _core.read_text_table(locked)


def test_a_pipe_is_read_as_a_file_is(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    content = b"".join(b"%d %d.5\n" % (i, i) for i in range(600_000))
    writer = threading.Thread(target=pipe.write_bytes, args=(content,))
    writer.start()
    table = _core.read_text_table(pipe).table
    writer.join()
    np.testing.assert_array_equal(table[:, 0], np.arange(600_000))


def test_memory_stays_bounded_above_the_result(tmp_path):
    """A text of comments alone is read through the same few megabytes, however long it is."""
    path = tmp_path / "f.txt"
    with path.open("wb") as file:
        file.write(b"1 2 3\n")
        for _ in range(100):
            file.write(b"# comment\n" * 100_000)
    script = (
        "import resource, sys; from bathyal import _core\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "table = _core.read_text_table(sys.argv[1], num_threads=2)\n"
        "assert len(table) == 1\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", script, str(path)], capture_output=True, text=True, check=True
    )
    assert int(run.stdout) < 30_000  # kilobytes, for a file of 100 MB


@pytest.mark.parametrize(
    ("options", "pattern"),
    [
        ({"separator": "x"}, "`separator`"),
        ({"separator": ""}, "`separator`: expected one character or None"),
        ({"separator": ", "}, "`separator`"),
        ({"decimal": ";"}, "`decimal`"),
        ({"decimal": ",", "separator": ","}, "`decimal`"),
        ({"comments": [""]}, "`comments`"),
        ({"header_lines": -2}, "`header_lines`"),
        ({"skip_lines": -1}, "`skip_lines`"),
        ({"columns": [-1]}, "`columns`"),
        ({"columns": [0, 0]}, "`columns`: expected each column once"),
        ({"leading": 4}, "`leading`"),
        ({"leading": -1}, "`leading`"),
        ({"num_threads": -1}, "`num_threads`"),
    ],
)
def test_options_out_of_range_are_refused(write, options, pattern):
    with pytest.raises(ValueError, match=pattern):
        _core.read_text_table(write("1 2 3\n"), **options)


def test_real_recordings_read_as_numpy_reads_them():
    path = DATA / "uvms" / "runs" / "baseline1_mocap.csv"
    if not path.exists():
        pytest.skip("no shared data beside the project: uvms/runs/baseline1_mocap.csv")
    table = _core.read_text_table(path)
    expected = np.genfromtxt(path, delimiter=",", names=True)
    assert table.names == list(expected.dtype.names)
    np.testing.assert_array_equal(table.table, np.column_stack([expected[n] for n in table.names]))


def test_a_decimal_comma_of_a_real_recording_is_read():
    path = DATA / "arms" / "ipa-ur10" / "Series_B" / "measurements_joint_configurations.csv"
    if not path.exists():
        pytest.skip("no shared data beside the project: arms/ipa-ur10")
    table = _core.read_text_table(path)
    assert (table.separator, table.decimal) == (";", ",")
    lines = path.read_text().splitlines()
    row = [float(v.replace(",", ".")) for v in lines[-1].rstrip(";").split(";")]
    np.testing.assert_array_equal(table.table[-1], row)


# PCD


def pcd_header(fields="x y z", size="4 4 4", kind="F F F", width=2, height=1, data="binary"):
    count = " ".join("1" for _ in fields.split())
    return (
        f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {size}\nTYPE {kind}\nCOUNT {count}\n"
        f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\nDATA {data}\n"
    ).encode()


def test_pcd_gives_points_and_attributes(write):
    colour = struct.unpack("<f", struct.pack("<I", 0x00FF8001))[0]
    body = struct.pack("<fffHf", 1, 2, 3, 9, colour) + struct.pack("<fffHf", 4, 5, 6, 8, colour)
    head = pcd_header("x y z intensity rgb", "4 4 4 2 4", "F F F U F")
    cloud = _core.read_pcd(write(head + body, "f.pcd"))
    np.testing.assert_array_equal(cloud.points, [[1, 2, 3], [4, 5, 6]])
    assert {name: list(values) for name, values in cloud.attributes.items()} == {
        "intensity": [9, 8],
        "red": [255, 255],
        "green": [128, 128],
        "blue": [1, 1],
    }


PCD_MALFORMED = {
    "empty": (b"", "the file is empty"),
    "text": (b"1 2 3\n", "expected a line of a PCD header"),
    "binary": (b"\0\1\2" * 50, "PCD header"),
    "no data line": (pcd_header().split(b"DATA")[0], "no DATA line"),
    "no z": (pcd_header("x y", "4 4", "F F"), "expected a field z"),
    "no size": (pcd_header().replace(b"SIZE 4 4 4\n", b""), "has no SIZE"),
    "size 0": (pcd_header(size="4 4 0"), "no type F of 0 bytes"),
    "size -4": (pcd_header(size="4 4 -4"), 'got "-4"'),
    "type": (pcd_header(kind="F F X"), "no type X"),
    "width -1": (pcd_header(width=-1), 'got "-1"'),
    "width word": (pcd_header(width="many"), 'got "many"'),
    "overflow": (pcd_header(width=2**33, height=2**33), "more than any file holds"),
    "overflow in bytes": (pcd_header(width=2**61), "more than any file holds"),
    "no points": (pcd_header(width=0), "holds no point"),
    "1 GB": (pcd_header(width=10**8), "cut short: expected 1200000000 bytes"),
    "1 GB compressed": (
        pcd_header(width=10**8, data="binary_compressed") + struct.pack("<II", 4, 1_200_000_000),
        "cut short",
    ),
    "1 GB ascii": (pcd_header(width=10**8, data="ascii") + b"1 2 3\n", "got 1"),
    "short": (pcd_header() + b"\0" * 23, "cut short: expected 24 bytes of points, got 23"),
    "ascii word": (pcd_header(data="ascii") + b"1 2 3\n1 two 3\n", r":12: .*\"two\""),
    "ascii short row": (pcd_header(data="ascii") + b"1 2 3\n1 2\n", r":12: expected 3 columns"),
    "damaged": (
        pcd_header(data="binary_compressed") + struct.pack("<II", 4, 24) + b"\x20\xff\xff\xff",
        "the packed data are damaged",
    ),
    "encoding": (pcd_header(data="zip"), 'got "zip"'),
}


@pytest.mark.parametrize("name", PCD_MALFORMED)
def test_malformed_pcd_is_refused(write, name):
    content, pattern = PCD_MALFORMED[name]
    path = write(content, "f.pcd")
    with pytest.raises(bathyal.Error, match=pattern) as error:
        _core.read_pcd(path)
    assert str(error.value).startswith(str(path))


# Writing


@settings(max_examples=100, deadline=None)
@given(
    points=st.lists(st.tuples(finite, finite, finite), min_size=1, max_size=10),
    decimals=st.integers(0, 17),
    separator=st.sampled_from([" ", ",", ";", "\t"]),
)
def test_xyz_is_written_as_python_formats(tmp_path_factory, points, decimals, separator):
    path = tmp_path_factory.mktemp("xyz") / "f.xyz"
    _core.write_xyz(path, bathyal.PointCloud(points), decimals=decimals, separator=separator)
    expected = "".join(separator.join(f"{v:.{decimals}f}" for v in p) + "\n" for p in points)
    assert path.read_text() == expected
    _core.write_xyz(path, bathyal.PointCloud(points), separator=separator)
    table = _core.read_text_table(path, separator=separator, decimal=".").table
    np.testing.assert_array_equal(table.view(np.uint64), np.array(points).view(np.uint64))


def test_xyz_refuses_what_it_cannot_write(tmp_path):
    cloud = bathyal.PointCloud([[1, 2, 3]])
    with pytest.raises(bathyal.Error, match="No such file or directory"):
        _core.write_xyz(tmp_path / "none" / "f.xyz", cloud)
    with pytest.raises(bathyal.Error, match="No space left on device"):
        _core.write_xyz("/dev/full", cloud)
    with pytest.raises(ValueError, match="`attributes`"):
        _core.write_xyz(tmp_path / "f.xyz", cloud, attributes=["depth"])
    assert not (tmp_path / "f.xyz").exists()
    with pytest.raises(ValueError, match="`decimals`"):
        _core.write_xyz(tmp_path / "f.xyz", cloud, decimals=18)


# Cleaning


coordinates = st.one_of(st.integers(-3, 3).map(float), st.sampled_from([math.nan, math.inf, 0.5]))
points = st.lists(st.tuples(coordinates, coordinates, coordinates), max_size=40)


def rows_as_set(cloud):
    return {tuple(p) for p in cloud.points.tolist()}


@settings(max_examples=150, deadline=None)
@given(points=points, data=st.data())
def test_cleaning_accounts_for_every_sounding(points, data):
    array = np.array(points, dtype=float).reshape(-1, 3)
    order = data.draw(st.permutations(range(len(points))))
    options = {
        "same_place": data.draw(st.sampled_from(["keep", "shallowest", "deepest"])),
        "spike_sigma": data.draw(st.sampled_from([0.0, 3.0])),
        "outlier_sigma": data.draw(st.sampled_from([0.0, 1.0])),
        "voxel": data.draw(st.sampled_from([0.0, 2.0])),
    }
    number = np.arange(len(points), dtype=float)
    cloud = bathyal.PointCloud(array, attributes={"number": number})
    result = bathyal.clean_cloud(cloud, **options)
    report = result.report.as_dict()
    dropped = sum(
        report[name]
        for name in (
            "not_finite", "duplicates", "same_place_dropped", "spikes", "outliers", "thinned"
        )
    )  # fmt: skip
    assert report["before"] - dropped == report["after"] == len(result.cloud)
    np.testing.assert_array_equal(result.cloud.points, array[result.rows])
    np.testing.assert_array_equal(result.cloud.attributes["number"], result.rows)
    assert len(rows_as_set(result.cloud)) == len(result.cloud)
    if not any(options[name] for name in ("spike_sigma", "outlier_sigma", "voxel")):
        finite_rows = {tuple(p) for p in array.tolist() if np.isfinite(p).all()}
        if options["same_place"] == "keep":
            assert rows_as_set(result.cloud) == finite_rows
        else:
            assert len(result.cloud) == len({p[:2] for p in finite_rows})
    turned = bathyal.clean_cloud(bathyal.PointCloud(array[order]), **options)
    assert rows_as_set(turned.cloud) == rows_as_set(result.cloud)
    assert turned.report.as_dict() == report


def test_cleaning_finds_the_fish():
    truth = {"seed": 4, "length": 20.0, "beams": 128}
    plain = bathyal.generate_survey(**truth).points
    cloud = bathyal.generate_survey(**truth, spike_fraction=0.002)
    fish = np.flatnonzero(cloud.points[:, 2] > plain[:, 2] + 0.3)
    result = bathyal.clean_cloud(cloud, spike_sigma=6.0)
    gone = np.setdiff1d(np.arange(len(cloud)), result.rows)
    assert len(np.intersect1d(gone, fish)) >= 0.9 * len(fish)
    assert len(np.setdiff1d(gone, fish)) <= 0.001 * len(cloud)
    assert "spikes" in str(result.report)


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"same_place": "first"}, "same_place"),
        ({"spike_sigma": -1.0}, "spike_sigma"),
        ({"spike_sigma": math.nan}, "spike_sigma"),
        ({"spike_neighbours": 2}, "spike_neighbours"),
        ({"spike_height": -0.1}, "spike_height"),
        ({"outlier_sigma": math.inf}, "outlier_sigma"),
        ({"outlier_neighbours": 0}, "outlier_neighbours"),
        ({"voxel": -1.0}, "voxel"),
        ({"voxel": 1e-300}, "voxel"),
        ({"num_threads": -1}, "num_threads"),
    ],
)
def test_cleaning_refuses_options_out_of_range(options, name):
    with pytest.raises(ValueError, match=f"`{name}`: expected"):
        bathyal.clean_cloud(bathyal.PointCloud([[1, 2, 3]]), **options)


# Surveys


def test_survey_and_height_take_the_same_options():
    survey = inspect.getdoc(bathyal.generate_survey).split("->")[0]
    height = inspect.getdoc(bathyal.survey_height).split("->")[0]
    assert survey.split("*, ")[1] == height.split("*, ")[1]


def test_survey_is_the_same_for_any_number_of_threads_and_unlike_another_seed():
    options = {"length": 10.0, "beams": 64}
    one = bathyal.generate_survey(seed=9, num_threads=1, **options)
    eight = bathyal.generate_survey(seed=9, num_threads=8, **options)
    assert one.points.tobytes() == eight.points.tobytes()
    for name, values in one.attributes.items():
        assert values.tobytes() == eight.attributes[name].tobytes()
    other = bathyal.generate_survey(seed=10, **options)
    assert not np.array_equal(one.points[:, 2], other.points[:, 2])


def test_survey_noise_is_what_its_uncertainty_says():
    options = {"seed": 2, "length": 20.0, "beams": 128, "boulders": 0, "trench_depth": 0.0}
    cloud = bathyal.generate_survey(**options)
    truth = bathyal.survey_height(cloud.points[:, 0], cloud.points[:, 1], **options)
    off = (cloud.points[:, 2] - truth) / cloud.attributes["uncertainty"]
    assert abs(off.mean()) < 0.05
    assert 0.9 < off.std() < 1.1


def test_survey_goes_through_a_file_unchanged(tmp_path):
    cloud = bathyal.generate_survey(seed=1, length=10.0)
    names = sorted(cloud.attributes)
    _core.write_xyz(tmp_path / "s.csv", cloud, separator=",", header=True, attributes=names)
    table = _core.read_text_table(tmp_path / "s.csv", leading=3)
    assert table.names == ["x", "y", "z", *names]
    np.testing.assert_array_equal(table.table, cloud.points)
    for column, name in zip(table.extra, names, strict=True):
        np.testing.assert_array_equal(column, cloud.attributes[name])


def test_survey_refuses_options_out_of_range():
    for name in ("length", "width", "altitude", "opening", "ping_spacing", "wave_length"):
        with pytest.raises(ValueError, match=f"`{name}`"):
            bathyal.generate_survey(**{name: 0.0})
    with pytest.raises(ValueError, match="`origin`"):
        bathyal.generate_survey(origin=(0, 0))
    with pytest.raises(ValueError, match="`y`: expected 2 values"):
        bathyal.survey_height([0.0, 1.0], [0.0])
