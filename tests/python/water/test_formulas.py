# SPDX-License-Identifier: BSD-3-Clause
"""Formulas of the water: check values, gsw as the peer, shapes, ranges, refusals."""

from __future__ import annotations

import builtins
import sys

import numpy as np
import pytest

import bathyal

T, S, D = np.meshgrid([3.0, 10.0, 20.0], [33.0, 35.0], [10.0, 500.0, 3000.0], indexing="ij")


def test_check_values():
    assert bathyal.sound_speed(25, 35, 1000) == pytest.approx(1550.744, abs=5e-4)
    check = bathyal.sound_speed(40, 40, pressure=1e4, formula="chen_millero")
    assert check == pytest.approx(1731.995, abs=5e-4)
    fg = bathyal.absorption([100e3, 600e3, 900e3], 10, 35, 50)
    am = bathyal.absorption([100e3, 600e3, 900e3], 10, 35, 50, formula="ainslie_mccolm")
    assert fg == pytest.approx([33.4, 158.6, 298.6], rel=2e-3)
    assert am == pytest.approx([34.1, 168.9, 321.1], rel=2e-3)


def test_depth_and_pressure_are_those_of_gsw():
    gsw = pytest.importorskip("gsw")
    pressure = np.array([0.0, 3.7, 120.0, 4321.0, 10000.0])
    for latitude in (-77.0, 0.0, 45.0):
        depth = bathyal.depth_from_pressure(pressure, latitude)
        assert depth == pytest.approx(-gsw.z_from_p(pressure, latitude), abs=1e-9)
        assert bathyal.pressure_from_depth(depth, latitude) == pytest.approx(pressure, abs=1e-8)


def test_salinity_and_density_are_those_of_gsw():
    gsw = pytest.importorskip("gsw")
    conductivity = np.array([20.0, 35.0, 50.0])
    places = ([5.0, 10.0, 20.0], [0.0, 100.0, 2000.0])
    own = bathyal.practical_salinity(conductivity / 10, *places)
    assert own == pytest.approx(gsw.SP_from_C(conductivity, *places), abs=1e-9)
    absolute = gsw.SR_from_SP(S)
    other = gsw.rho_t_exact(absolute, T, D)
    assert bathyal.seawater_density(T, S, D) == pytest.approx(other, abs=0.03)


def test_formulas_against_teos10():
    gsw = pytest.importorskip("gsw")
    pressure = gsw.p_from_z(-D, 45.0)
    absolute = gsw.SR_from_SP(S)
    exact = gsw.sound_speed(absolute, gsw.CT_from_t(absolute, T, pressure), pressure)
    assert bathyal.sound_speed(T, S, D, formula="teos10") == pytest.approx(exact, abs=1e-9)
    for formula, limit in (("del_grosso", 0.25), ("mackenzie", 0.4), ("chen_millero", 0.7)):
        own = bathyal.sound_speed(T, S, D, formula=formula, temperature_scale="ITS-90")
        assert own == pytest.approx(exact, abs=limit), formula
    near = bathyal.sound_speed(10, 35, 1000, formula="teos10", latitude=40, longitude=-20)
    p = gsw.p_from_z(-1000, 40)
    absolute = gsw.SA_from_SP(35, p, -20, 40)
    assert near == gsw.sound_speed(absolute, gsw.CT_from_t(absolute, 10, p), p)


def test_teos10_without_gsw_says_how_to_get_it(monkeypatch):
    real = builtins.__import__

    def without(name, *args, **kwargs):
        if name == "gsw":
            raise ImportError("no gsw")
        return real(name, *args, **kwargs)

    monkeypatch.setitem(sys.modules, "gsw", None)
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(bathyal.Error, match=r"pip install 'gsw'.*\[water\]"):
        bathyal.sound_speed(10, 35, 50, formula="teos10")


