# SPDX-License-Identifier: MIT
"""Fixtures that every test may use."""

import os
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]


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
    folder = Path(os.environ.get("FOPARQ_SHARED", REPOSITORY.parent / "shared"))
    if not (folder / "data").is_dir():
        pytest.skip(f"the shared shelf is not at {folder}: set FOPARQ_SHARED")
    return folder
