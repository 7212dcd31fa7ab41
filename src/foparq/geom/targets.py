# SPDX-License-Identifier: MIT
"""What an end could run into: linework ahead of it, an end that faces it, a corner that both would close.

Lines that merely lie side by side do not miss each other: parallel edges cut at one break line, the two faces of a thin
wall. Nearness says how far; direction says whether it was meant.
"""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.loose import Least, LooseEnds
from foparq.geom.polylines import Segments
from foparq.geom.segments import at_share, cross, nearest_share

#: sine of an angle that the rounding of places may make
_TURN = 1e-6


class Around(NamedTuple):
    """Other linework around e ends."""

    connected: Flags  #: (e,) it is met
    near: Least  #: the nearest within the radius
    target: Least  #: the nearest of what the end could run into


def around(ends: LooseEnds, *, ahead: float, alongside: float) -> Around:
    """Other linework within the radius of each end.

    A segment is a target if it does not run alongside and lies in the cone ahead, or if the end, drawn on, meets it:
    within the radius, or at all where it does not run alongside.

    Parameters
    ----------
    ahead : float, radians
        Half-angle of the cone around the direction of an end.
    alongside : float, radians
        What turns less against that direction runs alongside.
    """
    lines = ends.lines
    near, target = Least(ends.given, len(ends)), Least(ends.given, len(ends))
    connected = np.zeros(len(ends), dtype=bool)
    place, depth = ends.place, ends.depth
    turned = place @ lines.turn
    for end, segment in lines.tree.query(turned, turned, distance=ends.radius):
        kept = np.flatnonzero(ends.others(end, segment, ends.back))
        at, row = end[kept], segment[kept]
        piece = lines.segments(row)
        share = nearest_share(place[at], piece.start, piece.end)
        aside = at_share(share, piece.start, piece.end) - place[at]
        flat = np.hypot(*aside.T)
        drop = np.abs(at_share(share, piece.z0, piece.z1) - depth[at])
        connected[at[(flat <= ends.within) & (drop <= ends.within)]] = True
        apart = np.hypot(flat, drop)
        # What is farther is never told; what is no number would hide the others.
        far = np.flatnonzero((apart <= ends.radius + 2 * lines.slack) & ends.others(at, row))
        near.lower(at[far], apart[far], ends.chains.piece[row[far]])
        hit = far[before(ends, at[far], aside[far], piece.take(far), ahead, alongside)]
        target.lower(at[hit], apart[hit], ends.chains.piece[row[hit]])
    return Around(connected, near, target)


def before(ends: LooseEnds, at: Index, aside: Reals, piece: Segments, ahead: float, alongside: float) -> Flags:
    """Whether pieces lie before ends, so that these could run into them; see :func:`around`.

    Parameters
    ----------
    at : (k,) int
        Rows of the ends.
    aside : (k, 2) metres
        From each end to the nearest place of the piece.
    piece : Segments, k rows
    """
    flat, along = np.hypot(*aside.T), piece.end - piece.start
    length = np.hypot(*along.T)
    # What lies straight above or below has no direction in the plane.
    found: Flags = flat <= ends.lines.slack
    for way in ends.directions:
        u = way[at]
        product = cross(u, along)
        turned = np.abs(product) >= np.sin(alongside) * length - ends.lines.slack
        cone = np.einsum("ij,ij->i", aside, u) >= np.cos(ahead) * flat - ends.lines.slack
        on, meets = drawn_on(ends.place[at], u, piece, ends.within)
        found |= turned & (length > ends.lines.slack) & (cone | meets)
        found |= meets & (on <= ends.radius)
    return found


def drawn_on(place: Reals, way: Reals, piece: Segments, within: float) -> tuple[Reals, Flags]:
    """Where places (k, 2), drawn on along unit vectors (k, 2), meet pieces.

    Returns
    -------
    on : (k,) float, metres
        Length drawn on; infinite where they are parallel.
    meets : (k,) bool
        The piece is met, or passed by no farther than ``within``.
    """
    along, between = piece.end - piece.start, piece.start - place
    product, length = cross(way, along), np.hypot(*along.T)
    placed = np.abs(product) > _TURN * length
    divisor = np.where(placed, product, 1.0)
    on = np.where(placed, cross(between, along) / divisor, np.inf)
    share = cross(between, way) / divisor * length
    meets: Flags = placed & (on >= 0) & (share >= -within) & (share <= length + within)
    return on, meets


