# SPDX-License-Identifier: MIT
"""Features of a GIS layer as items: one item a part."""

from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Texts
from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Items, Role, no_items

#: columns whose text is the layer of a row, as CAD programs export it
LAYER_COLUMNS = ("layer", "Layer", "LAYER", "camada", "Camada", "CAMADA")
_MULTI = 4  #: shapely's type ids from here on are collections
_KINDS = np.array(
    ["Point", "LineString", "LineString", "Polygon", "Point", "LineString", "Polygon", "GeometryCollection"],
    dtype=object,
)
_ROLES = {"Point": Role.POINT, "LineString": Role.LINE, "Polygon": Role.AREA, "GeometryCollection": Role.LINE}
#: names of well-known binary types that are no simple feature; 1 to 7 are
_EXOTIC = {
    8: "CircularString", 9: "CompoundCurve", 10: "CurvePolygon", 11: "MultiCurve", 12: "MultiSurface", 13: "Curve",
    14: "Surface", 15: "PolyhedralSurface", 16: "TIN", 17: "Triangle",
}  # fmt: skip
_DEEPEST = 64  #: collections within collections that are taken apart
_FIRST = 5  #: handles named in a record of what was skipped
_BY_LAYER = 256  #: AutoCAD's colour index of what has no colour of its own


@dataclass(frozen=True, slots=True, kw_only=True)
class LayerRows:
    """One layer as read, n features."""

    name: str
    geometry_type: str  #: as declared: ``"MultiLineString"``, ``"Unknown"``
    system: str  #: reference system, ``""`` if none
    fid: Index  #: (n,)
    wkb: Texts  #: (n,) bytes, or ``None``
    layer: Texts | None  #: (n,) the file's own layer column, if it has one
    paper: Flags  #: (n,) true in the paper space of a CAD export


def items_of(layer: LayerRows, *, prefix: str) -> tuple[Items, tuple[Skipped, ...]]:
    """Items of one layer, and what could not become one.

    Parameters
    ----------
    prefix : str
        Written before the feature id to make the item id unique in the file: ``"plots:"``.

    Returns
    -------
    items : Items
        One row a part, in order of feature id and part. ``item`` is prefix and feature id; parts of one feature are
        told apart by a number from 1: ``"plots:7.2"``. A feature without geometry, or with one that cannot be built
        (a ring of two points), is a row whose geometry is ``None``; it has the kind of its layer.
    skipped : tuple of Skipped
        Surfaces and solids that are no simple features, by kind.
    """
    geometry: Geometries = shapely.from_wkb(layer.wkb, on_invalid="ignore")
    keep, skipped = _without_exotic(layer, geometry)
    parts, owner, part = _parts(geometry[keep])
    source = np.flatnonzero(keep)[owner]
    kinds = _kinds(parts, layer.geometry_type)
    names = np.full(len(source), layer.name, dtype=object)
    if layer.layer is not None:
        own = layer.layer[source]
        stated = np.fromiter((isinstance(text, str) and text != "" for text in own.tolist()), bool, len(own))
        names[stated] = own[stated]
    handle = _texts(map(str, layer.fid[source].tolist()))
    several = np.bincount(owner, minlength=int(keep.sum()))[owner] > 1
    item = _texts(
        f"{prefix}{fid}.{number}" if many else f"{prefix}{fid}"
        for fid, number, many in zip(handle.tolist(), part.tolist(), several.tolist(), strict=True)
    )
    paper = layer.paper[source]
    return Items(
        geometry=parts, layer=names, kind=kinds, role=_mapped(kinds, _ROLES), item=item, handle=handle,
        inserts=np.full(len(parts), "", dtype=object), colour=np.full(len(parts), _BY_LAYER, dtype=np.int32),
        closed=_closed(parts), visible=~paper, paper=paper, holders=np.full(len(parts), "", dtype=object),
    ), skipped  # fmt: skip


def join_items(pieces: list[Items]) -> Items:
    """Rows of several tables of items, one after the other."""
    if not pieces:
        return no_items()
    columns = [column.name for column in fields(Items)]
    return Items(**{name: np.concatenate([getattr(piece, name) for piece in pieces]) for name in columns})


def _without_exotic(layer: LayerRows, geometry: Geometries) -> tuple[Flags, tuple[Skipped, ...]]:
    keep = np.ones(len(geometry), dtype=bool)
    found: dict[str, list[str]] = {}
    for row in np.flatnonzero(shapely.is_missing(geometry)).tolist():
        kind = _EXOTIC.get(_type_code(layer.wkb[row]))
        if kind:
            keep[row] = False
            found.setdefault(kind, []).append(str(layer.fid[row]))
    skipped = tuple(
        Skipped(
            reason=SkippedReason.UNSUPPORTED_GEOMETRY,
            kind=kind,
            layer=layer.name,
            count=len(handles),
            handles=tuple(handles[:_FIRST]),
        )
        for kind, handles in sorted(found.items())
    )
    return keep, skipped


def _type_code(wkb: object) -> int:
    # Type of well-known binary without its marks for Z and M, in the manner of ISO or of PostGIS; 0 if there is none.
    if not isinstance(wkb, bytes) or len(wkb) < 5:  # noqa: PLR2004 - byte order and type
        return 0
    return (int.from_bytes(wkb[1:5], "little" if wkb[0] else "big") & 0x0FFFFFFF) % 1000


def _parts(geometry: Geometries) -> tuple[Geometries, Index, Index]:
    # Parts (m,), their owner (m,) and their number within the owner from 1 (m,); an empty collection stays whole.
    owner: Index = np.arange(len(geometry))
    for _ in range(_DEEPEST):
        whole = ~((shapely.get_type_id(geometry) >= _MULTI) & ~shapely.is_empty(geometry))
        if whole.all():
            break
        pieces, of = shapely.get_parts(geometry[~whole], return_index=True)
        owners = np.concatenate([owner[whole], owner[~whole][of]])
        order = np.argsort(owners, kind="stable")
        geometry, owner = np.concatenate([geometry[whole], pieces])[order], owners[order]
    start = np.searchsorted(owner, owner, side="left")
    return geometry, owner, np.arange(len(owner)) - start + 1


def _kinds(geometry: Geometries, declared: str) -> Texts:
    missing = shapely.is_missing(geometry)
    kinds: Texts = _KINDS[np.where(missing, 0, shapely.get_type_id(geometry))]
    plain = declared.removesuffix(" Z").removeprefix("Multi").replace("3D ", "")
    if plain not in _ROLES or plain == "GeometryCollection":
        seen = set(kinds[~missing].tolist())
        plain = seen.pop() if len(seen) == 1 else "LineString"
    kinds[missing] = plain
    return kinds


def _closed(geometry: Geometries) -> Flags:
    closed: Flags = shapely.get_type_id(geometry) == shapely.GeometryType.POLYGON
    lines = np.flatnonzero(
        (shapely.get_type_id(geometry) == shapely.GeometryType.LINESTRING) & ~shapely.is_empty(geometry)
    )
    first, last = (shapely.get_coordinates(shapely.get_point(geometry[lines], end), include_z=True) for end in (0, -1))
    closed[lines] = np.all((first == last) | (np.isnan(first) & np.isnan(last)), axis=1)
    return closed


def _mapped(texts: Texts, table: dict[str, Role]) -> Texts:
    return _texts(str(table[text]) for text in texts.tolist())


def _texts(values: Iterable[str]) -> Texts:
    listed = list(values)
    column: Texts = np.empty(len(listed), dtype=object)
    column[:] = listed
    return column
