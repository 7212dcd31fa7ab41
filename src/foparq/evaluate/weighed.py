# SPDX-License-Identifier: MIT
"""What stands behind a result that passes: rows that nobody can tie, and a survey that its own digits contradict."""

import math

import numpy as np

from foparq.columns import Flags, Index, Reals
from foparq.evaluate.evidence import Evidence, Judgement, judged
from foparq.evaluate.quality import ElementStatus, Reason, because
from foparq.evaluate.threshold import Sample
from foparq.findings.ties import Ends

_GROSS = 0.1  #: share of what rounding alone adds, below which a stated survey is no slip


def outvoted(judgement: Judgement, sample: Sample, rows: Index, evidence: Evidence, limit: float) -> Judgement:
    """Judgement of distances, undecided if names alone make it pass.

    Distances whose ends are names only may be one distance under many names. A pass must therefore stand without them,
    if some are between points of the drawing, and if all those that are no longer and no shorter than one another than
    can be seen have together the weight of one.

    Parameters
    ----------
    sample : Sample
        Differences of the rows that count.
    rows : (m,) int
        Their rows in the table.
    limit : float
        Metres.
    """
    ties = evidence.ties.distances if evidence.ties else None
    if ties is None or judgement.status is not ElementStatus.PASS:
        return judgement
    known: Flags = np.isfinite(sample.all)
    names: Flags = known & (ties.ends[rows] == Ends.NAMES)
    if not names.any():
        return judgement
    said = {"n": int(names.sum()), "total": int(known.sum()), "limit": (limit, "m")}
    tied = sample.all[known & ~names]
    if len(tied) and (alone := math.sqrt(float(np.mean(tied**2)))) >= limit:
        return judged(
            ElementStatus.UNDECIDED, because("relative.names-outvote", element=sample.id, value=(alone, "m"), **said)
        )
    if not len(ties.alike):
        return judgement
    kept = rows[known]
    _, group = np.unique(np.where(names[known], ties.alike[kept], -1 - kept), return_inverse=True)
    each = np.bincount(group, weights=sample.all[known] ** 2) / np.bincount(group)
    if (alone := math.sqrt(float(np.mean(each)))) >= limit:
        why = because("relative.names-alike", element=sample.id, value=(alone, "m"), lengths=len(each), **said)
        return judged(ElementStatus.UNDECIDED, why)
    return judgement


def finer_than_digits(sample: Sample, printed: float) -> tuple[Reason | None, bool]:
    """Whether a survey is said to be better than its own rounded digits can be, and whether grossly.

    A number that is rounded to a step has at least the standard deviation ``step / sqrt(12)``, whatever measured it.

    Parameters
    ----------
    printed : float, metres
        Half the last printed digit of what was surveyed.
    """
    rounding = printed / math.sqrt(3.0)
    if sample.survey is None or not sample.survey < rounding * (1.0 - 1e-9):
        return None, False
    said = {"survey": (sample.survey, "m"), "rounding": (rounding, "m"), "step": (2 * printed, "m")}
    gross = sample.survey < _GROSS * rounding
    return sample.reason("survey-impossible" if gross else "survey-finer", **said), gross


def with_survey(judgement: Judgement, sample: Sample, printed: float) -> Judgement:
    """Judgement of an RMSE in the light of the digits of its survey; a pass on what they contradict is undecided."""
    reason, gross = finer_than_digits(sample, printed)
    if reason is None or judgement.status is not ElementStatus.PASS:
        return judgement
    if gross:
        return judged(ElementStatus.UNDECIDED, reason)
    return judged(judgement.status, *judgement.why, reason)


def half_step(resolution: float, printed: Reals | float) -> float:
    """Half the last printed digit of what was surveyed, of that of both and of that of what was delivered."""
    return max(0.0, resolution - float(printed))
