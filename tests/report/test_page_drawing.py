# SPDX-License-Identifier: MIT
"""The picture of a drawing: where things stand, how large it may grow, and what it says it leaves out."""

import re
import struct
import zlib
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from foparq.findings.table import Findings, no_findings
from foparq.model.drawing import Drawing
from foparq.model.items import Items
from foparq.model.plane import plane_of
from foparq.report.page.bar import bar_text
from foparq.report.page.drawing import EXACT_VERTICES, GROUPS, Picture, marks_at, picture_of
from foparq.report.page.page import page
from foparq.report.page.paths import Strokes, density, merged_dots, path_data, simplify, strokes_of
from foparq.report.page.png import grey_png
from foparq.report.record import AuditRecord
from foparq.report.words import Words

Plant = Callable[..., Findings]
NOBODY = np.empty(0, dtype=np.intp)


def drawn(path: str) -> list[np.ndarray]:
    """Strokes of path data, read by the grammar of SVG 1.1, section 8.3.9."""
    strokes = []
    for part in path.split("M")[1:]:
        numbers = [int(number) for number in re.findall(r"-?\d+", part.replace("h0", ""))]
        strokes.append(np.cumsum(np.array(numbers).reshape(-1, 2), axis=0))
    return strokes


def picture(drawing: Drawing) -> Picture:
    return picture_of(drawing, 1, no_findings(), NOBODY)


def items_of(geometry: list[Any], **columns: Any) -> Items:
    n = len(geometry)
    shapes = np.empty(n, dtype=object)
    shapes[:] = geometry
    text = {
        name: np.full(n, value, dtype=object)
        for name, value in (("layer", "0"), ("kind", "LINE"), ("role", "line"), ("inserts", ""))
    }
    ids = np.array([f"{row:X}" for row in range(n)], dtype=object)
    flags = {"closed": np.zeros(n, dtype=bool), "visible": np.ones(n, dtype=bool), "paper": np.zeros(n, dtype=bool)}
    return Items(
        **{
            **text,
            "geometry": shapes,
            "item": ids,
            "handle": ids.copy(),
            "colour": np.zeros(n, dtype=np.int32),
            **flags,
            **columns,
        }
    )


def with_items(drawing: Drawing, items: Items, plane: str = "xy") -> Drawing:
    return replace(drawing, items=items, plane=plane_of(plane, items.geometry))


def segments(n: int, vertices: int, *, seed: int = 4) -> list[Any]:
    random = np.random.default_rng(seed)
    points = random.uniform((0, 0), (40, 15), (n, 1, 2)) + np.cumsum(random.normal(0, 0.1, (n, vertices, 2)), axis=1)
    return list(shapely.linestrings(points.reshape(-1, 2), indices=np.repeat(np.arange(n), vertices)))


def test_linework_stands_where_it_is(drawing: Drawing) -> None:
    one = picture(drawing)
    assert one.form == "exact"
    found = np.concatenate([stroke for path in one.paths for stroke in drawn(path.path)])
    placed = found * (1.0, -1.0) * one.quantum + one.corner
    model = drawing.items.geometry[~drawing.items.paper]
    true = drawing.plane.project(shapely.get_coordinates(model, include_z=True), 1.0)[:, :2]
    worst = max(np.abs(placed - point).max(axis=1).min() for point in true)
    assert worst <= one.quantum
    assert one.quantum <= 0.001
    framed = np.concatenate([stroke for path in one.paths if path.style == "ink" for stroke in drawn(path.path)])
    assert (framed >= 0).all()
    assert (framed <= (one.width, one.height)).all()


def test_up_is_up(drawing: Drawing) -> None:
    one = picture(drawing)
    low, high = one.cells(np.array([[5.0, 0.0], [5.0, 9.0]]))
    assert high[1] < low[1]
    assert high[0] == low[0]


def test_hidden_is_pale_lettering_is_soft_paper_is_left_out(drawing: Drawing) -> None:
    one = picture(drawing)
    styles = {path.layer: path.style for path in one.paths}
    assert styles["APOIO-CAMPO"] == "pale"
    assert styles["TEXTO"] == "soft"
    assert styles["PAREDE"] == "ink"
    assert "FOLHA" not in styles
    assert (one.hidden, one.paper) == (2, 1)
    assert {layer.layer: layer.items for layer in one.layers}["FOLHA"] == 1


