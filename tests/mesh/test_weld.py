# SPDX-License-Identifier: MIT
"""Vertices at one place, and near ones, against plain comparison."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.mesh.made import GEOREFERENCED

from foparq.columns import Coordinates
from foparq.mesh.weld import near, unreferenced, welded

coordinate = st.sampled_from([0.0, -0.0, 1.0, np.nextafter(1.0, 2.0), 7456789.123, 5e-324])
places = st.integers(0, 12).flatmap(lambda n: arrays(np.float64, (n, 3), elements=coordinate))


def plainly(points: Coordinates) -> list[int]:
    first: dict[tuple[float, ...], int] = {}
    return [first.setdefault(tuple(place), row) for row, place in enumerate(points.tolist())]


@given(places)
def test_equal_places_are_welded(points: Coordinates) -> None:
    assert welded(points).tolist() == plainly(points)


@given(places)
def test_places_of_like_keys_are_compared(points: Coordinates) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("foparq.mesh.weld.mixed", np.zeros_like)
        assert welded(points).tolist() == plainly(points)


def test_welding_many() -> None:
    rng = np.random.default_rng(3)
    places = rng.random((4000, 3)) + GEOREFERENCED
    points = places[rng.integers(0, 4000, 20000)]
    assert welded(points).tolist() == plainly(points)


@pytest.mark.parametrize("shift", [(0, 0, 0), GEOREFERENCED])
@pytest.mark.parametrize("coincide", [0.0, 0.01, 0.06])
def test_near_pairs_are_those_of_brute_force(shift: tuple[float, float, float], coincide: float) -> None:
    points = np.random.default_rng(4).random((400, 3)) + shift
    gap = np.linalg.norm(points[:, None] - points[None], axis=2)
    first, second = np.nonzero(np.triu(gap <= coincide, 1))
    found = near(points, coincide=coincide, most=10_000)
    assert found.complete
    assert found.total == len(first)
    assert (found.first.tolist(), found.second.tolist()) == (first.tolist(), second.tolist())
    assert found.distance == pytest.approx(gap[first, second], abs=1e-9)


def test_too_many_pairs_are_counted_and_every_vertex_keeps_its_nearest() -> None:
    points = np.random.default_rng(4).random((400, 3))
    gap = np.linalg.norm(points[:, None] - points[None], axis=2)
    found = near(points, coincide=0.2, most=100)
    assert not found.complete
    assert found.total == np.count_nonzero(np.triu(gap <= 0.2, 1))
    np.fill_diagonal(gap, np.inf)
    nearest = {tuple(sorted((row, int(gap[row].argmin())))) for row in range(400) if gap[row].min() <= 0.2}
    assert set(zip(found.first.tolist(), found.second.tolist(), strict=True)) == nearest


def test_a_pair_at_exactly_the_tolerance_is_near() -> None:
    found = near(np.array([[0.0, 0, 0], [0.25, 0, 0], [9, 9, 9]]), coincide=0.25, most=10)
    assert (found.first.tolist(), found.second.tolist(), found.distance.tolist()) == ([0], [1], [0.25])


def test_vertices_without_a_face() -> None:
    assert unreferenced(5, np.array([3, 0, 3])).tolist() == [1, 2, 4]
