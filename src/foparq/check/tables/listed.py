# SPDX-License-Identifier: MIT
"""Features of the list of a delivery, looked for in what was delivered."""

from foparq.check.drawn.placements import count_listed
from foparq.findings.counts import FeatureCounts
from foparq.model.delivery import Delivery


def listed_in(delivery: Delivery, *, gap: float, near: float) -> FeatureCounts | None:
    """Count and look for features in the drawings of a delivery; if there are none, on its meshes.

    Parameters
    ----------
    gap : float, metres
        Linework of one class nearer than this is one feature.
    near : float, metres
        How far from its place a feature may lie where the list states no tolerance.

    Returns
    -------
    FeatureCounts or None
        As :func:`foparq.check.drawn.placements.count_listed` and
        :func:`foparq.check.surfaces.listed.count_on_surfaces`.
    """
    if delivery.meshes and not delivery.drawings:
        from foparq.check.surfaces.listed import count_on_surfaces  # noqa: PLC0415 - a drawing never loads it

        return count_on_surfaces(delivery.meshes, features=delivery.features, near=near)
    return count_listed(delivery.drawings, features=delivery.features, gap=gap, near=near)
