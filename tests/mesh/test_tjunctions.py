# SPDX-License-Identifier: MIT
"""Vertices on foreign borders, and spikes."""

import numpy as np
import pytest
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, box, moved, plate, sphere, turn

from foparq.columns import Index
from foparq.mesh.edges import edges
from foparq.mesh.spikes import Cones, cones, edge_lengths, spikes
from foparq.mesh.tjunctions import TJunctions, t_junctions
from foparq.mesh.weld import welded


def found(of: Mesh, coincide: float, vertices: Index | None = None) -> TJunctions:
    return t_junctions(
        of.points, of.corners, of.starts, edges(of.corners, of.starts), coincide=coincide, vertices=vertices
    )


def half_split() -> Mesh:
    """A square beside two half ones, so that a vertex lies on its side."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0.5, 0), (2, 0, 0), (2, 0.5, 0), (2, 1, 0)]
    return mesh(points, [[0, 1, 2, 3], [1, 5, 6, 4], [4, 6, 7, 2]])


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
def test_a_vertex_on_the_side_of_a_neighbour(shift: tuple[float, float, float]) -> None:
    base = half_split()
    of = mesh(base.points @ turn(1).T + shift, base.lists())
    at = found(of, 1e-6)
    table = edges(of.corners, of.starts)
    assert at.vertex.tolist() == [4]
    assert (table.tail[at.edge].tolist(), table.head[at.edge].tolist()) == ([1], [2])
    assert at.share == pytest.approx([0.5])
    assert at.distance == pytest.approx([0], abs=1e-8)


def test_a_vertex_without_a_place_that_nothing_uses_hides_none() -> None:
    points = np.concatenate([half_split().points, [[np.nan, 0, np.inf]]])
    assert found(mesh(points, half_split().lists()), 1e-6).vertex.tolist() == [4]


def test_within_and_beyond_the_tolerance() -> None:
    points = half_split().points.copy()
    points[4, 0] = 1.25
    of = mesh(points, half_split().lists())
    assert found(of, 0.25).vertex.tolist() == [4]
    assert found(of, 0.25).distance.tolist() == [0.25]
    assert not len(found(of, np.nextafter(0.25, 0)).vertex)


def test_a_vertex_near_an_end_of_an_edge_is_no_t_junction() -> None:
    points = half_split().points.copy()
    points[4] = (1, 0.01, 0)
    of = mesh(points, half_split().lists())
    assert not len(found(of, 0.01).vertex)
    assert found(of, 0.0099).vertex.tolist() == [4]


def test_the_tip_of_a_flat_face_is_no_t_junction_with_its_own_base() -> None:
    assert not len(found(mesh([(0, 0, 0), (2, 0, 0), (1, 0.001, 0)], [[0, 1, 2]]), 0.01).vertex)


@pytest.mark.parametrize("base", [sphere(3), box(6), plate(12, 12, [(3, 3), (4, 4)])])
def test_sound_surfaces_have_none(base: Mesh) -> None:
    assert not len(found(base, 1e-3).vertex)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("chunk", [2**20, 50])
def test_pairs_are_those_of_brute_force(seed: int, chunk: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foparq.mesh.tjunctions._PAIRS", chunk)
    rng = np.random.default_rng(seed)
    count = 60
    # Triangles of very different size.
    size = 10 ** rng.uniform(-2, 0, (count, 1, 1))
    points = (rng.random((count, 1, 3)) + size * rng.normal(size=(count, 3, 3))).reshape(-1, 3) * (1, 1, 0.05)
    of = mesh(points, np.arange(3 * count).reshape(-1, 3).tolist())
    coincide = 0.02
    table = edges(of.corners, of.starts)
    expected = []
    for vertex in range(3 * count):
        for edge in range(len(table.tail)):
            a, b, p = points[table.tail[edge]], points[table.head[edge]], points[vertex]
            t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            away = np.linalg.norm(p - a - t * (b - a))
            ends = min(np.linalg.norm(p - a), np.linalg.norm(p - b))
            if away <= coincide and ends > coincide and vertex // 3 != table.tail[edge] // 3:
                expected.append((vertex, edge))
    at = found(of, coincide)
    assert list(zip(at.vertex.tolist(), at.edge.tolist(), strict=True)) == expected
    some = np.arange(0, 3 * count, 2)
    part = found(of, coincide, some)
    assert list(zip(part.vertex.tolist(), part.edge.tolist(), strict=True)) == [p for p in expected if p[0] % 2 == 0]


def test_columns_of_different_fineness_meet_in_t_junctions() -> None:
    # One plate of cells 0.4 m high, another beside it of cells half as high.
    coarse, fine = plate(3, 10, []), plate(3, 20, [])
    points = np.concatenate([coarse.points, fine.points * (1, 1, 0.5) + (1.5, 0, 0)])
    faces = coarse.lists() + [[v + len(coarse.points) for v in face] for face in fine.lists()]
    of = mesh(points, faces)
    of = Mesh(of.points, welded(of.points)[of.corners], of.starts)
    assert len(found(of, 1e-6).vertex) == 10
    assert len(found(moved(of, seed=1, rotate=True, shift=GEOREFERENCED), 1e-6).vertex) >= 10


def seen(of: Mesh) -> Cones:
    return cones(of.points, edges(of.corners, of.starts))


def found_spikes(of: Mesh) -> list[int]:
    table = edges(of.corners, of.starts)
    height = 5 * float(np.median(edge_lengths(of.points, table)))
    return spikes(cones(of.points, table), opening=np.radians(20), height=height).tolist()


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
def test_planted_spikes_are_found(shift: tuple[float, float, float]) -> None:
    for base, outward in ((sphere(4), True), (box(16), False)):
        table = edges(base.corners, base.starts)
        edge = float(np.median(edge_lengths(base.points, table)))
        rows = [17, 200, 431]
        points = base.points.copy()
        middle = np.array([0.0, 0, 0]) if outward else np.array([0.5, 0.5, 0.5])
        for row in rows:
            away = points[row] - middle
            points[row] += 12 * edge * away / np.linalg.norm(away) * (1 if outward else -1)
        of = mesh(points, base.lists())
        if outward:
            assert found_spikes(of) == rows
        moved_of = moved(of, seed=3, rotate=True, shift=shift)
        assert len(found_spikes(moved_of)) == len(found_spikes(of)) >= 2


def test_openings_are_the_known_ones() -> None:
    corner = seen(box(1))
    assert corner.opening == pytest.approx([2 * np.arccos(1 / np.sqrt(3))] * 8)
    assert corner.height == pytest.approx([1 / np.sqrt(3)] * 8)
    flat = seen(plate(3, 3, []))
    assert np.count_nonzero(flat.inner) == 4
    assert (flat.opening[flat.inner] >= np.pi - 1e-6).all()
    assert np.isnan(flat.opening[~flat.inner]).all()


@pytest.mark.parametrize("sides", [4, 6, 8])
def test_a_cone_of_known_opening(sides: int) -> None:
    angle = np.arange(sides) * 2 * np.pi / sides
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    points = np.concatenate([ring, [[0, 0, 9.0], [0, 0, 0]]])
    faces = [[k, (k + 1) % sides, sides] for k in range(sides)] + [
        [(k + 1) % sides, k, sides + 1] for k in range(sides)
    ]
    of = seen(mesh(points, faces))
    assert of.opening[sides] == pytest.approx(2 * np.arctan(1 / 9))
    assert of.height[sides] == pytest.approx(9)
    # The fan that closes it below is flat.
    assert of.opening[sides + 1] >= np.pi - 1e-6


def test_buildings_have_no_spikes() -> None:
    # A roof like a pyramid, a spire on a tower, a cylinder with fans for caps, a cube.
    ring = np.arange(24) * np.pi / 12
    circle = np.stack([np.cos(ring), np.sin(ring)], axis=1)
    cylinder = mesh(
        np.concatenate([np.insert(circle, 2, 0.0, axis=1), np.insert(circle, 2, 9.0, axis=1), [[0, 0, 0], [0, 0, 9]]]),
        [[k, (k + 1) % 24, 24 + (k + 1) % 24, 24 + k] for k in range(24)]
        + [[(k + 1) % 24, k, 48] for k in range(24)] + [[24 + k, 24 + (k + 1) % 24, 49] for k in range(24)],
    )  # fmt: skip
    base = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    walls = [[k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k] for k in range(4)] + [[3, 2, 1, 0]]
    for tip in (13.0, 40.0):
        points = [*base, *((x, y, 10.0) for x, y, _ in base), (2, 2, tip)]
        house = mesh(points, [*walls, *([4 + k, 4 + (k + 1) % 4, 8] for k in range(4))])
        assert not found_spikes(house)
    assert not found_spikes(cylinder)
    assert not found_spikes(box(1))
    assert not found_spikes(plate(5, 5, []))
