# SPDX-License-Identifier: MIT
"""What the terminal shows of a finished audit."""

import os
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
import numpy as np

from foparq.evaluate.quality import Element, Verdict
from foparq.findings.table import Severity
from foparq.model.delivery import LOST, SourceStatus
from foparq.report.balances import balance_note, balance_rows
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

_SHOWN = 10  #: findings of one kind that the text names
_WIDTH = 100
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
        place = "" if row["where"] is None else " ({})".format(", ".join(f"{value:.4f}" for value in row["where"]))
        parts = [printable(str(part)) for part in (row["source"], row["layer"], row["handle"]) if part]
        click.echo(f"{':'.join(parts)}: {row['rule']} {row['name']} {_size(say, row['size'], row['unit'])}{place}")
    click.echo(f"{_headline(record, say)} {_terms(record, say)}")


def _text(record: AuditRecord, say: Words, written: Sequence[Path]) -> None:
    colour = (
        {"accepted": "green", "rejected": "red"}.get(record.quality.verdict.value, "yellow")
        if not record.loose
        else None
    )
    click.echo(_styled(_headline(record, say), bold=True, fg=colour))
    click.echo(_terms(record, say))
    # Of loose files the headline tells the first reason itself: faults, or none.
    above = record.loose and record.quality.verdict is not Verdict.UNDECIDED
    for reason in record.quality.why[1 if above else 0 :]:
        click.echo(f"  - {reason_sentence(say, reason)}")
    if record.quality.remarks:
        click.echo(say("cli.remarks"))
    for reason in record.quality.remarks:
        click.echo(f"  - {reason_sentence(say, reason)}")
    if not record.loose:
        click.echo()
        for element in record.quality.elements:
            _element(element, say)
        _worst(record, say)
        _completeness(record, say)
    _findings(record, say)
    _not_checked(record, say)
    if written:
        click.echo()
        click.echo(say("cli.written", folder=str(written[0].parent), files=[path.name for path in written]))


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


def _element(element: Element, say: Words) -> None:
    value = "–" if element.value is None else _size(say, element.value, element.unit)
    limit = "" if element.limit is None else f"{element.comparison} {_size(say, element.limit, element.unit)}"
    status = say(f"cli.status.{element.status.value}")
    title = element_title(say, element)
    name = f"{element.id:<11}{title}"
    click.echo(f"{name[:62]:<62} {value:>12} {limit:>13}  {status}")
    for reason in element.why:
        if element.status.value not in {"pass", "not-applicable", "reported"}:
            click.echo(f"           {reason_sentence(say, reason)}")


def _worst(record: AuditRecord, say: Words) -> None:
    if (worst := record.quality.worst) is None:
        return
    element, row = worst
    click.echo()
    click.echo(
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
    click.echo(_styled(say("report.balance.title"), bold=True) + f"  {balance_note(say, record.quality)}")
    for row in rows:
        counts = say("cli.balance", required=row.required, found=row.found, missing=row.missing, surplus=row.surplus)
        click.echo(f"  {row.label:<28} {counts}  {row.word}")
        for note in row.notes:
            click.echo(f"    {note}")


def _findings(record: AuditRecord, say: Words) -> None:
    table = record.findings
    rows = list(finding_rows(record, say))
    several = len(record.delivery.drawings) > 1
    for severity in Severity:
        names = sorted(set(table.name[table.severity == severity].tolist()))
        for name in names:
            of_name = [row for row in rows if row["name"] == name and row["severity"] == severity]
            count = int(np.count_nonzero((table.name == name) & (table.severity == severity)))
            rule = of_name[0]["rule"]
            click.echo()
            click.echo(
                _styled(f"{rule} {name}", bold=True)
                + f" ({say(f'cli.severity.{severity.value}')}): {say.count(count)}. {say(f'rules.{rule}.title')}"
            )
            for row in of_name[:_SHOWN]:
                file = f"{printable(row['source'])} " if several else ""
                click.echo(f"  {file}{_place(row['where'])}  {row['message']}")
            if count > _SHOWN:
                click.echo(f"  {say('cli.more', count=count - _SHOWN)}")
            if severity is not Severity.NOTE:
                click.echo(_wrapped(say(f"rules.{rule}.mend"), "  > "))


def _unread(record: AuditRecord, say: Words) -> list[str]:
    return [
        f"{printable(source.path)}: {source_sentence(say, source)}"
        for source in record.delivery.sources
        if source.status in LOST
    ]


def _not_checked(record: AuditRecord, say: Words) -> None:
    lines = _unread(record, say)
    lines += [
        f"{printable(source.path)}: {source_sentence(say, source)}"
        for source in record.delivery.sources
        if source.status is SourceStatus.UNNAMED
    ]
    lines += sorted(
        {
            f"{printable(outcome.source)}: {outcome.name}: {outcome_because(say, outcome)}"
            for outcome in record.outcomes
            if outcome.because.opens and not outcome.helper
        }
    )
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
        click.echo(_styled(say("cli.not-checked"), bold=True))
        for line in lines:
            click.echo(f"  {line}")


def _styled(text: str, **style: Any) -> str:  # noqa: ANN401 - click's own arguments
    """Text with colour, unless the user asked for none (no-color.org) or the terminal knows none."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return text if plain else click.style(text, **style)


def _size(say: Words, value: float | None, unit: str) -> str:
    return "–" if value is None else say.quantity(value, unit)


def _place(where: list[float] | None) -> str:
    return "" if where is None else "({})".format("; ".join(f"{value:.4f}" for value in where))


def _wrapped(text: str, indent: str) -> str:
    import textwrap  # noqa: PLC0415

    width = min(shutil.get_terminal_size((_WIDTH, 24)).columns, 120)
    return textwrap.fill(text, width, initial_indent=indent, subsequent_indent=" " * len(indent))
