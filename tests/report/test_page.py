# SPDX-License-Identifier: MIT
"""The page as text: whole, inert, the same in both languages, and honest about what was not checked."""

import base64
import hashlib
import re
import tomllib
from dataclasses import fields, replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import shapely

from foparq.evaluate.quality import QualityReport, Verdict
from foparq.findings.because import Because
from foparq.findings.outcome import SetAside, Status
from foparq.findings.table import Findings, join_findings
from foparq.model.delivery import Delivery
from foparq.model.drawing import SkippedReason
from foparq.report.page.coverage import coverage
from foparq.report.page.findings import group_findings
from foparq.report.page.page import page, write_page
from foparq.report.record import AuditRecord
from foparq.report.words import LANGUAGES, Words

REPOSITORY = Path(__file__).resolve().parents[2]
VOID = {"meta", "input", "br", "img", "link", "hr", "wbr"}


class Reader(HTMLParser):
    """Collects elements and complains about tags that do not nest."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str]]] = []
        self.text: dict[str, list[str]] = {}
        self.language = ""
        self.faults: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.elements.append((tag, values))
        if tag == "main":
            self.language = values["lang"]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")
        if tag == "main":
            self.language = ""

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in {"script", "style"} and data.strip():
            self.text.setdefault(self.language, []).append(" ".join(data.split()))

    def words(self, language: str) -> str:
        return " ".join(self.text[language])

    def all(self, tag: str) -> list[dict[str, str]]:
        return [values for name, values in self.elements if name == tag]


def read(record: AuditRecord) -> Reader:
    reader = Reader()
    reader.feed(page(record))
    reader.close()
    return reader


def test_it_is_well_formed_and_every_link_has_its_end(rejected: AuditRecord) -> None:
    reader = read(rejected)
    assert not reader.faults
    assert not reader.open
    ids = [values["id"] for _, values in reader.elements if "id" in values]
    assert len(ids) == len(set(ids))
    ends = [values["href"][1:] for _, values in reader.elements if values.get("href", "").startswith("#")]
    ends += [values["for"] for values in reader.all("label")]
    ends += [values["aria-labelledby"] for _, values in reader.elements if "aria-labelledby" in values]
    assert set(ends) <= set(ids)
    assert len(ends) > 50


def test_marks_lead_to_rows_and_rows_to_marks(rejected: AuditRecord) -> None:
    reader = read(rejected)
    marks = {
        values["id"]: values["href"][1:] for values in reader.all("a") if values.get("class", "").startswith("mark ")
    }
    rows = {values["href"][1:] for values in reader.all("a") if values.get("class") == "to-mark"}
    assert set(marks) == rows
    placed = int(np.sum(~shapely.is_empty(rejected.findings.sheet)))
    assert len(marks) == 2 * placed
    assert all(row == f"f-{mark[2:]}" for mark, row in marks.items())


def test_hostile_names_are_text_and_nothing_else(rejected: AuditRecord) -> None:
    text = page(rejected)
    reader = read(rejected)
    assert len(reader.all("script")) == 1
    assert not reader.all("img")
    assert not [values for _, values in reader.elements if any(name.startswith("on") for name in values)]
    assert "<img src=x onerror=alert(1)>" in reader.words("pt-BR")
    assert "\u202e" not in text
    assert "\\u202e" in text


def test_nothing_outside_the_file_is_named(rejected: AuditRecord) -> None:
    reader = read(rejected)
    for _, values in reader.elements:
        for name in ("src", "href", "action", "data"):
            assert re.match(r"#|data:image/png;base64,|$", values.get(name, "")), values


def test_only_the_shipped_script_and_style_may_run(rejected: AuditRecord) -> None:
    text = page(rejected)
    policy = next(
        values["content"] for values in read(rejected).all("meta") if "content" in values and "src" in values["content"]
    )
    assert policy.startswith("default-src 'none'")
    assert "unsafe" not in policy
    for tag in ("style", "script"):
        held = text.split(f"<{tag}>")[1].split(f"</{tag}>")[0]
        digest = base64.b64encode(hashlib.sha256(held.encode()).digest()).decode()
        assert f"{tag}-src 'sha256-{digest}'" in policy
    assert ' style="' not in text


def test_the_same_record_gives_the_same_bytes(rejected: AuditRecord, tmp_path: Path) -> None:
    write_page(rejected, tmp_path / "a.html")
    write_page(rejected, tmp_path / "b.html")
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_language_of_the_record_comes_first(rejected: AuditRecord, language: str) -> None:
    reader = read(replace(rejected, language=language))
    assert [values["lang"] for values in reader.all("main")] == sorted(LANGUAGES, key=lambda other: other != language)
    assert reader.all("html")[0]["lang"] == language
    assert [values["id"] for values in reader.all("input") if "checked" in values and values["type"] == "radio"] == [
        f"show-{language}"
    ]


@pytest.mark.parametrize(
    ("verdict", "portuguese", "english"),
    [
        (Verdict.ACCEPTED, "Entrega conforme em relação à especificação ET/DOC", "The delivery conforms to ET/DOC"),
        (
            Verdict.REJECTED,
            "Entrega não conforme em relação à especificação ET/DOC",
            "The delivery does not conform to ET/DOC",
        ),
        (Verdict.UNDECIDED, "inconclusiva em relação à especificação ET/DOC", "inconclusive with respect to ET/DOC"),
    ],
)
def test_the_verdict_is_a_sentence(rejected: AuditRecord, verdict: Verdict, portuguese: str, english: str) -> None:
    reader = read(replace(rejected, quality=replace(rejected.quality, verdict=verdict)))
    assert portuguese in reader.words("pt-BR")
    assert english in reader.words("en")


def loose(record: AuditRecord, findings: Findings) -> AuditRecord:
    faulty = np.any(findings.severity != "note")
    quality = QualityReport(verdict=Verdict.REJECTED if faulty else Verdict.UNDECIDED, why=(), elements=())
    runs = tuple(replace(run, found=int(np.sum(findings.rule == run.rule))) for run in record.outcomes)
    return replace(record, loose=True, quality=quality, findings=findings, outcomes=runs)


def test_loose_files_have_a_count_and_no_verdict(rejected: AuditRecord) -> None:
    faults = int(np.sum(rejected.findings.severity != "note"))
    text = read(loose(rejected, rejected.findings)).words("pt-BR")
    assert f"Foram encontradas {faults} falhas." in text
    assert "em relação a" not in text
    assert "Elementos de qualidade" not in text
    assert "Nenhuma falha foi encontrada" in read(loose(rejected, join_findings([]))).words("pt-BR")
    idle = tuple(
        replace(run, status=Status.NOT_RUN, found=0, because=Because.UNIT_UNKNOWN) for run in rejected.outcomes
    )
    assert "Nada pôde ser verificado." in read(replace(loose(rejected, join_findings([])), outcomes=idle)).words(
        "pt-BR"
    )


def test_what_was_not_checked_is_said(rejected: AuditRecord) -> None:
    text = read(rejected).words("pt-BR")
    for part in (
        "Nem tudo foi verificado:",
        "3 arquivos não foram considerados",
        "elementos de qualidade exigidos ficaram sem decisão",
        "4 entidades dos desenhos não chegaram a nenhuma verificação",
        "O foparq falhou aqui: erro do programa, não da entrega.",
        "Não havia nada do tipo que esta regra verifica.",
        "Mencionado no manifesto, não entregue.",
        "o arquivo não é um DXF.",
        "2 entidades ocultas no espaço do modelo, 1 no espaço do papel; camadas ocultas: APOIO-CAMPO",
        "Deleted owner handle 1F of a missing block 9A",
    ):
        assert part in text, part
    assert "coincidência 0,1 mm; alcance 10 mm" in text
    assert "coincide 0.1 mm; reach 10 mm" in read(rejected).words("en")


def test_items_that_were_not_judged_are_named(rejected: AuditRecord) -> None:
    aside = (SetAside(item="2C", layer="PISO", rule=""), SetAside(item="3D", layer="PISO", rule="zero-length"))
    runs = tuple(replace(run, aside=aside) if run.skipped else run for run in rejected.outcomes)
    reader = read(replace(rejected, outcomes=runs))
    for language, odd, faulty in (
        ("pt-BR", "2C (PISO): a regra não consegue trabalhar com ele", "3D (PISO): com falha por zero-length"),
        ("en", "2C (PISO): the rule cannot work with it", "3D (PISO): at fault by zero-length"),
    ):
        assert odd in reader.words(language)
        assert faulty in reader.words(language)


def test_an_item_that_no_rule_could_judge_is_a_gap(accepted: AuditRecord) -> None:
    odd = (SetAside(item="2C", layer="PISO", rule=""),)
    first, *others = accepted.outcomes
    record = replace(accepted, outcomes=(replace(first, unjudged=np.arange(1), aside=odd), *others))
    assert coverage(Words("en"), accepted, ()).complete
    assert not coverage(Words("en"), record, ()).complete


def test_a_complete_audit_claims_no_gap(accepted: AuditRecord) -> None:
    text = read(accepted).words("en")
    assert "Not everything was checked" not in text
    assert "No rule that ran found anything." in text


def test_findings_are_counted_in_full_and_listed_up_to_a_bound(rejected: AuditRecord) -> None:
    one = rejected.findings
    row = int(np.flatnonzero(one.rule == "TOP011")[0])
    columns = [column.name for column in fields(one)]
    many = Findings(**{name: np.repeat(getattr(one, name)[row : row + 1], 2000, axis=0) for name in columns})
    runs = tuple(replace(run, found=2000) for run in rejected.outcomes if run.rule == "TOP011")
    reader = read(replace(rejected, findings=many, outcomes=runs))
    assert "500 de 2.000 apontamentos estão listados aqui." in reader.words("pt-BR")
    assert "500 of 2,000 findings are listed here." in reader.words("en")
    rows = [values["id"] for values in reader.all("tr") if values.get("id", "").startswith("f-")]
    assert len(rows) == len(set(rows)) == 1000


def test_faults_come_before_notes_and_grave_before_light(rejected: AuditRecord) -> None:
    groups = group_findings(rejected)
    order = ["critical", "major", "minor", "note"]
    ranks = [order.index(group.severity) for group in groups]
    assert ranks == sorted(ranks)
    assert [group.first for group in groups] == [
        1 + sum(len(other.shown) for other in groups[:n]) for n in range(len(groups))
    ]


def test_an_audit_of_nothing_has_a_page(rejected: AuditRecord) -> None:
    empty = replace(
        rejected,
        delivery=Delivery(title="", sources=()),
        findings=join_findings([]),
        outcomes=(),
        started="",
        scale=None,
        versions={},
        norms=(),
        quality=QualityReport(verdict=Verdict.UNDECIDED, why=(), elements=()),
    )
    reader = read(empty)
    assert not reader.faults
    assert "Nenhum desenho pôde ser lido." in reader.words("pt-BR")
    assert "Delivery without a title" in reader.words("en")


def luminance(colour: str) -> float:
    """Relative luminance, WCAG 2.2."""
    parts = [int(colour[n : n + 2], 16) / 255 for n in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))


def test_text_colours_contrast_with_the_paper() -> None:
    css = (REPOSITORY / "reports/templates/page/page.css").read_text(encoding="utf-8")
    named = dict(re.findall(r"--([a-z]+): (#[0-9a-f]{6});", css))
    for name in ("ink", "soft", "good", "bad", "open", "critical", "major", "minor", "note", "link"):
        for paper in ("#ffffff", named["faint"]):
            light, dark = sorted((luminance(named[name]), luminance(paper)), reverse=True)
            assert (light + 0.05) / (dark + 0.05) >= 4.5, name


def constants(pattern: str, *folders: str) -> set[str]:
    """What a pattern finds in the sources."""
    files = [path for folder in folders for path in (REPOSITORY / "src/foparq" / folder).rglob("*.py")]
    return {found for path in files for found in re.findall(pattern, path.read_text(encoding="utf-8"))}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_word_the_other_parts_hand_over_is_known(language: str) -> None:
    words = Words(language)
    catalogue = tomllib.loads((REPOSITORY / "rules/measures.toml").read_text(encoding="utf-8"))
    wanted = {f"report.element.{measure['element']}" for measure in catalogue["measure"]}
    wanted |= {f"report.because.{because}" for because in Because if because is not Because.RAN}
    wanted |= {f"report.skipped.{reason}" for reason in SkippedReason}
    wanted |= {
        f"report.role.{id_}"
        for id_ in constants(r'role="(drawing|checkpoints|distances|features|manifest|other)"', "read")
    }
    wanted |= {f"report.method.{id_}" for id_ in constants(r'method="([a-zA-Z]+)"', "evaluate")}
    wanted |= {
        f"report.parameter.{id_}"
        for id_ in constants(r'\("([a-z0-9-]+)", [^()]*(?:\([^()]*\))?[^()]*, "(?:m|1|items|)"\)', "evaluate")
    }
    assert len(wanted) > 30
    assert not {key for key in wanted if words.find(key) is None}
