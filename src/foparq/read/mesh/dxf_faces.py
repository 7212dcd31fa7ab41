# SPDX-License-Identifier: MIT
"""Entities of a DXF file that are surfaces of faces: 3DFACE, MESH, and POLYLINE as polyface or polygon mesh."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.read.dxf.facts import LEAKS, MalformedError
from foparq.read.mesh.made import joined

_POLYMESH, _POLYFACE = 16, 64  # flags of a POLYLINE
_CLOSED_M, _CLOSED_N = 1, 32
_PLACE = 64  # flag of a VERTEX of a polyface that is a place, and no face
_CORNERS = ("vtx0", "vtx1", "vtx2", "vtx3")


@dataclass(frozen=True, slots=True)
class Faces:
    """Surface of one entity."""

    points: Coordinates  #: (n, 3)
    corners: Index  #: (m,)
    counts: Index  #: (f,) corners of each face


def faces_of(entity: Any) -> Faces | None:  # noqa: ANN401 - ezdxf publishes no useful types
    """Surface of an entity; ``None`` if it is none of faces.

    Raises
    ------
    MalformedError
        If its values contradict the format.
    """
    read = _reader(entity)
    if read is None:
        return None
    try:
        return read(entity)
    except LEAKS as error:
        raise MalformedError(" ".join(str(error).split()) or type(error).__name__) from error


def is_smoothed(entity: Any) -> bool:  # noqa: ANN401
    """Whether CAD shows another surface than that of the faces: one that is subdivided or fitted to them."""
    name = {"MESH": "subdivision_levels", "POLYLINE": "smooth_type"}.get(entity.dxftype(), "")
    return bool(name and entity.dxf.get(name, 0))


def _reader(entity: Any) -> Callable[[Any], Faces] | None:  # noqa: ANN401
    kind = entity.dxftype()
    if kind == "POLYLINE":
        flags = int(entity.dxf.get("flags", 0))
        if flags & _POLYFACE:
            return _polyface
        return _polymesh if flags & _POLYMESH else None
    return {"3DFACE": _face, "MESH": _mesh}.get(kind)


def _face(entity: Any) -> Faces:  # noqa: ANN401
    points = np.array([tuple(entity.dxf.get(name)) for name in _CORNERS], dtype=np.float64)
    # A triangle is written with its last corner twice.
    count = 3 if (points[2] == points[3]).all() else 4
    return Faces(points[:count], np.arange(count, dtype=np.intp), np.array([count], dtype=np.intp))


def _mesh(entity: Any) -> Faces:  # noqa: ANN401
    points = np.array(entity.vertices.values, dtype=np.float64).reshape(-1, 3)
    corners = [np.array(face, dtype=np.intp) for face in entity.faces]
    return Faces(points, joined(corners), np.array([len(face) for face in corners], dtype=np.intp))


def _polyface(entity: Any) -> Faces:  # noqa: ANN401
    places, corners, counts = list[tuple[float, ...]](), list[int](), list[int]()
    for vertex in entity.vertices:
        if int(vertex.dxf.get("flags", 0)) & _PLACE:
            places.append(tuple(vertex.dxf.location))
            continue
        # Corners count from 1, and are negative where the edge behind them is not drawn; 0 is none.
        named = [abs(int(vertex.dxf.get(name, 0) or 0)) for name in _CORNERS]
        found = [number - 1 for number in named if number]
        corners += found
        counts.append(len(found))
    points = np.array(places, dtype=np.float64).reshape(-1, 3)
    return Faces(points, np.array(corners, dtype=np.intp), np.array(counts, dtype=np.intp))


def _polymesh(entity: Any) -> Faces:  # noqa: ANN401
    flags, m, n = (int(entity.dxf.get(name, 0)) for name in ("flags", "m_count", "n_count"))
    points = np.array([tuple(vertex.dxf.location) for vertex in entity.vertices], dtype=np.float64).reshape(-1, 3)
    if min(m, n) < 2 or len(points) != m * n:  # noqa: PLR2004 - rows of a face
        raise MalformedError(f"POLYLINE: {m} x {n} != {len(points)}")
    grid = np.arange(m * n, dtype=np.intp).reshape(m, n)
    grid = np.concatenate([grid, grid[:1]]) if flags & _CLOSED_M else grid
    grid = np.concatenate([grid, grid[:, :1]], axis=1) if flags & _CLOSED_N else grid
    corners = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1)
    return Faces(points, corners.reshape(-1), np.full(corners.size // 4, 4, dtype=np.intp))
