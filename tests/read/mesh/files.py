# SPDX-License-Identifier: MIT
"""Mesh files of every form, written plainly: a value after the other, by struct and by text."""

import struct
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from foparq.errors import InputError
from foparq.model.mesh import RawMesh
from foparq.profile.schema import LimitsSpec
from foparq.read.mesh.reader import read_mesh
from foparq.report.words import LANGUAGES, Words

Places = Sequence[tuple[float, float, float]]
Faces = Sequence[Sequence[int]]

#: a pyramid: a square and four triangles; coordinates that single precision holds exactly
POINTS: Places = ((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 2.0, 0.0), (0.0, 2.0, 0.0), (1.0, 1.0, 1.5))
FACES: Faces = ((3, 2, 1, 0), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
TRIANGLES: Faces = ((0, 2, 1), (0, 3, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))

CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
    "double": "d",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "float32": "f",
    "float64": "d",
    "int64": "q",
    "uint64": "Q",
}
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


def ply(
    form: str,
    elements: Sequence[tuple[str, Sequence[str], Sequence[Sequence[object]]]],
    *,
    comments: Sequence[str] = (),
    end: str = "\n",
) -> bytes:
    """PLY of elements: name, properties as the header writes them, rows; a list is a tuple in its row."""
    head = ["ply", f"format {form} 1.0", *(f"comment {one}" for one in comments)]
    for name, properties, rows in elements:
        head += [f"element {name} {len(rows)}", *(f"property {one}" for one in properties)]
    body = [_ply_row(form, properties, row, end) for _, properties, rows in elements for row in rows]
    return end.join([*head, "end_header", ""]).encode() + b"".join(body)


def _ply_row(form: str, properties: Sequence[str], row: Sequence[object], end: str) -> bytes:
    words, packed = list[str](), bytearray()
    for said, value in zip(properties, row, strict=True):
        kinds = said.split()[:-1]
        many = value if isinstance(value, tuple) else None
        entries = [value] if many is None else list(many)
        if many is not None:
            words.append(str(len(many)))
            packed += b"" if form == "ascii" else struct.pack(ORDERS[form] + CODES[kinds[1]], len(many))
        for entry in entries:
            words.append(str(entry))
            packed += b"" if form == "ascii" else struct.pack(ORDERS[form] + CODES[kinds[-1]], entry)
    return (" ".join(words) + end).encode() if form == "ascii" else bytes(packed)


def simple_ply(
    form: str = "binary_little_endian",
    *,
    real: str = "double",
    whole: str = "int",
    count: str = "uchar",
    points: Places = POINTS,
    faces: Faces = FACES,
) -> bytes:
    return ply(
        form,
        [
            ("vertex", [f"{real} {axis}" for axis in "xyz"], points),
            ("face", [f"list {count} {whole} vertex_indices"], [(tuple(face),) for face in faces]),
        ],
    )


def stl_binary(
    points: Places = POINTS, faces: Faces = TRIANGLES, *, head: bytes = b"", count: int | None = None
) -> bytes:
    text = head.ljust(80, b" ") + struct.pack("<I", len(faces) if count is None else count)
    for face in faces:
        text += struct.pack("<3f", 0, 0, 0)
        for vertex in face:
            text += struct.pack("<3f", *points[vertex])
        text += struct.pack("<H", 0)
    return text


def stl_text(points: Places = POINTS, faces: Faces = TRIANGLES, *, name: str = "obra", end: str = "\n") -> bytes:
    lines = [f"solid {name}"]
    for face in faces:
        lines += ["  facet normal 0 0 1", "    outer loop"]
        lines += ["      vertex {!r} {!r} {!r}".format(*points[vertex]) for vertex in face]
        lines += ["    endloop", "  endfacet"]
    return end.join([*lines, f"endsolid {name}", ""]).encode()


def obj(points: Places = POINTS, faces: Faces = FACES, *, end: str = "\n") -> bytes:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    lines += ["f " + " ".join(str(vertex + 1) for vertex in face) for face in faces]
    return end.join([*lines, ""]).encode()


def off(points: Places = POINTS, faces: Faces = FACES, *, end: str = "\n") -> bytes:
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *(f"{x!r} {y!r} {z!r}" for x, y, z in points)]
    lines += [" ".join(map(str, (len(face), *face))) for face in faces]
    return end.join([*lines, ""]).encode()


def read(folder: Path, data: bytes, name: str = "mesh", **bounds: int) -> RawMesh:
    """The mesh of some bytes, as a file of a name that says nothing."""
    path = folder / name
    path.write_bytes(data)
    return read_mesh(path, limits=LimitsSpec(**bounds))


def refused(folder: Path, data: bytes, name: str = "mesh", **bounds: int) -> InputError:
    """The error of a file that is not read; it has its sentence in both languages."""
    with pytest.raises(InputError) as caught:
        read(folder, data, name, **bounds)
    for language in LANGUAGES:
        assert Words(language).error(caught.value)
    return caught.value


def faces_of(mesh: RawMesh) -> list[list[int]]:
    """Corners of every face."""
    return [mesh.corners[a:b].tolist() for a, b in pairwise(mesh.starts.tolist())]


def places_of(mesh: RawMesh) -> list[tuple[float, ...]]:
    """Coordinates of every point."""
    return [tuple(point) for point in mesh.points.tolist()]


def sound(mesh: RawMesh) -> bool:
    """Whether the columns of a mesh fit each other, whatever it holds."""
    m, f = len(mesh.corners), mesh.faces
    texture = mesh.texture
    return (
        mesh.points.shape[1:] == (3,)
        and mesh.points.dtype == np.float64
        and all(column.dtype == np.intp for column in (mesh.corners, mesh.starts, mesh.group))
        and int(mesh.starts[0]) == 0
        and int(mesh.starts[-1]) == m
        and bool((np.diff(mesh.starts) >= 0).all())
        and mesh.group.shape == (f,)
        and bool(((mesh.group >= 0) & (mesh.group < len(mesh.groups))).all())
        and (
            texture is None
            or (
                texture.corner.shape == (m,)
                and texture.material.shape == (f,)
                and bool(((texture.corner >= -1) & (texture.corner < len(texture.uv))).all())
                and bool(((texture.material >= -1) & (texture.material < len(texture.materials))).all())
            )
        )
    )
