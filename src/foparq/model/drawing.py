# SPDX-License-Identifier: MIT
"""One delivered drawing: its items, and what the reader learned of the file."""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.model.items import Items, Role
from foparq.model.part import Part
from foparq.model.plane import Plane
from foparq.model.symbols import Symbols


class SkippedReason(StrEnum):
    """Why things of a file reach no check; each is an id in the ``report`` catalogue under ``skipped.``."""

    # of any drawing
    IGNORED_LAYER = "ignored-layer"  #: a person says that the layer is not to be checked
    NOT_PLOTTED = "not-plotted"  #: on a layer that is never plotted
    POINT_SYMBOL = "point-symbol"  #: a block insert that is taken for a sign on the drawing
    MALFORMED = "malformed"
    NO_GEOMETRY = "no-geometry"
    PAPER_SPACE = "paper-space"  #: beside a drawing in model space: frames, stamps, viewports
    PAPER_SPACE_ONLY = "paper-space-only"  #: model space holds nothing that is drawn
    # of a DXF file
    BLOCK_BOMB = "block-bomb"
    BLOCKS_SKIPPED = "blocks-skipped"
    DEGENERATE = "degenerate"
    EXTERNAL_REFERENCE = "external-reference"
    IMAGE = "image"
    INFINITE_LINE = "infinite-line"
    MISSING_BLOCK = "missing-block"
    MULTILINE = "multiline"
    OLE = "ole"
    PROXY = "proxy"
    SURFACE = "surface"  #: faces, meshes and solids in space, also those that stay among the items
    TOO_MANY_VERTICES = "too-many-vertices"
    UNDERLAY = "underlay"
    UNSUPPORTED = "unsupported"
    VIEWPORT = "viewport"
    WIPEOUT = "wipeout"
    XCLIP_IGNORED = "xclip-ignored"
    # of a GeoPackage, Shapefile or GeoJSON
    ATTRIBUTES = "attributes"
    BLOCKS_KEPT = "blocks-kept"  #: a CAD export that leaves blocks whole
    COMPUTED_TABLE = "computed-table"
    NO_GEOMETRY_COLUMN = "no-geometry-column"
    NOT_ASKED = "not-asked"
    RASTER = "raster"
    SEVERAL_GEOMETRIES = "several-geometries"  #: a table with several geometry columns
    TABLE_MISSING = "table-missing"
    TRIGGER = "trigger"
    UNLISTED_GEOMETRY = "unlisted-geometry"
    UNLISTED_VIEW = "unlisted-view"
    UNLISTED_VIRTUAL_TABLE = "unlisted-virtual-table"
    UNSUPPORTED_GEOMETRY = "unsupported-geometry"
    UNSUPPORTED_LAYER = "unsupported-layer"
    VIEW = "view"
    VIRTUAL_TABLE = "virtual-table"
    # of a table of points, distances or features
    ABOVE_HEADER = "above-header"
    # of a cloud of points
    NO_COORDINATES = "no-coordinates"  #: a point of which a coordinate is no number
    # of a mesh
    LINES_AND_POINTS = "lines-and-points"  #: beside the faces
    MATERIALS = "materials"  #: a library of materials that is not there, or may not be opened
    NO_SURFACE = "no-surface"  #: known to hold no face: cameras, lights
    UNKNOWN_ELEMENT = "unknown-element"  #: nobody knows whether it is a surface

    @property
    def opens(self) -> bool:
        """Whether linework may hide there that the delivery means to show, so that nothing can be concluded."""
        return self not in _NO_LINEWORK


#: what shows no linework of the delivery; a reason that nobody lists here leaves the question open
_NO_LINEWORK = frozenset({
    SkippedReason.ABOVE_HEADER,  # a remark in a table
    SkippedReason.ATTRIBUTES,  # rows without a place
    SkippedReason.DEGENERATE,  # no extent: nobody sees it in CAD either
    SkippedReason.IGNORED_LAYER,  # somebody's statement: evaluated by itself
    SkippedReason.IMAGE,  # the photograph that was drawn over
    SkippedReason.INFINITE_LINE,  # an aid of construction, not plotted as drawing
    SkippedReason.LINES_AND_POINTS,  # no surface, and a mesh is delivered for its surface
    SkippedReason.MATERIALS,  # how a surface looks, not where it is: the image that is missing is told by itself
    SkippedReason.NO_COORDINATES,  # of a reference: no part of what is delivered
    SkippedReason.NO_GEOMETRY,  # nothing is drawn
    SkippedReason.NO_SURFACE,  # cameras and lights of a mesh
    SkippedReason.NOT_ASKED,  # the manifest names what is delivered
    SkippedReason.NOT_PLOTTED,  # no sheet shows it: evaluated by itself where it is most of the drawing
    SkippedReason.OLE,  # a table or text of another program
    SkippedReason.POINT_SYMBOL,  # a sign, no linework: evaluated by itself
    SkippedReason.PAPER_SPACE,  # lettering of the sheet, while the drawing stands in model space
    SkippedReason.RASTER,  # tiles of an image
    SkippedReason.TRIGGER,  # runs when a row changes, draws nothing
    SkippedReason.UNLISTED_GEOMETRY,  # a column that no program shows
    SkippedReason.UNLISTED_VIEW,  # no layer: nothing is delivered through it
    SkippedReason.UNLISTED_VIRTUAL_TABLE,  # as above
    SkippedReason.VIEWPORT,  # a window on what is read elsewhere
    SkippedReason.WIPEOUT,  # hides what lies beneath, which is read
    SkippedReason.XCLIP_IGNORED,  # more was read than is shown, not less
})  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Skipped:
    """Things of the file that no check will see, counted by reason."""

    reason: SkippedReason
    kind: str  #: entity type of the file
    layer: str
    count: int
    handles: tuple[str, ...] = ()  #: the first few
    name: str = ""  #: block or reference that is not there: ``"PORTA_80"``, ``"PAVIMENTO (pavimento.dwg)"``

    @property
    def thing(self) -> str:
        """What is not seen, in words of the file: ``"MLINE"``, ``"INSERT PORTA_80"``."""
        return f"{self.kind} {self.name}" if self.name else self.kind


