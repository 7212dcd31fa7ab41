# SPDX-License-Identifier: MIT
"""Places and outlines: against every assignment there is."""

from itertools import permutations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from foparq.match.assign import UNASSIGNED, assign

BOXES = np.array([shapely.box(x, 0, x + 1, 1.5) for x in (0, 3, 6)], dtype=object)


def gain(places: np.ndarray, within: float, outlines: np.ndarray, chosen: tuple[int, ...]) -> float:
    lengths = [shapely.distance(shapely.Point(*places[n]), outlines[m]) for n, m in enumerate(chosen) if m >= 0]
    return sum(within**2 - d**2 for d in lengths)


@settings(deadline=None)  # the first call loads a solver
@given(
    st.lists(st.tuples(st.floats(-1, 8), st.floats(-1, 2.5)), min_size=1, max_size=4), st.sampled_from([0.05, 0.5, 2.0])
)
def test_no_assignment_is_better(spots: list[tuple[float, float]], within: float) -> None:
    places = np.array(spots)
    found = assign(places, np.full(len(places), within), BOXES)
    taken = found[found != UNASSIGNED]
    assert len(set(taken.tolist())) == len(taken)
    every = set(permutations([*range(len(BOXES)), *[UNASSIGNED] * len(places)], len(places)))
    best = max(gain(places, within, BOXES, chosen) for chosen in every)
    reached = gain(places, within, BOXES, tuple(found.tolist()))
    assert reached >= best - 2e-3 * within**2 * len(places)
    for n, m in enumerate(found.tolist()):
        assert m == UNASSIGNED or shapely.distance(shapely.Point(*places[n]), BOXES[m]) <= within


def test_a_place_inside_its_outline_keeps_it_from_one_beside() -> None:
    places = np.array([[1.3, 0.5], [0.5, 0.5]])
    assert assign(places, np.full(2, 0.5), BOXES).tolist() == [UNASSIGNED, 0]


@pytest.mark.parametrize("order", [[0, 1], [1, 0]])
def test_of_outlines_that_hold_a_place_the_one_around_it_is_taken(order: list[int]) -> None:
    nested = np.array([shapely.box(0, 0, 10, 10), shapely.box(1, 1, 2, 2)], dtype=object)[order]
    assert assign(np.array([[1.5, 1.5], [5.0, 5.0]]), np.full(2, 0.1), nested).tolist() == [
        order.index(1),
        order.index(0),
    ]


def test_nothing_to_assign() -> None:
    none = np.empty(0, dtype=object)
    assert assign(np.zeros((1, 2)), np.ones(1), none).tolist() == [UNASSIGNED]
    assert assign(np.zeros((0, 2)), np.ones(0), BOXES).tolist() == []
    assert assign(np.full((1, 2), 100.0), np.ones(1), BOXES).tolist() == [UNASSIGNED]
