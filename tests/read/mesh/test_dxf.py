# SPDX-License-Identifier: MIT
"""Meshes in DXF files: faces as they are drawn, also in blocks."""

from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from tests.read.mesh.files import FACES, POINTS, faces_of, places_of, sound

from foparq.errors import InputError
from foparq.model.drawing import SkippedReason
from foparq.model.mesh import RawMesh
from foparq.profile.schema import LimitsSpec
from foparq.read.mesh.reader import read_mesh


def new(version: str = "R2010", unit: int = 6) -> Any:
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = unit
    return document


def read(document: Any, folder: Path, form: str = "asc", **bounds: int) -> RawMesh:
    path = folder / "mesh.dxf"
    document.saveas(path, fmt=form)
    mesh = read_mesh(path, limits=LimitsSpec(**bounds))
    assert sound(mesh)
    return mesh


@pytest.mark.parametrize("form", ["asc", "bin"])
def test_mesh(tmp_path: Path, form: str) -> None:
    document = new()
    entity = document.modelspace().add_mesh(dxfattribs={"layer": "TORRE"})
    with entity.edit_data() as data:
        data.vertices, data.faces = list(POINTS), [list(face) for face in FACES]
    mesh = read(document, tmp_path, form)
    assert (places_of(mesh), faces_of(mesh)) == (list(POINTS), [list(face) for face in FACES])
    assert (mesh.groups, mesh.reading.unit, mesh.reading.version) == (("TORRE",), "m", "DXF AC1024")
    assert (mesh.reading.skipped, mesh.reading.repairs) == ((), ())


@pytest.mark.parametrize("version", ["R12", "R2018"])
def test_polyface(tmp_path: Path, version: str) -> None:
    document = new(version)
    polyface = document.modelspace().add_polyface()
    polyface.append_faces([[POINTS[vertex] for vertex in face] for face in FACES])
    mesh = read(document, tmp_path)
    # ezdxf writes the corners of every face by themselves: nothing is merged.
    assert [[tuple(mesh.points[corner]) for corner in face] for face in faces_of(mesh)] == [
        [POINTS[vertex] for vertex in face] for face in FACES
    ]


def test_corners_of_hidden_edges(tmp_path: Path) -> None:
    document = new()
    polyface = document.modelspace().add_polyface()
    polyface.append_faces([[POINTS[vertex] for vertex in (0, 1, 2, 3)]])
    polyface.vertices[-1].dxf.vtx1 = -2
    polyface.vertices[-1].dxf.vtx3 = 0
    assert faces_of(read(document, tmp_path)) == [[0, 1, 2]]
    polyface.vertices[-1].dxf.vtx2 = 9
    document.modelspace().add_3dface([(5, 0, 0), (6, 0, 0), (6, 1, 0)])
    first, second = faces_of(read(document, tmp_path))
    assert first[:2] == [0, 1]
    assert first[2] >= 7
    assert second == [4, 5, 6]


@pytest.mark.parametrize(("close", "faces"), [((0, 0), 6), ((1, 0), 9), ((0, 1), 8), ((1, 1), 12)])
def test_polygon_mesh(tmp_path: Path, close: tuple[int, int], faces: int) -> None:
    document = new()
    grid = document.modelspace().add_polymesh((3, 4))
    for m in range(3):
        for n in range(4):
            grid.set_mesh_vertex((m, n), (m, n, 0.5))
    if close[0]:
        grid.m_close()
    if close[1]:
        grid.n_close()
    mesh = read(document, tmp_path)
    assert (len(mesh.points), mesh.faces) == (12, faces)
    assert faces_of(mesh)[0] == [0, 4, 5, 1]
    if not any(close):
        # The squares lie side by side and are all turned the same way.
        a, b, c = (mesh.points[mesh.corners.reshape(-1, 4)[:, n]] for n in range(3))
        assert np.cross(b - a, c - b)[:, 2].tolist() == [1.0] * 6


def test_faces_in_space(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dxfattribs={"layer": "A"})
    space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 7)], dxfattribs={"layer": "B"})
    mesh = read(document, tmp_path)
    assert faces_of(mesh) == [[0, 1, 2, 3], [4, 5, 6]]
    assert [mesh.groups[row] for row in mesh.group] == ["A", "B"]


