# SPDX-License-Identifier: MIT
"""One cause that explains why points lie beside the linework they belong to.

Each search proposes a transformation of the points; whoever calls asks whether the linework holds them then.
"""

from collections.abc import Callable, Iterator
from itertools import combinations, permutations, product
from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.units import LENGTHS

Holds = Callable[[Coordinates], Flags]  #: whether the linework holds points (n, 3), as (n,)
_Axes = tuple[int, int, int]
HoldsEnlarged = Callable[[Coordinates, float], Flags]  #: the same of points that were multiplied by a factor

_FEWEST = 3  #: two points fit anywhere
_ANCHORS = 6  #: pairs of points that are tried
_TRIED = 50  #: proposals of one pair that are looked at closely
_MOST_PAIRS = 2_000_000  #: pairs of vertices that one search may look at
_SCALES = (0.5, 2.0)  #: a factor beyond is a unit, not a slip
_SAME_FACTOR = 0.05  #: of lengths in another unit, whatever their own errors
_UNITS = ("m", "mm", "cm", "in", "ft", "km")
#: factors that a table in another unit is off by, the nearest to one first: a tiny one puts all points on one place
UNIT_FACTORS = tuple(
    sorted({LENGTHS[a] / LENGTHS[b] for a in _UNITS for b in _UNITS if a != b}, key=lambda f: (max(f, 1 / f), f))
)


def _ways() -> Iterator[tuple[_Axes, _Axes]]:
    """Axes and signs: exchanges without a change of sign, then the turns by quarters that need some."""
    every = [(x, y, z) for x, y, z in permutations(range(3))]
    for axes in every:
        yield axes, (1, 1, 1)
    for axes, (x, y, z) in product(every, list(product((1, -1), repeat=3))[1:]):
        if np.linalg.det(np.eye(3)[list(axes)]) * x * y * z > 0:
            yield axes, (x, y, z)


_WAYS = tuple(_ways())
Y_UP = ((0, 2, 1), (1, 1, -1))  #: axes and signs of a table that is z up, and a file that is y up


class Cause(NamedTuple):
    """What was done to the points, so that they lie beside the linework."""

    kind: str  #: ``axes``, ``unit``, ``mirror``, ``shift`` or ``scale``
    axes: _Axes = (0, 1, 2)  #: of ``axes`` and ``unit``: column of the table that holds the axis of the drawing
    signs: _Axes = (1, 1, 1)  #: of these: -1 where it holds the opposite of it
    factor: float = 1.0  #: of ``unit`` and ``scale``: linework over points
    along: str = ""  #: of ``mirror`` and ``scale``: ``right``, ``up``, or ``""`` for all
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)  #: linework minus points, right, up, depth


def by_axes_or_unit(
    points: Coordinates, factors: tuple[float, ...], holds: HoldsEnlarged, *, turned: bool = False
) -> Cause | None:
    """Axes of the points exchanged, or another unit, or both.

    Parameters
    ----------
    points : (n, 3)
        In the axes of the file.
    factors : tuple of float
        Factors that a wrong unit can be.
    holds : callable
        Asks for points in the axes of the file, and by how much they were multiplied: so are their errors.
    turned : bool
        Quarter turns are tried too: where one axis points up in the table, and another in the file, exchanging them
        needs a change of sign if nothing is to be mirrored.
    """
    if not _enough(points):
        return None
    ways = [way for way in _WAYS if turned or way[1] == (1, 1, 1)]
    for factor in (1.0, *factors):
        for axes, signs in ways:
            if (factor != 1.0 or (axes, signs) != _WAYS[0]) and holds(points[:, axes] * signs * factor, factor).all():
                return Cause("axes" if factor == 1.0 else "unit", axes=axes, signs=signs, factor=factor)
    return None


def by_unit(lengths: Reals, others: Reals, factors: tuple[float, ...]) -> float:
    """Factor of a wrong unit with which all lengths are the others; 1 if there is none, or fewer than three lengths.

    Parameters
    ----------
    lengths, others : (n,)
        Greater than zero.
    factors : tuple of float
        Factors that a wrong unit can be.

    Examples
    --------
    >>> by_unit(np.array([201.0, 150.0, 333.0]), np.array([2.0, 1.5, 3.3]), UNIT_FACTORS)
    0.01
    """
    if len(lengths) < _FEWEST:
        return 1.0
    ratio = others / lengths
    fits = [f for f in factors if not _SCALES[0] < f < _SCALES[1] and (np.abs(ratio / f - 1) <= _SAME_FACTOR).all()]
    return min(fits, key=lambda factor: float(np.abs(ratio / factor - 1).max()), default=1.0)


