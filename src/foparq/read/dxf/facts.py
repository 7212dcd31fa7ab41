# SPDX-License-Identifier: MIT
"""Plain numbers and texts of DXF entities. The only place where an entity is asked; nothing is computed here.

A damaged entity makes ezdxf raise almost anything. :func:`facts_of` turns that into :class:`MalformedError`, so that
the entity can be named and the rest of the drawing is read. What is computed from the facts lies outside this net.
"""

import struct
from collections.abc import Callable
from typing import Any

from ezdxf.entities.dxfentity import DXFTagStorage
from ezdxf.lldxf.const import DXFError
from ezdxf.math import fit_points_to_cad_cv
from ezdxf.xclip import XClip

from foparq.model.drawing import SkippedReason
from foparq.read.dxf.curves import Point
from foparq.read.dxf.kinds import UNSEEN, Unseen
from foparq.read.dxf.records import (
    ArcFacts,
    Common,
    EllipseFacts,
    FaceFacts,
    Facts,
    InsertFacts,
    LineFacts,
    PlaceFacts,
    SplineFacts,
)

#: what ezdxf lets through when an entity or a file is damaged
LEAKS: tuple[type[Exception], ...] = (
    DXFError, ValueError, TypeError, LookupError, AttributeError, ArithmeticError, RecursionError, AssertionError,
    NotImplementedError, StopIteration, EOFError, struct.error,
)  # fmt: skip


STAND_IN = "foparq:malformed:"  #: before the kind of an entity that could not be loaded, in a text in its place


class MalformedError(Exception):
    """An entity that cannot be understood."""


_UP: Point = (0.0, 0.0, 1.0)


def common_of(entity: Any) -> Common:  # noqa: ANN401 - ezdxf entities share no useful type
    """Layer, handle, colour and visibility of an entity; damaged values become the defaults of the format."""
    found = entity.dxf.all_existing_dxf_attribs()
    if isinstance(entity, DXFTagStorage):  # of a type that ezdxf keeps as it is
        found = {**found, **entity.graphic_properties()}
    layer, handle, colour = found.get("layer"), found.get("handle"), found.get("color", 256)
    return Common(
        kind=_lost(entity) or str(entity.dxftype()),
        handle=handle if isinstance(handle, str) else "",
        layer=layer if isinstance(layer, str) and layer else "0",
        colour=colour if isinstance(colour, int) and 0 <= colour <= 257 else 256,  # noqa: PLR2004 - AutoCAD colour index
        invisible=bool(found.get("invisible", 0)),
    )


def facts_of(entity: Any) -> Facts:  # noqa: ANN401
    """Facts of an entity; :class:`Unseen` if it has none that an audit could use.

    Raises
    ------
    MalformedError
        If the entity is damaged.
    """
    kind = entity.dxftype()
    if _lost(entity):
        raise MalformedError
    if kind in UNSEEN:
        return Unseen(UNSEEN[kind])
    reader = _READERS.get(kind)
    if reader is None:
        return Unseen(SkippedReason.UNSUPPORTED)
    try:
        return reader(entity, entity.dxf.all_existing_dxf_attribs())
    except LEAKS as error:
        raise MalformedError(str(error)) from error


def _lost(entity: Any) -> str:  # noqa: ANN401
    """Kind of the entity in whose place a text stands; ``""`` for any other."""
    text = entity.dxf.get("text", "") if entity.dxftype() == "TEXT" else ""
    return text.removeprefix(STAND_IN) if isinstance(text, str) and text.startswith(STAND_IN) else ""


Attributes = dict[str, Any]


def _point(value: Any) -> Point:  # noqa: ANN401
    x, y, z = value.xyz
    return float(x), float(y), float(z)


def _extrusion(found: Attributes) -> Point:
    return _point(found["extrusion"]) if "extrusion" in found else _UP


