# SPDX-License-Identifier: MIT
"""Edges, fans, components and duplicates against plain counting, and against faults planted in known numbers."""

from collections import Counter, defaultdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, Planted, box, moved, plant, plate, sphere

from foparq.mesh.components import components, vertex_distance
from foparq.mesh.duplicates import duplicate_faces
from foparq.mesh.edges import Edges, edge_of_side, edges
from foparq.mesh.fans import fans
from foparq.mesh.shape import area_vectors
from foparq.mesh.vectors import lengths

VERTICES = 7
faces_of_any_kind = st.lists(st.lists(st.integers(0, VERTICES - 1), min_size=3, max_size=5), max_size=8)
simple_faces = st.lists(st.lists(st.integers(0, VERTICES - 1), min_size=3, max_size=5, unique=True), max_size=8)


def made(faces: list[list[int]]) -> Mesh:
    return mesh(np.random.default_rng(0).random((VERTICES, 3)), faces)


def table(of: Mesh) -> Edges:
    return edges(of.corners, of.starts)


def sides(face: list[int]) -> list[tuple[int, int]]:
    return [(a, b) for a, b in zip(face, [*face[1:], face[0]], strict=True) if a != b]


def bounding(faces: list[list[int]]) -> dict[frozenset[int], list[tuple[int, int, int]]]:
    """Sides (face, from, to) of every edge; a face that runs there and back does not bound."""
    found: dict[frozenset[int], list[tuple[int, int, int]]] = defaultdict(list)
    for number, face in enumerate(faces):
        ways = Counter(sides(face))
        for a, b in ways:
            found[frozenset((a, b))].extend([(number, a, b)] * max(0, ways[a, b] - ways[b, a]))
    return dict(found)


@given(faces_of_any_kind)
def test_edges_are_those_of_plain_counting(faces: list[list[int]]) -> None:
    of = made(faces)
    found, expected = table(of), bounding(faces)
    assert list(zip(found.tail.tolist(), found.head.tolist(), strict=True)) == sorted(map(tuple, map(sorted, expected)))
    face = np.repeat(np.arange(of.faces), np.diff(of.starts))
    for row, (a, b) in enumerate(zip(found.tail.tolist(), found.head.tolist(), strict=True)):
        at = slice(found.starts[row], found.starts[row + 1])
        ways = [
            (face[side], *((a, b) if along else (b, a)))
            for side, along in zip(found.sides[at].tolist(), found.along[at].tolist(), strict=True)
        ]
        assert sorted(ways) == sorted(expected[frozenset((a, b))])
        assert np.all(np.diff(found.sides[at]) > 0)
        for side, along in zip(found.sides[at], found.along[at], strict=True):
            assert of.corners[side] == (a if along else b)


@given(faces_of_any_kind)
def test_every_side_knows_its_edge(faces: list[list[int]]) -> None:
    of = made(faces)
    found = table(of)
    edge = edge_of_side(found, len(of.corners))
    assert np.count_nonzero(edge >= 0) == len(found.sides)
    for row in range(len(found.tail)):
        assert np.flatnonzero(edge == row).tolist() == found.sides[found.starts[row] : found.starts[row + 1]].tolist()


def reached(nodes: set[int], links: set[frozenset[int]]) -> list[set[int]]:
    """Connected components."""
    groups: list[set[int]] = []
    while nodes:
        group = {min(nodes)}
        while more := {b for link in links if link & group for b in link} - group:
            group |= more
        groups.append(group)
        nodes = nodes - group
    return groups


@given(faces_of_any_kind)
def test_fans_are_those_of_plain_search(faces: list[list[int]]) -> None:
    of = made(faces)
    bound = bounding(faces)
    expected = []
    for vertex in range(VERTICES):
        ends = [[face for face, *_ in bound[edge]] for edge in bound if vertex in edge and bound[edge]]
        nodes = {face for group in ends for face in group}
        links = {frozenset((a, b)) for group in ends for a in group for b in group}
        expected.append(len(reached(nodes, links)))
    assert fans(of.corners, of.starts, table(of), count=VERTICES).tolist() == expected


