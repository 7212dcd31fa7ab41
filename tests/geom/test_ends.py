# SPDX-License-Identifier: MIT
"""Ends of lines against a slow independent reading of the definitions, and against drawings that hurt."""

import itertools
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tests.geom.aims import AIM
from tests.geom.oracle import Aim as Told
from tests.geom.oracle import classify_all

from foparq.geom.ends import NOBODY, EndKind, Ends, classify_ends
from foparq.geom.leaving import leaving
from foparq.geom.polylines import Polylines

# No two places of a millimetre grid are exactly this far apart.
COINCIDE, REACH = 0.0004, 0.0103


def polylines(lines: list[NDArray[np.float64]]) -> Polylines:
    return Polylines.of(
        shapely.linestrings(np.concatenate(lines), indices=np.repeat(np.arange(len(lines)), [len(x) for x in lines]))
    )


def assert_same(ends: Ends, lines: list[NDArray[np.float64]]) -> None:
    expected = classify_all(lines, coincide=COINCIDE, reach=REACH, aim=Told(*AIM))
    assert len(ends.line) == len(expected)
    for n, want in enumerate(expected):
        assert (ends.line[n], not ends.forward[n]) == (want.line, want.last)
        assert EndKind(ends.kind[n]).name.lower() == want.kind, want
        assert ends.size[n] == pytest.approx(want.size, abs=1e-7), want
        assert ends.other[n] in (want.others or {NOBODY})


def walks(dimensions: int) -> st.SearchStrategy[list[NDArray[np.float64]]]:
    place = st.tuples(st.integers(0, 40), st.integers(0, 40), *[st.integers(0, 2)] * (dimensions - 2))
    walk = st.lists(place, min_size=2, max_size=7).filter(lambda way: all(a[:2] != b[:2] for a, b in pairwise(way)))
    return st.lists(walk.map(lambda way: np.array(way, dtype=float) / 1000), min_size=1, max_size=9)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(walks(2))
def test_ends_in_the_plane_are_what_the_definitions_say(lines: list[NDArray[np.float64]]) -> None:
    assert_same(classify_ends(polylines(lines), AIM, coincide=COINCIDE, reach=REACH), lines)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(walks(3))
def test_ends_with_depth_are_what_the_definitions_say(lines: list[NDArray[np.float64]]) -> None:
    assert_same(classify_ends(polylines(lines), AIM, coincide=COINCIDE, reach=REACH), lines)


