# SPDX-License-Identifier: MIT
"""Polygons cut in triangles: areas add up, no vertex is new, and every triangle lies inside."""

from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, box, sphere, turn

from foparq.columns import Reals
from foparq.mesh.shape import area_vectors
from foparq.mesh.triangulate import Triangulation, triangulate
from foparq.mesh.vectors import lengths

MANY = 1000


def cut(of: Mesh, most: int = MANY) -> Triangulation:
    return triangulate(of.points, of.corners, of.starts, most=most)


def check(of: Mesh, found: Triangulation, *, exact: float = 1e-9) -> None:
    """Area vectors of triangles add up to those of their faces, and their areas too: none is turned."""
    areas = area_vectors(of.points, found.triangles.ravel(), np.arange(0, found.triangles.size + 1, 3))
    whole = area_vectors(of.points, of.corners, of.starts)
    kept = np.setdiff1d(np.arange(of.faces), found.left)
    assert np.array_equal(np.unique(found.face), kept)
    assert np.all(np.diff(found.face) >= 0)
    for k in kept.tolist():
        part = found.face == k
        assert areas[part].sum(axis=0) == pytest.approx(whole[k], abs=exact)
        assert lengths(areas[part]).sum() == pytest.approx(np.linalg.norm(whole[k]), abs=exact)
        face = of.corners[of.starts[k] : of.starts[k + 1]].tolist()
        assert np.count_nonzero(part) == len(face) - 2
        assert set(found.triangles[part].ravel().tolist()) <= set(face)
        # The border of the triangles is the polygon: every other side is run there and back.
        sides = Counter((a, b) for t in found.triangles[part].tolist() for a, b in zip(t, [*t[1:], t[0]], strict=True))
        ring = Counter(zip(face, [*face[1:], face[0]], strict=True))
        inner = sides - ring
        assert not ring - sides
        assert all(inner[a, b] == inner[b, a] for a, b in inner)


