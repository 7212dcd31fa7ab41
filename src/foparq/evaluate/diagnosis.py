# SPDX-License-Identifier: MIT
"""What the differences of checkpoints have in common where positions fail: a shift, a rotation, a scale, or nothing."""

import math
from collections.abc import Sequence

import numpy as np

from foparq.accuracy.moments import moments
from foparq.accuracy.similarity import Part, fit_similarity
from foparq.accuracy.student import student_test
from foparq.columns import Coordinates, Flags, Reals
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Element, ElementStatus, Reason, because
from foparq.evaluate.tied import tied_points
from foparq.profile.elements import AXES, AbsoluteSpec, TrendSpec
from foparq.profile.schema import Profile

_FEWEST = 3  #: two differences have one degree of freedom


def diagnosis(profile: Profile, evidence: Evidence, elements: Sequence[Element]) -> tuple[Reason, ...]:
    """What explains that positions fail, where a test bears it out.

    A shift, if the mean of a failing axis is significant; where that does not explain it, a rotation or a scale, if the
    least squares fit of one is; else the outliers. Each must hold without the outliers as well: one point that is wrong
    is no shift of the whole.

    Returns
    -------
    tuple of Reason
        Empty if positions do not fail, or nothing can be said.
    """
    points = evidence.delivery.checkpoints
    spec = next((one for one in profile.elements if isinstance(one, AbsoluteSpec) and one.applicable), None)
    if points is None or spec is None:
        return ()
    by_id = {element.id: element for element in elements}
    axes = {n: by_id[id_] for n, axis in enumerate(AXES) if (id_ := f"{spec.id}-{axis}") in by_id}
    failing = [n for n, element in axes.items() if element.status is ElementStatus.FAIL]
    if not failing:
        return ()
    confidence = next((one.confidence for one in profile.elements if isinstance(one, TrendSpec)), spec.confidence)
    tied = tied_points(points, evidence, spec.id)
    outlying = {id_ for element in axes.values() if element.residuals for id_ in element.residuals.outliers}
    kept: Flags = ~np.isin(points.id[tied.rows].astype(str), sorted(outlying))
    shift, explained = _shift(tied.differences, kept, [(n, axes[n]) for n in failing], confidence)
    why = [shift] if shift else []
    if left := [n for n in failing if n not in explained]:
        why += _fits(points.surveyed[tied.rows][kept], tied.differences[kept], left, confidence)
    if outlying and not why:
        why.append(because("diagnosis.outliers", ids=sorted(outlying), confidence=(confidence, "1")))
    return tuple(why)


def _shift(
    every: Coordinates, kept: Flags, failing: Sequence[tuple[int, Element]], confidence: float
) -> tuple[Reason | None, set[int]]:
    """A significant mean of failing axes, and the axes that would not fail without it."""
    told, means, rests, explained = [], [], [], set()
    for axis, element in failing:
        sample = every[:, axis]
        if _significant(sample, confidence) and _significant(sample[kept], confidence):
            found = moments(sample[np.isfinite(sample)])
            rest = math.sqrt(max(0.0, found.rmse**2 - found.mean**2))
            told.append(AXES[axis])
            means.append((found.mean, "m"))
            rests.append((rest, "m"))
            if element.limit is not None and rest < element.limit:
                explained.add(axis)
    if not told:
        return None, explained
    return because("diagnosis.shift", axes=told, means=means, rest=rests, confidence=(confidence, "1")), explained


def _significant(sample: Reals, confidence: float) -> bool:
    known = sample[np.isfinite(sample)]
    if len(known) < _FEWEST:
        return False
    test = student_test(known, confidence=confidence)
    return abs(test.t) > test.critical


def _fits(places: Coordinates, found: Coordinates, failing: Sequence[int], confidence: float) -> list[Reason]:
    whole = np.flatnonzero(np.isfinite(found).all(axis=0))
    if not len(found) or not len(whole):
        return []
    fit = fit_similarity(places[:, whole], found[:, whole])
    if fit is None:
        return []
    axes = [column for column, axis in enumerate(whole) if axis in failing]

    def told(part: Part | None, message: str, size: object) -> list[Reason]:
        if part is None or not part.p < 1.0 - confidence or not axes:
            return []
        rest = [(moments(part.left[:, column]).rmse, "m") for column in axes]
        names = [AXES[whole[column]] for column in axes]
        return [because(message, size=size, p=(part.p, ""), axes=names, rest=rest, confidence=(confidence, "1"))]

    angle = "" if fit.rotation is None else f"{math.degrees(fit.rotation.size):.3g}°"
    change = (fit.scale.size, "1") if fit.scale is not None else ""
    return told(fit.rotation, "diagnosis.rotation", angle) + told(fit.scale, "diagnosis.scale", change)
