# SPDX-License-Identifier: MIT
"""Pieces that touch each other, joined into places and stretches."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.polylines import Segments, summed
from foparq.geom.segments import contacts


class Stretches(NamedTuple):
    """Pieces of one group that touch, as one; g rows in order of groups."""

    label: Index  #: (k,) stretch of each piece
    first: Index  #: (g,) a piece of each stretch
    length: Reals  #: (g,) pieces summed, metres


def components(count: int, i: Index, j: Index) -> Index:
    """Labels (count,) of connected components, numbered in order of their first row."""
    from scipy.sparse import coo_array  # noqa: PLC0415 - slow to load, and not every drawing needs it
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    graph = coo_array((np.ones(len(i), dtype=np.int8), (i, j)), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    return in_order_of_first(label)


def in_order_of_first(label: Index) -> Index:
    """The same grouping (n,), numbered in order of first rows."""
    _, first, inverse = np.unique(label, return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.intp)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    ordered: Index = rank[inverse]
    return ordered


def join_pieces(group: Index, start: Reals, end: Reals, *, gap: float) -> Stretches:
    """Stretches of straight pieces.

    Parameters
    ----------
    group : (k,) int
        Only pieces of one group are joined.
    start, end : (k, 2) metres
        A piece without length is a point.
    gap : float, metres
        Pieces not farther apart than this touch.
    """
    if not len(group):
        nothing = np.empty(0, dtype=np.intp)
        return Stretches(nothing, nothing, np.empty(0))
    pieces = Segments(start, end, np.zeros(len(group)), np.zeros(len(group)))
    found: list[tuple[Index, Index]] = []
    for i, j in BoxTree(np.minimum(start, end), np.maximum(start, end)).pairs(distance=gap):
        same = group[i] == group[j]
        one, two = i[same], j[same]
        near = contacts(pieces.take(one), pieces.take(two), within=gap).meets.any(axis=0)
        found.append((one[near], two[near]))
    i, j = (
        (np.concatenate([group[:0], *column]) for column in zip(*found, strict=True))
        if found
        else (group[:0], group[:0])
    )
    label = components(len(group), i, j)
    _, first = np.unique(label, return_index=True)
    return Stretches(label, first, summed(label, np.hypot(*(end - start).T), len(first)))


def longest(label: Index, length: Reals, tie: Reals, place: Reals, *, slack: float) -> Index:
    """Row of the longest piece of each label.

    Parameters
    ----------
    label : (k,) int, 0 ... g - 1, each used
    length : (k,) metres
    tie : (k,) float
        Of pieces that are equally long but for rounding, the one with the least ``tie`` is taken.
    place : (k, 2) metres
        Of those that are equal in this too, the first by x, then y.
    slack : float, metres
        Greatest effect of rounding on a length.

    Returns
    -------
    (g,) int
    """
    most = np.zeros(int(label.max()) + 1 if len(label) else 0)
    np.maximum.at(most, label, length)
    shorter = length < most[label] - slack
    x, y, tie = (np.round(column / slack / 4) for column in (*place.T, tie))
    order = np.lexsort((y, x, tie, shorter, label))
    _, first = np.unique(label[order], return_index=True)
    chosen: Index = order[first]
    return chosen
