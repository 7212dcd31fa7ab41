# SPDX-License-Identifier: MIT
"""B-splines replaced by chords that provably stay within a sagitta."""

import math

import numpy as np

from foparq.columns import Index, Reals
from foparq.read.dxf.curves import MOST_CHORDS, Sagitta, TooFineError

_HIGHEST_DEGREE = 25  #: CAD programs stop below; the cost grows with the third power


def flatten_spline(control: Reals, knots: Reals, degree: int, weights: Reals | None, sagitta: Sagitta) -> Reals | None:
    """Vertices of a B-spline, rational or not, clamped or not.

    Parameters
    ----------
    control : (n, 3) control points
    knots : (n + degree + 1,) knots, not decreasing
    weights : (n,) positive, or None

    Returns
    -------
    (m, 3) vertices, or None
        None if the numbers are no spline. Ends of knot spans are vertices.

    Notes
    -----
    Each knot span is turned into a Bezier curve by blossoming [1]_. A chord over an interval h of a curve stays within
    h^2 / 8 times the greatest second derivative; that is bounded by the second differences of the Bezier points, for
    rational curves by the quotient rule with the origin moved amid the control points. The bound is safe, not tight.

    References
    ----------
    .. [1] L. Ramshaw, "Blossoms are polar forms", Computer Aided Geometric Design 6, 1989.
    """
    n = len(control)
    if not 1 <= degree <= _HIGHEST_DEGREE or n <= degree or len(knots) != n + degree + 1:
        return None
    if weights is not None and (len(weights) != n or not np.all(weights > 0)):
        return None
    numbers = np.concatenate([control.ravel(), knots, [] if weights is None else weights])
    if not np.all(np.isfinite(numbers)) or np.any(np.diff(knots) < 0):
        return None
    spans = np.flatnonzero(knots[degree:n] < knots[degree + 1 : n + 1]) + degree
    if len(spans) == 0:
        return None
    with np.errstate(all="ignore"):  # coordinates near the greatest number overflow, and are then too fine
        centre = control.mean(axis=0)
        moved = control - centre
        own = float(np.abs(moved).max())
        homogeneous = moved if weights is None else np.hstack([moved * weights[:, None], weights[:, None]])
        pieces = _bezier(homogeneous, knots, degree, spans)  # (spans, degree + 1, 3 or 4)
        bend = _bend(pieces, degree) if weights is None else _rational_bend(pieces, degree)
        vertices: Reals = _vertices(pieces, degree, _chords(bend, sagitta.of(own))) + centre
        return vertices


def open_uniform(n: int, degree: int) -> Reals:
    """Clamped uniform knots for n control points, where the file holds none."""
    inner = np.arange(1, n - degree)
    return np.concatenate([np.zeros(degree + 1), inner, np.full(degree + 1, max(n - degree, 1))]).astype(float)


def _bezier(control: Reals, knots: Reals, degree: int, spans: Index) -> Reals:
    local: Reals = control[spans[:, None] - degree + np.arange(degree + 1)]  # (spans, degree + 1, d)
    left, right = knots[spans], knots[spans + 1]
    pieces: Reals = np.empty_like(local)
    for j in range(degree + 1):
        points = local.copy()
        for r in range(1, degree + 1):
            at = right if r <= j else left
            index = np.arange(r, degree + 1)
            low: Reals = knots[spans[:, None] - degree + index]
            high: Reals = knots[spans[:, None] + 1 + index - r]
            share = ((at[:, None] - low) / (high - low))[:, :, None]
            points[:, r:] = (1 - share) * points[:, r - 1 : -1] + share * points[:, r:]
        pieces[:, j] = points[:, degree]
    return pieces


def _bend(pieces: Reals, degree: int) -> Reals:
    if degree == 1:
        return np.zeros(len(pieces))
    second = degree * (degree - 1) * np.diff(pieces, n=2, axis=1)
    bend: Reals = np.linalg.norm(second, axis=2).max(axis=1)
    return bend


def _rational_bend(pieces: Reals, degree: int) -> Reals:
    if degree == 1:
        return np.zeros(len(pieces))  # weights move along the chord, not off it
    # C = A / w:  C' = (A' - w' C) / w,  C'' = (A'' - 2 w' C' - w'' C) / w
    weight = pieces[:, :, 3]
    least = weight.min(axis=1)
    reach = np.linalg.norm(pieces[:, :, :3] / weight[:, :, None], axis=2).max(axis=1)
    first = degree * np.abs(np.diff(pieces, axis=1))
    slope = np.linalg.norm(first[:, :, :3], axis=2).max(axis=1)
    weight_slope = first[:, :, 3].max(axis=1)
    speed = (slope + weight_slope * reach) / least
    weight_bend = _bend(pieces[:, :, 3:], degree)
    bend: Reals = (_bend(pieces[:, :, :3], degree) + 2 * weight_slope * speed + weight_bend * reach) / least
    return bend


def _chords(bend: Reals, allowed: float) -> Index:
    if not allowed > 0:
        raise TooFineError
    count = np.ceil(np.sqrt(bend / (8 * allowed)))
    if not np.sum(count) <= MOST_CHORDS:
        raise TooFineError
    chords: Index = np.maximum(count, 1).astype(np.intp)
    return chords


def _vertices(pieces: Reals, degree: int, chords: Index) -> Reals:
    choose = np.array([math.comb(degree, j) for j in range(degree + 1)], dtype=float)
    powers = np.arange(degree + 1)
    rows = [pieces[:1, 0]]
    for piece, n in zip(pieces, chords, strict=True):
        t = np.arange(1, n)[:, None] / n
        rows.append((choose * t**powers * (1 - t) ** (degree - powers)) @ piece)
        rows.append(piece[-1:])
    points = np.concatenate(rows)
    vertices: Reals = points if points.shape[1] == 3 else points[:, :3] / points[:, 3:]  # noqa: PLR2004 - x, y, z, weight
    return vertices
