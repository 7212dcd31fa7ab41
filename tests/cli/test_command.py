# SPDX-License-Identifier: MIT
"""The command as the three users meet it: words, exit codes, formats, files."""

import csv
import errno
import io
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import ezdxf
import jsonschema
import openpyxl
import pytest
from tests.cli.conftest import Command

from foparq.cli.main import COMMANDS
from foparq.profile.load import load_manifest
from foparq.report.formats import WRITTEN
from foparq.resources import shipped

FIXTURES = Path(__file__).resolve().parents[2] / "fixtures"
FILES = {form.file for form in WRITTEN}


def write_dxf(path: Path, *lines: tuple[tuple[float, float], tuple[float, float]], unit: int = 6) -> Path:
    document = ezdxf.new("R2010", units=unit)
    for start, end in lines:
        document.modelspace().add_line(start, end)
    document.saveas(path)
    return path


CLEAN = (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 0)))
FAULTY = (*CLEAN, ((0.5, 0.004), (0.5, 0.496)))


def write_delivery(folder: Path, manifest: str, *lines: tuple[tuple[float, float], tuple[float, float]]) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    write_dxf(folder / "fachada.dxf", *lines)
    (folder / "delivery.toml").write_text(manifest, encoding="utf-8")
    return folder


MANIFEST = '[delivery]\nscale = "1:50"\ntitle = "Casa"\n\n[[drawing]]\npath = "fachada.dxf"\nunit = "m"\n'


# --- words -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize(("language", "word"), [("en", "Usage:"), ("pt-BR", "Uso:")])
def test_every_command_has_help_in_both_languages(foparq: Command, name: str, language: str, word: str) -> None:
    code, out, _ = foparq(name, "--help", "--lang", language)
    assert code == 0
    assert word in out
    assert "--lang" in out


