# SPDX-License-Identifier: MIT
"""Logical consistency: rates over the features checked, and what leaves them open."""

import numpy as np
import pytest
from tests.evaluate.deliveries import drawing, drawn, judge, messages, not_run, one, outcome, parameter, spec

from foparq.evaluate.quality import ElementStatus, Verdict
from foparq.evaluate.remarks import deciding
from foparq.findings.because import Because
from foparq.findings.outcome import SetAside, Status
from foparq.model.drawing import Bomb, Skipped, SkippedReason
from foparq.units import Quantity

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
RULES = ("undershoot", "overshoot", "gap")
Q3 = spec("faulty-rate", id="Q3", rules=RULES)
HERE = drawn(drawing())

SIX = range(50, 56)


def clean(*but: str, checked: int = 100, source: str = "a.dxf") -> list:
    return [outcome(name, checked=checked, source=source) for name in RULES if name not in but]


# --- counting --------------------------------------------------------------------------------------------------------


def test_the_station_before_correction() -> None:
    """976 features, 2 overlaps, 64 overshoots and undershoots, no gaps: 66 at fault pass 10 %."""
    outcomes = [
        outcome("line-overlap", range(2), checked=976), outcome("undershoot", range(2, 40), checked=976),
        outcome("overshoot", range(40, 66), checked=976), not_run("gap", Because.NOTHING),
    ]  # fmt: skip
    whole = spec("faulty-rate", id="Q3", rules=("line-overlap", "undershoot", "overshoot", "gap"))
    overlap = spec("found-rate", id="Q3-overlap", required=False, rules=("line-overlap",))
    dangle = spec("found-rate", id="Q3-dangle", required=False, rules=("undershoot", "overshoot"))
    gap = spec("found-rate", id="Q3-gap", required=False, rules=("gap",))
    report = judge(whole, overlap, dangle, gap, delivery=HERE, outcomes=outcomes)
    q3, q3_overlap, q3_dangle, q3_gap = report.elements
    assert (q3.status, q3.n, q3.value) == (PASS, 976, 66 / 976)
    assert (q3_overlap.value, q3_overlap.n) == (2 / 976, 976)
    assert (q3_dangle.value, q3_dangle.n) == (64 / 976, 976)
    assert f"{q3_overlap.value:.1%} {q3_dangle.value:.1%}" == "0.2% 6.6%"
    assert (q3_dangle.status, q3_dangle.measure_id) == (ElementStatus.REPORTED, "foparq:found-rate")
    assert (parameter(q3_dangle, "measure-23"), parameter(q3_dangle, "measure-24")) == (38.0, 26.0)
    assert (q3_gap.status, messages(q3_gap)) == (ElementStatus.NOT_ASSESSED, ["checks.nothing"])
    assert report.verdict is Verdict.ACCEPTED


def test_a_feature_with_several_faults_counts_once() -> None:
    outcomes = [
        outcome("undershoot", [1, 2], checked=10, found=5),
        outcome("overshoot", [2, 3], checked=10),
        *clean("undershoot", "overshoot", checked=10),
    ]
    element = one(Q3, delivery=HERE, outcomes=outcomes)
    assert (parameter(element, "faulty"), element.value) == (3.0, 0.3)
    assert element.details[:2] == (("undershoot", 5.0, 10.0), ("overshoot", 2.0, 10.0))


@pytest.mark.parametrize(("faulty", "status"), [(9, PASS), (10, PASS), (11, FAIL)])
def test_the_limit_itself_passes(faulty: int, status: ElementStatus) -> None:
    outcomes = [outcome("undershoot", range(faulty), checked=100), *clean("undershoot")]
    assert one(Q3, delivery=HERE, outcomes=outcomes).status is status


def test_features_of_several_drawings_are_added_and_rows_never_mixed() -> None:
    outcomes = [
        outcome("undershoot", [0, 1], checked=10), outcome("undershoot", [0, 1], checked=20, source="b.dxf"),
        *clean("undershoot", checked=4), *clean("undershoot", checked=30, source="b.dxf"),
    ]  # fmt: skip
    element = one(Q3, delivery=drawn(drawing(), drawing("b.dxf")), outcomes=outcomes)
    assert (element.n, parameter(element, "faulty")) == (10 + 30, 2.0 + 2.0)


