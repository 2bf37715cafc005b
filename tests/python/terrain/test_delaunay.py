# SPDX-License-Identifier: BSD-3-Clause
"""The 2.5-D Delaunay triangulation, proven with fractions: every circle against every point."""

from fractions import Fraction
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bathyal._core import triangulate_delaunay


def with_depth(xy):
    xy = np.asarray(xy, dtype=float).reshape(-1, 2)
    return np.column_stack([xy, np.full(len(xy), -50.0)])


def exact(xy):
    return [(Fraction(float(x)), Fraction(float(y))) for x, y in xy]


def turn(a, b, c):
    return (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])


def in_circle(a, b, c, d):
    """Above 0 when d is inside the circle through a, b, c, which turn counter-clockwise."""
    (ax, ay), (bx, by), (cx, cy) = ((p[0] - d[0], p[1] - d[1]) for p in (a, b, c))
    return (
        (ax * ax + ay * ay) * (bx * cy - cx * by)
        + (bx * bx + by * by) * (cx * ay - ax * cy)
        + (cx * cx + cy * cy) * (ax * by - bx * ay)
    )


def hull_area_doubled(points):
    def chain(order):
        stack = []
        for p in order:
            while len(stack) > 1 and turn(stack[-2], stack[-1], p) <= 0:
                stack.pop()
            stack.append(p)
        return stack[:-1]

    points = sorted(set(points))
    hull = chain(points) + chain(points[::-1])
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(hull, hull[1:] + hull[:1], strict=True))


def assert_delaunay(xy, triangles):
    """Empty circles, every distinct point used, and areas that add up to the hull's."""
    points = exact(xy)
    area = Fraction(0)
    for t in triangles:
        a, b, c = (points[i] for i in t)
        doubled = turn(a, b, c)
        assert doubled > 0
        area += doubled
        assert all(in_circle(a, b, c, d) <= 0 for d in points)
    assert area == hull_area_doubled(points)
    assert {points[i] for i in np.unique(triangles)} == set(points)


def integer_circle():
    radius2 = 5 * 13 * 17
    across = range(-34, 35)
    points = [(x, y) for x in across for y in across if x * x + y * y == radius2]
    assert len(points) > 30
    return [*points, (0, 0)]


rng = np.random.default_rng(5)
ARRANGEMENTS = {
    "scattered": rng.random((60, 2)),
    "scattered far off": rng.random((60, 2)) + np.array([6.2e5, 1e7]),
    "grid": [(x, y) for x in range(7) for y in range(6)],
    "survey grid": [(620152.873 + 2 * x, 7246504.912 + 2 * y) for x in range(7) for y in range(6)],
    "fine grid about zero": [(0.1 * x - 0.3, 0.1 * y) for x in range(7) for y in range(6)],
    "co-circular": integer_circle(),
    "line and a point off it": [(x, 2 * x) for x in range(30)] + [(3, 7)],
    "two lines": [(x, 0.1) for x in range(20)] + [(x + 0.5, 0.3) for x in range(20)],
    "clusters": np.vstack([rng.random((20, 2)), 1e-6 * rng.random((20, 2)) + 1e9]),
    "three": [(0, 0), (1, 0), (0, 1)],
}


@pytest.mark.parametrize("name", ARRANGEMENTS)
def test_circles_are_empty_and_the_hull_is_covered(name):
    xy = ARRANGEMENTS[name]
    triangles, report = triangulate_delaunay(with_depth(xy), max_edge=inf)
    assert triangles.dtype == np.int32
    assert_delaunay(xy, triangles)
    assert report["max_edge"] == inf
    assert report["cut_triangles"] == 0


@pytest.mark.parametrize("name", ARRANGEMENTS)
def test_order_of_points_does_not_matter(name):
    xy = np.unique(np.asarray(ARRANGEMENTS[name], dtype=float), axis=0)
    order = np.random.default_rng(1).permutation(len(xy))
    triangles, _ = triangulate_delaunay(with_depth(xy), max_edge=inf)
    permuted, _ = triangulate_delaunay(with_depth(xy[order]), max_edge=inf)
    assert np.array_equal(xy[order][permuted], xy[triangles])


