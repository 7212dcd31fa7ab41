# SPDX-License-Identifier: MIT
"""Pairs of triangles, drawn by hand and by chance, against rational arithmetic."""

from itertools import permutations

import numpy as np
import pytest
from tests.mesh import exact

from foparq.mesh.determinants import WORKSPACE
from foparq.mesh.trianglepairs import Meeting, meeting

BASE = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (0.0, 4.0, 0.0)]

#: what a second triangle does to the triangle BASE
DRAWN = [
    ("apart", [(5, 5, 0), (6, 5, 0), (5, 6, 0)], Meeting.NONE),
    ("above", [(0, 0, 1), (4, 0, 1), (0, 4, 1)], Meeting.NONE),
    ("in its plane's way, beside it", [(5, 5, -1), (5, 5, 1), (6, 6, 1)], Meeting.NONE),
    ("through its inside", [(1, 1, -1), (1, 1, 1), (2, 2, 0.5)], Meeting.TRANSVERSAL),
    ("through its border", [(1, 1, -1), (1, 1, 1), (9, 9, 0)], Meeting.TRANSVERSAL),
    ("vertex on its inside", [(1, 1, 0), (1, 1, 1), (2, 1, 1)], Meeting.CONTACT),
    ("vertex on its edge", [(2, 2, 0), (2, 2, 1), (3, 2, 1)], Meeting.CONTACT),
    ("edge on its inside", [(1, 1, 0), (2, 1, 0), (1, 1, 2)], Meeting.CONTACT),
    ("edge crosses its edge", [(2, 0, -1), (2, 0, 1), (2, -3, 0)], Meeting.CONTACT),
    ("edge on part of its edge", [(1, 0, 0), (2, 0, 0), (1, 0, 2)], Meeting.CONTACT),
    ("edge on part of its edge, in its plane", [(1, 0, 0), (2, 0, 0), (1, -3, 0)], Meeting.CONTACT),
    ("edge beyond its edge on the same line", [(5, 0, 0), (6, 0, 0), (5, 0, 2)], Meeting.NONE),
    ("vertex on its edge, in its plane", [(2, 2, 0), (3, 3, 0), (3, 4, 0)], Meeting.CONTACT),
    ("over part of it", [(1, 1, 0), (4, 4, 0), (1, 9, 0)], Meeting.COPLANAR),
    ("within it", [(1, 1, 0), (2, 1, 0), (1, 2, 0)], Meeting.COPLANAR),
    ("around it", [(-9, -9, 0), (30, -9, 0), (-9, 30, 0)], Meeting.COPLANAR),
    ("star", [(3, 3, 0), (-1, 3, 0), (3, -1, 0)], Meeting.COPLANAR),
    ("shares a vertex, leans away", [(0, 0, 0), (-1, 0, 1), (0, -1, 1)], Meeting.NONE),
    ("shares a vertex, stands on it", [(0, 0, 0), (1, 0, 1), (0, 1, 1)], Meeting.NONE),
    ("shares a vertex, passes through", [(0, 0, 0), (1, 1, -1), (1, 1, 1)], Meeting.TRANSVERSAL),
    ("shares a vertex, edge on its inside", [(0, 0, 0), (1, 1, 0), (1, 1, 1)], Meeting.CONTACT),
    ("shares a vertex, edge along its edge", [(0, 0, 0), (2, 0, 0), (0, 0, 1)], Meeting.CONTACT),
    ("shares a vertex, edge along its edge, in its plane", [(0, 0, 0), (2, 0, 0), (0, -1, 0)], Meeting.CONTACT),
    ("shares a vertex, goes on from its edge, in its plane", [(0, 0, 0), (-2, 0, 0), (0, -1, 0)], Meeting.NONE),
    ("shares a vertex, in its plane, apart", [(0, 0, 0), (-2, -1, 0), (-1, -2, 0)], Meeting.NONE),
    ("shares a vertex, over part of it", [(0, 0, 0), (2, 1, 0), (1, 2, 0)], Meeting.COPLANAR),
    ("shares a vertex, crosses at the plane", [(0, 0, 0), (-1, -1, -1), (-1, -1, 1)], Meeting.NONE),
    ("shares an edge", [(0, 0, 0), (4, 0, 0), (1, 1, 1)], Meeting.NONE),
    ("shares an edge, goes on flat", [(0, 0, 0), (4, 0, 0), (1, -1, 0)], Meeting.NONE),
    ("shares an edge, folded back", [(0, 0, 0), (4, 0, 0), (1, 1, 0)], Meeting.FOLD),
    ("shares an edge, folded far over", [(0, 0, 0), (4, 0, 0), (9, 9, 0)], Meeting.FOLD),
    ("the same", [(0, 0, 0), (4, 0, 0), (0, 4, 0)], Meeting.NONE),
]  # fmt: skip


