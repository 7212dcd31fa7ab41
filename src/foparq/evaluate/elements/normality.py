# SPDX-License-Identifier: MIT
"""Normality of distance differences."""

import numpy as np

from foparq.accuracy.moments import moments
from foparq.accuracy.normality import anderson_darling
from foparq.evaluate.evidence import Evidence, Judgement, Parameters, element, judged
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, because
from foparq.evaluate.tied import tied_distances
from foparq.profile.elements import NormalitySpec

_MEASURE = "foparq:normality"
_FEWEST = 3  #: two numbers are normal in one way only


@evaluates(NormalitySpec, measure=_MEASURE)
def normality(spec: NormalitySpec, evidence: Evidence) -> tuple[Element, ...]:
    """Anderson-Darling p of the distance differences; it must exceed ``1 - confidence``.

    Returns
    -------
    tuple of one Element
    """
    distances = evidence.delivery.distances
    scope, limit = evidence.files("distances"), round(1.0 - spec.confidence, 12)
    if distances is None or not len(distances.id):
        case = because("relative.lost" if evidence.lost("distances") else "relative.none", element=spec.id)
        judgement = judged(ElementStatus.NOT_ASSESSED, case)
        return (element(spec, _MEASURE, judgement, scope=scope, limit=limit, comparison=">", method="directExternal"),)
    tied = tied_distances(distances, evidence, spec.id)
    every = tied.differences
    known = every[np.isfinite(every)]
    found = moments(known)
    value: float | None = None
    parameters: Parameters = (("n", float(found.n), "items"), ("sd", found.sd, "m"))
    fewest = max(spec.fewest, _FEWEST)
    if found.n < fewest:
        judgement = judged(ElementStatus.UNDECIDED, because("relative.few", element=spec.id, n=found.n, fewest=fewest))
    elif not found.sd > 0.0:
        judgement = judged(ElementStatus.UNDECIDED, because("normality.constant", element=spec.id, n=found.n))
    else:
        test = anderson_darling(known)
        value = test.p
        parameters = (*parameters, ("a2", test.a2, ""), ("a2-star", test.a2_star, ""), ("p", test.p, ""))
        judgement = _judge(spec.id, found.n, len(every), test.p, limit)
        if tied.doubts:
            judgement = judged(ElementStatus.UNDECIDED, *tied.doubts)
    made = element(
        spec, _MEASURE, judgement, scope=scope, n=found.n, value=value, limit=limit, comparison=">",
        parameters=parameters, method="directExternal",
    )  # fmt: skip
    return (made,)


def _judge(name: str, n: int, total: int, p: float, limit: float) -> Judgement:
    fields = {"element": name, "n": n, "p": (p, ""), "limit": (limit, "")}
    if n < total:
        return judged(ElementStatus.UNDECIDED, because("normality.missing", missing=total - n, total=total, **fields))
    if p > limit:
        return judged(ElementStatus.PASS, because("normality.pass", **fields))
    return judged(ElementStatus.FAIL, because("normality.fail", **fields))
