# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from and to text, PLY, PCD, LAS, BAG, GeoTIFF and VTP."""

from __future__ import annotations

import contextlib
import pathlib
import re
import struct
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from file_cases import measured, refusal_and_memory

UTM = np.array([620152.873, 7246504.912, -51.987])
JD211 = "seabed/jd211/JD211_public_Release_1-4_UTM.bag"


def survey(count=50, **extras):
    points = UTM + np.random.default_rng(3).normal(size=(count, 3))
    return bathyal.PointCloud(points, **extras)


def write_text(path, text):
    path.write_bytes(text.encode())
    return path


# --- BAG -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def jd211():
    with pytest.warns(UserWarning, match=r"\+2.000 m, \+2.000 m off"):
        return bathyal.read_cloud(measured(JD211))


def test_jd211_stands_where_libgdal_puts_it(jd211):
    decoded = np.load(measured("seabed/jd211/jd211_derived_grid.npz"))
    elevation = decoded["elevation_m"]
    row, column = np.nonzero(np.isfinite(elevation))
    assert len(jd211) == len(row) == 1_157_306
    x = decoded["x0_m"] + (column + 0.5) * decoded["dx"]
    y = decoded["y0_m"] + (row + 0.5) * decoded["dy"]
    expected = np.column_stack([x, y, elevation[row, column]])
    assert np.abs(jd211.points - expected).max() <= 1e-6
    assert np.array_equal(jd211.attributes["uncertainty"], decoded["uncertainty_m"][row, column])


def test_jd211_says_what_its_positions_refer_to(jd211):
    assert jd211.crs == "EPSG:32602"
    assert jd211.vertical_datum == "Mean Sea Level"
    assert jd211.points[:, 2].min() == pytest.approx(-52.957, abs=5e-4)
    assert jd211.points[:, 2].max() == pytest.approx(-50.987, abs=5e-4)


ISO_19139 = """<?xml version="1.0"?>
<gmi:MI_Metadata xmlns:gmi="http://www.isotc211.org/2005/gmi"
 xmlns:gmd="http://www.isotc211.org/2005/gmd" xmlns:gco="http://www.isotc211.org/2005/gco"
 xmlns:gml="http://www.opengis.net/gml/3.2"><gmd:spatialRepresentationInfo>
<gmd:MD_Georectified>
<gmd:axisDimensionProperties><gmd:MD_Dimension>
<gmd:dimensionName><gmd:MD_DimensionNameTypeCode>row</gmd:MD_DimensionNameTypeCode>
</gmd:dimensionName><gmd:dimensionSize><gco:Integer>3</gco:Integer></gmd:dimensionSize>
<gmd:resolution><gco:Measure uom="Metres">0.5</gco:Measure></gmd:resolution>
</gmd:MD_Dimension></gmd:axisDimensionProperties>
<gmd:axisDimensionProperties><gmd:MD_Dimension>
<gmd:dimensionName><gmd:MD_DimensionNameTypeCode>column</gmd:MD_DimensionNameTypeCode>
</gmd:dimensionName><gmd:dimensionSize><gco:Integer>4</gco:Integer></gmd:dimensionSize>
<gmd:resolution><gco:Measure uom="Metres">0.25</gco:Measure></gmd:resolution>
</gmd:MD_Dimension></gmd:axisDimensionProperties>
<gmd:cornerPoints><gml:Point gml:id="id1">
<gml:coordinates>500000,4000000 500000.75,4000001</gml:coordinates></gml:Point>
</gmd:cornerPoints></gmd:MD_Georectified></gmd:spatialRepresentationInfo>
<gmd:referenceSystemInfo><gmd:MD_ReferenceSystem><gmd:RS_Identifier><gmd:code>
<gco:CharacterString>PROJCS["UTM Zone 19"]</gco:CharacterString></gmd:code>
</gmd:RS_Identifier></gmd:MD_ReferenceSystem></gmd:referenceSystemInfo>
<gmd:referenceSystemInfo><gmd:MD_ReferenceSystem><gmd:RS_Identifier><gmd:code>
<gco:CharacterString>VERT_CS["MLLW depth"]</gco:CharacterString></gmd:code>
</gmd:RS_Identifier></gmd:MD_ReferenceSystem></gmd:referenceSystemInfo>
</gmi:MI_Metadata>"""


