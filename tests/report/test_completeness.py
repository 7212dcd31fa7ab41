# SPDX-License-Identifier: MIT
"""What every report says of a facade whose windows anybody can count."""

import json
import sqlite3
import tomllib
from contextlib import closing
from pathlib import Path

import ezdxf
import pyogrio
import pytest
import shapely
from tests.check.windows import pane

from foparq.audit import audit_to
from foparq.cli.main import run
from foparq.report.balances import balance_note, balance_rows
from foparq.report.files import Written
from foparq.report.page.tables import element_views
from foparq.report.words import LANGUAGES, Words

HOSTILE = "<b>porta</b>"
MANIFEST = """
[delivery]
title = "Casa"
scale = "1:50"
language = "en"

[[drawing]]
path = "f.dxf"
unit = "m"
plane = "xy"
facade = "N"
classes = { JANELA = "Janelas", PORTA = "<b>porta</b>" }

[features]
path = "f.csv"
"""
DECISION = """
[[decision]]
element = "Q5"
class = "janela"
facade = "n"
counted = 5
by = "A. Souza"
reason = "seen"
"""


def deliver(folder: Path, more: str = "") -> Written:
    """Six windows in the list; drawn: four, one of them again 2 mm aside, one half over another. A door too many."""
    document = ezdxf.new(units=6)
    space = document.modelspace()
    pane(document.blocks.new("J"))
    for x in (0.0, 3.0, 6.0, 9.0, 0.002, 3.5):
        space.add_blockref("J", (x, 3), dxfattribs={"layer": "JANELA"})
    pane(space, 0.0, 0.0, layer="PORTA")
    pane(space, 6.0, 0.0, layer="PORTA")
    document.saveas(folder / "f.dxf")
    rows = [f"J{n};janela;N;1;obrigatorio" for n in range(6)] + [f"P1;{HOSTILE};N;1;required"]
    (folder / "f.csv").write_text("\n".join(["id;class;facade;count;use", *rows]))
    (folder / "delivery.toml").write_text(MANIFEST + more)
    return audit_to(folder, folder / "out")


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> tuple[Written, Path]:
    folder = tmp_path_factory.mktemp("casa")
    return deliver(folder), folder / "out"


def test_the_run_says_what_was_found_of_each_class(done: tuple[Written, Path]) -> None:
    told = json.loads((done[1] / "audit.json").read_text())["completeness"]
    door, window = told
    assert (window["class"], window["facade"], window["required"], window["state"]) == ("janela", "N", 6, "short")
    assert window["found"] == {"least": 4, "most": 5}
    assert window["missing"] == {"least": 1, "most": 2}
    assert window["surplus"] == {"least": 0, "most": 0}
    assert window["ids"] == [f"J{n}" for n in range(6)]
    assert window["only_counted"]
    assert sorted(item["reading"] for item in window["items"]) == ["copy", *["counted"] * 4, "part"]
    assert (door["class"], door["state"], door["surplus"]) == (HOSTILE, "over", {"least": 1, "most": 1})


def test_outlines_lie_where_the_windows_are(done: tuple[Written, Path]) -> None:
    found = pyogrio.raw.read(done[1] / "findings.gpkg", layer="features_a")
    shapes = shapely.from_wkb(found[2])
    columns = dict(zip(found[0]["fields"], found[3], strict=True))
    windows = shapes[(columns["class"] == "Janelas") & (columns["code"] == "counted")]
    expected = [shapely.box(x, 3, x + 1, 4.5) for x in (0, 3, 6, 9)]
    assert len(windows) == len(expected)
    for box in expected:
        assert max(shapely.area(shapely.intersection(windows, box))) == pytest.approx(1.5, abs=0.01)
    with closing(sqlite3.connect(done[1] / "findings.gpkg")) as database:
        names = [name for (name,) in database.execute("SELECT table_name FROM gpkg_contents")]
    assert names.count("features_a") == 1


def test_the_page_shows_them_in_both_languages(done: tuple[Written, Path]) -> None:
    text = (done[1] / "report.html").read_text()
    assert HOSTILE not in text
    quality = done[0].record.quality
    for language in LANGUAGES:
        words = Words(language)
        assert balance_note(words, quality) == words("report.balance.only-counted")
        assert text.count(words("report.balance.only-counted")) == 1
        assert words("report.drawing.outline-counted", label="janela", count="4") in text
        assert words("report.drawing.outline-open", label="janela", count="2") in text


def test_the_decision_that_is_proposed_is_one_when_it_is_filled_in(done: tuple[Written, Path]) -> None:
    rows = {row.label: row for row in balance_rows(Words("pt-BR"), done[0].record.quality)}
    proposed = rows["janela / N"].decision
    with pytest.raises(tomllib.TOMLDecodeError):
        tomllib.loads(proposed)
    assert all("#" in line for line in proposed.splitlines() if line.startswith(("counted", "by", "reason")))
    filled = proposed.replace("counted = ", "counted = 5").replace('""', '"a"')
    (table,) = tomllib.loads(filled)["decision"]
    assert table == {"element": "Q5", "class": "janela", "facade": "N", "counted": 5, "by": "a", "reason": "a"}
    assert rows[f"{HOSTILE} / N"].decision == ""


def test_a_decision_is_shown_with_its_name(tmp_path: Path) -> None:
    written = deliver(tmp_path, DECISION)
    _, window = json.loads((tmp_path / "out" / "audit.json").read_text())["completeness"]
    assert window["decision"] == {"element": "Q5", "counted": 5, "by": "A. Souza", "reason": "seen"}
    assert (window["found"], window["missing"]) == ({"least": 5, "most": 5}, {"least": 1, "most": 1})
    assert "A. Souza" in (tmp_path / "out" / "report.html").read_text()
    assert "A. Souza" in (tmp_path / "out" / "quality.xml").read_text()
    (row,) = (row for row in balance_rows(Words("en"), written.record.quality) if row.label == "janela / N")
    assert "A. Souza" in row.notes[0]
    assert row.decision == ""


def test_the_terminal_says_it_in_a_line_a_class(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deliver(tmp_path)
    run(["audit", str(tmp_path), "--out", str(tmp_path / "out"), "--lang", "en"])
    shown = capsys.readouterr().out
    (line,) = (line for line in shown.splitlines() if line.strip().startswith("janela / N  "))
    assert "required 6, found 4–5, missing 1–2, surplus 0" in line


@pytest.mark.parametrize("language", LANGUAGES)
def test_an_open_rate_is_shown_from_least_to_most(done: tuple[Written, Path], language: str) -> None:
    """Of seven features six are windows: one or two of them are missing; of the doors one is too many either way."""
    words = Words(language)
    shown = {one.id: one.value for one in element_views(words, done[0].record)}
    assert shown["Q5"] == f"{words.quantity(1 / 7, '1')}–{words.quantity(2 / 7, '1')}"
    assert shown["Q4"] == words.quantity(1 / 7, "1")


def test_measures_are_named_in_the_language_of_the_page(done: tuple[Written, Path]) -> None:
    named = {one.id: one.measure for one in element_views(Words("pt-BR"), done[0].record)}
    assert named["Q5"] == "taxa de itens faltantes (7)"
    assert named["Q4"] == "taxa de itens excedentes (3)"
