# SPDX-License-Identifier: MIT
"""glTF and GLB: the scene stands where its nodes put it, and nothing is read from outside."""

import json
import os
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.read.mesh.files import POINTS, TRIANGLES, faces_of, places_of, read, refused, sound
from tests.read.mesh.gltf_files import Gltf, pyramid

from foparq.model.drawing import SkippedReason

FACES = [list(face) for face in TRIANGLES]


@pytest.mark.parametrize("kind", [5121, 5123, 5125])
def test_all_containers(tmp_path: Path, kind: int) -> None:
    made = pyramid(POINTS, TRIANGLES, kind)
    (tmp_path / "dados da torre.bin").write_bytes(made.data + b"more than announced")
    for data in (made.glb(), made.text(), made.text("dados%20da%20torre.bin"), b"\xef\xbb\xbf" + made.text()):
        mesh = read(tmp_path, data)
        assert (places_of(mesh), faces_of(mesh)) == (list(POINTS), FACES)
        assert (mesh.groups, mesh.reading.unit, mesh.reading.up, mesh.reading.first) == (("torre",), "m", "y", 0)
        assert mesh.reading.version in ("glTF 2.0", "GLB 2.0")
        assert mesh.reading.skipped == ()
        assert mesh.reading.repairs == ()
        assert sound(mesh)


@pytest.mark.parametrize("room", [0, -1])
def test_files_beside_may_fill_the_bytes_that_one_file_may_have(tmp_path: Path, room: int) -> None:
    made, size = pyramid(POINTS, TRIANGLES), 100_000
    (tmp_path / "torre.bin").write_bytes(made.data + bytes(size - len(made.data)))
    if room < 0:
        refused(tmp_path, made.text("torre.bin"), bytes=size + room)
    else:
        assert faces_of(read(tmp_path, made.text("torre.bin"), bytes=size + room)) == FACES


def test_without_indices_and_interleaved(tmp_path: Path) -> None:
    made = Gltf()
    position = made.accessor([POINTS[vertex] for face in TRIANGLES for vertex in face], stride=20)
    made.mesh({"attributes": {"POSITION": position}})
    made.nodes({"mesh": 0})
    mesh = read(tmp_path, made.glb())
    assert places_of(mesh) == [POINTS[vertex] for face in TRIANGLES for vertex in face]
    assert faces_of(mesh) == [[3 * n, 3 * n + 1, 3 * n + 2] for n in range(6)]


