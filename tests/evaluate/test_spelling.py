# SPDX-License-Identifier: MIT
"""Names of classes and facades, features that name no facade, and what an acceptance says of hidden layers."""

from dataclasses import replace

import numpy as np
import pytest
from tests.evaluate.deliveries import counted, drawing, drawn, judge, listed, messages, outcome, spec

from foparq.evaluate.balance import Incomparable, balances
from foparq.evaluate.quality import ElementStatus, Verdict

UNDECIDED = ElementStatus.UNDECIDED


def test_names_are_told_apart_without_regard_to_case_and_shown_as_the_list_has_them() -> None:
    rows = balances(listed(("Window", "n", 3), ("Window", "s", 1)), counted(("WINDOW", "N", 2), ("window", "S", 1)))
    assert [(row.feature_class, row.facade, row.required, row.delivered) for row in rows] == [
        ("Window", "n", 3, 2), ("Window", "s", 1, 1),
    ]  # fmt: skip


@pytest.mark.parametrize("count", [0, 1, 2])
def test_features_on_a_drawing_of_no_facade_leave_it_open(count: int) -> None:
    (row,) = balances(listed(("window", "N", 2)), counted(("window", "", count), ("window", "N", 2)))
    assert row.gap is (Incomparable.FACADE if count else Incomparable.NONE)
    assert row.delivered == (0 if count else 2)


def test_a_list_that_names_facades_of_some_rows_only_is_vague() -> None:
    rows = balances(listed(("window", "N", 2), ("window", "", 1)), counted(("window", "N", 3)))
    assert {row.gap for row in rows} == {Incomparable.FACADE}
    alone = balances(listed(("window", "", 3)), counted(("window", "N", 2), ("window", "S", 1), ("window", "", 1)))
    assert [(row.facade, row.delivered, row.gap) for row in alone] == [("", 4, Incomparable.NONE)]


def test_what_is_drawn_where_the_list_is_silent() -> None:
    rows = balances(
        listed(("window", "N", 2), ("door", "S", 1)),
        counted(("window", "N", 2), ("window", "S", 1), ("window", "E", 1), ("niche", "N", 1), ("niche", "S", 0)),
    )
    found = {row.label: (row.gap, row.surplus) for row in rows}
    assert found == {
        "door / S": (Incomparable.UNBOUND, 0), "niche / N": (Incomparable.UNLISTED, 1),
        "window / E": (Incomparable.UNLISTED, 1),
        "window / N": (Incomparable.NONE, 0), "window / S": (Incomparable.NONE, 1),
    }  # fmt: skip


def test_uses_and_excuses_are_added_by_class_and_facade() -> None:
    rows = listed(
        ("window", "N", 4), ("window", "N", 2, "optional"), ("window", "N", 3, "required", "OCCL", "foto"),
        ("window", "N", 1, "required", "OCCL", ""), ("window", "N", 9, "prohibited"), ("window", "S", 5),
    )  # fmt: skip
    north, south = balances(rows, counted(("window", "N", 4), ("window", "S", 5)))
    assert (north.required, north.optional, north.accepted, north.unproven) == (8, 2, 3, 1)
    assert (north.missing, north.missing_net, south.missing) == (4, 1, 0)


def test_layers_of_no_class_are_a_remark_with_their_items() -> None:
    delivery = drawn(drawing(classes={"J": "window"}), features=listed(("window", "N", 2)))
    counts = counted(("window", "N", 2), unmapped=(("A", 3), ("B", 4)))
    for element in judge(spec("omission"), spec("commission"), delivery=delivery, counts=counts).elements:
        assert messages(element)[-1] == "features.unmapped"
        said = dict(element.why[-1].fields)
        assert (said["layers"], said["n"], said["items"]) == (["A", "B"], 2, 7)


def test_an_acceptance_names_what_nobody_sees() -> None:
    part = drawing(n=4)
    items = replace(
        part.items, layer=np.array(["A", "B", "C", "B"], dtype=object), visible=np.array([True, False, False, False]),
        paper=np.array([False, False, True, False]),
    )  # fmt: skip
    report = judge(
        spec("faulty-rate", rules=("gap",)), delivery=drawn(replace(part, items=items)),
        outcomes=[outcome("gap", checked=4)],
    )  # fmt: skip
    assert report.verdict is Verdict.ACCEPTED
    hidden = next(reason for reason in report.remarks if reason.message == "verdict.hidden")
    assert dict(hidden.fields) == {"n": 2, "layers": ["B"]}
    plain = judge(
        spec("faulty-rate", rules=("gap",)), delivery=drawn(drawing(n=4)), outcomes=[outcome("gap", checked=4)]
    )
    assert "verdict.hidden" not in [reason.message for reason in plain.why]


@pytest.mark.parametrize(("faulty", "told"), [(0, False), (1, True)])
def test_an_acceptance_tells_faults_that_the_limit_allows(faulty: int, told: bool) -> None:  # noqa: FBT001
    report = judge(
        spec("faulty-rate", rules=("gap",)), delivery=drawn(drawing()),
        outcomes=[outcome("gap", range(faulty), checked=100)],
    )  # fmt: skip
    assert report.verdict is Verdict.ACCEPTED
    assert ("faulty.pass" in [reason.message for reason in report.why]) is told
