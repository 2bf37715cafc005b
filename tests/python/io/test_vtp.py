# SPDX-License-Identifier: BSD-3-Clause
"""VTK PolyData XML: our own round trips, and VTK itself on both sides."""

from __future__ import annotations

import contextlib
import itertools
import re
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import bathyal
from bathyal.io.formats.meshes.cells import Cells, cells_of
from bathyal.io.formats.meshes.polygons import triangles_of_polygons, triangles_of_strips
from bathyal.io.formats.vtp.reader import read_vtp
from bathyal.io.formats.vtp.writer import write_vtp

UTM = np.array([620152.873, 7246504.912, -51.987])
MODES = list(itertools.product(["raw", "base64"], [True, False]))


def write_example(path, **options):
    points = UTM + np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.001], [0, 1, 0], [2, 2, 2.0]])
    write_vtp(
        path,
        points,
        vertices=[4],
        lines=[[0, 1, 2], [3, 4]],
        polygons=[[0, 1, 2, 3], [0, 1, 2]],
        point_data={
            "uncertainty": np.linspace(0.1, 0.5, 5),
            "normal": np.eye(5, 3, dtype=np.float32),
            "status": ["hit", "miss", "", "grazing", "mètre"],
            "gap": [True, False, True, False, True],
        },
        cell_data={"segment": np.arange(5, dtype=np.int32)},
        field_data={"crs": "EPSG:32602", "step": [0.05]},
        **options,
    )
    return points


@pytest.mark.parametrize(("encoding", "compressed"), MODES)
def test_what_is_written_is_read_back(tmp_path, encoding, compressed):
    path = tmp_path / "a.vtp"
    points = write_example(path, encoding=encoding, compressed=compressed)
    data = read_vtp(path)
    assert np.array_equal(data.points, points)
    assert [row.tolist() for row in data.vertices.lists()] == [[4]]
    assert [row.tolist() for row in data.lines.lists()] == [[0, 1, 2], [3, 4]]
    assert [row.tolist() for row in data.polygons.lists()] == [[0, 1, 2, 3], [0, 1, 2]]
    assert data.triangles().tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2]]
    assert np.array_equal(data.point_data["uncertainty"], np.linspace(0.1, 0.5, 5))
    assert data.point_data["normal"].dtype == np.float32
    assert data.point_data["normal"].shape == (5, 3)
    assert data.point_data["status"].tolist() == ["hit", "miss", "", "grazing", "mètre"]
    assert data.point_data["gap"].tolist() == [1, 0, 1, 0, 1]
    assert data.cell_data["segment"].tolist() == [0, 1, 2, 3, 4]
    assert data.field_data["crs"].tolist() == ["EPSG:32602"]
    assert data.field_data["step"].tolist() == [0.05]


@given(
    points=hnp.arrays(
        np.float64,
        st.tuples(st.integers(0, 40), st.just(3)),
        elements=st.floats(allow_nan=True, allow_infinity=True),
    ),
    mode=st.sampled_from(MODES),
)
@settings(max_examples=60, deadline=None)
def test_any_points_come_back_bit_for_bit(tmp_path_factory, points, mode):
    path = tmp_path_factory.getbasetemp() / "property.vtp"
    rows = np.arange(len(points))
    write_vtp(path, points, vertices=rows, encoding=mode[0], compressed=mode[1])
    data = read_vtp(path)
    assert data.points.tobytes() == points.tobytes()
    assert np.array_equal(data.vertices.connectivity, rows)


def test_arrays_of_several_compressed_blocks(tmp_path):
    points = np.random.default_rng(1).normal(size=(100_001, 3))
    for encoding in ("raw", "base64"):
        write_vtp(tmp_path / "big.vtp", points, encoding=encoding)
        assert np.array_equal(read_vtp(tmp_path / "big.vtp").points, points)


