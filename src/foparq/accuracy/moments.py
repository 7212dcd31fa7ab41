# SPDX-License-Identifier: MIT
"""Mean, standard deviation and root mean square of differences."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, slots=True)
class Moments:
    """Statistics of n differences, in their unit."""

    n: int
    mean: float  #: the bias; NaN if n = 0
    sd: float  #: sample standard deviation, divisor n - 1; NaN if n < 2
    rmse: float  #: root mean square, divisor n; NaN if n = 0


def moments(differences: ArrayLike) -> Moments:
    """Mean, sample standard deviation and RMSE in two passes.

    ``mean = sum(d) / n``, ``sd = sqrt(sum((d - mean)^2) / (n - 1))``, ``rmse = sqrt(sum(d^2) / n)``; hence
    ``rmse^2 = mean^2 + (n - 1) / n * sd^2``. Sums are exact before the last rounding, so the order of the differences
    never matters, nor does a large common offset. Does not look for outliers.

    Parameters
    ----------
    differences : (n,) float
        Delivered minus reference; finite.

    Notes
    -----
    RMSE is ISO 19157 measure 39. Summation after Shewchuk 1997 (``math.fsum``).

    Examples
    --------
    >>> moments([1.0, 7.0]).rmse
    5.0
    """
    values = np.asarray(differences, dtype=np.float64).ravel()
    n = len(values)
    if n == 0:
        return Moments(0, math.nan, math.nan, math.nan)
    largest = float(np.abs(values).max())
    if largest == 0.0:
        return Moments(n, 0.0, 0.0 if n > 1 else math.nan, 0.0)
    # Squares of very large or very small numbers would overflow or vanish; a power of two costs no digits.
    scale = math.ldexp(1.0, math.frexp(largest)[1] - 1)
    unit = values / scale
    mean = math.fsum(unit) / n
    sd = math.sqrt(math.fsum((unit - mean) ** 2) / (n - 1)) if n > 1 else math.nan
    rmse = math.sqrt(math.fsum(unit**2) / n)
    return Moments(n, mean * scale, sd * scale, rmse * scale)
