# SPDX-License-Identifier: MIT
"""The shelf of real files: who reads it says so, and who relies on it learns that it is missing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

READER = "tests/accuracy/test_student.py"  #: one of its tests reads the shelf


def test_every_test_that_reads_the_shelf_is_marked(request: pytest.FixtureRequest) -> None:
    readers = [item for item in request.session.items if "shared" in getattr(item, "fixturenames", ())]
    assert not [item.nodeid for item in readers if item.get_closest_marker("shared") is None], "mark it: shared"


def run(repository: Path, **said: str) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name not in {"CI", "FOPARQ_SHARED"}}
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", READER],
        cwd=repository, env={**environment, **said}, capture_output=True, text=True, check=False,
    )  # fmt: skip


@pytest.mark.parametrize("said", [{}, {"CI": "true"}])
def test_a_shelf_that_is_named_and_missing_fails_the_run(
    repository: Path, tmp_path: Path, said: dict[str, str]
) -> None:
    done = run(repository, FOPARQ_SHARED=str(tmp_path / "nowhere"), **said)
    assert done.returncode == pytest.ExitCode.TESTS_FAILED
    assert f"1 tests of the shared shelf were NOT run: no shelf at {tmp_path / 'nowhere'}" in done.stdout


def test_a_shelf_that_is_renounced_is_told_and_no_failure(repository: Path) -> None:
    done = run(repository, FOPARQ_SHARED="none", CI="true")
    assert done.returncode == pytest.ExitCode.OK
    assert "1 tests of the shared shelf were NOT run" in done.stdout


def test_ci_relies_on_the_shelf_beside_the_checkout(repository: Path) -> None:
    there = (repository.parent / "shared" / "data").is_dir()
    assert run(repository).returncode == pytest.ExitCode.OK
    assert run(repository, CI="true").returncode == (pytest.ExitCode.OK if there else pytest.ExitCode.TESTS_FAILED)
