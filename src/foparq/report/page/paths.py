# SPDX-License-Identifier: MIT
"""Linework as columns on the sheet, and as path data of a scalable picture."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from foparq.columns import Flags, Geometries, Index, Reals
from foparq.model.plane import Plane

FARTHEST = 1e9  #: cells: what lies farther is drawn there, out of sight
_POLYGON = 3


@dataclass(frozen=True, slots=True)
class Strokes:
    """m vertices of k strokes; a stroke is an open or closed line, or a single point.

    Parameters
    ----------
    points : (m, 2) metres, or cells of the picture
        Right and up on the sheet.
    stroke : (m,) int
        Stroke that owns the vertex, ascending from 0.
    owner : (k,) int
        Row of the geometry that the stroke comes from.
    """

    points: Reals
    stroke: Index
    owner: Index

    def take(self, wanted: Flags) -> "Strokes":
        """The chosen strokes (k,)."""
        vertices = wanted[self.stroke]
        renumbered = np.cumsum(wanted) - 1
        return Strokes(self.points[vertices], renumbered[self.stroke[vertices]], self.owner[wanted])


def strokes_of(geometry: Geometries, plane: Plane | None, metres: float) -> Strokes:
    """Lines, rings and points of any geometries, projected on the sheet.

    Parameters
    ----------
    geometry : (n,) shapely geometries
        May hold ``None``, empty and nested collections.
    plane : Plane or None
        ``None``: the coordinates are those of the sheet already.
    metres : float
        Metres in one drawing unit.

    Returns
    -------
    Strokes
        Without those that have a coordinate which is not finite.
    """
    parts, owner = shapely.get_parts(np.asarray(geometry, dtype=object), return_index=True)
    while np.any(shapely.get_type_id(parts) > _POLYGON):  # collections may be nested
        parts, inner = shapely.get_parts(parts, return_index=True)
        owner = owner[inner]
    flat = shapely.get_type_id(parts) == _POLYGON
    rings, of_polygon = shapely.get_rings(parts[flat], return_index=True)
    lines = np.concatenate([parts[~flat], rings])
    owner = np.concatenate([owner[~flat], owner[flat][of_polygon]])
    order = np.argsort(owner, kind="stable")
    lines, owner = lines[order], owner[order]
    vertices, stroke = shapely.get_coordinates(lines, include_z=True, return_index=True)
    vertices[:, 2] = np.nan_to_num(vertices[:, 2], nan=0.0, posinf=np.inf, neginf=-np.inf)
    bad = np.zeros(len(lines), dtype=bool)
    bad[stroke[~np.isfinite(vertices).all(axis=1)]] = True
    bad[np.bincount(stroke, minlength=len(lines)) == 0] = True
    vertices[~np.isfinite(vertices)] = 0.0
    points = vertices[:, :2] if plane is None else plane.project(vertices, metres)[:, :2]
    return Strokes(points, stroke, owner).take(~bad)


def simplify(strokes: Strokes, tolerance: float) -> Strokes:
    """The same strokes within a tolerance (metres); strokes that shrink to one place become a point."""
    number = np.bincount(strokes.stroke, minlength=len(strokes.owner))
    single = (number < 2)[strokes.stroke]  # noqa: PLR2004 - a line has two ends
    lines = np.flatnonzero(number >= 2)  # noqa: PLR2004
    made = shapely.linestrings(strokes.points[~single], indices=np.repeat(np.arange(len(lines)), number[lines]))
    points, index = shapely.get_coordinates(
        shapely.simplify(made, tolerance, preserve_topology=False), return_index=True
    )
    joined = np.concatenate([strokes.points[single], points])
    stroke = np.concatenate([strokes.stroke[single], lines[index]])
    order = np.argsort(stroke, kind="stable")
    return Strokes(joined[order], stroke[order], strokes.owner)


def to_cells(strokes: Strokes, corner: Reals, quantum: float) -> Strokes:
    """Strokes in whole cells of the picture, y downward; vertices that fall on their predecessor are dropped.

    Parameters
    ----------
    strokes : Strokes
        In metres.
    corner : (2,) metres
        Upper left corner of the picture.
    quantum : float
        Metres in one cell.
    """
    cells = np.clip(np.rint((strokes.points - corner) / quantum * (1.0, -1.0)), -FARTHEST, FARTHEST)
    same = np.zeros(len(cells), dtype=bool)
    same[1:] = (cells[1:] == cells[:-1]).all(axis=1) & (strokes.stroke[1:] == strokes.stroke[:-1])
    return Strokes(cells[~same], strokes.stroke[~same], strokes.owner)


def merged_dots(strokes: Strokes) -> Strokes:
    """The same strokes with every cell holding at most one lone point."""
    number = np.bincount(strokes.stroke, minlength=len(strokes.owner))
    lone = np.flatnonzero(number == 1)
    if not len(lone):
        return strokes
    cell = strokes.points[np.isin(strokes.stroke, lone)]
    _, first = np.unique(cell, axis=0, return_index=True)
    kept = number != 1
    kept[lone[first]] = True
    return strokes.take(kept)


def path_data(strokes: Strokes) -> str:
    """Path data of strokes in cells: absolute starts, relative steps, lone points as strokes of no length."""
    if not len(strokes.points):
        return ""
    cells = strokes.points.astype(np.int64)
    start = np.ones(len(cells), dtype=bool)
    start[1:] = strokes.stroke[1:] != strokes.stroke[:-1]
    last = np.append(start[1:], True)
    step = np.diff(cells, axis=0, prepend=cells[:1])
    step[start] = cells[start]
    pieces: list[str] = []
    for opens, ends, (x, y) in zip(start.tolist(), last.tolist(), step.tolist(), strict=True):
        if opens:
            pieces.append(f"M{x} {y}h0" if ends else f"M{x} {y}l")
        else:
            # A minus sign separates by itself.
            pieces.append(f"{x}{y}" if y < 0 else f"{x} {y}")
            if not ends:
                pieces.append(" ")
    return "".join(pieces).replace(" -", "-")


def density(strokes: Strokes, width: int, height: int) -> NDArray[np.uint8]:
    """How much linework falls in every pixel.

    Parameters
    ----------
    strokes : Strokes
        In pixels, y downward.
    width, height : int
        Pixels.

    Returns
    -------
    (height, width) uint8
        255 where there is none; darker with the logarithm of what passes, in eight steps.
    """
    opens = np.diff(strokes.stroke, prepend=-1) > 0
    alone = np.flatnonzero(opens & np.append(opens[1:], True))  # a stroke of one vertex passes its own pixel
    follows = np.append(np.flatnonzero(~opens) - 1, alone)
    start, end = strokes.points[follows], strokes.points[np.append(np.flatnonzero(~opens), alone)]
    samples = np.ceil(np.abs(end - start).max(axis=1, initial=0.0)).astype(np.intp) + 1
    total = np.zeros(width * height, dtype=np.int64)
    bounds = np.searchsorted(np.cumsum(samples), np.arange(0, samples.sum() + _CHUNK, _CHUNK), side="right")
    for low, high in pairwise(bounds.tolist()):
        many = samples[low:high]
        of = np.repeat(np.arange(low, high), many)
        along = (np.arange(len(of)) - np.repeat(np.cumsum(many) - many, many)) / np.maximum(samples[of] - 1, 1)
        pixel = np.rint(start[of] + (end[of] - start[of]) * along[:, np.newaxis]).astype(np.intp)
        inside = ((pixel >= 0) & (pixel < (width, height))).all(axis=1)
        total += np.bincount(pixel[inside, 1] * width + pixel[inside, 0], minlength=len(total))
    level = np.minimum(np.ceil(np.log2(total + 1.0)), 7)  # 0 none, 7 very dense
    tone: NDArray[np.uint8] = np.where(level > 0, 200 - level * 24, 255).astype(np.uint8).reshape(height, width)
    return tone


_CHUNK = 4_000_000  #: samples held at a time
