# SPDX-License-Identifier: MIT
"""Intersecting triangles of whole meshes, against rational arithmetic over all pairs and against known answers."""

import json
from pathlib import Path

import numpy as np
import pytest
from tests.mesh import exact
from tests.mesh.meshes import Mesh, icosphere, plate, read, two_spheres

from foparq.mesh import intersections as module
from foparq.mesh.intersections import Intersections, intersections
from foparq.mesh.trianglepairs import Meeting

UTM = np.array([712345.678, 7456789.123, 812.5])
PLENTY = 10**6


def told(found: Intersections) -> dict[tuple[int, int], int]:
    return dict(zip(zip(found.first.tolist(), found.second.tolist(), strict=True), found.kind.tolist(), strict=True))


def agree(points: np.ndarray, corners: np.ndarray) -> Intersections:
    """The same pairs, kinds and places as all pairs in rational arithmetic."""
    found = intersections(points, corners, keep=PLENTY)
    known = exact.all_pairs(points, corners)
    assert told(found) == {pair: kind for pair, (kind, _) in known.items()}
    assert found.total == len(known)
    assert found.counts.tolist() == np.bincount([kind for kind, _ in known.values()], minlength=5).tolist()
    extent = np.abs(points - points.min(axis=0)).max(initial=0.0)
    for k, (_, met) in enumerate(known[pair] for pair in told(found)):
        apart = np.linalg.norm(met[:, None] - found.segment[k], axis=2)
        rounding = 4e-15 * extent + 4e-16 * np.abs(points).max(initial=0.0)
        length = float(np.linalg.norm(found.segment[k, 1] - found.segment[k, 0]))
        assert length == pytest.approx(np.linalg.norm(met[:, None] - met, axis=2).max(), abs=rounding)
        assert apart.min(axis=0).max() <= rounding
    return found


def random_mesh(kind: str, rng: np.random.Generator) -> Mesh:
    points = rng.integers(0, 4, size=(rng.integers(5, 26), 3)).astype(float)
    n = len(points)
    corners = np.array([rng.choice(n, 3, replace=False) for _ in range(26)], dtype=np.intp)
    if kind == "general":
        points = rng.normal(size=(n, 3))
    elif kind == "flat":
        points[:, 2] = 0
    elif kind == "slanted plane":
        points[:, 1:] = points[:, 1:] / 10 + 0.3
        points[:, 0] = points[:, 1]
    elif kind == "nearly flat":
        points += rng.normal(size=points.shape) * 1e-17
        points[:, 2] *= 1e-15
    elif kind == "unwelded":
        points, corners = points[corners].reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3)
    elif kind == "edges of many faces":
        corners[:, :2] = np.sort(rng.integers(0, 2, size=len(corners)))[:, None] * 2 + [0, 1]
        corners[:, 2] = rng.integers(4, n, size=len(corners))
    elif kind == "repeated faces":
        corners = np.concatenate([corners[:14], rng.permuted(corners[:14], axis=1)])
    elif kind == "repeated corners":
        corners[::3, 1] = corners[::3, 0]
    elif kind == "georeferenced":
        points = points / 8 + UTM
    return points, corners


KINDS = (
    "grid", "general", "flat", "slanted plane", "nearly flat", "unwelded", "edges of many faces", "repeated faces",
    "repeated corners", "georeferenced",
)  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_random_meshes_intersect_as_rational_arithmetic_says(kind: str) -> None:
    rng = np.random.default_rng([20261130, KINDS.index(kind)])
    total = sum(agree(*random_mesh(kind, rng)).total for _ in range(50))
    assert total > 100


@pytest.mark.parametrize(
    ("corners", "known"),
    [
        ([[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 1, 5]], {(0, 2): Meeting.FOLD}),
        ([[0, 1, 2], [2, 1, 0], [1, 2, 0]], {}),
        ([[0, 1, 2], [0, 1, 4], [4, 1, 0]], {(0, 1): Meeting.FOLD, (0, 2): Meeting.FOLD}),
    ],
    ids=["four faces on one edge, two of them folded", "a face three times", "a fold under a double face"],
)
def test_edges_of_many_faces_and_repeated_faces(corners: list[list[int]], known: dict[tuple[int, int], int]) -> None:
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 1, 1], [1, 1, 0], [0, -1, 0]], dtype=float)
    assert told(agree(points, np.array(corners))) == known


