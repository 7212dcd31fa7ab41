# SPDX-License-Identifier: MIT
"""PLY: polygons and strips of triangles, in text or binary of either byte order.

Coordinates in text are read as they are written, whatever their type is called; those of a binary file are widened
exactly. Other elements than vertices, faces and strips are not read, and told.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Coordinates, Index
from foparq.errors import UnreadableError
from foparq.model.drawing import Repair, Skipped, SkippedReason
from foparq.model.mesh import MeshReading, RawMesh, Texture
from foparq.read.mesh.made import Delivered, joined, made, starts_of
from foparq.read.mesh.ply_header import Element, Header, read_header
from foparq.read.mesh.ply_rows import Column, Table, binary_rows
from foparq.read.mesh.ply_text import text_rows
from foparq.read.mesh.strips import triangles_of_strips

_AXES = ("x", "y", "z")
_CORNERS = ("vertex_indices", "vertex_index")
_BY_VERTEX = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))
_LINES = frozenset({"edge", "edges", "line", "lines", "point", "points"})
_NO_SURFACE = frozenset({"camera", "cameras", "material", "materials", "light", "lights", "obj_info"})
_PADDING = b"\0\t\n\r \x1a"


def read_ply(delivered: Delivered) -> RawMesh:
    """Mesh of a PLY file.

    Raises
    ------
    UnreadableError
        If the header is none, the file is cut off or longer than it says, or a row does not fit.
    UnsafeError
        If it holds more vertices or faces than the limits allow.

    Notes
    -----
    O(n). Triangles of a strip that name a vertex twice join two strips in it and are no faces.
    """
    header = read_header(delivered.data, delivered.name)
    _hold(delivered, header)
    tables, repairs = _tables(delivered, header)
    vertex = tables["vertex"]
    points = np.column_stack([vertex[axis].value.astype(np.float64) for axis in _AXES])
    corners, starts = _faces(delivered, tables)
    texture, more = _texture(header, tables, corners, starts, len(points))
    reading = MeshReading(
        version=f"PLY {header.form} {header.version}",
        repairs=(*repairs, *more),
        skipped=tuple(_skipped(one) for one in header.elements if one.rows and one.name not in _READ),
        images=header.images,
    )
    return made(delivered, points, corners, starts, reading, texture=texture)


def read_ply_points(delivered: Delivered) -> tuple[Coordinates, str]:
    """Vertices (n, 3) of a PLY file, with faces or without, and the version of the format.

    Raises
    ------
    UnreadableError, UnsafeError
        As :func:`read_ply` does; a file without faces is none of these.
    """
    header = read_header(delivered.data, delivered.name)
    _hold(delivered, header)
    vertex = _tables(delivered, header)[0]["vertex"]
    # One axis after the other: a cloud takes half of the memory that a read may use.
    points = np.empty((len(vertex["x"].value), len(_AXES)))
    for column, axis in enumerate(_AXES):
        points[:, column] = vertex[axis].value
    return points, f"PLY {header.form} {header.version}"


_READ = ("vertex", "face", "tristrips")


def _hold(delivered: Delivered, header: Header) -> None:
    """Refuse a header without coordinates, or that announces too much."""
    elements = {one.name: one for one in header.elements}
    vertex = elements.get("vertex")
    single = {one.name for one in vertex.properties if one.count is None} if vertex else set()
    for axis in _AXES:
        if axis not in single:
            raise UnreadableError(
                "mesh.header-lacks", file=delivered.name, value=f"vertex {axis}", example=f"property float {axis}"
            )
    for name in ("face", "tristrips"):
        lists = [one.name for one in elements[name].properties if one.count is not None] if name in elements else []
        if name in elements and elements[name].rows and not set(_CORNERS) & set(lists):
            raise UnreadableError(
                "mesh.header-lacks", file=delivered.name, value=f"{name} vertex_indices",
                example="property list uchar int vertex_indices",
            )  # fmt: skip
    # First what the file cannot hold, then what is too much.
    # A row of text takes a digit and the end of its line at least.
    for one in header.elements:
        need = 2 * one.rows - 1 if header.text and one.properties else one.rows * one.least
        delivered.hold_bytes(one.name, one.rows, need, header.end)
    delivered.hold_vertices(elements["vertex"].rows)
    delivered.hold_faces(elements["face"].rows if "face" in elements else 0)


def _tables(delivered: Delivered, header: Header) -> tuple[dict[str, Table], tuple[Repair, ...]]:
    if header.text:
        return text_rows(delivered, header), ()
    tables, at = dict[str, Table](), header.end
    for element in header.elements:
        table, at = binary_rows(delivered, element, at)
        if element.name in _READ:
            tables[element.name] = table
    rest = delivered.data[at:]
    if not rest:
        return tables, ()
    # Zeros and ends of lines are padding; anything else may be rows that the header does not count.
    if rest.strip(_PADDING):
        raise UnreadableError("mesh.trailing", file=delivered.name, byte=at, value=len(rest))
    return tables, (Repair(code="mesh-trailing-bytes", text=str(len(rest))),)


def _faces(delivered: Delivered, tables: dict[str, Table]) -> tuple[Index, Index]:
    corners, counts = list[Index](), list[Index]()
    if "face" in tables and (column := _corners(tables["face"])) is not None and column.count is not None:
        corners.append(_index(delivered, column.value))
        counts.append(column.count)
    if "tristrips" in tables and (column := _corners(tables["tristrips"])) is not None and column.count is not None:
        strips = _index(delivered, column.value)
        triangles = triangles_of_strips(strips, starts_of(column.count))
        delivered.hold_faces(len(triangles) + sum(map(len, counts)))
        corners.append(triangles.reshape(-1))
        counts.append(np.full(len(triangles), 3, dtype=np.intp))
    return joined(corners), starts_of(joined(counts))


def _corners(table: Table) -> Column | None:
    return next((table[name] for name in _CORNERS if name in table), None)


def _index(delivered: Delivered, value: NDArray[Any]) -> Index:
    if value.dtype.kind == "f":
        if not (np.isfinite(value) & (np.trunc(value) == value) & (np.abs(value) < 2.0**53)).all():
            raise UnreadableError("mesh.index", file=delivered.name, key="vertex_indices")
    elif value.dtype.kind == "u" and value.dtype.itemsize == np.dtype(np.intp).itemsize:
        value = np.minimum(value, np.iinfo(np.intp).max)
    return value.astype(np.intp)


def _skipped(element: Element) -> Skipped:
    reason = SkippedReason.UNKNOWN_ELEMENT
    if element.name in _LINES:
        reason = SkippedReason.LINES_AND_POINTS
    elif element.name in _NO_SURFACE:
        reason = SkippedReason.NO_SURFACE
    return Skipped(reason=reason, kind=element.name, layer="", count=element.rows)


def _texture(
    header: Header, tables: dict[str, Table], corners: Index, starts: Index, points: int
) -> tuple[Texture | None, tuple[Repair, ...]]:
    """Texture coordinates by face or by vertex, those by face first."""
    face = tables.get("face", {})
    repairs: tuple[Repair, ...] = ()
    faces = len(starts) - 1
    if "texcoord" in face and face["texcoord"].count is not None and "tristrips" not in tables:
        uv, corner, odd = _by_face(face["texcoord"], starts)
        if odd:
            repairs = (Repair(code="mesh-texture-corners", text=str(odd)),)
    else:
        pair = next((pair for pair in _BY_VERTEX if set(pair) <= set(tables["vertex"])), None)
        if pair is None:
            return None, ()
        uv = np.column_stack([tables["vertex"][name].value.astype(np.float64) for name in pair])
        corner = np.where((corners >= 0) & (corners < points), corners, -1)
    material = np.full(faces, 0 if len(header.images) == 1 else -1, dtype=np.intp)
    if "texnumber" in face and face["texnumber"].count is None and len(face["texnumber"].value) == faces:
        number = face["texnumber"].value
        known = (number >= 0) & (number < len(header.images))
        material = np.where(known, number, -1).astype(np.intp)
    materials = tuple(("", image) for image in header.images)
    return Texture(uv=uv, corner=corner, material=material, materials=materials), repairs


def _by_face(column: Column, starts: Index) -> tuple[Coordinates, Index, int]:
    """Texture coordinates that faces list, two numbers a corner, and how many lists are of another length."""
    count = np.diff(starts)
    given = column.count if column.count is not None else np.zeros(len(count), dtype=np.intp)
    right = given == 2 * count
    value = column.value.astype(np.float64)
    if not right.all():
        value = value[np.repeat(right, given)]
    corner = np.full(int(starts[-1]), -1, dtype=np.intp)
    corner[np.repeat(right, count)] = np.arange(len(value) // 2)
    return value.reshape(-1, 2), corner, int(np.count_nonzero(~right & (given > 0)))
