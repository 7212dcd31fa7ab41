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