def test_refusals_of_the_writer(tmp_path):
    path = tmp_path / "a.vtp"
    points = np.zeros((3, 3))
    with pytest.raises(ValueError, match="`points`: expected shape"):
        write_vtp(path, np.zeros((3, 2)))
    with pytest.raises(ValueError, match="`lines`: expected rows of points from 0 to 2, got 3"):
        write_vtp(path, points, lines=[[0, 3]])
    with pytest.raises(ValueError, match="got -1"):
        write_vtp(path, points, polygons=[[0, 1, -1]])
    with pytest.raises(ValueError, match=r"`point_data\['a'\]`: expected 3 rows, got 2"):
        write_vtp(path, points, point_data={"a": [1.0, 2.0]})
    with pytest.raises(ValueError, match="`: expected numbers or texts"):
        write_vtp(path, points, point_data={"a": np.array([1j, 2, 3])})
    with pytest.raises(ValueError, match="`encoding`: expected"):
        write_vtp(path, points, encoding="ascii")
    assert list(tmp_path.iterdir()) == []


def test_strips_turn_every_second_triangle():
    assert triangles_of_strips(cells_of([[0, 1, 2, 3, 4]])).tolist() == [
        [0, 1, 2],
        [1, 3, 2],
        [2, 3, 4],
    ]


def test_polygons_become_fans_and_short_ones_are_refused():
    polygons = cells_of([[5, 6, 7], [0, 1, 2, 3, 4]])
    points = np.array([[0, 0], [1, 0], [2, 1], [1, 2], [0, 2], [5, 5], [6, 5], [5, 6.0]])
    points = np.column_stack([points, np.zeros(8)])
    fans = [[5, 6, 7], [0, 1, 2], [0, 2, 3], [0, 3, 4]]
    assert triangles_of_polygons(polygons, points).tolist() == fans
    with pytest.raises(bathyal.Error, match="polygon 1 has 2 corners"):
        triangles_of_polygons(cells_of([[0, 1, 2], [1, 2]]), points)


# --- VTK on the other side ---------------------------------------------------------------------


def vtk_writer(vtk, mode, compressor, header, order):
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetDataMode({"ascii": 0, "binary": 1, "raw": 2, "base64": 2}[mode])
    if mode != "ascii":
        writer.SetEncodeAppendedData(mode == "base64")
    {
        "none": lambda: writer.SetCompressorTypeToNone(),
        "zlib": lambda: writer.SetCompressorTypeToZLib(),
        "lz4": lambda: writer.SetCompressorTypeToLZ4(),
        "lzma": lambda: writer.SetCompressorTypeToLZMA(),
    }[compressor]()
    (writer.SetHeaderTypeToUInt32 if header == 32 else writer.SetHeaderTypeToUInt64)()
    (writer.SetByteOrderToLittleEndian if order == "little" else writer.SetByteOrderToBigEndian)()
    return writer


def vtk_example(vtk):
    """Vertices, a line, a strip and polygons, with numbers and texts on them."""
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    table = UTM + np.random.default_rng(2).normal(size=(3000, 3))
    points.SetData(support.numpy_to_vtk(table, deep=True))
    data.SetPoints(points)
    for lists, put in (
        ([[7]], data.SetVerts),
        ([[0, 1, 2]], data.SetLines),
        ([[3, 4, 5, 6]], data.SetStrips),
        ([[i, i + 1, i + 2, i + 3] for i in range(10)], data.SetPolys),
    ):
        cells = vtk.vtkCellArray()
        for row in lists:
            cells.InsertNextCell(len(row), row)
        put(cells)
    depth = support.numpy_to_vtk(table[:, 2].astype(np.float32), deep=True)
    depth.SetName("depth")
    data.GetPointData().AddArray(depth)
    text = vtk.vtkStringArray()
    text.SetName("crs")
    text.InsertNextValue("EPSG:32602")
    data.GetFieldData().AddArray(text)
    return data, table


@pytest.mark.parametrize("mode", ["ascii", "binary", "raw", "base64"])
@pytest.mark.parametrize("compressor", ["none", "zlib"])
@pytest.mark.parametrize("header", [32, 64])
@pytest.mark.parametrize("order", ["little", "big"])
def test_we_open_what_vtk_writes(tmp_path, mode, compressor, header, order):
    vtk = pytest.importorskip("vtk")
    data, table = vtk_example(vtk)
    writer = vtk_writer(vtk, mode, compressor, header, order)
    writer.SetFileName(str(tmp_path / "vtk.vtp"))
    writer.SetInputData(data)
    assert writer.Write() == 1
    ours = read_vtp(tmp_path / "vtk.vtp")
    tolerance = 2e-9 if mode == "ascii" else 0.0
    assert np.allclose(ours.points, table, rtol=0, atol=tolerance)
    assert ours.vertices.connectivity.tolist() == [7]
    assert ours.lines.connectivity.tolist() == [0, 1, 2]
    assert ours.strips.connectivity.tolist() == [3, 4, 5, 6]
    assert len(ours.polygons) == 10
    assert len(ours.triangles()) == 2 + 20
    assert np.allclose(ours.point_data["depth"], table[:, 2], atol=1e-5)
    assert ours.field_data["crs"].tolist() == ["EPSG:32602"]


