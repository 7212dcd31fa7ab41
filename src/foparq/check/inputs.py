# SPDX-License-Identifier: MIT
"""Columns of one drawing for the rules that look at them.

Geometry is brought into the drawing's plane, in metres; rows are put into an order that does not depend on the file.
What no rule could look at (a line of one point, a hidden layer) is counted as set aside, never dropped in silence.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any, cast

import numpy as np
import shapely

from foparq.check.unit_evidence import unit_evidence
from foparq.columns import Flags, Geometries, Index, Texts
from foparq.model.drawing import Drawing
from foparq.model.inputs import (
    Areas,
    Bombs,
    Features,
    HiddenItems,
    LayerNames,
    LayerPatterns,
    Lines,
    Named,
    Repairs,
    UnitEvidence,
)
from foparq.model.items import Role, holders_of

_FACTS = (Repairs, Bombs, HiddenItems, LayerNames, LayerPatterns, UnitEvidence)
_LINE_STRING, _LINEAR_RING, _POLYGON = 1, 2, 3
_RING_VERTICES = 4
#: by plane: a sheet narrower than this share of its depth is seen from its edge
_EDGE = {"xy": 0.1, "xz": 0.1, "yz": 0.1, "assumed": 10.0}
NO_ROW = -1  #: the statement is about no item


def matches(layer: str, patterns: tuple[str, ...]) -> bool:
    """Whether a layer name matches one of the patterns; case does not matter, as in CAD."""
    name = layer.casefold()
    return any(fnmatchcase(name, pattern.casefold()) for pattern in patterns)


def matching(layers: Texts, patterns: tuple[str, ...]) -> Flags:
    """(n,) whether each layer name matches one of the patterns."""
    if "*" in patterns:
        return np.ones(len(layers), dtype=bool)
    names, inverse = np.unique(layers.astype(str), return_inverse=True)
    hit = np.array([matches(name, patterns) for name in names], dtype=bool)
    return hit[inverse] if len(names) else np.zeros(0, dtype=bool)


def all_layers(drawing: Drawing) -> set[str]:
    """Every layer of a drawing: also the empty ones, and those of inserts."""
    held = {holder.layer for text in set(drawing.items.holders.tolist()) for holder in holders_of(text)}
    return {*drawing.reading.layers, *drawing.items.layer.tolist(), *held}


@dataclass
class DrawingInputs:
    """Inputs of the rules for one drawing, each built once.

    Parameters
    ----------
    drawing : Drawing
    hidden : bool
        True if off and frozen layers are looked at too.
    """

    drawing: Drawing
    hidden: bool
    _cache: dict[tuple[Any, ...], Named] = field(default_factory=dict)

    def __post_init__(self) -> None:
        items = self.drawing.items
        seen = ~items.paper & (items.visible | self.hidden)
        rows = np.flatnonzero(seen & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT]))
        order = sorted(rows.tolist(), key=lambda row: (items.layer[row], items.item[row]))
        self.rows: Index = np.array(order, dtype=np.intp)
        self.metres = self.drawing.unit.metres or 1.0
        self.geometry = self.on_sheet(items.geometry[self.rows])

    def on_sheet(self, geometry: Geometries) -> Geometries:
        """Geometries in the plane; depth is kept where it differs from zero."""
        flat = shapely.get_coordinates(geometry, include_z=True)
        flat[:, 2] = np.nan_to_num(flat[:, 2])
        sheet = self.drawing.plane.project(flat, self.metres)
        deep = bool(np.any(sheet[:, 2]))
        moved = geometry.copy()
        if deep:
            moved = shapely.force_3d(moved)
            return cast("Geometries", shapely.set_coordinates(moved, sheet))
        moved = shapely.force_2d(moved)
        return cast("Geometries", shapely.set_coordinates(moved, sheet[:, :2]))

    @cached_property
    def seen_edge_on(self) -> bool:
        """Whether the plane shows the drawing from its edge: its width or height is a small part of its depth.

        A facade in space that is taken for a plan collapses onto a line: nothing that is found there means anything.
        Where xy was only assumed, a drawing that is not flat is doubtful. A plane that was fitted, or given by its
        axes, was chosen on purpose.
        """
        share = _EDGE.get(self.drawing.plane.name)
        if share is None:
            return False
        drawn = self.drawing.items.role[self.rows] != Role.POINT
        sheet = shapely.get_coordinates(self.geometry[drawn], include_z=True)
        sheet = np.nan_to_num(sheet[np.isfinite(sheet[:, :2]).all(axis=1)])
        if not len(sheet):
            return False
        width, height, depth = np.ptp(sheet, axis=0)
        return bool(depth * share > min(width, height))

    def layers(self) -> list[str]:
        """Layers that hold anything a rule looks at, in order."""
        return sorted(set(self.drawing.items.layer[self.rows].tolist()))

    def get(self, subject: type, layers: tuple[str, ...], without: frozenset[int]) -> tuple[Named, int]:
        """Input of one type on some layers.

        Parameters
        ----------
        subject : type
            One of the types of ``model.inputs``.
        layers : tuple of str
            Patterns.
        without : frozenset of int
            Rows of the drawing's items to set aside.

        Returns
        -------
        input : Named
        aside : int
            Items on these layers that were set aside.
        """
        if subject in _FACTS:
            return self._facts(subject), 0
        whole = self._whole(subject, layers)
        broken = self._broken(subject, layers)
        if not without:
            return whole, broken
        kept = ~np.isin(whole.row, np.fromiter(without, dtype=np.intp, count=len(without)))
        if kept.all():
            return whole, broken
        key = (subject, layers, without)
        if key not in self._cache:
            self._cache[key] = whole.take(kept)
        return self._cache[key], broken + len(np.unique(whole.row[~kept]))

    def holds(self, subject: type, layers: tuple[str, ...]) -> bool:
        """Whether there is anything of the kind on these layers, sound or broken."""
        return subject in _FACTS or bool(len(self._whole(subject, layers))) or bool(self._broken(subject, layers))

    def examined(self, subject: type) -> bool:
        """Whether an empty input means that the file was looked at and nothing was there to report."""
        return subject in {Repairs, Bombs, HiddenItems, LayerNames, LayerPatterns}

    def _whole(self, subject: type, layers: tuple[str, ...]) -> Named:
        key = (subject, layers)
        if key not in self._cache:
            on = np.flatnonzero(matching(self.drawing.items.layer[self.rows], layers))
            build = {Features: self._features, Lines: self._lines, Areas: self._areas}[subject]
            self._cache[key] = build(on)
        return self._cache[key]

    def _broken(self, subject: type, layers: tuple[str, ...]) -> int:
        """Items of the kind that the input cannot hold."""
        on = matching(self.drawing.items.layer[self.rows], layers)
        if subject is Features:
            return 0
        role = self.drawing.items.role[self.rows]
        kind = (role == Role.AREA) | self._coverage() if subject is Areas else (role == Role.LINE) | (role == Role.AREA)
        return int(np.count_nonzero(on & kind)) - len(np.unique(self._whole(subject, layers).row))

    def _coverage(self) -> Flags:
        """(n,) lines that bound areas because the manifest says so of their layer."""
        items = self.drawing.items
        if not self.drawing.areas:
            return np.zeros(len(self.rows), dtype=bool)
        bounding: Flags = matching(items.layer[self.rows], self.drawing.areas) & (items.role[self.rows] == Role.LINE)
        return bounding

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
        geometry = self.geometry[on]
        kind = shapely.get_type_id(geometry)
        finite = _finite(geometry)
        single = on[np.isin(kind, [_LINE_STRING, _LINEAR_RING]) & finite & (shapely.get_num_points(geometry) > 1)]
        surfaces = on[(kind == _POLYGON) & finite & ~shapely.is_empty(geometry)]
        rings, owner = shapely.get_rings(self.geometry[surfaces], return_index=True)
        coordinates, of_ring = shapely.get_coordinates(
            rings, include_z=bool(np.any(shapely.has_z(rings))), return_index=True
        )
        boundaries = shapely.linestrings(coordinates, indices=of_ring) if len(rings) else np.empty(0, dtype=object)
        rows = np.concatenate([single, surfaces[owner]]).astype(np.intp)
        shapes = np.concatenate([self.geometry[single], boundaries])
        bounds = np.concatenate([self._coverage()[single], np.ones(len(boundaries), dtype=bool)])
        order = np.argsort(rows, kind="stable")
        return Lines(geometry=shapes[order], bounds=bounds[order], **self._named(rows[order]))

    def _areas(self, on: Index) -> Areas:
        shapes = self.geometry[on].copy()
        lines = np.flatnonzero(
            self._coverage()[on] & _finite(shapes) & (shapely.get_num_points(shapes) >= _RING_VERTICES)
        )
        for n in lines[shapely.is_closed(shapes[lines])]:
            shapes[n] = shapely.Polygon(shapely.get_coordinates(shapes[n]))
        sound = (shapely.get_type_id(shapes) == _POLYGON) & _finite(shapes)
        sound[sound] = shapely.is_valid(shapes[sound]) & ~shapely.is_empty(shapes[sound])
        return Areas(geometry=shapely.force_2d(shapes[sound]), **self._named(on[sound]))

    def _facts(self, subject: type) -> Named:
        if (subject,) not in self._cache:
            build = _BUILD[subject]
            self._cache[(subject,)] = build(self.drawing)
        return self._cache[(subject,)]


def _finite(geometry: Geometries) -> Flags:
    """(n,) whether every coordinate in the plane is a finite number; an empty geometry has none that is not."""
    coordinates, index = shapely.get_coordinates(geometry, return_index=True)
    finite = np.ones(len(geometry), dtype=bool)
    finite[index[~np.isfinite(coordinates).all(axis=1)]] = False
    finite[shapely.is_missing(geometry)] = False
    return finite


def _about_file(layers: list[str], handles: list[str]) -> dict[str, Any]:
    """Naming columns of statements that are about no item."""
    n = len(layers)
    return {
        "layer": np.array(layers, dtype=object),
        "item": np.full(n, "", dtype=object),
        "handle": np.array(handles, dtype=object),
        "inserts": np.full(n, "", dtype=object),
        "row": np.full(n, NO_ROW, dtype=np.intp),
    }


def _repairs(drawing: Drawing) -> Repairs:
    repairs = drawing.reading.repairs
    names = _about_file([""] * len(repairs), [repair.handle for repair in repairs])
    return Repairs(code=np.array([repair.code for repair in repairs], dtype=object), **names)


def _bombs(drawing: Drawing) -> Bombs:
    bombs = drawing.reading.bombs
    return Bombs(
        entities=np.array([bomb.entities for bomb in bombs], dtype=float),
        where=np.full(len(bombs), shapely.Point(), dtype=object),
        **_about_file([bomb.layer for bomb in bombs], [bomb.handle or bomb.block for bomb in bombs]),
    )


def _hidden_items(drawing: Drawing) -> HiddenItems:
    items = drawing.items
    hidden = ~items.visible & ~items.paper
    layers = sorted(set(items.layer[hidden].tolist()))
    count, where = [], []
    for layer in layers:
        rows = hidden & (items.layer == layer)
        count.append(float(np.count_nonzero(rows)))
        bounds = shapely.total_bounds(items.geometry[rows])
        where.append(shapely.box(*bounds) if np.isfinite(bounds).all() else shapely.Point())
    named = _about_file(layers, [""] * len(layers))
    return HiddenItems(count=np.array(count), where=np.array(where, dtype=object), **named)


def _layer_names(drawing: Drawing) -> LayerNames:
    bad = set(drawing.reading.bad_names)
    names = sorted({*drawing.reading.layers, *drawing.items.layer.tolist(), *bad})
    return LayerNames(
        doubly_encoded=np.array([name in bad for name in names], dtype=bool),
        count=np.array([np.count_nonzero(drawing.items.layer == name) for name in names], dtype=float),
        **_about_file(names, [""] * len(names)),
    )


def _layer_patterns(drawing: Drawing) -> LayerPatterns:
    layers = all_layers(drawing)
    patterns = sorted({*drawing.classes, *drawing.areas})
    matched = [any(matches(layer, (pattern,)) for layer in layers) for pattern in patterns]
    return LayerPatterns(matched=np.array(matched, dtype=bool), **_about_file(patterns, [""] * len(patterns)))


_BUILD: dict[type, Callable[[Drawing], Named]] = {
    Repairs: _repairs,
    Bombs: _bombs,
    HiddenItems: _hidden_items,
    LayerNames: _layer_names,
    LayerPatterns: _layer_patterns,
    UnitEvidence: unit_evidence,
}
