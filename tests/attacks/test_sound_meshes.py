# SPDX-License-Identifier: MIT
"""Sound meshes are accepted, without any fault, or one sentence says what a person must state."""

import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.attacks.mesh_deliveries import Answer, Meshes, deliver, sound_drawing
from tests.attacks.meshes import (
    ball,
    both,
    centres,
    facade,
    only,
    open_above,
    shifted,
    strip,
    triangles,
    windows,
    write_obj,
    write_stl,
)
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import GEOREFERENCED, box, turn
from tests.mesh.parts import cut, inside_out
from tests.read.mesh.gltf_files import Gltf

#: what is told of a sound mesh, and is no fault
NOTES = {"duplicate-vertex", "non-planar-polygon", "stated-rim", "unreferenced-vertex"}
OPENINGS = "MSH011: of an open surface one loop a piece is its rim, and nobody can state that other ones are meant"
TOUCHING = "MSH012, MSH021, MSH022, MSH023: solids that touch are taken for one surface that is wrong"


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sound_drawing(tmp_path_factory.mktemp("offices") / "office")


Audited = Callable[[Meshes], Answer]


@pytest.fixture
def audited(base: Path, tmp_path: Path) -> Audited:
    return lambda made: deliver(made, base, tmp_path / "delivery")


@dataclass(frozen=True)
class Sound:
    """A surface that has no fault."""

    make: Callable[[], Mesh]
    closed: bool = True
    unit: str = "m"
    write: Callable[[Mesh], tuple[str, bytes]] | None = None
    wrong: str = ""
    notes: frozenset[str] = field(default_factory=lambda: frozenset(NOTES))


def turned(of: Mesh) -> Mesh:
    """As a survey delivers it: no face along an axis, and in a national grid."""
    return Mesh(of.points @ turn(3).T + GEOREFERENCED, of.corners, of.starts)


def single(of: Mesh) -> Mesh:
    """Rounded to single precision."""
    return Mesh(of.points.astype(np.float32).astype(float), of.corners, of.starts)


def soup(of: Mesh) -> Mesh:
    """Every face with vertices of its own."""
    return Mesh(of.points[of.corners], np.arange(len(of.corners)), of.starts)


def star(n: int = 24) -> Mesh:
    """A prism over a star."""
    angle, far = 2 * np.pi * np.arange(n) / n, np.where(np.arange(n) % 2, 1.0, 0.4)
    flat = np.stack([far * np.cos(angle), far * np.sin(angle)], axis=1)
    points = np.concatenate([np.insert(flat, 2, height, axis=1) for height in (0, 1)])
    sides = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return mesh(points, [list(range(n))[::-1], list(range(n, 2 * n)), *sides])


def shaken(of: Mesh, by: float) -> Mesh:
    """Every vertex moved a little: no quadrangle is plane."""
    return Mesh(of.points + np.random.default_rng(1).normal(0, by, of.points.shape), of.corners, of.starts)


