# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from and to PLY, STL, OBJ, COLLADA and VTP."""

from __future__ import annotations

import contextlib
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal.formats.cells import cells_of
from bathyal.formats.polygons import triangles_of_polygons
from file_cases import measured, refusal_and_memory

UTM = np.array([620152.873, 7246504.912, -51.987])
CUBE_VERTICES = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
CUBE_QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def volume(mesh):
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles] - mesh.vertices[0], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def area(mesh):
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def cube(**extras):
    return bathyal.TriangleMesh(
        CUBE_VERTICES + UTM,
        triangles_of_polygons(cells_of(CUBE_QUADS), CUBE_VERTICES),
        **extras,
    )


# --- measured data: numbers known from elsewhere -------------------------------------------------

HULLS = {
    "COLLISION-Slocum-Glider": (124, 0.453234),
    "Slocum-Glider-Propeller": (238, 8.1604e-5),
    "caldus_collision": (32, 7.48856),
    "caracara_collision": (20, 2.19599),
    "torpedo_mk48_collision": (284, 1.24303),
    "uxo_a_collision": (316, 0.0560857),
    "uxo_b_collision": (348, 0.163788),
    "uxo_c_collision": (220, 0.501132),
    "smilodon_collision": (12, 18.9497),
    "COLLISION-Wave_Glider-umbilical": (12, -0.0070979),
    "uxo_b": (3994, 0.1496),
}
HULL_TRIANGLES = {"caldus": 1418, "sunkenship_distort": 4171}


@pytest.mark.parametrize("name", HULLS)
def test_hulls_have_their_known_triangles_and_volume(name):
    mesh = bathyal.read_mesh(measured(f"hulls/{name}.dae"))
    triangles, known_volume = HULLS[name]
    assert len(mesh.triangles) == triangles
    assert volume(mesh) == pytest.approx(known_volume, rel=1e-4 if name == "uxo_b" else 2e-5)


@pytest.mark.parametrize("name", HULL_TRIANGLES)
def test_hulls_that_are_not_closed_have_their_known_triangles(name):
    assert len(bathyal.read_mesh(measured(f"hulls/{name}.dae")).triangles) == HULL_TRIANGLES[name]


def test_every_hull_is_read():
    paths = sorted(measured("hulls").glob("*.dae"))
    assert len(paths) == 19
    assert all(len(bathyal.read_mesh(path).triangles) >= 12 for path in paths)


def test_the_wreck_has_its_known_size():
    mesh = bathyal.read_mesh(measured("hulls/sunkenship_distort.dae"))
    assert np.ptp(mesh.vertices, axis=0) == pytest.approx([17.5, 12.6, 7.2], abs=0.05)


def test_scanned_corals():
    coral = bathyal.read_mesh(measured("seabed/coral-mcap/mcap_derived.ply"))
    assert (len(coral.vertices), len(coral.triangles)) == (5568, 10939)
    assert np.ptp(coral.vertices[:, 2]) == pytest.approx(0.2185397, abs=5e-8)
    assert area(coral) == pytest.approx(0.2698, abs=5e-5)
    colony = bathyal.read_mesh(measured("seabed/coral-colony/colony_plot.ply"))
    assert (len(colony.vertices), len(colony.triangles)) == (5773, 11117)
    assert set(colony.attributes) >= {"red", "green", "blue"}
    for colour in ("red", "green", "blue"):
        values = colony.attributes[colour]
        assert values.max() > 100
        assert np.all((values >= 0) & (values <= 255) & (values == np.floor(values)))


# --- round trips ---------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".ply", ".vtp", ".obj", ".stl"])
def test_coordinates_come_back_bit_for_bit_at_survey_coordinates(tmp_path, suffix):
    mesh = cube()
    mesh.write(tmp_path / f"cube{suffix}")
    assert [path.name for path in tmp_path.iterdir()] == [f"cube{suffix}"]
    back = bathyal.read_mesh(tmp_path / f"cube{suffix}")
    corners = back.vertices[back.triangles]
    assert np.array_equal(corners, mesh.vertices[mesh.triangles])
    assert len(back.vertices) == 8
    assert volume(back) == pytest.approx(1.0)


