# SPDX-License-Identifier: MIT
"""Stretches that segments share in space, worked out by hand, for segments of any size and drawn any way."""

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from foparq.geom.polylines import Segments
from foparq.geom.segments import at_share, cannot_meet, contacts, nearest_share, shared

WITHIN = 5e-4
Way = tuple[tuple[float, float, float], tuple[float, float, float]]


def segment(way: Way) -> Segments:
    start, end = np.array(way, dtype=float)
    return Segments(start[None, :2], end[None, :2], start[None, 2], end[None, 2])


def every_way(one: Way, two: Way) -> list[tuple[Segments, Segments]]:
    """Both segments drawn both ways, in both orders."""
    ways = [(a, b) for a in (one, one[::-1]) for b in (two, two[::-1])]
    return [(segment(a), segment(b)) for a, b in [*ways, *((b, a) for a, b in ways)]]


def sloping(start: float, end: float, size: float, *, aside: float = 0.0, drop: float = 0.0) -> Way:
    """A piece of a line that rises by three in ten, between two shares of its length in the plane."""
    return tuple((share * size, aside, 0.3 * share * size + drop) for share in (start, end))  # type: ignore[return-value]


@pytest.mark.parametrize("size", [0.02, 0.5, 1.0, 3.0, 40.0])
@pytest.mark.parametrize(
    ("start", "end", "known"), [(0.5, 1.0, 0.5), (0.25, 0.75, 0.5), (-0.5, 0.5, 0.5), (-1, 3, 1.0)]
)
def test_segments_on_one_slope_share_what_lies_on_both(size: float, start: float, end: float, known: float) -> None:
    for a, b in every_way(sloping(0, 1, size), sloping(start, end, size)):
        found = shared(a, b, within=WITHIN)
        assert found.length == pytest.approx([known * size])
        places = sorted([found.start[0].tolist(), found.end[0].tolist()])
        assert places == [pytest.approx([max(start, 0) * size, 0]), pytest.approx([min(end, 1) * size, 0])]


@pytest.mark.parametrize("size", [0.02, 0.5, 1.0, 3.0])
@pytest.mark.parametrize(("aside", "drop"), list(itertools.product([0.9, 1.1], [0.9, -0.9, 1.1, -1.1])))
def test_they_share_nothing_where_either_is_farther_than_the_tolerance(size: float, aside: float, drop: float) -> None:
    shifted = sloping(0.25, 0.75, size, aside=aside * WITHIN, drop=drop * WITHIN)
    known = size / 2 if aside < 1 and abs(drop) < 1 else 0.0
    for a, b in every_way(sloping(0, 1, size), shifted):
        assert shared(a, b, within=WITHIN).length == pytest.approx([known])


@pytest.mark.parametrize(("rise", "runs"), [(0.2, True), (0.24, True), (0.26, False), (0.5, False), (1.0, False)])
def test_a_slope_of_one_in_four_ends_running_along(rise: float, runs: bool) -> None:  # noqa: FBT001
    # So short that both its ends stay within the tolerance: the sine of the angle decides.
    short = 0.3 * WITHIN
    turned = ((0.0, 0.0, 0.0), (short * np.sqrt(1 - rise**2), short * rise, 0.0))
    for a, b in every_way(((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)), turned):
        assert bool(shared(a, b, within=WITHIN).length[0] > 0) is runs


@pytest.mark.parametrize("turn", [0.0, 30.0, 90.0, 135.0])
@pytest.mark.parametrize("aside", [0.4 * WITHIN, -0.4 * WITHIN])
def test_of_equals_the_stretch_lies_on_the_first_by_place(turn: float, aside: float) -> None:
    # The first is that with the lower x of the middle, of equal x the lower y.
    along = np.round([np.cos(np.radians(turn)), np.sin(np.radians(turn))], 12)
    across = aside * np.array([-along[1], along[0]])
    one, two = np.array([-along, along]), np.array([-along, along]) + across
    first = one if tuple(across) > (0, 0) else two
    ways = [tuple((*place, 0.0) for place in ends.tolist()) for ends in (one, two)]
    for a, b in every_way(*ways):  # type: ignore[arg-type]
        found = shared(a, b, within=WITHIN)
        assert found.length == pytest.approx([2.0])
        places = sorted([found.start[0].tolist(), found.end[0].tolist()])
        assert np.array(places) == pytest.approx(np.array(sorted(first.tolist())), abs=1e-9)


