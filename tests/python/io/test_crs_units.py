# SPDX-License-Identifier: BSD-3-Clause
"""Reference systems that are not in metres: one rule for all formats."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import bathyal
from bathyal import Error
from bathyal.io.formats.crs import check_metric, units_of
from bathyal.io.formats.wkt import parse_wkt
from tests.support.cloud_cases import ISO_19139, UTM, write_bag, write_las, write_text, write_tiff

FOOT, SURVEY_FOOT = 0.3048, 0.304800609601219
DEGREE = 'GEOGCS["NAD83",DATUM["d",SPHEROID["s",6378137,298.257]],PRIMEM["Greenwich",0],'
DEGREE += 'UNIT["degree",0.0174532925199433]]'


def projected(unit: str, factor: float, after: str = "") -> str:
    """WKT 1, whose datum has a unit of its own before the one of the coordinates."""
    return (
        f'PROJCS["a, (b) [c] ""d""",{DEGREE},PROJECTION["Lambert_Conformal_Conic_2SP"],'
        f'PARAMETER["false_easting",6561666.667],UNIT["{unit}",{factor!r}]{after}]'
    )


def vertical(unit: str, factor: float) -> str:
    return f'VERT_CS["NAVD88",VERT_DATUM["n",2005],UNIT["{unit}",{factor!r}],AXIS["Up",UP]]'


WKT2 = (
    'PROJCRS["p",BASEGEOGCRS["g",DATUM["d",ELLIPSOID["e",6378137,298.257,LENGTHUNIT["metre",1]]],'
    'ANGLEUNIT["degree",0.0174532925199433]],CONVERSION["c",METHOD["m"],'
    'PARAMETER["False easting",2000000,LENGTHUNIT["metre",1]]],CS[Cartesian,{size}],'
    'AXIS["easting (X)",east,ORDER[1],LENGTHUNIT["{across}",{a!r}]],'
    'AXIS["northing (Y)",north,ORDER[2],LENGTHUNIT["{across}",{a!r}]]{third}]'
)
THIRD = ',AXIS["height",up,ORDER[3],LENGTHUNIT["{up}",{u!r}]]'
WKT2_VERTICAL = (
    'VERTCRS["v",VDATUM["d"],CS[vertical,1],AXIS["height",up],LENGTHUNIT["foot",0.3048]]'
)
WKT2_FEET = WKT2.format(size=2, across="foot", a=FOOT, third="")
WKT2_METRES = WKT2.format(size=2, across="metre", a=1.0, third="")

NONE = (None, None)
SYSTEMS = {
    "": NONE,
    "local grid of the harbour": NONE,
    'PROJCS["UTM 2N"]': NONE,
    'PROJCS["UTM 2N",AUTHORITY["EPSG","32602"]]': NONE,
    'PROJCS["CA 3",AUTHORITY["EPSG","2227"]]': (SURVEY_FOOT, None),
    projected("metre", 1.0): (1, None),
    projected("foot", FOOT): (FOOT, None),
    projected("US survey foot", SURVEY_FOOT): (SURVEY_FOOT, None),
    projected("metre", FOOT): (FOOT, None),
    projected("fathom", -1.0): (np.nan, None),
    f'COMPD_CS["c",{projected("metre", 1.0)},{vertical("foot", FOOT)}]': (1, FOOT),
    f'COMPD_CS["c",{projected("foot", FOOT)},{vertical("metre", 1.0)}]': (FOOT, 1),
    f"{projected('Foot_US', SURVEY_FOOT)},{vertical('Meter', 1.0)}": (SURVEY_FOOT, 1),
    vertical("foot", FOOT): (None, FOOT),
    f'LOCAL_CS["site",UNIT["foot",{FOOT}]]': (FOOT, None),
    WKT2_FEET: (FOOT, None),
    WKT2_METRES: (1, None),
    WKT2.format(size=3, across="metre", a=1.0, third=THIRD.format(up="foot", u=FOOT)): (1, FOOT),
    f'COMPOUNDCRS["c",{WKT2_METRES},{WKT2_VERTICAL}]': (1, FOOT),
    f'BOUNDCRS[SOURCECRS[{WKT2_FEET}],TARGETCRS[GEOGCRS["WGS 84"]]]': (FOOT, None),
    projected("foot", FOOT)[:-5]: (np.nan, None),  # cut short
    "EPSG:32602": NONE,
    "EPSG:2227": (SURVEY_FOOT, None),
    "epsg:2222": (FOOT, None),
    "urn:ogc:def:crs:EPSG::2222": (FOOT, None),
    "EPSG:32602+6360": (None, SURVEY_FOOT),
    "EPSG:6360": (None, SURVEY_FOOT),
    "EPSG:5714": NONE,
    "+proj=utm +zone=2 +units=m": (1, None),
    "+proj=lcc +units=us-ft +vunits=ft": (SURVEY_FOOT, FOOT),
    "+proj=lcc +to_meter=0.3048": (FOOT, None),
    "+proj=lcc +units=parsec": (np.nan, None),
}


