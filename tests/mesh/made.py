# SPDX-License-Identifier: MIT
"""Surfaces made here, with faults planted in numbers that are known."""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from tests.mesh.files import Mesh, mesh

from foparq.columns import Coordinates, Flags, Reals

#: a place in a national grid, and a height
GEOREFERENCED = (712345.678, 7456789.123, 812.5)


def sphere(subdivisions: int) -> Mesh:
    """Icosphere of radius one: 20 * 4**n triangles, closed, seen from outside."""
    t = (1 + 5**0.5) / 2
    points = [
        (-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
        (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1),
    ]  # fmt: skip
    v = np.array(points) / np.sqrt(1 + t * t)
    f = np.array([
        (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
        (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
        (9, 8, 1),
    ])  # fmt: skip
    for _ in range(subdivisions):
        to = np.roll(f, -1, axis=1)
        key = np.minimum(f, to) * len(v) + np.maximum(f, to)
        new, at = np.unique(key.ravel(), return_inverse=True)
        middle = v[new // len(v)] + v[new % len(v)]
        m = at.reshape(-1, 3) + len(v)
        v = np.concatenate([v, middle / np.linalg.norm(middle, axis=1, keepdims=True)])
        f = np.concatenate([
            np.stack([f[:, 0], m[:, 0], m[:, 2]], axis=1), np.stack([f[:, 1], m[:, 1], m[:, 0]], axis=1),
            np.stack([f[:, 2], m[:, 2], m[:, 1]], axis=1), m,
        ])  # fmt: skip
    return Mesh(v, f.ravel().astype(np.intp), np.arange(0, f.size + 1, 3, dtype=np.intp))


def box(cells: int, size: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Mesh:
    """Closed box of ``6 * cells**2`` quadrangles, seen from outside, one corner at the origin."""
    n = cells
    number: dict[tuple[int, int, int], int] = {}
    faces = []
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    places = [tuple(np.insert(p, axis, side).tolist()) for p in ring]
                    # Inserting at the second place turns the ring the other way round.
                    turn = (side == 0) != (axis == 1)
                    faces.append([number.setdefault(p, len(number)) for p in (places[::-1] if turn else places)])
    return mesh(np.array(list(number)) / n * size, faces)


def plate(columns: int, rows: int, openings: list[tuple[int, int]]) -> Mesh:
    """Facade in the plane xz, of quadrangles 0.5 m wide and 0.4 m high; the cells named are openings.

    Faces look along -y.
    """
    number: dict[tuple[int, int], int] = {}
    faces = []
    for j in range(rows):
        for i in range(columns):
            if (i, j) not in openings:
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                faces.append([number.setdefault(p, len(number)) for p in ring])
    at = np.array(list(number), dtype=float)
    return mesh(np.stack([at[:, 0] * 0.5, np.zeros(len(at)), at[:, 1] * 0.4], axis=1), faces)


@dataclass(frozen=True)
class Planted:
    """A surface and what was planted in it, beside what it had."""

    mesh: Mesh
    counts: Counter[str] = field(default_factory=Counter)


def plant(base: Mesh, *, each: int, seed: int) -> Planted:
    """Faults far from each other and from the border: so many of each kind.

    Missing faces, fins (a further triangle on an edge), faces twice, faces turned over, vertices without a face, and
    triangles alone far away.
    """
    rng = np.random.default_rng(seed)
    faces, points = base.lists(), base.points.tolist()
    uses = Counter(frozenset(side) for face in faces for side in zip(face, [*face[1:], face[0]], strict=True))
    taken = {vertex for side, n in uses.items() if n == 1 for vertex in side}
    around: dict[int, set[int]] = {}
    for face in faces:
        for vertex in face:
            around.setdefault(vertex, set()).update(face)
    sites: list[int] = []
    for row in rng.permutation(len(faces)).tolist():
        near = set().union(*(around[vertex] for vertex in faces[row]))
        if len(sites) < 4 * each and not near & taken:
            sites.append(row)
            taken |= near
    assert len(sites) == 4 * each, "the surface is too small"
    counts: Counter[str] = Counter()
    missing, fins, twice, turned = (sites[k * each : (k + 1) * each] for k in range(4))
    extra = []
    for row in fins:
        a, b = faces[row][:2]
        points.append((np.array(points[a]) + points[b] + rng.normal(0, 0.1, 3)).tolist())
        extra.append([b, a, len(points) - 1])
        counts.update(boundary=2, non_manifold=1, chains=1)
    for row in twice:
        extra.append(faces[row][1:] + faces[row][:1])
        counts.update(non_manifold=len(faces[row]), duplicates=1)
    for row in turned:
        faces[row] = faces[row][::-1]
        counts.update(inconsistent=len(faces[row]), flipped=1)
    for row in missing:
        counts.update(boundary=len(faces[row]), holes=1)
    for _ in range(each):
        points += (rng.uniform(-1, 1, (3, 3)) + 30).tolist()
        extra.append([len(points) - 3, len(points) - 2, len(points) - 1])
        points.append(rng.uniform(-1, 1, 3).tolist())
        counts.update(unreferenced=1, components=1, holes=1, boundary=3)
    kept = [face for row, face in enumerate(faces) if row not in set(missing)] + extra
    return Planted(mesh(points, kept), counts)


def turn(seed: int) -> Reals:
    """A rotation (3, 3)."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    q[:, 0] *= np.linalg.det(q)
    return q


def moved(of: Mesh, *, seed: int, shift: tuple[float, float, float] = (0.0, 0.0, 0.0), rotate: bool = False) -> Mesh:
    """The same surface elsewhere: vertices and faces in another order, each face from another corner on."""
    rng = np.random.default_rng(seed)
    points: Coordinates = of.points @ turn(seed).T if rotate else of.points
    place = rng.permutation(len(points))
    new = np.empty_like(points)
    new[place] = points + shift
    faces = []
    for row in rng.permutation(of.faces).tolist():
        face = place[of.corners[of.starts[row] : of.starts[row + 1]]].tolist()
        k = int(rng.integers(len(face)))
        faces.append(face[k:] + face[:k])
    return mesh(new, faces)


def without(of: Mesh, gone: Flags) -> Mesh:
    """The surface without some faces."""
    return mesh(of.points, [face for face, no in zip(of.lists(), gone.tolist(), strict=True) if not no])
