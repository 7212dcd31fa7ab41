# SPDX-License-Identifier: MIT
"""Linework of one drawing as columns for the rules that look at it.

Geometry is brought into the drawing's plane, in metres; rows are put into an order that does not depend on the file.
An odd item is left out of what cannot hold it and counted; it changes nothing for the others.
"""

from functools import cached_property
from typing import Any

import numpy as np
import shapely

from foparq.columns import Coordinates, Flags, Geometries, Index, Reals, Texts, union
from foparq.geom.areas import measurable
from foparq.geom.rounding import FARTHEST
from foparq.model.drawing import Drawing
from foparq.model.inputs import Areas, Features, Lines, Named
from foparq.model.items import Role
from foparq.model.layers import bonds, matching

_LINE_STRING, _LINEAR_RING, _POLYGON = 1, 2, 3
_RING_VERTICES = 4
_STRAYS = 0.01  #: share of vertices, or of items, that do not speak for the stance of a drawing
#: by plane: a sheet narrower than this share of its depth is seen from its edge
_EDGE = {"xy": 0.1, "xz": 0.1, "yz": 0.1, "assumed": 10.0}


class Columns:
    """Columns of the linework of one drawing.

    Parameters
    ----------
    hidden : bool
        True if off and frozen layers are looked at too.
    """

    def __init__(self, drawing: Drawing, *, hidden: bool) -> None:
        items = drawing.items
        seen = ~items.paper & (items.visible | hidden)
        if drawing.ignored:
            seen &= ~np.isin(items.layer, list(drawing.ignored))
        rows = np.flatnonzero(seen & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT]))
        layer, item = items.layer[rows].astype(str), items.item[rows].astype(str)
        self.drawing = drawing
        self.rows: Index = rows[np.lexsort((item, layer))]  #: (n,) of the drawing's items
        self.layer: Texts = items.layer[self.rows]
        self.role: Texts = items.role[self.rows]
        #: strokes of point symbols: features as others are, and no linework
        self.symbol: Flags = np.isin(self.rows, drawing.symbols.rows)
        self.metres = drawing.unit.metres or 1.0
        self.geometry = self.on_sheet(items.geometry[self.rows])
        #: lines that bound areas because the manifest says so of their layer
        self.bounding: Flags = (
            matching(self.layer, drawing.areas) & (self.role == Role.LINE)
            if drawing.areas
            else np.zeros(len(self.rows), dtype=bool)
        )

    @cached_property
    def bond(self) -> Index:
        """(n,) equal numbers on layers that are drawn as one: of one name, of one class, or bound by the manifest."""
        return bonds(self.layer, self.drawing.classes, self.drawing.bind)

    def on_sheet(self, geometry: Geometries) -> Geometries:
        """Geometries in the plane; depth is kept if it differs from zero anywhere."""
        flat = shapely.get_coordinates(geometry, include_z=True)
        flat[:, 2] = np.nan_to_num(flat[:, 2], posinf=np.inf, neginf=-np.inf)
        with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
            sheet = self.drawing.plane.project(flat, self.metres)
            # What is too far for a number is infinitely far: a ring whose first vertex were none would not be closed.
            sheet[np.isnan(sheet) & ~np.isnan(flat).any(axis=1, keepdims=True)] = np.inf
            # What is no number has no depth that could matter to others.
            deep = bool(np.any(np.nan_to_num(sheet[:, 2], posinf=0.0, neginf=0.0)))
            moved = _opened(shapely.force_3d(geometry.copy()) if deep else shapely.force_2d(geometry.copy()), sheet)
            placed: Geometries = shapely.set_coordinates(moved, sheet if deep else sheet[:, :2])
        return placed

    def seen_edge_on(self) -> bool:
        """Whether the plane shows the drawing from its edge: its width or height is a small part of its depth.

        A facade in space that is taken for a plan collapses onto a line: nothing that is found there means anything.
        Where xy was only assumed, a drawing that is not flat is doubtful, unless each of its items is level: a plan
        with pieces at several heights. A plane that was fitted, or given by its axes, was chosen on purpose.
        """
        share = _EDGE.get(self.drawing.plane.name)
        if share is None:
            return False
        if share > 1 and self._level():
            share = _EDGE["xy"]
        sheet: Coordinates = shapely.get_coordinates(self.geometry[self.role != Role.POINT], include_z=True)
        sheet = np.nan_to_num(sheet[np.isfinite(sheet[:, :2]).all(axis=1)], posinf=0.0, neginf=0.0)
        if not len(sheet):
            return False
        width, height, depth = np.ptp(sheet, axis=0) if share > 1 else _spread(sheet)
        return bool(depth * share > min(width, height))

    def _level(self) -> bool:
        """Whether no item rises, or no more than one of a hundred: a few strays do not make a plan stand up."""
        sheet, item = shapely.get_coordinates(self.geometry, include_z=True, return_index=True)
        depth = np.nan_to_num(sheet[:, 2], posinf=0.0, neginf=0.0)
        low, high = np.full(len(self.geometry), np.inf), np.full(len(self.geometry), -np.inf)
        np.minimum.at(low, item, depth)
        np.maximum.at(high, item, depth)
        return bool(np.count_nonzero(high > low) <= _STRAYS * len(self.geometry))

    def build(self, kind: type, on: Index) -> Named:
        """Input of one kind from the rows ``on`` of these columns."""
        made: Named = {Features: self._features, Lines: self._lines, Areas: self._areas}[kind](on)
        return made

    def of_kind(self, kind: type, on: Index) -> Index:
        """Rows among ``on`` that are of a kind, whether an input can hold them or not."""
        if kind is Features:
            return on
        on = on[~self.symbol[on]]
        area, line = self.role[on] == Role.AREA, self.role[on] == Role.LINE
        mine: Index = on[area | self.bounding[on]] if kind is Areas else on[area | line]
        return mine

    def _named(self, rows: Index) -> dict[str, Any]:
        items = self.drawing.items
        at = self.rows[rows]
        return {
            "layer": items.layer[at],
            "item": items.item[at],
            "handle": items.handle[at],
            "inserts": items.inserts[at],
            "row": at,
        }

    def _features(self, on: Index) -> Features:
        return Features(geometry=self.geometry[on], **self._named(on))

    def _lines(self, on: Index) -> Lines:
        on = on[~self.symbol[on]]
        geometry = self.geometry[on]
        kind, near = shapely.get_type_id(geometry), _measurable(geometry)
        single = on[np.isin(kind, [_LINE_STRING, _LINEAR_RING]) & near & (shapely.get_num_points(geometry) > 1)]
        surfaces = on[(kind == _POLYGON) & near & ~shapely.is_empty(geometry)]
        rings, owner = shapely.get_rings(self.geometry[surfaces], return_index=True)
        # A hole without vertices is no line.
        there = shapely.get_num_points(rings) > 1
        rings, owner = rings[there], owner[there]
        coordinates, of_ring = shapely.get_coordinates(
            rings, include_z=bool(np.any(shapely.has_z(rings))), return_index=True
        )
        boundaries = shapely.linestrings(coordinates, indices=of_ring) if len(rings) else np.empty(0, dtype=object)
        rows = np.concatenate([single, surfaces[owner]]).astype(np.intp)
        shapes = np.concatenate([self.geometry[single], boundaries])
        bounds = np.concatenate([self.bounding[single], np.ones(len(boundaries), dtype=bool)])
        order = np.argsort(rows, kind="stable")
        rows = rows[order]
        holders = self.drawing.items.holders[self.rows[rows]]
        return Lines(
            geometry=shapes[order], bounds=bounds[order], holders=holders, bond=self.bond[rows], **self._named(rows)
        )

    def _areas(self, on: Index) -> Areas:
        on = on[~self.symbol[on]]
        shapes = self.geometry[on].copy()
        near = _measurable(shapes)
        lines = np.flatnonzero(self.bounding[on] & near & (shapely.get_num_points(shapes) >= _RING_VERTICES))
        for n in lines[shapely.is_closed(shapes[lines])]:
            shapes[n] = shapely.Polygon(shapely.get_coordinates(shapes[n]))
        rows = np.flatnonzero((shapely.get_type_id(shapes) == _POLYGON) & near & ~shapely.is_empty(shapes))
        covered, there = measurable(shapely.force_2d(shapes[rows]))
        rows = rows[there]
        return Areas(geometry=covered[there], **self._named(on[rows]))


