# SPDX-License-Identifier: MIT
"""An elevation of 3,000 items: without a fault none is told, with sixty planted ones just these, in every format.

DXF, a GeoPackage with a table for each layer, and the GeoPackage that GDAL makes of the DXF.
"""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
import shapely
from tests.cli.conftest import Command
from tests.read.cad_exports import APART, WHOLE, export
from tests.tools.elevation import Elevation, elevation, write_dxf, write_gpkg
from tests.tools.elevation_faults import Planted, plant

FORMATS = ["dxf", "gpkg", "whole", "apart"]
NEAR = 1e-3  #: metres; GDAL's chords lie so near to the arcs they stand for


def written(made: Elevation, form: str, folder: Path) -> Path:
    if form == "gpkg":
        return write_gpkg(made, folder / "fachada.gpkg")
    path = write_dxf(made, folder / "fachada.dxf")
    return path if form == "dxf" else export(path, folder / "exportada.gpkg", {"whole": WHOLE, "apart": APART}[form])


def found(foparq: Command, path: Path, *options: str) -> list[dict[str, Any]]:
    code, out, err = foparq("check", path, "--scale", "1:50", "--unit", "m", "--format", "jsonl", *options)
    assert (code in (0, 1), err) == (True, "")
    return [json.loads(line) for line in out.splitlines()]


def faults(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [row for row in rows if row["severity"] != "note"]


@pytest.mark.parametrize("form", FORMATS)
def test_without_a_fault_none_is_told(foparq: Command, form: str, tmp_path: Path) -> None:
    made = elevation(1)
    assert len(made) > 3000
    rows = found(foparq, written(made, form, tmp_path), "--areas", "CANTARIA")
    assert faults(rows) == []
    told = Counter(row["name"] for row in rows)
    assert told["exploded-dashes"] == 8
    assert told["undeclared-coverage"] == 0
    assert {row["layer"] for row in rows if row["name"] == "free-end"} <= {"BALAUSTRADA", "CIMALHA", "EIXO", "PROJECAO"}


def test_stones_that_nobody_declares_are_one_proposal(foparq: Command, tmp_path: Path) -> None:
    rows = found(foparq, written(elevation(1), "dxf", tmp_path))
    assert faults(rows) == []
    assert [row["layer"] for row in rows if row["name"] == "undeclared-coverage"] == ["CANTARIA"]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("seed", [2, 3])
def test_sixty_planted_faults_are_told_and_no_other(foparq: Command, form: str, seed: int, tmp_path: Path) -> None:
    made = elevation(seed)
    left: list[Planted] = plant(made, seed)
    assert len(left) == 60
    rows = faults(found(foparq, written(made, form, tmp_path), "--areas", "CANTARIA"))
    for row in rows:
        place = shapely.Point(row["where"][:2])
        of = [one for one in left if one.rule == row["name"] and one.where.distance(place) < NEAR]
        assert of, (row["name"], row["where"], row["message"])
        left.remove(of[0])
    assert left == []
