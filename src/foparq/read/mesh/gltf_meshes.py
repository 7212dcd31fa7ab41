# SPDX-License-Identifier: MIT
"""The primitives of a glTF mesh as columns, before a node puts them somewhere."""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.read.mesh.gltf_data import Buffers, index_of
from foparq.read.mesh.gltf_json import Part
from foparq.read.mesh.gltf_materials import Material
from foparq.read.mesh.made import Delivered, joined, stacked
from foparq.read.mesh.strips import triangles_of_fan, triangles_of_strips

_TRIANGLES, _STRIP, _FAN = 4, 5, 6


@dataclass(frozen=True, slots=True)
class Shape:
    """One mesh: n points and f triangles."""

    points: Coordinates  #: (n, 3)
    corners: Index  #: (f, 3) rows of ``points``; -1 - k for the k-th beyond the vertices of its primitive
    uv: Index  #: (f, 3) row of all texture coordinates of the file; -1 where the corner has none
    materials: tuple[tuple[int, int], ...]  #: material and number of faces, primitive by primitive
    told: Counter[str]  #: what is not read


class Meshes:
    """Meshes of a file, and the texture coordinates that they share."""

    def __init__(self, delivered: Delivered, document: Part, buffers: Buffers, materials: list[Material]) -> None:
        self._delivered, self._document, self._buffers = delivered, document, buffers
        self._materials = materials
        self.uv = list[Coordinates]()
        self.uvs = 0
        self._uv_at: dict[int, tuple[int, int]] = {}  #: first row and number of rows, by accessor

    def shape(self, mesh: Part) -> Shape:
        """Primitives of a mesh, put together; those that share their vertices share them here.

        Raises
        ------
        UnreadableError
            If a value is of the wrong kind or reaches out of its buffer.
        UnsafeError
            If there are more vertices or faces than the limits allow.
        """
        work = _Work()
        for primitive in mesh.parts("primitives"):
            mode = primitive.whole("mode", _TRIANGLES)
            attributes = primitive.part("attributes")
            if mode > _FAN:
                raise primitive.wrong("mode", _TRIANGLES)
            if mode < _TRIANGLES:
                work.told["line" if mode else "point"] += 1
            elif not attributes.has("POSITION"):
                work.told["primitive"] += 1
            else:
                self._add(work, primitive, attributes, mode)
        return Shape(
            points=stacked(work.points),
            corners=joined(work.corners).reshape(-1, 3),
            uv=joined(work.uv).reshape(-1, 3),
            materials=tuple(work.materials),
            told=work.told,
        )

    def _add(self, work: "_Work", primitive: Part, attributes: Part, mode: int) -> None:
        number = attributes.whole("POSITION")
        if number not in work.shared:
            self._delivered.hold_vertices(work.vertices + self._buffers.count(number))
            rows = self._buffers.values(number, real=True)
            if rows.shape[1] != 3:  # noqa: PLR2004 - x, y, z
                raise attributes.wrong("POSITION", '"VEC3"')
            work.shared[number] = work.vertices, len(rows)
            work.points.append(rows.astype(np.float64))
            work.vertices += len(rows)
        first, count = work.shared[number]
        corners = self._corners(work, primitive, mode, count)
        work.faces += len(corners) // 3
        self._delivered.hold_faces(work.faces)
        work.materials.append((self._material(primitive), len(corners) // 3))
        work.uv.append(self._texture(primitive, attributes, corners, count))
        # What is outside its own vertices may not fall on those of another primitive.
        outside = corners >= count
        moved = corners + first if first else corners
        work.corners.append(np.where(outside, count - 1 - corners, moved) if outside.any() else moved)

    def _corners(self, work: "_Work", primitive: Part, mode: int, count: int) -> Index:
        """(3 t,) corners of a primitive, rows of its own vertices."""
        index = np.arange(count, dtype=np.intp)
        if primitive.has("indices"):
            number = primitive.whole("indices")
            self._delivered.hold_faces(work.faces + self._buffers.count(number) // 3)
            rows = self._buffers.values(number, real=False)
            if rows.shape[1] != 1:
                raise primitive.wrong("indices", '"SCALAR"')
            index = index_of(rows)
        if mode == _STRIP:
            return triangles_of_strips(index, np.array([0, len(index)])).reshape(-1)
        if mode == _FAN:
            return triangles_of_fan(index).reshape(-1)
        if len(index) % 3:
            raise primitive.wrong("indices", 3 * (len(index) // 3))
        return index

    def _material(self, primitive: Part) -> int:
        material = primitive.whole("material") if primitive.has("material") else -1
        if material >= len(self._materials):
            raise primitive.wrong("material", len(self._materials) - 1)
        return material

    def _texture(self, primitive: Part, attributes: Part, corners: Index, count: int) -> Index:
        """(3 t,) row of ``uv`` of every corner."""
        material = self._material(primitive)
        key = f"TEXCOORD_{self._materials[material].set if material >= 0 else 0}"
        if not attributes.has(key):
            return np.full(len(corners), -1, dtype=np.intp)
        number = attributes.whole(key)
        if number not in self._uv_at:
            self._delivered.hold_vertices(self.uvs + self._buffers.count(number))
            uv = self._buffers.values(number, real=True)
            if uv.shape[1] != 2:  # noqa: PLR2004 - u, v
                raise attributes.wrong(key, '"VEC2"')
            self._uv_at[number] = self.uvs, len(uv)
            self.uv.append(uv.astype(np.float64))
            self.uvs += len(uv)
        first, rows = self._uv_at[number]
        return np.where(corners < min(count, rows), corners + first, -1)


class _Work:
    """What of a mesh was put together so far."""

    def __init__(self) -> None:
        self.points, self.corners, self.uv = list[Coordinates](), list[Index](), list[Index]()
        self.materials = list[tuple[int, int]]()
        self.shared: dict[int, tuple[int, int]] = {}  #: first row and number of rows, by accessor
        self.vertices, self.faces = 0, 0
        self.told: Counter[str] = Counter()
