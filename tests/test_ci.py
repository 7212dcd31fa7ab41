# SPDX-License-Identifier: MIT
"""``.ci/run`` finds its way to uv where the system's pip refuses to install (PEP 668)."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

NEEDED = ("bash", "dirname", "mktemp", "rm", "tail", "mkdir", "cp", "cat")
UV = '#!/bin/sh\n[ "$1" = --version ] || echo "uv $*"\n'
REFUSING = "echo 'error: externally-managed-environment' >&2; exit 1"
#: a Python whose pip refuses, and whose new environments hold a pip that installs
PYTHON = f"""#!/bin/sh
case "$1 $2" in
"-m pip") {REFUSING} ;;
"-m venv") [ -e "$0.no-venv" ] && exit 1; mkdir -p "$3/bin"; cp "${{0%/*}}/installs" "$3/bin/python" ;;
esac
"""
INSTALLS = '#!/bin/sh\ncp "$STUBS/answers" "${0%/*}/uv"\n'

pytestmark = pytest.mark.skipif(os.name == "nt", reason="a shell script")


@pytest.fixture
def stubs(tmp_path: Path) -> Path:
    """The only folder on the PATH: what the script needs of the system, and a Python that refuses."""
    for name in NEEDED:
        found = shutil.which(name)
        assert found, name
        (tmp_path / name).symlink_to(found)
    for name, text in (("python3", PYTHON), ("installs", INSTALLS), ("answers", UV)):
        write(tmp_path / name, text)
    return tmp_path


def write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)


def run(stubs: Path, repository: Path) -> subprocess.CompletedProcess[str]:
    environment = {"PATH": str(stubs), "STUBS": str(stubs), "TMPDIR": str(stubs)}
    return subprocess.run(
        ["bash", repository / ".ci/run", "-x"], env=environment, capture_output=True, text=True, check=False
    )


def test_a_pip_that_refuses_is_not_the_end(stubs: Path, repository: Path) -> None:
    done = run(stubs, repository)
    assert (done.returncode, done.stdout) == (0, "uv run pytest -q -x\n"), done.stderr


def test_pipx_is_the_last_way(stubs: Path, repository: Path) -> None:
    (stubs / "python3.no-venv").touch()
    write(stubs / "pipx", '#!/bin/sh\nshift; shift\n[ "$1" = --version ] || echo "pipx: uv $*"\n')
    done = run(stubs, repository)
    assert (done.returncode, done.stdout) == (0, "pipx: uv run pytest -q -x\n"), done.stderr


def test_a_uv_that_is_there_is_used(stubs: Path, repository: Path) -> None:
    write(stubs / "uv", UV)
    (stubs / "python3").unlink()
    done = run(stubs, repository)
    assert (done.returncode, done.stdout) == (0, "uv run pytest -q -x\n"), done.stderr


def test_a_uv_that_cannot_be_had_is_told_with_every_reason(stubs: Path, repository: Path) -> None:
    (stubs / "python3.no-venv").touch()
    done = run(stubs, repository)
    assert done.returncode == 1
    assert "uv could not be installed" in done.stderr
    assert "externally-managed-environment" in done.stderr
    assert not list(stubs.glob("tmp.*"))
