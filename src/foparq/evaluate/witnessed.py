# SPDX-License-Identifier: MIT
"""An outlying checkpoint against the distances that end there: which is to be suspected, drawing or reference.

It decides nothing. A drawing that is wrong at a point by the difference found there has wrong distances from it; where
the reference is wrong, the distances of the drawing are right.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from foparq.accuracy.differences import differences
from foparq.accuracy.error_share import ErrorShare, error_share, point_effects
from foparq.columns import Coordinates, Index, Reals
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Element, Reason, because
from foparq.evaluate.tied import tied_distances
from foparq.findings.ties import NOBODY, DistanceTies, Ends, PointTies
from foparq.model.tables import Checkpoints, Distances

_SIGNIFICANCE = 0.01  #: of each test; two-sided for the share, one-sided for the scatter
_BEYOND = 2.5758293035489004  #: standard deviations of a normal at that significance


def with_distances(elements: Sequence[Element], evidence: Evidence) -> tuple[Element, ...]:
    """Elements of coordinates, one an axis, with a remark on each outlier that distances contradict or bear out.

    The difference of the point in all axes is projected on each distance that ends there, runs between two points of
    the drawing and has no other outlier at its far end. The share of it that the distances show is estimated. All:
    the drawing is wrong there. None: the reference is. Nothing is said where the distances allow both or rule out
    both, as where the difference is perpendicular to all of them, where they scatter too much, or where nobody states
    how well points and distances were surveyed.
    """
    points, distances = evidence.delivery.checkpoints, evidence.delivery.distances
    ties = evidence.ties
    if points is None or distances is None or ties is None or ties.points is None or ties.distances is None:
        return tuple(elements)
    told = _told(elements, evidence, points, distances, ties.points, ties.distances)
    return tuple(_with(element, told) for element in elements)


def _with(element: Element, told: dict[str, Reason]) -> Element:
    mine = element.residuals.outliers if element.residuals is not None else ()
    why = [_of(told[id_], element.id) for id_ in mine if id_ in told]
    return replace(element, why=(*element.why, *why)) if why else element


def _of(reason: Reason, element: str) -> Reason:
    return replace(reason, fields=(("element", element), *reason.fields))


def _told(
    elements: Sequence[Element], evidence: Evidence, points: Checkpoints, distances: Distances, at: PointTies,
    ties: DistanceTies,
) -> dict[str, Reason]:  # fmt: skip
    """Remark on each outlying point by its id; an id that is given twice names no one point."""
    measured = [element.residuals for element in elements if element.residuals is not None]
    times = Counter(map(str, points.id))
    outlying = {id_ for one in measured for id_ in one.outliers}
    survey, tape = points.survey_sd, distances.survey_sd
    if not outlying or not len(ties.at) or survey is None or tape is None or not survey > 0.0 or not tape > 0.0:
        return {}
    # Where others differ by less than their survey, luck made them agree.
    usual = np.array([max(survey, one.rest or 0.0) for one in measured])
    if len(usual) != 3:  # noqa: PLR2004 - axes
        return {}
    found = differences(ties.delivered, distances.measured)
    counted = tied_distances(distances, evidence, "").rows
    wrong: Index = np.flatnonzero([str(id_) in outlying for id_ in points.id])
    usable = (ties.ends[counted] == Ends.POINTS) & np.isfinite(found[counted])
    made = {}
    for row in wrong.tolist():
        id_ = str(points.id[row])
        if times[id_] > 1:
            continue
        ending = counted[usable & _ends_at(ties.at[counted], row, wrong)]
        place, difference = at.delivered[row], at.delivered[row] - points.surveyed[row]
        if not len(ending) or not np.isfinite(place).any():
            continue
        far = np.where((ties.at[ending, 0] == row)[:, np.newaxis], ties.places[ending, 1], ties.places[ending, 0])
        reason = _judged(id_, place, difference, far, found[ending], usual, survey, tape)
        if reason is not None:
            made[id_] = reason
    return made


def _ends_at(at: Index, row: int, wrong: Index) -> Index:
    """(m,) bool: one end is this point, the other another place that is no outlier."""
    here = at == row
    far = np.where(here[:, 0], at[:, 1], at[:, 0])
    chosen: Index = (here.sum(axis=1) == 1) & ((far == NOBODY) | ~np.isin(far, wrong))
    return chosen


class Suspected(NamedTuple):
    """What distances say of the difference at a point."""

    which: str  #: ``"drawing"``, ``"reference"`` or ``""``
    shown: ErrorShare
    effects: Reals  #: (n,) what the difference would do to each distance, metres


def suspected(step: Coordinates, difference: Reals, found: Reals, usual: Reals, tape: float) -> Suspected:
    """Whether distances that end at a point point to the drawing or to the reference.

    Parameters
    ----------
    step : (n, 3) metres
        From the far ends to the point, as drawn.
    difference : (3,) metres
        Delivered minus surveyed at the point.
    found : (n,) metres
        Delivered minus measured distances.
    usual : (3,) metres
        Standard deviation of ordinary differences of points.
    tape : float, metres
        Standard deviation of the measured distances.
    """
    effects, directions = point_effects(step, difference, np.zeros_like(step))
    shown = error_share(effects, found, directions, point_sd=usual, sd=tape)
    none_fits, all_fits = (abs(shown.share - share) <= _BEYOND * shown.sd for share in (0.0, 1.0))
    if none_fits == all_fits or not shown.p >= _SIGNIFICANCE:
        return Suspected("", shown, effects)
    return Suspected("reference" if none_fits else "drawing", shown, effects)


_MESSAGES = {"reference": "outlier.contradicted", "drawing": "outlier.borne-out"}


def _judged(
    id_: str, place: Reals, difference: Reals, far: Reals, found: Reals, usual: Reals, survey: float, tape: float
) -> Reason | None:
    # A depth that nobody delivered is that of a flat drawing: the distance runs within it.
    which, shown, effects = suspected(np.nan_to_num(place - far), np.nan_to_num(difference), found, usual, tape)
    if not which:
        return None
    fields = {
        "id": id_, "n": len(found), "most": (float(np.abs(found).max()), "m"),
        "effect": (float(np.abs(effects).max()), "m"), "share": (round(shown.share, 2), "1"),
        "share_sd": (round(shown.sd, 2), "1"), "significance": (_SIGNIFICANCE, "1"), "tape": (tape, "m"),
        "survey": (survey, "m"),
    }  # fmt: skip
    return because(_MESSAGES[which], **fields)
