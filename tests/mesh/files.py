# SPDX-License-Identifier: MIT
"""A small reader of the meshes of the shared shelf: what these tests need of PLY, OBJ, STL and PLC text."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Index

_KINDS = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip


class Mesh(NamedTuple):
    """Vertices and ragged faces."""

    points: Coordinates
    corners: Index
    starts: Index

    @property
    def faces(self) -> int:
        return len(self.starts) - 1

    def lists(self) -> list[list[int]]:
        return [self.corners[a:b].tolist() for a, b in zip(self.starts[:-1], self.starts[1:], strict=True)]


def mesh(points: object, faces: list[list[int]]) -> Mesh:
    """A mesh of lists."""
    starts = np.concatenate([[0], np.cumsum([len(face) for face in faces])]).astype(np.intp)
    corners = np.array([vertex for face in faces for vertex in face], dtype=np.intp)
    return Mesh(np.asarray(points, dtype=np.float64).reshape(-1, 3), corners, starts)


def read(path: Path) -> Mesh:
    return {".ply": _ply, ".obj": _obj, ".stl": _stl, ".poly": _plc}[path.suffix](path)


def _ply(path: Path) -> Mesh:
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    elements: list[tuple[str, int, list[list[str]]]] = []
    for line in head.decode("ascii").splitlines():
        word = line.split()
        if word[0] == "element":
            elements.append((word[1], int(word[2]), []))
        elif word[0] == "property":
            elements[-1][2].append(word[1:])
    if b"format ascii" in head:
        rows = iter(body.decode("ascii").splitlines())
        points = [[float(x) for x in next(rows).split()[:3]] for _ in range(elements[0][1])]
        return mesh(points, [[int(x) for x in next(rows).split()[1:]] for _ in range(elements[1][1])])
    kind = np.dtype([(p[-1], "<" + _KINDS[p[0]]) for p in elements[0][2]])
    table = np.frombuffer(body, kind, elements[0][1])
    points = np.stack([table[axis].astype(np.float64) for axis in "xyz"], axis=1)
    lists = [(np.dtype("<" + _KINDS[p[1]]), np.dtype("<" + _KINDS[p[2]])) for p in elements[1][2]]
    at, faces = elements[0][1] * kind.itemsize, []
    for _ in range(elements[1][1]):
        for n, (size, item) in enumerate(lists):
            count = int(np.frombuffer(body, size, 1, at)[0])
            at += size.itemsize
            if n == 0:
                faces.append(np.frombuffer(body, item, count, at).tolist())
            at += count * item.itemsize
    return mesh(points, faces)


def _obj(path: Path) -> Mesh:
    points, faces = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        word = line.split()
        if word[:1] == ["v"]:
            points.append([float(x) for x in word[1:4]])
        elif word[:1] == ["f"]:
            faces.append([int(corner.split("/")[0]) - 1 for corner in word[1:]])
    return mesh(points, faces)


def _stl(path: Path) -> Mesh:
    """Every face with three vertices of its own."""
    data = path.read_bytes()
    if b"facet normal" in data:
        lines = [line.split() for line in data.decode("ascii").splitlines()]
        places = [[float(x) for x in line[1:]] for line in lines if line[:1] == ["vertex"]]
        return mesh(places, np.arange(len(places)).reshape(-1, 3).tolist())
    kind = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("rest", "<u2")])
    count = int(np.frombuffer(data, "<u4", 1, 80)[0])
    points = np.frombuffer(data, kind, count, 84)["corner"].reshape(-1, 3).astype(np.float64)
    return mesh(points, np.arange(3 * count).reshape(-1, 3).tolist())


def _plc(path: Path) -> Mesh:
    """Facets of one ring each."""
    word = iter(path.read_text(encoding="utf-8").split())
    count, *_ = (int(next(word)) for _ in range(4))
    points = []
    for _ in range(count):
        next(word)
        points.append([float(next(word)) for _ in range(3)])
    faces = []
    number, _ = int(next(word)), next(word)
    for _ in range(number):
        rings, holes = int(next(word)), int(next(word))
        assert (rings, holes) == (1, 0), "written for facets of one ring"
        faces.append([int(next(word)) for _ in range(int(next(word)))])
    return mesh(points, faces)