def write_bag(path, metadata=ISO_19139, shape=(3, 4), **layers):
    h5py = pytest.importorskip("h5py")
    elevation = -np.arange(12, dtype=np.float32).reshape(3, 4)
    elevation[1, 2] = 1e6
    with h5py.File(path, "w") as file:
        root = file.create_group("BAG_root")
        root["metadata"] = np.frombuffer(metadata.encode(), "S1")
        root["elevation"] = layers.get("elevation", elevation)
        if shape != (3, 4):
            del root["elevation"]
            root.create_dataset("elevation", shape, "f4", chunks=(1, 1))
        root["uncertainty"] = layers.get("uncertainty", np.full((3, 4), 0.5, np.float32))
    return path


def test_bag_of_the_later_metadata(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        cloud = bathyal.read_cloud(write_bag(tmp_path / "a.bag"))
    assert len(cloud) == 11
    assert cloud.points[0].tolist() == [500000.0, 4000001.0, -8.0]  # the north-west node
    assert cloud.points[4].tolist() == [500000.0, 4000000.5, -4.0]
    assert cloud.points[-1].tolist() == [500000.75, 4000000.0, -3.0]
    assert -6.0 not in cloud.points[:, 2]
    assert cloud.crs == 'PROJCS["UTM Zone 19"]'
    assert cloud.vertical_datum == "MLLW depth"
    assert bathyal.read_cloud(tmp_path / "a.bag", vertical_datum="MSL").vertical_datum == "MSL"


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("PROJCS", "GEOGCS", "longitude and latitude"),
        ("500000,4000000 ", "500000,", "3 of four corner"),
        (">0.5<", ">0<", "resolutions 0.25 and 0.0"),
        (">0.5<", ">half<", "could not convert"),
        ("500000,4000000 ", "nan,4000000 ", "not finite"),
        ("<?xml", "<!DOCTYPE a [<!ENTITY b 'c'>]><?xml", "XML"),
        ("?>\n<gmi:MI", '?><!DOCTYPE a [<!ENTITY b "c">]><gmi:MI', "document type"),
        ("</gmi:MI_Metadata>", "", "well-formed"),
    ],
)
def test_bag_metadata_faults_are_errors(tmp_path, old, new, reason):
    assert old in ISO_19139
    path = write_bag(tmp_path / "a.bag", ISO_19139.replace(old, new, 1))
    with pytest.raises(bathyal.Error, match=reason):
        bathyal.read_cloud(path)


