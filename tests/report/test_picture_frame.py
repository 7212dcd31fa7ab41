# SPDX-License-Identifier: MIT
"""What the picture of a drawing frames, leaves outside, counts and marks."""

import base64
import struct
import zlib
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.findings.table import Findings, join_findings, no_findings
from foparq.model.drawing import Drawing
from foparq.model.items import Items
from foparq.model.plane import Plane
from foparq.report.page import drawing as module
from foparq.report.page.drawing import Picture, picture_of
from foparq.report.page.paths import Strokes, path_data, simplify, strokes_of, to_cells

Plant = Callable[..., Findings]
NOBODY = np.empty(0, dtype=np.intp)
GROUND = Plane("xy", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def flat(drawing: Drawing, *shapes: Any, **columns: list[Any]) -> Drawing:
    """The drawing with other items, in the plane xy."""
    n = len(shapes)

    def texts(value: Any) -> np.ndarray:
        made = np.empty(n, dtype=object)
        made[:] = value
        return made

    geometry = texts(list(shapes))
    given = {"layer": "0", "kind": "LINE", "role": "line", "inserts": "", "item": [f"{row:X}" for row in range(n)]}
    flags = {"visible": [True] * n, "paper": [False] * n, "closed": [False] * n}
    merged = {**given, **flags, **columns}
    texts_of = {name: texts(merged[name]) for name in given}
    flags_of = {name: np.array(merged[name], dtype=bool) for name in flags}
    items = Items(
        geometry=geometry, handle=texts_of["item"].copy(), colour=np.zeros(n, dtype=np.int32), **texts_of, **flags_of
    )
    return replace(drawing, items=items, plane=GROUND)


def line(*points: tuple[float, float]) -> shapely.LineString:
    return shapely.LineString(points)


def box(x: float, y: float, width: float, height: float) -> shapely.LineString:
    return line((x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y))


def frame(one: Picture) -> tuple[float, float, float, float]:
    """Left, bottom, right, top of the picture, metres."""
    left, top = one.corner
    return left, top - one.height * one.quantum, left + one.width * one.quantum, top


@pytest.mark.parametrize(("width", "height"), [(10.0, 1.0), (10.0, 5.0), (1.0, 10.0), (3.0, 3.0)])
def test_the_linework_stands_in_the_middle_with_a_margin(drawing: Drawing, width: float, height: float) -> None:
    one = picture_of(flat(drawing, box(7, -4, width, height)), 1, no_findings(), NOBODY)
    left, bottom, right, top = frame(one)
    fine = 2 * one.quantum
    assert 7 - left == pytest.approx(right - 7 - width, abs=fine)
    assert -4 - bottom == pytest.approx(top + 4 - height, abs=fine)
    margins = ((right - left - width) / width, (top - bottom - height) / height)
    assert min(margins) == pytest.approx(0.06, abs=0.001)
    assert 1.25 - 1e-3 <= (right - left) / (top - bottom) <= 3.2 + 1e-3


def test_a_cell_is_a_power_of_ten_and_a_fifty_thousandth_of_the_longer_side(drawing: Drawing) -> None:
    for size in (0.3, 4.0, 60.0):
        one = picture_of(flat(drawing, box(0, 0, size, size)), 1, no_findings(), NOBODY)
        assert np.log10(one.quantum) == pytest.approx(round(np.log10(one.quantum)), abs=1e-9)
        assert 50_000 <= max(one.width, one.height) <= 500_001


def test_what_lies_beyond_on_any_side_is_told(drawing: Drawing) -> None:
    house = box(0, 0, 10, 5)
    notes = [shapely.Point(x, y) for x, y in ((-9, 2), (19, 2), (5, -9), (5, 14), (5, 2.5))]
    roles = ["line", *["annotation"] * 5]
    one = picture_of(flat(drawing, house, *notes, role=roles), 1, no_findings(), NOBODY)
    assert one.outside == 4
    across = line((-30, 2), (40, 2))
    over = picture_of(flat(drawing, house, across, role=["line", "annotation"]), 1, no_findings(), NOBODY)
    assert over.outside == 0


def test_hidden_and_paper_items_are_counted_and_do_not_frame(drawing: Drawing) -> None:
    shapes = [box(0, 0, 10, 5), box(0, 0, 90, 90), box(0, 0, 80, 80), line((0, 0), (1, 1))]
    one = picture_of(
        flat(drawing, *shapes, visible=[True, False, False, True], paper=[False, False, True, False]), 1,
        no_findings(), NOBODY,
    )  # fmt: skip
    assert (one.hidden, one.paper) == (1, 1)
    assert frame(one)[2] - frame(one)[0] == pytest.approx(10.6, abs=0.01)


def test_layers_are_counted_with_their_faults_and_without_notes(drawing: Drawing, plant: Plant) -> None:
    made = flat(
        drawing, box(0, 0, 1, 1), box(2, 0, 1, 1), box(4, 0, 1, 1), layer=["A", "A", "B"], visible=[True, False, True]
    )
    made = replace(made, reading=replace(made.reading, layers=("A", "B", "EMPTY"), hidden_layers=()))
    place = shapely.Point(0, 0)
    findings = join_findings([
        plant(made, "TOP011", "undershoot", [("0", "A", place, 1.0), ("1", "A", place, 1.0)]),
        plant(made, "DOM002", "hidden-entities", [("", "B", place, 1.0)], severity="note"),
        plant(replace(made, path="other.dxf"), "TOP011", "undershoot", [("0", "A", place, 1.0)]),
    ])  # fmt: skip
    one = picture_of(made, 1, findings, NOBODY)
    rows = {count.layer: (count.items, count.hidden, count.findings) for count in one.layers}
    assert rows == {"A": (2, 1, 2), "B": (1, 0, 0), "EMPTY": (0, 0, 0)}


def test_items_that_listed_faults_name_are_drawn_once_more(drawing: Drawing, plant: Plant) -> None:
    shapes = [line((n, 0), (n, 1)) for n in range(5)]
    made = flat(drawing, *shapes, paper=[False, False, False, False, True])
    place = shapely.Point(0, 0)
    findings = join_findings([
        plant(made, "TOP001", "duplicate", [("1", "0", place, 1.0)], other="3"),
        plant(made, "TOP011", "undershoot", [("4", "0", place, 1.0)]),
        plant(made, "DOM002", "hidden-entities", [("2", "0", place, 1.0)], severity="note"),
    ])  # fmt: skip
    one = picture_of(made, 1, findings, np.arange(len(findings)))
    assert one.culprits.count("M") == 2
    assert picture_of(made, 1, findings, NOBODY).culprits == ""


def test_places_of_faults_are_bands_and_areas(drawing: Drawing, plant: Plant) -> None:
    made = flat(drawing, box(0, 0, 9, 9))
    places = [line((0, 0), (1, 1)), shapely.box(2, 2, 3, 3), shapely.Point(5, 5)]
    rows = [(str(n), "0", place, 1.0) for n, place in enumerate(places)]
    faults = plant(made, "TOP021", "line-overlap", rows)
    notes = plant(made, "DOM002", "hidden-entities", rows, severity="note")
    findings = join_findings([faults, notes])
    one = picture_of(made, 1, findings, np.arange(len(findings)))
    assert (one.bands.count("M"), one.areas.count("M")) == (1, 1)


def test_around_a_finding_a_simplified_drawing_is_drawn_exactly(
    drawing: Drawing, plant: Plant, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "EXACT_ITEMS", 2)
    made = flat(drawing, *(line((n, 0), (n, 10)) for n in range(31)))
    findings = plant(made, "TOP011", "undershoot", [("7", "0", shapely.Point(7.05, 3), 1.0)])
    one = picture_of(made, 1, findings, np.arange(1))
    assert one.form == "simplified"
    # A hundredth of a picture of 31.8 m is wider than 0.05 m and narrower than a metre.
    assert one.nearby.count("M") == 1
    assert picture_of(made, 1, findings, NOBODY).nearby == ""


@pytest.mark.parametrize(("items", "form"), [(3, "exact"), (4, "simplified")])
def test_items_up_to_the_bound_are_drawn_as_they_are(
    drawing: Drawing, items: int, form: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "EXACT_ITEMS", 3)
    made = flat(drawing, *(line((n, 0), (n, 10)) for n in range(items)))
    assert picture_of(made, 1, no_findings(), NOBODY).form == form


def test_vertices_up_to_the_bound_are_drawn_as_lines(drawing: Drawing, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "EXACT_VERTICES", 10)
    zigzag = line(*((n, 3 * (n % 2)) for n in range(10)))
    assert picture_of(flat(drawing, zigzag), 1, no_findings(), NOBODY).form == "exact"
    longer = line(*((n, 3 * (n % 2)) for n in range(11)))
    assert picture_of(flat(drawing, longer), 1, no_findings(), NOBODY).form == "toned"
    straight = line(*((n, 0) for n in range(11)))
    assert picture_of(flat(drawing, straight), 1, no_findings(), NOBODY).form == "simplified"


# --- strokes ---------------------------------------------------------------------------------------------------------


def test_strokes_keep_order_and_owner() -> None:
    shapes = np.array([shapely.box(0, 0, 1, 1), line((5, 5), (6, 6)), shapely.Point(9, 9)], dtype=object)
    strokes = strokes_of(shapes, None, 1.0)
    assert strokes.owner.tolist() == [0, 1, 2]
    chosen = strokes.take(np.array([False, True, True]))
    assert (chosen.owner.tolist(), chosen.stroke.tolist()) == ([1, 2], [0, 0, 1])
    assert chosen.points.tolist() == [[5, 5], [6, 6], [9, 9]]


def test_metres_of_a_unit_scale_the_sheet() -> None:
    shapes = np.array([shapely.LineString([(1000, 0, 0), (3000, 500, 0)])], dtype=object)
    strokes = strokes_of(shapes, GROUND, 0.001)
    assert strokes.points.tolist() == [[1.0, 0.0], [3.0, 0.5]]


def test_cells_count_downward_from_the_corner_and_repeat_none() -> None:
    strokes = Strokes(
        np.array([[1.0, 9.0], [1.004, 9.0], [2.0, 8.0], [2.0, 8.0]]), np.array([0, 0, 0, 1]), np.arange(2)
    )
    cells = to_cells(strokes, np.array([0.0, 10.0]), 0.01)
    assert cells.points.tolist() == [[100, 100], [200, 200], [200, 200]]
    assert cells.stroke.tolist() == [0, 0, 1]
    assert path_data(cells) == "M100 100l100 100M200 200h0"


def test_simplifying_keeps_lone_points_between_lines() -> None:
    strokes = Strokes(
        np.array([[0.0, 0], [1, 0.001], [2, 0], [7, 7], [0, 5], [4, 5]]), np.array([0, 0, 0, 1, 2, 2]), np.arange(3)
    )
    simple = simplify(strokes, 0.01)
    assert simple.points.tolist() == [[0, 0], [2, 0], [7, 7], [0, 5], [4, 5]]
    assert simple.stroke.tolist() == [0, 0, 1, 2, 2]


# --- tones, windows and bars -----------------------------------------------------------------------------------------


def test_a_toned_picture_is_dark_where_the_linework_is(drawing: Drawing, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "EXACT_VERTICES", 10)
    monkeypatch.setattr(module, "RASTER", 106)
    zigzag = line(*((0.5 * n, 4 * (n % 2)) for n in range(11)))
    made = flat(drawing, zigzag, line((5, 0), (10, 0)))
    one = picture_of(made, 1, no_findings(), NOBODY)
    assert one.form == "toned"
    data = base64.b64decode(one.toned)
    width, height = struct.unpack(">II", data[16:24])
    body = data[data.index(b"IDAT") + 4 : -16]
    pixels = np.frombuffer(zlib.decompress(body), dtype=np.uint8).reshape(height, width + 1)[:, 1:]
    assert width == 106
    metres = one.width * one.quantum / width
    rows, columns = np.nonzero(pixels < 255)
    spots = shapely.points(one.corner[0] + columns * metres, one.corner[1] - rows * metres)
    linework = shapely.union_all(made.items.geometry)
    assert shapely.distance(spots, linework).max() <= metres
    # Nothing of the linework stays white.
    along = shapely.get_coordinates(shapely.segmentize(linework, metres / 4))
    column, row = np.rint((along - one.corner) / metres * (1, -1)).astype(int).T
    assert (pixels[row, column] < 255).mean() > 0.9
