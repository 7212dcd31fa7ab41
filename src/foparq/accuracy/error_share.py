# SPDX-License-Identifier: MIT
"""Which share of the difference at a point shows in distances that end there."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from foparq.columns import Reals


class ErrorShare(NamedTuple):
    """A share estimated by generalised least squares: 1, all of the difference is in the distances; 0, none is."""

    share: float  #: NaN if no distance would show it
    sd: float  #: of the share; infinite likewise
    p: float  #: of scatter about it as great as was found; 1 of a single distance


def point_effects(point: ArrayLike, difference: ArrayLike, others: ArrayLike) -> tuple[Reals, Reals]:
    """What moving a point by a difference does to its distances from others.

    Parameters
    ----------
    point : (3,) float
        Where it was drawn.
    difference : (3,) float
        Delivered minus reference; without it the point would lie at ``point - difference``.
    others : (n, 3) float

    Returns
    -------
    effects : (n,) float
        ``|point - other| - |point - difference - other|``: to first order the projection of the difference on the
        direction of the distance.
    directions : (n, 3) float
        Unit vectors from the others to the point; zero where both are one place.
    """
    step = np.asarray(point, dtype=float) - np.asarray(others, dtype=float)
    long = np.linalg.norm(step, axis=1)
    effects: Reals = long - np.linalg.norm(step - np.asarray(difference, dtype=float), axis=1)
    directions: Reals = step / np.where(long > 0.0, long, 1.0)[:, np.newaxis]
    return effects, directions


def error_share(
    effects: ArrayLike, found: ArrayLike, directions: ArrayLike, *, point_sd: ArrayLike, sd: float
) -> ErrorShare:
    """Share of the difference at a point that its distances show.

    Parameters
    ----------
    effects : (n,) float
        What the whole difference would do to each distance.
    found : (n,) float
        Delivered minus measured distances.
    directions : (n, 3) float
        Unit vectors along the distances.
    point_sd : (3,) float
        Standard deviation of ordinary differences of points, each axis: both ends have such, the common end the same.
    sd : float
        Standard deviation of the measured distances, greater than zero.

    Notes
    -----
    The model is ``found = share * effects + e``, with ``cov(e) = sd^2 I + diag(U S U') + U S U'`` for directions U and
    variances S of points. O(n^3); n distances end at one point.
    """
    from scipy.special import chdtrc  # noqa: PLC0415 - slow to load

    e, f, u = (np.asarray(one, dtype=float) for one in (effects, found, directions))
    common = (u * np.square(np.asarray(point_sd, dtype=float))) @ u.T
    cov = common + np.diag(sd**2 + np.diag(common))
    weighted = np.linalg.solve(cov, np.column_stack([e, f]))
    information = float(e @ weighted[:, 0])
    if not information > 0.0:
        return ErrorShare(np.nan, np.inf, 1.0)
    share = float(e @ weighted[:, 1]) / information
    left = f - share * e
    scatter = float(left @ np.linalg.solve(cov, left))
    p = float(chdtrc(len(e) - 1, scatter)) if len(e) > 1 else 1.0
    return ErrorShare(share, information**-0.5, p)