def _measurable(geometry: Geometries) -> Flags:
    """(n,) whether distances can be computed with every coordinate; an empty geometry has none that hinders.

    A depth that is missing reads as NaN, and is none.
    """
    coordinates, index = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    near = np.ones(len(geometry), dtype=bool)
    size = np.abs(coordinates)
    near[index[~(size[:, :2] <= FARTHEST).all(axis=1) | (size[:, 2] > FARTHEST)]] = False
    near[shapely.is_missing(geometry)] = False
    return near


def _spread(sheet: Coordinates) -> Reals:
    """(3,) extent along each axis, without the outermost vertices: one far away must not turn a drawing."""
    low, high = np.quantile(sheet, [_STRAYS, 1 - _STRAYS], axis=0)
    spread: Reals = high - low
    return spread


def _opened(geometry: Geometries, sheet: Coordinates) -> Geometries:
    """Areas with a ring that does not close on the sheet as the lines that they are; all else as it is.

    A ring may close in the file's x and y and end at another height: seen in an elevation, it is open.
    """
    area = np.flatnonzero(shapely.get_type_id(geometry) == _POLYGON)
    rings, owner = shapely.get_rings(geometry[area], return_index=True)
    drawn = shapely.get_num_coordinates(rings) > 0
    rings, owner = rings[drawn], area[owner[drawn]]
    if not len(rings):
        return geometry
    all_sizes, sizes = shapely.get_num_coordinates(geometry), shapely.get_num_coordinates(rings)
    begin, before = np.cumsum(all_sizes) - all_sizes, np.cumsum(sizes) - sizes
    first = begin[owner] + before - before[np.searchsorted(owner, owner)]
    apart = (sheet[first, :2] != sheet[first + sizes - 1, :2]).any(axis=1)
    for row in union(owner[apart]).tolist():
        lines = [shapely.LineString(ring.coords) for ring in rings[owner == row]]
        geometry[row] = lines[0] if len(lines) == 1 else shapely.MultiLineString(lines)
    return geometry
