# SPDX-License-Identifier: MIT
"""Crossings, overlaps and the index beneath them, against shapely and against brute force."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from foparq.geom import boxtree, runtree
from foparq.geom.boxtree import BoxTree, z_order
from foparq.geom.crossings import self_meetings
from foparq.geom.overlaps import line_overlaps
from foparq.geom.pairs import own_meetings, runs_of_two
from foparq.geom.polylines import Polylines

FINE = 1e-9
walk = (
    st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=2, max_size=6)
    .filter(lambda way: all(a != b for a, b in pairwise(way)))
    .map(shapely.LineString)
)


def table(lines: list[shapely.LineString]) -> Polylines:
    return Polylines.of(np.array([*lines, None], dtype=object)[:-1])


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", [0, 1, 3, 4, 5, 17, 300])
def test_tree_finds_the_pairs_that_brute_force_finds(count: int, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(boxtree, "_CHUNK", 64)
    rng = np.random.default_rng(seed)
    low = rng.uniform(0, 1, (count, 2))
    high = low + rng.exponential(0.1, (count, 2)) * (rng.random((count, 1)) < 0.7)
    tree = BoxTree(low, high)
    near = np.all((low[:, None] <= high[None] + 0.01) & (low[None] <= high[:, None] + 0.01), axis=2)

    found = [
        pair for i, j in tree.pairs(distance=0.01) for pair in zip(np.minimum(i, j), np.maximum(i, j), strict=True)
    ]
    assert len(found) == len(set(found))
    assert set(found) == set(zip(*np.nonzero(np.triu(near, 1)), strict=True))

    asked: set[tuple[int, int]] = set()
    for rows, boxes in tree.query(low, high, distance=0.01):
        chunk = set(zip(rows.tolist(), boxes.tolist(), strict=True))
        assert not {row for row, _ in chunk} & {row for row, _ in asked}, "pairs of one box come together"
        asked |= chunk
    assert asked == set(zip(*(axis.tolist() for axis in np.nonzero(near)), strict=True))


@pytest.mark.parametrize("seed", range(6))
def test_runs_find_the_pairs_that_brute_force_finds(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runtree, "_CHUNK", 64)
    rng = np.random.default_rng(seed)
    offsets = np.concatenate([[0], np.cumsum(rng.choice([0, 1, 2, 3, 4, 5, 16, 17, 60], 20))])
    low = rng.uniform(0, 1, (offsets[-1], 2))
    high = low + rng.exponential(0.1, low.shape) * (rng.random((len(low), 1)) < 0.7)
    run = np.repeat(np.arange(20), np.diff(offsets))
    near = np.all((low[:, None] <= high[None] + 0.01) & (low[None] <= high[:, None] + 0.01), axis=2)
    expected = set(zip(*np.nonzero(np.triu(near & (run[:, None] == run), 2)), strict=True))
    found = [
        pair for i, j in runtree.pairs_of_runs(low, high, offsets, distance=0.01) for pair in zip(i, j, strict=True)
    ]
    assert len(found) == len(set(found))
    assert set(found) == expected


@pytest.mark.parametrize("seed", range(4))
def test_boxes_exactly_as_far_apart_as_the_distance_are_near(seed: int) -> None:
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 30, (60, 2)).astype(float)
    high = low + rng.integers(0, 4, (60, 2))
    near = np.all((low[:, None] <= high[None] + 2) & (low[None] <= high[:, None] + 2), axis=2)
    tree = BoxTree(low, high)
    one_run = np.array([0, 60])
    for found, expected in (
        (tree.pairs(distance=2), np.triu(near, 1)), (tree.query(low, high, distance=2), near),
        (runtree.pairs_of_runs(low, high, one_run, distance=2), np.triu(near, 2)),
    ):  # fmt: skip
        pairs = np.concatenate([np.stack(chunk) for chunk in found], axis=1)
        pairs = pairs if expected is near else np.sort(pairs, axis=0)
        assert sorted(pairs.T.tolist()) == np.argwhere(expected).tolist()


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.lists(walk, min_size=1, max_size=6))
def test_segments_of_one_line_meet_where_shapely_says_so(lines: list[shapely.LineString]) -> None:
    pieces = [
        (n, k, shapely.LineString(step)) for n, line in enumerate(lines) for k, step in enumerate(pairwise(line.coords))
    ]
    expected = {
        (i, j)
        for i, (n, k, a) in enumerate(pieces)
        for j, (m, l, b) in enumerate(pieces)
        if i < j and n == m and k + 1 != l and shapely.intersects(a, b)
    }
    assert set(zip(*own_meetings(table(lines), coincide=FINE).tolist(), strict=True)) == expected


@settings(max_examples=300, deadline=None, derandomize=True)
@given(walk)
def test_line_meets_itself_where_shapely_calls_it_not_simple(line: shapely.LineString) -> None:
    assert bool(len(self_meetings(table([line]), coincide=FINE).line)) == (not line.is_simple)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(walk.filter(lambda line: line.is_simple), min_size=2, max_size=5))
def test_shared_length_is_that_of_the_intersection(lines: list[shapely.LineString]) -> None:
    found = line_overlaps(table(lines), np.zeros(len(lines), dtype=bool), coincide=FINE)
    # Crossings are no overlaps; what is left of the intersection has a length.
    expected = {(j, i): shapely.intersection(lines[i], lines[j]).length for j in range(len(lines)) for i in range(j)}
    expected = {pair: length for pair, length in expected.items() if length > 1e-6}
    pairs = [(max(pair), min(pair)) for pair in zip(found.line.tolist(), found.other.tolist(), strict=True)]
    lengths = dict(zip(pairs, found.length, strict=True))
    assert lengths == pytest.approx(expected, abs=1e-6)


def star(count: int) -> NDArray[np.object_]:
    angle = np.arange(count) * (np.pi / count)
    arm = np.column_stack([np.cos(angle), np.sin(angle)])
    lines: NDArray[np.object_] = shapely.linestrings(np.stack([-arm, arm], axis=1))
    return lines


def test_pairs_come_in_order_whatever_the_blocks_they_are_found_in() -> None:
    rng = np.random.default_rng(8)
    lines = Polylines.of(np.array([shapely.LineString([(a, 0.0), (a + 3.0, 0.0)]) for a in rng.uniform(0, 20, 60)]))
    i, j = runs_of_two(lines, coincide=1e-3)
    assert len(i) > 100
    assert list(zip(i.tolist(), j.tolist(), strict=True)) == sorted(zip(i.tolist(), j.tolist(), strict=True))


def test_star_overlaps_nowhere() -> None:
    lines = Polylines.of(star(1000))
    assert not len(line_overlaps(lines, np.zeros(1000, dtype=bool), coincide=1e-6).length)


def test_crosshatch_overlaps_nowhere() -> None:
    place = np.arange(2000) * 0.001
    bars = np.stack([np.column_stack([place, 0 * place]), np.column_stack([place, 0 * place + 2])], axis=1)
    lines = Polylines.of(shapely.linestrings(np.concatenate([bars, bars[:, :, ::-1]])))
    assert not len(line_overlaps(lines, np.zeros(4000, dtype=bool), coincide=1e-4).length)


def test_collinear_lines_overlap_pair_by_pair() -> None:
    lines = shapely.linestrings([[(n, 2 * n), (n + 1.5, 2 * n + 3)] for n in range(50)])
    found = line_overlaps(Polylines.of(lines), np.zeros(50, dtype=bool), coincide=1e-6)
    pairs = zip(found.line.tolist(), found.other.tolist(), strict=True)
    assert sorted(map(min, pairs)) == list(range(49))
    assert found.length == pytest.approx(np.full(49, np.hypot(0.5, 1)))


@pytest.mark.parametrize(
    ("other", "runs"),
    [
        ([(0.5, 0), (3, 0)], True), ([(1, 0), (3, 0)], False), ([(-3, 0), (0, 0)], False), ([(1.5, 0), (3, 0)], False),
        ([(0, 9e-4), (1, 9e-4)], True), ([(0, 11e-4), (1, 11e-4)], False), ([(0.5, -1), (0.5, 1)], False),
        ([(0.5, 0), (0.5, 1)], False), ([(1, 9e-4), (3, 9e-4)], False),
    ],
)  # fmt: skip
def test_segments_that_only_touch_or_cross_do_not_run_along(other: list[tuple[float, float]], runs: bool) -> None:  # noqa: FBT001
    for two in (other, other[::-1]):
        for lines in ([[(0, 0), (1, 0)], two], [two, [(0, 0), (1, 0)]]):
            found = runs_of_two(table([shapely.LineString(way) for way in lines]), coincide=1e-3)
            assert found.T.tolist() == ([[0, 1]] if runs else [])


def test_figure_of_eight_crosses_once_whichever_way_it_is_cut_up() -> None:
    angle = np.linspace(0.3, 0.3 + 2 * np.pi, 400)
    eight = shapely.LineString(np.column_stack([np.sin(angle), np.sin(angle) * np.cos(angle)]))
    for line in (eight, shapely.segmentize(eight, 0.001)):
        found = self_meetings(table([line]), coincide=1e-4)
        assert found.start + Polylines.of(np.array([line])).origin == pytest.approx(np.zeros((1, 2)), abs=1e-4)
        assert found.loop == pytest.approx([line.length / 2], rel=1e-3)


def test_rounded_corners_finer_than_the_tolerance_are_no_meetings() -> None:
    angle = np.linspace(0, np.pi, 60)
    turn = np.column_stack([np.cos(angle), np.sin(angle)]) * 0.0004
    line = shapely.LineString(np.vstack([turn, turn[-1] + [[-0.2, -1]]]))
    assert not len(self_meetings(table([line]), coincide=0.001).line)


@pytest.mark.parametrize(
    "lines", [[], ["LINESTRING (1 1, 1 1)"], ["LINESTRING (1 1, 1 1, 1 1)", "LINESTRING (1 1, 1 1)"]]
)
def test_nothing_and_points_are_no_trouble(lines: list[str]) -> None:
    drawn = table([shapely.from_wkt(line) for line in lines])
    assert not len(line_overlaps(drawn, np.zeros(len(lines), dtype=bool), coincide=1e-4).length)
    assert not len(self_meetings(drawn, coincide=1e-4).line)


def test_a_chain_of_overlapping_lines_leaves_only_the_longest() -> None:
    count = 20_000
    shapes = [[(n, 0.0), (n + 1.5, 0.0)] for n in range(count)]
    shapes[7] = [(7, 0.0), (8.7, 0.0)]
    found = line_overlaps(Polylines.of(shapely.linestrings(shapes)), np.zeros(count, dtype=bool), coincide=1e-6)
    assert sorted(set(range(count)) - set(found.line.tolist())) == [7]


def morton(x: int, y: int) -> int:
    """Bits of both cells in turn, those of y in front."""
    return sum(((x >> bit) & 1) << 2 * bit | ((y >> bit) & 1) << 2 * bit + 1 for bit in range(31))


@pytest.mark.parametrize("side", [2, 8, 32])
@pytest.mark.parametrize("corner", [0.0, -1e6, 7.4e6])
def test_a_grid_is_ordered_quarter_by_quarter(side: int, corner: float) -> None:
    cells = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    places = np.random.default_rng(side).permutation(cells)
    ranks = z_order(places * 0.25 + corner)
    assert places[np.argsort(ranks)].tolist() == sorted(places.tolist(), key=lambda cell: morton(*cell))
    # The last cell has all bits: 31 of each axis.
    assert (ranks.min(), ranks.max()) == (0, 2**62 - 1)


@pytest.mark.parametrize("far", [(1e7, 0), (-1e7, 0), (0, 1e7), (0, -1e7), (-1e7, 1e7)])
def test_what_lies_far_outside_takes_no_fineness_from_the_bulk(far: tuple[float, float]) -> None:
    rng = np.random.default_rng(3)
    bulk = rng.uniform(0, 1, (5000, 2))
    ranks = z_order(np.vstack([bulk, [far]]))
    # The bulk keeps a fifth of either axis, of 256 steps more than 50: places of 5000 hit most of these cells.
    assert len(np.unique(ranks[:-1] >> np.uint64(2 * (31 - 8)))) > 2000
    assert len(np.unique(ranks)) == 5001


def test_one_place_and_no_place_have_an_order() -> None:
    assert z_order(np.zeros((0, 2))).tolist() == []
    assert z_order(np.full((3, 2), 5.0)).tolist() == [0, 0, 0]
