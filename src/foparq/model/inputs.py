# SPDX-License-Identifier: MIT
"""What rules look at: columns of one kind of thing, each row with its name in the file.

Geometry is in the drawing's plane: metres, x to the right, y up, z depth where the drawing has any. Rows are in a
defined order that does not depend on the order of the file.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, Self

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.geom.adjoining import adjoining
from foparq.geom.polylines import Polylines
from foparq.geom.repeats import drawn_again
from foparq.model.layers import bonds


class Numbered:
    """Names that are made when they are asked for: a letter, and a number that counts things of the file from 0.

    A column of ten million names would take a gigabyte; only those of faults are ever read.

    Examples
    --------
    >>> Numbered("f", np.array([4, 7]))[np.array([1])].tolist()
    ['f7']
    """

    def __init__(self, letter: str, number: Index) -> None:
        self.letter = letter
        self.number = number

    def __len__(self) -> int:
        return len(self.number)

    def __getitem__(self, rows: Any) -> Any:  # noqa: ANN401 - as of an array of texts
        if np.ndim(self.number[rows]) == 0:
            return f"{self.letter}{self.number[rows]}"
        return np.array([f"{self.letter}{n}" for n in self.number[rows].tolist()], dtype=object)


Names = Texts | Numbered


@dataclass(frozen=True, kw_only=True)
class Named:
    """Columns that name a row in the file; every input of a rule has them. n rows."""

    layer: Texts  #: (n,)
    item: Names  #: (n,) unique id in the drawing; ``""`` where no item is meant
    handle: Names  #: (n,) as written in the file
    inserts: Texts  #: (n,) chain of block inserts
    row: Index  #: (n,) row in the drawing's items; -1 where no item is meant

    def __len__(self) -> int:
        return len(self.layer)

    @property
    def told(self) -> Texts:
        """(n,) what the reader says of a row, as :attr:`Repairs.says`; ``""`` where it says nothing."""
        return np.full(len(self), "", dtype=object)

    def take(self, rows: Index | Flags) -> Self:
        """The chosen rows, in that order."""
        return type(self)(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})


@dataclass(frozen=True, kw_only=True)
class Features(Named):
    """Every delivered geometry of model space: lines, areas, points."""

    geometry: Geometries  #: (n,) may be ``None``, empty or invalid


@dataclass(frozen=True, kw_only=True)
class Lines(Named):
    """Linework: lines and the boundaries of areas, each one ``LineString`` of finite coordinates."""

    geometry: Geometries  #: (n,)
    bounds: Flags  #: (n,) true for the boundary of an area: neighbours may share it
    #: (n,) the inserts that hold it, from the outermost inward; each cell of an array by itself. Left out: ``inserts``
    holders: Texts = field(default_factory=lambda: np.empty(0, dtype=object))
    #: (n,) equal numbers on layers that bind: what is drawn there is drawn as one. Left out: by the names of the layers
    bond: Index = field(default_factory=lambda: np.empty(0, dtype=np.intp))

    def __post_init__(self) -> None:
        if len(self.holders) != len(self.geometry):
            object.__setattr__(self, "holders", self.inserts)
        if len(self.bond) != len(self.geometry):
            object.__setattr__(self, "bond", bonds(self.layer, {}, ()))

    @cached_property
    def polylines(self) -> Polylines:
        """The same lines as coordinate columns with a spatial index, built once."""
        return Polylines.of(self.geometry)

    @cached_property
    def names(self) -> Index:
        """(n,) equal numbers on layers of one name."""
        return bonds(self.layer, {}, ())

    def adjoining(self, coincide: float) -> Flags:
        """(n,) closed lines of the layers whose closed lines mostly share borders, and that are not known as areas."""
        table = self.polylines
        return table.kept(
            ("adjoining", coincide),
            lambda: adjoining(table, self.geometry, self.names, self.bounds, coincide=coincide),
        )

    def drawn_again(self, coincide: float) -> Flags:
        """(n,) lines that only repeat what another one draws on a layer that does not bind with theirs."""
        table = self.polylines
        return table.kept(("again", coincide), lambda: drawn_again(table, self.bounds, self.bond, coincide=coincide))


@dataclass(frozen=True, kw_only=True)
class Areas(Named):
    """Areas of one coverage, each one valid ``Polygon``."""

    geometry: Geometries  #: (n,)


@dataclass(frozen=True, kw_only=True)
class Repairs(Named):
    """What had to be mended before the file could be read."""

    code: Texts  #: (n,) the reader's code
    says: Texts  #: (n,) the repair, as JSON

    @property
    def told(self) -> Texts:
        """(n,) the repair, as JSON."""
        return self.says


@dataclass(frozen=True, kw_only=True)
class Bombs(Named):
    """Blocks that were not taken apart."""

    entities: Reals  #: (n,) entities the block would expand to; -1 for a cycle
    where: Geometries  #: (n,) insertion point, or empty


@dataclass(frozen=True, kw_only=True)
class HiddenItems(Named):
    """Layers with items that nobody sees; one row a layer."""

    count: Reals  #: (n,) items
    where: Geometries  #: (n,) box around them


@dataclass(frozen=True, kw_only=True)
class LayerNames(Named):
    """Names of layers of one file; one row a name."""

    doubly_encoded: Flags  #: (n,) true if it reads like UTF-8 taken for another encoding, or holds bytes of another
    count: Reals  #: (n,) items on the layer


@dataclass(frozen=True, kw_only=True)
class LayerPatterns(Named):
    """Layer patterns that the manifest states for one drawing; one row a pattern, which stands in ``layer``."""

    matched: Flags  #: (n,) true if some layer of the file matches


@dataclass(frozen=True, kw_only=True)
class UnitEvidence(Named):
    """Statements about the drawing unit other than the one in use; one row a statement."""

    witness: Texts  #: (n,) who says it: ``header``, ``lettering``, ``projection``, ``extent``, ``tables``, ``drawing``
    says: Reals  #: (n,) metres in one drawing unit by this statement
    used: Reals  #: (n,) metres in one drawing unit as used; NaN if none is known
    weight: Reals  #: (n,) relative difference that this statement cannot tell apart
    where: Geometries  #: (n,) place of the statement in the coordinates of the file, or empty


def nameless(n: int, layer: str = "0") -> dict[str, np.ndarray]:
    """Naming columns for n rows of one layer, with the row number as item id; for tests and loose use."""
    rows = np.arange(n)
    text = np.array([str(row) for row in rows], dtype=object)
    return {
        "layer": np.full(n, layer, dtype=object), "item": text, "handle": text.copy(),
        "inserts": np.full(n, "", dtype=object), "row": rows,
    }  # fmt: skip


def lines_of(geometry: Sequence[object]) -> Lines:
    """Lines of well-known text or shapely geometries; for tests and loose use."""
    shapes = _shapes(geometry)
    return Lines(geometry=shapes, bounds=np.zeros(len(shapes), dtype=bool), **nameless(len(shapes)))


def areas_of(geometry: Sequence[object]) -> Areas:
    """Areas of well-known text or shapely geometries; for tests and loose use."""
    shapes = _shapes(geometry)
    return Areas(geometry=shapes, **nameless(len(shapes)))


def features_of(geometry: Sequence[object]) -> Features:
    """Features of well-known text or shapely geometries; for tests and loose use."""
    shapes = _shapes(geometry)
    return Features(geometry=shapes, **nameless(len(shapes)))


def _shapes(geometry: Sequence[object]) -> Geometries:
    shapes = np.empty(len(geometry), dtype=object)
    for n, shape in enumerate(geometry):
        shapes[n] = shapely.from_wkt(shape) if isinstance(shape, str) else shape
    return shapes