def test_bag_layers_that_do_not_fit_are_errors(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = write_bag(tmp_path / "a.bag", uncertainty=np.zeros((2, 2), np.float32))
    with pytest.raises(bathyal.Error, match="uncertainty has shape"):
        bathyal.read_cloud(path)
    path = write_bag(tmp_path / "b.bag", shape=(100_000, 100_000))
    with pytest.raises(bathyal.Error, match="announces 10000000000 cells"):
        bathyal.read_cloud(path)
    with h5py.File(tmp_path / "c.bag", "w") as file:
        file.create_group("other")
    with pytest.raises(bathyal.Error, match="BAG_root"):
        bathyal.read_cloud(tmp_path / "c.bag")
    path = write_bag(tmp_path / "e.bag")
    with h5py.File(path, "a") as file:
        del file["BAG_root/elevation"]
        file["BAG_root/elevation"] = h5py.ExternalLink(
            str(tmp_path / "a.bag"), "/BAG_root/elevation"
        )
    with pytest.raises(bathyal.Error, match="link to another place"):
        bathyal.read_cloud(path)
    path = write_bag(tmp_path / "d.bag")
    with h5py.File(path, "a") as file:
        file["BAG_root/varres_refinements"] = np.zeros((1, 1))
    with pytest.raises(bathyal.Error, match="resolution varies"):
        bathyal.read_cloud(path)


# --- GeoTIFF -------------------------------------------------------------------------------------


def write_tiff(path, crs="EPSG:32602", bands=None, nodata=-9999.0, origin=UTM, **profile):
    rasterio = pytest.importorskip("rasterio")
    bands = [np.array([[-51, -9999, -52.5], [-53, -54, np.nan]])] if bands is None else bands
    height, width = bands[0].shape
    transform = rasterio.Affine(2.0, 0, origin[0], 0, -1.0, origin[1])
    with rasterio.open(
        path, "w", driver="GTiff", height=height, width=width, count=len(bands),
        dtype=profile.pop("dtype", "float32"), crs=crs, transform=transform, nodata=nodata,
    ) as grid:  # fmt: skip
        for i, band in enumerate(bands, 1):
            grid.write(band.astype(grid.dtypes[0]), i)
        for name, value in profile.items():
            setattr(grid, name, value)
    return path


def test_geotiff_gives_pixel_centres_without_the_empty_ones(tmp_path):
    spread = np.arange(6.0).reshape(2, 3)
    heights = np.array([[-51, -9999, -52.5], [-53, -54, np.nan]])
    path = write_tiff(
        tmp_path / "a.tif", bands=[spread, heights], descriptions=("Uncertainty", "elevation")
    )
    cloud = bathyal.read_cloud(path, band=2)
    expected = UTM[:2] + np.array([[1, -0.5], [5, -0.5], [1, -1.5], [3, -1.5]])
    assert np.allclose(cloud.points[:, :2], expected, rtol=0, atol=1e-6)
    assert cloud.points[:, 2].tolist() == [-51, -52.5, -53, -54]
    assert cloud.attributes["uncertainty"].tolist() == [0, 2, 3, 4]
    assert cloud.crs == "EPSG:32602"
    assert bathyal.read_cloud(path).points[:, 2].tolist() == [0, 1, 2, 3, 4, 5]
    with pytest.raises(ValueError, match="`band`: expected a number from 1 to 2, got 3"):
        bathyal.read_cloud(path, band=3)


def test_geotiff_of_whole_numbers_with_scale_and_offset(tmp_path):
    path = write_tiff(
        tmp_path / "a.tif", bands=[np.array([[100, -1]])], dtype="int16", nodata=-1,
        scales=(0.01,), offsets=(-50.0,),
    )  # fmt: skip
    assert bathyal.read_cloud(path).points[:, 2].tolist() == [-49.0]


def test_geotiff_depths_units_and_degrees_are_said_not_guessed(tmp_path):
    path = write_tiff(tmp_path / "a.tif", descriptions=("Depth",))
    with pytest.raises(ValueError, match="'Depth'"):
        bathyal.read_cloud(path)
    assert bathyal.read_cloud(path, z="down").points[0, 2] == 51
    path = write_tiff(tmp_path / "b.tif", crs="EPSG:2227")  # US survey feet
    with pytest.raises(ValueError, match="`scale`: expected metres"):
        bathyal.read_cloud(path)
    foot = bathyal.read_cloud(path, scale=(0.3048, 0.3048, 1)).points[0]
    assert foot[0] == pytest.approx((UTM[0] + 1) * 0.3048)
    path = write_tiff(tmp_path / "c.tif", crs="EPSG:4326", origin=(10.0, 60.0))
    with pytest.raises(bathyal.Error, match="longitude and latitude"):
        bathyal.read_cloud(path)


def test_geotiff_without_a_place_is_an_error(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    with (
        pytest.warns(rasterio.errors.NotGeoreferencedWarning),
        rasterio.open(tmp_path / "a.tif", "w", driver="GTiff", height=1, width=1, count=1,
                      dtype="float32") as grid,
    ):  # fmt: skip
        grid.write(np.zeros((1, 1, 1), np.float32))
    with pytest.raises(bathyal.Error, match="where its pixels are"):
        bathyal.read_cloud(tmp_path / "a.tif")


def test_geotiff_sizes_are_checked(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    path, transform = tmp_path / "a.tif", rasterio.Affine(1, 0, 6e5, 0, -1, 7e6)
    with rasterio.open(path, "w", driver="GTiff", height=200_000, width=200_000, count=1,
                       dtype="float32", tiled=True, sparse_ok=True, crs="EPSG:32602",
                       transform=transform, compress="zstd", blockxsize=16384,
                       blockysize=16384):  # fmt: skip
        pass
    name, grown = refusal_and_memory("read_cloud", path)
    assert name == "Error"
    assert grown < 128e6  # GDAL itself


# --- LAS -----------------------------------------------------------------------------------------


def write_las(path, version="1.4", point_format=7, count=100, records=()):
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(point_format=point_format, version=version)
    header.scales, header.offsets = [0.001] * 3, [620000, 7246000, 0]
    header.add_extra_dim(laspy.ExtraBytesParams("uncertainty", "f8"))
    for number, content in records:
        header.vlrs.append(laspy.VLR("LASF_Projection", number, "", content))
    las = laspy.LasData(header)
    random = np.random.default_rng(4)
    las.x, las.y, las.z = (UTM + random.normal(size=(count, 3))).T
    las.intensity = np.arange(count)
    las.classification = np.arange(count) % 30
    las.uncertainty = random.random(count)
    if "red" in las.point_format.dimension_names:
        las.red, las.green = np.full(count, 65535), np.full(count, 257)
    las.write(path)
    return las


@pytest.mark.parametrize("suffix", [".las", ".laz"])
@pytest.mark.parametrize(("version", "point_format"), [("1.2", 3), ("1.4", 7), ("1.4", 6)])
def test_las(tmp_path, suffix, version, point_format):
    if suffix == ".laz":
        pytest.importorskip("lazrs")
    las = write_las(tmp_path / f"a{suffix}", version, point_format)
    cloud = bathyal.read_cloud(tmp_path / f"a{suffix}")
    assert np.array_equal(cloud.points, np.column_stack([las.x, las.y, las.z]))
    assert np.array_equal(cloud.attributes["uncertainty"], las.uncertainty)
    assert np.array_equal(cloud.attributes["intensity"], np.arange(100))
    assert np.array_equal(cloud.attributes["classification"], np.arange(100) % 30)
    if point_format != 6:
        assert set(cloud.attributes["red"]) == {255.0}
        assert set(cloud.attributes["green"]) == {1.0}


def test_las_reference_systems(tmp_path):
    path = tmp_path / "a.las"
    wkt = b'COMPD_CS["both",PROJCS["UTM 2N"],VERT_CS["MSL height"]]\0'
    write_las(path, records=[(2112, wkt)])
    cloud = bathyal.read_cloud(path)
    assert cloud.crs == wkt.rstrip(b"\0").decode()
    assert cloud.vertical_datum == "MSL height"
    keys = struct.pack("<12H", 1, 1, 0, 2, 3072, 0, 1, 32602, 4096, 0, 1, 5714)
    write_las(path, "1.2", 3, records=[(34735, keys)])
    cloud = bathyal.read_cloud(path)
    assert (cloud.crs, cloud.vertical_datum) == ("EPSG:32602", "EPSG:5714")
    degrees = struct.pack("<8H", 1, 1, 0, 1, 2048, 0, 1, 4326)
    write_las(path, "1.2", 3, records=[(34735, degrees)])
    with pytest.raises(bathyal.Error, match="longitude and latitude"):
        bathyal.read_cloud(path)


def test_las_headers_are_checked(tmp_path):
    path = tmp_path / "a.las"
    write_las(path, "1.2", 3)
    whole = path.read_bytes()
    for place, form, value in ((107, "<I", 30_000_000), (100, "<I", 2**32 - 1), (96, "<I", 2**31),
                               (105, "<H", 3), (104, "<B", 99)):  # fmt: skip
        content = bytearray(whole)
        struct.pack_into(form, content, place, value)
        path.write_bytes(content)
        name, grown = refusal_and_memory("read_cloud", path)
        assert name == "Error", place
        assert grown < 64e6
    struct.pack_into("<I", content := bytearray(whole), 107, 30_000_000)
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match="header announces 30000000 points"):
        bathyal.read_cloud(path)


def test_laz_chunks_are_checked(tmp_path):
    pytest.importorskip("lazrs")
    path = tmp_path / "a.laz"
    las = write_las(path)
    whole = path.read_bytes()
    points = struct.unpack_from("<I", whole, 96)[0]
    table = struct.unpack_from("<q", whole, points)[0]
    layers = points + 8 + las.point_format.size + 4
    for place, value, reason in (
        (table + 4, b"\xff\xff\xff\xff", "4294967295 chunks"),
        (table + 4, b"\0\0\0\0", "hold fewer than the 100 points"),
        (points, b"\xff\xff\xff\x7f\0\0\0\0", "table of its chunks is not in the file"),
        (layers, b"\xff\xff\xff\xff", "layers of the chunk"),
    ):
        content = bytearray(whole)
        content[place : place + len(value)] = value
        path.write_bytes(content)
        with pytest.raises(bathyal.Error, match=reason):
            bathyal.read_cloud(path)


# --- text ----------------------------------------------------------------------------------------


def test_text_columns_found_by_name(tmp_path):
    text = "time,Northing [m],Easting [m],Elevation,TVU,note\n1,7e6,6e5,-51.5,0.3,4\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.csv", text))
    assert cloud.points.tolist() == [[6e5, 7e6, -51.5]]
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"time": [1.0], "uncertainty": [0.3], "note": [4.0]}


