# SPDX-License-Identifier: MIT
"""How the drawings lie in ``findings.gpkg``: on their file, or in their planes side by side; and ``desenho_a``."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from foparq.columns import Coordinates, Geometries, Reals, Texts
from foparq.model.drawing import Drawing
from foparq.report.page.frame import without_strays
from foparq.report.page.paths import strokes_of
from foparq.report.record import AuditRecord
from foparq.report.words import printable

LAYER = "desenho_a"

#: axes without a place on the Earth: GeoPackage reserves srs_id -1 for it (OGC 12-128, requirement 11)
UNDEFINED = (
    'ENGCRS["Undefined Cartesian SRS",EDATUM["unknown"],CS[Cartesian,2],'
    'AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]]]'
)

#: what a system may be called: GDAL opens files and addresses that bear its name
_CODE = re.compile(r"[A-Za-z]+:\d{1,8}")
_GAP = 0.1  # of the widest drawing, between two
_FARTHEST = 1e12  # metres or units: a frame goes no farther


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """One drawing in ``findings.gpkg``."""

    drawing: Drawing
    low: Reals  #: (2,) lower corner of what is seen of it, in the coordinates of the layers; NaN if nothing
    high: Reals  #: (2,) upper corner
    shift: Reals  #: (2,) what was added to its plane coordinates to set it beside the others, metres

    @property
    def origin(self) -> Reals:
        """(3,) place of the file that lies at nought in its plane coordinates, drawing units."""
        return np.asarray(self.drawing.plane.origin if self.drawing.plane.name == "given" else (0.0, 0.0, 0.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where the layers of ``findings.gpkg`` show what lies in the drawings.

    Notes
    -----
    Drawings that all lie in xy, one alone or all of one coordinate reference system, keep the coordinates and units of
    their file: QGIS shows findings over the delivered file. All others are shown in their planes, in metres: right and
    up are the products of the place with the two axes of the plane, from the origin that the manifest gives, else from
    nought, so that heights stay heights. Several are set side by side in the order of the delivery: each is shifted to
    the right of the one before it, and upward only if it would share no height with the first.
    """

    on_file: bool  #: coordinates and units of the files
    crs: str
    sheets: tuple[Sheet, ...]

    def flat(self, source: str, coordinates: Coordinates) -> Coordinates:
        """Places (n, 3) of a drawing, drawing units, in the coordinates of the layers (n, 2)."""
        sheet = next((one for one in self.sheets if one.drawing.path == source), None)
        if self.on_file or sheet is None:
            return coordinates[:, :2]
        drawing = sheet.drawing
        flat: Coordinates = drawing.plane.project(coordinates, drawing.unit.metres or 1.0)[:, :2] + self.base(source)
        return flat

    def base(self, source: str) -> Reals:
        """What is added to the plane coordinates that the audit reckons in (2,): origin and shift, metres."""
        sheet = next((one for one in self.sheets if one.drawing.path == source), None)
        return np.zeros(2) if self.on_file or sheet is None else _base(sheet.drawing) + sheet.shift

    def shown(self, source: Texts, where: Geometries, sheet: Geometries) -> Geometries:
        """Geometries of several drawings in the coordinates of the layers, without depth.

        Parameters
        ----------
        source : (n,) str
            Drawing of each.
        where, sheet : (n,) shapely geometries
            In coordinates of the file, and in the plane of the drawing, metres.
        """
        flat: Geometries = np.asarray(shapely.force_2d(where if self.on_file else sheet), dtype=object).copy()
        if self.on_file or not len(flat):
            return flat
        bases = {path: self.base(path) for path in set(source.tolist())}
        moved = np.array([bases[path] for path in source.tolist()])
        coordinates, of = shapely.get_coordinates(flat, return_index=True)
        shapely.set_coordinates(flat, coordinates + moved[of])
        return flat

    def facades(self, source: Texts) -> Texts:
        """Facade of each drawing, as the manifest names it."""
        named = {sheet.drawing.path: printable(sheet.drawing.facade) for sheet in self.sheets}
        facades: Texts = np.empty(len(source), dtype=object)
        facades[:] = [named.get(path, "") for path in source.tolist()]
        return facades


def layout_of(record: AuditRecord) -> Layout:
    """Layout of the drawings of one audit."""
    drawings = record.delivery.drawings
    flat = all((one.plane.right, one.plane.up) == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)) for one in drawings)
    systems = {_crs(record, one) for one in drawings}
    shared = next(iter(systems)) if len(systems) == 1 else ""
    on_file = flat and (len(drawings) <= 1 or bool(shared))
    sheets: list[Sheet] = []
    for one in drawings:
        low, high = _extent(one, on_file=on_file)
        shift = np.zeros(2) if on_file else _beside(sheets, low, high)
        sheets.append(Sheet(drawing=one, low=low + shift, high=high + shift, shift=shift))
    known = on_file and _CODE.fullmatch(shared) is not None
    return Layout(on_file=on_file, crs=shared if known else UNDEFINED, sheets=tuple(sheets))