def test_shapes_broadcast():
    assert isinstance(bathyal.sound_speed(10, 35, 50), float)
    assert bathyal.sound_speed([10, 11], 35, 50).shape == (2,)
    table = bathyal.sound_speed([[5], [10]], 35, [0, 50, 100])
    assert table.shape == (2, 3)
    assert table[1, 1] == bathyal.sound_speed(10, 35, 50)
    assert bathyal.absorption([[1e5], [2e5]], [8, 9], 35, 50).shape == (2, 2)
    assert bathyal.sound_speed(np.empty(0), 35, 50).shape == (0,)


def test_depth_or_pressure():
    deep = bathyal.sound_speed(10, 35, 3000, formula="del_grosso", latitude=60)
    pressure = bathyal.pressure_from_depth(3000, 60)
    assert deep == bathyal.sound_speed(10, 35, pressure=pressure, formula="del_grosso")
    by_pressure = bathyal.sound_speed(10, 35, pressure=pressure, latitude=60)
    assert by_pressure == pytest.approx(bathyal.sound_speed(10, 35, 3000), abs=1e-9)


def test_temperature_scales():
    printed = bathyal.sound_speed(20, 35, 0, formula="del_grosso")
    assert printed == bathyal.sound_speed(
        20, 35, 0, formula="del_grosso", temperature_scale="IPTS-68"
    )
    converted = bathyal.sound_speed(20, 35, 0, formula="del_grosso", temperature_scale="ITS-90")
    assert converted == bathyal.sound_speed(20 * 1.00024, 35, 0, formula="del_grosso")
    assert 0 < converted - printed < 0.02


def test_outside_its_range_a_formula_says_so():
    with pytest.warns(bathyal.RangeWarning, match=r"mackenzie extrapolates: salinity 5 \(25 to 40"):
        bathyal.sound_speed(10, 5, 50)
    with pytest.warns(bathyal.RangeWarning, match=r"temperature 1 °C.*1 of 2 rows"):
        bathyal.sound_speed([1, 10], 35, 50)
    with pytest.warns(bathyal.RangeWarning, match="del_grosso"):
        bathyal.sound_speed(35, 35, pressure=10, formula="del_grosso")
    with pytest.warns(bathyal.RangeWarning, match="francois_garrison extrapolates: frequency"):
        bathyal.absorption(2e6, 10, 35, 50)
    with pytest.warns(bathyal.RangeWarning, match="ph 7"):
        bathyal.absorption(1e5, 10, 35, 50, 7.0, "ainslie_mccolm")
    with pytest.warns(bathyal.RangeWarning):
        bathyal.Water(temperature=1.0)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: bathyal.sound_speed(10, 35), "one of depth"),
        (lambda: bathyal.sound_speed(10, 35, 5, pressure=5), "both"),
        (lambda: bathyal.sound_speed(np.nan, 35, 5), "temperature"),
        (lambda: bathyal.sound_speed(10, -1, 5), "salinity"),
        (lambda: bathyal.sound_speed(10, 35, 1e6), "depth"),
        (lambda: bathyal.sound_speed(10, 35, 5, formula="wilson"), "mackenzie"),
        (lambda: bathyal.sound_speed(10, 35, 5, latitude=91), "latitude"),
        (lambda: bathyal.sound_speed(10, 35, 5, temperature_scale="F"), "ITS-90"),
        (lambda: bathyal.sound_speed([1, 2], [1, 2, 3], 5), "broadcast"),
        (lambda: bathyal.sound_speed("warm", 35, 5), "temperature"),
        (lambda: bathyal.sound_speed(None, 35, 5), "temperature"),
        (lambda: bathyal.absorption(0, 10, 35, 50), "frequency"),
        (lambda: bathyal.absorption(1e5, 10, 35, 50, ph=20), "ph"),
        (lambda: bathyal.absorption(1e5, 10, 35, np.inf), "depth"),
        (lambda: bathyal.absorption(1e5, 10, 35, 50, formula="thorp"), "ainslie_mccolm"),
        (lambda: bathyal.depth_from_pressure(np.nan), "pressure"),
        (lambda: bathyal.pressure_from_depth(5, latitude=np.nan), "latitude"),
        (lambda: bathyal.seawater_density(10, 35, 1e9), "pressure"),
    ],
)
def test_refusals(call, says):
    with pytest.raises(ValueError, match=says):
        call()
