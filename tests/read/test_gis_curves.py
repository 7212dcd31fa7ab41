# SPDX-License-Identifier: MIT
"""Arcs in a GeoPackage become chords of the stated sagitta."""

import math
import struct
from pathlib import Path

import numpy as np
import pytest
import shapely
from tests.read.gis_files import put, read, refused, write

from foparq.errors import UnsafeError
from foparq.profile.schema import LimitsSpec
from foparq.read.gis.reader import read_gis

SAGITTA = 1e-4  # metres, as gis_files reads


def points(coordinates: list[tuple[float, ...]]) -> bytes:
    return struct.pack("<I", len(coordinates)) + np.array(coordinates, dtype="<f8").tobytes()


def shape(kind: int, *parts: bytes) -> bytes:
    return struct.pack("<BII", 1, kind, len(parts)) + b"".join(parts)


def simple(kind: int, coordinates: list[tuple[float, ...]]) -> bytes:
    return struct.pack("<BI", 1, kind) + points(coordinates)


def package(folder: Path, *wkb: bytes, kind: str = "GEOMETRY", z: int = 0) -> Path:
    path = write(folder / "a.gpkg", ["POINT (0 0)"] * len(wkb))
    put(path, dict(enumerate(wkb, start=1)), kind=kind, z=z)
    return path


def offset(line: shapely.LineString, centre: tuple[float, float], radius: float) -> tuple[float, float]:
    """Greatest distance of the chords and of the vertices from a circle."""
    xy = shapely.get_coordinates(line) - centre
    middles = (xy[1:] + xy[:-1]) / 2
    return float(np.abs(np.hypot(*middles.T) - radius).max()), float(np.abs(np.hypot(*xy.T) - radius).max())


@pytest.mark.parametrize("radius", [0.05, 2.0, 30.0, 2000.0])
@pytest.mark.parametrize(("start", "end"), [(0.0, 3.0), (3.0, 0.0), (1.0, 6.0), (6.0, 1.0), (0.3, 0.31)])
def test_an_arc(tmp_path: Path, radius: float, start: float, end: float) -> None:
    angles = (start, (start + end) / 2, end)
    delivered = [(500 + radius * math.cos(a), 900 + radius * math.sin(a)) for a in angles]
    (line,) = read(package(tmp_path, simple(8, delivered), kind="CIRCULARSTRING")).items.geometry
    chords, vertices = offset(line, (500, 900), radius)
    assert chords <= SAGITTA * 1.001
    assert vertices < 1e-9
    assert line.length == pytest.approx(radius * abs(end - start), rel=1e-2)
    # The three delivered points are vertices, bit by bit; no chord is wasted.
    xy = [tuple(point) for point in shapely.get_coordinates(line).tolist()]
    assert xy[0] == delivered[0]
    assert xy[-1] == delivered[2]
    assert delivered[1] in xy
    least = abs(end - start) / (2 * math.acos(max(1 - SAGITTA / radius, -1)))
    assert len(xy) <= least + 4


def test_a_whole_circle(tmp_path: Path) -> None:
    (line,) = read(package(tmp_path, simple(8, [(3, 0), (-3, 0), (3, 0)]))).items.geometry
    chords, vertices = offset(line, (0, 0), 3)
    assert chords <= SAGITTA * 1.001
    assert vertices < 1e-12
    assert line.is_ring
    assert shapely.Polygon(line).area == pytest.approx(9 * math.pi, rel=1e-3)


def test_a_flat_arc_is_two_chords(tmp_path: Path) -> None:
    (line,) = read(package(tmp_path, simple(8, [(0, 0), (1, 0), (5, 0)]))).items.geometry
    assert shapely.get_coordinates(line).tolist() == [[0, 0], [1, 0], [5, 0]]


def test_a_string_of_arcs_and_lines(tmp_path: Path) -> None:
    arcs = simple(8, [(0, 0), (1, 1), (2, 0), (3, -1), (4, 0)])
    compound = shape(9, simple(2, [(-5, 0), (0, 0)]), arcs, simple(2, [(4, 0), (9, 0)]))
    items = read(package(tmp_path, compound, shape(11, compound, simple(2, [(0, 0), (1, 1)])), kind="CURVE")).items
    assert items.item.tolist() == ["paredes:1", "paredes:2.1", "paredes:2.2"]
    assert set(items.kind) == {"LineString"}
    line = items.geometry[0]
    assert line.length == pytest.approx(10 + 2 * math.pi, rel=1e-3)
    assert line.is_simple
    assert len(np.unique(shapely.get_coordinates(line), axis=0)) == shapely.get_num_coordinates(line)


def test_a_window_with_an_arched_top_and_a_round_hole(tmp_path: Path) -> None:
    outer = shape(9, simple(2, [(0, 2), (0, 0), (2, 0), (2, 2)]), simple(8, [(2, 2), (1, 3), (0, 2)]))
    hole = simple(8, [(1.5, 1), (0.5, 1), (1.5, 1)])
    window = shape(10, outer, hole)
    items = read(
        package(tmp_path, window, shape(12, window, shape(3, points([(0, 0), (1, 0), (1, 1), (0, 0)]))), kind="SURFACE")
    ).items
    assert items.role.tolist() == ["area"] * 3
    assert items.geometry[0].area == pytest.approx(4 + math.pi / 2 - math.pi / 4, rel=1e-3)
    assert shapely.get_num_interior_rings(items.geometry[0]) == 1
    assert shapely.is_valid(items.geometry).all()


