# SPDX-License-Identifier: MIT
"""Whether checkpoints and distances belong to the drawings that were delivered with them.

A table may be sound in itself and speak of another building. Delivered coordinates count where the drawing has
something to show for them: a vertex or linework, in the axes that the drawing has.
"""

from collections.abc import Sequence

import numpy as np

from foparq.check.drawn.alike import alike_facades
from foparq.check.drawn.distance_ties import tie_distances
from foparq.check.drawn.ground import Ground, Nearness, ground_of
from foparq.check.drawn.made import mostly, only_for_points
from foparq.columns import Coordinates, Flags, Reals, Texts
from foparq.findings.ties import Lies, PointTies, Ties
from foparq.match.causes import UNIT_FACTORS, Cause, by_axes_or_unit, by_place_or_size
from foparq.match.linework import NOTHING, footing
from foparq.match.repeats import repeats
from foparq.model.delivery import Delivery
from foparq.model.tables import Checkpoints


def tie_evidence(delivery: Delivery, near: Nearness) -> Ties:
    """Hold the tables of a delivery against its drawings.

    Parameters
    ----------
    near : Nearness
        Of the profile.

    Returns
    -------
    Ties
        Without drawings of a known unit nothing is tied.
    """
    grounds = [ground for drawing in delivery.drawings if (ground := ground_of(drawing, near)) is not None]
    if not grounds:
        return Ties()
    alike = alike_facades(grounds, within=near.tie)
    points, distances = None, None
    if delivery.checkpoints is not None and len(delivery.checkpoints.id):
        points = tie_points(delivery.checkpoints, grounds, near)
    if delivery.distances is not None and len(delivery.distances.id):
        distances = tie_distances(
            delivery.distances, delivery.checkpoints, points, grounds, tie=near.tie, visible=near.visible
        )
    return Ties(points=points, distances=distances, alike=alike, drawings=len(grounds))


def tie_points(points: Checkpoints, grounds: Sequence[Ground], near: Nearness) -> PointTies:
    """Checkpoints held against drawings.

    A delivered point lies in a drawing if linework is not farther than ``near.tie`` and half the last printed digit of
    its coordinates, in the axes that the drawing has: a drawing that does not stand in space says nothing of depths. So
    is what bears its id: an insert with such an attribute, a point beside such a lettering. Without delivered
    coordinates these are taken from what bears the id, else from the only vertex within ``near.search`` of the surveyed
    place.

    Parameters
    ----------
    points : Checkpoints, n rows
    grounds : sequence of Ground
        One at least.

    Returns
    -------
    PointTies, n rows
        Of several drawings the nearest counts. If more than half of the points are absent, the cause that would put
        all of them on one drawing; if more than half are absent or within a line, that which would put all at vertices.
    """
    n = len(points.id)
    lies, gap, corner = np.full(n, str(Lies.ABSENT), dtype=object), np.full(n, np.inf), np.full(n, np.inf)
    names = {name: np.full(n, "", dtype=object) for name in ("drawing", "item", "layer")}
    delivered, compared = points.delivered.copy(), np.zeros((n, 3), dtype=bool)
    made = np.zeros(n, dtype=bool)
    held, far = np.zeros((n, len(grounds)), dtype=bool), np.full((n, len(grounds)), np.inf)
    untold = np.isnan(points.delivered).all(axis=1)
    tie = np.full(n, near.tie)
    for number, ground in enumerate(grounds):
        absent, places = lies == Lies.ABSENT, points.delivered.copy()
        bearing = _bearing(points.id, ground)
        by_name = untold & absent & np.isfinite(bearing).any(axis=1)
        places[by_name] = bearing[by_name]
        search = untold & absent & ~by_name
        places[search] = _only_vertices(ground, points.surveyed[search], near.search)
        found = ground.footing(places, tie, points.printed)
        apart, named = _apart(ground, places, bearing, points.printed)
        at_name = absent & (named <= near.tie) & ((found.line == NOTHING) | (apart < found.distance))
        on = (found.line != NOTHING) & (found.distance < np.where(absent, np.inf, gap)) & ~at_name
        gap = np.where(on | absent, np.minimum(gap, found.distance), gap)
        lies[on] = np.where(found.at_vertex[on], str(Lies.VERTEX), str(Lies.LINEWORK))
        lies[on & untold] = str(Lies.TAKEN_VERTEX)
        corner[on] = np.where(found.vertex[on] <= near.tie, found.vertex[on], np.inf)
        names["item"][on], names["layer"][on] = ground.item[found.line[on]], ground.layer[found.line[on]]
        held[:, number] = (found.line != NOTHING) | (named <= near.tie) | by_name
        far[:, number] = ground.beyond(places, found.distance)
        lies[at_name], gap[at_name] = str(Lies.NAMED), apart[at_name]
        corner[at_name] = np.where(apart[at_name] <= near.tie, apart[at_name], np.inf)
        lies[by_name] = str(Lies.TAKEN_NAMED)
        on |= at_name | by_name
        delivered[on & untold] = places[on & untold]
        names["drawing"][on] = ground.drawing.path
        drawn = np.flatnonzero(on & ~at_name & ~by_name)
        made[on] = False
        made[drawn] = only_for_points(ground, places[drawn], tie[drawn] + ground.hidden(points.printed), near)
        compared[on] = True
        compared[on, ground.depth_axis] = ground.deep
    absent = lies == Lies.ABSENT
    seen: Flags = np.any(compared, axis=0)
    lies[absent & untold] = str(Lies.UNTOLD)
    cause, drawing = _cause(points, lies, grounds, near.tie)
    return PointTies(
        lies=lies, gap=gap, **names, delivered=delivered, group=repeats(points.surveyed, apart=near.apart),
        corner=corner, unchecked=~seen, cause=cause, near=drawing,
        files=tuple(ground.drawing.path for ground in grounds),
        facades=tuple(ground.drawing.facade for ground in grounds),
        beside=_beside(far, absent, [ground.longest() for ground in grounds]), held=held,
        made=mostly(made, [ground.drawing.path for ground in grounds], names["drawing"]),
    )  # fmt: skip


