# SPDX-License-Identifier: MIT
"""Convex hulls of groups of geometries, and which of them lie within others."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals

_FIRST = 1000  #: hulls of the first step
_FEW = 30  #: of the first step where each is compared with each
#: Overlap over union of hulls that stand in one place. Two windows cannot.
_SAME = 0.9
_SLANT = 0.25  #: share of its box by which a hull may differ from one that it overlaps so far


def hulls_of(geometry: Geometries, label: Index) -> Geometries:
    """Convex hull of each label.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None
    label : (n,) int
        0, 1, 2 ... without gaps.

    Returns
    -------
    (k,) shapely geometries
        Points and lines where a group has no width; empty where it has no vertex. Vertices that are not finite are
        passed over.
    """
    if not len(geometry):
        return geometry
    coordinates, row = shapely.get_coordinates(geometry, return_index=True)
    finite = np.isfinite(coordinates).all(axis=1)
    coordinates, row = coordinates[finite], row[finite]
    order = np.argsort(label[row], kind="stable")
    crowds = np.full(int(label.max()) + 1, shapely.MultiPoint(), dtype=object)
    shapely.multipoints(shapely.points(coordinates[order]), indices=label[row][order], out=crowds)
    hulls: Geometries = shapely.convex_hull(crowds)
    return hulls


def across(geometry: Geometries) -> Reals:
    """Diagonals (n,) of the boxes around geometries."""
    bounds = shapely.bounds(geometry).reshape(-1, 4)
    diagonal: Reals = np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1])
    return diagonal


def outermost(hulls: Geometries, group: Index) -> Flags:
    """Hulls that lie within no other hull of their group.

    Parameters
    ----------
    hulls : (n,) convex shapely geometries
    group : (n,) int

    Returns
    -------
    (n,) bool
        Of equal hulls of one group, one is true; of empty ones, none.

    Notes
    -----
    O(n log n + near pairs). Does not look at hulls that overlap in part.
    """
    kept = np.zeros(len(hulls), dtype=bool)
    if not len(hulls):
        return kept
    order = np.lexsort([-shapely.length(hulls), -shapely.area(hulls)])
    order = order[~shapely.is_empty(hulls[order])]
    _, first = np.unique(_keys(hulls, group)[order], return_index=True)
    order = order[np.sort(first)]
    # Containment is transitive and what contains is larger: it is enough to ask the large ones that were kept. Steps
    # grow with what was kept, so that the tree is built a few times only.
    start, step = 0, _FIRST
    while start < len(order):
        block = order[start : start + step]
        roots = np.flatnonzero(kept)
        block = block[~_covered(hulls, group, block, roots)]
        kept[block[~_covered(hulls, group, block, block)]] = True
        start = step = start + step
    return kept


def _covered(hulls: Geometries, group: Index, inner: Index, outer: Index) -> Flags:
    i, j = shapely.STRtree(hulls[outer]).query(hulls[inner], predicate="covered_by")
    other = (group[inner[i]] == group[outer[j]]) & (inner[i] != outer[j])
    covered = np.zeros(len(inner), dtype=bool)
    covered[i[other]] = True
    return covered


def _keys(hulls: Geometries, group: Index) -> Index:
    """(n,) equal for equal hulls of one group."""
    texts = shapely.to_wkb(shapely.normalize(hulls)).tolist()
    numbers: dict[tuple[int, bytes], int] = {}
    keys = [numbers.setdefault(key, len(numbers)) for key in zip(group.tolist(), texts, strict=True)]
    return np.array(keys, dtype=np.intp)


def leaders(hulls: Geometries, group: Index, *, gap: float = 0.0) -> Index:
    """Hull in whose place each hull stands.

    Two hulls stand in one place if what they share is at least nine tenths of what they cover together, or if they are
    nowhere farther apart than ``gap``.

    Parameters
    ----------
    hulls : (n,) convex shapely geometries
    group : (n,) int
        Only hulls of one group are compared.
    gap : float, metres

    Returns
    -------
    (n,) int
        Row of the largest hull in that place, which leads itself; of equal ones the first. An empty hull leads itself.

    Notes
    -----
    Hulls are taken from the largest down, and each follows the first leader that stands in its place: a chain of hulls
    of which each overlaps the next is not one place. O(n log n + near pairs).
    """
    lead: Index = np.arange(len(hulls))
    if not len(hulls):
        return lead
    order = _largest_first(hulls)
    _, first, same = np.unique(_keys(hulls, group), return_index=True, return_inverse=True)
    lead = first[same.reshape(-1)]
    waiting = order[(lead[order] == order) & ~shapely.is_empty(hulls[order])]
    kept = np.empty(0, dtype=np.intp)
    start, step = 0, _FEW
    while start < len(waiting):
        # A small step first: of a crowd in one place all but a few are asked against their leader only.
        block, start, step = waiting[start : start + step], start + step, min(2 * step, _FIRST)
        for one, other in zip(*_one_place(hulls, group, block, kept, gap), strict=True):
            if lead[one] == one:
                lead[one] = other
        block = block[lead[block] == block]
        for one, other in zip(*_one_place(hulls, group, block, block, gap), strict=True):
            if lead[one] == one and lead[other] == other:
                lead[one] = other
        kept = np.concatenate([kept, block[lead[block] == block]])
    return lead[lead]


def _largest_first(hulls: Geometries) -> Index:
    bounds = np.nan_to_num(shapely.bounds(hulls).reshape(-1, 4))
    order: Index = np.lexsort([*bounds.T, -shapely.length(hulls), -shapely.area(hulls)])
    return order


def _one_place(hulls: Geometries, group: Index, some: Index, others: Index, gap: float) -> tuple[list[int], list[int]]:
    """Pairs of hulls in one place, ordered by both; of a hull with itself or a later one of ``some``, none."""
    i, j = shapely.STRtree(hulls[others]).query(hulls[some], predicate="dwithin", distance=gap)
    order = np.lexsort((j, i))
    i, j = i[order], j[order]
    if some is others:
        i, j = i[j < i], j[j < i]
    one, other = some[i], others[j]
    box, size = shapely.bounds(hulls).reshape(-1, 4), across(hulls)
    near = np.abs(box[one] - box[other]).max(axis=1, initial=0.0) <= np.maximum(gap, _SLANT * size[one])
    near &= group[one] == group[other]
    one, other = one[near], other[near]
    common = shapely.area(shapely.intersection(hulls[one], hulls[other]))
    both = shapely.area(hulls[one]) + shapely.area(hulls[other]) - common
    same = (both > 0) & (common >= _SAME * both)
    rest = np.flatnonzero(~same)
    same[rest] = shapely.hausdorff_distance(hulls[one[rest]], hulls[other[rest]]) <= gap
    return one[same].tolist(), other[same].tolist()


def larger_neighbours(hulls: Geometries, *, within: Reals) -> tuple[Index, Index]:
    """Pairs of a hull and a larger one near it.

    Parameters
    ----------
    hulls : (n,) convex shapely geometries
    within : (n,) float, metres
        How far around each hull smaller ones are looked for.

    Returns
    -------
    smaller, larger : (k,) int
        Of equal hulls one counts as the larger.
    """
    rank = np.empty(len(hulls), dtype=np.intp)
    rank[_largest_first(hulls)] = np.arange(len(hulls))
    larger, smaller = shapely.STRtree(hulls).query(hulls, predicate="dwithin", distance=within)
    falls = rank[smaller] > rank[larger]
    return smaller[falls], larger[falls]


def share_within(inner: Geometries, outer: Geometries) -> Reals:
    """Share (n,) of each hull that lies within another: of its area, or of its length where it has none."""
    common = shapely.intersection(inner, outer)
    flat = shapely.area(inner) <= 0
    part = np.where(flat, shapely.length(common), shapely.area(common))
    whole = np.where(flat, shapely.length(inner), shapely.area(inner))
    share: Reals = part / np.where(whole > 0, whole, 1.0)
    return share