def test_straight_collections_beside_an_arc_keep_their_parts(tmp_path: Path) -> None:
    arc = simple(8, [(0, 0), (1, 1), (2, 0)])
    lines = shape(5, simple(2, [(5, 5), (6, 5)]), simple(2, [(5, 7), (6, 7)]))
    parts = read(package(tmp_path, shape(7, arc, lines, shape(7, lines)))).items.geometry
    drawn = list(shapely.get_parts(shapely.get_parts(shapely.get_parts(parts))))
    straight = sorted(line.wkt for line in drawn if line.length == 1)
    assert straight == sorted(["LINESTRING (5 5, 6 5)", "LINESTRING (5 7, 6 7)"] * 2)
    assert sum(line.length for line in drawn) == pytest.approx(math.pi + 4, rel=1e-3)


def test_heights_run_along_the_arc(tmp_path: Path) -> None:
    measured = [(1.0, 0.0, 10.0, 7.0), (0.0, 1.0, 11.0, 8.0), (-1.0, 0.0, 12.0, 9.0)]
    (line,) = read(package(tmp_path, simple(3008, measured), z=2)).items.geometry
    assert not shapely.has_m(line)
    xyz = shapely.get_coordinates(line, include_z=True)
    angle = np.arctan2(xyz[:, 1], xyz[:, 0])
    np.testing.assert_allclose(xyz[:, 2], 10 + 2 * angle / math.pi, atol=1e-9)


def test_the_sagitta_is_metres_whatever_the_unit(tmp_path: Path) -> None:
    path = package(tmp_path, simple(8, [(3000, 0), (-3000, 0), (3000, 0)]))
    (line,) = read(path, unit="mm").items.geometry
    assert 0.05 < offset(line, (0, 0), 3000)[0] <= 0.1 * 1.001


def test_straight_neighbours_stay_as_they_are(tmp_path: Path) -> None:
    path = package(
        tmp_path, simple(2, [(0, 0), (1, 1)]), simple(8, [(0, 0), (1, 1), (2, 0)]), simple(2, [(5, 5), (6, 6)])
    )
    lines = read(path).items.geometry
    assert shapely.to_wkt(lines[[0, 2]]).tolist() == ["LINESTRING (0 0, 1 1)", "LINESTRING (5 5, 6 6)"]
    assert shapely.get_num_coordinates(lines[1]) > 10


def test_chords_are_counted_before_they_are_made(tmp_path: Path) -> None:
    path = package(tmp_path, simple(8, [(1e9, 0), (-1e9, 0), (1e9, 0)]))
    with pytest.raises(UnsafeError) as caught:
        read_gis(path, limits=LimitsSpec(vertices=1000), sagitta=1e-9, unit=None, layers=())
    assert caught.value.message == "read.too-many-vertices"
    assert refused(path, UnsafeError, vertices=1000).message == "read.too-many-vertices"


@pytest.mark.parametrize(
    "wkb",
    [
        simple(8, [(0, 0), (1, 1)]),
        simple(8, [(0, 0), (1, 1), (2, 0), (3, 1)]),
        simple(8, [(0, 0), (math.nan, 1), (2, 0)]),
        simple(8, [(0, 0), (math.inf, 1), (2, 0)]),
        simple(8, [(0, 0), (0, 0), (0, 0)]),
        simple(8, []),
        shape(9),
        struct.pack("<BII", 1, 8, 4_000_000_000),
        struct.pack("<BII", 1, 11, 4_000_000_000) + simple(8, [(0, 0), (1, 1), (2, 0)]),
        struct.pack("<BII", 1, 9, 1) * 500,
    ],
)
def test_odd_arcs_never_crash(tmp_path: Path, wkb: bytes) -> None:
    items = read(package(tmp_path, wkb, simple(2, [(0, 0), (1, 1)]))).items
    assert items.item[-1] == "paredes:2"


@pytest.mark.parametrize(("more", "columns"), [(0, (0, 1)), (1000, (0, 1, 2)), (2000, (0, 1, 3)), (3000, (0, 1, 2, 3))])
def test_straight_and_bent_pieces_with_depth_measure_or_both(
    tmp_path: Path, more: int, columns: tuple[int, ...]
) -> None:
    def kept(*places: tuple[float, ...]) -> list[tuple[float, ...]]:
        return [tuple(place[column] for column in columns) for place in places]

    straight = simple(2 + more, kept((0, 0, 5, 70), (2, 0, 6, 80)))
    bent = simple(8 + more, kept((2, 0, 6, 80), (3, 1, 7, 81), (4, 0, 8, 82)))
    (line,) = read(package(tmp_path, shape(9 + more, straight, bent), z=2)).items.geometry
    found = shapely.get_coordinates(line, include_z=2 in columns)
    for place in [(0, 0, 5), (2, 0, 6), (3, 1, 7), (4, 0, 8)]:
        assert list(place[: found.shape[1]]) in found.tolist()
    assert found[0].tolist() == [0, 0, 5][: found.shape[1]]
    assert found[-1].tolist() == [4, 0, 8][: found.shape[1]]
    assert line.length == pytest.approx(2 + math.pi, rel=1e-3)
