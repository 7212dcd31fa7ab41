# SPDX-License-Identifier: MIT
"""Whether checkpoints belong to what was delivered with them.

A table may be sound in itself and speak of another building. Delivered coordinates count where a drawing or a mesh has
something to show for them: a vertex, linework or a surface, in the axes that it has.
"""

from collections.abc import Sequence

import numpy as np

from foparq.check.drawn.made import mostly
from foparq.check.tables.ground import Ground, Nearness
from foparq.columns import Coordinates, Flags, Reals, Texts
from foparq.findings.ties import Lies, PointTies
from foparq.match.causes import Cause
from foparq.match.linework import NOTHING
from foparq.match.repeats import repeats
from foparq.model.tables import Checkpoints


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
        places[search] = ground.near(points.surveyed[search], near.search)
        found = ground.footing(places, tie, points.printed)
        apart, named = ground.apart(places, bearing, points.printed)
        at_name = absent & (named <= near.tie) & ((found.line == NOTHING) | (apart < found.distance))
        on = (found.line != NOTHING) & (found.distance < np.where(absent, np.inf, gap)) & ~at_name
        gap = np.where(on | absent, np.minimum(gap, found.distance), gap)
        lies[on] = np.where(found.at_vertex[on], str(Lies.VERTEX), str(ground.on))
        lies[on & untold] = str(ground.taken)
        corner[on] = np.where(found.vertex[on] <= near.tie, found.vertex[on], np.inf)
        names["item"][on], names["layer"][on] = ground.called(found.line[on])
        held[:, number] = (found.line != NOTHING) | (named <= near.tie) | by_name
        far[:, number] = ground.beyond(places, found.distance)
        lies[at_name], gap[at_name] = str(Lies.NAMED), apart[at_name]
        corner[at_name] = np.where(apart[at_name] <= near.tie, apart[at_name], np.inf)
        lies[by_name] = str(Lies.TAKEN_NAMED)
        on |= at_name | by_name
        delivered[on & untold] = places[on & untold]
        names["drawing"][on] = ground.path
        drawn = np.flatnonzero(on & ~at_name & ~by_name)
        made[on] = False
        made[drawn] = ground.made(places[drawn], tie[drawn] + ground.hidden(points.printed), near)
        compared[on] = True
        if ground.flat >= 0:
            compared[on, ground.flat] = False
    absent = lies == Lies.ABSENT
    seen: Flags = np.any(compared, axis=0)
    lies[absent & untold] = str(Lies.UNTOLD)
    cause, drawing = _cause(points, lies, grounds, near.tie)
    return PointTies(
        lies=lies, gap=gap, **names, delivered=delivered, group=repeats(points.surveyed, apart=near.apart),
        corner=corner, unchecked=~seen, cause=cause, near=drawing,
        files=tuple(ground.path for ground in grounds),
        facades=tuple(ground.facade for ground in grounds),
        beside=_beside(far, absent, [ground.longest() for ground in grounds]), held=held,
        made=mostly(made, [ground.path for ground in grounds], names["drawing"]),
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
    corners = bool(2 * np.count_nonzero(absent) <= np.count_nonzero(told))
    for digits in (0.0, 1.0):
        for ground in grounds:
            reach = tie + digits * ground.hidden(points.printed)
            bearing = _bearing(points.id[told], ground)
            cause = ground.cause(points.delivered[told], bearing, reach, corners=corners)
            if cause is not None:
                return cause, ground.path
    return None, ""
