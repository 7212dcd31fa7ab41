# SPDX-License-Identifier: MIT
"""The fitted tail of Anderson and Darling's statistic, branch by branch, and noise of differences."""

import math

import numpy as np
import pytest

from foparq.accuracy.bounds import rmse_less_reference, rmse_upper, rounding_bound
from foparq.accuracy.differences import differences
from foparq.accuracy.moments import moments
from foparq.accuracy.normality import anderson_darling, normal_tail
from foparq.accuracy.student import sign_test, student_test

#: D'Agostino and Stephens 1986, table 4.9: from where on, whether p or 1 - p, coefficients of exp(a + b A + c A^2)
BRANCHES = [
    (0.0, False, (-13.436, 101.14, -223.73)), (0.2, False, (-8.318, 42.796, -59.938)),
    (0.34, True, (0.9177, -4.279, -1.38)), (0.6, True, (1.2937, -5.709, 0.0186)),
]  # fmt: skip


@pytest.mark.parametrize("statistic", [0.05, 0.15, 0.1999, 0.2, 0.25, 0.3399, 0.34, 0.5, 0.5999, 0.6, 1.5, 9.0])
def test_each_branch_is_that_of_the_source(statistic: float) -> None:
    _, direct, (a, b, c) = [branch for branch in BRANCHES if branch[0] <= statistic][-1]
    fitted = math.exp(a + b * statistic + c * statistic**2)
    assert normal_tail(statistic) == pytest.approx(fitted if direct else 1 - fitted, rel=1e-12)


def test_beyond_ten_the_tail_stays_where_it_is() -> None:
    assert normal_tail(11.0) == normal_tail(10.0) < 4e-24


def test_three_differences_that_vary_are_enough() -> None:
    assert 0 <= anderson_darling([0.0, 1.0, 2.0]).p <= 1


def test_a_coarse_number_decides_what_a_subtraction_can_resolve() -> None:
    found = differences([7_400_000.351, 7.1 + 1e-13], [7_400_000.101, 7.0])
    assert found[0] == 0.25
    assert found[1] == pytest.approx(0.1, abs=1e-8)
    assert round(found[1] * 1e8) / 1e8 == 0.1


def test_what_has_no_noise_to_speak_of_stays_as_it_is() -> None:
    assert differences([3e17], [1e17]).tolist() == [2e17]
    assert differences([3e-17], [1e-17]).tolist() == [3e-17 - 1e-17]


def test_a_survey_as_poor_as_the_rmse_leaves_nothing() -> None:
    assert rmse_less_reference(1.0, 1.0) == rmse_less_reference(1.0, 2.0) == rmse_less_reference(0.0, 0.0) == 0.0
    assert rmse_less_reference(1.25, 0.75) == 1.0
    assert rmse_less_reference(1.25, 0.0) == 1.25


def test_rounding_counts_whatever_its_sign() -> None:
    assert rounding_bound([-0.5, 0.5]) == rounding_bound(0.5) == 0.5


@pytest.mark.parametrize(("n", "chi2"), [(1, 0.00393214), (4, 0.710723), (10, 3.94030), (50, 34.7643)])
def test_upper_bound_by_printed_quantiles(n: int, chi2: float) -> None:
    """Lower 5 % points of chi-square, Pearson and Hartley, Biometrika Tables for Statisticians, table 8."""
    assert rmse_upper(2.0, n, confidence=0.95) == pytest.approx(2.0 * math.sqrt(n / chi2), rel=1e-5)


def test_one_number_has_no_deviation_two_have() -> None:
    assert math.isnan(moments([3.0]).sd)
    assert moments([1.0, 3.0]).sd == math.sqrt(2.0)
    assert math.isnan(moments([0.0]).sd)
    assert moments([0.0, 0.0]).sd == 0.0


@pytest.mark.parametrize(("values", "t"), [([1.0, 3.0], 2.0), ([-1.0, -3.0], -2.0), ([0.0, 0.0], 0.0)])
def test_t_of_two(values: list[float], t: float) -> None:
    found = student_test(values, confidence=0.95)
    assert (found.t, found.freedom) == (t, 1)
    # One degree of freedom is Cauchy's distribution.
    assert found.p == pytest.approx(1 - 2 / math.pi * math.atan(abs(t)), rel=1e-12)
    assert found.critical == pytest.approx(math.tan(math.pi * 0.475), rel=1e-9)


def test_signs_of_one_side_only() -> None:
    assert sign_test([-1.0] * 6) == sign_test([1.0] * 6) == 2 / 2**6
    assert sign_test(np.array([1.0] * 5 + [-1.0])) == pytest.approx(2 * 7 / 2**6)
