# SPDX-License-Identifier: MIT
"""Places of upright lines, which begin and end at one x: drawn either way, the same to the last bit."""

import numpy as np
import pytest
import shapely

from foparq.geom.places import place_on


@pytest.mark.parametrize("axis", [1, 2])
@pytest.mark.parametrize("seed", range(10))
def test_a_line_along_one_axis_drawn_backwards_has_the_same_place(seed: int, axis: int) -> None:
    rng = np.random.default_rng(seed)
    lines = []
    for count in rng.integers(2, 30, 20):
        way = np.tile(rng.uniform(-9, 9, 3), (count, 1))
        way[1:-1, 0] += rng.uniform(-1, 1, count - 2)
        way[:, axis] = np.cumsum(rng.uniform(0.1, 1, count))
        lines.append(shapely.LineString(way))
    drawn = np.array(lines)
    places = place_on(drawn)
    assert np.array_equal(places, place_on(shapely.reverse(drawn)))
    if axis == 1:
        middle = shapely.line_interpolate_point(drawn, 0.5, normalized=True)
        assert shapely.distance(shapely.points(places), middle).max() < 1e-9
