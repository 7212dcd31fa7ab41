# SPDX-License-Identifier: MIT
"""The items of one drawing, as columns of equal length."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.model.packing import pack_geometry, pack_texts, unpack_geometry, unpack_texts

Geometries = NDArray[np.object_]  #: shapely geometries
Texts = NDArray[np.object_]  #: str
Flags = NDArray[np.bool_]
Index = NDArray[np.intp]
Reals = NDArray[np.float64]


class Role(StrEnum):
    """What an item is to the audit."""

    LINE = "line"  #: linework: topology is checked
    AREA = "area"  #: a surface with a boundary
    POINT = "point"  #: a position
    ANNOTATION = "annotation"  #: text, dimension, leader, title block
    HATCH = "hatch"  #: filling, also the anonymous ``*X`` blocks of older programs
    SURFACE = "surface"  #: faces and solids: not linework


@dataclass(frozen=True, kw_only=True)
class Items:
    """Delivered geometry as read-only columns of equal length n.

    Coordinates are those of the file, in drawing units, three-dimensional where the file is; curves are already
    flattened. Inserts are already taken apart: ``inserts`` tells the way.
    """

    geometry: Geometries  #: (n,) shapely geometry; ``None`` where the file holds none
    layer: Texts  #: (n,) layer or table name
    kind: Texts  #: (n,) entity type of the file: ``"LWPOLYLINE"``, ``"Polygon"``
    role: Texts  #: (n,) value of :class:`Role`
    item: Texts  #: (n,) id unique in this drawing, stable under reordering: handle or feature id, made unique
    handle: Texts  #: (n,) DXF handle or feature id as written in the file; not a key
    inserts: Texts  #: (n,) handles of the block inserts from the outermost inward, ``"2F/3A"``; ``""`` at top level
    colour: NDArray[np.int32]  #: (n,) AutoCAD colour index; 256 by layer, 0 by block
    closed: Flags  #: (n,) the file's own closed flag; whether the ends meet is a matter of geometry
    visible: Flags  #: (n,) false on off or frozen layers, for invisible entities and inside paper space
    paper: Flags  #: (n,) true in paper space

    def __post_init__(self) -> None:
        for column in self._columns():
            if len(column) != len(self.geometry):
                raise ValueError("columns of unequal length")
            column.setflags(write=False)

    def __len__(self) -> int:
        return len(self.geometry)

    def _columns(self) -> Iterator[NDArray[Any]]:
        return (getattr(self, field.name) for field in fields(self))

    def take(self, rows: Index | Flags) -> "Items":
        """Items of the chosen rows, in that order."""
        return Items(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})

    def __getstate__(self) -> dict[str, Any]:
        # Items cross process borders: a million rows in a second needs buffers instead of objects.
        state = {field.name: getattr(self, field.name) for field in fields(self)}
        for name in _TEXTS:
            state[name] = pack_texts(state[name])
        state["geometry"] = pack_geometry(self.geometry)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, column in state.items():
            unpack = unpack_geometry if name == "geometry" else unpack_texts if name in _TEXTS else None
            object.__setattr__(self, name, unpack(column) if unpack else column)
        self.__post_init__()


_TEXTS = ("layer", "kind", "role", "item", "handle", "inserts")


def no_items() -> Items:
    """Items of a drawing that holds none."""
    text: Texts = np.empty(0, dtype=object)
    flag = np.zeros(0, dtype=bool)
    return Items(
        geometry=text.copy(), layer=text.copy(), kind=text.copy(), role=text.copy(), item=text.copy(),
        handle=text.copy(), inserts=text.copy(), colour=np.zeros(0, dtype=np.int32),
        closed=flag.copy(), visible=flag.copy(), paper=flag.copy(),
    )  # fmt: skip
