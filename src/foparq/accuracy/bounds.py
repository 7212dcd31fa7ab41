# SPDX-License-Identifier: MIT
"""How far a root mean square error can be trusted: digits, sample size and the survey's own accuracy."""

import math

import numpy as np
from numpy.typing import ArrayLike

from foparq.accuracy.moments import moments


def rounding_bound(resolution: ArrayLike) -> float:
    """How far the RMSE can move because the differences were rounded.

    Each true difference lies within its resolution e of the one that was printed. By the triangle inequality
    ``|RMSE(d + e) - RMSE(d)| <= RMSE(e) <= max|e|``.

    Parameters
    ----------
    resolution : float or (n,) float
        Half the last printed digit of delivered plus that of reference; one for all differences, or one each.

    Returns
    -------
    float
        ``RMSE(e)``, in the same unit.

    Examples
    --------
    >>> rounding_bound(0.0005)
    0.0005
    """
    return moments(np.abs(np.asarray(resolution, dtype=np.float64))).rmse


def rmse_upper(rmse: float, n: int, *, confidence: float) -> float:
    """One-sided upper confidence bound of the RMSE of n normal differences without bias.

    ``rmse * sqrt(n / chi2)`` with chi2 the ``1 - confidence`` quantile of n degrees of freedom.

    Parameters
    ----------
    n : int
        At least 1.
    confidence : float
        0.95 for a bound at 95 %.

    Notes
    -----
    ``sum(d^2) / sigma^2`` is chi-square distributed with n degrees of freedom. A bias makes the bound wider than it
    needs to be.
    """
    from scipy.special import chdtri  # noqa: PLC0415 - slow to load; a check of loose files needs none

    return rmse * math.sqrt(n / float(chdtri(n, confidence)))


def rmse_with_reference(rmse: float, sd: float) -> float:
    """RMSE with the reference's own error: ``sqrt(rmse^2 + sd^2)``.

    Notes
    -----
    ASPRS Positional Accuracy Standards for Digital Geospatial Data, edition 2 (2023): a product is no better than the
    survey it is compared with.

    Examples
    --------
    >>> rmse_with_reference(0.004, 0.003)
    0.005
    """
    return math.hypot(rmse, sd)


def rmse_less_reference(rmse: float, sd: float) -> float:
    """RMSE that is left if all of the reference's error is taken out: ``sqrt(max(0, rmse^2 - sd^2))``.

    Notes
    -----
    The least that a product can owe to itself, with every benefit given to the survey.

    Examples
    --------
    >>> rmse_less_reference(0.005, 0.003)
    0.004
    """
    return math.sqrt((rmse - sd) * (rmse + sd)) if rmse > sd else 0.0
