# SPDX-License-Identifier: MIT
"""The first vertex at which a line leaves a circle, against a walk vertex by vertex."""

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from foparq.geom.leaving import leaving
from foparq.geom.polylines import Polylines


def walked(way: NDArray[np.float64], at: int, radius: float, *, forward: bool) -> int | None:
    rest = range(at + 1, len(way)) if forward else range(at - 1, -1, -1)
    return next((n for n in rest if np.hypot(*(way[n] - way[at])) > radius), None)


@pytest.mark.parametrize("radius", [0.4, 2.0, 7.0])
@pytest.mark.parametrize("seed", range(4))
def test_every_vertex_both_ways(seed: int, radius: float) -> None:
    rng = np.random.default_rng(seed)
    ways = [np.cumsum(rng.normal(0, 0.5, (count, 2)), axis=0) for count in (2, 3, 4, 7, 8, 9, 33)]
    lines = Polylines.of(np.array([shapely.LineString(way) for way in ways]))
    m = len(lines.coordinates)
    for forward in (True, False):
        found = leaving(lines, np.arange(m), np.full(m, forward), radius=radius)
        for head, way in zip(lines.heads, ways, strict=True):
            for n in range(len(way)):
                known = walked(way, n, radius, forward=forward)
                beyond = found[head + n] >= head + len(way) if forward else found[head + n] < head
                assert beyond if known is None else found[head + n] == head + known


@pytest.mark.parametrize("count", [2, 3, 4, 5, 8, 9])
def test_a_line_that_leaves_with_its_last_vertex(count: int) -> None:
    way = np.zeros((count, 2))
    way[:, 0] = np.linspace(0, 1, count)
    way[-1] = (9, 0)
    lines = Polylines.of(np.array([shapely.LineString(way), shapely.LineString(way[::-1])]))
    ahead = leaving(lines, np.array([0, 2 * count - 1]), np.array([True, False]), radius=2.0)
    assert ahead.tolist() == [count - 1, count]
