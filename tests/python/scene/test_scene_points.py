# SPDX-License-Identifier: BSD-3-Clause
"""What all questions about points share: threads, layouts, refusals."""

import numpy as np
import pytest

import bathyal
from tests.support.scene_meshes import box, seabed


def test_one_thread_equals_eight():
    points = np.random.default_rng(17).uniform((-9, -9, -9), (69, 49, 12), (3000, 3))
    one, eight = (bathyal.Scene(seabed(), num_threads=n) for n in (1, 8))
    a, b = one.nearest(points, num_threads=1), eight.nearest(points, num_threads=8)
    for name in ("distance", "point", "mesh", "triangle", "barycentric"):
        assert getattr(a, name).tobytes() == getattr(b, name).tobytes()
    numbers = one.winding_number(points, num_threads=1), eight.winding_number(points, num_threads=8)
    assert numbers[0].tobytes() == numbers[1].tobytes()
    assert (one.contains(points, num_threads=1) == eight.contains(points, num_threads=8)).all()


@pytest.mark.parametrize("query", ["nearest", "winding_number", "contains"])
def test_points_of_every_layout_are_taken_and_others_refused(query):
    scene = bathyal.Scene(box())
    ask = getattr(scene, query)
    points = np.random.default_rng(18).uniform(-3, 3, (20, 3)).astype(np.float32)
    read_only = points.astype(float)
    read_only.flags.writeable = False
    column = {"nearest": lambda n: n.distance}.get(query, lambda n: n)
    expected = column(ask(read_only))
    for same in (points, np.asfortranarray(read_only), np.repeat(read_only, 2, axis=0)[::2]):
        np.testing.assert_array_equal(column(ask(same)), expected)
    assert len(column(ask(np.zeros((0, 3))))) == 0
    for bad in ([[0, 0]], [0, 0, 0], [["a", "b", "c"]], [[0, np.nan, 0]], [[0, np.inf, 0]], None):
        with pytest.raises(ValueError, match="points"):
            ask(bad)
