# SPDX-License-Identifier: BSD-3-Clause
"""What the report of a diagnosis says and shows: its words, its numbers, its page, its files."""

from __future__ import annotations

import csv
import json
import math
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
import diagnosis_cases as cases
from bathyal import diagnosis_curves as curves
from bathyal import diagnosis_numbers as numbers
from bathyal import diagnosis_tables as tables
from bathyal.diagnosis_advice import next_steps
from bathyal.diagnosis_figure import curve_figure, diagnosis_figure, show_figure
from bathyal.diagnosis_files import told, write_diagnosis, write_residuals
from bathyal.diagnosis_page import _poses, write_page
from bathyal.diagnosis_words import effect_text, groups_of, headline, summary

ALL = pytest.mark.parametrize("name", cases.CASES)


# Numbers ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("metres", "text"),
    [(0.312e-3, "0.312 mm"), (0.0302e-3, "0.030 mm"), (0.2e-3, "0.200 mm"), (0.0125, "12.5 mm"),
     (3e-6, "3.00 µm"), (-1.5e-3, "−1.50 mm"), (1.25, "1.25 m"), (1e-12, "under 1 nm"),
     (0.0, "0 mm"), (math.nan, "?")],
)  # fmt: skip
def test_lengths_are_told_in_the_unit_that_suits(metres, text):
    assert numbers.length_text(metres) == text


@pytest.mark.parametrize(
    ("name", "value", "unit", "std", "text"),
    [
        ("cos", 4.8e-4, "rad", 1e-5, "0.0275° (0.0264 … 0.0286)"),
        ("scale", 0.0012, "1", 2e-5, "0.1200 % (0.1161 … 0.1239)"),
        ("expansion", 2.3e-5, "1/K", 1e-6, "23.0 µm/(m K) (21.0 … 25.0)"),
        ("rate_x", 1e-3 / 3600, "m/s", 0.0, "1.00 mm/h"),
        ("compliance", 1e-6, "rad/(N m)", 1e-7, "0.057 °/(kN m) (0.046 … 0.069)"),
        ("delay", 0.012, "s", math.inf, "12.0 ms (nothing bounds it)"),
        ("rate", 2e-4, "m/m", 1e-5, "0.200 mm/m (0.180 … 0.220)"),
        ("pull", 5.0, "lux", 0.4, "5.00 lux (4.22 … 5.78)"),
    ],
)
def test_estimates_carry_their_interval_and_no_more_figures(name, value, unit, std, text):
    assert numbers.estimate_text(name, cases.estimate(value, unit, std)) == text


@given(
    st.floats(-1e6, 1e6), st.floats(0, 1e6),
    st.sampled_from(["rad", "m", "1/K", "", "rad/(N m)", "odd"]),
)  # fmt: skip
@settings(max_examples=200, deadline=None)
def test_any_estimate_is_told_within_its_interval(value, std, unit):
    text = numbers.estimate_text("x", cases.estimate(value, unit, std))
    assert "nan" not in text
    found = [float(n.replace("−", "-")) for n in re.findall(r"−?\d+(?:\.\d+)?(?:e[+−]?\d+)?", text)]
    if "…" in text:
        assert found[1] <= found[0] <= found[2]


@pytest.mark.parametrize(
    ("p", "text"),
    [(0.034, "p = 0.034"), (1e-300, "p < 0.001"), (0.0, "p < 0.001"), (1.0, "p = 1"),
     (math.nan, "p not known")],
)  # fmt: skip
def test_chances(p, text):
    assert numbers.chance_text(p) == text


# Words --------------------------------------------------------------------------------------------


