# SPDX-License-Identifier: MIT
"""Mildly damaged deliveries of every format are handled. ``tests/tools/fuzz.py`` runs more of the same cases."""

from collections.abc import Sequence
from functools import cache

import pytest
from tests.tools.fuzz import Result, outcome, summary

CASES = 1_000
STEP = 50


@cache
def results(start: int) -> Sequence[Result]:
    return [outcome(number) for number in range(start, start + STEP)]


@pytest.mark.parametrize("start", range(0, CASES, STEP))
def test_every_answer_is_honest(start: int) -> None:
    wrong = [one for one in results(start) if one.wrong]
    assert not wrong, "\n\n".join(f"case {one.case}: {one.kind} {one.edits}\n{'; '.join(one.wrong)}" for one in wrong)


def test_the_changes_are_mild() -> None:
    every = [one for start in range(0, CASES, STEP) for one in results(start)]
    assert sum(one.read for one in every) > CASES / 2, f"most are to be read\n{summary(every)}"
    assert sum(one.reached for one in every) > CASES / 2, f"most are to reach the rules\n{summary(every)}"
    assert {one.exit for one in every} == {0, 1, 2, 3, 4}, "every kind of answer is to be met"


def in_process(code: int) -> Result:
    """A drawing among the cases that is not audited by the command."""
    every = (one for start in range(0, CASES, STEP) for one in results(start))
    return next(one for one in every if one.kind.startswith("dxf") and one.exit == code and not one.full)


def test_a_crash_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    def crashing(*_: object) -> None:
        raise ValueError("planted")

    case = in_process(0).case
    monkeypatch.setattr("foparq.read.delivery.read_drawing", crashing)
    assert any("planted" in trace for trace in outcome(case).wrong)


def test_a_dishonest_answer_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    case = in_process(4).case
    monkeypatch.setattr("foparq.evaluate.conclusion.lost_files", lambda _: [])
    monkeypatch.setattr("foparq.evaluate.conclusion._unseen", lambda _: [])
    assert any("refused" in why for why in outcome(case).wrong)
