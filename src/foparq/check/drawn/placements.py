# SPDX-License-Identifier: MIT
"""Features of the list, looked for where they are listed."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from foparq.check.drawn.features import count_features
from foparq.columns import Coordinates, Flags, Index
from foparq.findings.counts import FeatureCounts, FoundFeatures, Listed, Placements, Reading
from foparq.match.assign import UNASSIGNED, assign
from foparq.model.drawing import Drawing
from foparq.model.plane import Plane
from foparq.model.tables import FeatureList
from foparq.names import folded, of_kind

_SHEET = 2  #: axes of a sheet


def count_listed(
    drawings: Sequence[Drawing], *, features: FeatureList | None, gap: float, near: float
) -> FeatureCounts | None:
    """Count delivered features, and look for those of the list where it places them.

    Parameters
    ----------
    features : FeatureList or None
        A row is placed if it stands for one feature that is not prohibited and gives a place: coordinates in the axes
        of the drawing, metres; the axis of depth may be left out. Two coordinates in other axes are taken for those to
        the right and up.
    gap : float, metres
        As for :func:`foparq.check.drawn.features.count_features`.
    near : float, metres
        How far from its place the outline of a feature may lie where the list states no tolerance.

    Returns
    -------
    FeatureCounts or None
        A listed feature is *there* if an outline of its class and facade is its own: outlines and places are assigned
        to each other one to one, the nearer the better. It is *unsure* if only what may be part of another feature lies
        there, or what may be several and is that of another; *other* if a feature of another class does.
    """
    counts = count_features(drawings, gap=gap)
    if counts is None or features is None or not len(counts.found):
        return counts
    known = (features.count == 1) & (features.use != "prohibited") & (np.isfinite(features.place).sum(axis=1) >= _SHEET)
    if not known.any():
        return counts
    return replace(counts, placements=_placements(drawings, features, counts.found, known, near))


def _placements(
    drawings: Sequence[Drawing], features: FeatureList, found: FoundFeatures, known: Flags, near: float
) -> Placements:
    n = len(features.id)
    lies = np.full(n, Listed.UNPLACED.value, dtype=object)
    row: Index = np.full(n, UNASSIGNED, dtype=np.intp)
    tol = np.where(np.isfinite(features.tol) & (features.tol > 0), features.tol, max(near, np.finfo(float).tiny))
    kind = np.array([of_kind(str(name)) for name in features.feature_class], dtype=object)
    side = np.array([folded(str(name)) for name in features.facade], dtype=object)
    found_kind = np.array([of_kind(str(name)) for name in found.feature_class], dtype=object)
    found_side = np.array([folded(str(name)) for name in found.facade], dtype=object)
    rank = {Listed.UNPLACED: -1, Listed.ABSENT: 0, Listed.OTHER: 1, Listed.UNSURE: 2, Listed.THERE: 3}
    for drawing in drawings:
        here = found.drawing == drawing.path
        mine = known & ((side == folded(drawing.facade)) | (side == ""))
        if not here.any() or not mine.any():
            continue
        spots = _on_sheet(drawing, features.place)
        mine &= np.isfinite(spots).all(axis=1)
        for name in sorted(set(kind[mine])):
            rows = np.flatnonzero(mine & (kind == name))
            same = here & (found_kind == name) & (found_side == folded(drawing.facade))
            state, at = _of_class(spots[rows], tol[rows], found, same, here & ~same)
            for one, what, outline in zip(rows.tolist(), state, at.tolist(), strict=True):
                if rank[what] > rank[Listed(lies[one])]:
                    lies[one], row[one] = what.value, outline
    return Placements(lies=lies, row=row)


def _of_class(
    spots: Coordinates, tol: Coordinates, found: FoundFeatures, same: Flags, others: Flags
) -> tuple[list[Listed], Index]:
    """What lies at the places of one class on one drawing, and the row of the outline."""
    counted = np.flatnonzero(same & (found.reading == Reading.COUNTED))
    several = np.flatnonzero(same & ((found.reading == Reading.PART) | (found.most > 1)))
    strangers = np.flatnonzero(others & (found.reading == Reading.COUNTED))
    at = np.full(len(spots), UNASSIGNED, dtype=np.intp)
    state = [Listed.ABSENT] * len(spots)
    for outlines, what, exclusive in (
        (counted, Listed.THERE, True),
        (several, Listed.UNSURE, False),
        (strangers, Listed.OTHER, False),
    ):
        left = np.flatnonzero(at == UNASSIGNED)
        groups = [left] if exclusive else np.split(left, len(left)) if len(left) else []
        for some in groups:
            assigned = assign(spots[some], tol[some], found.sheet[outlines])
            for one, outline in zip(some.tolist(), assigned.tolist(), strict=True):
                if outline != UNASSIGNED:
                    at[one], state[one] = outlines[outline], what
    return state, at


def _on_sheet(drawing: Drawing, place: Coordinates) -> Coordinates:
    """Places (n, 2) in the plane of the drawing, metres; NaN where they cannot be brought there."""
    metres = drawing.unit.metres or 1.0
    plane: Plane = drawing.plane
    axes = [int(np.argmax(np.abs(row))) for row in plane.frame[:2]]
    straight = np.full(len(place), np.allclose(np.abs(plane.frame).max(axis=1), 1.0))
    given = np.isfinite(place)
    whole = given.all(axis=1) | (given[:, axes].all(axis=1) & straight)
    projected = plane.project(np.nan_to_num(place) / metres, metres)[:, :_SHEET]
    # A facade drawn flat, and a list in the axes of the building: the first is to the right, the second up.
    moved = np.zeros_like(place)
    two = given.sum(axis=1) == _SHEET
    moved[np.ix_(two, axes)] = place[two][given[two]].reshape(-1, _SHEET)
    turned = plane.project(moved / metres, metres)[:, :_SHEET]
    other: Coordinates = np.where((two & straight)[:, np.newaxis], turned, np.nan)
    sheet: Coordinates = np.where(whole[:, np.newaxis], projected, other)
    return sheet
