# SPDX-License-Identifier: MIT
"""``[contract]`` of the manifest: read with validation, printed on the first page, told to programs."""

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest
from lxml import etree, html

from foparq.errors import ManifestError
from foparq.model.delivery import SourceStatus
from foparq.model.statements import Contract
from foparq.profile.load import load_manifest, load_profile
from foparq.read.delivery import read_delivery
from foparq.report.audit_json import audit_json
from foparq.report.contract import contract_line
from foparq.report.iso19157 import NAMESPACES, quality_xml
from foparq.report.page.page import page
from foparq.report.record import AuditRecord
from foparq.report.words import Words
from foparq.resources import shipped

STATED = Contract(
    process="01234.000567/2026-89", contract="12/2026", contractor="Escritório <A> & filhos",
    responsible="CAU A000000-0", revision="2", date="2026-11-20",
)  # fmt: skip


@pytest.fixture
def signed(rejected: AuditRecord) -> AuditRecord:
    return replace(rejected, delivery=replace(rejected.delivery, contract=STATED))


def manifest(path: Path, body: str) -> Path:
    path.write_text(f'[delivery]\nscale = "1:50"\n\n[contract]\n{body}\n', encoding="utf-8")
    return path


@pytest.mark.parametrize(("revision", "day"), [('"2"', "2026-11-20"), ("2", '"2026-11-20"'), ('" 2 "', "2026-11-20")])
def test_what_is_stated_is_read(tmp_path: Path, revision: str, day: str) -> None:
    lines = [f'{name} = "{getattr(STATED, name)}"' for name in ("process", "contract", "contractor", "responsible")]
    path = manifest(tmp_path / "delivery.toml", "\n".join([*lines, f"revision = {revision}", f"date = {day}"]))
    delivery, _ = read_delivery(
        tmp_path, load_manifest(path), path.name, profile=load_profile("et-doc-foparq-a"), scale=50.0
    )
    assert delivery.contract == STATED


def test_a_section_that_states_nothing_is_none(tmp_path: Path) -> None:
    path = manifest(tmp_path / "delivery.toml", "")
    profile = load_profile("et-doc-foparq-a")
    assert read_delivery(tmp_path, load_manifest(path), path.name, profile=profile, scale=50.0)[0].contract is None


