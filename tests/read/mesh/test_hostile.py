# SPDX-License-Identifier: MIT
"""Files made to hurt: each is an error of the file or a mesh, soon, and in little more memory than the file takes."""

import os
import pickle
import time
import tracemalloc
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.read.mesh.files import (
    POINTS,
    TRIANGLES,
    faces_of,
    obj,
    off,
    ply,
    read,
    refused,
    simple_ply,
    sound,
    stl_binary,
    stl_text,
)
from tests.read.mesh.gltf_files import Gltf, pyramid

from foparq.errors import InputError
from foparq.profile.schema import LimitsSpec
from foparq.read.guard.parent import guarded
from foparq.read.mesh.reader import read_mesh

VERTICES = "".join(f"v {x} {y} {z}\n" for x, y, z in POINTS)
_TIMES = 40  #: bytes of memory for one of a file, at most
_BESIDE = 60_000_000  #: and so much for any


def shown_often(nodes: int, primitives: int) -> bytes:
    made = pyramid(POINTS, TRIANGLES)
    made.document["meshes"][0]["primitives"] *= primitives
    made.nodes(*({"mesh": 0} for _ in range(nodes)), roots=range(nodes))
    return made.glb()


def bounded(folder: Path, data: bytes, name: str = "mesh") -> str:
    """How the reading of a file ended, within bounds of time and memory."""
    path = folder / name
    path.write_bytes(data)
    begin = time.process_time()
    end = ended(path)
    assert time.process_time() - begin < 20
    # Watching memory takes more time than reading.
    tracemalloc.start()
    assert ended(path) == end
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < _TIMES * len(data) + _BESIDE
    return end


def ended(path: Path) -> str:
    try:
        mesh = read_mesh(path, limits=LimitsSpec())
    except InputError as error:
        return error.message
    assert sound(mesh)
    return "read"


@pytest.mark.parametrize(
    ("make", "end"),
    [
        (lambda: b"", "read.empty"),
        (lambda: shown_often(50_000, 1), "read"),
        (lambda: shown_often(10_000, 11), "mesh.gltf-parts"),
        (lambda: b"\0" * 100_000, "mesh.unknown-format"),
        (lambda: b"ply\n" + b"comment x\n" * 2_000_000 + b"end_header\n", "mesh.header-end"),
        (lambda: b"ply\nformat ascii 1.0\n" + b"element e 0\n" * 60_000 + b"end_header\n", "mesh.line"),
        (lambda: simple_ply("ascii", points=[], faces=[]), "mesh.no-surface"),
        (lambda: ply("ascii", []).replace(b"end_", b"element x 999999999999999999\nend_"), "mesh.header-lacks"),
        (lambda: obj() + b"".join(b"g %d\nf 1 2 3\n" % n for n in range(50_000)), "read"),
        (lambda: VERTICES.encode() + b"f" + b" 1 2 3 4 5" * 200_000 + b"\n", "read"),
        (lambda: VERTICES.encode() + b"f" + b" 1/1/1 2//2 3" * 300_000 + b"\n", "read"),
        (lambda: VERTICES.encode() + b"f 1 2 3\nf " + b"1" * 10_000_000 + b" 2 3\n", "read"),
        (lambda: b"v " + b"1 " * 5_000_000 + b"\nf 1 2 3\n", "mesh.line"),
        (lambda: b"v 1 2 " + b"9" * 10_000_000 + b"\nf 1 1 1\n", "read"),
        (lambda: b"#" * 100_000_000, "mesh.long-line"),
        (lambda: b"v 1 2 3" + b" " * 100_000_000 + b"\n", "mesh.long-line"),
        (lambda: b"v 1 2 3\n" + b"\n" * 30_000_000, "mesh.no-surface"),
        (lambda: b"v 1 2 3\n" + b" \n" * 10_000_000 + b"f 1 1 1\n", "read"),
        (lambda: b"v 1 2 3\n" + b"\\\n" * 3_000_000 + b"f 1 1 1\n", "read"),
        (lambda: b"v 1 2 3\n" + b"x\n" * 5_000_000, "mesh.line"),
        (lambda: b"v 1 2 3\n" + b"\r" * 30_000_000 + b"\nf 1 1 1", "read"),
        (lambda: b"OFF\n" + b"#\n" * 5_000_000 + b"1 1 0\n", "mesh.cut-off"),
        (lambda: b"OFF" + b" " * 5_000_000, "mesh.line"),
        (lambda: b"solid " + b"x" * 1_000_000 + b"\n" + b"solid\nendsolid\n" * 100_000, "mesh.line"),
        (lambda: b"solid\nendsolid\n" * 100_000, "mesh.no-surface"),
        (
            lambda: ply(
                "ascii",
                [
                    ("vertex", ["float x", "float y", "float z"], POINTS),
                    ("face", ["list int int vertex_indices"], [(tuple([1] * 500_000),)]),
                ],
            ),
            "read",
        ),
        (
            lambda: ply(
                "binary_big_endian",
                [
                    ("vertex", ["float x", "float y", "float z"], POINTS),
                    ("face", ["list int int vertex_indices"], [(tuple([1] * 500_000),), ((1,),)]),
                ],
            ),
            "read",
        ),
        (
            lambda: ply(
                "binary_little_endian",
                [
                    ("vertex", ["float x", "float y", "float z"], POINTS),
                    ("face", ["list uchar int vertex_indices"], [((),)] * 500_000),
                ],
            ),
            "read",
        ),
    ],
)
def test_bounds_of_time_and_memory(tmp_path: Path, make: Callable[[], bytes], end: str) -> None:
    assert bounded(tmp_path, make()) == end


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32", "utf-8-sig"])
def test_encodings(tmp_path: Path, encoding: str) -> None:
    for text in (obj(), off(), stl_text()):
        data = text.decode().encode(encoding)
        if encoding == "utf-8-sig":
            assert read(tmp_path, data).faces > 4
        else:
            refused(tmp_path, data)


