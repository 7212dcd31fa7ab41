# SPDX-License-Identifier: MIT
"""Loose ends that head for a line farther away."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.ends import Aim, EndKind, classify_ends, loose_ends
from foparq.geom.loose import Least, LooseEnds
from foparq.geom.polylines import Polylines
from foparq.geom.segments import at_share, cross, nearest_share
from foparq.geom.targets import closing, drawn_on


class Heading(NamedTuple):
    """k ends that head for other linework."""

    line: Index  #: (k,)
    vertex: Index  #: (k,)
    size: Reals  #: (k,) metres that are missing, in the direction of the end
    other: Index  #: (k,) line that would be met first


def heading_ends(lines: Polylines, aim: Aim, *, coincide: float, reach: float, heading: float) -> Heading:
    """Free ends that meet other linework if drawn on by at most ``heading``, or close a corner with another such end.

    Parameters
    ----------
    lines : Polylines, n lines
    aim, coincide, reach
        See :func:`foparq.geom.ends.classify_ends`.
    heading : float, metres
        Greatest length drawn on, in the plane; depths differ by no more.

    Notes
    -----
    O((s + e) log s + near pairs). What runs alongside is not met, but what lies in line stands before all that is
    farther on. Of several lines the first on the way is named; the own line, if its other end is nearer and the gap is
    its small remainder: an outline that was left open.
    """
    found = classify_ends(lines, aim, coincide=coincide, reach=reach)
    asked = found.vertex[np.isin(found.kind, [EndKind.FREE, EndKind.BESIDE])]
    every = loose_ends(lines, within=coincide + lines.slack, radius=reach + lines.slack)
    mine = every.chains.vertex[every.vertex]
    ends = every.take(np.flatnonzero(np.isin(mine, asked)))
    least, seen = Least(lines, len(ends)), np.full(len(ends), np.inf)
    for way in ends.directions:
        seen = np.minimum(seen, _first_met(ends, way, aim.alongside, heading + lines.slack, least))
    _corners(ends, heading + lines.slack, least)
    told = np.flatnonzero(np.isfinite(least.value) & (least.value <= seen + lines.slack))
    _own_ends(ends, told, aim.remainder, least)
    vertex = ends.chains.vertex[ends.vertex][told]
    return Heading(lines.line_of_vertex[vertex], vertex, least.value[told], least.line[told])


def _first_met(ends: LooseEnds, way: Reals, alongside: float, heading: float, least: Least) -> Reals:
    """Lower the distances to what is met; those (e,) to what lies in line, infinite where nothing does."""
    lines, start, seen = ends.lines, ends.place, np.full(len(ends), np.inf)
    a, b = start @ lines.turn, (start + heading * way) @ lines.turn
    for end, segment in lines.tree.query(np.minimum(a, b), np.maximum(a, b), distance=ends.within):
        kept = np.flatnonzero(ends.others(end, segment))
        at, row = end[kept], segment[kept]
        piece = lines.segments(row)
        on, meets = drawn_on(start[at], way[at], piece, ends.within)
        along = piece.end - piece.start
        length = np.hypot(*along.T)
        turned = np.abs(cross(way[at], along)) >= np.sin(alongside) * length
        share = nearest_share(start[at], piece.start, piece.end)
        aside = at_share(share, piece.start, piece.end) - start[at]
        before = np.einsum("ij,ij->i", aside, way[at])
        drop = np.abs(at_share(share, piece.z0, piece.z1) - ends.depth[at])
        in_line = ~turned & (np.abs(cross(way[at], aside)) <= ends.within) & (before > 0) & (drop <= heading)
        np.minimum.at(seen, at[in_line], before[in_line])
        meets &= turned & (length > lines.slack) & (on <= heading)
        near = np.flatnonzero(meets)
        at, on, row, piece = at[near], on[near], row[near], piece.take(near)
        along, length = along[near], length[near]
        share = np.einsum("ij,ij->i", start[at] + on[:, None] * way[at] - piece.start, along) / length**2
        drop = np.abs(at_share(np.clip(share, 0.0, 1.0), piece.z0, piece.z1) - ends.depth[at])
        level = np.flatnonzero(drop <= heading)
        least.lower(at[level], on[level], ends.chains.piece[row[level]])
    return seen


def _corners(ends: LooseEnds, heading: float, least: Least) -> None:
    lines, place = ends.lines, ends.place
    turned = place @ lines.turn
    given = ends.chains.vertex[ends.vertex]
    for one, two in BoxTree(turned, turned).pairs(distance=2 * heading):
        i, j = np.concatenate([one, two]), np.concatenate([two, one])
        other = (ends.line[i] != ends.line[j]) & (np.abs(ends.depth[i] - ends.depth[j]) <= heading)
        i, j = i[other], j[other]
        for way in ends.directions:
            for back in ends.directions:
                on, closed = closing(place[j] - place[i], way[i], back[j], heading, lines.slack)
                rows = np.flatnonzero(closed)
                least.lower(i[rows], on[rows], ends.given.line_of_vertex[given[j[rows]]])


def _own_ends(ends: LooseEnds, told: Index, remainder: float, least: Least) -> None:
    """Name the own line where its other end is nearer, and it is longer than so many times the gap."""
    chains, line = ends.lines, ends.line[told]
    gap, length = chains.opening[line], chains.length[line]
    nearer = (gap < least.value[told]) & (length >= remainder * gap - chains.slack)
    far = np.where(ends.forward[told], chains.tails[line], chains.heads[line])[nearer]
    least.lower(told[nearer], gap[nearer], ends.given.line_of_vertex[ends.chains.vertex[far]])
