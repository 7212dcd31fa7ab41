# SPDX-License-Identifier: MIT
"""Wholes drawn again a little aside: windows copied by hand, against what anybody sees."""

from collections.abc import Sequence

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given
from hypothesis import strategies as st

from foparq.geom.polylines import Polylines
from foparq.geom.wholes import LOOSE, repeated_wholes

WINDOW = [
    shapely.LineString([(0, 0), (1, 0), (1, 1.5), (0, 1.5), (0, 0)]),
    shapely.LineString([(0.06, 0.06), (0.94, 0.06), (0.94, 1.44), (0.06, 1.44), (0.06, 0.06)]),
    shapely.LineString([(0.5, 0.06), (0.5, 1.44)]),
]
MIRRORED = [shapely.affinity.scale(line, -1, 1, origin=(0.5, 0)).reverse() for line in WINDOW]
TURNED = [shapely.affinity.rotate(line, 180, origin=(0.5, 0.75)) for line in WINDOW][::-1]


def placed(window: Sequence[shapely.LineString], x: float, y: float = 0.0) -> list[shapely.LineString]:
    return [shapely.affinity.translate(line, x, y) for line in window]


def repeated(*wholes: Sequence[shapely.LineString], loose: Sequence[shapely.LineString] = ()) -> list[tuple[int, int]]:
    lines = [line for whole in wholes for line in whole] + list(loose)
    number = [n for n, whole in enumerate(wholes) for _ in whole] + [LOOSE] * len(loose)
    polylines = Polylines.of(np.array(lines, dtype=object))
    copy, other = repeated_wholes(polylines, np.array(number, dtype=np.intp), coincide=0.0005)
    return sorted((number[a], number[b]) for a, b in zip(copy.tolist(), other.tolist(), strict=True))


@pytest.mark.parametrize("aside", [0.0, 0.0004, 0.002, 0.02, 0.05])
@pytest.mark.parametrize("copy", [WINDOW, MIRRORED, TURNED])
def test_every_line_of_a_copy_is_one(aside: float, copy: list[shapely.LineString]) -> None:
    found = repeated(placed(WINDOW, 0), placed(WINDOW, 5), placed(copy, aside))
    assert {frozenset(pair) for pair in found} == {frozenset((0, 2))}
    assert len(found) == len(WINDOW)
    assert len({pair[0] for pair in found}) == 1


@pytest.mark.parametrize("aside", [0.06, 0.3, 1.0, 1.031])
def test_what_stands_beside_is_no_copy(aside: float) -> None:
    assert repeated(placed(WINDOW, 0), placed(WINDOW, aside)) == []


def test_another_window_in_the_same_place_is_no_copy() -> None:
    crossed = [*WINDOW[:2], shapely.LineString([(0.06, 0.75), (0.94, 0.75)])]
    assert repeated(WINDOW, crossed) == []
    assert repeated(WINDOW, WINDOW[:2]) == []


def test_bars_side_by_side_are_no_copies() -> None:
    bars = [[shapely.box(n * 0.008, 0, n * 0.008 + 0.004, 1).exterior] for n in range(20)]
    assert repeated(*bars) == []


def test_loose_lines_are_of_no_whole() -> None:
    assert repeated(WINDOW, loose=placed(WINDOW, 0.002)) == []
    assert repeated(loose=WINDOW) == []


@given(st.permutations(range(6)), st.floats(-1e6, 1e6))
def test_order_and_place_change_no_number(order: list[int], far: float) -> None:
    wholes = [placed(WINDOW, far + x) for x in (0, 5, 10, 0.002, 5.02, 0.003)]
    assert len(repeated(*(wholes[n] for n in order))) == 3 * len(WINDOW)
