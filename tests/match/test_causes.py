# SPDX-License-Identifier: MIT
"""One cause that puts points back on their linework: what was done is known, and must be found."""

import numpy as np
import pytest
import shapely

from foparq.columns import Coordinates, Flags
from foparq.match.causes import Cause, by_axes_or_unit, by_place_or_size
from foparq.match.linework import NOTHING, Linework, footing

TIE = 0.001


class Facade:
    """Openings of unequal size, and points at corners of some of them."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        left = np.cumsum(rng.uniform(1.2, 2.4, 20))
        width, sill, height = rng.uniform(0.7, 1.1, 20), rng.uniform(0.5, 4.0, 20), rng.uniform(1.1, 2.2, 20)
        self.lines = shapely.get_exterior_ring(shapely.box(left, sill, left + width, sill + height))
        self.corners = np.column_stack([shapely.get_coordinates(self.lines), np.zeros(100)])
        chosen = rng.choice(20, 7, replace=False)
        self.points = np.column_stack([left[chosen], (sill + height)[chosen], np.zeros(7)])
        self.work = Linework.of(self.lines)

    def holds(self, moved: Coordinates) -> Flags:
        found: Flags = footing(moved, self.work, within=np.full(len(moved), TIE), deep=False).line != NOTHING
        return found

    def holds_enlarged(self, points: Coordinates, _: float) -> Flags:
        return self.holds(points)

    def search(self, points: Coordinates) -> Cause | None:
        return by_place_or_size(points, self.corners, within=TIE, holds=self.holds)


@pytest.mark.parametrize("seed", range(6))
class TestPlaceAndSize:
    def test_a_shift(self, seed: int) -> None:
        facade = Facade(seed)
        found = facade.search(facade.points - [0.214, -0.318, 0])
        assert found is not None
        assert found.kind == "shift"
        assert found.shift[:2] == pytest.approx((0.214, -0.318), abs=2 * TIE)

    def test_a_mirror(self, seed: int) -> None:
        facade = Facade(seed)
        for along, flip in (("right", [-1, 1, 1]), ("up", [1, -1, 1])):
            found = facade.search(facade.points * flip + [50, 7, 0])
            assert found is not None
            assert (found.kind, found.along) == ("mirror", along)

    def test_a_stretch(self, seed: int) -> None:
        facade = Facade(seed)
        for along, factors in (("", [1.05, 1.05, 1]), ("right", [1.05, 1, 1]), ("up", [1, 0.97, 1])):
            found = facade.search(facade.points / factors - [3, 2, 0])
            assert found is not None
            assert (found.kind, found.along) == ("scale", along)
            assert found.factor == pytest.approx(max(factors) if max(factors) > 1 else 0.97, abs=0.002)

    def test_points_of_another_facade_have_no_cause(self, seed: int) -> None:
        assert Facade(seed).search(Facade(seed + 100).points) is None


def test_axes_and_units() -> None:
    facade = Facade(3)
    table = facade.points[:, [0, 2, 1]]  # the drawing's up stands in the third column
    assert by_axes_or_unit(table, (1000.0,), facade.holds_enlarged) == Cause("axes", axes=(0, 2, 1))
    assert by_axes_or_unit(facade.points * 1000, (1000.0, 0.001), facade.holds_enlarged) == Cause("unit", factor=0.001)
    both = by_axes_or_unit(table * 1000, (0.001,), facade.holds_enlarged)
    assert both == Cause("unit", axes=(0, 2, 1), factor=0.001)
    assert by_axes_or_unit(facade.points + 0.01, (1000.0, 0.001), facade.holds_enlarged) is None


def test_two_places_fit_anywhere() -> None:
    facade = Facade(1)
    two = np.repeat(facade.points[:2], 4, axis=0)
    assert facade.search(two - [0.2, 0.3, 0]) is None
    assert by_axes_or_unit(two * 1000, (0.001,), facade.holds_enlarged) is None
