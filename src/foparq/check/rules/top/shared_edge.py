# SPDX-License-Identifier: MIT
"""TOP022 shared-edge."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.columns import Index
from foparq.findings.hits import Hits, hits
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.overlaps import shared_runs
from foparq.geom.ranks import line_ranks
from foparq.geom.repeats import ring_kinds
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("TOP022", "shared-edge", limit="coincide", requires=("GEO001", "GEO002", "TOP001"))
def shared_edge(lines: Lines, *, coincide: Metres) -> Hits:
    """Linework that layers share which are not drawn as one.

    Layers are drawn as one (they *bind*) if they have one name, whatever its case and accents are composed of, if the
    manifest maps them to one feature class, or if it says so (``bind``). Between layers that bind, linework that is
    drawn twice is a fault: TOP001 duplicate and TOP021 line-overlap. Between layers that do not, it is the ordinary way
    to draw a surround against a frame, or a sill under a window, and told as information.

    Two lines of layers that do not bind share an edge if they run along each other for more than ``coincide``, whole or
    in part, by the definition of TOP021. Two boundaries of areas do so only if all rings of the areas are the same:
    neighbours have borders in common.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a pair: row is the shorter of the two, other the longer (of equals the first by place); place is the longest
        shared piece, size the shared length.

    Notes
    -----
    O(n log n + meetings). Duplicates are set aside first, so that a pair is told once. Does not say which of the two
    layers the line belongs on.
    """
    table = lines.polylines
    runs = shared_runs(table, lines.bounds, coincide=coincide)
    runs = runs.take(lines.bond[runs.one] != lines.bond[runs.two])
    rows, of = np.unique(np.concatenate([runs.one, runs.two]), return_inverse=True)
    rank = line_ranks(table, rows)[of]
    one, two = rank[: len(runs.one)], rank[len(runs.one) :]
    shorter, longer = np.where(one > two, runs.one, runs.two), np.where(one > two, runs.two, runs.one)
    ring, same = _same_areas(lines, coincide)
    return hits(
        np.concatenate([shorter, ring]),
        np.concatenate([table.chords(runs.start[runs.longest], runs.end[runs.longest]), lines.geometry[ring]]),
        np.concatenate([runs.length, shapely.length(lines.geometry[ring])]),
        np.concatenate([longer, same]),
    )


def _same_areas(lines: Lines, coincide: float) -> tuple[Index, Index]:
    """Boundaries of areas that an area on another layer repeats with all its rings, and that boundary."""
    edges = np.flatnonzero(lines.bounds)
    group = duplicate_groups(lines.polylines, coincide=coincide)
    kind = ring_kinds(lines.row, lines.bounds, group)
    edges = edges[kind[edges] > 0]
    _, first, of = np.unique(np.stack([group[edges], kind[edges]]), axis=1, return_index=True, return_inverse=True)
    leader = edges[first][of.ravel()]
    apart = lines.bond[edges] != lines.bond[leader]
    return edges[apart], leader[apart]
