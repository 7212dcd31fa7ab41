# SPDX-License-Identifier: MIT
"""Curves against their formulas: no chord leaves the curve by more than the sagitta."""

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline
from tests.read.drawn import SAGITTA, new, read_back, skipped

from foparq.read.dxf.curves import Sagitta, TooFineError, axes, cos_sin, flatten_arc, flatten_bulge, to_world
from foparq.read.dxf.spline import flatten_spline, open_uniform

RADII = st.floats(1e-3, 1e3)
SAGITTAS = st.floats(1e-4, 1e-1)


@settings(deadline=None, max_examples=40)
@given(RADII, st.floats(-10, 10), st.floats(1e-3, math.tau), SAGITTAS)
def test_arc_keeps_the_sagitta_and_no_more_chords_than_needed(
    radius: float, start: float, sweep: float, sagitta: float
) -> None:
    points = np.array(flatten_arc((0.0, 0.0, 0.0), radius, start, sweep, Sagitta(sagitta)))
    chords = len(points) - 1
    departure = radius * (1 - math.cos(sweep / chords / 2))
    assert departure <= sagitta * (1 + 1e-6)
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(np.full(chords + 1, radius), rel=1e-12)
    if chords > sweep / (math.pi / 4) + 1:
        assert radius * (1 - math.cos(sweep / (chords - 1) / 2)) > sagitta * (1 - 1e-6)


@settings(deadline=None, max_examples=40)
@given(st.floats(-20, 20).filter(lambda bulge: abs(bulge) > 1e-6), st.floats(0.1, 100), SAGITTAS)
def test_bulge_lies_on_its_circle(bulge: float, chord: float, sagitta: float) -> None:
    points = flatten_bulge((3.0, 4.0, 1.0), (3.0 + chord, 4.0, 1.0), bulge, Sagitta(sagitta))
    radius = chord * (1 + bulge**2) / (4 * abs(bulge))
    centre = (3 + chord / 2, 4 + chord * (1 - bulge**2) / (4 * bulge))
    for x, y, z in points:
        assert math.hypot(x - centre[0], y - centre[1]) == pytest.approx(radius, rel=1e-9)
        assert z == 1.0
        assert (y - 4) * bulge < 0 or abs(y - 4) < 1e-9  # positive: to the right of the chord
    sweep = 4 * math.atan(abs(bulge))
    assert radius * (1 - math.cos(sweep / (len(points) + 1) / 2)) <= sagitta * (1 + 1e-6)


def test_a_closed_polyline_that_ends_where_it_began_has_no_vertex_twice(tmp_path: Path) -> None:
    # A circle of radius 1 from two half turns, closed by the flag and by its last vertex too.
    document = new()
    document.modelspace().add_lwpolyline(
        [(-1, 0, 1), (1, 0, 1), (-1, 0, 0)], format="xyb", close=True, dxfattribs={"layer": "A"}
    )
    (circle,) = read_back(document, tmp_path).items.geometry
    points = shapely.get_coordinates(circle)
    assert circle.is_closed
    assert np.hypot(*np.diff(points, axis=0).T).min() > 0
    assert shapely.Polygon(points).area == pytest.approx(math.pi, rel=1e-3)


@pytest.mark.parametrize("bulge", [0.0, math.nan, math.inf, 5e-324, 1e-300])
def test_bulges_that_bend_nothing(bulge: float) -> None:
    assert flatten_bulge((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), bulge, Sagitta(1e-4)).tolist() == []


def test_curve_too_large_for_its_sagitta_is_refused_before_it_is_built() -> None:
    with pytest.raises(TooFineError):
        flatten_arc((0.0, 0.0, 0.0), 1e12, 0.0, math.tau, Sagitta(1e-6))


def test_quarter_turns_are_exact() -> None:
    assert [cos_sin(angle) for angle in (0.0, 90.0, 180.0, -90.0, 450.0)] == [(1, 0), (0, 1), (-1, 0), (0, -1), (0, 1)]


def departure(spline: BSpline, vertices: np.ndarray) -> float:
    path = shapely.LineString(vertices)
    dense = spline(np.linspace(spline.t[spline.k], spline.t[-spline.k - 1], 5000, endpoint=False))
    flat = shapely.points(dense[:, :2])
    return float(shapely.distance(path, flat).max())


