# SPDX-License-Identifier: MIT
"""Whether coordinate differences are what a rotation or a change of scale leaves."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from foparq.columns import Coordinates, Flags, Reals


@dataclass(frozen=True, slots=True)
class Part:
    """What rotation or scale explain beyond all else that was fitted."""

    p: float  #: probability of explaining as much, if there is none
    size: float  #: rotation: angle, radians; scale: change, a share of one
    left: Reals  #: (n, k) differences without it


@dataclass(frozen=True, slots=True)
class Similarity:
    """Least squares fit of shift, rotation and scale to differences."""

    rotation: Part | None  #: ``None`` along a line, and in one axis
    scale: Part | None
    freedom: int  #: observations beyond what was fitted


def fit_similarity(places: Coordinates, differences: Coordinates) -> Similarity | None:
    """Shift, rotation and scale that explain differences best, each tested against a fit without it.

    ``d = t + w x (p - c) + m (p - c)`` with c the mean place: differences are small, so rotations are. With S the sum
    of squared residuals, ``F = ((S_without - S) / q) / (S / f)`` for the q parameters of a part and f degrees of
    freedom.

    Parameters
    ----------
    places, differences : (n, k) float
        k axes, 1 to 3, of n points; finite.

    Returns
    -------
    Similarity or None
        ``None`` if the points are too few for all parameters and one degree of freedom, or all in one place.

    Notes
    -----
    Helmert transformation, linear for small angles; F test of nested linear models (Fisher 1925). Assumes normal
    differences of one standard deviation in all axes.
    """
    n, k = places.shape
    if n == 0:
        return None
    centred = places - places.mean(axis=0)
    reach = float(np.abs(centred).max(initial=0.0))
    if not reach > 0.0:
        return None
    unit = centred / reach
    turning = [_rotated(unit, a, b) for a, b in combinations(range(k), 2)]
    design = np.stack([*(np.eye(k)[a][None].repeat(n, 0).ravel() for a in range(k)), *turning, unit.ravel()], axis=1)
    observed = differences.ravel()
    solution, _, rank, _ = np.linalg.lstsq(design, observed, rcond=1e-9)
    freedom = n * k - int(rank)
    if freedom < 1:
        return None
    column = np.arange(design.shape[1])
    turns = (column >= k) & (column < k + len(turning))

    def part(chosen: Flags) -> Part | None:
        extra = int(rank) - int(np.linalg.matrix_rank(design[:, ~chosen], tol=1e-9 * np.sqrt(n * k)))
        if not extra:
            return None
        explained = (design[:, chosen] @ solution[chosen]).reshape(n, k)
        p = _tail(_squares(design[:, ~chosen], observed), _squares(design, observed), extra, freedom)
        size = float(solution[-1] if chosen[-1] else np.linalg.norm(solution[chosen]))
        return Part(p, size / reach, differences - explained)

    return Similarity(part(turns), part(column == column[-1]), freedom)


def _rotated(unit: Coordinates, a: int, b: int) -> Reals:
    """Column of a small rotation from axis a toward axis b."""
    moved = np.zeros_like(unit)
    moved[:, a], moved[:, b] = -unit[:, b], unit[:, a]
    column: Reals = moved.ravel()
    return column


def _squares(design: Reals, observed: Reals) -> float:
    solution = np.linalg.lstsq(design, observed, rcond=1e-9)[0]
    return float(np.sum((observed - design @ solution) ** 2))


def _tail(without: float, whole: float, extra: int, freedom: int) -> float:
    from scipy.special import fdtrc  # noqa: PLC0415 - slow to load; a check of loose files needs none

    gain = max(0.0, without - whole)
    if whole <= 1e-24 * without:
        return 0.0 if gain > 0.0 else 1.0
    return float(fdtrc(extra, freedom, gain / extra / (whole / freedom)))
