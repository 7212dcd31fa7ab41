# SPDX-License-Identifier: MIT
"""A CAD export is recognised whole: the same drawing is read alike as DXF and as GDAL hands it on."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from tests.read.cad_exports import APART, KEPT, WHOLE, export
from tests.read.drawn import read as read_drawn
from tests.read.gis_files import read, write

from foparq.cli.main import run
from foparq.model.items import holders_of
from foparq.read.raw import RawDrawing

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning", "ignore::RuntimeWarning")
BOTH = pytest.mark.parametrize("blocks", [WHOLE, APART], ids=["whole", "apart"])
AGES = pytest.mark.parametrize("version", ["R12", "R2000", "R2010"])


def drawing(folder: Path, version: str) -> Path:
    """One of everything, with the names that are written here."""
    made = ezdxf.new(version, setup=True)
    space = made.modelspace()
    window = made.blocks.new("JANELA")
    window.add_line((0, 0), (1, 0))
    window.add_line((1, 0), (1, 1))
    window.add_circle((0.5, 0.5), 0.1)
    window.add_text("J", dxfattribs={"height": 0.1})
    window.add_attdef("TAG", (0, 0))
    space.add_line((0, 0), (10, 0), dxfattribs={"layer": "PAREDE"})
    space.add_blockref("JANELA", (3, 3), dxfattribs={"layer": "VÃO"}).add_auto_attribs({"TAG": "J1"})
    array = {"layer": "VÃO", "row_count": 2, "column_count": 2, "row_spacing": 2, "column_spacing": 2}
    space.add_blockref("JANELA", (20, 3), dxfattribs=array)
    space.add_circle((0, 8), 1)
    space.add_point((1, 1))
    space.add_polyline2d([(0, 20), (1, 20), (1, 21)], close=True, dxfattribs={"layer": "PAREDE"})
    space.add_text("P1", dxfattribs={"layer": "TEXTO"}).set_placement((1, 1))
    space.add_text("ESC. 1:50", dxfattribs={"layer": "TEXTO"}).set_placement((1, 2))
    space.add_solid([(30, 0), (31, 0), (30, 1), (31, 1)])
    space.add_3dface([(40, 0, 0), (41, 0, 0), (41, 1, 1)])
    space.add_linear_dim((0, -1), (0, 0), (10, 0), dxfattribs={"layer": "COTAS"}).render()
    if version != "R12":
        hatch = space.add_hatch(dxfattribs={"layer": "HACHURA"})
        hatch.paths.add_polyline_path([(50, 0), (51, 0), (51, 1)], is_closed=True)
        hatch.paths.add_polyline_path([(60, 0), (61, 0), (61, 1)], is_closed=True)
        space.add_mtext("nota", dxfattribs={"insert": (2, 2), "layer": "TEXTO"})
        space.add_leader([(0, 0), (1, 1), (2, 1)])
        space.add_mline([(0, 0), (1, 1)])
    sheet = made.layout("Layout1")
    sheet.add_line((0, 0), (100, 0))
    sheet.add_text("folha")
    path = folder / f"{version}.dxf"
    made.saveas(path)
    return path


def drawn(items: Any) -> Counter[tuple[str, str]]:
    """Linework and fillings of model space, by role and layer."""
    seen = np.isin(items.role, ["line", "area", "point", "hatch", "surface"]) & ~items.paper
    return Counter(zip(items.role[seen].tolist(), items.layer[seen].tolist(), strict=True))


@BOTH
@AGES
def test_linework_hatches_and_surfaces_are_those_of_the_drawing(
    tmp_path: Path, version: str, blocks: dict[str, str]
) -> None:
    source = drawing(tmp_path, version)
    own, other = read_drawn(source, unit="m"), read(export(source, tmp_path / "a.gpkg", blocks), unit="m")
    fillings = Counter({("hatch", "HACHURA"): 1} if version != "R12" else {})  # a part is an item there
    assert drawn(other.items) == drawn(own.items) + fillings
    assert own.reading.labels is not None
    assert other.reading.labels is not None
    assert sorted(other.reading.labels.text) == sorted(own.reading.labels.text)
    assert other.reading.scales == own.reading.scales
    assert not other.reading.bad_names
    skips = [{(one.reason, one.kind, one.layer): one.count for one in one.reading.skipped} for one in (own, other)]
    line = [key for key in skips[1] if key[1] == "LineString"]  # R12 does not say what a line is
    assert {**skips[1], **{(key[0], "LINE", key[2]): skips[1][key] for key in line}}.items() >= skips[0].items()
    assert len(skips[1]) == len(skips[0])


@BOTH
@AGES
def test_whatever_has_a_handle_is_called_by_it(tmp_path: Path, version: str, blocks: dict[str, str]) -> None:
    source = drawing(tmp_path, version)
    own, other = read_drawn(source, unit="m").items, read(export(source, tmp_path / "a.gpkg", blocks), unit="m").items
    top = own.item[(own.inserts == "") & (own.role == "line")]
    assert set(top) <= set(other.item)
    assert len(set(other.item)) == len(other)
    assert {chain.split("/")[0] for chain in own.inserts} == set(other.inserts)
    within = other.inserts != ""
    assert all(
        item.startswith(f"{handle}.") for item, handle in zip(other.item[within], other.handle[within], strict=True)
    )


@AGES
def test_every_insert_holds_what_it_holds_in_the_drawing(tmp_path: Path, version: str) -> None:
    source = drawing(tmp_path, version)

    def held(raw: RawDrawing) -> Counter[tuple[str, str]]:
        lines = raw.items.holders[raw.items.role == "line"]
        return Counter((one.name, one.layer) for text in lines for one in holders_of(text))

    own, other = read_drawn(source, unit="m"), read(export(source, tmp_path / "a.gpkg", WHOLE), unit="m")
    assert held(other) == held(own)


def test_blocks_that_were_kept_whole_leave_the_question_open(tmp_path: Path) -> None:
    source = drawing(tmp_path, "R2010")
    found = read(export(source, tmp_path / "a.gpkg", KEPT), unit="m")
    kept = [one for one in found.reading.skipped if one.reason == "blocks-kept" and one.name == "JANELA"]
    assert all(one.reason.opens for one in kept)
    assert sum(one.count for one in kept if one.layer == "VÃO") == 5
    assert not set(found.items.layer) & {"VÃO", "blocks"}
    assert found.reading.labels is not None
    assert "J" not in found.reading.labels.text


def test_closed_lines_exported_as_areas_are_lines(tmp_path: Path) -> None:
    corners = "0 0, 1 0, 1 1, 0 0"
    path = write(
        tmp_path / "a.gpkg", [f"POLYGON (({corners}))", f"POLYGON (({corners}))", f"POLYGON (({corners}))"],
        Layer=["A", "A", "A"], EntityHandle=["1", "2", "3"],
        SubClasses=["AcDbEntity:AcDbPolyline", "AcDbEntity:AcDbHatch", "AcDbEntity:AcDbTrace"],
    )  # fmt: skip
    items = read(path).items
    assert items.role.tolist() == ["line", "hatch", "surface"]
    assert shapely.equals(items.geometry[0], shapely.from_wkt(f"LINESTRING ({corners})"))
    assert items.kind.tolist() == ["LWPOLYLINE", "HATCH", "SOLID"]


@pytest.mark.parametrize("name", ["EntityHandle", "entityhandle", "EntityHand", "ENTITYHANDLE"])
def test_columns_are_known_as_other_programs_write_them(tmp_path: Path, name: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"], **{"LAYER": ["A"], name: ["2F"], "text": ["P1"]})
    items = read(path).items
    assert (items.item.tolist(), items.role.tolist()) == (["2F"], ["annotation"])


def test_a_table_of_ones_own_with_texts_is_no_export(tmp_path: Path) -> None:
    path = write(
        tmp_path / "a.gpkg", ["POINT (0 0)", "POLYGON ((0 0, 1 0, 1 1, 0 0))"], LAYER=["A", "A"], Text=["a", "b"]
    )
    items = read(path).items
    assert (items.item.tolist(), items.role.tolist()) == (
        ["a:1", "a:2"][:0] or ["paredes:1", "paredes:2"],
        ["point", "area"],
    )


def test_lines_with_a_handle_in_common_are_no_dimension(tmp_path: Path) -> None:
    # The insert of a block with a number in it, taken apart: nothing shows a dimension.
    path = write(
        tmp_path / "a.gpkg", ["LINESTRING (0 0, 1 0)", "LINESTRING (0 0, 0 1)", "POINT (0 0)"], Layer=["A"] * 3,
        EntityHandle=["2F"] * 3, Text=[None, None, "1,20"],
        SubClasses=["AcDbEntity:AcDbLine"] * 2 + ["AcDbEntity:AcDbMText"],
    )  # fmt: skip
    assert read(path).items.role.tolist() == ["line", "line", "annotation"]


def test_two_drawings_in_one_table_keep_their_lines_apart(tmp_path: Path) -> None:
    path = write(
        tmp_path / "a.gpkg", ["LINESTRING (0 0, 1 0)", "LINESTRING (5 0, 5 1)", "LINESTRING (0 3, 1 3)"],
        Layer=["A"] * 3, EntityHandle=["2F", "30", "2F"], SubClasses=["AcDbEntity:AcDbLine"] * 3,
    )  # fmt: skip
    items = read(path).items
    assert items.inserts.tolist() == ["", "", ""]
    assert items.item.tolist() == ["2F~1", "30", "2F~3"]
    assert items.handle.tolist() == ["2F", "30", "2F"]


def faulty(folder: Path, version: str) -> Path:
    """Five planted faults, and what must not be taken for one: copies of a hatch, text, a dimension on a line."""
    made = ezdxf.new(version, setup=True)
    space = made.modelspace()
    wall = {"layer": "PAREDE"}
    space.add_line((0, 0), (10, 0), dxfattribs=wall)
    space.add_line((4, 5), (4, 0.0057), dxfattribs=wall)  # undershoot
    space.add_line((6, 5), (6, -0.0061), dxfattribs=wall)  # overshoot
    space.add_line((0, 5), (0, 9), dxfattribs=wall)
    space.add_line((0, 9), (0, 5), dxfattribs=wall)  # duplicate
    space.add_polyline2d([(12, 0), (13, 0), (13, 1), (12, 0.007)], dxfattribs=wall)  # ring left open
    block = made.blocks.new("PORTA")
    block.add_line((0, 0), (1, 0))
    block.add_line((0.4, 1), (0.4, 0.0053))  # undershoot, in a block
    space.add_blockref("PORTA", (20, 0), dxfattribs=wall)
    space.add_solid([(0, 0), (1, 0), (0, 1), (1, 1)], dxfattribs=wall)
    space.add_solid([(0, 0), (1, 0), (0, 1), (1, 1)], dxfattribs=wall)
    space.add_text("P1", dxfattribs=wall).set_placement((4, 5))
    space.add_linear_dim((0, -0.004), (0, 0), (10, 0), dxfattribs={"layer": "PAREDE"}).render()
    if version != "R12":
        for _ in range(2):
            hatch = space.add_hatch(dxfattribs=wall)
            hatch.paths.add_polyline_path([(0, 0), (4, 0), (4, 5)], is_closed=True)
    path = folder / f"{version}.dxf"
    made.saveas(path)
    return path


def findings(path: Path, capsys: pytest.CaptureFixture[str]) -> list[dict[str, Any]]:
    args = ["check", str(path), "--scale", "1:50", "--unit", "m", "--format", "jsonl", "--lang", "en"]
    assert run(args) == 1
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


@BOTH
@pytest.mark.parametrize(("version", "multi"), [("R12", True), ("R2000", False), ("R2010", True)])
def test_findings_are_those_of_the_drawing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], version: str, blocks: dict[str, str], *, multi: bool
) -> None:
    source = faulty(tmp_path, version)
    own = findings(source, capsys)
    other = findings(export(source, tmp_path / "a.gpkg", blocks, multi=multi), capsys)

    def known(found: list[dict[str, Any]]) -> list[tuple[Any, ...]]:
        named = [(one["name"], one["severity"], one["layer"], one["inserts"] or one["handle"]) for one in found]
        sizes = [(np.round(one["where"], 6).tolist(), round(one["size"], 9)) for one in found]
        return sorted((*name, *size) for name, size in zip(named, sizes, strict=True))

    assert known(other) == known(own)
    names = Counter(one["name"] for one in own)
    assert names["duplicate"] == 1
    assert names["overshoot"] == 1
    assert names["open-ring"] + names["undershoot"] >= 3
    of_block = [one for one in other if one["inserts"]]
    assert of_block
    assert all(f"{one['handle']}." in one["message"] for one in of_block)
