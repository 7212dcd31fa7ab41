# SPDX-License-Identifier: MIT
"""One mesh under two names, and meshes that only look alike."""

from dataclasses import replace

import numpy as np
import pytest
from tests.attacks.surveyed_meshes import head
from tests.check.test_surface_ground import mesh
from tests.mesh.made import turn

from foparq.check.surfaces.alike import alike_meshes
from foparq.model.mesh import Mesh

FAR = np.array([712345.678, 7456789.123, 812.5])


def bust(path: str = "a.ply", facade: str = "", *, other: bool = False) -> Mesh:
    of = head(other=other)
    made = mesh(of.points, [tuple(face) for face in of.lists()], facade=facade)
    return replace(made, path=path)


def changed(points: np.ndarray, facade: str = "") -> Mesh:
    return replace(bust("b.ply", facade), points=points)


POINTS = bust().points
SAME = {
    "as it is": POINTS,
    "moved": POINTS + 3.5,
    "georeferenced": POINTS + FAR,
    "turned": POINTS @ turn(3).T,
    "mirrored": POINTS * [-1.0, 1.0, 1.0],
    "in single precision": POINTS.astype(np.float32).astype(float),
}


@pytest.mark.parametrize("name", SAME)
def test_the_same_vertices_are_one_mesh(name: str) -> None:
    (told,) = alike_meshes([bust(), changed(SAME[name])])
    assert (told.path, told.other) == ("a.ply", "b.ply")


def test_renumbered_and_in_another_unit_it_is_the_same() -> None:
    order = np.random.default_rng(4).permutation(len(POINTS))
    back = np.argsort(order)
    other = changed(POINTS[order])
    other = replace(
        other, corners=back[other.corners], points=other.points * 1000, unit=replace(other.unit, metres=0.001)
    )
    assert len(alike_meshes([bust(), other])) == 1


def test_another_scan_or_size_is_another_mesh() -> None:
    noise = np.random.default_rng(1).normal(0, 0.0005, POINTS.shape)
    assert alike_meshes([bust(), changed(POINTS + noise)]) == ()
    assert alike_meshes([bust(), changed(POINTS * 1.05)]) == ()
    assert alike_meshes([bust(), bust("c.ply", other=True)]) == ()


def test_one_facade_may_be_delivered_twice_and_two_may_not() -> None:
    assert alike_meshes([bust(facade="N"), changed(POINTS, "n")]) == ()
    assert [one[:4] for one in alike_meshes([bust(facade="N"), changed(POINTS, "S")])] == [("a.ply", "N", "b.ply", "S")]


def test_simple_solids_may_be_equal_and_empty_meshes_are_nothing() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    one = mesh(corners, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    assert alike_meshes([one, one, mesh(np.empty((0, 3)), []), mesh(np.full((200, 3), np.nan), [])]) == ()
