# SPDX-License-Identifier: MIT
"""What the extent of the drawings tells of a table: whether its numbers are decimals or thousands."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foparq.columns import Reals
from foparq.geom.extent import boxes_of, main_box
from foparq.model.drawing import Drawing
from foparq.model.items import Role

_THOUSAND = 1000.0
_SPREAD = 0.05  #: of the diagonal: points nearer together do not lie about the drawing
_SHORT = 0.01  #: of the diagonal: no distance beyond is none that was measured for this drawing


@dataclass(frozen=True, slots=True)
class Extent:
    """Box around a drawing, metres, in the axes of its file; an axis may have no width."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    @property
    def diagonal(self) -> float:
        """Length of the longest line in the box, metres."""
        return float(np.linalg.norm(np.subtract(self.high, self.low)))


def extent_of(drawing: Drawing) -> Extent | None:
    """Extent of what is drawn, without strays; ``None`` if nothing is drawn or its unit is unknown."""
    if drawing.unit.metres is None:
        return None
    drawn = drawing.visible_rows() & np.isin(drawing.items.role, [Role.LINE.value, Role.AREA.value, Role.POINT.value])
    boxes = boxes_of(drawing.items.geometry[drawn]) * drawing.unit.metres
    if not len(boxes):
        return None
    low, high = (corner.tolist() for corner in main_box(boxes))
    return Extent((low[0], low[1], low[2]), (high[0], high[1], high[2]))


def points_are_decimal(axes: Sequence[Reals], extents: Sequence[Extent]) -> bool:
    """Whether coordinates belong to the drawings as they are, and not a thousand times larger.

    Parameters
    ----------
    axes : three (n,) metres
        Coordinates in x, y and z, as decimals; each axis may have another n.
    extents : sequence of Extent
        Of the drawings of known unit.

    Returns
    -------
    bool
        True if along some axis in which a drawing has an extent half of them or more lie near it and spread over a
        twentieth of its diagonal, while a thousand times larger none lies near a drawing in any axis. Near is within
        the diagonal.
    """
    there = False
    for extent in extents:
        margin = extent.diagonal
        for values, low, high in zip(axes, extent.low, extent.high, strict=True):
            if not len(values) or high <= low:
                continue
            times = values * _THOUSAND
            if ((times >= low - margin) & (times <= high + margin)).any():
                return False
            near = values[(values >= low - margin) & (values <= high + margin)]
            there = there or (2 * len(near) >= len(values) and bool(np.ptp(near) >= _SPREAD * margin))
    return there


def lengths_are_decimal(lengths: Reals, extents: Sequence[Extent]) -> bool:
    """Whether lengths fit into a drawing as they are, and not a thousand times longer.

    Parameters
    ----------
    lengths : (n,) metres
        As decimals.
    extents : sequence of Extent
        Of the drawings of known unit.

    Returns
    -------
    bool
        True if half of them or more are no longer than the longest diagonal and one of these is a hundredth of it,
        while a thousand times longer all exceed it.
    """
    longest = max((extent.diagonal for extent in extents), default=0.0)
    fitting = lengths[lengths <= longest]
    return bool(
        2 * len(fitting) >= len(lengths)
        and (fitting >= _SHORT * longest).any()
        and (lengths * _THOUSAND > longest).all()
    )
