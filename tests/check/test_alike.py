# SPDX-License-Identifier: MIT
"""Drawings of two facades that are one drawing, and such that are not."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.check.test_ties import NEAR, drawing, ground

from foparq.check.drawn.alike import alike_facades
from foparq.findings.ties import Alike
from foparq.model.drawing import Drawing
from foparq.model.items import Items

BOXES = np.cumsum(np.random.default_rng(4).uniform(0.4, 2.1, (20, 4)), axis=1).round(4)


def walls(boxes: np.ndarray, path: str, facade: str) -> Drawing:
    """Rectangles of a flat drawing, one item each, side by side."""
    shapes = np.array([shapely.box(*box).exterior for box in boxes], dtype=object)
    made = drawing(plane="xy", path=path)
    n = len(shapes)
    first = np.zeros(n, dtype=np.intp)
    ids = np.array([str(k) for k in range(n)], dtype=object)
    items = made.items.take(first)
    columns = {name: getattr(items, name) for name in Items.__dataclass_fields__} | {"geometry": shapes, "item": ids}
    return replace(made, items=Items(**columns), facade=facade)


def alike(one: np.ndarray, other: np.ndarray, facades: tuple[str, str] = ("N", "S")) -> tuple[Alike, ...]:
    drawings = (walls(one, "n.dxf", facades[0]), walls(other, "s.dxf", facades[1]))
    return alike_facades([ground(made) for made in drawings], within=NEAR.tie)


def apart(boxes: np.ndarray) -> np.ndarray:
    return boxes + np.arange(len(boxes))[:, None] * [7.0, 0, 7.0, 0]


@pytest.mark.parametrize("move", [0.0, 0.0004, 60.0, 4.2e5])
def test_a_copy_is_alike_wherever_it_stands(move: float) -> None:
    one = apart(BOXES)
    assert alike(one, one + move) == (Alike("n.dxf", "N", "s.dxf", "S", mirrored=False),)
    assert not alike(one, one + move, ("N", "n"))
    assert not alike(one, one + move, ("N", ""))


def test_a_mirrored_copy_is_alike() -> None:
    one = apart(BOXES)
    mirrored = one[:, [2, 1, 0, 3]] * [-1, 1, -1, 1] + [300, 2, 300, 2]
    assert alike(one, mirrored) == (Alike("n.dxf", "N", "s.dxf", "S", mirrored=True),)


@pytest.mark.parametrize(("changed", "same"), [(2, 1), (3, 0)])
def test_nine_tenths_of_the_vertices_are_the_bound(changed: int, same: int) -> None:
    one = apart(BOXES)
    other = one.copy()
    other[:changed] += 0.03
    assert len(alike(one, other + 50)) == same


@pytest.mark.parametrize(("off", "same"), [(1.9, 1), (2.1, 0)])
def test_vertices_are_the_same_up_to_twice_the_tolerance(off: float, same: int) -> None:
    """Boxes stay as they are but for every second one, which is moved: no shift brings all of them together."""
    one = apart(BOXES)
    other = one + np.where(np.arange(len(one)) % 2, off * NEAR.tie, 0.0)[:, None] * [1, 0, 1, 0]
    assert len(alike(one, other)) == same


def test_the_same_windows_at_other_places_are_no_copy() -> None:
    """One block for all: every line has its like in the other drawing, and the places differ."""
    window = np.array([0, 0, 1.2, 1.8])
    one, other = (
        np.array([window + np.tile([x, 3.0 * floor], 2) for floor in range(3) for x in np.cumsum(gaps)])
        for gaps in np.random.default_rng(8).uniform(1.8, 3.1, (2, 8))
    )
    assert not alike(one, other)
    assert alike(one, one + 9.0)