@given(faces_of_any_kind)
def test_components_are_those_of_plain_search(faces: list[list[int]]) -> None:
    of = made(faces)
    links = {frozenset((a, b)) for group in bounding(faces).values() for a, *_ in group for b, *_ in group}
    expected = reached(set(range(of.faces)), links)
    area = lengths(area_vectors(of.points, of.corners, of.starts))
    found = components(of.points, of.corners, of.starts, table(of), area)
    assert [set(np.flatnonzero(found.label == k).tolist()) for k in range(len(found.faces))] == expected
    for k, group in enumerate(expected):
        vertices = of.points[[vertex for face in group for vertex in faces[face]]]
        assert np.array_equal(found.low[k], vertices.min(axis=0))
        assert np.array_equal(found.high[k], vertices.max(axis=0))
        assert found.faces[k] == len(group)
        assert found.area[k] == pytest.approx(area[sorted(group)].sum())
        assert found.lowest[k] == min(group)


@given(simple_faces)
def test_duplicates_are_those_of_plain_comparison(faces: list[list[int]]) -> None:
    of = made(faces)
    expected: list[tuple[int, int, bool]] = []
    for row, face in enumerate(faces):
        for earlier, other in enumerate(faces[:row]):
            turns = [[*other[k:], *other[:k]] for k in range(len(other))]
            if face in turns or face[::-1] in turns:
                expected.append((row, earlier, face not in turns))
                break
    found = duplicate_faces(of.corners, of.starts)
    assert list(zip(found.face.tolist(), found.original.tolist(), found.turned.tolist(), strict=True)) == expected


@given(simple_faces)
def test_faces_of_like_keys_are_compared(faces: list[list[int]]) -> None:
    of = made(faces)
    expected = duplicate_faces(of.corners, of.starts)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("foparq.mesh.duplicates._sums", lambda _, starts: np.zeros(len(starts) - 1, dtype=np.uint64))
        found = duplicate_faces(of.corners, of.starts)
    for one, two in zip(found, expected, strict=True):
        assert one.tolist() == two.tolist()


def test_a_bridge_to_an_opening_is_no_border() -> None:
    outer = [(0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)]
    inner = [(1, 0, 1), (1, 0, 2), (2, 0, 2), (2, 0, 1)]
    of = mesh([*outer, *inner], [[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]])
    found = table(of)
    assert len(found.tail) == 9
    assert len(found.boundary) == 8
    assert not len(found.non_manifold)
    assert fans(of.corners, of.starts, found, count=8).tolist() == [1] * 8


def test_a_face_fallen_in_to_a_line_changes_nothing_of_its_neighbours() -> None:
    whole = sphere(1)
    of = mesh(whole.points, [*whole.lists(), [*whole.lists()[0][:2], whole.lists()[0][0]]])
    found, without = table(of), table(whole)
    for name in ("tail", "head", "starts", "sides", "along"):
        one, two = getattr(found, name), getattr(without, name)
        assert np.array_equal(one, two)
    assert found.returns.tolist() == [[len(whole.corners), len(whole.corners) + 1]]
    counted = fans(of.corners, of.starts, found, count=len(of.points))
    assert np.array_equal(counted, fans(whole.corners, whole.starts, without, count=len(of.points)))


def test_cubes_that_share_a_vertex_have_two_fans_there() -> None:
    one, two = box(2), box(2)
    touching = np.flatnonzero((one.points == 1).all(axis=1))[0]
    other = np.flatnonzero((two.points == 0).all(axis=1))[0]
    corners = two.corners + len(one.points)
    corners[two.corners == other] = touching
    starts = np.concatenate([one.starts, two.starts[1:] + len(one.corners)])
    corners = np.concatenate([one.corners, corners])
    count = fans(corners, starts, edges(corners, starts), count=len(one.points) + len(two.points))
    assert np.flatnonzero(count > 1).tolist() == [touching]
    assert np.flatnonzero(count == 0).tolist() == [other + len(one.points)]