def kind_of(points: np.ndarray, order: tuple[int, ...] = (0, 1, 2, 3, 4, 5)) -> Meeting:
    return Meeting(meeting(points, *order, np.empty(WORKSPACE)))


@pytest.mark.parametrize("turned", [False, True], ids=["in the plane z = 0", "in a slanted plane"])
@pytest.mark.parametrize(("second", "known"), [row[1:] for row in DRAWN], ids=[row[0] for row in DRAWN])
def test_two_triangles_meet_as_drawn(second: list[tuple[float, ...]], known: Meeting, turned: bool) -> None:  # noqa: FBT001
    points = np.array([*BASE, *second], dtype=float)
    if turned:
        # Whole numbers stay exact.
        points = points @ np.array([[2.0, 1.0, 3.0], [-1.0, 1.0, 1.0], [1.0, -2.0, 0.0]]) + [712345, 7456789, 812]
    for one in permutations((0, 1, 2)):
        for two in permutations((3, 4, 5)):
            assert kind_of(points, (*one, *two)) == known
            assert kind_of(points, (*two, *one)) == known


def test_a_shared_corner_is_one_by_its_number_too() -> None:
    points = np.array([*BASE, (1.0, 1.0, -1.0), (1.0, 1.0, 1.0)])
    assert kind_of(points, (0, 1, 2, 0, 3, 4)) == Meeting.TRANSVERSAL
    assert kind_of(points, (0, 1, 2, 0, 1, 4)) == Meeting.NONE


def test_zeros_of_both_signs_are_one_coordinate() -> None:
    points = np.array([*BASE, (-0.0, 0.0, -0.0), (4.0, -0.0, 0.0), (1.0, 1.0, 1.0)])
    assert kind_of(points) == Meeting.NONE


def test_the_least_step_decides() -> None:
    points = np.array([*BASE, (1.0, 1.0, 0.0), (1.0, 1.0, 1.0), (2.0, 1.0, 1.0)])
    assert kind_of(points) == Meeting.CONTACT
    for step, known in ((1e-90, Meeting.NONE), (-1e-90, Meeting.TRANSVERSAL)):
        points[3, 2] = step
        assert kind_of(points) == known


@pytest.mark.parametrize("seed", range(8))
def test_random_pairs_meet_as_rational_arithmetic_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    seen = set()
    for _ in range(400):
        points = rng.integers(0, 3, size=(6, 3)).astype(float)
        if seed % 4 == 1:
            points[:, 2] = points[:, 0]
        elif seed % 4 == 2:
            points = points / 10 + rng.choice([0.0, 1e-17], size=points.shape)
        elif seed % 4 == 3:
            points[:, 2] = points[:, 1] = points[:, 0] + points[:, 1] / 10
            points[:, 2] += rng.choice([0.0, 0.0, 0.5], size=6)
        whole, _ = exact.places(points)
        one, two = whole[:3], whole[3:]
        if exact.degenerate(one) or exact.degenerate(two):
            continue
        known, _ = exact.meeting(one, two)
        assert kind_of(points) == known, points.tolist()
        seen.add(known)
    assert len(seen) >= 3
