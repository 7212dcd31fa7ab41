# SPDX-License-Identifier: MIT
"""Whole lines drawn more than once."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import last_not_above, ragged
from foparq.geom.segments import at_share, nearest_share
from foparq.geom.stretches import components

#: pairs of lines, or places of them, compared in one step
_CHUNK = 2**20
#: cells of rounding from the origin, within what an integer holds
_FAR = 2.0**62
_WAITING, _FOUND, _DONE = 0, 1, 2
#: odd numbers that mix bits well (splitmix64, MurmurHash3)
_FACTORS = (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)


class _Alignments(NamedTuple):
    """Ways to lay one line on another, k rows."""

    pair: Index  #: (k,)
    start: Reals  #: (k,) place on the second line where the first begins, length along it
    vertex: Index  #: (k,) the vertex there; -1 if there is none
    sign: Index  #: (k,) 1 in the same direction, -1 backwards


def duplicate_groups(lines: Polylines, *, coincide: float, apart: Index | None = None) -> Index:
    """Groups of lines of the same shape.

    Two lines have the same shape if, followed from end to end, in the same direction or one of them backwards, they are
    nowhere farther apart than ``coincide``, in the plane and in depth: vertex by vertex if they have as many, or else
    at every same share of their lengths. Rings may start anywhere. It follows that both pass equally often.

    Parameters
    ----------
    lines : Polylines, n lines
    coincide : float, metres
        Distance up to which two places are one.
    apart : (n,) int, optional
        Lines with different numbers are not compared.

    Returns
    -------
    (n,) int
        Group of each line: connected components of "same shape", numbered in order of first lines.

    Notes
    -----
    Lines are compared only if the corners of their boxes are near. Within a group of candidates every newly found
    member is compared with those not yet found: a hundred thousand copies cost one round. O(n log n) for lines of
    different boxes. Additional vertices on a straight piece change nothing.
    """
    if apart is None or not len(apart) or (apart == apart[0]).all():
        apart = np.zeros(len(lines), dtype=np.intp)
    key = ("duplicates", coincide, apart.tobytes() if apart.any() else b"")
    return lines.kept(key, lambda: _groups(lines, apart, coincide + lines.slack))


def _groups(lines: Polylines, apart: Index, within: float) -> Index:
    # Lines equal but for rounding speak once, by their first.
    speaker = _equal_but_for_rounding(lines, apart)
    near = np.unique(np.stack([_candidates(lines, within), apart]), axis=1, return_inverse=True)[1].ravel()
    label = np.where(speaker == np.arange(len(lines)), near, -1)
    crowded = np.flatnonzero((label >= 0) & (np.bincount(label + 1)[label + 1] > 1))
    members = crowded[np.argsort(label[crowded], kind="stable")]
    _, crowd = np.unique(label[members], return_inverse=True)
    i, j = _same_shapes(lines, members, crowd, within)
    return components(len(lines), np.concatenate([i, speaker]), np.concatenate([j, np.arange(len(lines))]))


def _equal_but_for_rounding(lines: Polylines, apart: Index) -> Index:
    """First line (n,) that has the same vertices in the same order; often the line itself."""
    grid = 4 * lines.slack
    rounded = np.round(np.column_stack([lines.plane, lines.depth]) / grid)
    cells = np.clip(rounded, -_FAR, _FAR).astype(np.int64)
    place = np.arange(len(rounded)) - np.repeat(lines.heads, np.diff(lines.offsets))
    number = np.zeros(len(rounded), dtype=np.uint64)
    for column, factor in zip(cells.T, _FACTORS, strict=True):
        number = (number ^ column.astype(np.uint64)) * np.uint64(factor)
        number ^= number >> np.uint64(29)
    number *= place.astype(np.uint64) * np.uint64(2) + np.uint64(1)
    total = np.concatenate([np.zeros(1, dtype=np.uint64), np.cumsum(number, dtype=np.uint64)])
    size = np.diff(lines.offsets)
    named = total[lines.offsets[1:]] - total[lines.offsets[:-1]]
    name = np.column_stack([named, size.astype(np.uint64), apart.astype(np.uint64)])
    _, first, inverse = np.unique(name, axis=0, return_index=True, return_inverse=True)
    leader = first[inverse.ravel()]
    # Equal names are a hint; the vertices decide.
    differs = size != size[leader]
    owner, vertex = ragged(lines.offsets[:-1], np.where(differs, 0, size))
    partner = vertex - lines.offsets[owner] + lines.offsets[leader[owner]]
    differs[owner[np.any(rounded[vertex] != rounded[partner], axis=1)]] = True
    return np.where(differs, np.arange(len(lines)), leader)


def _candidates(lines: Polylines, within: float) -> Index:
    """Labels (n,): lines with the same box, but for ``within``, have the same label; others may have."""
    n = len(lines)
    drawn = np.flatnonzero(np.diff(lines.offsets) > 0)
    label = np.arange(n)
    if len(drawn) < 2:  # noqa: PLR2004 - a pair
        return label
    heads = lines.offsets[:-1][drawn]
    box = np.hstack([np.minimum.reduceat(lines.plane, heads), np.maximum.reduceat(lines.plane, heads)])
    # Boxes in one cell are near; of a crowd in one cell one speaks for all.
    cell = np.floor(box / within)
    _, first, inverse = np.unique(cell, axis=0, return_index=True, return_inverse=True)
    centre = cell[first]
    # Two boxes within one unit of each other lie in the same or in touching cells.
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load

    touching = cKDTree(centre).query_pairs(1.5, p=np.inf, output_type="ndarray")
    joined = components(len(first), touching[:, 0], touching[:, 1])[inverse]
    label[drawn] = n + joined
    return label


def _same_shapes(lines: Polylines, members: Index, crowd: Index, within: float) -> tuple[Index, Index]:
    """Pairs of lines of the same shape, enough to connect every group.

    ``members`` are lines ordered by their ``crowd``. In every round the lines found last, or the first line of a crowd
    in which nobody speaks, are compared with those of their crowd that still wait.
    """
    state = np.full(len(members), _WAITING, dtype=np.int8)
    found: list[tuple[Index, Index]] = [(members[:0], members[:0])]
    while (waiting := np.flatnonzero(state == _WAITING)).size:
        queue = np.bincount(crowd[waiting], minlength=int(crowd[-1]) + 1)
        speakers = np.flatnonzero((state == _FOUND) & (queue[crowd] > 0))
        silent = np.ones(len(queue), dtype=bool)
        silent[crowd[speakers]] = False
        starters = waiting[silent[crowd[waiting]]]
        _, first = np.unique(crowd[starters], return_index=True)
        begun = starters[first]
        state[begun] = _DONE
        queue[crowd[begun]] -= 1
        waiting = np.flatnonzero(state == _WAITING)
        speakers = np.concatenate([begun, speakers])
        speakers = speakers[: max(len(begun), 1, int(np.searchsorted(np.cumsum(queue[crowd[speakers]]), _CHUNK)))]
        state[speakers] = _DONE
        offsets = np.concatenate([[0], np.cumsum(queue)])
        owner, at = ragged(offsets[crowd[speakers]], queue[crowd[speakers]])
        one, two = speakers[owner], waiting[at]
        same = np.concatenate([np.zeros(0, dtype=bool)] + [
            _same_shape(lines, members[one[k : k + _CHUNK // 16]], members[two[k : k + _CHUNK // 16]], within)
            for k in range(0, len(one), _CHUNK // 16)
        ])  # fmt: skip
        state[two[same]] = _FOUND
        found.append((members[one[same]], members[two[same]]))
    i, j = (np.concatenate(column) for column in zip(*found, strict=True))
    return i, j


def _same_shape(lines: Polylines, one: Index, two: Index, within: float) -> Flags:
    """True (k,) where two lines have the same shape."""
    ring = (lines.opening[one] <= within) & (lines.opening[two] <= within)
    same = np.zeros(len(one), dtype=bool)
    for ways in (_ends_on_ends(lines, one, two, ~ring, within), _starts_in_rings(lines, one, two, ring, within)):
        todo = ways
        for test in (_by_vertex, _by_share):
            left = ~same[todo.pair]
            todo = _Alignments(todo.pair[left], todo.start[left], todo.vertex[left], todo.sign[left])
            same[todo.pair[test(lines, one[todo.pair], two[todo.pair], todo, within)]] = True
    return same


def _ends_on_ends(lines: Polylines, one: Index, two: Index, wanted: Flags, within: float) -> _Alignments:
    pair = np.flatnonzero(wanted)
    found = []
    for sign, start, end in ((1, lines.heads, lines.tails), (-1, lines.tails, lines.heads)):
        meets = _meet(lines, lines.heads[one[pair]], start[two[pair]], within)
        meets &= _meet(lines, lines.tails[one[pair]], end[two[pair]], within)
        kept = pair[meets]
        vertex = start[two[kept]]
        found.append(_Alignments(kept, lines.along[vertex], vertex, np.full(len(kept), sign)))
    return _Alignments(*(np.concatenate(columns) for columns in zip(*found, strict=True)))


def _starts_in_rings(lines: Polylines, one: Index, two: Index, wanted: Flags, within: float) -> _Alignments:
    """Where the first ring may begin on the second: at its vertices, at its nearest places, and the other way round."""
    pair = np.flatnonzero(wanted)
    owner, vertex = ragged(lines.heads[two[pair]], np.diff(lines.offsets)[two[pair]] - 1)
    at_vertex = _meet(lines, lines.heads[one[pair[owner]]], vertex, within)
    starts = [(pair[owner[at_vertex]], lines.along[vertex[at_vertex]], vertex[at_vertex])]
    owner, place = _places_of_head(lines, one[pair], two[pair], within)
    starts.append((pair[owner], place, np.full(len(owner), -1)))
    found = [_Alignments(*start, np.full(len(start[0]), sign)) for start in starts for sign in (1, -1)]
    owner, place = _places_of_head(lines, two[pair], one[pair], within)
    share = place / np.maximum(lines.length[one[pair[owner]]], lines.slack)
    for sign in (1, -1):
        start = np.mod(-sign * share, 1.0) * lines.length[two[pair[owner]]]
        found.append(_Alignments(pair[owner], start, np.full(len(owner), -1), np.full(len(owner), sign)))
    return _Alignments(*(np.concatenate(columns) for columns in zip(*found, strict=True)))


def _places_of_head(lines: Polylines, one: Index, two: Index, within: float) -> tuple[Index, Reals]:
    """Places along ``two`` that are near the first vertex of ``one``: row of the pair, length along the line."""
    owner, segment = ragged(lines.segment_offsets[two], np.diff(lines.segment_offsets)[two])
    point = lines.plane[lines.heads[one[owner]]]
    part = lines.segments(segment)
    share = nearest_share(point, part.start, part.end)
    near = np.hypot(*(at_share(share, part.start, part.end) - point).T) <= within
    return owner[near], (lines.along[lines.first[segment]] + share * lines.step[segment])[near]


def _by_vertex(lines: Polylines, one: Index, two: Index, ways: _Alignments, within: float) -> Flags:
    """True where both lines have as many vertices, each near its partner."""
    count = np.diff(lines.offsets)
    fits: Flags = (ways.vertex >= 0) & (count[one] == count[two])
    rows = np.flatnonzero(fits)
    owner, vertex = ragged(lines.heads[one[rows]], count[one[rows]])
    owner = rows[owner]
    step = (vertex - lines.heads[one[owner]]) * ways.sign[owner]
    head, vertices = lines.heads[two[owner]], count[two[owner]]
    partner = ways.vertex[owner] + step
    # In a ring the closing vertex is the first again: the count runs over all but one.
    inside = (partner >= head) & (partner < head + vertices)
    partner = np.where(inside, partner, head + np.mod(partner - head, np.maximum(vertices - 1, 1)))
    fits[owner[~_meet(lines, vertex, partner, within)]] = False
    return fits


def _by_share(lines: Polylines, one: Index, two: Index, ways: _Alignments, within: float) -> Flags:
    """True where places at the same share of the lengths are near; the farthest lie at a vertex of either."""
    fits = np.ones(len(ways.pair), dtype=bool)
    count = np.diff(lines.offsets)
    size = [np.maximum(lines.length[line], lines.slack) for line in (one, two)]
    begin = ways.start / size[1]
    owner, vertex = ragged(lines.heads[one], count[one])
    share = begin[owner] + ways.sign[owner] * lines.along[vertex] / size[0][owner]
    fits[owner[~_near_place(lines, vertex, two[owner], share * size[1][owner], within)]] = False
    owner, vertex = ragged(lines.heads[two], np.where(fits, count[two], 0))
    share = ways.sign[owner] * (lines.along[vertex] / size[1][owner] - begin[owner])
    fits[owner[~_near_place(lines, vertex, one[owner], share * size[0][owner], within)]] = False
    return fits


def _near_place(lines: Polylines, vertex: Index, line: Index, place: Reals, within: float) -> Flags:
    """True where a vertex is near a place of a line, given as length along it; rings are followed round."""
    length = lines.length[line]
    outside = (place < -lines.slack) | (place > length + lines.slack)
    place = np.clip(np.where(outside, np.mod(place, np.maximum(length, lines.slack)), place), 0.0, length)
    at = last_not_above(lines.along, lines.heads[line], lines.tails[line], place)
    part_end = at + 1
    step = lines.along[part_end] - lines.along[at]
    share = np.clip((place - lines.along[at]) / np.where(step > 0, step, 1.0), 0.0, 1.0)
    gap = at_share(share, lines.plane[at], lines.plane[part_end]) - lines.plane[vertex]
    drop = at_share(share, lines.depth[at], lines.depth[part_end]) - lines.depth[vertex]
    near: Flags = (np.hypot(*gap.T) <= within) & (np.abs(drop) <= within)
    return near


def _meet(lines: Polylines, one: Index, two: Index, within: float) -> Flags:
    """True where two vertices are near in the plane and in depth."""
    flat = np.hypot(*(lines.plane[one] - lines.plane[two]).T)
    near: Flags = (flat <= within) & (np.abs(lines.depth[one] - lines.depth[two]) <= within)
    return near
