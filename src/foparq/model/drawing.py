# SPDX-License-Identifier: MIT
"""One delivered drawing: its items, and what the reader learned of the file."""

from dataclasses import dataclass, field
from enum import StrEnum

from foparq.columns import Flags, Geometries, Reals, Texts
from foparq.model.items import Items
from foparq.model.plane import Plane


@dataclass(frozen=True, slots=True, kw_only=True)
class Skipped:
    """Things of the file that no check will see, counted by reason."""

    reason: str  #: id in the ``report`` catalogue under ``skipped.``: ``"paper-space"``, ``"no-geometry"``
    kind: str  #: entity type of the file
    layer: str
    count: int
    handles: tuple[str, ...] = ()  #: the first few


@dataclass(frozen=True, slots=True, kw_only=True)
class Repair:
    """One thing that had to be mended in memory before the file could be read."""

    code: str  #: the reader's own code
    detail: str  #: the reader's own words, in English
    handle: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bomb:
    """A block that is not taken apart because it would never end, or not in bounded space."""

    block: str  #: block name
    layer: str
    handle: str  #: handle of the insert at top level, ``""`` if the block is never inserted
    entities: int  #: entities it would expand to; -1 for a cycle


@dataclass(frozen=True, slots=True, kw_only=True)
class Dimensions:
    """Linear dimensions whose lettering states a length, as columns of equal length n."""

    measured: Reals  #: (n,) length in drawing units
    text: Texts  #: (n,) lettering, as written
    handle: Texts  #: (n,)
    where: Geometries  #: (n,) point, drawing units


class UnitOrigin(StrEnum):
    """Who said what one drawing unit is."""

    STATED = "stated"  #: the manifest or ``--unit``
    HEADER = "header"  #: the file's own header or coordinate reference system
    UNKNOWN = "unknown"  #: nobody


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawingUnit:
    """What one drawing unit is, in metres, and who said so."""

    metres: float | None  #: metres in one drawing unit; ``None`` if unknown or not a length
    name: str  #: ``"mm"``, ``"m"`` ..., ``""`` if unknown
    origin: UnitOrigin
    header: str = ""  #: what the file itself says: ``"mm"``, ``"EPSG:3857"``, ``"degree"``; ``""`` if silent
    header_metres: float | None = None  #: the same in metres
    stretch: float = 1.0  #: length on the projection over length on the ground, at the middle of the drawing


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """What the reader learned of one file, beside its items."""

    version: str = ""  #: ``"AC1027"``, ``"GPKG 1.2"``
    encoding: str = ""
    repairs: tuple[Repair, ...] = ()
    skipped: tuple[Skipped, ...] = ()
    bombs: tuple[Bomb, ...] = ()
    bad_names: tuple[str, ...] = ()  #: layer names that look doubly encoded
    dimensions: Dimensions | None = None
    layers: tuple[str, ...] = ()  #: every layer of the file, also the empty ones
    hidden_layers: tuple[str, ...] = ()  #: off or frozen layers
    crs: str = ""  #: coordinate reference system, ``"EPSG:31982"``


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """One drawing as delivered, with what the manifest says of it."""

    path: str  #: relative to the delivery, with ``/``
    items: Items
    reading: Reading
    unit: DrawingUnit
    plane: Plane
    facade: str = ""
    classes: dict[str, str] = field(default_factory=dict)  #: layer pattern to feature class
    areas: tuple[str, ...] = ()  #: patterns of the layers whose closed lines bound areas of a coverage

    def visible_rows(self) -> Flags:
        """(n,) true for what a person sees in model space."""
        return self.items.visible & ~self.items.paper
