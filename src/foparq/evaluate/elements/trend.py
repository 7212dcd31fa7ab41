# SPDX-License-Identifier: MIT
"""Trend of coordinate differences: whether their mean is other than zero."""

import math

import numpy as np

from foparq.accuracy.moments import Moments, moments
from foparq.accuracy.normality import anderson_darling
from foparq.accuracy.student import StudentTest, sign_test, student_test
from foparq.columns import Reals
from foparq.evaluate.evidence import Evidence, Judgement, element, judged
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, Reason, because
from foparq.evaluate.tied import resolution_of, tied_points, too_small
from foparq.model.tables import Checkpoints
from foparq.profile.elements import AXES, TrendSpec

_MEASURE = "foparq:trend"
_FEWEST = 3  #: two differences have one degree of freedom: hardly any trend would show


@evaluates(TrendSpec, measure=_MEASURE)
def trend(spec: TrendSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Student t of the mean difference of each axis; the absolute value of t must not exceed the critical value.

    Returns
    -------
    tuple of Element
        ``Q6-X``, ``Q6-Y``, ``Q6-Z``. The mean is ISO 19157 measure 128, among the parameters. If the differences do not
        look normal a remark says so and gives the sign test, which needs no normality. That at least one of three axes
        shows a trend where there is none, ``1 - confidence^3``, is among the parameters and stands beside a failure.
    """
    points = evidence.delivery.checkpoints
    scope = evidence.files("checkpoints")
    if points is None or not len(points.id):
        case = "absolute.lost" if evidence.lost("checkpoints") else "absolute.none"
        ids = [f"{spec.id}-{axis}" for axis in AXES]
        return tuple(
            element(
                spec, _MEASURE, judged(ElementStatus.NOT_ASSESSED, because(case, element=id_)), id=id_, scope=scope,
                comparison="<=", method="directExternal",
            )
            for id_ in ids
        )  # fmt: skip
    return tuple(_axis(spec, points, evidence, axis) for axis in range(len(AXES)))


def _axis(spec: TrendSpec, points: Checkpoints, evidence: Evidence, axis: int) -> Element:
    id_, scope = f"{spec.id}-{AXES[axis]}", evidence.files("checkpoints")
    tied = tied_points(points, evidence, id_, fewest=spec.fewest)
    every = tied.differences[:, axis]
    known = every[np.isfinite(every)]
    found = moments(known)
    fewest = max(spec.fewest, _FEWEST)
    if found.n < fewest:
        few = because("absolute.few", element=id_, n=found.n, fewest=fewest)
        judgement = judged(ElementStatus.UNDECIDED, *tied.doubts, few)
        return element(
            spec, _MEASURE, judgement, id=id_, scope=scope, n=found.n, comparison="<=", method="directExternal",
            parameters=(("mean", found.mean, "m"), ("sd", found.sd, "m"), ("n", float(found.n), "items")),
        )  # fmt: skip
    test = student_test(known, confidence=spec.confidence)
    resolution = resolution_of(points, evidence, axis, tied.rows[np.isfinite(every)])
    judgement = _judge(id_, test, found, len(every), resolution)
    good, gross = too_small(known, points.survey_sd, resolution, id_)
    if good and gross and judgement.status is ElementStatus.FAIL:  # what was copied has the trend of its rounding
        judgement = judged(ElementStatus.UNDECIDED, good)
    if tied.doubts or tied.one_way:
        judgement = judged(ElementStatus.UNDECIDED, *(tied.doubts or tied.one_way))
    remarks, extra = _normality(id_, known, spec.confidence)
    alarm = 1.0 - spec.confidence ** len(AXES)
    if judgement.status is ElementStatus.FAIL and not math.isinf(test.t):
        several = {"axes": len(AXES), "confidence": (spec.confidence, "1"), "share": (alarm, "1")}
        remarks = (because("trend.several", element=id_, **several), *remarks)
    parameters = (
        ("mean", found.mean, "m"), ("sd", found.sd, "m"), ("n", float(found.n), "items"),
        ("freedom", float(test.freedom), ""), ("p", test.p, ""), ("confidence", spec.confidence, "1"),
        ("false-alarm", alarm, "1"), *extra,
    )  # fmt: skip
    return element(
        spec, _MEASURE, judged(judgement.status, *judgement.why, *remarks), id=id_, scope=scope, n=found.n,
        value=abs(test.t), limit=test.critical, comparison="<=", parameters=(*parameters, ("t", test.t, "")),
        method="directExternal",
    )  # fmt: skip


def _judge(id_: str, test: StudentTest, found: Moments, total: int, resolution: float) -> Judgement:
    fields = {
        "element": id_, "n": found.n, "mean": (found.mean, "m"), "t": (abs(test.t), ""),
        "critical": (test.critical, ""),
    }  # fmt: skip
    if total > found.n:
        missing = total - found.n
        return judged(ElementStatus.UNDECIDED, because("trend.missing", missing=missing, total=total, **fields))
    if abs(test.t) <= test.critical:
        return judged(ElementStatus.PASS, because("trend.pass", **fields))
    if abs(found.mean) <= resolution:
        # The mean is no larger than what rounding alone may have made of zero.
        return judged(ElementStatus.UNDECIDED, because("trend.rounding", resolution=(resolution, "m"), **fields))
    if math.isinf(test.t):
        return judged(ElementStatus.FAIL, because("trend.constant", element=id_, n=found.n, mean=(found.mean, "m")))
    return judged(ElementStatus.FAIL, because("trend.fail", **fields))


def _normality(
    id_: str, known: Reals, confidence: float
) -> tuple[tuple[Reason, ...], tuple[tuple[str, float, str], ...]]:
    if np.ptp(known) == 0.0:
        return (), ()
    normal = anderson_darling(known)
    if normal.p > 1.0 - confidence:
        return (), (("normality-p", normal.p, ""),)
    sign = sign_test(known)
    doubt = because("trend.not-normal", element=id_, p=(normal.p, ""), sign=(sign, ""))
    return (doubt,), (("normality-p", normal.p, ""), ("sign-p", sign, ""))
