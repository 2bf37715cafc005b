# SPDX-License-Identifier: BSD-3-Clause
"""Soundings from BAG grids."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import bathyal
from tests.support.cloud_cases import ISO_19139, write_bag
from tests.support.file_cases import measured

JD211 = "seabed/jd211/JD211_public_Release_1-4_UTM.bag"


@pytest.fixture(scope="module")
def jd211():
    with pytest.warns(UserWarning, match=r"\+2.000 m, \+2.000 m off"):
        return bathyal.read_cloud(measured(JD211))


def test_jd211_lies_where_libgdal_puts_it(jd211):
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
