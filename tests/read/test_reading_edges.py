# SPDX-License-Identifier: MIT
"""Reference systems, letterings and curves at the edges of what is read."""

import math
from pathlib import Path

import numpy as np
import pyproj
import pytest
import shapely
from tests.read.drawn import new, read_back

from foparq.model.drawing import UnitOrigin
from foparq.model.lettering import lettered_length
from foparq.read.dxf.curves import arc_step, axes, count_chords
from foparq.read.gis.crs import unit_of

HERE = (440_000.0, 7_550_000.0, 441_000.0, 7_551_000.0)


# --- reference systems -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bounds", "known"),
    [
        ((-180.0, -90.0, 180.0, 90.0), True), ((-180.1, 0.0, 10.0, 10.0), False), ((0.0, 0.0, 180.1, 10.0), False),
        ((0.0, -90.1, 10.0, 10.0), False), ((0.0, 0.0, 10.0, 90.1), False), ((100.0, 0.0, 120.0, 10.0), True),
        ((math.nan,) * 4, True),
    ],
)  # fmt: skip
def test_degrees_within_the_globe(bounds: tuple[float, float, float, float], known: bool) -> None:  # noqa: FBT001
    unit = unit_of(("EPSG:4326",), bounds, None)
    assert (unit.metres, unit.header) == (None, "degree")
    assert unit.origin is (UnitOrigin.HEADER if known else UnitOrigin.UNKNOWN)


@pytest.mark.parametrize(
    ("system", "x", "y", "metres"),
    [("EPSG:31982", 500_000.0, 7_550_000.0, 1.0), ("EPSG:2225", 6_561_666.667, 1_640_416.667, 1200 / 3937)],
)
def test_a_projection_is_measured_in_its_own_unit(system: str, x: float, y: float, metres: float) -> None:
    unit = unit_of((system,), (x - 50, y - 50, x + 50, y + 50), None)
    assert unit.metres == pytest.approx(metres, rel=1e-9)
    # Both are conformal: PROJ's factors hold on the ellipsoid.
    to_degrees = pyproj.Transformer.from_crs(system, pyproj.CRS(system).geodetic_crs, always_xy=True)
    factors = pyproj.Proj(system).get_factors(*to_degrees.transform(x, y))
    assert unit.stretch == pytest.approx(factors.meridional_scale, abs=1e-7)


def test_the_stretch_is_that_of_the_middle() -> None:
    middle = unit_of(("EPSG:3857",), (0.0, 6e6, 2e6, 10e6), None).stretch
    assert middle == pytest.approx(unit_of(("EPSG:3857",), (1e6, 8e6, 1e6, 8e6), None).stretch, rel=1e-12)
    assert unit_of(("EPSG:3857",), (math.nan,) * 4, None).stretch == 1.0


@pytest.mark.parametrize(("name", "metres"), [("EPSG:31982", 1.0), ("EPSG:31983", 1.0)])
def test_several_systems_have_no_unit_together(name: str, metres: float) -> None:
    assert unit_of((name,), HERE, None).metres == metres
    both = unit_of((name, ""), HERE, None)
    assert (both.metres, both.origin, both.header) == (None, UnitOrigin.UNKNOWN, name)
    assert unit_of((name, ""), HERE, "mm").metres is None
    assert unit_of((), HERE, "mm").metres == 0.001


# --- letterings ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("3'", 0.9144), ('6"', 0.1524), ("3'-6\"", 1.0668), ("3' 6 1/2\"", 1.0795), ('1/2"', 0.0127),
        ("5'-1/4\"", 1.53035), ("2 km", 2000.0), ("3 dm", 0.3), ("4 cm", 0.04), ("5 mm", 0.005), ("6 yd", 5.4864),
        ("1.234,50 m", 1234.5), ("1,234.50 m", 1234.5), ("1.234.567 mm", 1234.567), ("2,500 m", 2.5), ("~2,50 m", 2.5),
        ("2,50 m (typ.)", 2.5), ("2,50 M.", 2.5), ("1 234 mm", 1.234),
    ],
)  # fmt: skip
def test_letterings_with_a_unit(text: str, metres: float) -> None:
    found, number = lettered_length(text)
    assert number is None
    assert found == pytest.approx(metres, abs=1e-9)