def test_text_names_in_a_comment(tmp_path):
    text = "# crs EPSG:32602\n# vertical_datum: MSL\n# y x z intensity\n1 2 3 4\n5 6 7 8\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.xyz", text))
    assert cloud.points.tolist() == [[2, 1, 3], [6, 5, 7]]
    assert cloud.attributes["intensity"].tolist() == [4, 8]
    assert (cloud.crs, cloud.vertical_datum) == ("EPSG:32602", "MSL")
    assert bathyal.read_cloud(tmp_path / "a.xyz", crs="EPSG:32603").crs == "EPSG:32603"


def test_text_names_that_come_twice_lose_nothing(tmp_path):
    path = write_text(tmp_path / "rgb.csv", "x,y,z,R,G,B,std\n1,2,3,4,5,6,7\n")
    assert sorted(bathyal.read_cloud(path).attributes) == ["blue", "green", "red", "std"]
    path = write_text(tmp_path / "a.csv", "x,y,z,x,a,a,\n1,2,3,4,5,6,7\n")
    cloud = bathyal.read_cloud(path)
    assert cloud.points.tolist() == [[1, 2, 3]]
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"column_3": [4], "a": [5], "column_5": [6], "column_6": [7]}
    for suffix in (".xyz", ".csv", ".ply"):
        with pytest.raises(ValueError, match="`attributes`: expected names other"):
            survey(1, attributes={"x": np.zeros(1)}).write(tmp_path / f"b{suffix}")


