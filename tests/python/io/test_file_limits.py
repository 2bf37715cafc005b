# SPDX-License-Identifier: BSD-3-Clause
"""Files without an end and files that ask for all memory: each reader refuses them at once.

Each case in a process of its own, with 2 GB of memory and a minute.
"""

from __future__ import annotations

import base64
import json
import os
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import bathyal
from bathyal import Error
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.seabed.bottom import file_facts
from tests.support.alone import MEMORY, Case, check, refused, works
from tests.support.bad_input import written

READERS: dict[str, Callable[[Path], object]] = {
    **{
        f"read_cloud {suffix}": bathyal.read_cloud
        for suffix in (".xyz", ".txt", ".csv", ".asc", ".ply", ".pcd", ".las", ".laz", ".bag",
                       ".tif", ".vtp")
    },
    **{f"read_mesh {s}": bathyal.read_mesh for s in (".ply", ".stl", ".obj", ".dae", ".vtp")},
    **{f"read_arm {s}": bathyal.read_arm for s in (".json", ".urdf")},
    **{f"read_aims {s}": bathyal.read_aims for s in (".csv", ".txt", ".tsv", ".json")},
    "read_vtp .vtp": read_vtp,
    "read_touches .csv": bathyal.read_touches,
    "read_tracked .csv": bathyal.read_tracked,
    "file_facts .xyz": file_facts,
    "read_text_table .xyz": bathyal._core.read_text_table,
    "read_pcd .pcd": bathyal._core.read_pcd,
}  # fmt: skip
LIMIT = "BATHYAL_MOST_BYTES"


def pipe(suffix: str) -> Path:
    path = Path("pipe" + suffix)
    os.mkfifo(path)
    return path


def folder(suffix: str) -> Path:
    path = Path("folder" + suffix)
    path.mkdir()
    return path


def zeros(suffix: str) -> Path:
    path = Path("zeros" + suffix)
    path.symlink_to("/dev/zero")
    return path


def hollow(suffix: str) -> Path:
    """A file of 100 GB that takes no room on the disk."""
    path = Path("hollow" + suffix)
    with path.open("wb") as stream:
        stream.truncate(100 * 10**9)
    return path


CASES: list[Case] = []
for _name, _read in READERS.items():
    _suffix = _name.split()[1]
    for _make, _errors, _says in (
        (pipe, (Error,), "pipe"),
        (folder, (OSError, Error), "folder|directory"),
        (zeros, (Error,), "expected a regular file, got a pipe or a device"),
        (hollow, (Error,), LIMIT),
    ):
        CASES.append(
            refused(
                f"{_name}: {_make.__name__}",
                _says,
                lambda r=_read, m=_make, s=_suffix: r(m(s)),
                _errors,
            )
        )


def with_limit(megabytes: int, body: Callable[[], object]) -> object:
    os.environ[LIMIT] = str(megabytes * 10**6)  # of a process of its own
    return body()


def ply(*elements: str) -> str:
    vertex = ["element vertex 1", "property double x", "property double y", "property double z"]
    return "\n".join(["ply", "format ascii 1.0", *vertex, *elements, "end_header", "1 2 3", ""])


def vtp_of_zeros(values: int, arrays: int, kind: str = "Float64") -> Path:
    """A file whose arrays all unpack the same blocks of nothing, of so many values each."""
    size = 1 << 25
    width = np.dtype(kind.lower()).itemsize
    blocks = values * width // size
    packed = zlib.compress(bytes(size), 9)
    header = np.array([blocks, size, 0] + [len(packed)] * blocks, "<u8").tobytes()
    names = "".join(
        f'<DataArray type="{kind}" Name="a{i}" format="appended" offset="0"/>'
        for i in range(arrays)
    )
    head = (
        '<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt64" '
        f'compressor="vtkZLibDataCompressor"><PolyData><FieldData>{names}</FieldData></PolyData>'
        '<AppendedData encoding="raw">_'
    )
    return written("a.vtp", head.encode() + header + packed * blocks + b"</AppendedData></VTKFile>")


def vtp_of_texts() -> Path:
    """One text of a megabyte and a million empty ones: in an array all are as wide."""
    texts = b"a" * (1 << 20) + b"\0" * (1 << 20)
    blob = base64.b64encode(np.array([len(texts)], "<u4").tobytes()) + base64.b64encode(texts)
    return written(
        "a.vtp",
        b'<VTKFile type="PolyData"><PolyData><FieldData><Array type="String" Name="a" '
        b'format="binary">' + blob + b"</Array></FieldData></PolyData></VTKFile>",
    )


def sparse_tiff(width: int, height: int, block: int = 256) -> Path:
    rasterio = pytest.importorskip("rasterio")
    with rasterio.open(
        "a.tif", "w", driver="GTiff", height=height, width=width, count=1, dtype="float32",
        tiled=True, sparse_ok=True, crs="EPSG:32602", blockxsize=block, blockysize=block,
        transform=rasterio.Affine(1, 0, 6e5, 0, -1, 7e6), compress="deflate",
    ):  # fmt: skip
        pass
    return Path("a.tif")