def test_a_named_cause_comes_with_its_evidence():
    text = summary(cases.named())
    for words in (
        "Named: a harmonic of order 2 along joint 3 with amplitude 0.0286°, cosine 0.01719° (0.016",
        "(moves the tip by 0.200 mm per axis)",
        "the error falls from 0.194 mm to 0.051 mm (3-D rms)",
        "with a floor of 0.052 mm by noise", "100 % of the variance above noise is gone",
        "that this is luck has p < 0.001", "Nothing beyond noise is left over",
        "4.8 to 1 against it", "Warning: The arm's masses are not known",
    ):  # fmt: skip
        assert words in text
    assert "Warning" not in summary(cases.named(), warnings=False)


def test_what_is_left_over_is_told():
    report = cases.named()
    report.leftover = cases.structure(
        "joint 5", "The residual bends along joint 5", 3e-5, 0.1, 1e-4
    )
    assert "Left over: The residual bends along joint 5 (0.030 mm per axis, p < 0.001)." in summary(
        report
    )


def test_clean_says_what_would_have_been_seen():
    text = summary(cases.clean())
    assert text.startswith("Clean: 240 poses show nothing beyond noise")
    assert "the most suspect, against joint 1, has p = 0.1." in text
    assert "What moves the tip by 0.012 mm or more per axis would have been seen" in text
    assert "noise is 0.030 mm per axis, by exact repeats of 12 poses" in text
    report = cases.clean()
    report.shown = []
    assert "no structure that was looked for has a chance below 0.01" in summary(report)


def test_ambiguous_lists_all_and_asks_for_poses():
    report = cases.ambiguous()
    text = summary(report)
    assert text.startswith(
        "Ambiguous, these data cannot tell apart: the tool slipped after 120 rows, the base moved "
        "between sessions 1 and 2 (as likely) or the base drifts (9 to 1 against it). Beside them "
        "stands: a harmonic of order 2 along joint 3 with amplitude"
    )
    assert "Measure the 5 poses of report.next_poses" in next_steps(report)[0]
    report.next_poses = np.empty((0, 6))
    assert "No pose would tell them apart" in next_steps(report)[0]


def test_groups_of_causes_that_cannot_be_told_apart_stay_apart():
    report = cases.ambiguous()
    report.ambiguous += [
        cases.cause("joint_harmonic", 2, report.effects[0].words),
        cases.cause("joint_coupling", 2, "joint 3 moved along by joint 2", 1.0),
    ]
    assert headline(report) == (
        "Ambiguous: the tool slipped after 120 rows, the base moved between sessions 1 and 2 or "
        "the base drifts; and a harmonic of order 2 along joint 3 or joint 3 moved along by "
        "joint 2."
    )
    assert "Beside them" not in summary(report)


def test_a_crowd_of_rivals_does_not_flood_the_page():
    report = cases.ambiguous()
    report.ambiguous += [cases.cause("x", None, f"rival {k}", 0.2) for k in range(60)]
    assert headline(report).endswith(", the base drifts or any of 60 others.")
    assert len(summary(report)) < 2000
    assert len(groups_of(report)[0]) == 63


def test_causes_of_the_noise_are_told_by_their_likelihood(tmp_path):
    report = cases.named()
    report.effects.append(
        cases.effect(
            "range_noise", None, "noise that grows with distance", gain=31.2, p_value=1.0,
            parameters={"rate": cases.estimate(2e-4, "m/m", 1e-5)},
        )
    )  # fmt: skip
    text = summary(report)
    assert "noise that grows with distance with rate 0.200 mm/m (0.180 … 0.220)." in text
    write_diagnosis(report, tmp_path / "r.html")
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "the log likelihood of data held out gains 31.2" in page


def test_unknown_says_what_it_looks_like_and_pretends_no_name():
    report = cases.unknown()
    assert "harmonic" not in headline(report)
    text = summary(report)
    assert "The residual swings with time, period 12.1 s (0.160 mm per axis, 80 %" in text
    assert "A part of it may be: a harmonic" in text
    assert "It goes with time" in text
    report.effects = []
    assert "A part of it" not in summary(report)


