# SPDX-License-Identifier: MIT
"""Areas that should cover a surface once: where two of them overlap, and where they leave a gap."""

from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Geometries, Index, Reals
from foparq.geom.parts import without_empty_holes
from foparq.geom.ranks import area_ranks
from foparq.geom.rounding import EARTH, origin_of, slack_of

#: corners sharper than this many times the growth are cut, so that growing stays near
_MITRE = 5.0
_BLOCK = 1000  #: pairs of a gap and an area looked at in one step
_STEP = 200  #: areas compared with all in one step
_POLYGON = shapely.GeometryType.POLYGON


class AreaOverlaps(NamedTuple):
    """Pairs of areas that cover a place twice, k rows."""

    larger: Index  #: (k,)
    smaller: Index  #: (k,) the one at fault; of equals the later by place
    common: Geometries  #: (k,) polygon or polygons
    area: Reals  #: (k,) square metres


class Gaps(NamedTuple):
    """Enclosed places that no area covers, k rows in order of (first, second)."""

    first: Index  #: (k,) area that bounds most of it, of equals the larger, then the first by place
    second: Index  #: (k,) the next
    gap: Geometries  #: (k,) polygon
    area: Reals  #: (k,) square metres


def area_overlaps(areas: Geometries, *, least: float) -> AreaOverlaps:
    """Pairs of areas whose common area is greater than ``least``.

    Parameters
    ----------
    areas : (n,) valid shapely polygons
    least : float, square metres

    Returns
    -------
    AreaOverlaps
        ``common`` holds the polygons of the intersection; lines and points that areas share are left out.

    Notes
    -----
    O(n log n + pairs that touch). Depth is not looked at.
    """
    local, origin = _near_zero(areas)
    shapely.prepare(local)
    tree = shapely.STRtree(local)
    # Whichever comes first in the file, the smaller of two areas is the one at fault.
    rank = area_ranks(areas)
    slack = slack_of(shapely.get_coordinates(areas))
    nothing = np.empty(0, dtype=np.intp)
    found = [AreaOverlaps(nothing, nothing, np.empty(0, dtype=object), np.empty(0))]
    for start in range(0, len(areas), _STEP):
        i, j = tree.query(local[start : start + _STEP], predicate="intersects")
        i += start
        i, j = i[rank[j] < rank[i]], j[rank[j] < rank[i]]
        inner = shapely.covers(local[j], local[i])
        # What lies within another is what they have in common.
        common = areas[i]
        common[~inner] = shapely.intersection(local[i[~inner]], local[j[~inner]])
        area = shapely.area(common)
        over = area > least + slack * shapely.length(common) + 1e-9 * least
        partly = over & ~inner
        common[partly] = _moved(_polygons_only(common[partly]), origin)
        found.append(AreaOverlaps(j[over], i[over], common[over], area[over]))
    larger, smaller, common, area = (np.concatenate(column) for column in zip(*found, strict=True))
    order = np.lexsort((larger, smaller))
    return AreaOverlaps(larger[order], smaller[order], common[order], area[order])


