# SPDX-License-Identifier: MIT
"""What stands below a picture: what is hidden, on paper, outside, without a mark, and not listed."""

import html
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.report.conftest import outcome

from foparq.findings.table import Findings
from foparq.model.drawing import Drawing
from foparq.report.page import drawing as module
from foparq.report.page.coverage import coverage
from foparq.report.page.drawing import picture_of
from foparq.report.page.page import page
from foparq.report.record import AuditRecord
from foparq.report.words import Words

Plant = Callable[..., Findings]
EN = Words("en")
SPOT = [("30", "PAREDE", shapely.Point(1, 12.5, 2), 0.1), ("31", "PAREDE", shapely.Point(), 0.1)]


def text(record: AuditRecord) -> str:
    return html.unescape(page(replace(record, language="en")))


@pytest.mark.parametrize("toned", [False, True])
def test_hidden_items_are_pale_or_left_out(
    rejected: AuditRecord,
    toned: bool,  # noqa: FBT001
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if toned:
        monkeypatch.setattr(module, "EXACT_VERTICES", 10)
    said = text(rejected)
    assert (EN("report.drawing.hidden", count="2") in said) is not toned
    assert (EN("report.drawing.hidden-left-out", count="2") in said) is toned
    assert EN("report.drawing.paper", count="1") in said


@pytest.mark.parametrize(("found", "told"), [(2, False), (3, True)])
def test_what_is_not_listed_is_told_below_the_picture(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, found: int, told: bool  # noqa: FBT001
) -> None:  # fmt: skip
    runs = (outcome("TOP011", "undershoot", found=found, faulty=np.arange(found)),)
    record = replace(rejected, findings=plant(drawing, "TOP011", "undershoot", SPOT), outcomes=runs)
    said = text(record)
    assert (EN("report.drawing.unlisted") in said) is told
    assert EN("report.drawing.unmarked", count="1") in said


@pytest.mark.parametrize(
    ("visible", "paper", "layers", "told"),
    [
        (True, False, (), False), (False, False, (), True), (True, True, (), True), (True, False, ("APOIO",), True),
    ],
)  # fmt: skip
def test_hidden_linework_is_what_nobody_checked(
    rejected: AuditRecord, drawing: Drawing, visible: bool, paper: bool, layers: tuple[str, ...], told: bool  # noqa: FBT001
) -> None:  # fmt: skip
    items = drawing.items
    rows = np.arange(len(items)) == 0
    made = replace(
        drawing, items=replace(items, visible=~rows | visible, paper=rows & paper),
        reading=replace(drawing.reading, hidden_layers=layers),
    )  # fmt: skip
    record = replace(rejected, delivery=replace(rejected.delivery, parts=(made,)))
    one = picture_of(made, 1, record.findings, np.empty(0, dtype=np.intp))
    assert bool(coverage(EN, record, (one,)).hidden) is told
