# SPDX-License-Identifier: MIT
"""What the texts of a rule must hold; messages say what to do."""

import string
from typing import Any

from foparq.check.rule import Rule
from foparq.report.rule_texts import digest
from foparq.report.words import LANGUAGES

#: what a sentence about a finding may name
FIELDS = {"size", "limit", "layer", "item", "handle", "other", "other_layer", "inserts", "source", "told"}


SENTENCES = ("finding", "finding_other", "finding_own")


def placeholders(text: str) -> set[str]:
    return {field for _, field, _, _ in string.Formatter().parse(text) if field is not None}


def check_texts(rule: Rule, tables: dict[str, Any]) -> None:
    """Assert that the texts are whole, say the same in both languages, and translate the docstring of today."""
    file = f"rules/texts/{rule.code}.toml"
    assert set(tables) == set(LANGUAGES), f"{file} needs one table a language: {LANGUAGES}"
    for language, texts in tables.items():
        due = {"title", "finding", "mend"} | ({"translates", "manual"} if language != "en" else set())
        assert set(texts) - {"finding_other", "finding_own"} == due, (
            f"[{language}] of {file} must hold {sorted(due)}, no more and no less"
        )
        for part, text in texts.items():
            assert isinstance(text, str), f"{part} under [{language}] of {file} is no text"
            assert text.strip(), f"{part} under [{language}] of {file} is empty"
        sentences = "".join(texts.get(part, "") for part in SENTENCES)
        unknown = placeholders(sentences) - FIELDS
        assert not unknown, f"finding under [{language}] of {file} names {unknown}: only {sorted(FIELDS)} are filled in"
        for part in ("title", "mend"):
            assert not placeholders(texts[part]), f"{part} under [{language}] of {file} names fields; only finding may"
    for part in SENTENCES:
        english, portuguese = (placeholders(tables[language].get(part, "")) for language in ("en", "pt-BR"))
        assert english == portuguese, f"{part} of {file} names {english} in English, {portuguese} in Portuguese"

    translated = tables["pt-BR"]
    for name, _ in rule.tolerances:
        assert name in translated["manual"], f"manual under [pt-BR] of {file} does not explain {name}"
    assert translated["translates"] == digest(rule.manual), (
        f"the docstring of {rule.name} is not the one that was translated. Bring manual under [pt-BR] of {file} "
        f'up to date, then write there:\ntranslates = "{digest(rule.manual)}"'
    )