def coverage_gaps(areas: Geometries, *, coincide: float, most: float) -> Gaps:
    """Places enclosed by areas together, covered by none, not larger than ``most``.

    Parameters
    ----------
    areas : (n,) valid shapely polygons
    coincide : float, metres
        A place narrower than this is no gap, and an opening narrower than this does not let out.
    most : float, square metres
        A larger place is meant to be open.

    Returns
    -------
    Gaps
        The areas are grown by half of ``coincide``; what they then enclose is grown back. It follows that a disc of
        diameter ``coincide`` fits into every gap, and that parts of a gap narrower than ``coincide`` do not count.

    Notes
    -----
    O(v log v) in the vertices. A gap is bounded by at least two areas, counted within ``coincide``: a hole of one area
    is none. Two parts of one feature are two areas here. Areas that go beyond the Earth are passed over: joined with
    them, the others would lose their digits.
    """
    near = np.flatnonzero(np.all(np.abs(shapely.bounds(areas).reshape(-1, 4)) <= EARTH, axis=1))
    if len(near) < len(areas):
        found = coverage_gaps(areas[near], coincide=coincide, most=most)
        return found._replace(first=near[found.first], second=near[found.second])
    if not len(areas):
        nothing = np.empty(0, dtype=np.intp)
        return Gaps(nothing, nothing, np.empty(0, dtype=object), np.empty(0))
    local, origin = _near_zero(areas)
    half = coincide / 2 + slack_of(shapely.get_coordinates(areas))
    covered = shapely.union_all(_grown(local, half))
    x0, y0, x1, y1 = shapely.bounds(covered)
    frame = shapely.box(x0 - 1, y0 - 1, x1 + 1, y1 + 1)
    open_parts = shapely.get_parts(shapely.difference(frame, covered))
    # The part outside of everything touches the frame.
    enclosed = open_parts[~shapely.intersects(open_parts, shapely.get_exterior_ring(frame))]
    enclosed = _polygons_only(_grown(enclosed, half))
    area = shapely.area(enclosed)
    small = (area > 0) & (
        area <= most + slack_of(shapely.get_coordinates(areas)) * shapely.length(enclosed) + 1e-9 * most
    )
    enclosed, area = enclosed[small], area[small]

    gap, side = shapely.STRtree(local).query(enclosed, predicate="dwithin", distance=2 * half)
    first, second = _most_bounding(local, enclosed, gap, side, half)
    kept = np.flatnonzero(second >= 0)
    kept = kept[np.lexsort((second[kept], first[kept]))]
    return Gaps(first[kept], second[kept], _moved(enclosed[kept], origin), area[kept])


def _most_bounding(areas: Geometries, gaps: Geometries, gap: Index, side: Index, half: float) -> tuple[Index, Index]:
    """The two areas (g,) that bound most of each gap, of equals the larger; -1 where there is none.

    ``gap`` and ``side`` are pairs of a gap and an area near it.
    """
    shared = np.zeros(len(gap))
    several = np.flatnonzero(np.bincount(gap, minlength=len(gaps))[gap] > 2)  # noqa: PLR2004 - two are not chosen
    edges = shapely.boundary(gaps)
    for start in range(0, len(several), _BLOCK):
        rows = several[start : start + _BLOCK]
        near, of = np.unique(side[rows], return_inverse=True)
        grown = _grown(areas[near], 2 * half)
        shared[rows] = shapely.length(shapely.intersection(edges[gap[rows]], grown[of.reshape(-1)]))
    order = np.lexsort((area_ranks(areas)[side], -np.round(shared / half), gap))
    gap, side = gap[order], side[order]
    head = np.searchsorted(gap, np.arange(len(gaps)))
    chosen = np.full((2, len(gaps)), -1, dtype=np.intp)
    for n, column in enumerate(chosen):
        there = np.flatnonzero(head + n < np.searchsorted(gap, np.arange(len(gaps)), side="right"))
        column[there] = side[head[there] + n]
    return chosen[0], chosen[1]


def _grown(shapes: Geometries, by: float) -> Geometries:
    grown: Geometries = shapely.buffer(shapes, by, join_style="mitre", mitre_limit=_MITRE)
    return grown


def _near_zero(areas: Geometries) -> tuple[Geometries, Reals]:
    """The areas moved to near zero, where computing loses no digits, and by how much."""
    origin = origin_of(shapely.get_coordinates(areas))
    return _moved(without_empty_holes(areas), -origin), origin


def _moved(shapes: Geometries, by: Reals) -> Geometries:
    moved: Geometries = shapely.transform(shapes, lambda coordinates: coordinates + by)
    return moved


def _polygons_only(shapes: Geometries) -> Geometries:
    """Polygonal part (n,) of each geometry; lines and points are dropped."""
    kind = shapely.get_type_id(shapes)
    mixed = np.flatnonzero(kind == shapely.GeometryType.GEOMETRYCOLLECTION)
    shapes = shapes.copy()
    for row in mixed:
        parts = shapely.get_parts(shapes[row])
        parts = parts[shapely.get_type_id(parts) == _POLYGON]
        shapes[row] = parts[0] if len(parts) == 1 else shapely.multipolygons(parts)
    return shapes