def test_scopes_of_one_rule_are_added_but_never_beyond_the_drawing() -> None:
    apart = [outcome("gap", [n], checked=40) for n in range(2)]
    both = [*apart, *clean("gap", checked=10)]
    assert one(Q3, delivery=drawn(drawing(n=200)), outcomes=both).n == 80
    assert one(Q3, delivery=drawn(drawing(n=50)), outcomes=both).n == 50


def test_features_set_aside_stay_in_the_denominator() -> None:
    outcomes = [
        outcome("duplicate", range(5), checked=100),
        *(outcome(name, checked=95, unjudged=range(5)) for name in RULES),
    ]
    element = one(spec("faulty-rate", rules=("duplicate", *RULES)), delivery=HERE, outcomes=outcomes)
    assert (element.n, element.value, element.status) == (100, 0.05, PASS)
    assert parameter(element, "set-aside") == 0.0


def test_features_set_aside_for_uncounted_faults_may_leave_it_open() -> None:
    outcomes = [
        outcome("invalid-geometry", SIX, checked=100), outcome("undershoot", range(5), checked=94, unjudged=SIX),
        *(outcome(name, checked=94, unjudged=SIX) for name in ("overshoot", "gap")),
    ]  # fmt: skip
    element = one(Q3, delivery=HERE, outcomes=outcomes)
    assert (element.status, messages(element)) == (UNDECIDED, ["faulty.aside"])
    assert parameter(element, "set-aside") == 6.0
    few = [part for part in outcomes if part.name != "undershoot"]
    four = outcome("undershoot", range(4), checked=94, unjudged=SIX)
    assert one(Q3, delivery=HERE, outcomes=[*few, four]).status is PASS


def test_only_what_was_set_aside_counts_as_set_aside() -> None:
    noted = outcome("free-end", range(20, 60), checked=100)
    element = one(
        Q3, delivery=HERE, outcomes=[noted, outcome("undershoot", range(10), checked=100), *clean("undershoot")]
    )
    assert (element.status, parameter(element, "set-aside")) == (PASS, 0.0)


@pytest.mark.parametrize("note", ["free-end", "shared-edge"])
def test_the_number_of_notes_stands_beside_the_rate_and_changes_nothing(note: str) -> None:
    twice = [outcome(note, range(n, n + 3), checked=100) for n in (20, 40)]
    plain = one(Q3, delivery=HERE, outcomes=clean())
    element = one(Q3, delivery=HERE, outcomes=[*twice, *clean()])
    assert (element.status, element.value) == (plain.status, plain.value) == (PASS, 0.0)
    (remark,) = set(element.why) - set(plain.why)
    assert remark.message == {"free-end": "faulty.free", "shared-edge": "faulty.shared"}[note]
    assert dict(remark.fields)["n"] == 6
    assert remark not in deciding(element)


def test_items_that_a_rule_could_not_judge_are_named() -> None:
    odd = SetAside(item="2A", layer="PISO", rule="")
    outcomes = [outcome("gap", checked=99, unjudged=[7], aside=(odd,)), *clean("gap")]
    (remark,) = (why for why in one(Q3, delivery=HERE, outcomes=outcomes).why if why.message == "checks.unfit")
    assert dict(remark.fields)["items"] == ["2A (PISO)"]


# --- rules that did not run ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("because", [because for because in Because if because.opens])
def test_a_rule_that_could_not_run_leaves_it_open(because: Because) -> None:
    element = one(Q3, delivery=HERE, outcomes=[not_run("gap", because), *clean("gap")])
    assert element.status is UNDECIDED
    assert messages(element) == [f"checks.{because}"]


def test_every_reason_leaves_the_question_open_but_for_two() -> None:
    assert {because for because in Because if not because.opens} == {Because.RAN, Because.NOTHING}


def test_nothing_to_check_is_no_doubt() -> None:
    assert one(Q3, delivery=HERE, outcomes=[not_run("gap", Because.NOTHING), *clean("gap")]).status is PASS


