# SPDX-License-Identifier: MIT
"""What the terminal shows of a finished audit."""

import textwrap
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

import click
import numpy as np

from foparq.cli.lines import styled, tell, width, wrapped
from foparq.cli.show_findings import show_findings
from foparq.evaluate.quality import Element, Reason, Verdict
from foparq.findings.table import Severity
from foparq.model.delivery import LOST, Source, SourceStatus
from foparq.report.balances import balance_note, balance_rows
from foparq.report.contract import contract_line
from foparq.report.files import text_of
from foparq.report.formats import format_named
from foparq.report.record import AuditRecord
from foparq.report.residuals import standing_words, tied_words
from foparq.report.rows import finding_rows
from foparq.report.sentences import (
    aside_sentence,
    element_title,
    outcome_because,
    reason_sentence,
    scale_text,
    source_sentence,
    specification,
)
from foparq.report.words import Words, printable

_ID = 11  #: letters of the column of ids
_BESIDE = 44  #: letters of the columns of values, limits and states
_NARROW = 16  #: letters of a title, at least
_WIDE = 106  #: letters of a line where there is no terminal
_LOOSE = {Verdict.ACCEPTED: "clean", Verdict.REJECTED: "faults", Verdict.UNDECIDED: "incomplete"}


def show(record: AuditRecord, form: str, say: Words, written: Sequence[Path]) -> None:
    """Write a finished audit to standard output.

    Parameters
    ----------
    form : str
        Name of a format that can be shown.
    say : Words
        Language of the terminal.
    written : sequence of Path
        Report files, named at the end of the text.
    """
    if not (chosen := format_named(form)).terminal:
        for text in text_of(record, chosen):
            click.echo(text, nl=False)
    elif form == "concise":
        _concise(record, say)
    else:
        _text(record, say, written)
    if form in {"concise", "jsonl", "csv"}:
        for line in _unread(record, say):
            click.echo(line, err=True)


def _concise(record: AuditRecord, say: Words) -> None:
    for row in finding_rows(record):
        place = f" {row['paste']}" if row["paste"] else ""
        parts = [printable(str(part)) for part in (row["source"], row["layer"], row["handle"]) if part]
        click.echo(f"{':'.join(parts)}: {row['rule']} {row['name']} {_size(say, row['size'], row['unit'])}{place}")
    click.echo(f"{_headline(record, say)} {_terms(record, say)}")


def _text(record: AuditRecord, say: Words, written: Sequence[Path]) -> None:
    colour = (
        {"accepted": "green", "rejected": "red"}.get(record.quality.verdict.value, "yellow")
        if not record.loose
        else None
    )
    click.echo(styled(wrapped(_headline(record, say)), bold=True, fg=colour))
    tell(_terms(record, say))
    if contract := contract_line(say, record):
        tell(f"{contract}.")
    # Of loose files the headline tells the first reason itself: faults, or none.
    above = record.loose and record.quality.verdict is not Verdict.UNDECIDED
    for reason in record.quality.why[1 if above else 0 :]:
        tell(reason_sentence(say, reason), "  - ")
    if record.quality.remarks:
        tell(say("cli.remarks"))
    for reason in record.quality.remarks:
        tell(reason_sentence(say, reason), "  - ")
    if not record.loose:
        click.echo()
        told = _Told((*record.quality.why, *record.quality.remarks))
        for element in record.quality.elements:
            _element(element, say, told)
        _worst(record, say)
        _completeness(record, say)
    show_findings(record, say)
    _not_checked(record, say)
    if written:
        click.echo()
        tell(say("cli.written", folder=str(written[0].parent), files=[path.name for path in written]))


def _headline(record: AuditRecord, say: Words) -> str:
    faults = int(np.count_nonzero(record.findings.severity != Severity.NOTE))
    notes = len(record.findings) - faults
    if record.loose:
        ran = any(outcome.checked for outcome in record.outcomes)
        message = _LOOSE[record.quality.verdict] if ran or faults else "nothing"
        return say(f"cli.headline.{message}", faults=faults, notes=notes)
    return say(
        f"cli.headline.{record.quality.verdict.value}",
        title=record.delivery.title,
        profile=record.profile,
        faults=faults,
        notes=notes,
    )


