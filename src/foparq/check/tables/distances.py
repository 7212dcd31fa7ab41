# SPDX-License-Identifier: MIT
"""Whether distances belong to the drawings: between which points they run, or whether they would fit."""

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from foparq.check.tables.ground import Ground
from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.findings.ties import NOBODY, DistanceTies, Ends, Lies, PointTies
from foparq.match.linework import NOTHING
from foparq.match.repeats import repeats
from foparq.model.tables import Checkpoints, Distances
from foparq.names import folded

_FEWEST = 3  #: rows that make a repetition, or a common factor, more than a coincidence
_SAME_FACTOR = 0.01
_UNIT_FACTOR = 2.0  #: a factor nearer to one is no unit


class _Places(NamedTuple):
    # Ends of n distances.
    places: Coordinates  # (n, 2, 3) metres, in the axes of the file; NaN where unknown
    known: Flags  # (n, 2) the end is a point of a drawing
    absent: Flags  # (n, 2) the end has a place, or the id of a checkpoint, that no drawing has
    flat: int  # axis without depth, or -1
    at: Index  # (n, 2) row of the checkpoint that the end is, or -1


def tie_distances(
    distances: Distances, points: Checkpoints | None, ties: PointTies | None, grounds: Sequence[Ground],
    *, tie: float, visible: float,
) -> DistanceTies:  # fmt: skip
    """Distances held against drawings.

    An end is a point of a drawing if the table gives its coordinates and linework lies there, or an insert that bears a
    name, or if its name is the id of a checkpoint that lies in a drawing, or borne by one place there. The delivered
    length must be that between the ends, or that in the plane where the drawing is flat, but for ``2 tie`` and the
    printed digits. Where the ends are names only, a drawing must be able to hold the length.

    Parameters
    ----------
    distances : Distances, n rows
    points, ties : Checkpoints and PointTies, m rows, or None
    grounds : sequence of Ground
        One at least.
    tie, visible : float, metres
        See :class:`foparq.profile.schema.EvidenceSpec`.

    Returns
    -------
    DistanceTies, n rows
    """
    ends = _ends(distances, points, ties, grounds, tie)
    both: Flags = np.all(ends.known, axis=1)
    step = ends.places[:, 1] - ends.places[:, 0]
    between = np.where(both, np.sqrt(np.nansum(step**2, axis=1)), np.nan)
    lengths = [between]
    if ends.flat >= 0:
        lengths.append(np.where(both, np.sqrt(np.nansum(np.delete(step, ends.flat, axis=1) ** 2, axis=1)), np.nan))
    untold = np.isnan(distances.delivered)
    delivered = np.where(untold & both, between, distances.delivered)
    of_ends = (distances.places_printed, *((points.printed,) if points is not None else ()))
    printed = distances.printed + 2 * max(float(np.linalg.norm(one)) for one in of_ends)
    off = np.min([np.abs(delivered - length) for length in lengths], axis=0)
    length = np.where(untold, distances.measured, distances.delivered)
    longest = max(ground.longest() for ground in grounds)
    told = np.select(
        [ends.absent.any(axis=1), both & (off <= 2 * tie + printed), both, length > longest + tie + printed,
         length < visible, untold],
        [str(Ends.ABSENT), str(Ends.POINTS), str(Ends.OTHER_LENGTH), str(Ends.TOO_LONG), str(Ends.TOO_SHORT),
         str(Ends.UNTOLD)],
        default=str(Ends.NAMES),
    ).astype(object)  # fmt: skip
    return DistanceTies(
        ends=told, between=between, delivered=delivered, group=_groups(distances, ends, both, tie),
        alike=repeats(length[:, None], apart=visible), longest=longest,
        factor=_factor(between, delivered, told == Ends.OTHER_LENGTH), places=ends.places, at=ends.at,
    )  # fmt: skip