def test_nothing_to_check_anywhere_is_no_pass() -> None:
    outcomes = [not_run(name, Because.NOTHING) for name in RULES]
    element = one(Q3, delivery=HERE, outcomes=outcomes)
    assert (element.status, element.value, messages(element)) == (ElementStatus.NOT_ASSESSED, None, ["checks.nothing"])


def test_unknown_unit_on_every_drawing_is_undecided() -> None:
    element = one(Q3, delivery=HERE, outcomes=[not_run(name, Because.UNIT_UNKNOWN) for name in RULES])
    assert (element.status, messages(element)) == (UNDECIDED, ["checks.unit-unknown"])


def test_a_rule_that_is_not_part_of_the_audit_is_not_assessed() -> None:
    element = one(Q3, delivery=HERE, outcomes=clean("gap"))
    assert (element.status, messages(element)) == (ElementStatus.NOT_ASSESSED, ["checks.absent"])
    bad = [outcome("undershoot", range(50), checked=100), outcome("overshoot", checked=100)]
    assert one(Q3, delivery=HERE, outcomes=bad).status is FAIL


def test_no_drawing() -> None:
    element = one(Q3, delivery=drawn())
    assert (element.status, messages(element)) == (ElementStatus.NOT_ASSESSED, ["checks.no-drawing"])


def test_a_crash_is_never_the_deliverys_fault() -> None:
    outcomes = [
        outcome("undershoot", range(90), checked=100),
        not_run("gap", Because.CRASHED),
        outcome("overshoot", checked=100),
    ]
    report = judge(Q3, delivery=HERE, outcomes=outcomes)
    assert (report.elements[0].status, messages(report.elements[0])) == (UNDECIDED, ["checks.crashed"])
    assert report.verdict is Verdict.UNDECIDED


def test_faults_on_one_drawing_reject_only_if_the_unchecked_one_cannot_outweigh_them() -> None:
    outcomes = [
        outcome("undershoot", range(20), checked=100), *clean("undershoot"),
        *(not_run(name, Because("unit-unknown"), "b.dxf") for name in RULES),
    ]  # fmt: skip
    small = drawn(drawing(n=100), drawing("b.dxf", n=50))
    large = drawn(drawing(n=100), drawing("b.dxf", n=150))
    assert one(Q3, delivery=small, outcomes=outcomes).status is FAIL  # 20 of 150
    assert one(Q3, delivery=large, outcomes=outcomes).status is UNDECIDED  # 20 of 250


# --- parts that nobody saw -------------------------------------------------------------------------------------------

UNSEEN = {
    "unseen.block": drawn(drawing(bombs=(Bomb(block="B", layer="0", handle="2F", entities=-1),))),
    "unseen.skipped": drawn(
        drawing(skipped=(Skipped(reason=SkippedReason.EXTERNAL_REFERENCE, kind="INSERT", layer="0", count=1),))
    ),
    "unseen.file": drawn(drawing(), lost=["b.dxf"]),
}


@pytest.mark.parametrize("message", UNSEEN)
def test_what_nobody_saw_turns_a_pass_but_not_a_failure(message: str) -> None:
    element = one(Q3, delivery=UNSEEN[message], outcomes=clean())
    assert (element.status, messages(element)) == (UNDECIDED, [message])
    bad = [outcome("undershoot", range(50), checked=100), *clean("undershoot")]
    failed = one(Q3, delivery=UNSEEN[message], outcomes=bad)
    assert (failed.status, messages(failed)) == (FAIL, ["faulty.fail", message])


@pytest.mark.parametrize(
    ("reason", "kind"), [("paper-space", "LINE"), ("image", "IMAGE"), ("unlisted-view", "view"), ("not-asked", "POINT")]
)
def test_what_is_no_linework_of_the_delivery_hides_nothing(reason: str, kind: str) -> None:
    part = drawing(skipped=(Skipped(reason=SkippedReason(reason), kind=kind, layer="0", count=3),))
    assert one(Q3, delivery=drawn(part), outcomes=clean()).status is PASS


