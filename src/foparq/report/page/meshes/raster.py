# SPDX-License-Identifier: MIT
"""Which triangle is seen in each pixel: a buffer of depths, in parallel projection."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Integers, Reals

NOTHING = -1  #: no triangle is seen in the pixel
_BLOCK = 2**21  #: pixels looked at in one step
_MOST = 30_000_000  #: pixels looked at in all, before the picture is made coarser
_DEPTHS = 2**30  #: steps between nearest and farthest
_ROUNDING = 1e-9  #: of a pixel: a centre nearer to a side is on it


class Seen(NamedTuple):
    """What is seen in every pixel."""

    triangle: Integers  #: (height, width) row of the triangle; :data:`NOTHING` where there is none
    depth: Reals  #: (height, width) towards the viewer; -inf where there is nothing


def seen(corners: Reals, width: int, height: int) -> Seen:
    """Triangles as they cover each other.

    Parameters
    ----------
    corners : (t, 3, 3) float
        To the right and downward in pixels from the upper left corner, and towards the viewer in any unit.
    width, height : int, pixels

    Returns
    -------
    Seen
        A triangle is seen in a pixel whose centre it covers, its sides included. Of equals the last is seen.

    Notes
    -----
    O(t + pixels in the boxes around the triangles). Where these are too many, as of heaps of large triangles, pixels
    are taken together in squares until they are not.
    """
    coarse = 1
    while _boxes(corners, width, height, coarse).prod(axis=1).sum() > _MOST:
        coarse *= 2
    across, down = -(-width // coarse), -(-height // coarse)
    corners = corners / (coarse, coarse, 1.0) if coarse > 1 else corners
    low, far = corners[..., 2].min(initial=np.inf), corners[..., 2].max(initial=-np.inf)
    span = max(float(far - low), np.finfo(float).tiny) if len(corners) else 1.0
    best = np.full(across * down, NOTHING, dtype=np.int64)
    for row, pixel, depth in _covered(corners, across, down):
        step = np.rint((depth - low) / span * _DEPTHS).astype(np.int64)
        np.maximum.at(best, pixel, (np.clip(step, 0, _DEPTHS) << 32) | row)
    there = best >= 0
    triangle = np.where(there, best & (2**32 - 1), NOTHING).astype(np.int32)
    depth = np.where(there, low + (best >> 32) / _DEPTHS * span if len(corners) else 0.0, -np.inf)
    return Seen(_enlarged(triangle, across, coarse, width, height), _enlarged(depth, across, coarse, width, height))


def _boxes(corners: Reals, width: int, height: int, coarse: int) -> Index:
    """Pixels (t, 2) across and down whose centres lie in the box around each triangle."""
    size = -(-np.array([width, height]) // coarse)
    a, b, c = (corners[:, n, :2] / coarse for n in range(3))
    first = np.clip(np.ceil(np.minimum(np.minimum(a, b), c) - 0.5), 0, size)
    last = np.clip(np.floor(np.maximum(np.maximum(a, b), c) - 0.5), -1, size - 1)
    many: Index = np.maximum(last - first + 1, 0).astype(np.intp)
    return many


def _covered(corners: Reals, width: int, height: int) -> Iterator[tuple[Index, Index, Reals]]:
    """Triangle, pixel and depth of every centre of a pixel that is covered."""
    number = _boxes(corners, width, height, 1).prod(axis=1)
    rows = np.flatnonzero(number)
    block = (np.cumsum(number[rows]) - 1) // _BLOCK
    for part in np.split(rows, np.flatnonzero(np.diff(block)) + 1):
        chosen = corners[part]
        at, line, left, right = _spans(_downward(chosen), height)
        first = np.clip(np.ceil(left - 0.5 - _ROUNDING), 0, width).astype(np.intp)
        many = np.clip(np.floor(right - 0.5 + _ROUNDING), -1, width - 1).astype(np.intp) - first + 1
        slopes, sound = _slopes(chosen)
        held = np.flatnonzero((many > 0) & sound[at])
        at, line, first, many = at[held], line[held], first[held], many[held]
        span, nth = _counted(many)
        # Depth is even along a line of pixels: that of its first one, and a step for each further one.
        start = chosen[at, 0, 2] + slopes[at, 0] * (first + 0.5 - chosen[at, 0, 0])
        start += slopes[at, 1] * (line + 0.5 - chosen[at, 0, 1])
        depth = start[span] + slopes[at, 0][span] * nth
        yield part[at[span]], (line * width + first)[span] + nth, depth


def _spans(ordered: Reals, height: int) -> tuple[Index, Index, Reals, Reals]:
    """Where lines of pixels cross triangles (t, 3, 3) whose corners go downward: triangle, line, left and right end."""
    top, middle, bottom = ordered[:, 0, 1], ordered[:, 1, 1], ordered[:, 2, 1]
    first = np.clip(np.ceil(top - 0.5 - _ROUNDING), 0, height).astype(np.intp)
    last = np.clip(np.floor(bottom - 0.5 + _ROUNDING), -1, height - 1).astype(np.intp)
    at, nth = _counted(np.maximum(last - first + 1, 0))
    line = first[at] + nth
    y = line.astype(float) + 0.5
    lower = (y > middle[at]).astype(np.intp)
    one = _crossing(ordered[at, 0], ordered[at, 2], y)
    other = _crossing(ordered[at, lower], ordered[at, lower + 1], y)
    return at, line, np.minimum(one, other), np.maximum(one, other)


def _downward(corners: Reals) -> Reals:
    """Corners of each triangle from top to bottom."""
    order = np.argsort(corners[..., 1], axis=1)
    ordered: Reals = corners[np.arange(len(corners))[:, np.newaxis], order]
    return ordered


def _crossing(upper: Reals, lower: Reals, y: Reals) -> Reals:
    """Where sides pass a height; a level side is passed at its lower end."""
    fall = lower[:, 1] - upper[:, 1]
    share = np.where(fall > 0, np.clip((y - upper[:, 1]) / np.where(fall > 0, fall, 1.0), 0.0, 1.0), 1.0)
    at: Reals = upper[:, 0] + share * (lower[:, 0] - upper[:, 0])
    return at


def _slopes(corners: Reals) -> tuple[Reals, Flags]:
    """How depth grows (t, 2) to the right and downward, and whether the triangle has an area in the picture."""
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    across = u[:, 2] * v[:, 1] - u[:, 1] * v[:, 2]
    down = u[:, 0] * v[:, 2] - u[:, 2] * v[:, 0]
    return np.stack([across, down], axis=1) / np.where(area != 0, area, 1.0)[:, np.newaxis], area != 0


def _counted(number: Index) -> tuple[Index, Index]:
    """Each row as often as its number says, and which time it is, from 0."""
    row = np.repeat(np.arange(len(number)), number)
    return row, np.arange(len(row)) - (np.cumsum(number) - number)[row]


def _enlarged(pixels: NDArray[Any], across: int, coarse: int, width: int, height: int) -> NDArray[Any]:
    rows = pixels.reshape(-1, across)
    if coarse > 1:
        rows = rows.repeat(coarse, axis=0).repeat(coarse, axis=1)
    return rows[:height, :width]
