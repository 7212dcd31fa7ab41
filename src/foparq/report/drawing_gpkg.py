# SPDX-License-Identifier: MIT
"""``desenho_l`` of ``findings.gpkg``: the linework of the drawings, under the findings."""

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from foparq.columns import Flags, Geometries, Index, Integers, Texts
from foparq.model.drawing import Drawing
from foparq.model.items import Role
from foparq.report.page.paths import strokes_of
from foparq.report.record import AuditRecord
from foparq.report.sheets_gpkg import Layout
from foparq.report.words import printable

LAYER = "desenho_l"
MOST_ITEMS = 100_000  #: of one file, shared among its drawings
MOST_VERTICES = 1_000_000  #: likewise
_SOFT = (Role.ANNOTATION, Role.HATCH, Role.SURFACE)
_COLUMNS = ("layer", "item", "kind", "role")
_LINES = (1, 2, 3, 5, 6, 7)  # shapely types that have lines: all but points


def drawing_layer(
    record: AuditRecord, layout: Layout
) -> tuple[tuple[str, Geometries, str, dict[str, NDArray[Any]]], dict[str, tuple[int, int]]]:
    """The layer, and of each drawing how many items have lines and how many of those are in it.

    Returns
    -------
    layer : tuple
        Name, lines, type of geometry and columns: ``layer``, ``item``, ``source``, ``kind``, ``role``, ``visible`` and
        ``facade``. Areas are their boundaries; one item is one feature.
    drawn : dict
        By drawing: items of model space with lines, and those written.

    Notes
    -----
    At most ``MOST_ITEMS`` items of ``MOST_VERTICES`` vertices are written, each drawing an equal share of both: first
    what findings name, then visible linework, lettering and hatches, and what is hidden, in the order of the file.
    """
    shapes: list[Geometries] = []
    columns: dict[str, list[NDArray[Any]]] = {name: [] for name in (*_COLUMNS, "source", "visible", "facade")}
    drawn: dict[str, tuple[int, int]] = {}
    for sheet in layout.sheets:
        drawing = sheet.drawing
        candidates = np.flatnonzero(~drawing.items.paper & np.isin(shapely.get_type_id(drawing.items.geometry), _LINES))
        rows = _within(drawing, candidates, _named(record, drawing), len(layout.sheets))
        lines, rows = _lines(drawing, rows, layout)
        drawn[drawing.path] = (len(candidates), len(rows))
        shapes.append(lines)
        for name in _COLUMNS:
            columns[name].append(_shown(getattr(drawing.items, name)[rows]))
        columns["visible"].append(drawing.items.visible[rows])
        columns["source"].append(_shown(np.full(len(rows), drawing.path, dtype=object)))
        columns["facade"].append(_shown(np.full(len(rows), drawing.facade, dtype=object)))
    joined = {name: np.concatenate(parts or [np.empty(0, dtype=object)]) for name, parts in columns.items()}
    ordered = {name: joined[name] for name in ("layer", "item", "source", "kind", "role", "visible", "facade")}
    ordered["visible"] = ordered["visible"].astype(bool)
    return (LAYER, np.concatenate([*shapes, np.empty(0, dtype=object)]), "MultiLineString", ordered), drawn


def _named(record: AuditRecord, drawing: Drawing) -> frozenset[str]:
    table = record.findings
    mine = table.source == drawing.path
    return frozenset({*table.item[mine], *table.other[mine]} - {""})


def _within(drawing: Drawing, rows: Index, named: frozenset[str], shares: int) -> Index:
    """Rows that stay within the bounds, in the order of the file."""
    items = drawing.items
    number: Integers = shapely.get_num_coordinates(items.geometry[rows])
    fits = number <= MOST_VERTICES // shares
    rows, number = rows[fits], number[fits]
    if len(rows) <= MOST_ITEMS // shares and number.sum() <= MOST_VERTICES // shares:
        return rows
    wanted = np.fromiter((item in named for item in items.item[rows].tolist()), dtype=bool, count=len(rows))
    rank = np.where(np.isin(items.role[rows], _SOFT), 2, 1)
    rank[~items.visible[rows]] = 3
    rank[wanted] = 0
    order = np.argsort(rank, kind="stable")[: MOST_ITEMS // shares]
    kept: Flags = np.cumsum(number[order]) <= MOST_VERTICES // shares
    chosen: Index = np.sort(rows[order[kept]])
    return chosen


def _lines(drawing: Drawing, rows: Index, layout: Layout) -> tuple[Geometries, Index]:
    """Lines of items in the coordinates of the layers, and the rows of those that have any."""
    plane = None if layout.on_file else drawing.plane
    strokes = strokes_of(drawing.items.geometry[rows], plane, drawing.unit.metres or 1.0)
    strokes = strokes.take(np.bincount(strokes.stroke, minlength=len(strokes.owner)) > 1)
    if not len(strokes.points):
        return np.empty(0, dtype=object), rows[:0]
    lines = shapely.linestrings(strokes.points + layout.base(drawing.path), indices=strokes.stroke)
    owners, part_of = np.unique(strokes.owner, return_inverse=True)
    return shapely.multilinestrings(lines, indices=part_of), rows[owners]


def _shown(column: Texts) -> Texts:
    known = {text: printable(str(text)) for text in set(column.tolist())}
    shown: Texts = np.empty(len(column), dtype=object)
    shown[:] = [known[text] for text in column.tolist()]
    return shown
