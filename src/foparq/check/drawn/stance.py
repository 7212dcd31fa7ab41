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
    ones shrink to points. The better one is ``xy``, ``xz`` or ``yz``, the one in use any, given by its axes or fitted.
    """
    *shown, used = _shown(columns).tolist()
    best = int(np.argmax(shown))
    return _NAMES[best] if shown[best] >= _WHOLE and used <= shown[best] - _LESS else ""


def _shown(columns: Columns) -> Reals:
    """(4,) share of all lengths that each of the planes and that in use show; ones where nothing has a length."""
    lines = columns.geometry[columns.role != Role.POINT]
    corners, of = shapely.get_coordinates(lines, include_z=True, return_index=True)
    if not np.nan_to_num(corners[:, 2]).any():
        return np.ones(4)
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates may be anything
        sheet = np.diff(np.nan_to_num(corners), axis=0)[of[1:] == of[:-1]]
        length = np.linalg.norm(sheet, axis=1)
        sound = np.isfinite(length) & (length > 0)
        sheet, length = sheet[sound], length[sound]
        if not len(length):
            return np.ones(4)
        # One line across the world must not speak for all others.
        weight = np.minimum(length, _LONG * np.median(length))
        step = sheet @ columns.drawing.plane.frame
        share = [np.linalg.norm(step[:, axes], axis=1) / length for axes in ([0, 1], [0, 2], [1, 2])]
        share.append(np.linalg.norm(sheet[:, :2], axis=1) / length)
    shown: Reals = np.array([np.average(one, weights=weight) for one in share])
    return shown
