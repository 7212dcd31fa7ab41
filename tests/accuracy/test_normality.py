# SPDX-License-Identifier: MIT
"""Anderson-Darling against scipy's statistic, published p values and simulation."""

import csv
import warnings
from pathlib import Path

import numpy as np
import pytest
import scipy.stats
from hypothesis import given
from hypothesis import strategies as st

from foparq.accuracy.normality import anderson_darling, normal_tail


@given(st.lists(st.integers(-9999, 9999), min_size=3, max_size=80).filter(lambda v: len(set(v)) > 1))
def test_the_statistic_is_scipys(values: list[int]) -> None:
    sample = np.array(values, dtype=float)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # scipy announces changes of its result object
        theirs = scipy.stats.anderson(sample, "norm").statistic
    assert anderson_darling(sample).a2 == pytest.approx(theirs, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("critical", "p"), [(0.470, 0.25), (0.631, 0.10), (0.752, 0.05), (0.873, 0.025), (1.035, 0.01)]
)
def test_p_at_the_critical_values_of_the_source(critical: float, p: float) -> None:
    """D'Agostino and Stephens 1986, table 4.7: the corrected statistic at five levels."""
    assert normal_tail(critical) == pytest.approx(p, rel=0.03)


def test_p_falls_as_the_statistic_grows_and_stays_a_probability() -> None:
    p = np.array([normal_tail(a) for a in np.linspace(0.0, 400.0, 20001)])
    assert ((p >= 0) & (p <= 1)).all()
    # The four branches were fitted one by one: they miss each other by up to 0.003.
    assert (np.diff(p) < 0.004).all()
    assert p[-1] < 1e-20


def test_the_papers_p() -> None:
    """p 0.204 of 29 distances lies on the third branch, at a corrected statistic of 0.504."""
    assert normal_tail(0.504) == pytest.approx(0.204, abs=5e-4)


def test_an_outlier_far_out_keeps_its_digits() -> None:
    sample = np.r_[np.linspace(-1, 1, 500), 1e6]
    found = anderson_darling(sample)
    assert np.isfinite(found.a2)
    assert found.p < 1e-20


def test_offset_and_unit_change_nothing() -> None:
    sample = np.random.default_rng(3).normal(size=29)
    assert anderson_darling(sample * 0.001 + 7).p == pytest.approx(anderson_darling(sample).p, rel=1e-6)


def test_one_in_twenty_normal_samples_is_rejected() -> None:
    rng = np.random.default_rng(7)
    rejected = sum(anderson_darling(rng.normal(size=29)).p <= 0.05 for _ in range(2000))
    assert 70 <= rejected <= 130  # binomial (2000, 0.05): four standard deviations are 39


@pytest.mark.parametrize("values", [[], [1.0], [1.0, 2.0], [2.0, 2.0, 2.0, 2.0]])
def test_nothing_is_said_of_too_few_or_equal_numbers(values: list[float]) -> None:
    with pytest.raises(ValueError, match="three differences that vary"):
        anderson_darling(values)


@pytest.mark.shared
def test_abdullah_2014(shared: Path) -> None:
    with (shared / "data/accuracy/abdullah2014_checkpoints.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    known = {
        "residual_e_m": (0.8173, 0.9424, 0.0171),
        "residual_n_m": (0.4257, 0.4908, 0.2198),
        "residual_h_m": (0.4115, 0.4745, 0.2408),
    }
    for column, (a2, star, p) in known.items():
        found = anderson_darling([float(row[column]) for row in rows])
        assert found.a2 == pytest.approx(a2, abs=5e-5)
        assert found.a2_star == pytest.approx(star, abs=5e-5)
        assert found.p == pytest.approx(p, abs=5e-5)
