# SPDX-License-Identifier: MIT
"""The drawing as a picture: linework of every layer, and where the findings lie on it."""

import base64
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.evaluate.quality import QualityReport
from foparq.findings.table import Findings, Severity
from foparq.geom.places import place_on
from foparq.model.drawing import Drawing
from foparq.model.items import Role
from foparq.report.page.completeness import OutlinePath, outline_paths
from foparq.report.page.frame import beyond, frame, without_strays
from foparq.report.page.paths import (
    FARTHEST,
    Strokes,
    density,
    merged_dots,
    path_data,
    simplify,
    strokes_of,
    to_cells,
)
from foparq.report.page.png import grey_png

PIXELS = 1000  #: width of the overview for which the picture is made
EXACT_ITEMS = 20_000  #: items up to which linework is drawn as it is
EXACT_VERTICES = 250_000  #: vertices up to which linework is drawn as lines
RASTER = 2000  #: pixels across where it is drawn as tones of grey
GROUPS = 300  #: layers that are drawn each by itself
_NEAR = 1 / 300  #: of the width of the picture: what counts as around a finding
_SOFT: frozenset[str] = frozenset({Role.ANNOTATION, Role.HATCH, Role.SURFACE})


@dataclass(frozen=True, slots=True, kw_only=True)
class LayerPath:
    """Linework of one layer and manner of drawing."""

    layer: str  #: ``""`` for the layers beyond ``GROUPS``, together
    style: str  #: ``ink``, ``soft`` (lettering, hatches, surfaces) or ``pale`` (hidden)
    path: str  #: path data, in cells


@dataclass(frozen=True, slots=True, kw_only=True)
class LayerCount:
    """Items of one layer."""

    layer: str
    items: int
    hidden: int  #: not visible in model space
    findings: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """One drawing, ready to be written as a scalable picture. A cell is ``quantum`` metres."""

    drawing: Drawing
    number: int  #: from 1
    quantum: float
    corner: Reals  #: (2,) metres: upper left corner
    width: int  #: cells
    height: int  #: cells
    form: str  #: ``exact``, ``simplified``, ``toned`` or ``empty``
    paths: tuple[LayerPath, ...]
    toned: str  #: the linework as PNG, base64; ``""`` unless toned
    nearby: str  #: path data of the linework around listed findings, exact, where ``paths`` is not
    culprits: str  #: path data of the items that findings name
    bands: str  #: path data of the places of faults that are lines
    areas: str  #: path data of the places of faults that are areas
    layers: tuple[LayerCount, ...]
    outside: int  #: items outside the overview, which frames the visible linework
    hidden: int  #: hidden items of model space
    paper: int  #: items of paper space: not drawn
    outlines: tuple[OutlinePath, ...] = ()  #: of features, by class
    extent: Reals = field(default_factory=lambda: np.zeros((2, 2)))  #: lower and upper corner of visible linework

    def cells(self, points: Reals) -> Reals:
        """Points (n, 2) of the sheet, metres, in cells of the picture."""
        placed = np.rint((points - self.corner) / self.quantum * (1.0, -1.0))
        return np.clip(placed, -FARTHEST, FARTHEST)


def picture_of(
    drawing: Drawing, number: int, findings: Findings, shown: Index, quality: QualityReport | None = None
) -> Picture:
    """Picture of one drawing.

    Parameters
    ----------
    number : int
        Ordinal among the drawings, from 1.
    findings : Findings
        All findings of the audit.
    shown : (k,) int
        Rows of the findings that the page lists.
    quality : QualityReport, optional
        With the features that were found, to be outlined.

    Notes
    -----
    Up to ``EXACT_ITEMS`` items the linework is drawn as it is. Beyond, it is simplified to a tenth of a pixel of the
    overview; where even that is too much, the overview is toned by the density of lines. Items that findings name are
    always drawn as they are.
    """
    metres = drawing.unit.metres or 1.0
    mine = shown[findings.source[shown] == drawing.path]
    sheet = findings.sheet[mine]
    model = drawing.items.geometry.copy()
    model[drawing.items.paper] = None
    exact, strays = without_strays(strokes_of(model, drawing.plane, metres))
    visible = drawing.visible_rows()
    soft = _is_one_of(drawing.items.role, _SOFT)
    linework = exact.take((visible & ~soft)[exact.owner])
    corner, size = frame(linework if len(linework.points) else exact, sheet)
    quantum = float(10.0 ** np.floor(np.log10(size.max() / 50_000)))
    form, strokes = _within_bounds(exact, len(model), float(size[0]) / PIXELS / 10)

    def path(strokes: Strokes) -> str:
        return path_data(_few(to_cells(strokes, corner, quantum)))

    named = drawing.items.geometry[_named_rows(drawing, findings, mine)]
    faults = findings.sheet[mine[findings.severity[mine] != Severity.NOTE]]
    return Picture(
        drawing=drawing,
        number=number,
        quantum=quantum,
        corner=corner,
        width=int(np.ceil(size[0] / quantum)),
        height=int(np.ceil(size[1] / quantum)),
        form=form,
        paths=() if form == "toned" else _layer_paths(drawing, to_cells(strokes, corner, quantum)),
        toned=_toned(exact.take(visible[exact.owner]), corner, size) if form == "toned" else "",
        nearby=path(_around(exact, sheet, float(size[0]))) if form in {"simplified", "toned"} else "",
        culprits=path(strokes_of(named, drawing.plane, metres)),
        bands=path(strokes_of(_of_dimension(faults, 1), None, 1.0)),
        areas=path(strokes_of(_of_dimension(faults, 2), None, 1.0)),
        layers=_layer_counts(drawing, findings),
        extent=_extent(linework),
        outside=strays + beyond(exact, corner, size),
        hidden=int(np.sum(~visible & ~drawing.items.paper)),
        paper=int(np.sum(drawing.items.paper)),
        outlines=outline_paths(drawing.path, quality, lambda shapes: path(strokes_of(shapes, None, 1.0)))
        if quality
        else (),
    )


