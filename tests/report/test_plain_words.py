# SPDX-License-Identifier: MIT
"""Numbers with their words, probabilities that are never nought, and pages that speak one language."""

import re
from dataclasses import replace

import pytest
from tests.report.conftest import element

from foparq.evaluate.quality import ElementStatus, QualityReport
from foparq.report.page.page import page
from foparq.report.page.tables import element_views, headline
from foparq.report.record import AuditRecord
from foparq.report.words import LANGUAGES, Words

TITLES = {"pt-BR": "ET/DOC-FOPARQ, classe A (produto métrico)", "en": "ET/DOC-FOPARQ, class A (metric product)"}


def main(text: str, language: str) -> str:
    """What one language says, without markup and without what stands in code."""
    found = re.search(rf'<main lang="{language}">(.*?)</main>', text, re.DOTALL)
    assert found is not None
    said = re.sub(r"<code.*?</code>|<(\w+) class=\"(?:id|sub code|code)\".*?</\1>", " ", found[1], flags=re.DOTALL)
    return re.sub(r"<[^>]+>", " ", said)


@pytest.mark.parametrize(
    ("count", "english", "portuguese"),
    [(1, "Show 1 more row", "Mostrar mais 1 linha"), (2, "Show 2 more rows", "Mostrar mais 2 linhas"),
     (0, "Show 0 more rows", "Mostrar mais 0 linhas"), (21, "Show 21 more rows", "Mostrar mais 21 linhas")],
)  # fmt: skip
def test_words_go_with_their_numbers(count: int, english: str, portuguese: str) -> None:
    assert Words("en")("report.findings.unfold", more=count) == english
    assert Words("pt-BR")("report.findings.unfold", more=count) == portuguese


def test_the_verb_goes_with_the_part_and_the_noun_with_the_whole() -> None:
    told = {
        (missing, total): Words("pt-BR")(
            "evaluate.omission.fail",
            element="Q5",
            missing=missing,
            required=total,
            value=(0.1, "1"),
            limit=(0, "1"),
        )
        for missing, total in ((1, 12), (2, 12), (1, 1))
    }
    assert "1 de 12 feições especificadas não foi desenhada" in told[1, 12]
    assert "2 de 12 feições especificadas não foram desenhadas" in told[2, 12]
    assert "1 de 1 feição especificada não foi desenhada" in told[1, 1]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    ("p", "told"), [(0.0, "< 0.001"), (9.9e-4, "< 0.001"), (1e-3, "= 0.001"), (0.204, "= 0.204"), (1.0, "= 1")]
)
def test_a_probability_is_never_nought(language: str, p: float, told: str) -> None:
    said = Words(language)("report.symbol.foparq:normality", value=(p, ""))
    assert said == f"p {told}".replace(".", "," if language == "pt-BR" else ".")


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_never_says_that_p_is_nought(rejected: AuditRecord, language: str) -> None:
    normality = element(
        "Q7", "NonQuantitativeAttributeCorrectness", 0.0, 0.05, ElementStatus.FAIL, measure_id="foparq:normality",
        unit="", comparison=">", parameters=(("p", 0.0, ""), ("sign-p", 2e-7, "")),
    )  # fmt: skip
    record = replace(rejected, quality=QualityReport(verdict=rejected.quality.verdict, why=(), elements=(normality,)))
    (view,) = element_views(Words(language), record)
    least = "< 0,001" if language == "pt-BR" else "< 0.001"
    assert view.value == f"p {least}"
    assert [value for _, value in view.parameters].count(least) == 2


def test_the_profile_is_named_in_the_language_of_the_reader(rejected: AuditRecord) -> None:
    record = replace(rejected, profile_titles=TITLES)
    for language, title in TITLES.items():
        assert title in headline(Words(language), record, (), "").sentence
    text = page(record)
    assert TITLES["pt-BR"] not in main(text, "en")
    assert TITLES["en"] not in main(text, "pt-BR")


@pytest.mark.parametrize("language", LANGUAGES)
def test_one_of_anything_has_no_plural(rejected: AuditRecord, language: str) -> None:
    ones = {"items", "itens", "layers", "camadas", "rules", "regras", "files", "arquivos", "rows", "linhas", "findings"}
    said = main(page(rejected), language)
    assert not [word for word in re.findall(r"(?<![\d.,])1 (\w+)", said) if word in ones]


def test_portuguese_names_rules_tolerances_and_measures_in_portuguese(rejected: AuditRecord) -> None:
    said = main(page(rejected), "pt-BR")
    for word in ("undershoot", "overshoot", "coincide", "reach", "alongside", "remainder", "faulty", "rate"):
        assert not re.search(rf"\b{word}\b", said), word


def test_names_of_manifest_keys_stand_as_code(rejected: AuditRecord) -> None:
    text = page(rejected)
    assert "`" not in main(text, "pt-BR")
    assert "`" not in main(text, "en")