@pytest.mark.parametrize("suffix", [".ply", ".vtp"])
def test_what_rides_along_comes_back(tmp_path, suffix):
    attributes = {
        "uncertainty": np.linspace(0.27, 0.66, 8),
        "red": np.arange(8.0) * 30,
        "green": np.zeros(8),
        "blue": np.full(8, 255.0),
        "a b%": np.array([np.nan, np.inf, *range(6)]),
    }
    datum = {"crs": 'PROJCS["UTM 2N",\n AUTHORITY["EPSG","32602"]]', "vertical_datum": "MSL"}
    mesh = cube(attributes=attributes, **datum)
    bathyal.write_mesh(mesh, tmp_path / f"cube{suffix}")
    back = bathyal.read_mesh(tmp_path / f"cube{suffix}")
    assert set(back.attributes) == set(attributes)
    for name, values in attributes.items():
        assert np.array_equal(back.attributes[name], values, equal_nan=True), name
    assert back.crs.split() == datum["crs"].split()
    assert back.vertical_datum == "MSL"
    assert np.array_equal(back.triangles, mesh.triangles)


def test_obj_keeps_colours_and_the_reference_system(tmp_path):
    colours = {name: np.arange(8.0) * k for k, name in enumerate(("red", "green", "blue"), 1)}
    bathyal.write_mesh(cube(attributes=colours, crs="EPSG:32602"), tmp_path / "a.obj")
    back = bathyal.read_mesh(tmp_path / "a.obj")
    assert back.crs == "EPSG:32602"
    for name, values in colours.items():
        assert np.array_equal(back.attributes[name], values)


def test_stl_is_binary_where_that_loses_nothing_that_matters(tmp_path):
    small = bathyal.TriangleMesh(CUBE_VERTICES, cube().triangles)
    bathyal.write_mesh(small, tmp_path / "small.stl")
    bathyal.write_mesh(cube(), tmp_path / "far.stl")
    assert len((tmp_path / "small.stl").read_bytes()) == 84 + 12 * 50
    assert (tmp_path / "far.stl").read_bytes().startswith(b"solid")
    assert volume(bathyal.read_mesh(tmp_path / "small.stl")) == pytest.approx(1.0)


@given(
    points=st.lists(
        st.tuples(*[st.floats(-1e7, 1e7, allow_subnormal=False)] * 3), min_size=3, max_size=12
    ),
    suffix=st.sampled_from([".ply", ".vtp", ".obj", ".stl"]),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=80, deadline=None)
def test_any_mesh_comes_back_corner_for_corner(tmp_path_factory, points, suffix, seed):
    path = tmp_path_factory.getbasetemp() / f"any{suffix}"
    vertices = np.array(points)
    triangles = np.random.default_rng(seed).integers(0, len(points), (7, 3))
    bathyal.write_mesh(bathyal.TriangleMesh(vertices, triangles), path)
    back = bathyal.read_mesh(path)
    loss = 1e-5 if suffix == ".stl" else 0.0
    assert np.allclose(back.vertices[back.triangles], vertices[triangles], rtol=0, atol=loss)


def test_the_same_mesh_gives_the_same_bytes(tmp_path):
    for suffix in (".ply", ".vtp", ".obj", ".stl"):
        paths = [tmp_path / f"{i}{suffix}" for i in range(2)]
        for path in paths:
            bathyal.write_mesh(cube(crs="EPSG:32602"), path)
        assert paths[0].read_bytes() == paths[1].read_bytes()


# --- PLY -----------------------------------------------------------------------------------------

SQUARE = """ply
format ascii 1.0
comment made by hand
element vertex 4
property float x
property float y
property float z
property uchar red
element face 2
property uchar quality
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
1 1 0 3
0 1 0 255
{faces}
"""


def write_text(path, text):
    path.write_bytes(text.encode("latin-1"))
    return path


