# SPDX-License-Identifier: MIT
"""Changes of a mesh that change no finding: written in another order, run around the other way, moved, turned."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from tests.mesh.made import GEOREFERENCED, turn

from foparq.columns import Coordinates, Index
from foparq.mesh.polygons import chosen
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh

#: metres; sums with coordinates of few bits are exact
POWERS = (1024.0, -2048.0, 512.0)
QUARTER = DrawingUnit(metres=0.25, name="", origin=UnitOrigin.STATED)


def as_it_is(where: Any) -> Any:
    return where


@dataclass(frozen=True, kw_only=True)
class Change:
    """A change of a mesh, and what brings back what is found in it."""

    forth: Callable[[Mesh], Mesh]
    back: Callable[[Any], Any] = as_it_is  #: of places
    faces: Callable[[Mesh], Index] | None = None  #: number that each face had before
    vertices: Callable[[Mesh], Index] | None = None  #: number that each vertex had before
    moves: bool = False  #: coordinates are others
    reverses: bool = False  #: every face looks to the other side

    @property
    def reorders(self) -> bool:
        """Whether what came first no longer does."""
        return self.faces is not None or self.vertices is not None


def reordered(part: Mesh, order: Index) -> Mesh:
    """The faces in another order."""
    corners, starts = chosen(part.corners, part.starts, order)
    return replace(part, corners=corners, starts=starts, group=part.group[order])


def renumbered(part: Mesh, order: Index) -> Mesh:
    """The vertices in another order; corners without a vertex stay so."""
    place = np.empty(len(order), dtype=np.intp)
    place[order] = np.arange(len(order))
    corners = part.corners.copy()
    corners[part.there] = place[corners[part.there]]
    return replace(part, points=part.points[order], corners=corners)


def rolled(part: Mesh) -> Mesh:
    """Every face from another corner on: the first from its second, the second from its third, and so on."""
    faces = [part.corners[a:b] for a, b in zip(part.starts[:-1], part.starts[1:], strict=True)]
    turned = [np.roll(face, -(1 + row)) for row, face in enumerate(faces)]
    return replace(part, corners=np.concatenate([part.corners[:0], *turned]))


def reversed_faces(part: Mesh) -> Mesh:
    """Every face run around the other way."""
    faces = [part.corners[a:b][::-1] for a, b in zip(part.starts[:-1], part.starts[1:], strict=True)]
    return replace(part, corners=np.concatenate([part.corners[:0], *faces]))


def moved(part: Mesh, move: Callable[[Coordinates], Coordinates], **other: Any) -> Mesh:
    """Vertices elsewhere; one without a place stays without."""
    points = part.points.copy()
    with np.errstate(over="ignore"):
        points[part.finite] = move(part.points[part.finite])
    return replace(part, points=points, **other)


def survives(part: Mesh, change: Change) -> bool:
    """Whether a change rounds no coordinate: brought back, each is what it was."""
    there = change.forth(part).points
    with np.errstate(invalid="ignore", over="ignore"):
        back = shapely.get_coordinates(change.back(shapely.points(there)), include_z=True)
    return bool(np.array_equal(back, part.points, equal_nan=True))


def _faces(part: Mesh) -> Index:
    return np.random.default_rng(3).permutation(part.features)


def _vertices(part: Mesh) -> Index:
    return np.random.default_rng(4).permutation(len(part.points))


def _last(part: Mesh) -> Index:
    return np.arange(len(part.points))[::-1]


def _backwards(part: Mesh) -> Index:
    return np.arange(part.features)[::-1]


def _lead_back(move: Callable[[Coordinates], Coordinates]) -> Callable[[Any], Any]:
    return lambda where: shapely.transform(where, move, include_z=True)


def _shift(by: tuple[float, float, float]) -> Change:
    return Change(
        forth=lambda part: moved(part, lambda p: p + by), back=_lead_back(lambda p: p - by), moves=True
    )  # fmt: skip


def _turn(about: Coordinates, by: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Change:
    return Change(
        forth=lambda part: moved(part, lambda p: p @ about.T + by), back=_lead_back(lambda p: (p - by) @ about),
        moves=True,
    )  # fmt: skip


#: orders of faces, vertices and corners: nothing is moved
ORDERS = {
    "faces shuffled": Change(forth=lambda part: reordered(part, _faces(part)), faces=_faces),
    "faces backwards": Change(forth=lambda part: reordered(part, _backwards(part)), faces=_backwards),
    "vertices backwards": Change(forth=lambda part: renumbered(part, _last(part)), vertices=_last),
    "vertices shuffled": Change(forth=lambda part: renumbered(part, _vertices(part)), vertices=_vertices),
    "corners rolled": Change(forth=rolled),
    "faces, vertices and corners": Change(
        forth=lambda part: rolled(renumbered(reordered(part, _faces(part)), _vertices(part))), faces=_faces,
        vertices=_vertices,
    ),
}  # fmt: skip

MOVES = {
    "shifted by powers of two": _shift(POWERS),
    "georeferenced": _shift(GEOREFERENCED),
    # No coordinate is rounded, and what is no number stays alone.
    "axes exchanged": Change(
        forth=lambda part: moved(part, lambda p: p[:, [2, 0, 1]]),
        back=_lead_back(lambda p: p[:, [1, 2, 0]]),
        moves=True,
    ),
    "turned": _turn(turn(5)),
    "turned and georeferenced": _turn(turn(6), GEOREFERENCED),
    "in quarters of a metre": Change(
        forth=lambda part: moved(part, lambda p: p * 4, unit=QUARTER), back=_lead_back(lambda p: p / 4), moves=True
    ),
}

REVERSED = {"faces reversed": Change(forth=reversed_faces, reverses=True)}
CHANGES = {**ORDERS, **REVERSED, **MOVES}
