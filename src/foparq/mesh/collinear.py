# SPDX-License-Identifier: MIT
"""Faces fallen in to a line or a place: exact answers on coordinates as delivered."""

from fractions import Fraction
from math import fsum

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.mesh.polygons import blocks, chosen, face_of, following

#: half a unit in the last place of one
_HALF = float(np.finfo(np.float64).eps) / 2
#: of a difference of two products of differences (Shewchuk 1997, the bound A of orient2d)
_BOUND = (3 + 16 * _HALF) * _HALF
#: splits a double into two of 26 bits (Dekker 1971)
_SPLITTER = 2.0**27 + 1
#: within these the rounding errors of products are themselves doubles
_LEAST, _MOST = 1e-140, 1e140
#: the pairs of axes of the three components of a cross product
_PLANES = ((1, 2), (2, 0), (0, 1))


def null_sides(corners: Index, starts: Index) -> Index:
    """Sides (k,) whose ends are one vertex, rising: the corner that the next one repeats."""
    return np.flatnonzero(corners == corners[following(starts)])


def collinear_faces(points: Coordinates, corners: Index, starts: Index) -> Flags:
    """Faces all of whose corners lie on one straight line, or at one place.

    Parameters
    ----------
    points : (n, 3) float
    corners : (m,) int
    starts : (f + 1,) int

    Returns
    -------
    (f,) bool
        Exact for the coordinates as they are: no tolerance, no rounding.

    Notes
    -----
    A cross product that exceeds its bound of error says that a face is not collinear; this decides all but the
    thinnest faces, also where they lie in the planes of the axes. The others are decided without rounding: the terms
    of each component are split into sums of doubles, or into fractions if they are very large or small. O(m).

    Examples
    --------
    >>> thin = np.array([[0.0, 0, 0], [1, 1, 1], [3, 3, 3], [3, 3, 3.0000000000000004]])
    >>> collinear_faces(thin, np.array([0, 1, 2, 0, 1, 3]), np.array([0, 3, 6])).tolist()
    [True, False]
    """
    open_faces = np.ones(len(starts) - 1, dtype=bool)
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        for first, stop in blocks(starts):
            at = starts[first : stop + 1] - starts[first]
            place = points.take(corners[starts[first] : starts[stop]], axis=0)
            spoke = place - np.repeat(place[at[:-1]], np.diff(at), axis=0)
            after = spoke[following(at)]
            apart = np.zeros(len(spoke), dtype=bool)
            for u, v in _PLANES:
                left, right = spoke[:, u] * after[:, v], spoke[:, v] * after[:, u]
                size = np.abs(left) + np.abs(right)
                apart |= (np.abs(left - right) > _BOUND * size) & (size > _LEAST)
            open_faces[first:stop] = ~np.logical_or.reduceat(apart, at[:-1])
    rows = np.flatnonzero(open_faces)
    some, begin = chosen(corners, starts, rows)
    found = np.zeros(len(starts) - 1, dtype=bool)
    found[rows] = _all_on_a_line(points[some], begin)
    return found


def _all_on_a_line(place: Coordinates, starts: Index) -> Flags:
    """Whether the places of each range lie on a line; exact."""
    count = len(starts) - 1
    owner = face_of(starts)
    base = place[starts[:-1]][owner]
    other = (place != base).any(axis=1)
    # The first place that is not that of the first corner gives the direction.
    second = starts[:-1].copy()
    rows = np.flatnonzero(other)[::-1]
    second[owner[rows]] = rows
    asked = rows[(place[rows] != place[second[owner[rows]]]).any(axis=1)]
    line = np.ones(count, dtype=bool)
    off = ~_on_lines(base[asked], place[second[owner[asked]]], place[asked])
    line[owner[asked[off]]] = False
    return line


def _on_lines(a: Coordinates, b: Coordinates, c: Coordinates) -> Flags:
    """Whether the places a, b, c (k, 3) lie on a line; exact."""
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        ahead, behind = (_difference(end, a) for end in (b, c))
    sizes = np.abs(np.concatenate([*ahead, *behind], axis=1))
    tame = ((sizes == 0) | ((sizes > _LEAST) & (sizes < _MOST))).all(axis=1)
    found = np.zeros(len(a), dtype=bool)
    tamed = np.flatnonzero(tame)
    found[tamed] = _vanish([part[tamed] for part in ahead], [part[tamed] for part in behind])
    for row in np.flatnonzero(~tame).tolist():
        found[row] = _on_line_of_fractions(*(place[row].tolist() for place in (a, b, c)))
    return found


def _difference(a: Reals, b: Reals) -> tuple[Reals, Reals]:
    """The difference and its rounding error (Knuth)."""
    x = a - b
    virtual = a - x
    return x, (a - (x + virtual)) + (virtual - b)


def _product(a: Reals, b: Reals) -> tuple[Reals, Reals]:
    """The product and its rounding error (Dekker)."""
    x = a * b
    halves = []
    for factor in (a, b):
        wide = _SPLITTER * factor
        high = wide - (wide - factor)
        halves.append((high, factor - high))
    (ah, al), (bh, bl) = halves
    return x, al * bl - (((x - ah * bh) - al * bh) - ah * bl)


def _vanish(ahead: list[Reals], behind: list[Reals]) -> Flags:
    """Whether the cross products of vectors (k, 3), each a sum of two doubles, vanish; exact."""
    zero = np.ones(len(ahead[0]), dtype=bool)
    for u, v in _PLANES:
        rows = np.flatnonzero(zero)
        terms: list[Reals] = []
        for one in ahead:
            for two in behind:
                terms += _product(one[rows, u], two[rows, v])
                terms += _product(-one[rows, v], two[rows, u])
        zero[rows] = _sums_vanish(np.stack(terms, axis=1))
    return zero


def _sums_vanish(terms: Reals) -> Flags:
    """Whether the sums of rows (k, t) are zero; exact."""
    total = terms.sum(axis=1)
    size = np.abs(terms).sum(axis=1)
    # A sum that is farther from zero than its terms can err is none.
    open_rows = np.flatnonzero(np.abs(total) <= 2 * terms.shape[1] * _HALF * size)
    zero = np.zeros(len(terms), dtype=bool)
    zero[open_rows] = [fsum(row) == 0 for row in terms[open_rows].tolist()]
    return zero


def _on_line_of_fractions(a: list[float], b: list[float], c: list[float]) -> bool:
    ahead = [Fraction(y) - Fraction(x) for x, y in zip(a, b, strict=True)]
    behind = [Fraction(y) - Fraction(x) for x, y in zip(a, c, strict=True)]
    return all(ahead[u] * behind[v] == ahead[v] * behind[u] for u, v in _PLANES)
