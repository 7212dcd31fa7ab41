# SPDX-License-Identifier: MIT
"""Linework that shows nothing but checkpoints: strokes drawn where a table says that something is.

A table of another building would lie on it, and it says nothing of the building that is drawn.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import shapely

from foparq.check.tables.ground import Nearness
from foparq.columns import Coordinates, Flags, Geometries, Index, Reals, Texts
from foparq.model.layers import matching

if TYPE_CHECKING:
    from foparq.check.drawn.ground import DrawnGround

_CORNERS = 2  #: corners of such a line for each point on it: a stroke has both ends, a line through points one each
_SMALL = 50  #: a mark is not larger than so many times what can be seen: 10 mm on the sheet
_USUAL = 0.5  #: share of the small things of a layer that bear a point, from which the layer is one of marks
_FEWEST = 3  #: marks of a layer
_CHANCE = 2  #: places at which a mark may touch other linework


def only_for_points(ground: "DrawnGround", places: Coordinates, within: Reals, near: Nearness) -> Flags:
    """Points that lie on nothing but linework which shows nothing else.

    A line shows nothing but points if its layer has no class of features and

    - its corners, and the places where other linework touches it, are together at most two for each point on it: a
      stroke, a line from point to point; or
    - it is a mark: not larger than fifty times what can be seen, touched at two places at most, on a layer with at
      least three small things, half of which bear a point.

    Linework touches where one line has a vertex and the other one lies, but for checkpoints: a stroke drawn for one may
    meet there what is drawn. Lines that cross do not touch.

    Parameters
    ----------
    places : (n, 3) metres
        In the axes of the file; points with a coordinate that is not finite lie on nothing.
    within : (n,) metres
        Distance up to which a point lies on a line.
    near : Nearness
        Of the profile.

    Returns
    -------
    (n,) bool
        False for points on no line.

    Notes
    -----
    O(n log m + vertices of the lines that touch one with few corners). Depths are not looked at.
    """
    sheet = ground.on_sheet(places)
    made = np.zeros(len(places), dtype=bool)
    known = np.flatnonzero(np.isfinite(sheet[:, :2]).all(axis=1))
    if not len(known) or not len(ground.work.lines):
        return made
    spots = shapely.points(sheet[known, :2])
    spot, line = ground.work.tree.query(spots, predicate="dwithin", distance=within[known])
    bearing, of, points = np.unique(line, return_inverse=True, return_counts=True)
    touching = _Touching(ground, near.tie, spots, float(within[known].max()) + near.tie)
    classed = matching(ground.layer[bearing], list(ground.drawing.classes))
    marks = _marks(ground, bearing, near)[bearing]
    corners = touching.corners(bearing)
    only = ~classed & (marks | (corners <= _CORNERS * points))
    for row in np.flatnonzero(only).tolist():
        places_touched = touching.places(bearing[row])
        few = corners[row] + places_touched <= _CORNERS * points[row]
        only[row] = few or bool(marks[row] and places_touched <= _CHANCE)
    made[known[spot]] = True
    made[known[spot[~only[of]]]] = False
    return made


class _Touching:
    """Where linework touches that of a drawing, in the plane."""

    def __init__(self, ground: "DrawnGround", tie: float, spots: Geometries, within: float) -> None:
        self.lines, self.tree, self.tie = shapely.force_2d(ground.work.lines), ground.work.tree, tie
        self.spots, self.within = shapely.STRtree(spots), within

    def corners(self, some: Index) -> Index:
        """(k,) vertices of some lines, each place once."""
        spots, of = shapely.get_coordinates(self.lines[some], return_index=True)
        places = np.unique(np.column_stack([of, self._cells(spots)]), axis=0)
        return np.bincount(places[:, 0].astype(np.intp), minlength=len(some))

    def places(self, line: int) -> int:
        """Places where other linework touches a line, but for those at checkpoints."""
        own = np.unique(shapely.get_coordinates(self.lines[line]), axis=0)
        vertex, other = self.tree.query(shapely.points(own), predicate="dwithin", distance=self.tie)
        near = self.tree.query(self.lines[line], predicate="dwithin", distance=self.tie)
        spots = shapely.get_coordinates(self.lines[near[near != line]])
        on_it = shapely.distance(shapely.points(spots), self.lines[line]) <= self.tie
        touched = np.concatenate([own[np.unique(vertex[other != line])], spots[on_it]])
        at_point = self.spots.query(shapely.points(touched), predicate="dwithin", distance=self.within)[0]
        return len(np.unique(self._cells(np.delete(touched, at_point, axis=0)), axis=0))

    def _cells(self, places: Reals) -> Reals:
        cells: Reals = np.round(places / (2 * self.tie))
        return cells


def _marks(ground: "DrawnGround", bearing: Index, near: Nearness) -> Flags:
    """(m,) small lines of layers whose small things mostly bear points."""
    bounds = shapely.bounds(ground.work.lines)
    small = np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1]) <= _SMALL * near.visible
    bears = np.zeros(len(small), dtype=bool)
    bears[bearing] = True
    names, layer = np.unique(ground.layer.astype(str), return_inverse=True)
    all_small = np.bincount(layer[small], minlength=len(names))
    bearing_small = np.bincount(layer[small & bears], minlength=len(names))
    usual = (all_small >= _FEWEST) & (bearing_small >= _USUAL * all_small)
    marks: Flags = usual[layer] & small
    return marks


def mostly(rows: Flags, drawings: Sequence[str], of: Texts) -> Flags:
    """(n,) those rows that are more than half of all rows of their drawing.

    Parameters
    ----------
    rows : (n,) bool
    drawings : sequence of str
        Paths.
    of : (n,) path of the drawing of each row
    """
    most = np.zeros(len(rows), dtype=bool)
    for path in drawings:
        here = of == path
        if 2 * np.count_nonzero(rows & here) > np.count_nonzero(here):
            most |= rows & here
    return most
