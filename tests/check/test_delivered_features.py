# SPDX-License-Identifier: MIT
"""What is one feature: counted from drawings whose windows anybody can count."""

from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
import shapely.affinity
from tests.check.windows import (
    FAIL,
    GAP,
    PASS,
    PLACES,
    UNDECIDED,
    counted,
    drawing,
    frame,
    interval,
    pane,
    read,
    verdicts,
)
from tests.evaluate.deliveries import drawn, judge, listed, messages, spec

from foparq.check.drawn.features import count_features
from foparq.model.drawing import DrawingUnit, Reading, UnitOrigin
from foparq.model.items import Holder, Role, holders_of

# --- loose linework --------------------------------------------------------------------------------------------------


def test_windows_drawn_apart_are_counted_and_have_one_reading() -> None:
    thing = drawing([frame(*place) for place in PLACES])
    assert interval(thing) == (20, 20, 20)
    assert verdicts(thing) == (PASS, PASS)


@pytest.mark.parametrize("shape", ["LINESTRING (0 0, 2 0)", "LINESTRING (1 1, 2.2 2.6)", "LINESTRING (5 0, 5 1, 5 2)"])
def test_a_feature_drawn_as_one_straight_line_has_an_outline_as_wide_as_the_gap(shape: str) -> None:
    line = shapely.from_wkt(shape)
    found = counted(drawing([shape, frame(20.0, 0.0)])).found
    narrow, window = found.outline[np.argsort([one.bounds[0] for one in found.outline])]
    assert (narrow.geom_type, narrow.is_valid, shapely.contains(narrow, line)) == ("Polygon", True, True)
    assert GAP * line.length < narrow.area < GAP * line.length + np.pi * GAP**2 / 4
    assert shapely.hausdorff_distance(narrow, line) <= GAP / 2 * (1 + 1e-9)
    assert window.area == pytest.approx(1.5)


def test_half_of_the_windows_missing_fails_and_five_more_fail() -> None:
    assert verdicts(drawing([frame(*place) for place in PLACES[:10]])) == (PASS, FAIL)
    more = [frame(x, 100.0) for x in (0.0, 3.0, 6.0, 9.0, 12.0)]
    assert verdicts(drawing([*(frame(*place) for place in PLACES), *more])) == (FAIL, PASS)


def test_frame_and_glass_are_one_window_or_two() -> None:
    thing = drawing([frame(*place, inset) for place in PLACES for inset in (0.0, 0.06)])
    assert interval(thing) == (20, 40, 40)
    assert verdicts(thing) == (UNDECIDED, PASS)
    assert verdicts(thing, required=40) == (PASS, UNDECIDED)


def test_frames_with_glass_fail_where_no_reading_helps() -> None:
    thing = drawing([frame(*place, inset) for place in PLACES for inset in (0.0, 0.06)])
    assert verdicts(thing, required=15) == (FAIL, PASS)
    assert verdicts(thing, required=60) == (PASS, FAIL)


def test_a_reason_names_the_class_and_both_counts() -> None:
    thing = drawing([frame(*place, inset) for place in PLACES for inset in (0.0, 0.06)])
    delivery = drawn(thing, features=listed(("window", "N", 20)))
    (commission,) = judge(spec("commission"), delivery=delivery, counts=counted(thing)).elements
    assert messages(commission) == ["commission.interval"]
    assert dict(commission.why[0].fields)["classes"] == ["window / N: 20–40"]
    assert commission.value == 0.0
    assert ("surplus-most", 20.0, "items") in commission.parameters


@pytest.mark.parametrize("depth", [2, 5, 15])
def test_nesting_has_no_depth_and_no_order(depth: int) -> None:
    frames = [shapely.from_wkt(frame(*place)) for place in PLACES]
    shapes = [shapely.affinity.scale(one, 0.93**n, 0.93**n).wkt for one in frames for n in range(depth)]
    expected = (20, 20 * depth, 20 * depth)
    assert interval(drawing(shapes)) == expected
    for seed in range(3):
        order = np.random.default_rng(seed).permutation(len(shapes))
        assert interval(drawing([shapes[n] for n in order])) == expected


