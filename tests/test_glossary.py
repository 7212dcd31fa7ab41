# SPDX-License-Identifier: MIT
"""One word for each thing: the texts in Portuguese keep to docs/glossary.md, and each language to itself."""

import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from foparq.report.words import Words

ROOT = Path(__file__).resolve().parents[1]
_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')
#: words of the other language that give it away; each stands in hundreds of sentences
_ENGLISH = """
the and with without which that this from are was were not nothing than they its their every each finding findings layer
layers overlap overlaps gap gaps drawing feature features checked unknown
"""
_PORTUGUESE = """
não são uma que com sem dos das nas nos pela pelo para camada camadas desenho desenhos falha falhas apontamento
apontamentos parecer fachada lacuna especificação
"""
ENGLISH, PORTUGUESE = frozenset(_ENGLISH.split()), frozenset(_PORTUGUESE.split())
#: what is typed or quoted, not said: code, keys, names of rules, commands, place holders
_TYPED = re.compile(
    r"``[^`]*``|`[^`]*`|\{[^}]*\}|\"[^\"]*\"|“[^”]*”|\[\[?[\w.*-]+\]?\]|--[\w-]+|\b[A-Z]{3}\d{3}( [a-z-]+)?"
    r"|\b[a-z]+(-[a-z]+)+\b|\b\w+ = \S+|https?://\S+|\[[^\]]*\]\([^)]*\)|[\w.-]*[/\\.][\w./\\-]+"
)


def catalogue(language: str) -> Iterator[tuple[str, str]]:
    """Place and text of every message."""
    for path in sorted((ROOT / "reports" / "templates" / "locale" / language).rglob("*.po")):
        message, told = "", ""
        for line in [*path.read_text(encoding="utf-8").splitlines(), "msgid"]:
            if line.startswith("msgid"):
                if message:
                    yield f"{path.name} {message}", told
                message, told = "".join(_STRING.findall(line)), ""
            elif line.startswith(("msgstr", '"')):
                told += "".join(_STRING.findall(line)).replace('\\"', '"').replace("\\n", "\n")


def rule_texts(language: str) -> Iterator[tuple[str, str]]:
    for path in sorted((ROOT / "rules" / "texts").glob("*.toml")):
        for name, text in tomllib.loads(path.read_text(encoding="utf-8"))[language].items():
            if name != "translates":
                yield f"{path.name} [{language}] {name}", text


@cache
def portuguese() -> tuple[tuple[str, str], ...]:
    readme = (ROOT / "README.pt-BR.md").read_text(encoding="utf-8")
    prose = re.sub(r"```.*?```", "", readme, flags=re.DOTALL)
    return (*catalogue("pt_BR"), *rule_texts("pt-BR"), ("README.pt-BR.md", prose))


@cache
def english() -> tuple[tuple[str, str], ...]:
    return (*catalogue("en"), *rule_texts("en"))


@cache
def glossary() -> tuple[tuple[str, str, tuple[str, ...]], ...]:
    """English, Portuguese and what is never said, of every row."""
    lines = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8").splitlines()
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")][1:]
    return tuple((row[0], row[1], tuple(re.findall(r"`([^`]+)`", row[4]))) for row in rows)


def banned(texts: tuple[tuple[str, str], ...]) -> list[str]:
    found = []
    for term, right, never in glossary():
        for word in never:
            pattern = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)", re.IGNORECASE)
            # What is typed is no prose; but a phrase with a place holder is looked for as it stands.
            found += [
                f"{place}: “{word}” for {term}: write {right}"
                for place, text in texts
                if pattern.search(" ".join((text if "{" in word else _TYPED.sub(" ", text)).split()))
            ]
    return found


def foreign(texts: tuple[tuple[str, str], ...], words: frozenset[str]) -> list[str]:
    """Texts that hold two different words of the other language: one may be a name."""
    found = []
    for place, text in texts:
        said = set(re.findall(r"[^\W\d_]+", _TYPED.sub(" ", text).lower()))
        if len(said & words) > 1 or (len(said & words) == 1 and len(said) < 4):
            found.append(f"{place}: {sorted(said & words)} in “{text[:80]}”")
    return found


def test_no_text_uses_a_word_that_the_glossary_bans() -> None:
    assert banned(portuguese()) == []


def test_every_word_of_the_glossary_is_in_use() -> None:
    """A row that no text bears out is a wish, no glossary."""
    said = " ".join(" ".join(text.split()) for _, text in portuguese()).casefold()
    for term, right, _ in glossary():
        for word in re.sub(r"\([^)]*\)", "", right).split(","):
            stem = word.strip().casefold()[:-2]  # a plural may change the end
            assert stem in said, f"{term}: nobody says “{word.strip()}”"


def test_each_text_is_in_one_language() -> None:
    assert foreign(portuguese(), ENGLISH) == []
    assert foreign(english(), PORTUGUESE) == []


def test_english_has_no_portuguese_letters() -> None:
    """Names of norms and examples of layers are quoted."""
    assert [
        f"{place}: {text[:80]}"
        for place, text in english()
        if re.search("[ãõçáéíóúâêôÃÕÇÁÉÍÓÚ]", _TYPED.sub(" ", text))
    ] == []


@pytest.mark.parametrize(
    "planted",
    [
        "Uma linha está em falta se é curta.", "O veredito é este.", "Sem vazio nem sobreposição.",
        "O desvio padrão é 3 mm.", "Há uma\nborda compartilhada.", "Qualidade auditada contra {profile}.",
        "O VEREDITO.",
    ],
)  # fmt: skip
def test_a_planted_bad_word_is_found(planted: str) -> None:
    assert len(banned((("planted", planted),))) == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("The layer is not there.", ENGLISH), ("Overlap", ENGLISH), ("A fachada não tem camadas.", PORTUGUESE),
        ("Especificação", PORTUGUESE),
    ],
)  # fmt: skip
def test_a_sentence_of_the_other_language_is_found(text: str, words: frozenset[str]) -> None:
    assert len(foreign((("planted", text),), words)) == 1


@pytest.mark.parametrize(
    ("language", "number", "said"),
    [
        ("pt-BR", 1, "1 entidade não foi verificada"), ("pt-BR", 2, "2 entidades não foram verificadas"),
        ("en", 1, "1 entity was not checked"), ("en", 0, "0 entities were not checked"),
    ],
)  # fmt: skip
def test_one_thing_is_told_in_the_singular(language: str, number: int, said: str) -> None:
    sentence = Words(language)("evaluate.unseen.skipped", element="Q3", file="a.dxf", n=number, kinds="MLINE")
    assert said in sentence