def test_text_without_names(tmp_path):
    title = "Survey north\n# made by hand\n1 2 3\n4 5 6\n"
    cloud = bathyal.read_cloud(write_text(tmp_path / "b.xyz", title))
    assert cloud.points.tolist() == [[1, 2, 3], [4, 5, 6]]
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.txt", "1;2;3;4\n5;6;7;8\n"))
    assert cloud.points.tolist() == [[1, 2, 3], [5, 6, 7]]
    assert cloud.attributes["column_3"].tolist() == [4, 8]


@pytest.mark.parametrize(
    "columns",
    [[2, 1, 0, 3], ["c", "b", "a", "d"], {"x": 2, "y": "b", "z": 0, "d": 3}],
)
def test_text_columns_said(tmp_path, columns):
    path = write_text(tmp_path / "a.csv", "a,b,c,d,e\n1,2,3,4,word\n")
    cloud = bathyal.read_cloud(path, columns=columns)
    assert cloud.points.tolist() == [[3, 2, 1]]
    assert {name: v.tolist() for name, v in cloud.attributes.items()} == {"d": [4]}


def test_text_options_reach_the_reader(tmp_path):
    path = write_text(tmp_path / "a.txt", "made by hand\n1,5;2,5;3,5\n")
    cloud = bathyal.read_cloud(path, skip_lines=1, decimal=",", separator=";")
    assert cloud.points.tolist() == [[1.5, 2.5, 3.5]]


