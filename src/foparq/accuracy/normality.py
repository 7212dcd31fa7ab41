# SPDX-License-Identifier: MIT
"""Whether differences are normally distributed."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from foparq.accuracy.moments import moments
from foparq.columns import Reals

_LARGE = 10.0  #: the fitted p is below 4e-24 here, and its polynomial turns upward far beyond


@dataclass(frozen=True, slots=True)
class AndersonDarling:
    """Anderson-Darling test of normality with estimated mean and standard deviation."""

    a2: float  #: the statistic
    a2_star: float  #: corrected for sample size
    p: float  #: probability of a larger statistic, if the differences are normal


def anderson_darling(differences: ArrayLike) -> AndersonDarling:
    """Anderson-Darling test of normality, mean and standard deviation estimated from the sample.

    With z the sorted standardised differences and F the normal distribution,
    ``A2 = -n - 1/n * sum((2 i - 1) (ln F(z_i) + ln(1 - F(z_(n+1-i)))))`` and ``A2* = A2 (1 + 0.75/n + 2.25/n^2)``.

    Parameters
    ----------
    differences : (n,) float
        At least 3 that are not all one number. The fitted p is meant for n >= 8.

    Raises
    ------
    ValueError
        If n < 3 or the differences are all one number: nothing can be said of their distribution.

    Notes
    -----
    D'Agostino and Stephens 1986, Goodness-of-Fit Techniques, section 4.8, table 4.9 (case 3).
    """
    values = np.asarray(differences, dtype=np.float64).ravel()
    found = moments(values)
    if found.n < 3 or not found.sd > 0.0:  # noqa: PLR2004 - two numbers are normal in one way only
        raise ValueError("a test of normality needs three differences that vary")
    n = found.n
    z = np.sort((values - found.mean) / found.sd)
    odd = 2.0 * np.arange(1, n + 1) - 1.0
    from scipy.special import log_ndtr  # noqa: PLC0415 - slow to load; a check of loose files needs none

    # Logarithms of both tails keep their digits where 1 - F(z) would be zero.
    a2 = -n - math.fsum(odd * (log_ndtr(z) + log_ndtr(-z[::-1]))) / n
    star = a2 * (1.0 + 0.75 / n + 2.25 / n**2)
    return AndersonDarling(a2, star, normal_tail(star))


def normal_tail(a2_star: float) -> float:
    """Probability of a larger corrected Anderson-Darling statistic if the sample is normal.

    Parameters
    ----------
    a2_star : float
        ``A2 (1 + 0.75/n + 2.25/n^2)``.

    Returns
    -------
    float
        p by the four fitted branches of D'Agostino and Stephens 1986, table 4.9; at most 4e-24 above 10.

    Examples
    --------
    >>> round(normal_tail(0.752), 3)
    0.05
    """
    a = min(a2_star, _LARGE)
    if a < 0.2:  # noqa: PLR2004 - branches of the source
        return 1.0 - math.exp(-13.436 + 101.14 * a - 223.73 * a * a)
    if a < 0.34:  # noqa: PLR2004
        return 1.0 - math.exp(-8.318 + 42.796 * a - 59.938 * a * a)
    if a < 0.6:  # noqa: PLR2004
        return math.exp(0.9177 - 4.279 * a - 1.38 * a * a)
    return math.exp(1.2937 - 5.709 * a + 0.0186 * a * a)


def normal_scores(n: int) -> Reals:
    """Values (n,) that a standard normal sample of n is expected to have, in order.

    Notes
    -----
    Blom 1958: the normal quantiles of ``(i - 3/8) / (n + 1/4)``.

    Examples
    --------
    >>> normal_scores(3).round(3)
    array([-0.869,  0.   ,  0.869])
    """
    from scipy.special import ndtri  # noqa: PLC0415 - slow to load; a check of loose files needs none

    scores: Reals = ndtri((np.arange(1, n + 1) - 0.375) / (n + 0.25))
    return scores
