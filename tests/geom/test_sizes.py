# SPDX-License-Identifier: MIT
"""What fits into a circle of some diameter, by shapes whose enclosing circle is known."""

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given
from hypothesis import strategies as st

from foparq.geom.sizes import smaller_than

#: shapes and the diameter of the smallest circle around each
KNOWN = {
    "LINESTRING (0 0, 3 4)": 5.0,
    "LINESTRING (0 0, 1 0, 1 1, 0 1, 0 0)": np.sqrt(2),
    "POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))": 5.0,
    "LINESTRING (0 0, 1 0, 0.5 0.8660254037844386, 0 0)": 2 / np.sqrt(3),
    "LINESTRING (0 0, 0.1 0, 0 0.1, 0.1 0.1, 0 0)": 0.1 * np.sqrt(2),
    "LINESTRING (2 2, 2 2)": 0.0,
}


@pytest.mark.parametrize(("shape", "diameter"), KNOWN.items())
@pytest.mark.parametrize("turn", [0, 17, 45, 90])
def test_known_circles_whichever_way_they_are_turned(shape: str, diameter: float, turn: float) -> None:
    turned = np.array([shapely.affinity.rotate(shapely.from_wkt(shape), turn, origin=(50, 50))], dtype=object)
    assert smaller_than(turned, diameter + 1e-6).all()
    assert not smaller_than(turned, diameter - 1e-6).any()


@pytest.mark.parametrize("shape", ["LINESTRING EMPTY", "LINESTRING (0 0, 0 nan)", "LINESTRING (0 0, inf 1)"])
def test_what_has_no_size_is_not_small(shape: str) -> None:
    with np.errstate(invalid="ignore"):
        assert not smaller_than(np.array([shapely.from_wkt(shape)], dtype=object), 1e9).any()


@given(st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=2, max_size=6), st.integers(1, 30))
def test_never_small_if_two_of_its_points_are_farther_apart(points: list[tuple[int, int]], size: int) -> None:
    apart = max(np.hypot(a[0] - b[0], a[1] - b[1]) for a in points for b in points)
    small = bool(smaller_than(np.array([shapely.LineString(points)], dtype=object), size)[0])
    assert not (small and apart >= size)
    assert small or apart * 2 / np.sqrt(3) >= size * (1 - 1e-9)  # Jung: no circle is larger than that
