# SPDX-License-Identifier: MIT
"""``quality.xml`` against the ISO schemas, offline, and against what the audit said."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lxml import etree

from foparq.evaluate.quality import (
    Element,
    ElementStatus,
    QualityReport,
    Residual,
    Residuals,
    Standing,
    Verdict,
    because,
)
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import no_findings
from foparq.model.delivery import Delivery
from foparq.model.statements import Contract
from foparq.report.iso19157 import NAMESPACES, quality_xml, write_quality_xml
from foparq.report.record import AuditRecord

HOSTILE = "<script>alert('x')</script> & \x00\x08\x1b\ud800\ufffe \u202eterces\u202c ]]> é ́"


def element(id_: str = "Q1-X", status: ElementStatus = ElementStatus.PASS, **changes: Any) -> Element:
    given = {
        "id": id_, "element": "AbsoluteExternalPositionalAccuracy", "measure_id": "39",
        "measure_name": "root mean square error", "scope": "pontos.csv", "value": 0.0042, "unit": "m", "limit": 0.015,
        "comparison": "<", "n": 7, "status": status, "required": True, "method": "directExternal",
        "why": (because("absolute.pass", element=id_, n=7, value=(0.0042, "m"), limit=(0.015, "m")),),
        "parameters": (("mean", 0.0021, "m"), ("sd", 0.0039, "m"), ("confidence", 0.95, "1"), ("n", 7.0, "items")),
    }  # fmt: skip
    return Element(**{**given, **changes})


def one_of_each() -> tuple[Element, ...]:
    return (
        element(),
        element("Q1-Y", why=(because("absolute.rounding", element="Q1-Y", value=(0.0149, "m"), limit=(0.015, "m"),
                                     low=(0.0144, "m"), high=(0.0154, "m")),), status=ElementStatus.UNDECIDED),
        element("Q1-Z", ElementStatus.NOT_ASSESSED, value=None, why=(because("absolute.none", element="Q1-Z"),)),
        element("Q2", ElementStatus.NOT_APPLICABLE, element="RelativeInternalPositionalAccuracy",
                measure_id="foparq:distance-rmse", why=(because("element.not-applicable", element="Q2"),)),
        element("Q3", ElementStatus.FAIL, element="TopologicalConsistency", measure_id="foparq:faulty-features",
                unit="1", value=0.25, limit=0.1, comparison="<=", method="directInternal", parameters=(),
                why=(because("faulty.fail", element="Q3", faulty=1, checked=4, value=(0.25, "1"), limit=(0.1, "1")),),
                details=(("undershoot", 1.0, 4.0),)),
        element("Q3-u", element="TopologicalConsistency", measure_id="23", unit="items", value=1.0, limit=2.0),
        element("Q4", element="CompletenessCommission", measure_id="3", unit="1", value=0.0, limit=0.0),
        element("Q5", element="CompletenessOmission", measure_id="7", unit="1", value=5 / 142, limit=0.05,
                details=(("janela <N> / N", 5.0, 142.0),)),
        element("Q6-X", measure_id="foparq:trend", unit="", value=1.42, limit=2.447),
        element("area", element="TopologicalConsistency", measure_id="foparq:own", unit="m2", value=0.3),
    )  # fmt: skip


def record(elements: tuple[Element, ...], verdict: Verdict = Verdict.REJECTED, **changes: Any) -> AuditRecord:
    undershoot = Outcome(
        rule="TOP021", name="undershoot", scope="a.dxf: *", source="a.dxf", status=Status.FAULTY, checked=4, found=1,
        faulty=np.array([2]), parameters=(("coincide", 0.0005, "m"), ("reach", 0.01, "m")),
    )  # fmt: skip
    why = (because("verdict.accepted", elements=["Q1-X"]),)
    given = {
        "delivery": Delivery(title="Estação", sources=()),
        "quality": QualityReport(verdict=verdict, why=why, elements=elements),
        "outcomes": (undershoot,), "findings": no_findings(), "profile": "et-doc-foparq-a",
        "profile_title": "ET/DOC-FOPARQ, classe A (produto métrico)", "profile_sha256": "ab" * 32, "product_class": "A",
        "scale": 50.0, "language": "pt-BR", "started": "2026-01-31T12:00:00+00:00", "norms": ("ISO 19157:2013",),
    }  # fmt: skip
    return AuditRecord(**{**given, **changes})


def find(document: bytes, path: str) -> list[Any]:
    return etree.fromstring(document).xpath(path, namespaces=NAMESPACES)


def reports(document: bytes) -> list[Any]:
    return find(document, "/mdq:DQ_DataQuality/mdq:report/*")


class _Shelf(etree.Resolver):
    """Addresses of the schemas to files of the shelf; nothing is fetched."""

    def __init__(self, folder: Path) -> None:
        super().__init__()
        catalog = etree.parse(folder / "catalog.xml").getroot()
        rows = catalog.findall("{*}rewriteSystem")
        self.rows = [(row.get("systemIdStartString"), str(folder / row.get("rewritePrefix"))) for row in rows]

    def resolve(self, url: str, _id: str, context: Any) -> Any:
        for start, place in self.rows:
            if url.startswith(start):
                return self.resolve_filename(f"{place}/{url[len(start) :]}", context)
        return None


@pytest.fixture(scope="module")
def schema(shared: Path) -> etree.XMLSchema:
    parser = etree.XMLParser(no_network=True)
    parser.resolvers.add(_Shelf(shared / "schemas"))
    return etree.XMLSchema(etree.parse(shared / "schemas/standards.iso.org/iso/19115/-3/mds/2.0/mds.xsd", parser))


@pytest.mark.shared
@pytest.mark.parametrize("language", ["pt-BR", "en"])
@pytest.mark.parametrize("verdict", list(Verdict))
def test_valid_against_the_iso_schemas(schema: etree.XMLSchema, language: str, verdict: Verdict) -> None:
    document = quality_xml(record(one_of_each(), verdict, language=language))
    schema.assertValid(etree.fromstring(document))


@pytest.mark.shared
@pytest.mark.parametrize("loose", [False, True])
def test_valid_with_hostile_texts_and_with_nothing(schema: etree.XMLSchema, *, loose: bool) -> None:
    worst = [replace(part, scope=HOSTILE, details=((HOSTILE, 1.0, 2.0),)) for part in one_of_each()]
    hostile = record(
        tuple(worst), delivery=Delivery(title=HOSTILE, sources=()), profile_title=HOSTILE, norms=(HOSTILE,)
    )
    schema.assertValid(etree.fromstring(quality_xml(replace(hostile, loose=loose))))
    empty = record((), delivery=Delivery(title="", sources=()), started="", profile_sha256="", loose=loose)
    schema.assertValid(etree.fromstring(quality_xml(empty)))


@pytest.mark.shared
@pytest.mark.parametrize("contractor", ["", HOSTILE])
@pytest.mark.parametrize("responsible", ["", HOSTILE])
def test_valid_with_whom_a_contract_names(schema: etree.XMLSchema, contractor: str, responsible: str) -> None:
    contract = Contract(process="1", contractor=contractor, responsible=responsible, date="2026-11-20")
    document = quality_xml(record(one_of_each(), delivery=Delivery(title="Casa", sources=(), contract=contract)))
    schema.assertValid(etree.fromstring(document))


@pytest.mark.shared
def test_the_schemas_do_reject_a_report_without_pass(schema: etree.XMLSchema) -> None:
    root = etree.fromstring(quality_xml(record(one_of_each())))
    for node in root.xpath("//mdq:pass", namespaces=NAMESPACES):
        node.getparent().remove(node)
    assert not schema.validate(root)


def test_a_hostile_title_stays_text() -> None:
    document = quality_xml(record((element(),), delivery=Delivery(title=HOSTILE, sources=())))
    assert not find(document, "//*[local-name()='script']")
    (title,) = find(document, "mdq:scope//mcc:dataset/gco:CharacterString/text()")
    assert title.startswith(
        "<script>alert('x')</script> & \\u0000\\u0008\\u001b\\ud800\\ufffe \\u202eterces\\u202c ]]> é"
    )


def test_every_element_is_one_report_and_the_verdict_the_last() -> None:
    elements = one_of_each()
    names = [etree.QName(node).localname for node in reports(quality_xml(record(elements)))]
    assert names == [*(f"DQ_{part.element}" for part in elements), "DQ_UsabilityElement"]


def test_only_pass_and_fail_are_conformance_results() -> None:
    elements = one_of_each()
    for part, node in zip(elements, reports(quality_xml(record(elements))), strict=False):
        passes = node.xpath("mdq:result/mdq:DQ_ConformanceResult/mdq:pass/gco:Boolean/text()", namespaces=NAMESPACES)
        known = {ElementStatus.PASS: ["true"], ElementStatus.FAIL: ["false"]}
        assert passes == known.get(part.status, [])
        statements = node.xpath("mdq:result/mdq:DQ_DescriptiveResult", namespaces=NAMESPACES)
        run = bool(part.parameters or part.details)
        assert len(statements) == (0 if part.status in known else 1) + run


def test_values_keep_all_their_digits_and_their_unit() -> None:
    nodes = reports(quality_xml(record(one_of_each())))
    values = [node.xpath("string(mdq:result//mdq:value/gco:Record/*)", namespaces=NAMESPACES) for node in nodes]
    assert values == ["0.0042", "0.0042", "", "0.0042", "0.25", "1", "0.0", repr(5 / 142), "1.42", "0.3", "false"]
    kinds = [node.xpath("name(mdq:result//mdq:value/gco:Record/*)", namespaces=NAMESPACES) for node in nodes]
    assert (kinds[0], kinds[5], kinds[10]) == ("gco:Real", "gco:Integer", "gco:Boolean")
    first = nodes[0].xpath("string(.//mdq:valueUnit//gml:identifier)", namespaces=NAMESPACES)
    assert first == "urn:ogc:def:uom:EPSG::9001"
    assert nodes[1].xpath("string(.//mdq:valueUnit/@xlink:href)", namespaces=NAMESPACES) == "#m"
    assert not nodes[5].xpath(".//mdq:valueUnit", namespaces=NAMESPACES)


def test_measures_carry_id_code_space_names_and_parameters() -> None:
    nodes = reports(quality_xml(record(one_of_each())))
    codes = [node.xpath("string(.//mdq:measureIdentification//mcc:code/*)", namespaces=NAMESPACES) for node in nodes]
    assert codes == ["39", "39", "39", "distance-rmse", "faulty-features", "23", "3", "7", "trend", "own", "101"]
    spaces = [
        node.xpath("string(.//mdq:measureIdentification//mcc:codeSpace/*)", namespaces=NAMESPACES) for node in nodes
    ]
    assert (spaces[0], spaces[3]) == ("ISO 19157", "foparq")
    names = nodes[0].xpath(".//mdq:nameOfMeasure/*/text()", namespaces=NAMESPACES)
    assert names[0] == "root mean square error"
    assert not nodes[0].xpath(".//mdq:measureDescription", namespaces=NAMESPACES), "it would describe the run"
    run = nodes[0].xpath("string(mdq:result[last()]//mdq:statement/*)", namespaces=NAMESPACES)
    assert "média: 2,1 mm" in run
    assert "95 %" in run
    counts = nodes[4].xpath("string(mdq:result[last()]//mdq:statement/*)", namespaces=NAMESPACES)
    assert "undershoot: 1 / 4" in counts
    method = nodes[4].xpath("string(.//mdq:evaluationMethodDescription/*)", namespaces=NAMESPACES)
    assert "500,0 µm" in method or "0,5 mm" in method
    assert "10 mm" in method


def test_a_sample_is_no_full_inspection() -> None:
    nodes = reports(quality_xml(record(one_of_each())))
    methods = [node.xpath("local-name(mdq:evaluationMethod/*)", namespaces=NAMESPACES) for node in nodes]
    sample, full = "DQ_SampleBasedInspection", "DQ_FullInspection"
    # Q1-Z was not assessed: nothing was inspected.
    assert methods[:8] == [sample, sample, "", sample, full, full, full, full]
    assert methods[8] == sample
    ratio = nodes[0].xpath("string(.//mdq:samplingRatio/*)", namespaces=NAMESPACES)
    assert ratio.startswith("7 ")


def test_the_report_names_its_maker_and_what_lies_beside_it() -> None:
    document = quality_xml(record(one_of_each(), versions={"foparq": "0.1.0"}, crashed=("report.html",)))
    assert find(document, "//mdq:reportReference//cit:CI_Organisation/cit:name/*/text()") == ["foparq 0.1.0"]
    links = find(document, "//mdq:reportReference//cit:linkage/*/text()")
    assert links == ["findings.gpkg", "findings.jsonl", "audit.json"]


def test_single_differences_are_listed_worst_first() -> None:
    rows = tuple(
        Residual(id=id_, difference=found, normalised=0.1, expected=0.1, standing=Standing.COUNTED, outlier=id_ == "P6")
        for id_, found in (("P6", -0.0713), ("P1", 0.0021))
    )
    residuals = Residuals(axis="Z", rows=rows, significance=0.05, most=1, n=2, rmse=0.05, rest=0.0021)
    (node, _) = reports(quality_xml(record((element("Q1-Z", residuals=residuals),))))
    run = node.xpath("string(mdq:result[last()]//mdq:statement/*)", namespaces=NAMESPACES)
    assert run.index("P6: \N{MINUS SIGN}71,3 mm (conta; discrepante)") < run.index("P1: 2,1 mm (conta)")


def test_a_conformance_result_cites_the_specification_and_explains_itself() -> None:
    (node, *_) = reports(quality_xml(record((element(),), language="en", profile_title="ET/DOC-FOPARQ, class A")))
    conformance = node.find("mdq:result/mdq:DQ_ConformanceResult", NAMESPACES)
    assert conformance.xpath("string(.//cit:title/*)", namespaces=NAMESPACES) == "ET/DOC-FOPARQ, class A"
    explanation = conformance.xpath("string(mdq:explanation/*)", namespaces=NAMESPACES)
    assert explanation == "Q1-X: the RMSE of 7 checkpoints is 4.2 mm, below the limit of 15 mm."


@pytest.mark.parametrize(
    ("verdict", "truth"), [(Verdict.ACCEPTED, ["true"]), (Verdict.REJECTED, ["false"]), (Verdict.UNDECIDED, [])]
)
def test_the_verdict_is_measure_101(verdict: Verdict, truth: list[str]) -> None:
    node = reports(quality_xml(record((element(),), verdict)))[-1]
    assert node.xpath("string(.//mcc:code/*)", namespaces=NAMESPACES) == "101"
    assert node.xpath(".//mdq:pass/*/text()", namespaces=NAMESPACES) == truth


def test_loose_files_have_no_verdict() -> None:
    node = reports(quality_xml(record((element(),), Verdict.ACCEPTED, loose=True)))[-1]
    assert not node.xpath(".//mdq:pass", namespaces=NAMESPACES)


def test_ids_are_unique_and_references_lead_somewhere() -> None:
    document = quality_xml(record(one_of_each()))
    ids = find(document, "//@gml:id")
    assert len(ids) == len(set(ids))
    assert {href.removeprefix("#") for href in find(document, "//mdq:valueUnit/@xlink:href")} <= set(ids)


def test_the_same_record_gives_the_same_bytes(tmp_path: Path) -> None:
    first, second = tmp_path / "a.xml", tmp_path / "b.xml"
    write_quality_xml(record(one_of_each()), first)
    write_quality_xml(record(one_of_each()), second)
    assert first.read_bytes() == second.read_bytes()
    assert first.read_bytes().startswith(b"<?xml version='1.0' encoding='UTF-8'?>")
