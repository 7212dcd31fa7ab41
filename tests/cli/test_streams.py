# SPDX-License-Identifier: MIT
"""Standard output that cannot be written to. It is buffered: what fails, fails late."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

COMMANDS = [
    ("rules", "--format", "json"),
    *(("check", "--scale=1:50", "--plane=xz", "--format", form) for form in ("text", "json", "jsonl", "csv")),
]


def run(repository: Path, command: tuple[str, ...], out: int) -> tuple[int, str]:
    file = [str(repository / "fixtures/deliveries/station-a-draft/fachada.dxf")] if command[0] == "check" else []
    done = subprocess.run(
        [sys.executable, "-m", "foparq", *command, *file, "--lang", "en"],
        env={**os.environ, "PYTHONUNBUFFERED": ""}, stdout=out, stderr=subprocess.PIPE, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stderr


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_full_disk_is_told_once(repository: Path, command: tuple[str, ...]) -> None:
    full = os.open("/dev/full", os.O_WRONLY)
    try:
        code, told = run(repository, command, full)
    finally:
        os.close(full)
    assert code == 2
    assert told.count("No space left on device") == told.count("\n") == 1


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_reader_that_left_is_no_error_to_tell(repository: Path, command: tuple[str, ...]) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    try:
        code, told = run(repository, command, writer)
    finally:
        os.close(writer)
    assert (code, told) == (141, "")