@pytest.mark.parametrize("crs", SYSTEMS)
def test_units_of(crs):
    units = units_of(crs)
    for unit, metres in zip((units.horizontal, units.vertical), SYSTEMS[crs], strict=True):
        if metres is None:
            assert unit is None
        else:
            assert unit is not None
            assert unit.metres == pytest.approx(metres, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(
    "crs",
    [
        DEGREE,
        DEGREE[:60],
        f'COMPD_CS["c",{DEGREE},{vertical("metre", 1.0)}]',
        'GEOGCRS["WGS 84"]',
        "EPSG:4326",
        "EPSG:4326+5773",
        "EPSG:4979",
        "+proj=longlat +datum=WGS84",
    ],
)
def test_degrees_are_refused(crs):
    with pytest.raises(Error, match="longitude and latitude"):
        units_of(crs)
    with pytest.raises(ValueError, match="`crs`: expected a reference system in metres"):
        check_metric("crs", crs)


def test_broken_wkt_is_none():
    for text in ("A[", "A]", "[1]", "A[1]B", 'A["x]', "A[" * 1000 + "]" * 1000, "A[1] 2"):
        assert parse_wkt(text) is None, text
    node = parse_wkt('a["x ""y""", 1e3 ,NORTH,B(2)]')[0]
    assert (node.keyword, node.values) == ("A", ['x "y"', "1e3", "NORTH"])
    assert (node.children[0].keyword, node.children[0].values) == ("B", ["2"])


def _las(path, crs):
    write_las(path, records=[(2112, crs.encode() + b"\0")])


def _bag(path, crs):
    code = crs.replace("&", "&amp;").replace("<", "&lt;")
    write_bag(path, ISO_19139.replace('PROJCS["UTM Zone 19"]', code))


def _tiff(path, crs):
    write_tiff(path, crs=crs)


def _text(path, crs):
    write_text(path, f"# crs {crs}\n1 2 3\n")


def _with_note(path, crs):
    bathyal.write_cloud(bathyal.PointCloud([UTM], crs=crs), path)


WRITERS = {
    ".las": _las, ".laz": _las, ".bag": _bag, ".tif": _tiff, ".xyz": _text, ".csv": _with_note,
    ".ply": _with_note, ".vtp": _with_note,
}  # fmt: skip


@pytest.mark.parametrize("suffix", WRITERS)
def test_clouds_in_feet_need_a_scale(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    crs = "EPSG:2222" if suffix == ".tif" else projected("foot", FOOT)
    WRITERS[suffix](path, crs)
    with pytest.raises(ValueError, match=r"`scale`: expected metres .* positions in foot.*, got"):
        bathyal.read_cloud(path)
    in_feet = bathyal.read_cloud(path, scale=1.0)
    cloud = bathyal.read_cloud(path, scale=FOOT, vertical_datum="MSL")
    assert np.allclose(cloud.points, FOOT * in_feet.points, rtol=1e-15)
    assert (cloud.crs, cloud.vertical_datum) == ("", "MSL")  # no longer the file's system
    assert bathyal.read_cloud(path, scale=FOOT, crs="EPSG:32610").crs == "EPSG:32610"
    with pytest.raises(ValueError, match="`crs`: expected a reference system in metres, got one"):
        bathyal.read_cloud(path, scale=FOOT, crs="EPSG:2222")


def test_heights_in_feet_need_a_scale(tmp_path):
    path = tmp_path / "a.las"
    _las(path, f'COMPD_CS["c",{projected("metre", 1.0)},{vertical("US survey foot", SURVEY_FOOT)}]')
    says = r"positions in metre and heights in US survey foot, such as \(1, 1, 0\.304800609601\)"
    with pytest.raises(ValueError, match=says):
        bathyal.read_cloud(path)
    cloud = bathyal.read_cloud(path, scale=(1, 1, SURVEY_FOOT))
    assert (cloud.crs, cloud.vertical_datum) == ("", "NAVD88")
    metres = ISO_19139.replace('VERT_CS["MLLW depth"]', vertical("foot", FOOT))
    write_bag(tmp_path / "a.bag", metres)
    with pytest.raises(ValueError, match="heights in foot"):
        bathyal.read_cloud(tmp_path / "a.bag")
    write_text(tmp_path / "a.xyz", "# crs EPSG:32602\n# vertical_datum EPSG:6360\n1 2 3\n")
    with pytest.raises(ValueError, match="heights in US survey foot"):
        bathyal.read_cloud(tmp_path / "a.xyz")


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({3072: 2227}, "positions in US survey foot"),
        ({3072: 32602, 3076: 9002}, "positions in foot"),
        ({3072: 32767, 3076: 9003}, "positions in US survey foot"),
        ({3072: 32767, 3076: 32767}, "positions in the unit EPSG:32767"),
        ({3072: 32602, 4096: 6360}, "heights in US survey foot"),
        ({3072: 32602, 4096: 5703, 4099: 9002}, "heights in foot"),
    ],
)
def test_las_keys_in_feet_need_a_scale(tmp_path, keys, says):
    path = tmp_path / "a.las"
    flat = [number for key, value in keys.items() for number in (key, 0, 1, value)]
    directory = struct.pack(f"<{4 + len(flat)}H", 1, 1, 0, len(keys), *flat)
    write_las(path, "1.2", 3, records=[(34735, directory)])
    with pytest.raises(ValueError, match=says):
        bathyal.read_cloud(path)
    assert bathyal.read_cloud(path, scale=1.0).crs == ""


