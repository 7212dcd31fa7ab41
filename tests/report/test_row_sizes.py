# SPDX-License-Identifier: MIT
"""Sizes of listed findings, and anchors of the language that the record is written in."""

import html
import re
from collections.abc import Callable
from dataclasses import replace

import pytest
import shapely

from foparq.findings.table import Findings
from foparq.model.delivery import Source, SourceStatus
from foparq.model.drawing import Drawing
from foparq.report.page.findings import group_view, listing_of
from foparq.report.page.page import page
from foparq.report.page.tables import input_views
from foparq.report.record import AuditRecord
from foparq.report.words import Words

Plant = Callable[..., Findings]


@pytest.mark.parametrize(
    ("size", "unit", "shown"),
    [
        (1.0, "items", ""), (3.0, "items", "3"), (1.0, "m", "1 m"), (0.004, "m", "4 mm"), (2.0, "m2", "2 m²"),
        (float("nan"), "m", ""), (float("inf"), "m", ""),
    ],
)  # fmt: skip
def test_a_size_is_shown_unless_it_is_one_item(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, size: float, unit: str, shown: str
) -> None:
    findings = plant(drawing, "TOP011", "undershoot", [("30", "PAREDE", shapely.Point(1, 12.5, 2), size)], unit=unit)
    listing = listing_of(replace(rejected, findings=findings, outcomes=()))
    view = group_view(Words("en"), listing, listing.groups[0], "")
    assert view.rows[0].size.replace("\u202f", " ").replace("\u00a0", " ") == shown
    assert ("size" in view.columns) is bool(shown)
    assert "source" not in view.columns


def test_the_file_is_shown_where_findings_lie_in_several(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    from foparq.findings.table import join_findings

    spot = [("30", "PAREDE", shapely.Point(1, 12.5, 2), 0.1)]
    both = join_findings([plant(replace(drawing, path=path), "TOP011", "undershoot", spot) for path in ("a", "b")])
    listing = listing_of(replace(rejected, findings=both, outcomes=()))
    assert "source" in group_view(Words("en"), listing, listing.groups[0], "").columns


@pytest.mark.parametrize("language", ["pt-BR", "en"])
def test_anchors_without_a_suffix_are_those_of_the_record_s_language(rejected: AuditRecord, language: str) -> None:
    text = page(replace(rejected, language=language))
    for rule in set(rejected.findings.rule):
        at = text.index(f'id="r-{rule}"')
        spoken = re.findall(r'<[a-z]+[^>]*\blang="([^"]+)"', text[:at])
        assert spoken[-1] == language


@pytest.mark.parametrize("name", ["m", "ftUS", ""])
def test_the_picture_says_what_one_drawing_unit_is(rejected: AuditRecord, drawing: Drawing, name: str) -> None:
    made = replace(drawing, unit=replace(drawing.unit, name=name), facade="N")
    text = page(replace(rejected, language="en", delivery=replace(rejected.delivery, parts=(made,))))
    words = Words("en")
    about = words(
        "report.drawing.about-facade", items=words.count(len(made.items)), layers=words.count(len(made.reading.layers)),
        plane="xz", unit=name or words("report.drawing.unit-unknown"), facade="N",
    )  # fmt: skip
    assert about in html.unescape(text)


def test_a_file_that_is_missing_has_no_size() -> None:
    sources = [
        Source(path=status.value, role="other", sha256="", bytes=7, status=status)
        for status in (SourceStatus.READ, SourceStatus.REFUSED, SourceStatus.MISSING)
    ]
    assert [view.bytes for view in input_views(Words("en"), sources)] == ["7", "7", "–"]