def _line(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    return LineFacts([_point(found["start"]), _point(found["end"])], None, closed=False, extrusion=_UP)


def _lwpolyline(entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    z = float(found.get("elevation", 0.0))
    rows = [(float(x), float(y), float(bulge)) for x, y, _, _, bulge in entity.lwpoints]
    bulges = [row[2] for row in rows]
    points = [(x, y, z) for x, y, _ in rows]
    return LineFacts(points, bulges if any(bulges) else None, bool(found.get("flags", 0) & 1), _extrusion(found))


def _polyline(entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    flags = int(found.get("flags", 0))
    if flags & 16 or flags & 64:  # mesh or polyface
        return Unseen(SkippedReason.SURFACE)
    vertices = list(entity.vertices)
    if flags & 4:  # spline fit: the frame of control points is not drawn
        vertices = [vertex for vertex in vertices if not vertex.dxf.get("flags", 0) & 16]
    points = [_point(vertex.dxf.location) for vertex in vertices]
    if flags & 8:  # three-dimensional: world coordinates, straight
        return LineFacts(points, None, bool(flags & 1), _UP)
    z = _point(found["elevation"])[2] if "elevation" in found else 0.0
    bulges = [float(vertex.dxf.get("bulge", 0.0)) for vertex in vertices]
    raised = [(x, y, z or own) for x, y, own in points]
    return LineFacts(raised, bulges if any(bulges) else None, bool(flags & 1), _extrusion(found))


def _circle(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    return ArcFacts(_point(found["center"]), float(found["radius"]), 0.0, 360.0, full=True, extrusion=_extrusion(found))


def _arc(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    start, end = float(found.get("start_angle", 0.0)), float(found.get("end_angle", 360.0))
    return ArcFacts(
        _point(found["center"]), float(found["radius"]), start, end, full=False, extrusion=_extrusion(found)
    )


def _ellipse(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    start, end = float(found.get("start_param", 0.0)), float(found.get("end_param", 6.283185307179586))
    centre, major = _point(found["center"]), _point(found["major_axis"])
    return EllipseFacts(centre, major, float(found.get("ratio", 1.0)), start, end, _extrusion(found))


def _spline(entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    closed = bool(int(found.get("flags", 0)) & 1)
    control = [_triple(row) for row in entity.control_points]
    if control:
        knots, weights = [float(knot) for knot in entity.knots], [float(weight) for weight in entity.weights]
        return SplineFacts(control, knots, weights, int(found.get("degree", 3)), closed)
    fit = [_triple(row) for row in entity.fit_points]
    if not fit:
        return Unseen(SkippedReason.NO_GEOMETRY)
    tangents = None
    if "start_tangent" in found and "end_tangent" in found:
        tangents = [found["start_tangent"], found["end_tangent"]]
    curve = fit_points_to_cad_cv(fit, tangents=tangents)
    knots = [float(knot) for knot in curve.knots()]
    return SplineFacts([_point(point) for point in curve.control_points], knots, [], int(curve.degree), closed)


def _triple(row: Any) -> Point:  # noqa: ANN401
    x, y, z = row
    return float(x), float(y), float(z)


def _face(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    corners = [_point(found[name]) for name in ("vtx0", "vtx1", "vtx2", "vtx3") if name in found]
    return FaceFacts(corners, _UP)


def _solid(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    corners = [_point(found[name]) for name in ("vtx0", "vtx1", "vtx3", "vtx2") if name in found]  # corners run in a Z
    return FaceFacts(corners, _extrusion(found))


def _place(name: str, *, own_system: bool) -> "Reader":
    def read(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
        return PlaceFacts(_point(found[name]), _extrusion(found) if own_system else _UP)

    return read


def _dimension(_entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    if "text_midpoint" in found:
        return PlaceFacts(_point(found["text_midpoint"]), _extrusion(found))
    return PlaceFacts(_point(found["defpoint"]), _UP)


def _leader(entity: Any, _found: Attributes) -> Facts:  # noqa: ANN401
    return PlaceFacts(_triple(entity.vertices[0]), _UP)


def _multileader(entity: Any, _found: Attributes) -> Facts:  # noqa: ANN401
    return PlaceFacts(_point(entity.context.base_point), _UP)


def _hatch(entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    elevation = _point(found["elevation"])[2] if "elevation" in found else 0.0
    for path in entity.paths:
        for vertex in getattr(path, "vertices", ()):
            return PlaceFacts((float(vertex[0]), float(vertex[1]), elevation), _extrusion(found))
        for edge in getattr(path, "edges", ()):
            start = edge.start_point
            return PlaceFacts((float(start[0]), float(start[1]), elevation), _extrusion(found))
    return Unseen(SkippedReason.NO_GEOMETRY)


def _insert(entity: Any, found: Attributes) -> Facts:  # noqa: ANN401
    return InsertFacts(
        name=str(found["name"]),
        point=_point(found["insert"]) if "insert" in found else (0.0, 0.0, 0.0),
        scale=(float(found.get("xscale", 1.0)), float(found.get("yscale", 1.0)), float(found.get("zscale", 1.0))),
        rotation=float(found.get("rotation", 0.0)),
        extrusion=_extrusion(found),
        rows=max(1, int(found.get("row_count", 1))),
        columns=max(1, int(found.get("column_count", 1))),
        row_spacing=float(found.get("row_spacing", 0.0)),
        column_spacing=float(found.get("column_spacing", 0.0)),
        attributes=tuple(entity.attribs),
        clipped=_clipped(entity),
    )


def _clipped(entity: Any) -> bool:  # noqa: ANN401
    if not entity.has_extension_dict:
        return False
    clip = XClip(entity)
    return clip.has_clipping_path and clip.is_clipping_enabled


Reader = Callable[[Any, Attributes], Facts]

_READERS: dict[str, Reader] = {
    "LINE": _line, "LWPOLYLINE": _lwpolyline, "POLYLINE": _polyline, "CIRCLE": _circle, "ARC": _arc,
    "ELLIPSE": _ellipse, "SPLINE": _spline, "HELIX": _spline, "POINT": _place("location", own_system=False),
    "3DFACE": _face, "SOLID": _solid, "TRACE": _solid, "HATCH": _hatch, "MPOLYGON": _hatch, "INSERT": _insert,
    "TEXT": _place("insert", own_system=True), "ATTRIB": _place("insert", own_system=True),
    "ATTDEF": _place("insert", own_system=True), "MTEXT": _place("insert", own_system=False),
    "SHAPE": _place("insert", own_system=True), "TOLERANCE": _place("insert", own_system=False),
    "ACAD_TABLE": _place("insert", own_system=False), "DIMENSION": _dimension, "ARC_DIMENSION": _dimension,
    "LARGE_RADIAL_DIMENSION": _dimension, "LEADER": _leader, "MULTILEADER": _multileader, "MLEADER": _multileader,
}  # fmt: skip
