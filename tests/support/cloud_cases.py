# SPDX-License-Identifier: BSD-3-Clause
"""Small files of soundings that the tests of every format start from."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

UTM = np.array([620152.873, 7246504.912, -51.987])


def survey(count=50, **extras):
    points = UTM + np.random.default_rng(3).normal(size=(count, 3))
    return bathyal.PointCloud(points, **extras)


def write_text(path, text):
    path.write_bytes(text.encode())
    return path


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
