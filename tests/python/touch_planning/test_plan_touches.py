# SPDX-License-Identifier: BSD-3-Clause
"""bathyal.plan_touches and forecast_touches: better than hands and chance, also in truth."""

from __future__ import annotations

import numpy as np
import pytest

import bathyal

POINTS = np.array([[0.75, -0.2, 0.25], [0.65, 0.35, 0.15], [0.55, 0.0, 0.6]])
DISTANCES = [(0, 1), (0, 2)]
COUNT = 63
HAND = [0.0, -1.2, 1.6, -2.0, -np.pi / 2, 0.0]  # elbow up, tool down, as seen from the front


def ur10e() -> bathyal.Arm:
    arm = bathyal.arms.ur10e()
    tool = np.eye(4)
    tool[:3, 3] = [0.03, 0.02, 0.15]
    arm.tool = tool
    return arm


def given_distances() -> dict[tuple[int, int], float]:
    return {(a, b): float(np.linalg.norm(POINTS[a] - POINTS[b])) for a, b in DISTANCES}


def touches(q, point):
    return bathyal.Touches(q, point, known_distances=given_distances())


def about(axis, angle):
    """(N, 3, 3) rotations about unit axes (N, 3)."""
    k = np.zeros((len(angle), 3, 3))
    x, y, z = axis.T
    k[:, 0, 1], k[:, 0, 2], k[:, 1, 2] = -z, y, -x
    k -= k.transpose(0, 2, 1)
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def by_hand(arm, seed):
    """21 touches a point, the tool within 45° of straight down and turned by at most as much."""
    rng = np.random.default_rng(seed)
    half = np.radians(45)
    rows, labels = [], []
    for label, place in enumerate(POINTS):
        n = 60
        azimuth, tilt = rng.uniform(0, 2 * np.pi, n), np.arccos(rng.uniform(np.cos(half), 1, n))
        level = np.column_stack([np.cos(azimuth), np.sin(azimuth), np.zeros(n)])
        up = np.tile([0.0, 0.0, 1.0], (n, 1))
        poses = np.tile(np.eye(4), (n, 1, 1))
        poses[:, :3, :3] = (
            about(level, tilt) @ np.diag([1, -1, -1]) @ about(up, rng.uniform(-half, half, n))
        )
        poses[:, :3, 3] = place
        found = arm.inverse(poses, HAND)
        reached = found.q[np.array(found.status) == "reached"][: COUNT // 3]
        rows.append(reached)
        labels += [label] * len(reached)
    assert len(labels) == COUNT
    return np.vstack(rows), np.array(labels)


def by_chance(arm, seed):
    """21 touches a point, from anywhere."""
    rng = np.random.default_rng(seed)
    rows = []
    for place in POINTS:
        start = rng.uniform(-np.pi, np.pi, (40, 6))
        found = arm.inverse(np.tile(place, (40, 1)), start, task="position")
        rows.append(found.q[np.array(found.status) == "reached"][: COUNT // 3])
    return np.vstack(rows), np.repeat([0, 1, 2], COUNT // 3)


@pytest.fixture(scope="module")
def arm():
    return ur10e()


@pytest.fixture(scope="module")
def plan(arm):
    return bathyal.plan_touches(arm, COUNT, points=POINTS, known_distances=DISTANCES)


def test_the_plan_touches_its_points(arm, plan):
    tips = arm.forward(plan.q)[:, :3, 3]
    np.testing.assert_allclose(tips, POINTS[plan.point], atol=1e-12)
    assert (plan.q >= arm.lower).all()
    assert (plan.q <= arm.upper).all()
    assert len(plan) == COUNT
    assert np.bincount(plan.point).min() >= 2
    assert len(np.unique(plan.q, axis=0)) == COUNT
    assert plan.forecast.rank == plan.forecast.free == 21
    assert plan.forecast.parameters == 27
    assert plan.value == plan.worst_tip_std == plan.forecast.tip_std.max()
    assert plan.median_tip_std == pytest.approx(np.median(plan.forecast.tip_std), rel=0.02)


def test_the_worst_deviation_at_least_halves_against_hands(arm, plan):
    hands = [
        bathyal.forecast_touches(
            arm, touches(*by_hand(arm, seed)), workspace=plan.forecast.workspace
        ).worst_tip_std
        for seed in range(20)
    ]
    assert plan.worst_tip_std < 0.4 * np.median(hands)
    assert plan.worst_tip_std < 0.5 * min(hands)


@pytest.mark.parametrize("distances", [DISTANCES, []], ids=["distances", "no distance"])
def test_never_worse_than_the_median_of_200_random_designs(arm, distances):
    planned = bathyal.plan_touches(arm, COUNT, points=POINTS, known_distances=distances)
    known = {pair: given_distances()[pair] for pair in distances}
    worst = [
        bathyal.forecast_touches(
            arm,
            bathyal.Touches(*by_chance(arm, seed), known_distances=known),
            workspace=planned.forecast.workspace,
        ).worst_tip_std
        for seed in range(200)
    ]
    assert planned.worst_tip_std < np.median(worst)
    assert planned.worst_tip_std < np.quantile(worst, 0.05)


def true_arm(seed):
    """The UR10e with errors of the size that the priors say."""
    rng = np.random.default_rng(seed)
    d = np.array([0.1807, 0, 0, 0.1741, 0.1198, 0.1165])
    a = np.array([0, -0.6127, -0.5715, 0, 0, 0])
    alpha = np.array([np.pi / 2, 0, 0, np.pi / 2, -np.pi / 2, 0])
    arm = bathyal.Arm.from_dh(
        a=a + rng.normal(0, 1e-3, 6),
        alpha=alpha + rng.normal(0, 2e-3, 6),
        d=d + rng.normal(0, 1e-3, 6),
        theta=rng.normal(0, 2e-3, 6),
        beta=np.array([0, 1, 1, 0, 0, 0]) * rng.normal(0, 2e-3, 6),
    )
    arm.tool = ur10e().tool
    return arm


def touched_by(truth, q, point, seed):
    """What the joints read when the true tip is on the point, within 0.1 mm per axis."""
    rng = np.random.default_rng(seed)
    places = POINTS[point] + rng.normal(0, 1e-4, (len(q), 3))
    found = truth.inverse(places, q, task="position", max_starts=1)
    assert set(found.status) == {"reached"}
    return found.q


def test_predictions_come_true(arm, plan):
    workspace = plan.forecast.workspace

    def strays(q, point, seed):
        truth = true_arm(seed)
        fit = bathyal.identify_arm(arm, touches(touched_by(truth, q, point, seed), point))
        found, real = fit.arm.forward(workspace), truth.forward(workspace)
        # The tips' clouds laid on each other: the pose of the base is not determined.
        return bathyal.verify_arm(fit.arm, workspace, real[:, :3, 3]).rms_after, found

    planned = [strays(plan.q, plan.point, seed)[0] for seed in range(15)]
    hands = [strays(*by_hand(arm, seed), seed)[0] for seed in range(15)]
    assert np.median(planned) < 0.5 * np.median(hands)
    assert np.median(planned) < 1.5 * plan.median_tip_std


def test_same_bytes_for_the_same_seed(arm, plan):
    again = bathyal.plan_touches(
        arm, COUNT, points=POINTS, known_distances=DISTANCES, num_threads=1
    )
    assert again.q.tobytes() == plan.q.tobytes()
    other = bathyal.plan_touches(arm, 8, points=POINTS, seed=1, candidates=50)
    assert other.q.tobytes() != (
        bathyal.plan_touches(arm, 8, points=POINTS, seed=2, candidates=50).q.tobytes()
    )


def test_criteria_by_name(arm, plan):
    chosen = {
        name: bathyal.plan_touches(
            arm, COUNT, points=POINTS, known_distances=DISTANCES, criterion=name
        )
        for name in ("d_optimal", "o1")
    }
    assert chosen["d_optimal"].value == chosen["d_optimal"].forecast.log_det
    assert chosen["o1"].value == chosen["o1"].forecast.o1
    assert chosen["d_optimal"].value > plan.forecast.log_det
    assert chosen["o1"].value > plan.forecast.o1
    assert min(p.worst_tip_std for p in chosen.values()) > plan.worst_tip_std


def test_o1_is_the_one_of_borm_and_menq(plan):
    values = plan.forecast.singular_values[: plan.forecast.rank]
    expected = np.exp(np.log(values).mean()) / np.sqrt(COUNT)
    assert plan.forecast.o1 == pytest.approx(expected, rel=1e-12)


def test_the_size_and_what_would_tell_it(arm):
    plan = bathyal.plan_touches(arm, 40, points=POINTS, length_prior=2e-3)
    assert plan.forecast.rank == plan.forecast.free - 1
    (unseen,) = plan.forecast.unseen
    assert "a of row 2" in unseen
    (size,) = [w for w in plan.warnings if "the scale of the arm" in w]
    assert "2 mm" in size
    assert "distance between points" in size
    measured = bathyal.plan_touches(arm, 40, points=POINTS, known_distances=[(0, 1)])
    assert not [w for w in measured.warnings if "the scale of the arm" in w]
    assert measured.worst_tip_std < 0.4 * plan.worst_tip_std
    placed = bathyal.plan_touches(arm, 40, points=POINTS, known_points=[0, 1, 2])
    assert placed.forecast.rank == placed.forecast.free == 23


def test_points_of_the_planners_choice(arm):
    plan = bathyal.plan_touches(arm, 20, num_points=4, candidates=100, floor=0.1)
    assert plan.points.shape == (4, 3)
    np.testing.assert_allclose(plan.points, plan.points.round(2), atol=1e-12)
    apart = np.linalg.norm(plan.points[:, None] - plan.points[None], axis=2)
    assert apart[np.triu_indices(4, 1)].min() > 0.1
    assert plan.points[:, 2].min() >= 0.1
    assert arm.forward(plan.q, links=True)[:, 1:, 2, 3].min() >= 0.1


def test_feasible_decides(arm):
    asked = []

    def feasible(q):
        asked.append(q.shape)
        return (np.abs(q[:, 0]) < 1.0) & (q[:, 2] > 0)

    plan = bathyal.plan_touches(arm, 20, points=POINTS, feasible=feasible, candidates=100)
    assert (np.abs(plan.q[:, 0]) < 1.0).all()
    assert (plan.q[:, 2] > 0).all()
    assert feasible(plan.forecast.workspace).all()
    assert len(asked) < 60
    assert all(len(shape) == 2 and shape[1] == 6 for shape in asked)


@pytest.mark.parametrize(
    ("answer", "named"),
    [
        (lambda q: True, "feasible"),
        (lambda q: np.ones(len(q) + 1, bool), "feasible"),
        (lambda q: np.ones((len(q), 1), bool), "feasible"),
        (lambda q: np.ones(len(q)), "feasible"),
        (lambda q: None, "feasible"),
        (lambda q: np.zeros(len(q), bool), "feasible"),
        ("yes", "feasible"),
    ],
)
def test_feasible_that_says_something_else(arm, answer, named):
    with pytest.raises(ValueError, match=f"`{named}`: expected"):
        bathyal.plan_touches(arm, 10, points=POINTS, feasible=answer, candidates=20)


def test_what_goes_wrong_in_feasible_comes_through(arm):
    def feasible(q):
        raise KeyError("no scene")

    with pytest.raises(KeyError, match="no scene"):
        bathyal.plan_touches(arm, 10, points=POINTS, feasible=feasible, candidates=20)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"points": [[0.6, 0, 0.2], [5, 0, 0]]}, r"`points`.*point 1 at \(5, 0, 0\)"),
        ({"points": [[0.6, 0, np.nan]]}, "`points`: expected finite"),
        ({"points": [0.6, 0, 0.2]}, "`points`: expected"),
        ({"points": np.zeros((0, 3))}, "`points`: expected"),
        ({"num_points": 0}, "`num_points`"),
        ({"known_distances": [(0, 3)]}, "`known_distances`: expected numbers of points, 0 … 2"),
        ({"known_distances": {(0, 1): 0.5}}, "`known_distances`: expected pairs"),
        ({"known_distances": [(1, 1)]}, "`known_distances`: expected two points"),
        ({"known_points": [7]}, "`known_points`"),
        ({"noise": 0.0}, "`noise`"),
        ({"length_prior": np.inf}, "`length_prior`"),
        ({"angle_prior": -1.0}, "`angle_prior`"),
        ({"tool_prior": 0.0}, "`tool_prior`"),
        ({"distance_std": 0.0}, "`distance_std`"),
        ({"point_std": np.nan}, "`point_std`"),
        ({"workspace": np.zeros((3, 5))}, "`workspace`"),
        ({"workspace": np.full((3, 6), np.nan)}, "`workspace`: expected finite"),
        ({"workspace_poses": 0}, "`workspace_poses`"),
        ({"floor": np.nan}, "`floor`"),
        ({"floor": 2.0}, "`floor`: expected some"),
        ({"criterion": "best"}, '`criterion`: expected "worst_tip" or "d_optimal" or "o1"'),
        ({"candidates": 1}, "`candidates`"),
        ({"passes": -1}, "`passes`"),
        ({"num_threads": -1}, "`num_threads`"),
    ],
)
def test_refusals(arm, options, text):
    with pytest.raises(ValueError, match=text):
        bathyal.plan_touches(arm, 10, **{"points": POINTS, "candidates": 20, **options})


