# SPDX-License-Identifier: MIT
"""The folder of reports: one entry makes a format, and a report that crashes costs no other."""

import json
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from foparq.cli.common import format_option
from foparq.cli.main import run
from foparq.errors import WriteError
from foparq.evaluate.quality import Verdict
from foparq.report import files
from foparq.report.files import LOG, write_reports
from foparq.report.formats import FORMATS, SHOWN, WRITTEN, Format
from foparq.report.record import AuditRecord
from foparq.report.words import Words

ROOT = Path(__file__).resolve().parents[2]
EVERY_FILE = pytest.mark.parametrize("form", WRITTEN, ids=lambda form: form.file)
Plant = Callable[[Format], None]


@pytest.fixture
def crash(monkeypatch: pytest.MonkeyPatch) -> Plant:
    """Plant a fault of ours into one format, halfway through its file."""

    def plant(form: Format) -> None:
        def lines(_record: AuditRecord) -> object:
            yield "half"
            raise ZeroDivisionError("planted \x1b[31m")

        def writer(_record: AuditRecord, path: Path) -> None:
            path.write_text("half")
            raise ZeroDivisionError("planted \x1b[31m")

        module, _, function = (form.lines or form.writer).partition(":")
        monkeypatch.setattr(f"foparq.report.{module}.{function}", lines if form.lines else writer)

    return plant


# --- the registry ----------------------------------------------------------------------------------------------------


def test_names_and_files_are_told_apart() -> None:
    names, written = [form.name for form in FORMATS], [form.file for form in WRITTEN]
    assert len(set(names)) == len(names)
    assert len(set(written)) == len(written)


@pytest.mark.parametrize("form", FORMATS, ids=lambda form: form.name)
def test_every_format_is_made_in_one_way(form: Format) -> None:
    assert sum((form.terminal, bool(form.lines), bool(form.writer))) == 1
    assert form.file or form.shown
    if not form.terminal:
        module, _, function = (form.lines or form.writer).partition(":")
        assert callable(getattr(import_module(f"foparq.report.{module}"), function))


def test_the_command_offers_what_can_be_shown() -> None:
    assert tuple(format_option(Words("en")).type.choices) == SHOWN  # type: ignore[attr-defined]
    assert {"text", "concise", "json", "jsonl", "csv"} <= set(SHOWN)


@pytest.mark.parametrize("page", ["README.md", "README.pt-BR.md"])
def test_the_readme_names_every_file(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    assert [form.file for form in WRITTEN if f"`{form.file}`" not in text] == []


def test_a_new_format_is_one_entry(rejected: AuditRecord, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("foparq.report.audit_json.poem", lambda record: iter([record.product_class]), raising=False)
    monkeypatch.setattr(files, "WRITTEN", (Format(name="poem", file="poem.txt", lines="audit_json:poem"), *WRITTEN))
    done = write_reports(rejected, (), tmp_path)
    assert (tmp_path / "poem.txt").read_text(encoding="utf-8") == "A\n"
    assert {path.name for path in done.paths} == {"poem.txt", *(form.file for form in WRITTEN)}


# --- the net ---------------------------------------------------------------------------------------------------------


@EVERY_FILE
def test_a_report_that_crashes_costs_no_other(
    accepted: AuditRecord, form: Format, crash: Plant, tmp_path: Path
) -> None:
    write_reports(accepted, (), tmp_path)
    crash(form)
    done = write_reports(accepted, (), tmp_path)
    left = {other.file for other in WRITTEN} - {form.file}
    assert {path.name for path in tmp_path.iterdir()} == left | {LOG}, "no half report, and none of an earlier run"
    assert done.record.crashed == (form.file,)
    assert len(done.log) == 1
    log = (tmp_path / LOG).read_text(encoding="utf-8")
    assert log.startswith("Traceback")
    assert "ZeroDivisionError: planted \\u001b[31m" in log
    if form.file != "audit.json":
        told = json.loads((tmp_path / "audit.json").read_text(encoding="utf-8"))
        assert told["crashed"] == [form.file]
        assert told["verdict"] == "undecided"
        assert [reason["id"] for reason in told["why"]] == ["verdict.crashed-reports"]
        assert form.file in told["why"][0]["text"]
    if form.file != "report.html":
        page = (tmp_path / "report.html").read_text(encoding="utf-8")
        assert "The delivery is accepted." not in page, "written before the crash or after, all tell the same"
        assert form.file in page


def test_several_that_crash_are_all_told(accepted: AuditRecord, crash: Plant, tmp_path: Path) -> None:
    others = [form for form in WRITTEN if form.file != "audit.json"]
    for form in others:
        crash(form)
    done = write_reports(accepted, ["an earlier one"], tmp_path)
    names = [form.file for form in others]
    assert json.loads((tmp_path / "audit.json").read_text(encoding="utf-8"))["crashed"] == names
    assert list(done.record.crashed) == names
    assert done.log[0] == "an earlier one"
    assert len(done.log) == len(WRITTEN)


@pytest.mark.parametrize("verdict", [Verdict.REJECTED, Verdict.UNDECIDED])
def test_what_was_not_accepted_stays_so(rejected: AuditRecord, verdict: Verdict, crash: Plant, tmp_path: Path) -> None:
    crash(WRITTEN[1])
    before = replace(rejected.quality, verdict=verdict)
    after = write_reports(replace(rejected, quality=before), (), tmp_path).record.quality
    assert after.verdict is verdict
    told = after.remarks if verdict is Verdict.REJECTED else after.why
    assert told[-1].message == "verdict.crashed-reports"
    assert after.why[:1] == before.why[:1]


def test_the_log_of_an_earlier_run_goes(accepted: AuditRecord, tmp_path: Path) -> None:
    write_reports(accepted, ["a trace"], tmp_path)
    assert (tmp_path / LOG).is_file()
    done = write_reports(accepted, (), tmp_path)
    assert not (tmp_path / LOG).exists()
    assert done.record is accepted


@EVERY_FILE
def test_a_file_that_cannot_be_written_is_no_crash(
    accepted: AuditRecord, form: Format, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_reports(accepted, (), tmp_path)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def full(*_anything: object) -> object:
        raise OSError(28, "No space left on device")

    module, _, function = (form.lines or form.writer).partition(":")
    monkeypatch.setattr(f"foparq.report.{module}.{function}", full)
    with pytest.raises(WriteError):
        write_reports(accepted, (), tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_the_exit_code_tells_of_it(crash: Plant, tmp_path: Path) -> None:
    delivery = ROOT / "fixtures" / "deliveries" / "station-a"
    asked = ["audit", str(delivery), "--out", str(tmp_path), "--format", "concise"]
    assert run(asked) == 0
    crash(next(form for form in WRITTEN if form.file == "report.html"))
    assert run(asked) == 3
    assert json.loads((tmp_path / "audit.json").read_text(encoding="utf-8"))["crashed"] == ["report.html"]


def test_the_exit_code_of_loose_files_tells_of_it_too(crash: Plant, tmp_path: Path) -> None:
    drawing = tmp_path / "a.geojson"
    lines = [[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 0]]]
    features = [
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": line}} for line in lines
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::31982"}}
    drawing.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    asked = ["check", str(drawing), "--scale", "1:50", "--unit", "m", "--out", str(tmp_path / "out")]
    assert run(asked) == 0
    crash(next(form for form in WRITTEN if form.file == "findings.gpkg"))
    assert run(asked) == 3
