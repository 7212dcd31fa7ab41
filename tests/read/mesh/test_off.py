# SPDX-License-Identifier: MIT
"""OFF and its kinds."""

from pathlib import Path

import pytest
from tests.read.mesh.files import FACES, POINTS, faces_of, off, places_of, read, refused, sound

POLYGONS = [list(face) for face in FACES]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize(
    "change",
    [
        str,
        lambda text: text.replace("OFF\n5", "OFF 5"),
        lambda text: "# made by hand\n\n" + text,
        lambda text: text.replace("OFF\n", "OFF # a comment\n# another\n\n"),
        lambda text: text.replace("5 5 0", "5 5"),
        lambda text: text.replace("2.0 0.0 0.0", "# between\n\n  2.0\t0.0 0.0  # behind"),
    ],
)
def test_forms(tmp_path: Path, end: str, change) -> None:  # noqa: ANN001
    mesh = read(tmp_path, change(off().decode()).replace("\n", end).encode())
    assert (places_of(mesh), faces_of(mesh), mesh.reading.version) == (list(POINTS), POLYGONS, "OFF")
    assert sound(mesh)


@pytest.mark.parametrize(
    ("keyword", "more"),
    [
        ("COFF", " 255 0 128 255"),
        ("COFF", " 0.5 0.25 1"),
        ("NOFF", " 0 0 1"),
        ("CNOFF", " 0 0 1 9 9 9 9"),
        ("STOFF", " 0.25 0.5"),
        ("STCNOFF", " 0 0 1 9 9 9 0.25 0.5"),
    ],
)
def test_kinds(tmp_path: Path, keyword: str, more: str) -> None:
    lines = off().decode().splitlines()
    lines[0] = keyword
    lines[2:7] = [line + more for line in lines[2:7]]
    mesh = read(tmp_path, "\n".join(lines).encode())
    assert (places_of(mesh), faces_of(mesh), mesh.reading.version) == (list(POINTS), POLYGONS, keyword)
    if keyword.startswith("ST"):
        assert mesh.texture is not None
        assert mesh.texture.uv.tolist() == [[0.25, 0.5]] * 5
        assert mesh.texture.corner.tolist() == mesh.corners.tolist()
    assert sound(mesh)


@pytest.mark.parametrize("colour", [" 3", " 255 0 0", " 0.5 0.5 0.5 1"])
def test_colours_of_faces(tmp_path: Path, colour: str) -> None:
    text = off().decode().replace("3 0 1 4\n", f"3 0 1 4{colour}\n")
    assert faces_of(read(tmp_path, text.encode())) == POLYGONS


def test_faulty_faces_stay(tmp_path: Path) -> None:
    faces = [(), (0,), (0, 0, 1), (-1, 0, 99)]
    assert faces_of(read(tmp_path, off(faces=faces))) == [list(face) for face in faces]


@pytest.mark.parametrize(
    ("old", "new", "message", "line"),
    [
        ("OFF\n", "OFF BINARY\n", "mesh.off-kind", 0),
        ("OFF\n", "4OFF\n", "mesh.off-kind", 0),
        ("OFF\n", "nOFF\n3\n", "mesh.off-kind", 0),
        ("5 5 0", "5 -5 0", "mesh.line", 2),
        ("5 5 0", "cinco", "mesh.line", 2),
        ("5 5 0", "6 5 0", "mesh.line", 8),
        ("5 5 0", "4 5 0", "mesh.too-long", 12),
        ("5 5 0", "5 6 0", "mesh.rows-missing", 0),
        ("5 5 0", "5 4 0", "mesh.too-long", 12),
        ("5 5 0", "5 9999999999 0", "mesh.cut-off", 0),
        ("5 5 0", "1000000000000 5 0", "mesh.cut-off", 0),
        ("3 0 1 4", "3 0 1", "mesh.line", 9),
        ("3 0 1 4", "3 0 1 x", "mesh.line", 9),
        ("3 0 1 4", "3 0 1 4 5 6", "mesh.line", 9),
        ("3 0 1 4", "3 0 1 4.5", "mesh.line", 9),
        ("3 0 1 4", "-3 0 1 4", "mesh.line", 9),
        ("3 0 1 4", "nan 0 1 4", "mesh.line", 9),
        ("1.0 1.0 1.5", "1,0 1,0 1,5", "mesh.line", 7),
        ("1.0 1.0 1.5", "1.0 1.0", "mesh.line", 7),
    ],
)
def test_damage_is_refused_with_its_place(tmp_path: Path, old: str, new: str, message: str, line: int) -> None:
    text = off().decode()
    assert old in text
    error = refused(tmp_path, text.replace(old, new, 1).encode())
    assert (error.message, error.fields.get("line", 0)) == (message, line)


def test_every_cut_is_noticed(tmp_path: Path) -> None:
    data = off()
    for length in range(1, len(data) - 2):
        refused(tmp_path, data[:length])


def test_bounds(tmp_path: Path) -> None:
    assert refused(tmp_path, off(), faces=4).message == "mesh.too-many-vertices"
    assert read(tmp_path, off(), faces=5).faces == 5
    assert refused(tmp_path, off(faces=[])).message == "mesh.no-surface"
