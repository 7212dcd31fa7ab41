# SPDX-License-Identifier: MIT
"""Bounds of the RMSE against simulation and printed tables."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from foparq.accuracy.bounds import rmse_less_reference, rmse_upper, rmse_with_reference, rounding_bound
from foparq.accuracy.moments import moments

SMALL = st.floats(-1.0, 1.0, allow_subnormal=False)


@given(arrays(float, 12, elements=SMALL), arrays(float, 12, elements=SMALL), st.floats(1e-6, 1.0))
def test_rounding_never_moves_the_rmse_further_than_the_bound(
    differences: np.ndarray, noise: np.ndarray, resolution: float
) -> None:
    moved = abs(moments(differences + noise * resolution).rmse - moments(differences).rmse)
    # Numbers near one are themselves rounded, by 1e-16.
    assert moved <= rounding_bound(resolution) * (1 + 1e-12) + 1e-15


def test_the_rounding_bound_is_reached() -> None:
    differences = np.full(9, 0.010)
    assert moments(differences + 0.0005).rmse - moments(differences).rmse == pytest.approx(rounding_bound(0.0005))


def test_one_coarse_row_among_fine_ones_counts_by_its_share() -> None:
    assert rounding_bound([0.001, 0.0, 0.0, 0.0]) == pytest.approx(0.0005)


@pytest.mark.parametrize(
    ("rmse", "n", "upper"), [(13.5, 7, 24.3), (4.2, 7, 7.5), (1.1, 7, 2.0), (1.0, 1, 15.947), (1.0, 30, 1.27348)]
)
def test_upper_bound_of_printed_chi_square_quantiles(rmse: float, n: int, upper: float) -> None:
    """Chi-square quantiles at 5 %: 0.003932 (1), 2.16735 (7), 18.4927 (30)."""
    assert rmse_upper(rmse, n, confidence=0.95) == pytest.approx(upper, abs=0.05)


def test_upper_bound_holds_in_nineteen_of_twenty_samples() -> None:
    samples = np.random.default_rng(5).normal(0.0, 1.0, size=(4000, 7))
    held = sum(rmse_upper(moments(sample).rmse, 7, confidence=0.95) >= 1.0 for sample in samples)
    assert 3745 <= held <= 3855  # binomial (4000, 0.95): four standard deviations are 55


@pytest.mark.parametrize(("rmse", "total"), [(13.5, 13.83), (4.2, 5.16), (1.1, 3.20)])
def test_with_a_survey_of_3_mm(rmse: float, total: float) -> None:
    assert rmse_with_reference(rmse, 3.0) == pytest.approx(total, abs=0.005)
    assert rmse_less_reference(rmse_with_reference(rmse, 3.0), 3.0) == pytest.approx(rmse)


def test_a_survey_poorer_than_the_rmse_explains_all_of_it() -> None:
    assert rmse_less_reference(0.009, 0.010) == 0.0
    assert rmse_less_reference(0.010, 0.010) == 0.0
