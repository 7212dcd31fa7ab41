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


def middle(boxes: Reals) -> tuple[Reals, Reals]:
    """Corners (3,) of the box that holds the middle four fifths of boxes (n, 6); of fewer than ten, all but one."""
    low = np.quantile(boxes[:, :3], 0.1, axis=0, method="higher")
    high = np.quantile(boxes[:, 3:], 0.9, axis=0, method="lower")
    return low, high


def main_box(boxes: Reals) -> tuple[Reals, Reals]:
    """Corners (3,) around boxes (n, 6), without the few that reach far beyond the middle of all others.

    Both are zero if there are none.
    """
    if not len(boxes):
        return np.zeros(3), np.zeros(3)
    low, high = middle(boxes)
    far = _FAR * max(1.0, _MANY / len(boxes)) * max(0.0, float(np.max(high - low)))
    stray = np.any((boxes[:, 3:] > high + far) | (boxes[:, :3] < low - far), axis=1)
    few = np.count_nonzero(stray) <= max(1.0, _FEW * len(boxes)) and not stray.all()
    kept = boxes[~stray] if few else boxes
    return kept[:, :3].min(axis=0), kept[:, 3:].max(axis=0)
