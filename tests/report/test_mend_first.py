# SPDX-License-Identifier: MIT
"""What to mend first is ordered by what it does to the verdict; remarks stand apart from what decides."""

from dataclasses import replace

from foparq.evaluate.quality import ElementStatus, Verdict, because
from foparq.report.page.findings import group_findings
from foparq.report.page.tables import Cause, headline
from foparq.report.record import AuditRecord
from foparq.report.words import Words

EN = Words("en")


def causes(record: AuditRecord, **statuses: ElementStatus) -> tuple[Cause, ...]:
    quality = record.quality
    elements = tuple(
        replace(one, status=statuses.get(one.id, ElementStatus.PASS), why=(because("absolute.none", element=one.id),))
        for one in quality.elements
    )
    record = replace(record, quality=replace(quality, elements=elements))
    return headline(EN, record, group_findings(record), "").causes


def test_faults_that_a_failing_rate_counts_come_before_more_frequent_ones(rejected: AuditRecord) -> None:
    """Q3 of this record counts undershoots and overshoots; everything else decides nothing."""
    first = causes(rejected, Q3=ElementStatus.FAIL)
    assert [cause.anchor for cause in first[:2]] == ["r-TOP011", "r-TOP012"]
    assert len({cause.anchor for cause in first}) == len(first)


def test_a_failing_element_without_faults_stands_for_itself(rejected: AuditRecord) -> None:
    first = causes(rejected, **{"Q1-X": ElementStatus.FAIL, "Q5": ElementStatus.UNDECIDED})
    assert [cause.anchor for cause in first[:2]] == ["e-Q1-X", "e-Q5"]
    assert "Q1-X" in first[0].mend
    assert not first[0].found


def test_failing_elements_come_before_open_ones(rejected: AuditRecord) -> None:
    first = causes(rejected, **{"Q1-X": ElementStatus.NOT_ASSESSED, "Q5": ElementStatus.FAIL})
    assert [cause.anchor for cause in first[:2]] == ["e-Q5", "e-Q1-X"]


def test_remarks_stand_apart(rejected: AuditRecord) -> None:
    quality = replace(rejected.quality, verdict=Verdict.UNDECIDED, remarks=(because("faulty.free", element="Q3", n=2),))
    told = headline(EN, replace(rejected, quality=quality), (), "")
    assert len(told.remarks) == 1
    assert not set(told.remarks) & set(told.why)


def test_what_stands_above_is_not_said_again(rejected: AuditRecord) -> None:
    reason = because("absolute.none", element="Q1-X")
    said = replace(rejected, quality=replace(rejected.quality, why=(reason,)))
    (first, *_) = causes(said, **{"Q1-X": ElementStatus.FAIL})
    assert (first.anchor, first.mend) == ("e-Q1-X", "")
