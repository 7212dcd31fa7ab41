# SPDX-License-Identifier: MIT
"""Linework that several layers draw alike, of which one has to be looked at."""

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.overlaps import Runs, shared_runs
from foparq.geom.polylines import Polylines, summed
from foparq.geom.ranks import line_ranks


def ring_kinds(item: Index, bounds: Flags, group: Index) -> Index:
    """Kinds (n,) of boundaries: equal where the areas that they bound have the same rings; 0 for other lines.

    Parameters
    ----------
    item : (n,) int
        Item that each line belongs to.
    bounds : (n,) bool
        True for the boundary of an area.
    group : (n,) int
        Equal for lines of the same shape, see :func:`foparq.geom.duplicates.duplicate_groups`.

    Notes
    -----
    Only areas of which another area repeats a ring are looked at; the others are of kind 0 too.
    """
    kind = np.zeros(len(item), dtype=np.intp)
    rows = np.flatnonzero(bounds & (np.bincount(group)[group] > 1)) if len(group) else kind
    concerned = np.flatnonzero(bounds & np.isin(item, item[rows]))
    rings: dict[int, list[int]] = {}
    for owner, ring in zip(item[concerned].tolist(), group[concerned].tolist(), strict=True):
        rings.setdefault(owner, []).append(ring)
    numbers: dict[tuple[int, ...], int] = {}
    of_item = {owner: numbers.setdefault(tuple(sorted(of)), len(numbers) + 1) for owner, of in rings.items()}
    kind[rows] = [of_item[owner] for owner in item[rows].tolist()]
    return kind


def drawn_again(lines: Polylines, bounds: Flags, bond: Index, *, coincide: float) -> Flags:
    """Lines that only repeat what another one draws on a layer that does not bind with theirs.

    A line repeats another if it has the same shape, or if it runs along the other with its whole length, but for
    ``coincide`` at each of its segments. Of two that repeat each other the boundary of an area stays, else the longer,
    of equals the first by place.

    Parameters
    ----------
    lines : Polylines, n lines
    bounds : (n,) bool
        True for the boundary of an area.
    bond : (n,) int
        Equal numbers on layers that bind.
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    (n,) bool
        Whatever a line that is true draws, one that is false draws as well.

    Notes
    -----
    O(s log s + meetings).
    """
    again = np.zeros(len(lines), dtype=bool)
    if not len(lines) or (bond == bond[0]).all():
        return again
    rank = np.empty(len(lines), dtype=np.intp)
    order = np.lexsort((line_ranks(lines, np.arange(len(lines))), ~bounds))
    rank[order] = np.arange(len(lines))
    group = duplicate_groups(lines, coincide=coincide)
    _, first = np.unique(group[order], return_index=True)
    leader = order[first][group]
    again[bond != bond[leader]] = True
    runs = shared_runs(lines, bounds, coincide=coincide)
    runs = runs.take(bond[runs.one] != bond[runs.two])
    later = rank[runs.one] > rank[runs.two]
    repeats = np.where(later, runs.one, runs.two)
    # What runs along another twice is longer by that, never shorter: a cheap rejection before the exact sum.
    near = runs.length >= 0.9 * lines.length[repeats] - coincide * np.diff(lines.offsets)[repeats]
    runs, repeats = runs.take(near), repeats[near]
    bare = lines.length[repeats] - _covered(lines, runs, repeats)
    again[repeats[bare <= coincide * np.maximum(np.diff(lines.offsets)[repeats] - 1, 1) + lines.slack]] = True
    return again


def _covered(lines: Polylines, runs: Runs, line: Index) -> Reals:
    """Length (k,) of one line of each pair that the other runs along, each piece of it once."""
    segment = np.where(lines.line[runs.i] == line[runs.pair], runs.i, runs.j)
    begin, step = lines.plane[lines.first[segment]], lines.step[segment]
    unit = lines.way[segment] / np.where(step > 0, step, 1.0)[:, None]
    ends = [np.clip(np.einsum("ij,ij->i", place - begin, unit), 0.0, step) for place in (runs.start, runs.end)]
    low, high = np.minimum(*ends), np.maximum(*ends)
    _, label = np.unique(np.stack([runs.pair, segment]), axis=1, return_inverse=True)
    label = label.ravel()
    order = np.lexsort((low, label))
    low, high, label = low[order], high[order], label[order]
    # Pieces of one segment that overlap count once: each begins where those before it end.
    span = float(step.max(initial=0.0)) * 2 + 1.0
    reached = np.maximum.accumulate(high + label * span) - label * span
    before = np.concatenate([[-np.inf], reached[:-1]])
    before[np.flatnonzero(np.diff(label, prepend=-1))] = -np.inf
    gained = np.maximum(high - np.maximum(low, before), 0.0)
    return summed(runs.pair[order], gained, len(line))
