# SPDX-License-Identifier: MIT
"""Borders of surfaces: holes that touch, chains, sizes."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh, read
from tests.mesh.made import GEOREFERENCED, Planted, box, moved, plant, plate, sphere, turn, without

from foparq.mesh.borders import Borders, borders
from foparq.mesh.edges import edges
from foparq.mesh.holes import BorderSizes, border_sizes


def found(of: Mesh) -> Borders:
    return borders(of.points, of.corners, of.starts, edges(of.corners, of.starts))


def sizes(of: Mesh) -> BorderSizes:
    return border_sizes(of.points, found(of))


def lengths(of: Mesh) -> list[int]:
    """Number of edges of every border, sorted; a chain's is negative."""
    all_of = found(of)
    return sorted((np.diff(all_of.starts) * np.where(all_of.closed, 1, -1)).tolist())


@pytest.mark.parametrize("base", [sphere(4), box(16), plate(40, 40, [(3, 3), (3, 4), (9, 3), (20, 20)])])
@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
def test_planted_holes_and_fins(base: Mesh, shift: tuple[float, float, float]) -> None:
    before = lengths(base)
    planted: Planted = plant(base, each=6, seed=1)
    size = int(np.diff(base.starts)[0])
    expected = sorted([*before, *[-2] * 6, *[size] * 6, *[3] * 6])
    assert lengths(planted.mesh) == expected
    assert lengths(moved(planted.mesh, seed=3, rotate=True, shift=shift)) == expected


TOUCHING = {
    "two openings touch at a corner": ([(3, 3), (4, 4)], [4, 4]),
    "four openings around a cell": ([(3, 3), (5, 3), (4, 2), (4, 4)], [4, 4, 4, 4]),
    "openings like the white fields of a chessboard": (
        [(i, j) for i in range(1, 9) for j in range(1, 9) if (i + j) % 2], [4] * 32,
    ),
    "an opening of two cells touches one": ([(3, 3), (3, 4), (4, 5)], [4, 6]),
}  # fmt: skip


@pytest.mark.parametrize("name", TOUCHING)
@pytest.mark.parametrize("seed", range(4))
def test_openings_that_touch_are_loops_of_their_own(name: str, seed: int) -> None:
    openings, expected = TOUCHING[name]
    of = moved(plate(10, 10, openings), seed=seed, rotate=True, shift=GEOREFERENCED)
    assert lengths(of) == sorted([*expected, 40])


@pytest.mark.parametrize("seed", range(4))
def test_three_holes_around_a_vertex(seed: int) -> None:
    # Six triangles around a vertex, within a ring of six quadrangles; every second triangle is missing.
    angle = np.arange(6) * np.pi / 3
    circle = np.stack([np.cos(angle), np.sin(angle), 0.1 * np.cos(2 * angle)], axis=1)
    points = np.concatenate([[[0, 0, 0]], circle, 2 * circle])
    ring = [[1 + k, 7 + k, 7 + (k + 1) % 6, 1 + (k + 1) % 6] for k in range(6)]
    of = mesh(points, [*ring, *[[0, 1 + k, 1 + (k + 1) % 6] for k in (0, 2, 4)]])
    assert lengths(moved(of, seed=seed, rotate=True)) == [3, 3, 3, 6]


@pytest.mark.parametrize("seed", range(4))
def test_every_second_triangle_of_a_lattice(seed: int) -> None:
    # Three triangles and three holes at every inner vertex.
    n = 7
    points = [(i + j / 2, j * np.sqrt(3) / 2, 0.1 * np.sin(i + 2 * j)) for j in range(n + 1) for i in range(n + 1)]
    upright = [[j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i] for j in range(n) for i in range(n)]
    lower = [
        [j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i] for j in range(n) for i in range(n)
    ]
    kept = {(n - 1) * n + i for i in range(n)} | {j * n + n - 1 for j in range(n)}
    of = mesh(points, [*upright, *(lower[row] for row in sorted(kept))])
    assert lengths(moved(of, seed=seed, rotate=True)) == [3] * (n - 1) ** 2 + [4 * n]


def test_openings_behind_bridges_are_loops() -> None:
    outer = [(0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)]
    inner = [(1, 0, 1), (1, 0, 2), (2, 0, 2), (2, 0, 1)]
    face = [0, 1, 2, 3, 0, 4, 5, 6, 7, 4]
    assert lengths(mesh([*outer, *inner], [face])) == [4, 4]
    # Two plates that share the two vertices from which bridges lead, each to a triangle.
    points = np.random.default_rng(0).random((20, 3))
    plates = [[0, 2 + k, 1, 3 + k, 4 + k, 5 + k, 3 + k, 1, 6 + k, 0, 7 + k, 8 + k, 9 + k, 7 + k] for k in (0, 8)]
    assert lengths(mesh(points, plates)) == [3] * 4 + [4] * 2


