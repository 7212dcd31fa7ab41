# SPDX-License-Identifier: MIT
"""Rows of dashes: what is left of a line with a line type once somebody has exploded it."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.chains import NOBODY, in_chains
from foparq.geom.loose import LooseEnds
from foparq.geom.polylines import Segments
from foparq.geom.segments import cannot_meet, contacts
from foparq.geom.targets import Faced

_FEWEST = 5  #: dashes that make a row
_ALIKE = 0.2  #: share by which gaps, and dashes, of one row may differ
#: A dash is at most so many times as long as the gap beside it: ISO 128-2 has 24 against 3 at most, and another half.
_LONGEST = 12.0
_PERIODS = (1, 2, 3)  #: dashes after which a line type repeats itself: dashed, chain, double-dashed chain


class Dashes(NamedTuple):
    """Rows of dashes among some loose ends."""

    end: Index  #: (d,) ends that face the next dash
    faced: Index  #: (d,) the end that each faces
    gap: Reals  #: (d,) metres between them
    row: Index  #: (k,) row of each dash; rows are numbered without holes
    dash: Index  #: (k,) chain that the dash is


def dashes(ends: LooseEnds, pairs: Faced, beyond: Flags) -> Dashes:
    """Rows of at least five dashes that head for each other, alike but for the outermost, with equal gaps.

    Parameters
    ----------
    ends : LooseEnds, e rows
    pairs : Faced
        Rows of ``ends`` that face each other.
    beyond : (e,) bool
        Ends that go beyond what they meet.

    Notes
    -----
    O((e + s) log s + near pairs). Lengths may alternate in periods of two or three, as those of chain lines do, if at
    least two periods are seen. Gaps and lengths are alike if they differ by a fifth at most. Pieces with other linework
    between them do not head for each other. A row is none, but a line cut at bars that it should meet, if other
    linework lies in more than half of its gaps and meets fewer than half of its dashes, or if more than half of the
    ends at its gaps go beyond what they meet.
    """
    mate, gap = _mates(ends, pairs)
    length, line = ends.lines.length, np.arange(len(mate)) // 2
    apart = np.where(mate != NOBODY, np.maximum(length[line], length[line[mate]]), 0.0)
    _part(mate, apart > _LONGEST * gap + ends.lines.slack)
    label, _, _ = in_chains(mate)
    usual = _medians(label[line], np.where(mate != NOBODY, gap, np.nan))[label[line]]
    _part(mate, np.abs(gap - usual) > _ALIKE * usual)
    label, place, _ = in_chains(mate)
    order = np.lexsort((place, label))
    order = order[_in_rows(label[order], length[order])]
    slot = 2 * ends.line + ~ends.forward
    end_of = np.full(len(mate), NOBODY, dtype=np.intp)
    end_of[slot] = np.arange(len(ends))
    order = order[~_cut_at_others(ends, beyond, label, order, end_of, mate)[label[order]]]
    row = np.unique(label[order], return_inverse=True)[1].reshape(-1)
    among = np.zeros(len(ends.lines), dtype=bool)
    among[order] = True
    end = np.flatnonzero(among[ends.line] & (mate[slot] != NOBODY))
    return Dashes(end, end_of[mate[slot[end]]], gap[slot[end]], row, order)


def _cut_at_others(ends: LooseEnds, beyond: Flags, label: Index, chain: Index, end_of: Index, mate: Index) -> Flags:
    """True for each label of chains that other linework cuts, see :func:`dashes`."""
    asked = np.isin(np.arange(len(mate)) // 2, chain) & (mate > np.arange(len(mate)))
    one, two = end_of[np.flatnonzero(asked)], end_of[mate[asked]]
    gaps = Segments(ends.place[one], ends.place[two], ends.depth[one], ends.depth[two])
    held = _meets(ends, gaps, np.stack([ends.line[one], ends.line[two]], axis=1))
    lines, of, count = ends.lines, label[ends.line[one]], int(label.max(initial=-1)) + 1
    piece = np.flatnonzero(np.isin(lines.line, chain))
    crossed = np.zeros(len(lines), dtype=bool)
    crossed[lines.line[piece[_meets(ends, lines.segments(piece), lines.line[piece][:, None])]]] = True
    over = beyond[one].astype(float) + beyond[two]
    gap, dash = np.bincount(of, minlength=count), np.bincount(label[chain], minlength=count)
    met = np.bincount(label[chain], weights=crossed[chain], minlength=count)
    found: Flags = np.bincount(of, weights=over, minlength=count) > gap
    found |= (2 * np.bincount(of, weights=held, minlength=count) > gap) & (2 * met < dash)
    return found


def _meets(ends: LooseEnds, piece: Segments, own: Index) -> Flags:
    """True (k,) where a segment meets a chain that is not one of its own (k, any number)."""
    lines, met = ends.lines, np.zeros(len(own), dtype=bool)
    start, stop = piece.start @ lines.turn, piece.end @ lines.turn
    for row, segment in lines.tree.query(np.minimum(start, stop), np.maximum(start, stop), distance=ends.within):
        of = lines.line[segment]
        kept = np.flatnonzero(~ends.short[of] & np.all(of[:, None] != own[row], axis=1))
        kept = kept[~cannot_meet(piece.take(row[kept]), lines.segments(segment[kept]), within=ends.within)]
        found = contacts(piece.take(row[kept]), lines.segments(segment[kept]), within=ends.within)
        met[row[kept[found.meets.any(axis=0)]]] = True
    return met


def _mates(ends: LooseEnds, pairs: Faced) -> tuple[Index, Reals]:
    """The one end (2 c,) that each end of a chain heads for, and the gap; both are nearest to each other."""
    slot = 2 * ends.line + ~ends.forward
    rows = np.flatnonzero(pairs.straight & (ends.line[pairs.end] != ends.line[pairs.other]))
    one, two, apart = slot[pairs.end[rows]], slot[pairs.other[rows]], pairs.apart[rows]
    order = np.lexsort((apart, one))
    first = np.unique(one[order], return_index=True)[1]
    mate, gap = np.full(2 * len(ends.lines), NOBODY, dtype=np.intp), np.zeros(2 * len(ends.lines))
    mate[one[order[first]]], gap[one[order[first]]] = two[order[first]], apart[order[first]]
    asked = np.flatnonzero(mate != NOBODY)
    lonely = asked[mate[mate[asked]] != asked]
    mate[lonely] = NOBODY
    return mate, gap


def _part(mate: Index, which: Flags) -> None:
    """Let go of some mates, both ways."""
    rows = np.flatnonzero(which & (mate != NOBODY))
    mate[mate[rows]] = NOBODY
    mate[rows] = NOBODY


def _medians(label: Index, value: Reals) -> Reals:
    """Median of the numbers of each label; NaN if it has none."""
    order = np.lexsort((value, label))
    count = np.bincount(label, weights=np.isfinite(value)).astype(np.intp)
    begin = np.searchsorted(label[order], np.arange(len(count)))
    middle: Reals = np.where(count > 0, value[order[np.minimum(begin + count // 2, len(order) - 1)]], np.nan)
    return middle


def _in_rows(label: Index, length: Reals) -> Flags:
    """True (k,) for dashes, in order of rows, whose row is long enough and alike in some period."""
    count = np.bincount(label)[label]
    begin = np.searchsorted(label, label)
    place = np.arange(len(label)) - begin
    good = np.zeros(len(label), dtype=bool)
    for period in _PERIODS:
        there = np.flatnonzero((place > 0) & (place + period < count - 1))
        one, two = length[there], length[there + period]
        odd = np.abs(one - two) > _ALIKE * np.maximum(one, two)
        failed = np.bincount(label[there], weights=odd, minlength=int(label.max(initial=-1)) + 1) > 0
        good |= (count >= max(_FEWEST, 2 * period + 2)) & ~failed[label]
    return good
