# SPDX-License-Identifier: MIT
"""``quality.xml``: stand-alone quality report in the mdq encoding of ISO/TS 19157-2:2016.

The encoding has no slot for the parameters of a measure: tolerances travel as text in the description of the method,
statistics, counts and single differences in a descriptive result of their own. A result that is neither pass nor fail
is descriptive, never a conformance result. What was not evaluated names no method.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from lxml import etree
from lxml.builder import ElementMaker

from foparq.evaluate.measures import measures
from foparq.evaluate.quality import Element, ElementStatus, Reason, Residual, Verdict
from foparq.report.contract import contract_sentences, responsible_party
from foparq.report.record import AuditRecord
from foparq.report.residuals import standing_words
from foparq.report.sentences import detail_name, parameter_name, reason_sentence, specification
from foparq.report.words import Words, printable

_ISO = "http://standards.iso.org/iso/"
NAMESPACES = {
    "mdq": _ISO + "19157/-2/mdq/1.0",
    "mcc": _ISO + "19115/-3/mcc/1.0",
    "gco": _ISO + "19115/-3/gco/1.0",
    "cit": _ISO + "19115/-3/cit/2.0",
    "gml": "http://www.opengis.net/gml/3.2",
    "xlink": "http://www.w3.org/1999/xlink",
    "xsi": "http://www.w3.org/2001/XMLSchema-instance",
}
_CODE_LISTS = {
    "MD_ScopeCode": _ISO + "19115/resources/Codelists/cat/codelists.xml#MD_ScopeCode",
    "CI_RoleCode": _ISO + "19115/resources/Codelists/cat/codelists.xml#CI_RoleCode",
    "DQ_EvaluationMethodTypeCode": _ISO + "19157/resources/Codelists/cat/codelists.xml#DQ_EvaluationMethodTypeCode",
}
#: SI unit: id in the document, code and its register
_UNITS = {
    "m": ("m", "urn:ogc:def:uom:EPSG::9001", "EPSG"),
    "m2": ("m2", "urn:ogc:def:uom:UCUM::m2", "UCUM"),
    "1": ("unity", "urn:ogc:def:uom:EPSG::9201", "EPSG"),
}
_VERDICT_MEASURE = "101"
#: measures of points and distances that somebody chose
_SAMPLED = frozenset({"39", "128", "foparq:distance-rmse", "foparq:trend", "foparq:normality"})
_UNEVALUATED = frozenset({ElementStatus.NOT_ASSESSED, ElementStatus.NOT_APPLICABLE})
_BESIDE = ("report.html", "findings.gpkg", "findings.jsonl", "audit.json")  #: reports that this one points to
_LISTED = 100  #: differences that are listed, worst first
_XLINK = f"{{{NAMESPACES['xlink']}}}"
_XSI = f"{{{NAMESPACES['xsi']}}}"
_Node = Any  # lxml publishes no types

_mdq = ElementMaker(namespace=NAMESPACES["mdq"], nsmap=NAMESPACES)
_mcc = ElementMaker(namespace=NAMESPACES["mcc"])
_gco = ElementMaker(namespace=NAMESPACES["gco"])
_cit = ElementMaker(namespace=NAMESPACES["cit"])
_gml = ElementMaker(namespace=NAMESPACES["gml"])


def write_quality_xml(record: AuditRecord, path: Path) -> None:
    """Write the quality report of an audit.

    Parameters
    ----------
    path : Path
        The file to write; an existing one is replaced.

    Notes
    -----
    The same record gives the same bytes. Texts of the delivery are written as text, control and bidirectional
    characters as escapes: XML has no place for most of them.
    """
    path.write_bytes(quality_xml(record))


def quality_xml(record: AuditRecord) -> bytes:
    """Stand-alone quality report as a UTF-8 document, root ``mdq:DQ_DataQuality``."""
    root = _Report(record).root()
    document: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return document


class _Report:
    """One report in the making; knows which units were defined already, because ids are unique in a document."""

    def __init__(self, record: AuditRecord) -> None:
        self.record = record
        self.words = Words(record.language)
        self.defined: set[str] = set()

    def root(self) -> _Node:
        title = printable(self.record.delivery.title) or self.words("evaluate.xml.untitled")
        return _mdq.DQ_DataQuality(
            _mdq.scope(_scope(title)),
            _mdq.standaloneQualityReport(
                _mdq.DQ_StandaloneQualityReportInformation(
                    _mdq.reportReference(self._reference(title)),
                    _mdq.abstract(_text(self._abstract())),
                )
            ),
            *(_mdq.report(self._element(element)) for element in self.record.quality.elements),
            _mdq.report(self._verdict()),
        )

    def _reference(self, title: str) -> _Node:
        """Citation of the report: who made it, and what lies beside it."""
        node = _citation(self.words("evaluate.xml.title", title=title))
        maker = f"foparq {self.record.versions.get('foparq', '')}".strip()
        party = _cit.CI_Organisation(_cit.name(_text(maker)))
        role = _cit.role(_code("CI_RoleCode", "processor", _cit))
        node.append(_cit.citedResponsibleParty(_cit.CI_Responsibility(role, _cit.party(party))))
        node.extend(responsible_party(self.record, _cit, _text, _code))
        for name in (name for name in _BESIDE if name not in self.record.crashed):
            node.append(_cit.onlineResource(_cit.CI_OnlineResource(_cit.linkage(_text(name)))))
        return node

    def _abstract(self) -> str:
        verdict = self.words(f"evaluate.verdict.name.{self.record.quality.verdict.value}")
        key = "evaluate.xml.abstract-loose" if self.record.loose else "evaluate.xml.abstract"
        opening = self.words(key, profile=self._specification(), verdict=verdict)
        quality, contract = self.record.quality, contract_sentences(self.words, self.record)
        why = () if self.record.loose else (*quality.why, *quality.remarks)
        return " ".join([opening, *contract, *self._sentences(why)])

    def _specification(self) -> str:
        record = self.record
        plain = record.profile_shipped and not record.profile_changes
        return printable(record.profile_title or record.profile) if plain else specification(self.words, record)

    def _sentences(self, reasons: Iterable[Reason]) -> Iterator[str]:
        return (reason_sentence(self.words, reason) for reason in reasons)

    def _element(self, element: Element) -> _Node:
        node = _mdq(
            f"DQ_{element.element}",
            _mdq.measure(self._measure(element.measure_id, element.measure_name)),
        )
        if element.value is not None or element.status not in _UNEVALUATED:
            node.append(_mdq.evaluationMethod(self._method(element)))
        if element.value is not None:
            node.append(_mdq.result(self._quantitative(element)))
        statement = " ".join(self._sentences(element.why))
        if element.status in {ElementStatus.PASS, ElementStatus.FAIL}:
            node.append(_mdq.result(self._conformance(statement, passed=element.status is ElementStatus.PASS)))
        else:
            node.append(_mdq.result(_descriptive(statement)))
        if run := self._run(element):
            node.append(_mdq.result(_descriptive(run)))
        return node

    def _measure(self, identifier: str, name: str) -> _Node:
        space, _, code = identifier.rpartition(":")
        translated = self.words.find(f"evaluate.measure.{identifier}")
        names = [name] if translated in {None, name} else [name, translated]
        return _mdq.DQ_MeasureReference(
            _mdq.measureIdentification(
                _mcc.MD_Identifier(_mcc.code(_text(code)), _mcc.codeSpace(_text(space or "ISO 19157")))
            ),
            *(_mdq.nameOfMeasure(_text(name)) for name in names),
        )

    def _run(self, element: Element) -> str:
        """Statistics, counts per class or rule, and differences of this run."""
        parts = [
            f"{parameter_name(self.words, name)}: {self.words.quantity(value, unit)}"
            for name, value, unit in element.parameters
        ]
        count = self.words.count
        for name, found, out_of in element.details:
            parts.append(f"{detail_name(self.words, element, name)}: {count(found)} / {count(out_of)}")
        parts += [self._residual(row) for row in (element.residuals.rows[:_LISTED] if element.residuals else ())]
        return "; ".join(parts)

    def _residual(self, row: Residual) -> str:
        difference = "–" if row.difference is None else self.words.quantity(row.difference, "m")
        return f"{printable(row.id)}: {difference} ({standing_words(self.words, row)})"

    def _tolerances(self, rule: str) -> str:
        rows = {row for outcome in self.record.outcomes if outcome.name == rule for row in outcome.parameters}
        return ", ".join(
            f"{parameter_name(self.words, name)} {self.words.quantity(value, unit)}"
            for name, value, unit in sorted(rows)
        )

    def _method(self, element: Element) -> _Node:
        own = f"evaluate.method.{element.measure_id}"
        text = self.words(own if self.words.find(own) else "evaluate.method.rules")
        rules = {name: self._tolerances(name) for name, _, _ in element.details}
        used = "; ".join(f"{printable(name)} ({tolerances})" for name, tolerances in rules.items() if tolerances)
        parts = [
            *self._when(),
            _mdq.evaluationMethodDescription(_text(f"{text} {used}".strip())),
            _mdq.evaluationMethodType(_code("DQ_EvaluationMethodTypeCode", element.method, _mdq)),
        ]
        if element.measure_id not in _SAMPLED:
            return _mdq.DQ_FullInspection(*parts)
        return _mdq.DQ_SampleBasedInspection(
            *parts,
            _mdq.samplingScheme(_text(self.words("evaluate.sampling.scheme"))),
            _mdq.lotDescription(_text(self.words("evaluate.sampling.lot"))),
            _mdq.samplingRatio(_text(self.words("evaluate.sampling.ratio", n=element.n))),
        )

    def _when(self) -> Iterator[_Node]:
        if self.record.started:
            yield _mdq.dateTime(_gco.DateTime(printable(self.record.started)))

    def _quantitative(self, element: Element) -> _Node:
        scope = [_mdq.resultScope(_scope(printable(element.scope)))] if element.scope else []
        whole = element.unit == "items"
        kind = "Integer" if whole else "Real"
        number = str(round(element.value or 0.0)) if whole else repr(float(element.value or 0.0))
        node = _mdq.DQ_QuantitativeResult(*scope, _mdq.value(_record(kind, number)))
        if not whole:
            node.append(self._unit(element.unit or "1"))
        value_type = measures()[element.measure_id].value if element.measure_id in measures() else kind
        node.append(_mdq.valueRecordType(_gco.RecordType(value_type)))
        return node

    def _unit(self, symbol: str) -> _Node:
        name, code, register = _UNITS[symbol]
        if name in self.defined:
            return _mdq.valueUnit({f"{_XLINK}href": f"#{name}"})
        self.defined.add(name)
        definition = _gml.UnitDefinition(
            {f"{{{NAMESPACES['gml']}}}id": name}, _gml.identifier(code, codeSpace=register), _gml.catalogSymbol(symbol)
        )
        return _mdq.valueUnit(definition)

    def _conformance(self, explanation: str, *, passed: bool) -> _Node:
        record = self.record
        # What is not shipped cites what it will; that makes it no other name of a norm, nor a profile of foparq.
        citation = _citation(
            self._specification(), also=record.norms if record.profile_shipped else (), edition=record.profile_sha256,
            identifier=record.profile, space="foparq" if record.profile_shipped else "",
        )  # fmt: skip
        return _mdq.DQ_ConformanceResult(
            _mdq.specification(citation),
            _mdq.explanation(_text(explanation)),
            _mdq("pass", _gco.Boolean("true" if passed else "false")),
        )

    def _verdict(self) -> _Node:
        """Measure 101 over the whole delivery; loose files and open questions have no truth value."""
        quality = self.record.quality
        method = _mdq.DQ_AggregationDerivation(
            *self._when(), _mdq.evaluationMethodDescription(_text(self.words(f"evaluate.method.{_VERDICT_MEASURE}")))
        )
        node = _mdq.DQ_UsabilityElement(
            _mdq.measure(self._measure(_VERDICT_MEASURE, measures()[_VERDICT_MEASURE].name)),
            _mdq.evaluationMethod(method),
        )
        if self.record.loose or quality.verdict is Verdict.UNDECIDED:
            node.append(_mdq.result(_descriptive(self._abstract())))
            return node
        accepted = quality.verdict is Verdict.ACCEPTED
        value = _mdq.DQ_QuantitativeResult(
            _mdq.value(_record("Boolean", "true" if accepted else "false")),
            _mdq.valueRecordType(_gco.RecordType("Boolean")),
        )
        node.append(_mdq.result(value))
        node.append(_mdq.result(self._conformance(" ".join(self._sentences(quality.why)), passed=accepted)))
        return node


def _text(text: str) -> _Node:
    return _gco.CharacterString(printable(text))


def _code(name: str, value: str, maker: ElementMaker) -> _Node:
    return maker(name, {"codeList": _CODE_LISTS[name], "codeListValue": value})


def _scope(title: str) -> _Node:
    return _mcc.MD_Scope(
        _mcc.level(_code("MD_ScopeCode", "dataset", _mcc)),
        _mcc.levelDescription(_mcc.MD_ScopeDescription(_mcc.dataset(_text(title)))),
    )


def _citation(
    title: str, *, also: Iterable[str] = (), edition: str = "", identifier: str = "", space: str = ""
) -> _Node:
    node = _cit.CI_Citation(_cit.title(_text(title)), *(_cit.alternateTitle(_text(norm)) for norm in also))
    if edition:
        node.append(_cit.edition(_text(f"sha256:{edition}")))
    if identifier:
        spaces = [_mcc.codeSpace(_text(space))] if space else []
        node.append(_cit.identifier(_mcc.MD_Identifier(_mcc.code(_text(identifier)), *spaces)))
    return node


def _record(kind: str, text: str) -> _Node:
    return _gco.Record({f"{_XSI}type": f"gco:{kind}_PropertyType"}, _gco(kind, text))


def _descriptive(statement: str) -> _Node:
    return _mdq.DQ_DescriptiveResult(_mdq.statement(_text(statement)))
