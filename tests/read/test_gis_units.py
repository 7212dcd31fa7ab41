# SPDX-License-Identifier: MIT
"""What one drawing unit is, told from a reference system."""

import math
import sqlite3
from pathlib import Path

import pyproj
import pytest
from tests.read.gis_files import WHERE, read, write

from foparq.model.drawing import UnitOrigin


@pytest.mark.parametrize(
    ("crs", "metres", "name"),
    [("EPSG:31982", 1.0, "m"), ("EPSG:2225", 1200 / 3937, "US survey foot"), ("EPSG:2770", 1.0, "m")],
)
def test_the_reference_system_says_the_unit(tmp_path: Path, crs: str, metres: float, name: str) -> None:
    unit = read(write(tmp_path / "a.gpkg", [f"POINT ({WHERE[0]} {WHERE[1]})"], crs=crs)).unit
    assert unit.metres == pytest.approx(metres, rel=1e-12)
    assert (unit.name, unit.origin, unit.header) == (name, UnitOrigin.HEADER, crs)
    assert unit.header_metres == unit.metres


def test_the_stretch_of_a_utm_zone_on_its_central_meridian(tmp_path: Path) -> None:
    unit = read(write(tmp_path / "a.gpkg", [f"POINT ({WHERE[0]} {WHERE[1]})"])).unit
    assert unit.stretch == pytest.approx(0.9996, abs=1e-7)


@pytest.mark.parametrize("latitude", [0.0, -22.12, 50.1, 75.0])
def test_the_stretch_of_web_mercator(tmp_path: Path, latitude: float) -> None:
    # Scale factors of the spherical formula on the ellipsoid, Snyder 1987, Map Projections, p. 44: the geometric mean
    # of a cos-1(phi) (1 - e2 sin2 phi)^(3/2) / (1 - e2) along the meridian and cos-1(phi) (1 - e2 sin2 phi)^(1/2).
    y = pyproj.Transformer.from_crs(4326, 3857, always_xy=True).transform(14.4, latitude)[1]
    unit = read(write(tmp_path / "a.gpkg", [f"POINT (1603000 {y})"], crs="EPSG:3857")).unit
    phi, e2 = math.radians(latitude), 0.0066943799901413165
    bent = 1 - e2 * math.sin(phi) ** 2
    expected = math.sqrt(bent**1.5 / (1 - e2) * bent**0.5) / math.cos(phi)
    assert unit.stretch == pytest.approx(expected, rel=1e-6)


def test_degrees_are_no_length(tmp_path: Path) -> None:
    unit = read(write(tmp_path / "a.gpkg", ["POINT (-51.4 -22.1)"], crs="EPSG:4326")).unit
    assert (unit.metres, unit.name, unit.origin, unit.header, unit.stretch) == (
        None,
        "degree",
        UnitOrigin.HEADER,
        "degree",
        1.0,
    )


def test_degrees_are_a_witness_against_a_stated_length(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["LINESTRING (-46.6 -23.5, -46.5 -23.4)"], crs="EPSG:4674")
    unit = read(path, unit="m").unit
    # A degree of latitude has 110.6 km at the equator and 111.7 km at a pole.
    assert unit.metres == 1.0
    assert unit.header == "degree"
    assert unit.header_metres is not None
    assert 110_500 < unit.header_metres < 111_700


def test_degrees_beyond_the_globe_are_not_believed(tmp_path: Path) -> None:
    unit = read(write(tmp_path / "a.gpkg", ["POINT (1389 -3880)"], crs="EPSG:4326")).unit
    assert (unit.metres, unit.origin, unit.header) == (None, UnitOrigin.UNKNOWN, "degree")


@pytest.mark.parametrize("srs", [-1, 0, 99999])
def test_an_undefined_system_says_nothing(tmp_path: Path, srs: int) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    with sqlite3.connect(path) as connection:
        if srs == 99999:
            connection.execute(
                "INSERT INTO gpkg_spatial_ref_sys"
                " (srs_name, srs_id, organization, organization_coordsys_id, definition)"
                " VALUES ('x', 99999, 'NONE', 99999, 'undefined')"
            )
        connection.execute("UPDATE gpkg_geometry_columns SET srs_id = ?", (srs,))
        connection.execute("UPDATE gpkg_contents SET srs_id = ?", (srs,))
    connection.close()
    unit = read(path).unit
    assert (unit.metres, unit.name, unit.origin, unit.header) == (None, "", UnitOrigin.UNKNOWN, "")


def test_a_stated_unit_wins_and_the_header_is_kept(tmp_path: Path) -> None:
    unit = read(write(tmp_path / "a.gpkg", ["POINT (0 0)"], crs="EPSG:3857"), unit="mm").unit
    assert (unit.metres, unit.name, unit.origin, unit.header, unit.header_metres) == (
        0.001,
        "mm",
        UnitOrigin.STATED,
        "EPSG:3857",
        1.0,
    )


def test_layers_in_two_systems_have_no_common_unit(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"], layer="um", crs="EPSG:31982")
    write(path, ["POINT (0 0)"], layer="dois", crs="EPSG:31983", append=True)
    drawing = read(path)
    assert (drawing.unit.metres, drawing.unit.origin) == (None, UnitOrigin.UNKNOWN)
    assert drawing.unit.header == drawing.reading.crs == "EPSG:31983, EPSG:31982"
    assert read(path, layers=("um",)).unit.metres == 1.0
