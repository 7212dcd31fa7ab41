# SPDX-License-Identifier: MIT
"""What is stated of meshes, by manifest, profile or option, hides nothing; what nobody assessed is not passed off."""

import json
import re
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.attacks.mesh_deliveries import Answer, Meshes, deliver, sound_drawing
from tests.attacks.meshes import (
    ball,
    both,
    facade,
    open_above,
    shifted,
    triangles,
    with_faces,
    write_obj,
    write_ply,
    write_stl,
)
from tests.cli.conftest import Command, foparq  # noqa: F401 - a fixture
from tests.mesh.files import Mesh
from tests.mesh.made import sphere
from tests.read.mesh.gltf_files import pyramid

CELLS = [(i, j) for i in range(1, 20, 2) for j in range(1, 20, 2)]
OPENINGS = facade(21, 21, CELLS)
_PLY = b"ply\nformat binary_little_endian 1.0\n"


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sound_drawing(tmp_path_factory.mktemp("offices") / "office")


Audited = Callable[[Meshes], Answer]


@pytest.fixture
def audited(base: Path, tmp_path: Path) -> Audited:
    return lambda made: deliver(made, base, tmp_path / f"delivery-{next(iter(made.files))}")


def soup(of: Mesh) -> Mesh:
    """Every face with vertices of its own."""
    return Mesh(of.points[of.corners], np.arange(len(of.corners)), of.starts)


# --- profiles of one's own ----------------------------------------------------------------------------------------


def element(rules: list[str], *, limit: str = "10 %", required: bool = True) -> str:
    head = f'[[element]]\nid = "Q3-mesh"\nkind = "surface-rate"\nrequired = {str(required).lower()}\n'
    return f'{head}limit = "{limit}"\nrules = {json.dumps(rules)}\n'


LOOSER = {
    "a rule on groups that are not there": '[[check]]\nrule = "hole"\nlayers = ["NADA"]\nseverity = "major"\n',
    "a rule left out of the element": element(["bad-index"]),
    "another limit": element(["hole"], limit="100 %"),
    "not required": element(["hole"], required=False),
}


@pytest.mark.parametrize("own", LOOSER.values(), ids=LOOSER)
def test_a_profile_that_looks_away_is_named_first(own: str, audited: Audited) -> None:
    answer = audited(Meshes(files={"a": OPENINGS}, closed=False, own=own))
    assert answer.verdict != "rejected"  # the profile says so
    assert "it is looser:" in answer.sentences[0]