def _beside(far: Reals, absent: Flags, longest: Sequence[float]) -> Flags:
    """(n, d) the drawing that an absent point is nearest to, if it is not beyond that drawing's own diagonal."""
    nearest = np.argmin(far, axis=1)[:, None] == np.arange(len(longest))
    found: Flags = nearest & (far <= np.array(longest)) & absent[:, None]
    return found


def _bearing(ids: Texts, ground: Ground) -> Coordinates:
    """Places (n, 3) of the drawing that bear the ids of points, in the axes of the file; NaN where none does."""
    places = np.full((len(ids), 3), np.nan)
    for row, name in enumerate(ids):
        if (place := ground.bearing(str(name))) is not None:
            places[row] = place
    return places


def _apart(ground: Ground, places: Coordinates, bearing: Coordinates, printed: Reals) -> tuple[Reals, Reals]:
    """Distances (n,) of places from those that bear their ids, infinite without; and the same less what was rounded."""
    axes = 3 if ground.deep else 2
    step = np.abs(ground.on_sheet(places) - ground.on_sheet(bearing))[:, :axes]
    less = np.maximum(step - ground.rounding(printed)[:axes], 0.0)
    gap, net = np.linalg.norm(step, axis=1), np.linalg.norm(less, axis=1)
    return np.where(np.isfinite(gap), gap, np.inf), np.where(np.isfinite(net), net, np.inf)


def _only_vertices(ground: Ground, surveyed: Coordinates, radius: float) -> Coordinates:
    """Vertices (k, 3) near surveyed places (k, 3), in the axes of the file; NaN where there is none, or several."""
    taken = np.full(surveyed.shape, np.nan)
    if not len(surveyed):
        return taken
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; delivered coordinates need none

    axes = 3 if ground.deep else 2
    corners = np.unique(ground.corners(), axis=0)
    near = cKDTree(corners[:, :axes]).query_ball_point(ground.on_sheet(surveyed)[:, :axes], radius)
    for row, rows in enumerate(near):
        # Ends of several lines at one corner are one vertex.
        if rows and np.ptp(corners[rows][:, :axes], axis=0).max() <= radius * _ONE_VERTEX:
            taken[row] = ground.in_file(corners[rows[:1]])[0]
    return taken


_ONE_VERTEX = 0.01  #: share of the radius of search in which ends of lines are one corner


def _cause(points: Checkpoints, lies: Texts, grounds: Sequence[Ground], tie: float) -> tuple[Cause | None, str]:
    """One cause that explains why most points are absent, and the drawing on which all would lie.

    Corners of a drawing that was moved or stretched along its lines still lie on these. So where most points are absent
    or within a line, and few absent, a cause is one that puts all of them at corners: as exactly as the tolerance asks,
    or if there is none, as the printed digits allow.
    """
    told = np.isfinite(points.delivered).all(axis=1)
    absent, off = told & (lies == Lies.ABSENT), told & np.isin(lies, [Lies.ABSENT, Lies.LINEWORK])
    if 2 * np.count_nonzero(off) <= np.count_nonzero(told):
        return None, ""
    search = _cause_on if 2 * np.count_nonzero(absent) > np.count_nonzero(told) else _beside_corners
    for digits in (0.0, 1.0):
        for ground in grounds:
            reach = tie + digits * ground.hidden(points.printed)
            cause = search(ground, points.delivered[told], _bearing(points.id[told], ground), reach)
            if cause is not None:
                return cause, ground.drawing.path
    return None, ""


def _cause_on(ground: Ground, places: Coordinates, bearing: Coordinates, within: float) -> Cause | None:
    def in_file(moved: Coordinates) -> Flags:
        return on_sheet(ground.on_sheet(moved))

    def on_sheet(moved: Coordinates) -> Flags:
        every = np.full(len(moved), within)
        lies: Flags = footing(moved, ground.every, within=every, deep=ground.deep).line != NOTHING
        return lies | _at(ground, moved, bearing, within)

    return by_axes_or_unit(places, UNIT_FACTORS, in_file) or by_place_or_size(
        ground.on_sheet(places), ground.corners(every=True), within=within, holds=on_sheet
    )


def _beside_corners(ground: Ground, places: Coordinates, bearing: Coordinates, within: float) -> Cause | None:
    sheet, corners, axes = ground.on_sheet(places), ground.corners(), 3 if ground.deep else 2
    if not len(sheet) or not len(corners):
        return None
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load

    tree = cKDTree(corners[:, :axes])

    def at_corners(moved: Coordinates) -> Flags:
        lies: Flags = tree.query(moved[:, :axes])[0] <= within
        return lies | _at(ground, moved, bearing, within)

    if 2 * np.count_nonzero(at_corners(sheet)) > len(sheet):
        return None
    return by_place_or_size(sheet, corners, within=within, holds=at_corners)


def _at(ground: Ground, moved: Coordinates, bearing: Coordinates, within: float) -> Flags:
    """(n,) whether places on the sheet are those that bear the names of the points."""
    step = (moved - ground.on_sheet(bearing))[:, : 3 if ground.deep else 2]
    found: Flags = np.linalg.norm(step, axis=1) <= within  # what nobody bears is no number
    return found