def test_too_few_touches(arm):
    with pytest.raises(ValueError, match="`count`: expected 2 or more touches, got 1"):
        bathyal.plan_touches(arm, 1)
    plan = bathyal.plan_touches(arm, 5, points=POINTS, candidates=50)
    assert len(plan) == 5
    assert set(plan.point) == {0, 1}
    text = str(plan)
    assert "only 2 points will be touched" in text
    assert "5 touches of 2 points give 9 numbers for 21 unknowns" in text
    assert "do not determine 12 combinations" in text
    assert plan.worst_tip_std < 0.02  # the priors hold what touches do not tell
    assert len(bathyal.plan_touches(arm, 2, points=POINTS, candidates=50)) == 2


def test_little_may_be_held(arm):
    plan = bathyal.plan_touches(arm, 30, points=POINTS, candidates=5)
    assert len(plan) == 15
    assert "Only 15 poses that may be held were found" in str(plan)


def test_three_joints_reach_a_point_in_few_ways():
    arm = bathyal.arms.maevskiy_zanin()
    plan = bathyal.plan_touches(arm, 30, num_points=3)
    assert len(plan) < 30
    assert len(np.unique(plan.q.round(5), axis=0)) == len(plan)
    assert "More points would give more" in str(plan)
    assert plan.worst_tip_std < 0.1  # the priors hold, the tool's too