@dataclass(frozen=True, slots=True, kw_only=True)
class Repair:
    """One thing that had to be changed or left out in memory before the file could be read."""

    code: str  #: id in the ``report`` catalogue under ``repair.``, or the reader's own code
    detail: str = ""  #: the reader's own words, in English
    handle: str = ""
    line: int = 0  #: of the file, from 1; 0 if nobody knows
    kind: str = ""  #: entity type, or name of a header variable
    layer: str = ""
    group: int = -1  #: group code of the damaged value; -1 if none is meant
    text: str = ""  #: what stands there, as far as it is told

    @property
    def loses(self) -> bool:
        """Whether something that was drawn may be lost by it; how names are read loses nothing, nor does padding."""
        return self.code not in _LOSES_NOTHING


_LOSES_NOTHING = frozenset({"code-page-unknown", "mesh-trailing-bytes"})


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Labels:
    """Short letterings that may name a point, as columns of equal length n."""

    text: Texts  #: (n,) as written
    place: Reals  #: (n, 3) of the lettering, or of the insert whose attribute it is; drawing units
    block: Flags  #: (n,) it is an attribute: the place is exact


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedScale:
    """A scale that the file states of itself."""

    witness: str  #: ``lettering`` or ``viewport``
    said: str  #: the lettering, or the viewport with its handle
    denominator: float = 0.0  #: k of 1:k, as lettered; 0 where it follows from ``ratio``
    ratio: float = 0.0  #: drawing units on one unit of the paper


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
class Heard:
    """What another file of the delivery says of the unit of a drawing."""

    witness: str  #: ``tables`` or ``drawing``
    path: str  #: of that file
    says: float  #: metres in one drawing unit


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """What the reader learned of one file, beside its items."""

    version: str = ""  #: ``"AC1027"``, ``"GPKG 1.2"``
    encoding: str = ""
    repairs: tuple[Repair, ...] = ()
    skipped: tuple[Skipped, ...] = ()
    bombs: tuple[Bomb, ...] = ()
    bad_names: tuple[str, ...] = ()  #: layer names that look doubly encoded, or hold bytes of another encoding
    dimensions: Dimensions | None = None
    labels: Labels | None = None
    scales: tuple[StatedScale, ...] = ()
    layers: tuple[str, ...] = ()  #: every layer of the file, also the empty ones
    hidden_layers: tuple[str, ...] = ()  #: off or frozen layers
    unplotted: tuple[str, ...] = ()  #: layers that CAD never plots: aids of construction
    crs: str = ""  #: coordinate reference system, ``"EPSG:31982"``


@dataclass(frozen=True, kw_only=True)
class Drawing(Part):
    """One drawing as delivered, with what the manifest says of it."""

    items: Items
    reading: Reading
    unit: DrawingUnit
    plane: Plane
    facade: str = ""
    classes: dict[str, str] = field(default_factory=dict)  #: layer pattern to feature class
    areas: tuple[str, ...] = ()  #: patterns of the layers whose closed lines bound areas of a coverage
    bind: tuple[tuple[str, ...], ...] = ()  #: groups of layer patterns that are drawn as one
    ignored: frozenset[str] = frozenset()  #: layers that are neither judged nor linework that others may meet
    symbols: Symbols = field(default_factory=Symbols)  #: inserts that are no linework of it
    heard: tuple[Heard, ...] = ()  #: what other files of the delivery say of its unit
    confirmed: frozenset[str] = frozenset()  #: what a person confirmed of it: ``unit``, ``plane``

    @property
    def features(self) -> int:
        """Items that rules may look at; of symbols, only what is invalid is counted among them."""
        return int(np.count_nonzero(self._looked_at))

    @property
    def rows(self) -> Index:
        """Rows of these items, without symbols: these are no linework."""
        looked_at = self._looked_at
        looked_at[self.symbols.rows] = False
        return np.flatnonzero(looked_at)

    @property
    def _looked_at(self) -> Flags:
        return ~self.items.paper & np.isin(self.items.role, [Role.LINE, Role.AREA, Role.POINT])

    @property
    def vertices(self) -> int:
        """Vertices of all items."""
        return int(shapely.get_num_coordinates(self.items.geometry).sum())

    def visible_rows(self) -> Flags:
        """(n,) true for what a person sees in model space."""
        return self.items.visible & ~self.items.paper

    def extent(self, rows: Index) -> float:
        """Length of the linework of some items in the plane, metres; what has no finite length adds nothing."""
        chosen = self.items.geometry[rows]
        area = shapely.get_type_id(chosen) == shapely.GeometryType.POLYGON
        lines = np.concatenate([chosen[~area], shapely.get_rings(chosen[area])])
        coordinates, of = shapely.get_coordinates(lines, include_z=True, return_index=True)
        coordinates[:, 2] = np.nan_to_num(coordinates[:, 2])
        with np.errstate(over="ignore", invalid="ignore"):  # coordinates may be anything
            flat = self.plane.project(coordinates, self.unit.metres or 1.0)
            step = np.diff(flat[:, :2], axis=0)[of[1:] == of[:-1]]
            length = np.hypot(step[:, 0], step[:, 1])
        return float(np.sum(length[np.isfinite(length)]))