def test_corners_twice_in_a_row_break_no_border() -> None:
    points = [(0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3), (-1, 0, 0), (-1, 0, -1)]
    assert lengths(mesh(points, [[0, 0, 1, 1, 2, 3]])) == [4]
    assert lengths(mesh(points, [[0, 0, 2, 1, 1, 3], [0, 0, 4, 1, 1, 5]])) == [4, 4]


def test_faces_that_touch_at_a_vertex_have_borders_of_their_own() -> None:
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (1, 1, 1), (2, 1, 1)]
    assert lengths(mesh(points, [[0, 1, 2], [0, 3, 4]])) == [3, 3]
    assert lengths(mesh(points, [[0, 1, 2], [0, 4, 3]])) == [3, 3]
    assert lengths(mesh(points, [[0, 1, 2], [0, 3, 4], [0, 5, 6]])) == [3, 3, 3]


def test_walls_that_meet_at_an_edge_have_chains() -> None:
    points = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (-1, 1, 0), (-1, 1, 1), (-1, -1, 0), (-1, -1, 1)]
    walls = [[0, 2, 3, 1], [0, 4, 5, 1], [0, 6, 7, 1]]
    assert lengths(mesh(points, walls)) == [-3, -3, -3]


def test_a_border_passes_a_face_that_is_there_twice() -> None:
    of = without(sphere(2), np.arange(320) == 100)
    faces = of.lists()
    hole = set(sphere(2).lists()[100])
    beside = next(row for row, face in enumerate(faces) if len(hole & set(face)) == 1)
    assert lengths(mesh(of.points, [*faces, faces[beside]])) == [3]


def test_a_strip_of_moebius_has_one_border() -> None:
    n = 9
    a, b = list(range(n)), list(range(n, 2 * n))
    faces = [[a[k], a[k + 1], b[k + 1], b[k]] for k in range(n - 1)] + [[a[-1], b[0], a[0], b[-1]]]
    angle = np.arange(n) * 2 * np.pi / n
    points = [
        (np.cos(t) * (2 + s * np.cos(t / 2)), np.sin(t) * (2 + s * np.cos(t / 2)), s * np.sin(t / 2))
        for s in (-1, 1) for t in angle
    ]  # fmt: skip
    assert lengths(mesh(points, faces)) == [2 * n]


def test_a_border_runs_with_its_sides_and_the_hole_lies_to_its_right() -> None:
    of = plate(3, 3, [(1, 1)])
    all_of = found(of)
    assert len(all_of.last) == 2
    middle = of.points.mean(axis=0)
    for start, stop in zip(all_of.starts[:-1], all_of.starts[1:], strict=True):
        place = of.points[all_of.vertices[start:stop]] - middle
        # The faces look along -y: counter-clockwise seen from there is a positive turn about -y.
        turned = -np.cross(place, np.roll(place, -1, axis=0))[:, 1].sum()
        assert bool(turned > 0) is bool(stop - start == 12)


@given(st.lists(st.lists(st.integers(0, 7), min_size=3, max_size=4), max_size=9))
def test_borders_hold_every_boundary_edge_once_and_pass_no_vertex_twice(faces: list[list[int]]) -> None:
    of = mesh(np.random.default_rng(1).random((8, 3)), faces)
    table = edges(of.corners, of.starts)
    all_of = found(of)
    assert sorted(all_of.edges.tolist()) == table.boundary.tolist()
    lowest = []
    for k, (start, stop) in enumerate(zip(all_of.starts[:-1], all_of.starts[1:], strict=True)):
        vertices = [*all_of.vertices[start:stop].tolist(), int(all_of.last[k])]
        for edge, a, b in zip(all_of.edges[start:stop], vertices, vertices[1:], strict=False):
            assert {int(table.tail[edge]), int(table.head[edge])} == {a, b}
        assert len(set(vertices)) == len(vertices) - bool(all_of.closed[k])
        assert bool(all_of.closed[k]) == (vertices[0] == vertices[-1])
        lowest.append(int(all_of.edges[start:stop].min()))
        if all_of.closed[k]:
            assert all_of.edges[start] == lowest[-1]
            side = table.sides[table.starts[lowest[-1]]]
            assert of.corners[side] in vertices
    assert lowest == sorted(lowest)
    # A surface whose vertices have an even number of boundary edges each, all in loops, has no chain.
    assert sum(np.diff(all_of.starts)) == len(table.boundary)


