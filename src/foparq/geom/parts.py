# SPDX-License-Identifier: MIT
"""What geometries are made of."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index

_SINGLE = shapely.GeometryType.POLYGON  #: greatest type number of a geometry without parts


def single_parts(geometry: Geometries) -> tuple[Geometries, Index]:
    """Points, lines, rings and polygons that geometries are made of, collections within collections taken apart.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None

    Returns
    -------
    parts : (k,) shapely geometries, none empty
    owner : (k,) int
        Row of the geometry, rising.
    """
    parts, owner = geometry, np.arange(len(geometry))
    while np.any(shapely.get_type_id(parts) > _SINGLE):
        parts, of = shapely.get_parts(parts, return_index=True)
        owner = owner[of]
    there = np.flatnonzero(~(shapely.is_missing(parts) | shapely.is_empty(parts)))
    return parts[there], owner[there]


def rings_of(polygons: Geometries) -> tuple[Geometries, Index]:
    """Rings (k,) of polygons, none empty, and the row of the polygon of each; a hole may be empty and is none."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    there = np.flatnonzero(~shapely.is_empty(rings))
    return rings[there], owner[there]


def without_empty_holes(polygons: Geometries) -> Geometries:
    """The same polygons (n,), those with a hole of no vertex built anew: GEOS ends the process when it prepares one."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    concerned = np.unique(owner[shapely.is_empty(rings)])
    if not len(concerned):
        return polygons
    built = polygons.copy()
    first, last = np.searchsorted(owner, concerned), np.searchsorted(owner, concerned, side="right")
    for row, start, stop in zip(concerned.tolist(), first.tolist(), last.tolist(), strict=True):
        shell, *holes = rings[start:stop]
        built[row] = shapely.Polygon(shell, [hole for hole in holes if not hole.is_empty])
    return built


def is_finite(geometry: Geometries) -> Flags:
    """True (n,) where every coordinate in the plane is a finite number; also where there is none."""
    coordinates, row = shapely.get_coordinates(geometry, return_index=True)
    finite = np.ones(len(geometry), dtype=bool)
    finite[row[~np.isfinite(coordinates).all(axis=1)]] = False
    return finite
