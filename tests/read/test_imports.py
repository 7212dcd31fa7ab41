# SPDX-License-Identifier: MIT
"""A reader loads the libraries of its own format only, in the parent and in the child."""

import subprocess
import sys
from pathlib import Path

import laspy
import pyogrio
import pyproj
import pytest
from tests.read.drawn import new
from tests.read.gis_files import write

from foparq.read.versions import reader_versions

_READ = """
import sys
from pathlib import Path
import foparq.read.delivery as delivery
from foparq.profile.load import load_profile
from foparq.profile.manifest import DrawingSection
from foparq.read.guard.parent import guarded
from foparq.read.versions import reader_versions

def modules(path):
    delivery.read_drawing(path, DrawingSection(path="x"), load_profile("et-doc-foparq-a"), 1e-4)
    return sorted({name.split(".")[0] for name in sys.modules})

path = Path(sys.argv[1])
child = guarded(modules, path, file="x", seconds=100, memory=10**9)
drawings, crashes = delivery.read_loose(
    [path], profile=load_profile("et-doc-foparq-a"), scale=50.0, unit="m", plane=None)
assert len(drawings.parts) == 1 and not crashes
reader_versions()
parent = {name.split(".")[0] for name in sys.modules}
watched = {"ezdxf", "pyogrio"}
print(*sorted(watched & set(child)), "|", *sorted(watched & parent))
"""


@pytest.mark.parametrize(("format_", "child"), [("dxf", "ezdxf"), ("gpkg", "pyogrio")])
def test_only_the_library_of_the_format_is_loaded_and_only_in_the_child(
    format_: str, child: str, tmp_path: Path
) -> None:
    path = tmp_path / f"a.{format_}"
    if format_ == "dxf":
        document = new()
        document.modelspace().add_line((0, 0), (1, 0))
        document.saveas(path)
    else:
        write(path, ["LINESTRING (0 0, 1 0)"])
    done = subprocess.run([sys.executable, "-c", _READ, str(path)], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == f"{child} |", done.stderr


def test_versions_are_those_of_the_libraries() -> None:
    told = reader_versions()
    assert told["GDAL"] == ".".join(map(str, pyogrio.__gdal_version__))
    assert told["PROJ"] == pyproj.proj_version_str
    assert told["pyogrio"] == pyogrio.__version__
    assert told["laspy"] == laspy.__version__, "of an extra, where it is installed"
