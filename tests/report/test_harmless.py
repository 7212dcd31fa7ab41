# SPDX-License-Identifier: MIT
"""Names of a delivery in every format: nothing of them reaches a terminal, a spreadsheet or a page as a command."""

import csv
import io
import json
import re
import sqlite3
import unicodedata
import xml.etree.ElementTree as ET
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest

from foparq.cli.show import show
from foparq.evaluate.quality import because
from foparq.findings.outcome import SetAside
from foparq.model.delivery import SourceStatus
from foparq.model.drawing import Repair, Skipped, SkippedReason
from foparq.report.files import write_reports
from foparq.report.formats import FORMATS, WRITTEN, Format
from foparq.report.harmless import cell, log_text
from foparq.report.record import AuditRecord
from foparq.report.words import Words

HOSTILE = {
    "escape": "\x1b[31mred",
    "C1 introducer": "\x9b31mred",
    "bell and backspace": "a\x07\x08b",
    "delete": "a\x7fb",
    "next line": "a\x85b",
    "line separator": "a\u2028b",
    "paragraph separator": "a\u2029b",
    "line break": "a\n=1+1",
    "carriage return": "a\r=1+1",
    "right to left": "a\u202eb",
    "isolate": "a\u2067b\u2069",
    "mark": "a\u200fb\u061c",
    "tag letter": "a\U000e0041b",
    "formula": "=1+1",
    "plus": "+1+1",
    "minus": "-1+1|cmd",
    "at": "@SUM(1)",
    "tab before": "\t=1+1",
    "return before": "\r=1+1",
    "blanks before": "   =1+1",
    "no-break blank before": "\u00a0=1+1",
    "zero width before": "\u200b\ufeff=1+1",
    "control before": "\x01=1+1",
    "wide": "＝1+1",
    "second cell": "a;=1+1",
    "second cell, blank": "a; \u00a0@b",
    "quote and comma": 'a",=1+1,"',
    "markup": "</script><img src=x onerror=alert(1)>",
    "entity": "&lt;b&gt; <b>",
    "template": "{layer} {{ 7*7 }} %s",
}
NAMES = pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)


def named(record: AuditRecord, name: str) -> AuditRecord:
    """The same audit of a delivery in which everything bears the name."""
    n = len(record.findings)
    column = np.full(n, name, dtype=object)
    texts = dict.fromkeys(("source", "layer", "item", "handle", "inserts", "other", "other_layer"), column)
    reason = because("page.test-fail", element=name, value=name, limit=[name, (name,)])
    items = record.delivery.parts[0].items
    drawing = record.delivery.parts[0]
    drawing = replace(
        drawing,
        path=name,
        facade=name,
        items=replace(items, layer=np.full(len(items), name, dtype=object)),
        reading=replace(
            drawing.reading,
            layers=(name,),
            hidden_layers=(name,),
            crs=name,
            repairs=(Repair(code=name, detail=name, handle=name),),
        ),
    )
    skipped = (Skipped(reason=SkippedReason.UNSUPPORTED, kind=name, layer=name, count=1, handles=(name,)),)
    sources = tuple(
        replace(
            source,
            path=name,
            skipped=skipped,
            fields=(("file", name),) if source.status is SourceStatus.REFUSED else (),
        )
        for source in record.delivery.sources
    )
    element = replace(
        record.quality.elements[0],
        scope=name,
        why=(reason,),
        details=((name, 1.0, 2.0),),
        parameters=((name, 1.0, "m"),),
    )
    aside = (SetAside(item=name, layer=name, rule=""), SetAside(item=name, layer=name, rule="duplicate"))
    return replace(
        record,
        findings=replace(record.findings, **texts),
        delivery=replace(record.delivery, title=name, sources=sources, parts=(drawing,)),
        quality=replace(record.quality, why=(reason,), elements=(element,)),
        outcomes=tuple(replace(run, source=name, scope=f"{name}: {name}", aside=aside) for run in record.outcomes),
        profile=name,
        profile_title=name,
        norms=(name,),
        versions={"foparq": "0.1.0", "GDAL": "3.12"},
    )


