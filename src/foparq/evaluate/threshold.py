# SPDX-License-Identifier: MIT
"""Whether a root mean square error is below its limit, and whether the evidence can tell."""

import math
from dataclasses import dataclass

import numpy as np

from foparq.accuracy.bounds import rmse_less_reference, rmse_upper, rmse_with_reference, rounding_bound
from foparq.accuracy.moments import Moments, moments
from foparq.columns import Reals
from foparq.evaluate.evidence import Judgement, Parameters, judged
from foparq.evaluate.quality import ElementStatus, Reason, because
from foparq.evaluate.tied import Tied, too_small
from foparq.profile.elements import ReferencedSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """Differences of one element, delivered minus reference, metres."""

    kind: str  #: prefix of the messages: ``absolute`` or ``relative``
    id: str  #: of the element
    all: Reals  #: (n,) NaN where nothing was delivered
    resolution: float  #: half the last printed digit of delivered plus reference
    survey_sd: float | None  #: of the reference; ``None`` if not stated

    @property
    def survey(self) -> float | None:
        """Standard deviation of the survey; ``None`` if not stated. Nobody measures to nothing or less."""
        return self.survey_sd if self.survey_sd is not None and self.survey_sd > 0.0 else None

    @property
    def known(self) -> Reals:
        """(m,) differences that are numbers."""
        known: Reals = self.all[np.isfinite(self.all)]
        return known

    @property
    def missing(self) -> int:
        """Rows without a difference: they are counted, never dropped in silence."""
        return len(self.all) - len(self.known)

    def reason(self, case: str, **fields: object) -> Reason:
        """Reason of this kind of element."""
        return because(f"{self.kind}.{case}", element=self.id, **fields)


def judge_rmse(sample: Sample, spec: ReferencedSpec, limit: float) -> Judgement:
    """Status of an RMSE against a strict upper limit.

    The order of decisions:

    1. Fewer than ``spec.fewest`` differences decide nothing.
    2. Every benefit is given to the delivery: missing differences are zero, a survey that is too poor explains as much
       as it can, digits were rounded upward. If ``sqrt(rmse^2 n / N - sd^2) - bound >= limit`` all the same, it fails.
    3. Missing differences, a survey of unknown accuracy or one poorer than ``spec.reference_share`` of the limit, and a
       limit within the rounding of the digits leave it undecided; each is named.
    4. Otherwise it passes: ``rmse + bound < limit``.

    Parameters
    ----------
    sample : Sample
        At least one row.
    limit : float
        Metres.

    Returns
    -------
    Judgement
        A pass whose upper confidence bound reaches the limit says so.
    """
    found = moments(sample.known)
    if found.n == 0:
        return judged(ElementStatus.UNDECIDED, sample.reason("none-delivered", total=len(sample.all)))
    if found.n < max(spec.fewest, 1):
        return judged(ElementStatus.UNDECIDED, sample.reason("few", n=found.n, fewest=spec.fewest))
    bound = rounding_bound(sample.resolution)
    allowed = math.inf if spec.reference_share is None else spec.reference_share * limit
    poor = _poor_reference(sample, found, limit, allowed)
    granted = 0.0 if poor is None else math.inf if sample.survey is None else sample.survey
    least = rmse_less_reference(found.rmse * math.sqrt(found.n / len(sample.all)), granted) - bound
    value = (found.rmse, "m")
    if least >= limit:
        case = "fail" if poor is None and not sample.missing else "fail-all-the-same"
        reason = sample.reason(case, n=found.n, value=value, limit=(limit, "m"), least=(least, "m"))
        return judged(ElementStatus.FAIL, reason, *_narrowly(sample, found, spec, limit))
    open_questions = [poor] if poor is not None else []
    if sample.missing:
        open_questions.append(sample.reason("missing", missing=sample.missing, total=len(sample.all), value=value))
    below, above = found.rmse + bound < limit, found.rmse - bound >= limit
    if not below and not above:
        low, high = (max(0.0, found.rmse - bound), "m"), (found.rmse + bound, "m")
        open_questions.append(sample.reason("rounding", value=value, limit=(limit, "m"), low=low, high=high))
    if open_questions:
        return judged(ElementStatus.UNDECIDED, *open_questions)
    passed = sample.reason("pass", n=found.n, value=value, limit=(limit, "m"))
    return judged(ElementStatus.PASS, passed, *_remarks(sample, found, spec, limit))


