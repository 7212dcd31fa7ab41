# SPDX-License-Identifier: MIT
"""Whether the tables of a delivery belong to its drawings and meshes."""

import numpy as np

from foparq.check.drawn.alike import alike_facades
from foparq.check.drawn.ground import ground_of
from foparq.check.surfaces.alike import alike_meshes
from foparq.check.tables.distances import tie_distances
from foparq.check.tables.ground import Ground, Nearness
from foparq.check.tables.points import tie_points
from foparq.findings.ties import Beside, Ties
from foparq.match.linework import NOTHING
from foparq.model.delivery import Delivery


def tie_evidence(delivery: Delivery, near: Nearness) -> Ties:
    """Hold the tables of a delivery against its drawings; if there are none, against its meshes.

    Parameters
    ----------
    near : Nearness
        Of the profile.

    Returns
    -------
    Ties
        Without drawings and meshes of a known unit nothing is tied.
    """
    drawn = [ground for drawing in delivery.drawings if (ground := ground_of(drawing, near)) is not None]
    grounds: list[Ground] = [*drawn] if delivery.drawings else _surfaces(delivery)
    same = (*alike_facades(drawn, within=near.tie), *alike_meshes(delivery.meshes))
    if not grounds:
        return Ties(alike=same)
    points, distances = None, None
    if delivery.checkpoints is not None and len(delivery.checkpoints.id):
        points = tie_points(delivery.checkpoints, grounds, near)
    if delivery.distances is not None and len(delivery.distances.id):
        distances = tie_distances(
            delivery.distances, delivery.checkpoints, points, grounds, tie=near.tie, visible=near.visible
        )
    return Ties(points=points, distances=distances, alike=same, beside=_beside(delivery, near), drawings=len(grounds))


def _beside(delivery: Delivery, near: Nearness) -> tuple[Beside, ...]:
    """How near surveyed places lie to meshes beside drawings, of which the delivered coordinates speak."""
    points = delivery.checkpoints
    if points is None or not len(points.id) or not delivery.drawings:
        return ()
    told = []
    for ground in _surfaces(delivery):
        foot = ground.footing(points.surveyed, np.full(len(points.id), near.search))
        rows = np.flatnonzero(foot.line != NOTHING)
        rows = rows[np.lexsort((rows, -foot.distance[rows]))]
        ids, distance = points.id[rows].tolist(), foot.distance[rows].tolist()
        told.append(Beside(ground.path, ground.facade, tuple(map(str, ids)), tuple(distance)))
    return tuple(told)


def _surfaces(delivery: Delivery) -> list[Ground]:
    if not delivery.meshes or (delivery.checkpoints is None and delivery.distances is None):
        return []
    from foparq.check.surfaces.ground import surface_ground_of  # noqa: PLC0415 - a drawing never loads it

    return [ground for mesh in delivery.meshes if (ground := surface_ground_of(mesh)) is not None]


def prepare(delivery: Delivery) -> None:
    """Make ready, once in this process and outside of any bounds, what meshes need: compiled code."""
    tables = (delivery.checkpoints, delivery.distances, delivery.features)
    if delivery.meshes and (delivery.references or any(table is not None for table in tables)):
        from foparq.mesh.warm import warm_nearest, warm_winding  # noqa: PLC0415 - a drawing never loads it

        warm_nearest()
        if delivery.references:
            warm_winding()