def _extent(strokes: Strokes) -> Reals:
    """Lower and upper corner (2, 2), metres; equal ones of nothing."""
    points = strokes.points
    return np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 2))


def marks_at(sheet: Geometries) -> Reals:
    """Where the mark of every finding stands (n, 2), metres on the sheet; NaN without a place.

    It is the place of the finding, which is chosen on the sheet.
    """
    return place_on(sheet)[:, :2]


def _within_bounds(strokes: Strokes, items: int, tolerance: float) -> tuple[str, Strokes]:
    if not len(strokes.points):
        return "empty", strokes
    if items <= EXACT_ITEMS and len(strokes.points) <= EXACT_VERTICES:
        return "exact", strokes
    simple = simplify(strokes, tolerance)
    return ("simplified", simple) if len(simple.points) <= EXACT_VERTICES else ("toned", strokes)


def _around(strokes: Strokes, sheet: Geometries, width: float) -> Strokes:
    """Strokes that pass near a finding: what is seen when the picture is enlarged there."""
    spots = marks_at(sheet)
    spots = spots[np.isfinite(spots).all(axis=1)]
    half = width * _NEAR
    tree = shapely.STRtree(shapely.box(*(spots - half).T, *(spots + half).T))
    start = np.flatnonzero(np.diff(strokes.stroke, prepend=-1))
    low, high = np.minimum.reduceat(strokes.points, start), np.maximum.reduceat(strokes.points, start)
    passing = np.zeros(len(strokes.owner), dtype=bool)
    passing[tree.query(shapely.box(*low.T, *high.T))[0]] = True
    return strokes.take(passing)


def _toned(strokes: Strokes, corner: Reals, size: Reals) -> str:
    pixel = float(size[0]) / RASTER
    placed = Strokes((strokes.points - corner) / pixel * (1.0, -1.0), strokes.stroke, strokes.owner)
    height = int(np.ceil(size[1] / pixel))
    return base64.b64encode(grey_png(density(placed, RASTER, height))).decode("ascii")


def _layer_paths(drawing: Drawing, strokes: Strokes) -> tuple[LayerPath, ...]:
    items = drawing.items
    names, of_item = _factors(items.layer)
    group = np.minimum(of_item, GROUPS)
    style = np.where(_is_one_of(items.role, _SOFT), 1, 2)
    style[~drawing.visible_rows()] = 0
    code = (group * 3 + style)[strokes.owner]
    paths = []
    for value in np.unique(code):
        layer, manner = divmod(int(value), 3)
        name = str(names[layer]) if layer < GROUPS else ""
        data = path_data(merged_dots(strokes.take(code == value)))
        paths.append(LayerPath(layer=name, style=("pale", "soft", "ink")[manner], path=data))
    # What is visible is drawn last, on top.
    return tuple(sorted(paths, key=lambda path: (("pale", "soft", "ink").index(path.style), path.layer)))


def _named_rows(drawing: Drawing, findings: Findings, mine: Index) -> Index:
    faults = mine[findings.severity[mine] != Severity.NOTE]
    named = {*findings.item[faults], *findings.other[faults]} - {""}
    wanted = np.fromiter((item in named for item in drawing.items.item), dtype=bool, count=len(drawing.items))
    return np.flatnonzero(wanted & ~drawing.items.paper)


def _of_dimension(geometry: Geometries, dimension: int) -> Geometries:
    parts = shapely.get_parts(geometry)
    chosen: Geometries = parts[shapely.get_dimensions(parts) == dimension]
    return chosen


def _few(strokes: Strokes) -> Strokes:
    """The first strokes that hold a fifth of the bound of vertices."""
    room = np.cumsum(np.bincount(strokes.stroke, minlength=len(strokes.owner))) <= EXACT_VERTICES // 5
    return strokes.take(room)


def _is_one_of(texts: Texts, wanted: frozenset[str]) -> Flags:
    names, number = _factors(texts)
    found: Flags = np.isin(number, [n for n, name in enumerate(names) if name in wanted])
    return found


def _factors(texts: Texts) -> tuple[list[str], Index]:
    """Distinct texts, sorted, and the number of each row's; one long name must not widen a column of fixed width."""
    names = sorted(set(texts))
    number = {name: n for n, name in enumerate(names)}
    return names, np.fromiter((number[text] for text in texts), dtype=np.intp, count=len(texts))


def _layer_counts(drawing: Drawing, findings: Findings) -> tuple[LayerCount, ...]:
    items = drawing.items
    names, of_item = _factors(np.append(items.layer, np.array(drawing.reading.layers, dtype=object)))
    number = np.bincount(of_item[: len(items)], minlength=len(names))
    unseen = np.bincount(of_item[: len(items)][~drawing.visible_rows()], minlength=len(names))
    found = Counter(findings.layer[(findings.source == drawing.path) & (findings.severity != Severity.NOTE)])
    return tuple(
        LayerCount(layer=str(name), items=int(number[n]), hidden=int(unseen[n]), findings=found[name])
        for n, name in enumerate(names)
    )
