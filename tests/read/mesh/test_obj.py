# SPDX-License-Identifier: MIT
"""OBJ: vertices and texture coordinates are counted apart, and faces say where they stand."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.read.mesh.files import FACES, POINTS, faces_of, obj, places_of, read, refused, sound

from foparq.errors import UnreadableError
from foparq.model.drawing import SkippedReason
from foparq.read.mesh import text as text_module

VERTICES = "".join(f"v {x} {y} {z}\n" for x, y, z in POINTS)
POLYGONS = [list(face) for face in FACES]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_polygons(tmp_path: Path, end: str) -> None:
    mesh = read(tmp_path, obj(end=end))
    assert (places_of(mesh), faces_of(mesh)) == (list(POINTS), POLYGONS)
    assert (mesh.reading.version, mesh.reading.first, mesh.groups, mesh.texture) == ("OBJ", 1, ("",), None)
    assert sound(mesh)


def test_vertices_with_a_weight_or_a_colour(tmp_path: Path) -> None:
    lines = [
        "v 0 1 2",
        "v 0 1 2 1",
        "v 0 1 2 0.5 0.5 0.5",
        "v 0 1 2 1.0 0.5 0.5 0.5",
        "  v\t0 1\t2  # note",
        "v 1.#QNAN -1.#IND 1.#INF",
    ]
    mesh = read(tmp_path, ("\n".join(lines) + "\nf 1 2 3\n").encode())
    assert places_of(mesh)[:5] == [(0.0, 1.0, 2.0)] * 5
    assert str(mesh.points[5].tolist()) == "[nan, nan, inf]"


@pytest.mark.parametrize(
    ("corner", "textured"),
    [
        ("{0}", False),
        ("{0}/", False),
        ("{0}//", False),
        ("{0}//7", False),
        ("{0}/{1}", True),
        ("{0}/{1}/", True),
        ("{0}/{1}/7", True),
    ],
)
def test_forms_of_corners(tmp_path: Path, corner: str, textured: bool) -> None:  # noqa: FBT001
    texture = "vt 0.25 0.5\nvt 0.75\nvt 1 0 0\n"
    face = " ".join(corner.format(a, b) for a, b in ((1, 3), (2, 2), (5, 1)))
    mesh = read(tmp_path, f"{VERTICES}{texture}vn 0 0 1\nf {face}\n".encode())
    assert faces_of(mesh) == [[0, 1, 4]]
    assert mesh.texture is not None
    assert mesh.texture.uv.tolist() == [[0.25, 0.5], [0.75, 0.0], [1.0, 0.0]]
    assert mesh.texture.corner.tolist() == ([2, 1, 0] if textured else [-1, -1, -1])


def test_mixed_forms_in_one_line(tmp_path: Path) -> None:
    data = f"{VERTICES}vt 0 0\nvt 1 1\nf 1/2/9 2//9 3 4/1 # 5/5\n".encode()
    mesh = read(tmp_path, data)
    assert faces_of(mesh) == [[0, 1, 2, 3]]
    assert mesh.texture is not None
    assert mesh.texture.corner.tolist() == [1, -1, -1, 0]


@given(
    st.lists(
        st.lists(st.tuples(st.integers(-9, 9), st.one_of(st.none(), st.integers(-9, 9)), st.booleans()), max_size=5),
        min_size=1,
        max_size=8,
    ),
    st.randoms(use_true_random=False),
)
def test_against_a_plain_reading(tmp_path_factory: pytest.TempPathFactory, faces, rng) -> None:  # noqa: ANN001
    lines, vertices, uvs, expected, expected_uv = ["vt 0 0", "v 0 0 0"], 1, 1, [], []
    for face in faces:
        for _ in range(rng.randrange(3)):
            lines.append(f"v {vertices} 0 0")
            vertices += 1
        if rng.random() < 0.5:
            lines.append(f"vt {uvs} 0")
            uvs += 1
        words = []
        expected.append([v - 1 if v >= 0 else vertices + v for v, _, _ in face])
        for v, t, normal in face:
            words.append(f"{v}{'' if t is None else f'/{t}'}" + (("//3" if t is None else "/3") if normal else ""))
            expected_uv.append(None if not t else (t - 1 if t > 0 else uvs + t))
        lines.append("f " + " ".join(words))
    mesh = read(tmp_path_factory.getbasetemp(), "\n".join(lines).encode())
    assert faces_of(mesh) == expected
    assert mesh.texture is not None
    assert mesh.texture.corner.tolist() == [-1 if t is None or not 0 <= t < uvs else t for t in expected_uv]
    outside = sum(t is not None and not 0 <= t < uvs for t in expected_uv)
    assert [one.text for one in mesh.reading.repairs] == ([str(outside)] if outside else [])
    assert sound(mesh)


def test_numbers_outside_stay_outside(tmp_path: Path) -> None:
    data = (
        VERTICES + "f 0 1 2\nf 6 1 2\nf -6 1 2\nf 99999999999999999999 1 2\nf -99999999999999999999 1 -0\nf\nf 1\n"
    ).encode()
    mesh = read(tmp_path, data)
    faces = faces_of(mesh)
    assert faces[:3] == [[-1, 0, 1], [5, 0, 1], [-1, 0, 1]]
    assert not 0 <= faces[3][0] < 5
    assert not 0 <= faces[4][0] < 5
    assert (faces[4][2], faces[5], faces[6]) == (-1, [], [0])


def test_a_face_may_name_vertices_that_come_later(tmp_path: Path) -> None:
    assert faces_of(read(tmp_path, f"f 1 2 3\n{VERTICES}f -1 -2 -3\n".encode())) == [[0, 1, 2], [4, 3, 2]]


def test_an_older_word_for_a_face(tmp_path: Path) -> None:
    assert faces_of(read(tmp_path, f"{VERTICES}fo 1 2 3\nf 2 3 4\nfo\n".encode())) == [[0, 1, 2], [1, 2, 3], []]


@pytest.mark.parametrize("letter", ["\0", "\x01", "\x0f", "\x1a", "\x1f"])
def test_control_characters(tmp_path: Path, letter: str) -> None:
    for text in (f"f{letter}1 2 3", f"f 1{letter}2 3", f"v 1{letter}2 3", f"g{letter}a"):
        data = f"{VERTICES}{text}\nf 1 2 3\n".encode()
        error = refused(tmp_path, data)
        assert error.message == ("mesh.unknown-format" if letter == "\0" else "mesh.control")
    # As DOS ended its files.
    assert read(tmp_path, obj() + b"\x1a").faces == 5


def test_lines_that_go_on(tmp_path: Path) -> None:
    for end in ("\n", "\r\n"):
        data = f"v 0 0 \\\n 0\n{VERTICES}f 1 \\\n2\\\n 3\nf 1 2 3 4 x\n".replace("\n", end).encode()
        error = refused(tmp_path, data)
        assert (error.fields["line"], error.fields["value"]) == (11, "f 1 2 3 4 x")
        mesh = read(tmp_path, data.replace(b" x", b""))
        assert faces_of(mesh) == [[0, 1, 2], [0, 1, 2, 3]]
        assert places_of(mesh)[0] == (0.0, 0.0, 0.0)


def test_groups_and_materials(tmp_path: Path) -> None:
    data = (
        f"{VERTICES}vt 0 0\nf 1 2 3\no torre\nusemtl pedra\nf 1 2 3\ng sino  norte\nf 1 2 3\nusemtl cal\n"
        "g torre\nf 1 2 3\ng\nf 1 2 3\n"
    )
    mesh = read(tmp_path, data.encode())
    assert [mesh.groups[row] for row in mesh.group] == ["", "torre", "sino norte", "torre", ""]
    assert mesh.texture is not None
    assert [mesh.texture.materials[row][0] if row >= 0 else None for row in mesh.texture.material] == [
        None,
        "pedra",
        "pedra",
        "cal",
        "cal",
    ]


def test_pieces_make_no_difference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = (
        f"mtllib a.mtl\n{VERTICES}vt 0 0\nvt 1 1\ng a\nusemtl m\nf 1/1 2/2 3\nf -1 \\\n-2 -3\n\n# c\nl 1 2\ng b\n"
        f"{VERTICES}vt 0 0\nf -1/-1 -2 \\\r\n -3/1\nusemtl n\nf 1 2 3 4\n"
    ).encode()
    whole = read(tmp_path, data)
    for size in (*range(1, 60), 100):
        monkeypatch.setattr(text_module, "PIECE", size)
        mesh = read(tmp_path, data)
        for name in ("points", "corners", "starts", "group"):
            assert getattr(mesh, name).tolist() == getattr(whole, name).tolist()
        assert (mesh.groups, mesh.reading) == (whole.groups, whole.reading)
        assert mesh.texture is not None
        assert whole.texture is not None
        assert mesh.texture.corner.tolist() == whole.texture.corner.tolist()
        assert mesh.texture.material.tolist() == whole.texture.material.tolist()


def test_images_of_materials(tmp_path: Path) -> None:
    (tmp_path / "materiais da torre.mtl").write_text(
        "# made by hand\nnewmtl pedra\nKd 1 1 1\nmap_Kd -s 2 2 2 -clamp on fotos\\parede norte.jpg\nnewmtl cal\n"
        "  map_Kd cal.png\nnewmtl vidro\nmap_d x.png\n",
        encoding="utf-8",
    )
    data = f"mtllib materiais da torre.mtl\n{VERTICES}"
    data += "".join(f"usemtl {name}\nf 1 2 3\n" for name in ("vidro", "pedra", "falta"))
    mesh = read(tmp_path, data.encode())
    assert mesh.texture is not None
    assert mesh.texture.materials == (("vidro", ""), ("pedra", "fotos\\parede norte.jpg"), ("falta", ""))
    assert mesh.reading.images == ("fotos\\parede norte.jpg",)
    assert mesh.reading.skipped == ()


@pytest.mark.parametrize(
    "named",
    ["../fora.mtl", "/etc/passwd", "http://example.org/a.mtl", "nenhum.mtl", "fila.mtl", "pasta", "", "a" * 5000],
)
def test_libraries_that_are_not_opened(tmp_path: Path, named: str) -> None:
    (tmp_path / "fora.mtl").write_text("newmtl m\nmap_Kd secret.png\n", encoding="utf-8")
    folder = tmp_path / "entrega"
    (folder / "pasta").mkdir(parents=True)
    os.mkfifo(folder / "fila.mtl")
    mesh = read(folder, f"mtllib {named}\n{VERTICES}usemtl m\nf 1 2 3\n".encode())
    (skipped,) = mesh.reading.skipped
    assert (skipped.reason, skipped.name, skipped.reason.opens) == (SkippedReason.MATERIALS, named, False)
    assert mesh.reading.images == ()


def test_several_libraries(tmp_path: Path) -> None:
    (tmp_path / "a.mtl").write_text("newmtl m  1\nmap_Kd a.png\n", encoding="utf-8")
    (tmp_path / "b.mtl").write_text("newmtl m 1\nmap_Kd other.png\nnewmtl n\nmap_Kd b.png\n", encoding="utf-8")
    data = f"mtllib a.mtl b.mtl\nmtllib a.mtl c.mtl\n{VERTICES}usemtl m 1\nf 1 2 3\nusemtl n\nf 1 2 3\n"
    mesh = read(tmp_path, data.encode())
    assert mesh.texture is not None
    assert mesh.texture.materials == (("m 1", "a.png"), ("n", "b.png"))
    assert [one.name for one in mesh.reading.skipped] == ["a.mtl c.mtl"]
    many = "".join(f"mtllib {n}.mtl\n" for n in range(1000))
    skipped = read(tmp_path, f"{many}{VERTICES}f 1 2 3\n".encode()).reading.skipped
    assert sum(one.count for one in skipped) == 1000


def test_texture_coordinates_that_are_not_there_are_told(tmp_path: Path) -> None:
    mesh = read(tmp_path, f"{VERTICES}f 1/1 2/2 3/0\n".encode())
    assert mesh.texture is not None
    assert mesh.texture.corner.tolist() == [-1, -1, -1]
    assert [one.text for one in mesh.reading.repairs] == ["2"]


def test_what_is_no_surface_is_told(tmp_path: Path) -> None:
    data = f"{VERTICES}p 1\nl 1 2\nl 1 2\ns off\nvp 1\ncurv 0 1 1 2\nxyz 7\nf 1 2 3\n"
    skipped = read(tmp_path, data.encode()).reading.skipped
    assert [(one.reason.value, one.kind, one.count, one.reason.opens) for one in skipped] == [
        ("lines-and-points", "p", 3, False),
        ("unknown-element", "curv", 1, True),
        ("unknown-element", "xyz", 1, True),
    ]


@pytest.mark.parametrize(
    "line",
    [
        "v 1 2",
        "v 1 2 3 4 5",
        "v 1 2 3 4 5 6 7 8",
        "v 1,0 2,0 3,0",
        "v 1 2 z",
        "v 1 2-3 4",
        "v",
        "v1 2 3",
        "vx 1 2 3",
        "vt",
        "vt a",
        "vt 0 0 0 0",
        "f 1 2 x",
        "f 1/2/3/4 2 3",
        "f 1.0 2 3",
        "f /1 2 3",
        "f 1/x 2/x 3/x",
        "f 1//-",
        "f1 2 3",
        "f 1 2 3_0",
        "f 1/1/1 2/2/2 //",
        "f 1 2 -",
        "f ١ 2 3",
    ],
)
def test_damage_is_refused_with_its_place(tmp_path: Path, line: str) -> None:
    data = f"{VERTICES}vt 0 0\n\nf 1/1 2/1 3/1\n{line}\nf 1 2 3\n"
    error = refused(tmp_path, data.encode())
    assert (error.message, error.fields["line"], error.fields["value"]) == ("mesh.line", 9, line)


def test_every_cut_is_read_or_refused(tmp_path: Path) -> None:
    data = (VERTICES + "vt 0 0\nf 1/1 2/1 3/1\n").encode() + obj()
    whole = faces_of(read(tmp_path, data))
    for length in range(len(data)):
        try:
            mesh = read(tmp_path, data[:length])
        except UnreadableError:
            continue
        # Nothing in an OBJ says how much it holds: what is there is read as it stands.
        assert faces_of(mesh)[:-1] == whole[: mesh.faces - 1]


def test_bounds(tmp_path: Path) -> None:
    assert refused(tmp_path, obj(), faces=4).message == "mesh.too-many-vertices"
    assert refused(tmp_path, obj() + b"f 1 2 3\n", faces=5).message == "mesh.too-many-faces"
    assert read(tmp_path, obj(), faces=5).faces == 5
    error = refused(tmp_path, VERTICES.encode())
    assert (error.message, error.fields["value"]) == ("mesh.no-surface", 5)