@pytest.mark.parametrize("seed", range(4))
def test_larger_drawing_is_what_the_definitions_say(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = rng.uniform(0, 0.3, (60, 1, 2))
    lines = list(np.concatenate([start, start + np.cumsum(rng.normal(0, 0.02, (60, 9, 2)), axis=1)], axis=1))
    assert_same(classify_ends(polylines(lines), AIM, coincide=COINCIDE, reach=REACH), lines)


@pytest.mark.parametrize(
    "lines", [[], ["LINESTRING (1 1, 1 1)"], ["LINESTRING (0 0, 1 0, 1 1, 0 0)"]], ids=["none", "a point", "a ring"]
)
def test_without_ends_there_is_nothing_to_say(lines: list[str]) -> None:
    ends = classify_ends(
        Polylines.of(np.array([shapely.from_wkt(x) for x in lines], dtype=object)), AIM, coincide=1e-4, reach=1e-2
    )
    assert not len(ends.line)


def test_line_straight_into_the_depth_has_two_ends() -> None:
    table = Polylines.of(
        np.array([shapely.from_wkt("LINESTRING Z (0 0 0, 0 0 1)"), shapely.from_wkt("LINESTRING Z (-1 0 1, 1 0 1)")])
    )
    kinds = classify_ends(table, AIM, coincide=1e-4, reach=1e-2).kind[:2]
    assert kinds.tolist() == [EndKind.FREE, EndKind.CONNECTED]


def test_end_beyond_a_line_straight_into_the_depth_is_an_overshoot() -> None:
    # Seen from above a post in a rail, which goes on for 5 mm beyond it.
    post, rail = "LINESTRING Z (0 0 0, 0 0 1)", "LINESTRING Z (-1 0 0, 0.005 0 0)"
    table = Polylines.of(np.array([shapely.from_wkt(post), shapely.from_wkt(rail)]))
    ends = classify_ends(table, AIM, coincide=1e-4, reach=1e-2)
    beyond = np.flatnonzero((ends.line == 1) & ~ends.forward)
    assert ends.kind[beyond].tolist() == [EndKind.OVERSHOOT]
    assert ends.size[beyond] == pytest.approx([0.005])
    assert ends.other[beyond].tolist() == [0]


Way = list[tuple[float, float]]


def beside(side: float, length: float) -> Way:
    """A line that runs past the origin, left or right of it."""
    return [(side * 2**-8, -length / 2), (side * 2**-8, length / 2)]


def across(side: float, length: float) -> Way:
    """A line through the origin that rises to the right, most of it left or right of it."""
    return [(-length * (0.5 - side / 4), -length * (0.5 - side / 4)), (length * (0.5 + side / 4),) * 2]


@pytest.mark.parametrize(("kind", "made", "end"), [(EndKind.BESIDE, beside, 0.0), (EndKind.OVERSHOOT, across, 2**-8)])
@pytest.mark.parametrize(("left", "right"), [(0.5, 0.25), (0.25, 0.5), (0.5, 0.5)])
def test_of_lines_as_near_the_longest_is_named_of_equals_the_first_by_place(
    left: float, right: float, kind: EndKind, made: Callable[[float, float], Way], end: float
) -> None:
    asked, named = [(0.0, -1.0), (0.0, end)], made(-1, left) if left >= right else made(1, right)
    for lines in itertools.permutations([asked, made(-1, left), made(1, right)]):
        ends = classify_ends(polylines([np.array(way) for way in lines]), AIM, coincide=1e-4, reach=1e-2)
        tip = np.flatnonzero((ends.line == lines.index(asked)) & ~ends.forward)
        assert ends.kind[tip].tolist() == [kind]
        assert ends.size[tip] == pytest.approx([2**-8])
        assert lines[ends.other[tip[0]]] == named


@pytest.mark.parametrize(("gap", "kind"), [(0.25, EndKind.UNDERSHOOT), (0.25 + 1e-6, EndKind.FREE)])
def test_a_line_exactly_at_reach_is_within(gap: float, kind: EndKind) -> None:
    for turned in (0, 1):
        lines = [np.array([(-3.0, 0.0), (-gap, 0.0)]), np.array([(0.0, -2.0), (0.0, 2.0)])]
        ends = classify_ends(polylines([np.roll(way, turned, axis=1) for way in lines]), AIM, coincide=1e-4, reach=0.25)
        assert ends.kind[:2].tolist() == [EndKind.FREE, kind]


def test_crowd_of_identical_lines_is_connected() -> None:
    ends = classify_ends(
        Polylines.of(np.full(100_000, shapely.LineString([(0, 0), (1, 1)]))), AIM, coincide=1e-4, reach=1e-2
    )
    assert np.all(ends.kind == EndKind.CONNECTED)


def test_star_of_lines_is_connected_in_the_middle_and_free_outside() -> None:
    angle = np.arange(20_000) * (2 * np.pi / 20_000)
    rays = np.stack([np.zeros((20_000, 2)), 1000 * np.column_stack([np.cos(angle), np.sin(angle)])], axis=1)
    ends = classify_ends(Polylines.of(shapely.linestrings(rays)), AIM, coincide=1e-4, reach=1e-2)
    assert np.all(ends.kind[ends.forward] == EndKind.CONNECTED)
    assert np.all(ends.kind[~ends.forward] == EndKind.FREE)


def test_askew_hatch_of_parallel_lines_misses_nothing() -> None:
    y = np.arange(20_000) * 0.001
    hatch = np.stack([np.column_stack([0 * y, y]), np.column_stack([0 * y + 1, y])], axis=1)
    turn = np.array([[np.cos(0.5), np.sin(0.5)], [-np.sin(0.5), np.cos(0.5)]])
    ends = classify_ends(Polylines.of(shapely.linestrings(hatch @ turn)), AIM, coincide=1e-4, reach=1e-2)
    assert np.all(ends.kind == EndKind.BESIDE)
    assert ends.size == pytest.approx(np.full(40_000, 0.001))


def test_leaving_is_the_first_vertex_outside() -> None:
    table = Polylines.of(np.array([shapely.from_wkt("LINESTRING (0 0, 1 0, 2 0, 1 0, 3 0)")]))
    ahead = leaving(table, np.array([0, 0, 4]), np.array([True, True, False]), radius=1.5)
    assert ahead.tolist() == [2, 2, 3]
    assert leaving(table, np.array([0, 4]), np.array([True, False]), radius=9).tolist() == [5, -1]


@pytest.mark.parametrize("seed", range(8))
def test_leaving_is_what_a_walk_finds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ways = [np.cumsum(rng.normal(0, rng.choice([0.02, 0.2]), (n, 2)), axis=0) for n in rng.integers(2, 90, 40)]
    table = polylines(ways)
    line = rng.integers(0, len(ways), 500)
    place = np.array([rng.integers(len(ways[n])) for n in line])
    forward = rng.random(500) < 0.5
    expected = []
    for n, k, ahead in zip(line, place, forward, strict=True):
        rest = range(k + 1, len(ways[n])) if ahead else range(k - 1, -1, -1)
        left = [m for m in rest if np.hypot(*(ways[n][m] - ways[n][k])) > 0.5]
        expected.append(table.offsets[n] + left[0] if left else len(table.coordinates) if ahead else -1)
    assert leaving(table, table.offsets[line] + place, forward, radius=0.5).tolist() == expected
