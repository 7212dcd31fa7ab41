# SPDX-License-Identifier: MIT
"""A mesh beside a drawing that is accepted: whether it lies where the checkpoints were surveyed."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import Delaunay
from tests.attacks.mesh_deliveries import Answer, Meshes, deliver, sound_drawing
from tests.mesh.files import Mesh, mesh

LIMIT = 0.0075  #: of Q1 at 1:25
Audited = Callable[..., Answer]


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sound_drawing(tmp_path_factory.mktemp("offices") / "office")


@pytest.fixture
def audited(base: Path, tmp_path: Path) -> Audited:
    def one(made: Mesh, facade: str = "") -> Answer:
        facades = (facade,) if facade else ()
        return deliver(Meshes(files={"a": made}, closed=False, facades=facades), base, tmp_path / "delivery")

    return one


def surveyed(base: Path) -> np.ndarray:
    """Surveyed places (n, 3) of the table, which is in millimetres with decimal commas."""
    rows = (base / "pontos.csv").read_text("utf-8-sig").split("\n")[1:]
    return np.array([[float(cell.replace(",", ".")) for cell in row.split(";")[1:4]] for row in rows if row]) / 1000


def through(places: np.ndarray) -> Mesh:
    """Triangles between places, as seen along their shallowest direction, and a frame of a metre around them."""
    flat = np.delete(np.arange(3), np.argmin(np.ptp(places, axis=0)))
    low, high = places[:, flat].min(axis=0) - 1.0, places[:, flat].max(axis=0) + 1.0
    frame = np.tile(places.mean(axis=0), (4, 1))
    frame[:, flat] = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]]
    points = np.vstack([places, frame])
    return mesh(points, Delaunay(points[:, flat]).simplices.tolist())


def across(of: Mesh, step: float) -> Mesh:
    """The mesh moved along its shallowest direction."""
    shift = np.zeros(3)
    shift[np.argmin(np.ptp(of.points, axis=0))] = step
    return of._replace(points=of.points + shift)


def of_mesh(answer: Answer) -> list[str]:
    return [one for one in answer.sentences if "mesh-a.ply" in one and "faces are at fault" not in one]


def test_a_mesh_through_the_surveyed_places_is_accepted_and_was_compared(base: Path, audited: Audited) -> None:
    answer = audited(through(surveyed(base)))
    assert answer.verdict == "accepted", answer.sentences
    assert not any("not compared" in one for one in of_mesh(answer))


@pytest.mark.parametrize(("step", "verdict"), [(0.8 * LIMIT, "accepted"), (1.3 * LIMIT, "undecided")])
def test_a_mesh_before_the_surveyed_places_is_told(base: Path, audited: Audited, step: float, verdict: str) -> None:
    answer = audited(across(through(surveyed(base)), step))
    assert answer.verdict == verdict, answer.sentences
    assert any("off the surveyed places" in one for one in of_mesh(answer)) is (verdict == "undecided")


def test_a_mesh_elsewhere_is_told_not_to_be_compared_and_of_a_facade_decides_nothing(
    base: Path, audited: Audited
) -> None:
    far = across(through(surveyed(base)), 5.0)
    answer = audited(far)
    assert answer.verdict == "accepted"
    assert any("not compared" in one for one in of_mesh(answer))


def test_a_mesh_of_a_facade_needs_places_of_its_own(base: Path, audited: Audited) -> None:
    answer = audited(across(through(surveyed(base)), 5.0), "S")
    assert answer.verdict == "undecided"
    assert any("0 checkpoints lie near the mesh mesh-a.ply of facade S" in one for one in answer.sentences)
