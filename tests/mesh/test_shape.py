# SPDX-License-Identifier: MIT
"""Areas, thin faces, flatness and folds: analytic values and exact arithmetic."""

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, box, moved, plate, sphere, turn

from foparq.mesh.collinear import collinear_faces, null_sides
from foparq.mesh.edges import edges
from foparq.mesh.shape import area_vectors, flatness, folds, triangle_shapes
from foparq.mesh.vectors import lengths

FAR = [(0.0, 0.0, 0.0), GEOREFERENCED]


def vectors(of: Mesh) -> np.ndarray:
    return area_vectors(of.points, of.corners, of.starts)


@pytest.mark.parametrize("shift", FAR)
def test_area_of_polygons(shift: tuple[float, float, float]) -> None:
    for count in (3, 4, 5, 12):
        angle = np.arange(count) * 2 * np.pi / count
        points = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        of = mesh(points @ turn(count).T + shift, [list(range(count)), list(range(count))[::-1]])
        exact = count / 2 * np.sin(2 * np.pi / count) * turn(count)[:, 2]
        assert vectors(of) == pytest.approx(np.array([exact, -exact]), abs=1e-8)


@pytest.mark.parametrize("shift", FAR)
def test_area_vectors_of_a_closed_surface_add_up_to_nothing(shift: tuple[float, float, float]) -> None:
    for base in (sphere(3), box(5)):
        of = moved(base, seed=1, shift=shift, rotate=True)
        assert vectors(of).sum(axis=0) == pytest.approx([0, 0, 0], abs=1e-8)
    assert lengths(vectors(plate(5, 4, [(1, 1)]))).sum() == pytest.approx(19 * 0.2)


def test_faces_of_many_sizes_in_one_block(monkeypatch: pytest.MonkeyPatch) -> None:
    of = mesh(np.random.default_rng(0).random((40, 3)), [list(range(k, k + 3 + k % 4)) for k in range(30)])
    whole = vectors(of)
    monkeypatch.setattr("foparq.mesh.polygons._BLOCK", 7)
    monkeypatch.setattr("foparq.mesh.polygons.blocks.__kwdefaults__", {"most": 7})
    assert np.array_equal(vectors(of), whole)
    assert flatness(of.points, of.corners, of.starts).distance.shape == (30,)


def exactly_collinear(places: list[list[float]]) -> bool:
    exact = [[Fraction(x) for x in place] for place in places]
    for a, b, c in combinations(exact, 3):
        u, v = [x - y for x, y in zip(b, a, strict=True)], [x - y for x, y in zip(c, a, strict=True)]
        if any(u[k - 1] * v[k - 2] != u[k - 2] * v[k - 1] for k in range(3)):
            return False
    return True


whole = st.integers(-3, 3).map(float)
near_one = st.integers(-2, 2).map(lambda k: 1 + k * 2.0**-52)
georeferenced = st.integers(-4, 4).map(lambda k: 7456789.123 + k * 0.1)
extreme = st.sampled_from([0.0, 1e-200, -2e-200, 3e-200, 5e-324, 1e200, 2e200, -1e200, 1e300])
kinds = [
    st.lists(st.lists(kind, min_size=3, max_size=3), min_size=3, max_size=5)
    for kind in (whole, near_one, georeferenced, extreme)
]


@given(st.lists(st.one_of(*kinds), min_size=1, max_size=4))
def test_collinear_faces_are_those_of_fractions(faces: list[list[list[float]]]) -> None:
    points = [place for face in faces for place in face]
    number = iter(range(len(points)))
    of = mesh(points, [[next(number) for _ in face] for face in faces])
    assert collinear_faces(of.points, of.corners, of.starts).tolist() == [exactly_collinear(face) for face in faces]