def shelf(name: str, *more: str) -> object:
    return pytest.param(name, *more, id=name)


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "kinds"),
    [
        # All contacts of not_convex.obj: 64 in a line, 56 in a point; of 36 common areas 12 lie beside a shared edge.
        shelf("trimesh_small/not_convex.obj", {Meeting.COPLANAR: 24, Meeting.CONTACT: 120, Meeting.FOLD: 12}),
        shelf("trimesh_small/soup.stl", {Meeting.TRANSVERSAL: 1248}),
        shelf("trimesh_small/multibody.stl", {}),
        shelf("trimesh_small/joined_tetrahedra.obj", {}),
        shelf("val3dity_small/twocubes.obj", {Meeting.FOLD: 3}),
        shelf("val3dity_small/basecube.obj", {}),
        shelf("val3dity_small/cube_tol_1.obj", None),
        shelf("val3dity_small/nonmanifold.obj", {}),
    ],
)
def test_small_meshes_of_the_shelf_intersect_as_known(
    shared: Path, name: str, kinds: dict[Meeting, int] | None
) -> None:
    found = agree(*read(shared / "data" / "mesh" / name))
    if kinds is not None:
        assert found.counts.tolist() == [kinds.get(kind, 0) for kind in Meeting]
    if name.endswith("not_convex.obj"):
        # Points are given twice.
        lines = np.linalg.norm(found.segment[:, 1] - found.segment[:, 0], axis=1) > 1e-9
        contact = found.kind == Meeting.CONTACT
        assert (int((contact & lines).sum()), int((contact & ~lines).sum())) == (64, 56)


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "pairs"),
    [
        shelf("manifold_selfintersect/self_intersectA.obj", 338),
        shelf("sceaux_openmvs/scene_mesh.ply", 8),
        shelf("sceaux_openmvs/scene_mesh_seams.ply", 8),
        shelf("sceaux_openmvs/scene_mesh_texture.ply", 8),
        shelf("trimesh_small/bunny.ply", 4),
        shelf("synth_two_spheres/two5.ply", 722),
        shelf("synth_defect_sphere/def5.ply", 0),
        shelf("demosthenes_bust/demosthenes-low-res.obj", 0),
        shelf("lion_statue/lionstatue.obj", 0),
    ],
)
def test_meshes_of_the_shelf_intersect_as_known(shared: Path, name: str, pairs: int) -> None:
    path = shared / "data" / "mesh" / name
    points, corners = read(path)
    expected = json.loads((path.parent / "expected.json").read_text(encoding="utf-8"))
    expected = expected.get(path.name, expected)
    listed = expected.get("selfint_pairs", expected.get("pairs"))
    for shift in (np.zeros(3), UTM):
        found = intersections(points + shift, corners, keep=PLENTY)
        if shift.any() and path.suffix == ".obj":
            continue  # their decimals fall on other doubles there
        assert found.total == pairs
        if listed is not None:
            assert sorted(told(found)) == sorted(map(tuple, listed))


def test_spheres_that_cross_do_so_along_a_circle() -> None:
    points, corners = two_spheres(4)
    found = intersections(points, corners, keep=PLENTY)
    assert found.total == len(found.first) > 300
    assert set(found.kind.tolist()) == {Meeting.TRANSVERSAL}
    half = len(corners) // 2
    assert (found.first < half).all()
    assert (found.second >= half).all()
    # The circle lies in the plane amid the centres; faces lie less than 2.3e-3 within their sphere.
    axis = np.array([0.5, 0.013, 0.027])
    across = (found.segment - axis / 2) @ axis / np.linalg.norm(axis)
    assert np.abs(across).max() < 0.012
    length = np.linalg.norm(found.segment[:, 1] - found.segment[:, 0], axis=1).sum()
    assert length == pytest.approx(2 * np.pi * np.sqrt(1 - axis @ axis / 4), rel=0.01)


def test_what_is_said_does_not_depend_on_order_threads_or_place(monkeypatch: pytest.MonkeyPatch) -> None:
    points, corners = two_spheres(3)
    monkeypatch.setattr(module, "_PART", 16)
    known = intersections(points, corners, keep=PLENTY, threads=1)
    rng = np.random.default_rng(2)
    for threads in (2, 3, 7):
        found = intersections(points, corners, keep=PLENTY, threads=threads)
        assert all(np.array_equal(one, two) for one, two in zip(known, found, strict=True))
    order, number = rng.permutation(len(corners)), rng.permutation(len(points))
    moved = np.empty_like(points)
    moved[number] = points
    shuffled = rng.permuted(number[corners[order]], axis=1)
    found = intersections(moved, shuffled, keep=PLENTY)
    pairs = np.sort(np.stack([order[found.first], order[found.second]], axis=1), axis=1)
    assert sorted(map(tuple, pairs.tolist())) == sorted(told(known))