@settings(deadline=None, max_examples=40)
@given(st.integers(1, 5), st.integers(0, 8), st.integers(0, 2**32 - 1), st.booleans(), st.floats(1e-4, 1e-1))
def test_spline_keeps_the_sagitta(degree: int, more: int, seed: int, clamped: bool, sagitta: float) -> None:  # noqa: FBT001
    source = np.random.default_rng(seed)
    n = degree + 1 + more
    control = np.hstack([source.uniform(-10, 10, (n, 2)), np.zeros((n, 1))])
    knots = open_uniform(n, degree) if clamped else np.sort(source.uniform(0, 10, n + degree + 1))
    vertices = flatten_spline(control, knots, degree, None, Sagitta(sagitta))
    assert vertices is not None
    assert departure(BSpline(knots, control, degree), vertices) <= sagitta * (1 + 1e-6)


def test_rational_spline_is_the_circle_it_stands_for() -> None:
    half = math.sqrt(0.5)
    control = np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0], [-1, 1, 0], [-1, 0, 0]], dtype=float)
    knots = np.array([0, 0, 0, 1, 1, 2, 2, 2], dtype=float)
    vertices = flatten_spline(control, knots, 2, np.array([1, half, 1, half, 1]), Sagitta(1e-4))
    assert vertices is not None
    assert np.hypot(vertices[:, 0], vertices[:, 1]) == pytest.approx(np.ones(len(vertices)), abs=1e-12)
    step = np.linalg.norm(np.diff(vertices, axis=0), axis=1).max()
    assert 1 - math.sqrt(1 - step**2 / 4) <= 1e-4


@pytest.mark.parametrize(
    ("knots", "degree", "weights"),
    [
        ([0, 0, 0, 0, 1, 1, 1], 3, None),  # too few
        ([0, 0, 0, 0, 1, 1, 1, 0.5], 3, None),  # decreasing
        ([0, 0, 0, 0, math.nan, 1, 1, 1], 3, None),
        ([0] * 8, 3, None),  # no span
        ([0, 0, 0, 0, 1, 1, 1, 1], 3, [1, 0, 1, 1]),
        ([0, 0, 0, 0, 1, 1, 1, 1], 30, None),
        ([0, 0, 0, 0, 1, 1, 1, 1], 0, None),
    ],
)
def test_numbers_that_are_no_spline(knots: list[float], degree: int, weights: list[float] | None) -> None:
    control = np.array([[0, 0, 0], [1, 1, 0], [2, 0, 0], [3, 1, 0]], dtype=float)
    weighted = None if weights is None else np.array(weights, dtype=float)
    assert flatten_spline(control, np.array(knots, dtype=float), degree, weighted, Sagitta(1e-3)) is None


# --- object coordinates ----------------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=40)
@given(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: math.hypot(*v) > 1e-3))
def test_object_axes_are_a_right_handed_frame(extrusion: tuple[float, float, float]) -> None:
    frame = np.array(axes(extrusion))
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(frame[0], frame[1]), frame[2], atol=1e-12)
    np.testing.assert_allclose(frame[2], np.array(extrusion) / math.hypot(*extrusion), atol=1e-12)


def test_facade_seen_from_the_south_stands_upright() -> None:
    # Normal to the south (0, -1, 0): object x runs east, object y upward.
    assert to_world(np.array([[2.0, 3.0, 5.0]]), (0.0, -1.0, 0.0)).tolist() == [[2.0, -5.0, 3.0]]


def test_mirrored_entities_are_mirrored() -> None:
    assert to_world(np.array([[2.0, 3.0, 5.0]]), (0.0, 0.0, -1.0)).tolist() == [[-2.0, 3.0, -5.0]]


# --- through a file --------------------------------------------------------------------------------------------------


