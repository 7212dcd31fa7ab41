# SPDX-License-Identifier: MIT
"""Faces, edges and vertices as shapely geometries in space."""

import numpy as np
import shapely

from foparq.columns import Coordinates, Geometries, Index, Reals
from foparq.mesh.borders import Borders
from foparq.mesh.polygons import chosen, members


def face_areas(points: Coordinates, corners: Index, starts: Index, faces: Index) -> Geometries:
    """Polygons (k,) of chosen faces, each closed; in space, whatever way they face."""
    areas: Geometries = shapely.polygons(_rings(points, corners, starts, faces))
    return areas


def face_lines(points: Coordinates, corners: Index, starts: Index, faces: Index) -> Geometries:
    """Outlines (k,) of chosen faces: what is left of a face without area."""
    some, begin = chosen(corners, starts, faces)
    some, owner = _closed(some, begin)
    return shapely.linestrings(points[some], indices=owner) if len(faces) else _nothing()


def edge_lines(points: Coordinates, tail: Index, head: Index) -> Geometries:
    """Segments (k,) between vertices."""
    return shapely.linestrings(points[np.stack([tail, head], axis=1)]) if len(tail) else np.empty(0, dtype=object)


def border_lines(points: Coordinates, found: Borders, rows: Index) -> Geometries:
    """Lines (k,) along chosen borders; loops come back to their first vertex."""
    begin, member = members(found.starts, rows)
    owner = np.repeat(np.arange(len(rows)), np.diff(begin))
    run = np.concatenate([found.vertices[member], found.last[rows]])
    owners = np.concatenate([owner, np.arange(len(rows))])
    order = np.argsort(owners, kind="stable")
    return shapely.linestrings(points[run[order]], indices=owners[order]) if len(rows) else _nothing()


def segments_or_points(ends: Reals) -> Geometries:
    """Segments (k,) between two places each; a point where both are one.

    Parameters
    ----------
    ends : (k, 2, 3) float
    """
    made: Geometries = np.full(len(ends), None, dtype=object)
    point = (ends[:, 0] == ends[:, 1]).all(axis=1)
    made[point] = shapely.points(ends[point, 0])
    made[~point] = shapely.linestrings(ends[~point]) if not point.all() else _nothing()
    return made


def _nothing() -> Geometries:
    return np.empty(0, dtype=object)


def _rings(points: Coordinates, corners: Index, starts: Index, faces: Index) -> Geometries:
    some, begin = chosen(corners, starts, faces)
    some, owner = _closed(some, begin)
    return shapely.linearrings(points[some], indices=owner) if len(faces) else np.empty(0, dtype=object)


def _closed(corners: Index, starts: Index) -> tuple[Index, Index]:
    """Corners with the first of each face once more at its end, and the face of each."""
    count = len(starts) - 1
    owner = np.repeat(np.arange(count), np.diff(starts))
    run = np.concatenate([corners, corners[starts[:-1]]])
    owners = np.concatenate([owner, np.arange(count)])
    order = np.argsort(owners, kind="stable")
    return run[order], owners[order]