def shown(record: AuditRecord, form: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> str:
    """What goes to a terminal that obeys; the command's own colours are off."""
    monkeypatch.setenv("NO_COLOR", "1")
    with click.Context(click.Command("test"), color=True).scope():
        show(record, form, Words("en"), ())
    said = capsys.readouterr()
    return said.out + said.err


def obeyed(text: str) -> set[str]:
    """Letters that a terminal or a line reader obeys, after the Unicode database."""
    return {c for c in text if unicodedata.category(c) in {"Cc", "Cf", "Cs", "Zl", "Zp"}} - {"\n"}


def texts_in(path: Path) -> str:
    """All text of a file; of a database that of all its tables."""
    if path.suffix != ".gpkg":
        return path.read_text(encoding="utf-8")
    with closing(sqlite3.connect(path)) as database:
        tables = [table for (table,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        rows = [row for table in tables for row in database.execute(f'SELECT * FROM "{table}"')]  # noqa: S608
    return "\n".join(value for row in rows for value in row if isinstance(value, str))


@NAMES
def test_no_file_holds_a_letter_that_is_obeyed(rejected: AuditRecord, name: str, tmp_path: Path) -> None:
    done = write_reports(named(rejected, name), [f"Traceback: {name}"], tmp_path)
    assert not done.record.crashed, done.log
    assert {path.name for path in done.paths} == {form.file for form in WRITTEN} | {"crash.log"}
    for path in done.paths:
        assert not obeyed(texts_in(path)), path.name


@NAMES
@pytest.mark.parametrize("form", [form for form in FORMATS if form.shown], ids=lambda form: form.name)
def test_no_output_holds_a_letter_that_is_obeyed(
    rejected: AuditRecord, name: str, form: Format, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = shown(named(rejected, name), form.name, capsys, monkeypatch)
    assert len(text) > 100
    assert not obeyed(text)


@NAMES
def test_json_keeps_the_very_name(
    rejected: AuditRecord, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    record = named(replace(rejected, delivery=replace(rejected.delivery, sources=())), name)
    rows = [json.loads(line) for line in shown(record, "jsonl", capsys, monkeypatch).split("\n") if line]
    assert len(rows) == len(record.findings)
    assert {row[column] for row in rows for column in ("source", "layer", "item", "handle", "inserts", "other")} == {
        name
    }
    assert json.loads(shown(record, "json", capsys, monkeypatch))["title"] == name


def cells(text: str) -> list[str]:
    """Cells as spreadsheets make them: some end a cell at a comma, some at a semicolon, some at both."""
    both = re.findall(r'"((?:[^"]|"")*)"|([^,;\n"]+)', text)
    return [
        *(value for row in csv.reader(io.StringIO(text)) for value in row),
        *(value for row in csv.reader(io.StringIO(text), delimiter=";") for value in row),
        *(quoted or bare for quoted, bare in both),
    ]


def is_formula(text: str) -> bool:
    """Whether a spreadsheet would compute the cell: blanks and what nobody sees do not protect."""
    seen = "".join(c for c in text if unicodedata.category(c)[0] not in "CZ")
    begins = unicodedata.normalize("NFKC", seen)[:1] in {"=", "+", "-", "@"}
    return begins and not re.fullmatch(r"-?\d+(\.\d+)?(e-?\d+)?", text)


def test_the_oracle_sees_formulas() -> None:
    for name in ("=1+1", "  =1", "\u200b@a", "＋1", "-1+1"):
        assert is_formula(name)
        assert any(is_formula(value) for value in cells(f"a,{name},b\n"))
    assert any(is_formula(value) for value in cells('x,"a;=1+1"\n'.replace('"', "")))
    assert not any(is_formula(value) for value in cells("name,-0.25,1e-9,'=1\n"))


@NAMES
def test_no_cell_is_a_formula(
    rejected: AuditRecord, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    record = named(replace(rejected, delivery=replace(rejected.delivery, sources=())), name)
    text = shown(record, "csv", capsys, monkeypatch)
    assert not [value for value in cells(text) if is_formula(value)]
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len(rows) == len(record.findings)
    for row in rows:
        assert row["layer"] == cell(name)
        assert row["layer"][0].isalpha() or row["layer"][0] in "'<&{\\"


def test_numbers_stay_numbers(
    rejected: AuditRecord, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    record = replace(rejected, findings=replace(rejected.findings, size=-rejected.findings.size))
    record = replace(record, delivery=replace(rejected.delivery, sources=()))
    rows = list(csv.DictReader(io.StringIO(shown(record, "csv", capsys, monkeypatch))))
    assert [float(row["size"]) for row in rows] == (-rejected.findings.size).tolist()
    assert {type(cell(value)) for value in (-1.5, -2, None, True)} == {float, int, type(None), bool}


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("PAREDE", "PAREDE"),
        ("", ""),
        ("a-b=c", "a-b=c"),
        ("=1", "'=1"),
        (" =1", "' =1"),
        ("\t=1", "'\\u0009=1"),
        ("\u00a0=1", "'\\u00a0=1"),
        ("a;=1", "a;'=1"),
        ("a;b", "a;b"),
        ("\x1b[0m", "\\u001b[0m"),
    ],
)
def test_cells(name: str, written: str) -> None:
    assert cell(name) == written


def test_names_that_are_no_utf_8_are_written_all_the_same(rejected: AuditRecord, tmp_path: Path) -> None:
    done = write_reports(named(rejected, "lat\udce9"), (), tmp_path)
    assert not done.record.crashed, done.log
    assert "lat\\udce9" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_a_traceback_keeps_its_lines() -> None:
    assert log_text(["one\n  two \x1b[0m", "three"]) == "one\n  two \\u001b[0m\nthree"


def test_a_map_tip_takes_names_as_text(rejected: AuditRecord, tmp_path: Path) -> None:
    write_reports(rejected, (), tmp_path)
    with closing(sqlite3.connect(tmp_path / "findings.gpkg")) as database:
        styles: list[tuple[Any, ...]] = database.execute("SELECT styleQML FROM layer_styles").fetchall()
    assert styles
    for (style,) in styles:
        tip = ET.fromstring(style).findtext("mapTip") or ""
        fields = re.findall(r"\[% (.*?) %\]", tip)
        assert fields
        for field in fields:
            value = r"""coalesce\(represent_value\("\w+"\), ''\)"""
            assert re.fullmatch(rf"replace\(replace\({value}, '&', '&amp;'\), '<', '&lt;'\)", field)
