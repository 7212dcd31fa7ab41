# SPDX-License-Identifier: MIT
"""PLY: every form, type and order is read as it stands there."""

import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.read.mesh.files import (
    FACES,
    ORDERS,
    POINTS,
    TRIANGLES,
    faces_of,
    places_of,
    ply,
    read,
    refused,
    simple_ply,
    sound,
)

from foparq.model.drawing import SkippedReason

BINARY = [form for form in ORDERS if form != "ascii"]


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("faces", [FACES, TRIANGLES], ids=["polygons", "triangles"])
@pytest.mark.parametrize(
    ("real", "whole", "count"),
    [
        ("double", "int", "uchar"),
        ("float", "uint", "uchar"),
        ("float32", "int32", "uint8"),
        ("float64", "uint32", "int"),
        ("short", "uchar", "ushort"),
        ("float", "short", "int8"),
        ("double", "uint64", "uint32"),
        ("float", "int64", "char"),
    ],
)
def test_all_forms_and_types(
    tmp_path: Path, form: str, faces: list[list[int]], real: str, whole: str, count: str
) -> None:
    points = [(x, y, 2 * z) for x, y, z in POINTS]  # whole, so that short holds them
    if real == "short":
        points = [(int(x), int(y), int(z)) for x, y, z in points]
    mesh = read(tmp_path, simple_ply(form, real=real, whole=whole, count=count, points=points, faces=faces))
    assert places_of(mesh) == points
    assert faces_of(mesh) == [list(face) for face in faces]
    assert mesh.reading.version == f"PLY {form} 1.0"
    assert (mesh.reading.first, mesh.reading.unit, mesh.reading.repairs, mesh.groups) == (0, "", (), ("",))
    assert sound(mesh)


@pytest.mark.parametrize("form", BINARY)
def test_single_precision_is_widened_exactly(tmp_path: Path, form: str) -> None:
    points = [(712345.678, 7456789.123, 0.1), (1e-42, -0.0, 3.4e38), (float("nan"), float("inf"), -1.5)]
    mesh = read(tmp_path, simple_ply(form, real="float", points=points, faces=[(0, 1, 2)]))
    expected = [struct.unpack("<3f", struct.pack("<3f", *point)) for point in points]
    np.testing.assert_array_equal(mesh.points, expected)
    assert np.signbit(mesh.points[1, 1])


def test_decimals_in_text_are_read_to_the_nearest_double(tmp_path: Path) -> None:
    words = [
        "0.1",
        "7456789.123",
        "-1e-3",
        "+5",
        ".5",
        "5.",
        "1e22",
        "123456789012345678",
        "nan",
        "-inf",
        "1.#QNAN",
        "9e999",
    ]
    rows = [words[n : n + 3] for n in range(0, 12, 3)]
    data = ply(
        "ascii",
        [
            ("vertex", ["float x", "float y", "float z"], rows),
            ("face", ["list uchar int vertex_index"], [((0, 1, 2),)]),
        ],
    )
    expected = [float(word.replace("1.#QNAN", "nan")) for word in words]
    np.testing.assert_array_equal(read(tmp_path, data).points.reshape(-1), expected)


@pytest.mark.parametrize("form", ORDERS)
def test_order_of_elements_and_columns_does_not_matter(tmp_path: Path, form: str) -> None:
    data = ply(
        form,
        [
            (
                "face",
                ["uchar flag", "list uchar float texcoord", "list ushort int vertex_indices", "double area"],
                [(7, (0.0, 0.5) * len(face), tuple(face), 1.25) for face in FACES],
            ),
            ("camera", ["float view", "list int double matrix"], [(1.0, (1.0, 2.0))]),
            (
                "vertex",
                ["uchar red", "double z", "double x", "float quality", "double y"],
                [(9, z, x, 0.5, y) for x, y, z in POINTS],
            ),
        ],
    )
    mesh = read(tmp_path, data)
    assert (places_of(mesh), faces_of(mesh)) == (list(POINTS), [list(face) for face in FACES])
    assert mesh.texture is not None
    assert (mesh.texture.uv == [0.0, 0.5]).all()
    assert mesh.texture.corner.tolist() == list(range(16))
    assert [(one.reason, one.kind, one.count) for one in mesh.reading.skipped] == [
        (SkippedReason.NO_SURFACE, "camera", 1)
    ]


