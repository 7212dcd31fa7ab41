# SPDX-License-Identifier: MIT
"""The verdict: accepted only if every required element passes."""

import itertools

import numpy as np
import pytest
from tests.accuracy.samples import with_moments
from tests.evaluate.deliveries import (
    MM,
    checkpoints,
    counted,
    distances,
    drawing,
    judge,
    listed,
    not_run,
    outcome,
    point_ties,
    source,
    spec,
    surveyed,
)  # fmt: skip

from foparq.evaluate.quality import ElementStatus, Verdict
from foparq.findings.because import Because
from foparq.findings.outcome import Status
from foparq.findings.ties import Ties
from foparq.model.delivery import Delivery, SourceStatus
from foparq.profile.elements import ElementSpec
from foparq.profile.load import load_profile
from foparq.units import Quantity


def rate(id_: str, rule: str, **changes: object) -> ElementSpec:
    return spec("faulty-rate", id=id_, rules=(rule,), **changes)


GOOD, BAD, OPEN = rate("good", "a"), rate("bad", "b"), rate("open", "c")
OUTCOMES = [outcome("a", checked=9), outcome("b", range(9), checked=9), not_run("c", Because("unit-unknown"))]
HERE = Delivery(title="", sources=(source("a.dxf"),))


def verdict(*elements: ElementSpec, **given: object) -> Verdict:
    return judge(*elements, **{"delivery": HERE, "outcomes": OUTCOMES, **given}).verdict


def test_truth_table() -> None:
    for chosen in itertools.product([GOOD, None], [BAD, None], [OPEN, None]):
        elements = [element for element in chosen if element]
        known = (
            Verdict.REJECTED
            if BAD in elements
            else Verdict.UNDECIDED
            if OPEN in elements or not elements
            else Verdict.ACCEPTED
        )
        assert verdict(*elements) is known


def test_what_is_not_required_decides_nothing() -> None:
    optional = [rate("bad", "b", required=False), rate("open", "c", required=False)]
    report = judge(GOOD, *optional, delivery=HERE, outcomes=OUTCOMES[:2])
    assert report.verdict is Verdict.ACCEPTED
    assert [reason.message for reason in report.why] == ["verdict.accepted"]
    assert [reason.message for reason in report.remarks] == ["verdict.not-required"]
    assert dict(report.remarks[0].fields)["elements"] == ["bad"], "nothing is said of what was not evaluated"


def test_nothing_required_is_never_accepted() -> None:
    report = judge(rate("good", "a", required=False), delivery=HERE, outcomes=OUTCOMES)
    assert (report.verdict, report.why[-1].message) == (Verdict.UNDECIDED, "verdict.nothing-required")
    assert verdict(rate("bad", "b", applicable=False)) is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("status", "known"),
    [
        (SourceStatus.READ, Verdict.ACCEPTED), (SourceStatus.RECOVERED, Verdict.ACCEPTED),
        (SourceStatus.UNNAMED, Verdict.ACCEPTED),
        (SourceStatus.REFUSED, Verdict.UNDECIDED), (SourceStatus.MISSING, Verdict.UNDECIDED),
    ],
)  # fmt: skip
def test_a_named_file_that_could_not_be_read(status: SourceStatus, known: Verdict) -> None:
    delivery = Delivery(title="", sources=(source("a.dxf"), source("x.csv", "other", status)))
    assert verdict(GOOD, delivery=delivery) is known


def test_a_crash_anywhere_leaves_it_open() -> None:
    assert verdict(GOOD, crashed=True) is Verdict.UNDECIDED
    elsewhere = [*OUTCOMES, outcome("z", status=Status.CRASHED, because=Because.CRASHED)]
    assert verdict(GOOD, outcomes=elsewhere) is Verdict.UNDECIDED
    assert verdict(GOOD, BAD, crashed=True) is Verdict.REJECTED


