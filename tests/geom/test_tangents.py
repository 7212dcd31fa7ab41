# SPDX-License-Identifier: MIT
"""Curves that touch share no stretch; lines that run along each other do."""

import numpy as np
import shapely

from foparq.geom.overlaps import line_overlaps
from foparq.geom.polylines import Polylines


def circle(x: float, y: float, radius: float) -> shapely.LineString:
    """Circle whose chords lie at most 0.05 mm from it."""
    count = int(np.ceil(np.pi / np.arccos(1 - 0.00005 / radius)))
    angle = np.linspace(0, 2 * np.pi, count + 1)
    return shapely.LineString(np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)]))


def pairs(*lines: shapely.LineString) -> int:
    shapes = np.array(lines, dtype=object)
    return len(line_overlaps(Polylines.of(shapes), np.zeros(len(shapes), dtype=bool), coincide=0.0005).length)


def test_circles_that_touch_from_outside() -> None:
    assert pairs(circle(0, 0, 1), circle(2, 0, 1)) == 0


def test_circles_that_touch_from_inside() -> None:
    assert pairs(circle(0, 0, 1), circle(0.5, 0, 0.5)) == 0


def test_a_circle_on_a_line() -> None:
    assert pairs(circle(0, 1, 1), shapely.LineString([(-3, 0), (3, 0)])) == 0


def test_a_line_that_runs_along_a_longer_one() -> None:
    assert pairs(shapely.LineString([(0, 0), (1, 0)]), shapely.LineString([(-3, 0), (3, 0)])) == 1


def test_an_arc_drawn_over_a_circle() -> None:
    whole = circle(0, 0, 1)
    part = shapely.LineString(shapely.get_coordinates(whole)[10:40])
    assert pairs(whole, part) == 1