def test_esri_grid(tmp_path):
    text = ("ncols 2\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nnodata_value -1\n"
            "5 6\n-1 8\n")  # fmt: skip
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.asc", text), z="down", scale=2.0)
    assert cloud.points.tolist() == [[210, 430, -10], [230, 430, -12], [230, 410, -16]]


def test_depths_are_said_not_guessed(tmp_path):
    path = write_text(tmp_path / "a.csv", "x,y,Depth (m),tvu\n1,2,51.5,0.3\n")
    with pytest.raises(ValueError, match=r"`z`: expected .* calls it 'Depth \(m\)', got None"):
        bathyal.read_cloud(path)
    assert bathyal.read_cloud(path, z="down").points.tolist() == [[1, 2, -51.5]]
    assert bathyal.read_cloud(path, z="up").points.tolist() == [[1, 2, 51.5]]
    with pytest.raises(ValueError, match="`z`: expected"):
        bathyal.read_cloud(path, columns=["x", "y", "Depth (m)"])
    nameless = write_text(tmp_path / "b.csv", "1,2,51.5\n")
    assert bathyal.read_cloud(nameless).points[0, 2] == 51.5
    assert bathyal.read_cloud(nameless, z="down").points[0, 2] == -51.5


def test_units_are_said_not_guessed(tmp_path):
    path = write_text(tmp_path / "a.csv", "x [m],y [m],z [ft],uncertainty\n1,2,10,1\n")
    with pytest.raises(ValueError, match=r"`scale`: expected metres .* 'ft'"):
        bathyal.read_cloud(path)
    cloud = bathyal.read_cloud(path, scale=(1, 1, 0.3048))
    assert cloud.points.tolist() == [[1, 2, 3.048]]
    assert cloud.attributes["uncertainty"].tolist() == [0.3048]


def test_degrees_are_refused_with_the_reason(tmp_path):
    path = write_text(tmp_path / "a.csv", "lon,lat,z\n10.5,60.1,-5\n")
    with pytest.raises(bathyal.Error, match="longitude and latitude in degrees: project them"):
        bathyal.read_cloud(path)
    path = write_text(tmp_path / "b.csv", "lon,lat,x,y,z\n10.5,60.1,1,2,-5\n")
    assert bathyal.read_cloud(path).points.tolist() == [[1, 2, -5]]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("a,b,c\n1,2,3\n", "no column is called x or y or depth among a, b, c"),
        ("1 2\n3 4\n", "at least three columns, got 2"),
        ("x y z\n", "no row of numbers"),
        ("1 2 3\n4 5\n", r":2: expected 3 columns"),
        ("1 2 3\n4 five 6\n", ':2: expected a number in column 1, got "five"'),
        ("ncols 2\n1 2 3\n", "header lacks nrows"),
        ("\0\1\2\3", "text"),
    ],
)
def test_text_faults_are_errors(tmp_path, text, reason):
    path = write_text(tmp_path / "a.xyz", text)
    with pytest.raises(bathyal.Error, match=reason):
        bathyal.read_cloud(path)


# --- round trips ---------------------------------------------------------------------------------

WRITTEN = [".xyz", ".txt", ".csv", ".ply", ".vtp"]


@pytest.mark.parametrize("suffix", WRITTEN)
def test_what_rides_along_comes_back(tmp_path, suffix):
    attributes = {
        "uncertainty": np.linspace(0.27, 0.66, 50),
        "red": np.arange(50.0),
        "a b,c%": np.random.default_rng(5).normal(size=50),
        "gap": np.where(np.arange(50) % 7, 1.5, np.nan),
    }
    wkt = 'PROJCS["UTM 2N",\n  AUTHORITY["EPSG","32602"]]'
    cloud = survey(attributes=attributes, crs=wkt, vertical_datum="Mean Sea Level")
    cloud.write(tmp_path / f"a{suffix}")
    assert [path.name for path in tmp_path.iterdir()] == [f"a{suffix}"]
    back = bathyal.read_cloud(tmp_path / f"a{suffix}")
    assert np.array_equal(back.points, cloud.points)
    assert set(back.attributes) == set(attributes)
    for name, values in attributes.items():
        assert np.array_equal(back.attributes[name], values, equal_nan=True), name
    assert back.crs.split() == wkt.split()
    assert back.vertical_datum == "Mean Sea Level"


