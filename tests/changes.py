# SPDX-License-Identifier: MIT
"""Changes of a drawing that change no finding: moved, turned, drawn the other way, written in another order."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely

from foparq.columns import Coordinates, Geometries

Move = Callable[[Coordinates], Coordinates]

#: metres; an UTM place of southern Brazil, and a depth
SHIFT = np.array([4.4e5, 7.4e6, 700.0])
_C, _S = np.cos(np.radians(33)), np.sin(np.radians(33))
TURN = np.array([[_C, -_S, 0], [_S, _C, 0], [0, 0, 1]])
#: by a right angle: no coordinate is rounded
QUARTER = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
MIRROR = np.array([-1.0, 1, 1])


@dataclass(frozen=True, kw_only=True)
class Change:
    """A change of columns, and what brings a place found in them back to where it was drawn."""

    forth: Callable[[Any], Any]
    back: Callable[[Geometries], Geometries] = lambda places: places
    rounds: bool = False  #: coordinates are rounded
    turns: bool = False  #: what was lowest or leftmost no longer is
    redraws: bool = False  #: vertices come in another order
    reorders: bool = False  #: rows come in another order


def moved(geometry: Geometries, move: Move) -> Geometries:
    """Geometries with changed coordinates; those without depth stay without."""

    def in_space(coordinates: Coordinates) -> Coordinates:
        deep = np.column_stack([coordinates, np.zeros((len(coordinates), 3 - coordinates.shape[1]))])
        return move(deep)[:, : coordinates.shape[1]]

    deep = shapely.has_z(geometry)
    result = geometry.copy()
    for flags, include_z in ((deep, True), (~deep & ~shapely.is_missing(geometry), False)):
        result[flags] = shapely.transform(geometry[flags], in_space, include_z=include_z)
    return result


def redrawn(geometry: Geometries, draw: Callable[[Any], Any]) -> Geometries:
    """Geometries drawn anew, one by one."""
    result = geometry.copy()
    result[:] = [shape if shape is None or shape.is_empty else draw(shape) for shape in geometry]
    return result


def started_elsewhere(shape: Any, by: int) -> Any:
    """The same shape with every ring started ``by`` vertices later; other lines as they are."""
    if shape.geom_type == "MultiPolygon":
        return shapely.MultiPolygon([started_elsewhere(part, by) for part in shape.geoms])
    if shape.geom_type == "Polygon":
        shell, *holes = [_rolled(shapely.get_coordinates(r, include_z=shape.has_z), by) for r in _rings(shape)]
        return shapely.Polygon(shell, holes)
    if shape.geom_type != "LineString":
        return shape
    vertices = shapely.get_coordinates(shape, include_z=shape.has_z)
    return shapely.LineString(_rolled(vertices, by)) if np.array_equal(vertices[0], vertices[-1]) else shape


def _rings(shape: Any) -> tuple[Any, ...]:
    return (shape.exterior, *shape.interiors)


def _rolled(ring: Coordinates, by: int) -> Coordinates:
    turned = np.roll(ring[:-1], -by, axis=0)
    return np.vstack([turned, turned[:1]])


def _by_geometry(change: Callable[[Geometries], Geometries]) -> Callable[[Any], Any]:
    def forth(columns: Any) -> Any:
        with np.errstate(invalid="ignore"):
            return replace(columns, geometry=change(columns.geometry))

    return forth


def _in_one_space(geometry: Geometries) -> Geometries:
    """What has no depth lies at depth zero, also after it was moved in depth."""
    return shapely.force_3d(geometry) if shapely.has_z(geometry).any() else geometry


def _motion(forth: Move, back: Move, *, rounds: bool = True, turns: bool = True) -> Change:
    there = _by_geometry(lambda g: moved(_in_one_space(g), forth))
    return Change(forth=there, back=lambda g: moved(g, back), rounds=rounds, turns=turns)


def _drawing(change: Callable[[Geometries], Geometries]) -> Change:
    return Change(forth=_by_geometry(change), redraws=True)


def _shuffled(columns: Any) -> Any:
    return columns.take(np.random.default_rng(3).permutation(len(columns)))


CHANGES = {
    "shifted": _motion(lambda c: c + SHIFT, lambda c: c - SHIFT, turns=False),
    "turned": _motion(lambda c: c @ TURN.T, lambda c: c @ TURN),
    "turned and shifted": _motion(lambda c: c @ TURN.T + SHIFT, lambda c: (c - SHIFT) @ TURN),
    "turned by a right angle": _motion(lambda c: c @ QUARTER.T, lambda c: c @ QUARTER, rounds=False),
    "upside down": _motion(lambda c: c * [-1, -1, 1], lambda c: c * [-1, -1, 1], rounds=False),
    "mirrored": _motion(lambda c: c * MIRROR, lambda c: c * MIRROR, rounds=False),
    "reversed": _drawing(shapely.reverse),
    "every other one reversed": _drawing(lambda g: np.where(np.arange(len(g)) % 2, shapely.reverse(g), g)),
    "rings started at the next vertex": _drawing(lambda g: redrawn(g, lambda s: started_elsewhere(s, 1))),
    "rings started two vertices on": _drawing(lambda g: redrawn(g, lambda s: started_elsewhere(s, 2))),
    "written backwards": Change(forth=lambda columns: columns.take(np.arange(len(columns))[::-1]), reorders=True),
    "shuffled": Change(forth=_shuffled, reorders=True),
}
