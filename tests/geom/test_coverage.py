# SPDX-License-Identifier: MIT
"""Areas of a coverage with overlaps and gaps of known size."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from foparq.geom.coverage import area_overlaps, coverage_gaps


def boxes(count: int, **changed: tuple[float, float, float, float]) -> list[shapely.Polygon]:
    """Unit squares of a grid, some of them moved by (left, bottom, right, top)."""
    made = []
    for x in range(count):
        for y in range(count):
            left, bottom, right, top = changed.get(f"b{x}{y}", (0, 0, 0, 0))
            made.append(shapely.box(x + left, y + bottom, x + 1 + right, y + 1 + top))
    return made


@pytest.mark.parametrize("offset", [0.0, 7.4e6])
@pytest.mark.parametrize("angle", [0, 33])
def test_known_overlap_and_gap(offset: float, angle: float) -> None:
    areas = boxes(4, b11=(0, 0, 0.02, 0), b22=(0.01, 0, 0, -0.03))
    areas = np.array(
        [affinity.translate(affinity.rotate(area, angle, origin=(0, 0)), offset, offset / 3) for area in areas]
    )
    overlaps = area_overlaps(areas, least=1e-4)
    assert [sorted(pair) for pair in zip(overlaps.larger, overlaps.smaller, strict=True)] == [[5, 9]]
    assert overlaps.area == pytest.approx([0.02], abs=1e-7)
    gaps = coverage_gaps(areas, coincide=1e-3, most=1.0)
    assert gaps.area == pytest.approx([0.01 + 0.03 - 0.01 * 0.03], abs=1e-6)
    assert gaps.first.tolist() == [10]  # the one that shrank bounds both arms


def test_place_inside_the_gap_is_covered_by_none() -> None:
    rng = np.random.default_rng(2)
    areas = np.array(boxes(6, **{f"b{x}{y}": tuple(rng.uniform(-0.04, 0.04, 4)) for x in range(6) for y in range(6)}))
    gaps = coverage_gaps(areas, coincide=1e-3, most=1.0)
    assert len(gaps.gap) > 3
    covered = shapely.union_all(areas)
    # Grown and shrunk corners may leave the gap by no more than the tolerance is wide.
    assert shapely.area(shapely.intersection(gaps.gap, covered)).max() < 1e-3**2
    distance = shapely.distance(areas[gaps.first], gaps.gap)
    assert distance.max() <= 1e-3


def test_courtyard_of_several_areas_is_a_gap_up_to_the_most_area() -> None:
    ring = [area for n, area in enumerate(boxes(3)) if n != 4]
    assert len(coverage_gaps(np.array(ring), coincide=1e-3, most=1.0).area) == 1
    assert len(coverage_gaps(np.array(ring), coincide=1e-3, most=0.99).area) == 0


@pytest.mark.parametrize(
    "areas", [[], ["POLYGON ((0 0, 1 0, 1 1, 0 0))"], ["POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 2, 2 2, 1 1))"]]
)
def test_one_area_neither_overlaps_nor_gapes(areas: list[str]) -> None:
    drawn = np.array([shapely.from_wkt(area) for area in areas], dtype=object)
    assert not len(area_overlaps(drawn, least=1e-6).area)
    assert not len(coverage_gaps(drawn, coincide=1e-3, most=9.0).area)


def test_sixty_equal_areas_overlap_in_pairs() -> None:
    found = area_overlaps(np.array([shapely.box(0, 0, 1, 1)] * 60), least=1e-4)
    assert len(found.area) == 60 * 59 / 2
    assert found.area == pytest.approx(np.ones(1770))


def test_nested_areas_have_the_inner_one_in_common() -> None:
    areas = np.array([shapely.box(-n, -n, n, n) for n in range(1, 501)])[::-1]
    found = area_overlaps(areas, least=1e-4)
    assert len(found.area) == 500 * 499 / 2
    assert np.all(found.smaller > found.larger)
    assert found.area == pytest.approx(shapely.area(areas[found.smaller]))
    assert shapely.equals(found.common, areas[found.smaller]).all()


CUP = "POLYGON ((0 0, 4 0, 4 3, 3 3, 3 1, 1 1, 1 3, 0 3, 0 0))"  # open above, 2 m wide and deep
LID = "POLYGON ((0 3, 4 3, 4 3.5, 0 3.5, 0 3))"


@pytest.mark.parametrize("swapped", [False, True])
def test_a_cup_and_its_lid_enclose_a_gap_between_the_larger_and_the_smaller(*, swapped: bool) -> None:
    order = [LID, CUP] if swapped else [CUP, LID]
    found = coverage_gaps(np.array([shapely.from_wkt(area) for area in order]), coincide=1e-3, most=4.0)
    assert found.area == pytest.approx([4.0], abs=1e-6)
    assert (order[found.first[0]], order[found.second[0]]) == (CUP, LID)


@pytest.mark.parametrize("last", range(5))
def test_of_several_areas_those_that_bound_most_of_a_gap_are_named(last: int) -> None:
    # Around a gap of 3 m by 2 m: below; left and right, of 4 and 8 m2; above in two parts, of 7 and 2 m2.
    around = [
        shapely.box(0, -1, 3, 0), shapely.box(-1, -1, 0, 3), shapely.box(3, -1, 5, 3), shapely.box(0, 2, 1, 9),
        shapely.box(1, 2, 3, 3),
    ]  # fmt: skip
    rolled = around[last:] + around[:last]
    found = coverage_gaps(np.array(rolled), coincide=1e-3, most=6.0)
    assert found.area == pytest.approx([6.0], abs=1e-6)
    # 3 m below; then 2 m at the left, the right and above, of which the largest area is named.
    assert [rolled[found.first[0]], rolled[found.second[0]]] == [around[0], around[2]]


@pytest.mark.parametrize("far", [[0], [2], [0, 3]])
def test_areas_beyond_the_earth_are_passed_over_and_the_others_keep_their_rows(far: list[int]) -> None:
    drawn = [shapely.from_wkt(LID), shapely.from_wkt(CUP)]
    for row in far:
        drawn.insert(row, shapely.box(1e15, 0, 2e15, 1e15))
    found = coverage_gaps(np.array(drawn), coincide=1e-3, most=4.0)
    assert [drawn[row].area for row in (found.first[0], found.second[0])] == [8.0, 2.0]
    assert found.area == pytest.approx([4.0], abs=1e-6)


def test_gaps_come_in_order_of_the_areas_that_bound_them() -> None:
    cups = [affinity.translate(shapely.from_wkt(area), x, 0) for x in (30, 20, 10) for area in (LID, CUP)]
    found = coverage_gaps(np.array(cups), coincide=1e-3, most=4.0)
    assert found.first.tolist() == [1, 3, 5]
    assert found.second.tolist() == [0, 2, 4]
    assert shapely.centroid(found.gap).tolist() == [shapely.Point(x, 2) for x in (32, 22, 12)]


@pytest.mark.parametrize(("beyond", "count"), [(0.0, 1), (1.0, 0)])
def test_what_reaches_to_the_end_of_the_earth_still_lies_on_it(beyond: float, count: int) -> None:
    # No grid has a place farther than a hundred thousand kilometres from its origin.
    for x, y in ((1e8 - 4, 0), (-1e8, 0), (0, 1e8 - 3.5), (0, -1e8)):
        by = (x + np.sign(x) * beyond, y + np.sign(y) * beyond)
        areas = np.array([affinity.translate(shapely.from_wkt(area), *by) for area in (CUP, LID)])
        assert len(coverage_gaps(areas, coincide=1e-3, most=4.1).area) == count
