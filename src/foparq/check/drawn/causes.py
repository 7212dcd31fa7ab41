# SPDX-License-Identifier: MIT
"""What was done to the places of a table that lie beside a drawing as a whole."""

from typing import TYPE_CHECKING

import numpy as np

from foparq.columns import Coordinates, Flags
from foparq.match.causes import UNIT_FACTORS, Cause, by_axes_or_unit, by_place_or_size
from foparq.match.linework import NOTHING, footing

if TYPE_CHECKING:
    from foparq.check.drawn.ground import DrawnGround


def cause_on(ground: "DrawnGround", places: Coordinates, bearing: Coordinates, within: float) -> Cause | None:
    """Cause that puts all places on the linework of a drawing, also on what cannot be seen: in another unit it can."""

    def in_file(moved: Coordinates, _: float) -> Flags:
        return on_sheet(ground.on_sheet(moved))

    def on_sheet(moved: Coordinates) -> Flags:
        every = np.full(len(moved), within)
        lies: Flags = footing(moved, ground.every, within=every, deep=ground.deep).line != NOTHING
        return lies | _at(ground, moved, bearing, within)

    return by_axes_or_unit(places, UNIT_FACTORS, in_file) or by_place_or_size(
        ground.on_sheet(places), ground.corners(every=True), within=within, holds=on_sheet
    )


def beside_corners(ground: "DrawnGround", places: Coordinates, bearing: Coordinates, within: float) -> Cause | None:
    """Cause that puts all places at corners of a drawing, of which most are at none."""
    sheet, corners, axes = ground.on_sheet(places), ground.corners(), ground.axes
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


def _at(ground: "DrawnGround", moved: Coordinates, bearing: Coordinates, within: float) -> Flags:
    """(n,) whether places on the sheet are those that bear the names of the points."""
    step = (moved - ground.on_sheet(bearing))[:, : ground.axes]
    found: Flags = np.linalg.norm(step, axis=1) <= within  # what nobody bears is no number
    return found
