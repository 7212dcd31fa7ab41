# SPDX-License-Identifier: MIT
"""Mean, standard deviation and RMSE against analytic values and certified ones."""

import csv
import math
import statistics
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.accuracy.samples import with_moments

from foparq.accuracy.moments import moments

REALS = st.floats(min_value=-1e6, max_value=1e6, allow_nan=False).filter(lambda x: x == 0 or abs(x) > 1e-9)


def test_of_an_arithmetic_series() -> None:
    n = 1001
    found = moments(np.arange(1, n + 1))
    assert found.mean == (n + 1) / 2
    assert found.sd == pytest.approx(math.sqrt(n * (n + 1) / 12), rel=1e-15)
    assert found.rmse == pytest.approx(math.sqrt((n + 1) * (2 * n + 1) / 6), rel=1e-15)


def test_of_nothing_of_one_and_of_zeros() -> None:
    assert moments([]).n == 0
    assert math.isnan(moments([]).rmse)
    one = moments([-0.004])
    assert (one.n, one.mean, one.rmse) == (1, -0.004, 0.004)
    assert math.isnan(one.sd)
    assert (moments([0.0, 0.0]).sd, moments([0.0, 0.0]).rmse) == (0.0, 0.0)


@given(st.lists(REALS, min_size=2, max_size=40))
def test_agrees_with_exact_rational_arithmetic(values: list[float]) -> None:
    found = moments(values)
    size = max(map(abs, values)) or 1.0
    assert found.mean == pytest.approx(statistics.fmean(values), rel=1e-12, abs=1e-15 * size)
    assert found.sd == pytest.approx(statistics.stdev(values), rel=1e-12, abs=1e-15 * size)


@given(st.lists(REALS, min_size=2, max_size=40), st.randoms(use_true_random=False))
def test_order_never_matters_to_the_last_bit(values: list[float], rng: object) -> None:
    shuffled = values.copy()
    rng.shuffle(shuffled)  # type: ignore[attr-defined]
    assert moments(values) == moments(shuffled)


@given(st.lists(REALS, min_size=2, max_size=40))
def test_rmse_is_composed_of_mean_and_sd(values: list[float]) -> None:
    found = moments(values)
    assert found.rmse**2 == pytest.approx(found.mean**2 + (found.n - 1) / found.n * found.sd**2, rel=1e-12)


@pytest.mark.parametrize("size", [1e-300, 1e300, 1.7e308])
def test_very_large_and_very_small_differences_do_not_overflow(size: float) -> None:
    found = moments([size, -size, size, -size])
    assert found.rmse == pytest.approx(size)
    assert found.mean == 0.0


@pytest.mark.shared
@pytest.mark.parametrize(("file", "mean"), [("nist_numacc3.csv", 1000000.2), ("nist_numacc4.csv", 10000000.2)])
def test_nist_certified_values_with_large_offsets(shared: Path, file: str, mean: float) -> None:
    with (shared / "data/accuracy" / file).open(newline="") as table:
        values = [float(row["value"]) for row in csv.DictReader(table)]
    found = moments(values)
    assert found.n == 1001
    assert found.mean == pytest.approx(mean, rel=1e-15)
    assert found.sd == pytest.approx(0.1, rel=1e-8)


@pytest.mark.shared
def test_abdullah_2014(shared: Path) -> None:
    with (shared / "data/accuracy/abdullah2014_checkpoints.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    known = {
        "residual_e_m": (-0.058857, 0.0747160, 0.0908248),
        "residual_n_m": (0.043857, 0.0734108, 0.0808871),
        "residual_h_m": (0.017714, 0.0303079, 0.0331835),
    }
    for column, (mean, sd, rmse) in known.items():
        found = moments([float(row[column]) for row in rows])
        assert found.mean == pytest.approx(mean, abs=5e-7)
        assert found.sd == pytest.approx(sd, abs=5e-8)
        assert found.rmse == pytest.approx(rmse, abs=1e-7)


@pytest.mark.shared
def test_the_paper_prints_the_sample_standard_deviation(shared: Path) -> None:
    """Mean, sd and RMSE of all eight rows fit each other within the printed digits, with the divisor n - 1."""
    with (shared / "data/accuracy/campos2015_tables.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    assert len(rows) == 8
    for row in rows:
        half_mean, half_sd, half_rmse = (_half_digit(row[key]) for key in ("mean", "sd_sample", "rmse_printed"))
        n, mean, sd, printed = int(row["n"]), float(row["mean"]), float(row["sd_sample"]), float(row["rmse_printed"])
        nearest = max(0.0, abs(mean) - half_mean)
        low = moments(with_moments(n, nearest, sd - half_sd)).rmse
        high = moments(with_moments(n, abs(mean) + half_mean, sd + half_sd)).rmse
        assert low - half_rmse <= printed <= high + half_rmse
        assert moments(with_moments(n, mean, sd)).rmse == pytest.approx(printed, abs=1.5 * half_rmse + half_sd)


def _half_digit(text: str) -> float:
    return 0.5 * 10.0 ** -len(text.partition(".")[2])