@given(
    st.lists(
        st.lists(
            st.tuples(st.integers(-(10**6), 10**6), st.integers(-(10**6), 10**6)), min_size=1, max_size=6, unique=True
        ),
        max_size=6,
    )
)
def test_path_data_reads_back(lines: list[list[tuple[int, int]]]) -> None:
    stroke = np.repeat(np.arange(len(lines)), [len(line) for line in lines]).astype(np.intp)
    points = np.array([point for line in lines for point in line], dtype=float).reshape(-1, 2)
    back = drawn(path_data(Strokes(points, stroke, np.arange(len(lines)))))
    assert [part.tolist() for part in back] == [[list(point) for point in line] for line in lines]


def test_any_geometry_has_strokes() -> None:
    nested = shapely.GeometryCollection(
        [shapely.GeometryCollection([shapely.Point(1, 1)]), shapely.LineString([(0, 0), (2, 0)])]
    )
    ring = shapely.Polygon(shapely.box(0, 0, 4, 4).exterior, [shapely.box(1, 1, 2, 2).exterior])
    shapes = np.array(
        [None, shapely.Point(), nested, ring, shapely.MultiLineString([[(0, 0), (1, 1)], [(5, 5), (6, 6)]])],
        dtype=object,
    )
    strokes = strokes_of(shapes, None, 1.0)
    assert np.bincount(strokes.owner, minlength=5).tolist() == [0, 0, 2, 2, 2]
    assert np.bincount(strokes.stroke).tolist() == [1, 2, 5, 5, 2, 2]


def test_coordinates_that_are_no_numbers_are_not_drawn(drawing: Drawing) -> None:
    with np.errstate(invalid="ignore"):
        bad = [shapely.LineString([(0, 0), (x, 1)]) for x in (float("nan"), float("inf"), 1.0)]
    one = picture(replace(drawing, items=items_of(bad), plane=plane_of("xy", np.array(bad[2:], dtype=object))))
    assert [len(drawn(path.path)) for path in one.paths] == [1]
    marks = marks_at(np.array(bad, dtype=object))
    assert marks.tolist() == [[0, 0], [0, 0], [0.5, 0.5]], "on the one vertex that lies anywhere"


def test_one_stray_entity_does_not_make_the_drawing_a_dot(drawing: Drawing) -> None:
    near = segments(300, 2)
    one = picture(with_items(drawing, items_of([*near, shapely.LineString([(4e8, 7e9), (4e8, 7.1e9)])])))
    assert one.outside == 1
    assert one.width * one.quantum < 60


@pytest.mark.parametrize("shape", [shapely.Point(3, 3), shapely.LineString([(0, 0), (0, 0)]), None])
def test_a_drawing_without_extent_has_a_picture(drawing: Drawing, shape: Any) -> None:
    one = picture(with_items(drawing, items_of([shape])))
    assert one.width > 0
    assert one.height > 0
    assert one.form == ("empty" if shape is None else "exact")


def test_simplifying_stays_within_its_tolerance() -> None:
    angle = np.linspace(0, 2 * np.pi, 4001)
    circle = shapely.LineString(np.stack([np.cos(angle), np.sin(angle)], axis=1))
    strokes = strokes_of(np.array([circle, shapely.Point(5, 5)], dtype=object), None, 1.0)
    simple = simplify(strokes, 0.01)
    kept = shapely.LineString(simple.points[simple.stroke == 0])
    assert shapely.hausdorff_distance(kept, circle, densify=0.01) <= 0.0101
    assert len(kept.coords) < 80
    assert simple.points[simple.stroke == 1].tolist() == [[5, 5]]


def test_dots_on_one_cell_are_one_dot() -> None:
    strokes = Strokes(
        np.array([[1, 1], [1, 1], [2, 2], [0, 0], [3, 0]], dtype=float), np.array([0, 1, 2, 3, 3]), np.arange(4)
    )
    assert path_data(merged_dots(strokes)) == "M1 1h0M2 2h0M0 0l3 0"


def test_density_counts_what_passes_each_pixel() -> None:
    points = np.array([[1, 2], [6, 2], [1, 2], [6, 2], [3, 0], [3, 4], [7, 4]], dtype=float)
    tone = density(Strokes(points, np.array([0, 0, 1, 1, 2, 2, 3]), np.arange(4)), 8, 5)
    level = {255: 0, 176: 1, 152: 2}  # none; one passes; two or three pass
    expected = np.zeros((5, 8), dtype=int)
    expected[2, 1:7] = 2
    expected[[0, 1, 3, 4], 3] = 1
    expected[4, 7] = 1
    assert np.vectorize(level.get)(tone).tolist() == expected.tolist()


