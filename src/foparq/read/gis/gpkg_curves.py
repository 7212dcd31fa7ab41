# SPDX-License-Identifier: MIT
"""Arcs in a GeoPackage, replaced by chords of a stated sagitta.

GDAL replaces arcs by chords of four degrees, whatever their radius: at 2 m that is 1.2 mm off, more than the tolerances
of a drawing at 1:50. Curved geometries are therefore taken from the table itself. The three points of an arc stay as
delivered; chords are added between them.
"""

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foparq.columns import Coordinates
from foparq.errors import UnsafeError
from foparq.read.gis.gpkg_safety import Table, opened, quoted

#: registered types that cannot hold an arc
STRAIGHT = frozenset({"POINT", "LINESTRING", "POLYGON", "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON"})
_ENVELOPES = (0, 32, 48, 48, 64)  #: bytes of the envelope in the header of a geometry
_POINT, _LINE, _POLYGON = 1, 2, 3
_COLLECTION, _CIRCULAR, _COMPOUND, _CURVE_POLYGON = 7, 8, 9, 10
_COLLECTIONS = {4: 4, 5: 5, 6: 6, 7: 7, 11: 5, 12: 6}  #: type to the type that holds its straight parts
_CURVED = frozenset({7, 8, 9, 10, 11, 12})
_DEEPEST = 32
_RELATIVE = 1e-4  #: sagitta over the size of a curve where the unit is unknown
_LONGEST = 1_000_000_000


class _OddError(Exception):
    """The bytes are no well-known binary of a known type."""


def chords_of(path: Path, table: Table, *, sagitta: float | None, vertices: int, seconds: float) -> dict[int, bytes]:
    """Curved geometries of one table with chords instead of arcs.

    Parameters
    ----------
    path : Path
        GeoPackage.
    table : Table
        A plain table of it.
    sagitta : float or None, drawing units
        Greatest distance between arc and chord; one ten-thousandth of each arc's chord if ``None``.
    vertices : int
        Most vertices of all arcs together.
    seconds : float
        Time for the whole table.

    Returns
    -------
    dict
        Feature id to well-known binary. Features without arcs, and those that cannot be understood, are left out.

    Raises
    ------
    UnsafeError
        If the chords would have more vertices than allowed, or the time runs out.
    """
    stroke = _Stroke(sagitta, vertices, path.name)
    found: dict[int, bytes] = {}
    for fid, wkb in _curved_rows(path, table, seconds):
        try:
            straight, _ = stroke.straighten(wkb, 0, 0)
        except (_OddError, struct.error, ValueError, IndexError):
            continue
        found[fid] = straight
    return found


def _curved_rows(path: Path, table: Table, seconds: float) -> Iterator[tuple[int, bytes]]:
    query = f"SELECT rowid, {quoted(table.column)} FROM {quoted(table.name)}"  # noqa: S608 - quoted
    with opened(path, seconds, longest=_LONGEST) as connection:
        for fid, blob in connection.execute(query):
            if not isinstance(blob, bytes) or len(blob) < 13 or blob[:2] != b"GP":  # noqa: PLR2004 - header and type
                continue
            envelope = blob[3] >> 1 & 7
            if envelope >= len(_ENVELOPES):
                continue
            wkb = blob[8 + _ENVELOPES[envelope] :]
            if len(wkb) > 5 and _head(wkb, 0)[1] in _CURVED:  # noqa: PLR2004 - byte order and type
                yield int(fid), wkb


def _head(wkb: bytes, at: int) -> tuple[str, int, bool, bool]:
    # Byte order, type, has Z, has M; in the manner of ISO, which GeoPackage prescribes.
    order = "<" if wkb[at] else ">"
    (code,) = struct.unpack_from(f"{order}I", wkb, at + 1)
    return order, code % 1000, code // 1000 in (1, 3), code // 1000 in (2, 3)


