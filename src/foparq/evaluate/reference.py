# SPDX-License-Identifier: MIT
"""Whether reference and delivered values are written alike: a slip of the pen in a table is no fault of a drawing."""

import numpy as np

from foparq.columns import Coordinates, Flags, Reals
from foparq.evaluate.quality import Reason, because
from foparq.match.causes import UNIT_FACTORS, by_axes_or_unit, by_unit
from foparq.profile.elements import AXES

#: whether axes are exchanged, and whether the unit is another
_SLIPS = {
    (True, False): "evidence.reference-axes", (False, True): "evidence.reference-unit",
    (True, True): "evidence.reference-unit-axes",
}  # fmt: skip
_AXES = 2  #: that a flat drawing has
_NEAR = 0.01  #: share of the extent of the delivered points within which a surveyed one is theirs


def other_coordinates(surveyed: Coordinates, delivered: Coordinates, name: str) -> tuple[Reason, ...]:
    """Whether one other unit, or axes exchanged, of the surveyed coordinates would bring all of them to the delivered.

    Parameters
    ----------
    surveyed, delivered : (n, 3) metres
        As read; NaN where nothing was delivered, as the depth of a flat drawing.
    name : str
        Id of the element, for the reason.
    """
    told = np.isfinite(surveyed).all(axis=1) & (np.isfinite(delivered).sum(axis=1) >= _AXES)
    places, there = surveyed[told], delivered[told]
    seen = np.isfinite(there).all(axis=0)
    if not len(there):
        return ()
    within = _NEAR * float(np.linalg.norm(np.ptp(there[:, seen], axis=0)))

    def near(moved: Coordinates, _: float = 1.0) -> Flags:
        found: Flags = np.linalg.norm((moved - there)[:, seen], axis=1) <= within
        return found

    if (
        2 * np.count_nonzero(near(places)) > len(there)
        or (cause := by_axes_or_unit(places, UNIT_FACTORS, near)) is None
    ):
        return ()
    axes = [f"{AXES[k]} = {AXES[own]}" for k, own in enumerate(cause.axes) if own != k]
    message = _SLIPS[bool(axes), cause.factor != 1.0]
    return (because(message, element=name, n=len(there), axes=axes, factor=f"{cause.factor:.6g}"),)


def other_lengths(measured: Reals, delivered: Reals, name: str) -> tuple[Reason, ...]:
    """Whether another unit of the measured lengths would make all of them the delivered ones.

    Parameters
    ----------
    measured, delivered : (n,) metres
        As read; NaN where nothing was delivered.
    name : str
        Id of the element, for the reason.
    """
    told = np.isfinite(measured) & np.isfinite(delivered)
    factor = by_unit(measured[told], delivered[told], UNIT_FACTORS)
    if factor == 1.0:
        return ()
    return (because("evidence.reference-lengths", element=name, n=int(np.count_nonzero(told)), factor=f"{factor:.6g}"),)
