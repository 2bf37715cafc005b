# SPDX-License-Identifier: BSD-3-Clause
"""Casts of nine vendors, and tables, read by what they say."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import bathyal
from tests.support.cast_files import MEASURED, WRITTEN, measured

CASTAWAYS = [name for name in MEASURED if name.startswith("castaway")]


@pytest.mark.parametrize("name", MEASURED)
def test_measured_casts(name):
    cast = bathyal.read_profile(measured(name))
    rows, deepest, columns = MEASURED[name]
    assert len(cast) == rows
    assert np.nanmax(cast.depth) == pytest.approx(deepest, rel=0.005, abs=0.005)
    found = {"t": cast.temperature, "s": cast.salinity, "c": cast.sound_speed, "p": cast.pressure}
    assert {letter for letter, values in found.items() if values is not None} == set(columns)
    clean = cast.cleaned()
    assert (np.diff(clean.depth) > 0).all()
    assert clean.depth[0] >= 0
    assert cast.source.startswith(name)
    assert cast.instrument


def test_sound_speed_of_three_castaways_within_a_tenth():
    for name in CASTAWAYS:
        cast = bathyal.read_profile(measured(name))
        for formula, limit in (("mackenzie", 0.1), ("chen_millero", 0.1), ("del_grosso", 0.1)):
            speed = bathyal.sound_speed(
                cast.temperature, cast.salinity, cast.depth, formula=formula
            )
            assert np.abs(speed - cast.sound_speed).max() < limit, formula
        # What the instrument computes by: UNESCO's formula on the scale that it is printed for.
        speed = bathyal.sound_speed(
            cast.temperature,
            cast.salinity,
            pressure=cast.pressure,
            formula="chen_millero",
            temperature_scale="ITS-90",
        )
        assert np.abs(speed - cast.sound_speed).max() < 1e-3


def test_density_and_depth_of_the_castaway():
    path = measured(CASTAWAYS[0])
    cast = bathyal.read_profile(path)
    density = np.loadtxt(path, delimiter=",", comments="%", skiprows=29, usecols=7)
    own = bathyal.seawater_density(cast.temperature, cast.salinity, cast.pressure)
    assert np.abs(own - density).max() < 0.01
    depth = bathyal.depth_from_pressure(cast.pressure, cast.position[0])
    assert np.abs(depth - cast.depth).max() < 0.12  # the instrument's is of the measured density


@pytest.mark.parametrize(
    ("name", "limit"),
    [
        ("sippican_T5_00002_oldsippicansoft.EDF", 0.1),
        ("valeport_midas_svp_MIDAS_SVP_sample.vpd", 0.1),
        ("seabird__tan1802_094_ctd_converted.cnv", 0.6),  # its column is of Wilson's formula
    ],
)
def test_speed_columns_of_the_others(name, limit):
    cast = bathyal.read_profile(measured(name)).cleaned()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bathyal.RangeWarning)
        own = cast.with_sound_speed(temperature_scale="ITS-90").sound_speed
    assert np.abs(own - cast.sound_speed).max() < limit


def test_every_format_by_its_content(write):
    for name, text in WRITTEN.items():
        cast = bathyal.read_profile(write(text, f"{name}.anything"))
        assert len(cast) == 2, name
        assert cast.temperature is not None or cast.sound_speed is not None


def test_position_and_time(write):
    expected = {
        "castaway": ((50.5, -3.25), "2020-02-03T04:05:06"),
        "aml": (None, "2021-06-16T17:23:45"),
        "aml_csv": ((43.5, -70.5), "2019-04-11T18:25:01.36"),
        "seabird": ((43.5, -70.5), "2013-03-07T15:09:24"),
        "hypack": ((37.9, -122.4), "2019-08-19T15:47:00"),
        "asvp": ((22.5, -156.5), "2012-03-21T22:42:00"),
        "valeport": (None, "2021-12-24T18:57:14"),
        "sippican": ((22.5, -17.25), "2017-07-14T16:40:45"),
        "oceanscience": ((-63.42, -56.615), "2019-02-21T22:14:27"),
        "plain": (None, None),
    }
    for name, (position, time) in expected.items():
        cast = bathyal.read_profile(write(WRITTEN[name]))
        assert cast.position == (None if position is None else pytest.approx(position)), name
        if time is None:
            assert cast.time is None
        else:
            assert cast.time == pytest.approx(
                np.datetime64(time).astype("datetime64[ms]").astype(float) / 1e3
            ), name


def test_what_is_derived_and_missing(write):
    aml = bathyal.read_profile(write(WRITTEN["aml"]))
    assert np.isnan(aml.sound_speed[0])  # 0.000 in air
    assert aml.salinity[0] == pytest.approx(35.0, abs=0.01)
    assert "PSS-78" in aml.source
    assert "TEOS-10" in aml.source
    seabird = bathyal.read_profile(write(WRITTEN["seabird"]))
    assert np.isnan(seabird.salinity[1])
    valeport = bathyal.read_profile(write(WRITTEN["valeport"]))
    assert np.isnan(valeport.salinity[0])
    assert valeport.salinity[1] == 34.5
    sippican = bathyal.read_profile(write(WRITTEN["sippican"]))
    assert sippican.salinity.tolist() == [37.2, 37.2]
    assert "assumed" in sippican.source
    few = WRITTEN["seabird"].replace("nvalues = 2", "nvalues = 9")
    assert "2 rows of the 9" in bathyal.read_profile(write(few)).source


def test_plain_tables(write):
    two = bathyal.read_profile(write("0 1500\n10 1490\n", "a.txt"))
    assert two.sound_speed.tolist() == [1500.0, 1490.0]
    pressure = bathyal.read_profile(write("pressure,temp,sal\n10,5,35\n20,5,35\n", "b.csv"))
    assert pressure.depth.tolist() == pytest.approx([9.92, 19.83], abs=0.01)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "empty"),
        ("hello world this is no cast\n", "expected"),
        (b"\x00\x01\x02" * 50, "binary"),
        (b"PK\x03\x04\x05\x06\x07\x08\x01\x02", "binary"),
        ("1 2 3\n4 5 6\n", "header that names columns"),
        ("depth,colour\n1,2\n2,3\n", "temperatures or sound speeds"),
        ("depth [ft],sound_speed\n1,1500\n", "unit among"),
        ("depth,sound_speed\n1,1500\n2\n", "cells"),
        ("depth,sound_speed\n1,fast\n", "fast"),
        (WRITTEN["castaway"].split("Pressure")[0], "header of columns"),
        (WRITTEN["castaway"][:-12], "line 8: expected 5 values"),
        (WRITTEN["castaway"].replace("Celsius", "Fahrenheit"), "unit among"),
        (WRITTEN["castaway"].replace("1,0.99,", "1,0.99e,"), "0.99e"),
        (WRITTEN["aml"].split("[MeasurementData]")[0], "rows of a cast"),
        (WRITTEN["aml"].replace("Units=", "Unit="), "Units="),
        (WRITTEN["aml_csv"].replace("SensorName", "S"), "sensors in slots"),
        (WRITTEN["aml_csv"].replace("P.X", "Q.X"), "Q.X"),
        (WRITTEN["seabird"].split("*END*")[0], r"\*END\*"),
        (WRITTEN["seabird"].replace("# name", "# nam"), "names of its columns"),
        (WRITTEN["hypack"] + "3.0\n", "line 4: expected 2"),
        (WRITTEN["asvp"] + "3.0 1500\n", "expected 2 rows"),
        (WRITTEN["asvp"].replace(" P 0002", ""), "twelve words"),
        (WRITTEN["valeport"].split("Date/Time")[0], "names, units and rows"),
        (WRITTEN["sippican"].split("Depth (")[0], "names its columns"),
        (WRITTEN["oceanscience"] + "3 2.7\n", "expected 4"),
        (WRITTEN["hypack"].replace("1504.90", "inf"), "finite"),
    ],
)
def test_broken_files(write, text, says):
    with pytest.raises(bathyal.Error, match=says):
        bathyal.read_profile(write(text, "cast.dat"))


@pytest.mark.parametrize("name", WRITTEN)
def test_cut_at_any_byte(write, name):
    """Less than the whole is a shorter cast or our error."""
    content = WRITTEN[name].encode()
    for end in range(0, len(content), 7):
        try:
            cast = bathyal.read_profile(write(content[:end]))
        except bathyal.Error:
            continue
        assert len(cast) <= 2


def test_missing_files_are_the_systems_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        bathyal.read_profile(tmp_path / "none.csv")


def test_plot(write, tmp_path):
    cast = bathyal.read_profile(write(WRITTEN["plain"]))
    figure = cast.plot(tmp_path / "cast.png")
    assert (tmp_path / "cast.png").read_bytes()[:4] == b"\x89PNG"
    assert [axes.get_xlabel() for axes in figure.axes] == [
        "sound speed [m/s]",
        "temperature [°C]",
        "salinity",
    ]
    top, bottom = figure.axes[0].get_ylim()[::-1]
    assert (top, bottom) == (0.0, 20.0)
    computed = bathyal.Profile([0, 9], temperature=[10, 9], salinity=[35, 35]).plot()
    assert "computed" in computed.axes[0].get_xlabel()
