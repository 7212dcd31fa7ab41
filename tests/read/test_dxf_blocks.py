# SPDX-License-Identifier: MIT
"""Blocks: counted before they are taken apart, and taken apart as CAD programs do."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from ezdxf.math import Matrix44
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.read.drawn import new, read_back, skipped

from foparq.check.rules.fil.block_bomb import block_bomb
from foparq.errors import UnsafeError
from foparq.model.items import Role
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.blocks import admit, count_blocks


def nested(levels: int, times: int) -> Any:
    """One line at the bottom, ``times`` inserts of each level in the next."""
    document = new()
    document.blocks.new("L0").add_line((0, 0), (1, 0))
    for level in range(1, levels + 1):
        block = document.blocks.new(f"L{level}")
        for n in range(times):
            block.add_blockref(f"L{level - 1}", (n, level))
    document.modelspace().add_blockref(f"L{levels}", (0, 0))
    document.modelspace().add_line((0, 0), (5, 5))
    return document


def test_nested_bomb_is_counted_exactly_and_the_rest_is_read(tmp_path: Path) -> None:
    drawing = read_back(nested(8, 10), tmp_path)
    assert [(bomb.block, bomb.entities) for bomb in drawing.reading.bombs] == [("L8", 100_000_000)]
    assert drawing.items.kind.tolist() == ["LINE"]
    assert skipped(drawing) == {("block-bomb", "INSERT"): 1}


def test_depth_without_end_stops_counting_but_not_reading(tmp_path: Path) -> None:
    drawing = read_back(nested(200, 10), tmp_path)
    assert drawing.reading.bombs[0].entities == 10**18  # and more
    assert len(drawing.items) == 1


def test_array_bomb_is_counted_exactly(tmp_path: Path) -> None:
    document = new()
    document.blocks.new("CELL").add_point((0, 0))
    counts = {"row_count": 32767, "column_count": 32767, "row_spacing": 1, "column_spacing": 1}
    document.modelspace().add_blockref("CELL", (0, 0), dxfattribs=counts)
    drawing = read_back(document, tmp_path)
    assert [bomb.entities for bomb in drawing.reading.bombs] == [1_073_676_289]
    assert len(drawing.items) == 0


def test_inserts_of_nothing_are_a_bomb_too(tmp_path: Path) -> None:
    document = nested(8, 10)
    document.blocks.get("L0").delete_all_entities()
    drawing = read_back(document, tmp_path)
    assert [bomb.entities for bomb in drawing.reading.bombs] == [sum(10**n for n in range(1, 9))]


def test_cycle_is_cut_and_what_surrounds_it_is_read(tmp_path: Path) -> None:
    document = new()
    one, two, frame = (document.blocks.new(name) for name in ("ONE", "TWO", "FRAME"))
    one.add_blockref("TWO", (1, 0))
    two.add_blockref("ONE", (1, 0))
    frame.add_line((0, 0), (1, 0))
    frame.add_blockref("ONE", (0, 0))
    document.modelspace().add_blockref("FRAME", (0, 0))
    drawing = read_back(document, tmp_path)
    assert [(bomb.block, bomb.entities) for bomb in drawing.reading.bombs] == [("ONE", -1)]
    assert drawing.items.kind.tolist() == ["LINE"]


def test_block_that_inserts_itself(tmp_path: Path) -> None:
    document = new()
    document.blocks.new("SELF").add_blockref("SELF", (1, 0))
    document.modelspace().add_blockref("SELF", (0, 0))
    assert [bomb.entities for bomb in read_back(document, tmp_path).reading.bombs] == [-1]


def test_bomb_that_nothing_inserts_is_none(tmp_path: Path) -> None:
    document = nested(8, 10)
    document.modelspace().delete_all_entities()
    document.modelspace().add_line((0, 0), (1, 1))
    drawing = read_back(document, tmp_path)
    assert drawing.reading.bombs == ()
    assert len(drawing.items) == 1


def test_a_block_exactly_as_large_as_the_room_is_taken_apart(tmp_path: Path) -> None:
    document = nested(2, 3)  # nine lines and the one beside it; twelve inserts below the top
    assert read_back(document, tmp_path, limits=LimitsSpec(entities=13)).reading.bombs == ()
    refused = read_back(document, tmp_path, limits=LimitsSpec(entities=12)).reading.bombs
    assert [bomb.entities for bomb in refused] == [12]


def test_small_blocks_are_admitted_before_large_ones_in_whatever_order() -> None:
    census = count_blocks({"A": 5, "B": 50, "C": 7}, {"A": [], "B": [], "C": []})
    assert admit({"B": 1, "A": 2, "C": 1}, census, 30) == {"B": 50}
    assert admit({"C": 1, "A": 2, "B": 1}, census, 30) == {"B": 50}


def test_a_block_may_fill_the_room_that_is_left() -> None:
    census = count_blocks({"A": 10, "B": 6}, {"A": [], "B": []})
    assert admit({"A": 1, "B": 2}, census, 22) == {}
    assert admit({"A": 1, "B": 2}, census, 21) == {"B": 6}


def test_model_space_over_the_budget_is_refused(tmp_path: Path) -> None:
    document = new()
    for n in range(4):
        document.modelspace().add_line((n, 0), (n, 1))
    with pytest.raises(UnsafeError, match=r"dxf\.too-many-entities"):
        read_back(document, tmp_path, limits=LimitsSpec(entities=3))


USES = st.lists(st.tuples(st.integers(0, 5), st.integers(1, 3)), max_size=3)


@given(st.lists(st.tuples(st.integers(0, 3), USES), min_size=1, max_size=6))
@settings(deadline=None)
def test_counting_equals_walking(blocks: list[tuple[int, list[tuple[int, int]]]]) -> None:
    # Blocks insert only those before them: without cycles the walk ends.
    own = {str(n): count for n, (count, _) in enumerate(blocks)}
    uses = {str(n): [(str(m), t) for m, t in used if m < n] for n, (_, used) in enumerate(blocks)}

    def walk(name: str) -> int:
        return own[name] + sum(times * walk(child) for child, times in uses[name])

    census = count_blocks(own, uses)
    assert census.entities == {name: walk(name) for name in own}
    position = {name: n for n, name in enumerate(census.order)}
    assert all(position[user] < position[child] for user, used in uses.items() for child, _ in used)
    assert not census.cyclic


def by_matrices(space: Any, outer: Matrix44) -> list[tuple[float, ...]]:
    """Ends of all lines by ezdxf's own matrices of inserts, cell by cell."""
    ends = []
    for entity in space:
        if entity.dxftype() == "LINE":
            start, end = outer.transform_vertices([entity.dxf.start, entity.dxf.end])
            ends.append((*start.xyz, *end.xyz))
        else:
            for cell in entity.multi_insert() if entity.mcount > 1 else [entity]:
                ends += by_matrices(entity.block(), cell.matrix44() @ outer)
    return sorted(ends)


