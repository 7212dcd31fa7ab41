# SPDX-License-Identifier: MIT
"""Arcs within other geometries of a GeoPackage keep the sagitta; GDAL's own chords of four degrees would not."""

import math
import struct
from pathlib import Path

import numpy as np
import pytest
import shapely
from tests.read.drawn import new, read_back
from tests.read.gis_files import put, read, write

SAGITTA = 1e-4
RADIUS = 2.0


def points(kind: int, coordinates: list[tuple[float, float]], order: str = "<") -> bytes:
    packed = np.array(coordinates, dtype=f"{order}f8").tobytes()
    return struct.pack(f"{order}BII", order == "<", kind, len(coordinates)) + packed


def parts(kind: int, *inner: bytes, order: str = "<") -> bytes:
    return struct.pack(f"{order}BII", order == "<", kind, len(inner)) + b"".join(inner)


def half(order: str = "<") -> bytes:
    return points(8, [(RADIUS, 0), (0, RADIUS), (-RADIUS, 0)], order)


BASE = points(2, [(-RADIUS, 0), (RADIUS, 0)])
KINDS = {
    "arcs": half(), "arcs, other bytes": half(">"), "compound": parts(9, half(), BASE),
    "compound, other bytes": parts(9, half(">"), points(2, [(-RADIUS, 0), (RADIUS, 0)], ">"), order=">"),
    "surface": parts(10, parts(9, half(), BASE)), "curves": parts(11, half(), BASE),
    "surfaces": parts(12, parts(10, parts(9, half(), BASE))), "collection": parts(7, half()),
    "collection in a collection": parts(7, parts(7, half())),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_arcs_keep_the_sagitta_wherever_they_stand(tmp_path: Path, kind: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    put(path, {1: KINDS[kind]}, kind="GEOMETRY")
    items = read(path).items
    xy = np.concatenate([shapely.get_coordinates(part) for part in items.geometry])
    bent = xy[xy[:, 1] > 1e-9]
    assert np.hypot(*bent.T) == pytest.approx(np.full(len(bent), RADIUS), abs=1e-9)
    # Chords stay within the sagitta, and no more of them than that asks for.
    least = math.pi / (2 * math.acos(1 - SAGITTA / RADIUS))
    assert least - 2 <= len(bent) <= least + 3


def test_skipped_things_are_counted_in_full_and_named_once(tmp_path: Path) -> None:
    document = new()
    block = document.blocks.new("B")
    ray = block.add_ray((0, 0), (1, 0))
    for n in range(3):
        document.modelspace().add_blockref("B", (n, 0))
    lines = [document.modelspace().add_xline((0, n), (1, 0)) for n in range(20)]
    skipped = {(part.reason.value, part.kind): part for part in read_back(document, tmp_path).reading.skipped}
    rays, xlines = skipped["infinite-line", "RAY"], skipped["infinite-line", "XLINE"]
    assert (rays.count, rays.handles) == (3, (ray.dxf.handle,))
    assert xlines.count == 20
    assert 1 < len(xlines.handles) < 20
    assert list(xlines.handles) == [line.dxf.handle for line in lines][: len(xlines.handles)]
