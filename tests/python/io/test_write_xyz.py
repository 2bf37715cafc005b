# SPDX-License-Identifier: BSD-3-Clause
"""The text writer of the engine."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from bathyal import _core

finite = st.floats(allow_nan=False, allow_infinity=False)


@settings(max_examples=100, deadline=None)
@given(
    points=st.lists(st.tuples(finite, finite, finite), min_size=1, max_size=10),
    decimals=st.integers(0, 17),
    separator=st.sampled_from([" ", ",", ";", "\t"]),
)
def test_xyz_is_written_as_python_formats(tmp_path_factory, points, decimals, separator):
    path = tmp_path_factory.mktemp("xyz") / "f.xyz"
    _core.write_xyz(path, bathyal.PointCloud(points), decimals=decimals, separator=separator)
    expected = "".join(separator.join(f"{v:.{decimals}f}" for v in p) + "\n" for p in points)
    assert path.read_text() == expected
    _core.write_xyz(path, bathyal.PointCloud(points), separator=separator)
    table = _core.read_text_table(path, separator=separator, decimal=".").table
    np.testing.assert_array_equal(table.view(np.uint64), np.array(points).view(np.uint64))


def test_xyz_refuses_what_it_cannot_write(tmp_path):
    cloud = bathyal.PointCloud([[1, 2, 3]])
    with pytest.raises(bathyal.Error, match="No such file or directory"):
        _core.write_xyz(tmp_path / "none" / "f.xyz", cloud)
    with pytest.raises(bathyal.Error, match="No space left on device"):
        _core.write_xyz("/dev/full", cloud)
    with pytest.raises(ValueError, match="`attributes`"):
        _core.write_xyz(tmp_path / "f.xyz", cloud, attributes=["depth"])
    assert not (tmp_path / "f.xyz").exists()
    with pytest.raises(ValueError, match="`decimals`"):
        _core.write_xyz(tmp_path / "f.xyz", cloud, decimals=18)