@pytest.mark.parametrize(
    ("name", "reason"), [("edge", SkippedReason.LINES_AND_POINTS), ("range_grid", SkippedReason.UNKNOWN_ELEMENT)]
)
def test_other_elements_are_told(tmp_path: Path, name: str, reason: SkippedReason) -> None:
    data = ply(
        "ascii",
        [
            ("vertex", ["float x", "float y", "float z"], POINTS),
            (name, ["int a", "int b"], [(0, 1), (1, 2)]),
            ("face", ["list uchar int vertex_indices"], [((0, 1, 2),)]),
        ],
    )
    (skipped,) = read(tmp_path, data).reading.skipped
    assert (skipped.reason, skipped.kind, skipped.count) == (reason, name, 2)
    assert skipped.reason.opens == (name == "range_grid")


@pytest.mark.parametrize("form", ORDERS)
def test_strips(tmp_path: Path, form: str) -> None:
    data = ply(
        form,
        [
            ("vertex", ["float x", "float y", "float z"], [(i, i % 2, 0) for i in range(9)]),
            (
                "tristrips",
                ["list int int vertex_indices"],
                [((0, 1, 2, 3, 4, -1, 5, 6, 7, -1, 1, 2, -1),), ((3, 4, 4, 5, 6),)],
            ),
        ],
    )
    mesh = read(tmp_path, data)
    # By hand: every second triangle is turned round, -1 begins anew, and 3 4 4, 4 4 5 are no faces.
    assert faces_of(mesh) == [[0, 1, 2], [2, 1, 3], [2, 3, 4], [5, 6, 7], [4, 5, 6]]


def test_faulty_faces_stay(tmp_path: Path) -> None:
    faces = [(), (0,), (0, 1), (0, 0, 1), (-1, 0, 1), (99, 0, 2**31 - 1), (0, 1, 2)]
    for form in ORDERS:
        mesh = read(tmp_path, simple_ply(form, faces=faces))
        assert faces_of(mesh) == [list(face) for face in faces]
        assert sound(mesh)


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("names", [("s", "t"), ("u", "v"), ("texture_u", "texture_v")])
def test_texture_by_vertex(tmp_path: Path, form: str, names: tuple[str, str]) -> None:
    data = ply(
        form,
        [
            (
                "vertex",
                ["float x", "float y", "float z", *(f"float {name}" for name in names)],
                [(*point, n / 4, n / 8) for n, point in enumerate(POINTS)],
            ),
            ("face", ["list uchar int vertex_indices"], [((0, 1, 4),), ((1, 2, 77),)]),
        ],
        comments=["TextureFile parede norte.jpg"],
    )
    mesh = read(tmp_path, data)
    texture = mesh.texture
    assert texture is not None
    assert texture.uv.tolist() == [[n / 4, n / 8] for n in range(5)]
    assert texture.corner.tolist() == [0, 1, 4, 1, 2, -1]
    assert (texture.material.tolist(), texture.materials) == ([0, 0], (("", "parede norte.jpg"),))
    assert mesh.reading.images == ("parede norte.jpg",)


@pytest.mark.parametrize("form", ORDERS)
def test_texture_by_face(tmp_path: Path, form: str) -> None:
    data = ply(
        form,
        [
            ("vertex", ["float x", "float y", "float z"], POINTS),
            (
                "face",
                ["list uchar int vertex_indices", "list uchar float texcoord", "int texnumber"],
                [
                    ((0, 1, 4), (0.0, 0.5, 1.0, 0.5, 0.25, 0.75), 1),
                    ((1, 2, 4), (), 0),
                    ((2, 3, 4), (0.5, 0.5), 9),
                ],
            ),
        ],
        comments=["TextureFile a.png", "TextureFile b.png"],
    )
    mesh = read(tmp_path, data)
    texture = mesh.texture
    assert texture is not None
    assert texture.uv[texture.corner[:3]].tolist() == [[0.0, 0.5], [1.0, 0.5], [0.25, 0.75]]
    assert texture.corner[3:].tolist() == [-1] * 6
    assert texture.material.tolist() == [1, 0, -1]
    assert [(one.code, one.text) for one in mesh.reading.repairs] == [("mesh-texture-corners", "1")]
    assert sound(mesh)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_ends_of_lines(tmp_path: Path, end: str) -> None:
    for form in ORDERS:
        data = ply(
            form,
            [
                ("vertex", ["float x", "float y", "float z"], POINTS),
                ("face", ["list uchar int vertex_indices"], [(tuple(face),) for face in FACES]),
            ],
            end=end,
        )
        assert faces_of(read(tmp_path, data)) == [list(face) for face in FACES]