def _terms(record: AuditRecord, say: Words) -> str:
    """On what every number rests: specification, class of product, scale."""
    return say(
        "cli.terms",
        specification=specification(say, record),
        product_class=say(f"report.fact.class-{record.product_class}"),
        scale=scale_text(say, record),
    )


class _Told:
    """Reasons that stand on the terminal already, of whichever element, so that none is read twice."""

    def __init__(self, reasons: Sequence[Reason]) -> None:
        self._known = {_but_element(reason) for reason in reasons}

    def new(self, reasons: Sequence[Reason]) -> list[Reason]:
        """Those that were not told before; from now on they were."""
        fresh = [reason for reason in reasons if _but_element(reason) not in self._known]
        self._known |= {_but_element(reason) for reason in fresh}
        return fresh


def _but_element(reason: Reason) -> tuple[str, str]:
    return reason.message, repr([field for field in reason.fields if field[0] != "element"])


def _element(element: Element, say: Words, told: _Told) -> None:
    value = "–" if element.value is None else _size(say, element.value, element.unit)
    limit = "" if element.limit is None else f"{element.comparison} {_size(say, element.limit, element.unit)}"
    status = say(f"cli.status.{element.status.value}")
    room = max(_NARROW, (width() or _WIDE) - _BESIDE - _ID)
    title, *rest = textwrap.wrap(element_title(say, element), room) or [""]
    click.echo(f"{element.id:<{_ID}}{title:<{room}} {value:>12} {limit:>13}  {status}")
    for line in rest:
        click.echo(f"{'':<{_ID}}{line}")
    if element.status.value not in {"pass", "not-applicable", "reported"}:
        for reason in told.new(element.why):
            tell(reason_sentence(say, reason), " " * _ID)


def _worst(record: AuditRecord, say: Words) -> None:
    if (worst := record.quality.worst) is None:
        return
    element, row = worst
    click.echo()
    tell(
        say(
            "cli.worst", element=element.id, id=row.id, difference=(row.difference, "m"), tied=tied_words(say, row),
            standing=standing_words(say, row),
        )
    )  # fmt: skip


def _completeness(record: AuditRecord, say: Words) -> None:
    rows = balance_rows(say, record.quality)
    if not rows:
        return
    click.echo()
    click.echo(styled(say("report.balance.title"), bold=True))
    tell(balance_note(say, record.quality), "  ")
    for row in rows:
        counts = say("cli.balance", required=row.required, found=row.found, missing=row.missing, surplus=row.surplus)
        click.echo(f"  {row.label:<28} {counts}  {row.word}")
        for note in row.notes:
            tell(note, "    ")


def _unread(record: AuditRecord, say: Words) -> list[str]:
    return [_file_line(source, say) for source in record.delivery.sources if source.status in LOST]


def _file_line(source: Source, say: Words) -> str:
    """What became of a file; most sentences name it themselves."""
    sentence, name = source_sentence(say, source), printable(source.path)
    return sentence if sentence.startswith(name) else f"{name}: {sentence}"


def _not_checked(record: AuditRecord, say: Words) -> None:
    lines = _unread(record, say)
    lines += [_file_line(source, say) for source in record.delivery.sources if source.status is SourceStatus.UNNAMED]
    rules: dict[tuple[str, str], list[str]] = defaultdict(list)
    for outcome in record.outcomes:
        if outcome.because.opens and not outcome.helper:
            rules[printable(outcome.source), outcome_because(say, outcome)].append(outcome.name)
    lines += sorted(f"{source} ({', '.join(sorted(set(names)))}): {why}" for (source, why), names in rules.items())
    lines += sorted(
        {
            f"{printable(outcome.source)}: {aside_sentence(say, one)}"
            for outcome in record.outcomes
            for one in outcome.aside
            if one.open
        }
    )
    if lines:
        click.echo()
        click.echo(styled(say("cli.not-checked"), bold=True))
        for line in lines:
            tell(line, "  ", "    ")


def _size(say: Words, value: float | None, unit: str) -> str:
    return "–" if value is None else say.quantity(value, unit)
