# SPDX-License-Identifier: MIT
"""Layers that look like a coverage and are not declared as one."""

from dataclasses import fields, replace

import numpy as np
import pytest
import shapely
import shapely.affinity
from tests.evaluate.deliveries import drawn, one, spec

from foparq.check.run import check_part
from foparq.evaluate.quality import ElementStatus
from foparq.model.drawing import Drawing, DrawingUnit, Reading, UnitOrigin
from foparq.model.inputs import lines_of
from foparq.model.items import Items, Role
from foparq.model.plane import plane_of
from foparq.profile.load import load_profile

PROFILE = load_profile("et-doc-foparq-a")
GAP = spec("found-rate", id="Q3-gap", required=False, rules=("gap",))
OVERLAP = spec("found-rate", id="Q3-overlap", required=False, rules=("line-overlap", "area-overlap"))


def drawing(boxes: list[tuple[float, float, float, float]], *, turn: float = 0.0, **said: object) -> Drawing:
    """Closed lines on the layer PISO[1]."""
    n = len(boxes)
    geometry = np.empty(n, dtype=object)
    geometry[:] = [shapely.affinity.rotate(shapely.box(*box).exterior, turn, origin=(0, 0)) for box in boxes]
    geometry = shapely.linestrings(
        *shapely.get_coordinates(geometry, return_index=True)[:1], indices=np.repeat(np.arange(n), 5)
    )

    def same(value: object) -> np.ndarray:
        return np.full(n, value, dtype=object)

    names = np.array([f"{row:X}" for row in range(n)], dtype=object)
    items = Items(
        geometry=geometry, layer=same("PISO[1]"), kind=same("LWPOLYLINE"), role=same(Role.LINE.value), item=names,
        handle=names.copy(), inserts=same(""), colour=np.zeros(n, dtype=np.int32), closed=np.ones(n, dtype=bool),
        visible=np.ones(n, dtype=bool), paper=np.zeros(n, dtype=bool),
    )  # fmt: skip
    unit = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)
    return Drawing(path="a.dxf", items=items, reading=Reading(), unit=unit, plane=plane_of("xy", geometry), **said)  # type: ignore[arg-type]


def undeclared(part: Drawing) -> set[str]:
    outcomes = check_part(part, PROFILE, 50.0).outcomes
    return {pattern for outcome in outcomes for pattern in outcome.undeclared}


GRID = [(x, y, x + 1, y + 1) for x in range(4) for y in range(3)]
BOND = [(x + 0.5 * (y % 2), y, x + 1 + 0.5 * (y % 2), y + 1) for x in range(4) for y in range(3)]
STRIP = [(x, 0, x + 1, 2) for x in range(5)]
APART = [(1.5 * x, 1.5 * y, 1.5 * x + 1, 1.5 * y + 1) for x in range(4) for y in range(3)]
#: windows: a frame, and a pane in it that shares its sill
WINDOWS = [box for x in range(0, 9, 3) for box in ((x, 0, x + 2, 2), (x + 0.2, 0, x + 1.8, 1.8))]
CORNERS = [(n, n, n + 1, n + 1) for n in range(6)]


@pytest.mark.parametrize("turn", [0.0, 31.0])
@pytest.mark.parametrize("boxes", [GRID, BOND, STRIP], ids=["grid", "running bond", "strip"])
def test_a_coverage_is_known_by_its_shared_borders(boxes: list, turn: float) -> None:
    assert undeclared(drawing(boxes, turn=turn)) == {"PISO[[]1]"}


@pytest.mark.parametrize(
    "boxes", [APART, WINDOWS, CORNERS, GRID[:2], []], ids=["apart", "frames", "corners", "two", "none"]
)
def test_what_shares_no_borders_is_none(boxes: list) -> None:
    assert undeclared(drawing(boxes)) == set()


def test_a_declared_coverage_needs_no_word() -> None:
    assert undeclared(drawing(GRID, areas=("PISO[[]1]",))) == set()


def test_gap_and_overlap_are_not_assessed_and_the_line_is_proposed() -> None:
    part = drawing(GRID)
    outcomes = check_part(part, PROFILE, 50.0).outcomes
    for element in (
        one(GAP, delivery=drawn(part), outcomes=outcomes),
        one(OVERLAP, delivery=drawn(part), outcomes=outcomes),
    ):
        assert element.status is ElementStatus.NOT_ASSESSED
        assert element.why[0].message == "checks.undeclared"
        assert dict(element.why[0].fields)["line"] == 'areas = ["PISO[[]1]"]'


def test_the_proposed_line_settles_it() -> None:
    part = drawing(GRID, areas=("PISO[[]1]",))
    outcomes = check_part(part, PROFILE, 50.0).outcomes
    gap = one(GAP, delivery=drawn(part), outcomes=outcomes)
    assert (gap.value, gap.n) == (0.0, len(GRID))


@pytest.mark.parametrize("points", [2, 3, 9])
def test_lines_of_no_extent_say_nothing_and_harm_nothing(points: int) -> None:
    grid = drawing(GRID)
    dot = np.empty(1, dtype=object)
    dot[0] = shapely.LineString([(9.0, 9.0)] * points)
    items = Items(**{
        name: np.concatenate([getattr(grid.items, name), dot if name == "geometry" else getattr(grid.items, name)[:1]])
        for name in (field.name for field in fields(Items))
    })  # fmt: skip
    checked = check_part(replace(grid, items=items), PROFILE, 50.0)
    assert not checked.log
    assert {pattern for outcome in checked.outcomes for pattern in outcome.undeclared} == {"PISO[[]1]"}


def test_what_else_is_drawn_changes_nothing_of_closed_lines() -> None:
    stones = [shapely.box(x, y, x + 1, y + 1).exterior for x in range(4) for y in range(3)]
    # A thousand and more strokes in one place share all of each other, and nothing with the stones.
    strokes = [shapely.LineString([(0.2, 0.2), (0.8, 0.8)])] * 1200
    alone, together = lines_of(stones), lines_of([*strokes, *stones])
    assert alone.adjoining(1e-4).all()
    assert together.adjoining(1e-4).tolist() == [False] * len(strokes) + [True] * len(stones)
