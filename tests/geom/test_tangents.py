# SPDX-License-Identifier: MIT
"""Curves that touch share no stretch; lines that run along each other do."""

import numpy as np
import pytest
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


def arc(x: float, y: float, radius: float, start: float, stop: float, sagitta: float = 0.00005) -> shapely.LineString:
    count = max(2, int(np.ceil(np.radians(stop - start) / (2 * np.arccos(1 - sagitta / radius)))))
    angle = np.radians(np.linspace(start, stop, count + 1))
    return shapely.LineString(np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)]))


@pytest.mark.parametrize("sagitta", [0.0001, 0.00005, 0.00001])
@pytest.mark.parametrize("radius", [0.05, 0.3, 1.0, 5.0])
def test_an_arch_that_springs_from_jambs_which_go_on(radius: float, sagitta: float) -> None:
    left = shapely.LineString([(-radius, -2), (-radius, 3)])
    right = shapely.LineString([(radius, -2), (radius, 3)])
    assert pairs(left, right, arc(0, 0, radius, 0, 180, sagitta)) == 0


@pytest.mark.parametrize("radius", [0.05, 0.3, 1.0])
def test_a_fillet_between_two_lines(radius: float) -> None:
    flat = shapely.LineString([(radius, 0), (3, 0)])
    upright = shapely.LineString([(0, radius), (0, 3)])
    assert pairs(flat, upright, arc(radius, radius, radius, 180, 270)) == 0


def test_a_line_that_runs_along_and_then_leaves_in_a_gentle_curve() -> None:
    wall = shapely.LineString([(0, 0), (3, 0)])
    bend = shapely.get_coordinates(arc(1, 2, 2, 270, 300))
    over = shapely.LineString(np.vstack([[(0.5, 0)], bend]))
    assert pairs(wall, over) == 1


def test_collinear_lines_that_overlap_in_part() -> None:
    assert pairs(shapely.LineString([(0, 0), (2, 0)]), shapely.LineString([(1.5, 0), (4, 0)])) == 1
