# SPDX-License-Identifier: MIT
"""Omission and commission by counts, class by class and facade by facade."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.evaluate.deliveries import (
    counted,
    drawing,
    drawn,
    judge,
    listed,
    messages,
    not_run,
    one,
    parameter,
    source,
    spec,
)

from foparq.evaluate.balance import balances
from foparq.evaluate.quality import ElementStatus, Verdict
from foparq.findings.because import Because
from foparq.model.delivery import Delivery, SourceStatus
from foparq.model.drawing import Bomb

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
Q4, Q5 = spec("commission", id="Q4"), spec("omission", id="Q5")
UNKNOWN = drawing("b.dxf", classes={"JANELA": "window"}, metres=None)
BOUND = drawing(classes={"JANELA": "window", "PORTA": "door"})


def both(rows: list, counts: list, *, drawings: tuple = (BOUND,), lost: tuple = (), unmapped: tuple = ()) -> tuple:
    delivery = drawn(*drawings, features=listed(*rows), lost=lost)
    report = judge(Q4, Q5, delivery=delivery, counts=counted(*counts, unmapped=unmapped))
    return report.elements


def test_the_station_omits_5_of_142() -> None:
    commission, omission = both([("window", "N", 100), ("door", "N", 42)], [("window", "N", 96), ("door", "N", 41)])
    assert (omission.status, omission.value, omission.n, omission.measure_id) == (PASS, 5 / 142, 142, "7")
    assert f"{omission.value:.2%}" == "3.52%"
    assert omission.details == (("door / N", 1.0, 42.0), ("window / N", 4.0, 100.0))
    assert (commission.status, commission.value, commission.measure_id) == (PASS, 0.0, "3")


def test_the_limit_itself_passes_and_one_more_fails() -> None:
    assert both([("window", "N", 100)], [("window", "N", 95)])[1].status is PASS
    assert both([("window", "N", 100)], [("window", "N", 94)])[1].status is FAIL


def test_one_surplus_feature_fails() -> None:
    commission, omission = both([("window", "N", 10)], [("window", "N", 11)])
    assert (commission.status, commission.value, omission.status) == (FAIL, 0.1, PASS)
    assert parameter(commission, "share-of-delivered") == pytest.approx(1 / 11)


def test_a_surplus_on_one_facade_never_makes_good_a_deficit_on_another() -> None:
    rows, counts = [("window", "N", 10), ("window", "S", 10)], [("window", "N", 12), ("window", "S", 8)]
    commission, omission = both(rows, counts)
    assert (commission.status, omission.status) == (FAIL, FAIL)
    assert (parameter(commission, "surplus"), parameter(omission, "missing")) == (2.0, 2.0)


def test_optional_features_may_be_drawn_or_not() -> None:
    for count in (10, 12, 13):
        commission, omission = both([("window", "N", 10), ("window", "N", 3, "optional")], [("window", "N", count)])
        assert (commission.status, omission.status) == (PASS, PASS)
    assert both([("window", "N", 10), ("window", "N", 3, "optional")], [("window", "N", 14)])[0].status is FAIL


def test_prohibited_features_are_surplus() -> None:
    commission, omission = both(
        [("window", "N", 9), ("door", "N", 1, "prohibited")], [("window", "N", 9), ("door", "N", 1)]
    )
    assert (commission.status, omission.status) == (FAIL, PASS)
    alone = both([("door", "N", 1, "prohibited")], [("door", "N", 2)])
    assert (alone[0].status, alone[0].value) == (FAIL, None)
    assert (alone[1].status, messages(alone[1])) == (ElementStatus.NOT_ASSESSED, ["omission.nothing-required"])
    none = both([("door", "N", 1, "prohibited")], [("door", "N", 0)])
    assert (none[0].status, none[0].value) == (PASS, 0.0)


def test_accepted_omissions_are_shown_and_gross_decides() -> None:
    rows = [
        ("window", "N", 92),
        ("window", "N", 6, "required", "OCCL", "foto 12"),
        ("window", "N", 2, "required", "OCCL", ""),
    ]
    _, omission = both(rows, [("window", "N", 92)])
    assert (omission.status, omission.value) == (FAIL, 0.08)
    assert (parameter(omission, "missing-net"), parameter(omission, "net-rate")) == (2.0, 0.02)
    assert messages(omission) == ["omission.fail", "omission.net", "omission.unproven"]


# --- what cannot be compared -----------------------------------------------------------------------------------------


def test_no_layer_bound_to_a_class_is_no_evidence_of_omission() -> None:
    commission, omission = both([("window", "N", 100), ("door", "N", 20)], [("window", "N", 100)])
    assert (omission.status, messages(omission)) == (UNDECIDED, ["features.unbound"])
    assert dict(omission.why[0].fields)["classes"] == ["door / N"]
    assert (omission.value, parameter(omission, "not-compared")) == (0.0, 20.0)
    assert commission.status is UNDECIDED


def test_a_class_bound_and_never_drawn_is_omitted() -> None:
    _, omission = both([("window", "N", 100), ("door", "N", 20)], [("window", "N", 100), ("door", "N", 0)])
    assert (omission.status, omission.value) == (FAIL, 20 / 120)


def test_enough_missing_elsewhere_fails_all_the_same() -> None:
    rows = [("window", "N", 100), ("door", "N", 100)]
    assert both(rows, [("window", "N", 89)])[1].status is FAIL  # 11 of 200
    assert both(rows, [("window", "N", 90)])[1].status is UNDECIDED  # 10 of 200


@pytest.mark.parametrize(
    ("rows", "counts"),
    [
        ([("window", "N", 10)], [("window", "", 10)]),
        ([("window", "N", 10), ("window", "", 10)], [("window", "N", 20)]),
    ],
)
def test_a_facade_that_only_one_side_names(rows: list, counts: list) -> None:
    commission, omission = both(rows, counts)
    assert (omission.status, messages(omission)) == (UNDECIDED, ["features.facade"])
    assert (commission.status, commission.value) == (UNDECIDED, None)


def test_a_facade_that_no_drawing_shows_may_be_another_name_of_one() -> None:
    """Two doors of "Norte" and two that are drawn on "N": neither is proven missing, nor in surplus."""
    rows, counts = [("window", "N", 20), ("door", "Norte", 2)], [("window", "N", 20), ("door", "N", 2)]
    commission, omission = both(rows, counts)
    assert (commission.status, omission.status) == (UNDECIDED, UNDECIDED)
    # Where each facade of the list is drawn, what is drawn on the other one is a surplus.
    other, _ = both(rows, [*counts, ("window", "Norte", 0)])
    assert (other.status, other.value) == (FAIL, 2 / 20)  # doors of Norte have no layer: not compared


def test_a_list_without_facades_counts_all_of_them() -> None:
    _, omission = both([("window", "", 20)], [("window", "N", 12), ("window", "S", 8)])
    assert (omission.status, omission.value) == (PASS, 0.0)


def test_a_list_that_is_silent_prohibits_nothing() -> None:
    commission, omission = both([("window", "N", 10)], [("window", "N", 10), ("door", "N", 3)])
    assert (commission.status, messages(commission)) == (UNDECIDED, ["features.unlisted"])
    assert omission.status is PASS
    facade, _ = both([("window", "N", 10)], [("window", "N", 10), ("window", "S", 3)])
    assert (facade.status, messages(facade)) == (UNDECIDED, ["features.unlisted"])


def test_a_class_and_a_facade_that_the_list_knows_leave_no_room() -> None:
    rows = [("window", "N", 10), ("door", "S", 1)]
    commission, _ = both(rows, [("window", "N", 10), ("door", "S", 1), ("window", "S", 3)])
    assert (commission.status, parameter(commission, "surplus")) == (FAIL, 3.0)


def test_layers_without_a_class_are_named_and_never_count() -> None:
    commission, omission = both([("window", "N", 10)], [("window", "N", 10)], unmapped=(("TEXTO", 40), ("COTAS", 7)))
    assert (commission.status, omission.status) == (PASS, PASS)
    for element in (commission, omission):
        assert messages(element)[-1] == "features.unmapped"
        assert dict(element.why[-1].fields)["items"] == 47


# --- no evidence -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("delivery", "status", "message"),
    [
        (drawn(BOUND), ElementStatus.NOT_ASSESSED, "features.no-list"),
        (drawn(BOUND, features=listed()), ElementStatus.NOT_ASSESSED, "features.no-list"),
        (drawn(drawing(), features=listed(("window", "N", 1))), ElementStatus.NOT_ASSESSED, "features.no-classes"),
        (drawn(features=listed(("window", "N", 1))), ElementStatus.NOT_ASSESSED, "checks.no-drawing"),
        (drawn(BOUND, features=listed(("window", "N", 1))), ElementStatus.NOT_ASSESSED, "features.not-counted"),
        (drawn(UNKNOWN, features=listed(("window", "N", 1))), UNDECIDED, "features.unit-unknown"),
        (drawn(features=listed(("window", "N", 1)), lost=["a.dxf"]), UNDECIDED, "unseen.file"),
        (Delivery(title="", sources=(source("f.csv", "features", SourceStatus.REFUSED),)), UNDECIDED, "features.lost"),
    ],
)  # fmt: skip
def test_without_list_or_classes_nothing_is_assessed(delivery: Delivery, status: ElementStatus, message: str) -> None:
    report = judge(Q4, Q5, delivery=delivery)
    for element in report.elements:
        assert (element.status, element.value, messages(element)) == (status, None, [message])
    assert report.verdict is Verdict.UNDECIDED


HIDDEN = [
    {"drawings": (drawing(classes={"A": "window"}, bombs=(Bomb(block="B", layer="0", handle="", entities=9),)),)},
    {"lost": ("b.dxf",)},
    {"drawings": (BOUND, UNKNOWN)},
]


@pytest.mark.parametrize("hidden", HIDDEN)
def test_what_nobody_saw_may_hold_the_missing_and_the_surplus(hidden: dict) -> None:
    rows = [("window", "N", 10)]
    commission, omission = both(rows, [("window", "N", 5)], **hidden)
    assert (commission.status, omission.status) == (UNDECIDED, UNDECIDED)
    assert messages(omission)[0] == "omission.hidden"
    surplus, complete = both(rows, [("window", "N", 11)], **hidden)
    assert (surplus.status, complete.status) == (FAIL, PASS)


def test_a_doubtful_unit_leaves_counts_without_meaning() -> None:
    delivery = drawn(BOUND, features=listed(("window", "N", 10)))
    for count in (0, 10, 11):
        report = judge(
            Q4,
            Q5,
            delivery=delivery,
            counts=counted(("window", "N", count)),
            outcomes=[not_run("gap", Because("unit-doubtful"))],
        )
        for element in report.elements:
            assert (element.status, messages(element)) == (UNDECIDED, ["features.unit-doubtful"])


def test_no_limit_decides_nothing() -> None:
    delivery = drawn(BOUND, features=listed(("window", "N", 1)))
    for kind in ("omission", "commission"):
        element = one(spec(kind, limit=None), delivery=delivery, counts=counted(("window", "N", 1)))
        assert (element.status, messages(element)) == (UNDECIDED, ["limit.none"])


# --- counts that are an interval -------------------------------------------------------------------------------------

CASES = [  # fewest, most, most of opened blocks; required: commission and omission
    ((20, 40, 40), 20, (UNDECIDED, PASS)), ((10, 20, 20), 20, (PASS, UNDECIDED)), ((1, 1, 20), 20, (PASS, UNDECIDED)),
    ((1, 1, 20), 40, (PASS, FAIL)), ((25, 30, 30), 20, (FAIL, PASS)), ((10, 30, 30), 20, (UNDECIDED, UNDECIDED)),
    ((94, 94, 94), 100, (PASS, FAIL)), ((94, 95, 95), 100, (PASS, UNDECIDED)), ((95, 100, 100), 100, (PASS, PASS)),
]  # fmt: skip


@pytest.mark.parametrize(("numbers", "required", "expected"), CASES)
def test_an_interval_decides_where_both_ends_do(numbers: tuple, required: int, expected: tuple) -> None:
    count, most, pieces = (np.array([number], dtype=np.intp) for number in numbers)
    counts = replace(counted(("window", "N", numbers[0])), count=count, most=most, pieces=pieces)
    delivery = drawn(BOUND, features=listed(("window", "N", required)))
    elements = judge(Q4, Q5, delivery=delivery, counts=counts).elements
    assert tuple(element.status for element in elements) == expected
    for element, kind in zip(elements, ("commission", "omission"), strict=True):
        assert (f"{kind}.interval" in messages(element)) == (element.status is UNDECIDED)
    omission = elements[1]
    assert omission.value == max(0, required - numbers[0]) / required
    if numbers[2] > numbers[0] and omission.value:
        assert parameter(omission, "missing-least") == max(0, required - numbers[2])


def test_hidden_layers_excuse_their_own_class_only() -> None:
    rows = [("window", "N", 100), ("door", "N", 100)]
    hidden = (("window", "N", "JANELA-OFF"),)
    for windows, doors, status in ((50, 100, UNDECIDED), (50, 90, UNDECIDED), (50, 89, FAIL), (100, 100, PASS)):
        counts = replace(counted(("window", "N", windows), ("door", "N", doors)), hidden=hidden)
        omission = one(Q5, delivery=drawn(BOUND, features=listed(*rows)), counts=counts)
        assert omission.status is status
        assert ("omission.hidden-layers" in messages(omission)) == (status is UNDECIDED)


def test_case_tells_no_names_apart_and_the_list_spells_them() -> None:
    _, omission = both([("Window", "n", 10), ("window", "N", 10)], [("WINDOW", "N", 15), ("window", "n", 5)])
    assert (omission.status, omission.n, omission.value) == (PASS, 20, 0.0)
    assert omission.details == (("Window / N", 0.0, 20.0),)


# --- properties ------------------------------------------------------------------------------------------------------

KEYS = st.tuples(st.sampled_from("abc"), st.sampled_from(["", "N", "S"]), st.integers(0, 9))
USES = st.sampled_from(["required", "optional", "prohibited"])


@given(
    st.lists(st.tuples(KEYS, USES), min_size=1, max_size=12),
    st.lists(KEYS, max_size=8),
    st.randoms(use_true_random=False),
)
def test_order_changes_nothing_and_every_feature_is_counted_once(rows: list, counts: list, rng: object) -> None:
    table = listed(*((*key, use) for key, use in rows))
    delivered = counted(*counts)
    found = balances(table, delivered)
    assert sum(row.required for row in found) == sum(key[2] for key, use in rows if use == "required")
    assert sum(row.optional for row in found) == sum(key[2] for key, use in rows if use == "optional")
    assert sum(row.delivered for row in found) <= int(np.sum(delivered.count))
    assert all(row.missing * row.surplus == 0 for row in found)
    rng.shuffle(rows)  # type: ignore[attr-defined]
    rng.shuffle(counts)  # type: ignore[attr-defined]
    again = balances(listed(*((*key, use) for key, use in rows)), counted(*counts))
    # Ids are given in order of rows.
    assert [replace(row, ids=()) for row in again] == [replace(row, ids=()) for row in found]
