# SPDX-License-Identifier: MIT
"""Trend of coordinates and normality of distances."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.accuracy.samples import with_moments
from tests.evaluate.deliveries import MM, checkpoints, distances, judge, messages, one, parameter, spec, surveyed

from foparq.evaluate.quality import ElementStatus

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
Q6, Q7 = spec("trend", id="Q6", fewest=3), spec("normality", id="Q7", fewest=8)


def x_axis(differences: object, **given: object) -> object:
    return judge(Q6, delivery=surveyed(checkpoints(differences, **given))).elements[0]


def test_table_8_has_no_trend() -> None:
    rows = [(2.1, 3.9, 1.42), (0.4, 1.1, 0.96), (6.4, 12.9, 1.31)]
    points = np.stack([with_moments(7, mean * MM, sd * MM) for mean, sd, _ in rows], axis=1)
    report = judge(Q6, delivery=surveyed(checkpoints(points)))
    assert [element.id for element in report.elements] == ["Q6-X", "Q6-Y", "Q6-Z"]
    for element, (mean, _, t) in zip(report.elements, rows, strict=True):
        assert element.status is PASS
        assert element.value == pytest.approx(t, abs=0.01)
        assert element.limit == pytest.approx(2.4469, abs=5e-5)
        assert parameter(element, "mean") == pytest.approx(mean * MM)


def test_a_trend_fails_whatever_its_sign() -> None:
    up, down = x_axis(with_moments(7, 5 * MM, 3 * MM)), x_axis(with_moments(7, -5 * MM, 3 * MM))
    assert (up.status, down.status) == (FAIL, FAIL)
    assert up.value == pytest.approx(down.value)
    assert parameter(up, "t") == pytest.approx(-parameter(down, "t"))


def test_one_difference_for_all_points_is_the_clearest_trend() -> None:
    points = checkpoints(np.zeros((6, 3)))
    decimals = np.array([100.101, 17.003, 64.7, 3.999, 81.05, 12.0])
    points = replace(points, surveyed=np.stack([decimals] * 3, axis=1))
    shifted = type(points)(
        id=points.id,
        surveyed=points.surveyed,
        delivered=points.surveyed + 0.25,
        resolution=points.resolution,
        survey_sd=None,
    )
    element = judge(Q6, delivery=surveyed(shifted)).elements[0]
    assert (element.status, element.value, messages(element)) == (FAIL, None, ["trend.constant"])


def test_no_difference_at_all_is_no_trend() -> None:
    element = x_axis(np.zeros(6))
    assert (element.status, element.value) == (PASS, 0.0)


def test_a_bias_within_the_rounding_is_no_proof() -> None:
    element = x_axis(with_moments(20, 0.5 * MM, 0.3 * MM), resolution=1 * MM)
    assert (element.status, messages(element)[0]) == (UNDECIDED, "trend.rounding")


def test_missing_points_leave_it_open() -> None:
    differences = with_moments(9, 0.0, MM)
    differences[0] = math.nan
    element = x_axis(differences)
    assert (element.status, element.n, messages(element)[0]) == (UNDECIDED, 8, "trend.missing")


def test_two_points_show_nothing_even_if_the_profile_would_take_them() -> None:
    element = judge(spec("trend", fewest=1), delivery=surveyed(checkpoints([MM, 2 * MM]))).elements[0]
    assert (element.status, messages(element)) == (UNDECIDED, ["absolute.few"])


def test_doubt_about_normality_is_a_remark_with_another_test() -> None:
    differences = np.r_[np.full(15, MM), np.full(15, -MM), 0.4]
    element = x_axis(differences)
    assert element.status is PASS
    assert messages(element) == ["trend.pass", "trend.not-normal"]
    assert parameter(element, "normality-p") < 0.001
    assert 0.5 < parameter(element, "sign-p") <= 1.0


def test_normal_distances_are_reported_with_p() -> None:
    element = one(Q7, delivery=surveyed(lengths=distances(with_moments(29, 0.0, 10 * MM))))
    assert (element.status, element.comparison, element.limit) == (PASS, ">", 0.05)
    assert element.value is not None
    assert element.value > 0.9


def test_one_blunder_among_29_is_not_normal() -> None:
    differences = with_moments(29, 0.0, MM)
    differences[3] = 0.5
    element = one(Q7, delivery=surveyed(lengths=distances(differences)))
    assert (element.status, messages(element)) == (FAIL, ["normality.fail"])


@pytest.mark.parametrize(
    ("differences", "message"),
    [
        (np.full(7, MM), "relative.few"), (np.zeros(9), "normality.constant"),
        (np.r_[np.linspace(-1, 1, 9), math.nan], "normality.missing"),
    ],
)  # fmt: skip
def test_what_says_nothing_of_normality(differences: np.ndarray, message: str) -> None:
    element = one(Q7, delivery=surveyed(lengths=distances(differences)))
    assert (element.status, messages(element)) == (UNDECIDED, [message])
