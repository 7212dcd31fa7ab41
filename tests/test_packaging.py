# SPDX-License-Identifier: MIT
"""What is shipped: the wheel, built from the source archive and installed into an empty environment."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

#: what is needed to build; no compiled catalogue is among it
SOURCES = ("pyproject.toml", "hatch_build.py", "README.md", "LICENSE", "src", "rules", "reports")
UV = os.environ.get("UV") or shutil.which("uv")
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "VIRTUAL_ENV", "FOPARQ_SHARED"}
}


def run(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run(command, cwd=cwd, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}"
    return done.stdout


def uv(*arguments: str | Path, cwd: Path) -> None:
    assert UV is not None
    done = subprocess.run([UV, *arguments], cwd=cwd, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    if done.returncode and any(
        sign in done.stderr for sign in ("Failed to fetch", "error sending request", "dns error")
    ):
        pytest.skip(f"no network to build and install with: {done.stderr.strip().splitlines()[-1]}")
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def installed(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Scripts of an environment that holds the wheel and what it depends on."""
    if UV is None:
        pytest.skip("uv is not on the PATH")
    folder = tmp_path_factory.mktemp("shipped")
    for name in SOURCES:
        source, target = repository / name, folder / "source" / name
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("*.mo", "__pycache__"))
        else:
            target.parent.mkdir(exist_ok=True)
            shutil.copyfile(source, target)
    uv("build", "--out-dir", folder / "dist", folder / "source", cwd=folder)
    uv("venv", "--python", sys.executable, folder / "venv", cwd=folder)
    scripts = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
    wheel = next((folder / "dist").glob("*.whl"))
    uv("pip", "install", "--python", folder / "venv", wheel, cwd=folder)
    shutil.rmtree(folder / "source")
    return scripts


def test_the_wheel_answers(installed: Path, tmp_path: Path) -> None:
    assert "audit" in run(installed / "foparq", "--lang", "en", "--help", cwd=tmp_path)
    assert "TOP021" in run(installed / "foparq", "rules", cwd=tmp_path)
    assert "works" in run(installed / "foparq", "--lang", "en", "doctor", cwd=tmp_path)


def test_the_wheel_audits_a_delivery_and_reports_in_both_languages(
    installed: Path, tmp_path: Path, repository: Path
) -> None:
    shutil.copytree(
        repository / "fixtures/deliveries/station-a", tmp_path / "station", ignore=shutil.ignore_patterns("audit")
    )
    for language, verdict in (("en", "conforms"), ("pt-BR", "conforme")):
        told = run(installed / "foparq", "--lang", language, "audit", "station", cwd=tmp_path)
        assert verdict in told.lower()
        written = {path.name for path in (tmp_path / "station" / "audit").iterdir()}
        assert {"report.html", "quality.xml", "findings.gpkg", "audit.json", "findings.jsonl"} <= written


def test_what_travels_with_foparq_lies_in_the_wheel(installed: Path, tmp_path: Path, repository: Path) -> None:
    where = "from foparq.resources import shipped; print(shipped('templates')); print(shipped('rules'))"
    templates, rules = map(Path, run(installed / "python", "-c", where, cwd=tmp_path).split())
    assert templates.is_relative_to(installed.parent)
    for ours, theirs in ((repository / "reports/templates", templates), (repository / "rules", rules)):
        tracked = {path.relative_to(ours) for path in ours.rglob("*") if path.is_file() and path.suffix != ".mo"}
        shipped = {path.relative_to(theirs) for path in theirs.rglob("*") if path.is_file()}
        compiled = {path.with_suffix(".mo") for path in tracked if path.suffix == ".po"}
        assert shipped == tracked | compiled
