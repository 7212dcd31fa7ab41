# SPDX-License-Identifier: MIT
"""Features of a GIS layer as items: one item a part."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, fields

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Holder, Items, Role, no_items
from foparq.read.gis.cad import CadColumns, CadRows, alone, places_of, read_cad, roles_of, skipped_rows, unfilled

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
    cad: CadColumns | None = None  #: what else a CAD export says of its rows


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """What one layer gave."""

    items: Items
    skipped: tuple[Skipped, ...]
    system: str  #: reference system, ``""`` if none
    words: Texts  #: (k,) letterings of a CAD export
    places: Reals  #: (k, 3) where they stand
    on_sheet: Flags  #: (k,) true in paper space


def items_of(layer: LayerRows, *, prefix: str) -> Piece:
    """Items of one layer, and what could not become one.

    Parameters
    ----------
    prefix : str
        Written before the feature id to make the item id unique in the file: ``"plots:"``.

    Returns
    -------
    Piece
        Items: one row a part, in order of feature id and part. ``item`` is prefix and feature id; parts of one feature
        are told apart by a number from 1: ``"plots:7.2"``. In a CAD export the handle stands for the feature id. A
        feature without geometry, or with one that cannot be built (a ring of two points), is a row whose geometry is
        ``None``; it has the kind of its layer. Skipped are surfaces and solids that are no simple features, by kind,
        and what a CAD export holds beside linework.
    """
    geometry: Geometries = shapely.from_wkb(layer.wkb, on_invalid="ignore")
    keep, skipped = _without_exotic(layer, geometry)
    names = np.full(len(geometry), layer.name, dtype=object)
    if layer.layer is not None:
        stated = np.fromiter((isinstance(text, str) and text != "" for text in layer.layer.tolist()), bool, len(names))
        names[stated] = layer.layer[stated]
    single = alone(geometry)
    cad = None if layer.cad is None else read_cad(layer.cad, names, single)
    if cad is not None and layer.cad is not None:
        skipped += skipped_rows(cad, names, layer.cad)
        keep &= cad.left_out == ""
    parts, owner, part = _parts(geometry[keep])
    source = np.flatnonzero(keep)[owner]
    kinds = _kinds(parts, layer.geometry_type)
    named = _Named.of(layer, cad)
    several = np.bincount(named.entity[source])[named.entity[source]] > 1
    if cad is None:
        roles, inserts, holders = _mapped(kinds, _ROLES), *([_texts([""] * len(source))] * 2)
    else:
        number = _numbered(named.entity[source])
        part = np.where(cad.insert[source] | (cad.handle[source] != ""), number, part)
        parts, roles = unfilled(cad.kind[source], parts), roles_of(cad.kind[source], _mapped(kinds, _ROLES), parts)
        inserts = np.where(cad.insert[source], cad.handle[source], "").astype(object)
        holders = _held(cad, names)[source]
        kinds = np.where(cad.kind[source] == "", kinds, cad.kind[source]).astype(object)
    item = _texts(
        f"{prefix}{name}.{number}" if many else f"{prefix}{name}"
        for name, number, many in zip(named.item[source].tolist(), part.tolist(), several.tolist(), strict=True)
    )
    paper = layer.paper[source]
    items = Items(
        geometry=parts, layer=names[source], kind=kinds, role=roles, item=item, handle=named.handle[source],
        inserts=inserts, colour=np.full(len(parts), _BY_LAYER, dtype=np.int32),
        closed=_closed(parts), visible=~paper, paper=paper, holders=holders,
    )  # fmt: skip
    said = np.flatnonzero(np.zeros(len(names), bool) if cad is None else cad.lettering)
    return Piece(
        items=items, skipped=skipped, system=layer.system, words=_texts([]) if cad is None else cad.text[said],
        places=places_of(single[said]), on_sheet=layer.paper[said],
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Named:
    """How the n features of a layer are called."""

    handle: Texts  #: (n,) handle of a CAD export, else the feature id
    item: Texts  #: (n,) the same, unique
    entity: Index  #: (n,) number of what parts are counted of: a feature, or all rows of one handle

    @classmethod
    def of(cls, layer: LayerRows, cad: CadRows | None) -> "_Named":
        fid = _texts(map(str, layer.fid.tolist()))
        if cad is None:
            return cls(fid, fid, np.arange(len(fid)))
        handle = np.where(cad.handle == "", fid, cad.handle).astype(object)
        # A handle that stands for several entities, in an export of several drawings, is no id.
        first = np.unique(cad.run, return_index=True)[1]
        times = Counter(handle[first].tolist())
        item = _texts(
            name if times[name] == 1 else f"{name}~{row}" for name, row in zip(handle, fid[first][cad.run], strict=True)
        )
        return cls(handle, item, cad.run)


def _numbered(entity: Index) -> Index:
    """Number of each row among those of its entity, from 1; rows of one follow each other."""
    return np.arange(len(entity)) - np.searchsorted(entity, entity) + 1


def _held(cad: CadRows, layer: Texts) -> Texts:
    """Inserts that hold the rows of a CAD export; their blocks are not told."""
    known = np.where(
        cad.kind == "INSERT", layer, ""
    )  # of rows that are only a part, the layer is not that of the insert
    return _texts(
        str(Holder(name, on, "")) if name else "" for name, on in zip(cad.holder.tolist(), known.tolist(), strict=True)
    )


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
