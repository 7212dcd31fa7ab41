# SPDX-License-Identifier: MIT
"""What is concluded of files without a manifest: faults; none; or what nobody looked at."""

import itertools
from typing import Any

import pytest
from tests.evaluate.deliveries import drawing, not_run, outcome, profile, source

from foparq.evaluate.evaluate import evaluate
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import QualityReport, Verdict, because
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, SetAside
from foparq.model.delivery import Delivery, SourceStatus
from foparq.model.drawing import Skipped, SkippedReason

SEEN = outcome("a", checked=1)


def concluded(*outcomes: Outcome, parts: Any = None, sources: Any = None, **given: Any) -> QualityReport:
    """Conclusion on one sound drawing, unless others are given."""
    parts = (drawing(),) if parts is None else parts
    sources = tuple(source(part.path) for part in parts) if sources is None else sources
    delivery = Delivery(title="", sources=sources, parts=parts)
    evidence = Evidence(delivery=delivery, outcomes=outcomes, counts=None, scale=None, **given)
    return evaluate(profile(), evidence, loose=True).quality


def told(report: QualityReport) -> list[tuple[str, dict[str, object]]]:
    return [(reason.message, dict(reason.fields)) for reason in report.why]


def test_nothing_found_where_everything_was_seen_is_accepted() -> None:
    report = concluded(SEEN)
    assert (report.verdict, told(report)) == (Verdict.ACCEPTED, [("files.none", {})])
    assert not report.refused


def test_one_fault_rejects_and_what_was_not_seen_is_told_after_it() -> None:
    report = concluded(SEEN, faults=1, crashed=True)
    assert report.verdict is Verdict.REJECTED
    assert told(report) == [("files.faults", {"n": 1}), ("verdict.crashed", {})]


@pytest.mark.parametrize(
    "idle",
    [
        [], [outcome("a", checked=0)], [outcome("a", checked=1, about_file=True)],
        [outcome("a", checked=1, helper=True)], [outcome("a", checked=1, about_file=True, helper=True)],
        [outcome("a", checked=1, source="b.dxf")], [not_run("a", Because.NOTHING)],
    ],
)  # fmt: skip
def test_a_drawing_at_which_no_chosen_rule_looked_is_undecided(idle: list[Outcome]) -> None:
    report = concluded(*idle)
    assert (report.verdict, told(report)) == (Verdict.UNDECIDED, [("files.nothing", {"file": "a.dxf"})])
    assert concluded(*idle, SEEN).verdict is Verdict.ACCEPTED


def test_every_drawing_speaks_for_itself() -> None:
    parts = (drawing("a.dxf"), drawing("b.dxf"), drawing("c.dxf"))
    report = concluded(SEEN, outcome("a", checked=1, source="c.dxf"), parts=parts)
    assert told(report) == [("files.nothing", {"file": "b.dxf"})]


@pytest.mark.parametrize(
    ("status", "message"), [(SourceStatus.REFUSED, "verdict.refused"), (SourceStatus.MISSING, "verdict.missing")]
)
def test_a_file_that_could_not_be_read_is_the_only_reason_where_it_is_the_only_file(
    status: SourceStatus, message: str
) -> None:
    report = concluded(parts=(), sources=(source("x.dxf", status=status),))
    assert (report.verdict, told(report)) == (Verdict.UNDECIDED, [(message, {"files": ["x.dxf"]})])
    assert report.refused


@pytest.mark.parametrize("statuses", list(itertools.product(SourceStatus, repeat=2)), ids=str)
def test_one_lost_file_among_others_is_refused(statuses: tuple[SourceStatus, SourceStatus]) -> None:
    sources = tuple(source(f"{n}.dxf", status=status) for n, status in enumerate(statuses))
    lost = bool({SourceStatus.REFUSED, SourceStatus.MISSING} & set(statuses))
    assert concluded(SEEN, sources=sources).refused is lost


def test_no_drawing_at_all_is_undecided() -> None:
    for sources in ((), (source("a.csv", "other"),)):
        report = concluded(parts=(), sources=sources)
        assert (report.verdict, told(report)) == (Verdict.UNDECIDED, [("files.no-drawing", {})])


def test_things_behind_which_faults_may_hide_are_counted_by_what_they_are() -> None:
    skipped = tuple(
        Skipped(kind=kind, count=count, reason=reason, layer="0")
        for kind, count, reason in [
            ("PROXY", 2, SkippedReason.PROXY), ("3DFACE", 1, SkippedReason.SURFACE),
            ("PROXY", 3, SkippedReason.MALFORMED), ("VIEWPORT", 4, SkippedReason.VIEWPORT),
        ]
    )  # fmt: skip
    report = concluded(SEEN, parts=(drawing(skipped=skipped),))
    assert report.verdict is Verdict.UNDECIDED
    assert told(report) == [("files.unseen", {"file": "a.dxf", "parts": ["1 × 3DFACE", "5 × PROXY"]})]


def test_a_block_that_was_not_taken_apart_is_undecided_whichever_rules_were_chosen() -> None:
    block = Skipped(kind="INSERT", name="B", count=2, reason=SkippedReason.BLOCK_BOMB, layer="0")
    report = concluded(SEEN, parts=(drawing(skipped=(block,)),))
    assert report.verdict is Verdict.UNDECIDED
    assert told(report) == [("files.unseen", {"file": "a.dxf", "parts": ["2 × INSERT B"]})]


def test_rules_that_did_not_run_are_told_by_reason_and_crashes_once() -> None:
    report = concluded(
        SEEN, not_run("z", Because.LIMIT), not_run("b", Because.LIMIT), not_run("c", Because.NOTHING),
        not_run("d", Because.CRASHED), not_run("e", Because.UNIT_UNKNOWN), not_run("f", Because.UNIT_UNKNOWN),
    )  # fmt: skip
    assert report.verdict is Verdict.UNDECIDED
    assert told(report) == [
        ("verdict.crashed-rules", {"rules": ["d (a.dxf)"]}), ("files.limit", {"files": ["b · a.dxf", "z · a.dxf"]}),
        ("files.unit-unknown", {"files": ["a.dxf"]}),
    ]  # fmt: skip


def test_items_that_no_rule_could_judge_are_named_up_to_ten_and_counted_once() -> None:
    odd = [SetAside(item=f"{n}", layer="L", rule="") for n in range(11)]
    settled = SetAside(item="S", layer="L", rule="invalid-geometry")
    silent = SetAside(item="T", layer="L", rule="zero-length", told=False)
    again = outcome("b", checked=1, aside=(odd[0], silent))
    report = concluded(outcome("a", checked=1, aside=(settled, *odd)), again)
    assert report.verdict is Verdict.UNDECIDED
    shown = [*(f"{n} (L)" for n in range(10)), because("list.more", n=2)]
    assert told(report) == [("files.unfit", {"items": shown, "n": 12})]
    assert concluded(outcome("a", checked=1, aside=(settled,))).verdict is Verdict.ACCEPTED
