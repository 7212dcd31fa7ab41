# SPDX-License-Identifier: MIT
"""How often the upper confidence bound of an RMSE holds, where its assumptions do and where they do not.

    uv run python benchmarks/confidence.py

The bound that stands beside an RMSE assumes normal, independent differences without bias. Each line draws samples from
a population of known RMSE and tells in which share of them the bound at 95 % is not below it; the last one tells how
often Q6 rejects a survey without any trend. Twenty thousand samples a line: 95 % is told to about 0.3 %.
"""

import numpy as np

from foparq.accuracy.bounds import rmse_upper
from foparq.accuracy.student import student_test

SAMPLES = 20_000
CONFIDENCE = 0.95
SIZES = (7, 29)


def covered(samples: np.ndarray, rmse: float) -> float:
    """Share of samples (k, n) whose bound is at least the population's RMSE."""
    factor = rmse_upper(1.0, samples.shape[1], confidence=CONFIDENCE)
    return float(np.mean(np.sqrt(np.mean(samples**2, axis=1)) * factor >= rmse))


def gross(random: np.random.Generator, n: int, share: float, factor: float) -> tuple[np.ndarray, float]:
    """Normal differences, a share of them ``factor`` times as large."""
    drawn = random.normal(size=(SAMPLES, n)) * np.where(random.random((SAMPLES, n)) < share, factor, 1.0)
    return drawn, float(np.sqrt(1.0 - share + share * factor**2))


def shared_ends(random: np.random.Generator, points: int, height: float) -> tuple[np.ndarray, float]:
    """All distances between points spread over a width of 14 m; the errors lie in the points that distances share."""
    places = np.stack([np.linspace(0.0, 14.0, points), height * np.sin(np.arange(points) * 2.4)], axis=1)
    first, second = np.triu_indices(points, k=1)
    along = places[second] - places[first]
    along /= np.linalg.norm(along, axis=1)[:, np.newaxis]
    errors = random.normal(size=(SAMPLES, points, 2))
    return np.einsum("kij,ij->ki", errors[:, second] - errors[:, first], along), float(np.sqrt(2.0))


def main() -> None:
    """Print the table of ``docs/verdict.md``."""
    random = np.random.default_rng(19157)
    for n in SIZES:
        name = f"normal, n = {n}"
        print(f"{name:48} {covered(random.normal(size=(SAMPLES, n)), 1.0):6.1%}")
    for freedom in (4.0, 3.0):
        for n in SIZES:
            drawn = random.standard_t(freedom, (SAMPLES, n))
            name = f"heavy tails, Student t of {freedom:g} degrees, n = {n}"
            print(f"{name:48} {covered(drawn, np.sqrt(freedom / (freedom - 2.0))):6.1%}")
    for share, factor in ((0.05, 10.0), (0.02, 10.0), (0.02, 20.0)):
        for n in SIZES:
            name = f"gross errors, {share:.0%} of {factor:g} times, n = {n}"
            print(f"{name:48} {covered(*gross(random, n, share, factor)):6.1%}")
    for height, where in ((3.5, "over a facade"), (0.0, "along one line")):
        name = f"shared ends, 8 points {where}, n = 28"
        print(f"{name:48} {covered(*shared_ends(random, 8, height)):6.1%}")
    fails = 0
    for sample in random.normal(size=(2000, 3, 7)):
        tests = [student_test(axis, confidence=CONFIDENCE) for axis in sample]
        fails += any(abs(test.t) > test.critical for test in tests)
    print(f"{'Q6 fails on one of three axes, n = 7':48} {fails / 2000:6.1%}")


if __name__ == "__main__":
    main()