@given(
    st.lists(st.lists(st.integers(0, 300), max_size=9), min_size=1, max_size=30),
    st.sampled_from(BINARY),
    st.sampled_from(["uchar", "char", "int", "ushort"]),
    st.sampled_from(["int", "ushort", "uint"]),
)
def test_ragged_rows_are_walked_right(
    tmp_path_factory: pytest.TempPathFactory, faces: list[list[int]], form: str, count: str, whole: str
) -> None:
    data = ply(
        form,
        [
            ("vertex", ["float x", "float y", "float z"], POINTS),
            (
                "face",
                ["uchar a", f"list {count} {whole} vertex_indices", "short b", f"list {count} double more", "int c"],
                [(1, tuple(face), -2, tuple(map(float, face[:3])), 3) for face in faces],
            ),
        ],
    )
    assert faces_of(read(tmp_path_factory.getbasetemp(), data)) == faces
    plain = simple_ply(form, count=count, whole=whole, faces=faces)
    assert faces_of(read(tmp_path_factory.getbasetemp(), plain)) == faces


@pytest.mark.parametrize("form", ORDERS)
def test_every_cut_is_noticed(tmp_path: Path, form: str) -> None:
    for data in (simple_ply(form), simple_ply(form, faces=TRIANGLES), simple_ply(form, count="int")):
        # In text the end of the last line may be missing, and its last digit can be any.
        for length in range(1, len(data) - (2 if form == "ascii" else 0)):
            refused(tmp_path, data[:length])


@pytest.mark.parametrize("form", BINARY)
def test_what_follows_the_last_row(tmp_path: Path, form: str) -> None:
    data = simple_ply(form)
    mesh = read(tmp_path, data + b"\n\0\0")
    assert [(one.code, one.text, one.loses) for one in mesh.reading.repairs] == [("mesh-trailing-bytes", "3", False)]
    error = refused(tmp_path, data + b"\x03abcdefghijkl")
    assert (error.message, error.fields["byte"], error.fields["value"]) == ("mesh.trailing", len(data), 13)


def test_a_row_too_many_in_text(tmp_path: Path) -> None:
    data = simple_ply("ascii") + b"3 0 1 2\n"
    error = refused(tmp_path, data)
    assert (error.message, error.fields["line"]) == ("mesh.too-long", data.count(b"\n"))


@pytest.mark.parametrize("rows", [10**12, 10**17, 10**9])
def test_announcements_that_the_file_cannot_keep(tmp_path: Path, rows: int) -> None:
    for form in ORDERS:
        data = simple_ply(form)
        for element in ("vertex", "face"):
            false = data.replace(f"element {element} 5".encode(), f"element {element} {rows}".encode())
            assert refused(tmp_path, false).message == "mesh.cut-off"