def pyramid() -> Mesh:
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]
    return mesh(points, [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def hollow() -> Mesh:
    """A box with a box-shaped cavity in it, whose wall looks inward."""
    return both(box(4), inside_out(shifted(box(2), (0.25, 0.25, 0.25), 0.5)))


def thin(of: float) -> Mesh:
    return shifted(box(10), scale=(1, 1, of))


def folded() -> Mesh:
    """Two triangles that meet at an edge and nearly lie on each other."""
    return triangles([[0, 0, 0], [0, 1, 0], [1, 0, 1e-6], [1, 0, -1e-6]], [[0, 1, 2], [1, 0, 3]])


def tube() -> Mesh:
    """The shaft of a column, which ends above and below."""
    of = ball(60, 120)
    return only(of, np.abs(centres(of)[:, 2]) < 0.7)


def textured(of: Mesh) -> tuple[str, bytes]:
    """An OBJ whose corners have texture coordinates of their own, cut open along seams."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in of.points.tolist()]
    lines += [f"vt {k % 7 / 7!r} {k % 5 / 5!r}" for k in range(len(of.corners))]
    for a, b in zip(of.starts[:-1].tolist(), of.starts[1:].tolist(), strict=True):
        lines.append("f " + " ".join(f"{of.corners[k] + 1}/{k + 1}" for k in range(a, b)))
    return "a.obj", "\n".join(lines).encode()


def in_groups(of: Mesh, folder: Path) -> tuple[str, bytes]:
    groups = [f"parte {row * 2 // of.faces}" for row in range(of.faces)]
    return "a.obj", write_obj(of, folder / "a.obj", groups).read_bytes()


def nodes(of: Mesh, *said: Mapping[str, object]) -> tuple[str, bytes]:
    """A scene of several nodes, each with its transformation, of one mesh."""
    made = Gltf()
    position = made.accessor(of.points.tolist())
    indices = made.accessor([(vertex,) for vertex in of.corners.tolist()], 5125)
    made.mesh({"attributes": {"POSITION": position}, "indices": indices})
    made.nodes(*({"mesh": 0, **one} for one in said), roots=list(range(len(said))))
    return "a.glb", made.glb()


MIRRORED = {"scale": [-1, 1, 1], "translation": [5, 0, 0]}
UPSIDE_DOWN = {"scale": [-2, -2, -2], "translation": [0, 9, 0]}
TURNED = {"rotation": [0.5, 0.5, 0.5, 0.5], "translation": [0, 0, 12]}

SOUND = {
    "a cube of twelve triangles": Sound(lambda: cut(box(1))),
    "a cube of six quadrangles, in a national grid": Sound(lambda: turned(box(1))),
    "a pyramid": Sound(pyramid),
    "a pyramid in a national grid": Sound(lambda: turned(pyramid())),
    "a closed ball": Sound(lambda: ball(20, 40)),
    "a ball in millimetres": Sound(lambda: shifted(ball(20, 40), scale=1000), unit="mm"),
    "a ball in a national grid": Sound(lambda: turned(ball(20, 40))),
    "every face with vertices of its own": Sound(lambda: soup(ball(20, 40))),
    "a scan with an open base": Sound(lambda: open_above(ball(40, 80), 0.8), closed=False),
    "a scan with an open base, in a national grid": Sound(lambda: turned(open_above(ball(40, 80), 0.8)), closed=False),
    "a cavity that looks inward": Sound(hollow),
    "a cavity, in a national grid": Sound(lambda: turned(hollow())),
    "solids apart": Sound(lambda: both(box(4), shifted(box(4), (2, 0, 0)), shifted(ball(20, 40), (5, 0, 0)))),
    "a wall of a thousandth of a millimetre": Sound(lambda: thin(1e-6)),
    "a wall of a millimetre in a national grid": Sound(lambda: turned(thin(1e-3))),
    "a sharp fold": Sound(folded, closed=False),
    "a prism over a star": Sound(star),
    "a prism over a star, in a national grid": Sound(lambda: turned(star())),
    "a flat facade": Sound(lambda: facade(20, 20), closed=False),
    "a flat facade in a national grid": Sound(lambda: turned(facade(20, 20)), closed=False),
    "a flat facade of triangles in single precision": Sound(
        lambda: single(shifted(turned(cut(facade(20, 20))), -np.array(GEOREFERENCED))), closed=False
    ),
    "a facade whose quadrangles are not plane": Sound(lambda: shaken(facade(20, 20), 0.05), closed=False),
    "a box whose quadrangles are not plane": Sound(lambda: shaken(box(20), 0.003)),
    "one polygon with openings over bridges, and panes": Sound(lambda: windows(4), closed=False),
    "the same in a national grid": Sound(lambda: turned(windows(6)), closed=False),
    "a surface of one side only": Sound(
        lambda: strip(200, 1), closed=False, notes=frozenset({*NOTES, "flipped-orientation"})
    ),
    "solids that touch at an edge": Sound(
        lambda: both(box(8), shifted(box(8), (1, 1, 0))), notes=frozenset({*NOTES, "non-manifold-edge"})
    ),
    "solids that touch at a vertex": Sound(
        lambda: both(box(4), shifted(box(4), (1, 1, 1))), notes=frozenset({*NOTES, "non-manifold-vertex"})
    ),
    "solids that touch at a side": Sound(lambda: both(box(4), shifted(box(4), (1, 0, 0))), wrong=TOUCHING),
    "solids that touch at a part of a side": Sound(
        lambda: both(box(4), shifted(box(4), (1, 0.1, 0.1))), wrong=TOUCHING
    ),
    "STL": Sound(lambda: cut(ball(20, 40)), write=lambda of: ("a.stl", stl(of))),
    "textured OBJ": Sound(lambda: ball(20, 40), write=textured),
    "nodes of a scene, mirrored ones among them": Sound(
        lambda: cut(box(3)), unit="", write=lambda of: nodes(of, {}, MIRRORED, UPSIDE_DOWN, TURNED)
    ),
    "the shaft of a column": Sound(tube, closed=False, wrong=OPENINGS),
    "a facade with openings without panes": Sound(lambda: windows(4, panes=False), closed=False, wrong=OPENINGS),
}


def stl(of: Mesh) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        return write_stl(of, Path(folder) / "a.stl").read_bytes()


def marked(cases: dict[str, Sound]) -> list[object]:
    return [
        pytest.param(one, id=name, marks=pytest.mark.xfail(strict=True, reason=one.wrong) if one.wrong else ())
        for name, one in cases.items()
    ]


@pytest.mark.parametrize("sound", marked(SOUND))
def test_it_is_accepted(sound: Sound, audited: Audited) -> None:
    of = sound.make()
    name, content = sound.write(of) if sound.write else ("a", of)
    answer = audited(Meshes(files={name: content}, closed=sound.closed, unit=sound.unit))
    assert (answer.verdict, answer.state) == ("accepted", "pass")
    assert set(answer.found) <= sound.notes
    assert "duplicate-face" not in answer.found


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (partial(ball, 20, 40), None), (lambda: open_above(ball(20, 40), 0.8), "`closed = false`"),
        (partial(facade, 10, 10), "`closed = false`"),
    ],
)  # fmt: skip
def test_where_nobody_states_whether_it_is_closed_a_sentence_asks(
    make: Callable[[], Mesh], said: str | None, audited: Audited
) -> None:
    answer = audited(Meshes(files={"a": make()}))
    asked = [sentence for sentence in answer.sentences if "`closed = false`" in sentence.lower()]
    assert (answer.verdict, len(asked)) == (("undecided", 1) if said else ("accepted", 0))


def test_several_files_of_several_parts(audited: Audited) -> None:
    files = {"a": ball(20, 40), "b": shifted(box(4), (3, 0, 0)), "c": turned(star())}
    assert audited(Meshes(files=files, closed=True)).verdict == "accepted"


def test_groups_of_a_file_are_one_surface(audited: Audited, tmp_path: Path) -> None:
    name, content = in_groups(ball(20, 40), tmp_path)
    answer = audited(Meshes(files={name: content}, closed=True))
    assert (answer.verdict, dict(answer.found)) == ("accepted", {})
