# SPDX-License-Identifier: MIT
"""Differences without the noise of binary numbers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foparq.accuracy.differences import differences


@given(st.lists(st.integers(0, 99_999_999), min_size=2, max_size=20), st.integers(-9999, 9999))
def test_one_shift_of_decimal_coordinates_is_one_number(millimetres: list[int], shift: int) -> None:
    surveyed = np.array([value / 1000 for value in millimetres])
    delivered = np.array([(value + shift) / 1000 for value in millimetres])
    assert set(differences(delivered, surveyed)) == {shift / 1000}


@given(st.lists(st.floats(-1e7, 1e7), min_size=1, max_size=20), st.floats(-1, 1))
def test_nothing_that_matters_is_rounded(surveyed: list[float], shift: float) -> None:
    reference = np.array(surveyed)
    assert np.abs(differences(reference + shift, reference) - (reference + shift - reference)).max() < 1e-7


def test_what_is_no_number_is_nan_and_says_nothing() -> None:
    left = [math.inf, math.nan, 1.0, 1.7e308, -math.inf]
    right = [math.inf, 1.0, math.nan, -1.7e308, 0.0]
    assert np.isnan(differences(left, right)).all()
    assert differences([], []).shape == (0,)


@pytest.mark.parametrize("size", [1e-300, 1e-9, 1.0, 1e15, 1e300])
def test_any_size(size: float) -> None:
    assert differences([2 * size, size], [size, size]) == pytest.approx([size, 0.0])


def test_shape_is_kept() -> None:
    assert differences(np.full((4, 3), 0.3), np.full((4, 3), 0.1)).tolist() == [[0.2] * 3] * 4
