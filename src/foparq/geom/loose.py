# SPDX-License-Identifier: MIT
"""Ends of chains that are looked at, and what is other linework to them."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.chains import NOBODY, Chains
from foparq.geom.leaving import leaving
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import last_not_above
from foparq.geom.ranks import line_ranks
from foparq.geom.segments import at_share


@dataclass(frozen=True, eq=False)
class LooseEnds:
    """e ends of chains. *Own* is the chain of an end, followed from it; all else is other linework.

    Parameters
    ----------
    given : Polylines
        The lines that the chains are made of.
    chains : Chains
    short : (n,) bool
        Chains that are no linework by themselves.
    line, vertex : (e,) int
        Chain of each end, and its row among the vertices of the chains.
    forward : (e,) bool
        True if the chain is followed in its own order.
    within, radius : float, metres
        Distance up to which places are one, and beyond which they are unrelated, rounding included.
    """

    given: Polylines
    chains: Chains
    short: Flags
    line: Index
    vertex: Index
    forward: Flags
    within: float
    radius: float

    def __len__(self) -> int:
        return len(self.line)

    def take(self, rows: Index) -> "LooseEnds":
        """The chosen ends."""
        taken = replace(self, line=self.line[rows], vertex=self.vertex[rows], forward=self.forward[rows])
        taken.__dict__.update(left=self.left[rows], back=self.back[rows])
        return taken

    @property
    def lines(self) -> Polylines:
        """The chains."""
        return self.chains.lines

    @property
    def place(self) -> Reals:
        """(e, 2) the ends in the plane."""
        return self.lines.plane[self.vertex]

    @property
    def depth(self) -> Reals:
        """(e,) their depth."""
        return self.lines.depth[self.vertex]

    @cached_property
    def left(self) -> Index:
        """(e,) vertex from which on the own chain is other linework: it has left the circle of ``radius``."""
        return leaving(self.lines, self.vertex, self.forward, radius=self.radius)

    @cached_property
    def back(self) -> Index:
        """(e,) vertex from which on the end may rest on its own chain: it has left the circle of ``within``."""
        return leaving(self.lines, self.vertex, self.forward, radius=self.within)

    def others(self, end: Index, segment: Index, left: Index | None = None) -> Flags:
        """True where the segment is other linework of the end, its own chain from the vertex ``left`` on included."""
        of = self.lines.line[segment]
        own = self.beyond(self.left if left is None else left, end, segment)
        other: Flags = ~self.short[of] & ((of != self.line[end]) | own)
        return other

    def beyond(self, left: Index, end: Index, segment: Index) -> Flags:
        """True where a segment of the end's own chain comes after the vertex ``left[end]``; others are not told."""
        start = self.lines.first[segment]
        after: Flags = np.where(self.forward[end], start >= left[end], start + 1 <= left[end])
        return after

    @cached_property
    def directions(self) -> tuple[Reals, Reals]:
        """Where the ends head for: unit vectors (e, 2) of the last segment, and of the chord over the last ``radius``.

        The last segment is that from the first place farther than ``within``; what is shorter is a tick of the pen.
        """
        lines, way = self.lines, np.where(self.forward, 1, -1)
        far = np.where(self.forward, lines.tails[self.line], lines.heads[self.line])
        before = np.where(self.forward, np.minimum(self.back, far), np.maximum(self.back, far))
        run = lines.along[self.vertex]
        head, tail = lines.heads[self.line], lines.tails[self.line]
        limit = np.clip(run + way * self.radius, 0.0, lines.along[tail])
        at = last_not_above(lines.along, head, tail, limit)
        step = lines.along[np.minimum(at + 1, tail)] - lines.along[at]
        share = np.clip((limit - lines.along[at]) / np.where(step > 0, step, 1.0), 0.0, 1.0)
        chord = self.place - at_share(share, lines.plane[at], lines.plane[np.minimum(at + 1, tail)])
        last = self.place - lines.plane[before]
        size = np.hypot(*chord.T)
        chord = np.where((size > self.within)[:, None], chord, last)
        return unit(last), unit(chord)


def unit(vector: Reals) -> Reals:
    """Vectors (k, 2) of length one; without direction, zero."""
    size = np.hypot(*vector.T)
    found: Reals = vector / np.where(size > 0, size, 1.0)[:, None]
    return found


class Least:
    """The least distance of each of e ends, and the line it is that to.

    Among lines at the same distance, but for rounding, the longest is named, of equals the first by place.
    """

    def __init__(self, given: Polylines, count: int) -> None:
        self._given = given
        self.value, self.line = np.full(count, np.inf), np.full(count, NOBODY, dtype=np.intp)

    def lower(self, at: Index, value: Reals, of: Index) -> None:
        """Lower ``value[at]``, and name the line."""
        ends = np.unique(at)
        named = self.line[ends] != NOBODY
        at, of = np.concatenate([at, ends[named]]), np.concatenate([of, self.line[ends[named]]])
        value = np.concatenate([value, self.value[ends[named]]])
        np.minimum.at(self.value, at, value)
        tied = value <= self.value[at] + self._given.slack
        at, of = at[tied], of[tied]
        self.line[at] = of
        doubtful = np.zeros(len(self.line), dtype=bool)
        doubtful[at[self.line[at] != of]] = True
        rows = np.flatnonzero(doubtful[at])
        if len(rows):
            choice, index = np.unique(of[rows], return_inverse=True)
            order = rows[np.argsort(-line_ranks(self._given, choice)[index], kind="stable")]
            self.line[at[order]] = of[order]  # the last that is written stays