def test_png_holds_the_pixels() -> None:
    pixels = np.arange(35, dtype=np.uint8).reshape(5, 7)
    data = grey_png(pixels)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, chunks = 8, {}
    while place < len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        name, body = data[place + 4 : place + 8], data[place + 8 : place + 8 + length]
        assert struct.unpack(">I", data[place + 8 + length : place + 12 + length])[0] == zlib.crc32(name + body)
        chunks[name] = body
        place += 12 + length
    assert struct.unpack(">IIBBBBB", chunks[b"IHDR"]) == (7, 5, 8, 0, 0, 0, 0)
    assert (
        np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8).reshape(5, 8)[:, 1:].tolist() == pixels.tolist()
    )


def test_twenty_thousand_polylines_are_drawn_as_they_are(rejected: AuditRecord, drawing: Drawing) -> None:
    large = with_items(drawing, items_of(segments(20_000, 6)))
    assert picture(large).form == "exact"
    delivery = replace(rejected.delivery, parts=(large,))
    assert len(page(replace(rejected, delivery=delivery, findings=no_findings())).encode()) < 3_000_000


def test_a_large_drawing_is_simplified_and_says_so(rejected: AuditRecord, drawing: Drawing) -> None:
    x = np.linspace(0, 40, 30)
    lines = [shapely.LineString(np.stack([x, np.full(30, 0.0006 * n)], axis=1)) for n in range(20_001)]
    large = with_items(drawing, items_of(lines))
    one = picture(large)
    assert one.form == "simplified"
    assert sum(len(stroke) for path in one.paths for stroke in drawn(path.path)) <= EXACT_VERTICES
    text = page(replace(rejected, delivery=replace(rejected.delivery, parts=(large,)), findings=no_findings()))
    assert "this overview is simplified to a tenth of a pixel" in text


def test_a_very_large_drawing_is_toned_and_bounded(rejected: AuditRecord, drawing: Drawing) -> None:
    large = with_items(drawing, items_of(segments(150_000, 3)))
    assert picture(large).form == "toned"
    text = page(replace(rejected, delivery=replace(rejected.delivery, parts=(large,)), findings=no_findings()))
    assert len(text.encode()) < 3_000_000
    assert "this overview shows how dense the linework is" in text


def test_marks_stand_on_points_along_lines_and_inside_areas() -> None:
    horseshoe = shapely.Polygon([(0, 0), (10, 0), (10, 1), (1, 1), (1, 9), (10, 9), (10, 10), (0, 10)])
    bow = shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    shapes = np.array(
        [shapely.Point(3, 4), shapely.LineString([(0, 0), (4, 0), (4, 4)]), horseshoe, bow, shapely.Point(), None],
        dtype=object,
    )
    marks = marks_at(shapes)
    assert marks[0].tolist() == [3, 4]
    assert marks[1].tolist() == [4, 0]
    assert horseshoe.contains(shapely.Point(marks[2]))
    assert np.isfinite(marks[3]).all()
    assert np.isnan(marks[4:]).all()


@pytest.mark.parametrize(
    ("metres", "text"),
    [(2000.0, "2 km"), (5.0, "5 m"), (1.0, "1 m"), (0.2, "20 cm"), (0.005, "5 mm"), (0.00002, "20 µm")],
)
def test_scale_bars_are_lettered_in_whole_units(metres: float, text: str) -> None:
    assert bar_text(Words("pt-BR"), metres) == text


def test_what_lies_absurdly_far_is_still_a_number(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    far = shapely.LineString([(1e300, 0), (1e300, 1e300)])
    large = with_items(drawing, items_of([*segments(200, 2), far]))
    findings = plant(
        large, "TOP011", "undershoot", [("C8", "0", far, 1e300), ("C8", "0", shapely.Point(-1e300, 5), 1.0)]
    )
    record = replace(rejected, delivery=replace(rejected.delivery, parts=(large,)), findings=findings)
    text = page(record)
    assert "translate(1000000000 " in text
    assert "translate(-1000000000 " in text
    assert "nan" not in "".join(re.findall(r'd="([^"]*)"', text))


def test_many_layers_and_one_long_name_cost_little(drawing: Drawing) -> None:
    names = np.array([f"L{n:05d}" for n in range(5000)], dtype=object)
    names[-1] = "x" * 1_000_000
    one = picture(with_items(drawing, items_of(segments(5000, 2), layer=names)))
    assert len(one.paths) == GROUPS + 1
    assert one.paths[0].layer == ""
    assert len(one.layers) == 5000 + len(drawing.reading.layers)


def test_the_picture_frames_the_linework_and_tells_what_lies_beyond(drawing: Drawing) -> None:
    roles = np.array(["line"] * 300 + ["annotation"], dtype=object)
    one = picture(with_items(drawing, items_of([*segments(300, 2), shapely.Point(-60, -60)], role=roles)))
    assert one.outside == 1
    assert one.width * one.quantum < 60
    assert "soft" in {path.style for path in one.paths}