@pytest.mark.parametrize("compressor", ["lz4", "lzma"])
def test_other_compressors_are_refused_by_name(tmp_path, compressor):
    vtk = pytest.importorskip("vtk")
    writer = vtk_writer(vtk, "raw", compressor, 64, "little")
    writer.SetFileName(str(tmp_path / "vtk.vtp"))
    writer.SetInputData(vtk_example(vtk)[0])
    assert writer.Write() == 1
    with pytest.raises(bathyal.Error, match=f"compressor vtk{compressor.upper()}DataCompressor"):
        read_vtp(tmp_path / "vtk.vtp")


@pytest.mark.parametrize(("encoding", "compressed"), MODES)
def test_vtk_opens_what_we_write(tmp_path, encoding, compressed):
    vtk = pytest.importorskip("vtk")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    points = write_example(tmp_path / "a.vtp", encoding=encoding, compressed=compressed)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    assert reader.GetErrorCode() == 0
    data = reader.GetOutput()
    assert np.array_equal(support.vtk_to_numpy(data.GetPoints().GetData()), points)
    counts = (data.GetNumberOfVerts(), data.GetNumberOfLines(), data.GetNumberOfPolys())
    assert counts == (1, 2, 2)
    status = data.GetPointData().GetAbstractArray("status")
    assert [status.GetValue(i) for i in range(5)] == ["hit", "miss", "", "grazing", "mètre"]
    assert data.GetFieldData().GetAbstractArray("crs").GetValue(0) == "EPSG:32602"
    segment = support.vtk_to_numpy(data.GetCellData().GetArray("segment"))
    assert segment.tolist() == [0, 1, 2, 3, 4]
    assert data.GetPointData().GetArray("normal").GetNumberOfComponents() == 3


# --- several pieces, and hostile files -----------------------------------------------------------

TWO_PIECES = (
    """<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData>{}{}</PolyData></VTKFile>"""
)
PIECE = """<Piece NumberOfPoints="3" NumberOfVerts="1" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
{0} 0 0 {0} 1 0 {0} 1 1</DataArray></Points>
<Verts><DataArray type="Int64" Name="connectivity" format="ascii">1</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">1</DataArray></Verts>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys>
<CellData><DataArray type="Int32" Name="id" format="ascii">{0}0 {0}1</DataArray></CellData>
</Piece>"""


def test_pieces_are_joined(tmp_path):
    path = tmp_path / "pieces.vtp"
    path.write_text(TWO_PIECES.format(PIECE.format(4), PIECE.format(7)))
    data = read_vtp(path)
    assert data.points[:, 0].tolist() == [4, 4, 4, 7, 7, 7]
    assert data.vertices.connectivity.tolist() == [1, 4]
    assert data.triangles().tolist() == [[0, 1, 2], [3, 4, 5]]
    assert data.cell_data["id"].tolist() == [40, 70, 41, 71]


def test_keys_between_the_numbers_are_stepped_over(tmp_path):
    key = '<InformationKey name="L2_NORM_RANGE"><Value index="0">7</Value></InformationKey>'
    path = tmp_path / "keys.vtp"
    path.write_text(TWO_PIECES.format(PIECE.format(4).replace("4 1 0", f"4 1 {key} 0"), ""))
    assert read_vtp(path).points[1].tolist() == [4, 1, 0]