def test_what_is_no_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.ply")
    for path in (tmp_path, tmp_path / "a.ply", Path("/dev/zero")):
        with pytest.raises(InputError) as caught:
            read_mesh(path, limits=LimitsSpec())
        assert caught.value.message == "read.not-a-file"


@pytest.mark.parametrize(
    ("data", "message", "value"),
    [
        (b"PK\x03\x04....", "read.archive", "ZIP"),
        (b"AC1032....", "read.dwg", "AC1032"),
        (b"%PDF-1.7", "mesh.not-a-mesh", "PDF"),
        (b"Kaydara FBX Binary  \0", "mesh.not-a-mesh", "FBX"),
        (b"LASF....", "mesh.not-a-mesh", "LAS"),
        (b"<?xml", "mesh.not-a-mesh", "XML"),
        (b"SQLite format 3\0", "mesh.not-a-mesh", "gpkg"),
        (b"name;x;y;z\n1;2;3;4\n", "mesh.unknown-format", None),
    ],
)
def test_other_files_are_named(tmp_path: Path, data: bytes, message: str, value: str | None) -> None:
    error = refused(tmp_path, data)
    assert (error.message, error.fields.get("value")) == (message, value)


def textured() -> Gltf:
    made = pyramid(POINTS, TRIANGLES)
    uv = made.accessor([(0.5, 0.5)] * 5)
    primitive = made.document["meshes"][0]["primitives"][0]
    primitive["attributes"]["TEXCOORD_0"] = uv
    made.document["materials"] = [{"name": "m"}]
    made.nodes({"children": [1], "scale": [2, 2, -2]}, {"mesh": 0, "matrix": [1.0] * 16}, roots=[0])
    return made