class Faced(NamedTuple):
    """Pairs of loose ends, k rows; each pair both ways."""

    end: Index  #: (k,)
    other: Index  #: (k,) an end
    apart: Reals  #: (k,) metres, depth included
    straight: Flags  #: (k,) both head for each other


def faced(ends: LooseEnds, *, straight: float) -> Faced:
    """Ends that face each other, and ends of lines that would close a corner if both were drawn on.

    Two ends face each other if their directions are opposed and neither lies behind the other by more than places that
    are one: the last chord of an arch that springs aside of its jamb leans a little. A corner is closed where
    what is drawn on of both, each by the radius at most, meets.

    Parameters
    ----------
    straight : float, radians
        Ends that face each other within this angle head for each other.
    """
    lines, place = ends.lines, ends.place
    turned = place @ lines.turn
    found = [Faced(*(np.zeros(0, dtype=kind) for kind in (np.intp, np.intp, float, bool)))]
    for one, two in BoxTree(turned, turned).pairs(distance=ends.radius):
        i, j = np.concatenate([one, two]), np.concatenate([two, one])
        aside = place[j] - place[i]
        flat = np.hypot(*aside.T)
        apart = np.hypot(flat, ends.depth[j] - ends.depth[i])
        kept = np.flatnonzero((i != j) & (apart <= ends.radius) & _apart(ends, i, j))
        i, j, aside, flat, apart = i[kept], j[kept], aside[kept], flat[kept], apart[kept]
        meant, heads = np.zeros(len(i), dtype=bool), np.zeros(len(i), dtype=bool)
        for way in ends.directions:
            for back in ends.directions:
                u, v = way[i], back[j]
                opposed = np.einsum("ij,ij->i", u, v) < -_TURN
                before = np.einsum("ij,ij->i", aside, u), -np.einsum("ij,ij->i", aside, v)
                facing = opposed & (np.minimum(*before) >= -ends.within)
                meant |= facing | closing(aside, u, v, ends.radius, lines.slack)[1]
                towards = (np.minimum(*before) >= np.cos(straight) * flat) | _in_line(aside, u, v, ends.within)
                heads |= facing & towards & (np.einsum("ij,ij->i", u, v) <= -np.cos(straight))
        rows = np.flatnonzero(meant)
        found.append(Faced(i[rows], j[rows], apart[rows], heads[rows]))
    return Faced(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _apart(ends: LooseEnds, i: Index, j: Index) -> Flags:
    """True (k,) where the second end is other linework of the first."""
    after = np.where(ends.forward[i], ends.vertex[j] >= ends.left[i], ends.vertex[j] <= ends.left[i])
    apart: Flags = (ends.line[i] != ends.line[j]) | after
    return apart


def closing(aside: Reals, u: Reals, v: Reals, radius: float, slack: float) -> tuple[Reals, Flags]:
    """Where two ends, drawn on, meet each other.

    Parameters
    ----------
    aside : (k, 2) metres
        From the first end to the second.
    u, v : (k, 2)
        Unit vectors of both.
    radius : float, metres
        How far each may be drawn on.
    slack : float, metres
        Rounding of places.

    Returns
    -------
    on : (k,) metres
        Length by which the first is drawn on; meaningless where they do not meet.
    meets : (k,) bool
    """
    product = cross(u, v)
    placed = np.abs(product) > _TURN
    divisor = np.where(placed, product, 1.0)
    on, back = cross(aside, v) / divisor, cross(aside, u) / divisor
    closed: Flags = placed & (np.minimum(on, back) >= -slack) & (np.maximum(on, back) <= radius)
    return on, closed


def _in_line(aside: Reals, u: Reals, v: Reals, within: float) -> Flags:
    """True (k,) where each end lies on the other line drawn on."""
    on: Flags = (np.abs(cross(u, aside)) <= within) & (np.abs(cross(v, aside)) <= within)
    return on
