# SPDX-License-Identifier: MIT
"""How a mark is shown, how long the scale bar is, and how finely a place is written."""

from collections.abc import Callable
from dataclasses import fields, replace

import numpy as np
import pytest
import shapely

from foparq.findings.table import Findings
from foparq.model.drawing import Drawing
from foparq.report.page.bar import scale_bar
from foparq.report.page.drawing import picture_of
from foparq.report.page.findings import group_view, listing_of
from foparq.report.page.marks import mark_views
from foparq.report.record import AuditRecord
from foparq.report.words import Words

Plant = Callable[..., Findings]
FRAMED = 10.6  #: metres across of a picture of ten metres: six per cent are margin


def record_of(rejected: AuditRecord, drawing: Drawing, findings: Findings) -> AuditRecord:
    delivery = replace(rejected.delivery, parts=(drawing,))
    return replace(rejected, findings=findings, delivery=delivery, outcomes=())


def house(drawing: Drawing, width: float) -> Drawing:
    """The drawing with a single rectangle, twice as wide as high, in the plane xz."""
    rows = np.arange(len(drawing.items)) == 0
    items = drawing.items
    corners = [(0, 0, 0), (width, 0, 0), (width, 0, width / 2), (0, 0, width / 2), (0, 0, 0)]
    columns = {column.name: getattr(items, column.name)[rows] for column in fields(items)}
    geometry = np.array([shapely.LineString(corners)], dtype=object)
    return replace(drawing, items=type(items)(**{**columns, "geometry": geometry}))


@pytest.mark.parametrize(
    ("shape", "size", "unit", "half"),
    [
        (shapely.Point(5, 0, 3), 0.01, "m", 0.25), (shapely.Point(5, 0, 3), 0.0, "m", FRAMED / 400),
        (shapely.Point(5, 0, 3), 9.0, "m2", FRAMED / 400), (shapely.LineString([(1, 0, 1), (3, 0, 2)]), 0.0, "m", 3.0),
        (shapely.LineString([(1, 0, 1), (1.5, 0, 3)]), 0.0, "m", 3.0), (shapely.Point(5, 0, 3), 9.0, "m", FRAMED / 2),
    ],
)  # fmt: skip
def test_a_mark_is_shown_with_room_around_it(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, shape: shapely.Geometry, size: float, unit: str, half: float
) -> None:
    made = house(drawing, 10.0)
    findings = plant(made, "TOP011", "undershoot", [("2A", "0", shape, size)], unit=unit)
    one = picture_of(made, 1, findings, np.arange(1))
    (mark,) = mark_views(Words("en"), listing_of(record_of(rejected, made, findings)), one, "")
    assert mark.window * one.quantum == pytest.approx(half, abs=2 * one.quantum)


@pytest.mark.parametrize("width", [0.3, 0.9, 1.7, 2.3, 4.0, 7.7, 40.0, 93.0, 1234.0])
def test_the_scale_bar_is_the_longest_round_one_within_a_fifth(drawing: Drawing, width: float, plant: Plant) -> None:
    made = house(drawing, width)
    one = picture_of(made, 1, plant(made, "TOP011", "undershoot", []), np.empty(0, dtype=np.intp))
    share, text = scale_bar(Words("en"), one, one.width)
    across = one.width * one.quantum
    round_ = np.outer([1, 2, 5], 10.0 ** np.arange(-6, 6)).ravel()
    assert share * across == pytest.approx(round_[round_ <= across / 5 * (1 + 1e-9)].max(), rel=1e-9)
    assert text[0] in "125"


@pytest.mark.parametrize(("metres", "decimals"), [(1.0, 4), (0.001, 1), (0.0254, 2), (1e-9, 0), (1000.0, 7)])
def test_a_place_is_written_to_a_tenth_of_a_millimetre(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, metres: float, decimals: int
) -> None:
    made = replace(drawing, unit=replace(drawing.unit, metres=metres))
    findings = plant(made, "TOP011", "undershoot", [("1", "0", shapely.Point(1.25, 2.5), 0.1)])
    listing = listing_of(record_of(rejected, made, findings))
    for language in ("en", "pt-BR"):
        (row,) = group_view(Words(language), listing, listing.groups[0], "").rows
        written = f"{2.5:.{decimals}f}"
        assert row.place.split(",")[1:] == [written.rstrip("0").rstrip(".") if "." in written else written, "0"]