def test_the_name_of_a_file_says_nothing(tmp_path: Path) -> None:
    made = {
        "PLY": simple_ply(),
        "OFF": off(),
        "OBJ": obj(),
        "STL": stl_binary(),
        "GLB": pyramid(POINTS, TRIANGLES).glb(),
    }
    for version, data in made.items():
        for ending in ("stl", "ply", "obj", "dxf", "txt"):
            assert read(tmp_path, data, f"mesh.{ending}").reading.version.startswith(version)


MADE = {
    "glb": textured().glb(),
    "gltf": textured().text(),
    "ply-le": simple_ply(),
    "ply-be": simple_ply("binary_big_endian", real="float", count="int"),
    "ply-text": simple_ply("ascii"),
    "stl": stl_binary(),
    "stl-text": stl_text(),
    "obj": obj(),
    "off": off(),
    "obj-textured": (VERTICES + "vt 0 0\nvt 1 1\ng a\nusemtl m\nf 1/1 2/2 -1/1\nl 1 2\n").encode(),
    "strips": ply(
        "binary_little_endian",
        [
            (
                "vertex",
                ["float x", "float y", "float z", "float s", "float t"],
                [(*point, 0.5, 0.5) for point in POINTS],
            ),
            ("tristrips", ["list int int vertex_indices"], [((0, 1, 2, 3, -1, 4, 0, 1),)]),
        ],
    ),
}
NUMBERS = [b"nan", b"-1", b"0", b"1e308", b"99999999999999999999", b"", b"1,5", b"x", b"4294967295", b"1e400", b"-0.0"]


def damaged(data: bytes, rng: np.random.Generator) -> bytes:
    """One mild change: a byte, a cut, a repeated or missing stretch, an odd word."""
    at, to = sorted(rng.integers(0, len(data) + 1, 2).tolist())
    to = min(to, at + 12)
    match int(rng.integers(6)):
        case 0:
            return data[:at] + bytes([int(rng.integers(256))]) + data[at + 1 :]
        case 1:
            return data[:at]
        case 2:
            return data[:to] + data[at:]
        case 3:
            return data[:at] + data[to:]
        case 4:
            return (
                data[:at] + bytes([data[at] ^ 1 << int(rng.integers(8))]) + data[at + 1 :] if at < len(data) else data
            )
        case _:
            words = data.split(b" ")
            words[int(rng.integers(len(words)))] = NUMBERS[int(rng.integers(len(NUMBERS)))]
            return b" ".join(words)


@pytest.mark.parametrize("kind", MADE)
def test_mild_damage_is_read_or_refused(tmp_path: Path, kind: str) -> None:
    rng = np.random.default_rng(list(kind.encode()))
    ends: set[str] = set()
    for _ in range(400):
        data = MADE[kind]
        for _ in range(int(rng.integers(1, 4))):
            data = damaged(data, rng)
        name = "mesh.stl" if kind == "stl" else "mesh"
        (tmp_path / name).write_bytes(data)
        ends.add(ended(tmp_path / name))
    assert "read" in ends
    assert len(ends) > 2


def test_a_reader_in_a_child_process(tmp_path: Path) -> None:
    path = tmp_path / "mesh"
    path.write_bytes(obj() + b"f 1 2 3\n" * 200_000)
    bounds = {"file": path.name, "seconds": 60.0, "memory": 300_000_000}
    mesh = guarded(partial(read_mesh, limits=LimitsSpec()), path, **bounds)
    assert (len(mesh.points), mesh.faces) == (5, 200_005)
    with pytest.raises(InputError) as caught:
        guarded(partial(read_mesh, limits=LimitsSpec(faces=9)), path, **bounds)
    assert caught.value.message == "mesh.too-many-faces"


def test_the_result_is_passed_on_whole(tmp_path: Path) -> None:
    mesh = read(tmp_path, MADE["obj-textured"])
    again = pickle.loads(pickle.dumps(mesh, protocol=5))
    assert faces_of(again) == faces_of(mesh)
    assert (again.reading, again.groups) == (mesh.reading, mesh.groups)
