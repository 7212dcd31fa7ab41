# SPDX-License-Identifier: MIT
"""A CAD export among GIS files: what GDAL's DXF driver says of each row, and so QGIS and ogr2ogr with it.

It writes columns ``Layer``, ``PaperSpace``, ``SubClasses`` (``"AcDbEntity:AcDbHatch"``), ``EntityHandle``, ``Text``,
and ``BlockName`` or ``Block`` where blocks are kept. Dimensions are taken apart, into rows that share the handle of the
dimension; block inserts become one collection each, or rows that share the handle of the insert.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Role
from foparq.names import folded

_POINT, _POLYGON, _COLLECTION = 0, 3, 4  #: shapely's type ids; from the last on they are collections
_FIRST = 5  #: handles named in a record of what was skipped
_DEFINING = "defpoints"  #: layer of the points that define a dimension
_MOST_STROKES = 6  #: lines of a dimension: two of extension, and that of the measure in parts

#: entity types by the last of their subclasses
_KINDS = {
    "AcDbLine": "LINE", "AcDbPolyline": "LWPOLYLINE", "AcDb2dPolyline": "POLYLINE", "AcDb3dPolyline": "POLYLINE",
    "AcDbArc": "ARC", "AcDbCircle": "CIRCLE", "AcDbEllipse": "ELLIPSE", "AcDbSpline": "SPLINE", "AcDbHelix": "HELIX",
    "AcDbPoint": "POINT", "AcDbHatch": "HATCH", "AcDbMPolygon": "MPOLYGON", "AcDbText": "TEXT", "AcDbMText": "MTEXT",
    "AcDbAttribute": "ATTRIB", "AcDbAttributeDefinition": "ATTDEF", "AcDbShape": "SHAPE", "AcDbFcf": "TOLERANCE",
    "AcDbTable": "ACAD_TABLE", "AcDbLeader": "LEADER", "AcDbMLeader": "MULTILEADER", "AcDbMline": "MLINE",
    "AcDbTrace": "SOLID", "AcDbFace": "3DFACE", "AcDbPolyFaceMesh": "POLYLINE", "AcDbPolygonMesh": "POLYLINE",
    "AcDbBlockReference": "INSERT", "AcDbMInsertBlock": "INSERT",
}  # fmt: skip
_MESHES = frozenset({"AcDbPolyFaceMesh", "AcDbPolygonMesh"})
_LINES = frozenset({"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "HELIX"})
_LETTERING = frozenset({"TEXT", "MTEXT", "ATTRIB", "ATTDEF"})
_ROLES = {
    **dict.fromkeys(_LINES, Role.LINE), "POINT": Role.POINT, "HATCH": Role.HATCH, "MPOLYGON": Role.HATCH,
    **dict.fromkeys(_LETTERING | {"SHAPE", "TOLERANCE", "ACAD_TABLE", "LEADER", "MULTILEADER"}, Role.ANNOTATION),
    "DIMENSION": Role.ANNOTATION, "SOLID": Role.SURFACE, "3DFACE": Role.SURFACE, "MESH": Role.SURFACE,
}  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class CadColumns:
    """Columns of an export, n rows; texts or ``None``, empty where the table has no such column."""

    subclasses: Texts
    handle: Texts
    text: Texts
    inserted: Texts  #: block that a row inserts, where blocks are kept
    defined: Texts  #: block that a row is a part of, where blocks are kept


@dataclass(frozen=True, slots=True, kw_only=True)
class CadRows:
    """What the rows of an export are, n rows."""

    kind: Texts  #: entity type of the DXF; ``""`` if it is not told
    handle: Texts  #: as written; ``""`` if there is none
    lettering: Flags  #: it is a text of its own, in no block and no dimension
    text: Texts  #: its words, else ``""``
    run: Index  #: number of the entity that rows belong to, in order of the rows
    insert: Flags  #: it is, or belongs to, an insert of a block
    holder: Texts  #: name of that insert, a cell of an array by itself; ``""`` if there is none
    left_out: Texts  #: :class:`SkippedReason` of what becomes no item, else ``""``


def read_cad(columns: CadColumns, layer: Texts, geometry: Geometries) -> CadRows:
    """Entities behind the rows of an export.

    Parameters
    ----------
    columns : CadColumns, n rows
        In the order of feature ids, which is that of the drawing: rows of one entity follow each other.
    layer : (n,) str
    geometry : (n,) shapely geometry
        Collections of several parts only: see :func:`alone`.

    Returns
    -------
    CadRows

    Notes
    -----
    Rows that share a handle are a dimension if a point on ``Defpoints`` is among them and no more strokes than a
    dimension has; or if a text is among them, and other rows show that inserts became collections. Else they are an
    insert. Without subclasses (R12) a text is told by its words, a collection is an insert.
    """
    kind = _kinds(columns.subclasses)
    words = _words(columns.text)
    handle = _words(columns.handle)
    shape = shapely.get_type_id(geometry)
    untold = kind == ""
    kind[untold & (shape == _POINT)] = np.where(words[untold & (shape == _POINT)] == "", "POINT", "TEXT")
    kind[untold & (shape >= _COLLECTION)] = "INSERT"
    kind[untold & (shape == _POLYGON)] = (
        "SOLID"  # R12: a closed line stays a line; what fills is SOLID, TRACE or 3DFACE
    )
    kind[untold & (shape == _POLYGON) & shapely.has_z(geometry)] = "3DFACE"
    run = _runs(handle)
    size = np.bincount(run)[run]
    dimension = _dimensions(kind, layer, run, size, merged=bool(np.any((kind == "INSERT") & (shape >= _COLLECTION))))
    left_out = _left_out(columns, kind, shape)
    lettering = np.isin(kind, list(_LETTERING)) & (words != "") & (size == 1) & (left_out == "")
    kind[dimension] = "DIMENSION"
    drawn = ~np.isin(kind, [name for name, role in _ROLES.items() if role is Role.ANNOTATION])
    insert = drawn & ((kind == "INSERT") | ((size > 1) & (np.bincount(run, drawn)[run] > 1)))
    return CadRows(
        kind=kind, handle=handle, lettering=lettering, text=np.where(lettering, words, ""), run=run, insert=insert,
        holder=_holders(handle, run, insert & (shape >= _COLLECTION), insert), left_out=left_out,
    )  # fmt: skip


def alone(geometry: Geometries) -> Geometries:
    """Geometries, with collections of a single part as that part: some programs make a collection of everything."""
    plain = geometry.copy()
    one = np.flatnonzero((shapely.get_type_id(plain) >= _COLLECTION) & (shapely.get_num_geometries(plain) == 1))
    plain[one] = shapely.get_geometry(plain[one], 0)
    return plain


def roles_of(kind: Texts, role: Texts, part: Geometries) -> Texts:
    """Role of every part: what its entity is, else what its shape is.

    Parameters
    ----------
    kind : (m,) str
        Entity type of each part, ``""`` if unknown.
    role : (m,) str
        Role by shape.
    part : (m,) shapely geometry

    Returns
    -------
    (m,) str
        What fills within an insert is a hatch: closed lines stay lines there.
    """
    roles = role.copy()
    for name in set(kind.tolist()) & _ROLES.keys():
        roles[kind == name] = str(_ROLES[name])
    roles[(kind == "INSERT") & (shapely.get_type_id(part) == _POLYGON)] = str(Role.HATCH)
    return roles


def unfilled(kind: Texts, part: Geometries) -> Geometries:
    """Parts, with closed lines that were exported as areas as the lines that they are."""
    lines = part.copy()
    chosen = np.isin(kind, list(_LINES)) & (shapely.get_type_id(part) == _POLYGON) & ~shapely.is_empty(part)
    rows = np.flatnonzero(chosen & (shapely.get_num_interior_rings(part) == 0))
    if len(rows):
        raised = bool(np.any(shapely.has_z(part[rows])))
        points, of = shapely.get_coordinates(part[rows], include_z=raised, return_index=True)
        lines[rows] = shapely.linestrings(points, indices=of)
    return lines


def skipped_rows(rows: CadRows, layer: Texts, columns: CadColumns) -> tuple[Skipped, ...]:
    """Records of what becomes no item, and of faces, whose edges no rule sees.

    Parameters
    ----------
    layer : (n,) str
    columns : CadColumns, n rows
        Of which the rows were made.
    """
    name = np.where(rows.left_out == SkippedReason.BLOCKS_KEPT, _block(columns), "")
    reason = rows.left_out.copy()
    reason[(reason == "") & np.isin(rows.kind, ["3DFACE", "MESH"])] = SkippedReason.SURFACE.value
    chosen = np.flatnonzero(reason != "")
    keys = list(zip(*(column[chosen].tolist() for column in (reason, rows.kind, layer, name)), strict=True))
    handles: dict[tuple[str, ...], list[str]] = {}
    for key, handle in zip(keys, rows.handle[chosen].tolist(), strict=True):
        known = handles.setdefault(key, [])
        if handle and handle not in known and len(known) < _FIRST:
            known.append(handle)
    return tuple(
        Skipped(reason=SkippedReason(key[0]), kind=key[1] or "INSERT", layer=key[2], name=key[3], count=count,
                handles=tuple(handles[key]))
        for key, count in sorted(Counter(keys).items())
    )  # fmt: skip


def places_of(geometry: Geometries) -> Reals:
    """(n, 3) places of points; a missing height is 0."""
    places: Reals = np.column_stack([shapely.get_x(geometry), shapely.get_y(geometry), shapely.get_z(geometry)])
    places[np.isnan(places)] = 0.0
    return places


def _kinds(subclasses: Texts) -> Texts:
    texts, inverse = np.unique(_words(subclasses).astype(str), return_inverse=True)
    known: Texts = np.empty(len(texts), dtype=object)
    known[:] = [_kind(text.split(":")) for text in texts.tolist()]
    kinds: Texts = known[inverse]
    return kinds


def _kind(classes: Sequence[str]) -> str:
    if any(name.endswith("Dimension") for name in classes):
        return "DIMENSION"
    if _MESHES.intersection(classes):
        return "MESH"
    return _KINDS.get(classes[-1], "")


def _words(texts: Texts) -> Texts:
    words: Texts = np.empty(len(texts), dtype=object)
    words[:] = [text.strip() if isinstance(text, str) else "" for text in texts.tolist()]
    return words


def _runs(handle: Texts) -> Index:
    """Number of the entity of each row: rows in succession that share a handle are of one."""
    fresh = np.ones(len(handle), dtype=bool)
    fresh[1:] = (handle[1:] != handle[:-1]) | (handle[1:] == "")
    return np.cumsum(fresh) - 1


def _dimensions(kind: Texts, layer: Texts, run: Index, size: Index, *, merged: bool) -> Flags:
    def count(rows: Flags) -> Index:
        return np.bincount(run, rows)[run].astype(np.intp)

    defining = np.array([folded(name) == _DEFINING for name in layer.tolist()], dtype=bool) & (kind == "POINT")
    lettered = count(np.isin(kind, list(_LETTERING)))
    whole = count((kind == "INSERT") | (kind == "")) == 0
    strokes = count(np.isin(kind, ["LINE", "ARC"]))
    by_points = (count(defining) > 0) & (lettered <= 1) & (strokes <= _MOST_STROKES)
    # R12 names no kinds: what is neither text nor point is a stroke, an arrow among them.
    untold = (count(defining) > 0) & (lettered <= 1) & (count(kind == "") <= 2 * _MOST_STROKES)
    by_text = merged & (lettered > 0)
    dimension: Flags = (size > 1) & ((whole & (by_points | by_text)) | (untold & (count(kind == "INSERT") == 0)))
    return dimension


def _holders(handle: Texts, run: Index, whole: Flags, insert: Flags) -> Texts:
    """Names of inserts; where several collections have one handle, each is a cell of an array."""
    names: Texts = np.where(insert, handle, "").astype(object)
    rows = np.flatnonzero(whole)
    rows = rows[np.bincount(run[rows], minlength=1)[run[rows]] > 1] if len(rows) else rows
    cells = np.arange(len(rows)) - np.searchsorted(run[rows], run[rows]) + 1
    names[rows] = [f"{name}:{cell}" for name, cell in zip(handle[rows].tolist(), cells.tolist(), strict=True)]
    return names


def _left_out(columns: CadColumns, kind: Texts, shape: Index) -> Texts:
    reason: Texts = np.full(len(kind), "", dtype=object)
    reason[kind == "MLINE"] = SkippedReason.MULTILINE.value
    kept = (_words(columns.inserted) != "") & (shape == _POINT)
    reason[kept | (_words(columns.defined) != "")] = SkippedReason.BLOCKS_KEPT.value
    return reason


def _block(columns: CadColumns) -> Texts:
    """Block that a row inserts or defines."""
    inserted = _words(columns.inserted)
    block: Texts = np.where(inserted == "", _words(columns.defined), inserted).astype(object)
    return block
