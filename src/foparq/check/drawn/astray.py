# SPDX-License-Identifier: MIT
"""Which linework lies so far from the rest of a drawing that it is no part of what is drawn there."""

import numpy as np

from foparq.columns import Flags, Reals

_NEAR = 10.0  #: metres, nearer than which nothing is astray: a portal before its church, a lantern above the roof


def astray(low: Reals, high: Reals, length: Reals) -> Flags:
    """Items beyond an empty space that is wider than all on its other side.

    The widest empty space in an axis parts the items in two. Those with less length are astray if the space is wider
    than the others reach in that axis, than these are wide or high, whichever is less, and than ten metres. What is
    left is parted again.

    Parameters
    ----------
    low, high : (n, 3) metres
        Corners of the boxes of items in the plane of the drawing: right, up, depth.
    length : (n,) metres
        Of the linework of each.

    Returns
    -------
    (n,) bool

    Notes
    -----
    O(n log n) for each part that is left out; these are few, since each is farther away than all before are wide.
    """
    kept: Flags = np.ones(len(low), dtype=bool)
    while np.count_nonzero(kept) > 1:
        rows = np.flatnonzero(kept)
        away = next(
            (far for axis in range(3) if (far := _beyond(low[rows], high[rows], length[rows], axis)).any()), None
        )
        if away is None:
            break
        kept[rows[away]] = False
    return ~kept


def _beyond(low: Reals, high: Reals, length: Reals, axis: int) -> Flags:
    """(n,) items beyond the widest empty space in one axis, if that is wide enough."""
    order = np.argsort(low[:, axis], kind="stable")
    reached = np.maximum.accumulate(high[order, axis])
    empty = low[order[1:], axis] - reached[:-1]
    at = int(np.argmax(empty))
    after = np.zeros(len(low), dtype=bool)
    after[order[at + 1 :]] = True
    away = after if length[after].sum() <= length[~after].sum() else ~after
    extent = high[~away].max(axis=0) - low[~away].min(axis=0)
    wide = empty[at] > max(float(extent[axis]), float(extent[:2].min()), _NEAR)
    return away if wide else np.zeros(len(low), dtype=bool)
