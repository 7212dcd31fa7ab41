# SPDX-License-Identifier: MIT
"""Numbers beside their marks, none over another."""

from collections.abc import Iterator

import numpy as np

from foparq.columns import Flags, Reals

_RINGS = np.array([0.5, 1.5, 3.0, 5.0, 7.5, 10.5, 14.0, 18.0, 23.0, 29.0])  #: mm between mark and number
_TURNS = np.deg2rad(np.concatenate([np.arange(-45, 315, 90), np.arange(0, 360, 15)]))  #: the corners are tried first
_ROUND = np.stack([np.cos(_TURNS), np.sin(_TURNS)], axis=1)


def placed(spots: Reals, widths: Reals, height: float, size: Reals, clear: float, taken: Reals) -> Reals:
    """Middles of the boxes of numbers, one a mark, in the order of the marks.

    Every box lies on the sheet, over no other box and over no mark, as near to its own mark as it can. One that finds
    no such place beside its mark goes to the nearest place anywhere on the sheet.

    Parameters
    ----------
    spots : (n, 2) mm
        Marks, from the upper left corner of the sheet; y downward.
    widths : (n,) mm
        Of the boxes.
    height : float, mm
        Of the boxes.
    size : (2,) mm
        Of the sheet.
    clear : float, mm
        Half the width and height of a mark.
    taken : (k, 4) mm
        What no box may cover: middle, half the width and half the height.

    Returns
    -------
    (n, 2) mm

    Notes
    -----
    O(n (n + k)). A sheet that has no room left gets boxes over one another: a box and a mark each take at most four
    places of a grid as fine as a box, so that has not to be feared of a sheet that is larger than eight boxes a mark.
    """
    marks = np.column_stack([spots, np.full((len(spots), 2), clear)])
    boxes = np.concatenate([taken, marks, np.empty((len(spots), 4))])
    filled = len(taken) + len(spots)
    for row, (spot, width) in enumerate(zip(spots, widths.tolist(), strict=True)):
        half = np.array([width / 2, height / 2])
        boxes[filled + row] = *_middle(spot, half, size, clear, boxes[: filled + row]), *half
    middles: Reals = boxes[filled:, :2]
    return middles


def _middle(spot: Reals, half: Reals, size: Reals, clear: float, boxes: Reals) -> Reals:
    for tried in _places(spot, half, size, clear):
        free = np.flatnonzero(_inside(tried, half, size) & _clear_of(tried, half, boxes))
        if len(free):
            middle: Reals = tried[free[0]]
            return middle
    return np.clip(spot, half, np.maximum(size - half, half))


def _places(spot: Reals, half: Reals, size: Reals, clear: float) -> Iterator[Reals]:
    """Places around a mark, ring by ring, then all over the sheet."""
    for away in _RINGS:
        yield spot + _ROUND * (half + clear + away)
    yield _grid(spot, half, size)


def _grid(spot: Reals, half: Reals, size: Reals) -> Reals:
    """Places all over the sheet, the nearest first."""
    across, down = (np.arange(low, high, 2 * low) for low, high in zip(half, size, strict=True))
    places = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)
    return places[np.argsort(((places - spot) ** 2).sum(axis=1), kind="stable")]


def _inside(middles: Reals, half: Reals, size: Reals) -> Flags:
    within: Flags = np.all((middles >= half) & (middles <= size - half), axis=1)
    return within


def _clear_of(middles: Reals, half: Reals, boxes: Reals) -> Flags:
    apart = np.abs(middles[:, np.newaxis] - boxes[:, :2]) >= half + boxes[:, 2:]
    free: Flags = np.all(apart[..., 0] | apart[..., 1], axis=1)
    return free