def test_facade_of_polylines_and_arcs_in_a_file(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    south = {"extrusion": (0, -1, 0)}
    space.add_lwpolyline([(0, 0), (4, 0), (4, 3)], close=True, dxfattribs={**south, "elevation": 7})
    space.add_circle((1, 2, 7), 0.5, dxfattribs=south)
    items = read_back(document, tmp_path).items
    polyline, circle = (shapely.get_coordinates(line, include_z=True) for line in items.geometry)
    assert polyline.tolist() == [[0, -7, 0], [4, -7, 0], [4, -7, 3], [0, -7, 0]]
    assert items.closed.tolist() == [True, True]
    np.testing.assert_allclose(np.hypot(circle[:, 0] - 1, circle[:, 2] - 2), 0.5)
    np.testing.assert_allclose(circle[:, 1], -7)


def test_every_curve_keeps_the_sagitta_in_its_own_unit(tmp_path: Path) -> None:
    document = new(insunits=4)  # millimetres: sagitta 0.1
    space = document.modelspace()
    space.add_circle((0, 0), 1000)
    space.add_ellipse((0, 0), (1000, 0), ratio=0.25)
    space.add_arc((0, 0), 1000, 350, 20)
    items = read_back(document, tmp_path).items
    inner = [shapely.distance(shapely.Point(0, 0), geometry) for geometry in items.geometry]
    assert inner[0] >= 1000 - SAGITTA * 1000 * (1 + 1e-9)
    assert inner[2] >= 1000 - SAGITTA * 1000 * (1 + 1e-9)
    dense = np.linspace(0, math.tau, 20_001)
    ellipse = shapely.points(1000 * np.cos(dense), 250 * np.sin(dense))
    assert shapely.distance(items.geometry[1], ellipse).max() <= SAGITTA * 1000
    assert items.closed.tolist() == [True, True, False]
    assert shapely.is_closed(items.geometry).tolist() == [True, True, False]


def test_unknown_unit_flattens_by_the_size_of_each_curve(tmp_path: Path) -> None:
    document = new(insunits=0)
    document.modelspace().add_circle((0, 0), 5e6)
    drawing = read_back(document, tmp_path)
    assert drawing.unit.metres is None
    assert shapely.distance(shapely.Point(0, 0), drawing.items.geometry[0]) >= 5e6 * (1 - 1e-4 * (1 + 1e-9))


def test_spline_of_fit_points_passes_through_them(tmp_path: Path) -> None:
    document = new()
    fit = [(0, 0, 0), (2, 3, 0), (5, 1, 0), (7, 4, 0)]
    document.modelspace().add_spline(fit)
    line = read_back(document, tmp_path).items.geometry[0]
    assert max(shapely.distance(line, shapely.Point(x, y)) for x, y, _ in fit) <= SAGITTA
    assert line.coords[0] == pytest.approx((0, 0), abs=1e-12)


@pytest.mark.parametrize(("points", "expected"), [
    ([(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 0), (1, 1), (0, 0)]),
    ([(0, 0), (1, 0), (0, 0)], [(0, 0), (1, 0), (0, 0)]),  # closed already: the first vertex is not repeated twice
    ([(2, 3)], [(2, 3), (2, 3)]),  # a single vertex has no length
])  # fmt: skip
def test_closed_flag(tmp_path: Path, points: list[tuple[float, float]], expected: list[tuple[float, float]]) -> None:
    document = new()
    document.modelspace().add_lwpolyline(points, close=True)
    items = read_back(document, tmp_path).items
    assert list(items.geometry[0].coords) == expected
    assert items.closed.tolist() == [True]


def test_frame_of_a_spline_fit_polyline_is_not_drawn(tmp_path: Path) -> None:
    document = new("R12")
    polyline = document.modelspace().add_polyline2d([(0, 0), (1, 5), (2, 0)], dxfattribs={"flags": 4})
    polyline.vertices[1].dxf.flags = 16
    assert list(read_back(document, tmp_path).items.geometry[0].coords) == [(0, 0), (2, 0)]


def test_surfaces_and_endless_lines(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 1)])
    space.add_solid([(0, 0), (1, 0), (0, 1), (1, 1)])
    space.add_ray((0, 0), (1, 0))
    space.add_xline((0, 0), (1, 0))
    with space.add_mesh().edit_data() as data:
        data.vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 1)]
        data.faces = [(0, 1, 2)]
    drawing = read_back(document, tmp_path)
    assert drawing.items.role.tolist() == ["surface", "surface"]
    assert shapely.is_valid(drawing.items.geometry).all()  # the corners of a SOLID run in a Z
    assert skipped(drawing) == {
        ("infinite-line", "RAY"): 1,
        ("infinite-line", "XLINE"): 1,
        ("surface", "MESH"): 1,
        ("surface", "3DFACE"): 1,
    }


def test_paper_space_is_counted_only(tmp_path: Path) -> None:
    document = new()
    document.layout("Layout1").add_line((0, 0), (1, 0), dxfattribs={"layer": "FOLHA"})
    drawing = read_back(document, tmp_path)
    assert len(drawing.items) == 0
    assert skipped(drawing)["paper-space-only", "LINE"] == 1