def test_ply_ascii_with_even_and_uneven_faces(tmp_path):
    even = SQUARE.format(faces="7 3 0 1 2\n7 3 0 2 3")
    uneven = SQUARE.format(faces="7 4 0 1 2 3\n7 3 0 2 3")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.ply", even))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.attributes["red"].tolist() == [1, 2, 3, 255]
    mesh = bathyal.read_mesh(write_text(tmp_path / "b.ply", uneven.replace("\n", "\r\n")))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 2, 3]]


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("sizes", [[3, 3, 3], [4, 3, 5]])
def test_ply_binary_of_either_byte_order(tmp_path, order, sizes):
    name = {"<": "little", ">": "big"}[order]
    header = (
        f"ply\nformat binary_{name}_endian 1.0\nelement vertex 5\nproperty double x\n"
        f"property float y\nproperty short z\nelement face 3\n"
        f"property list ushort uint vertex_index\nproperty float quality\n"
        f"element edge 1\nproperty int a\nend_header\n"
    )
    body = b""
    for i in range(5):
        body += np.array([i / 3], order + "f8").tobytes() + np.array([i], order + "f4").tobytes()
        body += np.array([-i], order + "i2").tobytes()
    for size in sizes:
        body += np.array([size], order + "u2").tobytes()
        body += np.arange(size).astype(order + "u4").tobytes()
        body += np.array([0.5], order + "f4").tobytes()
    body += np.array([4], order + "i4").tobytes()
    path = tmp_path / "a.ply"
    path.write_bytes(header.encode() + body)
    mesh = bathyal.read_mesh(path)
    assert np.array_equal(mesh.vertices, [[i / 3, i, -i] for i in range(5)])
    fans = [[0, k + 1, k + 2] for size in sizes for k in range(size - 2)]
    assert mesh.triangles.tolist() == fans
    for cut in range(len(header), len(header) + len(body)):
        path.write_bytes((header.encode() + body)[:cut])
        with pytest.raises(bathyal.Error):
            bathyal.read_mesh(path)


PLY_FAULTS = {
    "no ply": ("ply\n", "plx\n"),
    "no format": ("format ascii 1.0\n", ""),
    "unknown format": ("ascii", "utf16"),
    "unknown type": ("float x", "quad x"),
    "a property twice": ("float y", "float x"),
    "no z": ("float z", "float w"),
    "no end": ("end_header\n", ""),
    "negative count": ("vertex 4", "vertex -4"),
    "a billion vertices": ("vertex 4", "vertex 1000000000"),
    "a billion faces": ("face 2", "face 1000000000"),
    "more vertices than there are": ("vertex 4", "vertex 5"),
    "fewer faces than there are": ("face 2", "face 1"),
    "index of no vertex": ("0 2 3", "0 2 4"),
    "negative index": ("0 2 3", "0 2 -1"),
    "half an index": ("0 2 3", "0 2 1.5"),
    "a face of two": ("3 0 2 3", "2 0 2"),
    "a negative length": ("3 0 2 3", "-3 0 2 3"),
    "a word": ("1 0 0 2", "one 0 0 2"),
    "not a number": ("1 0 0 2", "nan 0 0 2"),
    "infinite": ("1 0 0 2", "inf 0 0 2"),
    "a colour above a byte": ("0 1 0 255", "0 1 0 256"),
    "no list": ("property list uchar int vertex_indices", "property int vertex_indices"),
    "strips": ("element face 2", "element tristrips 2"),
}


@pytest.mark.parametrize("fault", PLY_FAULTS)
def test_ply_faults_are_errors(tmp_path, fault):
    old, new = PLY_FAULTS[fault]
    text = SQUARE.format(faces="7 3 0 1 2\n7 3 0 2 3")
    assert old in text
    path = write_text(tmp_path / "a.ply", text.replace(old, new, 1))
    reason = "announces at least" if "billion" in fault else ""
    with pytest.raises(bathyal.Error, match=f"{re.escape(str(path))}: .*{reason}"):
        bathyal.read_mesh(path)