def test_an_element_without_rules_passes_nothing(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": OPENINGS}, closed=False, own=element([])))
    assert (answer.verdict, answer.state) == ("undecided", "not-assessed")


def test_two_shells_as_delivered_are_told_or_the_profile_is_named(audited: Audited) -> None:
    two = both(ball(20, 40), ball(20, 40))
    answer = audited(Meshes(files={"a": two}, closed=True, own='[mesh]\nweld = "none"\n'))
    assert answer.verdict != "accepted" or "it is looser:" in answer.sentences[0]


def test_openings_between_faces_that_share_no_vertex_are_told_or_the_profile_is_named(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": soup(OPENINGS)}, closed=False, own='[mesh]\nweld = "none"\n'))
    assert answer.verdict != "accepted" or "it is looser:" in answer.sentences[0]


def test_openings_between_faces_that_share_no_vertex_are_told_by_the_shipped_profile(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": soup(OPENINGS)}, closed=False))
    assert (answer.verdict, answer.found["hole"]) == ("rejected", len(CELLS))


# --- several meshes, other meshes ---------------------------------------------------------------------------------


@pytest.mark.parametrize("lost", [b"", _PLY, b"solid nothing\nendsolid nothing\n"], ids=["empty", "cut", "no face"])
def test_a_mesh_that_is_refused_beside_a_good_one_leaves_it_open(lost: bytes, audited: Audited) -> None:
    answer = audited(Meshes(files={"a": ball(20, 40), "b.ply": lost}, closed=True))
    assert (answer.verdict, answer.state) == ("undecided", "undecided")
    assert any("mesh-b.ply" in sentence for sentence in answer.sentences)


def test_a_mesh_that_is_refused_is_not_called_a_drawing(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": ball(20, 40), "b.ply": b""}, closed=True))
    assert not any("drawing" in said for said in answer.sentences if said.startswith("Q3-mesh"))


def test_a_bad_mesh_beside_a_good_one_and_a_good_drawing_rejects(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": ball(40, 80), "b": both(ball(10, 20), ball(10, 20))}, closed=True))
    assert (answer.verdict, answer.state) == ("rejected", "fail")


@pytest.mark.parametrize("facades", [("N", "S"), ()], ids=["facades", "names"])
def test_one_mesh_under_two_names_is_told(facades: tuple[str, ...], audited: Audited) -> None:
    of = facade(20, 20)
    answer = audited(Meshes(files={"a": of, "b": of}, closed=False, facades=facades))
    assert answer.verdict == "undecided"


def test_vertices_without_faces_and_an_empty_mesh_are_no_mesh(audited: Audited) -> None:
    none = Mesh(ball(20, 40).points, np.zeros(0, np.intp), np.zeros(1, np.intp))
    answer = audited(Meshes(files={"a": none}, closed=True))
    assert (answer.verdict, answer.state) == ("undecided", "not-assessed")


# --- what is not assessed -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("scale", "state"),
    [((1.05, 1.05, 1.05), "pass"), ((1000, 1000, 1000), "undecided"), ((1, 1, 1), "pass")],
    ids=["1.05", "mm", "right"],
)
def test_points_and_distances_of_a_mesh_alone_are_not_assessed(
    scale: tuple[float, float, float], state: str, audited: Audited
) -> None:
    answer = audited(Meshes(files={"a": shifted(ball(20, 40), scale=scale)}, closed=True, drawing=False))
    states = {of: str(answer.element(of).status) for of in ("Q1-X", "Q1-Y", "Q1-Z", "Q2", "Q4", "Q5", "Q6-X")}
    assert not {"pass", "reported"} & set(states.values()), states
    assert (answer.verdict, answer.state) == ("undecided", state)


@pytest.mark.parametrize("scale", [1.05, 1000.0], ids=["1.05", "mm"])
def test_a_mesh_of_another_size_beside_a_good_drawing_is_said_not_to_be_compared(
    scale: float, audited: Audited
) -> None:
    answer = audited(Meshes(files={"a": shifted(ball(20, 40), scale=scale)}, closed=True))
    said = [one for one in answer.sentences if "mesh-a.ply" in one and "faces are at fault" not in one]
    assert said


def test_areas_of_an_unknown_unit_are_not_called_metres(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": ball(20, 40)}, closed=True, unit=""))
    (said,) = [sentence for sentence in answer.sentences if "faces are at fault" in sentence]
    assert not re.search(r"m²", said)


def test_a_scene_in_metres_that_is_stated_in_millimetres_is_doubted(audited: Audited) -> None:
    made = pyramid([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    assert audited(Meshes(files={"a.glb": made.glb()}, closed=True, unit="m")).verdict == "accepted"
    assert audited(Meshes(files={"b.glb": made.glb()}, closed=True, unit="mm")).verdict == "undecided"


def test_a_tenth_of_a_ball_stated_open_is_told_with_its_rim(audited: Audited) -> None:
    answer = audited(Meshes(files={"a": open_above(ball(20, 40), -0.8)}, closed=False))
    assert any("rim" in sentence for sentence in answer.sentences)


def test_pairs_beyond_those_kept_are_not_passed_over(audited: Audited, monkeypatch: pytest.MonkeyPatch) -> None:
    """Triangles that all cross each other, before a surface that crosses another one: with room for a few pairs."""
    monkeypatch.setattr("foparq.mesh.topology._KEPT", 100)
    turn = np.pi * np.arange(40) / 40
    ends = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1) * 0.01
    aside = np.random.default_rng(1).uniform(-1e-5, 1e-5, ends.shape)
    points = np.concatenate([ends + aside, aside - ends, aside - ends + [0, 0, 0.002]]) - 5.0
    of = ball(40, 80)
    crossing = both(triangles(points, np.arange(120).reshape(3, -1).T), of, shifted(of, (0.5, 0.013, 0.027)))
    answer = audited(Meshes(files={"a": crossing}, closed=False))
    # Two balls cross along a circle: faces of both, at least as many as a ball has around.
    at_fault = {one.name: one for one in answer.done.record.outcomes}["surface-self-intersection"]
    assert len(at_fault.faulty) >= 40 + 80 or str(at_fault.status) not in {"clean", "faulty"}


def comb() -> tuple[list[tuple[int, int]], Mesh]:
    """A facade of 20 by 20 with one opening that is a comb: its border is longer than that of the facade."""
    cells = [(i, j) for i in range(2, 18) for j in range(2, 18) if j == 2 or i % 2 == 0]
    return cells, facade(20, 20, cells)


def test_a_ragged_opening_is_told_and_not_the_outline(audited: Audited) -> None:
    cells, of = comb()
    answer = audited(Meshes(files={"a": of}, closed=False))
    hole = {one.name: one for one in answer.done.record.outcomes}["hole"]
    assert (hole.found, hole.total) == (1, pytest.approx(len(cells)))


def test_a_copy_that_begins_at_another_corner_is_told_once(audited: Audited) -> None:
    of = facade(10, 10)
    answer = audited(Meshes(files={"a": with_faces(of, [face[1:] + face[:1] for face in of.lists()])}, closed=False))
    assert (answer.found["duplicate-face"], answer.found.get("coplanar-overlap", 0)) == (100, 0)


# --- options of the command ---------------------------------------------------------------------------------------


def test_a_rule_that_was_left_out_is_no_clean_one(foparq: Command, tmp_path: Path) -> None:  # noqa: F811
    of = sphere(2)
    file = write_obj(Mesh(of.points, of.corners[3:], of.starts[:-1]), tmp_path / "bola.obj")
    assert foparq("check", file, "--unit", "m", "--closed")[0] == 1
    code, out, _ = foparq("check", file, "--unit", "m", "--closed", "--ignore", "hole")
    assert "hole" not in out.splitlines()[0]
    assert code in {0, 1}
    code, out, _ = foparq("check", file, "--unit", "m", "--closed", "--select", "MSH013")
    assert "MSH011 hole" not in out


@pytest.mark.parametrize("name", ["a.ply", "a.obj", "a.stl", "a.glb", "a.off"])
def test_an_empty_file_is_refused(name: str, foparq: Command, tmp_path: Path) -> None:  # noqa: F811
    (tmp_path / name).write_bytes(b"")
    assert foparq("check", tmp_path / name, "--unit", "m")[0] == 4


def hostile() -> dict[str, tuple[bytes, int]]:
    """Files that lie of themselves, and what the command must answer."""
    axes = b"property float x\nproperty float y\nproperty float z\n"
    faces = b"property list uint int vertex_indices\nend_header\n"
    corners = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    three = _PLY + b"element vertex 3\n" + axes + b"element face 1\n" + faces + b"\0" * 36
    return {
        "zero.obj": (corners + b"f 0 1 2\nf 1 3 2\n", 1),
        "beyond.obj": (corners + b"f 1 2 99\nf 1 3 2\n", 1),
        "nan.obj": (b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1),
        "many.ply": (_PLY + b"element vertex 1000000000000\n" + axes + b"element face 1\n" + faces + b"\0" * 99, 4),
        "list.ply": (three + struct.pack("<I", 4 * 10**9), 4),
    }  # fmt: skip


@pytest.mark.parametrize("name", hostile())
def test_what_lies_of_itself_is_told_or_refused(name: str, foparq: Command, tmp_path: Path) -> None:  # noqa: F811
    content, code = hostile()[name]
    (tmp_path / name).write_bytes(content)
    assert foparq("check", tmp_path / name, "--unit", "m", "--open")[0] == code


@pytest.mark.parametrize("count", [0, 2, 4 * 10**9])
def test_a_false_number_of_facets_is_refused(count: int, foparq: Command, tmp_path: Path) -> None:  # noqa: F811
    file = write_stl(triangles(np.eye(3), [[0, 1, 2]] * 3), tmp_path / "a.stl")
    data = file.read_bytes()
    file.write_bytes(data[:80] + struct.pack("<I", count) + data[84:])
    assert foparq("check", file, "--unit", "m")[0] == 4


def test_a_file_that_is_cut_off_is_refused(foparq: Command, tmp_path: Path) -> None:  # noqa: F811
    file = write_ply(ball(10, 20), tmp_path / "a.ply")
    file.write_bytes(file.read_bytes()[:-3])
    assert foparq("check", file, "--unit", "m")[0] == 4
