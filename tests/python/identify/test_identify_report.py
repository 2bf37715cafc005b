# SPDX-License-Identifier: BSD-3-Clause
"""What a report of an identification shows: its tables, its words, its picture, its page."""

from __future__ import annotations

import csv
import math
import re

import numpy as np
import pytest

import bathyal
from bathyal.identify.job import identify
from bathyal.identify.report import tables as fit_tables
from bathyal.identify.report import text as fit_words
from bathyal.identify.report.curves import curves_of
from bathyal.identify.report.figure import fit_figure
from bathyal.identify.report.page import write_page
from bathyal.identify.simulate import simulate_touches, write_touches
from bathyal.view.figure import write_png
from tests.support.touch_jobs import MUKCA, simulated, table, with_distance

UR10E = bathyal.arms.ur10e()


@pytest.fixture(scope="module")
def made():
    return simulated()


@pytest.fixture(scope="module")
def unscaled(made):
    return bathyal.identify_arm(UR10E, made.touches)


@pytest.fixture(scope="module")
def data(made):
    return with_distance(made)


@pytest.fixture(scope="module")
def scaled(data):
    return bathyal.identify_arm(UR10E, data)


# The example --------------------------------------------------------------------------------------


def test_example_touches_its_points(made):
    tips = made.true_arm.forward(made.touches.q)[:, :3, 3]
    off = tips - made.points[made.touches.point]
    assert np.std(off) == pytest.approx(0.09e-3, rel=0.15)
    assert np.linalg.norm(made.points[0] - made.points[1]) == pytest.approx(made.apart, abs=1e-12)
    assert UR10E.within_limits(made.touches.q).all()
    exact = simulated(noise=0.0)
    tips = exact.true_arm.forward(exact.touches.q)[:, :3, 3]
    assert np.abs(tips - exact.points[exact.touches.point]).max() < 2e-6


def test_example_depends_on_its_seed_alone(made):
    assert np.array_equal(simulated().touches.q, made.touches.q)
    assert not np.array_equal(simulated(seed=1).touches.q, made.touches.q)


@pytest.mark.parametrize("name", ["gen3_lite", "panda", "reach_alpha_5", "reach_bravo_7", "ur10"])
def test_example_of_every_arm_can_be_identified(name):
    arm = getattr(bathyal.arms, name)()
    fit = bathyal.identify_arm(arm, with_distance(simulate_touches(arm)))
    assert fit.rms_after < 0.2e-3 < 0.5e-3 < fit.rms_before


@pytest.mark.parametrize(
    ("options", "name"),
    [({"count": 1}, "count"), ({"noise": -1.0}, "noise"), ({"noise": math.nan}, "noise")],
)
def test_example_refuses(options, name):
    with pytest.raises(ValueError, match=name):
        simulated(**options)


def test_example_needs_joints_enough():
    with pytest.raises(ValueError, match="4 moving joints"):
        simulate_touches(bathyal.arms.maevskiy_zanin())


# Names --------------------------------------------------------------------------------------------


def test_names_of_points_survive_the_table(made, tmp_path):
    again = bathyal.read_touches(table(tmp_path, made))
    assert again.names == {0: "left", 1: "right", 2: "top"}
    assert np.array_equal(again.point, made.touches.point)
    np.testing.assert_allclose(again.q, made.touches.q, atol=np.radians(0.51e-4))


def test_whole_numbers_need_no_names(tmp_path):
    (tmp_path / "t.csv").write_text("point;q1_deg;q2_deg\n7;0,5;1\n7;10;2\n9;1;30\n;;\n")
    touches = bathyal.read_touches(tmp_path / "t.csv")
    assert touches.names == {}
    assert touches.point.tolist() == [7, 7, 9]
    assert fit_tables.point_name(touches, 9) == "point 9"


def test_labels_of_planes_and_known_points(tmp_path):
    rows = [f"{name},{a},{b}" for name in ("deck", "pin") for a, b in np.eye(4, 2) * 9 + 1]
    (tmp_path / "t.csv").write_text("\n".join(["point,q1_deg,q2_deg", *rows]))
    touches = bathyal.read_touches(
        tmp_path / "t.csv", planes=["deck"], known_points={"pin": (1, 2, 3)}
    )
    assert {name: rows.tolist() for name, rows in touches.planes.items()} == {"deck": [0, 1, 2, 3]}
    assert {label: at.tolist() for label, at in touches.known_points.items()} == {1: [1, 2, 3]}
    with pytest.raises(ValueError, match="`planes`: expected labels among deck, pin, got 'dock'"):
        bathyal.read_touches(tmp_path / "t.csv", planes=["dock"])


