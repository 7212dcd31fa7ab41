# SPDX-License-Identifier: MIT
"""Fixtures that every test may use."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

#: how long an example takes says something of the machine, nothing of foparq
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

#: scripts run by hand; they import each other as neighbours
collect_ignore = ["tools"]

REPOSITORY = Path(__file__).resolve().parents[1]
SHELF = Path(os.environ.get("FOPARQ_SHARED") or REPOSITORY.parent / "shared")
#: whether somebody relies on the tests that read the shelf
EXPECTED = bool(os.environ.get("FOPARQ_SHARED") or os.environ.get("CI") == "true") and str(SHELF) != "none"


KERNELS = REPOSITORY / "src" / "foparq" / "mesh"


def forget_stale() -> None:
    """Remove what was compiled before the newest source: the compiler of kernels looks at each one's own file only."""
    newest = max(path.stat().st_mtime for path in KERNELS.glob("*.py"))
    for kept in (KERNELS / "__pycache__").glob("*.nb[ic]"):
        if kept.stat().st_mtime < newest:
            kept.unlink(missing_ok=True)


forget_stale()
if "PYTEST_XDIST_WORKER" in os.environ:
    # Tests that run side by side are told a width of lines, though nobody watches.
    os.environ.pop("COLUMNS", None)


def pytest_report_header() -> list[str]:
    """Versions of what decides geometry and formats."""
    import ezdxf
    import pyogrio
    import shapely

    gdal = ".".join(map(str, pyogrio.__gdal_version__))
    return [f"GEOS {shapely.geos_version_string}, GDAL {gdal}, ezdxf {ezdxf.__version__}"]


def pytest_configure() -> None:
    """Say what is wrong with a rule before every test that needs the rules says something else."""
    from foparq.check.registry import all_rules
    from foparq.errors import RuleError
    from foparq.report.words import Words

    try:
        all_rules()
    except RuleError as error:
        pytest.exit(Words("en").error(error), returncode=1)


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the checkout."""
    return REPOSITORY


@pytest.fixture(scope="session")
def shared() -> Path:
    """The shelf of real files nobody here wrote; ``FOPARQ_SHARED`` names it, else it lies beside the checkout."""
    if not has_shelf():
        pytest.skip(f"the shared shelf is not at {SHELF}: set FOPARQ_SHARED")
    return SHELF


def has_shelf() -> bool:
    return (SHELF / "data").is_dir()


#: tests that were to run and had no shelf to read; reports come here from whatever process ran them
_not_run: set[str] = set()


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Keep which tests of the shelf were skipped for its absence."""
    if report.skipped and "shared" in report.keywords and not has_shelf():
        _not_run.add(report.nodeid)


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """A run that is relied on is not green without the shelf."""
    if EXPECTED and exitstatus == pytest.ExitCode.OK and _not_run:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say loudly what was not tested."""
    if _not_run:
        terminalreporter.section("shared shelf", red=True, bold=True)
        terminalreporter.line(
            f"{len(_not_run)} tests of the shared shelf were NOT run: no shelf at {SHELF}. "
            "FOPARQ_SHARED names its folder; FOPARQ_SHARED=none says that it is meant.",
            red=True,
        )
