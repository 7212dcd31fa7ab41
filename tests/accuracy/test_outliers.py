# SPDX-License-Identifier: MIT
"""The generalised ESD test against Rosner's own example, Grubbs' table and its stated significance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foparq.accuracy.outliers import extreme_deviations, most_outliers, outliers

#: Rosner 1983, as printed in the NIST/SEMATECH e-Handbook of Statistical Methods, section 1.3.5.17.3
ROSNER = [
    -0.25, 0.68, 0.94, 1.15, 1.20, 1.26, 1.26, 1.34, 1.38, 1.43, 1.49, 1.49, 1.55, 1.56, 1.58, 1.65, 1.69, 1.70, 1.76,
    1.77, 1.81, 1.91, 1.94, 1.96, 1.99, 2.06, 2.09, 2.10, 2.14, 2.15, 2.23, 2.24, 2.26, 2.35, 2.37, 2.40, 2.47, 2.54,
    2.62, 2.64, 2.90, 2.92, 2.92, 2.93, 3.21, 3.26, 3.30, 3.59, 3.68, 4.30, 4.64, 5.34, 5.42, 6.01,
]  # fmt: skip


def test_rosners_example() -> None:
    steps = extreme_deviations(ROSNER, significance=0.05, most=10)
    assert [step.deviation for step in steps] == pytest.approx(
        [3.118, 2.942, 3.179, 2.810, 2.815, 2.848, 2.279, 2.310, 2.101, 2.067], abs=1e-3
    )
    assert [step.critical for step in steps] == pytest.approx(
        [3.158, 3.151, 3.143, 3.136, 3.128, 3.120, 3.111, 3.103, 3.094, 3.085], abs=1e-3
    )
    assert [ROSNER[row] for row in outliers(ROSNER, significance=0.05)] == [5.34, 5.42, 6.01]


@pytest.mark.parametrize(("n", "critical"), [(3, 1.155), (7, 2.020), (8, 2.126), (10, 2.290), (20, 2.709)])
def test_first_step_has_grubbs_two_sided_values(n: int, critical: float) -> None:
    """Grubbs and Beck 1972, table 1: 2.5 % on each side."""
    (step,) = extreme_deviations(np.arange(n), significance=0.05, most=1)
    assert step.critical == pytest.approx(critical, abs=1.5e-3)


@pytest.mark.parametrize("n", [7, 8, 12, 30])
def test_normal_samples_have_outliers_as_seldom_as_stated(n: int) -> None:
    samples = np.random.default_rng(20).normal(size=(2000, n))
    share = np.mean([len(outliers(sample, significance=0.05)) > 0 for sample in samples])
    assert share <= 0.05 + 3 * np.sqrt(0.05 * 0.95 / 2000) + 0.015 * (most_outliers(n) > 1)


def test_a_common_shift_is_no_outlier() -> None:
    assert outliers([0.062, 0.061, 0.063, 0.0615, 0.0625, 0.062], significance=0.05).tolist() == []


def test_two_bad_points_do_not_hide_each_other() -> None:
    rest = [0.001, -0.002, 0.0005, 0.002, -0.001, 0.0, 0.0015]
    assert outliers([*rest, 0.07, 0.08], significance=0.05).tolist() == [7, 8]


@pytest.mark.parametrize("few", [[], [1.0], [1.0, 90.0], [5.0, 5.0, 5.0, 5.0]])
def test_nothing_can_be_said_of_few_or_equal_numbers(few: list[float]) -> None:
    assert outliers(few, significance=0.05).tolist() == []


@given(st.lists(st.integers(-50, 50), min_size=5, max_size=12, unique=True), st.integers(-9, 9), st.integers(1, 9))
def test_unit_and_shift_and_order_do_not_matter(values: list[int], shift: int, factor: int) -> None:
    found = outliers(values, significance=0.05)
    assert outliers([factor * v + 64 * shift for v in values], significance=0.05).tolist() == found.tolist()
    turned = outliers(values[::-1], significance=0.05)
    assert {values[::-1][row] for row in turned} == {values[row] for row in found}
