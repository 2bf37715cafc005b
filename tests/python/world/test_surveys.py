# SPDX-License-Identifier: BSD-3-Clause
"""Generated surveys."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import bathyal
from bathyal import _core


def test_survey_and_height_take_the_same_options():
    survey = inspect.getdoc(bathyal.generate_survey).split("->")[0]
    height = inspect.getdoc(bathyal.survey_height).split("->")[0]
    assert survey.split("*, ")[1] == height.split("*, ")[1]


def test_survey_is_the_same_for_any_number_of_threads_and_unlike_another_seed():
    options = {"length": 10.0, "beams": 64}
    one = bathyal.generate_survey(seed=9, num_threads=1, **options)
    eight = bathyal.generate_survey(seed=9, num_threads=8, **options)
    assert one.points.tobytes() == eight.points.tobytes()
    for name, values in one.attributes.items():
        assert values.tobytes() == eight.attributes[name].tobytes()
    other = bathyal.generate_survey(seed=10, **options)
    assert not np.array_equal(one.points[:, 2], other.points[:, 2])


def test_survey_noise_is_what_its_uncertainty_says():
    options = {"seed": 2, "length": 20.0, "beams": 128, "boulders": 0, "trench_depth": 0.0}
    cloud = bathyal.generate_survey(**options)
    truth = bathyal.survey_height(cloud.points[:, 0], cloud.points[:, 1], **options)
    off = (cloud.points[:, 2] - truth) / cloud.attributes["uncertainty"]
    assert abs(off.mean()) < 0.05
    assert 0.9 < off.std() < 1.1


def test_survey_goes_through_a_file_unchanged(tmp_path):
    cloud = bathyal.generate_survey(seed=1, length=10.0)
    names = sorted(cloud.attributes)
    _core.write_xyz(tmp_path / "s.csv", cloud, separator=",", header=True, attributes=names)
    table = _core.read_text_table(tmp_path / "s.csv", leading=3)
    assert table.names == ["x", "y", "z", *names]
    np.testing.assert_array_equal(table.table, cloud.points)
    for column, name in zip(table.extra, names, strict=True):
        np.testing.assert_array_equal(column, cloud.attributes[name])


def test_survey_refuses_options_out_of_range():
    for name in ("length", "width", "altitude", "opening", "ping_spacing", "wave_length"):
        with pytest.raises(ValueError, match=f"`{name}`"):
            bathyal.generate_survey(**{name: 0.0})
    with pytest.raises(ValueError, match="`origin`"):
        bathyal.generate_survey(origin=(0, 0))
    with pytest.raises(ValueError, match="`y`: expected 2 values"):
        bathyal.survey_height([0.0, 1.0], [0.0])
