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
_TURNED = 0.25  #: and less than the plane that fits, where no named one shows the drawing as well
_CLOSE = 0.05  #: share by which a named plane may show less than the fitted one


def better_plane(columns: Columns) -> str:
    """Name of a plane that shows what the drawing is, where the plane in use does not; ``""`` else.

    Lines of an elevation lie in its plane, which shows nine tenths of their length at least; from elsewhere the upright
    ones shrink to points. The better one is ``xy``, ``xz`` or ``yz``, else ``fit``; the one in use may be any.
    """
    *shown, fitted, used = _shown(columns).tolist()
    best = int(np.argmax(shown))
    if fitted >= _WHOLE and fitted > shown[best] + _CLOSE and used <= fitted - _TURNED:
        return "fit"
    return _NAMES[best] if shown[best] >= _WHOLE and used <= shown[best] - _LESS else ""


def _shown(columns: Columns) -> Reals:
    """(5,) share of all lengths that the named planes, the fitted one and that in use show; ones without lengths."""
    lines = columns.geometry[columns.role != Role.POINT]
    corners, of = shapely.get_coordinates(lines, include_z=True, return_index=True)
    if not np.nan_to_num(corners[:, 2]).any():
        return np.ones(5)
    with np.errstate(over="ignore", invalid="ignore"):  # coordinates may be anything
        sheet = np.diff(np.nan_to_num(corners), axis=0)[of[1:] == of[:-1]]
        length = np.linalg.norm(sheet, axis=1)
        sound = np.isfinite(length) & (length > 0)
        sheet, length = sheet[sound], length[sound]
        if not len(length):
            return np.ones(5)
        # One line across the world must not speak for all others.
        weight = np.minimum(length, _LONG * np.median(length))
        step = sheet @ columns.drawing.plane.frame
        share = [np.linalg.norm(step[:, axes], axis=1) / length for axes in ([0, 1], [0, 2], [1, 2])]
        course = step / length[:, None]
        _, axes = np.linalg.eigh((course * weight[:, None]).T @ course)
        share += [np.linalg.norm(course @ axes[:, 1:], axis=1), np.linalg.norm(sheet[:, :2], axis=1) / length]
    shown: Reals = np.array([np.average(one, weights=weight) for one in share])
    return shown