@dataclass
class _Stroke:
    """Turns arcs into chords and counts them."""

    sagitta: float | None
    vertices: int
    file: str

    def straighten(self, wkb: bytes, at: int, depth: int) -> tuple[bytes, int]:
        """Well-known binary without arcs and measures of the geometry at an offset, and the offset behind it."""
        order, kind, z, m = _head(wkb, at)
        if depth > _DEEPEST:
            raise _OddError
        if kind == _POINT:
            points, end = _read(wkb, at + 5, order, 1, z, m)
            return _start(_POINT, z) + points.tobytes(), end
        if kind in (_LINE, _CIRCULAR, _COMPOUND):
            points, end = self._curve(wkb, at, depth)
            return _start(_LINE, z) + _packed(points), end
        (count,) = struct.unpack_from(f"{order}I", wkb, at + 5)
        at += 9
        pieces = []
        for _ in range(count):
            if kind == _POLYGON:
                points, at = _counted(wkb, at, order, z, m)
                pieces.append(_packed(points))
            elif kind == _CURVE_POLYGON:
                points, at = self._curve(wkb, at, depth + 1)
                pieces.append(_packed(points))
            elif kind in _COLLECTIONS:
                piece, at = self.straighten(wkb, at, depth + 1)
                pieces.append(piece)
            else:
                raise _OddError
        straight = _COLLECTIONS.get(kind, _POLYGON)
        return _start(straight, z) + struct.pack("<I", count) + b"".join(pieces), at

    def _curve(self, wkb: bytes, at: int, depth: int) -> tuple[Coordinates, int]:
        # Vertices of a line, an arc string or a compound of both.
        order, kind, z, m = _head(wkb, at)
        if kind == _COMPOUND and depth <= _DEEPEST:
            (count,) = struct.unpack_from(f"{order}I", wkb, at + 5)
            at += 9
            pieces: list[Coordinates] = []
            for _ in range(count):
                points, at = self._curve(wkb, at, depth + 1)
                joined = pieces and len(points) and np.array_equal(pieces[-1][-1], points[0])
                pieces.append(points[1:] if joined else points)
            return (np.concatenate(pieces) if pieces else np.empty((0, 2 + z))), at
        if kind not in (_LINE, _CIRCULAR):
            raise _OddError
        points, at = _counted(wkb, at + 5, order, z, m)
        return (points if kind == _LINE else self._arcs(points)), at

    def _arcs(self, points: Coordinates) -> Coordinates:
        if len(points) == 0:
            return points
        if len(points) < 3 or len(points) % 2 == 0:  # noqa: PLR2004 - an arc has three points, the next two more
            raise _OddError
        pieces = [points[:1]]
        for first in range(0, len(points) - 2, 2):
            pieces += self._arc(points[first], points[first + 1], points[first + 2])
        return np.concatenate(pieces)

    def _arc(self, start: Coordinates, middle: Coordinates, end: Coordinates) -> list[Coordinates]:
        centre = _centre(start[:2], middle[:2], end[:2])
        if centre is None:
            return [middle[None], end[None]]
        radius = math.hypot(*(start[:2] - centre))
        from_start, by_middle, to_end = (math.atan2(*(point[:2] - centre)[::-1]) for point in (start, middle, end))
        whole = np.array_equal(start[:2], end[:2])
        turn = 1.0 if whole or _turns_left(start[:2], middle[:2], end[:2]) else -1.0
        pieces = []
        legs = ((start, middle, from_start, by_middle), (middle, end, by_middle, to_end))
        for one, other, here, there in legs:
            sweep = math.pi if whole else (turn * (there - here)) % (2 * math.pi)
            steps = self._steps(radius, sweep)
            share = np.arange(1, steps) / steps
            along = here + turn * sweep * share
            chord = one + (other - one) * share[:, None]
            chord[:, 0] = centre[0] + radius * np.cos(along)
            chord[:, 1] = centre[1] + radius * np.sin(along)
            pieces += [chord, other[None]]
        return pieces

    def _steps(self, radius: float, sweep: float) -> int:
        # A chord over the angle a is r (1 - cos(a / 2)) from its arc.
        sagitta = radius * _RELATIVE if self.sagitta is None else self.sagitta
        step = 2 * math.acos(max(1 - sagitta / radius, 0.0)) if sagitta < radius else math.pi
        wanted = sweep / step if step > 0 else math.inf
        if not wanted < self.vertices:
            raise UnsafeError("read.too-many-vertices", file=self.file, value=str(wanted), limit=self.vertices)
        steps = max(1, math.ceil(wanted))
        self.vertices -= steps
        return steps


def _centre(start: Coordinates, middle: Coordinates, end: Coordinates) -> Coordinates | None:
    # Centre of the circle through three points; None if they lie on a line. A whole circle is given by its diameter.
    if not np.isfinite([start, middle, end]).all():
        return None
    if np.array_equal(start, end):
        return None if np.array_equal(start, middle) else (start + middle) / 2
    a, b = middle - start, end - start
    cross = 2 * (a[0] * b[1] - a[1] * b[0])
    if abs(cross) <= 1e-12 * math.hypot(*a) * math.hypot(*b):
        return None
    aa, bb = a @ a, b @ b
    centre: Coordinates = start + np.array([b[1] * aa - a[1] * bb, a[0] * bb - b[0] * aa]) / cross
    return centre


def _turns_left(start: Coordinates, middle: Coordinates, end: Coordinates) -> bool:
    a, b = middle - start, end - middle
    return bool(a[0] * b[1] - a[1] * b[0] > 0)


def _counted(wkb: bytes, at: int, order: str, z: bool, m: bool) -> tuple[Coordinates, int]:  # noqa: FBT001 - two facts
    (count,) = struct.unpack_from(f"{order}I", wkb, at)
    return _read(wkb, at + 4, order, count, z, m)


def _read(wkb: bytes, at: int, order: str, count: int, z: bool, m: bool) -> tuple[Coordinates, int]:  # noqa: FBT001
    width = 2 + z + m
    end = at + 8 * width * count
    if end > len(wkb):
        raise _OddError
    values = np.frombuffer(wkb, dtype=f"{order}f8", count=width * count, offset=at).reshape(count, width)
    return np.ascontiguousarray(values[:, : 2 + z], dtype="<f8"), end


def _start(kind: int, z: bool) -> bytes:  # noqa: FBT001 - a fact
    return struct.pack("<BI", 1, kind + 1000 * z)


def _packed(points: Coordinates) -> bytes:
    return struct.pack("<I", len(points)) + np.ascontiguousarray(points, dtype="<f8").tobytes()