@given(
    points=st.lists(st.tuples(*[st.floats()] * 3), min_size=1, max_size=20),
    suffix=st.sampled_from(WRITTEN),
)
@settings(max_examples=100, deadline=None)
def test_any_cloud_comes_back_bit_for_bit(tmp_path_factory, points, suffix):
    path = tmp_path_factory.getbasetemp() / f"any{suffix}"
    cloud = bathyal.PointCloud(np.array(points))
    bathyal.write_cloud(cloud, path)
    assert np.array_equal(bathyal.read_cloud(path).points, cloud.points, equal_nan=True)


def test_an_empty_cloud_is_written(tmp_path):
    empty = bathyal.PointCloud(np.empty((0, 3)), crs="EPSG:32602")
    for suffix in (".ply", ".vtp"):
        empty.write(tmp_path / f"a{suffix}")
        assert len(bathyal.read_cloud(tmp_path / f"a{suffix}")) == 0


@pytest.mark.parametrize("suffix", WRITTEN)
def test_a_disk_without_room_is_told(tmp_path, suffix):
    full = pathlib.Path("/dev/full")
    if not full.exists():
        pytest.skip("no /dev/full here")
    (tmp_path / f"a{suffix}").symlink_to(full)
    with pytest.raises((OSError, bathyal.Error), match="No space left"):
        survey(2000).write(tmp_path / f"a{suffix}")


def test_vtk_opens_the_cloud(tmp_path):
    vtk = pytest.importorskip("vtk")
    survey().write(tmp_path / "a.vtp")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "a.vtp"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfVerts() == 50


PCD = """VERSION 0.7
FIELDS x y z intensity rgb
SIZE 8 8 8 4 4
TYPE F F F F U
COUNT 1 1 1 1 1
WIDTH {count}
HEIGHT 1
VIEWPOINT 0 0 0 1 0 0 0
POINTS {count}
DATA ascii
620152.873 7246504.912 -51.987 12 16711935
"""


def test_pcd(tmp_path):
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.pcd", PCD.format(count=1)))
    assert np.array_equal(cloud.points, UTM[None])
    attributes = {name: values.tolist() for name, values in cloud.attributes.items()}
    assert attributes == {"intensity": [12], "red": [255], "green": [0], "blue": [255]}
    with pytest.raises(bathyal.Error):
        bathyal.read_cloud(write_text(tmp_path / "b.pcd", PCD.format(count=10**9)))


def test_ply_of_points_with_float_colours(tmp_path):
    text = ("ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
            "property double z\nproperty float red\nproperty ushort green\nend_header\n"
            "1 2 3 0.5 65535\n")  # fmt: skip
    cloud = bathyal.read_cloud(write_text(tmp_path / "a.ply", text), z="down")
    assert cloud.points.tolist() == [[1, 2, -3]]
    assert cloud.attributes["red"].tolist() == [127.5]
    assert cloud.attributes["green"].tolist() == [255]


# --- every format: what is not one ---------------------------------------------------------------

SUFFIXES = [".xyz", ".csv", ".ply", ".pcd", ".las", ".laz", ".bag", ".tif", ".vtp"]


