# SPDX-License-Identifier: MIT
"""Points on linework, against distances that GEOS and plain geometry compute."""

import numpy as np
import pytest
import shapely

from foparq.match.linework import NOTHING, Footing, Linework, footing, stands_in_space


def lines(*texts: str) -> np.ndarray:
    return np.array([shapely.from_wkt(text) for text in texts], dtype=object)


def stand(points: list[tuple[float, float, float]], work: np.ndarray, within: float, *, deep: bool = False) -> Footing:
    return footing(np.array(points), Linework.of(work), within=np.full(len(points), within), deep=deep)


def test_a_point_on_a_vertex_on_a_line_and_beside_it() -> None:
    found = stand([(2, 0, 0), (1, 0, 0), (1, 0.5, 0)], lines("LINESTRING (0 0, 2 0, 2 3)"), 0.25)
    assert found.line.tolist() == [0, 0, NOTHING]
    assert found.distance.tolist() == [0, 0, 0.5]
    assert found.vertex.tolist() == [0, 1, np.inf]


def test_exactly_within_is_on() -> None:
    assert stand([(1, 0.25, 0)], lines("LINESTRING (0 0, 2 0)"), 0.25).line.tolist() == [0]
    assert stand([(1, np.nextafter(0.25, 1), 0)], lines("LINESTRING (0 0, 2 0)"), 0.25).line.tolist() == [NOTHING]


def test_depth_counts_where_it_is_asked_for() -> None:
    rising = lines("LINESTRING Z (0 0 0, 4 0 3)")
    assert stand([(2, 0, 1.5)], rising, 0.1, deep=True).distance.tolist() == [0]
    assert stand([(2, 0, 9)], rising, 0.1, deep=True).line.tolist() == [NOTHING]
    assert stand([(2, 0, 9)], rising, 0.1).line.tolist() == [0]
    # A point 1 beside the middle of a line in space is 1 from it, whatever the line's slope.
    assert stand([(2, 1, 1.5)], rising, 1.0, deep=True).distance.tolist() == [1]


def test_points_count_as_linework() -> None:
    found = stand([(5, 5, 0), (0, 0, 0)], lines("POINT (5 5)"), 0.5)
    assert (found.line.tolist(), found.vertex.tolist()) == ([0, NOTHING], [0, np.inf])


def test_of_lines_equally_near_the_first_and_else_the_nearest() -> None:
    work = lines("LINESTRING (0 1, 9 1)", "LINESTRING (0 -1, 9 -1)", "LINESTRING (0 3, 9 3)")
    assert stand([(4, 0, 0), (4, 2.75, 0)], work, 2.0).line.tolist() == [0, 2]


def test_nowhere_lies_nothing() -> None:
    found = stand([(np.nan, 0, 0), (np.inf, 0, 0)], lines("LINESTRING (0 0, 2 0)"), 1.0)
    assert (found.line.tolist(), found.distance.tolist()) == ([NOTHING] * 2, [np.inf] * 2)
    assert stand([(0, 0, 0)], lines(), 1.0).distance.tolist() == [np.inf]


@pytest.mark.parametrize("seed", range(5))
def test_distances_are_those_of_geos(seed: int) -> None:
    rng = np.random.default_rng(seed)
    work = np.array([shapely.LineString(rng.random((4, 2))) for _ in range(200)], dtype=object)
    points = np.column_stack([rng.random((100, 2)), np.zeros(100)])
    found = footing(points, Linework.of(work), within=np.full(100, 0.02), deep=False)
    truth = shapely.distance(shapely.points(points[:, :2])[:, None], work[None])
    assert found.distance == pytest.approx(truth.min(axis=1), abs=1e-12)
    on = truth.min(axis=1) <= 0.02
    assert (found.line != NOTHING).tolist() == on.tolist()
    assert found.line[on].tolist() == truth.argmin(axis=1)[on].tolist()


def test_many_vertices_are_looked_at_in_parcels(monkeypatch: pytest.MonkeyPatch) -> None:
    work = lines(*[f"LINESTRING ({n} 0, {n} 1, {n} 2)" for n in range(50)])
    points = [(n + 0.25, 1.5, 0.0) for n in range(50)]
    whole = stand(points, work, 0.8)
    monkeypatch.setattr("foparq.match.linework._AT_ONCE", 4)
    assert [column.tolist() for column in stand(points, work, 0.8)] == [column.tolist() for column in whole]


def test_a_drawing_stands_in_space_if_more_than_a_tenth_of_it_does() -> None:
    flat = [f"LINESTRING ({n} 0, {n} 1)" for n in range(9)]
    assert not stands_in_space(lines(*flat, "LINESTRING Z (0 0 5, 0 1 5)"))  # two of twenty
    assert stands_in_space(lines(*flat[1:], "LINESTRING Z (0 0 5, 0 1 5)"))  # two of eighteen
    assert not stands_in_space(lines())
