# SPDX-License-Identifier: MIT
"""Whether a drawing is looked at from where it was meant to be seen."""

import numpy as np
import shapely

from foparq.check.drawn.columns import Columns
from foparq.columns import Reals
from foparq.model.items import Role

_NAMES = ("xy", "xz", "yz")
_WHOLE = 0.9  #: share of all lengths that the plane of a drawing shows
_LONG = 10.0  #: a line counts no more than so many lines of middle length
_LESS = 0.15  #: share that a wrong plane shows less


def better_plane(columns: Columns) -> str:
    """Name of a plane that shows what the drawing is, where the plane in use does not; ``""`` else.

    Lines of an elevation lie in its plane, which shows nine tenths of their length at least; from elsewhere the upright
    ones shrink to points. Asked only of ``xy``, ``xz`` and ``yz``: a plane that was fitted, or given by its axes, was
    chosen on purpose.
    """
    if columns.drawing.plane.name not in {*_NAMES, "assumed"}:
        return ""
    shown = _shown(columns)
    used = _NAMES.index(columns.drawing.plane.name.replace("assumed", "xy"))
    best = int(np.argmax(shown))
    if best != used and shown[best] >= _WHOLE and shown[used] <= shown[best] - _LESS:
        return _NAMES[best]
    return ""


def _shown(columns: Columns) -> Reals:
    """(3,) share of all lengths that each of the planes shows; ones where nothing has a length."""
    lines = columns.geometry[columns.role != Role.POINT]
    corners, of = shapely.get_coordinates(lines, include_z=True, return_index=True)
    if not np.nan_to_num(corners[:, 2]).any():
        return np.ones(3)
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates may be anything
        step = np.diff(np.nan_to_num(corners), axis=0)[of[1:] == of[:-1]] @ columns.drawing.plane.frame
        length = np.linalg.norm(step, axis=1)
        sound = np.isfinite(length) & (length > 0)
        step, length = step[sound], length[sound]
        if not len(length):
            return np.ones(3)
        # One line across the world must not speak for all others.
        weight = np.minimum(length, _LONG * np.median(length))
        share = [np.linalg.norm(step[:, axes], axis=1) / length for axes in ([0, 1], [0, 2], [1, 2])]
    shown: Reals = np.array([np.average(one, weights=weight) for one in share])
    return shown
