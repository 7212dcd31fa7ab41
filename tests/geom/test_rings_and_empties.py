# SPDX-License-Identifier: MIT
"""Lines without vertices, rings whose teeth differ, clusters without a gap, and how much rounding may shift a place."""

import numpy as np
import pytest
import shapely
from tests.geom.aims import AIM

from foparq.geom.clusters import clusters
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.ends import classify_ends
from foparq.geom.extent import boxes_of, main_box
from foparq.geom.polylines import Polylines
from foparq.geom.rounding import EARTH, ROUNDING, slack_of

COINCIDE = 5e-4
A, B, NOTHING = "LINESTRING (0 0, 1 1)", "LINESTRING (5 0, 9 0)", "LINESTRING EMPTY"


def table(*lines: str) -> Polylines:
    return Polylines.of(np.array([shapely.from_wkt(line) for line in lines], dtype=object))


@pytest.mark.parametrize(
    ("lines", "groups"),
    [
        ((NOTHING, A), [0, 1]), ((A, NOTHING), [0, 1]), ((A, NOTHING, A), [0, 1, 0]), ((NOTHING, A, A), [0, 1, 1]),
        ((A, NOTHING, NOTHING, B, A), [0, 1, 2, 3, 0]), ((A, B, NOTHING), [0, 1, 2]),
    ],
)  # fmt: skip
def test_a_line_without_vertices_is_no_copy_of_a_neighbour(lines: tuple[str, ...], groups: list[int]) -> None:
    found = duplicate_groups(table(*lines), coincide=COINCIDE).tolist()
    same = [[found[i] == found[j] for j, other in enumerate(lines) if NOTHING not in (line, other)]
            for i, line in enumerate(lines)]  # fmt: skip
    known = [[groups[i] == groups[j] for j, other in enumerate(lines) if NOTHING not in (line, other)]
             for i, line in enumerate(lines)]  # fmt: skip
    assert same == known
    for i, line in enumerate(lines):
        assert line == NOTHING or all(found[i] != found[j] for j, other in enumerate(lines) if other == NOTHING)


def test_no_boxes_have_an_extent_of_nothing_and_a_box_that_of_itself() -> None:
    def of(*shapes: str) -> list[list[float]]:
        drawn = np.array([shapely.from_wkt(shape) for shape in shapes], dtype=object)
        return [corner.tolist() for corner in main_box(boxes_of(drawn))]

    assert of() == of(NOTHING) == of(NOTHING, "LINESTRING (0 0, 1 inf)") == [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    assert of("LINESTRING Z (5 0 7, 9 1 3)", NOTHING) == [[5.0, 0.0, 3.0], [9.0, 1.0, 7.0]]


def test_a_line_without_vertices_is_closed_and_has_no_ends() -> None:
    drawn = table(A, NOTHING, B)
    assert drawn.opening.tolist() == pytest.approx([np.sqrt(2), 0.0, 4.0])
    assert drawn.length.tolist() == pytest.approx([np.sqrt(2), 0.0, 4.0])
    assert set(classify_ends(drawn, AIM, coincide=COINCIDE, reach=0.01).line.tolist()) == {0, 2}


def saw(height: float) -> np.ndarray:
    """Ring of which one side is a saw with teeth of a height, metres; the other sides are straight."""
    x = np.linspace(0, 0.1, 41)
    teeth = np.column_stack([x, np.where(np.arange(41) % 2, height, 0.0)])
    return np.vstack([teeth, [[0.1, 0.2], [0.0, 0.2]]])


@pytest.mark.parametrize("start", [0, 1, 17, 30])
@pytest.mark.parametrize("way", [1, -1])
def test_rings_are_compared_vertex_by_vertex_wherever_they_start(start: int, way: int) -> None:
    # Every vertex is within 0.4 mm of its partner; along the saw one ring is 7 mm longer than the other.
    one, two = saw(0.001), np.roll(saw(0.0014), start, axis=0)[::way]
    rings = [shapely.LineString(np.vstack([ring, ring[:1]])) for ring in (one, two)]
    assert abs(rings[0].length - rings[1].length) > 0.005
    assert duplicate_groups(Polylines.of(np.array(rings)), coincide=COINCIDE).tolist() == [0, 0]
    other = np.roll(saw(0.0016), start, axis=0)[::way]
    apart = [rings[0], shapely.LineString(np.vstack([other, other[:1]]))]
    assert duplicate_groups(Polylines.of(np.array(apart)), coincide=COINCIDE).tolist() == [0, 1]


def test_without_a_gap_only_what_touches_belongs_together() -> None:
    shapes = shapely.from_wkt(["POINT (0 0)", "POINT (0 0)", "POINT (1e-9 0)", "LINESTRING (0 0, -1 -1)"])
    assert clusters(shapes, gap=0.0).tolist() == [0, 0, 1, 0]


@pytest.mark.parametrize("size", [0.0, 1.0, 7.4e6, 3e7, 1e8])
def test_slack_covers_four_units_in_the_last_place(size: float) -> None:
    slack = slack_of(np.array([[size, 0.0], [0.0, -size]]))
    assert slack == pytest.approx(ROUNDING + 4 * np.spacing(size), rel=1e-12)
    assert slack_of(np.array([[0.0, -size]])) == slack


def test_what_lies_beyond_the_earth_makes_nothing_vague() -> None:
    assert slack_of(np.array([[1.0, 2.0], [EARTH * 1.001, 0.0], [1e300, 0.0]])) == slack_of(np.array([[1.0, 2.0]]))