@pytest.mark.parametrize(
    "post", [((1.0, 0.0, 0.0), (1.0, 0.0, 2.0)), ((1.0, 0.0, 0.0), (1.0, 0.0, 0.0))], ids=["into the depth", "a point"]
)
@pytest.mark.parametrize("through", [((0.0, 0.0, 0.0), (3.0, 0.0, 0.0)), ((1.0, -1.0, 0.0), (1.0, 1.0, 0.0))])
def test_what_meets_is_never_rejected_though_it_has_no_length_in_the_plane(post: Way, through: Way) -> None:
    for a, b in every_way(post, through):
        assert contacts(a, b, within=WITHIN).meets.any()
        assert not cannot_meet(a, b, within=WITHIN).any()
        beside = Segments(b.start + 2 * WITHIN, b.end + 2 * WITHIN, b.z0, b.z1)
        assert not contacts(a, beside, within=WITHIN).meets.any()
        assert cannot_meet(a, beside, within=WITHIN).all()


def test_a_segment_without_length_shares_nothing_and_its_place_is_its_start() -> None:
    dot = ((0.5, 0.0, 0.0), (0.5, 0.0, 0.0))
    for a, b in [*every_way(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), dot), *every_way(dot, dot)]:
        assert shared(a, b, within=WITHIN).length.tolist() == [0.0]
    start = np.array([[0.5, 0.0]])
    assert nearest_share(np.array([[7.0, 7.0]]), start, start).tolist() == [0.0]


@pytest.mark.parametrize(
    ("point", "share"), [((-1.0, 0.5), 0.0), ((0.0, 0.0), 0.0), ((3.0, 0.0), 0.5), ((0.0, 9.0), 1.0), ((9.0, 9.0), 1.0)]
)
def test_the_nearest_place_is_the_foot_of_the_perpendicular_or_an_end(point: tuple[float, float], share: float) -> None:
    start, end = np.array([[0.0, 0.0]]), np.array([[3.0, 3.0]])
    found = nearest_share(np.array([point]), start, end)
    assert found == pytest.approx([share])
    places: NDArray[np.float64] = at_share(np.linspace(0, 1, 101), np.repeat(start, 101, 0), np.repeat(end, 101, 0))
    least = np.hypot(*(places - point).T).min()
    assert np.hypot(*(at_share(found, start, end)[0] - point)) == pytest.approx(least)


@pytest.mark.parametrize("z", [-2.0, 0.0, 40.0])
@pytest.mark.parametrize(("drop", "meets"), [(0.9, True), (-0.9, True), (1.1, False), (-1.1, False)])
def test_a_crossing_is_one_in_space(z: float, drop: float, meets: bool) -> None:  # noqa: FBT001
    rising = ((0.0, 0.0, z), (4.0, 0.0, z + 4))
    across = ((1.0, -1.0, z + 1 + drop * WITHIN - 3), (1.0, 3.0, z + 1 + drop * WITHIN + 9))
    for a, b in every_way(rising, across):
        found = contacts(a, b, within=WITHIN)
        assert bool(found.meets[0, 0]) is meets
        assert at_share(found.on_a[0], a.start, a.end)[0] == pytest.approx([1.0, 0.0])
        assert at_share(found.on_b[0], b.start, b.end)[0] == pytest.approx([1.0, 0.0])
        assert not found.meets[1:].any()


@pytest.mark.parametrize("short", [0.0, 0.25, 1.0])
@pytest.mark.parametrize("angle", [90.0, 30.0, 150.0])
def test_segments_cross_up_to_their_ends_and_not_beyond(angle: float, short: float) -> None:
    # The second comes from either side, and ends on the first or stops before it.
    way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    for side in (1, -1):
        start, end = side * short * way, side * 3 * way
        base = ((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0))
        for a, b in every_way(base, ((*start.tolist(), 0.0), (*end.tolist(), 0.0))):
            found = contacts(a, b, within=WITHIN)
            assert bool(found.meets[0, 0]) is (short == 0)
            assert bool(found.meets.any()) is (short == 0)
            if short:
                assert np.isnan([found.on_a[0, 0], found.on_b[0, 0]]).all()
            else:
                assert at_share(found.on_a[0], a.start, a.end)[0] == pytest.approx([0.0, 0.0])
