# SPDX-License-Identifier: MIT
"""Sentences that every report shares: findings, reasons, outcomes and files in the language of the reader."""

import json
import re
from collections.abc import Iterable, Iterator
from functools import cache
from string import Formatter

import numpy as np

from foparq.check.catalogue import cards
from foparq.columns import Index
from foparq.evaluate.quality import Element, Reason
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, SetAside
from foparq.findings.table import Findings
from foparq.model.delivery import Source
from foparq.model.drawing import Repair, Skipped
from foparq.names import of_kind
from foparq.report.manual import plain
from foparq.report.record import AuditRecord
from foparq.report.rule_texts import has_part
from foparq.report.words import Words, printable

_MEASURE = "measure-"  #: a count that has an ISO 19157 measure of its own


def finding_sentences(words: Words, findings: Findings, rows: Index) -> list[str]:
    """What was found, one sentence a finding.

    Parameters
    ----------
    rows : (k,) int
        Rows of the findings.

    Returns
    -------
    list of str, k
        ``rules.CODE.finding``, or where a rule has that for findings with a second item, ``finding_other``, and if that
        is the item itself, ``finding_own``; with
        ``size``, ``limit`` (quantities), ``layer``, ``item``, ``handle``, ``other``, ``other_layer``, ``inserts``,
        ``source`` and ``told`` (a repair) filled in. ``handle`` names the item as ``other`` names the other one: with
        the way through the blocks, and by its number where the file has none.

    Raises
    ------
    KeyError
        If a rule has no sentence in this language, or its sentence names another field.
    """
    made = np.empty(len(rows), dtype=object)
    codes = findings.rule[rows]
    for code in dict.fromkeys(codes.tolist()):
        mine = np.flatnonzero(codes == code)
        for message, some in _variants(code, findings, rows, mine):
            made[some] = _filled(words, message, findings, rows[some])
    sentences: list[str] = made.tolist()
    return sentences


def _variants(code: str, findings: Findings, rows: Index, mine: Index) -> Iterator[tuple[str, Index]]:
    """The sentence of a rule, and where it has them, those for a second item and for the same item once more."""
    other = findings.other[rows[mine]]
    left = np.ones(len(mine), dtype=bool)
    for part, fits in (("finding_own", other == findings.item[rows[mine]]), ("finding_other", other != "")):
        chosen = fits & left & has_part(code, part)
        left &= ~chosen
        if chosen.any():
            yield f"rules.{code}.{part}", mine[chosen]
    if left.any():
        yield f"rules.{code}.finding", mine[left]


def _filled(words: Words, message: str, findings: Findings, rows: Index) -> list[str]:
    text = words.find(message)
    if text is None:
        raise KeyError(f"no message {message!r} in {words.language}")
    template, fields = _positional(text)
    columns = [_column(words, findings, field, rows) for field in fields]
    return list(map(template.format, *columns)) if columns else [template.format()] * len(rows)


@cache
def _positional(text: str) -> tuple[str, tuple[str, ...]]:
    """A sentence with its fields numbered, and their names in that order."""
    pieces: list[str] = []
    fields: list[str] = []
    for literal, field, form, _ in Formatter().parse(text):
        pieces.append(literal.replace("{", "{{").replace("}", "}}"))
        if field is not None:
            pieces.append(f"{{:{form}}}" if form else "{}")
            fields.append(field)
    return "".join(pieces), tuple(fields)


def _column(words: Words, findings: Findings, field: str, rows: Index) -> list[str]:
    if field not in _FIELDS:
        raise KeyError(field)
    values = getattr(findings, field)[rows].tolist()
    if field == "handle":
        values = [item or handle for item, handle in zip(findings.item[rows].tolist(), values, strict=True)]
    if field == "told":
        return [_mended(words, value) for value in values]
    if field in _TEXTS:
        return [printable(str(value)) for value in values]
    quantity = cache(words.quantity)  # a limit is the same for all
    return [quantity(value, unit) for value, unit in zip(values, findings.unit[rows].tolist(), strict=True)]


