# SPDX-License-Identifier: MIT
"""Sentences that every report shares."""

from dataclasses import replace

import pytest

from foparq.evaluate.quality import because
from foparq.findings.because import Because
from foparq.findings.outcome import Status
from foparq.model.delivery import Source, SourceStatus
from foparq.model.drawing import Skipped, SkippedReason
from foparq.report import sentences as say
from foparq.report.record import AuditRecord
from foparq.report.words import LANGUAGES, Words


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_state_of_a_file_has_a_sentence(language: str) -> None:
    words = Words(language)
    for status in SourceStatus:
        source = Source(path="a.dxf", role="drawing", sha256="", bytes=0, status=status, items=1234)
        text = say.source_sentence(words, source)
        assert text
        counted = status in {SourceStatus.READ, SourceStatus.RECOVERED}
        assert (("1.234" if language == "pt-BR" else "1,234") in text) is counted


def test_a_refused_file_speaks_with_the_words_of_its_error() -> None:
    source = Source(
        path="a.dxf",
        role="drawing",
        sha256="",
        bytes=0,
        status=SourceStatus.REFUSED,
        error="page.test-refused",
        fields=(("file", "a\u202e.dxf"),),
    )
    assert say.source_sentence(Words("en"), source) == "a\\u202e.dxf: o arquivo não é um DXF."


def test_reasons_write_quantities_in_the_manner_of_the_language() -> None:
    reason = because("page.test-poor", value=(0.01, "m"), limit=(0.0033, "m"))
    assert "(10 mm)" in say.reason_sentence(Words("pt-BR"), reason)
    assert "(10 mm)" in say.reason_sentence(Words("en"), reason)


def test_scopes_and_tolerances(rejected: AuditRecord) -> None:
    run = next(run for run in rejected.outcomes if run.rule == "TOP011")
    assert say.outcome_scope(Words("en"), run) == "fachada.dxf: all layers"
    assert say.outcome_scope(Words("en"), replace(run, scope="fachada.dxf: PAREDE*")) == "fachada.dxf: PAREDE*"
    assert say.parameters_sentence(Words("pt-BR"), run.parameters) == "coincidência 0,1 mm; alcance 10 mm"
    assert say.parameter_name(Words("pt-BR"), "measure-23") == "contagem conforme a medida 23 da ISO 19157"
    assert say.outcome_because(Words("en"), run) == ""
    assert say.outcome_because(Words("en"), replace(run, status=Status.CRASHED, because=Because.CRASHED)).startswith(
        "foparq failed"
    )


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("reason", SkippedReason)
def test_every_reason_of_skipping_has_its_sentence(language: str, reason: SkippedReason) -> None:
    part = Skipped(reason=reason, kind="KIND", layer="LAYER", count=1, name="NAME")
    told = say.skipped_sentence(Words(language), part)
    assert told
    assert "{" not in told


def test_the_meaning_of_a_rule_is_the_first_paragraph_of_its_manual() -> None:
    meaning = say.rule_meaning(Words("en"), "TOP011")
    assert meaning.endswith(".")
    assert "\n" not in meaning
    assert len(meaning) < 400


@pytest.mark.parametrize(
    ("value", "shown"),
    [(3e-7, "3 × 10⁻⁷"), (0.0, "0"), (0.0005, "0,001"), (0.91, "0,91"), (-8.2e-5, "\N{MINUS SIGN}8 × 10⁻⁵")],
)
def test_a_bare_number_that_is_not_nought_is_not_written_as_nought(value: float, shown: str) -> None:
    assert Words("pt-BR").quantity(value, "") == shown


def test_the_parts_of_a_drawing_are_items_and_never_elements_on_the_page() -> None:
    """An element is one of quality (ISO 19157); what a file holds is an item, in every table and sentence."""
    for language in LANGUAGES:
        words = Words(language)
        shown = {words(f"report.column.{name}") for name in ("element", "featid", "other")}
        assert shown == ({"Item", "Other item"} if language == "en" else {"Item", "Outro item"})
