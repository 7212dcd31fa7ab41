# SPDX-License-Identifier: MIT
"""Orientation determinants, worked out exactly as expansions.

They lie in a workspace: differences of coordinates first, each as what rounding left out and the rounded difference,
then products and sums. Coordinates must be safe (`predicates.safe`).

Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, Discrete &
Computational Geometry 18 (1997).
"""

from foparq.columns import Reals
from foparq.mesh.compiled import compiled
from foparq.mesh.expansions import add, scale, two_difference

WORKSPACE = 570  #: doubles that the predicates work in
MINOR = 26  #: where minors of two rows lie in the workspace
#: where products of two, factors, and sums of up to 128 and 192 parts lie
_ONE, _SPARE, _LOW, _TERM, _EVEN, _ODD = 18, 42, 58, 122, 186, 378


@compiled
def sign(w: Reals, e: int, n: int) -> int:
    """Sign of an expansion.

    Parameters
    ----------
    w, e, n
        As in `expansions.add`.
    """
    if n == 0:
        return 0
    return 1 if w[e + n - 1] > 0.0 else -1


@compiled
def _load(w: Reals, k: int, a: float, b: float) -> None:
    """Write the difference number k, as a rest and a rounded difference."""
    w[2 * k + 1], w[2 * k] = two_difference(a, b)


@compiled
def _times(w: Reals, e: int, m: int, j: int, sign: float, rests: bool, h: int) -> int:  # noqa: FBT001
    """Write an expansion of at most 16 parts times a difference to h; at most 4 m parts."""
    low, n = 0, 0
    for k in range(0 if rests and w[2 * j] != 0.0 else 1, 2):
        low, n = n, scale(w, e, m, sign * w[2 * j + k], _LOW + 32 * k)
    return add(w, _LOW, low, _LOW + 32, n, h)


@compiled
def _minor(w: Reals, i: int, j: int, k: int, l: int, rests: bool, h: int) -> int:  # noqa: FBT001
    """Write the products of differences i j - k l to h; at most 16 parts."""
    count = 0
    for one, two, sign in ((i, j, 1.0), (k, l, -1.0)):
        begin = 2 * one if rests and w[2 * one] != 0.0 else 2 * one + 1
        m = _times(w, begin, 2 * one + 2 - begin, two, sign, rests, _ONE)
        if sign > 0.0:
            for part in range(m):
                w[_SPARE + part] = w[_ONE + part]
            count = m
        else:
            count = add(w, _SPARE, count, _ONE, m, h)
    return count


@compiled
def determinant(w: Reals, rests: bool) -> tuple[int, int]:  # noqa: FBT001
    """Determinant of the nine differences, exactly: where it begins, and its number of parts, at most 192."""
    total, count, following = _ODD, 0, _EVEN
    for k in range(3):
        one, two = 3 * ((k + 1) % 3), 3 * ((k + 2) % 3)
        m = _minor(w, one, two + 1, one + 1, two, rests, MINOR)
        n = _times(w, MINOR, m, 3 * k + 2, 1.0, rests, _TERM)
        count = add(w, total, count, _TERM, n, following)
        total, following = following, total
    return total, count


@compiled
def correction(w: Reals) -> float:
    """What the rests of the differences add to the determinant, to first order."""
    total = 0.0
    for row, one, two in ((0, 3, 6), (3, 6, 0), (6, 0, 3)):
        ax, ay, bx, by = w[2 * one + 1], w[2 * one + 3], w[2 * two + 1], w[2 * two + 3]
        change = (ax * w[2 * two + 2] + by * w[2 * one]) - (ay * w[2 * two] + bx * w[2 * one + 2])
        total += w[2 * row + 5] * change + w[2 * row + 4] * (ax * by - ay * bx)
    return total


@compiled
def load_space(w: Reals, p: Reals, a: int, b: int, c: int, d: int) -> bool:
    """Write the differences of three points to d, row by row; whether rounding left anything out."""
    rests = False
    for axis in range(3):
        _load(w, axis, p[a, axis], p[d, axis])
        _load(w, 3 + axis, p[b, axis], p[d, axis])
        _load(w, 6 + axis, p[c, axis], p[d, axis])
    for k in range(9):
        rests |= w[2 * k] != 0.0
    return rests


@compiled
def load_plane(w: Reals, p: Reals, a: int, b: int, c: int, x: int, y: int) -> int:
    """Write the determinant of three points of a coordinate plane to `MINOR`; its number of parts."""
    _load(w, 0, p[a, x], p[c, x])
    _load(w, 1, p[a, y], p[c, y])
    _load(w, 2, p[b, x], p[c, x])
    _load(w, 3, p[b, y], p[c, y])
    return _minor(w, 0, 3, 1, 2, True, MINOR)


@compiled
def rounded(w: Reals, e: int, n: int) -> float:
    """Value of an expansion, but for rounding."""
    total = 0.0
    for k in range(n):
        total += w[e + k]
    return total


@compiled
def volume(p: Reals, a: int, b: int, c: int, d: int, w: Reals) -> float:
    """Six times the volume of a tetrahedron, with the sign of `orient3d`, correct to the last bits of the result.

    Parameters
    ----------
    p, a, b, c, d, w
        As in `orient3d`.
    """
    begin, n = determinant(w, load_space(w, p, a, b, c, d))
    return rounded(w, begin, n)


@compiled
def area(p: Reals, a: int, b: int, c: int, x: int, y: int, w: Reals) -> float:
    """Twice the area of a triangle in a coordinate plane, with the sign of `orient2d`, correct to the last bits.

    Parameters
    ----------
    p, a, b, c, x, y, w
        As in `orient2d`.
    """
    return rounded(w, MINOR, load_plane(w, p, a, b, c, x, y))
