# SPDX-License-Identifier: MIT
"""Points within lines, at corners, and at inserts: what each of them proves."""

import numpy as np
import pytest
from tests.check.test_ties import BOXES, CORNERS, NEAR, checkpoints, drawing, ground, in_space, lies, texts

from foparq.check.tables.distances import tie_distances
from foparq.check.tables.points import tie_points
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.tied import resolution_of
from foparq.findings.ties import Ends, Lies, Ties
from foparq.model.delivery import Delivery
from foparq.model.tables import Distances
from foparq.report.words import Words

LEFT = CORNERS[:4]  #: lower left corner of each opening


def test_a_drawing_that_was_moved_along_its_lines_is_told() -> None:
    moved = checkpoints(in_space(LEFT + np.array([0.1, 0.0])))
    assert lies(moved, drawing()) == [Lies.LINEWORK] * 4
    cause = tie_points(moved, [ground(drawing())], NEAR).cause
    assert cause is not None
    assert cause.kind == "shift"
    assert cause.shift == pytest.approx((-0.1, 0.0, 0.0), abs=1e-9)


def test_a_drawing_that_was_stretched_along_its_lines_is_told() -> None:
    # The left edges, 1.2 % nearer to the left end of the drawing, still end on lower edges.
    table = in_space(np.column_stack([40.0 + (LEFT[:, 0] - 40.0) / 0.988, LEFT[:, 1]]))
    cause = tie_points(checkpoints(table), [ground(drawing())], NEAR).cause
    assert cause is not None
    assert (cause.kind, cause.along) == ("scale", "right")
    assert cause.factor == pytest.approx(0.988, abs=1e-4)


def test_points_in_the_middle_of_lines_are_no_shift() -> None:
    middle = np.array([((a + c) / 2, b) for a, b, c, _ in BOXES])
    ties = tie_points(checkpoints(in_space(middle)), [ground(drawing())], NEAR)
    assert ties.lies.tolist() == [Lies.LINEWORK] * 4
    assert ties.cause is None


@pytest.mark.parametrize(("off", "known"), [(0.0, 0.0), (0.0009, 0.0009), (0.02, 0.5)])
def test_coordinates_of_a_vertex_were_not_rounded_by_more_than_they_differ(off: float, known: float) -> None:
    # A column that shows no digit after the sign may hide half a metre, and a point then lies where it may.
    points = checkpoints(
        in_space(CORNERS) + np.array([0, off, 0]), resolution=np.array([0.50005] * 3), printed=np.array([0.5] * 3)
    )
    ties = tie_points(points, [ground(drawing())], NEAR)
    assert set(ties.lies) == {Lies.VERTEX}
    evidence = Evidence(
        delivery=Delivery(title="t", sources=(), checkpoints=points), outcomes=(), counts=None, scale=50.0,
        ties=Ties(points=ties, drawings=1),
    )  # fmt: skip
    assert resolution_of(points, evidence, 1, np.arange(len(points.id))) == pytest.approx(0.00005 + known, abs=1e-9)


def test_the_depth_of_a_flat_drawing_proves_no_digits() -> None:
    points = checkpoints(
        np.column_stack([CORNERS, np.full(8, 3.0)]), resolution=np.array([0.6] * 3), printed=np.array([0.5] * 3)
    )
    ties = tie_points(points, [ground(drawing(plane="xy"))], NEAR)
    evidence = Evidence(
        delivery=Delivery(title="t", sources=(), checkpoints=points), outcomes=(), counts=None, scale=50.0,
        ties=Ties(points=ties, drawings=1),
    )  # fmt: skip
    assert [resolution_of(points, evidence, axis, np.arange(len(points.id))) for axis in range(3)] == pytest.approx(
        [0.1, 0.1, 0.6]
    )


def test_a_distance_may_end_at_an_insert_that_bears_a_name() -> None:
    marks = {"A": (40.5, 8.0), "B": (43.5, 8.0)}
    places = np.array([[[40.5, 8.0, 0.0], [43.5, 8.0, 0.0]], [[40.5, 8.0, 0.0], [43.5, 8.1, 0.0]]])
    lengths = Distances(
        id=texts("D1", "D2"), measured=np.array([3.001, 3.003]), delivered=np.hypot(3.0, [0.0, 0.1]),
        resolution=0.0, survey_sd=0.002, places=places,
    )  # fmt: skip
    sheet = ground(drawing(plane="xy", names=marks))
    told = tie_distances(lengths, None, None, [sheet], tie=NEAR.tie, visible=NEAR.visible)
    assert told.ends.tolist() == [Ends.POINTS, Ends.ABSENT]


def test_a_name_that_two_drawings_bear_is_no_place() -> None:
    marks = {"A": (40.5, 8.0), "B": (43.5, 8.0)}
    lengths = Distances(
        id=texts("D1"), measured=np.array([3.001]), delivered=np.array([3.0]), resolution=0.0, survey_sd=0.002,
        start=texts("A"), end=texts("B"),
    )  # fmt: skip
    sheets = [ground(drawing(plane="xy", names=marks)), ground(drawing(plane="xy", names=marks, path="g.dxf"))]
    for some, ends in ((sheets[:1], Ends.POINTS), (sheets, Ends.NAMES)):
        told = tie_distances(lengths, None, None, some, tie=NEAR.tie, visible=NEAR.visible)
        assert told.ends.tolist() == [ends]


@pytest.mark.parametrize(("value", "shown"), [(1e-5, "0.001 %"), (0.01, "1 %"), (0.0, "0 %"), (0.0676, "6.76 %")])
def test_a_small_probability_is_not_nothing(value: float, shown: str) -> None:
    assert Words("en").quantity(value, "1") == shown
