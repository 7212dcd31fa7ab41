# SPDX-License-Identifier: MIT
"""Small ellipses, splines with uneven weights, and normals near the pole."""

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from scipy.interpolate import BSpline
from tests.read.drawn import new, read_back

from foparq.read.dxf.curves import Sagitta, axes, flatten_bulge
from foparq.read.dxf.spline import flatten_spline


@pytest.mark.parametrize("length", [0.01, 0.5, 1.0, 30.0])
def test_an_ellipse_of_any_size(tmp_path: Path, length: float) -> None:
    document = new()
    document.modelspace().add_ellipse((3, 4), (0, length), ratio=0.5)
    (ellipse,) = read_back(document, tmp_path).items.geometry
    x, y = (shapely.get_coordinates(ellipse) - (3, 4)).T
    assert (x / (length / 2)) ** 2 + (y / length) ** 2 == pytest.approx(np.ones(len(x)))


@pytest.mark.parametrize(("y", "near"), [(1 / 64 - 1e-6, True), (1 / 64 + 1e-6, False), (-1 / 64 - 1e-6, False)])
def test_the_arbitrary_axis_turns_at_a_sixty_fourth_of_y(y: float, near: bool) -> None:  # noqa: FBT001
    normal = np.array([0.0, y, math.sqrt(1 - y * y)])
    expected = np.cross([0, 1, 0] if near else [0, 0, 1], normal)
    np.testing.assert_allclose(axes(tuple(normal))[0], expected / np.linalg.norm(expected), atol=1e-12)


@pytest.mark.parametrize("degree", [2, 3, 4])
@pytest.mark.parametrize("seed", range(5))
def test_a_spline_with_uneven_weights_keeps_the_sagitta(seed: int, degree: int) -> None:
    rng = np.random.default_rng(seed)
    n, sagitta = degree + 4, 1e-2
    control = np.hstack([rng.uniform(-10, 10, (n, 2)), np.zeros((n, 1))])
    weights = 10.0 ** rng.uniform(-0.5, 0.5, n)
    knots = np.concatenate([np.zeros(degree), np.linspace(0, 1, n - degree + 1), np.ones(degree)])
    vertices = flatten_spline(control, knots, degree, weights, Sagitta(sagitta))
    assert vertices is not None
    homogeneous = BSpline(knots, np.hstack([control[:, :2] * weights[:, None], weights[:, None]]), degree)
    dense = homogeneous(np.linspace(0, 1, 4000, endpoint=False))
    on_curve = shapely.points(dense[:, :2] / dense[:, 2:])
    assert shapely.distance(shapely.LineString(vertices), on_curve).max() <= sagitta * (1 + 1e-6)


@pytest.mark.parametrize("bulge", [-2.0, -1.0, 0.25, 0.5, 1.0, 4.0])
@pytest.mark.parametrize("chord", [0.125, 1.0, 8.0])
def test_an_arc_no_higher_than_the_sagitta_is_its_chord(bulge: float, chord: float) -> None:
    height = abs(bulge) * chord / 2  # of the arc above its chord
    ends = (1.0, 1.0, 5.0), (1.0, 1.0 + chord, 5.0)
    for within in (height, 1.5 * height, 3.9 * height):
        assert len(flatten_bulge(*ends, bulge, Sagitta(within))) == 0
    for beyond in (0.99 * height, height / 2, height / 4):
        points = flatten_bulge(*ends, bulge, Sagitta(beyond))
        assert len(points) > 0
        assert set(points[:, 2]) == {5.0}
