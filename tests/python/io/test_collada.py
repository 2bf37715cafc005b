# SPDX-License-Identifier: BSD-3-Clause
"""Meshes from COLLADA."""

from __future__ import annotations

import re

import numpy as np
import pytest

import bathyal
from tests.support.mesh_cases import PLACE, TRIANGLE, dae, write_text


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
