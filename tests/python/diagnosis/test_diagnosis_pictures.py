# SPDX-License-Identifier: BSD-3-Clause
"""What the report of a diagnosis draws."""

from __future__ import annotations

import numpy as np
import pytest

from bathyal.diagnosis.report import curves
from bathyal.diagnosis.report import quantities as tables
from bathyal.diagnosis.report.figure import (
    curve_figure,
    diagnosis_figure,
    show_figure,
    support_figure,
)
from bathyal.diagnosis.report.text import effect_text
from tests.support import diagnosis_cases as cases


def test_residuals_along_a_joint_show_its_error():
    """Means along the joint whose encoder errs swing by its harmonic; along the others they lie
    flat, and so do those of the axes of the world."""
    report = cases.named()
    rest = tables.residuals_of(report, report.residuals_before)
    known = {one.key: one for one in tables.quantities(report)}
    means = {
        key: tables.binned(one, rest.against(one)) for key, one in known.items() if "joint" in key
    }
    own = means.pop("joint 3")
    assert all(np.ptp(own.mean) > 2.5 * np.ptp(other.mean) for other in means.values())
    q = np.radians(own.place)
    curve = 3e-4 * np.cos(2 * q) - 4e-4 * np.sin(2 * q)
    assert abs(np.corrcoef(own.mean[:, 0], curve)[0, 1]) > 0.95
    world = tables.binned(known["joint 3"], rest.world)
    assert np.ptp(own.mean) > 2.5 * np.ptp(world.mean, axis=0).max()


def test_bins_hold_every_row_once():
    quantity = tables.Quantity(
        "time", "time", "s", np.array([3.0, 1, 2, 2, 9, 5, 5, 7] * 30), "time"
    )
    values = np.arange(240.0)[:, None] * [1, -1, 0]
    some = tables.binned(quantity, values)
    assert some.by_value
    assert some.place.tolist() == [1, 2, 3, 5, 7, 9]
    assert some.mean[1, 0] == pytest.approx(values[quantity.values == 2, 0].mean())
    many = tables.Quantity("time", "time", "s", np.random.default_rng(0).uniform(size=240), "time")
    bins = tables.binned(many, values)
    assert len(bins.place) == 20
    assert bins.mean.mean(axis=0) == pytest.approx(values.mean(axis=0))
    assert np.all(np.diff(bins.place) > 0)


def test_a_curve_is_the_effects_own():
    report = cases.named()
    curve = curves.joint_curve(report, report.effects[0])
    q = np.radians(curve.place)
    expected = 3e-4 * np.cos(2 * q) - 4e-4 * np.sin(2 * q)
    np.testing.assert_allclose(np.radians(curve.middle), expected, rtol=0, atol=1e-15)
    half = 1.96 * np.hypot(6e-6 * np.cos(2 * q), 5e-6 * np.sin(2 * q))
    np.testing.assert_allclose(np.radians(curve.high - curve.middle), half, rtol=1e-9)
    np.testing.assert_allclose(np.radians(curve.middle - curve.low), half, rtol=1e-9)
    assert (curve.across, curve.up) == ("joint 3 · elbow_joint [°]", "joint 3 off by [°]")


def test_curves_of_maps_scales_and_couplings():
    effects = {effect.name: effect for effect in cases.many(9).effects}
    report = cases.named()
    curve = curves.joint_curve(report, effects["joint_map"])
    q = np.radians(curve.place)
    expected = 1e-4 * np.cos(q) + 2e-4 * np.sin(q) + 5e-5 * np.cos(2 * q) - 3e-5 * np.sin(2 * q)
    np.testing.assert_allclose(np.radians(curve.middle), expected, rtol=0, atol=1e-15)
    curve = curves.joint_curve(report, effects["joint_scale"])
    np.testing.assert_allclose(curve.middle, 1.2e-3 * curve.place)
    curve = curves.joint_curve(report, effects["joint_coupling"])
    np.testing.assert_allclose(curve.middle, -0.002 * curve.place)
    assert curve.across.startswith("joint 3")
    assert curve.up == "joint 4 off by [°]"
    assert curves.joint_curve(report, effects["base_shift"]) is None
    assert curves.joint_curve(report, effects["backlash"]) is None


def test_what_is_beyond_noise_is_marked_where_it_belongs():
    known = {one.key: one for one in tables.quantities(cases.named())}
    swings = cases.vibration(12.1, "", 1e-4, 0.5, 1e-9)
    both = cases.on_pair(2, 3, "", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(swings, one)] == ["time"]
    assert [key for key, one in known.items() if tables.concerns(both, one)] == []
    assert tables.pair_of(both, [*known.values()]) == (known["joint 2"], known["joint 3"])
    place = cases.structure("position", "position", "", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(place, one)] == ["x", "y", "z"]
    single = cases.on_joint(4, "", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(single, one)] == ["joint 4"]
    assert tables.pair_of(single, [*known.values()]) is None
    warm = cases.structure("covariate", "", "", 1e-4, 0.5, 1e-9, covariate="temperature")
    assert [key for key, one in known.items() if tables.concerns(warm, one)] == ["temperature"]
    for kind in ("none", "approach"):
        other = cases.structure(kind, "", "", 1e-4, 0.5, 1e-9, coordinates=[3])
        assert not [key for key, one in known.items() if tables.concerns(other, one)]
    titles = [axes.get_title(loc="left") for axes in show_figure(cases.named()).axes]
    assert titles[2] == "● 0.200 mm, p < 0.001"
    assert titles[8] == "noise, p = 0.004"
    assert sum(title.startswith("●") for title in titles) == 1


def test_a_sheet_has_room_for_its_pictures_whatever_there_is_to_say():
    report = cases.many()
    for effect in report.effects:
        effect.words = f"{effect.words} {40 * 'and more of it '}"
    report.warnings = [40 * "much to know "] * 9
    figure = diagnosis_figure(report, title="long")
    heights = [axes.get_position().height for axes in figure.axes]
    assert min(heights) > 0.03
    assert min(axes.get_position().y0 for axes in figure.axes) > 0
    tops = [text.get_position()[1] for text in figure.texts]
    assert min(tops) > 0


def test_a_cause_of_many_numbers_is_described_without_them():
    report = cases.many(6)
    assert "with 6 parameters" in effect_text(report.effects[5])


def test_sheet_has_a_panel_for_each_step():
    figure = diagnosis_figure(cases.named(), title="UR10 $x$ from a_b.csv")
    assert len(figure.axes) == 8 + 1 + 2
    assert any("harmonic of order 2" in text.get_text() for text in figure.texts)
    assert len(curve_figure(cases.many()).axes) == 8
    assert curve_figure(cases.clean()) is None


def test_gaps_are_cut_out_of_the_range() -> None:
    report = cases.named()
    report.model.gaps = (*cases.Arm.gaps[:2], np.array([[0.1, 0.8]]), *cases.Arm.gaps[3:])
    gaps = [one.gaps for one in tables.supports(report)]
    assert gaps[1] == ()
    assert len(gaps[2]) == 1
    np.testing.assert_allclose(gaps[2][0], np.degrees([0.1, 0.8]))
    figure = support_figure(report)
    bars = figure.axes[0].patches
    figure_before = support_figure(cases.named())
    assert len(bars) == len(figure_before.axes[0].patches) + 1
