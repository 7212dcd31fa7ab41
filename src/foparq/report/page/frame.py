# SPDX-License-Identifier: MIT
"""What part of the sheet the picture shows."""

import numpy as np

from foparq.columns import Geometries, Reals
from foparq.report.page.paths import Strokes, strokes_of

_FLATTEST, _TALLEST = 3.2, 1.25  # width over height of the picture


def without_strays(strokes: Strokes) -> tuple[Strokes, int]:
    """Strokes without those that lie absurdly far from the rest, and how many items those are.

    One entity a thousand kilometres away would make the facade a dot.
    """
    if not len(strokes.points):
        return strokes, 0
    low, high = np.quantile(strokes.points, [0.01, 0.99], axis=0)
    reach = 5 * max(float((high - low).max()), 1e-9)
    far = ((strokes.points < low - reach) | (strokes.points > high + reach)).any(axis=1)
    stray = np.zeros(len(strokes.owner), dtype=bool)
    stray[strokes.stroke[far]] = True
    if stray.all():
        return strokes, 0
    return strokes.take(~stray), len(np.unique(strokes.owner[stray]))


def frame(strokes: Strokes, sheet: Geometries) -> tuple[Reals, Reals]:
    """Upper left corner (2,) and size (2,) of the picture, metres, with a margin and a bounded shape."""
    points = strokes.points
    if not len(points):
        points = strokes_of(sheet, None, 1.0).points
    if not len(points):
        points = np.zeros((1, 2))
    low, high = points.min(axis=0), points.max(axis=0)
    extent = high - low
    size = np.maximum(extent * 1.06, max(float(extent.max()) * 0.02, 1e-6))
    size[0] = max(size[0], size[1] * _TALLEST)
    size[1] = max(size[1], size[0] / _FLATTEST)
    middle = (low + high) / 2
    return np.array([middle[0] - size[0] / 2, middle[1] + size[1] / 2]), size


def beyond(strokes: Strokes, corner: Reals, size: Reals) -> int:
    """Items that lie wholly outside the picture."""
    if not len(strokes.points):
        return 0
    start = np.flatnonzero(np.diff(strokes.stroke, prepend=-1))
    low, high = np.minimum.reduceat(strokes.points, start), np.maximum.reduceat(strokes.points, start)
    left, top = corner
    seen = (high[:, 0] >= left) & (low[:, 0] <= left + size[0]) & (low[:, 1] <= top) & (high[:, 1] >= top - size[1])
    return len(np.setdiff1d(strokes.owner, strokes.owner[seen]))