def by_place_or_size(points: Coordinates, vertices: Coordinates, *, within: float, holds: Holds) -> Cause | None:
    """Points shifted, mirrored or stretched as a whole.

    Parameters
    ----------
    points : (n, 3)
        Right, up, depth.
    vertices : (m, 3)
        Of the linework.
    within : float
        Distance up to which a point is at a vertex.
    holds : callable
        Asks for points in the frame of ``points``.

    Returns
    -------
    Cause or None
        Tried in this order: shift; mirrored right, or up, and shifted; stretched in all directions, right, or up, and
        shifted. ``None`` too where a search would cost too much, or points are fewer than three.

    Notes
    -----
    Two points are anchors: pairs of vertices that lie to each other as they do propose a transformation. Six pairs of
    anchors are tried, the farthest first; O(m log m + pairs of vertices on one line).
    """
    if not _enough(points):
        return None
    corners = _distinct(vertices, within)
    search = _Search(points, corners, within, holds)
    for along, flip in (("", (1.0, 1.0, 1.0)), ("right", (-1.0, 1.0, 1.0)), ("up", (1.0, -1.0, 1.0))):
        if (shift := search.shift(np.array(flip))) is not None:
            return Cause("mirror" if along else "shift", along=along, shift=_triple(shift))
    for along in ("", "right", "up"):
        if (found := search.stretch(along)) is not None:
            return Cause("scale", along=along, factor=found[0], shift=_triple(found[1]))
    return None


class _Search:
    def __init__(self, points: Coordinates, corners: Coordinates, within: float, holds: Holds) -> None:
        from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; sound evidence needs none

        self.points, self.corners, self.within, self.holds = points, corners, within, holds
        self.tree = cKDTree(corners[:, :2])

    def shift(self, flip: Reals) -> Reals | None:
        """Shift (3,) after which the linework holds the points, mirrored or not."""
        moved = self.points * flip
        for a, b in _anchors(self.points):
            step = moved[b] - moved[a]
            gap, _ = self.tree.query(self.corners[:, :2] + step[:2], distance_upper_bound=2 * self.within)
            shifts = self.corners[np.isfinite(gap)] - moved[a]
            for shift in self._best(moved, shifts, np.ones((len(shifts), 3))):
                if self.holds(moved + shifts[shift]).all():
                    found: Reals = shifts[shift]
                    return found
        return None

    def stretch(self, along: str) -> tuple[float, Reals] | None:
        """Factor and shift (3,) after which the linework holds the points."""
        for a, b in _anchors(self.points):
            step = (self.points[b] - self.points[a])[:2]
            length = np.hypot(*step)
            across, run = {
                "": (self.corners[:, :2] @ np.array([-step[1], step[0]]) / length,
                     self.corners[:, :2] @ step / length),
                "right": (self.corners[:, 1], self.corners[:, 0]),
                "up": (self.corners[:, 0], self.corners[:, 1]),
            }[along]  # fmt: skip
            wanted, apart = {"": (length, 0.0), "right": step, "up": step[::-1]}[along]
            if abs(wanted) <= self.within:
                continue
            first, second = _pairs(across, apart, 2 * self.within)
            factor = (run[second] - run[first]) / wanted
            good = (factor > _SCALES[0]) & (factor < _SCALES[1]) & (np.abs(factor - 1) * abs(wanted) > 2 * self.within)
            first, factor = first[good], factor[good]
            factors = np.ones((len(factor), 3))
            factors[:, {"": [0, 1, 2], "right": [0], "up": [1]}[along]] = factor[:, None]
            shifts = self.corners[first] - self.points[a] * factors
            for n in self._best(self.points, shifts, factors):
                if self.holds(self.points * factors[n] + shifts[n]).all():
                    return float(factor[n]), shifts[n]
        return None

    def _best(self, points: Coordinates, shifts: Coordinates, factors: Coordinates) -> Index:
        """Proposals under which most points are at a vertex, best first."""
        votes = np.zeros(len(shifts), dtype=np.intp)
        for point in points:
            gap, _ = self.tree.query((point * factors + shifts)[:, :2], distance_upper_bound=3 * self.within)
            votes += np.isfinite(gap)
        order: Index = np.lexsort((np.linalg.norm(shifts, axis=1), -votes))
        return order[votes[order] >= _FEWEST][:_TRIED]


def _pairs(across: Reals, apart: float, within: float) -> tuple[Index, Index]:
    """Pairs of vertices whose second lies ``apart`` from the first across the direction of search."""
    order = np.argsort(across, kind="stable")
    low = np.searchsorted(across[order], across + apart - within)
    high = np.searchsorted(across[order], across + apart + within)
    count = high - low
    if count.sum() > _MOST_PAIRS:
        return np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp)
    first = np.repeat(np.arange(len(across)), count)
    start = np.repeat(low - np.concatenate([[0], np.cumsum(count)[:-1]]), count)
    return first, order[start + np.arange(len(first))]


def _anchors(points: Coordinates) -> Iterator[tuple[int, int]]:
    """Pairs of points, the farthest first."""
    pairs = list(combinations(range(min(len(points), 20)), 2))
    length = [float(np.linalg.norm(points[a, :2] - points[b, :2])) for a, b in pairs]
    for n in np.argsort(length, kind="stable")[::-1][:_ANCHORS]:
        if length[n] > 0:
            yield pairs[n]


def _distinct(vertices: Coordinates, within: float) -> Coordinates:
    """One vertex for each cell of the grid."""
    finite = vertices[np.isfinite(vertices[:, :2]).all(axis=1)]
    _, first = np.unique(np.round(finite[:, :2] / within), axis=0, return_index=True)
    corners: Coordinates = np.nan_to_num(finite[np.sort(first)])
    return corners


def _enough(points: Coordinates) -> bool:
    return len(np.unique(points, axis=0)) >= _FEWEST


def _triple(values: Reals) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
