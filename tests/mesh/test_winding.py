# SPDX-License-Identifier: MIT
"""Winding numbers, against whole numbers known by hand and against the sum of all solid angles."""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.mesh.meshes import Mesh, icosphere

from foparq.mesh import winding as module
from foparq.mesh.winding import border, signed, winding

UTM = np.array([712345.678, 7456789.123, 812.5])


def box(n: int = 2) -> Mesh:
    """Cube of 0 ... n with n by n cells a side, two triangles each, outward; the top last."""
    points: list[tuple[float, ...]] = []
    corners: list[list[int]] = []
    number: dict[tuple[float, ...], int] = {}
    for axis, level in ((0, 0), (0, n), (1, 0), (1, n), (2, 0), (2, n)):
        for i in range(n):
            for j in range(n):
                quad = []
                for u, v in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    place = [0.0, 0.0, 0.0]
                    place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = level, u, v
                    quad.append(number.setdefault(tuple(place), len(number)))
                quad = quad if level else quad[::-1]
                corners += [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
    points = list(number)
    return np.array(points), np.array(corners)


def all_angles(
    points: NDArray[np.float64], corners: NDArray[np.intp], asked: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Sum of the solid angles of all triangles, by the angles between their sides on the sphere, over 4 pi."""
    told = np.zeros(len(asked))
    for k, place in enumerate(asked):
        a, b, c = (points[corners[:, i]] - place for i in range(3))
        turn = np.sign(np.einsum("ij,ij->i", np.cross(a, b), c))
        total = -np.pi
        for one, two, three in ((a, b, c), (b, c, a), (c, a, b)):
            u, v = np.cross(one, two), np.cross(one, three)
            total = total + np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v))
        told[k] = (turn * total).sum() / (4 * np.pi)
    return told


def lattice(n: int, step: float) -> NDArray[np.float64]:
    side = np.arange(-1, n + 1 + step / 2, step)
    return np.stack(np.meshgrid(side, side, side, indexing="ij"), axis=-1).reshape(-1, 3)


@pytest.mark.parametrize("shift", [np.zeros(3), np.array([2.0**20, -(2.0**22), 2.0**9])], ids=["near", "far"])
def test_a_box_holds_what_lies_within_though_rays_pass_its_corners_and_edges(shift: NDArray[np.float64]) -> None:
    points, corners = box()
    asked = lattice(2, 0.25)
    on = ((asked == 0) | (asked == 2)).any(axis=1) & ((asked >= 0) & (asked <= 2)).all(axis=1)
    asked = asked[~on]
    inside = ((asked > 0) & (asked < 2)).all(axis=1)
    told = winding(points + shift, corners, asked + shift)
    assert told.tolist() == inside.astype(float).tolist()
    assert winding(points + shift, corners[:, ::-1], asked + shift).tolist() == (-inside.astype(float)).tolist()


def test_what_goes_around_twice_is_told_so_and_a_hollow_is_outside() -> None:
    points, corners = icosphere(2)
    many = np.concatenate([points * 3, points])
    asked = np.array([[0.0, 0, 0], [2, 0, 0], [4, 0, 0]])
    n = len(points)
    assert winding(many, np.concatenate([corners, corners + n]), asked).tolist() == [2, 1, 0]
    assert winding(many, np.concatenate([corners, corners[:, ::-1] + n]), asked).tolist() == [0, 1, 0]


@pytest.mark.parametrize("kind", ["a hole", "faces turned over", "scattered faces", "an edge of three faces"])
def test_what_is_open_covers_as_much_as_all_its_triangles(kind: str) -> None:
    rng = np.random.default_rng(5)
    points, corners = icosphere(3)
    points = points + rng.normal(size=points.shape) * 0.05
    if kind == "a hole":
        corners = corners[points[corners].mean(axis=1)[:, 2] < 0.4]
    elif kind == "faces turned over":
        corners = np.where(rng.uniform(size=len(corners))[:, None] < 0.1, corners[:, ::-1], corners)
    elif kind == "scattered faces":
        corners = corners[rng.uniform(size=len(corners)) < 0.1]
    else:
        corners = np.concatenate([corners, [[*corners[0, :2], len(points) - 1]]])
    asked = rng.normal(size=(400, 3))
    told = winding(points + UTM, corners, asked + UTM)
    # What is asked is what the doubles there hold.
    known = all_angles(points + UTM, corners, asked + UTM)
    assert np.abs(told - known).max() < 1e-9
    assert winding(points, corners, asked) == pytest.approx(all_angles(points, corners, asked), abs=1e-12)


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("flipped", [False, True])
def test_seen_from_its_opening_a_box_covers_half_of_all(axis: int, flipped: bool) -> None:  # noqa: FBT001
    # Places in the plane of the opening lie in the cone that closes it, on its edges and beside it.
    points, corners = box()
    points = np.roll(points, axis + 1, axis=1)
    corners = corners[:-8]
    if flipped:
        points = 2 - points
        corners = corners[:, ::-1]
    side = np.arange(-0.75, 3, 0.25)
    asked = np.roll(
        np.stack([*(grid.ravel() for grid in np.meshgrid(side, side)), np.full(225, 2.0)], axis=1), axis + 1, axis=1
    )
    asked = 2 - asked if flipped else asked
    plane = np.delete(asked, axis, axis=1)
    rim = ((plane == 0) | (plane == 2)).any(axis=1) & ((plane >= 0) & (plane <= 2)).all(axis=1)
    within = ((plane > 0) & (plane < 2)).all(axis=1)
    told = winding(points, corners, asked)
    assert told[within] == pytest.approx(np.full(within.sum(), 0.5), abs=1e-12)
    assert told[~within & ~rim] == pytest.approx(np.zeros((~within & ~rim).sum()), abs=1e-12)


def test_the_border_is_what_is_passed_more_one_way_than_the_other() -> None:
    assert border(np.empty((0, 3), dtype=np.intp)).tolist() == []
    assert border(np.array([[3, 1, 2]])).tolist() == [[1, 2], [3, 1], [2, 3]]
    assert border(np.array([[0, 1, 2], [1, 0, 3]])).tolist() == [[2, 0], [0, 3], [1, 2], [3, 1]]
    assert border(np.array([[0, 1, 2], [2, 1, 0]])).tolist() == []
    assert border(np.array([[0, 1, 2], [0, 1, 3]])).tolist() == [[0, 1], [0, 1], [2, 0], [3, 0], [1, 2], [1, 3]]
    assert border(np.array([[0, 0, 1]])).tolist() == []


def test_what_is_said_does_not_depend_on_order_or_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    points, corners = icosphere(3)
    corners = corners[points[corners].mean(axis=1)[:, 0] < 0.7]
    asked = np.random.default_rng(2).normal(size=(300, 3))
    monkeypatch.setattr(module, "_PART", 16)
    known = winding(points, corners, asked, threads=1)
    assert winding(points, corners, asked, threads=3).tolist() == known.tolist()
    assert winding(points, corners, asked[::-1])[::-1].tolist() == known.tolist()
    order = np.random.default_rng(3).permutation(len(corners))
    assert winding(points, np.roll(corners[order], 1, axis=1), asked) == pytest.approx(known, abs=1e-12)


def test_a_place_that_is_no_place_changes_nothing_of_the_others() -> None:
    points, corners = box()
    asked = np.array([[1.0, 1, 1], [np.nan, 1, 1], [1, -np.inf, 1], [1, 1, 1e-200], [5, 1, 1]])
    told = winding(points, corners, asked)
    assert told[[0, 4]].tolist() == [1, 0]
    assert np.isnan(told[1:4]).all()
    assert winding(points, np.empty((0, 3), dtype=np.intp), asked[:1]).tolist() == [0]
    assert len(winding(points, corners, np.empty((0, 3)))) == 0


def test_distances_are_negative_inside() -> None:
    told = signed(np.array([1.0, 2.0, 3.0, 4.0, 0.0]), np.array([1.0, 0.4, -1.0, np.nan, 0.6]))
    assert told[:3].tolist() == [-1, 2, 3]
    assert np.isnan(told[3])
    assert told[4] == 0