def test_only_what_decides_is_decisive_and_equal_reasons_are_told_once() -> None:
    report = judge(OPEN, BAD, spec("absolute", id="Q1"), delivery=HERE, outcomes=OUTCOMES)
    assert [reason.message for reason in report.why] == ["faulty.fail"]
    assert [reason.message for reason in report.remarks] == ["checks.unit-unknown", "absolute.none"]
    assert dict(report.remarks[1].fields)["element"] == ["Q1-X", "Q1-Y", "Q1-Z"]
    without = judge(OPEN, spec("absolute", id="Q1"), delivery=HERE, outcomes=OUTCOMES)
    assert [reason.message for reason in without.why] == ["checks.unit-unknown", "absolute.none"]
    assert without.remarks == ()


# --- the shipped profiles --------------------------------------------------------------------------------------------


def station(**tables: object) -> dict:
    rows = [(2.1, 3.9), (0.4, 1.1), (6.4, 12.9)]
    points = np.stack([with_moments(7, mean * MM, sd * MM) for mean, sd in rows], axis=1)
    rules = next(element for element in load_profile("et-doc-foparq-a").elements if element.id == "Q3").rules
    given = {
        "points": checkpoints(points), "lengths": distances(with_moments(29, 0.1 * MM, 10 * MM)),
        "parts": (drawing(classes={"J": "window"}),), "features": listed(("window", "N", 142)),
    }  # fmt: skip
    outcomes = [outcome(name, checked=976) for name in rules]
    return {
        "delivery": surveyed(**{**given, **tables}), "outcomes": outcomes, "counts": counted(("window", "N", 137)),
    }  # fmt: skip


def test_the_station_is_accepted_for_class_a_and_b() -> None:
    for name in ("et-doc-foparq-a", "et-doc-foparq-b"):
        elements = load_profile(name).elements
        report = judge(*elements, **station())
        assert report.verdict is Verdict.ACCEPTED, report.why
        assert {spec_.kind for spec_ in elements} == set(ElementSpec.KINDS)


def test_the_station_measured_with_a_tape_is_undecided() -> None:
    tape = distances(with_moments(29, 0.1 * MM, 10 * MM), survey_sd=10 * MM)
    report = judge(*load_profile("et-doc-foparq-a").elements, **station(lengths=tape))
    assert (report.verdict, report.why[0].message) == (Verdict.UNDECIDED, "relative.survey-poor")
    assert judge(*load_profile("et-doc-foparq-b").elements, **station(lengths=tape)).verdict is Verdict.ACCEPTED


def test_an_empty_delivery_passes_nothing() -> None:
    for name in ("et-doc-foparq-a", "et-doc-foparq-b"):
        report = judge(*load_profile(name).elements, delivery=Delivery(title="", sources=()))
        assert report.verdict is Verdict.UNDECIDED
        assert {element.status for element in report.elements} <= {
            ElementStatus.NOT_ASSESSED,
            ElementStatus.NOT_APPLICABLE,
        }


def test_elements_keep_the_order_of_the_profile() -> None:
    elements = judge(BAD, GOOD, rate("third", "a", limit=Quantity(1, "%")), delivery=HERE, outcomes=OUTCOMES).elements
    assert [element.id for element in elements] == ["bad", "good", "third"]


def test_a_contradicted_statement_is_the_first_reason() -> None:
    points = checkpoints([0.001] * 8)
    absent = Ties(points=point_ties(points, lies=np.full(8, "absent", dtype=object)), drawings=1)
    delivery = surveyed(points, parts=(drawing(),))
    report = judge(
        spec("absolute", id="Q1"), spec("faulty-rate", id="Q3", rules=("undershoot",)), delivery=delivery, ties=absent,
        outcomes=[not_run("undershoot", Because.UNIT_CONTRADICTED)],
    )  # fmt: skip
    assert [reason.message for reason in report.why] == ["checks.unit-contradicted", "evidence.absent"]