def lifted(plane: Reals, seed: int, shift: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Reals:
    points: Reals = np.concatenate([plane, np.zeros((len(plane), 1))], axis=1) @ turn(seed).T + shift
    return points


def star(count: int, seed: int) -> Reals:
    rng = np.random.default_rng(seed)
    angle = (np.arange(count) + rng.uniform(-0.4, 0.4, count)) * 2 * np.pi / count
    return rng.uniform(0.2, 1, (count, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def comb(teeth: int) -> Reals:
    """A bar with teeth: every second corner is reflex."""
    top = [(x, y) for k in range(teeth) for x, y in ((k, 1.0), (k + 0.3, 3.0), (k + 0.6, 3.0), (k + 0.9, 1.0))]
    return np.array([(0.0, 0.0), (float(teeth), 0.0), *top[::-1]])


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
@pytest.mark.parametrize("seed", range(6))
def test_simple_polygons(seed: int, shift: tuple[float, float, float]) -> None:
    planes = [star(n, 31 * n + seed) for n in (3, 4, 5, 6, 8, 12, 40, 200)] + [comb(n) for n in (1, 2, 9)]
    points, faces, first = [], [], 0
    for plane in planes:
        assert shapely.Polygon(plane).is_valid
        points.append(lifted(plane, seed, shift))
        ring = list(range(first, first + len(plane)))
        faces.append(ring if seed % 2 else ring[::-1])
        first += len(plane)
    of = mesh(np.concatenate(points), faces)
    found = cut(of)
    assert not len(found.left)
    check(of, found, exact=1e-7 if any(shift) else 1e-12)


@given(st.integers(0, 10**6), st.integers(4, 14))
def test_polygons_on_a_grid_with_corners_on_their_sides(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    cells = shapely.union_all([shapely.box(x, y, x + 1, y + 1) for x, y in rng.integers(0, 4, (count, 2)).tolist()])
    for part in shapely.get_parts(cells).tolist():
        if part.interiors or not shapely.is_valid(part.exterior):
            continue
        plane = shapely.get_coordinates(shapely.segmentize(part.exterior, 1.0))[:-1]
        of = mesh(lifted(plane, 1) if seed % 2 else np.insert(plane, seed % 3, 0.0, axis=1), [list(range(len(plane)))])
        found = cut(of)
        if not seed % 2:
            assert not len(found.left)
        check(of, found)


def test_a_facade_with_openings_behind_bridges() -> None:
    outer = [(0.0, 0.0), (10, 0), (10, 6), (0, 6)]
    openings = [[(1 + 3 * k, 2.0), (1 + 3 * k, 4), (2.5 + 3 * k, 4), (2.5 + 3 * k, 2)] for k in range(3)]
    points = np.array([*outer, *(p for opening in openings for p in opening)])
    # From the corner to the first opening, from each opening to the next one, and back.
    ring = [0, 4, 5, 6, 8, 9, 10, 12, 13, 14, 15, 12, 10, 11, 8, 6, 7, 4, 0, 1, 2, 3]
    for shift in ((0.0, 0.0, 0.0), GEOREFERENCED):
        of = mesh(lifted(points, 3, shift), [ring])
        found = cut(of)
        assert not len(found.left)
        areas = area_vectors(of.points, found.triangles.ravel(), np.arange(0, found.triangles.size + 1, 3))
        assert lengths(areas).sum() == pytest.approx(60 - 3 * 3.0, abs=1e-6)
        check(of, found, exact=1e-6)


def test_no_triangle_is_without_area_where_corners_lie_on_a_side() -> None:
    plane = np.array([(0.0, 0), (1, 0), (2, 0), (3, 0), (3, 3), (2, 3), (1, 3), (0, 3), (0, 1)])
    found = cut(mesh(np.insert(plane, 1, 0.0, axis=1), [list(range(9))]))
    areas = lengths(area_vectors(np.insert(plane, 1, 0.0, axis=1), found.triangles.ravel(), np.arange(0, 22, 3)))
    assert len(areas) == 7
    assert areas.min() > 0.1
    assert areas.sum() == pytest.approx(9)


def test_triangles_pass_as_they_are() -> None:
    for of in (sphere(1), mesh([(0, 0, 0)] * 3, [[0, 1, 2], [1, 1, 2]])):
        found = cut(of)
        assert np.array_equal(found.triangles.ravel(), of.corners)
        assert found.face.tolist() == list(range(of.faces))
        assert not len(found.left)


def test_what_cannot_be_cut_is_left() -> None:
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (3, 0, 0)], dtype=float)
    bow, line, square = [0, 1, 3, 2], [0, 1, 4, 5], [0, 1, 2, 3]
    found = cut(mesh(points, [bow, square, line]))
    assert found.left.tolist() == [0, 2]
    assert found.face.tolist() == [1, 1]


def test_polygons_with_too_many_corners_are_left_unless_they_are_convex() -> None:
    plane = np.concatenate([star(12, 5), 5 * np.stack([np.cos(np.arange(9)), np.sin(np.arange(9))], axis=1)])
    circle = (12 + np.argsort(np.arange(9) % (2 * np.pi))).tolist()
    of = mesh(lifted(plane, 0), [list(range(12)), circle])
    assert cut(of, most=8).left.tolist() == [0]
    assert not len(cut(of, most=12).left)


def circle(count: int) -> Reals:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle), 0.3 * np.cos(angle)], axis=1)


@pytest.mark.parametrize("count", [64, 65, 66, 67, 128, 129, 1000])
@pytest.mark.parametrize("seed", [1, 2])
def test_large_convex_polygons_have_no_vertex_where_all_triangles_meet(count: int, seed: int) -> None:
    of = mesh(circle(count) @ turn(seed).T + np.array(GEOREFERENCED) * (seed - 1), [list(range(count))])
    found = cut(of, most=10)
    check(of, found, exact=1e-7)
    meeting = np.bincount(found.triangles.ravel()).max()
    assert meeting == count - 2 if count <= 64 else meeting <= 2 * np.log2(count) + 2


def test_a_large_polygon_of_stars_is_cut_or_left_by_its_number_of_corners() -> None:
    """From its first corner it is a fan, and it is not convex."""
    plane = np.concatenate([[(0.0, -5.0)], star(99, 4) + np.array([0.0, 1.0])])
    angle = np.arctan2(plane[1:, 1] + 5.0, plane[1:, 0])
    of = mesh(lifted(np.vstack([plane[:1], plane[1:][np.argsort(angle)]]), 0), [list(range(100))])
    check(of, cut(of))
    assert cut(of, most=99).left.tolist() == [0]


def test_faces_of_a_box_are_two_triangles_each() -> None:
    of = box(3)
    found = cut(of)
    check(of, found)
    assert np.bincount(found.face).tolist() == [2] * of.faces


def test_nothing() -> None:
    found = cut(mesh([], []))
    assert found.triangles.shape == (0, 3)
    assert not len(found.left)