def nested_scene() -> Path:
    """Three corners, and a million triangles between them, shown 10⁴ times."""
    nodes = '<node><instance_geometry url="#g"/></node>' * 10_000
    triangles = "0 1 2 " * 100_000
    return written(
        "a.dae",
        '<COLLADA><library_geometries><geometry id="g"><mesh><source id="s">'
        '<float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>'
        '<accessor source="#f" count="3" stride="3"/></technique_common></source>'
        '<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>'
        '<triangles count="100000"><input semantic="VERTEX" source="#v" offset="0"/>'
        f"<p>{triangles}</p></triangles></mesh></geometry></library_geometries>"
        f'<library_visual_scenes><visual_scene id="w">{nodes}</visual_scene>'
        '</library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>',
    )


PCD_WIDE = (
    "VERSION 0.7\nFIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nCOUNT 1 1 1\nWIDTH 300000000\nHEIGHT 1\n"
    "POINTS 300000000\nDATA binary\n"
)

CASES += [
    works(
        "a PLY with 10¹⁰ elements of no properties",
        lambda: len(bathyal.read_cloud(written("a.ply", ply("element junk 10000000000")))),
    ),
    refused(
        "a PLY with 10¹⁰ lists",
        "announces",
        lambda: bathyal.read_cloud(
            written("a.ply", ply("element junk 10000000000", "property list uchar int a"))
        ),
        (Error,),
    ),
    refused(
        "a PCD of bytes that become doubles",
        LIMIT,
        lambda: bathyal.read_cloud(written("a.pcd", PCD_WIDE)),
        (Error,),
    ),
    refused("a VTP that unpacks to 8 GB", LIMIT,
            lambda: read_vtp(vtp_of_zeros(10**9, 1)), (Error,)),
    refused("a VTP whose arrays share what they unpack", LIMIT,
            lambda: with_limit(300, lambda: read_vtp(vtp_of_zeros(1 << 23, 100))), (Error,)),
    refused("a VTP of bytes that become doubles", LIMIT,
            lambda: read_vtp(vtp_of_zeros(10**9, 1, "UInt8")), (Error,)),
    refused("a VTP of one long text and many short ones", LIMIT,
            lambda: read_vtp(vtp_of_texts()), (Error,)),
    refused("a GeoTIFF of 10¹⁰ cells that are not there", LIMIT,
            lambda: bathyal.read_cloud(sparse_tiff(100_000, 100_000)), (Error,)),
    refused("a GeoTIFF whose cells all have a value", LIMIT,
            lambda: with_limit(200, lambda: bathyal.read_cloud(sparse_tiff(5000, 5000))),
            (Error,)),
    refused("a COLLADA scene that repeats its triangles", LIMIT,
            lambda: bathyal.read_mesh(nested_scene()), (Error,)),
    refused("aims of 80 MB in JSON", LIMIT,
            lambda: bathyal.read_aims(written("a.json", "[" + "[]," * 27_000_000)), (Error,)),
    refused("an arm of 80 MB", LIMIT,
            lambda: bathyal.read_arm(written("a.json", "[" + "0," * 40_000_000 + "0]")), (Error,)),
    refused("touches of 80 MB", LIMIT,
            lambda: bathyal.read_touches(written("a.csv", "1,2\n" * 20_000_000)), (Error,)),
]  # fmt: skip


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_case(case: Case, tmp_path: Path) -> None:
    assert MEMORY == 2 << 30
    check(case, tmp_path)


def test_the_limit_is_the_environment_s(tmp_path, monkeypatch):
    path = tmp_path / "a.xyz"
    path.write_text("1 2 3\n" * 100)
    monkeypatch.setenv(LIMIT, "600")
    assert len(bathyal.read_cloud(path)) == 100
    monkeypatch.setenv(LIMIT, "599")
    with pytest.raises(Error, match=rf"a\.xyz: the file takes 1 MB, more than {LIMIT}"):
        bathyal.read_cloud(path)
    aims = tmp_path / "aims.json"
    aims.write_text(json.dumps([[0, 0, 0, 0, 0, -1]]))
    with pytest.raises(Error, match=LIMIT):
        bathyal.read_aims(aims)
    monkeypatch.setenv(LIMIT, "plenty")
    with pytest.raises(Error, match=f"{LIMIT}: expected a whole number of bytes, got plenty"):
        bathyal.read_cloud(path)


def test_a_pipe_with_a_writer_is_refused_too(tmp_path):
    path = tmp_path / "a.xyz"
    os.mkfifo(path)
    end = os.open(path, os.O_RDWR)
    try:
        os.write(end, b"1 2 3\n")
        with pytest.raises(Error, match="expected a regular file"):
            bathyal.read_cloud(path)
    finally:
        os.close(end)


def test_a_manifest_that_is_a_pipe_holds_nobody(tmp_path):
    """Readers look for one in the folder of every file."""
    (tmp_path / "a.xyz").write_text("1 2 3\n")
    os.mkfifo(tmp_path / "bathyal-manifest.json")
    with pytest.raises(Error, match=r"manifest\.json: expected a regular"):
        bathyal.read_cloud(tmp_path / "a.xyz")


def test_a_file_is_read_up_to_the_size_it_was_opened_with(tmp_path):
    """What somebody appends in the meantime belongs to the next reading."""
    path = tmp_path / "a.json"
    path.write_text("[]")
    from bathyal.io.files import opened

    with opened(path) as (stream, size):
        path.open("a").write("[]")
        assert stream.read(size) == b"[]"
