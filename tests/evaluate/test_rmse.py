# SPDX-License-Identifier: MIT
"""Absolute and relative accuracy: when an RMSE passes, fails, and cannot decide."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.accuracy.samples import with_moments
from tests.evaluate.deliveries import (
    MM,
    checkpoints,
    distances,
    drawn,
    judge,
    messages,
    one,
    parameter,
    source,
    spec,
    surveyed,
)  # fmt: skip

from foparq.evaluate.quality import ElementStatus, Verdict
from foparq.model.delivery import SourceStatus
from foparq.units import Quantity

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
Q1, Q2 = spec("absolute", id="Q1"), spec("relative", id="Q2")


def rmse_of(value: float, n: int = 8) -> np.ndarray:
    """n differences of alternating sign with this RMSE."""
    return np.where(np.arange(n) % 2, value, -value)


def result(value: float, *, n: int = 8, **given: object) -> object:
    return one(Q2, delivery=surveyed(lengths=distances(rmse_of(value, n), **given)))


# --- the railway station ---------------------------------------------------------------------------------------------


def station_points(scale: float = 1.0) -> np.ndarray:
    """Table 8: mean and sd of seven checkpoints, metres."""
    rows = [(2.1, 3.9), (0.4, 1.1), (6.4, 12.9)]
    return np.stack([with_moments(7, mean * MM, sd * MM) for mean, sd in rows], axis=1) * scale


def test_table_8_passes_on_all_axes_with_a_survey_of_3_mm() -> None:
    report = judge(Q1, delivery=surveyed(checkpoints(station_points())))
    assert [element.id for element in report.elements] == ["Q1-X", "Q1-Y", "Q1-Z"]
    assert [element.status for element in report.elements] == [PASS] * 3
    for element, rmse, total in zip(report.elements, (4.2, 1.1, 13.5), (5.16, 3.20, 13.83), strict=True):
        assert element.limit == 0.015
        assert element.comparison == "<"
        assert (element.measure_id, element.n) == ("39", 7)
        assert element.value == pytest.approx(rmse * MM, abs=0.06 * MM)
        assert parameter(element, "rmse-with-survey") == pytest.approx(total * MM, abs=0.06 * MM)
    assert parameter(report.elements[0], "rmse-xyz") == pytest.approx(14.2 * MM, abs=0.05 * MM)
    assert report.verdict is Verdict.ACCEPTED


def test_table_8_says_that_seven_points_are_few_for_z() -> None:
    x, _, z = judge(Q1, delivery=surveyed(checkpoints(station_points()))).elements
    assert parameter(z, "rmse-upper") == pytest.approx(24.3 * MM, abs=0.1 * MM)
    assert messages(z) == ["absolute.pass", "absolute.upper"]
    assert messages(x) == ["absolute.pass"]


def test_table_9_with_the_tape_is_undecided_because_of_the_reference() -> None:
    lengths = distances(with_moments(29, 0.1 * MM, 10 * MM), survey_sd=10 * MM, resolution=0.1 * MM)
    report = judge(Q2, delivery=surveyed(lengths=lengths))
    assert report.elements[0].status is UNDECIDED
    assert messages(report.elements[0])[0] == "relative.survey-poor"
    assert report.verdict is Verdict.UNDECIDED
    assert report.why[0].message == "relative.survey-poor"


def test_table_9_with_a_survey_of_3_mm_passes_at_tenths_of_a_millimetre() -> None:
    lengths = distances(with_moments(29, 0.1 * MM, 10 * MM), survey_sd=3 * MM, resolution=0.1 * MM)
    element = one(Q2, delivery=surveyed(lengths=lengths))
    assert element.value == pytest.approx(9.83 * MM, abs=0.005 * MM)
    assert element.status is PASS
    assert element.measure_id == "foparq:distance-rmse"


def test_table_9_as_printed_to_the_millimetre_cannot_decide() -> None:
    lengths = distances(with_moments(29, 0.1 * MM, 10 * MM), survey_sd=3 * MM, resolution=0.5 * MM)
    element = one(Q2, delivery=surveyed(lengths=lengths))
    assert element.status is UNDECIDED
    assert messages(element) == ["relative.rounding"]


def test_the_bust_would_fail_and_class_b_waives_it() -> None:
    lengths = distances(with_moments(6, 1.3 * MM, 20 * MM), survey_sd=0.5 * MM)
    assert one(Q2, delivery=surveyed(lengths=lengths), scale=10.0).status is FAIL
    waived = spec("relative", id="Q2", required=False, applicable=False)
    element = one(waived, delivery=surveyed(lengths=lengths), scale=10.0)
    assert element.status is ElementStatus.NOT_APPLICABLE
    assert element.value == pytest.approx(18.3 * MM, abs=0.05 * MM)


# --- limit, digits, reference ----------------------------------------------------------------------------------------


def test_one_place_measured_seven_times_is_one_checkpoint() -> None:
    points = checkpoints([0.001] * 7)
    alike = replace(
        points, surveyed=points.surveyed[:1].repeat(7, axis=0), delivered=points.delivered[:1].repeat(7, axis=0)
    )
    for element in judge(Q1, delivery=surveyed(alike)).elements:
        assert element.status is UNDECIDED
        assert [reason.message for reason in element.why] == ["absolute.few", "evidence.repeated"]


def test_the_limit_is_strict() -> None:
    at = spec("relative", limit=Quantity(0.25, "m"))
    lengths = distances(rmse_of(0.0), resolution=0.0)
    lengths = type(lengths)(
        id=lengths.id, measured=np.full(8, 4.0), delivered=4.0 + rmse_of(0.25), resolution=0.0, survey_sd=MM
    )
    assert one(at, delivery=surveyed(lengths=lengths)).status is FAIL


@pytest.mark.parametrize(
    ("rmse", "resolution", "status"),
    [
        (9.4, 0.5, PASS),
        (9.6, 0.5, UNDECIDED),
        (10.4, 0.5, UNDECIDED),
        (10.6, 0.5, FAIL),
        (9.6, 0.1, PASS),
        (10.4, 0.1, FAIL),
    ],
)
def test_rounding_decides_only_near_the_limit(rmse: float, resolution: float, status: ElementStatus) -> None:
    assert result(rmse * MM, resolution=resolution * MM).status is status


@pytest.mark.parametrize(
    ("sd", "status"), [(3.3, PASS), (3.4, UNDECIDED), (None, UNDECIDED), (0.0, UNDECIDED), (-3.0, UNDECIDED)]
)
def test_the_survey_must_be_good_to_a_third_of_the_limit(sd: float | None, status: ElementStatus) -> None:
    element = result(5 * MM, survey_sd=None if sd is None else sd * MM)
    assert element.status is status
    if sd is None or sd <= 0:
        assert messages(element) == ["relative.survey-unknown"]


def test_an_unknown_resolution_never_passes() -> None:
    for rmse in (1.0, 20.0):
        element = result(rmse * MM, resolution=math.nan)
        assert (element.status, messages(element)) == (UNDECIDED, ["relative.rounding"])


def test_a_poor_survey_excuses_only_what_it_can_explain() -> None:
    assert result(10.5 * MM, survey_sd=10 * MM).status is UNDECIDED
    failed = result(14.5 * MM, survey_sd=10 * MM)  # sqrt(14.5^2 - 10^2) = 10.5
    assert failed.status is FAIL
    assert messages(failed) == ["relative.fail-all-the-same"]
    assert result(14.1 * MM, survey_sd=10 * MM).status is UNDECIDED  # 9.94
    assert result(14.2 * MM, survey_sd=10 * MM, resolution=0.2 * MM).status is UNDECIDED  # 10.08 less 0.2


def test_a_survey_of_unknown_accuracy_never_rejects() -> None:
    assert result(1.0, survey_sd=None).status is UNDECIDED


def test_without_a_share_the_profile_asks_nothing_of_the_survey() -> None:
    plain = spec("relative", reference_share=None)
    assert one(plain, delivery=surveyed(lengths=distances(rmse_of(5 * MM), survey_sd=None))).status is PASS


# --- what is not there -----------------------------------------------------------------------------------------------


def test_points_without_delivered_coordinates_are_counted_not_dropped() -> None:
    differences = np.stack([rmse_of(2 * MM)] * 3, axis=1)
    differences[[0, 3], 1] = math.nan
    x, y, z = judge(Q1, delivery=surveyed(checkpoints(differences))).elements
    assert (x.status, y.status, z.status) == (PASS, UNDECIDED, PASS)
    assert messages(y) == ["absolute.missing"]
    assert dict(y.why[0].fields)["missing"] == 2
    assert (y.n, parameter(y, "missing")) == (6, 2.0)


def test_missing_points_are_given_every_benefit_before_a_failure() -> None:
    differences = rmse_of(30 * MM, 8)
    differences[:2] = math.nan
    failed = one(Q2, delivery=surveyed(lengths=distances(differences)))  # 30 * sqrt(6 / 8) = 26
    assert failed.status is FAIL
    assert messages(failed) == ["relative.fail-all-the-same"]
    differences[:7] = math.nan
    few = one(spec("relative", fewest=1), delivery=surveyed(lengths=distances(differences)))  # 30 * sqrt(1 / 8) = 10.6
    assert few.status is FAIL
    differences[7] = 28 * MM  # 9.9
    assert one(spec("relative", fewest=1), delivery=surveyed(lengths=distances(differences))).status is UNDECIDED


def test_an_infinite_coordinate_counts_as_missing() -> None:
    differences = rmse_of(2 * MM)
    differences[4] = math.inf
    element = one(Q2, delivery=surveyed(lengths=distances(differences)))
    assert (element.status, parameter(element, "missing")) == (UNDECIDED, 1.0)


def test_nothing_delivered_at_all() -> None:
    element = one(Q2, delivery=surveyed(lengths=distances(np.full(5, math.nan))))
    assert (element.status, element.value, element.n) == (UNDECIDED, None, 0)
    assert messages(element) == ["relative.none-delivered"]
    assert all(math.isfinite(value) for _, value, _ in element.parameters)


def test_too_few_decide_nothing_however_large() -> None:
    element = one(Q2, delivery=surveyed(lengths=distances([5.0, -5.0])))
    assert (element.status, messages(element)) == (UNDECIDED, ["relative.few"])


@pytest.mark.parametrize("n", [0, None])
def test_no_table_is_not_assessed(n: int | None) -> None:
    points, lengths = (None, None) if n is None else (checkpoints(np.zeros((0, 3))), distances([]))
    for element in judge(Q1, Q2, spec("trend"), spec("normality"), delivery=surveyed(points, lengths)).elements:
        assert (element.status, element.value) == (ElementStatus.NOT_ASSESSED, None)
        assert messages(element) in (["absolute.none"], ["relative.none"])


def test_a_table_that_could_not_be_read_says_so() -> None:
    lost = (source("p.csv", "checkpoints", SourceStatus.REFUSED), source("d.csv", "distances", SourceStatus.MISSING))
    report = judge(Q1, Q2, delivery=surveyed(sources=lost))
    assert {messages(element)[0] for element in report.elements} == {"absolute.lost", "relative.lost"}
    assert report.verdict is Verdict.UNDECIDED
    assert [reason.message for reason in report.why[:2]] == ["verdict.refused", "verdict.missing"]


@pytest.mark.parametrize(
    ("changes", "scale", "message"),
    [
        ({"limit": None}, 50.0, "limit.none"),
        ({"limit": Quantity(10, "%")}, 50.0, "limit.unit"),
        ({}, None, "limit.no-scale"),
    ],
)
def test_a_limit_that_cannot_be_used_decides_nothing(changes: dict, scale: float | None, message: str) -> None:
    element = one(spec("relative", **changes), delivery=surveyed(lengths=distances(rmse_of(MM))), scale=scale)
    assert (element.status, messages(element)) == (UNDECIDED, [message])
    assert element.value == pytest.approx(MM)


# --- properties ------------------------------------------------------------------------------------------------------


def test_order_of_points_changes_nothing() -> None:
    points = station_points()
    shuffled = np.random.default_rng(2).permutation(points)
    first = judge(Q1, spec("trend"), delivery=surveyed(checkpoints(points))).elements
    second = judge(Q1, spec("trend"), delivery=surveyed(checkpoints(shuffled))).elements
    assert [element.parameters for element in first] == [element.parameters for element in second]


def test_large_coordinates_change_no_verdict() -> None:
    near = judge(Q1, delivery=surveyed(checkpoints(station_points()))).elements
    far = judge(Q1, delivery=surveyed(checkpoints(station_points(), at=7.4e6))).elements
    for one_, other in zip(near, far, strict=True):
        assert other.value == pytest.approx(one_.value, abs=1e-8)
        assert other.status is one_.status


def test_a_shift_of_all_points_is_told_with_its_size() -> None:
    report = judge(Q1, Q2, delivery=surveyed(checkpoints(station_points() + 0.050), distances(rmse_of(2 * MM))))
    assert report.verdict is Verdict.REJECTED
    assert [reason.message for reason in report.why] == ["absolute.fail"] * 3
    assert report.remarks[0].message == "diagnosis.shift"
    told = dict(report.remarks[0].fields)
    assert told["axes"] == ["X", "Y", "Z"]
    means = np.array([mean for mean, _ in told["means"]])
    assert means == pytest.approx(0.050 + station_points().mean(axis=0), abs=1e-9)


def test_no_drawing_is_needed_for_points() -> None:
    assert judge(Q2, delivery=drawn()).elements[0].scope == ""


@given(
    st.lists(st.floats(-0.03, 0.03), min_size=3, max_size=10),
    st.floats(0.0, 0.004),
    st.lists(st.floats(-1, 1), min_size=10, max_size=10),
)
def test_what_was_decided_holds_for_every_truth_behind_the_digits(
    differences: list[float], resolution: float, errors: list[float]
) -> None:
    printed = np.array(differences)
    element = one(Q2, delivery=surveyed(lengths=distances(printed, resolution=resolution)))
    true = printed + resolution * np.array(errors[: len(printed)])
    rmse = math.sqrt(float(np.mean(true**2)))
    if element.status is PASS:
        assert rmse < 0.010 + 1e-12
    if element.status is FAIL:
        assert rmse >= 0.010 - 1e-12


@given(st.lists(st.floats(-0.03, 0.03), min_size=3, max_size=10), st.floats(1e-6, 0.02), st.floats(1e-6, 0.02))
def test_a_better_survey_never_costs_a_pass(differences: list[float], first: float, second: float) -> None:
    # Of exact numbers: no survey is better than the digits of its own.
    poor, good = max(first, second), min(first, second)

    def status(sd: float) -> ElementStatus:
        return one(Q2, delivery=surveyed(lengths=distances(differences, survey_sd=sd, resolution=0.0))).status

    if status(poor) is PASS:
        assert status(good) is PASS
    if status(poor) is FAIL:
        assert status(good) is FAIL


@given(st.lists(st.floats(-0.03, 0.03), min_size=3, max_size=10), st.integers(1, 4))
def test_leaving_points_out_never_helps(differences: list[float], missing: int) -> None:
    left_out = np.r_[differences, np.full(missing, math.nan)]
    assert one(Q2, delivery=surveyed(lengths=distances(left_out))).status is not PASS


@pytest.mark.parametrize(("rmse", "told"), [(15.15, True), (15.25, True), (15.35, False), (40.0, False), (14.9, False)])
def test_a_failure_that_a_better_survey_might_turn_says_which_number_decides(rmse: float, *, told: bool) -> None:
    """sqrt(15.297^2 - 3^2) = 15: from there on the survey explains nothing of the failure."""
    differences = np.array([1.0, -1.0] * 5) * rmse * MM
    element = judge(spec("absolute", id="Q1"), delivery=surveyed(checkpoints(differences, resolution=0.0))).elements[0]
    said = [dict(one.fields) for one in element.why if one.message == "absolute.measured"]
    assert bool(said) is told
    if told:
        assert said[0]["less"] == (pytest.approx(np.sqrt(rmse**2 - 9) * MM), "m")
        assert said[0]["over"] == (pytest.approx((rmse - 15) * MM), "m")
