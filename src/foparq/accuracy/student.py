# SPDX-License-Identifier: MIT
"""Whether the mean of differences is other than zero."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from foparq.accuracy.moments import moments


@dataclass(frozen=True, slots=True)
class StudentTest:
    """Two-sided Student test of a mean against zero."""

    t: float  #: ``mean / (sd / sqrt(n))``; infinite if all differences are one number other than zero
    critical: float  #: greatest ``|t|`` that is no trend at the stated confidence
    p: float  #: probability of a ``|t|`` at least as large, if there is no trend
    freedom: int  #: degrees of freedom, n - 1


def student_test(differences: ArrayLike, *, confidence: float) -> StudentTest:
    """Student t of the mean of differences.

    Parameters
    ----------
    differences : (n,) float
        Delivered minus reference; n >= 2.
    confidence : float
        0.95 for a test at 95 %.

    Returns
    -------
    StudentTest
        ``t`` is 0 if all differences are zero.

    Raises
    ------
    ValueError
        If n < 2.

    Notes
    -----
    Student 1908. Assumes normal differences; see :func:`foparq.accuracy.normality.anderson_darling`, and
    :func:`sign_test` where they are not.
    """
    found = moments(differences)
    if found.n < 2:  # noqa: PLR2004 - a standard deviation needs two
        raise ValueError("a Student test needs two differences")
    from scipy.special import stdtr, stdtrit  # noqa: PLC0415 - slow to load; a check of loose files needs none

    freedom = found.n - 1
    critical = float(stdtrit(freedom, (1.0 + confidence) / 2.0))
    if found.sd > 0.0:
        t = found.mean / (found.sd / math.sqrt(found.n))
    else:
        t = math.copysign(math.inf, found.mean) if found.mean else 0.0
    return StudentTest(t, critical, 2.0 * float(stdtr(freedom, -abs(t))), freedom)


def sign_test(differences: ArrayLike) -> float:
    """Two-sided sign test of the median of differences against zero: needs no normality, and has little power.

    ``p = min(1, 2 * P(B <= min(k, m - k)))`` with k positive ones among the m differences other than zero and B
    binomial (m, 1/2).

    Parameters
    ----------
    differences : (n,) float

    Returns
    -------
    float
        p; 1 if no difference is other than zero.

    Notes
    -----
    Dixon and Mood 1946. Differences of zero are left out.

    Examples
    --------
    >>> sign_test([1.0, 2.0, 3.0, 4.0, 5.0])
    0.0625
    """
    values = np.asarray(differences, dtype=np.float64).ravel()
    above, below = int(np.count_nonzero(values > 0)), int(np.count_nonzero(values < 0))
    from scipy.special import bdtr  # noqa: PLC0415 - slow to load; a check of loose files needs none

    return min(1.0, 2.0 * float(bdtr(min(above, below), above + below, 0.5)))
