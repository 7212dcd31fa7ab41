# SPDX-License-Identifier: MIT
"""Geometries that no other kernel can work with."""

import re
from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index
from foparq.geom.parts import is_finite, rings_of, single_parts

_LINE, _RING = (shapely.GeometryType.LINESTRING, shapely.GeometryType.LINEARRING)
#: vertices below which a line or ring has no shape
_LEAST_LINE, _LEAST_RING = 2, 4
_PLACE = re.compile(r"\[(\S+) (\S+)(?: \S+)?\]")


class Invalid(NamedTuple):
    """Geometries without a usable shape, k rows in order."""

    row: Index  #: (k,)
    place: Geometries  #: (k,) point, empty where there is none


def invalid_geometries(geometry: Geometries) -> Invalid:
    """Geometries that are missing, empty, not finite, short of vertices, or polygons that bound no area.

    Parameters
    ----------
    geometry : (n,) shapely geometries or None

    Returns
    -------
    Invalid
        A polygon counts if GEOS calls it invalid, except where the only fault is a ring that crosses or touches
        itself: that is a matter of the ring as a line. Parts and holes that are empty are no fault. The place is the
        one GEOS names; it names one.

    Notes
    -----
    O(vertices log vertices). Depth is not looked at. Validity is that of OGC Simple Features in the GEOS reading.
    """
    broken = shapely.is_missing(geometry) | shapely.is_empty(geometry) | _not_finite(geometry) | _too_short(geometry)
    place = np.full(len(geometry), shapely.Point(), dtype=object)
    doubtful = np.flatnonzero(~broken & ~shapely.is_valid(geometry) & (shapely.get_dimensions(geometry) == 2))  # noqa: PLR2004
    # GEOS names what it comes upon first: the same place wherever a ring starts and whichever way it is drawn.
    reason = shapely.is_valid_reason(shapely.normalize(geometry[doubtful]))
    simple = _rings_are_simple(geometry[doubtful])
    for row, text, rings_are_simple in zip(doubtful, reason, simple, strict=True):
        if "elf-intersection" in text and not rings_are_simple:
            continue
        broken[row] = True
        named = _PLACE.search(text)
        if named and all(np.isfinite(float(number)) for number in named.groups()):
            place[row] = shapely.Point(float(named[1]), float(named[2]))
    rows = np.flatnonzero(broken)
    return Invalid(rows, place[rows])


def _not_finite(geometry: Geometries) -> Flags:
    bad = ~is_finite(geometry)
    depth, row = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    # A missing depth reads as NaN in a flat geometry; an infinite one is never meant.
    bad[row[np.isinf(depth[:, 2])]] = True
    return bad


def _too_short(geometry: Geometries) -> Flags:
    parts, row = single_parts(geometry)
    bad = np.zeros(len(geometry), dtype=bool)
    lines = np.isin(shapely.get_type_id(parts), (_LINE, _RING))
    bad[row[lines & (shapely.get_num_coordinates(parts) < _LEAST_LINE)]] = True
    rings, owner = rings_of(parts)
    closed = shapely.is_closed(rings)
    bad[row[owner[(shapely.get_num_coordinates(rings) < _LEAST_RING) | ~closed]]] = True
    return bad


def _rings_are_simple(geometry: Geometries) -> Flags:
    """True (n,) where no ring crosses or touches itself."""
    parts, row = single_parts(geometry)
    rings, owner = rings_of(parts)
    simple = np.ones(len(geometry), dtype=bool)
    simple[row[owner[~shapely.is_simple(rings)]]] = False
    return simple
