# SPDX-License-Identifier: MIT
"""An outlying checkpoint against its distances: a wrong reference, a wrong drawing, and geometry that cannot tell."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.evaluate.deliveries import MM, checkpoints, judge, point_ties, spec, surveyed

from foparq.evaluate.quality import ElementStatus, QualityReport, Reason
from foparq.evaluate.witnessed import suspected
from foparq.findings.ties import DistanceTies, Ends, Ties
from foparq.model.tables import Checkpoints, Distances

Q1, Q2 = spec("absolute", id="Q1"), spec("relative", id="Q2")
#: a facade of 30 m by 8 m; P7 is the point in question
FACADE = np.array(
    [[0, 0, 0], [14, 0, 0], [30, 0, 8], [0, 0, 7], [3, 0.4, 2], [9, 0.2, 5], [20, 0.1, 1], [12, 0, 4]], dtype=float
)
NOISE = np.array([2.1, -1.7, 3.4, -2.6, 0.8, -3.1, 2.4, 0.0]) * MM
NOISES = np.stack([NOISE, NOISE[::-1] / 2, np.roll(NOISE, 3)], axis=1)
TAPE = np.array([1.3, -0.8, 0.4, -1.9, 0.9, -0.3, 1.1]) * MM


def situation(
    wrong: tuple[float, float, float], *, of: str, others: tuple[int, ...] = (0, 2, 5), **changes: Any
) -> QualityReport:
    """P7 shows a difference, mm, because the drawing is wrong there or the survey is; tapes measure what is true."""
    difference = np.array(wrong) * MM
    differences = NOISES.copy()
    differences[7] = difference
    points = replace(checkpoints(differences), delivered=FACADE + differences, surveyed=FACADE)
    if of == "survey":
        points = replace(points, delivered=FACADE + NOISES, surveyed=FACADE.copy())
        points.surveyed[7] = points.delivered[7] - difference
    return judged(points, FACADE, others, **changes)


def judged(points: Checkpoints, true: np.ndarray, others: tuple[int, ...], **changes: Any) -> QualityReport:
    far = np.array(others)
    measured = np.linalg.norm(true[7] - true[far], axis=1) + TAPE[: len(far)]
    delivered = np.linalg.norm(points.delivered[7] - points.delivered[far], axis=1)
    n = len(far)
    lengths = Distances(
        id=np.array([f"D{k}" for k in range(n)], dtype=object), measured=measured, delivered=delivered,
        resolution=0.05 * MM, survey_sd=changes.pop("tape", 2 * MM),
    )  # fmt: skip
    ties = DistanceTies(**{
        "ends": np.full(n, str(Ends.POINTS), dtype=object), "between": delivered, "delivered": delivered,
        "group": np.arange(n), "longest": 40.0, "at": np.column_stack([np.full(n, 7), far]),
        "places": np.stack([np.tile(points.delivered[7], (n, 1)), points.delivered[far]], axis=1), **changes,
    })  # fmt: skip
    delivery = surveyed(points, lengths)
    return judge(Q1, Q2, delivery=delivery, ties=Ties(points=point_ties(points), distances=ties, drawings=1))


def told(report: QualityReport) -> dict[str, Reason]:
    return {one.id: reason for one in report.elements for reason in one.why if reason.message.startswith("outlier.")}


@pytest.mark.parametrize("wrong", [(-48.9, 0, 19.7), (60, 0, 0), (-60, 0, 0), (45, 10, -45)])
def test_distances_that_agree_with_the_drawing_point_to_the_reference(wrong: tuple[float, float, float]) -> None:
    report = situation(wrong, of="survey")
    reason = told(report)["Q1-X"]
    assert reason.message == "outlier.contradicted"
    said = dict(reason.fields)
    assert (said["id"], said["n"]) == ("P7", 3)
    # The largest projection of the difference on the three directions, by hand.
    step = FACADE[7] - FACADE[[0, 2, 5]]
    along = np.abs(step @ np.array(wrong) / np.linalg.norm(step, axis=1)).max()
    assert said["effect"] == (pytest.approx(along * MM, rel=0.02), "m")
    assert abs(said["share"][0]) < 0.25


@pytest.mark.parametrize("wrong", [(-48.9, 0, 19.7), (60, 0, 0), (-60, 0, 0), (45, 10, -45)])
def test_distances_that_differ_as_much_point_to_the_drawing(wrong: tuple[float, float, float]) -> None:
    reason = told(situation(wrong, of="drawing"))["Q1-X"]
    assert reason.message == "outlier.borne-out"
    assert dict(reason.fields)["share"] == (pytest.approx(1.0, abs=0.25), "1")


@pytest.mark.parametrize("of", ["survey", "drawing"])
def test_a_difference_perpendicular_to_all_distances_says_nothing(of: str) -> None:
    """P7 is 60 mm off in depth, along Y; its distances run within the facade."""
    report = situation((0, 60, 0), of=of, others=(0, 2))
    assert report.elements[1].residuals is not None
    assert report.elements[1].residuals.outliers == ("P7",)
    assert told(report) == {}


@pytest.mark.parametrize("of", ["survey", "drawing"])
def test_a_tape_as_poor_as_the_difference_says_nothing(of: str) -> None:
    assert told(situation((-48.9, 0, 0), of=of, tape=49 * MM)) == {}
    assert told(situation((-48.9, 0, 0), of=of, tape=None)) == {}


def test_distances_that_contradict_one_another_say_nothing() -> None:
    true = FACADE.copy()
    report = situation((-60, 0, 0), of="survey")
    assert told(report)
    points = replace(checkpoints(NOISES), delivered=FACADE + NOISES, surveyed=FACADE.copy())
    points.surveyed[7] = points.delivered[7] + (0.06, 0, 0)
    true[0, 0] -= 0.06  # one tape says that the drawing is wrong, two that it is not
    assert told(judged(points, true, (0, 2, 6))) == {}


def test_a_distance_to_another_outlier_is_no_witness() -> None:
    differences = NOISES.copy()
    differences[[2, 7], 0] = 70 * MM, -60 * MM
    points = replace(checkpoints(differences), delivered=FACADE + differences, surveyed=FACADE)
    assert told(judged(points, FACADE, (2,))) == {}
    assert set(told(judged(points, FACADE, (0, 2)))) == {"Q1-X"}


@pytest.mark.parametrize("ends", [Ends.NAMES, Ends.OTHER_LENGTH, Ends.ABSENT])
def test_only_distances_between_points_of_the_drawing_are_witnesses(ends: Ends) -> None:
    assert told(situation((-60, 0, 0), of="survey", ends=np.full(3, str(ends), dtype=object))) == {}


def test_it_is_a_remark_and_decides_nothing() -> None:
    for of in ("survey", "drawing"):
        report = situation((-60, 0, 0), of=of)
        assert report.elements[0].status is ElementStatus.FAIL
        assert not [one for one in report.why if one.message.startswith("outlier.")]
        assert [one for one in report.remarks if one.message.startswith("outlier.")]


def test_an_id_that_two_points_bear_is_left_alone() -> None:
    differences = NOISES.copy()
    differences[7, 0] = -60 * MM
    points = replace(checkpoints(differences), delivered=FACADE + differences, surveyed=FACADE)
    points.id[3] = "P7"
    assert told(judged(points, FACADE, (0, 2, 5))) == {}


@pytest.mark.parametrize("wrong", ["drawing", "reference"])
def test_the_wrong_one_is_hardly_ever_named(wrong: str) -> None:
    """60 mm among noise of 3 and 4 mm, in random directions: of 400 at most 2 % are named wrongly, most rightly."""
    rng = np.random.default_rng(7)
    told = []
    for _ in range(400):
        places = rng.uniform([0, 0, 0], [30, 0.5, 10], (4, 3))
        error = rng.normal(size=3)
        error *= 0.06 / np.linalg.norm(error)
        drawn, points = places + rng.normal(0, 4 * MM, (4, 3)), places + rng.normal(0, 3 * MM, (4, 3))
        if wrong == "drawing":
            drawn[0] += error
        else:
            points[0] -= error
        taped = np.linalg.norm(places[1:] - places[0], axis=1) + rng.normal(0, 3 * MM, 3)
        found = np.linalg.norm(drawn[1:] - drawn[0], axis=1) - taped
        told.append(suspected(drawn[0] - drawn[1:], drawn[0] - points[0], found, np.full(3, 5 * MM), 3 * MM).which)
    assert told.count(wrong) > 240
    assert 400 - told.count(wrong) - told.count("") <= 8
