# SPDX-License-Identifier: MIT
"""Exact sums and products of doubles, as expansions.

An expansion is a number written as a sum of doubles that do not overlap, smallest first, without zeros. Its sign is
that of its last part; the number zero has none. Expansions lie in a workspace ``w`` and are named by where they begin
and how many parts they have, so that nothing is allocated.

Everything here is exact as long as nothing over- or underflows; `predicates` says which coordinates are safe.

Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, Discrete &
Computational Geometry 18 (1997); T. J. Dekker, A floating-point technique for extending the available precision,
Numerische Mathematik 18 (1971).
"""

from foparq.columns import Reals
from foparq.mesh.compiled import compiled

_SPLITTER = 134217729.0  # 2**27 + 1: halves the 53 bits of a double


@compiled
def two_sum(a: float, b: float) -> tuple[float, float]:
    """Rounded sum, and what rounding left out (Knuth)."""
    total = a + b
    virtual = total - a
    return total, (a - (total - virtual)) + (b - virtual)


@compiled
def two_difference(a: float, b: float) -> tuple[float, float]:
    """Rounded difference, and what rounding left out."""
    gap = a - b
    virtual = a - gap
    return gap, (a - (gap + virtual)) + (virtual - b)


@compiled
def two_product(a: float, b: float) -> tuple[float, float]:
    """Rounded product, and what rounding left out (Dekker and Veltkamp)."""
    product = a * b
    wide = _SPLITTER * a
    a_high = wide - (wide - a)
    a_low = a - a_high
    wide = _SPLITTER * b
    b_high = wide - (wide - b)
    b_low = b - b_high
    rest = product - a_high * b_high
    rest -= a_low * b_high
    rest -= a_high * b_low
    return product, a_low * b_low - rest


@compiled
def add(w: Reals, e: int, m: int, f: int, n: int, h: int) -> int:
    """Write e + f to h; the number of its parts, at most m + n.

    Parameters
    ----------
    w : (s,) float
        Workspace; the result must not overlap e or f.
    e, m, f, n : int
        Expansions: where they begin and how many parts they have.
    h : int
        Where the result begins.

    Notes
    -----
    O(m + n): parts are merged by size and summed from the smallest.
    """
    i, j, count = 0, 0, 0
    total = 0.0
    for k in range(m + n):
        if j == n or (i < m and abs(w[e + i]) < abs(w[f + j])):
            part = w[e + i]
            i += 1
        else:
            part = w[f + j]
            j += 1
        if k == 0:
            total = part
            continue
        total, rest = two_sum(total, part)
        if rest != 0.0:
            w[h + count] = rest
            count += 1
    if total != 0.0:
        w[h + count] = total
        count += 1
    return count


@compiled
def scale(w: Reals, e: int, m: int, factor: float, h: int) -> int:
    """Write factor * e to h; the number of its parts, at most 2 m.

    Parameters
    ----------
    w, e, m, h
        As in `add`.
    factor : float
    """
    if m == 0 or factor == 0.0:
        return 0
    count = 0
    total, rest = two_product(w[e], factor)
    if rest != 0.0:
        w[h] = rest
        count = 1
    for i in range(1, m):
        high, low = two_product(w[e + i], factor)
        total, rest = two_sum(total, low)
        if rest != 0.0:
            w[h + count] = rest
            count += 1
        # |high| >= |total| here (Shewchuk, theorem 19); a full sum costs little and needs no proof.
        total, rest = two_sum(high, total)
        if rest != 0.0:
            w[h + count] = rest
            count += 1
    if total != 0.0:
        w[h + count] = total
        count += 1
    return count
