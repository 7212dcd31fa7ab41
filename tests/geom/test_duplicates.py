# SPDX-License-Identifier: MIT
"""Whole lines drawn more than once, and things that are near each other."""

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from foparq.geom.clusters import clusters
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.polylines import Polylines

COINCIDE = 0.001


def disguised(line: shapely.LineString, rng: np.random.Generator) -> shapely.LineString:
    """The same shape: another start if it is a ring, backwards, more vertices, a little beside itself."""
    if line.is_ring:
        way = np.array(line.coords)[:-1]
        way = np.roll(way, rng.integers(len(way)), axis=0)
        line = shapely.LineString(np.vstack([way, way[:1]]))
    if rng.random() < 0.5:
        line = shapely.reverse(line)
    if rng.random() < 0.5:
        line = shapely.segmentize(line, rng.uniform(0.05, 0.5))
    beside = rng.uniform(-0.4, 0.4, 2) * COINCIDE
    return shapely.transform(line, lambda way: way + beside)


@pytest.mark.parametrize("seed", range(10))
def test_disguised_copies_are_found_and_nothing_else(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shapes = []
    for _ in range(25):
        way = np.cumsum(rng.uniform(-1, 1, (rng.integers(2, 8), 2)), axis=0)
        shapes.append(shapely.LineString(np.vstack([way, way[:1]]) if rng.random() < 0.5 and len(way) > 2 else way))
    truth = np.concatenate([np.arange(25), rng.integers(0, 25, 60)])
    lines = np.array([disguised(shapes[n], rng) if k >= 25 else shapes[n] for k, n in enumerate(truth)], dtype=object)
    assert duplicate_groups(Polylines.of(lines), coincide=COINCIDE).tolist() == truth.tolist()


@pytest.mark.parametrize("noise", [0.0, 0.2], ids=["exact", "each beside the others"])
def test_hundred_thousand_copies_are_one_group(noise: float) -> None:
    way = np.array([[0, 0], [1, 0], [1, 1], [3, 2]], dtype=float)
    copies = np.tile(way, (100_000, 1, 1)) + np.random.default_rng(1).uniform(-noise, noise, (100_000, 1, 2)) * COINCIDE
    groups = duplicate_groups(Polylines.of(shapely.linestrings(copies)), coincide=COINCIDE)
    assert not groups.any()


def test_chain_of_many_near_copies_is_one_group() -> None:
    rows = np.arange(800) * 0.9 * COINCIDE
    lines = shapely.linestrings(
        np.stack([np.column_stack([0 * rows, rows]), np.column_stack([0 * rows + 1, rows])], axis=1)
    )
    assert not duplicate_groups(Polylines.of(lines), coincide=COINCIDE).any()


def test_diagonals_of_one_box_are_two_shapes() -> None:
    lines = shapely.linestrings([[(0, 0), (1, 1)], [(0, 1), (1, 0)]] * 40_000)
    assert duplicate_groups(Polylines.of(lines), coincide=COINCIDE).tolist() == [0, 1] * 40_000


@pytest.mark.parametrize("lines", [[], ["LINESTRING (0 0, 1 1)"]])
def test_few_lines_have_no_copies(lines: list[str]) -> None:
    drawn = Polylines.of(np.array([shapely.from_wkt(line) for line in lines], dtype=object))
    assert duplicate_groups(drawn, coincide=COINCIDE).tolist() == list(range(len(lines)))


def shuffled_truth(geometry: NDArray[np.object_], gap: float) -> list[int]:
    """Components by flooding, one geometry at a time."""
    label = [-1] * len(geometry)
    for seed in range(len(geometry)):
        if label[seed] >= 0:
            continue
        label[seed] = max(label) + 1
        queue = [seed]
        while queue:
            near = shapely.distance(geometry[queue.pop()], geometry) <= gap
            fresh = [n for n in np.flatnonzero(near) if label[n] < 0]
            for n in fresh:
                label[n] = label[seed]
            queue += fresh
    return label


@pytest.mark.parametrize("seed", range(5))
def test_clusters_are_what_flooding_finds(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = rng.uniform(0, 3, (150, 1, 2))
    geometry = shapely.linestrings(np.concatenate([start, start + rng.normal(0, 0.1, (150, 2, 2))], axis=1))
    geometry[::7] = shapely.points(start[::7, 0])
    assert clusters(geometry, gap=0.05).tolist() == shuffled_truth(geometry, 0.05)


def test_what_is_missing_or_empty_is_alone() -> None:
    geometry = np.array([None, shapely.Point(0, 0), shapely.Point(), shapely.Point(0, 0.009), shapely.Point(1, 1)])
    assert clusters(geometry, gap=0.01).tolist() == [0, 1, 2, 1, 3]
    assert clusters(np.empty(0, dtype=object), gap=0.01).tolist() == []


def test_exactly_gap_apart_belongs_together() -> None:
    geometry = shapely.points([[0, 0], [3, 4], [20, 0]])
    assert clusters(geometry, gap=5.0).tolist() == [0, 0, 1]
    assert clusters(geometry, gap=4.999).tolist() == [0, 1, 2]


def halved(way: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same way with a vertex in the middle of every segment."""
    return np.insert(way, np.arange(1, len(way)), (way[:-1] + way[1:]) / 2, axis=0)


@pytest.mark.parametrize("seed", range(6))
def test_copies_are_as_deep_as_what_they_repeat(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ways, deep = [], np.array([0, 0, 2 * COINCIDE])
    for n in range(12):
        way = np.cumsum(rng.uniform(-1, 1, (rng.integers(3, 7), 3)), axis=0)
        way[:, 2] += rng.choice([0, -40, 700])
        ways.append(np.vstack([way, way[:1]]) if n % 2 else way)
    # Alike in the plane, and no copies: all of it is deeper, or one vertex more is.
    deeper = [way + deep for way in ways]
    dented = [np.insert(way, 1, way[:2].mean(axis=0) + deep, axis=0) for way in ways]
    copies = [halved(way)[::-1] + rng.uniform(-0.4, 0.4, 3) * COINCIDE for way in (*ways, *deeper, *dented)]
    lines = np.array([shapely.LineString(way) for way in (*ways, *deeper, *dented, *copies)], dtype=object)
    found = duplicate_groups(Polylines.of(lines), coincide=COINCIDE)
    assert found.tolist() == [*range(36), *range(36)]