def test_a_joint_that_cannot_move():
    arm = bathyal.Arm.from_dh(
        a=[0, 0.5, 0.4, 0], alpha=[np.pi / 2, 0, 0, 0], d=[0.2, 0, 0, 0], theta=[0] * 4,
        lower=[-3, -2, -2.5, 0.3], upper=[3, 2, 2.5, 0.3],
    )  # fmt: skip
    plan = bathyal.plan_touches(arm, 12, num_points=2, candidates=60)
    assert any("Joint 4" in w and "moves by 0 deg only" in w for w in plan.warnings)
    assert any("no tool" in w for w in plan.warnings)
    assert np.isfinite(plan.worst_tip_std)


def test_without_limits_and_with_a_sliding_joint():
    arm = bathyal.Arm.from_dh(
        a=[0, 0.4, 0.3, 0], alpha=[0, 0, np.pi / 2, 0], d=[0.3, 0, 0, 0.1], theta=[0] * 4,
        joint_types=["prismatic", "revolute", "revolute", "revolute"],
    )  # fmt: skip
    tool = np.eye(4)
    tool[0, 3] = 0.1
    arm.tool = tool
    plan = bathyal.plan_touches(arm, 16, num_points=2, known_distances=[(0, 1)], candidates=80)
    np.testing.assert_allclose(arm.forward(plan.q)[:, :3, 3], plan.points[plan.point], atol=1e-10)
    assert np.ptp(plan.q[:, 0]) > 0.01


