# SPDX-License-Identifier: MIT
"""What is a copy of a feature, what may be a part of one, and what cannot hide that one is missing."""

from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given
from hypothesis import strategies as st
from tests.check.windows import FAIL, PASS, PLACES, UNDECIDED, drawing, frame, interval, pane, read, verdicts

from foparq.model.drawing import Drawing
from foparq.model.items import Holder, Role

# --- copies ----------------------------------------------------------------------------------------------------------


def blocks(n: int, layer: str = "JANELA") -> list[str]:
    return [str(Holder(str(row), layer, "J")) for row in range(n)]


def test_twins_at_one_place_count_once() -> None:
    assert interval(drawing([frame(0, 0)] * 2, holders=blocks(2))) == (1, 1, 1)


@pytest.mark.parametrize("aside", [0.0, 0.0004, 0.002, 0.009, 0.02])
@pytest.mark.parametrize("held", [(True, True), (True, False), (False, True), (False, False)])
def test_copies_aside_hide_no_missing_window(aside: float, held: tuple[bool, bool]) -> None:
    places = [*PLACES[:15], *((x + aside, y + aside) for x, y in PLACES[:5])]
    names = [*blocks(15), *(str(Holder(f"copy{n}", "JANELA", "J")) for n in range(5))]
    holders = [name if held[n >= 15] else "" for n, name in enumerate(names)]
    thing = drawing([frame(*place) for place in places], holders=holders)
    assert interval(thing) == (15, 15, 15)
    assert verdicts(thing) == (PASS, FAIL)


@pytest.mark.parametrize("aside", [0.06, 0.3, 0.8])
def test_windows_that_overlap_are_one_or_two(aside: float) -> None:
    places = [*PLACES[:15], *((x + aside, y) for x, y in PLACES[:5])]
    thing = drawing([frame(*place) for place in places], holders=blocks(20))
    assert interval(thing) == (15, 20, 20)
    assert verdicts(thing) == (PASS, UNDECIDED)


@pytest.mark.parametrize("apart", [0.031, 0.2])
def test_windows_side_by_side_are_two(apart: float) -> None:
    places = [*PLACES, *((x + 1 + apart, y) for x, y in PLACES[:5])]
    for holders in (blocks(25), [""] * 25):
        thing = drawing([frame(*place) for place in places], holders=holders)
        assert interval(thing) == (25, 25, 25)


def test_a_turned_or_mirrored_copy_is_a_copy() -> None:
    pent = shapely.from_wkt("POLYGON ((0 0, 1 0, 1 1, 0.5 1.4, 0 1, 0 0))").exterior
    mirrored = shapely.affinity.scale(pent, -1, 1)
    assert interval(drawing([pent.wkt, mirrored.wkt], holders=blocks(2))) == (1, 1, 1)


def test_a_copy_of_a_block_that_is_placed_once_opens_and_closes_nothing() -> None:
    shapes = [frame(*place) for place in PLACES]
    once = [str(Holder("A", "FACHADA", "F"))] * 20
    thing = drawing(shapes, layer="JANELA", holders=once)
    twice = drawing(shapes * 2, layer="JANELA", holders=once + [str(Holder("B", "FACHADA", "F"))] * 20)
    assert interval(thing) == interval(twice) == (1, 1, 20)


FACADE = st.lists(
    st.tuples(st.sampled_from(PLACES), st.sampled_from([0.4, 0.7, 1.0]), st.booleans()), min_size=2, max_size=12,
    unique_by=lambda row: row[0],
)  # fmt: skip


def facade_of(rows: list[tuple[tuple[float, float], float, bool]]) -> Drawing:
    shapes = [shapely.affinity.scale(shapely.from_wkt(frame(*at)), size, size).wkt for at, size, _ in rows]
    holders = [str(Holder(f"{n}", "JANELA", f"J{at}{size}")) if held else "" for n, (at, size, held) in enumerate(rows)]
    return drawing(shapes, holders=holders)


@given(FACADE, st.data())
def test_a_copy_never_adds_and_order_never_matters(rows: list, data: st.DataObject) -> None:
    plain = interval(facade_of(rows))
    copies = data.draw(st.lists(st.sampled_from(rows), max_size=4))
    assert interval(facade_of([*rows, *copies])) == plain
    assert interval(facade_of(data.draw(st.permutations([*rows, *copies])))) == plain


@given(FACADE, st.data())
def test_a_window_less_is_never_one_window_more(rows: list, data: st.DataObject) -> None:
    before = interval(facade_of(rows))
    lost = data.draw(st.sampled_from(rows))
    after = interval(facade_of([row for row in rows if row is not lost]))
    assert all(less <= more for less, more in zip(after, before, strict=True))