def broken_examples():
    good = PIECE.format(1)
    yield "other type", TWO_PIECES.replace("PolyData", "UnstructuredGrid").format(good, good)
    yield "index out of range", TWO_PIECES.format(good.replace("0 1 2<", "0 1 3<"), good)
    yield "negative index", TWO_PIECES.format(good.replace("0 1 2<", "0 1 -1<"), good)
    yield "end past the indices", TWO_PIECES.format(good.replace(">3<", ">4<"), good)
    yield "end before zero", TWO_PIECES.format(good.replace(">3<", ">-3<"), good)
    yield "billion points", TWO_PIECES.format(good.replace('Points="3"', 'Points="9000000000"'), "")
    yield "billion polygons", TWO_PIECES.format(good.replace('Polys="1"', 'Polys="9000000000"'), "")
    yield "negative count", TWO_PIECES.format(good.replace('Points="3"', 'Points="-3"'), "")
    yield "no components", TWO_PIECES.format(good.replace('Components="3"', 'Components="0"'), "")
    yield "word for a number", TWO_PIECES.format(good.replace(" 1 1<", " x 1<"), "")
    yield "bits", TWO_PIECES.format(good.replace("Float64", "Bit"), "")
    yield "unknown format", TWO_PIECES.format(good.replace("ascii", "morse"), "")
    yield "not base64", TWO_PIECES.format(good.replace('format="ascii"', 'format="binary"'), "")
    yield "no file type", "<VTKFile><PolyData/></VTKFile>"
    yield "empty root", "<a/>"
    yield "no XML", "depth 1 2 3\n"
    yield "entity bomb", '<!DOCTYPE a [<!ENTITY b "bb"><!ENTITY c "&b;&b;">]><VTKFile>&c;</VTKFile>'
    yield (
        "external entity",
        '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><VTKFile>&b;</VTKFile>',
    )


@pytest.mark.parametrize("text", [pytest.param(t, id=n) for n, t in broken_examples()])
def test_broken_files_are_errors(tmp_path, text):
    path = tmp_path / "broken.vtp"
    path.write_text(text)
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        read_vtp(path)


@pytest.mark.parametrize(("encoding", "compressed"), MODES)
def test_cut_files_are_errors(tmp_path, encoding, compressed):
    path = tmp_path / "a.vtp"
    write_example(path, encoding=encoding, compressed=compressed)
    whole = path.read_bytes()
    for tenth in range(10):
        path.write_bytes(whole[: len(whole) * tenth // 10])
        with pytest.raises(bathyal.Error):
            read_vtp(path)


@given(data=st.data(), mode=st.sampled_from(MODES))
@settings(max_examples=150, deadline=None)
def test_a_changed_byte_is_read_or_refused(tmp_path_factory, data, mode):
    path = tmp_path_factory.getbasetemp() / "changed.vtp"
    write_example(path, encoding=mode[0], compressed=mode[1])
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(bathyal.Error):
        read_vtp(path).triangles()


def appended(header: bytes, *, compressor: str = "") -> bytes:
    return (
        b'<VTKFile type="PolyData" header_type="UInt64"'
        + compressor.encode()
        + b"><PolyData><FieldData>"
        b'<DataArray type="Float64" Name="a" format="appended" offset="0"/></FieldData></PolyData>'
        b'<AppendedData encoding="raw">_' + header + b"</AppendedData></VTKFile>"
    )


def test_announced_sizes_are_checked_before_memory_is_taken(tmp_path):
    path = tmp_path / "bomb.vtp"
    huge = np.array([1 << 40, 1 << 40, 0], "<u8").tobytes()
    zlib_name = ' compressor="vtkZLibDataCompressor"'
    path.write_bytes(appended(huge[:8]))
    with pytest.raises(bathyal.Error, match="are announced"):
        read_vtp(path)
    path.write_bytes(appended(huge, compressor=zlib_name))
    with pytest.raises(bathyal.Error, match="are announced"):
        read_vtp(path)
    block = zlib.compress(bytes(8))
    sizes = np.array([1, 1 << 34, 0, len(block)], "<u8").tobytes()
    path.write_bytes(appended(sizes + block, compressor=zlib_name))
    with pytest.raises(bathyal.Error, match="cannot hold"):
        read_vtp(path)


def test_cells_check_their_ends():
    with pytest.raises(bathyal.Error, match="ends of the cells"):
        Cells(np.arange(4), np.array([3, 2])).check(4)
    with pytest.raises(ValueError, match="whole numbers"):
        cells_of([[0.5, 1.0]])
