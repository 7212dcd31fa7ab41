# SPDX-License-Identifier: MIT
"""What geometries are made of: parts, rings, finite coordinates."""

from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from foparq.geom.parts import is_finite, rings_of, single_parts, without_empty_holes

SQUARE, HOLE = [(0, 0), (9, 0), (9, 9), (0, 9)], [(1, 1), (1, 2), (2, 2), (2, 1)]


def column(*shapes: Any) -> NDArray[np.object_]:
    made = np.empty(len(shapes), dtype=object)
    with np.errstate(invalid="ignore"):
        made[:] = [shapely.from_wkt(shape) if isinstance(shape, str) else shape for shape in shapes]
    return made


def test_single_parts_are_all_that_is_drawn_with_the_rows_they_come_from() -> None:
    parts, owner = single_parts(
        column(
            None, "POINT EMPTY", "LINESTRING EMPTY", "POINT (1 2)", "MULTIPOINT (3 4, 5 6)",
            "GEOMETRYCOLLECTION (POINT EMPTY, GEOMETRYCOLLECTION (MULTILINESTRING ((0 0, 1 1), EMPTY), POINT (7 8)))",
            "GEOMETRYCOLLECTION EMPTY", "POLYGON ((0 0, 1 0, 1 1, 0 0))", "POLYGON EMPTY",
            "LINEARRING (0 0, 1 0, 1 1, 0 0)",
        )
    )  # fmt: skip
    assert [part.wkt for part in parts] == [
        "POINT (1 2)", "POINT (3 4)", "POINT (5 6)", "LINESTRING (0 0, 1 1)", "POINT (7 8)",
        "POLYGON ((0 0, 1 0, 1 1, 0 0))", "LINEARRING (0 0, 1 0, 1 1, 0 0)",
    ]  # fmt: skip
    assert owner.tolist() == [3, 4, 4, 5, 5, 7, 9]
    for nothing in (column(), column(None), column("POLYGON EMPTY")):
        assert [len(found) for found in single_parts(nothing)] == [0, 0]


def test_rings_are_those_with_vertices() -> None:
    rings, owner = rings_of(
        column(shapely.Polygon(SQUARE, [HOLE]), "POLYGON EMPTY", shapely.Polygon(SQUARE, [[]]), shapely.Polygon(SQUARE))
    )
    assert owner.tolist() == [0, 0, 2, 3]
    assert shapely.area(shapely.polygons(rings)).tolist() == [81, 1, 81, 81]


@pytest.mark.parametrize("holes", [[], [HOLE], [[]], [HOLE, []], [[], HOLE], [[], []]])
def test_an_empty_hole_is_left_out_and_everything_else_stays(holes: list[list[tuple[float, float]]]) -> None:
    given = column("POLYGON ((5 5, 6 5, 6 6, 5 5))", shapely.Polygon(SQUARE, holes), "POLYGON EMPTY")
    found = without_empty_holes(given)
    kept = [hole for hole in holes if hole]
    assert shapely.get_num_interior_rings(found).tolist() == [0, len(kept), 0]
    assert found[1].equals_exact(shapely.Polygon(SQUARE, kept), 0)
    assert found[0] is given[0]
    assert shapely.get_num_interior_rings(given)[1] == len(holes)


def test_coordinates_in_the_plane_are_finite_or_not() -> None:
    shapes = column(
        "POINT (1 2)", "LINESTRING (0 0, NaN 1)", "LINESTRING (0 0, 1 NaN)", shapely.LineString([(0, 0), (np.inf, 1)]),
        "LINESTRING Z (0 0 NaN, 1 1 2)", None, "POINT EMPTY", "MULTIPOINT (0 0, 1 -7)",
    )  # fmt: skip
    assert is_finite(shapes).tolist() == [True, False, False, False, True, True, True, True]