@pytest.mark.parametrize(("text", "number"), [("350", 350.0), ("2,5", 2.5), ("1.234.567", 1234567.0), ("0", 0.0)])
def test_letterings_without_a_unit(text: str, number: float) -> None:
    assert lettered_length(text) == (None, number)


@pytest.mark.parametrize(
    "text",
    ["", "x", '3/2"', '2/2"', "1.2.3 m", "1.23.456", "12,34,567", "1.234,5,6", "1,234.5.6", "2 m 3", "-", "5 stone"],
)
def test_letterings_that_state_nothing(text: str) -> None:
    assert lettered_length(text) == (None, None)


def test_a_longer_text_is_a_remark() -> None:
    assert lettered_length("1" * 40) == (None, float("1" * 40))
    assert lettered_length("1" * 41) == (None, None)


# --- curves ----------------------------------------------------------------------------------------------------------


def test_a_spline_of_the_first_degree_is_its_polyline(tmp_path: Path) -> None:
    document = new()
    corners = [(0, 0, 0), (2, 0, 0), (2, 3, 0)]
    document.modelspace().add_open_spline(corners, degree=1)
    document.modelspace().add_open_spline([*corners, (5, 5, 0)], degree=2)
    first, second = read_back(document, tmp_path).items.geometry
    assert shapely.get_coordinates(first).tolist() == [[0, 0], [2, 0], [2, 3]]
    assert shapely.get_num_coordinates(second) > 4


@pytest.mark.parametrize(
    ("sweep", "step", "count"), [(1.0, 0.25, 4), (1.0, 0.3, 4), (-1.0, 0.25, 4), (0.1, 1.0, 1), (0.0, 1.0, 1)]
)
def test_chords_are_as_few_as_the_step_allows(sweep: float, step: float, count: int) -> None:
    assert count_chords(sweep, step) == count


def test_a_circle_smaller_than_the_sagitta_has_eight_chords() -> None:
    assert arc_step(1.0, 1.0) == arc_step(0.5, 1.0) == math.pi / 4
    # 1 - cos(step / 2) = sagitta / radius
    assert arc_step(1.0, 1e-4) == pytest.approx(2 * math.acos(1 - 1e-4), rel=1e-9)


@pytest.mark.parametrize("extrusion", [(0.0, 0.0, 0.0), (math.inf, 0.0, 0.0), (math.nan, 0.0, 1.0)])
def test_without_a_direction_the_axes_are_those_of_the_world(extrusion: tuple[float, float, float]) -> None:
    assert np.array(axes(extrusion)).tolist() == np.eye(3).tolist()


@pytest.mark.parametrize(("x", "near"), [(1 / 64 - 1e-6, True), (1 / 64 + 1e-6, False)])
def test_the_arbitrary_axis_turns_at_a_sixty_fourth(x: float, near: bool) -> None:  # noqa: FBT001
    normal = np.array([x, 0.0, math.sqrt(1 - x * x)])
    expected = np.cross([0, 1, 0] if near else [0, 0, 1], normal)
    np.testing.assert_allclose(axes(tuple(normal))[0], expected / np.linalg.norm(expected), atol=1e-12)


def test_an_ellipse_through_a_turned_plane(tmp_path: Path) -> None:
    document = new()
    normal = np.array([1.0, 2.0, 2.0]) / 3
    major = np.array([2.0, 1.0, -2.0])
    document.modelspace().add_ellipse((1, 2, 3), tuple(major), ratio=0.5, dxfattribs={"extrusion": tuple(normal)})
    (ellipse,) = read_back(document, tmp_path).items.geometry
    points = shapely.get_coordinates(ellipse, include_z=True) - (1, 2, 3)
    np.testing.assert_allclose(points @ normal, 0, atol=1e-9)
    along, across = points @ (major / 3) / 3, points @ np.cross(normal, major / 3) / 1.5
    np.testing.assert_allclose(along**2 + across**2, 1, atol=1e-9)
    # It begins at the end of the major axis and turns towards the minor one.
    assert points[0] == pytest.approx(major)
    assert across[1] > 0
