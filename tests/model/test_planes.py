# SPDX-License-Identifier: MIT
"""The plane of a drawing: axes, depth, and what is fitted to leaning and lying linework."""

import math

import numpy as np
import pytest
import shapely

from foparq.errors import ManifestError
from foparq.model.plane import Plane, plane_of

RNG = np.random.default_rng(11)


def lines(points: np.ndarray) -> np.ndarray:
    return np.array([shapely.LineString(points)], dtype=object)


def on_plane(right: np.ndarray, up: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Linework of a plane through a place: a wide and high zigzag."""
    spots = RNG.uniform(-1, 1, (40, 2)) * [9, 4]
    return lines(at + spots @ np.stack([right, up]))


@pytest.mark.parametrize(
    ("name", "sheet"), [("xy", (1.0, 2.0, 4.0)), ("xz", (1.0, 4.0, -2.0)), ("yz", (2.0, 4.0, 1.0))]
)
def test_named_planes(name: str, sheet: tuple[float, float, float]) -> None:
    """Right and up on the sheet, and depth towards the reader: a right-handed frame."""
    corner = np.array([[0.0, 0.0, 0.0], [9.0, 9.0, 9.0]])
    plane = plane_of(name, lines(corner))
    assert plane.name == name
    assert plane.project(np.array([[1.0, 2.0, 4.0]]), 1.0)[0].tolist() == list(sheet)
    assert plane.project(np.array([[1.0, 2.0, 4.0]]), 0.5)[0].tolist() == [value / 2 for value in sheet]


def test_without_a_statement_xy_is_assumed() -> None:
    plane = plane_of(None, lines(np.array([[0.0, 0, 0], [1, 1, 1]])))
    assert (plane.name, plane.right, plane.up) == ("assumed", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


@pytest.mark.parametrize("name", ["xy", "xz", "yz"])
def test_the_origin_is_the_whole_lower_corner_and_depth_is_told_from_zero(name: str) -> None:
    far = np.array([[440_001.5, 7_400_002.5, 3.5], [440_011.0, 7_400_012.0, 13.0]])
    plane = plane_of(name, lines(far))
    placed = plane.project(far, 1.0)
    for axis, column in ((0, "xy".index(name[0]) if name[0] != "z" else 2), (1, "xyz".index(name[1]))):
        assert placed[:, axis] == pytest.approx(far[:, column] - math.floor(far[0, column]))
    depth = {"xy": far[:, 2], "xz": -far[:, 1], "yz": far[:, 0]}[name]
    assert placed[:, 2] == pytest.approx(depth)


def test_nothing_drawn_starts_at_zero() -> None:
    assert plane_of("xz", np.empty(0, dtype=object)).origin == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("metres", [1.0, 0.001])
def test_lifting_undoes_projecting(metres: float) -> None:
    points = RNG.uniform(-5, 5, (20, 3))
    plane = Plane("given", (1.0, -2.0, 3.0), (0.0, 0.6, 0.8), (0.0, -0.8, 0.6))
    assert plane.lift(plane.project(points, metres), metres) == pytest.approx(points, abs=1e-12)
    np.testing.assert_allclose(plane.frame @ plane.frame.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(plane.frame) == pytest.approx(1.0)


# --- fitted ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [0, 20, 70, 110, 200, 290])
def test_a_fitted_facade_keeps_right_level_and_up_upward(angle: float) -> None:
    along = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle)), 0.0])
    plane = plane_of("fit", on_plane(along, np.array([0.0, 0.0, 1.0]), np.array([40.0, 70.0, 5.0])))
    right, up = np.array(plane.right), np.array(plane.up)
    assert plane.name == "fit"
    assert abs(right @ along) == pytest.approx(1.0)
    assert right[np.argmax(np.abs(right))] > 0
    assert up == pytest.approx([0, 0, 1], abs=1e-9)


@pytest.mark.parametrize("lean", [15, 45, 75])
def test_a_leaning_plane_has_its_up_along_the_slope(lean: float) -> None:
    slope = np.array([0.0, math.sin(math.radians(lean)), math.cos(math.radians(lean))])
    geometry = on_plane(np.array([1.0, 0.0, 0.0]), slope, np.zeros(3))
    plane = plane_of("fit", geometry)
    assert plane.right == pytest.approx((1, 0, 0), abs=1e-9)
    assert np.array(plane.up) == pytest.approx(slope, abs=1e-9)
    points = shapely.get_coordinates(geometry, include_z=True)
    assert plane.project(points, 1.0)[:, 2] == pytest.approx(np.zeros(len(points)), abs=1e-9)


@pytest.mark.parametrize("tilt", [-8, 0, 8])
def test_a_lying_drawing_keeps_its_own_x(tilt: float) -> None:
    lean = math.radians(tilt)
    right = np.array([math.cos(lean), 0.0, math.sin(lean)])
    plane = plane_of("fit", on_plane(right, np.array([0.0, 1.0, 0.0]), np.array([3.0, 4.0, 9.0])))
    assert np.array(plane.right) == pytest.approx(right, abs=1e-9)
    assert np.array(plane.up) == pytest.approx([0, 1, 0], abs=1e-9)


@pytest.mark.parametrize("points", [[[0, 0, 0], [1, 1, 1]], [[0, 0, 0], [1, 2, 3], [2, 4, 6]], [[5, 5, 5]] * 4])
def test_what_spans_no_plane_has_no_fit(points: list[list[float]]) -> None:
    with pytest.raises(ManifestError, match=r"manifest\.plane-fit"):
        plane_of("fit", lines(np.array(points, dtype=float)))


# --- given -----------------------------------------------------------------------------------------------------------


def test_given_axes_are_made_upright_and_of_length_one() -> None:
    plane = plane_of(((1.0, 2.0, 3.0), (2.0, 0.0, 0.0), (5.0, 0.0, 3.0)), np.empty(0, dtype=object))
    assert (plane.name, plane.origin) == ("given", (1.0, 2.0, 3.0))
    assert (plane.right, plane.up) == ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))


@pytest.mark.parametrize(
    ("first", "second"),
    [((0, 0, 0), (0, 0, 1)), ((1, 0, 0), (2, 0, 0)), ((1, 0, 0), (0, 0, 0)), ((1, 0, 0), (0, math.inf, 0))],
)
def test_axes_that_span_nothing_are_refused(first: tuple[float, ...], second: tuple[float, ...]) -> None:
    with pytest.raises(ManifestError, match=r"manifest\.plane"):
        plane_of(((0.0, 0.0, 0.0), first, second), np.empty(0, dtype=object))


def test_another_name_is_no_plane() -> None:
    with pytest.raises(ManifestError, match=r"manifest\.plane"):
        plane_of("zx", np.empty(0, dtype=object))
