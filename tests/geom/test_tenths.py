# SPDX-License-Identifier: MIT
"""Drawings on a grid of a tenth of a millimetre, where places lie at, just within and just beyond the tolerances."""

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

from foparq.geom.clusters import clusters
from foparq.geom.crossings import self_meetings
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.ends import NOBODY, EndKind, classify_ends
from foparq.geom.overlaps import line_overlaps
from foparq.geom.polylines import Polylines

TENTH = 1e-4  #: metres
COINCIDE, REACH = 5 * TENTH, 100 * TENTH  #: 0.01 mm and 0.2 mm on the sheet, at 1:50
FAR = 7_400_000.0  #: a northing
TENTHS = range(1, 12)
Way = NDArray[np.float64]


def table(*lines: Way) -> Polylines:
    ways = [np.asarray(line, dtype=float) for line in lines]
    index = np.repeat(np.arange(len(ways)), [len(way) for way in ways])
    return Polylines.of(shapely.linestrings(np.concatenate(ways), indices=index))


def tenths(*places: tuple[float, ...], by: float = 0.0) -> Way:
    """Vertices given in tenths of a millimetre, moved by metres in the plane."""
    way = np.array(places, dtype=float) * TENTH
    way[:, :2] += by
    return way


# --- ends ------------------------------------------------------------------------------------------------------------


def walks(dimensions: int) -> st.SearchStrategy[list[Way]]:
    place = st.tuples(st.integers(0, 28), st.integers(0, 28), *[st.integers(0, 9)] * (dimensions - 2))
    walk = st.lists(place, min_size=2, max_size=5).filter(lambda way: all(a[:2] != b[:2] for a, b in pairwise(way)))
    return st.lists(walk.map(lambda way: np.array(way, dtype=float) * TENTH), min_size=2, max_size=7)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.one_of(walks(2), walks(3)), st.sampled_from([10, 13, 15]))
def test_ends_are_what_the_definitions_say(lines: list[Way], reach: int) -> None:
    ends = classify_ends(table(*lines), AIM, coincide=COINCIDE, reach=reach * TENTH)
    expected = classify_all(lines, coincide=COINCIDE, reach=reach * TENTH, aim=Told(*AIM))
    assert len(ends.line) == len(expected)
    for n, want in enumerate(expected):
        assert (ends.line[n], not ends.forward[n]) == (want.line, want.last)
        assert EndKind(ends.kind[n]).name.lower() == want.kind, want
        assert ends.size[n] == pytest.approx(want.size, abs=1e-7), want
        assert ends.other[n] in (want.others or {NOBODY})


def kind_by(distance: float, beyond: EndKind) -> EndKind:
    return EndKind.CONNECTED if distance <= 5 else beyond if distance <= 100 else EndKind.FREE


@pytest.mark.parametrize("by", [0.0, FAR])
@pytest.mark.parametrize("gap", [*TENTHS, 99, 100, 101])
def test_an_end_that_stops_short(gap: int, by: float) -> None:
    ends = classify_ends(
        table(tenths((-900, 0), (900, 0), by=by), tenths((3, gap), (3, 900), by=by)),
        AIM,
        coincide=COINCIDE,
        reach=REACH,
    )
    assert ends.kind[2] == kind_by(gap, EndKind.UNDERSHOOT)
    known = {EndKind.CONNECTED: 0.0, EndKind.UNDERSHOOT: gap * TENTH, EndKind.FREE: REACH}[EndKind(ends.kind[2])]
    assert ends.size[2] == pytest.approx(known, abs=1e-8)
    assert ends.other[2] == (0 if ends.kind[2] == EndKind.UNDERSHOOT else NOBODY)


@pytest.mark.parametrize("by", [0.0, FAR])
@pytest.mark.parametrize("over", [*TENTHS, 99, 100, 105, 106])
def test_an_end_that_goes_beyond(over: int, by: float) -> None:
    ends = classify_ends(
        table(tenths((-900, 0), (900, 0), by=by), tenths((3, -over), (3, 900), by=by)),
        AIM,
        coincide=COINCIDE,
        reach=REACH,
    )
    known = kind_by(over, EndKind.OVERSHOOT)
    assert ends.kind[2] == known
    if known is EndKind.OVERSHOOT:
        assert ends.size[2] == pytest.approx(over * TENTH, abs=1e-8)
        assert ends.other[2] == 0


@pytest.mark.parametrize("depth", [-6, -5, 0, 5, 6, 100, 101])
def test_depth_counts_like_a_way_in_the_plane(depth: int) -> None:
    ends = classify_ends(
        table(tenths((-900, 0, 0), (900, 0, 0)), tenths((3, 0, depth), (3, 900, depth))), AIM,
        coincide=COINCIDE, reach=REACH,
    )  # fmt: skip
    assert ends.kind[2] == kind_by(abs(depth), EndKind.UNDERSHOOT)


