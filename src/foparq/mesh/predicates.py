# SPDX-License-Identifier: MIT
"""Exact signs of orientation determinants.

A determinant in doubles decides if it exceeds its error bound; else the determinant of the rounded differences is
worked out exactly, then corrected for what they leave out, then worked out exactly with it. The sign is always right.

Coordinates are safe if they are zero or their size is within `SMALLEST` ... `LARGEST`: then differences, products and
sums of three factors neither over- nor underflow. What lies beyond is refused, not guessed.

Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, Discrete &
Computational Geometry 18 (1997), with its error bounds.
"""

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Coordinates, Flags, Reals
from foparq.mesh.compiled import compiled
from foparq.mesh.determinants import MINOR, WORKSPACE, correction, determinant, load_plane, load_space, rounded, sign

Signs = NDArray[np.int8]

SMALLEST = 2.0**-300  #: least size of a coordinate that is not zero, about 5e-91
LARGEST = 2.0**300  #: greatest size of a coordinate, about 2e90

_EPSILON = 2.0**-53
_PLANE_A = (3.0 + 16.0 * _EPSILON) * _EPSILON
_SPACE_A = (7.0 + 56.0 * _EPSILON) * _EPSILON
_SPACE_B = (3.0 + 28.0 * _EPSILON) * _EPSILON
_SPACE_C = (26.0 + 288.0 * _EPSILON) * _EPSILON * _EPSILON
_RESULT = (3.0 + 8.0 * _EPSILON) * _EPSILON
#: more than underflow adds to a determinant in doubles of safe coordinates, which is below 2**-760
_UNDERFLOW = 1e-220


@compiled
def _orient3d_exact(p: Reals, a: int, b: int, c: int, d: int, size: float, w: Reals) -> int:
    """Sign that doubles left undecided; ``size`` is the sum of the sizes of all products."""
    rests = load_space(w, p, a, b, c, d)
    value = 0.0
    for with_rests in (False, True):
        begin, n = determinant(w, with_rests)
        if with_rests or not rests:
            return sign(w, begin, n)
        value = rounded(w, begin, n)
        if abs(value) < _SPACE_B * size + _UNDERFLOW:
            bound = _SPACE_C * size + _RESULT * abs(value) + _UNDERFLOW
            value += correction(w)
            if abs(value) < bound:
                continue
        break
    return 1 if value > 0.0 else -1


@compiled
def orient3d(p: Reals, a: int, b: int, c: int, d: int, w: Reals) -> int:
    """Side of the plane through a, b, c on which d lies: the exact sign of det[a - d, b - d, c - d].

    Parameters
    ----------
    p : (n, 3) float
        Points; safe coordinates.
    a, b, c, d : int
        Rows of p.
    w : (WORKSPACE,) float
        Workspace, one a thread.

    Returns
    -------
    int
        1 if a, b, c turn clockwise seen from d, -1 if counterclockwise, 0 if all lie in one plane.

    Notes
    -----
    O(1). Without error analysis for what underflows, but for a bound far above it.
    """
    adx, bdx, cdx = p[a, 0] - p[d, 0], p[b, 0] - p[d, 0], p[c, 0] - p[d, 0]
    ady, bdy, cdy = p[a, 1] - p[d, 1], p[b, 1] - p[d, 1], p[c, 1] - p[d, 1]
    adz, bdz, cdz = p[a, 2] - p[d, 2], p[b, 2] - p[d, 2], p[c, 2] - p[d, 2]
    bc, cb = bdx * cdy, cdx * bdy
    ca, ac = cdx * ady, adx * cdy
    ab, ba = adx * bdy, bdx * ady
    value = adz * (bc - cb) + bdz * (ca - ac) + cdz * (ab - ba)
    size = (abs(bc) + abs(cb)) * abs(adz) + (abs(ca) + abs(ac)) * abs(bdz) + (abs(ab) + abs(ba)) * abs(cdz)
    bound = _SPACE_A * size + _UNDERFLOW
    if value > bound:
        return 1
    if value < -bound:
        return -1
    # Products of safe differences do not vanish by underflow.
    if size == 0.0:
        return 0
    return _orient3d_exact(p, a, b, c, d, size, w)


@compiled
def orient2d(p: Reals, a: int, b: int, c: int, x: int, y: int, w: Reals) -> int:
    """Turn of the way a, b, c in a coordinate plane: the exact sign of det[a - c, b - c].

    Parameters
    ----------
    p : (n, 2) or (n, 3) float
        Points; safe coordinates.
    a, b, c : int
        Rows of p.
    x, y : int
        Columns of p.
    w : (WORKSPACE,) float
        Workspace, one a thread.

    Returns
    -------
    int
        1 counterclockwise, -1 clockwise, 0 on one line.
    """
    left = (p[a, x] - p[c, x]) * (p[b, y] - p[c, y])
    right = (p[a, y] - p[c, y]) * (p[b, x] - p[c, x])
    value, size = left - right, abs(left) + abs(right)
    bound = _PLANE_A * size + _UNDERFLOW
    if value > bound:
        return 1
    if value < -bound:
        return -1
    if size == 0.0:
        return 0
    return sign(w, MINOR, load_plane(w, p, a, b, c, x, y))


def safe(points: Reals) -> Flags:
    """Points (n,) whose coordinates are finite, and zero or of a size within `SMALLEST` ... `LARGEST`.

    Parameters
    ----------
    points : (n, d) float
    """
    size = np.abs(points)
    fits: Flags = ((size == 0) | ((size >= SMALLEST) & (size <= LARGEST))).all(axis=1)
    return fits


def orientation(*points: Coordinates) -> Signs:
    """Exact orientation of k triples in the plane or quadruples in space.

    Parameters
    ----------
    *points : three (k, 2) or four (k, 3) float
        Safe coordinates.

    Returns
    -------
    (k,) int8
        As `orient2d` and `orient3d` say.

    Raises
    ------
    ValueError
        If a coordinate is not finite, or neither zero nor within `SMALLEST` ... `LARGEST`.

    Examples
    --------
    >>> orientation(*(np.array([place]) for place in ([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]))).tolist()
    [1]
    """
    stacked = np.ascontiguousarray(np.stack(points, axis=1), dtype=np.float64)
    places = stacked.reshape(-1, stacked.shape[2])
    if not safe(places).all():
        raise ValueError("a coordinate is not finite, or too large or too small for exact signs")
    signs = np.empty(len(stacked), dtype=np.int8)
    _orientations(places, len(points), signs, np.empty(WORKSPACE))
    return signs


@compiled
def _orientations(p: Reals, corners: int, signs: Signs, w: Reals) -> None:
    for k in range(len(signs)):
        a = k * corners
        if corners == 4:  # noqa: PLR2004
            signs[k] = orient3d(p, a, a + 1, a + 2, a + 3, w)
        else:
            signs[k] = orient2d(p, a, a + 1, a + 2, 0, 1, w)