def test_none_says_why():
    text = summary(cases.none())
    assert text.startswith("No verdict, no data could be held out: 40 poses make fewer than four")
    assert "twice" in text
    assert "nan" not in text


def test_what_was_not_recorded_is_told():
    report = cases.clean()
    assert "Record payload and direction as well" in next_steps(report)[-1]
    data = report.data
    report.data = bathyal.Tracked(
        data.q, data.position, session=data.covariates["session"].ravel(),
        covariates={"time": np.arange(240.0), "temperature": np.ones(240), "payload": np.ones(240),
                    "direction": np.ones((240, 6))},
    )  # fmt: skip
    assert not any("Record" in step for step in next_steps(report))


@ALL
def test_every_verdict_is_one_paragraph_of_sentences(name):
    text = summary(cases.CASES[name]())
    assert "\n" not in text
    assert not re.search(r"nan|inf\b|\.\.|,\.| {2}|\( |\bNone\b", text)
    assert text.endswith(".")
    assert len(text) < 2000


# What is drawn ------------------------------------------------------------------------------------


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
    quantity = tables.Quantity("time", "time", "s", np.array([3.0, 1, 2, 2, 9, 5, 5, 7] * 30))
    values = np.arange(240.0)[:, None] * [1, -1, 0]
    some = tables.binned(quantity, values)
    assert some.by_value
    assert some.place.tolist() == [1, 2, 3, 5, 7, 9]
    assert some.mean[1, 0] == pytest.approx(values[quantity.values == 2, 0].mean())
    many = tables.Quantity("time", "time", "s", np.random.default_rng(0).uniform(size=240))
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
    swings = cases.structure("time, period 12.1 s", "", 1e-4, 0.5, 1e-9)
    both = cases.structure("joints 2 and 3", "", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(swings, one)] == ["time"]
    assert [key for key, one in known.items() if tables.concerns(both, one)] == []
    assert tables.pair_of(both, [*known.values()]) == (known["joint 2"], known["joint 3"])
    place = cases.structure("position", "", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(place, one)] == ["x", "y", "z"]
    wave = cases.structure("joint_harmonic", "a wave of order 2 along joint 4 (w)", 1e-4, 0.5, 1e-9)
    assert [key for key, one in known.items() if tables.concerns(wave, one)] == ["joint 4"]
    titles = [axes.get_title(loc="left") for axes in show_figure(cases.named()).axes]
    assert titles[2] == "● 0.200 mm, p < 0.001"
    assert titles[8] == "● 0.040 mm, p = 0.004"
    assert sum(title.startswith("●") for title in titles) == 2


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


def test_a_cause_of_many_numbers_is_told_without_them():
    report = cases.many(6)
    assert "told by 6 numbers" in effect_text(report.effects[5])


def test_sheet_has_a_panel_for_each_step():
    figure = diagnosis_figure(cases.named(), title="UR10 $x$ from a_b.csv")
    assert len(figure.axes) == 8 + 1 + 2
    assert any("harmonic of order 2" in text.get_text() for text in figure.texts)
    assert len(curve_figure(cases.many()).axes) == 8
    assert curve_figure(cases.clean()) is None


# The page -----------------------------------------------------------------------------------------


