# SPDX-License-Identifier: MIT
"""The page's headline, table of quality elements and lists of files, in one language."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from foparq.evaluate.quality import Element, ElementStatus, Verdict
from foparq.findings.outcome import Status
from foparq.findings.table import Severity
from foparq.model.delivery import Source, SourceStatus
from foparq.report.page.findings import Group
from foparq.report.page.mending import Cause, causes_of, tasks_of
from foparq.report.record import AuditRecord
from foparq.report.sentences import (
    detail_title,
    element_kind,
    element_title,
    parameter_name,
    parameter_value,
    profile_title,
    reason_sentence,
    scale_text,
    source_sentence,
    specification,
)
from foparq.report.words import Words, printable

#: an element that leaves the question open
OPEN = frozenset({ElementStatus.UNDECIDED, ElementStatus.NOT_ASSESSED})
TAKEN_IN = frozenset({SourceStatus.READ, SourceStatus.RECOVERED})
#: roles whose items or rows are told
_COUNTED = frozenset({"drawing", "mesh", "reference", "checkpoints", "distances", "features"})
_OTHER_RATES = frozenset({"rate-least", "rate-most"})  #: of completeness, by the other reading of the drawings
_FILES_NAMED = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Headline:
    """The verdict and what a reader must know first."""

    mark: str  #: ``accepted``, ``rejected``, ``undecided``; for loose files ``clean``, ``faulty`` or ``undecided``
    title: str
    sentence: str
    why: tuple[str, ...]
    remarks: tuple[str, ...]
    gaps: tuple[str, ...]  #: what was not checked, in a few words
    causes: tuple[Cause, ...]
    tasks: tuple[Cause, ...]  #: of whoever decides
    facts: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ElementView:
    """One quality element."""

    id: str
    element: str
    measure: str
    scope: str
    value: str
    limit: str
    n: str
    status: str
    word: str
    why: tuple[str, ...]
    required: bool
    parameters: tuple[tuple[str, str], ...]
    details: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class InputView:
    """One delivered file."""

    path: str
    role: str
    status: str
    word: str
    sentence: str
    bytes: str
    sha256: str


def headline(words: Words, record: AuditRecord, groups: Sequence[Group], suffix: str) -> Headline:
    """What stands on top of the page."""
    faults = [group for group in groups if group.severity != Severity.NOTE]
    mark, sentence = _loose(words, record, faults) if record.loose else _judged(words, record)
    return Headline(
        mark=mark,
        sentence=sentence,
        title=title(words, record),
        why=tuple(reason_sentence(words, reason) for reason in record.quality.why[_told_above(record) :]),
        remarks=tuple(reason_sentence(words, reason) for reason in record.quality.remarks),
        gaps=_gaps(words, record),
        causes=causes_of(words, record, faults, suffix),
        tasks=tasks_of(words, record, suffix),
        facts=_facts(words, record),
    )


def _told_above(record: AuditRecord) -> int:
    """Of loose files the headline tells the first reason itself: faults, or none."""
    return int(record.loose and record.quality.verdict is not Verdict.UNDECIDED)


def title(words: Words, record: AuditRecord) -> str:
    """Title of the delivery; for loose files their names."""
    if record.delivery.title:
        return printable(record.delivery.title)
    files = [source.path for source in record.delivery.sources if source.role != "profile"]
    names = [printable(PurePosixPath(path).name or path) for path in files]
    if not record.loose or not names:
        return words("report.page.untitled")
    first = ", ".join(names[:_FILES_NAMED])
    more = len(names) - _FILES_NAMED
    return words("report.page.and-more", files=first, more=words.count(more)) if more > 0 else first


def _judged(words: Words, record: AuditRecord) -> tuple[str, str]:
    verdict = record.quality.verdict
    sentence = words(f"report.headline.{verdict.value}", profile=profile_title(words, record))
    return verdict.value, sentence if record.profile_shipped else f"{sentence} {words('report.headline.own-profile')}"


def _loose(words: Words, record: AuditRecord, faults: Sequence[Group]) -> tuple[str, str]:
    verdict = record.quality.verdict
    if verdict is Verdict.REJECTED:
        total = sum(group.found for group in faults)
        return "faulty", words(f"report.headline.loose-{'one' if total == 1 else 'many'}", count=words.count(total))
    if verdict is Verdict.ACCEPTED:
        return "clean", words("report.headline.loose-none")
    ran = any(outcome.status in {Status.CLEAN, Status.FAULTY} for outcome in record.outcomes)
    return verdict.value, words(f"report.headline.loose-{'open' if ran else 'nothing'}")


def _gaps(words: Words, record: AuditRecord) -> tuple[str, ...]:
    left_open = [] if record.loose else [element for element in record.quality.elements if element.status in OPEN]
    numbers = {
        "files": sum(source.status not in TAKEN_IN for source in record.delivery.sources),
        # Loose files are not asked for what only a delivery holds.
        "elements": sum(element.required for element in left_open),
        "informative": sum(not element.required for element in left_open),
        # A rule that had nothing to look at left nothing unjudged.
        "rules": len({run.rule for run in record.outcomes if run.because.opens}),
        "things": sum(part.count for source in record.delivery.sources for part in source.skipped),
    }
    return tuple(
        words(f"report.headline.gap-{name}-{'one' if number == 1 else 'many'}", count=words.count(number))
        for name, number in numbers.items()
        if number
    )


def _facts(words: Words, record: AuditRecord) -> tuple[tuple[str, str], ...]:
    facts = [
        ("profile", specification(words, record)),
        ("class", words(f"report.fact.class-{record.product_class}")),
        ("scale", scale_text(words, record)),
    ]
    if record.started:
        facts.append(("date", moment(words, record.started)))
    facts.append(("version", f"foparq {record.versions.get('foparq', '')}".strip()))
    if record.norms:
        facts.append(("norms", "; ".join(printable(norm) for norm in record.norms)))
    return tuple((words(f"report.fact.{name}"), value) for name, value in facts)


def moment(words: Words, iso: str) -> str:
    """Moment (ISO 8601, UTC) as people write it."""
    date, _, clock = iso.partition("T")
    year, month, day = date.split("-")
    return words(
        "report.date.long", day=day.lstrip("0"), month=words(f"report.date.month-{month}"), year=year, time=clock[:5]
    )


def element_views(words: Words, record: AuditRecord) -> tuple[ElementView, ...]:
    """Rows of the table of quality elements; of loose files those that could be assessed."""
    shown = (one for one in record.quality.elements if not record.loose or one.status is not ElementStatus.NOT_ASSESSED)
    return tuple(_element_view(words, element) for element in shown)


def open_elements(words: Words, record: AuditRecord) -> tuple[ElementView, ...]:
    """Quality elements that were not decided."""
    return tuple(_element_view(words, element) for element in record.quality.elements if element.status in OPEN)


def _element_view(words: Words, element: Element) -> ElementView:
    kind = element_kind(words, element)
    sign = {"<=": "≤", ">=": "≥"}.get(element.comparison, element.comparison)
    limit = "" if element.limit is None else f"{sign} {words.quantity(element.limit, element.unit)}"
    parameters = [
        (parameter_name(words, name), parameter_value(words, name, value, unit))
        for name, value, unit in element.parameters
    ]
    return ElementView(
        id=printable(element.id),
        element=element_title(words, element),
        measure=_measure(words, element),
        scope=printable(element.scope),
        value=_value(words, element),
        limit=limit.strip() or "–",
        n=words.count(element.n),
        status=element.status.value,
        word=words(f"report.status.{element.status.value}"),
        why=tuple(reason_sentence(words, reason) for reason in element.why),
        required=element.required,
        parameters=(
            (words("report.elements.kind"), kind),
            *parameters,
            (words("report.elements.method"), words(f"report.method.{element.method}")),
        ),
        details=tuple((detail_title(words, element, name), _share(words, *of)) for name, *of in element.details),
    )


def _measure(words: Words, element: Element) -> str:
    name = words.find(f"evaluate.measure.{element.measure_id}") or printable(element.measure_name)
    return f"{name} ({element.measure_id})" if element.measure_id.isdecimal() else name


def _value(words: Words, element: Element) -> str:
    """Value with its unit, from-to where drawings allow several; a bare statistic with its symbol."""
    if element.value is None:
        return "–"
    other = [value for name, value, _ in element.parameters if name in _OTHER_RATES]
    symbol = f"report.symbol.{element.measure_id}"
    if words.find(symbol):
        return words(symbol, value=(element.value, element.unit))
    return "–".join(words.quantity(value, element.unit) for value in sorted([element.value, *other]))


def _share(words: Words, found: float, out_of: float) -> str:
    if not out_of:
        return words.count(found)
    return words(
        "report.elements.detail",
        found=words.count(found),
        total=words.count(out_of),
        rate=words.quantity(found / out_of, "1"),
    )


def _state(words: Words, source: Source) -> str:
    plain = source.status is SourceStatus.READ and source.role not in _COUNTED
    return "" if plain else source_sentence(words, source)


def input_views(words: Words, sources: Sequence[Source]) -> tuple[InputView, ...]:
    """Rows of the table of files."""
    return tuple(
        InputView(
            path=printable(source.path),
            role=words(f"report.role.{source.role}"),
            status=source.status.value,
            word=words(f"report.source-status.{source.status.value}"),
            sentence=_state(words, source),
            bytes=words.count(source.bytes) if source.status is not SourceStatus.MISSING else "–",
            sha256=source.sha256,
        )
        for source in sources
    )
