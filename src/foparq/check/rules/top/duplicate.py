# SPDX-License-Identifier: MIT
"""TOP001 duplicate."""

import numpy as np

from foparq.check.rule import rule
from foparq.columns import Index
from foparq.findings.hits import Hits, hits
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.repeats import ring_kinds
from foparq.geom.wholes import LOOSE, repeated_wholes
from foparq.model.inputs import Lines
from foparq.units import Metres


@rule("TOP001", "duplicate", limit="coincide", measures=("4",), requires=("GEO001", "GEO002"), repeats=True)
def duplicate(lines: Lines, *, coincide: Metres) -> Hits:
    """Line drawn more than once.

    Two lines are duplicates if, followed from end to end, in the same direction or one of them backwards, they are
    nowhere farther apart than ``coincide``, in the plane and in depth: vertex by vertex if they have as many, or else
    at every same share of their lengths. Rings may start anywhere; vertices added on a straight piece change nothing.
    Duplicates of duplicates belong to the same group.

    Only lines that bind are compared: on layers of one name, of one feature class of the manifest, or bound by it
    (``bind``). What other layers draw in the same place is told by TOP022 shared-edge.

    Lines of a block insert are duplicates as well where the insert as a whole is one of another, a little aside: their
    convex hulls share at least nine tenths of what they cover, and once the boxes are laid centre on centre each line
    of one lies on a line of its own of the other, within ``coincide``. Two windows cannot stand in one place. Blocks
    that were mirrored, turned or renamed are compared by their linework; each cell of an array by itself; inserts that
    have other numbers of lines on the layers that bind are not compared.

    Of the lines of a group all but the first are at fault. A line on the boundary of an area is always at fault, the
    boundary never because of it. Boundaries are compared area by area: two areas are duplicates if all their rings are;
    a hole and the area that fills it are not.

    Parameters
    ----------
    lines : Lines, n rows
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    Hits
        One a copy: place is the copy itself, size its length, other the line it repeats.

    Notes
    -----
    O(n log n); copies are not paired with each other. Does not report lines that share a part only: see TOP021
    line-overlap.
    """
    group = duplicate_groups(lines.polylines, coincide=coincide, apart=lines.bond)
    crowded = np.flatnonzero(np.bincount(group)[group] > 1)
    row, other = _copies(crowded, group, ring_kinds(lines.row, lines.bounds, group), lines.bounds)
    copy, repeated = repeated_wholes(lines.polylines, _inserts(lines), coincide=coincide, apart=lines.bond)
    new = ~np.isin(copy, row)
    row, other = np.concatenate([row, copy[new]]), np.concatenate([other, repeated[new]])
    return hits(row, lines.geometry[row], lines.polylines.length_in_space[row], other)


def _inserts(lines: Lines) -> Index:
    """Number (n,) of the insert that holds each line itself."""
    numbers = {"": LOOSE}
    held = [numbers.setdefault(holders, len(numbers)) for holders in lines.holders.tolist()]
    return np.array(held, dtype=np.intp)


def _copies(rows: Index, group: Index, kind: Index, bounds: np.ndarray) -> tuple[Index, Index]:
    """Rows at fault and the row each repeats."""
    # Boundaries stand before lines in their group, otherwise rows keep their order.
    order = rows[np.lexsort((rows, ~bounds[rows], group[rows]))]
    _, first = np.unique(group[order], return_index=True)
    leader = np.repeat(order[first], np.diff(np.append(first, len(order))))
    copy = (leader != order) & ~bounds[order]
    row, other = order[copy], leader[copy]
    edges = order[bounds[order]]
    _, first, inverse = np.unique(np.stack([group[edges], kind[edges]]), axis=1, return_index=True, return_inverse=True)
    leader = edges[first][inverse.ravel()]
    copy = leader != edges
    return np.concatenate([row, edges[copy]]), np.concatenate([other, leader[copy]])