def lines_of(items: Any) -> list[tuple[float, ...]]:
    solid = shapely.force_3d(items.geometry)
    return sorted(tuple(shapely.get_coordinates(line, include_z=True).ravel()) for line in solid)


def test_nesting_scale_rotation_extrusion_and_base_point_as_ezdxf_has_them(tmp_path: Path) -> None:
    document = new()
    leaf = document.blocks.new("LEAF", base_point=(1, 2, 3))
    leaf.add_line((0, 0, 0), (4, 1, 2))
    middle = document.blocks.new("MIDDLE", base_point=(0.5, 0, 0))
    middle.add_blockref("LEAF", (3, 1, 1), dxfattribs={"rotation": 30, "xscale": 2, "yscale": -0.5, "zscale": 3})
    middle.add_blockref("LEAF", (0, 1, 0), dxfattribs={"rotation": 200, "extrusion": (0, 0, -1)})
    attributes = {"rotation": 77, "xscale": -1.5, "extrusion": (0.3, -0.4, 0.8660254037844386)}
    document.modelspace().add_blockref("MIDDLE", (10, 20, 30), dxfattribs=attributes)
    array = {"rotation": 15, "row_count": 3, "column_count": 2, "row_spacing": 7, "column_spacing": -4}
    document.modelspace().add_blockref("LEAF", (1, 1, 1), dxfattribs=array)
    items = read_back(document, tmp_path).items
    np.testing.assert_allclose(lines_of(items), by_matrices(document.modelspace(), Matrix44()), atol=1e-9)