@pytest.mark.parametrize("shift", [*FAR, (1e-3, 1e6, -1e6)])
def test_places_along_a_line_and_next_to_it(shift: tuple[float, float, float]) -> None:
    rng = np.random.default_rng(8)
    count = 3000
    base = rng.integers(-1000, 1000, (count, 3)) / 8.0 + np.round(np.array(shift) * 8) / 8
    step = rng.integers(-9, 10, (count, 3)) / 16.0
    points = np.stack([base, base + step, base + 3 * step], axis=1)
    beside = rng.random(count) < 0.5
    axis = rng.integers(0, 3, count)
    row = np.flatnonzero(beside)
    points[row, 2, axis[row]] = np.nextafter(points[row, 2, axis[row]], np.inf)
    of = mesh(points.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3).tolist())
    expected = [exactly_collinear(face) for face in points.tolist()]
    assert collinear_faces(of.points, of.corners, of.starts).tolist() == expected
    assert 0 < sum(expected) < count


@pytest.mark.parametrize("far", [False, True])
def test_places_whose_differences_and_products_are_rounded(far: bool) -> None:  # noqa: FBT001
    # Multiples of a short vector, of very different length: each place is exact, their differences are not.
    rng = np.random.default_rng(9)
    count = 4000
    bits, reach = (48, 20) if far else (50, 0)
    times = rng.integers(2 ** (bits - 1), 2**bits, (count, 3, 1)) * 2.0 ** rng.integers(
        -reach, reach + 1, (count, 3, 1)
    )
    points = times * rng.integers(-7, 8, (count, 1, 3))
    if not far:
        points[:, 0] = 0
    beside = np.flatnonzero(rng.random(count) < 0.5)
    axis = rng.integers(0, 3, len(beside))
    points[beside, 2, axis] = np.nextafter(points[beside, 2, axis], np.inf)
    of = mesh(points.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3).tolist())
    expected = [exactly_collinear(face) for face in points.tolist()]
    assert collinear_faces(of.points, of.corners, of.starts).tolist() == expected
    assert 0 < sum(expected) < count


def test_a_polygon_that_runs_there_and_back_is_collinear_and_a_bent_one_is_not() -> None:
    points = [(0, 0, 0), (1, 2, 3), (2, 4, 6), (0, 1, 0)]
    of = mesh(points, [[0, 1, 0, 2], [0, 1, 0, 3], [0, 0, 0], [1, 1, 2]])
    assert collinear_faces(of.points, of.corners, of.starts).tolist() == [True, False, True, True]
    assert null_sides(of.corners, of.starts).tolist() == [8, 9, 10, 11]


@pytest.mark.parametrize("base", [sphere(3), box(6), plate(6, 6, [])])
def test_sound_faces_are_not_collinear(base: Mesh) -> None:
    for of in (base, moved(base, seed=1, shift=GEOREFERENCED, rotate=True)):
        assert not collinear_faces(of.points, of.corners, of.starts).any()


@pytest.mark.parametrize("shift", FAR)
def test_needles_and_caps(shift: tuple[float, float, float]) -> None:
    height = np.sqrt(3) / 2
    points = [(0, 0, 0), (1, 0, 0), (0.5, height, 0), (8, 0, 0), (8, 1, 0), (4, 0.1, 0), (0, 0, 0)]
    of = np.array([[0, 1, 2], [4, 0, 3], [0, 3, 5], [0, 6, 1]])
    shapes = triangle_shapes(np.array(points) @ turn(1).T + shift, of)
    assert shapes.longest == pytest.approx([1, np.sqrt(65), 8, 1], abs=1e-8)
    assert shapes.shortest == pytest.approx([1, 1, np.hypot(4, 0.1), 0], abs=1e-8)
    assert shapes.cosine == pytest.approx([0.5, 0, (0.01 - 16) / (16 + 0.01), -1], abs=1e-8)
    assert shapes.side[1:].tolist() == [2, *shapes.side[2:3].tolist(), 0]
    assert shapes.corner[1:3].tolist() == [2, 2]


