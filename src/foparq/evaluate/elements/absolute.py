# SPDX-License-Identifier: MIT
"""Absolute positional accuracy: RMSE of coordinate differences at checkpoints, each axis by itself."""

import math

import numpy as np

from foparq.accuracy.differences import differences
from foparq.accuracy.moments import moments
from foparq.evaluate.evidence import Evidence, element, judged, limit_of
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, because
from foparq.evaluate.threshold import Sample, judge_rmse, rmse_parameters
from foparq.model.tables import Checkpoints
from foparq.profile.elements import AXES, AbsoluteSpec


@evaluates(AbsoluteSpec, measure="39")
def absolute(spec: AbsoluteSpec, evidence: Evidence) -> tuple[Element, ...]:
    """One result an axis: measure 39, strict ``<``.

    Returns
    -------
    tuple of Element
        ``Q1-X``, ``Q1-Y``, ``Q1-Z``. See :func:`foparq.evaluate.threshold.judge_rmse` for the order of decisions; what
        would pass stays undecided if several points stand at one place.
    """
    return tuple(_axis(spec, evidence, axis) for axis in range(len(AXES)))


def _axis(spec: AbsoluteSpec, evidence: Evidence, axis: int) -> Element:
    id_ = f"{spec.id}-{AXES[axis]}"
    points, scope = evidence.delivery.checkpoints, evidence.files("checkpoints")
    limit, no_limit = limit_of(spec, evidence, "m", id_)
    if points is None or not len(points.id):
        case = because("absolute.lost" if evidence.lost("checkpoints") else "absolute.none", element=id_)
        return element(
            spec, "39", judged(ElementStatus.NOT_ASSESSED, case), id=id_, scope=scope, limit=limit, comparison="<",
            method="directExternal",
        )  # fmt: skip
    sample = Sample(
        kind="absolute", id=id_, all=differences(points.delivered[:, axis], points.surveyed[:, axis]),
        resolution=float(points.resolution[axis]), survey_sd=points.survey_sd,
    )  # fmt: skip
    judgement = judged(ElementStatus.UNDECIDED, no_limit) if no_limit else judge_rmse(sample, spec, limit or 0.0)
    if judgement.status is ElementStatus.PASS and (repeated := _repeated(points)):
        case = because("absolute.repeated", element=id_, n=repeated, total=len(points.id))
        judgement = judged(ElementStatus.UNDECIDED, case)
    found = moments(sample.known)
    return element(
        spec, "39", judgement, id=id_, scope=scope, n=found.n, value=found.rmse, limit=limit, comparison="<",
        parameters=(*rmse_parameters(sample, spec), ("rmse-xyz", _in_space(points), "m")), method="directExternal",
    )  # fmt: skip


def _repeated(points: Checkpoints) -> int:
    """Points at a place that another point already stands for: one place measured twice is one checkpoint."""
    return len(points.id) - len(np.unique(points.surveyed, axis=0))


def _in_space(points: Checkpoints) -> float:
    """RMSE of the points that have all three coordinates: ``sqrt(RMSE_X^2 + RMSE_Y^2 + RMSE_Z^2)``; NaN if none has."""
    every = differences(points.delivered, points.surveyed)
    whole = every[np.isfinite(every).all(axis=1)]
    return math.hypot(*(moments(whole[:, axis]).rmse for axis in range(3))) if len(whole) else math.nan
