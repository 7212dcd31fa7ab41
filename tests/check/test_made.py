# SPDX-License-Identifier: MIT
"""Linework that shows nothing but the points on it, and such that shows more."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.check.test_alike import walls
from tests.check.test_ties import NEAR, checkpoints, ground, lies, texts

from foparq.check.drawn.ground import ground_of
from foparq.check.drawn.made import mostly, only_for_points
from foparq.check.tables.points import tie_points
from foparq.findings.ties import Lies
from foparq.model.drawing import Drawing, Labels, Reading
from foparq.model.items import Items, Role

Line = list[tuple[float, float]]
SPOTS = np.array([(3.0 * k, 1.7 * (k % 3)) for k in range(6)])


def sketch(lines: list[Line], layers: list[str] | None = None, **changes: object) -> Drawing:
    """Lines of a flat drawing in metres, one item each."""
    made = walls(np.tile([0.0, 0.0, 1.0, 1.0], (len(lines), 1)), "f.dxf", "N")
    shapes = np.empty(len(lines), dtype=object)
    shapes[:] = [shapely.LineString(line) if len(line) > 1 else shapely.Point(line[0]) for line in lines]
    columns = {name: getattr(made.items, name) for name in Items.__dataclass_fields__} | {"geometry": shapes}
    columns["role"] = texts(*[str(Role.LINE if len(line) > 1 else Role.POINT) for line in lines])
    columns["layer"] = texts(*(layers or ["PAREDE"] * len(lines)))
    return replace(made, items=Items(**columns), **changes)  # type: ignore[arg-type]


def only(made: Drawing, spots: np.ndarray = SPOTS) -> list[bool]:
    places = np.column_stack([spots, np.zeros(len(spots))])
    found: list[bool] = only_for_points(ground(made), places, np.full(len(spots), NEAR.tie), NEAR).tolist()
    return found


def strokes(length: float) -> list[Line]:
    return [[(x, y), (x + length, y)] for x, y in SPOTS.tolist()]


def squares(size: float) -> list[Line]:
    return [[(x, y), (x + size, y), (x + size, y + size), (x, y + size), (x, y)] for x, y in SPOTS.tolist()]


@pytest.mark.parametrize("length", [0.02, 0.15, 1.9])
def test_a_stroke_for_each_point_shows_nothing_else(length: float) -> None:
    assert only(sketch(strokes(length))) == [True] * 6
    assert only(sketch(strokes(length), classes={"PAR*": "wall"})) == [False] * 6
    assert only(sketch(strokes(length)), SPOTS + 0.5 * length * np.array([1.0, 0.0])) == [True] * 6
    assert only(sketch(strokes(length)), SPOTS + np.array([0.0, 0.3])) == [False] * 6


def test_a_stroke_that_other_linework_touches_shows_that() -> None:
    posts = [[(x + 1.5, y), (x + 1.5, y - 0.9)] for x, y in SPOTS.tolist()]
    assert only(sketch([*strokes(1.5), *posts])) == [False] * 6
    crossing = [[(x + 0.7, y + 0.4), (x + 0.7, y - 0.4)] for x, y in SPOTS.tolist()]
    assert only(sketch([*strokes(1.5), *crossing])) == [True] * 6
    at_the_point = [[(x, y), (x - 0.8, y - 0.9)] for x, y in SPOTS.tolist()]
    assert only(sketch([*strokes(1.5), *at_the_point])) == [True] * 6


def test_a_line_through_points_has_two_corners_for_each_at_most() -> None:
    path: Line = [tuple(spot) for spot in SPOTS.tolist()]  # type: ignore[misc]
    between = [tuple(spot) for spot in (SPOTS[:-1] * 0.7 + SPOTS[1:] * 0.3).tolist()]
    twelve = [spot for pair in zip(path, [*between, (20.0, 9.0)], strict=True) for spot in pair]
    assert only(sketch([path])) == [True] * 6
    assert only(sketch([twelve])) == [True] * 6  # type: ignore[list-item]
    assert only(sketch([[*twelve, (22.0, 9.0)]])) == [False] * 6  # type: ignore[list-item]


@pytest.mark.parametrize(("size", "mark"), [(0.35, 1), (0.36, 0)])
def test_a_mark_is_no_larger_than_ten_millimetres_on_the_sheet(size: float, mark: int) -> None:
    """At 1:50 that is 0.5 m from corner to corner: squares of 0.353 m."""
    assert only(sketch(squares(size))) == [bool(mark)] * 6


@pytest.mark.parametrize(("others", "mark"), [(6, 1), (7, 0)])
def test_half_of_the_small_things_of_a_layer_bear_a_point(others: int, mark: int) -> None:
    more = [[(x + 100, y) for x, y in line] for line in [*squares(0.2), *squares(0.25)][:others]]
    assert only(sketch([*squares(0.2), *more])) == [bool(mark)] * 6
    elsewhere = ["MARCAS"] * 6 + ["PAREDE"] * others
    assert only(sketch([*squares(0.2), *more], elsewhere)) == [True] * 6


def test_a_window_with_bars_is_no_mark() -> None:
    bars = [[(x + 0.1, y), (x + 0.1, y + 0.2)] for x, y in SPOTS.tolist()]
    rails = [[(x, y + 0.15), (x + 0.2, y + 0.15)] for x, y in SPOTS.tolist()]
    assert only(sketch([*squares(0.2), *bars, *rails])) == [False] * 6


def test_more_than_half_of_the_points_of_a_drawing() -> None:
    rows = np.array([True, True, False, True, False, False])
    of = texts("a", "a", "a", "b", "b", "")
    assert mostly(rows, ["a", "b"], of).tolist() == [True, True, False, False, False, False]


def test_points_count_only_with_their_names() -> None:
    spots = np.column_stack([SPOTS, np.zeros(6)])
    bare = sketch([*[[tuple(spot)] for spot in SPOTS.tolist()], [(0, 9), (9, 9)]])  # type: ignore[list-item]
    assert lies(checkpoints(spots), bare) == [Lies.ABSENT] * 6
    labels = Labels(text=texts(*[f"V{n}" for n in range(6)]), place=spots + 0.05, block=np.zeros(6, dtype=bool))
    assert lies(checkpoints(spots), replace(bare, reading=Reading(labels=labels))) == [Lies.NAMED] * 6


def test_what_cannot_be_seen_or_is_not_plotted_holds_nothing() -> None:
    spots = checkpoints(np.column_stack([SPOTS, np.zeros(6)]))
    for length, there in ((0.0, Lies.ABSENT), (0.0099, Lies.ABSENT), (0.0101, Lies.VERTEX)):
        assert lies(spots, sketch([*strokes(length), [(0, 9), (9, 9)]])) == [there] * 6
    # A curve of short strokes is seen.
    chains = [[(x + 0.004 * k, y), (x + 0.004 * k + 0.004, y)] for x, y in SPOTS.tolist() for k in range(5)]
    assert lies(spots, sketch(chains)) == [Lies.VERTEX] * 6
    layers = ["AUX"] * 6 + ["PAREDE"]
    hidden = sketch([*strokes(2.0), [(0, 9), (9, 9)]], layers, reading=Reading(unplotted=("AUX",)))
    assert lies(spots, hidden) == [Lies.ABSENT] * 6
    assert ground_of(sketch(strokes(2.0), reading=Reading(unplotted=("PAREDE",))), NEAR) is None


def test_points_on_real_linework_stay_tied() -> None:
    spots = np.column_stack([SPOTS, np.zeros(6)])
    ties = tie_points(checkpoints(spots), [ground(sketch([*squares(1.0), *strokes(0.15)]))], NEAR)
    assert not ties.made.any()
    assert tie_points(checkpoints(spots), [ground(sketch(strokes(0.15)))], NEAR).made.all()
