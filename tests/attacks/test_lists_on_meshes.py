# SPDX-License-Identifier: MIT
"""Lists and tables of meshes that hide something, or that are sound and look odd."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.attacks.meshes import write_ply, write_stl
from tests.attacks.surveyed_meshes import Answer, Delivery, added, answer, head, without, write
from tests.mesh.files import Mesh, mesh
from tests.read.mesh.gltf_files import pyramid
from tests.tools.sound import unguarded

from foparq.audit import audit
from foparq.columns import Coordinates

Q1 = {"Q1-X", "Q1-Y", "Q1-Z"}
BY_HAND = '[[confirmed]]\nwhat = "commission"\nvalue = "none"\nby = "Fiscal da obra"\nreason = "Vista a malha"\n'


def unwelded() -> Mesh:
    """Every face with vertices of its own, as a PLY with a texture has them."""
    of = head()
    return mesh(of.points[of.corners], np.arange(len(of.corners)).reshape(-1, 3).tolist())


def write_glb(of: Mesh, path: Path) -> None:
    """As programs export it: y up."""
    x, y, z = of.points.T
    turned = np.column_stack([x, z, -y])
    path.write_bytes(pyramid(turned.tolist(), of.corners.reshape(-1, 3).tolist()).glb())


def apart(places: Coordinates) -> Coordinates:
    """Places that are not written alike to a centimetre."""
    return places[np.sort(np.unique(np.round(places, 2), axis=0, return_index=True)[1])]


def with_a_far_face() -> Mesh:
    return added(head(), np.array([[1e200, 0, 0], [0, 1e200, 0], [0, 0, 1e200]]), [[0, 1, 2]])


SOUND = {
    "an STL": Delivery(file="busto.stl", save=write_stl),
    "vertices of their own": Delivery(surface=unwelded),
    "places printed to a centimetre": Delivery(listed=2, places=apart),
    "a prohibited class without a place": Delivery(
        rows=("X1,andaime,,,,,prohibited",), spacing="", more=BY_HAND,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SOUND)
def test_what_is_sound_is_accepted(name: str, tmp_path: Path) -> None:
    told = answer(SOUND[name], tmp_path / "delivery")
    assert told.verdict == "accepted", told.why


def tiled(gap: float) -> Mesh:
    """The head, and beside it a plate of 25 tiles, each less than the square of the spacing, that share no edge."""
    side = 0.028
    of = head()
    for row, column in np.ndindex(5, 5):
        x, y = 0.5 + row * (side + gap), column * (side + gap)
        tile = np.array([[x, y, 0], [x + side, y, 0], [x + side, y + side, 0], [x, y + side, 0]])
        of = added(of, tile, [[0, 1, 2], [0, 2, 3]])
    return of


def with_a_screen(far: float) -> Callable[[], Mesh]:
    """A plate of 0.4 m behind the head."""

    def made() -> Mesh:
        plate = np.array([[-0.2, -0.2, -far], [0.2, -0.2, -far], [0.2, 0.2, -far], [-0.2, 0.2, -far]])
        return added(head(), plate, [[0, 1, 2], [0, 2, 3]])

    return made


@pytest.mark.parametrize("gap", [1e-5, 0.005])
def test_a_plate_in_tiles_is_a_plate(gap: float, tmp_path: Path) -> None:
    told = answer(Delivery(surface=lambda: tiled(gap)), tmp_path / "delivery")
    assert told.verdict == "rejected"
    assert "Q4" in told.open()
    assert re.search("1 piece of surface", told.why), told.why


def test_a_missing_place_far_away_excuses_no_screen(tmp_path: Path) -> None:
    made = Delivery(surface=with_a_screen(1.5), rows=("X1,relief,0,0,-2.4,0.003,required",))
    told = answer(made, tmp_path / "delivery")
    assert told.verdict == "rejected"
    assert "Q4" in told.open()


def test_a_spacing_that_the_mesh_contradicts_is_wrong_whoever_confirms(tmp_path: Path) -> None:
    told = answer(Delivery(spacing="1 mm", more=BY_HAND), tmp_path / "delivery")
    assert told.verdict == "undecided"
    assert "Correct the spacing" in told.why


@pytest.mark.parametrize("decimals", [0, 1])
def test_places_of_too_few_digits_say_nothing(decimals: int, tmp_path: Path) -> None:
    told = answer(Delivery(listed=decimals, profile="et-doc-foparq-b"), tmp_path / "delivery")
    assert told.verdict == "undecided", told.why
    assert "more digits" in told.why


def test_a_face_beyond_any_object_changes_nothing_that_tables_say(tmp_path: Path) -> None:
    sound = answer(Delivery(), tmp_path / "sound")
    told = answer(Delivery(surface=with_a_far_face), tmp_path / "far")
    for of in (*Q1, "Q2", "Q4", "Q5"):
        one, other = sound.element(of), told.element(of)
        assert (one.value, one.status) == (other.value, other.status), of


def test_y_up_is_told_for_what_it_is(tmp_path: Path) -> None:
    told = answer(Delivery(file="busto.glb", save=write_glb), tmp_path / "delivery")
    assert told.verdict == "undecided"
    assert re.search(r"y axis up, the table its z axis: all 12 points lie on the mesh with Y = Z, Z = -Y", told.why), (
        told.why
    )


def disc() -> Mesh:
    """Another head than the table speaks of, far from it, and a small disc at the origin."""
    turn = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    ring = 0.004 * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(12)])
    of = head(other=True)
    far = of._replace(points=of.points + np.array([3.0, 2.0, 1.0]))
    return added(far, np.vstack([ring, np.zeros((1, 3))]), [[12, k, (k + 1) % 12] for k in range(12)])


def test_a_disc_at_the_origin_is_no_unit(tmp_path: Path) -> None:
    told = answer(Delivery(surface=disc, profile="et-doc-foparq-a"), tmp_path / "delivery")
    assert told.verdict == "undecided"
    assert "multiplied" not in told.why


def two(made: Delivery, folder: Path, other: Mesh) -> Answer:
    """A second mesh of the same delivery."""
    folder.mkdir(parents=True)

    def save(of: Mesh, path: Path) -> None:
        write_ply(of, path)
        write_ply(other, path.with_name("b.ply"))

    return answer(replace(made, save=save), folder / "delivery")


def test_a_mesh_of_which_the_list_says_nothing_was_not_compared(tmp_path: Path) -> None:
    of = head(other=True)
    far = of._replace(points=of.points + np.array([3.0, 2.0, 1.0]))
    more = BY_HAND + '[[mesh]]\npath = "b.ply"\nunit = "m"\nclosed = false\n'
    made = Delivery(profile="et-doc-foparq-b", tables=("features",), spacing="", more=more)
    told = two(made, tmp_path / "two", far)
    assert re.search(r"not compared.*b\.ply|b\.ply.*not compared", told.why), told.why
    assert not re.search(r"not compared.*busto\.ply|busto\.ply.*not compared", told.why), told.why


def test_many_points_off_the_surface_are_looked_at_in_part(tmp_path: Path) -> None:
    """The cause is the same, and holds for all of them."""
    made = Delivery(n=1500, tables=("checkpoints",), points=lambda points: points + np.array([0.05, 0.02, 0.01]))
    told = answer(made, tmp_path / "delivery")
    assert "moved by 50 mm along x, 20 mm along y and 10 mm" in told.why


def plate() -> Mesh:
    """A tablet of half a metre, exactly in the plane z = 0."""
    x, y = np.meshgrid(np.linspace(0, 0.5, 21), np.linspace(0, 0.5, 21), indexing="ij")
    corner = np.arange(441).reshape(21, 21)
    ring = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1).reshape(-1, 4)
    faces = np.concatenate([ring[:, [0, 1, 2]], ring[:, [0, 2, 3]]]).tolist()
    return mesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=-1), faces)


@pytest.mark.parametrize(("missing", "state"), [(0, "pass"), (200, "fail")])
def test_a_spreadsheet_drops_the_zeros_of_a_plane(missing: int, state: str, tmp_path: Path) -> None:
    """Its column of heights says 0, which is no place to the metre: faces that are missing are missed."""
    made = Delivery(
        surface=lambda: without(plate(), np.arange(missing)),
        surveyed=plate,
        profile="et-doc-foparq-b",
        tables=("features",),
    )
    folder = write(made, tmp_path / "delivery")
    path = folder / "feicoes.csv"
    path.write_text(path.read_text("utf-8").replace(",0.00000,", ",0,"), encoding="utf-8")
    with unguarded():
        told = Answer(audit(folder).record)
    assert str(told.element("Q5").status) == state, told.why
