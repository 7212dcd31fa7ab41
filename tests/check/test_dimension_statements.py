# SPDX-License-Identifier: MIT
"""What the lettering of dimensions and the extent say of the unit, at their bounds."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from tests.check.test_engine import drawing
from tests.read.drawn import new, read_back

from foparq.check.drawn.unit_evidence import unit_evidence
from foparq.model.drawing import Dimensions, Drawing, DrawingUnit, Reading, UnitOrigin
from foparq.model.items import Role, no_items
from foparq.model.plane import plane_of

METRES = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)


def stating(unit: DrawingUnit = METRES, dimensions: Dimensions | None = None) -> Drawing:
    items = no_items()
    reading = Reading(version="AC1027", dimensions=dimensions)
    return Drawing(path="a.dxf", items=items, reading=reading, unit=unit, plane=plane_of("xy", items.geometry))


def lettered(*pairs: tuple[float, str]) -> Drawing:
    return stating(dimensions=Dimensions(
        measured=np.array([measured for measured, _ in pairs]),
        text=np.array([text for _, text in pairs], dtype=object),
        handle=np.array([f"{n:X}" for n in range(len(pairs))], dtype=object),
        where=shapely.points([[n, 0.0] for n in range(len(pairs))]),
    ))  # fmt: skip


def says(made: Drawing) -> list[float]:
    return unit_evidence(made).says.tolist()


@pytest.mark.parametrize(("few", "known"), [(1, [1.0]), (2, [0.5, 1.0])])
def test_a_quarter_of_the_dimensions_is_no_group(few: int, known: list[float]) -> None:
    # One of four is a quarter, two of five more than that.
    right = [(float(n), f"{n},00 m") for n in range(1, 4)]
    wrong = [(2.0 * n, f"{n},00 m") for n in range(1, few + 1)]
    assert says(lettered(*right, *wrong)) == pytest.approx(known)


@pytest.mark.parametrize(("ratio", "groups"), [(1.049, 1), (1.051, 2)])
def test_ratios_within_a_twentieth_are_one_group(ratio: float, groups: int) -> None:
    assert len(says(lettered((1.0, "1,00 m"), (1.0, "1,00 m"), (1.0, f"{ratio} m"), (1.0, f"{ratio} m")))) == groups


@pytest.mark.parametrize(("number", "known"), [(1019, [1.0]), (1021, [])])
def test_a_number_fits_a_unit_within_two_per_cent(number: int, known: list[float]) -> None:
    assert says(lettered((1.0, str(number)), (1.0, str(number)))) == pytest.approx(known)


@pytest.mark.parametrize(("fit", "known"), [(2, []), (3, [1.0])])
def test_numbers_tell_a_unit_only_if_most_of_them_do(fit: int, known: list[float]) -> None:
    other = [(1.0, "7"), (1.0, "13")]
    assert says(lettered(*[(1.0, "1000")] * fit, *other)) == pytest.approx(known)


@pytest.mark.parametrize(
    ("factor", "metres"),
    [
        (1000, 1.0), (100, 1.0), (10, 0.01), (0.1, 0.001), (0.01, 0.01), (0.001, 0.001), (12, 0.3048),
        (25.4, 0.0254), (2.54, 0.0254), (304.8, 0.3048), (30.48, 0.3048),
    ],
)  # fmt: skip
def test_factors_that_a_pair_of_units_explains(factor: float, metres: float) -> None:
    pairs = [(1000.0 * n, f"{1000 * n * factor:.6f}".rstrip("0").rstrip(".")) for n in (1, 2, 5)]
    assert says(lettered(*pairs)) == pytest.approx([metres])


@pytest.mark.parametrize(("stretch", "told"), [(1.0019, False), (1.0021, True), (0.9981, False), (0.9979, True)])
def test_a_projection_beyond_two_in_a_thousand_is_told(stretch: float, told: bool) -> None:  # noqa: FBT001
    unit = DrawingUnit(
        metres=2.0, name="x", origin=UnitOrigin.HEADER, header="EPSG:1", header_metres=2.0, stretch=stretch
    )
    assert says(stating(unit)) == (pytest.approx([2.0 / stretch]) if told else [])


@pytest.mark.parametrize(
    ("across", "version", "told"),
    [
        (0.19, "AC1027", True), (0.2, "AC1027", False), (499.0, "AC1027", False), (501.0, "AC1027", True),
        (501.0, "GPKG", False), (19_999.0, "GPKG", False), (20_001.0, "GPKG", True),
    ],
)  # fmt: skip
def test_an_extent_that_no_building_has(across: float, version: str, told: bool) -> None:  # noqa: FBT001
    made = drawing([f"LINESTRING (0 0, {across} 0)"] * 10)
    evidence = unit_evidence(Drawing(
        path="a", items=made.items, reading=Reading(version=version), unit=METRES, plane=made.plane
    ))  # fmt: skip
    assert ("extent" in evidence.item) is told
    if told:
        plausible = 0.2 if across < 0.2 else 500.0 if version.startswith("AC") else 20_000.0
        assert evidence.says.tolist() == pytest.approx([plausible / across])


def test_height_counts_as_extent() -> None:
    made = drawing(["LINESTRING Z (0 0 0, 0.1 0 3)"])
    assert "extent" not in unit_evidence(made).item
    assert "extent" in unit_evidence(drawing(["LINESTRING Z (0 0 0, 0.1 0 0.1)"])).item


def test_what_is_not_seen_has_no_extent() -> None:
    made = drawing(["LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 0.1 0)"], visible=[False, True])
    reading = Reading(version="AC1027")
    assert (
        "extent"
        in unit_evidence(Drawing(path="a", items=made.items, reading=reading, unit=METRES, plane=made.plane)).item
    )


def test_a_dimension_alone_in_a_file_names_itself(tmp_path: Path) -> None:
    document = new()
    block = document.blocks.new("CORTE")
    document.layers.add("COTAS")
    block.add_linear_dim(base=(0, 1), p1=(0, 0), p2=(2, 0), text="3'-0\"", dxfattribs={"layer": "COTAS"}).render()
    document.modelspace().add_blockref("CORTE", (5, 5), dxfattribs={"layer": "PAREDE"})
    raw = read_back(document, tmp_path, unit="m")
    made = Drawing(
        path="a.dxf", items=raw.items, reading=raw.reading, unit=raw.unit, plane=plane_of("xy", raw.items.geometry)
    )
    evidence = unit_evidence(made)
    (n,) = np.flatnonzero(np.char.startswith(evidence.handle.astype(str), "DIMENSION"))
    row = int(evidence.row[n])
    assert row == 0
    assert evidence.says[n] == pytest.approx(0.9144 / 2)
    assert (evidence.layer[n], evidence.item[n]) == ("COTAS", raw.items.item[0])
    assert evidence.inserts[n] == raw.items.inserts[0] != ""


@pytest.mark.parametrize(("chain", "row"), [("2A", 3), ("2C/2A", 4), ("2B", -1), ("2D/2A", -1)])
def test_a_statement_is_about_the_dimension_itself_not_about_its_lines(chain: str, row: int) -> None:
    thing = drawing(["LINESTRING (0 0, 1 0)"] * 5, inserts=["", "2C", "", "", "2C"], layers=["A", "B", "C", "D", "E"])
    handles = np.array(["2A", "2A", "2B", "2A", "2A"], dtype=object)
    roles = np.array([Role.LINE, Role.LINE, Role.LINE, Role.ANNOTATION, Role.ANNOTATION], dtype=object)
    dimensions = Dimensions(
        measured=np.array([1.0]), text=np.array(["2,00 m"], dtype=object), handle=np.array([chain], dtype=object),
        where=shapely.points([[0.5, 0.0]]),
    )  # fmt: skip
    items = replace(thing.items, handle=handles, role=roles)
    told = unit_evidence(replace(thing, items=items, reading=Reading(version="AC1027", dimensions=dimensions)))
    assert (told.row.tolist(), told.says.tolist()) == ([row], [2.0])
    assert told.layer.tolist() == ["ABCDE"[row] if row >= 0 else ""]
    assert told.item.tolist() == [thing.items.item[row] if row >= 0 else chain]