def example(path):
    """A small valid file of the path's format."""
    match path.suffix:
        case ".las" | ".laz":
            write_las(path)
        case ".bag":
            write_bag(path)
        case ".tif":
            write_tiff(path)
        case ".pcd":
            write_text(path, PCD.format(count=1))
        case _:
            survey().write(path)
    return path


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\0" * 400,
        bytes(range(256)) * 40,
        b"no numbers here\n",
        b"\x89HDF\r\n\x1a\n" + b"\0" * 99,
    ],
    ids=["empty", "zeros", "bytes", "words", "HDF"],
)
def test_content_of_another_kind_is_an_error(tmp_path, suffix, content):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    with pytest.raises(bathyal.Error, match=re.escape(str(path))):
        bathyal.read_cloud(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_suffix_that_lies_is_an_error(tmp_path, suffix):
    other = example(tmp_path / f"a{'.ply' if suffix in ('.bag', '.tif') else '.bag'}")
    other.rename(tmp_path / f"b{suffix}")
    with pytest.raises(bathyal.Error):
        bathyal.read_cloud(tmp_path / f"b{suffix}")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_cut_files_are_errors(tmp_path, suffix):
    path = example(tmp_path / f"a{suffix}")
    whole = path.read_bytes()
    for tenth in range(10):
        path.write_bytes(whole[: len(whole) * tenth // 10])
        try:
            cut = bathyal.read_cloud(path)
        except bathyal.Error:
            continue
        # columns of text have no end: a cut between two lines, or in a last number, cannot be seen
        assert suffix in (".xyz", ".csv")
        assert len(cut) < 50


@given(data=st.data(), suffix=st.sampled_from([".ply", ".pcd", ".vtp", ".xyz", ".las"]))
@settings(max_examples=150, deadline=None)
def test_changed_bytes_are_read_or_refused(tmp_path_factory, data, suffix):
    path = example(tmp_path_factory.getbasetemp() / f"changed{suffix}")
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(content)
    with contextlib.suppress(bathyal.Error):
        bathyal.read_cloud(path, z="up", scale=1.0)


def test_arguments_are_named(tmp_path):
    path = example(tmp_path / "a.ply")
    with pytest.raises(ValueError, match=r"`path`: expected a point file \(\.asc \.bag \.csv"):
        bathyal.read_cloud("a.dae")
    with pytest.raises(ValueError, match="`path`: expected a point file"):
        bathyal.write_cloud(survey(), "a.las")
    for scale in (0, -1, np.nan, [1, 2], [1, 1, 0], "two"):
        with pytest.raises(ValueError, match=r"scale|could not convert"):
            bathyal.read_cloud(path, scale=scale)
    with pytest.raises(ValueError, match='`z`: expected "up" or "down"'):
        bathyal.read_cloud(path, z="north")
    with pytest.raises(
        ValueError, match=r"`columns`: expected with text files only, got it with \.ply"
    ):
        bathyal.read_cloud(path, columns=[0, 1, 2])
    with pytest.raises(ValueError, match="`decimal`: expected with text files only"):
        bathyal.read_cloud(path, decimal=",")
    with pytest.raises(ValueError, match="`band`: expected with GeoTIFF only"):
        bathyal.read_cloud(path, band=1)
    text = write_text(tmp_path / "a.xyz", "1 2 3\n")
    for columns in ([0, 1], "xyz", {"x": 0, "y": 1}, [0, 1, 2, 2, 2], [0, 1, 9], ["x", "y", "z"]):
        with pytest.raises(ValueError, match="column"):
            bathyal.read_cloud(text, columns=columns)
    with pytest.raises(ValueError, match="`seperator`: expected a keyword of read_cloud"):
        bathyal.read_cloud(text, seperator=",")
    with pytest.raises(FileNotFoundError):
        bathyal.read_cloud(tmp_path / "none.xyz")
    with pytest.raises(FileNotFoundError, match="cannot write"):
        bathyal.write_cloud(survey(), tmp_path / "no" / "a.xyz")


def test_a_missing_library_is_named(tmp_path, monkeypatch):
    import sys

    for suffix, module in ((".las", "laspy"), (".laz", "lazrs"), (".bag", "h5py"),
                           (".tif", "rasterio")):  # fmt: skip
        path = example(tmp_path / f"a{suffix}")
        with monkeypatch.context() as patch:
            patch.setitem(sys.modules, module, None)
            with pytest.raises(bathyal.Error, match=r"needs the Python package .* pip install"):
                bathyal.read_cloud(path)
