# SPDX-License-Identifier: MIT
"""Every difference is told, the worst and the outliers by name, and a cause only where a test bears it out."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.accuracy.samples import with_moments
from tests.evaluate.deliveries import (
    MM,
    checkpoints,
    distances,
    judge,
    messages,
    one,
    parameter,
    point_ties,
    spec,
    surveyed,
    tied,
)

from foparq.evaluate.quality import Element, ElementStatus, QualityReport, Residuals, Standing
from foparq.model.tables import Checkpoints

Q1, Q2, Q6 = spec("absolute", id="Q1"), spec("relative", id="Q2"), spec("trend", id="Q6")
#: corners and other points of a facade of 14 m by 7 m
FACADE = np.array([[0, 0, 0], [14, 0, 0], [14, 0, 7], [0, 0, 7], [3, 0.4, 2], [9, 0.2, 5], [6, 0.1, 1], [11, 0.5, 6]])
NOISE = np.array([2.1, -1.7, 3.4, -2.6, 0.8, -3.1, 2.4, -0.9]) * MM
NOISES = np.stack([NOISE, NOISE[::-1], np.roll(NOISE, 3)], axis=1)


def facade(differences: np.ndarray) -> Checkpoints:
    points = checkpoints(differences)
    return replace(points, surveyed=FACADE, delivered=FACADE + differences)


def of(element: Element) -> Residuals:
    assert element.residuals is not None
    return element.residuals


def diagnoses(report: QualityReport) -> list[str]:
    return [reason.message for reason in report.remarks if reason.message.startswith("diagnosis.")]


def test_every_difference_is_told_worst_first() -> None:
    element = one(Q2, delivery=surveyed(lengths=distances(NOISE)))
    rows = of(element).rows
    assert [row.id for row in rows] == ["D2", "D5", "D3", "D6", "D0", "D1", "D7", "D4"]
    assert [row.difference for row in rows] == pytest.approx(sorted(NOISE, key=abs, reverse=True), abs=1e-9)
    spread = (NOISE[2] - NOISE.mean()) / NOISE.std(ddof=1)
    assert rows[0].normalised == pytest.approx(spread, rel=1e-6)
    assert of(element).outliers == ()


def test_one_wrong_point_is_named_with_size_and_place() -> None:
    wrong = NOISES.copy()
    wrong[5, 2] = -71.3 * MM
    report = judge(Q1, Q6, delivery=surveyed(facade(wrong)))
    z = report.elements[2]
    assert z.status is ElementStatus.FAIL
    (told,) = dict(z.why[0].fields)["worst"]
    assert dict(told.fields) == {
        "id": "P5", "difference": (pytest.approx(-71.3 * MM), "m"), "place": "drawing item layer",
    }  # fmt: skip
    assert of(z).outliers == ("P5",)
    assert of(z).rest == pytest.approx(np.sqrt(np.mean(np.delete(wrong[:, 2], 5) ** 2)), rel=1e-6)
    assert of(z).rmse == z.value
    assert diagnoses(report) == ["diagnosis.outliers"]


def test_two_wrong_points_are_both_named() -> None:
    wrong = NOISES.copy()
    wrong[[1, 6], 0] = 66 * MM, -58 * MM
    report = judge(Q1, delivery=surveyed(facade(wrong)))
    told = [dict(one.fields)["id"] for one in dict(report.why[0].fields)["worst"]]
    assert told == ["P1", "P6"]
    assert dict(report.remarks[0].fields)["ids"] == told


@pytest.mark.parametrize("row", range(8))
@pytest.mark.parametrize("axis", range(3))
def test_one_wrong_point_is_never_a_shift_or_a_rotation(row: int, axis: int) -> None:
    wrong = NOISES.copy()
    wrong[row, axis] += 62 * MM
    report = judge(Q1, delivery=surveyed(facade(wrong)))
    assert diagnoses(report) == ["diagnosis.outliers"]
    assert dict(report.remarks[0].fields)["ids"] == [f"P{row}"]


def test_a_shift_is_told_and_nothing_else() -> None:
    report = judge(Q1, delivery=surveyed(facade(NOISES + np.array([0.0, 0.0, 40 * MM]))))
    assert diagnoses(report) == ["diagnosis.shift"]
    told = dict(report.remarks[0].fields)
    assert told["axes"] == ["Z"]
    assert told["means"] == [(pytest.approx(40 * MM + NOISES[:, 2].mean(), abs=1e-9), "m")]


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_rotation_of_the_whole_is_told(axis: int) -> None:
    centre = FACADE.mean(axis=0)
    turned = Rotation.from_rotvec(np.eye(3)[axis] * 6e-3).apply(FACADE - centre) + centre
    report = judge(Q1, delivery=surveyed(facade(turned - FACADE + NOISES)))
    assert diagnoses(report) == ["diagnosis.rotation"]
    assert dict(report.remarks[0].fields)["size"].startswith("0.3")


def test_another_scale_of_the_whole_is_told() -> None:
    scaled = (FACADE - FACADE.mean(axis=0)) * 0.006
    report = judge(Q1, delivery=surveyed(facade(scaled + NOISES)))
    assert diagnoses(report) == ["diagnosis.scale"]
    assert dict(report.remarks[0].fields)["size"][0] == pytest.approx(0.006, rel=0.1)


def test_scatter_without_a_cause_gets_no_diagnosis() -> None:
    scatter = np.stack([with_moments(8, 0.0, 25 * MM)] * 3, axis=1)
    assert diagnoses(judge(Q1, delivery=surveyed(facade(np.roll(scatter, 2, axis=0) * (1, 1e-2, 1e-2))))) == []


def test_a_passing_delivery_gets_no_diagnosis() -> None:
    assert diagnoses(judge(Q1, delivery=surveyed(facade(NOISES)))) == []


def test_repeated_and_missing_rows_are_told_and_do_not_count() -> None:
    found = np.append(NOISE, np.nan)
    delivery = surveyed(checkpoints(found))
    points = delivery.checkpoints
    assert points is not None
    ties = replace(tied(delivery), points=point_ties(points, group=np.array([0, 1, 2, 3, 4, 5, 6, 2, 8])))
    element = judge(Q1, delivery=delivery, ties=ties).elements[0]
    standing = {row.id: row.standing for row in of(element).rows}
    assert (standing["P7"], standing["P8"]) == (Standing.REPEATED, Standing.MISSING)
    assert of(element).n == parameter(element, "n") == 7
    assert of(element).rows[-1].id == "P8"
    assert messages(element)


def test_a_repeated_row_is_no_outlier_and_not_the_worst() -> None:
    found = np.array([*NOISE, 0.0])
    found[7] = 90 * MM
    delivery = surveyed(checkpoints(found))
    points = delivery.checkpoints
    assert points is not None
    ties = replace(tied(delivery), points=point_ties(points, group=np.array([0, 1, 2, 3, 4, 5, 6, 7, 7])))
    rows = of(judge(Q1, delivery=delivery, ties=ties).elements[0]).rows
    assert {row.id for row in rows if row.outlier} == {"P7"}
    assert {row.id for row in rows if row.standing is Standing.REPEATED} == {"P8"}
