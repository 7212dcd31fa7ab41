# SPDX-License-Identifier: MIT
"""Chains of near places, against a search that looks at every pair."""

import numpy as np
import pytest

from foparq.match import repeats as module
from foparq.match.repeats import repeats


def slow(places: np.ndarray, apart: float) -> list[int]:
    group = list(range(len(places)))
    changed = True
    while changed:
        changed = False
        for a in range(len(places)):
            for b in range(len(places)):
                if np.linalg.norm(places[a] - places[b]) <= apart and group[a] != group[b]:
                    group[a] = group[b] = min(group[a], group[b])
                    changed = True
    return group


@pytest.mark.parametrize("few", [300, 0])
@pytest.mark.parametrize("seed", range(10))
def test_chains_are_those_of_a_slow_search(seed: int, few: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_FEW", few)
    rng = np.random.default_rng(seed)
    places = np.round(rng.random((40, 3)), 1)
    assert repeats(places, apart=0.15).tolist() == slow(places, 0.15)


def test_exactly_apart_is_one_place_and_a_chain_is_one() -> None:
    assert repeats(np.array([[0.0], [0.25], [0.5], [1.0]]), apart=0.25).tolist() == [0, 0, 0, 3]


def test_nowhere_repeats_nothing() -> None:
    assert repeats(np.array([[np.nan], [np.nan], [1.0], [1.0]]), apart=1.0).tolist() == [0, 1, 2, 2]
    assert repeats(np.empty((0, 3)), apart=1.0).tolist() == []
