# SPDX-License-Identifier: BSD-3-Clause
"""Cleaning: every sounding that goes is counted, and the fish are found."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal

coordinates = st.one_of(st.integers(-3, 3).map(float), st.sampled_from([math.nan, math.inf, 0.5]))
points = st.lists(st.tuples(coordinates, coordinates, coordinates), max_size=40)


def rows_as_set(cloud):
    return {tuple(p) for p in cloud.points.tolist()}


@settings(max_examples=150, deadline=None)
@given(points=points, data=st.data())
def test_cleaning_accounts_for_every_sounding(points, data):
    array = np.array(points, dtype=float).reshape(-1, 3)
    order = data.draw(st.permutations(range(len(points))))
    options = {
        "same_place": data.draw(st.sampled_from(["keep", "shallowest", "deepest"])),
        "spike_sigma": data.draw(st.sampled_from([0.0, 3.0])),
        "outlier_sigma": data.draw(st.sampled_from([0.0, 1.0])),
        "voxel": data.draw(st.sampled_from([0.0, 2.0])),
    }
    number = np.arange(len(points), dtype=float)
    cloud = bathyal.PointCloud(array, attributes={"number": number})
    result = bathyal.clean_cloud(cloud, **options)
    report = result.report.as_dict()
    dropped = sum(
        report[name]
        for name in (
            "not_finite", "duplicates", "same_place_dropped", "spikes", "outliers", "thinned"
        )
    )  # fmt: skip
    assert report["before"] - dropped == report["after"] == len(result.cloud)
    np.testing.assert_array_equal(result.cloud.points, array[result.rows])
    np.testing.assert_array_equal(result.cloud.attributes["number"], result.rows)
    assert len(rows_as_set(result.cloud)) == len(result.cloud)
    if not any(options[name] for name in ("spike_sigma", "outlier_sigma", "voxel")):
        finite_rows = {tuple(p) for p in array.tolist() if np.isfinite(p).all()}
        if options["same_place"] == "keep":
            assert rows_as_set(result.cloud) == finite_rows
        else:
            assert len(result.cloud) == len({p[:2] for p in finite_rows})
    turned = bathyal.clean_cloud(bathyal.PointCloud(array[order]), **options)
    assert rows_as_set(turned.cloud) == rows_as_set(result.cloud)
    assert turned.report.as_dict() == report


def test_cleaning_finds_the_fish():
    truth = {"seed": 4, "length": 20.0, "beams": 128}
    plain = bathyal.generate_survey(**truth).points
    cloud = bathyal.generate_survey(**truth, spike_fraction=0.002)
    fish = np.flatnonzero(cloud.points[:, 2] > plain[:, 2] + 0.3)
    result = bathyal.clean_cloud(cloud, spike_sigma=6.0)
    gone = np.setdiff1d(np.arange(len(cloud)), result.rows)
    assert len(np.intersect1d(gone, fish)) >= 0.9 * len(fish)
    assert len(np.setdiff1d(gone, fish)) <= 0.001 * len(cloud)
    assert "spikes" in str(result.report)


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"same_place": "first"}, "same_place"),
        ({"spike_sigma": -1.0}, "spike_sigma"),
        ({"spike_sigma": math.nan}, "spike_sigma"),
        ({"spike_neighbours": 2}, "spike_neighbours"),
        ({"spike_height": -0.1}, "spike_height"),
        ({"outlier_sigma": math.inf}, "outlier_sigma"),
        ({"outlier_neighbours": 0}, "outlier_neighbours"),
        ({"voxel": -1.0}, "voxel"),
        ({"voxel": 1e-300}, "voxel"),
        ({"num_threads": -1}, "num_threads"),
    ],
)
def test_cleaning_refuses_options_out_of_range(options, name):
    with pytest.raises(ValueError, match=f"`{name}`: expected"):
        bathyal.clean_cloud(bathyal.PointCloud([[1, 2, 3]]), **options)
