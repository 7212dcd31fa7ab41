# SPDX-License-Identifier: MIT
"""What stands on the terminal: its language, its width, each reason once, errors for people and for programs."""

import json
import re
from pathlib import Path

import ezdxf
import pytest
from tests.cli.conftest import Command

from foparq.check.catalogue import cards
from foparq.cli.main import COMMANDS
from foparq.profile.find import shipped_profiles
from foparq.report.formats import SHOWN

MANIFEST = '[delivery]\nscale = "1:50"\ntitle = "Casa"\nlanguage = "pt-BR"\n\n[[drawing]]\npath = "a.dxf"\nunit = "m"\n'


def deliver(folder: Path, manifest: str = MANIFEST) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    document = ezdxf.new("R2010", units=6)
    for start, end in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 0)), ((0.5, 0.004), (0.5, 0.496))):
        document.modelspace().add_line(start, end)
    document.saveas(folder / "a.dxf")
    (folder / "delivery.toml").write_text(manifest, encoding="utf-8")
    return folder


def test_the_terminal_speaks_as_the_manifest_unless_asked(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d")
    assert foparq("audit", folder)[1].startswith("NÃO CONFORME")
    assert foparq("audit", folder, "--lang", "en")[1].startswith("DOES NOT CONFORM")
    silent = deliver(tmp_path / "e", MANIFEST.replace('language = "pt-BR"\n', ""))
    assert foparq("audit", silent)[1].startswith("DOES NOT CONFORM")
    assert foparq("--lang", "pt", "audit", silent)[1].startswith("NÃO CONFORME")


def test_what_is_wrong_in_a_manifest_is_told_in_its_language(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", MANIFEST.replace("1:50", "um para cinquenta"))
    assert foparq("audit", folder)[2].startswith("Erro: ")
    assert foparq("audit", folder, "--lang=en")[2].startswith("Error: ")
    (folder / "delivery.toml").write_text("[delivery\n", encoding="utf-8")
    assert foparq("audit", folder)[2].startswith("Error: ")


@pytest.mark.parametrize("tag", ["pt", "PT-br", "pt_BR"])
def test_the_language_of_a_manifest_may_be_spelt_shorter(foparq: Command, tmp_path: Path, tag: str) -> None:
    folder = deliver(tmp_path / "d", MANIFEST.replace('"pt-BR"', f'"{tag}"'))
    assert foparq("audit", folder)[1].startswith("NÃO CONFORME")
    deliver(folder, (folder / "delivery.toml").read_text(encoding="utf-8") + "[contract]\ndate = 20/11/2026\n")
    assert foparq("audit", folder)[2].startswith("Erro: "), "what is not TOML states its language all the same"
    deliver(folder, MANIFEST.replace('"pt-BR"', '"de"'))
    assert foparq("audit", folder)[0] == 2


@pytest.mark.parametrize("columns", [20, 60, 80, 100])
@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_lines_are_as_wide_as_the_terminal(
    foparq: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, columns: int, language: str
) -> None:
    folder = deliver(tmp_path / "d")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", str(columns))
    out = foparq("audit", "d", "--lang", language)[1]
    table = [line for line in out.splitlines() if re.match(r"(Q\d|NBR)", line)]
    long = [
        line
        for line in out.splitlines()
        if len(line) > max(columns, 40) and "handent" not in line and line not in table
    ]
    assert not long
    assert folder.exists()
    assert all(len(line) <= max(columns, 71) + 14 for line in table), "only the word of a state may stand out"


def test_no_sentence_stands_twice(foparq: Command, tmp_path: Path) -> None:
    for manifest in (MANIFEST, MANIFEST.replace('unit = "m"', 'unit = "mm"'), MANIFEST.replace("a.dxf", "b.dxf")):
        out = foparq("audit", deliver(tmp_path / str(len(manifest)), manifest), "--lang", "en")[1]
        sentences = [part.strip(" -") for part in out.splitlines() if ":" in part and part.strip().endswith(".")]
        assert sentences
        assert len(sentences) == len(set(sentences)), sorted(sentences)


def test_a_sentence_in_a_pipe_is_one_line(foparq: Command, tmp_path: Path) -> None:
    out = foparq("check", deliver(tmp_path / "d") / "a.dxf", "--scale", "1:50")[1]
    line = next(line for line in out.splitlines() if line.startswith("  0.5,0.004,0  "))
    assert line.endswith("(0; limit 0.5 mm).")
    assert '(command "_.ZOOM" "_O" (handent "' in out
    assert '"EntityHandle"' in out


@pytest.mark.parametrize(
    ("arguments", "near"),
    [
        (("chek",), "check"), (("aduit", "x"), "audit"), (("explain", "undershot"), "undershoot"),
        (("check", "{d}", "--format", "jsn"), "json"), (("check", "{d}", "--scale", "1:50", "--plane", "xzz"), "xz"),
        (("check", "{d}", "--scale", "1:50", "--set", "undershot.reach=1mm"), "undershoot.reach"),
        (("check", "{d}", "--scale", "1:50", "--profile", "et-doc-foparq-bb"), "et-doc-foparq-b"),
        (("--lang", "pt-BT", "chek"), "check"), (("check", "--ouput", "x"), "--out"),
    ],
)  # fmt: skip
def test_the_nearest_name_stands_first(foparq: Command, tmp_path: Path, arguments: tuple[str, ...], near: str) -> None:
    drawing = deliver(tmp_path / "d") / "a.dxf"
    code, out, err = foparq(*(str(drawing) if part == "{d}" else part for part in arguments))
    assert (code, out) == (2, "")
    told = re.findall(r"[\w.-]+", err.partition("Err")[2].partition(":")[2].replace(str(drawing), ""))
    known = {*COMMANDS, *SHOWN, "xy", "xz", "yz", "fit", "--out"}
    known |= {*shipped_profiles(), *(card.name for card in cards())}
    known |= {word for word in told if re.fullmatch(r"[a-z-]+\.[a-z]+", word)} - {"undershot.reach"}
    assert next(word for word in told if word in known) == near


def test_an_error_is_json_where_json_was_asked_for(foparq: Command, tmp_path: Path) -> None:
    folder = deliver(tmp_path / "d", MANIFEST.replace("scale", "escala"))
    asks = (
        (("audit", folder, "--format", "json"), "toml.unknown-key"),
        (("audit", tmp_path / "nowhere", "--format=json"), "manifest.missing"),
        (("check", folder / "a.dxf", "--format", "json"), "usage.scale"),
        (("check", "--format", "json"), "usage"),
        (("check", folder / "a.dxf", "--scale", "1:50", "--frmat", "x", "--format", "json"), "usage"),
    )
    for arguments, name in asks:
        code, out, err = foparq(*arguments)
        told = json.loads(out)
        assert (code, told["exit"], told["error"]["id"]) == (2, 2, name)
        assert told["error"]["text"] in err
    fields = json.loads(foparq("audit", folder, "--format", "json")[1])["error"]["fields"]
    assert (fields["key"], fields["line"]) == ("escala", 2)
    assert foparq("audit", folder, "--format", "jsonl")[:2] == (2, "")


def deliver_glazing(folder: Path) -> Path:
    """A frame without a fault, whose bar stops 30 mm short of it: a millimetre on the sheet is 50 mm."""
    folder = deliver(folder)
    document = ezdxf.new("R2010", units=6)
    document.modelspace().add_lwpolyline([(0, 0), (3, 0), (3, 3), (0, 3)], close=True)
    document.modelspace().add_line((1, 0.03), (1, 3))
    document.saveas(folder / "a.dxf")
    return folder


@pytest.mark.parametrize(("language", "told"), [("en", "50 mm away: 1 (lines"), ("pt-BR", "50 mm: 1 (linhas")])
def test_what_heads_for_a_line_is_a_remark_though_consistency_passes(
    foparq: Command, tmp_path: Path, language: str, told: str
) -> None:
    code, out, _ = foparq("audit", deliver_glazing(tmp_path / "d"), "--lang", language)
    assert code == 3, "points, distances and features were not delivered"
    assert re.search(r"^Q3 .* (pass(es)?|conforms|atende)$", out, re.MULTILINE)
    remarks = out.partition("Q1-X  ")[0]
    assert told in remarks


def test_a_note_says_what_to_do(foparq: Command, tmp_path: Path) -> None:
    folder = deliver_glazing(tmp_path / "d")
    out = foparq("check", folder / "a.dxf", "--scale", "1:50")[1]
    notes = re.findall(r"^TOP\d+ ([\w-]+) \(note\)", out, re.MULTILINE)
    assert notes == ["free-end", "probable-undershoot"]
    assert len(re.findall(r"^  > ", out, re.MULTILINE)) == len(notes)
