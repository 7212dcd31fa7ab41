# SPDX-License-Identifier: MIT
"""What to mend first is ordered by what it does to the verdict; remarks stand apart from what decides."""

from dataclasses import replace

from foparq.evaluate.quality import (
    BalanceState,
    ClassBalance,
    ElementStatus,
    Residual,
    Residuals,
    Standing,
    Verdict,
    because,
)
from foparq.report.page.findings import group_findings
from foparq.report.page.mending import Cause
from foparq.report.page.tables import headline
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


def test_a_failing_element_names_the_points_that_make_it_fail(rejected: AuditRecord) -> None:
    rows = tuple(
        Residual(
            id=id_, difference=found, normalised=0.0, expected=0.0, standing=Standing.COUNTED, outlier=id_ == "P7",
            drawing="fachada.dxf", item="E7", layer="JANELA",
        )
        for id_, found in (("P1", 0.06), ("P7", -0.04894))
    )  # fmt: skip
    of_axis = Residuals(axis="X", rows=rows, significance=0.05, most=1, n=2, rmse=0.05, rest=0.06)
    quality = rejected.quality
    elements = tuple(replace(one, residuals=of_axis if one.id == "Q1-X" else None) for one in quality.elements)
    measured = replace(rejected, quality=replace(quality, elements=elements))
    (first, *_) = causes(measured, **{"Q1-X": ElementStatus.FAIL})
    assert first.mend == "P7 \N{MINUS SIGN}48.94 mm (fachada.dxf E7 JANELA)"


def test_classes_that_are_short_are_named_and_counting_is_the_work_of_whoever_decides(rejected: AuditRecord) -> None:
    short = ClassBalance(
        feature_class="window", facade="N", state=BalanceState.SHORT, required=27, optional=0, found=(24, 24),
        missing=(3, 3), surplus=(0, 0), ids=(), rows=(),
    )  # fmt: skip
    open_ = replace(short, feature_class="door", state=BalanceState.OPEN, found=(2, 4), missing=(0, 2))
    quality = replace(rejected.quality, balances=(short, open_))
    omission = replace(quality.elements[0], id="Q5", measure_id="7", residuals=None, details=(), required=True)
    failing = replace(omission, status=ElementStatus.FAIL, why=(because("omission.fail", element="Q5"),))
    asked = (because("omission.interval", element="Q5"),)
    asking = replace(omission, status=ElementStatus.UNDECIDED, why=asked)
    spoken = (("en", "window / N: 3 missing", "door / N"), ("pt-BR", "janela / N: faltam 3", "porta / N"))
    for language, missing, counted in spoken:
        words = Words(language)
        told = headline(words, replace(rejected, quality=replace(quality, elements=(failing,))), (), "")
        assert (told.causes[0].mend, told.tasks) == (missing, ())
        left_open = replace(quality, elements=(asking,), remarks=(), why=())
        told = headline(words, replace(rejected, quality=left_open), (), "")
        assert told.causes == ()
        assert [task.title for task in told.tasks] == [counted]
        assert "2" in told.tasks[0].mend
        assert "4" in told.tasks[0].mend


def test_what_stands_above_is_not_said_again(rejected: AuditRecord) -> None:
    reason = because("absolute.none", element="Q1-X")
    said = replace(rejected, quality=replace(rejected.quality, why=(reason,)))
    (first, *_) = causes(said, **{"Q1-X": ElementStatus.FAIL})
    assert (first.anchor, first.mend) == ("e-Q1-X", "")
