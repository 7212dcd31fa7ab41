# SPDX-License-Identifier: MIT
"""One cause that explains why points lie beside the surface they belong to.

Source: Y. Chen and G. Medioni, Object modelling by registration of multiple range images, Image and Vision Computing 10
(1992): the points move until they lie in the planes of their nearest places.
"""

from collections.abc import Callable

import numpy as np

from foparq.columns import Coordinates, Index, Reals
from foparq.match.causes import Cause

Feet = Callable[[Coordinates], tuple[Coordinates, Coordinates]]  #: nearest places (n, 3), and normals there

_ASKED = 200  #: points that a transformation is found by; all must obey it then
_STEPS = 60
_SCALES = (0.5, 2.0)  #: a factor beyond is a unit, not a slip
_SPARE = 4  #: points beyond the numbers that are fitted: fewer fit anywhere
_AXES = ("x", "y", "z")
_STILL = 1e-3  #: of what counts as on the surface: a smaller step is none
_SOFT = 1e-9  #: of the number of points: a direction in which nothing holds them is not moved along


def by_fit(points: Coordinates, feet: Feet, *, middle: Reals, within: float) -> Cause | None:
    """Points shifted, mirrored or enlarged as a whole.

    Parameters
    ----------
    points : (n, 3)
    feet : callable
        Nearest places of the surface, and unit normals there.
    middle : (3,)
        Of the surface.
    within : float
        Distance up to which a point lies on the surface.

    Returns
    -------
    Cause or None
        Tried in this order: shift; mirrored along x, y or z, and shifted; enlarged and shifted. ``None`` where none
        puts all points on the surface, or they are too few to tell: seven for a shift, eight for a factor.

    Notes
    -----
    Each is tried from where the points are and from the middle of the surface; sixty steps of least squares at most,
    with two hundred points at most.
    """
    n = len(points)
    about = points.mean(axis=0) if n else np.zeros(3)
    away = middle - about
    flips = [("", np.ones(3)), *((name, np.where(np.arange(3) == k, -1.0, 1.0)) for k, name in enumerate(_AXES))]
    if n >= 3 + _SPARE:
        for along, flip in flips:
            turned = (points - about) * flip + about
            for start in (np.zeros(3), away):
                if (fit := _fitted(turned, about, feet, start, within, scaled=False)) is not None:
                    return Cause("mirror" if along else "shift", along=along, shift=_triple(fit[1]))
    if n >= 4 + _SPARE:
        for start in (np.zeros(3), away):
            if (fit := _fitted(points, about, feet, start, within, scaled=True)) is not None:
                return Cause("scale", factor=fit[0], shift=_triple(fit[1]))
    return None


def _fitted(
    points: Coordinates, about: Reals, feet: Feet, start: Reals, within: float, *, scaled: bool
) -> tuple[float, Reals] | None:
    """Factor and shift (3,) that put all points on the surface."""
    every, factor, shift, held = points - about, 1.0, start.copy(), False
    arms = every[spread(len(every))]

    def apart(arms: Coordinates) -> tuple[Coordinates, Coordinates]:
        moved = about + arms * factor + shift
        foot, normal = feet(moved)
        return foot - moved, normal

    for _ in range(_STEPS):
        gap, normal = apart(arms)
        if not np.isfinite(gap).all() or not _SCALES[0] < factor < _SCALES[1]:
            return None
        held = bool(np.linalg.norm(gap, axis=1).max() <= within)
        step = _step(np.nan_to_num(normal), arms, gap, scaled=scaled)
        if np.abs(step[:3]).max() + abs(step[3]) * np.abs(arms).max() < _STILL * within:
            break
        shift, factor = shift + step[:3], factor + float(step[3])
    held = held and (len(arms) == len(every) or bool(np.linalg.norm(apart(every)[0], axis=1).max() <= within))
    return (factor, shift) if held else None


def spread(n: int) -> Index:
    """Rows of a table of n by which a transformation is found: two hundred at most, evenly over the table."""
    return np.linspace(0, n - 1, min(n, _ASKED)).astype(np.intp)


def _step(normal: Coordinates, arms: Coordinates, gap: Coordinates, *, scaled: bool) -> Reals:
    """(4,) by how much shift and factor bring points into the planes of their nearest places; least squares."""
    columns = np.column_stack([normal, np.einsum("ij,ij->i", normal, arms)])[:, : 4 if scaled else 3]
    size = np.linalg.norm(columns, axis=0)
    size[size == 0.0] = 1.0
    unit = columns / size
    softly = unit.T @ unit + _SOFT * len(gap) * np.eye(unit.shape[1])
    found = np.linalg.solve(softly, unit.T @ np.einsum("ij,ij->i", normal, gap)) / size
    return np.append(found, np.zeros(4 - len(found)))


def _triple(values: Reals) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