def test_names_are_of_labels_that_were_touched():
    with pytest.raises(ValueError, match=r"`names`: expected labels that occur in `point`, got 5"):
        bathyal.Touches([[0, 1], [1, 0]], [0, 0], names={5: "left"})
    with pytest.raises(ValueError, match="`names`: expected a dict"):
        bathyal.Touches([[0, 1], [1, 0]], [0, 0], names=["left"])


# Tables -------------------------------------------------------------------------------------------


def test_pairs_are_those_of_the_paper(data, scaled):
    """J of eq 7 is the sum of the squares of what is drawn, before and after."""
    pairs = fit_tables.pair_distances(scaled, data)
    assert [some.group for some in pairs] == ["left", "right", "top"]
    assert sum(len(some.before) for some in pairs) == 3 * 21 * 20 // 2
    for name, total in (("before", scaled.pairs_before), ("after", scaled.pairs_after)):
        assert sum(np.sum(getattr(some, name) ** 2) for some in pairs) == pytest.approx(total)
    tips = scaled.arm.forward(data.q)[:, :3, 3]
    some = pairs[1]
    apart = np.linalg.norm(tips[some.first] - tips[some.second], axis=1)
    np.testing.assert_allclose(apart, some.after, atol=1e-12)


def test_groups_have_the_rms_of_the_fit(data, scaled):
    found = fit_tables.groups(scaled, data)
    np.testing.assert_allclose([group.before for group in found], scaled.point_rms_before)
    np.testing.assert_allclose([group.after for group in found], scaled.point_rms_after)


def test_parameters_are_shown_in_mm_and_degrees(scaled):
    lines = {line.name: line for line in fit_tables.lines(scaled)}
    alpha = lines["alpha_2"]
    p = next(p for p in scaled.parameters if p.name == "alpha_2")
    assert alpha.value == pytest.approx(math.degrees(p.value))
    assert alpha.change == pytest.approx(1e3 * (p.value - p.nominal))
    assert alpha.changed == f"+{1e3 * p.value:.3f} ± {1e3 * p.std:.3f} mrad"
    assert lines["a_2"].changed.endswith(" mm")
    assert lines["d_1"].changed == "held"
    assert lines["d_6"].trades == "tool_z −1"


@pytest.mark.parametrize(
    ("value", "sign", "text"), [(-0.0001, "", "0.000"), (-2.5, "", "−2.500"), (0.25, "+", "+0.250")]
)
def test_numbers_are_printed_with_a_true_minus(value, sign, text):
    assert fit_tables.number(value, sign=sign) == text