@pytest.mark.parametrize(
    ("line", "message", "example"),
    [
        ('date = "3/12/2026"', "toml.wrong-value", "date = 2026-11-20"),
        ('date = "2026-02-30"', "toml.wrong-value", "date = 2026-11-20"),
        ('date = "20261120"', "toml.wrong-value", "date = 2026-11-20"),
        ("date = 2026-11-20T10:00:00", "toml.wrong-value", "date = 2026-11-20"),
        ("date = 1949-12-31", "toml.wrong-value", "date = 2026-11-20"),
        ("date = 2201-01-01", "toml.wrong-value", "date = 2026-11-20"),
        ("date = 20/11/2026", "toml.syntax", "date = 2026-11-20"),
        ("revision = 1.5", "toml.wrong-value", 'revision = "2"'),
        ("revision = true", "toml.wrong-value", 'revision = "2"'),
        ('process = ""', "toml.wrong-value", 'process = "01234.000567/2026-89"'),
        ('contractor = "a\\u202eb"', "toml.wrong-value", 'contractor = "name of the office"'),
        (f'responsible = "{"a" * 201}"', "toml.wrong-value", 'responsible = "name, registration"'),
        ('contrato = "1"', "toml.unknown-key", "contractor, contract, date, process, revision, responsible"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(tmp_path: Path, line: str, message: str, example: str) -> None:
    with pytest.raises(ManifestError) as caught:
        load_manifest(manifest(tmp_path / "delivery.toml", line))
    assert caught.value.message == message
    assert caught.value.fields["line"] == 5
    shown = str(caught.value.fields["example"])
    assert set(shown.split(", ")) == set(example.split(", ")) if message == "toml.unknown-key" else shown == example
    assert shown.split(", ", maxsplit=1)[0] == example.split(", ", maxsplit=1)[0]


@pytest.mark.parametrize("day", ["1950-01-01", "2200-12-31"])
def test_the_years_of_a_delivery(tmp_path: Path, day: str) -> None:
    section = load_manifest(manifest(tmp_path / "delivery.toml", f"date = {day}")).contract
    assert section is not None
    assert str(section.date) == day


def test_the_first_page_shows_contract_hashes_and_a_place_to_sign(signed: AuditRecord) -> None:
    sources = tuple(
        replace(source, sha256=f"{n:064x}" if source.sha256 else "") for n, source in enumerate(signed.delivery.sources)
    )
    record = replace(signed, delivery=replace(signed.delivery, sources=sources))
    tree = html.fromstring(page(record))
    for language, day in (("pt-BR", "20 de novembro de 2026"), ("en", "20 November 2026")):
        (header,) = tree.xpath(f"//main[@lang='{language}']/header")
        shown = " ".join(header.text_content().split())
        for value in (STATED.process, STATED.contract, STATED.contractor, STATED.responsible, day):
            assert value in shown
        hashed = [source.sha256 for source in sources if source.sha256 and source.status is not SourceStatus.UNNAMED]
        assert [cell.text for cell in header.xpath(".//table[@class='hashes']//td")] == hashed[:12]
        assert len(header.xpath(".//*[@class='signature']/div")) == 2
    loose = html.fromstring(page(replace(record, loose=True)))
    assert not loose.xpath("//*[@class='annex']"), "loose files are no delivery: nobody signs for them"


def test_no_contract_is_told(rejected: AuditRecord) -> None:
    tree = html.fromstring(page(rejected))
    for language in ("pt-BR", "en"):
        (annex,) = tree.xpath(f"//main[@lang='{language}']//*[@class='annex']")
        assert Words(language)("report.contract.none") in annex.text_content()
    assert audit_json(rejected)["contract"] is None
    assert b"resourceProvider" not in quality_xml(rejected)


def test_audit_json_holds_it(signed: AuditRecord) -> None:
    schema = json.loads((shipped("templates") / "schema" / "foparq-audit-1.schema.json").read_text(encoding="utf-8"))
    part = schema["properties"]["contract"]
    told = audit_json(signed)["contract"]
    jsonschema.validate(told, part)
    assert told["date"] == "2026-11-20"
    short = replace(signed.delivery, contract=Contract(revision="3"))
    assert audit_json(replace(signed, delivery=short))["contract"] == {
        "process": None, "contract": None, "contractor": None, "responsible": None, "revision": "3", "date": None,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("contract", "organisation", "person"),
    [
        (STATED, [STATED.contractor], [STATED.responsible]),
        (replace(STATED, responsible=""), [STATED.contractor], []),
        (replace(STATED, contractor=""), [], [STATED.responsible]),
        (Contract(process="1"), [], []),
    ],
)
def test_quality_xml_names_the_responsible_party(
    rejected: AuditRecord, contract: Contract, organisation: list[str], person: list[str]
) -> None:
    root = etree.fromstring(quality_xml(replace(rejected, delivery=replace(rejected.delivery, contract=contract))))
    at = "//cit:CI_Responsibility[cit:role/cit:CI_RoleCode/@codeListValue='resourceProvider']"
    name = "cit:name/gco:CharacterString/text()"
    assert root.xpath(f"{at}//cit:CI_Organisation/{name}", namespaces=NAMESPACES) == organisation
    assert root.xpath(f"{at}//cit:CI_Individual/{name}", namespaces=NAMESPACES) == person
    (abstract,) = root.xpath("//mdq:abstract/gco:CharacterString/text()", namespaces=NAMESPACES)
    assert contract.process in abstract


def test_the_line_of_the_terminal(signed: AuditRecord) -> None:
    line = contract_line(Words("pt-BR"), signed)
    assert line.startswith("Processo: 01234.000567/2026-89; Contrato: 12/2026; ")
    assert line.endswith("; Revisão: 2; Data da entrega: 20 de novembro de 2026")
