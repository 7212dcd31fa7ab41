# SPDX-License-Identifier: MIT
"""The items of one drawing, as columns of equal length."""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Geometries, Index, Integers, Texts
from foparq.geom.packing import pack_geometry, pack_texts, unpack_geometry, unpack_texts

INSERT_END, FIELD_END = "\x1e", "\x1f"  #: end one insert, and one word on it, in ``Items.holders``


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
    colour: Integers  #: (n,) AutoCAD colour index; 256 by layer, 0 by block
    closed: Flags  #: (n,) the file's own closed flag; whether the ends meet is a matter of geometry
    visible: Flags  #: (n,) false on off or frozen layers, for invisible entities and inside paper space
    paper: Flags  #: (n,) true in paper space
    #: (n,) the inserts that hold the item, from the outermost inward, in words of :class:`Holder`; each cell of an
    #: array is an insert of its own. Left out: made of ``inserts``, with layers and blocks unknown.
    holders: Texts = field(default_factory=lambda: np.empty(0, dtype=object))

    def __post_init__(self) -> None:
        if len(self.geometry) and not len(self.holders):
            known = {chain: _unnamed(chain) for chain in set(self.inserts.tolist())}
            holders: Texts = np.empty(len(self.inserts), dtype=object)
            holders[:] = [known[chain] for chain in self.inserts.tolist()]
            object.__setattr__(self, "holders", holders)
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


_TEXTS = ("layer", "kind", "role", "item", "handle", "inserts", "holders")


@dataclass(frozen=True, slots=True)
class Holder:
    """One insert that holds an item."""

    name: str  #: unique within the definition it stands in: handle or position, with the cell of an array
    layer: str  #: layer it stands on; where that is layer 0, the layer of the insert around it
    block: str  #: block it inserts, ``""`` if unknown

    def __str__(self) -> str:
        return f"{self.name}{FIELD_END}{self.layer}{FIELD_END}{self.block}{INSERT_END}"


def holders_of(text: str) -> tuple[Holder, ...]:
    """Inserts that one entry of ``Items.holders`` tells, from the outermost inward."""
    return tuple(Holder(*one.split(FIELD_END)) for one in text.split(INSERT_END)[:-1])


def _unnamed(chain: str) -> str:
    return "".join(str(Holder(handle, "", "")) for handle in chain.split("/")) if chain else ""


def no_items() -> Items:
    """Items of a drawing that holds none."""
    text: Texts = np.empty(0, dtype=object)
    flag = np.zeros(0, dtype=bool)
    return Items(
        geometry=text.copy(), layer=text.copy(), kind=text.copy(), role=text.copy(), item=text.copy(),
        handle=text.copy(), inserts=text.copy(), colour=np.zeros(0, dtype=np.int32),
        closed=flag.copy(), visible=flag.copy(), paper=flag.copy(), holders=text.copy(),
    )  # fmt: skip