def rmse_parameters(sample: Sample, spec: ReferencedSpec) -> Parameters:
    """Statistics that stand beside an RMSE."""
    found = moments(sample.known)
    rows = [
        ("mean", found.mean, "m"), ("sd", found.sd, "m"), ("rmse", found.rmse, "m"), ("n", float(found.n), "items"),
        ("missing", float(sample.missing), "items"), ("rounding", rounding_bound(sample.resolution), "m"),
    ]  # fmt: skip
    if found.n:
        rows.append(("rmse-upper", rmse_upper(found.rmse, found.n, confidence=spec.confidence), "m"))
        rows.append(("confidence", spec.confidence, "1"))
    if sample.survey is not None:
        rows.append(("survey-sd", sample.survey, "m"))
        rows.append(("rmse-with-survey", rmse_with_reference(found.rmse, sample.survey), "m"))
        rows.append(("rmse-less-survey", rmse_less_reference(found.rmse, sample.survey), "m"))
    return tuple(rows)


def _poor_reference(sample: Sample, found: Moments, limit: float, allowed: float) -> Reason | None:
    value, wanted = (found.rmse, "m"), (allowed, "m")
    if math.isinf(allowed):
        return None
    if sample.survey is None:
        return sample.reason("survey-unknown", value=value, limit=(limit, "m"), allowed=wanted)
    if sample.survey > allowed:
        survey = (sample.survey, "m")
        return sample.reason("survey-poor", value=value, limit=(limit, "m"), allowed=wanted, survey=survey)
    return None


def _remarks(sample: Sample, found: Moments, spec: ReferencedSpec, limit: float) -> tuple[Reason, ...]:
    upper = rmse_upper(found.rmse, found.n, confidence=spec.confidence)
    if upper < limit:
        return ()
    confidence = (spec.confidence, "1")
    return (sample.reason("upper", n=found.n, upper=(upper, "m"), limit=(limit, "m"), confidence=confidence),)


def _narrowly(sample: Sample, found: Moments, spec: ReferencedSpec, limit: float) -> tuple[Reason, ...]:
    """Which of several RMSE decides, where that of a better survey might have met the limit."""
    if sample.survey is None or sample.missing:
        return ()
    less = rmse_less_reference(found.rmse, sample.survey)
    if less >= limit:
        return ()
    upper = rmse_upper(found.rmse, found.n, confidence=spec.confidence)
    more = rmse_with_reference(found.rmse, sample.survey)
    told = {"over": (found.rmse - limit, "m"), "less": (less, "m"), "more": (more, "m"), "upper": (upper, "m")}
    return (sample.reason("measured", value=(found.rmse, "m"), limit=(limit, "m"), **told),)


def with_doubts(judgement: Judgement, tied: Tied, sample: Sample, remarks: tuple[Reason, ...] = ()) -> Judgement:
    """Judgement of an RMSE in the light of what its table has to do with the drawing.

    Parameters
    ----------
    tied : Tied
        What the sample was made from. Its doubts leave the judgement undecided, whatever the numbers say: they are
        numbers about something else. What shows a part of the differences only leaves a pass undecided.
    remarks : tuple of Reason
        Further remarks.
    """
    good, gross = too_small(sample.known, sample.survey, sample.resolution, sample.id)
    doubts = (*tied.doubts, *((good,) if good and gross else ()))
    small = (good,) if good and judgement.status is ElementStatus.PASS and not gross else ()
    remarks = (*small, *tied.remarks, *remarks)
    if doubts:
        # Reasons of a judgement that does not stand would be read as decisive.
        rest = judgement.why if judgement.status is ElementStatus.UNDECIDED else ()
        return judged(ElementStatus.UNDECIDED, *doubts, *rest, *remarks)
    if tied.one_way and judgement.status is ElementStatus.PASS:
        return judged(ElementStatus.UNDECIDED, *tied.one_way, *remarks)
    return judged(judgement.status, *judgement.why, *tied.one_way, *remarks)
