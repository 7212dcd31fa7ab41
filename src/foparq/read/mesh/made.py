# SPDX-License-Identifier: MIT
"""What every reader of meshes does alike: bounds, and the surface as columns."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.errors import UnreadableError, UnsafeError
from foparq.model.mesh import MeshReading, RawMesh, Texture
from foparq.profile.schema import LimitsSpec


@dataclass(frozen=True, slots=True)
class Delivered:
    """A file that is read, whole, and the bounds of what it may hold."""

    path: Path
    data: bytes
    limits: LimitsSpec

    @property
    def name(self) -> str:
        """Name of the file, for messages."""
        return self.path.name

    def hold_faces(self, count: int) -> None:
        """Refuse more faces than the limits allow.

        Raises
        ------
        UnsafeError
        """
        if count > self.limits.faces:
            raise UnsafeError("mesh.too-many-faces", file=self.name, value=count, limit=self.limits.faces)

    def hold_vertices(self, count: int) -> None:
        """Refuse more vertices than the limits allow: as many as faces.

        Raises
        ------
        UnsafeError
        """
        if count > self.limits.faces:
            raise UnsafeError("mesh.too-many-vertices", file=self.name, value=count, limit=self.limits.faces)

    def hold_bytes(self, kind: str, count: int, need: int, at: int) -> None:
        """Refuse an announcement that the rest of the file cannot keep, before anything is made of it.

        Parameters
        ----------
        kind, count
            What is announced, and how much of it.
        need : int
            Bytes that it takes at least.
        at : int
            Where it begins.

        Raises
        ------
        UnreadableError
        """
        left = len(self.data) - at
        if need > left:
            raise UnreadableError(
                "mesh.cut-off", file=self.name, byte=at, key=kind, value=count, bytes=need, left=max(left, 0)
            )


def joined(columns: Sequence[Index]) -> Index:
    """Columns of whole numbers one behind the other; none is an empty one, and a single one is not copied."""
    return columns[0] if len(columns) == 1 else np.concatenate([np.empty(0, dtype=np.intp), *columns])


def stacked(tables: Sequence[Coordinates], width: int = 3) -> Coordinates:
    """As :func:`joined`, of rows of so many real numbers."""
    return tables[0] if len(tables) == 1 else np.concatenate([np.empty((0, width)), *tables])


def starts_of(corners: Index) -> Index:
    """(f + 1,) first corner of each face, of the number of corners of each."""
    starts = np.zeros(len(corners) + 1, dtype=np.intp)
    np.cumsum(corners, out=starts[1:])
    return starts


def every(width: int, faces: int) -> Index:
    """(f + 1,) first corner of each face, where all have the same number of corners."""
    return np.arange(faces + 1, dtype=np.intp) * width


def made(
    delivered: Delivered, points: Coordinates, corners: Index, starts: Index, reading: MeshReading, *,
    group: Index | None = None, groups: tuple[str, ...] = ("",), texture: Texture | None = None,
) -> RawMesh:  # fmt: skip
    """The mesh, if it has a surface at all.

    Raises
    ------
    UnreadableError
        If there is no face: a cloud of points, or an empty file of its format. That a surface is missing is never said
        of it by silence.
    """
    if len(starts) == 1:
        raise UnreadableError("mesh.no-surface", file=delivered.name, value=len(points))
    return RawMesh(
        points=points,
        corners=corners,
        starts=starts,
        group=np.zeros(len(starts) - 1, dtype=np.intp) if group is None else group,
        groups=groups,
        texture=texture,
        reading=reading,
    )