def test_offsets_within_a_view(tmp_path: Path) -> None:
    made = Gltf()
    view = made.view(
        b"\xee" * 12 + b"".join(struct.pack("<6f", *point, 0.0, 0.5, 9.0) for point in POINTS), byteStride=24
    )
    said = {"bufferView": view, "componentType": 5126, "count": 5}
    made.document["accessors"] += [
        {**said, "byteOffset": 12, "type": "VEC3"},
        {**said, "byteOffset": 24, "type": "VEC2"},
    ]
    indices = made.accessor([(vertex,) for face in TRIANGLES for vertex in face], 5125)
    made.mesh({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": indices})
    made.nodes({"mesh": 0})
    mesh = read(tmp_path, made.glb())
    assert places_of(mesh) == list(POINTS)
    assert mesh.texture is not None
    assert mesh.texture.uv.tolist() == [[0.0, 0.5]] * 5
    assert mesh.texture.corner.tolist() == mesh.corners.tolist()
    # The last row may end with its view, and not beyond.
    made.document["accessors"][0]["byteOffset"] = 24
    assert places_of(read(tmp_path, made.glb()))[0] == (0.0, 0.5, 9.0)
    made.document["accessors"][0]["byteOffset"] = 25
    error = refused(tmp_path, made.glb())
    assert (error.message, error.fields["key"], error.fields["bytes"]) == (
        "mesh.gltf-outside",
        "accessors[0].count",
        133,
    )


@pytest.mark.parametrize(
    ("mode", "index", "expected"),
    [
        (4, [0, 1, 2, 2, 1, 3], [[0, 1, 2], [2, 1, 3]]),
        (5, [0, 1, 2, 3, 4], [[0, 1, 2], [2, 1, 3], [2, 3, 4]]),
        (5, [0, 1, 2, 2, 3, 3, 4, 0], [[0, 1, 2], [4, 3, 0]]),
        (6, [0, 1, 2, 3, 4], [[0, 1, 2], [0, 2, 3], [0, 3, 4]]),
    ],
)
def test_triangles_strips_and_fans(tmp_path: Path, mode: int, index: list[int], expected: list[list[int]]) -> None:
    made = Gltf()
    position, indices = made.accessor(POINTS), made.accessor([(one,) for one in index], 5121)
    made.mesh({"attributes": {"POSITION": position}, "indices": indices, "mode": mode})
    made.nodes({"mesh": 0})
    found = faces_of(read(tmp_path, made.glb()))
    assert [sorted(turned(face)) for face in found] == [sorted(turned(face)) for face in expected]


def turned(face: list[int]) -> list[tuple[int, ...]]:
    return [tuple(face[n:] + face[:n]) for n in range(3)]


def test_nodes_are_multiplied(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    # By hand: half a turn about z, then twice as large, then moved; above, a matrix that moves by 100 along y.
    matrix = [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0, 0, 100.0, 0, 1.0]
    made.nodes(
        {"children": [1, 2], "matrix": matrix, "name": "terreno"},
        {"mesh": 0, "rotation": [0, 0, 1, 0], "scale": [2, 2, 2], "translation": [712345.678, 0, 5]},
        {"mesh": 0, "name": "torre"},
        roots=[0],
    )
    mesh = read(tmp_path, made.glb())
    expected = [(712345.678 - 2 * x, 100 - 2 * y, 2 * z + 5) for x, y, z in POINTS] + [
        (x, y + 100, z) for x, y, z in POINTS
    ]
    np.testing.assert_array_equal(mesh.points, expected)
    assert faces_of(mesh) == FACES + [[vertex + 5 for vertex in face] for face in FACES]
    assert (mesh.groups, mesh.group.tolist()) == (("", "torre"), [0] * 6 + [1] * 6)


def test_a_quarter_turn(tmp_path: Path) -> None:
    made = pyramid([(1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2)])
    half = 0.5**0.5
    for turn, images in (
        ([half, 0, 0, half], [(1, 0, 0), (0, 0, 1), (0, -1, 0)]),
        ([0, half, 0, half], [(0, 0, -1), (0, 1, 0), (1, 0, 0)]),
        ([0, 0, half, half], [(0, 1, 0), (-1, 0, 0), (0, 0, 1)]),
        ([0.5, 0.5, 0.5, 0.5], [(0, 1, 0), (0, 0, 1), (1, 0, 0)]),
    ):
        made.document["nodes"][0]["rotation"] = turn
        np.testing.assert_allclose(read(tmp_path, made.glb()).points, images, atol=1e-15)


def test_what_is_mirrored_is_turned_round(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    made.document["nodes"][0]["scale"] = [-1, 1, 1]
    mesh = read(tmp_path, made.glb())
    assert places_of(mesh) == [(-x, y, z) for x, y, z in POINTS]
    # The pyramid keeps its volume, and does not become a hole.
    a, b, c = (mesh.points[mesh.corners.reshape(-1, 3)[:, n]] for n in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(4 * 1.5 / 3)


def test_primitives_that_share_vertices_stay_together(tmp_path: Path) -> None:
    made = Gltf()
    position = made.accessor(POINTS)
    parts = [made.accessor([(vertex,) for vertex in face], 5121) for face in TRIANGLES]
    made.mesh(*({"attributes": {"POSITION": position}, "indices": part} for part in parts))
    made.nodes({"mesh": 0}, {"mesh": 0})
    mesh = read(tmp_path, made.glb())
    assert len(mesh.points) == 10
    assert faces_of(mesh) == FACES + [[vertex + 5 for vertex in face] for face in FACES]


def test_numbers_outside_stay_outside(tmp_path: Path) -> None:
    made = pyramid(POINTS, [(0, 1, 5), (0, 1, 200)])
    other = made.accessor([(2,), (3,), (4,)], 5121)
    made.document["meshes"][0]["primitives"].append(
        {"attributes": {"POSITION": made.accessor(POINTS)}, "indices": other}
    )
    assert faces_of(read(tmp_path, made.glb())) == [[0, 1, 10], [0, 1, 205], [7, 8, 9]]


def test_sparse_accessors(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    which, what = made.view(struct.pack("<2H", 1, 4)), made.view(struct.pack("<6f", 7, 8, 9, 1, 2, 3))
    sparse = {
        "count": 2, "indices": {"bufferView": which, "componentType": 5123}, "values": {"bufferView": what},
    }  # fmt: skip
    made.document["accessors"][0]["sparse"] = sparse
    expected = [POINTS[0], (7, 8, 9), *POINTS[2:4], (1, 2, 3)]
    assert places_of(read(tmp_path, made.glb())) == expected
    del made.document["accessors"][0]["bufferView"]
    assert places_of(read(tmp_path, made.glb())) == [(0, 0, 0), (7, 8, 9), (0, 0, 0), (0, 0, 0), (1, 2, 3)]
    made.document["accessors"][0]["count"] = 10**7
    assert refused(tmp_path, made.glb()).message == "mesh.cut-off"
    made.document["accessors"][0]["count"] = 4
    assert refused(tmp_path, made.glb()).fields["key"] == "accessors[0].sparse.indices"


@pytest.mark.parametrize(
    ("kind", "rows", "expected"),
    [
        (5121, [(0, 255), (51, 204), (255, 0)], [(0.0, 1.0), (0.2, 0.8), (1.0, 0.0)]),
        (5123, [(0, 65535), (13107, 0), (65535, 0)], [(0.0, 1.0), (0.2, 0.0), (1.0, 0.0)]),
        (5120, [(-128, 127), (-127, 0), (127, 0)], [(-1.0, 1.0), (-1.0, 0.0), (1.0, 0.0)]),
        (5122, [(-32768, 32767), (-32767, 0), (32767, 0)], [(-1.0, 1.0), (-1.0, 0.0), (1.0, 0.0)]),
    ],
)
def test_whole_numbers_that_mean_shares(
    tmp_path: Path, kind: int, rows: list[tuple[int, int]], expected: list[tuple[float, float]]
) -> None:
    made = pyramid(POINTS[:3], [(0, 1, 2)])
    uv = made.accessor(rows, kind, normalized=True)
    made.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv
    texture = read(tmp_path, made.glb()).texture
    assert texture is not None
    np.testing.assert_allclose(texture.uv, expected, rtol=1e-15)


def test_materials_and_images(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    first, second = made.accessor([(0.0, 0.25)] * 5), made.accessor([(0.5, 0.75)] * 5)
    attributes = made.document["meshes"][0]["primitives"][0]["attributes"] | {"TEXCOORD_0": first, "TEXCOORD_1": second}
    parts = [{"attributes": attributes, "indices": 1, "material": material} for material in (0, 1, 2, 3)]
    made.document["meshes"][0]["primitives"] = [*parts, {"attributes": attributes, "indices": 1}]
    made.document |= {
        "images": [
            {"uri": "parede%20norte.jpg"},
            {"bufferView": 0, "mimeType": "image/png"},
            {"uri": "data:image/webp;base64,AA"},
        ],
        "textures": [{"source": 0}, {"source": 1}, {"extensions": {"EXT_texture_webp": {"source": 2}}}],
        "materials": [
            {"name": "pedra", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}},
            {"name": "cal"},
        ],
    }
    mesh = read(tmp_path, made.glb())
    texture = mesh.texture
    assert texture is not None
    assert texture.materials == (
        ("pedra", "parede norte.jpg"),
        ("", "data:image/png"),
        ("", "data:image/webp"),
        ("cal", ""),
    )
    assert texture.material.tolist() == [n for n in (0, 1, 2, 3, -1) for _ in range(6)]
    assert texture.uv[texture.corner].tolist() == [[0.5, 0.75]] * 18 + [[0.0, 0.25]] * 72
    assert mesh.reading.images == ("parede norte.jpg",)
    assert (len(mesh.points), len(texture.uv)) == (5, 10)
    assert sound(mesh)


def test_what_is_not_read_is_told(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    triangles = made.document["meshes"][0]["primitives"][0]
    made.document["meshes"][0]["primitives"] += [
        {**triangles, "mode": 0},
        {**triangles, "mode": 1},
        {**triangles, "mode": 3},
        {"attributes": {}},
    ]
    made.document["meshes"][0]["weights"] = [0, 0.5]
    made.document |= {"animations": [{}], "cameras": [{}], "skins": [{}]}
    made.nodes({"mesh": 0, "skin": 0, "camera": 0}, {"mesh": 0}, {"camera": 0}, roots=[0])
    skipped = {one.kind: (one.reason, one.count) for one in read(tmp_path, made.glb()).reading.skipped}
    assert skipped == {
        "animation": (SkippedReason.NO_SURFACE, 1),
        "camera": (SkippedReason.NO_SURFACE, 1),
        "line": (SkippedReason.LINES_AND_POINTS, 2),
        "morph target": (SkippedReason.UNKNOWN_ELEMENT, 1),
        "node": (SkippedReason.UNKNOWN_ELEMENT, 1),
        "point": (SkippedReason.LINES_AND_POINTS, 1),
        "primitive": (SkippedReason.UNKNOWN_ELEMENT, 1),
        "skin": (SkippedReason.UNKNOWN_ELEMENT, 1),
    }


@pytest.mark.parametrize(
    ("where", "value", "message"),
    [
        ("asset.version", "1.0", "mesh.gltf-version"),
        ("asset", 3, "mesh.gltf-value"),
        ("asset.version", None, "mesh.gltf-value"),
        ("extensionsUsed", ["KHR_draco_mesh_compression"], "mesh.gltf-compressed"),
        ("extensionsRequired", ["EXT_meshopt_compression"], "mesh.gltf-compressed"),
        ("extensionsRequired", ["CESIUM_RTC"], "mesh.gltf-extension"),
        ("extensionsRequired", [3], "mesh.gltf-value"),
        ("bufferViews.0.extensions", {"EXT_meshopt_compression": {}}, "mesh.gltf-compressed"),
        ("nodes.0.extensions", {"EXT_mesh_gpu_instancing": {}}, "mesh.gltf-extension"),
        ("nodes.0.children", [0], "mesh.gltf-nodes"),
        ("nodes.0.children", [99], "mesh.gltf-value"),
        ("nodes.0.children", [-1], "mesh.gltf-value"),
        ("nodes.0.mesh", 7, "mesh.gltf-value"),
        ("nodes.0.mesh", 1.5, "mesh.gltf-value"),
        ("nodes.0.mesh", True, "mesh.gltf-value"),
        ("nodes.0.matrix", [1] * 15, "mesh.gltf-value"),
        ("nodes.0.rotation", ["a"] * 4, "mesh.gltf-value"),
        ("scene", 5, "mesh.gltf-value"),
        ("scenes.0.nodes", [0, 0], "mesh.gltf-nodes"),
        ("accessors.0.bufferView", 99, "mesh.gltf-value"),
        ("accessors.0.count", 6, "mesh.gltf-outside"),
        ("accessors.0.count", 10**12, "mesh.too-many-vertices"),
        ("accessors.0.count", 10**400, "mesh.gltf-value"),
        ("accessors.0.count", -1, "mesh.gltf-value"),
        ("accessors.0.type", "MAT4", "mesh.gltf-value"),
        ("accessors.0.type", "VEC2", "mesh.gltf-value"),
        ("accessors.0.componentType", 5124, "mesh.gltf-value"),
        ("accessors.0.byteOffset", 1, "mesh.gltf-outside"),
        ("accessors.1.componentType", 5126, "mesh.gltf-value"),
        ("accessors.1.count", 17, "mesh.gltf-value"),
        ("accessors.1.type", "VEC3", "mesh.gltf-outside"),
        ("bufferViews.0.byteLength", 10**9, "mesh.gltf-outside"),
        ("bufferViews.0.byteOffset", 10**9, "mesh.gltf-outside"),
        ("bufferViews.0.byteStride", 4, "mesh.gltf-value"),
        ("bufferViews.0.byteStride", 24, "mesh.gltf-outside"),
        ("bufferViews.0.buffer", 1, "mesh.gltf-value"),
        ("meshes.0.primitives.0.mode", 7, "mesh.gltf-value"),
        ("meshes.0.primitives.0.material", 0, "mesh.gltf-value"),
        ("meshes.0.primitives.0.attributes", [], "mesh.gltf-value"),
        ("meshes.0.primitives", {}, "mesh.gltf-value"),
        ("meshes.0.primitives", [], "mesh.no-surface"),
        ("meshes", None, "mesh.gltf-value"),
        ("nodes", [], "mesh.gltf-value"),
        ("materials", [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "mesh.gltf-value"),
    ],
)
def test_damage_is_refused(tmp_path: Path, where: str, value: Any, message: str) -> None:
    made = pyramid(POINTS, TRIANGLES)
    *path, last = where.split(".")
    part: Any = made.document
    for name in path:
        part = part[int(name)] if isinstance(part, list) else part[name]
    part[last] = value
    assert refused(tmp_path, made.glb()).message == message


def test_nodes_that_are_no_tree(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    made.nodes({"children": [1]}, {"children": [0]})
    assert refused(tmp_path, made.glb()).message == "mesh.gltf-nodes"
    made.nodes({"children": [2]}, {"children": [2]}, {"mesh": 0})
    assert refused(tmp_path, made.glb()).message == "mesh.gltf-nodes"
    # A chain of any length is a tree.
    made.nodes(*({"children": [n + 1]} for n in range(50_000)), {"mesh": 0}, roots=[0])
    assert read(tmp_path, made.glb()).faces == 6


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("../fora.bin", "read.path-outside"),
        ("%2e%2e/fora.bin", "read.path-outside"),
        ("/etc/hostname", "read.path-absolute"),
        ("http://example.org/a.bin", "read.path-address"),
        ("file:///etc/hostname", "read.path-address"),
        ("falta.bin", "mesh.gltf-buffer"),
        ("", "read.path-odd"),
        ("fila.bin", "read.not-a-file"),
        ("pasta", "read.not-a-file"),
        ("elo.bin", "read.path-outside"),
        ("data:application/octet-stream,abc", "mesh.gltf-data"),
        ("data:;base64,%%%", "mesh.gltf-data"),
        ("data:;base64", "mesh.gltf-data"),
        ("data:;base64,AAAA", "mesh.gltf-outside"),
        ("a\x00b", "read.path-odd"),
        ("x" * 5000, "read.path-odd"),
        ("curto.bin", "mesh.gltf-outside"),
    ],
)
def test_buffers_that_are_not_read(tmp_path: Path, address: str, message: str) -> None:
    folder = tmp_path / "entrega"
    (folder / "pasta").mkdir(parents=True)
    os.mkfifo(folder / "fila.bin")
    made = pyramid(POINTS, TRIANGLES)
    (tmp_path / "fora.bin").write_bytes(made.data)
    (folder / "curto.bin").write_bytes(made.data[:-1])
    (folder / "elo.bin").symlink_to(tmp_path / "fora.bin")
    assert refused(folder, made.text(address)).message == message


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"{", "mesh.json"),
        (b"{}", "mesh.not-a-mesh"),
        (b'{"asset":{"version":"2.0"}}', "mesh.no-surface"),
        (b'{"type":"FeatureCollection"}', "mesh.not-a-mesh"),
        (b'{"a":' + b'[{"a":' * 100_000, "mesh.json-deep"),
        (b'{"a":' + b"[" * 20_000 + b"]" * 20_000 + b"}", "mesh.json-deep"),
        (b'{"a":' + b"9" * 100_000 + b"}", "mesh.json"),
        (b'{"a":NaN}', "mesh.json"),
        (b'{"a":"\xff"}', "mesh.json"),
        (b'{"a":[' + b"0," * 6_000_000 + b"0]}", "mesh.json-large"),
    ],
)
def test_odd_texts(tmp_path: Path, text: bytes, message: str) -> None:
    assert refused(tmp_path, text).message == message


def test_every_cut_is_noticed(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    for data in (made.glb(), made.text()):
        for length in range(1, len(data) - 1):
            refused(tmp_path, data[:length])


def test_frame_of_a_glb(tmp_path: Path) -> None:
    data = pyramid(POINTS, TRIANGLES).glb()
    assert refused(tmp_path, data[:4] + struct.pack("<I", 1) + data[8:]).message == "mesh.gltf-version"
    assert refused(tmp_path, data[:12] + struct.pack("<I", 2**32 - 1) + data[16:]).message == "mesh.cut-off"
    assert refused(tmp_path, data.replace(b"JSON", b"NOSJ", 1)).message == "mesh.header-lacks"
    assert refused(tmp_path, data.replace(b"BIN\0", b"NIB\0", 1)).message == "mesh.gltf-value"
    assert refused(tmp_path, data + b"x").message == "mesh.trailing"
    assert [one.code for one in read(tmp_path, data + b"\0\0").reading.repairs] == ["mesh-trailing-bytes"]


def test_bounds(tmp_path: Path) -> None:
    made = pyramid(POINTS, TRIANGLES)
    assert read(tmp_path, made.glb(), faces=6).faces == 6
    assert refused(tmp_path, made.glb(), faces=5).message == "mesh.too-many-faces"
    assert refused(tmp_path, made.glb(), faces=4).message == "mesh.too-many-vertices"
    # A mesh that many nodes show is as many meshes.
    made.nodes(*({"mesh": 0} for _ in range(1000)), roots=range(1000))
    assert refused(tmp_path, made.glb(), faces=5999).message == "mesh.too-many-faces"
    assert read(tmp_path, made.glb(), faces=6000).faces == 6000
    (tmp_path / "a.bin").write_bytes(made.data)
    assert refused(tmp_path, made.text("a.bin"), bytes=len(made.data) - 1).message == "read.too-large"
    made.mesh(*({"attributes": {}} for _ in range(2000)))
    made.nodes(*({"mesh": 1} for _ in range(100)), roots=range(100))
    assert refused(tmp_path, made.glb()).message == "mesh.gltf-parts"
    assert json.loads(made.text())["asset"]["version"] == "2.0"
