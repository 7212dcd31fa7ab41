# SPDX-License-Identifier: MIT
"""Plates: each number of the list once, where its finding is, over no other number, with a scale bar that is true."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.findings.table import Findings, join_findings
from foparq.model.drawing import Drawing
from foparq.report.page.findings import FIRST
from foparq.report.page.page import page
from foparq.report.page.plates import MOST, _crowded, cut
from foparq.report.record import AuditRecord

Plant = Callable[..., Findings]
RULES = (
    ("TOP011", "undershoot"), ("TOP012", "overshoot"), ("TOP001", "duplicate"), ("TOP013", "free-end"),
    ("GEO004", "self-intersection"), ("TOP021", "line-overlap"), ("GEO003", "repeated-vertex"),
)  # fmt: skip
DEPTH = 12.5


@dataclass
class Number:
    """A number on a plate, in cells."""

    text: str
    x: float
    y: float
    length: float
    letter: float
    further: bool

    def box(self) -> tuple[float, float, float, float]:
        """What the digits cover: they are lower than three quarters of the letter size."""
        return (
            self.x - self.length / 2,
            self.y - 0.75 * self.letter,
            self.x + self.length / 2,
            self.y,
        )


class Sheets(HTMLParser):
    """Plates of one language, the ink of both, and the plate that every row names."""

    def __init__(self, language: str) -> None:
        super().__init__()
        self.language, self.now = language, ""
        self.ink: dict[str, list[Number]] = {}
        self.plates: dict[int, dict[str, Any]] = {}
        self.rows: dict[int, str] = {}
        self.marks: dict[int, tuple[int, int]] = {}  #: number to cell, of the picture on screen
        self._mark: tuple[int, int] | None = None
        self._group, self._letter, self._text, self._plate = "", 0.0, None, None
        self._cells: list[str] | None = None

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        kind = given.get("class", "").split()
        if tag == "main":
            self.now = given["lang"]
        elif tag == "g" and "plate-ink" in kind:
            self._group, self._letter = given["id"], float(given["font-size"])
            self.ink[self._group] = []
        elif tag == "g" and "plate-bar" in kind and self._plate:
            self._group = "bar"
        elif tag == "a" and "data-x" in given:
            self._mark = (int(given["data-x"]), int(given["data-y"]))
        elif tag == "text" and (self._mark or (self._group and "frame" not in kind)):
            self._text = given
        elif tag == "svg" and "data-window" in given and self.now == self.language:
            self._plate = self.plates[int(given["data-number"])] = {
                "box": np.array(given["viewbox"].split(), dtype=float),
                "window": np.array(given["data-window"].split(), dtype=float),
                "cell": float(given["data-cell"]), "width": given["width"], "uses": [], "bar": "", "lettering": "",
            }  # fmt: skip
        elif tag == "use" and self._plate:
            self._plate["uses"].append(given["href"])
        elif tag == "path" and self._plate and self._group == "bar":
            self._plate["bar"] = given["d"]
        elif tag == "tr" and given.get("id", "").startswith("f-") and self.now == self.language:
            self._cells = []
        elif tag == "td" and self._cells is not None:
            self._cells.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag == "text":
            self._text, self._mark = None, None
        elif tag == "svg":
            self._plate, self._group = None, ""
        elif tag == "tr" and self._cells:
            self.rows[int(self._cells[0])] = self._cells[1]
            self._cells = None

    def handle_data(self, data: str) -> None:
        if self._cells:
            self._cells[-1] += data.strip()
        if self._text is None:
            return
        if self._mark:
            self.marks[int(data)] = self._mark
        elif self._group == "bar" and self._plate:
            self._plate["lettering"] += data
        else:
            at = (float(self._text[name]) for name in ("x", "y", "textlength"))
            self.ink[self._group].append(Number(data, *at, self._letter, self._group.endswith("f")))

    def numbers(self, plate: int) -> list[Number]:
        return [number for href in self.plates[plate]["uses"] for number in self.ink.get(href[1:], [])]


def sheets(record: AuditRecord, language: str = "en") -> Sheets:
    reader = Sheets(language)
    reader.feed(page(record))
    return reader


def strewn(kind: str, number: int, box: tuple[float, float, float, float]) -> np.ndarray:
    """Places (n, 2) in a box: left, low, right, high."""
    random = np.random.default_rng(5)
    left, low, right, high = box
    spread = random.uniform((left, low), (right, high), (number, 2))
    if kind == "spread":
        return spread
    if kind == "one place":
        return np.repeat(spread[:1], number, axis=0)
    heart = random.uniform((left, low), (right, high), (3, 2))
    return heart[random.integers(0, 3, number)] + random.normal(0, 0.02, (number, 2))


def walls(drawing: Drawing, width: float, height: float, away: float = 0.0) -> Drawing:
    """The drawing with one rectangle and a grid of lines in its plane."""
    corners = np.array([(0, 0), (width, 0), (width, height), (0, height), (0, 0)], dtype=float) + away
    items = drawing.items
    rows = np.arange(len(items)) == 0
    columns = {name: getattr(items, name)[rows] for name in items.__dataclass_fields__}
    line = shapely.LineString([(x, DEPTH, z) for x, z in corners])
    geometry = np.empty(1, dtype=object)
    geometry[:] = [line]
    return replace(drawing, items=type(items)(**{**columns, "geometry": geometry}))


def record_of(rejected: AuditRecord, plant: Plant, drawings: dict[str, tuple[Drawing, np.ndarray]]) -> AuditRecord:
    """Findings at places of drawings, shared out among the rules."""
    tables, parts = [], []
    for path, (drawing, places) in drawings.items():
        mine = replace(drawing, path=path)
        parts.append(mine)
        for n, (code, name) in enumerate(RULES):
            rows = [(f"{k:X}", "PAREDE", shapely.Point(x, DEPTH, z), 0.004) for k, (x, z) in enumerate(places[n::7])]
            tables.append(plant(mine, code, name, rows))
    findings = join_findings(tables)
    return replace(
        rejected, findings=findings, outcomes=(), delivery=replace(rejected.delivery, parts=tuple(parts)), language="en"
    )


SHAPES = {
    "house": (30.0, 10.0, 0.0), "wide": (800.0, 1.5, 0.0), "high": (6.0, 200.0, 0.0), "far": (30.0, 10.0, 1e7),
}  # fmt: skip


def one(rejected: AuditRecord, drawing: Drawing, plant: Plant, shape: str, kind: str, number: int) -> AuditRecord:
    width, height, away = SHAPES[shape]
    places = strewn(kind, number, (away, away, away + width, away + height))
    return record_of(rejected, plant, {"fachada.dxf": (walls(drawing, width, height, away), places)})


CASES = [
    ("house", "spread", 1), ("house", "spread", 66), ("house", "clustered", 66), ("house", "one place", 66),
    ("house", "spread", 500), ("house", "clustered", 500), ("wide", "spread", 66), ("high", "spread", 66),
    ("high", "clustered", 150), ("far", "clustered", 66), ("house", "spread", 5000), ("house", "one place", 5000),
]  # fmt: skip


@pytest.fixture(scope="module")
def known() -> dict[Any, tuple[AuditRecord, Sheets]]:
    """What was made once: pages of thousands of findings take seconds."""
    return {}


@pytest.fixture(params=CASES, ids=lambda case: "-".join(map(str, case)))
def made(
    request: pytest.FixtureRequest, known: dict[Any, Any], rejected: AuditRecord, drawing: Drawing, plant: Plant
) -> tuple[AuditRecord, Sheets]:
    if request.param not in known:
        record = one(rejected, drawing, plant, *request.param)
        known[request.param] = (record, sheets(record))
    return known[request.param]


def listed(record: AuditRecord) -> dict[int, int]:
    """Number of every row to the row of the findings: by rule, as the page counts them."""
    ordered = sorted({*record.findings.rule}, key=lambda code: (-int(np.sum(record.findings.rule == code)), code))
    most = 500 if len(record.findings) <= 3000 else max(50, 3000 // len(ordered))
    rows = [row for code in ordered for row in np.flatnonzero(record.findings.rule == code)[:most].tolist()]
    return dict(enumerate(rows, start=1))


def test_every_number_stands_once_and_where_its_finding_is(made: tuple[AuditRecord, Sheets]) -> None:
    record, found = made
    standing = [(int(number.text), plate) for plate in found.plates for number in found.numbers(plate)]
    rows = listed(record)
    assert sorted(number for number, _ in standing) == sorted(rows), "each number of the list once"
    assert {number: str(plate) for number, plate in standing} == found.rows, "the plate that the row names"


def test_places_lie_on_the_plates_that_claim_them(made: tuple[AuditRecord, Sheets]) -> None:
    record, found = made
    rows = listed(record)
    true = shapely.get_coordinates(record.findings.sheet)
    for sheet, numbers in ((sheet, found.numbers(plate)) for plate, sheet in found.plates.items()):
        left, top, width, height = sheet["window"]
        for number in numbers:
            x, y = found.marks[int(number.text)]
            assert left <= x <= left + width
            assert top <= y <= top + height
            box = number.box()
            assert left <= box[0] < box[2] <= left + width
            assert top <= box[1] < box[3] <= top + height
    # The mark on screen, in the same cells, is where the finding is.
    cell = next(iter(found.plates.values()))["cell"]
    marks = np.array([found.marks[number] for number in rows]) * (cell, -cell)
    apart = marks - true[list(rows.values())]
    assert np.ptp(apart, axis=0).max() <= 1.01 * cell + 4e-9 * np.abs(true).max()


def test_no_number_lies_over_another(made: tuple[AuditRecord, Sheets]) -> None:
    _, found = made
    for plate in found.plates:
        boxes = shapely.box(*np.array([number.box() for number in found.numbers(plate)]).reshape(-1, 4).T)
        tree = shapely.STRtree(boxes)
        pairs = tree.query(boxes, predicate="intersects")
        assert not np.any(pairs[0] != pairs[1]), plate


def test_digits_are_as_wide_as_is_reckoned(made: tuple[AuditRecord, Sheets]) -> None:
    _, found = made
    for numbers in found.ink.values():
        for number in numbers:
            assert number.length == pytest.approx(0.6 * number.letter * len(number.text), abs=1.5, rel=0.02)
            assert number.letter > 0


def test_scale_bars_are_true(made: tuple[AuditRecord, Sheets]) -> None:
    _, found = made
    factor = {"km": 1000.0, "m": 1.0, "cm": 0.01, "mm": 0.001}
    for sheet in found.plates.values():
        (length,) = re.findall(r"h(\d+)", sheet["bar"])
        told, unit = sheet["lettering"].replace(",", "").split()
        assert int(length) * sheet["cell"] == pytest.approx(float(told) * factor[unit], rel=0.01)
        assert int(length) <= sheet["box"][2] / 5 + 1
        # Paper is as wide as the plate says: no more than a lying sheet of A4 within its margins.
        assert float(sheet["width"].removesuffix("mm")) <= 269


def test_details_are_larger_and_few(made: tuple[AuditRecord, Sheets]) -> None:
    record, found = made
    plates = list(found.plates)
    if not plates[1:]:
        return
    scale = {plate: float(sheet["width"].removesuffix("mm")) / sheet["box"][2] for plate, sheet in found.plates.items()}
    assert all(scale[plate] >= 1.9 * scale[plates[0]] for plate in plates[1:]), "twice, less what is rounded"
    assert len(plates) - 1 <= MOST
    assert len(plates) - 1 <= max(2 * len(record.findings) / 12, 4)


def test_rows_that_are_folded_stand_on_what_is_printed_on_request(
    rejected: AuditRecord, drawing: Drawing, plant: Plant
) -> None:
    record = one(rejected, drawing, plant, "house", "spread", 500)
    found = sheets(record)
    rows = listed(record)
    first: dict[str, int] = {}
    for number, row in sorted(rows.items()):
        first.setdefault(str(record.findings.rule[row]), number)
    late = {number for number, row in rows.items() if number >= first[str(record.findings.rule[row])] + FIRST}
    assert late
    for name, numbers in found.ink.items():
        if name.endswith("f"):
            assert {int(one.text) for one in numbers} <= late
    always = re.findall(r'<figure class="plate \w+">.*?data-number="(\d+)"', page(record), flags=re.DOTALL)
    borne = {
        int(number.text) for plate in map(int, always) for number in found.ink.get(f"p{plate}", [])
    }  # fmt: skip
    assert borne == set(rows) - late


def test_each_drawing_has_its_own_plates(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    house = walls(drawing, 30.0, 10.0)
    places = strewn("spread", 66, (0, 0, 30, 10))
    record = record_of(rejected, plant, {"norte.dxf": (house, places), "sul.dxf": (house, places[:5])})
    text, found = page(record), sheets(record)
    files = dict(re.findall(r"<strong>Plate (\d+)\.</strong> (\S+) ", text))
    rows = listed(record)
    assert {number: files[plate] for number, plate in found.rows.items()} == {
        number: record.findings.source[row] for number, row in rows.items()
    }
    assert text.count("overview; the frames are the other plates") == 2, "title and description of one overview"
    assert "the whole drawing" in text, "five numbers have room on the other one"


def test_without_marks_there_are_no_plates(accepted: AuditRecord) -> None:
    text = page(accepted)
    assert 'class="plates' not in text
    assert 'class="n paper"' not in text


def test_marks_far_from_the_drawing_have_a_plate_of_their_own(
    rejected: AuditRecord, drawing: Drawing, plant: Plant
) -> None:
    places = np.concatenate([strewn("spread", 66, (0, 0, 30, 10)), [[5e5, 5e5]]])
    record = record_of(rejected, plant, {"fachada.dxf": (walls(drawing, 30.0, 10.0), places)})
    found = sheets(record)
    windows = np.array([sheet["window"][2] * sheet["cell"] for sheet in found.plates.values()])
    assert windows[1:].max() <= windows[0] / 1.9


def test_too_many_plates_are_cut_off_and_said(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("foparq.report.page.plates.MOST", 3)
    record = one(rejected, drawing, plant, "house", "spread", 500)
    text, found = page(record), sheets(record)
    assert len(found.plates) == 4
    borne = {int(number.text) for plate in found.plates for number in found.numbers(plate)}
    without = [number for number, plate in found.rows.items() if plate == "–"]
    assert sorted({*borne, *without}) == list(range(1, 501))
    assert not borne & {*without}
    assert f"because there are too many: {len(without)}." in text


def test_plates_do_not_depend_on_the_order_of_drawing(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    record = one(rejected, drawing, plant, "house", "clustered", 66)
    assert page(record) == page(record)


def test_the_page_stays_small(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    record = one(rejected, drawing, plant, "house", "spread", 5000)
    text = page(record)
    ink = sum(len(part) for part in re.findall(r'<g id="p\d+f?".*?</g>', text, flags=re.DOTALL))
    plates = sum(len(part) for part in re.findall(r'<figure class="plate .*?</figure>', text, flags=re.DOTALL))
    assert ink + plates < 0.25 * len(text)


@pytest.mark.parametrize("grouped", [True, False])
@pytest.mark.parametrize("kind", ["spread", "clustered", "one place"])
def test_a_cut_keeps_every_mark_once(kind: str, grouped: bool) -> None:  # noqa: FBT001
    spots = np.rint(strewn(kind, 200, (0, 0, 30, 10)) * 1000)
    paper = np.array([269.0, 155.0])
    parts = list(cut(spots, np.arange(200), 24, 60.0, paper, grouped=grouped))
    assert np.sort(np.concatenate(parts)).tolist() == list(range(200))
    assert max(map(len, parts)) <= 24
    assert all((np.ptp(spots[part], axis=0) / paper).max() <= 60.0 for part in parts)


def test_a_cut_for_number_alone_makes_no_more_parts_than_needed() -> None:
    spots = np.rint(strewn("spread", 500, (0, 0, 30, 10)) * 1000)
    parts = list(cut(spots, np.arange(500), 24, np.inf, np.array([269.0, 155.0]), grouped=False))
    assert len(parts) == 21


def test_groups_are_parted_at_the_gap_between_them() -> None:
    random = np.random.default_rng(3)
    spots = np.rint(np.concatenate([random.normal(5000, 30, (10, 2)), random.normal(25_000, 30, (10, 2))]))
    parts = list(cut(spots, np.arange(20), 24, np.inf, np.array([269.0, 155.0])))
    assert sorted(sorted(part.tolist()) for part in parts) == [list(range(10)), list(range(10, 20))]


@pytest.mark.parametrize(("spots", "crowded"), [
    ([[0, 0], [0, 0], [100, 0]], False), ([[0, 0], [0, 0]], False), ([[0, 0], [1e-6, 0], [100, 100]], True),
])  # fmt: skip
def test_marks_at_one_place_crowd_nothing(spots: list[list[float]], crowded: bool) -> None:  # noqa: FBT001
    assert _crowded(np.array(spots, dtype=float), 1.0) is crowded
