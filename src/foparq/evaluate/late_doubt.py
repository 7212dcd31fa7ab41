# SPDX-License-Identifier: MIT
"""A doubt that comes up after the verdict, while it is written down."""

from collections.abc import Sequence
from dataclasses import replace

from foparq.evaluate.quality import QualityReport, Verdict, because


def without_reports(quality: QualityReport, reports: Sequence[str]) -> QualityReport:
    """Quality report that tells of reports which could not be made: no acceptance stands, a rejection does.

    Parameters
    ----------
    reports : sequence of str
        Names of their files.
    """
    reason = because("verdict.crashed-reports", reports=tuple(reports))
    if quality.verdict is Verdict.ACCEPTED:
        first = (quality.terms,) if quality.terms else ()
        return replace(quality, verdict=Verdict.UNDECIDED, why=(*first, reason))
    if quality.verdict is Verdict.REJECTED:
        return replace(quality, remarks=(*quality.remarks, reason))
    return replace(quality, why=(*quality.why, reason))
