# SPDX-License-Identifier: MIT
"""What was set aside, not run or crashed, at the limit exactly and several at once."""

import pytest
from tests.evaluate.deliveries import drawing, drawn, messages, not_run, one, outcome, parameter, spec

from foparq.evaluate.quality import ElementStatus
from foparq.findings.because import Because
from foparq.findings.outcome import Status
from foparq.units import Quantity

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
HERE = drawn(drawing())
RATE = spec("faulty-rate", rules=("gap",), limit=Quantity(25, "%"))
BAD = outcome("gap", range(90), checked=100)
EVERY = ("faulty-rate", "found-rate")


def test_features_of_drawings_on_which_no_rule_ran_are_counted_apart() -> None:
    several = drawn(drawing(n=40), drawing("b.dxf", n=30), drawing("c.dxf", n=20))
    outcomes = [
        outcome("gap", range(4), checked=40), not_run("gap", Because.UNIT_UNKNOWN, "b.dxf"),
        not_run("gap", Because.NOTHING, "c.dxf"),
    ]  # fmt: skip
    element = one(RATE, delivery=several, outcomes=outcomes)
    assert (parameter(element, "not-run-on"), element.n, element.value) == (30.0, 40, 0.1)


@pytest.mark.parametrize(("faulty", "status"), [(16, UNDECIDED), (17, FAIL)])
def test_unchecked_drawings_are_given_the_benefit_up_to_the_limit(faulty: int, status: ElementStatus) -> None:
    both = drawn(drawing(n=32), drawing("b.dxf", n=32))
    outcomes = [outcome("gap", range(faulty), checked=32), not_run("gap", Because.UNIT_UNKNOWN, "b.dxf")]
    for kind in EVERY:
        share = spec(kind, rules=("gap", "sliver"), limit=Quantity(25, "%"))
        assert one(share, delivery=both, outcomes=[*outcomes, outcome("sliver", checked=32)]).status is status


@pytest.mark.parametrize(("aside", "status"), [(8, PASS), (9, UNDECIDED)])
def test_features_set_aside_may_bring_it_up_to_the_limit(aside: int, status: ElementStatus) -> None:
    outcomes = [outcome("gap", range(8), checked=64 - aside, unjudged=range(40, 40 + aside))]
    element = one(RATE, delivery=HERE, outcomes=outcomes)
    assert (element.status, parameter(element, "set-aside"), element.n) == (status, aside, 64)


@pytest.mark.parametrize(("found", "status"), [(3, PASS), (4, FAIL)])
def test_a_count_at_the_limit_passes(found: int, status: ElementStatus) -> None:
    count = spec("found-rate", rules=("gap",), limit=Quantity(3, "items"))
    assert one(count, delivery=HERE, outcomes=[outcome("gap", range(found), checked=64)]).status is status
    part = outcome("gap", range(1), checked=64, unjudged=range(20, 19 + found))
    assert one(count, delivery=HERE, outcomes=[part]).status is (PASS if status is PASS else UNDECIDED)


@pytest.mark.parametrize(("aside", "status"), [(8, PASS), (9, UNDECIDED)])
def test_a_share_of_faults_may_be_brought_up_to_the_limit(aside: int, status: ElementStatus) -> None:
    share = spec("found-rate", rules=("gap", "sliver"), limit=Quantity(25, "%"))
    part = outcome("gap", range(8), checked=64 - aside, unjudged=range(20, 20 + aside))
    assert one(share, delivery=HERE, outcomes=[part, outcome("sliver", checked=64)]).status is status


def test_an_item_at_fault_is_not_set_aside_as_well() -> None:
    outcomes = [outcome("gap", range(8), checked=60), outcome("sliver", checked=56, unjudged=range(8))]
    element = one(spec("faulty-rate", rules=("gap", "sliver")), delivery=HERE, outcomes=outcomes)
    assert (element.n, parameter(element, "set-aside"), parameter(element, "faulty")) == (64, 0.0, 8.0)


@pytest.mark.parametrize("kind", EVERY)
def test_a_crash_goes_before_a_failure_whatever_else_did_not_run(kind: str) -> None:
    asked = spec(kind, rules=("gap", "overshoot", "undershoot"), limit=Quantity(10, "%"))
    doubt = not_run("undershoot", Because.UNIT_UNKNOWN)
    element = one(asked, delivery=HERE, outcomes=[BAD, doubt, not_run("overshoot", Because.CRASHED)])
    assert (element.status, messages(element)) == (UNDECIDED, ["checks.crashed", "checks.unit-unknown"])
    without = one(asked, delivery=HERE, outcomes=[BAD, doubt, outcome("overshoot", checked=100)])
    assert (without.status, messages(without)[1:]) == (FAIL, ["checks.unit-unknown"])


@pytest.mark.parametrize("kind", EVERY)
def test_every_reason_not_to_have_run_is_told_with_its_drawings(kind: str) -> None:
    asked = spec(kind, rules=("gap", "overshoot"), limit=Quantity(10, "%"))
    both = drawn(drawing(), drawing("b.dxf"))
    outcomes = [
        outcome("gap", checked=100), not_run("gap", Because.UNIT_UNKNOWN, "b.dxf"),
        not_run("overshoot", Because.UNIT_UNKNOWN), not_run("overshoot", Because.UNIT_DOUBTFUL, "b.dxf"),
    ]  # fmt: skip
    element = one(asked, delivery=both, outcomes=outcomes)
    assert element.status is UNDECIDED
    said = {reason.message: dict(reason.fields)["files"] for reason in element.why}
    assert said == {"checks.unit-unknown": ["a.dxf", "b.dxf"], "checks.unit-doubtful": ["b.dxf"]}


def test_a_rule_on_trial_that_did_not_run_leaves_nothing_open() -> None:
    trial = outcome("overshoot", status=Status.NOT_RUN, because=Because.UNIT_UNKNOWN, preview=True)
    asked = spec("faulty-rate", rules=("gap", "overshoot"))
    assert one(asked, delivery=HERE, outcomes=[outcome("gap", checked=9), trial]).status is PASS


@pytest.mark.parametrize("kind", EVERY)
def test_what_ran_only_to_help_counts_nowhere(kind: str) -> None:
    helper = outcome("gap", range(90), checked=100, helper=True)
    element = one(spec(kind, rules=("gap",), limit=Quantity(10, "%")), delivery=HERE, outcomes=[helper])
    assert (element.status, element.value) == (ElementStatus.NOT_ASSESSED, None)
