# SPDX-License-Identifier: MIT
"""Meshes for tests: made here, or read plainly from the shelf."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]

_PLY = {
    "double": "<f8", "float": "<f4", "float32": "<f4", "uchar": "u1", "uint8": "u1", "int": "<i4", "int32": "<i4",
    "uint": "<u4", "uint32": "<u4",
}  # fmt: skip


def read(path: Path) -> Mesh:
    """Points and triangles of an OBJ, STL or PLY file without surprises."""
    return {".obj": read_obj, ".stl": read_stl, ".ply": read_ply}[path.suffix](path)


def read_obj(path: Path) -> Mesh:
    points, corners = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            points.append([float(value) for value in rest[:3]])
        elif word == "f":
            face = [int(value.split("/")[0]) - 1 for value in rest]
            corners.extend([face[0], face[k], face[k + 1]] for k in range(1, len(face) - 1))
    return np.array(points), np.array(corners, dtype=np.intp)


def read_stl(path: Path) -> Mesh:
    data = path.read_bytes()
    if data.startswith(b"solid"):
        lines = (line.split() for line in data.decode().splitlines())
        points = np.array([[float(value) for value in words[1:]] for words in lines if words[:1] == ["vertex"]])
    else:
        facet = np.dtype([("normal", "<f4", 3), ("points", "<f4", (3, 3)), ("rest", "<u2")])
        points = np.frombuffer(data, facet, offset=84)["points"].reshape(-1, 3).astype(float)
    return points, np.arange(len(points), dtype=np.intp).reshape(-1, 3)


def read_ply(path: Path) -> Mesh:
    head, _, body = path.read_bytes().partition(b"end_header\n")
    count, columns = {}, {}
    for words in (line.split() for line in head.decode().splitlines()):
        if words[0] == "element":
            element = words[1]
            count[element], columns[element] = int(words[2]), []
        elif words[0] == "property":
            columns[element].append(words)
    if b"format ascii" in head:
        rows = [line.split() for line in body.decode().splitlines()]
        points, faces = rows[: count["vertex"]], rows[count["vertex"] :]
        return np.array([row[:3] for row in points], dtype=float), np.array([row[1:4] for row in faces], dtype=np.intp)
    vertex = np.dtype([(words[2], _PLY[words[1]]) for words in columns["vertex"]])
    kinds = []
    for words, many in zip(columns["face"], (3, 6), strict=False):
        kinds += [(f"{words[4]} count", _PLY[words[2]]), (words[4], _PLY[words[3]], many)]
    points = np.frombuffer(body, vertex, count["vertex"])
    faces = np.frombuffer(body, np.dtype(kinds), count["face"], offset=count["vertex"] * vertex.itemsize)
    assert (faces[kinds[0][0]] == 3).all()
    return np.stack([points[axis].astype(float) for axis in "xyz"], axis=1), faces[kinds[1][0]].astype(np.intp)


def icosphere(divisions: int) -> Mesh:
    """Unit sphere: an icosahedron whose faces are divided into four, again and again."""
    golden = (1 + np.sqrt(5)) / 2
    points = np.array([[a, b * golden, 0.0] for b in (1, -1) for a in (-1, 1)])
    points = np.concatenate([points, np.roll(points, 1, axis=1), np.roll(points, 2, axis=1)])
    points /= np.linalg.norm(points, axis=1)[:, None]
    near = np.linalg.norm(points[:, None] - points, axis=2) < 1.2
    corners = np.array(
        [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near[i, j] and near[j, k] and near[i, k]]
    )
    a, b, c = (points[corners[:, k]] for k in range(3))
    turned = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0
    corners[turned] = corners[turned][:, ::-1]
    for _ in range(divisions):
        edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        edges, of = np.unique(edges, axis=0, return_inverse=True)
        between = points[edges].sum(axis=1)
        x, y, z = of.reshape(3, -1) + len(points)
        a, b, c = corners.T
        points = np.concatenate([points, between / np.linalg.norm(between, axis=1)[:, None]])
        corners = np.concatenate([np.stack(part, axis=1) for part in ((a, x, z), (b, y, x), (c, z, y), (x, y, z))])
    return points, corners


def two_spheres(divisions: int) -> Mesh:
    """Two unit spheres that cross, the second turned and shifted."""
    points, corners = icosphere(divisions)
    turn, _ = np.linalg.qr(np.array([[0.8, 0.3, 0.1], [-0.2, 0.9, 0.4], [0.1, -0.3, 0.7]]))
    turn *= np.sign(np.linalg.det(turn))
    return (
        np.concatenate([points, points @ turn.T + [0.5, 0.013, 0.027]]),
        np.concatenate([corners, corners + len(points)]),
    )


def plate(n: int) -> Mesh:
    """Unit square of n by n cells, two triangles each, in a plane in which no axis lies."""
    u, v = (side.ravel() / n for side in np.mgrid[: n + 1, : n + 1])
    cell = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    a, b, c, d = cell, cell + n + 1, cell + n + 2, cell + 1
    corners = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return np.stack([u, v, u], axis=1), corners