def _crs(record: AuditRecord, drawing: Drawing) -> str:
    """System of the file's own; the delivery's is one of metres."""
    return drawing.reading.crs or (record.delivery.crs if drawing.unit.metres == 1.0 else "")


def _base(drawing: Drawing) -> Reals:
    """What the origin of the plane adds (2,): it was chosen near the linework, unless the manifest gives it."""
    plane = drawing.plane
    if plane.name == "given":
        return np.zeros(2)
    base: Reals = (plane.frame @ np.asarray(plane.origin))[:2] * (drawing.unit.metres or 1.0)
    return base


def _extent(drawing: Drawing, *, on_file: bool) -> tuple[Reals, Reals]:
    """Corners of what is seen of a drawing, without strays; NaN if nothing is."""
    seen = drawing.items.geometry[drawing.visible_rows()]
    with np.errstate(over="ignore"):  # coordinates may be anything
        strokes, _ = without_strays(strokes_of(seen, None if on_file else drawing.plane, drawing.unit.metres or 1.0))
    if not len(strokes.points):
        return np.full(2, np.nan), np.full(2, np.nan)
    base = np.zeros(2) if on_file else _base(drawing)
    points = np.clip(strokes.points + base, -_FARTHEST, _FARTHEST)
    return points.min(axis=0), points.max(axis=0)


def _beside(before: list[Sheet], low: Reals, high: Reals) -> Reals:
    """Shift (2,) of a drawing to the right of those before it, in round metres."""
    seen = [sheet for sheet in before if np.isfinite(sheet.low).all()]
    if not seen or not np.isfinite(low).all():
        return np.zeros(2)
    widest = max(float(np.max([sheet.high - sheet.low for sheet in seen])), float(np.max(high - low)), 1e-3)
    step = 10.0 ** np.floor(np.log10(widest * _GAP))
    right = np.ceil((seen[-1].high[0] + widest * _GAP - low[0]) / step) * step
    first = seen[0]
    apart = low[1] > first.high[1] or high[1] < first.low[1]
    up = np.rint((first.low[1] - low[1]) / step) * step if apart else 0.0
    return np.array([right, up])


def sheets_layer(layout: Layout, drawn: dict[str, tuple[int, int]]) -> tuple[str, Geometries, str, dict[str, Any]]:
    """Name, frames, type of geometry and columns of ``desenho_a``: one drawing a row, and how to go back to its file.

    Parameters
    ----------
    drawn : dict
        By drawing: items that could be drawn, and those that are in ``desenho_l``.

    Notes
    -----
    A place of the layers is the place ``origin + ((r - shift_r) · right + (u - shift_u) · up) / metres`` of the file,
    depth apart, in drawing units.
    """
    sheets = layout.sheets
    frames: Geometries = np.full(len(sheets), None, dtype=object)
    for n, sheet in enumerate(sheets):
        if np.isfinite(sheet.low).all():
            margin = max(float(np.max(sheet.high - sheet.low)) * _GAP / 4, 1e-3)
            frames[n] = shapely.box(*(sheet.low - margin), *(sheet.high + margin))
    metres = [1.0 if layout.on_file else sheet.drawing.unit.metres or 1.0 for sheet in sheets]
    columns: dict[str, NDArray[Any]] = {
        "source": _texts(printable(sheet.drawing.path) for sheet in sheets),
        "facade": _texts(printable(sheet.drawing.facade) for sheet in sheets),
        "plane": _texts(sheet.drawing.plane.name for sheet in sheets),
        "items": np.array([drawn[sheet.drawing.path][0] for sheet in sheets], dtype=np.int64),
        "drawn": np.array([drawn[sheet.drawing.path][1] for sheet in sheets], dtype=np.int64),
        "metres": np.array(metres, dtype=float),
        "origin": _texts(_triple(sheet.origin) for sheet in sheets),
        "right": _texts(_triple(np.asarray(sheet.drawing.plane.right)) for sheet in sheets),
        "up": _texts(_triple(np.asarray(sheet.drawing.plane.up)) for sheet in sheets),
        "shift_r": np.array([sheet.shift[0] for sheet in sheets], dtype=float),
        "shift_u": np.array([sheet.shift[1] for sheet in sheets], dtype=float),
    }
    return LAYER, frames, "Polygon", columns


def _texts(values: Iterable[str]) -> Texts:
    listed = list(values)
    made: Texts = np.empty(len(listed), dtype=object)
    made[:] = listed
    return made


def _triple(values: Reals) -> str:
    return " ".join(repr(float(value)) for value in values)