@pytest.mark.parametrize("suffix", [".ply", ".vtp", ".stl"])
def test_files_without_faces_name_the_other_reader(tmp_path, suffix):
    empty = bathyal.TriangleMesh(CUBE_VERTICES, np.empty((0, 3), int))
    bathyal.write_mesh(empty, tmp_path / f"a{suffix}")
    with pytest.raises(bathyal.Error, match="no faces; read_cloud"):
        bathyal.read_mesh(tmp_path / f"a{suffix}")
    if suffix != ".stl":
        bathyal.write_cloud(bathyal.PointCloud(CUBE_VERTICES), tmp_path / f"b{suffix}")
        with pytest.raises(bathyal.Error, match="no faces; read_cloud"):
            bathyal.read_mesh(tmp_path / f"b{suffix}")


# --- STL, OBJ, axes and units --------------------------------------------------------------------

FACET = """solid a vertex in a name
 FACET  normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1e0 0 0
   vertex 0 1 0
  endloop
 endfacet
endsolid a
"""


def test_stl_ascii_of_several_solids(tmp_path):
    second = FACET.replace("0 1 0\n", "0 2 0\n")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.stl", FACET + second), scale=0.001)
    assert len(mesh.triangles) == 2
    assert len(mesh.vertices) == 4
    assert mesh.vertices.max() == 0.002


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("endsolid a", ""),
        ("endfacet", ""),
        ("   vertex 0 1 0\n", ""),
        ("0 1 0", "0 1"),
        ("0 1 0", "0 x 0"),
        ("0 1 0", "0 nan 0"),
        ("solid a", "slid a"),
    ],
)
def test_stl_faults_are_errors(tmp_path, old, new):
    path = write_text(tmp_path / "a.stl", FACET.replace(old, new, 1))
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_mesh(path)


def test_equal_corners_of_stl_become_one_vertex_and_zero_has_no_sign(tmp_path):
    text = FACET + FACET.replace("0 0 0", "-0 0 -0.0").replace("0 1 0\n", "0 -1 0\n")
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.stl", text))
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0]]
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 1, 3]]


OBJ = """# a house
mtllib none.mtl
o house
v 0 0 0
v 1 0 0 # a comment
v 1 1 0
vn 0 0 1
f 1//1 2//1 \\
 3//1
v 0 1 0
v 0.5 1.5 0
usemtl roof
f -5/1 -3/2 -2/3
f 4 3 5
l 1 2
"""


def test_obj_with_slashes_continued_lines_and_counting_back(tmp_path):
    mesh = bathyal.read_mesh(write_text(tmp_path / "a.obj", OBJ))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 4]]
    assert mesh.vertices[4].tolist() == [0.5, 1.5, 0]


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("f 4 3 5", "f 4 3 6", "index 5 names no point"),
        ("f 4 3 5", "f 4 3 -6", "index -1 names no point"),
        ("f 4 3 5", "f 4 3 0", "is 0 or no whole number"),
        ("f 4 3 5", "f 4 3", "2 corners"),
        ("f 4 3 5", "f 4 3 x", "'x'"),
        ("v 0 1 0", "v 0 1", "all three numbers"),
        ("v 0 1 0", "v 0 1 nan", "finite"),
        ("l 1 2", "curv 0 1 1 2", "line 15: 'curv' is not read"),
        ("f ", "# ", "5 vertices and 0 faces"),
        ("v ", "# ", "0 vertices and 3 faces"),
    ],
)
def test_obj_faults_are_errors(tmp_path, old, new, reason):
    path = write_text(tmp_path / "a.obj", OBJ.replace(old, new))
    with pytest.raises(bathyal.Error, match=reason):
        bathyal.read_mesh(path)


@pytest.mark.parametrize(
    ("up", "expected"), [("z", [1, 2, 3]), ("y", [1, -3, 2]), ("x", [-2, -3, 1])]
)
def test_the_axis_that_points_up_becomes_z(tmp_path, up, expected):
    path = write_text(tmp_path / "a.obj", "v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n")
    assert bathyal.read_mesh(path, up=up).vertices[0].tolist() == expected