@given(st.permutations([0, 1, 2]), st.lists(st.tuples(*[st.floats(-1, 1)] * 3), min_size=3, max_size=3, unique=True))
def test_shapes_do_not_depend_on_the_first_corner(order: list[int], points: list[tuple[float, float, float]]) -> None:
    place = np.array(points)
    one, two = triangle_shapes(place, np.array([[0, 1, 2]])), triangle_shapes(place, np.array([order]))
    assert one.longest == pytest.approx(two.longest)
    assert one.shortest == pytest.approx(two.shortest)
    assert one.cosine == pytest.approx(two.cosine, abs=1e-7)


@pytest.mark.parametrize("shift", FAR)
def test_a_quadrangle_with_one_corner_up(shift: tuple[float, float, float]) -> None:
    # With one corner of a square up by h, all four are h / 4 from the middle plane, measured upright.
    h = 0.2
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, h), (0, 1, 0), (2, 0, 0)], dtype=float)
    of = mesh(points @ turn(2).T + shift, [[0, 1, 2, 3], [0, 1, 3], [0, 4, 1]])
    flat = flatness(of.points, of.corners, of.starts)
    normal = np.linalg.svd(points[:4] - points[:4].mean(axis=0))[2][2]
    expected = np.abs((points[:4] - points[:4].mean(axis=0)) @ normal).max()
    assert flat.distance == pytest.approx([expected, 0, 0], abs=1e-8)
    assert flat.distance[0] == pytest.approx(h / 4, rel=0.02)
    assert flat.corner[1:].tolist() == [4, 7]


def test_a_plane_polygon_is_plane_and_a_dent_is_found() -> None:
    angle = np.arange(24) * np.pi / 12
    points = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    of = mesh(points @ turn(2).T + GEOREFERENCED, [list(range(24))])
    assert flatness(of.points, of.corners, of.starts).distance[0] < 1e-8
    points[7, 2] = 0.05
    dent = mesh(points @ turn(2).T + GEOREFERENCED, [list(range(24))])
    found = flatness(dent.points, dent.corners, dent.starts)
    assert found.corner[0] == 7
    assert 0.04 < found.distance[0] < 0.05


@pytest.mark.parametrize("degrees", [0, 30, 90, 150, 179.9, 180])
@pytest.mark.parametrize("turned", [False, True])
def test_fold_between_two_faces(degrees: float, turned: bool) -> None:  # noqa: FBT001
    t = np.radians(degrees)
    points = np.array([(0, 0, 0), (0, 1, 0), (-1, 0, 0), (np.cos(t), 0.5, np.sin(t))]) @ turn(4).T
    second = [0, 3, 1] if not turned else [0, 1, 3]
    of = mesh(points, [[0, 1, 2], second])
    rows, angle = folds(edges(of.corners, of.starts), vectors(of), of.starts)
    table = edges(of.corners, of.starts)
    assert (table.tail[rows].tolist(), table.head[rows].tolist()) == ([0], [1])
    assert angle == pytest.approx([t], abs=1e-7)


def test_folds_of_a_box() -> None:
    of = moved(box(3), seed=2, rotate=True)
    _, angle = folds(edges(of.corners, of.starts), vectors(of), of.starts)
    assert np.count_nonzero(angle > 1) == 12 * 3
    assert angle[angle > 1] == pytest.approx(np.pi / 2)
    assert angle[angle <= 1] == pytest.approx(0, abs=1e-7)


def test_a_face_without_area_has_no_fold() -> None:
    of = mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0)], [[0, 1, 2], [1, 0, 3]])
    assert np.isnan(folds(edges(of.corners, of.starts), vectors(of), of.starts)[1]).tolist() == [True]


@pytest.mark.parametrize("power", [-400, 400, 1000])
def test_flatness_is_in_proportion_to_the_polygon_however_large_or_small(power: int) -> None:
    points = np.array([[0.1, 0, 0], [4, 0.2, 0], [4, 4, 0.7], [0, 5, 0.3], [-1, 2, 0.1]])
    corners, starts = np.arange(5), np.array([0, 5])
    expected = flatness(points, corners, starts)
    found = flatness(np.ldexp(points, power), corners, starts)
    assert found.corner.tolist() == expected.corner.tolist()
    assert np.ldexp(found.distance, -power) == pytest.approx(expected.distance, rel=1e-12)
