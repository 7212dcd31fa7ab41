# SPDX-License-Identifier: MIT
"""Differences that are too small, against the chi-square distribution and a simulated survey."""

import numpy as np
import pytest
from scipy.stats import chi2

from foparq.accuracy.too_good import too_good


def test_it_is_the_lower_tail_of_chi_square() -> None:
    d = np.array([1.0, -2.0, 0.5, 3.0])
    assert too_good(d, 2.0, 0.0) == pytest.approx(chi2.cdf(np.sum(d**2) / 4, 4), rel=1e-12)


def test_the_variance_of_two_roundings_is_added() -> None:
    """Each to the half digit h is even over 2 h, of variance h^2 / 3; 20 mm of digits beside a survey of 3 mm."""
    hidden = 2 * 0.005**2 / 3
    expected = chi2.cdf(5 * hidden / 0.003**2, 5)
    assert too_good(np.zeros(5), 0.003, 0.010) == pytest.approx(expected, rel=1e-12)
    assert np.var(np.random.default_rng(1).uniform(-0.005, 0.005, (2, 10**6)).sum(axis=0)) == pytest.approx(
        hidden, rel=0.01
    )


def test_probabilities_of_a_faultless_product_are_even() -> None:
    """A product without error of its own, measured against a survey of 3: every probability is as likely as any."""
    rng = np.random.default_rng(7)
    p = np.sort([too_good(rng.normal(0, 3, 9), 3.0, 0.0) for _ in range(4000)])
    even = (np.arange(4000) + 0.5) / 4000
    assert np.abs(p - even).max() < 1.63 / np.sqrt(4000)  # Kolmogorov-Smirnov at 99 %


def test_rounding_makes_no_copy_of_a_coarse_table() -> None:
    """Both written to the centimetre: a true 3 mm is nought more often than not."""
    rng = np.random.default_rng(3)
    for _ in range(50):
        surveyed = rng.uniform(0, 20, 8)
        d = np.round(surveyed + rng.normal(0, 0.003, 8), 2) - np.round(surveyed, 2)
        assert too_good(d, 0.003, 0.01) > 0.01


def test_the_published_height_of_seven_points_is_possible_and_a_copy_is_not() -> None:
    """Campos et al. 2015: RMSE 1.1 mm in Y beside a survey of 3 mm."""
    assert 1e-3 < too_good(np.full(7, 0.0011), 0.003, 0.0) < 1e-2
    assert too_good(np.zeros(7), 0.003, 0.001) < 1e-5  # the same digits, to the millimetre


@pytest.mark.parametrize(("sd", "p"), [(1e200, 0.0), (1e-200, 1.0), (5e-324, 1.0), (1.7e308, 0.0)])
def test_a_standard_deviation_may_be_anything_positive(sd: float, p: float) -> None:
    assert too_good([0.001, -0.002, 0.0], sd, 0.001) == p
