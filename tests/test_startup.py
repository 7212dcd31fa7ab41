# SPDX-License-Identifier: MIT
"""What a command loads before it answers, and what libraries say meanwhile."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyogrio.raw
import pytest
import shapely

#: libraries that take a tenth of a second or more, or are needed by one command only
HEAVY = {"numpy", "scipy", "shapely", "pyogrio", "pyproj", "ezdxf", "lxml", "openpyxl", "jinja2", "pydantic", "rich"}
LOOK = """
import sys
from foparq.cli.main import run
run(sys.argv[1:])
sys.stderr.write("\\n".join(["", *sys.modules]))
"""
#: every library warns when it is loaded, as one does whose dependency has grown older
GRUMBLE = """
import sys, warnings
class Grumble:
    @staticmethod
    def find_spec(name, path=None, target=None):
        for kind in (DeprecationWarning, FutureWarning, UserWarning, RuntimeWarning):
            if name in {libraries!r}:
                warnings.warn_explicit(name + " grows old", kind, name + ".py", 1, module=name)
sys.meta_path.insert(0, Grumble)
"""


@pytest.fixture
def drawing(tmp_path: Path) -> Path:
    """A box and a line that stops 5 mm short of it."""
    shapes = shapely.from_wkt(["LINESTRING (0 0, 4 0, 4 3, 0 3, 0 0)", "LINESTRING (1 0, 1 2.995)"])
    path = tmp_path / "x.gpkg"
    pyogrio.raw.write(
        path, np.asarray(shapely.to_wkb(shapes)), field_data=[], fields=[], layer="lines", driver="GPKG",
        geometry_type="LineString", crs='LOCAL_CS["sheet", UNIT["metre", 1]]',
    )  # fmt: skip
    return path


def loaded(*arguments: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", LOOK, *arguments], capture_output=True, text=True, encoding="utf-8", check=True
    )
    return set(done.stderr.split())


@pytest.mark.parametrize("arguments", [("--help",), ("rules",), ("explain", "undershoot"), ("check", "--help")])
def test_who_only_asks_waits_for_no_library(arguments: tuple[str, ...]) -> None:
    assert not loaded(*arguments) & HEAVY


def test_a_check_without_reports_loads_no_writers_and_no_statistics(drawing: Path) -> None:
    modules = loaded("check", str(drawing), "--scale", "1:50")
    assert {"shapely", "pydantic"} <= modules
    assert not modules & {"lxml", "jinja2", "rich", "scipy.stats", "foparq.report.page.page", "foparq.report.iso19157"}


@pytest.mark.parametrize("strict", [(), ("-W", "error")])
@pytest.mark.parametrize("inherited", ["", "error"])
def test_what_libraries_warn_of_neither_shows_nor_fails(
    drawing: Path, tmp_path: Path, strict: tuple[str, ...], inherited: str
) -> None:
    (tmp_path / "sitecustomize.py").write_text(GRUMBLE.replace("{libraries!r}", repr(HEAVY | {"click"})), "utf-8")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONWARNINGS": inherited}
    grumbles = subprocess.run(
        [sys.executable, "-c", "import click, shapely"], env=environment, capture_output=True, text=True, check=False
    )
    assert "click grows old" in grumbles.stderr
    done = subprocess.run(
        [sys.executable, *strict, "-m", "foparq", "check", str(drawing), "--scale=1:50", "--out", str(tmp_path / "o")],
        env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (1, "")
    assert (tmp_path / "o" / "report.html").is_file()
