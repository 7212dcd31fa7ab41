# SPDX-License-Identifier: MIT
"""Delivered minus reference."""

import math

import numpy as np
from numpy.typing import ArrayLike

from foparq.columns import Reals

_NOISE = 8.0  #: units in the last place that a subtraction and a change of unit may leave


def differences(delivered: ArrayLike, reference: ArrayLike) -> Reals:
    """Delivered minus reference, without the noise of binary numbers.

    100.351 - 100.101 is 0.25, not 0.25000000000001: decimals that the subtraction cannot resolve are rounded away, so
    that equal differences are equal. At 7 million metres this is 0.01 micrometre. Does not round to the printed digits.

    Parameters
    ----------
    delivered, reference : (n,) float
        In one unit.

    Returns
    -------
    (n,) float
        NaN where one of the two is not a finite number, or the difference is not.

    Examples
    --------
    >>> differences([100.351, 7.0], [100.101, float("nan")])
    array([0.25,  nan])
    """
    left, right = np.asarray(delivered, dtype=np.float64), np.asarray(reference, dtype=np.float64)
    with np.errstate(over="ignore", invalid="ignore"):
        raw: Reals = left - right
    known = np.isfinite(raw)
    found = np.where(known, raw, math.nan)
    if known.any():
        noise = _NOISE * float(np.spacing(np.abs([left[known], right[known]]).max()))
        decimals = math.floor(-math.log10(noise))
        # Beyond 15 decimals every number is small enough; below 0 there is no noise to speak of.
        found[known] = np.round(found[known], decimals) if 0 <= decimals <= 15 else found[known]  # noqa: PLR2004
    return found
