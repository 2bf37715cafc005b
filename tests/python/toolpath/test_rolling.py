# SPDX-License-Identifier: BSD-3-Clause
"""The rolling ball at a standoff, and the plain offset it replaces."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bathyal
from tests.support.bottoms import TOUR, down, grid, hills

LEVEL = bathyal.Plane((0, 0, 1), -5.0)
SLOPE = bathyal.Plane((0.3, 0.2, 1), -5.0)


@pytest.fixture(scope="module")
def scene():
    return bathyal.Scene(grid(hills))


@pytest.mark.parametrize("orientation", ["blended", "piecewise_constant"])
def test_plain_offset_moves_every_sample_along_its_approach(scene, orientation):
    plain = bathyal.plan_toolpath(
        scene, TOUR, orientation=orientation, standoff=0.1, offset="plain"
    )
    bottom = bathyal.plan_toolpath(scene, TOUR, orientation=orientation)
    assert np.array_equal(plain.surface, bottom.surface)
    assert np.array_equal(plain.approach, bottom.approach)
    assert np.array_equal(plain.position, bottom.surface + 0.1 * bottom.approach)


def test_without_standoff_and_on_a_plane_both_offsets_are_the_same(scene):
    for surface, standoff in ((scene, 0.0), (LEVEL, 0.3), (SLOPE, 0.3)):
        rolling = bathyal.plan_toolpath(surface, TOUR, standoff=standoff)
        plain = bathyal.plan_toolpath(surface, TOUR, standoff=standoff, offset="plain")
        assert np.array_equal(rolling.position, plain.position)
        assert np.array_equal(rolling.time, plain.time)


def test_rolling_over_a_rough_reef_never_comes_nearer_nor_crosses():
    rng = np.random.default_rng(17)
    # Facets of 1 cm, 37° along their edges in the root mean square.
    rough = grid(lambda x, y: rng.uniform(-0.0092, 0.0092, x.shape), size=1.5, cells=150)
    reef = bathyal.Scene(rough)
    aims = down([[0.2, 0.3], [1.3, 0.5], [1.1, 1.2]])
    rolling = bathyal.plan_toolpath(reef, aims, standoff=0.1)
    assert rolling.warnings == []
    assert not rolling.crossing.any()
    distance = reef.nearest(rolling.position).distance
    assert distance.min() >= 0.1
    assert distance.max() <= 0.1 + 1e-9
    moved = np.diff(rolling.position, axis=0)
    between = rolling.position[:-1, None] + np.linspace(0, 1, 9)[:, None] * moved[:, None]
    least = np.sqrt(0.1**2 - np.sum(moved**2, axis=1) / 4)
    on_the_way = reef.nearest(between.reshape(-1, 3)).distance.reshape(-1, 9).min(axis=1)
    assert (on_the_way >= least - 1e-12).all()
    turned = np.arccos(np.clip(np.sum(rolling.approach[1:] * rolling.approach[:-1], axis=1), -1, 1))
    assert turned.max() < 0.3
    plain = bathyal.plan_toolpath(reef, aims, standoff=0.1, offset="plain", blend_length=0.02)
    assert plain.crossing.mean() > 0.2
    assert reef.nearest(plain.position).distance.min() < 0.08


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 2**31),
    roughness=st.floats(0, 0.3),
    standoff=st.floats(0.02, 0.8),
    step=st.sampled_from([0.0, 0.03]),
    orientation=st.sampled_from(["blended", "piecewise_constant"]),
)
def test_rolling_keeps_the_standoff_over_any_ground(seed, roughness, standoff, step, orientation):
    rng = np.random.default_rng(seed)
    ground = grid(lambda x, y: roughness * rng.standard_normal(x.shape), cells=20)
    ground = bathyal.Scene(ground)
    aims = down(rng.uniform(0.8, 5.2, (3, 2)))
    path = bathyal.plan_toolpath(
        ground, aims, standoff=standoff, step=step, orientation=orientation
    )
    distance = ground.nearest(path.position).distance
    assert distance.min() >= standoff
    assert distance.max() <= standoff * (1 + 1e-9)
    assert not any("rolled" in warning for warning in path.warnings)
    if step:
        assert np.linalg.norm(np.diff(path.position, axis=0), axis=1).max() <= step * (1 + 1e-9)