def test_lists_longer_than_the_file(tmp_path: Path) -> None:
    data = simple_ply("binary_little_endian", count="uint")
    at = data.index(b"end_header\n") + 11 + 5 * 24
    error = refused(tmp_path, data[:at] + struct.pack("<I", 2**32 - 1) + data[at + 4 :])
    assert (error.message, error.fields["byte"], error.fields["value"]) == ("mesh.list-count", at, 2**32 - 1)
    for faces in (FACES, TRIANGLES):
        data = simple_ply("binary_big_endian", count="char", faces=faces)
        at = data.index(b"end_header\n") + 11 + 5 * 24
        error = refused(tmp_path, data[:at] + b"\xff" + data[at + 1 :])
        assert (error.message, error.fields["byte"], error.fields["value"]) == ("mesh.list-count", at, -1)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("property double x", "property double w", "mesh.header-lacks"),
        ("property double x", "property list uchar double x", "mesh.header-lacks"),
        ("property double x", "property triple x", "mesh.line"),
        ("property double y", "property double x", "mesh.line"),
        ("property double x", "property", "mesh.line"),
        ("property list uchar int", "property list float int", "mesh.line"),
        ("vertex_indices", "vertices", "mesh.header-lacks"),
        ("element face 5", "element face -5", "mesh.line"),
        ("element face 5", "element face 5.0", "mesh.line"),
        ("element face 5", "element face " + "9" * 400, "mesh.line"),
        ("element face 5", "element vertex 5", "mesh.line"),
        ("element face", "elephant face", "mesh.line"),
        ("format ascii 1.0", "format binary 1.0", "mesh.line"),
        ("format ascii 1.0", "comment none", "mesh.line"),
        ("end_header", "end_heading", "mesh.header-end"),
        ("3 0 1 4\n", "3 0 1\n", "mesh.line"),
        ("3 0 1 4\n", "3 0 1 4 4\n", "mesh.line"),
        ("3 0 1 4\n", "-3 0 1 4\n", "mesh.line"),
        ("3 0 1 4\n", "3 0 1 4.5\n", "mesh.line"),
        ("3 0 1 4\n", "3 0 1 nan\n", "mesh.line"),
        ("3 0 1 4\n", "3.5 0 1 4\n", "mesh.line"),
        ("3 0 1 4\n", "99999999999999999999 0 1 4\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1,0 1,0 1,5\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0 1.01.5\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0 1.0-1.5\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0 1.0-1.5 2.0\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0 1_0 1.5\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0 0x10 1.5\n", "mesh.line"),
        ("1.0 1.0 1.5\n", "1.0\x001.0 1.5\n", "mesh.control"),
    ],
)
def test_damage_is_refused_with_its_place(tmp_path: Path, old: str, new: str, message: str) -> None:
    text = simple_ply("ascii").decode()
    assert old in text
    damaged = text.replace(old, new, 1)
    error = refused(tmp_path, damaged.encode())
    assert error.message == message
    if message == "mesh.line":
        line = next(
            n for n, (a, b) in enumerate(zip(text.splitlines(), damaged.splitlines(), strict=True), 1) if a != b
        )
        # What comes before the format is understood only with it.
        assert error.fields["line"] == (line if "none" not in new else line + 1)


def test_cloud_of_points(tmp_path: Path) -> None:
    for faces in ([], None):
        elements = [("vertex", ["float x", "float y", "float z"], POINTS)]
        elements += [] if faces is None else [("face", ["list uchar int vertex_indices"], [])]
        for form in ORDERS:
            error = refused(tmp_path, ply(form, elements))
            assert (error.message, error.fields["value"]) == ("mesh.no-surface", 5)


def test_bounds(tmp_path: Path) -> None:
    for form in ORDERS:
        assert refused(tmp_path, simple_ply(form), faces=4).message in ("mesh.too-many-faces", "mesh.too-many-vertices")
        assert read(tmp_path, simple_ply(form), faces=5).faces == 5
        strip = ply(
            form,
            [
                ("vertex", ["float x", "float y", "float z"], POINTS[:3]),
                ("tristrips", ["list int int vertex_indices"], [((0, 1, 2, 0, 1, 2),)]),
            ],
        )
        assert refused(tmp_path, strip, faces=3).message == "mesh.too-many-faces"
        assert read(tmp_path, strip, faces=4).faces == 4
    assert refused(tmp_path, simple_ply(), bytes=100).message == "read.too-large"


def test_a_header_is_no_longer_than_a_mebibyte(tmp_path: Path) -> None:
    assert sound(read(tmp_path, long_header(1000)))
    assert refused(tmp_path, long_header(1100)).message == "mesh.header-end"


def long_header(lines: int) -> bytes:
    """With so many comments of a thousand bytes."""
    comments = b"".join(b"comment " + b"x" * 991 + b"\n" for _ in range(lines))
    return simple_ply().replace(b"end_header", comments + b"end_header")


@pytest.mark.parametrize("form", ORDERS)
def test_strips_that_are_announced_and_not_there_change_nothing(tmp_path: Path, form: str) -> None:
    vertices = ("vertex", [f"double {axis}" for axis in "xyz"], POINTS)
    faces = ("face", ["list uchar int vertex_indices"], [(tuple(face),) for face in FACES])
    strips = ("tristrips", ["uchar colour", "list int int vertex_indices"], [])
    mesh = read(tmp_path, ply(form, [vertices, strips, faces]))
    assert (places_of(mesh), faces_of(mesh)) == (list(POINTS), [list(face) for face in FACES])


@pytest.mark.parametrize("form", ORDERS)
def test_numbers_of_vertices_may_be_written_as_reals_that_are_whole(tmp_path: Path, form: str) -> None:
    assert faces_of(read(tmp_path, simple_ply(form, whole="float"))) == [list(face) for face in FACES]
    assert refused(tmp_path, simple_ply(form, whole="float", faces=[(0, 1, 1.5)])).message == "mesh.index"
