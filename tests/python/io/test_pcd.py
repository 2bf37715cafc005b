# SPDX-License-Identifier: BSD-3-Clause
"""The .pcd reader of the engine."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import bathyal
from bathyal import _core


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
