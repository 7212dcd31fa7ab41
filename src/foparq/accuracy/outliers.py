# SPDX-License-Identifier: MIT
"""Which of some differences do not belong to the others."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from foparq.accuracy.moments import moments
from foparq.columns import Index

_FEWEST = 3  #: two numbers deviate equally from their mean
_SHARE = 4  #: at most one outlier in so many differences


class ESDStep(NamedTuple):
    """One step of the test: the value farthest from the mean of those that are left."""

    row: int
    deviation: float  #: ``|value - mean| / sd`` of those that are left
    critical: float  #: it is an outlier if a deviation of this step or a later one exceeds its own


def most_outliers(n: int) -> int:
    """How many outliers are looked for among n differences: one, or a quarter of them if that is more."""
    return max(1, n // _SHARE)


def extreme_deviations(differences: ArrayLike, *, significance: float, most: int) -> tuple[ESDStep, ...]:
    """Steps of the generalised extreme Studentized deviate test.

    Parameters
    ----------
    differences : (n,) float
        Finite.
    significance : float
        0.05: the probability of calling a value of a normal sample an outlier.
    most : int
        Greatest number of outliers that is looked for.

    Returns
    -------
    tuple of ESDStep
        ``most`` at the most. Fewer where less than three differences are left, or those that are left are one number.

    Notes
    -----
    Rosner 1983, Percentage points for a generalized ESD many-outlier procedure, Technometrics 25, 165-172. With
    ``most = 1`` it is the two-sided test of Grubbs 1950. The critical values are exact for the first step and good
    approximations for the others from 15 differences on. Assumes that the others are normal.
    """
    from scipy.special import stdtrit  # noqa: PLC0415 - slow to load; a check of loose files needs none

    values = np.asarray(differences, dtype=np.float64).ravel()
    left = np.arange(len(values))
    steps: list[ESDStep] = []
    while len(left) >= _FEWEST and len(steps) < most:
        found, n = moments(values[left]), len(left)
        if not found.sd > 0.0:
            break
        deviation = np.abs(values[left] - found.mean) / found.sd
        worst = int(np.argmax(deviation))
        t = float(stdtrit(n - 2, 1.0 - significance / (2.0 * n)))
        critical = (n - 1) * t / np.sqrt((n - 2 + t * t) * n)
        steps.append(ESDStep(int(left[worst]), float(deviation[worst]), float(critical)))
        left = np.delete(left, worst)
    return tuple(steps)


def outliers(differences: ArrayLike, *, significance: float) -> Index:
    """Rows of the differences that are outliers by the generalised ESD test, in order.

    Parameters
    ----------
    differences : (n,) float
        Finite.
    significance : float

    Returns
    -------
    (k,) int
        At most :func:`most_outliers` of them; the last step whose deviation exceeds its critical value says how many.

    Examples
    --------
    >>> outliers([1.0, -2.0, 0.5, 71.0, 2.0, -1.0, 0.0, 1.5], significance=0.05)
    array([3])
    """
    values = np.asarray(differences, dtype=np.float64).ravel()
    steps = extreme_deviations(values, significance=significance, most=most_outliers(len(values)))
    beyond = [n for n, step in enumerate(steps, start=1) if step.deviation > step.critical]
    rows: Index = np.sort(np.array([step.row for step in steps[: beyond[-1] if beyond else 0]], dtype=np.intp))
    return rows
