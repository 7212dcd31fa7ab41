# SPDX-License-Identifier: MIT
"""Meshes from the file to the exit code and the reports, as a person runs them."""

import json
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from tests.cli.conftest import Command
from tests.mesh.made import GEOREFERENCED, sphere

Triple = tuple[float, float, float]


def obj(path: Path, points: Iterable[Iterable[float]], faces: Iterable[Iterable[int]]) -> Path:
    """Write an OBJ, whose vertices are counted from 1."""
    lines = [f"v {' '.join(repr(float(value)) for value in point)}" for point in points]
    lines += [f"f {' '.join(str(corner + 1) for corner in face)}" for face in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path


def ball(*, without: int = 0, shift: Triple = (0, 0, 0)) -> tuple[np.ndarray, np.ndarray]:
    made = sphere(2)
    return made.points + shift, made.corners.reshape(-1, 3)[without:]


def manifest(folder: Path, *meshes: str, profile: str = "et-doc-foparq-b") -> Path:
    tables = "\n".join(f"[[mesh]]\n{text}\n" for text in meshes)
    (folder / "delivery.toml").write_text(
        f'[delivery]\ntitle = "Busto"\nprofile = "{profile}"\nscale = "1:10"\n{tables}', encoding="utf-8"
    )
    return folder


def audited(folder: Path) -> dict[str, object]:
    read: dict[str, object] = json.loads((folder / "audit" / "audit.json").read_text("utf-8"))
    return read


def test_a_sound_closed_mesh_has_no_fault(foparq: Command, tmp_path: Path) -> None:
    code, out, _ = foparq("check", obj(tmp_path / "bola.obj", *ball()), "--unit", "m", "--closed")
    assert (code, out.splitlines()[0]) == (0, "No fault found; notes: 0.")


def test_nothing_is_concluded_on_an_open_mesh_of_which_nobody_says_that_it_should_be(
    foparq: Command, tmp_path: Path
) -> None:
    file = obj(tmp_path / "bola.obj", *ball(without=1))
    code, out, _ = foparq("check", file, "--unit", "m")
    assert code == 3
    assert "--open" in out
    assert foparq("check", file, "--unit", "m", "--open")[0] == 0
    code, out, _ = foparq("check", file, "--unit", "m", "--closed")
    assert code == 1
    assert "MSH011 hole" in out


def test_a_closed_surface_with_rims_is_a_contradiction(foparq: Command, tmp_path: Path) -> None:
    code, _, err = foparq("check", obj(tmp_path / "bola.obj", *ball()), "--closed", "--rims", "2")
    assert code == 2
    assert "--rims 2" in err
    obj(tmp_path / "busto.obj", *ball())
    manifest(tmp_path, 'path = "busto.obj"\nclosed = true\nrims = 2')
    code, _, err = foparq("audit", tmp_path)
    assert code == 2
    assert "rims" in err


def test_a_georeferenced_mesh_loses_nothing(foparq: Command, tmp_path: Path) -> None:
    points, faces = ball(without=1, shift=GEOREFERENCED)
    code, out, _ = foparq(
        "check", obj(tmp_path / "bola.obj", points, faces), "--unit", "m", "--closed", "--format", "jsonl"
    )
    (finding,) = (json.loads(line) for line in out.splitlines())
    first = sphere(2).corners[:3]
    assert (code, finding["name"]) == (1, "hole")
    # The place is a vertex of the loop: that of least x, then y, then z.
    loop = sphere(2).points[first] + GEOREFERENCED
    assert finding["where"] == pytest.approx(loop[np.lexsort(loop.T[::-1])[0]], abs=1e-6)


def test_no_scale_is_needed_where_no_drawing_is_checked(foparq: Command, tmp_path: Path) -> None:
    file = obj(tmp_path / "bola.obj", *ball())
    assert foparq("check", file, "--closed", "--unit", "m")[0] == 0
    drawing = tmp_path / "fachada.dxf"
    drawing.write_text("0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", encoding="ascii")
    code, _, err = foparq("check", file, drawing, "--closed")
    assert code == 2
    assert "--scale" in err


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_what_a_length_means_is_left_open_where_nobody_states_the_unit(
    foparq: Command, tmp_path: Path, language: str
) -> None:
    code, out, _ = foparq("check", obj(tmp_path / "bola.obj", *ball()), "--closed", "--lang", language)
    assert code == 3
    assert "--unit" in out
    assert "t-junction" in out
    assert not re.search("drawing|desenho", out)


def test_a_delivery_of_one_mesh_is_audited_and_drawings_are_not_asked_for(foparq: Command, tmp_path: Path) -> None:
    obj(tmp_path / "busto.obj", *ball(without=1))
    manifest(tmp_path, 'path = "busto.obj"\nunit = "m"\nclosed = false')
    code, out, _ = foparq("audit", tmp_path)
    record = audited(tmp_path)
    elements = {one["id"]: one for one in record["elements"]}  # type: ignore[attr-defined]
    assert (elements["Q3-mesh"]["status"], elements["Q3-mesh"]["value"]) == ("pass", 0.0)
    assert elements["Q3-mesh"]["n"] == 319
    assert elements["Q3"]["status"] == "not-applicable"
    # No list of features was delivered: what is not shown is not accepted.
    assert (code, record["verdict"]) == (3, "undecided")
    assert [(one["path"], one["role"], one["items"]) for one in record["inputs"]] == [  # type: ignore[attr-defined]
        ("delivery.toml", "manifest", 1), ("busto.obj", "mesh", 319),
    ]  # fmt: skip
    assert "Q3-mesh" in out


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_every_report_of_a_faulty_mesh_is_written(foparq: Command, tmp_path: Path, language: str) -> None:
    points, faces = ball(without=1)
    # The copy lies beside the opening: two of its edges have three sides then, the third is still the opening's.
    obj(tmp_path / "busto.obj", points, [*faces, faces[0], (0, 1, 999)])
    manifest(tmp_path, 'path = "busto.obj"\nunit = "m"\nclosed = true')
    foparq("audit", tmp_path, "--lang", language)
    record = audited(tmp_path)
    assert record["findings"]["by_name"] == {  # type: ignore[index]
        "bad-index": 1, "duplicate-face": 1, "hole": 1, "non-manifold-edge": 2,
    }  # fmt: skip
    assert record["crashed"] == []
    written = {path.name for path in (tmp_path / "audit").iterdir()}
    assert written == {"audit.json", "findings.gpkg", "findings.jsonl", "quality.xml", "report.html"}
    page = (tmp_path / "audit" / "report.html").read_text("utf-8")
    for code in ("MSH001", "MSH011", "MSH012", "MSH021"):
        assert code in page


def test_a_mesh_under_drawing_and_a_mesh_named_twice_are_told(foparq: Command, tmp_path: Path) -> None:
    obj(tmp_path / "busto.obj", *ball())
    manifest(tmp_path, 'path = "busto.obj"', 'path = "busto.obj"')
    code, _, err = foparq("audit", tmp_path)
    assert code == 2
    assert "busto.obj" in err


def test_a_mesh_that_is_not_there_leaves_everything_open(foparq: Command, tmp_path: Path) -> None:
    manifest(tmp_path, 'path = "busto.obj"\nclosed = false')
    code, out, _ = foparq("audit", tmp_path)
    assert code == 4
    assert "busto.obj" in out


def test_init_proposes_the_mesh_with_its_size(foparq: Command, tmp_path: Path) -> None:
    obj(tmp_path / "busto.obj", *ball())
    assert foparq("init", tmp_path)[0] == 0
    text = (tmp_path / "delivery.toml").read_text("utf-8")
    assert '[[mesh]]\npath = "busto.obj"\n# 320 faces; extent 2.000 by 2.000 by 2.000 units of the file\n' in text
    assert "# closed = false" in text


def test_the_order_of_faces_and_vertices_changes_no_finding(foparq: Command, tmp_path: Path) -> None:
    points, faces = ball(without=3)
    shuffle = np.random.default_rng(5)
    order = shuffle.permutation(len(points))
    back = np.argsort(order)
    one = obj(tmp_path / "a.obj", points, faces)
    two = obj(tmp_path / "b.obj", points[order], shuffle.permutation(back[faces]))
    keys = []
    for file in (one, two):
        _, out, _ = foparq("check", file, "--unit", "m", "--closed", "--format", "jsonl")
        keys.append(sorted(json.loads(line)["key"] for line in out.splitlines()))
    assert keys[0] == keys[1]
    assert len(keys[0]) >= 1


@pytest.mark.parametrize(("language", "said"), [("en", "once on this machine"), ("pt-BR", "uma só vez nesta máquina")])
def test_compiling_is_announced_where_it_takes_seconds(
    foparq: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, language: str, said: str
) -> None:
    path = obj(tmp_path / "bola.obj", *ball())
    arguments = ("check", path, "--unit", "m", "--closed", "--lang", language)
    assert foparq(*arguments)[2] == ""
    monkeypatch.setattr("foparq.mesh.warm.cold", lambda: True)
    code, _, err = foparq(*arguments)
    assert (code, err.count(said), err.count("\n")) == (0, 1, 1)
