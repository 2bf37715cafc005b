# SPDX-License-Identifier: BSD-3-Clause
"""Small meshes and files of meshes that the tests of every format start from."""

from __future__ import annotations

import numpy as np

import bathyal
from bathyal.io.formats.meshes.cells import cells_of
from bathyal.io.formats.meshes.polygons import triangles_of_polygons

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


def write_text(path, text):
    path.write_bytes(text.encode("latin-1"))
    return path


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
