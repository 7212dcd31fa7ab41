# SPDX-License-Identifier: MIT
"""Where two straight segments meet, and the stretch they share. All functions work row by row on k pairs."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Reals
from foparq.geom.polylines import Segments
from foparq.geom.rounding import ROUNDING

#: sine of an angle of 0.06 degrees: below it the crossing of two segments is not well placed
_TRANSVERSAL = 1e-3
#: cosine of 14.5 degrees, the angle of slope one in four: a piece turned further does not run along
ALONG = float(np.sqrt(1 - 1 / 16))


class Contacts(NamedTuple):
    """Where k pairs of segments a and b may meet: five candidate places a pair.

    The candidates are the crossing, the start of a, the end of a, the start of b, the end of b, each with the nearest
    place of the other segment.
    """

    on_a: Reals  #: (5, k) share of the length of a
    on_b: Reals  #: (5, k) share of the length of b
    meets: Flags  #: (5, k) near in the plane and in depth


class Shared(NamedTuple):
    """The stretch that k pairs of segments share."""

    length: Reals  #: (k,) metres, zero if none
    start: Reals  #: (k, 2)
    end: Reals  #: (k, 2)


def cross(a: Reals, b: Reals) -> Reals:
    """Cross product (k,) of plane vectors (k, 2)."""
    product: Reals = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def nearest_share(point: Reals, start: Reals, end: Reals) -> Reals:
    """Place of a segment nearest to a point, as a share of its length.

    Parameters
    ----------
    point, start, end : (k, 2) metres

    Returns
    -------
    (k,) float in 0 ... 1; 0 for a segment without length
    """
    step = end - start
    square = np.einsum("ij,ij->i", step, step)
    share = np.einsum("ij,ij->i", point - start, step) / np.where(square > 0, square, 1.0)
    clipped: Reals = np.clip(share, 0.0, 1.0)
    return clipped


def at_share(share: Reals, start: Reals, end: Reals) -> Reals:
    """Point (k, 2) or depth (k,) at a share of the way from start to end; exact at both ends."""
    share = share[:, None] if start.ndim > 1 else share
    mixed: Reals = start * (1 - share) + end * share
    return mixed


def cannot_meet(a: Segments, b: Segments, *, within: float) -> Flags:
    """True (k,) where all of one segment lies on one side of the other, farther than ``within``.

    A quick rejection: False says nothing.
    """
    apart = np.zeros(len(a.start), dtype=bool)
    for one, two in ((a, b), (b, a)):
        step = one.end - one.start
        far = within * np.hypot(step[:, 0], step[:, 1])
        left, right = cross(step, two.start - one.start), cross(step, two.end - one.start)
        apart |= (np.minimum(left, right) > far) | (np.maximum(left, right) < -far)
    return apart


def contacts(a: Segments, b: Segments, *, within: float) -> Contacts:
    """Candidate places where segments meet.

    Parameters
    ----------
    a, b : Segments, k rows
    within : float, metres
        Places meet if they are not farther apart than this in the plane, and not farther in depth.

    Returns
    -------
    Contacts
        If no candidate meets, the segments are farther apart than ``within``: the least distance of two segments that
        do not cross lies at an end of one of them.
    """
    k = len(a.start)
    on_a, on_b = np.zeros((5, k)), np.zeros((5, k))
    on_a[0], on_b[0] = _crossing(a, b, within)
    on_a[2], on_b[4] = 1.0, 1.0
    on_b[1], on_b[2] = nearest_share(a.start, b.start, b.end), nearest_share(a.end, b.start, b.end)
    on_a[3], on_a[4] = nearest_share(b.start, a.start, a.end), nearest_share(b.end, a.start, a.end)
    meets = np.zeros((5, k), dtype=bool)
    for n in range(5):
        gap = at_share(on_a[n], a.start, a.end) - at_share(on_b[n], b.start, b.end)
        drop = at_share(on_a[n], a.z0, a.z1) - at_share(on_b[n], b.z0, b.z1)
        # An invalid crossing is NaN and meets nothing.
        meets[n] = (np.hypot(gap[:, 0], gap[:, 1]) <= within) & (np.abs(drop) <= within)
    return Contacts(on_a, on_b, meets)


def _crossing(a: Segments, b: Segments, within: float) -> tuple[Reals, Reals]:
    """Shares of both lengths at the crossing; NaN where there is none or it is not well placed."""
    along_a, along_b, between = a.end - a.start, b.end - b.start, b.start - a.start
    product = cross(along_a, along_b)
    long_a, long_b = np.hypot(*along_a.T), np.hypot(*along_b.T)
    # Nearly parallel and never farther apart than `within`: an end of one lies near the other, which says it better.
    placed = (np.abs(product) > _TRANSVERSAL * long_a * long_b) | (
        np.abs(product) > within * np.maximum(long_a, long_b)
    )
    divisor = np.where(placed, product, 1.0)
    on_a, on_b = cross(between, along_b) / divisor, cross(between, along_a) / divisor
    # Rounding does not decide whether segments that touch end to end cross there.
    inside = placed.copy()
    for share, length in ((on_a, long_a), (on_b, long_b)):
        inside &= np.abs(share - 0.5) * length <= 0.5 * length + ROUNDING
    return np.where(inside, np.clip(on_a, 0.0, 1.0), np.nan), np.where(inside, np.clip(on_b, 0.0, 1.0), np.nan)


def shared(a: Segments, b: Segments, *, within: float) -> Shared:
    """Stretch over which two segments run along each other.

    Both are laid on the longer of the two, of equals the first by place; the stretch is their common interval, if they
    are within ``within`` of each other at both ends of it, in the plane and in depth, and their directions differ by
    less than one in four.

    Parameters
    ----------
    a, b : Segments, k rows
    within : float, metres
    """
    long_a, long_b = np.hypot(*(a.end - a.start).T), np.hypot(*(b.end - b.start).T)
    swap = _goes_first(b, a, long_b - long_a)
    base, other = _choose(swap, b, a), _choose(swap, a, b)
    length, short = np.maximum(long_a, long_b), np.minimum(long_a, long_b)
    unit = (base.end - base.start) / np.where(length > 0, length, 1.0)[:, None]
    place = [np.einsum("ij,ij->i", end - base.start, unit) for end in (other.start, other.end)]
    aside = [cross(unit, end - base.start) for end in (other.start, other.end)]
    reach = place[1] - place[0]
    low = np.maximum(np.minimum(*place), 0.0)
    high = np.minimum(np.maximum(*place), length)
    runs = (high > low) & (np.abs(reach) >= ALONG * short)
    for at in (low, high):
        share = np.clip((at - place[0]) / np.where(reach != 0, reach, 1.0), 0.0, 1.0)
        runs &= np.abs(at_share(share, *aside)) <= within
        drop = at_share(share, other.z0, other.z1) - at_share(at / np.where(length > 0, length, 1.0), base.z0, base.z1)
        runs &= np.abs(drop) <= within
    start, end = base.start + unit * low[:, None], base.start + unit * high[:, None]
    return Shared(np.where(runs, high - low, 0.0), start, end)


def _goes_first(one: Segments, two: Segments, longer: Reals) -> Flags:
    """True (k,) where the first segment is longer, or, but for rounding, as long and its middle comes first."""
    # Halved to keep huge numbers finite.
    aside = (one.start / 2 + one.end / 2) - (two.start / 2 + two.end / 2)
    ahead = (aside[:, 0] < -ROUNDING) | ((aside[:, 0] <= ROUNDING) & (aside[:, 1] < 0))
    first: Flags = (longer > ROUNDING) | ((longer >= -ROUNDING) & ahead)
    return first


def _choose(which: Flags, yes: Segments, no: Segments) -> Segments:
    flags = which[:, None]
    return Segments(
        np.where(flags, yes.start, no.start), np.where(flags, yes.end, no.end),
        np.where(which, yes.z0, no.z0), np.where(which, yes.z1, no.z1),
    )  # fmt: skip