def test_what_cannot_be_seen_at_the_scale_is_no_feature() -> None:
    specks = [f"LINESTRING ({x} {y}, {x + 0.001} {y})" for x, y in PLACES]
    blocks = [str(Holder(str(n), "JANELA", "J")) for n in range(20)]
    for thing in (drawing(specks), drawing(specks, holders=blocks)):
        assert interval(thing) == (0, 0, 0)
        assert verdicts(thing) == (PASS, FAIL)
    larger = [f"LINESTRING ({x} {y}, {x + 0.011} {y})" for x, y in PLACES]
    assert interval(drawing(larger)) == (20, 20, 20)


def test_points_are_no_features() -> None:
    points = drawing([f"POINT ({x} {y})" for x, y in PLACES], role=Role.POINT)
    assert interval(points) == (0, 0, 0)
    assert verdicts(points) == (PASS, FAIL)


def test_coordinates_that_are_no_numbers_stop_nothing() -> None:
    thing = drawing([frame(*place) for place in PLACES])
    geometry = thing.items.geometry.copy()
    with np.errstate(invalid="ignore"):
        geometry[:2] = shapely.linestrings([[[np.nan, 0], [1, 1]], [[0, 0], [np.inf, 1]]])
        geometry[2] = shapely.LineString([(-1e308, 0), (1e308, 1e308)])
    assert interval(replace(thing, items=replace(thing.items, geometry=geometry))) == (17, 17, 17)


# --- names, drawings, hidden layers ----------------------------------------------------------------------------------


def test_case_tells_no_classes_and_no_facades_apart() -> None:
    thing = drawing(
        [frame(*place) for place in PLACES], layer=["JANELA"] * 10 + ["VAO"] * 10, facade="n",
        classes={"JANELA": "window", "VAO": "Window"},
    )  # fmt: skip
    assert len(counted(thing).count) == 1
    assert verdicts(thing, feature_class="WINDOW") == (PASS, PASS)
    assert verdicts(thing, feature_class="WINDOW", required=30) == (PASS, FAIL)


def test_one_facade_in_two_drawings_is_counted_once_or_twice() -> None:
    thing = drawing([frame(*place) for place in PLACES])
    detail = drawing([frame(x + 500, y) for x, y in PLACES[:5]])
    assert interval(thing, detail) == interval(detail, thing) == (20, 25, 25)
    assert verdicts(thing, detail) == (UNDECIDED, PASS)
    assert verdicts(thing, detail, required=15) == (FAIL, PASS)
    assert verdicts(thing, detail, required=40) == (PASS, FAIL)


def test_facades_apart_are_never_added() -> None:
    north, south = (drawing([frame(*place) for place in PLACES], facade=facade) for facade in "NS")
    assert counted(north, south).count.tolist() == [20, 20]
    assert counted(north, south).most.tolist() == [20, 20]


def test_windows_on_a_hidden_layer_may_be_the_missing_ones() -> None:
    shapes, layers = [frame(*place) for place in PLACES], ["JANELA"] * 10 + ["JANELA_OFF"] * 10
    thing = drawing(shapes, layer=layers, visible=[True] * 10 + [False] * 10)
    assert interval(thing) == (10, 10, 10)
    assert counted(thing).hidden == (("window", "N", "JANELA_OFF"),)
    assert verdicts(thing) == (PASS, UNDECIDED)
    delivery = drawn(thing, features=listed(("window", "N", 20)))
    (omission,) = judge(spec("omission"), delivery=delivery, counts=counted(thing)).elements
    assert messages(omission) == ["omission.hidden-layers"]
    assert dict(omission.why[0].fields)["layers"] == ["JANELA_OFF"]


def test_a_hidden_layer_of_another_class_excuses_nothing() -> None:
    shapes, layers = [frame(*place) for place in PLACES], ["JANELA"] * 10 + ["PORTA"] * 10
    thing = drawing(
        shapes, layer=layers, visible=[True] * 10 + [False] * 10, classes={"JANELA": "window", "PORTA": "door"}
    )
    assert verdicts(thing) == (PASS, FAIL)


