# SPDX-License-Identifier: MIT
"""Lines that other layers draw again, at sizes near the tolerance."""

import numpy as np
import pytest
import shapely

from foparq.geom.polylines import Polylines
from foparq.geom.repeats import drawn_again

COINCIDE = 0.001


def again(*lines: list[tuple[float, float]]) -> list[bool]:
    """Which of some lines, each on a layer of its own, only repeat others."""
    made = Polylines.of(np.array([shapely.LineString(line) for line in lines], dtype=object))
    n = len(lines)
    told: list[bool] = drawn_again(made, np.zeros(n, dtype=bool), np.arange(n), coincide=COINCIDE).tolist()
    return told


@pytest.mark.parametrize("length", [0.005, 0.01, 0.03, 1.0])
def test_a_piece_of_a_longer_line_repeats_it_however_short_it_is(length: float) -> None:
    assert again([(0, 0), (5, 0)], [(1, 0), (1 + length, 0)]) == [False, True]


def test_a_piece_that_goes_on_beyond_the_longer_line_repeats_nothing() -> None:
    assert again([(0, 0), (5, 0)], [(4.99, 0), (4.99 + 0.013, 0)]) == [False, False]