def test_sizes_of_an_opening() -> None:
    of = plate(6, 6, [(2, 2), (3, 2)])
    for it in (of, moved(of, seed=2, rotate=True, shift=GEOREFERENCED)):
        all_of, size = found(it), sizes(it)
        hole = int(np.flatnonzero(np.diff(all_of.starts) == 6)[0])
        exact = 1e-9
        assert size.length[hole] == pytest.approx(2 * (1.0 + 0.4), abs=exact)
        assert size.diameter[hole] == pytest.approx(np.hypot(1.0, 0.4), abs=exact)
        assert size.area[hole] == pytest.approx(0.4, abs=exact)
        assert size.fan[hole] == pytest.approx(0.4, abs=exact)
        middle = np.array([1.5, 0, 1.0])
        expected = middle if it is of else turn(2) @ middle + GEOREFERENCED
        assert size.centroid[hole] == pytest.approx(expected, abs=exact)


def test_a_loop_that_is_not_plane() -> None:
    # The border of a saddle: its projection is the unit square, its fill is larger.
    points = [(0, 0, 0), (1, 0, 1), (1, 1, 0), (0, 1, 1)]
    size = sizes(mesh(points, [[0, 1, 2, 3]]))
    assert size.area[0] == pytest.approx(1.0)
    assert size.fan[0] == pytest.approx(4 * 0.5 * np.linalg.norm(np.cross((1, 0, 1), (0.5, 0.5, 0.5))))
    assert size.diameter[0] == pytest.approx(np.sqrt(2))


def test_a_chain_has_no_area() -> None:
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 2)]
    of = mesh(points, [[0, 1, 2], [1, 0, 3], [0, 1, 4]])
    size = sizes(of)
    assert np.isnan(size.area).all()
    assert sorted(size.length) == pytest.approx(sorted([1 + np.sqrt(2), 1 + np.sqrt(2), 2 + np.sqrt(5)]))
    assert sorted(size.diameter) == pytest.approx(sorted([np.sqrt(2), np.sqrt(2), np.sqrt(5)]))


def polygon(count: int, seed: int) -> Mesh:
    angle = np.sort(np.random.default_rng(seed).random(count)) * 2 * np.pi
    points = np.stack([np.cos(angle), 2 * np.sin(angle), 0.3 * np.cos(3 * angle)], axis=1) @ turn(seed)
    return mesh(points, [list(range(count))])


@pytest.mark.parametrize("count", [3, 5, 8, 9, 100, 1024])
def test_diameters_are_those_of_brute_force(count: int) -> None:
    of = polygon(count, count)
    brute = np.linalg.norm(of.points[:, None] - of.points[None], axis=2).max()
    assert sizes(of).diameter[0] == pytest.approx(brute, rel=1e-12)


def test_the_diameter_of_a_long_border_is_near_to_that_of_brute_force() -> None:
    of = polygon(3000, 1)
    brute = np.linalg.norm(of.points[:, None] - of.points[None], axis=2).max()
    assert 0.996 * brute <= sizes(of).diameter[0] <= brute * (1 + 1e-12)


def test_no_border() -> None:
    closed = sizes(sphere(1))
    assert [len(column) for column in closed] == [0] * 5


@pytest.mark.shared
def test_known_borders(shared: Path) -> None:
    folder = shared / "data" / "mesh"
    names = ("demosthenes_bust/demosthenes-low-res.obj", "lion_statue/lionstatue.obj", "sceaux_openmvs/scene_mesh.ply")
    assert [lengths(read(folder / name)) for name in names] == [[67], [322], [45]]
    assert lengths(read(folder / "synth_defect_sphere/def5.ply")) == [-2] * 10 + [3] * 11
    bunny = found(read(folder / "trimesh_small/bunny.ply"))
    assert len(bunny.last) == 5
    # Holes beside faces that are there twice lack an edge and are chains.
    assert np.count_nonzero(bunny.closed) == 3


@pytest.mark.shared
def test_borders_along_seams(shared: Path) -> None:
    of = read(shared / "data" / "mesh" / "sceaux_openmvs/scene_mesh_seams.ply")
    all_of = found(of)
    assert all_of.closed.all()
    assert len(all_of.edges) == 2065
    # 136 pieces of border; each vertex that a piece passes a second time may cut a loop off it.
    ends = np.bincount(all_of.vertices)
    assert np.count_nonzero(ends > 1) == 23
    assert 136 <= len(all_of.last) <= 136 + (ends[ends > 1] - 1).sum()