def test_parts_of_a_block_that_are_switched_off_hide_no_feature() -> None:
    shapes = [frame(*place, inset) for place in PLACES[:10] for inset in (0.0, 0.06)]
    blocks = [str(Holder(str(n // 2), "JANELA", "J")) for n in range(20)]
    thing = drawing(shapes, holders=blocks, visible=[True, False] * 10)
    assert counted(thing).hidden == ()
    assert verdicts(thing) == (PASS, FAIL)


# --- blocks ----------------------------------------------------------------------------------------------------------


def test_an_array_of_blocks_is_as_many_windows_as_it_has_cells(tmp_path: Path) -> None:
    document = ezdxf.new()
    pane(document.blocks.new("J"))
    array = {"layer": "JANELA", "row_count": 2, "column_count": 10, "row_spacing": 4, "column_spacing": 3}
    document.modelspace().add_blockref("J", (0, 0), dxfattribs=array)
    thing = read(document, tmp_path)
    assert interval(thing) == (20, 20, 20)
    assert verdicts(thing) == (PASS, PASS)
    assert verdicts(thing, required=40) == (PASS, FAIL)
    assert verdicts(thing, required=15) == (FAIL, PASS)


@pytest.mark.parametrize("outer", ["0", "FACHADA"])
def test_a_facade_that_is_one_block_holds_its_windows(tmp_path: Path, outer: str) -> None:
    document = ezdxf.new()
    pane(document.blocks.new("J"))
    facade = document.blocks.new("FACHADA")
    for place in PLACES:
        facade.add_blockref("J", place, dxfattribs={"layer": "JANELA"})
    document.modelspace().add_blockref("FACHADA", (0, 0), dxfattribs={"layer": outer})
    thing = read(document, tmp_path)
    assert interval(thing) == (20, 20, 20)
    assert verdicts(thing, required=40) == (PASS, FAIL)


@pytest.mark.parametrize(("outer", "inner"), [("0", "JANELA"), ("JANELA", "0"), ("JANELA", "JANELA")])
def test_a_facade_of_loose_windows_in_one_block_is_not_rejected(tmp_path: Path, outer: str, inner: str) -> None:
    document = ezdxf.new()
    facade = document.blocks.new("FACHADA")
    for place in PLACES:
        pane(facade, *place, layer=inner)
        pane(facade, *place, inset=0.06, layer=inner)
    document.modelspace().add_blockref("FACHADA", (0, 0), dxfattribs={"layer": outer})
    thing = read(document, tmp_path)
    assert interval(thing) == (1, 1, 20)
    assert verdicts(thing) == (PASS, UNDECIDED)
    assert verdicts(thing, required=40) == (PASS, FAIL)


@pytest.mark.parametrize("layers", [("CAIXILHO", "VIDRO"), ("JANELA", "VIDRO"), ("0", "JANELA-VIDRO")])
def test_content_takes_the_class_of_the_insert_that_holds_it(tmp_path: Path, layers: tuple[str, str]) -> None:
    document = ezdxf.new()
    block = document.blocks.new("J")
    pane(block, layer=layers[0])
    pane(block, x=5.0, layer=layers[1])
    for x, y in PLACES:
        document.modelspace().add_blockref("J", (x * 10, y), dxfattribs={"layer": "JANELA"})
    thing = read(document, tmp_path)
    assert interval(thing) == (20, 40, 40), "both panes are of the class, whatever layers they lie on"
    assert counted(thing).unmapped == ()
    assert verdicts(thing, required=50) == (PASS, FAIL)


def test_content_on_a_layer_of_another_class_keeps_it() -> None:
    held = [str(Holder("A", "PORTA", "P"))] * 2
    thing = drawing(
        [frame(0, 0), frame(0, 5)], layer=["FOLHA", "BANDEIRA"], holders=held,
        classes={"PORTA": "door", "BANDEIRA": "window"},
    )  # fmt: skip
    counts = counted(thing)
    assert dict(zip(counts.feature_class, counts.count, strict=True)) == {"door": 1, "window": 1}


def test_the_outermost_insert_with_a_class_wins() -> None:
    held = str(Holder("A", "0", "F")) + str(Holder("B", "JANELA", "J")) + str(Holder("C", "PORTA", "P"))
    thing = drawing([frame(0, 0)], layer="CAIXILHO", holders=[held], classes={"PORTA": "door", "JANELA": "window"})
    counts = counted(thing)
    assert dict(zip(counts.feature_class, counts.count, strict=True)) == {"door": 0, "window": 1}


def test_a_block_that_holds_blocks_of_its_class_is_one_or_as_many() -> None:
    outer = str(Holder("A", "JANELA", "CONJUNTO"))
    held = [outer + str(Holder(str(n), "JANELA", "J")) for n in range(20)]
    thing = drawing([frame(*place) for place in PLACES], holders=held)
    assert interval(thing) == (1, 20, 20)
    assert verdicts(thing) == (PASS, UNDECIDED)
    assert verdicts(thing, required=40) == (PASS, FAIL)


def test_half_of_the_blocks_missing_fails_and_five_more_fail() -> None:
    for n, expected in ((10, (PASS, FAIL)), (20, (PASS, PASS)), (25, (FAIL, PASS))):
        places = [(x, y + 50 * again) for again in range(2) for x, y in PLACES][:n]
        shapes = [frame(*place, inset) for place in places for inset in (0.0, 0.06)]
        held = [str(Holder(str(row // 2), "JANELA", "J")) for row in range(2 * n)]
        assert verdicts(drawing(shapes, holders=held)) == expected


def test_windows_on_a_frozen_insert_layer_may_be_the_missing_ones(tmp_path: Path) -> None:
    document = ezdxf.new()
    pane(document.blocks.new("J"))
    document.layers.add("JANELA").freeze()
    for place in PLACES:
        document.modelspace().add_blockref("J", place, dxfattribs={"layer": "JANELA"})
    thing = read(document, tmp_path)
    assert interval(thing) == (0, 0, 0)
    assert verdicts(thing) == (PASS, UNDECIDED)


def test_a_reader_tells_cell_layer_and_block_of_every_insert(tmp_path: Path) -> None:
    document = ezdxf.new()
    pane(document.blocks.new("J"))
    outer = document.blocks.new("F")
    inner = outer.add_blockref("J", (0, 0), dxfattribs={"column_count": 2, "column_spacing": 3})
    insert = document.modelspace().add_blockref("F", (0, 0), dxfattribs={"layer": "JANELA"})
    items = read(document, tmp_path).items
    told = {holders_of(text) for text in items.holders}
    assert told == {
        (Holder(insert.dxf.handle, "JANELA", "F"), Holder(f"{inner.dxf.handle}:{cell}", "JANELA", "J"))
        for cell in (1, 2)
    }
    assert set(items.inserts) == {f"{insert.dxf.handle}/{inner.dxf.handle}"}


def test_a_misspelt_pattern_is_no_evidence_of_omission() -> None:
    windows = drawing([frame(x, y) for x, y in PLACES], classes={"JANELAS": "window"})
    delivery = drawn(windows, features=listed(("window", "N", 20)))
    (omission,) = judge(spec("omission"), delivery=delivery, counts=counted(windows)).elements
    assert omission.status is UNDECIDED
    assert "features.unbound" in messages(omission)


def test_a_layer_that_exists_and_is_empty_is_evidence_of_omission() -> None:
    walls = drawing(["LINESTRING (0 0, 9 0)"], layer="PAREDE")
    walls = replace(walls, reading=Reading(layers=("PAREDE", "JANELA")))
    assert verdicts(walls)[1] is FAIL


@pytest.mark.parametrize("metres", [1.0, 0.001, 0.3048, 100.0])
def test_counts_are_the_same_in_any_unit(metres: float) -> None:
    # Two panes 9 mm apart are one window, two 11 mm apart are two; what is 9 mm long is none.
    pieces = [(0, 1), (1.009, 2), (2.011, 3), (9, 9.009)]
    shapes = [f"LINESTRING ({a / metres} 0, {b / metres} 0)" for a, b in pieces]
    unit = DrawingUnit(metres=metres, name="", origin=UnitOrigin.STATED)
    counts = count_features([replace(drawing(shapes), unit=unit)], gap=GAP)
    assert counts is not None
    assert counts.count.tolist() == [2]


def test_what_is_exactly_as_large_as_the_gap_is_no_feature() -> None:
    # A quarter of a metre, which binary numbers hold exactly.
    loose = drawing(["LINESTRING (0 0, 0.25 0)", "LINESTRING (5 0, 5.5 0)"])
    counts = count_features([loose], gap=0.25)
    assert counts is not None
    assert (counts.count.tolist(), counts.most.tolist(), counts.pieces.tolist()) == ([1], [1], [1])