_TEXTS = frozenset({"layer", "item", "handle", "other", "other_layer", "inserts", "source"})
_FIELDS = _TEXTS | {"size", "limit", "told"}


def _mended(words: Words, repair: str) -> str:
    return repair_sentence(words, Repair(**json.loads(repair))) if repair else words("report.repair.unknown")


def repair_sentence(words: Words, repair: Repair) -> str:
    """What was changed or left out, and where: ``report.repair.CODE``; for a reader's own code, its words."""
    message = f"report.repair.{repair.code}"
    if words.find(message) is None:
        handle = "" if repair.handle in repair.detail else f" {repair.handle}"
        return words("report.repair.other", detail=repair.detail + handle)
    fields = {name: getattr(repair, name) for name in ("line", "layer", "group", "text", "detail")}
    return words(message, what=" ".join(part for part in (repair.kind, repair.handle) if part), **fields)


def rule_meaning(words: Words, code: str) -> str:
    """What a rule finds, in one paragraph: the first of its manual.

    The manual is the docstring of the rule; catalogues of other languages translate it as ``rules.CODE.manual``.
    """
    manual = words.find(f"rules.{code}.manual") or _manuals()[code]
    return plain(" ".join(manual.strip().split("\n\n", 1)[0].split()))


@cache
def _codes() -> dict[str, str]:
    return {card.name: card.code for card in cards()}


@cache
def _manuals() -> dict[str, str]:
    return {card.code: card.manual for card in cards()}


def reason_sentence(words: Words, reason: Reason) -> str:
    """Sentence of a reason of the evaluation: ``evaluate.ID`` with its fields."""
    fields = {name: _labels(words, value) if name in _LABELS else _told(words, value) for name, value in reason.fields}
    return words(f"evaluate.{reason.message}", **fields)


COUNTING = frozenset({"3", "7"})  #: measures of commission and omission
#: fields of reasons that hold a class, its facade, and what was counted: ``"window / N: 20–40"``
_LABELS = frozenset({"label", "classes"})
_LABEL = re.compile(r"(?P<name>.+?)(?: / (?P<facade>.+?))?(?P<count>: \d+–\d+)?")


def class_word(words: Words, name: str) -> str:
    """Class of features in the language of the reader where the catalogue has it, else as it is spelt; safe to show."""
    return words.find(f"report.class.{of_kind(name)}") or printable(name)


def _labels(words: Words, value: object) -> object:
    return (
        [label_text(words, str(part)) for part in value]
        if isinstance(value, list | tuple)
        else label_text(words, str(value))
    )


def label_text(words: Words, label: str) -> str:
    """Class and facade in words, safe to show: ``"window / N: 20–40"`` as ``"janela (fachada N): 20–40"``."""
    found = _LABEL.fullmatch(label)
    if found is None:
        return printable(label)
    name, count = class_word(words, found["name"]), found["count"] or ""
    told = words("report.label.facade", name=name, facade=found["facade"]) if found["facade"] else name
    return f"{told}{count}"


def detail_name(words: Words, element: Element, name: str) -> str:
    """What a detail of an element counts: a class on a facade where features are counted, else a rule."""
    return label_text(words, name) if element.measure_id in COUNTING else printable(name)


def detail_title(words: Words, element: Element, name: str) -> str:
    """The same for people: a rule by its title."""
    code = _codes().get(name)
    return words(f"rules.{code}.title") if code else detail_name(words, element, name)


def _told(words: Words, value: object) -> object:
    """Reasons within a reason as their sentences."""
    if isinstance(value, Reason):
        return reason_sentence(words, value)
    if isinstance(value, tuple) and value and all(isinstance(part, Reason) for part in value):
        return words.joined(reason_sentence(words, part) for part in value)
    if isinstance(value, list) and value and isinstance(value[-1], Reason):  # the first of many names
        return f"{words.listed(value[:-1])} {reason_sentence(words, value[-1])}"
    return value


def profile_title(words: Words, record: AuditRecord) -> str:
    """Title of the profile in the language of the reader where it has one; safe to show."""
    return printable(record.profile_titles.get(words.language) or record.profile_title or record.profile)