def test_las_keys_in_metres_need_none(tmp_path):
    path = tmp_path / "a.las"
    keys = struct.pack("<16H", 1, 1, 0, 3, 3072, 0, 1, 32602, 3076, 0, 1, 9001, 4099, 0, 1, 9001)
    write_las(path, "1.2", 3, records=[(34735, keys)])
    assert bathyal.read_cloud(path).crs == "EPSG:32602"
    degrees = struct.pack("<8H", 1, 1, 0, 1, 1024, 0, 1, 2)
    write_las(path, "1.2", 3, records=[(34735, degrees)])
    with pytest.raises(Error, match="longitude and latitude"):
        bathyal.read_cloud(path)


def test_las_extended_records_are_looked_at(tmp_path):
    laspy = pytest.importorskip("laspy")
    path = tmp_path / "a.las"
    las = write_las(path)
    wkt = projected("foot", FOOT).encode()
    las.evlrs = laspy.vlrs.vlrlist.VLRList([laspy.VLR("LASF_Projection", 2112, "", wkt)])
    las.write(path)
    with pytest.raises(ValueError, match="positions in foot"):
        bathyal.read_cloud(path)
    content = bytearray(path.read_bytes())
    struct.pack_into("<I", content, 243, 2**32 - 1)
    path.write_bytes(content)
    with pytest.raises(Error, match="4294967295 extended records"):
        bathyal.read_cloud(path)


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".vtp"])
def test_meshes_in_feet_need_a_scale(tmp_path, suffix):
    path = tmp_path / f"a{suffix}"
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    bathyal.write_mesh(bathyal.TriangleMesh(corners, [[0, 1, 2]], crs="EPSG:2222"), path)
    with pytest.raises(ValueError, match=r"`scale`: expected metres .* positions in foot"):
        bathyal.read_mesh(path)
    mesh = bathyal.read_mesh(path, scale=FOOT)
    assert mesh.crs == ""
    assert mesh.vertices[1].tolist() == [FOOT, 0, 0]
    bathyal.write_mesh(bathyal.TriangleMesh(corners, [[0, 1, 2]], crs="EPSG:4326"), path)
    with pytest.raises(Error, match="longitude and latitude"):
        bathyal.read_mesh(path)
