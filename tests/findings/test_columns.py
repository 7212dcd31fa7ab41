# SPDX-License-Identifier: MIT
"""What rules return and what becomes of it: order of hits, differences beyond a limit, outcomes that leave open."""

import itertools

import numpy as np
import pytest
import shapely

from foparq.findings.because import Because
from foparq.findings.hits import NOBODY, Deviations, hits, no_hits
from foparq.findings.outcome import Outcome, SetAside, Status
from foparq.findings.table import join_findings, no_findings


def outcome(**changes: object) -> Outcome:
    given = {
        "rule": "TOP011", "name": "undershoot", "scope": "a: *", "source": "a", "status": Status.CLEAN, "checked": 3,
        "found": 0, "faulty": np.empty(0, dtype=np.intp),
    }  # fmt: skip
    return Outcome(**{**given, **changes})  # type: ignore[arg-type]


@pytest.mark.parametrize("order", list(itertools.permutations(range(5))))
def test_hits_are_ordered_by_row_other_and_place(order: tuple[int, ...]) -> None:
    # Of the places of one pair, the left one lies higher than both of the right.
    row, other = np.array([1, 1, 1, 1, 2]), np.array([NOBODY, 3, 3, 3, 0])
    where = shapely.points([[9, 9], [-1, 8], [0, 5], [0, 7], [0, 0]])
    mixed = list(order)
    found = hits(row[mixed], where[mixed], np.array([1.0, 2.0, 3.0, 4.0, 5.0])[mixed], other[mixed])
    assert found.size.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert (found.row.tolist(), found.other.tolist()) == ([1, 1, 1, 1, 2], [-1, 3, 3, 3, 0])
    assert [(place.x, place.y) for place in found.where] == [(9, 9), (-1, 8), (0, 5), (0, 7), (0, 0)]


def test_hits_without_a_second_item_name_nobody() -> None:
    found = hits(np.array([5, 2]), shapely.points([[0, 0], [1, 1]]), np.array([1.0, 2.0]))
    assert (found.row.tolist(), found.other.tolist()) == ([2, 5], [-1, -1])
    assert len(found.take(np.array([True, False]))) == 1
    assert len(no_hits()) == len(hits(np.empty(0), np.empty(0, dtype=object), np.empty(0))) == 0


def test_differences_longer_than_the_limit_are_hits() -> None:
    found = Deviations(
        row=np.arange(4), where=shapely.points([[n, 0] for n in range(4)]),
        delta=np.array([[0.3, 0.4], [0.0, 0.5], [-0.3, -0.41], [0.0, 0.0]]), other=np.array([7, 6, 5, 4]),
    )  # fmt: skip
    beyond = found.beyond(0.5)
    assert (beyond.row.tolist(), beyond.other.tolist()) == ([2], [5])
    assert beyond.size.tolist() == [pytest.approx(np.hypot(0.3, 0.41))]
    assert found.beyond(0.0).row.tolist() == [0, 1, 2]
    assert found.take(np.array([3, 0])).other.tolist() == [4, 7]


@pytest.mark.parametrize(
    ("changes", "opens"),
    [
        ({}, False), ({"status": Status.FAULTY, "found": 2}, False), ({"status": Status.CRASHED}, True),
        ({"because": Because.UNIT_UNKNOWN}, True), ({"because": Because.NOTHING}, False),
        ({"aside": (SetAside(item="1", layer="A", rule="zero-length"),)}, False),
        ({"aside": (SetAside(item="1", layer="A", rule="zero-length"), SetAside(item="2", layer="A", rule=""))}, True),
    ],
)  # fmt: skip
def test_what_an_outcome_leaves_open(changes: dict, opens: bool) -> None:  # noqa: FBT001
    assert outcome(**changes).opens is opens


def test_a_plain_outcome_is_no_trial_no_helper_and_set_nothing_aside() -> None:
    plain = outcome()
    assert (plain.preview, plain.helper, plain.about_file, plain.skipped) == (False, False, False, 0)
    assert outcome(unjudged=np.array([4, 7])).skipped == 2


def test_no_findings_join_to_none() -> None:
    assert no_findings().place.shape == join_findings([no_findings()] * 2).place.shape == (0, 3)
    assert len(no_findings()) == len(join_findings([])) == len(join_findings([no_findings()] * 2)) == 0
