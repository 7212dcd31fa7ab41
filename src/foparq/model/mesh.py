# SPDX-License-Identifier: MIT
"""One delivered mesh as it stands in its file: nothing merged, nothing repaired, nothing left out."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.model.drawing import DrawingUnit, Repair, Skipped
from foparq.model.part import Part

_CORNERS = 3  #: fewer bound no face


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshReading:
    """What the reader learned of one file, beside its surface."""

    version: str  #: ``"PLY binary_little_endian 1.0"``, ``"OBJ"``, ``"STL binary"``
    repairs: tuple[Repair, ...] = ()
    skipped: tuple[Skipped, ...] = ()
    first: int = 0  #: number of the first vertex in the file's own counting: 1 in an OBJ
    unit: str = ""  #: what the file itself says: ``"m"`` for glTF; ``""`` if silent
    up: str = ""  #: axis that points up: ``"y"`` for glTF; ``""`` if silent
    images: tuple[str, ...] = ()  #: images that the file refers to, as written
    crs: str = ""  #: coordinate reference system


@dataclass(frozen=True, slots=True, kw_only=True)
class Texture:
    """Where an image lies on a surface of f faces and m corners."""

    uv: Coordinates  #: (k, 2) texture coordinates
    corner: Index  #: (m,) row of ``uv``; -1 where the corner has none
    material: Index  #: (f,) row of ``materials``; -1 where the face has none
    materials: tuple[tuple[str, str], ...]  #: name, and image as written; ``""`` where there is none


@dataclass(frozen=True, slots=True, kw_only=True)
class RawMesh:
    """The surface of one file: n points, and f polygons of m corners in all.

    Face i has the corners ``corners[starts[i]:starts[i + 1]]``. Coordinates may be no numbers, a corner may name a
    point that is not there, and a face may have less than three corners: rules tell it.
    """

    points: Coordinates  #: (n, 3) as written; values of single precision are widened exactly
    corners: Index  #: (m,) row of ``points``, counted from 0; what the file gives outside stays outside
    starts: Index  #: (f + 1,)
    group: Index  #: (f,) row of ``groups``
    groups: tuple[str, ...]  #: objects and groups of the file; ``""`` where it names none
    texture: Texture | None = None
    reading: MeshReading

    @property
    def faces(self) -> int:
        """Number of faces, f."""
        return len(self.starts) - 1


@dataclass(frozen=True, kw_only=True)
class Mesh(Part):
    """One mesh as delivered, with what the manifest says of it. Its features are its faces."""

    points: Coordinates  #: (n, 3) in units of the file
    corners: Index  #: (m,) vertex of each corner; see :class:`RawMesh`
    starts: Index  #: (f + 1,)
    group: Index  #: (f,) row of ``groups``
    groups: tuple[str, ...]
    texture: Texture | None = None
    reading: MeshReading
    unit: DrawingUnit
    closed: bool | None = None  #: whether the surface has no rim; ``None`` if nobody states it
    rims: int | None = None  #: how many rims it has; ``None`` if nobody states it
    facade: str = ""
    up: str = ""  #: axis that points up, as stated: ``"x"``, ``"y"`` or ``"z"``; ``""`` if nobody states it
    confirmed: frozenset[str] = frozenset()  #: what a person confirmed of it: ``unit``

    @property
    def features(self) -> int:
        """Faces, also those that cannot be used."""
        return len(self.starts) - 1

    @property
    def vertices(self) -> int:
        """Vertices, and corners where these are more: both take time."""
        return max(len(self.points), len(self.corners))

    @property
    def held(self) -> int:
        """Bytes of points, corners and faces."""
        return sum(column.nbytes for column in (self.points, self.corners, self.starts, self.group))

    @property
    def areas(self) -> Reals:
        """(f,) areas of the faces, square metres; in units of the file where nobody knows these. 0 if it has none."""
        from foparq.mesh.polygons import chosen  # noqa: PLC0415 - a drawing never loads the kernels of meshes
        from foparq.mesh.shape import area_vectors  # noqa: PLC0415 - as above
        from foparq.mesh.vectors import lengths  # noqa: PLC0415 - as above

        areas: Reals = np.zeros(self.features)
        rows = np.flatnonzero(self.usable)
        areas[rows] = lengths(area_vectors(self.points, *chosen(self.corners, self.starts, rows)))
        return areas * (self.unit.metres or 1.0) ** 2

    @cached_property
    def finite(self) -> Flags:
        """(n,) vertices with three finite coordinates."""
        return np.asarray(np.isfinite(self.points).all(axis=1))

    @cached_property
    def there(self) -> Flags:
        """(m,) corners that name a vertex of the file."""
        return np.asarray((self.corners >= 0) & (self.corners < len(self.points)))

    @cached_property
    def usable(self) -> Flags:
        """(f,) faces of three corners and more, each at a vertex that exists and has a place."""
        good = self.there.copy()
        good[self.there] = self.finite[self.corners[self.there]]
        counts = np.diff(self.starts)
        usable: Flags = np.asarray(counts >= _CORNERS)
        # Sums over runs of corners; a face without corners has none to be wrong.
        wrong = np.concatenate([[0], np.cumsum(~good)])
        usable &= np.asarray(wrong[self.starts[1:]] == wrong[self.starts[:-1]])
        return usable
