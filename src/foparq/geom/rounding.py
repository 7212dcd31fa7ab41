# SPDX-License-Identifier: MIT
"""Where to compute so that digits are kept, and how much rounding may shift a place.

Neither depends on single items that lie absurdly far away.
"""

import numpy as np

from foparq.columns import Reals

#: metres; half a unit in the last place of seven digits before the point, in two coordinates of two points
ROUNDING = 5e-9
#: metres; no place of a drawing is farther from the origin of any grid on Earth
EARTH = 1e8
#: metres; the square of a longer distance may be no finite number
FARTHEST = 1e150


def origin_of(coordinates: Reals) -> Reals:
    """(2,) whole metres amidst coordinates (m, 2 or more): computing near zero loses no digits at 7.4e6."""
    if not len(coordinates):
        return np.zeros(2)
    middle: Reals = np.floor(np.median(coordinates[:, :2], axis=0))
    return middle


def slack_of(coordinates: Reals) -> float:
    """Metres by which a distance may be off because coordinates (m, 2 or more) are rounded."""
    size = np.abs(coordinates[:, :2])
    return ROUNDING + 4 * float(np.spacing(np.max(size, initial=0.0, where=size <= EARTH)))