# --- what may be a part of what --------------------------------------------------------------------------------------


def sill(x: float, y: float) -> str:
    return shapely.box(x - 0.05, y - 0.1, x + 1.05, y - 0.03).exterior.wkt


def test_loose_sills_hide_no_missing_window() -> None:
    shapes = [*(frame(*place) for place in PLACES[:10]), *(sill(*place) for place in PLACES[:10])]
    for holders in ([""] * 20, [*blocks(10), *[""] * 10]):
        thing = drawing(shapes, holders=holders)
        assert interval(thing) == (10, 20, 20)
        assert verdicts(thing) == (PASS, UNDECIDED)


def test_strokes_far_from_everything_hide_no_missing_window() -> None:
    strokes = [f"LINESTRING (50 {y}, 50.3 {y})" for y in range(5)]
    thing = drawing([*(frame(*place) for place in PLACES[:15]), *strokes])
    assert interval(thing) == (15, 20, 20)
    assert verdicts(thing) == (PASS, UNDECIDED)
    assert interval(drawing([*(frame(*place) for place in PLACES[:15]), *strokes], holders=blocks(20))) == (15, 20, 20)


def test_small_windows_between_large_ones_are_windows() -> None:
    small = [shapely.box(x + 1.4, y + 0.6, x + 1.9, y + 1.2).exterior.wkt for x, y in PLACES]
    thing = drawing([*(frame(*place) for place in PLACES), *small])
    assert interval(thing) == (40, 40, 40)


def test_a_block_of_two_windows_may_be_two(tmp_path: Path) -> None:
    document = ezdxf.new()
    pane(document.blocks.new("J"))
    pane(document.blocks["J"], x=1.4)
    for place in PLACES:
        document.modelspace().add_blockref("J", place, dxfattribs={"layer": "JANELA"})
    thing = read(document, tmp_path)
    assert interval(thing) == (20, 40, 40)
    assert verdicts(thing) == (UNDECIDED, PASS)
    assert verdicts(thing, required=40) == (PASS, UNDECIDED)


def test_a_block_of_a_window_its_sill_and_two_sashes_is_one(tmp_path: Path) -> None:
    document = ezdxf.new()
    block = document.blocks.new("J")
    for left in (0.0, 0.52):
        block.add_lwpolyline([(left, 0), (left + 0.48, 0), (left + 0.48, 1.5), (left, 1.5)], close=True)
    block.add_lwpolyline([(-0.05, -0.1), (1.05, -0.1), (1.05, -0.03), (-0.05, -0.03)], close=True)
    for place in PLACES:
        document.modelspace().add_blockref("J", place, dxfattribs={"layer": "JANELA"})
    thing = read(document, tmp_path)
    assert interval(thing) == (20, 20, 20)
    assert verdicts(thing, required=40) == (PASS, FAIL)


def test_windows_in_paper_space_may_be_the_missing_ones() -> None:
    thing = drawing([frame(*place) for place in PLACES], visible=[True] * 10 + [False] * 10)
    paper = replace(thing, items=replace(thing.items, paper=np.array([False] * 10 + [True] * 10)))
    assert interval(paper) == (10, 10, 10)
    assert verdicts(paper) == (PASS, UNDECIDED)


# --- areas, and drawings that were turned ----------------------------------------------------------------------------


def test_copies_of_areas_count_once() -> None:
    boxes = [shapely.box(x, y, x + 1, y + 1.5).wkt for x, y in PLACES[:15]]
    aside = [shapely.box(x + 0.002, y, x + 1.002, y + 1.5).wkt for x, y in PLACES[:5]]
    assert interval(drawing([*boxes, *boxes[:5], *aside], role=Role.AREA)) == (15, 15, 15)


@pytest.mark.parametrize("angle", [17.0, 45.0, 90.0, 211.0])
def test_a_turned_drawing_has_as_many_features(angle: float) -> None:
    shapes = [
        *(frame(*place) for place in PLACES[:10]), *(sill(*place) for place in PLACES[:4]),
        *(frame(x + 0.003, y) for x, y in PLACES[4:6]), *(frame(x + 0.4, y) for x, y in PLACES[6:8]),
        *(frame(*place, 0.2) for place in PLACES[8:10]), "LINESTRING (50 0, 50.2 0)",
    ]  # fmt: skip
    held = [*blocks(10), *[""] * 4, *(str(Holder(f"c{n}", "JANELA", "J")) for n in range(4)), *[""] * 3]
    plain = interval(drawing(shapes, holders=held))
    assert plain[0] == 10
    turned = [shapely.affinity.rotate(shapely.from_wkt(one), angle, origin=(3, 7)).wkt for one in shapes]
    assert interval(drawing(turned, holders=held)) == plain
