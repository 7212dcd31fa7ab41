# SPDX-License-Identifier: MIT
"""Each limit met exactly, with numbers that binary arithmetic holds: ``<`` told from ``<=``."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from tests.evaluate.deliveries import (
    counted,
    distances,
    drawing,
    drawn,
    judge,
    listed,
    messages,
    one,
    outcome,
    parameter,
    spec,
    surveyed,
)

from foparq.accuracy.normality import AndersonDarling
from foparq.accuracy.student import StudentTest
from foparq.evaluate import threshold as threshold_module
from foparq.evaluate.elements import normality as normality_module
from foparq.evaluate.elements import trend as trend_module
from foparq.evaluate.quality import Element, ElementStatus
from foparq.model.tables import Checkpoints
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words
from foparq.units import Quantity

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
NOT_ASSESSED = ElementStatus.NOT_ASSESSED
QUARTER = Quantity(0.25, "m")
HERE = drawn(drawing(n=1000))


def signs(value: float, n: int = 8) -> np.ndarray:
    return np.where(np.arange(n) % 2, value, -value)


def points(differences: np.ndarray, *, resolution: float = 0.0, survey_sd: float | None = None) -> Checkpoints:
    """Checkpoints at whole metres, all axes alike; n of them, none at the place of another."""
    n = len(differences)
    at = np.stack([np.arange(n, dtype=float)] * 3, axis=1)
    return Checkpoints(
        id=np.array([f"P{row}" for row in range(n)], dtype=object), surveyed=at,
        delivered=at + differences[:, None], resolution=np.full(3, resolution), survey_sd=survey_sd,
    )  # fmt: skip


def absolute(value: float, **given: object) -> list[Element]:
    """Q1 of eight points with this RMSE, limit a quarter of a metre, nothing asked of the survey."""
    plain = spec("absolute", limit=QUARTER, reference_share=None)
    return list(judge(plain, delivery=surveyed(points(signs(value), **given))).elements)


def relative(value: float, *, n: int = 8, limit: Quantity = QUARTER, **given: object) -> Element:
    """Q2 of n distances of four metres with this RMSE."""
    changes = {"reference_share": None, **given}
    survey, resolution = changes.pop("survey_sd", None), changes.pop("resolution", 0.0)
    lengths = replace(
        distances(np.zeros(n)), measured=np.full(n, 4.0), delivered=4.0 + signs(value, n), survey_sd=survey,
        resolution=resolution,
    )  # fmt: skip
    return one(spec("relative", limit=limit, **changes), delivery=surveyed(lengths=lengths))


# --- Q1 and Q2: below the limit, never at it -------------------------------------------------------------------------


def test_an_rmse_at_the_limit_fails_on_every_axis() -> None:
    assert [(element.status, element.value) for element in absolute(0.25)] == [(FAIL, 0.25)] * 3
    assert [element.status for element in absolute(0.25 - 2.0**-40)] == [PASS] * 3
    assert relative(0.25).status is FAIL
    assert relative(0.1875).status is PASS


def test_digits_that_reach_the_limit_from_below_leave_it_open() -> None:
    for element in (*absolute(0.1875, resolution=0.0625), relative(0.1875, resolution=0.0625)):
        assert element.status is UNDECIDED
        assert messages(element)[0].endswith(".rounding")
        low, high = (dict(element.why[0].fields)[name] for name in ("low", "high"))
        assert (low, high) == ((0.125, "m"), (0.25, "m"))
    assert relative(0.1875, resolution=0.03125).status is PASS


def test_digits_that_reach_the_limit_from_above_do_not_save_it() -> None:
    assert relative(0.3125, resolution=0.0625).status is FAIL
    assert relative(0.3125, resolution=0.09375).status is UNDECIDED


def test_the_least_that_rounding_leaves_is_never_below_nothing() -> None:
    fields = dict(relative(0.0625, resolution=0.25).why[0].fields)
    assert (fields["low"], fields["high"]) == ((0.0, "m"), (0.3125, "m"))


def test_a_survey_at_exactly_its_share_of_the_limit_is_good_enough() -> None:
    limit = Quantity(0.375, "m")
    assert relative(0.25, limit=limit, reference_share=1 / 3, survey_sd=0.125).status is PASS
    poor = relative(0.25, limit=limit, reference_share=1 / 3, survey_sd=float(np.nextafter(0.125, 1)))
    assert (poor.status, messages(poor)) == (UNDECIDED, ["relative.survey-poor"])
    said = dict(poor.why[0].fields)
    assert said["allowed"] == (0.125, "m")


def test_what_a_poor_survey_explains_exactly_to_the_limit_fails() -> None:
    # sqrt(0.3125^2 - 0.1875^2) = 0.25
    failed = relative(0.3125, reference_share=1 / 3, survey_sd=0.1875)
    assert (failed.status, messages(failed)) == (FAIL, ["relative.fail-all-the-same"])
    assert dict(failed.why[0].fields)["least"] == (0.25, "m")
    assert relative(0.28125, reference_share=1 / 3, survey_sd=0.1875).status is UNDECIDED


def test_a_limit_of_nothing_is_a_limit() -> None:
    assert relative(0.25, limit=Quantity(0.0, "m"), reference_share=None).status is FAIL


@pytest.mark.parametrize(("n", "status"), [(2, UNDECIDED), (3, PASS), (4, PASS)])
def test_the_fewest_observations_are_enough(n: int, status: ElementStatus) -> None:
    element = relative(0.125, n=n, fewest=3)
    assert element.status is status
    if status is UNDECIDED:
        assert messages(element) == ["relative.few"]
        assert dict(element.why[0].fields)["fewest"] == 3


def test_one_observation_is_judged_if_the_profile_takes_it() -> None:
    assert relative(0.125, n=1, fewest=0).status is PASS


def test_an_upper_bound_at_the_limit_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threshold_module, "rmse_upper", lambda *_, **__: 0.25)
    assert messages(relative(0.125)) == ["relative.pass", "relative.upper"]
    monkeypatch.setattr(threshold_module, "rmse_upper", lambda *_, **__: float(np.nextafter(0.25, 0)))
    assert messages(relative(0.125)) == ["relative.pass"]


def test_two_points_at_one_place_are_one_with_the_larger_difference() -> None:
    plain = spec("absolute", limit=QUARTER, reference_share=None)
    table = points(signs(0.125))
    table.surveyed[5], table.delivered[5] = table.surveyed[3], table.surveyed[3] + 0.5
    element = judge(plain, delivery=surveyed(table)).elements[0]
    # Six of 0.125 and one of 0.5.
    assert element.value == pytest.approx(np.sqrt((6 * 0.125**2 + 0.5**2) / 7), abs=1e-12)
    repeated = next(reason for reason in element.why if reason.message == "evidence.repeated")
    assert dict(repeated.fields)["ids"] == [table.id[3]]
    assert element.n == 7


# --- Q6 and Q7 -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("t", "status"), [(2.0, PASS), (-2.0, PASS), (2.0000001, FAIL), (-2.0000001, FAIL)])
def test_t_at_the_critical_value_is_no_trend(t: float, status: ElementStatus, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trend_module, "student_test", lambda *_, **__: StudentTest(t, 2.0, 0.05, 7))
    differences = np.array([0.1, 0.2, 0.3, 0.1, 0.2, 0.4, 0.1, 0.2])
    element = judge(spec("trend"), delivery=surveyed(points(differences))).elements[0]
    assert (element.status, element.value, element.limit) == (status, abs(t), 2.0)
    assert parameter(element, "t") == t


@pytest.mark.parametrize(("resolution", "status"), [(0.5, UNDECIDED), (0.25, FAIL)])
def test_a_mean_of_exactly_what_rounding_makes_is_no_proof(resolution: float, status: ElementStatus) -> None:
    differences = np.array([0.5, 0.25, 0.75] * 5)
    element = judge(spec("trend"), delivery=surveyed(points(differences, resolution=resolution))).elements[0]
    assert element.status is status
    assert parameter(element, "mean") == 0.5


@pytest.mark.parametrize(("n", "status"), [(2, UNDECIDED), (3, PASS)])
def test_three_points_may_show_a_trend(n: int, status: ElementStatus) -> None:
    element = judge(spec("trend", fewest=0), delivery=surveyed(points(signs(0.5, n)))).elements[0]
    assert element.status is status
    if n < 3:
        assert dict(element.why[0].fields)["fewest"] == 3


@pytest.mark.parametrize(("p", "status"), [(0.05, FAIL), (0.0500001, PASS)])
def test_p_at_its_limit_is_not_normal(p: float, status: ElementStatus, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(normality_module, "anderson_darling", lambda _: AndersonDarling(1.0, 1.0, p))
    lengths = distances(np.arange(8.0) / 1000)
    element = one(spec("normality", fewest=8), delivery=surveyed(lengths=lengths))
    assert (element.status, element.value, element.limit) == (status, p, 0.05)


@pytest.mark.parametrize(("n", "assessed"), [(2, False), (3, True)])
def test_three_distances_have_a_shape(n: int, assessed: bool) -> None:  # noqa: FBT001
    element = one(spec("normality", fewest=0), delivery=surveyed(lengths=distances(np.arange(float(n)) / 1000)))
    assert (element.value is not None) is assessed
    if not assessed:
        assert dict(element.why[0].fields)["fewest"] == 3


# --- Q3: at the limit is within it -----------------------------------------------------------------------------------

RATE = spec("faulty-rate", rules=("gap",), limit=Quantity(25, "%"))


@pytest.mark.parametrize(("faulty", "status"), [(16, PASS), (17, FAIL)])
def test_a_rate_at_the_limit_passes(faulty: int, status: ElementStatus) -> None:
    element = one(RATE, delivery=HERE, outcomes=[outcome("gap", range(faulty), checked=64)])
    assert (element.status, element.value) == (status, faulty / 64)


@pytest.mark.parametrize(("found", "status"), [(16, PASS), (17, FAIL)])
def test_a_share_of_faults_at_the_limit_passes(found: int, status: ElementStatus) -> None:
    share = spec("found-rate", rules=("gap", "sliver"), limit=Quantity(25, "%"))
    outcomes = [outcome("gap", range(found), checked=64), outcome("sliver", checked=64)]
    assert one(share, delivery=HERE, outcomes=outcomes).status is status


# --- Q4 and Q5 -------------------------------------------------------------------------------------------------------

BOUND = drawing(classes={"J": "window", "P": "door"})


def completeness(rows: list, counts: list, **given: object) -> tuple[Element, Element]:
    limits = [spec("commission", limit=Quantity(25, "%")), spec("omission", limit=Quantity(25, "%"))]
    delivery = drawn(BOUND, features=listed(*rows), **given)
    commission, omission = judge(*limits, delivery=delivery, counts=counted(*counts)).elements
    return commission, omission


@pytest.mark.parametrize(("delivered", "status"), [(16, PASS), (15, PASS), (20, PASS), (21, FAIL)])
def test_surplus_at_the_limit_passes(delivered: int, status: ElementStatus) -> None:
    commission, _ = completeness([("window", "N", 16)], [("window", "N", delivered)])
    assert (commission.status, commission.value) == (status, max(0, delivered - 16) / 16)


@pytest.mark.parametrize(("delivered", "status"), [(16, PASS), (12, PASS), (11, FAIL)])
def test_omissions_at_the_limit_pass(delivered: int, status: ElementStatus) -> None:
    _, omission = completeness([("window", "N", 16)], [("window", "N", delivered)])
    assert (omission.status, omission.value) == (status, (16 - delivered) / 16)


@pytest.mark.parametrize(("delivered", "status"), [(12, UNDECIDED), (11, UNDECIDED), (7, FAIL)])
def test_classes_not_compared_are_given_the_benefit_up_to_the_limit(delivered: int, status: ElementStatus) -> None:
    rows = [("window", "N", 16), ("door", "N", 16)]
    _, omission = completeness(rows, [("window", "N", delivered)])
    assert omission.status is status
    assert completeness(rows, [("window", "N", 8)])[1].status is UNDECIDED  # 8 of 32: at the limit


def test_a_lost_drawing_leaves_open_only_what_exceeds_the_limit() -> None:
    for delivered, message in ((12, "omission.pass"), (11, "omission.hidden")):
        _, omission = completeness([("window", "N", 16)], [("window", "N", delivered)], lost=("b.dxf",))
        assert (messages(omission)[0], omission.status) == (message, PASS if delivered == 12 else UNDECIDED)


def counts_of(delivered: int, *, most: int, pieces: int) -> object:
    return replace(counted(("window", "N", delivered)), most=np.array([most]), pieces=np.array([pieces]))


@pytest.mark.parametrize(("pieces", "status"), [(12, UNDECIDED), (11, FAIL)])
def test_the_most_features_there_may_be_reach_the_limit(pieces: int, status: ElementStatus) -> None:
    delivery = drawn(BOUND, features=listed(("window", "N", 16)))
    element = one(
        spec("omission", limit=Quantity(25, "%")), delivery=delivery, counts=counts_of(8, most=8, pieces=pieces)
    )
    assert element.status is status
    assert parameter(element, "missing-least") == 16 - pieces


@pytest.mark.parametrize(("most", "status"), [(20, PASS), (21, UNDECIDED)])
def test_the_most_surplus_there_may_be_reaches_the_limit(most: int, status: ElementStatus) -> None:
    delivery = drawn(BOUND, features=listed(("window", "N", 16)))
    element = one(
        spec("commission", limit=Quantity(25, "%")), delivery=delivery, counts=counts_of(16, most=most, pieces=16)
    )
    assert element.status is status
    assert parameter(element, "surplus-most") == most - 16


# --- axes and signs --------------------------------------------------------------------------------------------------


def test_differences_are_delivered_minus_surveyed_on_each_axis() -> None:
    table = points(np.zeros(8))
    table.delivered[:] += [0.25, -0.5, 0.125]
    for kind in ("absolute", "trend"):
        elements = judge(spec(kind), delivery=surveyed(table)).elements
        assert [parameter(element, "mean") for element in elements] == [0.25, -0.5, 0.125]
    rmse = parameter(judge(spec("absolute"), delivery=surveyed(table)).elements[0], "rmse-xyz")
    assert rmse == pytest.approx(math.sqrt(0.25**2 + 0.5**2 + 0.125**2))


def test_each_axis_is_judged_by_its_own_digits() -> None:
    table = replace(points(signs(0.1875)), resolution=np.array([0.0, 0.0625, 0.03125]))
    plain = spec("absolute", limit=QUARTER, reference_share=None)
    elements = judge(plain, delivery=surveyed(table)).elements
    assert [element.status for element in elements] == [PASS, UNDECIDED, PASS]
    assert [parameter(element, "rounding") for element in elements] == [0.0, 0.0625, 0.03125]
    shifted = replace(points(np.array([0.5, 0.25, 0.75] * 5)), resolution=np.array([0.25, 0.5, 0.25]))
    trends = judge(spec("trend"), delivery=surveyed(shifted)).elements
    assert [element.status for element in trends] == [FAIL, UNDECIDED, FAIL]


def test_the_error_in_space_leaves_out_points_without_all_three_axes() -> None:
    table = points(np.full(8, 0.5))
    table.delivered[0] = [50.0, np.nan, 50.0]
    element = judge(spec("absolute"), delivery=surveyed(table)).elements[0]
    assert parameter(element, "rmse-xyz") == pytest.approx(math.sqrt(3) * 0.5)
    assert parameter(element, "n") == 8.0


@pytest.mark.parametrize(
    ("least", "most", "listed_", "message", "range_"),
    [
        (16, 16, 16, "omission.none", None),
        (13, 13, 16, "omission.pass", None),
        (12, 14, 16, "omission.pass-between", (2, 4)),
        (6, 8, 16, "omission.fail-between", (8, 10)),
        (8, 8, 16, "omission.fail", None),
    ],
)
def test_what_may_be_drawn_is_never_said_to_be_missing(
    least: int, most: int, listed_: int, message: str, range_: tuple[int, int] | None
) -> None:
    delivery = drawn(BOUND, features=listed(("window", "N", listed_)))
    counts = counts_of(least, most=most, pieces=most)
    element = one(spec("omission", limit=Quantity(25, "%")), delivery=delivery, counts=counts)
    assert messages(element)[0] == message
    if range_ is not None:
        fields = dict(element.why[0].fields)
        assert (fields["least"], fields["missing"]) == range_
        for language in ("en", "pt-BR"):
            said = reason_sentence(Words(language), element.why[0])
            assert re.search(rf"\b{range_[0]} (to|a) {range_[1]}\b", said)
