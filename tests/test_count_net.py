# SPDX-License-Identifier: MIT
"""A count of features that breaks off is told as what it is, and costs nothing else."""

import shutil
from pathlib import Path

import pytest

import foparq.audit as module
from foparq import bounded
from foparq.audit import Audit, audit
from foparq.evaluate.quality import ElementStatus, Verdict
from foparq.profile.load import load_profile


def endless(*_: object, **__: object) -> None:
    while True:
        pass


def crashing(*_: object, **__: object) -> None:
    raise ZeroDivisionError("planted")


def audited(repository: Path, folder: Path) -> Audit:
    shutil.copytree(repository / "fixtures" / "deliveries" / "station-a", folder / "station")
    return audit(folder / "station", language="en")


def assert_open(done: Audit, message: str) -> None:
    quality = done.record.quality
    assert quality.verdict is Verdict.UNDECIDED
    status = {element.id: element.status for element in quality.elements}
    assert (status["Q4"], status["Q5"]) == (ElementStatus.UNDECIDED, ElementStatus.UNDECIDED)
    assert {status[name] for name in ("Q1-X", "Q2", "Q3", "Q6-X")} == {ElementStatus.PASS}
    (q5,) = (element for element in quality.elements if element.id == "Q5")
    assert [reason.message for reason in q5.why] == [message]


def test_a_count_that_crashes(repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "listed_in", crashing)
    done = audited(repository, tmp_path)
    assert_open(done, "features.crashed")
    assert "planted" in done.log[0]


def test_a_count_without_end(repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    profile = load_profile("et-doc-foparq-a")
    monkeypatch.setattr(bounded, "budget_of", lambda *_: bounded.Budget(1.0, 1.0, profile.limits.check_memory))
    monkeypatch.setattr(module, "listed_in", endless)
    done = audited(repository, tmp_path)
    assert_open(done, "features.limit")
    assert done.log == ()
