# SPDX-License-Identifier: MIT
"""Names that differ in case, or in how accents are composed, are one name wherever they are compared."""

import unicodedata
from pathlib import Path

import ezdxf
import pytest
from tests.read.gis_files import read, write

from foparq.profile.manifest import ConfirmedSection, DrawingSection
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf
from foparq.read.statements import confirms

COMPOSED = "VÃO_JANELA"
DECOMPOSED = unicodedata.normalize("NFD", COMPOSED)
SMALL = "vão_janela"
SPELLINGS = [COMPOSED, DECOMPOSED, SMALL, unicodedata.normalize("NFD", SMALL)]


@pytest.mark.parametrize("order", [SPELLINGS, SPELLINGS[::-1]], ids=["forward", "backward"])
def test_layers_of_a_table_are_one(tmp_path: Path, order: list[str]) -> None:
    lines = [f"LINESTRING (0 {n}, 1 {n})" for n in range(4)]
    items = read(write(tmp_path / "a.gpkg", lines, Layer=order)).items
    assert set(items.layer) == {min(SPELLINGS)}


def test_the_spelling_of_a_table_wins_over_that_of_a_row(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)", "POINT (1 0)"], layer=SMALL, Layer=[DECOMPOSED, "PAREDE"])
    assert read(path).items.layer.tolist() == [SMALL, "PAREDE"]


def test_layers_of_a_dxf_are_one(tmp_path: Path) -> None:
    document = ezdxf.new("R2010")
    document.layers.add(COMPOSED)
    for name in SPELLINGS:
        document.modelspace().add_line((0, 0), (1, 0), dxfattribs={"layer": name})
    document.saveas(tmp_path / "a.dxf")
    drawing = read_dxf(tmp_path / "a.dxf", limits=LimitsSpec(), sagitta=0.001, unit="m", blocks="explode")
    assert set(drawing.items.layer) == {COMPOSED}


@pytest.mark.parametrize("asked", SPELLINGS)
def test_tables_are_asked_for_in_any_spelling(tmp_path: Path, asked: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"], layer=COMPOSED)
    write(path, ["POINT (1 0)"], layer="PAREDE", append=True)
    assert set(read(path, layers=(asked,)).items.layer) == {COMPOSED}


@pytest.mark.parametrize("path", ["Elevação.DXF", unicodedata.normalize("NFD", "elevação.dxf"), ".\\elevação.dxf", ""])
def test_a_confirmation_speaks_of_its_drawing_however_it_is_spelt(path: str) -> None:
    section = DrawingSection.model_validate({"path": "elevação.dxf", "unit": "mm"})
    one = ConfirmedSection.model_validate({"what": "unit", "value": "mm", "by": "A", "reason": "b", "path": path})
    assert confirms(one, section)
    other = DrawingSection.model_validate({"path": "elevacao.dxf", "unit": "mm"})
    assert confirms(one, other) is (path == "")


def test_files_of_a_shapefile_may_differ_in_case(tmp_path: Path) -> None:
    path = write(tmp_path / "fachada.shp", ["POINT (0 0)"], camada=["VÃO"])
    for ending in (".dbf", ".shx", ".cpg", ".prj"):
        path.with_suffix(ending).rename(tmp_path / f"FACHADA{ending.upper()}")
    drawing = read(path)
    assert (drawing.items.layer.tolist(), drawing.unit.metres) == (["VÃO"], 1.0)


def test_two_shapefiles_that_differ_in_case_keep_their_own_files(tmp_path: Path) -> None:
    first = write(tmp_path / "a.shp", ["POINT (0 0)"], camada=["UM"])
    second = write(tmp_path / "A.shp", ["POINT (1 0)"], camada=["DOIS"])
    assert [read(path).items.layer.tolist() for path in (first, second)] == [["UM"], ["DOIS"]]
    first.with_suffix(".prj").unlink()
    assert read(first).unit.metres is None