def test_ids_name_the_way_through_the_inserts(tmp_path: Path) -> None:
    document = new()
    line = document.blocks.new("LEAF").add_line((0, 0), (1, 0))
    inner = document.blocks.new("MIDDLE").add_blockref(
        "LEAF", (0, 0), dxfattribs={"column_count": 2, "column_spacing": 5}
    )
    outer = document.modelspace().add_blockref("MIDDLE", (0, 0))
    items = read_back(document, tmp_path).items
    a, b, c = outer.dxf.handle, inner.dxf.handle, line.dxf.handle
    assert items.inserts.tolist() == [f"{a}/{b}"] * 2
    assert items.item.tolist() == [f"{a}/{b}:1/{c}", f"{a}/{b}:2/{c}"]
    assert items.handle.tolist() == [c, c]


def test_layer_0_takes_the_layer_of_the_insert_through_all_depths(tmp_path: Path) -> None:
    document = new()
    leaf = document.blocks.new("LEAF")
    leaf.add_line((0, 0), (1, 0))
    leaf.add_line((0, 0), (1, 0), dxfattribs={"layer": "OWN"})
    document.blocks.new("MIDDLE").add_blockref("LEAF", (0, 0))
    document.modelspace().add_blockref("MIDDLE", (0, 0), dxfattribs={"layer": "WALL"})
    assert sorted(read_back(document, tmp_path).items.layer) == ["OWN", "WALL"]


@pytest.mark.parametrize(
    ("hide", "visible"),
    [
        ("off", {"WALL": False, "OWN": True}),  # an off layer hides only what lies on it
        ("frozen", {"WALL": False, "OWN": False}),  # a frozen one hides the whole insert
        ("invisible", {"WALL": False, "OWN": False}),
        ("nothing", {"WALL": True, "OWN": True}),
    ],
)
def test_hidden_inserts(tmp_path: Path, hide: str, visible: dict[str, bool]) -> None:
    document = new()
    wall = document.layers.add("WALL")
    if hide == "off":
        wall.off()
    if hide == "frozen":
        wall.freeze()
    leaf = document.blocks.new("LEAF")
    leaf.add_line((0, 0), (1, 0))
    leaf.add_line((0, 0), (1, 0), dxfattribs={"layer": "OWN"})
    attributes = {"layer": "WALL", "invisible": int(hide == "invisible")}
    document.modelspace().add_blockref("LEAF", (0, 0), dxfattribs=attributes)
    items = read_back(document, tmp_path).items
    assert dict(zip(items.layer, items.visible.tolist(), strict=True)) == visible


@pytest.mark.parametrize("flags", range(16))
def test_of_attribute_definitions_only_constant_ones_are_drawn(tmp_path: Path, flags: int) -> None:
    # Flags of the format: 1 invisible, 2 constant, 4 to verify, 8 preset. A constant one has no ATTRIB in the insert.
    document = new()
    leaf = document.blocks.new("LEAF")
    leaf.add_line((0, 0), (1, 0))
    leaf.add_attdef("NAME", (0, 0), dxfattribs={"flags": flags})
    document.modelspace().add_blockref("LEAF", (0, 0))
    drawing = read_back(document, tmp_path)
    assert sorted(drawing.items.kind.tolist()) == (["ATTDEF", "LINE"] if flags & 2 else ["LINE"])