@pytest.mark.parametrize(("plane", "depth", "kind"), [(60, 80, EndKind.UNDERSHOOT), (60, 81, EndKind.FREE)])
def test_plane_and_depth_are_joined_at_the_reach(plane: int, depth: int, kind: EndKind) -> None:
    ends = classify_ends(
        table(tenths((-900, 0, 0), (900, 0, 0)), tenths((3, plane, depth), (3, 900, depth))), AIM,
        coincide=COINCIDE, reach=REACH,
    )  # fmt: skip
    assert ends.kind[2] == kind


@pytest.mark.parametrize("opening", TENTHS)
def test_a_line_is_closed_up_to_the_tolerance(opening: int) -> None:
    line = tenths((0, 0), (500, 0), (500, 500), (0, 500), (0, opening))
    assert len(classify_ends(table(line), AIM, coincide=COINCIDE, reach=REACH).line) == (0 if opening <= 5 else 2)


def test_of_lines_at_one_distance_the_leftmost_is_named() -> None:
    short = tenths((0, 0), (0, -900))
    left, right = tenths((-9, 20), (-9, 900)), tenths((9, 20), (9, 900))
    for lines, named in (((left, right), 1), ((right, left), 2)):
        ends = classify_ends(table(short, *lines), AIM, coincide=COINCIDE, reach=REACH)
        assert (ends.kind[0], ends.other[0]) == (EndKind.UNDERSHOOT, named)


def test_the_last_meeting_is_the_one_nearest_to_the_end() -> None:
    bars = [tenths((-900, y), (900, y)) for y in (40, 60, 20)]
    ends = classify_ends(table(*bars, tenths((0, 0), (0, 900))), AIM, coincide=COINCIDE, reach=REACH)
    assert (ends.kind[6], ends.other[6]) == (EndKind.OVERSHOOT, 2)
    assert ends.size[6] == pytest.approx(20 * TENTH)


# --- lines along lines -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("by", [0.0, FAR])
@pytest.mark.parametrize("aside", [0, *TENTHS])
@pytest.mark.parametrize("common", [4, 5, 6, 7, 300])
def test_a_stretch_is_shared_within_the_tolerance_and_longer_than_it(common: int, aside: int, by: float) -> None:
    long, other = tenths((0, 0), (900, 0), by=by), tenths((900 - common, aside), (1500, aside), by=by)
    found = line_overlaps(table(long, other), np.zeros(2, dtype=bool), coincide=COINCIDE)
    assert len(found.length) == (aside <= 5 and common > 5)
    if len(found.length):
        assert found.length == pytest.approx([common * TENTH], abs=1e-8)
        assert (found.other.tolist(), found.line.tolist()) == ([0], [1])
        ends = np.sort(np.stack([found.start[0], found.end[0]])[:, 0])
        assert ends == pytest.approx([(900 - common) * TENTH, 900 * TENTH], abs=1e-7)


@pytest.mark.parametrize(("rise", "along"), [(3.8, True), (4.2, False), (-3.8, True), (-4.2, False)])
def test_a_piece_turned_by_more_than_one_in_four_does_not_run_along(rise: float, along: bool) -> None:  # noqa: FBT001
    # Sixteen tenths long, of which it rises so many.
    run = np.sqrt(16.0**2 - rise**2)
    lines = table(tenths((0, 0), (900, 0)), tenths((400, 0), (400 + run, rise)))
    found = line_overlaps(lines, np.zeros(2, dtype=bool), coincide=COINCIDE)
    assert len(found.length) == along
    if along:
        assert found.length == pytest.approx([run * TENTH], abs=1e-8)


@pytest.mark.parametrize("depth", [5, 6])
def test_a_stretch_is_shared_in_depth_too(depth: int) -> None:
    lines = table(tenths((0, 0, 0), (900, 0, 0)), tenths((300, 0, depth), (600, 0, depth)))
    assert len(line_overlaps(lines, np.zeros(2, dtype=bool), coincide=COINCIDE).length) == (depth <= 5)


@pytest.mark.parametrize("exempt", [(False, False), (True, False), (False, True), (True, True)])
def test_two_boundaries_are_not_compared_and_a_boundary_never_is_at_fault(exempt: tuple[bool, bool]) -> None:
    # The second is the shorter: it is at fault unless it is the boundary.
    lines = table(tenths((0, 0), (900, 0)), tenths((300, 0), (600, 0)))
    found = line_overlaps(lines, np.array(exempt), coincide=COINCIDE)
    known = [] if all(exempt) else [0] if exempt[1] else [1]
    assert found.line.tolist() == known


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
def test_of_lines_over_each_other_the_longest_stays(order: tuple[int, ...]) -> None:
    ways = [tenths((0, 0), (400, 0)), tenths((300, 0), (1200, 0)), tenths((1100, 0), (1400, 0))]
    found = line_overlaps(table(*(ways[n] for n in order)), np.zeros(3, dtype=bool), coincide=COINCIDE)
    at_fault = {order[n] for n in found.line.tolist()}
    assert at_fault == {0, 2}
    assert {order[n] for n in found.other.tolist()} == {1}


