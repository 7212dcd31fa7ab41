# SPDX-License-Identifier: MIT
"""Patterns of layers, and what is left of the time of a part."""

from types import SimpleNamespace

import numpy as np
import pytest

from foparq.check.bounds import budget_of
from foparq.model.layers import literal, matches, matching
from foparq.profile.schema import LimitsSpec

NAMES = np.array(["PAREDE", "parede-2", "PORTA", "A*B", "A[1]", "Ação"], dtype=object)


@pytest.mark.parametrize(
    ("patterns", "known"),
    [
        (("*",), [True] * 6), (("PAREDE",), [True, False, False, False, False, False]),
        (("parede*",), [True, True, False, False, False, False]),
        (("PORTA", "PAREDE-?"), [False, True, True, False, False, False]),
        (("P[AO]R*",), [True] * 3 + [False] * 3),
        (("AÇÃO",), [False] * 5 + [True]), ((), [False] * 6), (("nada*",), [False] * 6),
    ],
)  # fmt: skip
def test_layers_by_pattern(patterns: tuple[str, ...], known: list[bool]) -> None:
    assert matching(NAMES, patterns).tolist() == known
    assert [matches(name, patterns) for name in NAMES] == known
    assert matching(NAMES[::-1], patterns).tolist() == known[::-1]
    assert matching(NAMES[:0], patterns).tolist() == []


@pytest.mark.parametrize("name", NAMES)
def test_a_literal_pattern_matches_its_layer_alone(name: str) -> None:
    assert matching(NAMES, (literal(name),)).tolist() == [other == name for other in NAMES]


def test_what_a_run_may_use_grows_with_the_part_and_shrinks_with_what_was_spent() -> None:
    limits = LimitsSpec(check_seconds=30, check_seconds_per_million=60, check_memory=5)
    part = SimpleNamespace(vertices=500_000, held=0)
    fresh, later, over = (budget_of(part, limits, spent) for spent in (0.0, 45.0, 61.0))  # type: ignore[arg-type]
    assert (fresh.seconds, fresh.memory) == (60.0, 5)
    assert (later.seconds, over.seconds) == (15.0, 0.0)
    # One call may use a third of all, however much was spent before.
    assert fresh.at_once == later.at_once == over.at_once == 20.0
