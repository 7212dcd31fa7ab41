# SPDX-License-Identifier: MIT
"""Linework of a drawing as places of tables are held against it."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from foparq.check.drawn.causes import beside_corners, cause_on
from foparq.check.drawn.columns import Columns
from foparq.check.drawn.made import only_for_points
from foparq.check.tables.ground import Ground, Nearness
from foparq.columns import Coordinates, Flags, Geometries, Index, Reals, Texts
from foparq.geom.clusters import clusters
from foparq.geom.extent import boxes_of, main_box
from foparq.match.causes import Cause
from foparq.match.linework import Footing, Linework, footing, stands_in_space
from foparq.model.drawing import Drawing
from foparq.model.inputs import Lines
from foparq.model.items import Role
from foparq.names import folded

_BESIDE = 0.5  #: metres between a point and the lettering that names it
_ONE_VERTEX = 0.01  #: share of the radius of search in which ends of lines are one corner


@dataclass(frozen=True, slots=True)
class DrawnGround(Ground):
    """Linework of one drawing; sheet coordinates, metres."""

    drawing: Drawing
    work: Linework  #: m lines and boundaries that can be seen
    every: Linework  #: the same with what cannot be seen: in another unit it can
    item: Texts  #: (m,)
    layer: Texts  #: (m,)
    deep: bool  #: it stands in space: depths are compared
    points: Coordinates  #: (p, 3) of its points, in the axes of the file, drawing units
    named: Mapping[str, Sequence[int]]  #: rows of its labels by folded name

    @property
    def path(self) -> str:
        """Of the drawing."""
        return self.drawing.path

    @property
    def facade(self) -> str:
        """That the drawing shows."""
        return self.drawing.facade

    @property
    def metres(self) -> float:
        """Metres in one drawing unit."""
        return self.drawing.unit.metres or 1.0

    @property
    def depth_axis(self) -> int:
        """Axis of the file that runs along the depth."""
        return int(np.argmax(np.abs(self.drawing.plane.frame[2])))

    @property
    def flat(self) -> int:
        """Axis of the depth, if the drawing has none."""
        return -1 if self.deep else self.depth_axis

    @property
    def axes(self) -> int:
        """Axes of the sheet in which places are compared."""
        return 3 if self.deep else 2

    def on_sheet(self, places: Coordinates) -> Coordinates:
        """Places (n, 3) in metres, in the axes of the file, brought to the sheet.

        The depth that a flat drawing does not have may be missing.
        """
        if not self.deep:
            places = places.copy()
            places[:, self.depth_axis] = np.nan_to_num(places[:, self.depth_axis])
        return self.drawing.plane.project(places / self.metres, self.metres)

    def in_file(self, sheet: Coordinates) -> Coordinates:
        """Sheet coordinates (n, 3) in the axes of the file, metres; a depth that the drawing does not have is NaN."""
        places: Coordinates = self.drawing.plane.lift(sheet, self.metres) * self.metres
        if not self.deep:
            places[:, self.depth_axis] = np.nan
        return places

    def footing(self, places: Coordinates, within: Reals, printed: Reals | None = None) -> Footing:
        """Linework on which places (n, 3) in metres, in the axes of the file, lie; ``printed`` as :meth:`rounding`."""
        rounding = None if printed is None else self.rounding(printed)
        return footing(self.on_sheet(places), self.work, within=within, deep=self.deep, rounding=rounding)

    def rounding(self, printed: Reals) -> Reals:
        """Half the last printed digits (3,) along the axes of the file, as seen on the sheet: right, up, and depth.

        Nothing along the depth of a flat drawing, where nothing is compared.
        """
        seen: Reals = np.abs(self.drawing.plane.frame) @ printed
        return seen if self.deep else seen * [1.0, 1.0, 0.0]

    def hidden(self, printed: Reals) -> float:
        """How far a place may lie from where it is told to, because of the digits that are not printed, metres."""
        return float(np.linalg.norm(self.rounding(printed)))

    def called(self, rows: Index) -> tuple[Texts, Texts]:
        """Items and layers of lines."""
        return self.item[rows], self.layer[rows]

    def near(self, surveyed: Coordinates, radius: float) -> Coordinates:
        """The only vertices near surveyed places; NaN where there is none, or several."""
        taken = np.full(surveyed.shape, np.nan)
        if not len(surveyed):
            return taken
        from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; delivered coordinates need none

        corners = np.unique(self.corners(), axis=0)
        around = cKDTree(corners[:, : self.axes]).query_ball_point(self.on_sheet(surveyed)[:, : self.axes], radius)
        for row, rows in enumerate(around):
            # Ends of several lines at one corner are one vertex.
            if rows and np.ptp(corners[rows][:, : self.axes], axis=0).max() <= radius * _ONE_VERTEX:
                taken[row] = self.in_file(corners[rows[:1]])[0]
        return taken

    def made(self, places: Coordinates, within: Reals, near: Nearness) -> Flags:
        """(n,) places on nothing but linework that shows nothing else."""
        return only_for_points(self, places, within, near)

    def cause(self, places: Coordinates, bearing: Coordinates, within: float, *, corners: bool) -> Cause | None:
        """One cause that puts all places on the linework, or at its corners."""
        search = beside_corners if corners else cause_on
        return search(self, places, bearing, within)

    def apart(self, places: Coordinates, bearing: Coordinates, printed: Reals) -> tuple[Reals, Reals]:
        """Distances of places from those that bear their ids; and the same less what was rounded."""
        step = np.abs(self.on_sheet(places) - self.on_sheet(bearing))[:, : self.axes]
        less = np.maximum(step - self.rounding(printed)[: self.axes], 0.0)
        gap, net = np.linalg.norm(step, axis=1), np.linalg.norm(less, axis=1)
        return np.where(np.isfinite(gap), gap, np.inf), np.where(np.isfinite(net), net, np.inf)

    def marked(self, places: Coordinates, within: Reals) -> Flags:
        """(n,) whether an insert or point that bears a name is at a place (n, 3), metres, in the axes of the file."""
        marks = self._marks() * self.metres
        if not len(marks):
            return np.zeros(len(places), dtype=bool)
        apart = self.on_sheet(places)[:, None, : self.axes] - self.on_sheet(marks)[None, :, : self.axes]
        at: Flags = np.any(np.linalg.norm(apart, axis=2) <= within[:, None], axis=1)
        return at

    def _marks(self) -> Coordinates:
        """Places (k, 3) of what bears a name, in the axes of the file, drawing units."""
        labels = self.drawing.reading.labels
        if labels is None or not len(labels.text):
            return np.empty((0, 3))
        marks: Coordinates = labels.place[labels.block]
        beside = labels.place[~labels.block]
        if len(self.points) and len(beside):
            from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load

            gap, row = cKDTree(self.points).query(beside, distance_upper_bound=_BESIDE / self.metres)
            marks = np.concatenate([marks, self.points[row[np.isfinite(gap)]]])
        return marks

    def bearing(self, name: str) -> Coordinates | None:
        """The one place (3,) that bears a name, in the axes of the file, metres; ``None`` if none does, or several.

        An insert with such an attribute, or the nearest point beside such a lettering.
        """
        places = [self._borne(row) for row in self.named.get(folded(name), ())]
        known = np.unique([place for place in places if place is not None], axis=0)
        if len(known) != 1:
            return None
        place: Coordinates = known[0] * self.metres
        if not self.deep:
            place[self.depth_axis] = np.nan
        return place

    def _borne(self, row: int) -> Coordinates | None:
        labels = self.drawing.reading.labels
        if labels is None or labels.block[row]:
            return None if labels is None else labels.place[row]
        gap = np.linalg.norm(self.points - labels.place[row], axis=1)
        beside: Coordinates | None = None
        if len(gap) and gap.min() * self.metres <= _BESIDE:
            beside = self.points[np.argmin(gap)]
        return beside

    def corners(self, *, every: bool = False) -> Coordinates:
        """(v, 3) vertices on the sheet; those that cannot be seen too if asked for."""
        corners = shapely.get_coordinates((self.every if every else self.work).lines, include_z=True)
        finite: Coordinates = np.nan_to_num(corners[np.isfinite(corners[:, :2]).all(axis=1)])
        return finite

    def beyond(self, places: Coordinates, distance: Reals) -> Reals:
        """Distances (n,) of places (n, 3) in metres, in the axes of the file, from the drawing.

        Parameters
        ----------
        distance : (n,) metres
            To the nearest linework in the plane. Where the drawing stands in space, what the place lies before or
            behind all of it is added.
        """
        if not self.deep:
            return distance
        low, high = main_box(boxes_of(self.work.lines))
        depth = self.on_sheet(places)[:, 2]
        far: Reals = np.hypot(distance, np.maximum(0.0, np.maximum(low[2] - depth, depth - high[2])))
        return far

    def longest(self) -> float:
        """Length of the longest line that fits into the box of the drawing, without strays."""
        low, high = main_box(boxes_of(self.work.lines))
        return float(np.linalg.norm(high - low))


def ground_of(drawing: Drawing, near: Nearness) -> DrawnGround | None:
    """What places are held against; ``None`` if nobody knows the unit of the drawing, or nothing is drawn.

    Linework on layers that are not plotted, and what cannot be seen with all that touches it, show nothing. A point
    without a name is no linework: it would be at the place that the table says, wherever that is.

    Parameters
    ----------
    near : Nearness
        Of the profile.
    """
    if drawing.unit.metres is None:
        return None
    columns = Columns(drawing, hidden=False)
    plotted = ~np.isin(columns.layer.astype(str), drawing.reading.unplotted)
    lines = columns.build(Lines, np.flatnonzero(plotted))
    assert isinstance(lines, Lines)  # noqa: S101 - what was asked for
    point = np.flatnonzero(plotted & (columns.role == Role.POINT) & _placed(columns.geometry))
    at = columns.rows[point]
    seen = _seen(lines.geometry, near)
    geometry: Geometries = np.concatenate([lines.geometry, columns.geometry[point]])
    if not len(geometry):
        return None
    work = Linework.of(lines.geometry[seen])
    return DrawnGround(
        drawing=drawing, work=work, every=work if seen.all() else Linework.of(lines.geometry),
        item=lines.item[seen], layer=lines.layer[seen],
        deep=stands_in_space(geometry),
        points=np.nan_to_num(shapely.get_coordinates(drawing.items.geometry[at], include_z=True)),
        named=_rows_by_name(drawing),
    )  # fmt: skip


def _seen(lines: Geometries, near: Nearness) -> Flags:
    """(m,) lines that are not smaller than what can be seen, with all that touches them."""
    bounds = shapely.bounds(lines)
    small = np.hypot(bounds[:, 2] - bounds[:, 0], bounds[:, 3] - bounds[:, 1]) < near.visible
    if not small.any():
        return np.ones(len(lines), dtype=bool)
    group = clusters(lines, gap=near.tie)
    low, high = np.full((len(lines), 2), np.inf), np.full((len(lines), 2), -np.inf)
    np.minimum.at(low, group, bounds[:, :2])
    np.maximum.at(high, group, bounds[:, 2:])
    seen: Flags = (np.hypot(*(high - low).T) >= near.visible)[group]
    return seen


def _rows_by_name(drawing: Drawing) -> dict[str, list[int]]:
    """Rows of the labels of a drawing by folded name."""
    found: dict[str, list[int]] = defaultdict(list)
    for row, text in enumerate(drawing.reading.labels.text if drawing.reading.labels else ()):
        found[folded(str(text))].append(row)
    return found


def _placed(geometry: Geometries) -> Flags:
    """(n,) whether a point has a place."""
    there: Flags = ~(shapely.is_missing(geometry) | shapely.is_empty(geometry))
    there[there] = np.isfinite(shapely.bounds(geometry[there])).all(axis=1)
    return there
