# SPDX-License-Identifier: MIT
"""Layers that look like a coverage, although nobody says that their lines bound areas."""

import numpy as np
import shapely

from foparq.check.drawn.columns import Columns
from foparq.columns import Geometries, Index
from foparq.geom.overlaps import line_overlaps
from foparq.model.inputs import Lines
from foparq.model.items import Role

_RING_VERTICES = 4
_FEWEST = 3  #: closed lines of a layer
_LAYERS = 100  #: layers that are looked at, those with the most closed lines
_SHARED = 0.25  #: of its length that a closed line shares with others: half of two sides of a square


def undeclared_coverages(columns: Columns, *, coincide: float) -> tuple[str, ...]:
    """Layers whose closed lines mostly share borders and are not declared as bounds of areas.

    At least half of the closed lines of such a layer share a quarter of their length with others of the layer. Lines
    that lie in one another are no part of it: a frame and what it holds.

    Parameters
    ----------
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    tuple of str
        Names, in order.

    Notes
    -----
    O(s log s) in the segments of closed lines. At most a hundred layers are looked at, those with the most of them.
    """
    lines = np.flatnonzero((columns.role == Role.LINE) & ~columns.bounding)
    with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
        lines = lines[np.isfinite(shapely.length(columns.geometry[lines]))]
    closed = lines[shapely.is_ring(columns.geometry[lines])]
    # A line of no extent counts as a ring too, and bounds nothing.
    closed = closed[shapely.get_num_points(columns.geometry[closed]) >= _RING_VERTICES]
    layers, number, count = np.unique(columns.layer[closed].astype(str), return_inverse=True, return_counts=True)
    of_layer = np.split(closed[np.argsort(number, kind="stable")], np.cumsum(count)[:-1])
    most = sorted(np.argsort(-count, kind="stable")[:_LAYERS].tolist())
    return tuple(str(layers[n]) for n in most if _shares(columns, of_layer[n], coincide))


def _shares(columns: Columns, rows: Index, coincide: float) -> bool:
    if len(rows) < _FEWEST:
        return False
    lines = columns.build(Lines, rows)
    assert isinstance(lines, Lines)  # noqa: S101 - by the kind that was asked for
    lines = lines.take(_beside_each_other(lines.geometry))
    if len(lines) < _FEWEST:
        return False
    table = lines.polylines
    found = line_overlaps(table, np.zeros(len(lines), dtype=bool), coincide=coincide)
    shared = np.zeros(len(lines))
    for side in (found.line, found.other):
        np.add.at(shared, side, found.length)
    return bool(2 * np.count_nonzero(shared >= _SHARED * table.length) >= len(lines))


def _beside_each_other(rings: Geometries) -> np.ndarray:
    """(n,) closed lines that lie in no other one, and hold none."""
    points, of_ring = shapely.get_coordinates(rings, return_index=True)
    faces = shapely.polygons(shapely.linearrings(points, indices=of_ring))
    inner, outer = shapely.STRtree(faces).query(shapely.point_on_surface(faces), predicate="within")
    nested = inner != outer
    beside = np.ones(len(rings), dtype=bool)
    beside[inner[nested]] = beside[outer[nested]] = False
    return beside