def test_empty() -> None:
    nothing = np.empty(0, dtype=np.intp), np.zeros(1, dtype=np.intp)
    found = edges(*nothing)
    assert len(found.tail) == len(found.boundary) == len(found.inconsistent) == 0
    assert fans(*nothing, found, count=2).tolist() == [0, 0]
    assert not len(duplicate_faces(*nothing).face)
    assert not len(components(np.zeros((2, 3)), *nothing, found, np.empty(0)).faces)


SURFACES = {
    "sphere": (sphere(4), Counter(components=1)),
    "box": (box(16), Counter(components=1)),
    "plate": (
        plate(40, 40, [(3, 3), (3, 4), (9, 3), (20, 20)]),
        Counter(components=1, boundary=160 + 6 + 4 + 4, holes=4),
    ),
}


@pytest.fixture(scope="module", params=SURFACES)
def planted(request: pytest.FixtureRequest) -> Planted:
    base, counts = SURFACES[request.param]
    found = plant(base, each=6, seed=1)
    return Planted(found.mesh, found.counts + counts)


@pytest.mark.parametrize("change", [None, {}, {"shift": GEOREFERENCED}, {"rotate": True, "shift": GEOREFERENCED}])
def test_planted_faults_are_counted(planted: Planted, change: dict[str, object] | None) -> None:
    of = planted.mesh if change is None else moved(planted.mesh, seed=5, **change)  # type: ignore[arg-type]
    found = table(of)
    area = lengths(area_vectors(of.points, of.corners, of.starts))
    pieces = components(of.points, of.corners, of.starts, found, area)
    counted = Counter(
        boundary=len(found.boundary), non_manifold=len(found.non_manifold), inconsistent=len(found.inconsistent),
        duplicates=len(duplicate_faces(of.corners, of.starts).face), components=len(pieces.faces),
        unreferenced=len(of.points) - len(np.unique(of.corners)),
    )  # fmt: skip
    assert counted == Counter({key: planted.counts[key] for key in counted})
    assert not np.any(fans(of.corners, of.starts, found, count=len(of.points)) > 1)
    assert pieces.faces[pieces.largest] == of.faces - 6


def test_distance_between_vertices() -> None:
    near, far = sphere(2), sphere(1)
    away = far.points + np.array([4.0, 0, 0])
    points = np.concatenate([near.points, away, [[10.0, 0, 0]]])
    corners = np.concatenate([near.corners, far.corners + len(near.points)])
    starts = np.concatenate([near.starts, far.starts[1:] + len(near.corners)])
    area = lengths(area_vectors(points, corners, starts))
    found = components(points, corners, starts, edges(corners, starts), area)
    brute = np.linalg.norm(near.points[:, None] - away[None], axis=2).min()
    assert vertex_distance(points, corners, starts, found, to=found.largest) == pytest.approx([0, brute])
    assert found.largest == 0


@pytest.mark.parametrize("seed", range(4))
def test_distances_between_vertices_are_those_of_brute_force(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foparq.mesh.components._CHUNK", 7)
    monkeypatch.setattr("foparq.mesh.components._FIRST", 1)
    rng = np.random.default_rng(seed)
    base = sphere(1)
    shifts = rng.uniform(-6, 6, (12, 1, 3))
    points = (base.points[None] * rng.uniform(0.2, 2, (12, 1, 1)) + shifts).reshape(-1, 3)
    faces = [[v + k * len(base.points) for v in face] for k in range(12) for face in base.lists()]
    # One more that shares a vertex with the first.
    faces.append([0, len(points), len(points) + 1])
    of = moved(mesh(np.concatenate([points, rng.uniform(-6, 6, (2, 3))]), faces), seed=seed, shift=GEOREFERENCED)
    found = components(
        of.points, of.corners, of.starts, table(of), lengths(area_vectors(of.points, of.corners, of.starts))
    )
    owner = np.repeat(found.label, np.diff(of.starts))
    places = [of.points[of.corners[owner == k]] for k in range(13)]
    to = found.largest
    brute = [np.linalg.norm(place[:, None] - places[to][None], axis=2).min() for place in places]
    assert vertex_distance(of.points, of.corners, of.starts, found, to=to) == pytest.approx(brute, abs=1e-8)
    assert found.area[to] == found.area.max()
