# SPDX-License-Identifier: MIT
"""A mesh and its tables: what was done to one of them is told for what it is, and what is sound is accepted."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from tests.attacks.surveyed_meshes import Answer, Delivery, added, answer, head, without
from tests.mesh.files import Mesh

from foparq.columns import Coordinates

FAR = np.array([712345.678, 7456789.123, 812.5])
Q1 = {"Q1-X", "Q1-Y", "Q1-Z"}
Q6 = {"Q6-X", "Q6-Y", "Q6-Z"}
BY_HAND = '[[confirmed]]\nwhat = "commission"\nvalue = "none"\nby = "Fiscal da obra"\nreason = "Vista a malha"\n'


@dataclass(frozen=True)
class Attack:
    """A delivery that must not be accepted."""

    made: Delivery
    open: set[str]  #: elements that must not pass
    said: str  #: pattern of what the verdict must say
    verdict: str = "undecided"


def scaled(points: Coordinates) -> Coordinates:
    return points * 1.05


def mirrored(points: Coordinates) -> Coordinates:
    return points * np.array([-1.0, 1.0, 1.0])


def in_millimetres(points: Coordinates) -> Coordinates:
    return points * 1000.0


def shifted(points: Coordinates) -> Coordinates:
    return points + np.array([0.05, 0.02, 0.01])


def off_the_surface(points: Coordinates) -> Coordinates:
    return points * (1 + 0.05 / np.linalg.norm(points, axis=1, keepdims=True))


def one_off(points: Coordinates) -> Coordinates:
    moved = points.copy()
    moved[4] *= 1.2
    return moved


def exchanged(points: Coordinates) -> Coordinates:
    return points[:, [1, 0, 2]]


def other_statue() -> Mesh:
    return head(other=True)


def on_discs() -> Mesh:
    """Another statue, and a small disc wherever a table says that a point is."""
    truth = head()
    corners = truth.points[truth.corners.reshape(-1, 3)]
    rng = np.random.default_rng(3)
    pick = rng.choice(len(corners), 12, replace=False)
    at = np.einsum("ij,ijk->ik", rng.dirichlet([1.0, 1.0, 1.0], 12), corners[pick])
    discs = np.concatenate([at + step for step in 0.003 * np.array([[1, 0, 0], [-1, 1, 0], [-1, -1, 0]])])
    return added(other_statue(), discs, [[k, k + 12, k + 24] for k in range(12)])


def with_a_bump() -> Mesh:
    """A plate of 100 mm beside the head, joined to nothing that the list names."""
    plate = np.array([[0.5, 0, 0], [0.6, 0, 0], [0.6, 0.1, 0], [0.5, 0.1, 0]])
    return added(head(), plate, [[0, 1, 2], [0, 2, 3]])


def with_a_horn() -> Mesh:
    """One vertex drawn out by 150 mm: it has the faces of the head, and is not on the monument."""
    of = head()
    points = of.points.copy()
    points[10 * 40 + 25] *= 1.6
    return of._replace(points=points)


def with_a_hole() -> Mesh:
    """A tenth of the faces, of one side, is missing."""
    of = head()
    middle = of.points[of.corners.reshape(-1, 3)].mean(axis=1)
    return without(of, np.argsort(-middle[:, 0])[: of.faces // 10])


ATTACKS = {
    "another statue": Attack(Delivery(surface=other_statue), {*Q1, "Q2", "Q4", "Q5"}, "not on the mesh"),
    "another statue, class B": Attack(
        Delivery(surface=other_statue, profile="et-doc-foparq-b"), {"Q4", "Q5"}, "another mesh"
    ),
    "enlarged": Attack(Delivery(points=scaled), {*Q1, "Q2", "Q5"}, r"enlarged by a factor of 1\.05"),
    "enlarged, class B": Attack(Delivery(points=scaled, profile="et-doc-foparq-b"), {"Q4", "Q5"}, "enlarged"),
    "mirrored": Attack(Delivery(points=mirrored), {*Q1, "Q2", "Q5"}, "mirrored along x"),
    "mirrored, class B": Attack(Delivery(points=mirrored, profile="et-doc-foparq-b"), {"Q4", "Q5"}, "mirrored"),
    "millimetres called metres": Attack(Delivery(points=in_millimetres), {*Q1, "Q2", "Q5"}, "multiplied by 1000"),
    "metres called millimetres": Attack(Delivery(unit="mm"), {*Q1, "Q2", "Q5"}, r"multiplied by 0\.001"),
    "millimetres called metres, class B without tables": Attack(
        Delivery(points=in_millimetres, profile="et-doc-foparq-b", tables=()), {"Q3-mesh"}, "no object of this scale"
    ),
    "metres called millimetres, class B without tables": Attack(
        Delivery(unit="mm", profile="et-doc-foparq-b", tables=()), {"Q3-mesh"}, "no object of this scale"
    ),
    "shifted": Attack(Delivery(points=shifted), {*Q1, "Q2", "Q5"}, "moved by 50 mm along x, 20 mm along y and 10 mm"),
    "axes of the table exchanged": Attack(Delivery(told=exchanged), {*Q1, *Q6}, "."),
    "points off the surface": Attack(
        Delivery(told=off_the_surface, tables=("checkpoints", "features")), {*Q1, *Q6}, "not on the mesh"
    ),
    "one point off the surface": Attack(
        Delivery(told=one_off), {*Q1, *Q6}, "1 of 12 checkpoints is not on the mesh: P4"
    ),
    "points not delivered": Attack(Delivery(names=False), {*Q1, *Q6}, "deliver them as xd, yd, zd"),
    "points on discs": Attack(Delivery(surface=on_discs), {*Q1, *Q6}, "small pieces"),
    "ends of distances elsewhere": Attack(Delivery(ends=off_the_surface), {"Q2"}, "12 of 12 distances end at points"),
    "no tables": Attack(Delivery(tables=()), {*Q1, "Q2", "Q4", "Q5"}, "."),
    "places of the list elsewhere": Attack(Delivery(places=shifted), {"Q4", "Q5"}, "another mesh"),
    "one in twelve is missing": Attack(Delivery(bare=180), {"Q5"}, "no surface was delivered", "rejected"),
    "a tenth was never scanned": Attack(Delivery(surface=with_a_hole), {"Q5"}, "no surface was delivered", "rejected"),
    "a plate that nobody asked for": Attack(Delivery(surface=with_a_bump), {"Q4"}, "1 piece of surface", "rejected"),
    "a horn that nobody asked for": Attack(Delivery(surface=with_a_horn), {"Q4"}, "1 piece of surface", "rejected"),
    "a list that covers only places": Attack(Delivery(spacing=""), {"Q4"}, "state how far"),
    "a tolerance that anything meets": Attack(
        Delivery(surface=other_statue, profile="et-doc-foparq-b", tol="100"), {"Q4", "Q5"}, "at most 10 mm"
    ),
    "what is there listed ten times": Attack(Delivery(bare=180, times=10), {"Q4", "Q5"}, "repeat the place"),
    "a spacing as wide as the object": Attack(Delivery(spacing="1 m"), {"Q4"}, "wider than 50 mm"),
    "a feature that must not be there": Attack(
        Delivery(rows=("X1,scaffold,0,0,0.32,0.003,prohibited",)), {"Q4"}, "prohibits 1 feature"
    ),
    "a spacing that the list does not have": Attack(Delivery(spacing="1 mm"), {"Q4"}, "Correct the spacing"),
}  # fmt: skip


@pytest.mark.parametrize("name", ATTACKS)
def test_what_is_wrong_is_told_for_what_it_is(name: str, tmp_path: Path) -> None:
    attack = ATTACKS[name]
    told = answer(attack.made, tmp_path / "delivery")
    assert told.verdict == attack.verdict, told.why
    assert attack.open <= told.open(), told.why
    assert re.search(attack.said, told.why), told.why


def georeferenced(points: Coordinates) -> Coordinates:
    return points + FAR


SOUND = {
    "class A": Delivery(),
    "class B": Delivery(profile="et-doc-foparq-b"),
    "class B without tables of accuracy": Delivery(profile="et-doc-foparq-b", tables=("features",)),
    "few places are missing": Delivery(bare=90),
    "in millimetres": Delivery(points=in_millimetres, unit="mm"),
    "printed to a millimetre": Delivery(decimals=3),
    "georeferenced": Delivery(
        points=georeferenced, surveyed=lambda: head()._replace(points=head().points + FAR)
    ),
    "nothing was added, by name": Delivery(spacing="", more=BY_HAND),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_what_is_sound_is_accepted(name: str, tmp_path: Path) -> None:
    told = answer(SOUND[name], tmp_path / "delivery")
    assert told.verdict == "accepted", told.why


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Answer:
    return answer(Delivery(), tmp_path_factory.mktemp("sound") / "delivery")


def test_an_acceptance_that_was_compared_says_nothing_else(sound: Answer) -> None:
    assert "not compared" not in sound.why
    assert "stated" in sound.why  # the rim


@pytest.mark.parametrize("axis", "XYZ")
def test_the_error_of_an_axis_is_that_of_the_table(sound: Answer, axis: str, tmp_path: Path) -> None:
    rows = np.genfromtxt(sound_table(tmp_path), delimiter=",", names=True, dtype=None, encoding="utf-8")
    column = axis.lower()
    expected = np.sqrt(np.mean((rows[f"{column}d"] - rows[column]) ** 2))
    assert sound.element(f"Q1-{axis}").value == pytest.approx(expected, rel=1e-9)


def sound_table(folder: Path) -> Path:
    answer(Delivery(), folder / "again")
    return folder / "again" / "pontos.csv"


def test_a_unit_that_somebody_answers_for_is_no_doubt(tmp_path: Path) -> None:
    by_name = '[[confirmed]]\nwhat = "unit"\nvalue = "mm"\nby = "Fiscal"\nreason = "Medalha"\n'
    made = Delivery(unit="mm", profile="et-doc-foparq-b", tables=(), more=by_name)
    assert str(answer(made, tmp_path / "delivery").element("Q3-mesh").status) == "pass"


def test_who_confirms_that_nothing_was_added_is_named(tmp_path: Path) -> None:
    told = answer(Delivery(spacing="", more=BY_HAND), tmp_path / "delivery")
    assert "the word of Fiscal da obra" in told.why


def test_a_drawing_that_is_confirmed_not_to_be_drawn_is_no_way_around_a_mesh(tmp_path: Path) -> None:
    more = '[[confirmed]]\nwhat = "checkpoints"\nvalue = "not drawn"\nby = "Produtor"\nreason = "Estéreo"\n'
    told = answer(Delivery(told=off_the_surface, more=more), tmp_path / "delivery")
    assert told.verdict == "undecided"
    assert told.open() >= Q1


def test_one_bad_face_changes_nothing_that_is_said_of_the_tables(sound: Answer, tmp_path: Path) -> None:
    bad = Delivery(surface=lambda: added(head(), np.array([[np.nan, 0, 0], [9, 9, 9], [9, 9, 10]]), [[0, 1, 2]]))
    told = answer(bad, tmp_path / "delivery")
    for of in (*Q1, "Q2", *Q6, "Q5"):
        one, other = sound.element(of), told.element(of)
        assert (one.value, one.status) == (other.value, other.status)