def _ends(
    distances: Distances, points: Checkpoints | None, ties: PointTies | None, grounds: Sequence[Ground], tie: float
) -> _Places:
    n = len(distances.id)
    places = distances.places.copy()
    given = np.isfinite(places).sum(axis=2) > 1  # a depth may be left out
    known, absent = np.zeros((n, 2), dtype=bool), np.zeros((n, 2), dtype=bool)
    at = np.full((n, 2), NOBODY, dtype=np.intp)
    for end in range(2):
        rows = np.flatnonzero(given[:, end])
        within, hidden = np.full(len(rows), tie), float(np.linalg.norm(distances.places_printed))
        for ground in grounds:
            known[rows, end] |= ground.footing(places[rows, end], within, distances.places_printed).line != NOTHING
            known[rows, end] |= ground.marked(places[rows, end], within + hidden)
    absent = given & ~known
    if points is not None and ties is not None:
        at = _named_points(distances, points, given)
        named = at != NOBODY
        places[named] = ties.delivered[at[named]]
        known[named] = ~np.isin(ties.lies[at[named]], [Lies.ABSENT, Lies.UNTOLD])
        absent[named] = ties.lies[at[named]] == Lies.ABSENT
    for end, names in enumerate((distances.start, distances.end)):
        for row in np.flatnonzero(~(given | known | absent)[:, end]).tolist():
            borne = [place for one in grounds if (place := one.bearing(str(names[row]))) is not None]
            if len(borne) == 1:
                places[row, end], known[row, end] = borne[0], True
    flat = next((ground.flat for ground in grounds if ground.flat >= 0), -1)
    if ties is not None:
        at = np.where(at == NOBODY, _standing_at(places, ties.delivered, flat, tie), at)
    return _Places(places, known, absent, flat, at)


def _named_points(distances: Distances, points: Checkpoints, given: Flags) -> Index:
    """(n, 2) the checkpoint whose id an end without a place of its own bears, or -1."""
    row_of = {folded(str(name)): row for row, name in enumerate(points.id)}
    ends = zip(distances.start, distances.end, strict=True)
    named = [[row_of.get(folded(str(name)), NOBODY) for name in pair] for pair in ends]
    return np.where(given, NOBODY, np.array(named, dtype=np.intp).reshape(-1, 2))


def _standing_at(places: Coordinates, points: Coordinates, flat: int, tie: float) -> Index:
    """(n, 2) the one checkpoint in whose place an end lies, or -1; the depth of a flat drawing tells nothing."""
    from scipy.spatial import KDTree  # noqa: PLC0415 - slow to load; few deliveries need it

    axes = [axis for axis in range(3) if axis != flat]
    ends = places.reshape(-1, 3)[:, axes]
    whole, there = (np.flatnonzero(np.isfinite(one).all(axis=1)) for one in (ends, points[:, axes]))
    at = np.full(len(ends), NOBODY, dtype=np.intp)
    if len(whole) and len(there):
        gap, row = KDTree(points[there][:, axes]).query(ends[whole], k=2, distance_upper_bound=tie)
        only = np.isfinite(gap[:, 0]) & ~np.isfinite(gap[:, 1])
        at[whole[only]] = there[row[only, 0]]
    return at.reshape(-1, 2)


def _groups(distances: Distances, ends: _Places, both: Flags, tie: float) -> Index:
    """(n,) number of the measurement that a row stands for.

    Rows are one measurement if they run between the same points, or between the same names and are as long in the
    drawing, in either direction; names apart, three rows or more with the same lengths to the last digit. "Left" and
    "right" of twelve openings of unequal width are twelve measurements.
    """
    n = len(distances.id)
    group = np.arange(n)
    drawn = np.where(np.isnan(distances.delivered), distances.measured, distances.delivered)
    by_names: dict[tuple[str, ...], list[int]] = defaultdict(list)
    for row, (a, b) in enumerate(zip(distances.start, distances.end, strict=True)):
        if a and b:
            by_names[tuple(sorted((folded(str(a)), folded(str(b)))))].append(row)
    for same_names in by_names.values():
        rows = np.array(same_names)
        group[rows] = rows[repeats(drawn[rows, None], apart=2 * tie)]
    rows = np.flatnonzero(both)
    if len(rows):
        pair = np.nan_to_num(ends.places[rows])
        swap = np.array([tuple(b) < tuple(a) for a, b in pair.tolist()], dtype=bool)
        pair[swap] = pair[swap][:, ::-1]
        group[rows] = rows[repeats(pair.reshape(-1, 6), apart=tie)]
    rows = np.flatnonzero(~both)
    if len(rows):
        lengths = np.column_stack([distances.measured[rows], np.nan_to_num(distances.delivered[rows], nan=-1.0)])
        same = repeats(lengths, apart=tie / 2)
        often = np.bincount(same, minlength=len(rows))[same] >= _FEWEST
        group[rows[often]] = rows[same[often]]
    return group


def _factor(between: Reals, delivered: Reals, other: Flags) -> float:
    """Factor with which every length would be that between its ends; 1 if there is none."""
    if np.count_nonzero(other) < _FEWEST:
        return 1.0
    ratio = between[other] / delivered[other]
    middle = float(np.median(ratio))
    common = np.all(np.abs(ratio / middle - 1) <= _SAME_FACTOR)
    return middle if common and not 1 / _UNIT_FACTOR < middle < _UNIT_FACTOR else 1.0
