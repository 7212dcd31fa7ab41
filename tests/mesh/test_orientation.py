# SPDX-License-Identifier: MIT
"""Faces turned over, sheets with one side, volumes."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh, read
from tests.mesh.made import GEOREFERENCED, box, moved, plant, plate, sphere, turn

from foparq.columns import Index
from foparq.mesh.edges import edges
from foparq.mesh.orientation import Orientation, Volumes, closed_components, orientation, signed_volumes


def found(of: Mesh) -> Orientation:
    return orientation(of.starts, edges(of.corners, of.starts))


def volumes(of: Mesh, label: Index | None = None) -> Volumes:
    label = np.zeros(of.faces, dtype=np.intp) if label is None else label
    return signed_volumes(of.points, of.corners, of.starts, label, count=int(label.max()) + 1)


def flipped(of: Mesh, rows: list[int]) -> Mesh:
    return mesh(of.points, [face[::-1] if row in rows else face for row, face in enumerate(of.lists())])


@given(st.lists(st.lists(st.integers(0, 6), min_size=3, max_size=4, unique=True), max_size=9))
def test_sheets_are_coloured_like_by_plain_search(faces: list[list[int]]) -> None:
    of = mesh(np.zeros((7, 3)), faces)
    table = edges(of.corners, of.starts)
    face = np.repeat(np.arange(of.faces), np.diff(of.starts))
    links: list[tuple[int, int, bool]] = []
    for row in table.paired.tolist():
        at = table.starts[row]
        one, two = face[table.sides[at : at + 2]].tolist()
        links.append((one, two, bool(table.along[at] == table.along[at + 1])))
    colour: dict[int, int] = {}
    sheet: dict[int, int] = {}
    good: list[bool] = []
    for first in range(of.faces):
        if first in colour:
            continue
        colour[first], sheet[first], todo, sound = 0, len(good), [first], True
        while todo:
            here = todo.pop()
            for a, b, differ in links:
                for one, two in ((a, b), (b, a)):
                    if one == here and two not in colour:
                        colour[two], sheet[two] = colour[here] ^ differ, len(good)
                        todo.append(two)
                    elif one == here:
                        sound &= colour[two] == colour[here] ^ differ
        good.append(sound)
    of_faces = found(of)
    assert of_faces.sheet.tolist() == [sheet[row] for row in range(of.faces)]
    assert of_faces.orientable.tolist() == good
    for number, sound in enumerate(good):
        rows = [row for row in range(of.faces) if sheet[row] == number]
        turned = [row for row in rows if colour[row]]
        minority = turned if 2 * len(turned) <= len(rows) else [row for row in rows if not colour[row]]
        assert [row for row in rows if of_faces.flipped[row]] == (minority if sound else [])


@pytest.mark.parametrize("base", [sphere(3), box(8), plate(12, 12, [(3, 3)])])
def test_faces_turned_over_are_found(base: Mesh) -> None:
    rows = sorted(np.random.default_rng(1).choice(base.faces, base.faces // 5, replace=False).tolist())
    of = flipped(base, rows)
    assert np.flatnonzero(found(of).flipped).tolist() == rows
    assert np.count_nonzero(found(moved(of, seed=4, rotate=True)).flipped) == len(rows)
    # Most faces turned over: the rest is the smaller part.
    most = sorted(set(range(base.faces)) - set(rows))
    assert np.flatnonzero(found(flipped(base, most)).flipped).tolist() == rows


def test_planted_ones_are_found_beside_other_faults() -> None:
    planted = plant(sphere(4), each=6, seed=1)
    assert np.count_nonzero(found(planted.mesh).flipped) == 6


def test_a_strip_of_moebius_has_one_side() -> None:
    n = 7
    a, b = list(range(n)), list(range(n, 2 * n))
    faces = [[a[k], a[k + 1], b[k + 1], b[k]] for k in range(n - 1)] + [[a[-1], b[0], a[0], b[-1]]]
    of = found(mesh(np.zeros((2 * n, 3)), faces))
    assert of.orientable.tolist() == [False]
    assert not of.flipped.any()


def test_volume_of_a_box() -> None:
    of = box(4, (2.0, 3.0, 0.5))
    for it in (of, moved(of, seed=1, rotate=True, shift=GEOREFERENCED)):
        value = volumes(it)
        # The corners of the shifted box are rounded by 1e-9 m.
        assert value.volume[0] == pytest.approx(3.0, abs=1e-7)
        assert 0 < value.doubt[0] < 1e-9
    inward = volumes(flipped(of, list(range(of.faces))))
    assert inward.volume[0] == pytest.approx(-3.0)


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED])
def test_volume_differs_from_the_exact_one_by_less_than_the_doubt(shift: tuple[float, float, float]) -> None:
    of = moved(sphere(2), seed=1, shift=shift)
    exact = Fraction(0)
    for face in of.lists():
        (a, b, c), (d, e, f), (g, h, i) = ([Fraction(x) for x in of.points[vertex].tolist()] for vertex in face)
        exact += a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    value = volumes(of)
    assert abs(Fraction(float(value.volume[0])) - exact / 6) <= Fraction(float(value.doubt[0]))


def test_volume_of_a_flat_closed_surface_has_no_sign() -> None:
    points = (np.array([[0.1, 0.2, 0], [1.3, 0.1, 0], [0.9, 1.1, 0], [0.2, 0.7, 0]]) @ turn(3)) + GEOREFERENCED
    value = volumes(mesh(points, [[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]]))
    assert abs(value.volume[0]) <= value.doubt[0]


def test_volumes_of_a_shell_and_its_cavity() -> None:
    outer, inner = sphere(2), sphere(1)
    points = np.concatenate([outer.points * 2, inner.points])
    faces = outer.lists() + [[v + len(outer.points) for v in face[::-1]] for face in inner.lists()]
    of = mesh(points, faces)
    label = np.repeat([0, 1], [outer.faces, inner.faces])
    value = volumes(of, label)
    assert value.volume[0] == pytest.approx(8 * volumes(outer).volume[0])
    assert value.volume[1] == pytest.approx(-volumes(inner).volume[0])
    state = closed_components(of.starts, edges(of.corners, of.starts), label, count=2)
    assert state.closed.tolist() == [True, True]
    assert state.consistent.tolist() == [True, True]


def test_closed_and_consistent_are_told_apart() -> None:
    whole = box(2)
    for of, expected in (
        (whole, (True, True)),
        (flipped(whole, [3]), (True, False)),
        (mesh(whole.points, whole.lists()[1:]), (False, True)),
        (mesh(whole.points, [*whole.lists(), whole.lists()[0]]), (False, True)),
    ):
        state = closed_components(of.starts, edges(of.corners, of.starts), np.zeros(of.faces, np.intp), count=1)
        assert (bool(state.closed[0]), bool(state.consistent[0])) == expected


def test_nothing() -> None:
    of = found(mesh([], []))
    assert len(of.sheet) == len(of.orientable) == 0


@pytest.mark.shared
def test_known_faces_turned_over(shared: Path) -> None:
    folder = shared / "data" / "mesh"
    for name, count in (("synth_defect_sphere/def5.ply", 10), ("val3dity_small/307.poly", 1), ("two5.ply", 0)):
        path = folder / name if "/" in name else folder / "synth_two_spheres" / name
        of = found(read(path))
        assert np.count_nonzero(of.flipped) == count
        assert of.orientable.all()