def specification(words: Words, record: AuditRecord) -> str:
    """Title and name of the profile, and that it does not come with foparq or was changed, where that is so."""
    title = profile_title(words, record)
    named = title if title == printable(record.profile) else f"{title} ({printable(record.profile)})"
    if not record.profile_shipped:
        files = [source.path for source in record.delivery.sources if source.role == "profile"]
        return words("report.specification.own", title=named, files=files)
    if record.profile_changes:
        return words("report.specification.changed", title=named, changes=list(record.profile_changes))
    return named


def scale_text(words: Words, record: AuditRecord) -> str:
    """Drawing scale: ``"1:50"``."""
    if not record.scale:
        return words("report.fact.no-scale")
    text = f"1:{record.scale:g}"
    return text.replace(".", ",") if words.language == "pt-BR" else text


def element_title(words: Words, element: Element) -> str:
    """Name of a quality element: the catalogue's for those of the specification, else that of its measure."""
    return words.find(f"evaluate.element.{element.id}.title") or element_kind(words, element)


def element_kind(words: Words, element: Element) -> str:
    """Name of the ISO 19157 element, else of the measure; of one that could not be evaluated its id."""
    known = words.find(f"report.element.{element.element}") or words.find(f"evaluate.measure.{element.measure_id}")
    return known or printable(element.measure_name or element.id)


def source_sentence(words: Words, source: Source) -> str:
    """State of a delivered file in one sentence; for a refused file the reader's error."""
    if source.error:
        return words(f"errors.{source.error}", **dict(source.fields))
    return words(f"report.source.{source.status.value}", file=source.path, items=words.count(source.items))


def skipped_sentence(words: Words, skipped: Skipped) -> str:
    """Why things of a file reach no check: ``report.skipped.REASON``."""
    return words(f"report.skipped.{skipped.reason}", kind=skipped.kind, layer=skipped.layer, name=skipped.name or "–")


def outcome_because(words: Words, outcome: Outcome) -> str:
    """Why a rule did not run, ``report.because.ID``; empty if it ran."""
    if outcome.because is Because.RAN:
        return ""
    return words(f"report.because.{outcome.because}", rule=outcome.name, names=list(outcome.names))


def aside_sentence(words: Words, aside: SetAside) -> str:
    """An item that a rule did not judge, and why: ``"2A (PAREDE): at fault by zero-length"``."""
    why = words("report.aside.rule", rule=aside.rule) if aside.rule else words("report.aside.unfit")
    return f"{printable(aside.item)} ({printable(aside.layer)}): {why}"


def outcome_scope(words: Words, outcome: Outcome) -> str:
    """What a rule was run on, safe to show: ``"fachada.dxf: PAREDE*"``, ``"fachada.dxf: all layers"``."""
    scope = outcome.scope or outcome.source
    if scope == f"{outcome.source}: *":
        scope = f"{outcome.source}: {words('report.scope.all-layers')}"
    return printable(scope)


def parameter_name(words: Words, name: str) -> str:
    """Name of a statistic or tolerance: the catalogue's, else the identifier that the profile uses."""
    if name.startswith(_MEASURE):
        return words("report.parameter.measure", id=name.removeprefix(_MEASURE))
    return words.find(f"report.parameter.{name}") or printable(name)


_PROBABILITIES = frozenset({"p", "normality-p", "sign-p"})


def parameter_value(words: Words, name: str, value: float, unit: str) -> str:
    """Value of a statistic or tolerance; of a probability never nought."""
    return words.probability(value) if name in _PROBABILITIES else words.quantity(value, unit)


def parameters_sentence(words: Words, parameters: Iterable[tuple[str, float, str]]) -> str:
    """Names and values in one line: ``"coincide 0,1 mm; reach 10,0 mm"``.

    Parameters
    ----------
    parameters : iterable of (name, value, SI unit)
    """
    return "; ".join(f"{parameter_name(words, name)} {words.quantity(value, unit)}" for name, value, unit in parameters)