def test_normals_turn_with_the_mesh(tmp_path):
    normals = dict(zip(("nx", "ny", "nz"), np.eye(8, 3).T.copy(), strict=True))
    bathyal.write_mesh(cube(attributes=normals), tmp_path / "a.ply")
    back = bathyal.read_mesh(tmp_path / "a.ply", up="y").attributes
    assert [back[name][1] for name in ("nx", "ny", "nz")] == [0, 0, 1]


# --- polygons ------------------------------------------------------------------------------------


def test_concave_polygons_are_cut_without_folding():
    arrow = np.array([[0, 0, 0], [2, 1, 0], [0, 2, 0], [1, 1, 0.0]])
    for start in range(4):
        polygon = np.roll(np.arange(4), start)
        triangles = triangles_of_polygons(cells_of([polygon]), arrow)
        a, b, c = np.moveaxis(arrow[triangles], 1, 0)
        areas = np.cross(b - a, c - a)[:, 2] / 2
        assert np.all(areas > 0)
        assert areas.sum() == pytest.approx(1.0)


@given(
    radii=st.lists(st.floats(0.2, 1.0), min_size=4, max_size=30),
    turn=st.floats(0, 6.28),
    down=st.booleans(),
)
@settings(max_examples=100, deadline=None)
def test_star_shaped_polygons_keep_their_area(radii, turn, down):
    angle = turn + np.linspace(0, 2 * np.pi, len(radii), endpoint=False)
    flat = np.array(radii)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    points = UTM + flat @ np.array([[0.6, 0, 0.8], [0, 1, 0]])
    points = points[::-1].copy() if down else points
    x, y = flat.T
    known = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    triangles = triangles_of_polygons(cells_of([np.arange(len(points))]), points)
    a, b, c = np.moveaxis(points[triangles] - UTM, 1, 0)
    normals = np.cross(b - a, c - a) / 2
    assert np.linalg.norm(normals, axis=1).sum() == pytest.approx(known, abs=1e-7)
    assert len(triangles) == len(points) - 2


# --- COLLADA -------------------------------------------------------------------------------------

DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{unit}<up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0  1 0 0  1 1 0  0 1 7</float_array>
<technique_common><accessor source="#a" count="4" stride="3">
<param name="X"/><param name="Y"/><param name="Z"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
{primitive}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>"""
TRIANGLE = """<triangles count="1"><input semantic="VERTEX" source="#v" offset="1"/>
<input semantic="NORMAL" source="#n" offset="0"/><p>9 0 9 1 9 2</p></triangles>"""
PLACE = '<instance_geometry url="#g"/>'


def dae(nodes=f"<node>{PLACE}</node>", primitive=TRIANGLE, unit="", up="Z_UP"):
    return DAE.format(nodes=nodes, primitive=primitive, unit=unit, up=up)


def read_dae(tmp_path, **parts):
    return bathyal.read_mesh(write_text(tmp_path / "a.dae", dae(**parts)))


def test_collada_unit_and_up_axis(tmp_path):
    mesh = read_dae(tmp_path, unit='<unit name="inch" meter="0.0254"/>', up="Y_UP")
    assert mesh.vertices.tolist() == [[0, 0, 0], [0.0254, 0, 0], [0.0254, 0, 0.0254]]
    path = tmp_path / "a.dae"
    assert bathyal.read_mesh(path, scale=2.0, up="z").vertices.max() == 2.0


def test_collada_transforms_apply_in_order_and_nodes_are_instanced(tmp_path):
    nodes = f"""<node><translate>10 0 0</translate><rotate>0 0 1 90</rotate>
    <node id="leaf"><scale>2 3 1</scale>{PLACE}</node></node>
    <node><matrix>1 0 0 0 0 1 0 0 0 0 1 -5 0 0 0 1</matrix><instance_node url="#leaf"/></node>"""
    mesh = read_dae(tmp_path, nodes=nodes)
    expected = [[10, 0, 0], [10, 2, 0], [7, 2, 0], [0, 0, -5], [2, 0, -5], [2, 3, -5]]
    assert np.allclose(mesh.vertices, expected, atol=1e-12)
    assert mesh.triangles.tolist() == [[0, 1, 2], [3, 4, 5]]


def test_collada_looks_at(tmp_path):
    nodes = f"<node><lookat>0 0 5  1 0 5  0 0 1</lookat>{PLACE}</node>"
    # the node's −z looks along x, its y is up, so its x runs along −y
    assert np.allclose(
        read_dae(tmp_path, nodes=nodes).vertices, [[0, 0, 5], [0, -1, 5], [0, -1, 6]]
    )


def test_collada_mirrored_parts_still_face_outward(tmp_path):
    mesh = read_dae(tmp_path, nodes=f"<node><scale>-1 1 1</scale>{PLACE}</node>")
    a, b, c = mesh.vertices[mesh.triangles[0]]
    assert np.cross(b - a, c - a)[2] > 0


PRIMITIVES = {
    "polylist": ("<polylist>{i}<vcount>3 4</vcount><p>0 1 2 0 1 2 3</p></polylist>", 3),
    "polygons": ("<polygons>{i}<p>0 1 2</p><p>0 1 2 3</p></polygons>", 3),
    "trifans": ("<trifans>{i}<p>0 1 2 3</p></trifans>", 2),
    "tristrips": ("<tristrips>{i}<p>0 1 3 2</p></tristrips>", 2),
    "with lines": ("<lines>{i}<p>0 1</p></lines><triangles>{i}<p>0 1 2</p></triangles>", 1),
}


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_collada_primitives(tmp_path, kind):
    text, count = PRIMITIVES[kind]
    text = text.format(i='<input semantic="VERTEX" source="#v" offset="0"/>')
    mesh = read_dae(tmp_path, primitive=text)
    assert len(mesh.triangles) == count
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    assert np.all(np.cross(b - a, c - a)[:, 2] > 0)


def bomb():
    levels = [f'<node id="n0">{PLACE}</node>']
    for i in range(40):
        levels.append(f'<node id="n{i + 1}">{f"""<instance_node url="#n{i}"/>""" * 10}</node>')
    return "".join(levels)


COLLADA_FAULTS = {
    "a document type": dae().replace('"1.0"?>', '"1.0"?><!DOCTYPE a [<!ENTITY b "c">]>', 1),
    "another root": "<a/>",
    "no XML": "solid",
    "no faces": dae(primitive=""),
    "nothing shown": dae(nodes=""),
    "an index of no point": dae().replace("9 2<", "9 4<"),
    "a negative index": dae().replace("9 2<", "9 -2<"),
    "half a row": dae().replace("9 2<", "9<"),
    "words": dae().replace("9 2<", "9 two<"),
    "fewer numbers than announced": dae().replace('count="4"', 'count="5000000000"'),
    "not a number": dae().replace("1 1 0", "1 nan 0"),
    "a lost source": dae().replace('source="#s"', 'source="#t"'),
    "a lost geometry": dae().replace('url="#g"', 'url="#h"'),
    "a geometry elsewhere": dae().replace('url="#g"', 'url="file:///etc/passwd#g"'),
    "no unit": dae(unit='<unit meter="0"/>'),
    "a unit in words": dae(unit='<unit meter="long"/>'),
    "an unknown up axis": dae(up="W_UP"),
    "a transform cut short": dae(nodes=f"<node><matrix>1 0</matrix>{PLACE}</node>"),
    "a node in itself": dae(nodes=f'<node id="n">{PLACE}<instance_node url="#n"/></node>'),
    "nodes without end": dae(nodes=bomb()),
    "skinned": dae(nodes='<node><instance_controller url="#g"/></node>'),
    "holes": dae(primitive=TRIANGLE.replace("triangles", "polygons").replace("p>", "ph>")),
    "a polylist cut short": dae(primitive=PRIMITIVES["polylist"][0].format(
        i='<input semantic="VERTEX" source="#v" offset="0"/>').replace("3 4", "3 5")),
}  # fmt: skip


@pytest.mark.parametrize("fault", COLLADA_FAULTS)
def test_collada_faults_are_errors(tmp_path, fault):
    path = write_text(tmp_path / "a.dae", COLLADA_FAULTS[fault])
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_mesh(path)


# --- every format: what is not one ---------------------------------------------------------------

SUFFIXES = [".ply", ".stl", ".obj", ".dae", ".vtp"]


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "content",
    [b"", b"\0" * 200, bytes(range(256)) * 40, b"depth 1 2 3\n", b"\x89HDF\r\n\x1a\n" + b"\0" * 99],
    ids=["empty", "zeros", "bytes", "words", "HDF"],
)
def test_content_of_another_kind_is_an_error(tmp_path, suffix, content):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_mesh(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_suffix_that_lies_is_an_error(tmp_path, suffix):
    written = {".ply": ".stl", ".stl": ".ply", ".obj": ".ply", ".dae": ".vtp", ".vtp": ".obj"}
    bathyal.write_mesh(cube(), tmp_path / f"a{written[suffix]}")
    (tmp_path / f"a{written[suffix]}").rename(tmp_path / f"b{suffix}")
    with pytest.raises(bathyal.Error):
        bathyal.read_mesh(tmp_path / f"b{suffix}")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_cut_files_are_errors(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    if suffix == ".dae":
        write_text(path, dae())
    else:
        bathyal.write_mesh(cube(crs="EPSG:32602"), path)
    whole = path.read_bytes()
    for tenth in range(10):
        path.write_bytes(whole[: len(whole) * tenth // 10])
        if suffix == ".obj" and b"\nf " in path.read_bytes():
            continue  # OBJ has no end: a cut between its faces cannot be seen
        with pytest.raises(bathyal.Error):
            bathyal.read_mesh(path)


@given(data=st.data(), suffix=st.sampled_from(SUFFIXES))
@settings(max_examples=200, deadline=None)
def test_changed_bytes_are_read_or_refused(tmp_path_factory, data, suffix):
    path = tmp_path_factory.getbasetemp() / f"changed{suffix}"
    if suffix == ".dae":
        write_text(path, dae())
    else:
        bathyal.write_mesh(cube(crs="EPSG:32602"), path)
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(bathyal.Error):
        bathyal.read_mesh(path)


def test_huge_headers_take_no_memory(tmp_path):
    header = (
        "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\n"
        "property list uint int vertex_indices\nend_header\n"
    )
    path = write_text(tmp_path / "a.ply", header.format(1) + "0" * 100)
    assert refusal_and_memory("read_mesh", path)[0] == "Error"
    one_list = header.replace("1000000000", "0").format(1) + "\xff\xff\xff\x7f"
    for suffix, content in (
        (".ply", one_list),
        (".ply", header.replace("property", "propert")),
        (".stl", "\0" * 80 + "\xff\xff\xff\xff" + "\0" * 50),
        (".dae", COLLADA_FAULTS["fewer numbers than announced"]),
    ):
        path = write_text(tmp_path / f"a{suffix}", content)
        name, grown = refusal_and_memory("read_mesh", path)
        assert name == "Error"
        assert grown < 64e6


def test_arguments_are_named(tmp_path):
    path = tmp_path / "a.obj"
    bathyal.write_mesh(cube(), path)
    with pytest.raises(ValueError, match=r"`path`: expected a mesh file \(.dae .obj .ply .stl .vtp"):
        bathyal.read_mesh("a.xyz")
    with pytest.raises(ValueError, match="`path`: expected a mesh file"):
        bathyal.write_mesh(cube(), "a.dae")
    for scale in (0, -1, np.nan, np.inf):
        with pytest.raises(ValueError, match="`scale`: expected"):
            bathyal.read_mesh(path, scale=scale)
    with pytest.raises(ValueError, match="`up`: expected"):
        bathyal.read_mesh(path, up="down")
    with pytest.raises(FileNotFoundError):
        bathyal.read_mesh(tmp_path / "none.ply")
    with pytest.raises(FileNotFoundError, match="cannot write"):
        bathyal.write_mesh(cube(), tmp_path / "no" / "a.ply")
    with pytest.raises(ValueError, match="`attributes`: expected names other"):
        bathyal.write_mesh(cube(attributes={"x": np.zeros(8)}), tmp_path / "x.ply")
