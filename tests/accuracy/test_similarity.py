# SPDX-License-Identifier: MIT
"""Fits of shift, rotation and scale against motions that were made, and F tests against their own distribution."""

import numpy as np
import pytest
import scipy.stats
from scipy.spatial.transform import Rotation

from foparq.accuracy.similarity import Part, fit_similarity

FACADE = np.array([[0, 0, 0], [14, 0, 0], [14, 0, 7], [0, 0, 7], [3, 0.4, 2], [9, 0.2, 5], [6, 0.1, 1], [11, 0.5, 6]])


def parts(places: np.ndarray, differences: np.ndarray) -> tuple[Part, Part]:
    found = fit_similarity(places, differences)
    assert found is not None
    assert found.rotation is not None
    assert found.scale is not None
    return found.rotation, found.scale


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_rotation_is_found_with_its_angle(axis: int) -> None:
    turn = Rotation.from_rotvec(np.eye(3)[axis] * 1e-4)
    noise = np.random.default_rng(1).normal(0, 1e-5, FACADE.shape)
    rotation, scale = parts(FACADE, turn.apply(FACADE) - FACADE + noise)
    assert rotation.size == pytest.approx(1e-4, rel=0.1)
    assert rotation.p < 1e-6
    assert scale.p > 1e-3
    assert np.abs(rotation.left - rotation.left.mean(axis=0)).max() < 5e-5


def test_a_scale_is_found_with_its_factor() -> None:
    noise = np.random.default_rng(2).normal(0, 1e-4, FACADE.shape)
    rotation, scale = parts(FACADE, 0.002 * FACADE + noise)
    assert scale.size == pytest.approx(0.002, rel=0.05)
    assert scale.p < 1e-6
    assert rotation.p > 1e-3


def test_significance_is_what_it_says() -> None:
    random = np.random.default_rng(3)
    p = []
    for _ in range(800):
        rotation, scale = parts(FACADE, random.normal(0, 0.003, FACADE.shape))
        p.append((rotation.p, scale.p))
    for part in np.transpose(p):
        assert scipy.stats.kstest(part, "uniform").pvalue > 1e-3


def test_a_shift_is_neither() -> None:
    rotation, scale = parts(FACADE, np.random.default_rng(4).normal((0.03, 0.0, -0.02), 0.002, FACADE.shape))
    assert min(rotation.p, scale.p) > 0.01


def test_points_of_a_flat_drawing() -> None:
    flat = FACADE[:, [0, 2]]
    turned = flat @ np.array([[1, 1e-3], [-1e-3, 1]])
    rotation, _ = parts(flat, turned - flat + np.random.default_rng(5).normal(0, 1e-4, flat.shape))
    assert rotation.size == pytest.approx(1e-3, rel=0.05)


@pytest.mark.parametrize("places", [np.zeros((5, 3)), np.array([[0.0, 0, 0], [1, 0, 0]]), np.empty((0, 3))])
def test_too_few_points_say_nothing(places: np.ndarray) -> None:
    assert fit_similarity(places, np.ones(places.shape)) is None


def test_points_on_a_line_turn_about_two_axes_only() -> None:
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [5, 0, 0]])
    found = fit_similarity(line, np.random.default_rng(6).normal(size=line.shape))
    assert found is not None
    assert found.freedom == 12 - 3 - 2 - 1