class Outline(HTMLParser):
    """Checks that what is opened is closed; keeps pictures and links."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.sources: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.sources += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag == "img":
            assert dict(attrs)["alt"]
        if tag not in ("meta", "img", "link", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@ALL
def test_page_is_whole_and_needs_no_network(name, tmp_path):
    report = cases.CASES[name]()
    write_page(report, tmp_path / "r.html", title="<UR10> & friends", facts={"arm": "<b>"})
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    outline = Outline(text)
    assert all(source.startswith("data:image/svg+xml;base64,") for source in outline.sources)
    assert "http" not in re.sub(r"base64,[^']*", "", text)
    assert text.index('class="verdict"') < text.index('class="tiles"') < text.index("<h2>")
    steps = [text.index(f"<h2><i>{k}</i>") for k in (1, 2, 3, 4)]
    assert steps == sorted(steps)
    for warning in report.warnings:
        assert warning.replace("'", "&#x27;") in text
    assert "<UR10>" not in text
    assert "&lt;UR10&gt; &amp; friends" in text
    assert not re.search(r"\bnan\b|\bNone\b", re.sub(r"base64,[^']*", "", text))
    assert ("Poses to measure next" in text) == (name == "ambiguous")
    assert ("error on data held out, before and after" in text) == (name != "none")
    assert len(text) < 3e6


def test_names_are_text_and_no_markup(tmp_path):
    report = cases.many()
    report.effects[0].rivals = [cases.cause("x", None, "<script>alert('ü')</script>", 0.5)]
    report.held_out.parts[0].name = "сессия <1> $\\frac"
    report.shown[0].against = "<i>$x^"
    report.warnings = ["<img src=x>", "$\\alpha"]
    write_diagnosis(report, tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert "<script" not in text
    assert "<img src=x>" not in text
    assert "sessions &lt;1&gt; &amp; 2" in text
    assert "Größe µ ✓" in text
    write_diagnosis(report, tmp_path / "r.png")


def test_page_and_sheet_are_the_same_bytes_twice(tmp_path):
    for name in ("a", "b"):
        write_diagnosis(cases.none(), tmp_path / f"{name}.html")
        write_diagnosis(cases.none(), tmp_path / f"{name}.png")
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_the_next_poses_are_listed_in_degrees():
    report = cases.ambiguous()
    text = _poses(report)
    assert "Poses to measure next" in text
    assert f"<td>{math.degrees(report.next_poses[0, 0]):.2f}</td>".replace("-", "−") in text
    assert _poses(cases.named()) == ""


def test_a_page_of_many_rows_stays_small_and_says_what_it_draws(tmp_path):
    report = cases.base(count=12_000, sessions=3)
    write_diagnosis(report, tmp_path / "r.html")
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    assert len(text) < 4e6
    assert "1,500 of 12,000 rows are drawn" in text


def test_rows_that_were_not_held_out_are_left_out(tmp_path):
    report = cases.named()
    report.held_out.before = np.where(np.arange(240) % 3 == 0, np.nan, report.held_out.before)
    report.held_out.after = np.full(240, np.nan)
    write_diagnosis(report, tmp_path / "r.html")
    write_diagnosis(report, tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text())["held_out"]
    assert kept["after_m"] == [None] * 240
    assert kept["before_m"][0] is None
    assert kept["before_m"][1] == report.held_out.before[1]


@pytest.mark.parametrize("size", [0.0, 1e-300, 5e-324, 1e6, math.inf, math.nan])
def test_odd_numbers_are_drawn_and_written(size, tmp_path):
    report = cases.named()
    effect = report.effects[0]
    effect.p_value = effect.size = effect.gain = size
    effect.parameters["cos"] = cases.Estimate(
        value=1e-4, unit="rad", std=size, interval=(-size, size)
    )
    report.shown[0].p_value = report.held_out.p_value = size
    report.leftover.size = size
    write_diagnosis(report, tmp_path / "r.json")
    assert "  " not in summary(report)
    if size in (0.0, math.inf) or math.isnan(size):
        write_diagnosis(report, tmp_path / "r.html")
    kept = json.loads((tmp_path / "r.json").read_text())["effects"][0]
    assert kept["p_value"] == (size if math.isfinite(size) else None)


def test_touches_have_positions_of_their_own(tmp_path):
    """Measured positions are those that the identified arm foretells."""
    from touch_jobs import simulated

    made = simulated()
    fit = bathyal.identify_arm(bathyal.arms.ur10e(), made.touches)
    report = cases.named()
    report.__dict__.update(data=made.touches, fit=fit, residuals_before=fit.residuals.T,
                           residuals_after=fit.residuals.T)  # fmt: skip
    report.held_out.before = report.held_out.after = np.linalg.norm(fit.residuals, axis=1)
    place = tables.positions(report)
    assert np.abs(place - fit.points[made.touches.point]).max() < 1e-3
    write_diagnosis(report, tmp_path / "r.html")
    assert "touch each point" in next_steps(_with(report, verdict="none"))[0].lower()


def _with(report, **changes):
    report.__dict__.update(changes)
    return report


# Files --------------------------------------------------------------------------------------------


KEYS = [
    "ambiguous", "bathyal", "detectable_m", "effects", "format", "gain", "held_out", "joint_units",
    "leftover", "next", "next_poses", "noise_m", "noise_source", "poses", "residuals_after_m",
    "residuals_before_m", "schema", "shown", "summary", "verdict", "warnings",
]  # fmt: skip


@ALL
def test_json_keeps_its_names_and_goes_round(name, tmp_path):
    report = cases.CASES[name]()
    write_diagnosis(report, tmp_path / "r.json", settings={"tracked": True})
    kept = json.loads((tmp_path / "r.json").read_text(encoding="utf-8"))
    assert kept.pop("settings") == {"tracked": True}
    assert sorted(kept) == KEYS
    assert (kept["format"], kept["schema"]) == ("bathyal diagnosis", 1)
    assert json.loads(json.dumps(kept, allow_nan=False)) == kept
    assert np.shape(kept["residuals_before_m"]) == (len(report.data), 3)
    assert np.array_equal(kept["residuals_after_m"], report.residuals_after.T)
    assert sorted(told(report)) == KEYS
    for effect, own in zip(kept["effects"], report.effects, strict=True):
        assert sorted(effect) == [
            "gain", "held_out_after_m", "held_out_before_m", "joint", "name", "p_value",
            "parameters", "rivals", "rows", "size_m", "words",
        ]  # fmt: skip
        for number, estimate in own.parameters.items():
            kept_number = effect["parameters"][number]
            assert (kept_number["low"], kept_number["high"]) == estimate.interval
            assert sorted(kept_number) == ["high", "low", "std", "unit", "value"]


def test_json_holds_small_chances_and_no_nan(tmp_path):
    write_diagnosis(cases.named(), tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert kept["effects"][0]["p_value"] == 1e-300
    write_diagnosis(cases.none(), tmp_path / "r.json")
    kept = json.loads((tmp_path / "r.json").read_text(), parse_constant=pytest.fail)
    assert kept["gain"] is None
    assert kept["held_out"]["before_m"] == [None] * 40


def test_residuals_as_a_table(tmp_path):
    report = cases.named()
    report.held_out.before = np.where(np.arange(240) == 7, np.nan, report.held_out.before)
    write_residuals(report, tmp_path / "r.csv")
    with open(tmp_path / "r.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 240
    assert rows[7]["held_out_before_m"] == ""
    assert float(rows[9]["held_out_before_m"]) == report.held_out.before[9]
    assert float(rows[9]["z_m"]) == report.residuals_after[2, 9]
    assert float(rows[9]["before_m"]) == pytest.approx(
        np.linalg.norm(report.residuals_before[:, 9]), rel=1e-15
    )


def test_other_endings_are_refused_and_nothing_is_half_written(tmp_path):
    with pytest.raises(ValueError, match=r"`path`: expected a report file \(.html .json .png\)"):
        write_diagnosis(cases.named(), tmp_path / "r.pdf")
    (tmp_path / "r.html").write_text("old")
    broken = cases.named()
    broken.held_out = None
    with pytest.raises(AttributeError):
        write_diagnosis(broken, tmp_path / "r.html")
    assert (tmp_path / "r.html").read_text() == "old"
    assert [file.name for file in tmp_path.iterdir()] == ["r.html"]
