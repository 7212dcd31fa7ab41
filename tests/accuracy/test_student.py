# SPDX-License-Identifier: MIT
"""Student t and sign test against tables, the shelf and scipy."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
import scipy.stats
from hypothesis import given
from hypothesis import strategies as st
from tests.accuracy.samples import with_moments

from foparq.accuracy.student import sign_test, student_test


@pytest.mark.parametrize(("n", "critical"), [(2, 12.706), (3, 4.303), (7, 2.447), (29, 2.048), (121, 1.980)])
def test_critical_values_of_the_printed_table(n: int, critical: float) -> None:
    assert student_test(with_moments(n, 0.0, 1.0), confidence=0.95).critical == pytest.approx(critical, abs=5e-4)


@pytest.mark.parametrize(
    ("n", "mean", "sd", "t"),
    [
        (7, -0.3, 1.2, -0.66), (7, -0.14, 1.2, -0.31), (7, 1.1, 3.0, 0.97),
        (7, 2.1, 3.9, 1.42), (7, 0.4, 1.1, 0.96), (7, 6.4, 12.9, 1.31),
        (29, 0.1, 10.0, 0.05), (6, 1.3, 20.0, 0.16),
    ],
)  # fmt: skip
def test_the_papers_tables_show_no_trend(n: int, mean: float, sd: float, t: float) -> None:
    found = student_test(with_moments(n, mean, sd), confidence=0.95)
    assert found.t == pytest.approx(t, abs=5e-3)
    assert abs(found.t) < found.critical
    assert found.freedom == n - 1


@given(st.lists(st.integers(-999, 999), min_size=3, max_size=30).filter(lambda v: len(set(v)) > 1))
def test_agrees_with_scipy(values: list[int]) -> None:
    found = student_test(np.array(values, dtype=float), confidence=0.95)
    theirs = scipy.stats.ttest_1samp(values, 0.0)
    assert found.t == pytest.approx(theirs.statistic, rel=1e-9, abs=1e-9)
    assert found.p == pytest.approx(theirs.pvalue, rel=1e-8, abs=1e-12)


def test_differences_that_are_all_one_number() -> None:
    assert student_test([0.002] * 5, confidence=0.95).t == math.inf
    assert student_test([-0.002] * 5, confidence=0.95).t == -math.inf
    assert student_test([0.002] * 5, confidence=0.95).p == 0.0
    assert student_test([0.0] * 5, confidence=0.95).t == 0.0


def test_one_difference_has_no_t() -> None:
    with pytest.raises(ValueError, match="two differences"):
        student_test([1.0], confidence=0.95)


@pytest.mark.parametrize(
    ("values", "p"),
    [([1, 2, 3, 4, 5], 0.0625), ([1, 2, 3, -4], 0.625), ([0, 0, 0], 1.0), ([], 1.0), ([1, -1], 1.0), ([0, 3], 1.0)],
)
def test_sign_test_by_hand(values: list[float], p: float) -> None:
    assert sign_test(values) == pytest.approx(p)


def test_sign_test_agrees_with_the_binomial_test() -> None:
    values = np.random.default_rng(1).normal(0.3, 1.0, 60)
    theirs = scipy.stats.binomtest(int((values > 0).sum()), 60, 0.5).pvalue
    assert sign_test(values) == pytest.approx(theirs, rel=1e-10)


@pytest.mark.shared
def test_abdullah_2014(shared: Path) -> None:
    with (shared / "data/accuracy/abdullah2014_checkpoints.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    known = {
        "residual_e_m": (-2.08418, 0.08226), "residual_n_m": (1.58063, 0.16505), "residual_h_m": (1.54638, 0.17297),
    }  # fmt: skip
    for column, (t, p) in known.items():
        found = student_test([float(row[column]) for row in rows], confidence=0.95)
        assert found.t == pytest.approx(t, abs=5e-6)
        assert found.p == pytest.approx(p, abs=5e-6)
        assert found.critical == pytest.approx(2.44691, abs=5e-6)
