# SPDX-License-Identifier: MIT
"""Distances to meshes, against rational arithmetic over all triangles and against a sphere."""

from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.mesh.exact import Place, cross, dot, minus, places
from tests.mesh.meshes import icosphere

from foparq.mesh import distance as module
from foparq.mesh.bvh import hierarchy
from foparq.mesh.distance import nearest

UTM = np.array([712345.678, 7456789.123, 812.5])


def to_segment(point: Place, start: Place, end: Place) -> Fraction:
    """Square of the distance, in rational arithmetic."""
    along, step = minus(end, start), minus(point, start)
    length = dot(along, along)
    share = min(max(Fraction(dot(step, along), length), Fraction(0)), Fraction(1)) if length else Fraction(0)
    rest = minus(step, (share * along[0], share * along[1], share * along[2]))
    return Fraction(dot(rest, rest))


def to_triangle(point: Place, triangle: list[Place]) -> Fraction:
    """Square of the distance, in rational arithmetic."""
    a, b, c = triangle
    up = cross(minus(b, a), minus(c, a))
    edges = ((a, b), (b, c), (c, a))
    if any(up) and all(dot(cross(minus(end, start), minus(point, start)), up) >= 0 for start, end in edges):
        return Fraction(dot(minus(point, a), up) ** 2, dot(up, up))
    return min(to_segment(point, start, end) for start, end in edges)


def known_distances(
    points: NDArray[np.float64], corners: NDArray[np.intp], asked: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distances (q, n) of every place to every triangle."""
    whole, unit = places(np.concatenate([points, asked]))
    triangles = [[whole[k] for k in row] for row in corners.tolist()]
    squares = [[to_triangle(place, triangle) for triangle in triangles] for place in whole[len(points) :]]
    return np.array([[float(square / unit**2) ** 0.5 for square in row] for row in squares])


def scene(kind: str) -> tuple[NDArray[np.float64], NDArray[np.intp], NDArray[np.float64]]:
    rng = np.random.default_rng(20261130)
    points, asked = rng.normal(size=(40, 3)), rng.normal(size=(60, 3)) * 2
    corners = np.array([rng.choice(40, 3, replace=False) for _ in range(40)])
    if kind == "grid":
        points, asked = rng.integers(0, 4, size=(40, 3)).astype(float), rng.integers(-1, 5, size=(60, 3)).astype(float)
    elif kind == "needles":
        points = rng.normal(size=3) * rng.normal(size=(40, 1)) + rng.normal(size=(40, 3)) * 1e-7
        asked[::2] = points[rng.integers(0, 40, size=30)] + rng.normal(size=(30, 3)) * 1e-6
    elif kind == "lines and points":
        corners[::2, 1] = corners[::2, 0]
        corners[::4] = corners[::4, :1]
        points[30:] = points[:10] / 2 + points[10:20] / 2
        corners[1::4] = np.stack([np.arange(10), np.arange(30, 40), np.arange(10, 20)], axis=1)
    elif kind == "georeferenced":
        points, asked = points + UTM, asked + UTM
    elif kind == "on the mesh":
        share = rng.dirichlet([1, 1, 1], size=60)
        asked = np.einsum("ij,ijk->ik", share, points[corners[rng.integers(0, 40, size=60)]])
        asked[:20] = points[:20]
    elif kind == "far away":
        asked = asked * 1e6
    return points, corners, asked


@pytest.mark.parametrize(
    "kind",
    ["general", "grid", "needles", "lines and points", "georeferenced", "on the mesh", "far away"],
)
def test_distances_are_those_of_rational_arithmetic(kind: str) -> None:
    points, corners, asked = scene(kind)
    known = known_distances(points, corners, asked)
    found = nearest(points, hierarchy(points, corners), asked)
    extent = np.ptp(np.concatenate([points, asked]), axis=0).max()
    assert np.abs(found.distance - known.min(axis=1)).max() <= 1e-14 * extent
    # The triangle is the nearest, and the place lies on it as far away as it says.
    assert np.abs(known[np.arange(len(asked)), found.row] - known.min(axis=1)).max() <= 1e-14 * extent
    rounding = 4 * np.spacing(np.abs(points).max())
    assert np.abs(np.linalg.norm(found.place - asked, axis=1) - found.distance).max() <= rounding + 1e-15 * extent
    on = np.diagonal(known_distances(points, corners[found.row], found.place))
    assert on.max() <= rounding + 1e-14 * extent


def test_distances_to_a_sphere_are_those_to_its_centre_less_one() -> None:
    points, corners = icosphere(4)
    rng = np.random.default_rng(1)
    way = rng.normal(size=(3000, 3))
    way /= np.linalg.norm(way, axis=1)[:, None]
    radius = np.concatenate([rng.uniform(0.5, 2, 2900), np.full(100, 50.0)])
    found = nearest(points + UTM, hierarchy(points + UTM, corners), way * radius[:, None] + UTM)
    deep = 1 - np.linalg.norm(points[corners].mean(axis=1), axis=1).min()
    assert np.abs(found.distance - np.abs(radius - 1)).max() <= deep + 1e-8
    # Triangles are told apart by the direction.
    assert np.einsum("ij,ij->i", points[corners[found.row]].mean(axis=1), way).min() > 0.99


def test_what_is_said_does_not_depend_on_order_or_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    points, corners = icosphere(3)
    asked = np.random.default_rng(2).normal(size=(500, 3))
    monkeypatch.setattr(module, "_PART", 16)
    known = nearest(points, hierarchy(points, corners), asked, threads=1)
    for threads in (2, 5):
        found = nearest(points, hierarchy(points, corners, threads=threads), asked, threads=threads)
        assert all(np.array_equal(one, two) for one, two in zip(known, found, strict=True))
    order = np.random.default_rng(3).permutation(len(corners))
    found = nearest(points, hierarchy(points, corners[order]), asked[::-1])
    assert np.array_equal(found.distance[::-1], known.distance)


def test_of_two_triangles_at_one_place_the_first_is_told() -> None:
    points, corners = icosphere(1)
    twice = np.concatenate([corners, corners])
    asked = points[corners].mean(axis=1) * 1.5
    assert nearest(points, hierarchy(points, twice), asked).row.tolist() == list(range(len(corners)))


def test_a_place_that_is_no_place_changes_nothing_of_the_others() -> None:
    points, corners = icosphere(1)
    asked = np.array([[2.0, 0, 0], [np.nan, 0, 0], [0, np.inf, 0], [0, 0, 1e300], [0, 0, 3.0]])
    found = nearest(points, hierarchy(points, corners), asked)
    alone = nearest(points, hierarchy(points, corners), asked[[0, 4]])
    assert found.distance[[0, 4]].tolist() == alone.distance.tolist()
    assert np.isnan(found.distance[1:4]).all()
    assert np.isnan(found.place[1:4]).all()
    assert found.row[1:4].tolist() == [-1] * 3
    assert len(nearest(points, hierarchy(points, corners), np.empty((0, 3))).distance) == 0
