# SPDX-License-Identifier: MIT
"""What a drawing says of its unit."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from tests.read.drawn import new, read, read_back

from foparq.check.drawn.unit_evidence import unit_evidence
from foparq.check.rules.dom.unit_contradiction import unit_contradiction
from foparq.model.drawing import Dimensions, Drawing, DrawingUnit, Reading, UnitOrigin
from foparq.model.items import Items, no_items
from foparq.model.plane import plane_of


def lettered(pairs: list[tuple[float, str]]) -> Dimensions:
    return Dimensions(
        measured=np.array([measured for measured, _ in pairs]),
        text=np.array([text for _, text in pairs], dtype=object),
        handle=np.array([f"{n:X}" for n in range(len(pairs))], dtype=object),
        where=shapely.points([[n, 0.0] for n in range(len(pairs))]),
    )


def drawing(
    pairs: list[tuple[float, str]] | None = None, unit: DrawingUnit | None = None, items: Items | None = None
) -> Drawing:
    items = no_items() if items is None else items
    unit = unit or DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)
    reading = Reading(version="AC1027", dimensions=lettered(pairs) if pairs else None)
    return Drawing(path="a.dxf", items=items, reading=reading, unit=unit, plane=plane_of("xy", items.geometry))


def says(made: Drawing) -> list[float]:
    return unit_evidence(made).says.tolist()


def test_a_silent_drawing_says_nothing() -> None:
    assert len(unit_evidence(drawing())) == 0


def test_header_is_a_statement_only_when_another_unit_is_used() -> None:
    stated = DrawingUnit(metres=0.0254, name="in", origin=UnitOrigin.STATED, header="mm", header_metres=0.001)
    evidence = unit_evidence(drawing(unit=stated))
    assert (evidence.item.tolist(), evidence.says.tolist()) == (["$INSUNITS"], [0.001])
    assert says(drawing(unit=replace(stated, metres=0.001, origin=UnitOrigin.HEADER))) == []


def test_feet_and_inches_tell_the_unit() -> None:
    pairs = [(37.0, "3'-1\""), (192.0, "16'-0\""), (150.0, "12'-6\"")]
    assert says(drawing(pairs)) == pytest.approx([0.0254])


@pytest.mark.parametrize(
    ("pairs", "metres"),
    [
        ([(2.5, "2500"), (1.2, "1200")], [1.0]),
        ([(2.5, "250"), (1.2, "120")], [1.0]),
        ([(250.0, "2,50"), (120.0, "1.20")], [0.01]),
        ([(2500.0, "2,50"), (1200.0, "1.20")], [0.001]),
        ([(2.5, "2,50"), (1.2, "1.20")], []),  # one to one: says nothing
        ([(2.5, "17"), (1.2, "1200")], []),  # two factors: no majority
    ],
)
def test_numbers_alone_tell_it_only_by_one_consistent_factor(
    pairs: list[tuple[float, str]], metres: list[float]
) -> None:
    assert says(drawing(pairs)) == pytest.approx(metres)


def test_a_few_wrong_letterings_are_no_unit() -> None:
    right = [(float(n), f"{n},00 m") for n in range(1, 9)]
    assert says(drawing([*right, (2.5, "3,10 m")])) == pytest.approx([1.0])


def test_two_large_groups_are_two_statements_with_place_and_examples() -> None:
    metric = [(float(n), f"{n}.00 m") for n in range(1, 9)]
    imperial = [(12.0 * n, f"{n}'-0\"") for n in range(1, 5)]
    evidence = unit_evidence(drawing([*metric, *imperial]))
    assert evidence.says.tolist() == pytest.approx([0.0254, 1.0])
    assert evidence.handle.tolist() == ["DIMENSION 8, 9, A, B", "DIMENSION 0, 1, 2, 3, 4 (+3)"]
    assert [len(place.geoms) for place in evidence.where] == [4, 5]


def test_statements_do_not_depend_on_the_order_of_dimensions() -> None:
    pairs = [(12.0 * n, f"{n}'-0\"") for n in range(1, 5)]
    behind = lettered(pairs)
    behind = Dimensions(
        measured=behind.measured[::-1], text=behind.text[::-1], handle=behind.handle[::-1], where=behind.where[::-1]
    )
    made = drawing(pairs)
    turned = replace(made, reading=replace(made.reading, dimensions=behind))
    assert unit_evidence(made).handle.tolist() == unit_evidence(turned).handle.tolist()
    assert unit_evidence(made).where[0] == unit_evidence(turned).where[0]


def test_projection_stretch_beyond_two_per_mille_is_a_statement() -> None:
    mercator = DrawingUnit(
        metres=1.0, name="m", origin=UnitOrigin.HEADER, header="EPSG:3857", header_metres=1.0, stretch=1.6
    )
    assert says(drawing(unit=mercator)) == pytest.approx([1 / 1.6])
    assert says(drawing(unit=replace(mercator, stretch=1.0009))) == []


def lines(folder: Path, ends: list[tuple[float, float]], unit: str = "m") -> Drawing:
    document = new()
    for x, y in ends:
        document.modelspace().add_line((x, y), (x + 0.01, y))
    raw = read_back(document, folder, unit=unit)
    plane = plane_of("xy", raw.items.geometry)
    return Drawing(path="a.dxf", items=raw.items, reading=raw.reading, unit=raw.unit, plane=plane)


def test_a_house_of_millimetres_is_implausible(tmp_path: Path) -> None:
    made = lines(tmp_path, [(0, 0), (22.0, 0), (0, 14.5)], unit="mm")
    evidence = unit_evidence(made)
    assert evidence.item.tolist() == ["$INSUNITS", "extent"]
    assert evidence.says[1] == pytest.approx(0.2 / 22.01)
    assert len(unit_contradiction(evidence, agree=0.02)) == 2


def test_one_stray_at_the_origin_does_not_make_a_town_of_a_house(tmp_path: Path) -> None:
    house = [(440_000 + x % 5, 7_400_000 + x / 5) for x in range(30)]
    assert "extent" not in unit_evidence(lines(tmp_path, [(0, 0), *house])).item


def test_a_house_of_kilometres_is_implausible(tmp_path: Path) -> None:
    made = lines(tmp_path, [(100.0 * n, 0) for n in range(20)], unit="km")
    assert "extent" in unit_evidence(made).item


def test_nothing_contradicts_where_no_unit_is_used() -> None:
    unknown = DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN)
    evidence = unit_evidence(drawing([(37.0, "3'-1\"")], unit=unknown))
    assert np.isnan(evidence.used).all()
    assert evidence.says.tolist() == pytest.approx([0.0254])
    assert len(unit_contradiction(evidence, agree=0.02)) == 0


def bishop(shared: Path, **options: Any) -> Drawing:
    raw = read(shared / "data/drawings/bishop_overland/floorplan.dxf", **options)
    plane = plane_of("xy", raw.items.geometry)
    return Drawing(path="floorplan.dxf", items=raw.items, reading=raw.reading, unit=raw.unit, plane=plane)


@pytest.mark.shared
def test_bishop_as_its_header_says(shared: Path) -> None:
    evidence = unit_evidence(bishop(shared))
    hits = unit_contradiction(evidence, agree=0.02)
    assert hits.size.tolist() == pytest.approx([0.0254])
    assert evidence.handle[0].endswith("(+58)")  # 63 dimensions in all
    assert evidence.layer[0] == "A-DIMS-1"


@pytest.mark.shared
def test_bishop_in_inches_as_stated(shared: Path) -> None:
    evidence = unit_evidence(bishop(shared, unit="in"))
    hits = unit_contradiction(evidence, agree=0.02)
    assert evidence.item[hits.row].tolist() == ["$INSUNITS"]
    assert hits.size.tolist() == pytest.approx([0.001])
