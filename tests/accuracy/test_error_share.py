# SPDX-License-Identifier: MIT
"""Which share of the difference at a point shows in its distances: against what geometry and arithmetic say."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foparq.accuracy.error_share import error_share, point_effects

NONE = np.full(3, 1e-9)


def test_the_effect_is_the_projection_to_first_order_and_exact_beyond() -> None:
    effects, directions = point_effects([3.0, 4.0, 0.0], [0.03, 0.0, 0.0], [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]])
    assert directions == pytest.approx(np.array([[0.6, 0.8, 0.0], [0.0, 1.0, 0.0]]))
    assert effects[0] == pytest.approx(5.0 - math.hypot(2.97, 4.0), abs=1e-15)
    assert effects[0] == pytest.approx(0.018, abs=1e-4)
    assert effects[1] == pytest.approx(4.0 - math.hypot(0.03, 4.0), abs=1e-15)


@settings(deadline=None)
@given(st.floats(-2, 2), st.lists(st.floats(0.01, 0.1), min_size=1, max_size=6))
def test_a_share_that_is_there_is_found(share: float, effects: list[float]) -> None:
    directions = np.tile([1.0, 0.0, 0.0], (len(effects), 1))
    found = error_share(effects, share * np.array(effects), directions, point_sd=[0.002] * 3, sd=0.003)
    assert found.share == pytest.approx(share, abs=1e-9)
    assert found.p == pytest.approx(1.0)


def test_one_distance_has_the_error_of_tape_and_both_ends() -> None:
    """3 mm of tape, and 4 mm at either end along the distance, over an effect of 50 mm."""
    found = error_share([0.05], [0.0], [[0.0, 0.0, 1.0]], point_sd=[9.0, 9.0, 0.004], sd=0.003)
    assert found.sd == pytest.approx(math.sqrt(0.003**2 + 2 * 0.004**2) / 0.05)
    assert (found.share, found.p) == (0.0, 1.0)


def test_more_distances_in_one_direction_do_not_wear_out_the_error_of_the_common_end() -> None:
    directions = np.tile([1.0, 0.0, 0.0], (400, 1))
    found = error_share(np.full(400, 0.05), np.zeros(400), directions, point_sd=[0.004] * 3, sd=0.003)
    assert found.sd == pytest.approx(math.sqrt(0.004**2 + (0.003**2 + 0.004**2) / 400) / 0.05)


def test_scatter_beyond_tape_and_points_is_improbable() -> None:
    """Two distances that say opposite things: chi-square of one degree of freedom of (30 / (3 sqrt 2))^2 = 50."""
    found = error_share([0.05, 0.05], [0.03, 0.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], point_sd=NONE, sd=0.003)
    assert found.share == pytest.approx(0.3)
    assert found.p == pytest.approx(math.erfc(math.sqrt(25.0)), rel=1e-3)


def test_without_effect_nothing_is_known() -> None:
    found = error_share([0.0, 0.0], [0.001, 0.0], np.zeros((2, 3)), point_sd=NONE, sd=0.003)
    assert math.isnan(found.share)
    assert math.isinf(found.sd)
