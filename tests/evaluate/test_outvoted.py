# SPDX-License-Identifier: MIT
"""Distances whose ends are names only make nothing pass that those between points do not."""

from dataclasses import replace

import numpy as np
import pytest
from tests.evaluate.deliveries import distances, judge, spec, surveyed, tied

from foparq.evaluate.quality import ElementStatus
from foparq.findings.ties import Ends

LIMIT = 0.010  #: 0.2 mm at 1:50


def status(values: list[float], named: list[bool]) -> tuple[ElementStatus, str]:
    """Q2 of distances, some of them between names; and the message that decides."""
    delivery = surveyed(lengths=distances(np.array(values), survey_sd=0.001))
    ties = tied(delivery)
    assert ties.distances is not None
    ends = np.where(named, str(Ends.NAMES), str(Ends.POINTS)).astype(object)
    ties = replace(ties, distances=replace(ties.distances, ends=ends))
    (element,) = judge(spec("relative"), delivery=delivery, ties=ties).elements
    return element.status, element.why[0].message


@pytest.mark.parametrize(
    ("tied_error", "expected"),
    [
        (0.8 * LIMIT, (ElementStatus.PASS, "relative.pass")),
        (1.1 * LIMIT, (ElementStatus.UNDECIDED, "relative.names-outvote")),
    ],
)
def test_a_pass_must_stand_without_the_names(tied_error: float, expected: tuple[ElementStatus, str]) -> None:
    small = [0.002 if n % 2 else -0.002 for n in range(20)]
    large = [tied_error if n % 2 else -tied_error for n in range(4)]
    assert status(small + large, [True] * 20 + [False] * 4) == expected


def test_what_fails_with_the_names_fails_for_what_it_is() -> None:
    large = [1.3 * LIMIT if n % 2 else -1.3 * LIMIT for n in range(24)]
    assert status(large, [True] * 20 + [False] * 4)[0] is ElementStatus.FAIL
