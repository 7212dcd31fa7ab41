# SPDX-License-Identifier: MIT
"""Whether differences are smaller than the accuracy of their reference lets them be."""

import numpy as np
from numpy.typing import ArrayLike


def too_good(differences: ArrayLike, sd: float, resolution: float) -> float:
    """Probability of differences so small, if the reference alone were in error.

    The sum of squares over the variance of the reference is chi-square with n degrees of freedom if the product is
    without any error; a product with errors of its own makes it larger. A small probability means that delivered and
    reference are not independent: one was copied from the other, or the standard deviation is stated too large.

    Parameters
    ----------
    differences : (n,) float
        Delivered minus reference.
    sd : float
        Standard deviation of the reference, in the same unit; positive.
    resolution : float
        Half the last printed digit of delivered plus that of reference. Rounding makes equal what is not: the variance
        that it hides is added, as if both had the same digits.

    Returns
    -------
    float
        Lower tail of chi-square.

    Notes
    -----
    Of a sum of two roundings to the half digit h each the variance is ``2 h^2 / 3``, with ``h = resolution / 2``.

    Examples
    --------
    >>> round(too_good([0.0, 0.0, 0.0, 0.0], 3.0, 0.0), 9)
    0.0
    """
    with np.errstate(over="ignore"):  # a standard deviation may be anything that is positive
        ratio = np.asarray(differences, dtype=np.float64) / sd
        hidden = np.float64(resolution) / 2 / sd
        total = float(np.sum(ratio**2)) + len(ratio) * float(hidden**2) * 2 / 3
    from scipy.special import chdtr  # noqa: PLC0415 - slow to load; a check of loose files needs none

    return float(chdtr(len(ratio), total))
