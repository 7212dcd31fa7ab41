# SPDX-License-Identifier: MIT
"""Styles in ``findings.gpkg``: every layer has one, in words of its language only; and QGIS draws with it."""

import json
import re
import shutil
import sqlite3
import subprocess
import xml.etree.ElementTree as ET
from contextlib import closing
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from foparq.audit import audit
from foparq.report.findings_gpkg import write_findings_gpkg
from foparq.report.record import AuditRecord

DRAFT = Path(__file__).resolve().parents[2] / "fixtures" / "deliveries" / "station-a-draft"
QGIS = Path("/usr/bin/python3")  # QGIS of Debian comes with the Python of the system
LANGUAGES = ("pt-BR", "en")
LAYERS = {"flags_p", "flags_l", "flags_a", "residuals", "features_a", "desenho_l", "desenho_a"}
#: the same in both languages: names of axes, units and planes
COMMON = {"x", "y", "z", "m", "m²", "Handle", "Item", "area"}


@cache
def draft() -> AuditRecord:
    """The draft of the station, with one feature that may be part and a checkpoint that does not count."""
    return audit(DRAFT / "delivery.toml").record


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    made = {}
    for language in LANGUAGES:
        made[language] = tmp_path_factory.mktemp(language) / "findings.gpkg"
        write_findings_gpkg(replace(draft(), language=language), made[language])
    return made


def styles(path: Path) -> dict[str, ET.Element]:
    with closing(sqlite3.connect(path)) as database:
        rows = database.execute("SELECT f_table_name, styleQML FROM layer_styles WHERE useAsDefault = 1").fetchall()
    return {name: ET.fromstring(style) for name, style in rows}


def columns(path: Path, layer: str) -> list[str]:
    with closing(sqlite3.connect(path)) as database:
        return [row[1] for row in database.execute(f"PRAGMA table_info({layer})")]


def shown(style: ET.Element) -> list[str]:
    """Every word of ours that a person reads in QGIS."""
    labels = [part.get("label") for part in style.iter("category")] + [part.get("name") for part in style.iter("alias")]
    values = [part.get("name") for part in style.iterfind(".//editWidget//Option[@type='QString']")]
    tip = re.findall(r">([^<>\[\]]+): \[%", style.findtext("mapTip") or "")
    return [text or "" for text in (*labels, *values, *tip)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_layer_has_a_style_and_a_description(packages: dict[str, Path], language: str) -> None:
    assert set(styles(packages[language])) == LAYERS
    with closing(sqlite3.connect(packages[language])) as database:
        told = dict(database.execute("SELECT table_name, description FROM gpkg_contents WHERE data_type = 'features'"))
    assert set(told) == LAYERS
    assert all(text and not text.startswith("gpkg.") for text in told.values())
    assert ("100.000" if language == "pt-BR" else "100,000") in told["desenho_l"]


def test_words_are_those_of_the_language(packages: dict[str, Path]) -> None:
    portuguese, english = (styles(packages[language]) for language in LANGUAGES)
    for layer in LAYERS:
        one, other = shown(portuguese[layer]), shown(english[layer])
        assert len(one) == len(other)
        assert set(one) & set(other) <= COMMON, layer
        for text in (*one, *other):
            assert text.strip(), layer
            assert not re.fullmatch(r"[a-z]+(\.[a-z0-9_-]+)+", text), f"{text} is an id, no word"


@pytest.mark.parametrize("language", LANGUAGES)
def test_styles_name_columns_that_are_there(packages: dict[str, Path], language: str) -> None:
    for layer, style in styles(packages[language]).items():
        known = columns(packages[language], layer)
        aliased = [part.get("field") for part in style.iter("alias")]
        assert aliased == known[2:], layer  # all but fid and geom
        told = [
            style.findtext("mapTip") or "", style.findtext("previewExpression") or "",
            *(part.get("fieldName") or "" for part in style.iter("text-style")),
        ]  # fmt: skip
        for text in told:
            assert set(re.findall(r'represent_value\("([^"]+)"\)', text)) <= set(known), layer


def test_a_hostile_class_is_a_value(tmp_path: Path) -> None:
    record = draft()
    found = record.quality.found
    names = found.feature_class.copy()
    names[0] = '"/><script>&\u202e'
    changed = replace(record, quality=replace(record.quality, found=replace(found, feature_class=names)))
    write_findings_gpkg(changed, tmp_path / "f.gpkg")
    values = [part.get("value") for part in styles(tmp_path / "f.gpkg")["features_a"].iter("Option")]
    assert '"/><script>&\\u202e' in values


def has_qgis() -> bool:
    there = shutil.which(str(QGIS)) is not None
    return there and subprocess.run([QGIS, "-c", "import qgis.core"], capture_output=True, check=False).returncode == 0


@pytest.mark.qgis
@pytest.mark.parametrize("language", LANGUAGES)
def test_qgis_draws_every_feature_with_its_style(
    packages: dict[str, Path], language: str, repository: Path, tmp_path: Path
) -> None:
    if not has_qgis():
        pytest.skip("QGIS is not installed: apt-get install qgis python3-qgis")
    done = subprocess.run(
        [QGIS, repository / "tests" / "tools" / "qgis_looks.py", packages[language], tmp_path / "look.png"],
        capture_output=True, text=True, check=True, timeout=300,
        env={"QT_QPA_PLATFORM": "offscreen", "HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path)},
    )  # fmt: skip
    told = json.loads(done.stdout)
    assert set(told) == LAYERS
    for name, layer in told.items():
        assert layer["styled"], name
        assert layer["drawn"] == layer["features"], f"{name}: QGIS has no symbol for some"
        assert layer["errors"] == [], name
    assert told["desenho_l"]["width"] > 60  # the station is 60 m wide, and seen from the front
    assert told["desenho_l"]["height"] > 8
    assert told["flags_p"]["ink"] > 1000  # pixels of its own colour
    title = {"pt-BR": "<b>Linha aquém</b>", "en": "<b>Undershoot</b>"}[language]
    assert any(tip.startswith(title) for tip in told["flags_p"]["tips"])
    assert all("&lt;" not in tip and "[%" not in tip for layer in told.values() for tip in layer["tips"])