def test_hatches_of_older_programs_are_one_item_each(tmp_path: Path) -> None:
    document = new()
    strokes = document.blocks.new("*X7")
    for n in range(50):
        strokes.add_line((n, 0), (n, 0))
    document.modelspace().add_blockref("*X7", (3, 4), dxfattribs={"layer": "SCHRAFF"})
    document.blocks.new("FRAME").add_blockref("*X7", (0, 0))
    document.modelspace().add_blockref("FRAME", (10, 0))
    items = read_back(document, tmp_path).items
    assert items.role.tolist() == [Role.HATCH, Role.HATCH]
    assert sorted(place.wkt for place in items.geometry) == ["POINT (10 0)", "POINT (3 4)"]


def test_dynamic_blocks_are_ordinary_blocks(tmp_path: Path) -> None:
    document = new()
    document.blocks.new("*U3").add_line((0, 0), (1, 0))
    document.modelspace().add_blockref("*U3", (0, 0))
    assert read_back(document, tmp_path).items.role.tolist() == [Role.LINE]


def test_blocks_left_alone_are_counted(tmp_path: Path) -> None:
    drawing = read_back(nested(2, 3), tmp_path, blocks="skip")
    assert skipped(drawing) == {("blocks-skipped", "INSERT"): 1}
    assert len(drawing.items) == 1


def test_block_that_the_file_does_not_hold(tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_blockref("NOWHERE", (0, 0))
    assert skipped(read_back(document, tmp_path)) == {("missing-block", "INSERT"): 1}


def test_curves_in_enlarged_blocks_keep_the_sagitta(tmp_path: Path) -> None:
    document = new()
    document.blocks.new("WHEEL").add_circle((0, 0), 0.001)
    document.modelspace().add_blockref("WHEEL", (0, 0), dxfattribs={"xscale": 1000, "yscale": 1000, "zscale": 1000})
    items = read_back(document, tmp_path, sagitta=1e-4).items
    assert 1 - shapely.distance(shapely.Point(0, 0), items.geometry[0]) <= 1e-4 * (1 + 1e-9)


def test_dimension_in_an_enlarged_block_measures_in_model_space(tmp_path: Path) -> None:
    document = new(insunits=0)
    block = document.blocks.new("DETAIL")
    block.add_linear_dim(base=(0, 2), p1=(0, 0), p2=(37, 0), text="3'-1\"").render()
    document.modelspace().add_blockref(
        "DETAIL", (0, 0), dxfattribs={"xscale": 0.0254, "yscale": 0.0254, "zscale": 0.0254}
    )
    dimensions = read_back(document, tmp_path).reading.dimensions
    assert dimensions is not None
    assert dimensions.measured.tolist() == pytest.approx([0.9398])
    assert dimensions.text.tolist() == ["3'-1\""]


def test_rule_reports_what_the_reader_found(tmp_path: Path) -> None:
    from foparq.model.inputs import Bombs, nameless

    bombs = read_back(nested(8, 10), tmp_path).reading.bombs
    rows = Bombs(
        entities=np.array([float(bomb.entities) for bomb in bombs]),
        where=np.array([shapely.Point()], dtype=object),
        **nameless(1),
    )
    assert block_bomb(rows).size.tolist() == [1e8]


def test_an_insert_that_states_no_place_stands_at_the_origin(tmp_path: Path) -> None:
    document = new()
    document.blocks.new("B").add_line((1, 2), (3, 4))
    for at in ((5, 6), None):
        reference = document.modelspace().add_blockref("B", at or (0, 0))
        if at is None:
            reference.dxf.discard("insert")
    items = read_back(document, tmp_path).items
    assert [shapely.get_coordinates(shape).tolist() for shape in items.geometry] == [
        [[6, 8], [8, 10]], [[1, 2], [3, 4]],
    ]  # fmt: skip