def test_the_locale_chooses_the_language(foparq: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LC_ALL", "pt_BR.UTF-8")
    assert "Uso:" in foparq("--help")[1]
    assert "Usage:" in foparq("--lang", "en", "--help")[1]


def test_a_wrong_word_is_told_with_the_nearest(foparq: Command) -> None:
    code, _, err = foparq("explain", "undershot")
    assert code == 2
    assert "undershoot" in err


@pytest.mark.parametrize(
    "arguments",
    [("--nothing",), ("check",), ("audit",), ("frobnicate",), ("audit", "a", "b"), ("--lang", "de", "rules")],
)
def test_wrong_usage_is_exit_2(foparq: Command, arguments: tuple[str, ...]) -> None:
    code, out, err = foparq(*arguments)
    assert (code, out) == (2, "")
    assert err
    assert "Traceback" not in err


def test_rules_and_explain(foparq: Command) -> None:
    code, out, _ = foparq("rules")
    assert code == 0
    assert "TOP011  undershoot" in out
    listed = json.loads(foparq("rules", "--format", "json")[1])
    assert {"code", "name", "title", "tolerances"} <= set(listed[0])
    for rule in listed:
        for language in ("en", "pt-BR"):
            code, out, _ = foparq("explain", rule["code"], "--lang", language)
            assert code == 0
            assert rule["name"] in out


def test_doctor_finds_everything_working(foparq: Command) -> None:
    code, out, _ = foparq("doctor", "--format", "json")
    assert code == 0
    assert all(json.loads(out)["trials"].values())


# --- check -----------------------------------------------------------------------------------------------------------


def test_check_says_clean_faults_and_why(foparq: Command, tmp_path: Path) -> None:
    clean, faulty = write_dxf(tmp_path / "clean.dxf", *CLEAN), write_dxf(tmp_path / "faulty.dxf", *FAULTY)
    assert foparq("check", clean, "--scale", "1:50")[0] == 0
    code, out, _ = foparq("check", faulty, "--scale", "1:50")
    assert code == 1
    assert "undershoot" in out
    assert "4 mm" in out


def test_check_needs_the_scale_of_the_profile(foparq: Command, tmp_path: Path) -> None:
    code, _, err = foparq("check", write_dxf(tmp_path / "a.dxf", *CLEAN))
    assert code == 2
    assert "--scale 1:50" in err


def test_check_with_an_unknown_unit_is_not_decided(foparq: Command, tmp_path: Path) -> None:
    silent = write_dxf(tmp_path / "a.dxf", *FAULTY, unit=0)
    assert foparq("check", silent, "--scale", "1:50")[0] == 3
    assert foparq("check", silent, "--scale", "1:50", "--unit", "m")[0] == 1
    assert foparq("check", silent, "--scale", "1:50", "--unit", "stone")[0] == 2


def test_a_drawing_that_holds_nothing_is_not_clean(foparq: Command, tmp_path: Path) -> None:
    code, out, _ = foparq("check", write_dxf(tmp_path / "a.dxf"), "--scale", "1:50")
    assert code == 3, "no evidence is never a pass"
    assert "not everything could be checked" in out


def test_check_refuses_what_it_cannot_read(foparq: Command, tmp_path: Path) -> None:
    (tmp_path / "a.dxf").write_bytes(b"not a drawing")
    code, out, err = foparq("check", tmp_path / "a.dxf", "--scale", "1:50")
    assert code == 4
    assert "a.dxf" in out + err
    assert foparq("check", tmp_path / "nowhere.dxf", "--scale", "1:50")[0] == 2, "the request is wrong, not a file"


def test_rules_can_be_chosen_and_tolerances_set(foparq: Command, tmp_path: Path) -> None:
    faulty = write_dxf(tmp_path / "a.dxf", *FAULTY)
    assert foparq("check", faulty, "--scale", "1:50", "--ignore", "undershoot")[0] == 0
    assert foparq("check", faulty, "--scale", "1:50", "--select", "GEO,FIL001")[0] == 0
    assert foparq("check", faulty, "--scale", "1:50", "--set", "undershoot.reach=2mm")[0] == 0
    assert foparq("check", faulty, "--scale", "1:50", "--set", "undershoot.reach=3")[0] == 2


def test_formats_agree(foparq: Command, tmp_path: Path) -> None:
    faulty = write_dxf(tmp_path / "a.dxf", *FAULTY)
    total = json.loads(foparq("check", faulty, "--scale", "1:50", "--format", "json")[1])["findings"]["total"]
    lines = [
        json.loads(line) for line in foparq("check", faulty, "--scale", "1:50", "--format", "jsonl")[1].splitlines()
    ]
    table = list(csv.DictReader(io.StringIO(foparq("check", faulty, "--scale", "1:50", "--format", "csv")[1])))
    concise = foparq("check", faulty, "--scale", "1:50", "--format", "concise")[1].splitlines()
    assert total == len(lines) == len(table) == len(concise) - 1
    assert [row["key"] for row in table] == [line["key"] for line in lines]
    short = next(line for line in lines if line["name"] == "undershoot")
    assert short["where"] == pytest.approx([0.5, 0.004, 0])
    assert short["size"] == pytest.approx(0.004)


def test_the_json_follows_the_shipped_schema(foparq: Command, tmp_path: Path) -> None:
    schema = json.loads((shipped("templates") / "schema" / "foparq-audit-1.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    faulty = write_dxf(tmp_path / "a.dxf", *FAULTY)
    (tmp_path / "b.dxf").write_bytes(b"?")
    run_json = json.loads(foparq("check", faulty, tmp_path / "b.dxf", "--scale", "1:50", "--format", "json")[1])
    jsonschema.validate(run_json, schema)
    assert run_json["verdict"] is None, "loose files are no delivery: there is nothing to accept"
    folder = write_delivery(tmp_path / "d", MANIFEST, *FAULTY)
    run_json = json.loads(foparq("audit", folder, "--format", "json")[1])
    jsonschema.validate(run_json, schema)
    assert run_json["verdict"] == "rejected", "one of four lines is at fault"


def write_geojson(path: Path, layer: str) -> Path:
    line = {"type": "LineString", "coordinates": [[0, 0], [1, 0]]}
    feature = {"type": "Feature", "properties": {"layer": layer}, "geometry": line}
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::31982"}}
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": [feature]}))
    return path


def test_a_formula_in_a_layer_name_stays_text_in_a_spreadsheet(foparq: Command, tmp_path: Path) -> None:
    path = write_geojson(tmp_path / "a.geojson", "=cmd|x")
    table = foparq("check", path, "--scale", "1:50", "--unit", "m", "--format", "csv")[1]
    assert {row["layer"] for row in csv.DictReader(io.StringIO(table))} == {"'=cmd|x"}


@pytest.mark.parametrize("form", ["text", "concise"])
def test_terminal_escapes_of_a_drawing_are_shown_and_not_obeyed(foparq: Command, tmp_path: Path, form: str) -> None:
    path = write_geojson(tmp_path / "a.geojson", "\x1b[31mred\u202e")
    out = foparq("check", path, "--scale", "1:50", "--unit", "m", "--format", form)[1]
    assert "red" in out or form == "text"
    assert "\x1b[31m" not in out
    assert "\u202e" not in out


@pytest.mark.parametrize(
    "arguments",
    [
        ("--select", "TOP", "--ignore", "TOP"),
        ("--set", "undershoot.reach=-5mm"),
        ("--set", "undershoot.reach=0.1mm"),
        ("--set", "undershoot.reach=1e400mm"),
        ("--unit", "1e-300 m"),
    ],
)
def test_senseless_requests_are_refused(foparq: Command, tmp_path: Path, arguments: tuple[str, str]) -> None:
    code, out, err = foparq("check", write_dxf(tmp_path / "a.dxf", *FAULTY), "--scale", "1:50", *arguments)
    assert (code, out) == (2, "")
    assert "failed" not in err


def test_a_rule_that_had_nothing_to_look_at_is_no_clean_drawing(foparq: Command, tmp_path: Path) -> None:
    assert foparq("check", write_dxf(tmp_path / "a.dxf", *CLEAN), "--scale", "1:50", "--select", "gap")[0] == 3


# --- audit -----------------------------------------------------------------------------------------------------------


def test_what_is_not_there_is_not_assessed_and_never_accepted(foparq: Command, tmp_path: Path) -> None:
    code, out, _ = foparq("audit", write_delivery(tmp_path / "d", MANIFEST, *CLEAN))
    assert code == 3
    assert out.startswith("INCONCLUSIVE")


def test_an_audit_writes_all_its_files_and_nothing_else(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    before = {path: path.read_bytes() for path in folder.iterdir()}
    foparq("audit", folder)
    assert {path.name for path in (folder / "audit").iterdir()} == FILES
    assert {path: path.read_bytes() for path in before} == before, "the delivered bytes stay as they are"


def test_out_puts_the_reports_elsewhere(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    foparq("audit", folder, "--out", tmp_path / "elsewhere" / "deep")
    assert not (folder / "audit").exists()
    assert {path.name for path in (tmp_path / "elsewhere" / "deep").iterdir()} == FILES


@pytest.mark.parametrize(
    ("stated", "asked", "spoken"), [("pt-BR", None, "pt-BR"), ("pt-BR", "en", "en"), (None, None, "en")]
)
def test_reports_speak_as_asked_else_as_the_manifest_says(
    foparq: Command, tmp_path: Path, stated: str | None, asked: str | None, spoken: str
) -> None:
    manifest = MANIFEST.replace('title = "Casa"', f'title = "Casa"\nlanguage = "{stated}"') if stated else MANIFEST
    folder = write_delivery(tmp_path / "d", manifest, *FAULTY)
    foparq("audit", folder, *(["--lang", asked] if asked else []))
    written = json.loads((folder / "audit" / "audit.json").read_text(encoding="utf-8"))
    assert written["language"] == spoken


def test_a_full_disk_leaves_no_half_report(foparq: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    foparq("audit", folder)
    before = {path.name: path.read_bytes() for path in (folder / "audit").iterdir()}

    def full(_record: object, path: Path) -> None:
        path.write_text("half")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("foparq.report.page.page.write_page", full)
    code, _, err = foparq("audit", folder)
    assert code == 2
    assert "No space left" in err
    assert {path.name: path.read_bytes() for path in (folder / "audit").iterdir()} == before


def test_a_folder_that_cannot_be_written_is_told_before_the_work(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    (folder / "audit").write_text("a file where the folder should be")
    code, _, err = foparq("audit", folder)
    assert code == 2
    assert "--out" in err


def test_a_drawing_named_twice_is_told(foparq: Command, tmp_path: Path) -> None:
    again = '\n[[drawing]]\npath = "./fachada.dxf"\nunit = "m"\n'
    code, _, err = foparq("audit", write_delivery(tmp_path / "d", MANIFEST + again, *CLEAN))
    assert code == 2
    assert "more than once" in err


def test_a_facade_in_space_taken_for_a_plan_is_not_judged(foparq: Command, tmp_path: Path) -> None:
    document = ezdxf.new("R2010", units=6)
    for start, end in CLEAN:
        document.modelspace().add_line((start[0], 5, start[1]), (end[0], 5, end[1]))
    document.saveas(tmp_path / "a.dxf")
    assert foparq("check", tmp_path / "a.dxf", "--scale", "1:50")[0] == 3
    assert foparq("check", tmp_path / "a.dxf", "--scale", "1:50", "--plane", "xz")[0] == 0


def test_a_delivery_may_not_disguise_its_own_specification(foparq: Command, tmp_path: Path) -> None:
    manifest = MANIFEST.replace("[delivery]", '[delivery]\nprofile = "mine.toml"')
    folder = write_delivery(tmp_path / "d", manifest, *CLEAN)
    (folder / "mine.toml").write_text('extends = "et-doc-foparq-a"\n', encoding="utf-8")
    code, _, err = foparq("audit", folder)
    assert code == 2
    assert "mine.toml" in err
    (folder / "mine.toml").write_text('extends = "et-doc-foparq-a"\nname = "mine"\nscale = "1:10"\n', encoding="utf-8")
    code, _, err = foparq("audit", folder)
    assert code == 2, "two scales"
    assert "1:10" in err


@pytest.mark.parametrize("name", ["a b\nc", "lat\udce9"])
def test_folders_with_awkward_names(foparq: Command, tmp_path: Path, name: str) -> None:
    folder = write_delivery(tmp_path / name, MANIFEST, *CLEAN)
    assert foparq("audit", folder)[0] == 3
    assert {path.name for path in (folder / "audit").iterdir()} == FILES


def test_a_folder_where_a_report_should_be_is_told_before_any_is_replaced(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    (folder / "audit" / "findings.gpkg").mkdir(parents=True)
    assert foparq("audit", folder)[0] == 2
    assert [path.name for path in (folder / "audit").iterdir()] == ["findings.gpkg"]


@pytest.mark.parametrize("place", ["nowhere", "empty"])
def test_without_a_manifest_the_way_to_one_is_told(foparq: Command, tmp_path: Path, place: str) -> None:
    (tmp_path / "empty").mkdir()
    code, _, err = foparq("audit", tmp_path / place)
    assert code == 2
    assert "foparq" in err


def test_a_manifest_without_a_scale_is_told(foparq: Command, tmp_path: Path) -> None:
    code, _, err = foparq("audit", write_delivery(tmp_path / "d", MANIFEST.replace('scale = "1:50"', ""), *CLEAN))
    assert code == 2
    assert 'scale = "1:50"' in err


def test_a_missing_file_is_the_delivery_s_fault(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST.replace("fachada.dxf", "gone.dxf"), *CLEAN)
    code, out, _ = foparq("audit", folder)
    assert code == 4
    assert "gone.dxf" in out


def test_the_same_delivery_gives_the_same_report(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *FAULTY)
    runs = []
    for name in ("one", "two"):
        foparq("audit", folder, "--out", tmp_path / name)
        run_json = json.loads((tmp_path / name / "audit.json").read_text(encoding="utf-8"))
        run_json.pop("started")
        for check in run_json["checks"]:
            check.pop("seconds")
        runs.append((run_json, (tmp_path / name / "findings.jsonl").read_bytes()))
    assert runs[0] == runs[1]


# --- init ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_init_proposes_and_guesses_nothing(foparq: Command, tmp_path: Path, language: str) -> None:
    folder = tmp_path / 'Estação "velha"'
    folder.mkdir()
    write_dxf(folder / "fachada.dxf", *CLEAN)
    (folder / "pontos.csv").write_text("id;x;y;z;xd;yd;zd\nP1;1,0;2,0;3,0;1,0;2,0;3,0\n", encoding="utf-8")
    (folder / "notas.txt").write_text("nothing to read", encoding="utf-8")
    assert foparq("init", folder, "--lang", language)[0] == 0
    text = (folder / "delivery.toml").read_text(encoding="utf-8")
    manifest = load_manifest(folder / "delivery.toml")
    assert manifest.delivery.title == 'Estação "velha"'
    assert manifest.delivery.scale is None
    assert [section.path for section in manifest.drawing] == ["fachada.dxf"]
    assert manifest.drawing[0].unit is None
    assert manifest.checkpoints is not None
    assert manifest.checkpoints.survey_sd is None
    assert "notas.txt" in text
    assert foparq("audit", folder)[0] == 2, "the scale is for a person to state"
    (folder / "delivery.toml").write_text(text.replace('# scale = "1:50"', 'scale = "1:50"'), encoding="utf-8")
    assert foparq("audit", folder)[0] == 3


def test_init_finds_the_tables_of_a_workbook(foparq: Command, tmp_path: Path) -> None:
    write_dxf(tmp_path / "fachada.dxf", *CLEAN)
    book = openpyxl.Workbook()
    sheets = {
        "Feições": [["id", "classe"], ["A", "janela"]],
        "Notas": [["nada"]],
        "Pontos": [["id", "x", "y", "z"], ["P1", 1.5, 2.5, 3.5]],
        "Medidas": [["id", "medida"], ["D1", 1.5]],
    }
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(row)
    book.save(tmp_path / "levantamento.xlsx")
    assert foparq("init", tmp_path)[0] == 0
    manifest = load_manifest(tmp_path / "delivery.toml")
    named = [manifest.features, manifest.checkpoints, manifest.distances]
    assert [section and section.path for section in named] == ["levantamento.xlsx"] * 3
    assert [section and section.sheet for section in named] == [None, "Pontos", "Medidas"]


def test_init_proposes_one_of_two_formats_of_the_same_drawing(foparq: Command, tmp_path: Path) -> None:
    shutil.copytree(
        FIXTURES / "deliveries" / "station-a", tmp_path / "d", ignore=shutil.ignore_patterns("*.toml", "audit")
    )
    assert foparq("init", tmp_path / "d")[0] == 0
    manifest = load_manifest(tmp_path / "d" / "delivery.toml")
    assert [section.path for section in manifest.drawing] == ["fachada.dxf"]


def test_init_never_replaces_a_manifest_unasked(foparq: Command, tmp_path: Path) -> None:
    folder = write_delivery(tmp_path / "d", MANIFEST, *CLEAN)
    assert foparq("init", folder)[0] == 2
    assert (folder / "delivery.toml").read_text(encoding="utf-8") == MANIFEST
    assert foparq("init", folder, "--force")[0] == 0


def test_init_of_an_empty_folder_or_none(foparq: Command, tmp_path: Path) -> None:
    assert foparq("init", tmp_path)[0] == 2
    assert foparq("init", tmp_path / "nowhere")[0] == 2


# --- as a process ----------------------------------------------------------------------------------------------------


def test_as_a_process_without_a_terminal(tmp_path: Path) -> None:
    faulty = write_dxf(tmp_path / "a.dxf", *FAULTY)
    command = [sys.executable, "-m", "foparq", "check", str(faulty), "--scale", "1:50", "--lang", "pt-BR"]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env=environment, stdin=subprocess.DEVNULL
    )
    assert done.returncode == 1
    assert done.stderr == "", "nothing but results where nobody watches"
    assert "\x1b" not in done.stdout


def test_help_loads_no_geometry_engine() -> None:
    heavy = "{'numpy', 'shapely', 'ezdxf', 'pydantic'}"
    code = f"import sys; from foparq.cli.main import run; run(['rules']); sys.exit(bool({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(("redirect", "code"), [("2>&-", 1), (">/dev/full", 2), (">&-", 1)])
def test_streams_that_are_closed_or_full(tmp_path: Path, redirect: str, code: int) -> None:
    faulty = write_dxf(tmp_path / "a.dxf", *FAULTY)
    command = f'"{sys.executable}" -m foparq check "{faulty}" --scale 1:50 {redirect}'
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.returncode == code
    assert "Traceback" not in done.stderr


def test_what_a_silent_rule_sets_aside_is_not_no_fault(foparq: Command, tmp_path: Path) -> None:
    path = write_dxf(tmp_path / "a.dxf", *CLEAN)
    document = ezdxf.readfile(path)
    document.modelspace().add_line((math.nan, 0), (1, 1))
    document.saveas(path, fmt="bin")  # in a text, what is no number would be left out by the reader
    assert foparq("check", path, "--scale", "1:50")[0] == 1
    assert foparq("check", path, "--scale", "1:50", "--ignore", "invalid-geometry")[0] == 3
