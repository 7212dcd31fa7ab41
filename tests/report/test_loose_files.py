# SPDX-License-Identifier: MIT
"""The page of loose files: elements that could be assessed, and no gap for what only a delivery holds."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from foparq.evaluate.quality import ElementStatus
from foparq.model.plane import Plane
from foparq.report.page.findings import group_findings
from foparq.report.page.paths import strokes_of
from foparq.report.page.tables import OPEN, element_views, headline
from foparq.report.record import AuditRecord
from foparq.report.words import Words

EN = Words("en")


def with_statuses(record: AuditRecord, *statuses: ElementStatus, loose: bool) -> AuditRecord:
    first = record.quality.elements[0]
    elements = tuple(replace(first, id=status.value, status=status) for status in statuses)
    return replace(record, loose=loose, quality=replace(record.quality, elements=elements))


@pytest.mark.parametrize("loose", [False, True])
def test_what_was_not_assessed_is_no_row_of_loose_files(rejected: AuditRecord, *, loose: bool) -> None:
    record = with_statuses(rejected, *ElementStatus, loose=loose)
    shown = [view.id for view in element_views(EN, record)]
    known = [status.value for status in ElementStatus if not loose or status is not ElementStatus.NOT_ASSESSED]
    assert shown == known


@pytest.mark.parametrize("loose", [False, True])
@pytest.mark.parametrize("many", [1, 2])
def test_open_elements_are_a_gap_of_deliveries_only(rejected: AuditRecord, many: int, *, loose: bool) -> None:
    record = with_statuses(rejected, *[ElementStatus.UNDECIDED] * many, ElementStatus.PASS, loose=loose)
    said = [EN(f"report.headline.gap-elements-{'one' if n == 1 else 'many'}", count=str(n)) for n in (1, 2, 3)]
    gaps = headline(EN, record, group_findings(record), "").gaps
    assert [gap for gap in gaps if gap in said] == ([] if loose else [said[many - 1]])
    assert {ElementStatus.UNDECIDED, ElementStatus.NOT_ASSESSED} == OPEN


def test_linework_without_depth_lies_at_zero() -> None:
    flat = np.array([shapely.LineString([(1, 5), (3, 7)])], dtype=object)
    facade = Plane("xz", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    assert strokes_of(flat, facade, 1.0).points.tolist() == [[1, 0], [3, 0]]
