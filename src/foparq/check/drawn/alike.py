# SPDX-License-Identifier: MIT
"""Drawings of two facades that are one drawing."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any

import numpy as np
import shapely

from foparq.check.drawn.ground import DrawnGround
from foparq.columns import Coordinates, Reals
from foparq.findings.ties import Alike
from foparq.names import folded

_ALIKE = 0.9  #: share of the vertices of either drawing that the other one has too
_LARGEST = 20  #: lines of a drawing that may tell how the other one lies to it
_SOME = 200  #: vertices that are looked at first
_TRIED = 60  #: places of the other drawing that are looked at


def alike_facades(grounds: Sequence[DrawnGround], *, within: float) -> tuple[Alike, ...]:
    """Pairs of drawings with different names of facades whose linework is the same, moved or mirrored or not.

    Parameters
    ----------
    grounds : sequence of DrawnGround
    within : float, metres
        Vertices not farther apart are the same.

    Returns
    -------
    tuple of Alike
        In the order of the drawings. Depths are not looked at.

    Notes
    -----
    How one drawing lies to the other is proposed by their largest lines of equal width and height, at most sixty times;
    O(d^2 m log m) for d drawings of m vertices.
    """
    named = [ground for ground in grounds if ground.drawing.facade]
    found = []
    for one, other in combinations(named, 2):
        if folded(one.drawing.facade) == folded(other.drawing.facade):
            continue
        for mirrored in (False, True):
            if _same(one, other, within, mirrored=mirrored):
                a, b = one.drawing, other.drawing
                found.append(Alike(a.path, a.facade, b.path, b.facade, mirrored))
                break
    return tuple(found)


def _same(one: DrawnGround, other: DrawnGround, within: float, *, mirrored: bool) -> bool:
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; one drawing needs none

    flip = np.array([-1.0 if mirrored else 1.0, 1.0])
    here, there = _vertices(one, within), _vertices(other, within) * flip
    # What one drawing has more than twice of cannot be nine tenths of the other.
    if min(len(here), len(there)) < _ALIKE * max(len(here), len(there)) / 2 or not len(here):
        return False
    tree, back, some = cKDTree(here), cKDTree(there), there[:: max(1, len(there) // _SOME)]
    for shift in _shifts(_boxes(one, np.ones(2)), _boxes(other, flip), within):
        # A few first: hardly any proposal is right.
        asked = ((tree, some + shift), (tree, there + shift), (back, here - shift))
        if all(_share(of, spots, 2 * within) >= _ALIKE for of, spots in asked):
            return True
    return False


def _share(tree: Any, spots: Coordinates, within: float) -> float:  # noqa: ANN401 - scipy publishes no useful types
    """Share of some places that one of the tree is near to."""
    return float(np.isfinite(tree.query(spots, distance_upper_bound=within)[0]).mean())


def _shifts(here: Reals, there: Reals, within: float) -> Iterator[Reals]:
    """Steps (2,) from the largest boxes (n, 4) of one drawing to those of the other with the same sizes."""
    tried = 0
    for box in here[:_LARGEST]:
        same = np.flatnonzero(np.all(np.abs(there[:, 2:] - box[2:]) <= 2 * within, axis=1))
        for row in same.tolist():
            if tried == _TRIED:
                return
            tried += 1
            yield box[:2] - there[row, :2]


def _boxes(ground: DrawnGround, flip: Reals) -> Reals:
    """(n, 4) lower left corner and size of the lines on the sheet, the largest first."""
    bounds = shapely.bounds(ground.work.lines)
    bounds = bounds[np.isfinite(bounds).all(axis=1)]
    corners = np.sort(np.stack([bounds[:, :2] * flip, bounds[:, 2:] * flip]), axis=0)
    boxes: Reals = np.hstack([corners[0], corners[1] - corners[0]])
    return boxes[np.argsort(-np.hypot(boxes[:, 2], boxes[:, 3]), kind="stable")]


def _vertices(ground: DrawnGround, within: float) -> Coordinates:
    """(v, 2) places of the sheet where vertices lie, each about once."""
    corners = ground.corners()[:, :2]
    _, first = np.unique(np.round(corners / within), axis=0, return_index=True)
    vertices: Coordinates = corners[np.sort(first)]
    return vertices
