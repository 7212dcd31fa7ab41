# SPDX-License-Identifier: MIT
"""Columns of items under construction."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from foparq.columns import Flags, Index, Integers, Reals, Texts
from foparq.errors import UnsafeError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Items, Role, no_items
from foparq.names import folded
from foparq.read.dxf.kinds import Unseen

LINE, FACE, PLACE = 0, 1, 2  #: forms of geometry
_EXAMPLES = 5  #: handles kept for a reason of skipping
_ROLES = tuple(Role)


class LayerTable:
    """Layers of a file by number. Number 0 is layer ``"0"``, whose content takes the layer of the insert.

    Names are told apart without regard to case, as CAD programs do, and to how accents are composed; the spelling of
    the layer table wins.
    """

    def __init__(self, table: Sequence[tuple[str, bool, bool]]) -> None:
        self.names: list[str] = ["0"]
        self.table: list[str] = []
        self._numbers: dict[str, int] = {"0": 0}
        self._off: list[bool] = [False]
        self._frozen: list[bool] = [False]
        for name, off, frozen in table:
            number = self.number(name)
            self.table.append(self.names[number])
            self._off[number], self._frozen[number] = off, frozen

    def number(self, name: str) -> int:
        """Number of a layer; one that the table does not hold is added, on and thawed."""
        key = folded(name)
        if key not in self._numbers:
            self._numbers[key] = len(self.names)
            self.names.append(name)
            self._off.append(False)
            self._frozen.append(False)
        return self._numbers[key]

    @property
    def frozen(self) -> Flags:
        """(layers,) frozen."""
        return np.array(self._frozen)

    @property
    def hidden(self) -> Flags:
        """(layers,) off or frozen."""
        hidden: Flags = np.array(self._off) | np.array(self._frozen)
        return hidden


_Key = tuple[SkippedReason, str, str, str]


@dataclass(slots=True)
class LeftOut:
    """What is skipped: count and first handles by (reason, kind, layer, name)."""

    counts: dict[_Key, int] = field(default_factory=dict)
    handles: dict[_Key, list[str]] = field(default_factory=dict)

    def add(self, unseen: Unseen, kind: str, layer: str, handle: str, count: int = 1) -> None:
        """Count one entity, or one that stands for several."""
        key = (unseen.reason, kind, layer, unseen.name)
        self.counts[key] = self.counts.get(key, 0) + count
        known = self.handles.setdefault(key, [])
        if handle and len(known) < _EXAMPLES and handle not in known:
            known.append(handle)

    def records(self) -> tuple[Skipped, ...]:
        """Ordered by reason, kind, layer and name."""
        return tuple(
            Skipped(reason=key[0], kind=key[1], layer=key[2], name=key[3], count=self.counts[key],
                    handles=tuple(self.handles[key]))
            for key in sorted(self.counts)
        )  # fmt: skip


@dataclass(slots=True, kw_only=True)
class Chunk:
    """Columns of n items with m vertices."""

    vertices: Reals  #: (m, 3)
    counts: Index  #: (n,) vertices of each item
    form: Integers  #: (n,)
    kind: Texts  #: (n,)
    role: Integers  #: (n,) number in ``Role``
    layer: Integers  #: (n,) number in ``LayerTable``
    handle: Texts  #: (n,)
    item: Texts  #: (n,)
    inserts: Texts  #: (n,)
    holders: Texts  #: (n,)
    colour: Integers  #: (n,)
    closed: Flags  #: (n,)
    visible: Flags  #: (n,)


def role_number(role: Role) -> int:
    """Number of a role in a chunk."""
    return _ROLES.index(role)


class Columns:
    """Chunks, bounded in vertices.

    Parameters
    ----------
    most : int
        Vertices that may be held.
    file : str
        Named when there are more.
    """

    def __init__(self, most: int, file: str) -> None:
        self._most, self._file = most, file
        self._vertices = 0
        self._chunks: list[Chunk] = []
        self._geometry: list[Texts] = []

    def expect(self, vertices: int) -> None:
        """Announce vertices before memory is taken for them.

        Raises
        ------
        UnsafeError
            If there are too many.
        """
        self._vertices += vertices
        self.check(0)

    def check(self, vertices: int) -> None:
        """See whether vertices would fit.

        Raises
        ------
        UnsafeError
            If they would not.
        """
        if self._vertices + vertices > self._most:
            raise UnsafeError(
                "dxf.too-many-vertices", file=self._file, value=self._vertices + vertices, limit=self._most
            )

    def add(self, chunk: Chunk) -> None:
        """Keep a chunk; its vertices become geometry at once, so that only one chunk is held twice."""
        self._geometry.append(_geometry(chunk.vertices, chunk.counts, chunk.form))
        self._chunks.append(replace(chunk, vertices=np.empty((0, 3))))

    def items(self, layers: LayerTable) -> Items:
        """All items, in the order of the chunks."""
        if not self._chunks:
            return no_items()
        joined = {name: np.concatenate([getattr(chunk, name) for chunk in self._chunks]) for name in Chunk.__slots__}
        names = np.array(layers.names, dtype=object)
        roles = np.array([str(role) for role in _ROLES], dtype=object)
        return Items(
            geometry=np.concatenate(self._geometry),
            layer=names[joined["layer"]],
            kind=joined["kind"],
            role=roles[joined["role"]],
            item=_unique(joined["item"]),
            handle=joined["handle"],
            inserts=joined["inserts"],
            holders=joined["holders"],
            colour=joined["colour"],
            closed=joined["closed"],
            visible=joined["visible"],
            paper=np.zeros(len(joined["kind"]), dtype=bool),
        )


def _geometry(vertices: Reals, counts: Index, form: Integers) -> Texts:
    result = np.empty(len(counts), dtype=object)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.intp)
    raised = np.logical_or.reduceat(vertices[:, 2] != 0, starts)  # also true for NaN
    for flat in (True, False):
        for wanted, make in ((LINE, shapely.linestrings), (FACE, _faces), (PLACE, _places)):
            rows = np.flatnonzero((form == wanted) & (raised != flat))
            if len(rows):
                chosen = np.repeat(np.isin(np.arange(len(counts)), rows), counts)
                index = np.repeat(np.arange(len(rows)), counts[rows])
                result[rows] = make(vertices[chosen, : 2 if flat else 3], indices=index)
    return result


def _faces(vertices: Reals, indices: Index) -> Texts:
    faces: Texts = shapely.polygons(shapely.linearrings(vertices, indices=indices))
    return faces


def _places(vertices: Reals, indices: Index) -> Texts:
    places: Texts = shapely.points(vertices[np.argsort(indices, kind="stable")])
    return places


def _unique(item: Texts) -> Texts:
    seen: dict[str, int] = {}
    taken = set(item.tolist())
    if len(taken) == len(item):
        return item
    result = item.copy()
    for n, name in enumerate(item):
        seen[name] = seen.get(name, 0) + 1
        if seen[name] > 1:
            while (renamed := f"{name}~{seen[name]}") in taken:
                seen[name] += 1
            taken.add(renamed)
            result[n] = renamed
    return result
