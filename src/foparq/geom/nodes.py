# SPDX-License-Identifier: MIT
"""Places where only ends meet, short of a third line."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.chains import Chains, meetings, open_ends
from foparq.geom.ends import Aim
from foparq.geom.loose import Least, LooseEnds
from foparq.geom.polylines import Polylines
from foparq.geom.ragged import ragged
from foparq.geom.ranks import line_ranks
from foparq.geom.segments import at_share, nearest_share
from foparq.geom.stretches import components
from foparq.geom.targets import before

_PAIR = 2  #: ends at one place that may be one line


class Nodes(NamedTuple):
    """k places where ends meet nothing but each other."""

    line: Index  #: (k,) of the lines that end there the longest, of equals the first by place
    vertex: Index  #: (k,) its vertex there
    size: Reals  #: (k,) metres to the third line
    other: Index  #: (k,) that line


class _Members(NamedTuple):
    # Ends of lines that meet other ends, ordered by node.
    line: Index
    vertex: Index
    forward: Flags
    node: Index  #: numbered without holes


def short_nodes(lines: Polylines, aim: Aim, *, coincide: float, reach: float) -> Nodes:
    """Nodes of two ends or more, that meet nothing but each other, short of what one of them could run into.

    Where just two lines go on in each other, turned by less than ``alongside``, they are one line, and no node.

    Parameters
    ----------
    lines : Polylines, n lines
    aim : Aim
    coincide, reach : float, metres

    Notes
    -----
    O((s + e) log s + near pairs). See :func:`foparq.geom.targets.around` for what an end could run into.
    """
    within, radius = coincide + lines.slack, reach + lines.slack
    members = _members(lines, within)
    first = np.unique(members.node, return_index=True)[1]
    node, segment, connected = _near(lines, members, first, within, radius)
    passed = _going_on(lines, members, first, aim.alongside, within, radius)
    kept = ~(connected | passed)[node]
    node, segment = node[kept], segment[kept]
    begin = np.searchsorted(members.node, node)
    pair, end = ragged(begin, np.searchsorted(members.node, node, side="right") - begin)
    asked, of = np.unique(end, return_inverse=True)
    ends = _ends(lines, members, asked, within, radius)
    piece = lines.segments(segment[pair])
    share = nearest_share(ends.place[of], piece.start, piece.end)
    aside = at_share(share, piece.start, piece.end) - ends.place[of]
    apart = np.hypot(np.hypot(*aside.T), at_share(share, piece.z0, piece.z1) - ends.depth[of])
    hit = np.flatnonzero((apart <= radius) & before(ends, of, aside, piece, aim.ahead, aim.alongside))
    least = Least(lines, len(first))
    least.lower(node[pair[hit]], apart[hit], lines.line[segment[pair[hit]]])
    told = np.flatnonzero(np.isfinite(least.value))
    speaker = _speakers(lines, members)[told]
    return Nodes(members.line[speaker], members.vertex[speaker], least.value[told], least.line[told])


def _ends(lines: Polylines, members: _Members, rows: Index, within: float, radius: float) -> LooseEnds:
    return LooseEnds(
        given=lines, chains=Chains(lines, np.arange(len(lines.coordinates)), lines.line),
        short=np.zeros(len(lines), dtype=bool), line=members.line[rows], vertex=members.vertex[rows],
        forward=members.forward[rows], within=within, radius=radius,
    )  # fmt: skip


def _going_on(
    lines: Polylines, members: _Members, first: Index, alongside: float, within: float, radius: float
) -> Flags:
    """True (n,) for nodes of two ends whose last segments go on in each other."""
    count = np.diff(np.append(first, len(members.node)))
    pair = first[count == _PAIR]
    way, _ = _ends(lines, members, np.concatenate([pair, pair + 1]), within, radius).directions
    turn = np.einsum("ij,ij->i", way[: len(pair)], -way[len(pair) :])
    passed = np.zeros(len(first), dtype=bool)
    passed[count == _PAIR] = turn > np.cos(alongside)
    return passed


def _members(lines: Polylines, within: float) -> _Members:
    line, vertex, forward = open_ends(lines, within)
    met = meetings(lines, within)
    cell = components(len(met.rows), met.one, met.two)[met.stands_for]
    rows = np.flatnonzero(np.bincount(cell)[cell] > 1) if len(cell) else cell
    rows = rows[np.argsort(cell[rows], kind="stable")]
    node = np.unique(cell[rows], return_inverse=True)[1].reshape(-1)
    return _Members(line[rows], vertex[rows], forward[rows], node)


def _near(
    lines: Polylines, members: _Members, first: Index, within: float, radius: float
) -> tuple[Index, Index, Flags]:
    """Segments near nodes, of lines that do not end there; and whether a node meets one of them."""
    ending = np.sort(members.node * len(lines) + members.line)
    place, depth = lines.plane[members.vertex[first]], lines.depth[members.vertex[first]]
    turned, connected = place @ lines.turn, np.zeros(len(first), dtype=bool)
    nodes, segments = [first[:0]], [first[:0]]
    for asked, found in lines.tree.query(turned, turned, distance=radius + within):
        key = asked * len(lines) + lines.line[found]
        at = np.minimum(np.searchsorted(ending, key), len(ending) - 1)
        third = np.flatnonzero(ending[at] != key)
        node, segment = asked[third], found[third]
        piece = lines.segments(segment)
        share = nearest_share(place[node], piece.start, piece.end)
        flat = np.hypot(*(at_share(share, piece.start, piece.end) - place[node]).T)
        drop = np.abs(at_share(share, piece.z0, piece.z1) - depth[node])
        connected[node[(flat <= 2 * within) & (drop <= 2 * within)]] = True
        near = np.flatnonzero(flat <= radius + within)
        nodes.append(node[near])
        segments.append(segment[near])
    return np.concatenate(nodes), np.concatenate(segments), connected


def _speakers(lines: Polylines, members: _Members) -> Index:
    """The member (k,) of each node that names it."""
    chosen, index = np.unique(members.line, return_inverse=True)
    order = np.lexsort((line_ranks(lines, chosen)[index.reshape(-1)], members.node))
    return order[np.unique(members.node[order], return_index=True)[1]]
