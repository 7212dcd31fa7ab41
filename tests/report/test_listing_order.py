# SPDX-License-Identifier: MIT
"""Findings on the page: the gravest first, numbered in a row, marks of faults on top."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely

from foparq.findings.table import Findings, Severity, join_findings
from foparq.model.drawing import Drawing
from foparq.report.page import findings as module
from foparq.report.page.drawing import picture_of
from foparq.report.page.findings import group_findings, group_view, listing_of, shown_rows
from foparq.report.page.marks import mark_views
from foparq.report.record import AuditRecord
from foparq.report.words import Words

Plant = Callable[..., Findings]
ORDER = ("critical", "major", "minor", "note")


def record_of(rejected: AuditRecord, *tables: Findings) -> AuditRecord:
    return replace(rejected, findings=join_findings(tables), outcomes=())


def rows(count: int, x: float = 1.0) -> list[tuple[str, str, shapely.Point, float]]:
    return [(str(n), "0", shapely.Point(x, 12.5, n), 0.004) for n in range(count)]


def test_severities_from_the_gravest() -> None:
    assert tuple(severity.value for severity in Severity) == ORDER


def test_rules_by_severity_then_number_then_code(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    record = record_of(
        rejected,
        plant(drawing, "DOM002", "hidden-entities", rows(9), severity="note"),
        plant(drawing, "TOP011", "undershoot", rows(2), severity="minor"),
        plant(drawing, "TOP012", "overshoot", rows(3), severity="minor"),
        plant(drawing, "GEO002", "zero-length", rows(2), severity="minor"),
        plant(drawing, "TOP001", "duplicate", rows(1), severity="critical"),
        plant(drawing, "TOP013", "free-end", rows(1), severity="major"),
    )
    groups = group_findings(record)
    assert [group.rule for group in groups] == ["TOP001", "TOP013", "TOP012", "GEO002", "TOP011", "DOM002"]
    assert [group.severity for group in groups] == ["critical", "major", "minor", "minor", "minor", "note"]
    # Numbers run on from rule to rule.
    assert [group.first for group in groups] == [1, 2, 3, 6, 8, 10]
    assert len(shown_rows(groups)) == 18


def test_within_a_rule_the_gravest_come_first(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    tables = [
        plant(drawing, "TOP011", "undershoot", rows(2, x), severity=ORDER[n]) for n, x in ((3, 3), (1, 1), (2, 2))
    ]
    (group,) = group_findings(record_of(rejected, *tables))
    findings = record_of(rejected, *tables).findings
    assert findings.severity[group.rows].tolist() == ["major"] * 2 + ["minor"] * 2 + ["note"] * 2
    assert group.severity == "major"


@pytest.mark.parametrize(("in_all", "each"), [(12, 5), (11, 3)])
def test_every_rule_is_listed_up_to_its_share(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, in_all: int, each: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "WRITTEN", 5)
    monkeypatch.setattr(module, "IN_ALL", in_all)
    monkeypatch.setattr(module, "max", lambda _, share: share, raising=False)  # no least share in so small a list
    record = record_of(
        rejected, *(plant(drawing, f"TOP01{n}", name, rows(4)) for n, name in ((1, "undershoot"), (2, "overshoot"))),
        plant(drawing, "TOP013", "free-end", rows(4)),
    )  # fmt: skip
    groups = group_findings(record)
    assert [len(group.shown) for group in groups] == [min(4, each)] * 3
    assert [group.found for group in groups] == [4, 4, 4] if in_all == 12 else True


def test_marks_of_faults_lie_on_top_of_notes(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    nowhere = [("9", "0", shapely.Point(), 0.1)]
    elsewhere = plant(replace(drawing, path="other.dxf"), "TOP013", "free-end", rows(1))
    record = record_of(
        rejected, plant(drawing, "TOP001", "duplicate", rows(2), severity="critical"),
        plant(drawing, "DOM002", "hidden-entities", rows(1), severity="note"),
        plant(drawing, "TOP011", "undershoot", rows(1), severity="minor"),
        plant(drawing, "GEO001", "invalid-geometry", nowhere), elsewhere,
    )  # fmt: skip
    listing = listing_of(record)
    picture = picture_of(drawing, 1, record.findings, shown_rows(listing.groups))
    marks = mark_views(Words("en"), listing, picture, "")
    assert [mark.severity for mark in marks] == ["note", "minor", "critical", "critical"]
    numbers = [mark.number for mark in marks if mark.severity == "critical"]
    assert numbers == sorted(numbers)
    for mark in marks:
        spot = np.array([mark.x, -mark.y]) * picture.quantum + picture.corner
        true = listing.sheet[next(row for row, name in listing.names.items() if f"f-{name}" == mark.row)]
        assert spot == pytest.approx(true, abs=picture.quantum)
        assert mark.anchor == f"m-{mark.row[2:]}"


def test_numbers_of_rows_and_marks_agree(rejected: AuditRecord) -> None:
    listing = listing_of(rejected)
    words = Words("pt-BR")
    views = [group_view(words, listing, group, "-pt") for group in listing.groups]
    listed = [row for view in views for row in view.rows]
    assert [row.number for row in listed] == list(range(1, len(listed) + 1))
    (drawing,) = rejected.delivery.drawings
    picture = picture_of(drawing, 1, rejected.findings, shown_rows(listing.groups))
    marks = {mark.row: mark for mark in mark_views(words, listing, picture, "-pt")}
    for row in listed:
        assert bool(row.mark) == (row.anchor in marks)
        if row.mark:
            assert (marks[row.anchor].anchor, marks[row.anchor].number) == (row.mark, row.number)


def test_what_is_not_listed_is_told(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    from tests.report.conftest import outcome

    record = replace(
        record_of(rejected, plant(drawing, "TOP011", "undershoot", rows(4))),
        outcomes=(outcome("TOP011", "undershoot", found=4, faulty=np.arange(3)),),
    )
    listing = listing_of(record)
    assert group_view(Words("en"), listing, listing.groups[0], "").unlisted == ""
    more = replace(record, outcomes=(outcome("TOP011", "undershoot", found=9, faulty=np.arange(3)),))
    listing = listing_of(more)
    view = group_view(Words("en"), listing, listing.groups[0], "")
    assert (view.counted, len(view.rows)) == (9, 4)
    assert "4" in view.unlisted
    assert "9" in view.unlisted
