# SPDX-License-Identifier: MIT
"""Places where a line crosses, touches or retraces itself."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.leaving import leaving
from foparq.geom.pairs import own_meetings
from foparq.geom.polylines import Polylines, Segments
from foparq.geom.segments import ALONG, Contacts, at_share, contacts, shared
from foparq.geom.stretches import join_pieces, longest


class SelfMeetings(NamedTuple):
    """Places where a line meets itself, k rows in order of lines."""

    line: Index  #: (k,)
    start: Reals  #: (k, 2) the place, or the start of the longest retraced piece, from the origin of the lines
    end: Reals  #: (k, 2) the same place, or the end of that piece
    loop: Reals  #: (k,) metres along the line between the two passes


class _Pieces(NamedTuple):
    """Single meetings: points, or pieces run along twice."""

    line: Index
    start: Reals
    end: Reals
    loop: Reals


def self_meetings(lines: Polylines, *, coincide: float) -> SelfMeetings:
    """Places where two segments of one line cross, touch, or run along each other.

    Parameters
    ----------
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    SelfMeetings
        Meetings of one line nearer than twice ``coincide`` are one place. ``loop`` is the longest way along the line
        between two passes of the place; in a ring the shorter way round counts.

    Notes
    -----
    Two segments are *joined* if the line between them stays within ``coincide`` of the end of the first, or of the
    start of the second: neighbours, neighbours but for repeated vertices, and the two segments at the closing point of
    a ring. Joined segments are at
    fault only if they run along each other for more than ``coincide`` (a kickback). O(s log s + meetings).
    """
    within = coincide + lines.slack
    i, j = own_meetings(lines, coincide=coincide)
    joined = _joined(lines, i, j, within)
    back = _turning_back(lines, within)
    retraced = _retraced(lines, np.concatenate([i, back]), np.concatenate([j, back + 1]), within)
    points = _touched(lines, i[~joined], j[~joined], within)
    pieces = _Pieces(*(np.concatenate(columns) for columns in zip(points, retraced, strict=True)))

    touching = join_pieces(pieces.line, pieces.start, pieces.end, gap=2 * within)
    length = np.hypot(*(pieces.end - pieces.start).T)
    loop = np.zeros(len(touching.first))
    np.maximum.at(loop, touching.label, pieces.loop)
    row = longest(touching.label, length, -pieces.loop, pieces.start / 2 + pieces.end / 2, slack=lines.slack)
    return SelfMeetings(pieces.line[row], pieces.start[row], pieces.end[row], loop)


def _joined(lines: Polylines, i: Index, j: Index, within: float) -> Flags:
    """True where the line between segments i < j of one line stays within a circle, either way round in a ring."""
    end, start = lines.first[i] + 1, lines.first[j]
    joined = lines.along[start] - lines.along[end] <= within
    doubtful = np.flatnonzero(~joined & _near(lines, end, start, within))
    forth = leaving(lines, end[doubtful], np.ones(len(doubtful), dtype=bool), radius=within)
    back = leaving(lines, start[doubtful], np.zeros(len(doubtful), dtype=bool), radius=within)
    joined[doubtful] = (forth > start[doubtful]) | (back < end[doubtful])

    line = lines.line[i]
    before, after = lines.first[i], lines.first[j] + 1
    around = lines.along[before] + lines.length[line] - lines.along[after]
    closed = lines.opening[line] <= within
    rounded = closed & (around <= within)
    doubtful = np.flatnonzero(closed & ~rounded & _near(lines, before, after, within))
    forth = leaving(lines, after[doubtful], np.ones(len(doubtful), dtype=bool), radius=within)
    back = leaving(lines, before[doubtful], np.zeros(len(doubtful), dtype=bool), radius=within)
    # Rows beyond the line mean that it never left.
    rounded[doubtful] = (forth > lines.tails[line[doubtful]]) & (back < lines.heads[line[doubtful]])
    return joined | rounded


def _near(lines: Polylines, one: Index, two: Index, within: float) -> Flags:
    near: Flags = np.hypot(*(lines.plane[two] - lines.plane[one]).T) <= within
    return near


def _turning_back(lines: Polylines, within: float) -> Index:
    """Segments (k,) after which the line turns back on itself, nearly; a rejection before the exact test."""
    i = np.flatnonzero(lines.line[:-1] == lines.line[1:])
    one, two = lines.segments(i), lines.segments(i + 1)
    turn = np.einsum("ij,ij->i", one.end - one.start, two.end - two.start)
    back = turn < -ALONG * lines.step[i] * lines.step[i + 1] + lines.slack**2
    kept: Index = i[back & (np.minimum(lines.step[i], lines.step[i + 1]) > within)]
    return kept


def _retraced(lines: Polylines, i: Index, j: Index, within: float) -> _Pieces:
    run = shared(lines.segments(i), lines.segments(j), within=within)
    kept = np.flatnonzero(run.length > within)
    i, j = i[kept], j[kept]
    # From the middle of the piece on one pass to its middle on the other.
    middle = (run.start[kept] + run.end[kept]) / 2
    place = [lines.along[lines.first[s]] + np.hypot(*(middle - lines.plane[lines.first[s]]).T) for s in (i, j)]
    return _Pieces(
        lines.line[i], run.start[kept], run.end[kept], _loop(lines, lines.line[i], place[0], place[1], within)
    )


def _touched(lines: Polylines, i: Index, j: Index, within: float) -> _Pieces:
    one, two = lines.segments(i), lines.segments(j)
    found = contacts(one, two, within=within)
    which = _best_contact(found, one, two, lines.slack)
    pick = np.arange(len(i))
    on_one, on_two = found.on_a[which, pick], found.on_b[which, pick]
    place = (at_share(on_one, one.start, one.end) + at_share(on_two, two.start, two.end)) / 2
    run = [lines.along[lines.first[s]] + share * lines.step[s] for s, share in ((i, on_one), (j, on_two))]
    return _Pieces(lines.line[i], place, place, _loop(lines, lines.line[i], run[0], run[1], within))


def _best_contact(found: Contacts, one: Segments, two: Segments, slack: float) -> Index:
    """Candidate (k,) that says where two segments meet: the crossing, else the nearest, then the first by place."""
    best = np.zeros(len(one.start), dtype=np.intp)
    least = np.full((3, len(best)), np.inf)
    for n in range(1, len(found.meets)):
        on_one, on_two = at_share(found.on_a[n], one.start, one.end), at_share(found.on_b[n], two.start, two.end)
        key = np.round(np.vstack([np.hypot(*(on_one - on_two).T), (on_one / 2 + on_two / 2).T]) / (4 * slack))
        less = key < least
        less = less[0] | ((key[0] == least[0]) & (less[1] | ((key[1] == least[1]) & less[2])))
        taken = ~found.meets[0] & found.meets[n] & less
        best[taken] = n
        least[:, taken] = key[:, taken]
    return best


def _loop(lines: Polylines, line: Index, one: Reals, two: Reals, within: float) -> Reals:
    """Length along the line between two of its places; the shorter way round in a ring."""
    forth = np.abs(two - one)
    ring = lines.opening[line] <= within
    way: Reals = np.where(ring, np.minimum(forth, lines.length[line] - forth), forth)
    return way