@pytest.mark.parametrize("aside", TENTHS)
def test_a_line_retraces_itself_within_the_tolerance(aside: int) -> None:
    hairpin = tenths((0, 0), (500, 0), (500, aside), (100, aside))
    found = self_meetings(table(hairpin), coincide=COINCIDE)
    assert len(found.line) == (aside <= 5)
    if len(found.line):
        assert np.ptp(np.stack([found.start[0], found.end[0]])[:, 0]) == pytest.approx(400 * TENTH, abs=1e-7)


@pytest.mark.parametrize("back", [*TENTHS, 14, 40])
def test_a_line_that_turns_back_at_its_end(back: int) -> None:
    found = self_meetings(table(tenths((0, 0), (500, 0), (500 - back, 0))), coincide=COINCIDE)
    assert len(found.line) == (back > 5)
    if len(found.line):
        assert np.hypot(*(found.end - found.start).T) == pytest.approx([back * TENTH], abs=1e-8)


@pytest.mark.parametrize("gap", TENTHS)
def test_a_line_touches_itself_within_the_tolerance(gap: int) -> None:
    hook = tenths((0, 0), (900, 0), (900, 600), (300, 600), (300, gap))
    found = self_meetings(table(hook), coincide=COINCIDE)
    assert len(found.line) == (gap <= 5)
    if len(found.line):
        assert found.loop == pytest.approx([(600 + 600 + 600 + 600) * TENTH], abs=2 * COINCIDE)
        assert found.start[0] == pytest.approx([300 * TENTH, 0.0], abs=COINCIDE)


# --- copies ----------------------------------------------------------------------------------------------------------


def same(one: Way, two: Way) -> bool:
    """Definition of TOP001 for open lines: vertex by vertex, or at every same share of the lengths."""
    return any(_near(one, way) for way in (two, two[::-1]))


def _near(one: Way, two: Way) -> bool:
    bound = COINCIDE + 1e-8
    if len(one) == len(two) and np.all(np.hypot(*(one - two).T) <= bound):
        return True
    runs = [np.concatenate([[0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))]) for way in (one, two)]
    shares = np.unique(np.concatenate([run / run[-1] for run in runs]))
    places = [
        np.column_stack([np.interp(shares * run[-1], run, way[:, axis]) for axis in (0, 1)])
        for run, way in zip(runs, (one, two), strict=True)
    ]
    return bool(np.all(np.hypot(*(places[0] - places[1]).T) <= bound))


def groups(ways: list[Way]) -> list[int]:
    label = list(range(len(ways)))
    for j in range(len(ways)):
        for i in range(j):
            if label[i] != label[j] and same(ways[i], ways[j]):
                old, new = max(label[i], label[j]), min(label[i], label[j])
                label = [new if name == old else name for name in label]
    order = {name: n for n, name in enumerate(dict.fromkeys(label))}
    return [order[name] for name in label]


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.data())
def test_copies_are_what_the_definition_says(data: st.DataObject) -> None:
    bases = [np.array([(0, 0), (60, 0)]), np.array([(0, 0), (40, 0), (40, 40)]), np.array([(0, 0), (30, 0), (60, 0)])]
    beside = st.tuples(st.integers(-6, 6), st.integers(-6, 6))
    ways = []
    for _ in range(data.draw(st.integers(2, 6))):
        way = data.draw(st.sampled_from(bases))
        moved = way + np.array([data.draw(beside) for _ in way])
        ways.append(moved[:: data.draw(st.sampled_from([1, -1]))] * TENTH)
    assert duplicate_groups(table(*ways), coincide=COINCIDE).tolist() == groups(ways)


@pytest.mark.parametrize("by", [0.0, FAR])
@pytest.mark.parametrize("aside", [0, *TENTHS])
def test_a_copy_beside_its_original(aside: int, by: float) -> None:
    original = tenths((0, 0), (500, 0), (500, 300), by=by)
    ring = tenths((1000, 0), (1500, 0), (1500, 300), (1000, 0), by=by)
    moved = np.array([0.0, aside * TENTH])
    copy, turned = original + moved, np.roll(ring[:-1], 1, axis=0) + moved
    found = duplicate_groups(table(original, ring, copy[::-1], np.vstack([turned, turned[:1]])), coincide=COINCIDE)
    assert found.tolist() == ([0, 1, 0, 1] if aside <= 5 else [0, 1, 2, 3])


@pytest.mark.parametrize("depth", [5, 6])
def test_a_copy_in_another_depth(depth: int) -> None:
    original = tenths((0, 0, 0), (500, 0, 3), (500, 300, 9))
    lines = table(original, original + np.array([0.0, 0.0, depth * TENTH]))
    assert duplicate_groups(lines, coincide=COINCIDE).tolist() == ([0, 0] if depth <= 5 else [0, 1])


@pytest.mark.parametrize("gap", [99, 100, 101])
def test_what_is_not_farther_than_the_gap_belongs_together(gap: int) -> None:
    shapes = shapely.linestrings([tenths((0, 0), (50, 0)), tenths((50 + gap, 0), (500, 0))])
    assert clusters(shapes, gap=0.01 + 1e-12).tolist() == ([0, 0] if gap <= 100 else [0, 1])
