# SPDX-License-Identifier: MIT
"""STL: binary and text are told apart by what they hold, and every corner is a vertex."""

import struct
from pathlib import Path

import numpy as np
import pytest
from tests.read.mesh.files import POINTS, TRIANGLES, faces_of, places_of, read, refused, sound, stl_binary, stl_text

CORNERS = [POINTS[vertex] for face in TRIANGLES for vertex in face]
EVERY_THREE = [[3 * n, 3 * n + 1, 3 * n + 2] for n in range(len(TRIANGLES))]


@pytest.mark.parametrize(
    "head", [b"", b"solid obra", b"solid \nfacet normal 0 0 1\nouter loop", b"ply\nformat", b"PK\x03\x04", b"{"]
)
def test_binary_whatever_its_header_says(tmp_path: Path, head: bytes) -> None:
    mesh = read(tmp_path, stl_binary(head=head))
    assert (places_of(mesh), faces_of(mesh)) == (CORNERS, EVERY_THREE)
    assert (mesh.reading.version, mesh.groups, mesh.reading.repairs) == ("STL binary", ("",), ())
    assert sound(mesh)


def test_single_precision_is_widened_exactly(tmp_path: Path) -> None:
    points = [(712345.678, 0.1, 1e-42), (np.nan, np.inf, -np.inf), (1.0, 2.0, 3.0)]
    mesh = read(tmp_path, stl_binary(points, [(0, 1, 2)]))
    np.testing.assert_array_equal(mesh.points, [struct.unpack("<3f", struct.pack("<3f", *point)) for point in points])


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize(
    "change", [str, str.upper, lambda text: text.replace("  ", ""), lambda text: text.replace("\n", "\n\n\t")]
)
def test_text(tmp_path: Path, end: str, change) -> None:  # noqa: ANN001
    data = change(stl_text().decode()).replace("\n", end).encode()
    mesh = read(tmp_path, data)
    assert (places_of(mesh), faces_of(mesh)) == (CORNERS, EVERY_THREE)
    assert (mesh.reading.version, [name.lower() for name in mesh.groups]) == ("STL ascii", ["obra"])
    assert sound(mesh)


def test_each_solid_is_a_group(tmp_path: Path) -> None:
    data = (
        stl_text(faces=TRIANGLES[:2], name="torre norte") + stl_text(faces=[], name="") + stl_text(faces=TRIANGLES[2:])
    )
    mesh = read(tmp_path, data)
    assert mesh.groups == ("torre norte", "", "obra")
    assert mesh.group.tolist() == [0, 0, 2, 2, 2, 2]


def test_a_loop_of_other_than_three_corners_stays(tmp_path: Path) -> None:
    lines = stl_text(faces=TRIANGLES[:2]).decode().split("\n")
    vertex = lines[3]
    quad = "\n".join([*lines[:3], vertex, *lines[3:]])
    assert [len(face) for face in faces_of(read(tmp_path, quad.encode()))] == [4, 3]
    edge = "\n".join([*lines[:3], *lines[4:]])
    assert [len(face) for face in faces_of(read(tmp_path, edge.encode()))] == [2, 3]


@pytest.mark.parametrize("count", [2, 5, 7, 1000, 4_000_000_000])
@pytest.mark.parametrize("head", [b"", b"solid x"])
def test_a_false_count_is_refused(tmp_path: Path, count: int, head: bytes) -> None:
    error = refused(tmp_path, stl_binary(head=head, count=count), "mesh.stl")
    assert (error.message, error.fields["value"], error.fields["other"]) == ("mesh.stl-count", count, 6)


def test_some_bytes_behind_the_last_facet(tmp_path: Path) -> None:
    data = stl_binary()
    mesh = read(tmp_path, data + b"\0" * 49, "mesh.STL")
    assert [(one.code, one.text, one.loses) for one in mesh.reading.repairs] == [("mesh-trailing-bytes", "49", False)]
    assert mesh.faces == 6
    assert refused(tmp_path, data + b"\0" * 50, "mesh.stl").message == "mesh.stl-count"


def test_every_cut_is_noticed(tmp_path: Path) -> None:
    data = stl_binary()
    for length in range(1, len(data)):
        refused(tmp_path, data[:length], "mesh.stl")
    # A name that is cut off is a name.
    text = stl_text()
    for length in range(1, text.index(b"endsolid") + 8):
        refused(tmp_path, text[:length])


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("vertex 2.0", "vertex 2,0", 5),
        ("vertex 2.0", "vertice 2.0", 5),
        ("vertex 2.0", "vertex 0 2.0", 5),
        ("    endloop\n", "", 7),
        ("    outer loop\n", "", 3),
        ("  endfacet\n", "", 8),
        ("solid obra\n", "solid obra\nnonsense\n", 2),
        ("endsolid", "endsolids", 44),
        ("  endfacet\n", "  endfacet\nvertex 0 0 0\n", 9),
    ],
)
def test_a_line_that_does_not_fit(tmp_path: Path, old: str, new: str, line: int) -> None:
    text = stl_text().decode()
    assert old in text
    error = refused(tmp_path, text.replace(old, new, 1).encode())
    assert (error.message, error.fields["line"]) == ("mesh.line", line)


def test_no_facet(tmp_path: Path) -> None:
    for data in (stl_binary(faces=[]), stl_text(faces=[])):
        assert refused(tmp_path, data).message == "mesh.no-surface"


def test_bounds(tmp_path: Path) -> None:
    for data in (stl_binary(), stl_text()):
        assert refused(tmp_path, data, faces=5).message == "mesh.too-many-faces"
        assert read(tmp_path, data, faces=6).faces == 6
