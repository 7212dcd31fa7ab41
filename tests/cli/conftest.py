# SPDX-License-Identifier: MIT
"""The command, run in this process."""

from collections.abc import Callable

import pytest

from foparq.cli.main import run

Command = Callable[..., tuple[int, str, str]]


@pytest.fixture
def foparq(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    """Run the command under an English locale, its output no terminal: exit code, standard output, standard error."""
    for name in ("LC_ALL", "LC_MESSAGES", "LANG", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANGUAGE", "en")
    # What the first run on a machine says is asked for by itself.
    monkeypatch.setattr("foparq.mesh.warm.cold", lambda: False)

    def call(*arguments: object) -> tuple[int, str, str]:
        code = run([str(argument) for argument in arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return call