def test_blocks_stand_where_they_are_inserted(tmp_path: Path) -> None:
    document = new()
    block = document.blocks.new("JANELA", base_point=(1, 0, 0))
    block.add_3dface([(1, 0, 0), (2, 0, 0), (2, 1, 0)])
    outer = document.blocks.new("VÃO")
    outer.add_blockref("JANELA", (10, 0, 0), dxfattribs={"xscale": 2, "yscale": 2, "zscale": 2, "layer": "VIDRO"})
    space = document.modelspace()
    space.add_blockref("VÃO", (0, 5, 0), dxfattribs={"rotation": 90, "layer": "NORTE"})
    space.add_blockref("JANELA", (0, 0, 3), dxfattribs={"row_count": 2, "row_spacing": 4, "layer": "SUL"})
    mesh = read(document, tmp_path)
    expected = [
        *[(0, 15, 0), (0, 17, 0), (-2, 17, 0)], *[(0, 0, 3), (1, 0, 3), (1, 1, 3)], *[(0, 4, 3), (1, 4, 3), (1, 5, 3)],
    ]  # fmt: skip
    np.testing.assert_allclose(mesh.points, expected, atol=1e-12)
    assert [mesh.groups[row] for row in mesh.group] == ["VIDRO", "SUL", "SUL"]


def test_blocks_without_end(tmp_path: Path) -> None:
    document = new()
    block = document.blocks.new("A")
    block.add_blockref("B", (0, 0, 0))
    document.blocks.new("B").add_blockref("A", (0, 0, 0))
    document.modelspace().add_blockref("A", (0, 0, 0))
    with pytest.raises(InputError) as caught:
        read(document, tmp_path)
    assert caught.value.message == "mesh.dxf-blocks"


def test_blocks_that_grow(tmp_path: Path) -> None:
    document = new()
    for n in range(30):
        block = document.blocks.new(f"B{n}")
        for _ in range(2):
            block.add_blockref(f"B{n + 1}", (0, 0, 0))
    document.blocks.new("B30").add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 0)])
    document.modelspace().add_blockref("B0", (0, 0, 0))
    with pytest.raises(InputError) as caught:
        read(document, tmp_path)
    assert caught.value.message == "dxf.too-many-entities"


def test_what_is_no_surface_is_told(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 7)])
    space.add_line((0, 0), (1, 1))
    space.add_3dsolid().sat = ["700 0 1 0", "@0 @0 @0", "1 1e-6 1e-10", "End-of-ACIS-data"]
    space.add_blockref("FALTA", (0, 0, 0))
    entity = space.add_mesh(dxfattribs={"subdivision_levels": 2})
    with entity.edit_data() as data:
        data.vertices, data.faces = list(POINTS), [list(face) for face in FACES]
    skipped = {(one.kind, one.name): one.reason for one in read(document, tmp_path).reading.skipped}
    assert skipped == {
        ("LINE", ""): SkippedReason.LINES_AND_POINTS,
        ("3DSOLID", ""): SkippedReason.UNKNOWN_ELEMENT,
        ("INSERT", "FALTA"): SkippedReason.MISSING_BLOCK,
        ("MESH (smooth)", ""): SkippedReason.UNKNOWN_ELEMENT,
    }


def test_a_drawing_is_no_mesh(tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_line((0, 0), (1, 1))
    with pytest.raises(InputError) as caught:
        read(document, tmp_path)
    assert caught.value.message == "mesh.no-surface"


def test_bounds(tmp_path: Path) -> None:
    cases = ((FACES, POINTS, "vertices"), ([(0, 1, 2)] * 5, POINTS[:4], "faces"))
    for faces, points, message in cases:
        document = new()
        entity = document.modelspace().add_mesh()
        with entity.edit_data() as data:
            data.vertices, data.faces = list(points), [list(face) for face in faces]
        assert read(document, tmp_path, faces=5).faces == 5
        with pytest.raises(InputError) as caught:
            read(document, tmp_path, faces=4)
        assert caught.value.message == f"mesh.too-many-{message}"


def test_every_cut_is_noticed(tmp_path: Path) -> None:
    document = new("R12")
    document.modelspace().add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 7)])
    path = tmp_path / "mesh.dxf"
    document.saveas(path)
    data = path.read_bytes()
    for length in range(len(data) // 2, len(data) - 8, 97):
        path.write_bytes(data[:length])
        with pytest.raises(InputError):
            read_mesh(path, limits=LimitsSpec())
