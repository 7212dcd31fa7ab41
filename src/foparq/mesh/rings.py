# SPDX-License-Identifier: MIT
"""Edges joined at their ends, put in order.

Edge j has two ends, 2j and 2j + 1; dart d leaves end d and arrives at end ``d ^ 1``.
"""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index
from foparq.mesh.polygons import members


class Rings(NamedTuple):
    """Darts in order: loops and chains."""

    starts: Index  #: (k + 1,)
    darts: Index  #: (b,) one of every edge
    closed: Flags  #: (k,) True for a loop


def rings(mate: Index) -> Rings:
    """Loops and chains of edges.

    Parameters
    ----------
    mate : (2b,) int
        The end that each end is joined to, mutually; -1 for one that is free.

    Returns
    -------
    Rings
        A loop begins with the forward dart of its lowest edge. A chain begins at a free end, with a forward dart if
        either of its ends has one.

    Notes
    -----
    At a free end a dart turns back, so that all darts lie on cycles: a loop on two, a chain on one. Cycles are labelled
    and ranked by doubling the steps. O(b log l) for loops of up to l edges.
    """
    dart = np.arange(len(mate), dtype=np.intp)
    after = mate[dart ^ 1]
    after = np.where(after < 0, dart ^ 1, after)
    lowest, jump = dart, after
    while True:
        lower = np.minimum(lowest, lowest[jump])
        if np.array_equal(lower, lowest):
            break
        lowest, jump = lower, jump[jump]
    head = lowest.copy()
    free = np.flatnonzero(mate < 0)
    open_cycle = np.zeros(len(mate), dtype=bool)
    open_cycle[lowest[free]] = True
    # The last written stands: forward darts come before backward ones, low ones before high ones.
    free = free[np.lexsort((free, free % 2))][::-1]
    head[lowest[free]] = free
    head = head[lowest]
    kept = np.flatnonzero(open_cycle[lowest] | (lowest % 2 == 0))
    rank = _ranks(after, head, kept)
    size = np.bincount(head[kept], minlength=len(mate))[head[kept]]
    chain = open_cycle[lowest[kept]]
    # A chain is run there and back: the first half is the chain.
    half = np.flatnonzero(~chain | (2 * rank < size))
    kept, rank = kept[half], rank[half]
    size = np.bincount(head[kept], minlength=len(mate))
    heads = np.flatnonzero(size)
    starts = np.zeros(len(heads) + 1, dtype=np.intp)
    np.cumsum(size[heads], out=starts[1:])
    size[heads] = starts[:-1]
    darts = np.empty(len(kept), dtype=np.intp)
    darts[size[head[kept]] + rank] = kept
    return Rings(starts, darts, ~open_cycle[lowest[heads]])


def _ranks(after: Index, head: Index, kept: Index) -> Index:
    """Number of steps (k,) from the head of its cycle to each dart that is kept; whole cycles are."""
    place = np.empty(len(after), dtype=np.intp)
    place[kept] = np.arange(len(kept))
    before = np.empty(len(kept), dtype=np.intp)
    before[place[after[kept]]] = np.arange(len(kept))
    first = place[head[kept]]
    rank = np.ones(len(kept), dtype=np.intp)
    heads = first == np.arange(len(kept))
    before[heads], rank[heads] = np.flatnonzero(heads), 0
    while not np.array_equal(before, first):
        rank += rank[before]
        before = before[before]
    return rank


def simple(found: Rings, vertex: Index) -> Rings:
    """The same edges as loops and chains that pass every vertex at most once.

    Parameters
    ----------
    found : Rings
    vertex : (2b,) int
        Vertex of every end.

    Returns
    -------
    Rings
        In order of their lowest edges.
    """
    count = np.diff(found.starts)
    owner = np.repeat(np.arange(len(count)), count)
    ends = np.flatnonzero(~found.closed)
    passed = np.concatenate([vertex[found.darts], vertex[found.darts[found.starts[ends + 1] - 1] ^ 1]])
    owner = np.concatenate([owner, ends])
    often = np.flatnonzero(np.bincount(passed)[passed] > 1) if len(passed) else passed
    key = np.sort((owner[often].astype(np.uint64) << np.uint64(32)) | passed[often].astype(np.uint64))
    again = key[1:][key[1:] == key[:-1]]
    crossed = np.zeros(len(count), dtype=bool)
    crossed[(again >> np.uint64(32)).astype(np.intp)] = True
    kept = np.flatnonzero(~crossed)
    begin, member = members(found.starts, kept)
    darts, sizes, closed = [found.darts[member]], [np.diff(begin)], [found.closed[kept]]
    for row in np.flatnonzero(crossed).tolist():
        pieces = _cut(found.darts[found.starts[row] : found.starts[row + 1]], vertex)
        darts += pieces
        sizes.append(np.array([len(piece) for piece in pieces], dtype=np.intp))
        closed.append(np.array([vertex[piece[0]] == vertex[piece[-1] ^ 1] for piece in pieces]))
    return _in_order(np.concatenate(darts), np.concatenate(sizes), np.concatenate(closed))


def _in_order(darts: Index, sizes: Index, closed: Flags) -> Rings:
    """Loops and chains sorted by their lowest edges."""
    starts = np.zeros(len(sizes) + 1, dtype=np.intp)
    np.cumsum(sizes, out=starts[1:])
    lowest = np.minimum.reduceat(darts >> 1, starts[:-1]) if len(sizes) else sizes
    order = np.argsort(lowest, kind="stable")
    begin, member = members(starts, order)
    return Rings(begin, darts[member], closed[order])


def _cut(darts: Index, vertex: Index) -> list[Index]:
    """Loops cut off wherever a vertex is passed again, and what remains. A loop begins with its lowest edge."""
    path: list[int] = []
    place: dict[int, int] = {}
    pieces: list[Index] = []

    def cut(at: int) -> None:
        piece = np.array(path[at:], dtype=np.intp)
        for dart in path[at:]:
            del place[int(vertex[dart])]
        del path[at:]
        pieces.append(np.roll(piece, -int(piece.argmin())))

    for dart in darts.tolist():
        here = int(vertex[dart])
        if here in place:
            cut(place[here])
        place[here] = len(path)
        path.append(dart)
    end = int(vertex[path[-1] ^ 1])
    if end in place:
        cut(place[end])
    if path:
        pieces.append(np.array(path, dtype=np.intp))
    return pieces
