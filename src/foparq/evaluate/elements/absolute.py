# SPDX-License-Identifier: MIT
"""Absolute positional accuracy: RMSE of coordinate differences at checkpoints, each axis by itself."""

import math

import numpy as np

from foparq.accuracy.moments import moments
from foparq.columns import Reals
from foparq.evaluate.beside import with_meshes
from foparq.evaluate.evidence import Evidence, element, judged, limit_of
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, because
from foparq.evaluate.residuals import naming_worst, point_residuals
from foparq.evaluate.threshold import Sample, judge_rmse, rmse_parameters, with_doubts
from foparq.evaluate.tied import resolution_of, tied_points, unchecked
from foparq.evaluate.weighed import half_step, with_survey
from foparq.evaluate.witnessed import with_distances
from foparq.profile.elements import AXES, AbsoluteSpec


@evaluates(AbsoluteSpec, measure="39")
def absolute(spec: AbsoluteSpec, evidence: Evidence) -> tuple[Element, ...]:
    """One result an axis: measure 39, strict ``<``.

    Returns
    -------
    tuple of Element
        ``Q1-X``, ``Q1-Y``, ``Q1-Z``. Points that are not in the drawing, or repeat the survey too well, leave it
        undecided; else :func:`foparq.evaluate.threshold.judge_rmse` has the order of decisions.
    """
    return with_distances([_axis(spec, evidence, axis) for axis in range(len(AXES))], evidence)


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
    tied = tied_points(points, evidence, id_, fewest=spec.fewest)
    tied = with_meshes(tied, evidence, id_, limit=limit, fewest=spec.fewest)
    resolution = resolution_of(points, evidence, axis, tied.rows[np.isfinite(tied.differences[:, axis])])
    sample = Sample(
        kind="absolute", id=id_, all=tied.differences[:, axis], resolution=resolution, survey_sd=points.survey_sd
    )
    judgement = judged(ElementStatus.UNDECIDED, no_limit) if no_limit else judge_rmse(sample, spec, limit or 0.0)
    residuals = point_residuals(points, tied, evidence, axis, spec.confidence)
    judgement = naming_worst(judgement, residuals, id_, limit)
    judgement = with_survey(judgement, sample, half_step(float(points.resolution[axis]), float(points.printed[axis])))
    judgement = with_doubts(judgement, tied, sample, unchecked(evidence, axis, id_))
    found = moments(sample.known)
    return element(
        spec, "39", judgement, id=id_, scope=scope, n=found.n, value=found.rmse, limit=limit, comparison="<",
        parameters=(*rmse_parameters(sample, spec), ("rmse-xyz", _in_space(tied.differences), "m")),
        method="directExternal", residuals=residuals,
    )  # fmt: skip


def _in_space(every: Reals) -> float:
    """RMSE of the points that have all three coordinates: ``sqrt(RMSE_X^2 + RMSE_Y^2 + RMSE_Z^2)``; NaN if none has."""
    whole = every[np.isfinite(every).all(axis=1)]
    return math.hypot(*(moments(whole[:, axis]).rmse for axis in range(3))) if len(whole) else math.nan
