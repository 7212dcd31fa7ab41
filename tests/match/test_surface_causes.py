# SPDX-License-Identifier: MIT
"""Points moved off surfaces whose nearest places are known formulas."""

from collections.abc import Callable

import numpy as np
import pytest

from foparq.columns import Coordinates
from foparq.match.surface_causes import by_fit

#: half axes of a box about the origin with a corner cut off: no mirror image is the box itself
HALF = np.array([0.3, 0.2, 0.5])
CUT = np.ones(3) / np.sqrt(3)
OFF = 0.35


def directions(n: int, seed: int = 5) -> Coordinates:
    random = np.random.default_rng(seed).normal(size=(n, 3))
    made: Coordinates = random / np.linalg.norm(random, axis=1, keepdims=True)
    return made


def onto_ball(radius: float) -> Callable[[Coordinates], tuple[Coordinates, Coordinates]]:
    def feet(points: Coordinates) -> tuple[Coordinates, Coordinates]:
        out = points / np.linalg.norm(points, axis=1, keepdims=True)
        return out * radius, out

    return feet


def planes() -> tuple[Coordinates, Coordinates]:
    """Places and normals of three walls and a slope."""
    normal = np.vstack([np.eye(3), CUT])
    return np.vstack([np.diag(HALF), CUT * OFF]), normal


def onto_walls(points: Coordinates) -> tuple[Coordinates, Coordinates]:
    place, normal = planes()
    apart = np.einsum("kj,nkj->nk", normal, points[:, None] - place)
    nearest = np.argmin(np.abs(apart), axis=1)
    gap = apart[np.arange(len(points)), nearest]
    return points - gap[:, None] * normal[nearest], normal[nearest]


def on_walls(n: int) -> Coordinates:
    return onto_walls(directions(n) * 0.4)[0]


@pytest.mark.parametrize("shift", [(0.02, -0.01, 0.03), (0.5, 0.4, -0.7)])
def test_a_shifted_ball_is_found_where_its_middle_went(shift: tuple[float, ...]) -> None:
    points = directions(20) * 0.25 + shift
    cause = by_fit(points, onto_ball(0.25), middle=np.zeros(3), within=1e-6)
    assert cause is not None
    assert (cause.kind, cause.along) == ("shift", "")
    assert np.allclose(cause.shift, np.negative(shift), atol=2e-6)


@pytest.mark.parametrize("factor", [1.05, 0.9])
def test_the_factor_is_that_of_the_surface_over_the_points(factor: float) -> None:
    points = directions(20) * 0.25
    cause = by_fit(points, onto_ball(0.25 * factor), middle=np.zeros(3), within=1e-6)
    assert cause is not None
    assert cause.kind == "scale"
    assert cause.factor == pytest.approx(factor, abs=1e-5)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_mirrored_points_are_told_with_the_axis(axis: int) -> None:
    flip = np.ones(3)
    flip[axis] = -1.0
    points = on_walls(40) * flip
    cause = by_fit(points, onto_walls, middle=np.zeros(3), within=1e-6)
    assert cause is not None
    assert (cause.kind, cause.along) == ("mirror", "xyz"[axis])


def test_points_that_lie_on_it_need_no_shift() -> None:
    cause = by_fit(on_walls(20), onto_walls, middle=np.zeros(3), within=1e-6)
    assert cause is not None
    assert cause.kind == "shift"
    assert np.abs(cause.shift).max() == 0.0


def test_six_points_can_be_shifted_onto_anything_and_tell_nothing() -> None:
    points = directions(7) * 0.25 + 0.01
    assert by_fit(points, onto_ball(0.25), middle=np.zeros(3), within=1e-6) is not None
    assert by_fit(points[:6], onto_ball(0.25), middle=np.zeros(3), within=1e-6) is None
    assert by_fit(points[:0], onto_ball(0.25), middle=np.zeros(3), within=1e-6) is None


def test_points_of_something_else_have_no_cause() -> None:
    points = np.random.default_rng(9).uniform(-0.3, 0.3, (20, 3))
    assert by_fit(points, onto_ball(0.25), middle=np.zeros(3), within=1e-4) is None