@pytest.mark.parametrize("keep", [0, 1, 17, 100])
def test_what_is_kept_is_capped_and_what_is_counted_is_not(keep: int, monkeypatch: pytest.MonkeyPatch) -> None:
    points, corners = two_spheres(3)
    monkeypatch.setattr(module, "_PART", 4)
    monkeypatch.setattr(module, "_ROOM", 2)
    every = intersections(points, corners, keep=PLENTY)
    assert every.total == len(every.first) > keep
    some = [intersections(points, corners, keep=keep, threads=threads) for threads in (1, 2, 5)]
    for found in some:
        assert found.total == every.total
        assert len(found.first) == keep
        assert told(found).items() <= told(every).items()
        assert told(found) == told(some[0])


def test_one_bad_face_changes_nothing_of_the_others() -> None:
    points, corners = two_spheres(2)
    known = intersections(points, corners, keep=PLENTY)
    bad = np.array([[np.nan, 0, 0], [np.inf, 1, 0], [1e200, 0, 0], [1e-200, 0.1, 0], [1e80, -1e80, 1e80]])
    n = len(points)
    more = [[0, 1, n], [0, 1, n + 1], [0, n + 2, 1], [n + 3, 0, 1], [3, 3, 4], [5, 5, 5]]
    place = [0, 7, 100, 100, 200, 320]
    found = intersections(np.concatenate([points, bad]), np.insert(corners, place, more, axis=0), keep=PLENTY)
    rows = np.insert(np.arange(len(corners)), place, -1)
    assert rows[found.left_out].tolist() == [-1] * 6
    assert len(known.left_out) == 0
    old = {(int(rows[i]), int(rows[j])): kind for (i, j), kind in told(found).items()}
    assert old == told(known)


def test_a_far_corner_changes_nothing_of_the_others() -> None:
    points, corners = two_spheres(2)
    known = told(intersections(points, corners, keep=PLENTY))
    # A sound face that reaches far out, and ends away from the spheres.
    far = np.array([[5.0, 5.0, 5.0], [1e60, 2e60, 1e60], [1e60, 1e60, 2e60]])
    n = len(points)
    found = intersections(np.concatenate([points, far]), np.concatenate([corners, [[n, n + 1, n + 2]]]), keep=PLENTY)
    assert told(found) == known


@pytest.mark.parametrize("n", [0, 1, 2, 8, 9, 16, 17, 63, 64, 65, 129])
def test_every_number_of_faces_finds_every_pair(n: int) -> None:
    # Squares through which one long triangle passes: the last row, the first, or amid.
    points = np.array([[-1.0, 0.1, 0.2], [1000.0, 0.1, 0.2], [1000.0, 0.2, 0.25]])
    x = np.arange(n, dtype=float)
    disks = np.stack([np.stack([x, 0 * x + a, 0 * x + b], axis=1) for a, b in ((-1, -1), (2, -1), (-1, 2))], axis=1)
    corners = 3 + np.arange(3 * n).reshape(-1, 3)
    for at in {0, n // 2, n}:
        found = intersections(
            np.concatenate([points, disks.reshape(-1, 3)]), np.insert(corners, at, [0, 1, 2], axis=0), keep=PLENTY
        )
        assert found.total == n
        assert set(told(found)) == {(min(at, k), max(at, k)) for k in range(n + 1) if k != at}


@pytest.mark.parametrize("offset", [np.zeros(3), UTM])
def test_a_flat_plate_does_not_intersect_itself_and_a_doubled_one_does_everywhere(offset: np.ndarray) -> None:
    points, corners = plate(12)
    points = points + offset
    assert intersections(points, corners, keep=PLENTY).total == 0
    # The other diagonals: every cell has four overlaps of two halves, which share an edge.
    n = len(corners) // 2
    other = np.stack([corners[:n, 0], corners[:n, 1], corners[n:, 2]], axis=1)
    found = intersections(points, np.concatenate([corners, other]), keep=PLENTY)
    assert found.counts[Meeting.FOLD] == 2 * n


def test_no_faces_are_no_pairs() -> None:
    for points in (np.empty((0, 3)), np.full((4, 3), np.nan), np.zeros((4, 3))):
        found = intersections(points, np.empty((0, 3), dtype=np.intp), keep=PLENTY)
        assert (found.total, len(found.first), found.segment.shape) == (0, 0, (0, 2, 3))
    found = intersections(np.zeros((3, 3)), np.array([[0, 1, 2]]), keep=PLENTY)
    assert found.left_out.tolist() == [0]


def test_a_sphere_does_not_intersect_itself() -> None:
    points, corners = icosphere(4)
    assert intersections(points, corners, keep=PLENTY).total == 0