def test_csv_files_hold_every_parameter_and_row(data, scaled, tmp_path):
    fit_tables.write_parameters(scaled, tmp_path / "p.csv")
    fit_tables.write_residuals(scaled, data, tmp_path / "r.csv")
    with open(tmp_path / "p.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["name"] for row in rows] == [p.name for p in scaled.parameters]
    assert [float(row["value"]) for row in rows] == [p.value for p in scaled.parameters]
    with open(tmp_path / "r.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    after = np.array([float(row["after_m"]) for row in rows])
    assert np.sqrt(np.mean(after**2)) == pytest.approx(scaled.rms_after)
    assert [row["group"] for row in rows[::21]] == ["left", "right", "top"]


def test_many_pairs_are_thinned_and_said_so():
    made = simulated(count=70)
    fit = bathyal.identify_arm(UR10E, made.touches)
    curves = curves_of(fit, made.touches)
    assert sum(len(curve.before) for curve in curves.curves) <= 6000
    assert re.search(r"; [\d,]+ of 7,245 shown$", curves.across)
    square = sum(np.sum(some.after**2) for some in fit_tables.pair_distances(fit, made.touches))
    counted = sum(70 * 69 / 2 * curve.rms_after**2 for curve in curves.curves)
    assert counted == pytest.approx(square)


# Words --------------------------------------------------------------------------------------------


def test_undetermined_scale_is_the_first_thing_to_mend(data, made, unscaled, scaled):
    wanted = fit_words.next_touches(unscaled, made.touches)
    assert wanted[0].startswith("Measure one distance between touched points, say left to right")
    assert "prior" in unscaled.summary(warnings=False)
    assert not any("Measure one" in text for text in fit_words.next_touches(scaled, data))


def test_how_surely_depends_on_the_size(unscaled, scaled):
    def predicted(fit):
        return float(re.search(r"tip is predicted to ([\d.]+) mm", fit_words.surely_text(fit))[1])

    assert predicted(unscaled) > 2 * predicted(scaled)
    q = np.random.default_rng(5).uniform(-np.pi, np.pi, (500, 6))
    assert predicted(scaled) == pytest.approx(1e3 * np.median(scaled.tip_std(q)), rel=0.1)


def test_one_point_needs_a_second(made):
    touches = bathyal.Touches(made.touches.q[:21], made.touches.point[:21])
    fit = bathyal.identify_arm(UR10E, touches)
    assert fit_words.next_touches(fit, touches)[0].startswith("Touch a second point")


def test_joint_that_did_not_move_is_named(made):
    q = made.touches.q.copy()
    q[:, 4] = 0.3 + 0.01 * np.arange(len(q)) / len(q)
    touches = bathyal.Touches(q, made.touches.point)
    fit = bathyal.identify_arm(UR10E, touches)
    assert any("wrist_2_joint moved over" in text for text in fit_words.next_touches(fit, touches))


def test_few_touches_are_reported():
    made = simulated(count=5)
    fit = bathyal.identify_arm(UR10E, made.touches)
    assert any(
        "degrees of freedom remain" in text for text in fit_words.next_touches(fit, made.touches)
    )


def test_known_distances_are_listed_with_what_was_found(data, scaled):
    text = fit_words.known_text(scaled, data)
    assert text.startswith("Known distances: left to right given 350.000 mm, found 3")


def test_data_of_another_fit_are_refused(made, scaled):
    for other in (made.touches, with_distance(simulated(count=8))):
        with pytest.raises(ValueError, match="`data`: expected what the fit was found from"):
            fit_figure(scaled, other)


def test_unseen_motion_is_no_standard_deviation():
    """An elbow that never moved says nothing of what lies before and behind it."""
    arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    q = np.random.default_rng(1).uniform(-2, 2, (40, 2))
    q[:, 1] = 0.3
    tracked = bathyal.Tracked(q, arm.forward(q)[:, :3, 3])
    fit = bathyal.identify_arm(arm, tracked)
    assert "Everywhere the tip depends on what the data do not determine" in fit_words.surely_text(
        fit
    )
    lost = [text for text in fit_words.next_touches(fit, tracked) if "do not determine" in text]
    assert "base_z" in lost[0]
    assert "measure more poses" in lost[0]
    table = {line.name: line.changed for line in fit_tables.lines(fit)}
    assert table["base_z"].endswith("± ? mm")


def test_warnings_are_shown_once(unscaled, scaled):
    """By the paragraph, or by who leaves them out of it."""
    assert unscaled.warnings
    assert not scaled.warnings
    short = unscaled.summary(warnings=False)
    assert unscaled.summary().startswith(short)
    for warning in unscaled.warnings:
        assert warning in unscaled.summary()
        assert warning not in short
    assert not short.endswith("But:")
    assert scaled.summary(warnings=False) == scaled.summary()


# Picture and page ---------------------------------------------------------------------------------


def test_picture_shows_what_was_found(data, scaled):
    figure = fit_figure(scaled, data, title="UR10e")
    words = " ".join(" ".join(text.get_text().split()) for text in figure.texts)
    assert scaled.summary(warnings=False) in words
    assert "350.000 mm" in words
    pairs, values, table, *joints = figure.axes
    assert len(joints) == 6
    assert values.get_title() == "rank 21 of 27"
    shown = [line.get_ydata() for line in pairs.lines if len(line.get_ydata()) == 210]
    after = np.concatenate(shown[1::2]) * 1e-3
    assert np.sum(after**2) == pytest.approx(scaled.pairs_after)
    names = [text.get_text() for text in table.texts]
    assert all(p.name in names for p in scaled.parameters)


def test_picture_and_page_are_the_same_bytes_twice(data, scaled, tmp_path):
    for name in "ab":
        write_png(fit_figure(scaled, data), tmp_path / f"{name}.png")
        write_page(scaled, data, tmp_path / f"{name}.html")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()


def test_page_needs_no_network_and_shows_everything(data, scaled, tmp_path):
    write_page(scaled, data, tmp_path / "r.html", title="<arm>", facts={"a<": "b&"})
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    own = page.replace(page[page.index("<script>") : page.index("</script>")], "", 1)
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=", own)
    assert "&lt;arm&gt;" in own
    assert "a&lt;" in own
    for name in ("pairs", "values", "residuals", "arm"):
        assert f'id="{name}"' in own
    assert own.count("<tr><td title=") == len(scaled.parameters)
    assert "349.99" in own or "350.00" in own


def test_tracked_poses_have_a_report_too(made, tmp_path):
    q = made.touches.q
    tracked = bathyal.Tracked(q, made.true_arm.forward(q)[:, :3, 3])
    fit = bathyal.identify_arm(UR10E, tracked)
    assert [group.name for group in fit_tables.groups(fit, tracked)] == ["all poses"]
    figure = fit_figure(fit, tracked)
    assert "from where it should be" in figure.axes[0].get_ylabel()
    write_page(fit, tracked, tmp_path / "r.html")
    assert "Measure one distance" not in " ".join(fit_words.next_touches(fit, tracked))


def test_planes_are_listed_with_points(made, tmp_path):
    """A plane has no pairs; its rows have distances of their own."""
    q, rng = made.touches.q[:21], np.random.default_rng(4)
    places = np.column_stack([rng.uniform([0.4, -0.3], [0.8, 0.3], (30, 2)), np.full(30, 0.2)])
    found = made.true_arm.inverse(places, task="position")
    reached = found.q[np.asarray(found.status) == "reached"]
    rows = np.arange(21, 21 + len(reached))
    touches = bathyal.Touches(
        np.vstack([q, reached]), np.zeros(21 + len(reached)), planes={"deck": rows}
    )
    fit = bathyal.identify_arm(UR10E, touches)
    assert [group.name for group in fit_tables.groups(fit, touches)] == ["point 0", "plane deck"]
    assert [some.group for some in fit_tables.pair_distances(fit, touches)] == ["point 0"]
    fit_figure(fit, touches)
    write_page(fit, touches, tmp_path / "r.html")


# From end to end ----------------------------------------------------------------------------------


def test_files_of_one_point_each_are_called_by_what_differs(made, tmp_path):
    touches = made.touches
    for folder, point in (("front", 0), ("back", 1)):
        (tmp_path / folder).mkdir()
        rows = touches.point == point
        some = bathyal.Touches(touches.q[rows], touches.point[rows])
        write_touches(some, tmp_path / folder / "hole.csv")
    files = [tmp_path / "front" / "hole.csv", tmp_path / "back" / "hole.csv"]
    found = identify(files, "ur10e")
    assert found.data.names == {0: "front/hole", 1: "back/hole"}
    with pytest.raises(ValueError, match="`source`: expected each file once"):
        identify([files[0], files[0]], "ur10e")


def test_columns_may_be_called_as_the_joints_are(made, tmp_path):
    text = table(tmp_path, made).read_text()
    for number, name in enumerate(UR10E.joint_names, 1):
        text = text.replace(f"q{number}_deg", f"{name} [deg]")
    (tmp_path / "named.csv").write_text(text)
    named = identify(tmp_path / "named.csv", "ur10e")
    numbered = identify(tmp_path / "touches.csv", "ur10e")
    assert named.fit.rms_after == numbered.fit.rms_after


def test_arm_says_where_it_comes_from(made, tmp_path):
    arm = identify(table(tmp_path, made), "ur10e").arm
    assert "from touches.csv; nominal: Yukhimets, Gubankov (2023)" in arm.source


@pytest.mark.skipif(not MUKCA.exists(), reason="no shared data next to the project: arms/mukca")
def test_mukca_report():
    """Sockets 50.0 mm apart, a pair in each folder, touched by a ball."""
    folders = sorted((MUKCA / "data" / "panda_2_clean").iterdir())
    files = [folder / f"hole_{k}.csv" for folder in folders for k in (0, 1)]
    known = {(f"{f.name}/hole_0", f"{f.name}/hole_1"): 0.05 for f in folders}
    arm = bathyal.read_arm(MUKCA / "urdf" / "panda.urdf", tip="ball_link")
    found = identify(files, arm, read={"unit": "rad", "known_distances": known})
    assert found.facts["touches"] == "497 of 16 points"
    assert 1e3 * found.fit.rms_after < 0.31
    off = [d.found - d.given for d in fit_tables.distances(found.fit, found.data)]
    assert np.max(np.abs(off)) < 0.3e-3
    assert "8 known distances" in fit_words.known_text(found.fit, found.data)
