# SPDX-License-Identifier: MIT
"""Where a line meets itself: at the crossing, else where its segments come nearest, of equals the first by place."""

from typing import Any

import numpy as np
import pytest
import shapely

from foparq.geom.crossings import SelfMeetings, self_meetings
from foparq.geom.polylines import Polylines

COINCIDE = 0.0004


def meetings(way: list[tuple[float, float]]) -> tuple[SelfMeetings, Any]:
    """Meetings of one line with itself, and their places."""
    table = Polylines.of(np.array([shapely.LineString(way)]))
    found = self_meetings(table, coincide=COINCIDE)
    return found, (found.start + found.end) / 2 + table.origin


def seen(way: list[tuple[float, float]], *, upright: bool) -> list[tuple[float, float]]:
    return [(y, x) for x, y in way] if upright else way


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize(
    ("tail", "place", "loop"),
    [
        # The last piece comes to a metre's base nearest at its start, at its end, or is as near at both.
        ([(0.2, 0.0001), (0.1998, 0.0003)], (0.2, 0.00005), 4.0 - 0.0001),
        ([(0.2, 0.0003), (0.1998, 0.0001)], (0.1998, 0.00005), 4.0 - 0.0003 + 0.0002 + np.hypot(0.0002, 0.0002)),
        ([(0.2, 0.0003), (0.2001, 0.0001)], (0.2001, 0.00005), 4.0 - 0.0003 - 0.0001 + np.hypot(0.0001, 0.0002)),
        ([(0.2, 0.0002), (0.1998, 0.0002)], (0.1998, 0.0001), 4.0 - 0.0002 + 0.0004),
        # It crosses the base nearer to one end than to the other.
        ([(0.2, 0.0001), (0.2, -0.0003)], (0.2, 0.0), 4.0),
    ],
)  # fmt: skip
def test_a_tail_near_the_base_meets_it_at_the_nearest_place(
    tail: list[tuple[float, float]], place: tuple[float, float], loop: float, *, upright: bool
) -> None:
    # From 0.2 along the base 0.8, up 1.2, back 0.8 and down 1.2 make 4 m.
    way = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.2), (0.2, 1.2), *tail]
    found, places = meetings(seen(way, upright=upright))
    assert places == pytest.approx(np.array(seen([place], upright=upright)), abs=1e-9)
    assert found.loop == pytest.approx([loop], abs=1e-9)


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("x", [1.0, 2.0, 3.5])
def test_in_a_ring_the_shorter_way_round_is_the_loop(x: float, *, backwards: bool) -> None:
    # Two triangles on upright sides of 2 m touch at (x, 1).
    way = [(0.0, 0.0), (0.0, 2.0), (x, 1.0), (4.0, 0.0), (4.0, 2.0), (x, 1.0), (0.0, 0.0)]
    found, places = meetings(way[::-1] if backwards else way)
    assert places == pytest.approx(np.array([[x, 1.0]]))
    assert found.loop == pytest.approx([2 + 2 * np.hypot(min(x, 4 - x), 1)])


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize(("apart", "count"), [(1.5, 1), (1.9, 1), (2.1, 2), (2.9, 2)])
def test_crossings_nearer_than_twice_the_tolerance_are_one_place(apart: float, count: int, *, upright: bool) -> None:
    x = 0.2 + apart * COINCIDE
    tail = [(0.2, 1.2), (0.2, -0.1), (x, -0.1), (x, 0.1)]
    found, places = meetings(seen([(0.0, 0.0), (1.0, 0.0), (1.0, 1.2), *tail], upright=upright))
    # The way to the second crossing leads down and up 0.1 m, and over to a place farther along the base.
    known = [((x, 0.0), 4.2), ((0.2, 0.0), 4.0)][:count]
    order = np.argsort(-found.loop)
    assert places[order] == pytest.approx(np.array(seen([place for place, _ in known], upright=upright)), abs=1e-9)
    assert found.loop[order] == pytest.approx([loop for _, loop in known])


def drawings(ring: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """A ring from every vertex, both ways round."""
    rolled = [ring[n:] + ring[:n] for n in range(len(ring))]
    return [[*way, way[0]][::step] for way in rolled for step in (1, -1)]


@pytest.mark.parametrize("upright", [False, True])
def test_of_crossings_with_equal_loops_the_first_by_place_is_named(*, upright: bool) -> None:
    # Two equal lobes beside a lens 0.6 mm wide: its ends are one place.
    ring = [(-3.0, 30.0), (0.0, -0.003), (3.0, 30.0), (3.0, -30.0), (0.0, 0.003), (-3.0, -30.0)]
    left = -3.0 * 0.003 / 30.003
    for way in drawings(seen(ring, upright=upright)):
        found, places = meetings(way)
        assert places == pytest.approx(np.array(seen([(left, 0.0)], upright=upright)), abs=1e-9)
        assert found.loop == pytest.approx([60 + 2 * np.hypot(3 + left, 30)])


@pytest.mark.parametrize("upright", [False, True])
def test_of_retraced_pieces_as_long_the_one_with_its_middle_first_by_place_is_named(*, upright: bool) -> None:
    corner = [(0.0, 1.0), (0.0, 0.0), (1.0, 0.0), (0.0, 0.0)]
    for way in drawings(seen(corner, upright=upright)):
        found, places = meetings(way)
        assert places == pytest.approx(np.array([[0.0, 0.5]]))
        assert found.loop == pytest.approx([2.0])  # from the corner along one side and back
