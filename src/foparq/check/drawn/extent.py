# SPDX-License-Identifier: MIT
"""How large a drawing is, whatever strays lie about it."""

import numpy as np
import shapely

from foparq.columns import Geometries, Reals

_FAR = 1.0  #: strays reach farther from the middle of the drawing than this is wide, so many times
_MANY = 10  #: of fewer items the middle tells less, and strays must reach the farther
_FEW = 0.05  #: and are no larger share of the items; one item always may be


def boxes_of(geometry: Geometries) -> Reals:
    """(n, 6) lower and upper corners of items whose coordinates are numbers; a missing depth is zero."""
    corners, item = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    corners[:, 2] = np.nan_to_num(corners[:, 2], posinf=np.inf, neginf=-np.inf)
    low, high = np.full((len(geometry), 3), np.inf), np.full((len(geometry), 3), -np.inf)
    np.minimum.at(low, item, corners)
    np.maximum.at(high, item, corners)
    boxes: Reals = np.hstack([low, high])
    return boxes[np.isfinite(boxes).all(axis=1)]


def main_extent(boxes: Reals) -> Reals:
    """(3,) extent of boxes (n, 6) along each axis, without the few that reach far beyond the middle of all others."""
    if not len(boxes):
        return np.zeros(3)
    low = np.quantile(boxes[:, :3], 0.1, axis=0, method="higher")
    high = np.quantile(boxes[:, 3:], 0.9, axis=0, method="lower")
    far = _FAR * max(1.0, _MANY / len(boxes)) * max(0.0, float(np.max(high - low)))
    stray = np.any((boxes[:, 3:] > high + far) | (boxes[:, :3] < low - far), axis=1)
    kept = boxes[~stray] if np.count_nonzero(stray) <= max(1.0, _FEW * len(boxes)) else boxes
    extent: Reals = kept[:, 3:].max(axis=0) - kept[:, :3].min(axis=0) if len(kept) else np.zeros(3)
    return extent
