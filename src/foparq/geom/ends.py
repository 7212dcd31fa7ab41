# SPDX-License-Identifier: MIT
"""Ends of lines: connected, beyond the last crossing, short of what they could run into, or free.

An *end* is the first or last vertex of a line whose ends are apart by more than ``coincide``. Lines are followed
through the places where just two ends meet: their *chain*. *Other linework* of an end is every segment of any other
chain, and the segments of its own chain that come after the chain, followed from the end, has left the circle of radius
``reach`` around it. An end that rests on its own chain is connected even if the chain has left the circle of radius
``coincide`` only.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index, Reals
from foparq.geom.chains import CELL, NOBODY, chained, open_ends
from foparq.geom.dashes import dashes
from foparq.geom.loose import LooseEnds
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import ragged
from foparq.geom.strokes import joints, near_tips
from foparq.geom.stubs import stubs
from foparq.geom.targets import around, faced

__all__ = ["NOBODY", "Aim", "EndKind", "Ends", "classify_ends"]


class EndKind(IntEnum):
    """What an end is; every end is exactly one of these."""

    CONNECTED = 0  #: meets other linework
    OVERSHOOT = 1  #: goes beyond its last meeting, by more than ``coincide`` and at most ``reach``
    UNDERSHOOT = 2  #: stops short of what it could run into, by more than ``coincide`` and at most ``reach``
    FREE = 3  #: nothing within ``reach``
    BESIDE = 4  #: nothing within ``reach`` that it could run into, but something beside or behind
    DASH = 5  #: faces the next of a row of dashes


class Aim(NamedTuple):
    """What direction has to do with ends."""

    ahead: float  #: radians, half-angle of the cone before an end in which it misses what is near
    alongside: float  #: radians; what turns less against an end runs alongside
    remainder: float  #: a stub is an overshoot if its line goes on beyond the meeting for so many times its length


class Ends(NamedTuple):
    """The e ends of some lines, as columns, ordered by line, first vertex before last."""

    line: Index  #: (e,)
    vertex: Index  #: (e,) row of the coordinates
    forward: Flags  #: (e,) true if the line is followed in its own order
    kind: NDArray[np.int8]  #: (e,) :class:`EndKind`
    size: Reals  #: (e,) metres; 0 if connected, ``reach`` if free
    other: Index  #: (e,) line that is met, crossed, missed or beside; ``NOBODY`` if connected or free
    dash: Index  #: (d,) lines that are dashes of a row
    row: Index  #: (d,) number of their row


def classify_ends(lines: Polylines, aim: Aim, *, coincide: float, reach: float) -> Ends:
    """What every end of every line is.

    Parameters
    ----------
    lines : Polylines, n lines
    aim : Aim
    coincide, reach : float, metres
        Distance up to which two places are one, and beyond which they are unrelated.

    Returns
    -------
    Ends, e rows
        Computed once a set of tolerances.

    Notes
    -----
    O((s + e) log s + near pairs), in blocks of bounded memory. The distance to other linework is that to the nearest
    place in the plane, joined with the difference in depth there. Among lines at the same distance the longest is
    named, of equals the first by place.
    Does not look at the middle of lines: two lines that cross without a vertex are no matter of ends.
    """
    return lines.kept(("ends", aim, coincide, reach), lambda: _classify(lines, aim, coincide, reach))


def loose_ends(lines: Polylines, *, within: float, radius: float) -> LooseEnds:
    """Ends of chains, less those of which others lie at the very same place.

    Parameters
    ----------
    within, radius : float, metres
        Rounding included.
    """
    return lines.kept(("loose", within, radius), lambda: _loose(lines, within, radius))


def _loose(lines: Polylines, within: float, radius: float) -> LooseEnds:
    chains = chained(lines, within=within)
    line, vertex, forward = open_ends(chains.lines, within)
    alone = np.flatnonzero(~_share_an_end(chains.lines, vertex, within))
    return LooseEnds(
        given=lines, chains=chains, short=chains.lines.length_in_space <= within, line=line[alone],
        vertex=vertex[alone], forward=forward[alone], within=within, radius=radius,
    )  # fmt: skip


def _classify(lines: Polylines, aim: Aim, coincide: float, reach: float) -> Ends:
    within, radius = coincide + lines.slack, reach + lines.slack
    line, vertex, forward = open_ends(lines, within)
    kind = np.full(len(line), EndKind.CONNECTED, dtype=np.int8)
    size, other = np.zeros(len(line)), np.full(len(line), NOBODY, dtype=np.intp)
    ends = loose_ends(lines, within=within, radius=radius)
    found = around(ends, ahead=aim.ahead, alongside=aim.alongside)
    connected = found.connected.copy()
    dangling = np.flatnonzero(~connected)
    if ends.short.any():
        connected[dangling[_joined(ends.take(dangling))]] = True
    dangling = np.flatnonzero(~connected)
    stub = stubs(ends.take(dangling))
    passed, whole = np.where(np.isfinite(stub.value), stub.value, 0.0), ends.lines.length[ends.line[dangling]]
    over = (passed > within) & (whole - passed >= aim.remainder * passed - lines.slack)

    pairs = faced(ends.take(dangling), straight=aim.alongside)
    rows = dashes(ends.take(dangling), pairs, over)
    settled = over.copy()  # not what another end misses
    settled[rows.end] = True
    missed = np.flatnonzero(~over[pairs.end] & ~settled[pairs.other])
    mine = ends.chains.vertex[ends.vertex]
    facing = lines.line_of_vertex[mine[dangling[pairs.other[missed]]]]
    found.target.lower(dangling[pairs.end[missed]], pairs.apart[missed], facing)
    rest = dangling[~over]  # neither met nor beyond
    near, target = found.near, found.target
    short = rest[target.value[rest] <= radius]
    beside = rest[(target.value[rest] > radius) & (near.value[rest] <= radius)]
    free = rest[(target.value[rest] > radius) & (near.value[rest] > radius)]
    place = np.searchsorted(vertex, mine)
    for chosen, which, amount, whom in (
        (dangling[over], EndKind.OVERSHOOT, stub.value[over], stub.line[over]),
        (short, EndKind.UNDERSHOOT, target.value[short], target.line[short]),
        (beside, EndKind.BESIDE, near.value[beside], near.line[beside]),
        (free, EndKind.FREE, reach, NOBODY),
        (dangling[rows.end], EndKind.DASH, rows.gap, lines.line_of_vertex[mine[dangling[rows.faced]]]),
    ):
        at = place[chosen]
        kind[at], size[at], other[at] = which, amount, whom
    of_chain, dash = np.unique(np.stack([ends.lines.line, ends.chains.piece]), axis=1)
    number = np.full(len(ends.lines), NOBODY, dtype=np.intp)
    number[rows.dash] = rows.row
    among = number[of_chain] != NOBODY
    return Ends(line, vertex, forward, kind, size, other, dash[among], number[of_chain][among])


def _share_an_end(lines: Polylines, vertex: Index, within: float) -> Flags:
    """True where another end lies in the same small cell, hence at the same place.

    The two ends of one chain are farther apart than the cell is wide: the other end is another chain's.
    """
    if not len(vertex):
        return np.zeros(0, dtype=bool)
    cell = np.floor(np.column_stack([lines.plane[vertex], lines.depth[vertex]]) / (CELL * within))
    order = np.lexsort(cell.T)
    alike = np.all(cell[order[1:]] == cell[order[:-1]], axis=1)
    crowded = np.zeros(len(vertex), dtype=bool)
    crowded[order[1:][alike]] = True
    crowded[order[:-1][alike]] = True
    return crowded


def _joined(ends: LooseEnds) -> Index:
    """Ends (k,) that meet other linework through lines that are no longer than a point."""
    lines = ends.lines
    found = joints(lines, ends.short, within=ends.within)
    end, joint = near_tips(lines, found, ends.vertex, within=ends.within)
    touched, line = np.unique(np.stack([found.touching, lines.line[found.segment]]), axis=1)
    several = np.bincount(touched, minlength=int(joint.max()) + 1 if len(joint) else 0)
    alone = np.full(len(several), NOBODY, dtype=np.intp)
    alone[touched] = line
    met = (several[joint] > 1) | ((several[joint] == 1) & (alone[joint] != ends.line[end]))
    # A joint that touches one chain, maybe the end's own: elsewhere, or at the end alone?
    own = np.flatnonzero(several[joint] == 1)
    order = np.argsort(found.touching, kind="stable")
    first, last = (np.searchsorted(found.touching[order], joint[own], side=side) for side in ("left", "right"))
    of, at = ragged(first, last - first)
    back_again = ends.beyond(ends.back, end[own][of], found.segment[order[at]])
    met[own[of[back_again]]] = True
    return np.unique(end[met])
