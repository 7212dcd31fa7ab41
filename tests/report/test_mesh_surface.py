# SPDX-License-Identifier: MIT
"""The surface that is shown of a mesh: how far it may differ from the delivered one."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree
from tests.mesh.files import mesh
from tests.mesh.made import GEOREFERENCED, box, sphere
from tests.report.mesh_records import mesh_of

from foparq.report.page.meshes.clusters import clustered
from foparq.report.page.meshes.surface import Shown, shown_of


def in_file(shown: Shown) -> np.ndarray:
    places: np.ndarray = shown.origin + shown.vertices * shown.size
    return places


def area(shown: Shown) -> float:
    a, b, c = (in_file(shown)[corner] for corner in shown.triangles.T)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
def test_a_small_mesh_is_shown_whole_to_half_a_step(shift: tuple[float, ...]) -> None:
    surface = sphere(4)
    points = surface.points + shift
    shown = shown_of(mesh_of(surface._replace(points=points)), 100_000)
    assert (len(shown.triangles), len(shown.steps)) == (5120, 2562)
    longest = float(np.ptp(points, axis=0).max())
    away, nearest = cKDTree(points).query(in_file(shown), p=np.inf)
    assert away.max() <= longest / 65_535 / 2 + 2e-9  # doubles at seven million are 1e-9 apart
    assert sorted(map(sorted, nearest[shown.triangles].tolist())) == sorted(map(sorted, surface.lists()))
    assert shown.cell == 0


def test_a_large_mesh_keeps_its_extent_and_moves_no_vertex_farther_than_a_cell() -> None:
    surface = sphere(6)
    points = surface.points * (1.0, 0.6, 0.3) + GEOREFERENCED
    shown = shown_of(mesh_of(surface._replace(points=points)), 5_000)
    assert 2_500 < len(shown.triangles) <= 5_000
    step = shown.size / 65_535
    for end in (np.min, np.max):
        assert np.abs(end(in_file(shown), axis=0) - end(points, axis=0)).max() <= step / 2 + 2e-9
    away, _ = cKDTree(in_file(shown)).query(points, p=np.inf)
    assert away.max() <= shown.cell * shown.size + step
    # An ellipsoid, by triangles between places of its own: they lie within it, and not far.
    assert 0.95 < area(shown) / area(shown_of(mesh_of(surface._replace(points=points)), 100_000)) <= 1.0


def test_what_stands_for_a_cell_is_a_vertex_of_the_mesh() -> None:
    surface = sphere(5)
    made = clustered(surface.points, surface.corners.reshape(-1, 3), 2_000)
    away, _ = cKDTree(surface.points).query(made.points)
    assert away.max() == 0
    away, _ = cKDTree(made.points).query(surface.points, p=np.inf)
    assert 0 < away.max() <= made.cell
    assert len(np.unique(np.sort(made.triangles, axis=1), axis=0)) == len(made.triangles) <= 2_000
    assert all(len(set(corners)) == 3 for corners in made.triangles.tolist())


def test_order_of_the_faces_does_not_matter_to_what_stays() -> None:
    surface = sphere(5)
    faces = surface.corners.reshape(-1, 3)
    turned = np.random.default_rng(3).permutation(faces)
    one, other = (clustered(surface.points, rows, 2_000) for rows in (faces, turned))
    assert (one.points == other.points).all()
    assert sorted(map(sorted, one.triangles.tolist())) == sorted(map(sorted, other.triangles.tolist()))


def test_polygons_are_shown_with_their_own_area() -> None:
    assert area(shown_of(mesh_of(box(3, (2.0, 1.0, 0.5))), 1_000)) == pytest.approx(7.0, rel=1e-4)
    # Two walls at a corner: from the first corner a fan would cross the empty part.
    corner = [(0, 0, 0), (3, 0, 0), (3, 1, 0), (1, 1, 0), (1, 3, 0), (0, 3, 0)]
    ell = mesh(np.roll(corner, -2, axis=0), [list(range(6))])
    assert area(shown_of(mesh_of(ell), 1_000)) == pytest.approx(5.0, rel=1e-4)


def test_a_heap_of_small_pieces_does_not_vanish(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    places = rng.uniform(0, 10, (20_000, 1, 3)) + rng.uniform(0, 0.01, (20_000, 3, 3))
    heap = mesh(places.reshape(-1, 3), np.arange(60_000).reshape(-1, 3).tolist())
    assert 100 < len(shown_of(mesh_of(heap), 1_000).triangles) <= 1_000
    # Where no size of cells is found that leaves enough, pieces are chosen evenly, and told.
    monkeypatch.setattr("foparq.report.page.meshes.clusters._TRIES", 0)
    shown = shown_of(mesh_of(heap), 1_000)
    assert shown.thinned
    assert 500 < len(shown.triangles) <= 1_000
    away, _ = cKDTree(heap.points).query(in_file(shown), p=np.inf)
    assert away.max() <= shown.size / 65_535 / 2 + 1e-12


@pytest.mark.parametrize("far", [1e6, 1e300])
def test_one_vertex_absurdly_far_away_does_not_make_the_mesh_a_dot(far: float) -> None:
    surface = sphere(3)
    points = surface.points.copy()
    points[7] = far
    shown = shown_of(mesh_of(surface._replace(points=points)), 100_000)
    around = sum(7 in face for face in surface.lists())
    assert shown.strays == around
    assert shown.size == pytest.approx(2.0, rel=0.02)
    assert len(shown.triangles) == 1280 - around


@pytest.mark.parametrize(
    ("points", "faces"),
    [
        ([], []),
        ([(0, 0, 0)] * 3, [[0, 1, 2]]),
        ([(0, 0, np.nan), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]]),
        ([(0, 0, 0), (1, 0, 0)], [[0, 1, 9]]),
        ([(-1.7e308, 0, 0), (1.7e308, 0, 0), (0, 1.7e308, 0)], [[0, 1, 2]]),
        ([(0, 0, 0), (5e-324, 0, 0), (0, 5e-324, 0)], [[0, 1, 2]]),
    ],
)
def test_what_has_no_extent_shows_nothing_or_itself(points: Any, faces: Any) -> None:
    with np.errstate(over="ignore", invalid="ignore"):
        shown = shown_of(mesh_of(mesh(points, faces)), 1_000)
    assert len(shown.triangles) <= 1
    assert np.isfinite(shown.origin).all()
    assert 0 < shown.size < np.inf
