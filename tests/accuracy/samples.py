# SPDX-License-Identifier: MIT
"""Samples with stated statistics."""

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri


def with_moments(n: int, mean: float, sd: float) -> NDArray[np.float64]:
    """n normal-looking differences with exactly this mean and this sample standard deviation."""
    scores = ndtri((np.arange(1, n + 1) - 0.375) / (n + 0.25))
    scores -= scores.mean()
    return mean + sd * scores / scores.std(ddof=1)
