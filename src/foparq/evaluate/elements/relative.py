# SPDX-License-Identifier: MIT
"""Relative positional accuracy: RMSE of delivered minus measured distances."""

from foparq.accuracy.moments import moments
from foparq.evaluate.evidence import Evidence, element, judged, limit_of
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, because
from foparq.evaluate.residuals import distance_residuals, naming_worst
from foparq.evaluate.threshold import Sample, judge_rmse, rmse_parameters, with_doubts
from foparq.evaluate.tied import tied_distances
from foparq.evaluate.weighed import half_step, outvoted, with_survey
from foparq.profile.elements import RelativeSpec

_MEASURE = "foparq:distance-rmse"


@evaluates(RelativeSpec, measure=_MEASURE)
def relative(spec: RelativeSpec, evidence: Evidence) -> tuple[Element, ...]:
    """RMSE of distances against the limit, strict ``<``.

    Returns
    -------
    tuple of one Element
        Distances that do not belong to the drawing leave it undecided; else
        :func:`foparq.evaluate.threshold.judge_rmse` has the order of decisions.
    """
    distances = evidence.delivery.distances
    scope = evidence.files("distances")
    limit, no_limit = limit_of(spec, evidence, "m", spec.id)
    if distances is None or not len(distances.id):
        case = because("relative.lost" if evidence.lost("distances") else "relative.none", element=spec.id)
        judgement = judged(ElementStatus.NOT_ASSESSED, case)
        return (element(spec, _MEASURE, judgement, scope=scope, limit=limit, comparison="<", method="directExternal"),)
    tied = tied_distances(distances, evidence, spec.id)
    sample = Sample(
        kind="relative", id=spec.id, all=tied.differences, resolution=distances.resolution,
        survey_sd=distances.survey_sd,
    )  # fmt: skip
    judgement = judged(ElementStatus.UNDECIDED, no_limit) if no_limit else judge_rmse(sample, spec, limit or 0.0)
    residuals = distance_residuals(distances, tied, evidence, spec.confidence)
    judgement = naming_worst(judgement, residuals, spec.id, limit)
    judgement = outvoted(judgement, sample, tied.rows, evidence, limit or 0.0)
    judgement = with_survey(judgement, sample, half_step(distances.resolution, distances.printed))
    judgement = with_doubts(judgement, tied, sample)
    found = moments(sample.known)
    made = element(
        spec, _MEASURE, judgement, scope=scope, n=found.n, value=found.rmse, limit=limit, comparison="<",
        parameters=rmse_parameters(sample, spec), method="directExternal", residuals=residuals,
    )  # fmt: skip
    return (made,)