# --- rules on trial --------------------------------------------------------------------------------------------------


def test_a_rule_on_trial_never_rejects_and_is_named() -> None:
    trial = outcome("gap", range(90), checked=100, preview=True)
    element = one(Q3, delivery=HERE, outcomes=[trial, *clean("gap")])
    assert (element.status, element.value) == (PASS, 0.0)
    assert messages(element) == ["faulty.pass", "checks.preview"]


def test_rules_on_trial_alone_are_no_evidence() -> None:
    outcomes = [outcome(name, checked=100, preview=True) for name in RULES]
    assert one(Q3, delivery=HERE, outcomes=outcomes).status is ElementStatus.NOT_ASSESSED


# --- found faults ----------------------------------------------------------------------------------------------------


def test_a_count_with_a_limit_in_items_is_the_measure_of_the_standard() -> None:
    count = spec("found-rate", rules=("undershoot",), limit=Quantity(2, "items"))
    two = one(count, delivery=HERE, outcomes=[outcome("undershoot", [1, 5], checked=50)])
    assert (two.status, two.measure_id, two.value, two.unit) == (PASS, "23", 2.0, "items")
    assert parameter(two, "rate") == 0.04
    three = one(count, delivery=HERE, outcomes=[outcome("undershoot", [1, 5, 6], checked=50)])
    assert (three.status, messages(three)) == (FAIL, ["found.fail"])


def test_a_rate_with_a_limit() -> None:
    rate = spec("found-rate", rules=("undershoot", "overshoot"), limit=Quantity(1, "%"))
    outcomes = [outcome("undershoot", [1], checked=200), outcome("overshoot", [1], checked=200)]
    assert one(rate, delivery=HERE, outcomes=outcomes).status is PASS
    assert one(rate, delivery=HERE, outcomes=[*outcomes[:1], outcome("overshoot", [1, 2], checked=200)]).status is FAIL
    assert one(rate, delivery=UNSEEN["unseen.block"], outcomes=outcomes).status is UNDECIDED
    assert one(rate, delivery=HERE, outcomes=outcomes[:1]).status is ElementStatus.NOT_ASSESSED
    assert one(rate, delivery=HERE, outcomes=[outcomes[0], not_run("overshoot", Because.CRASHED)]).status is UNDECIDED
    aside = [
        outcome("undershoot", [1], checked=190, unjudged=range(20, 30)),
        outcome("overshoot", [1], checked=190, unjudged=range(20, 30)),
    ]
    assert messages(one(rate, delivery=HERE, outcomes=aside)) == ["found.aside"]


def test_a_required_rate_without_a_limit_is_undecided() -> None:
    element = one(spec("found-rate", rules=("gap",)), delivery=HERE, outcomes=[outcome("gap", checked=10)])
    assert (element.status, messages(element)) == (UNDECIDED, ["limit.none", "found.reported"])


def test_a_rate_that_nobody_requires_needs_no_limit() -> None:
    optional = spec("found-rate", rules=("gap",), required=False)
    element = one(optional, delivery=HERE, outcomes=[outcome("gap", [1], checked=10)])
    assert (element.status, messages(element)) == (ElementStatus.REPORTED, ["found.reported"])
    assert (element.value, element.n, element.limit) == (0.1, 10, None)


def test_surfaces_and_duplicates_speak_of_other_elements_of_quality() -> None:
    overlap = spec("found-rate", required=False, rules=("area-overlap",))
    assert one(overlap, delivery=HERE, outcomes=[outcome("area-overlap", checked=9)]).element == "ConceptualConsistency"
    both = spec("found-rate", required=False, rules=("area-overlap", "duplicate"))
    assert one(both, delivery=HERE, outcomes=[outcome("duplicate", checked=9)]).element == "TopologicalConsistency"


def test_hits_without_a_row_count_no_feature() -> None:
    outcomes = [outcome("gap", np.array([-1, -1]), checked=10, status=Status.FAULTY), *clean("gap", checked=10)]
    assert one(Q3, delivery=HERE, outcomes=outcomes).value == 0.0
