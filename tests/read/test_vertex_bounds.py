# SPDX-License-Identifier: MIT
"""As many vertices as are allowed, and one more; arcs with heights; enlarged blocks."""

import math
import struct
from pathlib import Path

import numpy as np
import pytest
import shapely
from tests.read.drawn import SAGITTA, new, read_back
from tests.read.gis_files import put, read, write

from foparq.errors import UnsafeError
from foparq.profile.schema import LimitsSpec


def arcs(kind: int, coordinates: list[tuple[float, ...]]) -> bytes:
    return struct.pack("<BII", 1, kind, len(coordinates)) + np.array(coordinates, dtype="<f8").tobytes()


def test_a_drawing_of_exactly_the_most_vertices_is_read(tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_lwpolyline([(0, 0), (1, 0), (1, 1)])
    document.modelspace().add_line((5, 5), (6, 6))
    assert len(read_back(document, tmp_path, limits=LimitsSpec(vertices=5)).items) == 2
    with pytest.raises(UnsafeError) as caught:
        read_back(document, tmp_path, limits=LimitsSpec(vertices=4))
    assert (caught.value.message, caught.value.fields["limit"]) == ("dxf.too-many-vertices", 4)


@pytest.mark.parametrize("scale", [1.0, 3.0, 4.0, 100.0])
def test_a_circle_in_an_enlarged_block_keeps_the_sagitta(tmp_path: Path, scale: float) -> None:
    document = new()
    document.blocks.new("RODA").add_circle((0, 0), 1)
    document.modelspace().add_blockref("RODA", (7, 3), dxfattribs={"xscale": scale, "yscale": scale})
    (circle,) = read_back(document, tmp_path).items.geometry
    radius = np.hypot(*(shapely.get_coordinates(circle) - (7, 3)).T)
    assert radius == pytest.approx(np.full(len(radius), scale), rel=1e-12)
    inner = shapely.distance(shapely.Point(7, 3), circle)
    assert scale - inner <= SAGITTA * (1 + 1e-9)
    # No more than twice as fine as it must be, by the next power of two.
    least = math.pi / math.acos(1 - SAGITTA / scale)
    assert shapely.get_num_coordinates(circle) - 1 <= max(8, 1.5 * least)


def test_a_block_turned_about_an_axis_of_its_own(tmp_path: Path) -> None:
    document = new()
    block = document.blocks.new("JANELA", base_point=(1, 1))
    block.add_line((1, 1), (2, 1))
    document.modelspace().add_blockref("JANELA", (10, 20), dxfattribs={"xscale": 2, "yscale": 3, "rotation": 90})
    (line,) = read_back(document, tmp_path).items.geometry
    assert shapely.get_coordinates(line) == pytest.approx(np.array([[10, 20], [10, 22]]), abs=1e-12)


def test_a_circle_with_heights_is_whole(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    put(path, {1: arcs(1008, [(3, 0, 5), (-3, 0, 7), (3, 0, 5)])}, kind="GEOMETRY", z=2)
    (line,) = read(path).items.geometry
    assert line.is_ring
    assert shapely.Polygon(line).area == pytest.approx(9 * math.pi, rel=1e-3)
    xyz = shapely.get_coordinates(line, include_z=True)
    np.testing.assert_allclose(xyz[:, 2], 5 + 2 * np.abs(np.arctan2(xyz[:, 1], xyz[:, 0])) / math.pi, atol=1e-9)


@pytest.mark.parametrize("direction", [1, -1])
def test_arcs_turn_the_way_of_their_three_points(tmp_path: Path, direction: int) -> None:
    quarter = [(2.0, 0.0), (math.sqrt(2), direction * math.sqrt(2)), (0.0, direction * 2.0)]
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    put(path, {1: arcs(8, quarter)}, kind="GEOMETRY")
    (line,) = read(path).items.geometry
    xy = shapely.get_coordinates(line)
    assert (xy[:, 1] * direction >= -1e-12).all()
    assert line.length == pytest.approx(math.pi, rel=1e-4)
    assert np.all(np.diff(np.arctan2(xy[:, 1], xy[:, 0])) * direction > 0)


@pytest.mark.parametrize("size", [8, 48, 64])
def test_an_envelope_of_any_kind_is_passed_over(tmp_path: Path, size: int) -> None:
    """GeoPackage 2.1.3.1: no envelope, or 32, 48, 48 or 64 bytes of it, told by three bits of the flags."""
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    put(path, {1: arcs(8, [(2, 0), (0, 2), (-2, 0)])}, kind="GEOMETRY")
    import sqlite3

    with sqlite3.connect(path) as connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f'DROP TRIGGER "{name}"')
        ((blob,),) = connection.execute("SELECT geom FROM paredes").fetchall()
        bare = blob[8 + (0, 32, 48, 48, 64)[blob[3] >> 1 & 7] :]
        kind = {8: 0, 48: 2, 64: 4}[size]
        bounds = np.array([-2, 2, 0, 2, 0, 0, 0, 0][: {0: 0, 2: 6, 4: 8}[kind]], dtype="<f8").tobytes()
        made = blob[:3] + bytes([blob[3] & 0b11110001 | kind << 1]) + blob[4:8] + bounds + bare
        connection.execute("UPDATE paredes SET geom = ?", (made,))
    connection.close()
    (line,) = read(path).items.geometry
    assert line.length == pytest.approx(2 * math.pi, rel=1e-3)