# Few values, so that lines, circles and repeated points are the rule.
crowded = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=3, max_size=25)
number = st.floats(-1e9, 1e9)
anywhere = st.lists(st.tuples(number, number), min_size=3, max_size=12)


@settings(max_examples=150, deadline=None)
@given(xy=st.one_of(crowded, anywhere), offset=st.sampled_from([0.0, 1e7]))
def test_any_points(xy, offset):
    xy = np.asarray(xy, dtype=float) + offset
    points = exact(xy)
    distinct = sorted(set(points))
    if all(turn(distinct[0], distinct[-1], p) == 0 for p in distinct):
        with pytest.raises(ValueError, match=r"`points`: expected three or more"):
            triangulate_delaunay(with_depth(xy))
        return
    triangles, report = triangulate_delaunay(with_depth(xy), max_edge=inf)
    assert_delaunay(xy, triangles)
    assert report["merged_points"] == len(points) - len(distinct)


def test_the_lowest_of_several_in_one_place_is_used():
    points = np.array([[0, 0, -5], [1, 0, -5], [0, 1, -4], [0, 1, -6], [0, 1, -6], [1, 0, -4.0]])
    triangles, report = triangulate_delaunay(points)
    assert sorted(triangles[0]) == [0, 1, 3]
    assert report["merged_points"] == 3


def test_max_edge_is_horizontal_and_leaves_gaps():
    left = [(x, y) for x in range(10) for y in range(10)]
    right = [(x + 30, y) for x, y in left]
    points = with_depth(left + right)
    points[::3, 2] = 1000.0  # heights do not count
    triangles, report = triangulate_delaunay(points)
    assert report["max_edge"] == pytest.approx(5 * 2**0.5)
    assert len(triangles) == 2 * 2 * 81
    assert report["cut_triangles"] == 2 * 9
    whole, whole_report = triangulate_delaunay(points, max_edge=inf)
    assert len(whole) == len(triangles) + report["cut_triangles"]
    assert whole_report["cut_triangles"] == 0
    edge = 2**0.5
    assert len(triangulate_delaunay(points, max_edge=edge)[0]) == len(triangles)
    assert len(triangulate_delaunay(points, max_edge=np.nextafter(edge, 0))[0]) == 0


def test_few_points_are_not_trimmed_unasked():
    xy = [*((x, y) for x in range(5) for y in range(5)), (1000, 2)]
    _, report = triangulate_delaunay(with_depth(xy))
    assert report["max_edge"] == inf
    assert report["cut_triangles"] == 0


def test_threads_do_not_show():
    xy = np.random.default_rng(2).random((100_000, 2)) * 1e3 + [5e5, 6e6]
    one, report = triangulate_delaunay(with_depth(xy), num_threads=1)
    for threads in (0, 2, 8):
        many, report_many = triangulate_delaunay(with_depth(xy), num_threads=threads)
        assert one.tobytes() == many.tobytes()
        assert report == report_many


@pytest.mark.parametrize("max_edge", [0.0, -1.0, np.nan])
def test_refuses_a_max_edge_that_is_not_above_zero(max_edge):
    with pytest.raises(ValueError, match="`max_edge`: expected a number above 0"):
        triangulate_delaunay(with_depth([(0, 0), (1, 0), (0, 1)]), max_edge=max_edge)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (np.zeros((0, 3)), "got 0 distinct"),
        (np.zeros((1, 3)), "got 1 distinct"),
        (np.zeros((9, 3)), "got 1 distinct"),
        (with_depth([(0, 0), (1, 1)]), "got 2 distinct"),
        (with_depth([(0.1 * x, 5) for x in range(40)]), "all on one line"),
        (np.array([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]]), "row 2"),
        (np.array([[0, 0, 0], [1, 0, -np.inf], [0, 1, 0]]), "row 1"),
        (with_depth([(0, 0), (1e80, 0), (0, 1)]), "at most 1e.75"),
        (np.zeros((4, 2)), r"shape \(N, 3\)"),
    ],
)
def test_refuses_points_without_a_triangulation(points, message):
    with pytest.raises(ValueError, match=f"`points`.*{message}"):
        triangulate_delaunay(points)
