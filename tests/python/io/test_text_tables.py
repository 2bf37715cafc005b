# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in columns of a text, as the engine reads them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal import _core

DATA = Path(__file__).resolve().parents[3] / ".." / "shared" / "data"

finite = st.floats(allow_nan=False, allow_infinity=False)
tables = st.integers(1, 5).flatmap(
    lambda width: st.lists(
        st.lists(finite, min_size=width, max_size=width), min_size=1, max_size=20
    )
)


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
    message = str(path)
    try:
        table = _core.read_text_table(path)
    except bathyal.Error as error:
        message = str(error)
    else:
        assert table.table.shape == (len(table), table.table.shape[1])
        assert len(table) > 0
    assert message.startswith(str(path))


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
        pytest.skip("no shared data next to the project: uvms/runs/baseline1_mocap.csv")
    table = _core.read_text_table(path)
    expected = np.genfromtxt(path, delimiter=",", names=True)
    assert table.names == list(expected.dtype.names)
    np.testing.assert_array_equal(table.table, np.column_stack([expected[n] for n in table.names]))


def test_a_decimal_comma_of_a_real_recording_is_read():
    path = DATA / "arms" / "ipa-ur10" / "Series_B" / "measurements_joint_configurations.csv"
    if not path.exists():
        pytest.skip("no shared data next to the project: arms/ipa-ur10")
    table = _core.read_text_table(path)
    assert (table.separator, table.decimal) == (";", ",")
    lines = path.read_text().splitlines()
    row = [float(v.replace(",", ".")) for v in lines[-1].rstrip(";").split(";")]
    np.testing.assert_array_equal(table.table[-1], row)
