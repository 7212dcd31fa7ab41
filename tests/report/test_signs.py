# SPDX-License-Identifier: MIT
"""Signs of severities on plates: told apart by their outlines, without colour."""

from itertools import pairwise

import numpy as np
import pytest

from foparq.report.page.inking import _SIGNS


@pytest.mark.parametrize("severity", _SIGNS)
def test_a_sign_is_the_same_from_both_sides(severity: str) -> None:
    corners = np.array(_SIGNS[severity])
    mirrored = corners * (-1, 1)
    assert {tuple(one) for one in mirrored.tolist()} == {tuple(one) for one in corners.tolist()}


@pytest.mark.parametrize("severity", _SIGNS)
def test_a_sign_is_one_convex_outline_around_its_middle(severity: str) -> None:
    corners = [*_SIGNS[severity], *_SIGNS[severity][:2]]
    steps = [np.subtract(b, a) for a, b in pairwise(corners)]
    turns = {float(np.sign(one[0] * two[1] - one[1] * two[0])) for one, two in pairwise(steps)}
    arms = {float(np.sign(a[0] * b[1] - a[1] * b[0])) for a, b in pairwise(corners)}
    assert turns == arms
    assert len(turns) == 1


def test_no_two_signs_are_alike() -> None:
    assert len(set(_SIGNS.values())) == len(_SIGNS)
