# SPDX-License-Identifier: MIT
"""The manual of a rule for people: its docstring, or a translation of it, without the marks of source code."""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass

from foparq.check.catalogue import Card
from foparq.report.words import Words
from foparq.resources import shipped

_PROFILE = "et-doc-foparq-a"  #: whose tolerances are shown as the example
_HEADING = re.compile(r"^(?P<name>\S[^\n]*)\n-{3,}$", re.MULTILINE)
#: titles of the sections of a docstring, in both languages, and what stands under each
_KINDS = {
    "parameters": "parameters", "parâmetros": "parameters", "returns": "finding", "retorna": "finding",
    "resultado": "finding", "notes": "notes", "notas": "notes",
}  # fmt: skip
_ENTRY = re.compile(r"^(?P<names>[\w, ]+?) : (?P<type>[^\n]*)$")
_COST = re.compile(r"^O\([^)]*\)[^.]*\.\s*")  #: how time grows is for programmers
_MARKS = re.compile(r"``(?P<code>[^`]+)``|\*\*(?P<strong>[^*]+)\*\*|(?<![\w*])\*(?P<term>[^*\s][^*]*)\*(?![\w*])")


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """A part of a manual."""

    kind: str  #: ``""`` of the text that opens it, else ``tolerances``, ``input``, ``finding``, ``notes``, ``profile``
    paragraphs: tuple[str, ...]


def manual_of(words: Words, card: Card) -> tuple[Section, ...]:
    """Manual of a rule in one language, in the order in which it is read."""
    text = words.find(f"rules.{card.code}.manual") or card.manual
    pieces = _HEADING.split(text.strip())
    made = [Section(kind="", paragraphs=_paragraphs(pieces[0]))]
    for name, body in zip(pieces[1::2], pieces[2::2], strict=True):
        kind = _KINDS.get(name.strip().casefold(), "notes")
        if kind == "parameters":
            made += _parameters(body, {name for name, _ in card.tolerances})
        elif kind == "finding":
            described = [line for line in body.strip("\n").split("\n") if line.startswith(" ")]
            made.append(Section(kind=kind, paragraphs=_paragraphs("\n".join(described))))
        else:
            made.append(Section(kind=kind, paragraphs=_paragraphs(_COST.sub("", body.strip()))))
    if said := _bound(words, card):
        made.append(Section(kind="profile", paragraphs=(said,)))
    return tuple(section for section in made if section.paragraphs)


def plain(text: str) -> str:
    """Text without the marks of reStructuredText; what is typed as it stands, such as a key, is quoted.

    Examples
    --------
    >>> plain("An *end* is **free** beyond ``reach``; 2 * 3")
    'An end is free beyond “reach”; 2 * 3'
    """
    return _MARKS.sub(lambda found: f"“{found['code']}”" if found["code"] else found["strong"] or found["term"], text)


def _paragraphs(text: str) -> tuple[str, ...]:
    """Paragraphs without the marks of source code; each item of a list is one of its own."""
    return tuple(plain(" ".join(part.split())) for part in re.split(r"\n\s*\n|\n(?=\s*- )", text) if part.strip())


def _parameters(body: str, tolerances: set[str]) -> list[Section]:
    """What is looked at, and the tolerances, each with what it means; types are for programmers."""
    told: dict[str, list[str]] = {"input": [], "tolerances": []}
    for part in re.split(r"\n(?=\S)", body.strip("\n")):
        head, _, rest = part.partition("\n")
        entry = _ENTRY.match(head)
        if entry is None:
            continue
        names = [name.strip() for name in entry["names"].split(",")]
        said = " ".join(_paragraphs(rest))
        if set(names) & tolerances:
            told["tolerances"].append(f"{', '.join(names)}: {said}" if said else ", ".join(names))
        elif said:
            told["input"].append(said)
    return [Section(kind=kind, paragraphs=tuple(lines)) for kind, lines in told.items()]


def _bound(words: Words, card: Card) -> str:
    """How the specification that is used by default binds the rule."""
    path = shipped("rules") / "profiles" / f"{_PROFILE}.toml"
    profile = tomllib.loads(path.read_text(encoding="utf-8"))
    checks: list[Mapping[str, object]] = [one for one in profile.get("check", []) if one["rule"] == card.name]
    if not checks:
        return ""
    found = {**profile.get("linework", {}), **checks[0]}
    severity = words(f"report.severity.{found['severity']}")
    values = [f'{name} = "{found[name]}"' for name, _ in card.tolerances if name in found]
    said = words("report.manual.bound", profile=_PROFILE, values=[severity, *values])
    on_sheet = any("@ scale" in value for value in values)
    return f"{said} {words('report.manual.sheet')}" if on_sheet else said