def test_base_and_workspace_of_the_user(arm):
    moved = ur10e()
    base = np.eye(4)
    base[:3, 3] = [10.0, 20.0, -5.0]
    moved.base = base
    kept = bathyal.plan_touches(arm, 20, points=POINTS, candidates=80)
    there = bathyal.plan_touches(moved, 20, points=POINTS + base[:3, 3], candidates=80)
    assert there.worst_tip_std == pytest.approx(kept.worst_tip_std, rel=1e-2)
    near = np.tile(HAND, (5, 1)) + np.linspace(-0.1, 0.1, 5)[:, None]
    planned = bathyal.plan_touches(arm, 20, points=POINTS, workspace=near, candidates=80)
    np.testing.assert_array_equal(planned.forecast.workspace, near)
    elsewhere = bathyal.forecast_touches(arm, bathyal.Touches(kept.q, kept.point), workspace=near)
    assert planned.worst_tip_std < elsewhere.worst_tip_std


def test_the_table_is_what_read_touches_reads(plan, tmp_path):
    file = tmp_path / "plan.csv"
    plan.write(file)
    read = bathyal.read_touches(file)
    np.testing.assert_allclose(read.q, plan.q, atol=np.radians(6e-4))
    np.testing.assert_array_equal(read.point, plan.point)
    assert "point 2 at 0.550 0.000 0.600" in file.read_text()
    assert "distance between points 0 and 2" in file.read_text()
    with pytest.raises(ValueError, match="csv"):
        plan.write(tmp_path / "plan.xlsx")


def test_the_picture(plan, tmp_path):
    figure = plan.plot(tmp_path / "plan.png")
    assert (tmp_path / "plan.png").stat().st_size > 50_000
    (legend,) = figure.legends
    counts = np.bincount(plan.point)
    assert [t.get_text() for t in legend.get_texts()] == [
        f"point {k}: {n} touches" for k, n in enumerate(counts)
    ]


def test_words(plan):
    text = plan.summary()
    assert text == str(plan)
    assert f"Touch 3 points in {COUNT} poses" in text
    assert f"{1e3 * plan.worst_tip_std:.3g} mm at the worst of 400 poses" in text
    assert "determine 21 of the 21" in text
    assert repr(plan).startswith("TouchPlan(63 touches of 3 points, worst 0.")
