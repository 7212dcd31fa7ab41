# SPDX-License-Identifier: MIT
"""``foparq explain`` prints a manual: no mark of source code, every tolerance with its meaning, in both languages."""

import json
import re
import tomllib
from collections.abc import Callable

import pytest

from foparq.check.catalogue import Card, cards
from foparq.cli.main import run
from foparq.report.manual import manual_of, plain
from foparq.report.words import Words
from foparq.resources import shipped

SHIPPED = tomllib.loads((shipped("rules") / "profiles" / "et-doc-foparq-a.toml").read_text(encoding="utf-8"))


@pytest.fixture
def explain(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    monkeypatch.delenv("COLUMNS", raising=False)

    def call(*arguments: str) -> str:
        assert run(["explain", *arguments]) == 0
        return capsys.readouterr().out

    return call


@pytest.mark.parametrize("language", ["en", "pt-BR"])
@pytest.mark.parametrize("card", cards(), ids=lambda card: card.code)
def test_a_manual_is_for_people(explain: Callable[..., str], card: Card, language: str) -> None:
    out = explain(card.code, "--lang", language)
    for mark in ("``", "**", "----", "; - ", "O(n", " : ", "Hits", "Parameters", "Returns", "Parâmetros", "Retorna"):
        assert mark not in out, mark
    lines = out.splitlines()
    for name, _ in card.tolerances:
        meant = next(line for line in lines if re.match(rf"([\w, ]*\b)?{name}\b[\w, ]*: ", line))
        assert len(meant.partition(": ")[2]) > 10
        checks = [{**SHIPPED["linework"], **check} for check in SHIPPED["check"] if check["rule"] == card.name]
        bound = next((check[name] for check in checks), None)
        assert bound is None or f'{name} = "{bound}"' in out
    told = json.loads(explain(card.code, "--lang", language, "--format", "json"))
    assert told["manual"].splitlines()[0] in lines
    assert told["mend"] in lines


def test_the_marks_go_and_the_words_stay() -> None:
    """A key is quoted: in a Portuguese sentence “reach” would else be a word that nobody knows."""
    assert plain("a *term*, a **word**, ``code``; 2 * 3 * 4 and a*b*c") == "a term, a word, “code”; 2 * 3 * 4 and a*b*c"


@pytest.mark.parametrize("language", ["en", "pt-BR"])
@pytest.mark.parametrize("card", cards(), ids=lambda card: card.code)
def test_no_word_of_a_manual_is_lost(card: Card, language: str) -> None:
    source = Words(language).find(f"rules.{card.code}.manual") or card.manual
    kept = " ".join(p for part in manual_of(Words(language), card) for p in part.paragraphs)
    parts = re.split(r"^(\S[^\n]*)\n-{3,}$", source, flags=re.MULTILINE)
    prose = re.sub(r"``|\*", "", parts[0])
    assert set(prose.split()) <= set(re.sub("[*“”]", "", kept).split())
    described = " ".join(line for part in parts[2::2] for line in part.split("\n") if line.startswith(" "))
    assert set(re.sub(r"``|\*", "", described).split()) <= set(re.sub("[*“”]", "", kept).split())


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_each_item_of_a_list_stands_on_a_line_of_its_own(explain: Callable[..., str], language: str) -> None:
    out = explain("undershoot", "--lang", language)
    items = [line for line in out.splitlines() if line.startswith("- ")]
    assert len(items) == 3
    assert not any("; -" in line for line in out.splitlines())
