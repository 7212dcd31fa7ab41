# SPDX-License-Identifier: MIT
"""Arithmetic of one class on one facade: what is missing, and what is too much."""

import itertools

import pytest

from foparq.evaluate.balance import Balance


def test_of_what_nobody_drew_or_asked_for_nothing_is_missing_and_nothing_too_much() -> None:
    row = Balance(feature_class="window", facade="")
    assert (row.missing, row.missing_least, row.missing_net, row.surplus, row.surplus_most) == (0, 0, 0, 0, 0)
    asked = Balance(feature_class="window", facade="", required=1)
    assert (asked.missing, asked.missing_least, asked.missing_net, asked.surplus, asked.surplus_most) == (1, 1, 1, 0, 0)
    drawn = Balance(feature_class="window", facade="", delivered=1)
    assert (drawn.missing, drawn.missing_least, drawn.missing_net, drawn.surplus, drawn.surplus_most) == (0, 0, 0, 1, 1)


@pytest.mark.parametrize(("facade", "label"), [("", "window"), ("N", "window / N")])
def test_a_class_is_named_with_its_facade(facade: str, label: str) -> None:
    assert Balance(feature_class="window", facade=facade).label == label


@pytest.mark.parametrize(("required", "optional", "accepted"), list(itertools.product([0, 2, 5], [0, 1], [0, 1, 3])))
def test_every_feature_is_allowed_missing_or_too_much(required: int, optional: int, accepted: int) -> None:
    for delivered, more in itertools.product(range(9), [0, 1, 4]):
        row = Balance(
            feature_class="window", facade="N", required=required, optional=optional, accepted=accepted,
            delivered=delivered, most=delivered + more, pieces=delivered + more,
        )  # fmt: skip
        # One after the other: first those that are required are filled up, then the optional ones.
        found = min(delivered, required)
        assert row.missing == required - found
        assert row.surplus == delivered - found - min(delivered - found, optional)
        most = delivered + more
        assert row.missing_least == required - min(most, required)
        assert row.surplus_most == most - min(most, required + optional)
        assert row.missing_net == len(range(row.missing)[accepted:])
    # What was counted at least is there, whatever the other counts say.
    fewer = Balance(feature_class="window", facade="N", required=4, delivered=3, most=1, pieces=1)
    assert (fewer.missing_least, fewer.surplus_most) == (1, 0)
