# SPDX-License-Identifier: MIT
"""What the terminal shows of findings: each kind with its first ones, what to do, and how to get to the items."""

from typing import Any

import click
import numpy as np

from foparq.cli.lines import styled, tell, wrapped
from foparq.findings.table import Severity
from foparq.report.record import AuditRecord
from foparq.report.rows import finding_rows
from foparq.report.second_reading import found_words
from foparq.report.words import Words, printable

_SHOWN = 10  #: findings of one kind that the text names


def show_findings(record: AuditRecord, say: Words) -> None:
    """Write the findings to standard output, gravest first."""
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
            head = f"{rule} {name} ({say(f'cli.severity.{severity.value}')}): {say.count(count)}."
            lines = wrapped(f"{head} {say(f'rules.{rule}.title')}")
            click.echo(lines.replace(f"{rule} {name}", styled(f"{rule} {name}", bold=True), 1))
            for row in of_name[:_SHOWN]:
                file = printable(row["source"]) if several else ""
                tell("  ".join(part for part in (file, row["paste"], row["message"]) if part), "  ", "      ")
            if count > _SHOWN:
                tell(say("cli.more", count=count - _SHOWN), "  ")
            tell(say(f"rules.{rule}.mend"), "  > ")
    _otherwise(record, say)
    _ways(rows, say)


def _otherwise(record: AuditRecord, say: Words) -> None:
    """Faults of the second reading of a part, where it has others than the one that decides."""
    told = [
        f"{outcome.name} {found_words(say, outcome)}"
        for outcome in record.outcomes
        if outcome.otherwise and outcome.otherwise[1] != outcome.found
    ]
    if told:
        click.echo()
        tell(say("cli.otherwise", rules=told))


def _ways(rows: list[dict[str, Any]], say: Words) -> None:
    """How to get to an item, shown of the first one. The line itself is not wrapped: it is to be pasted."""
    lines = []
    for program in ("cad", "qgis"):
        if line := next((row[program] for row in rows if row[program]), ""):
            lines += [(wrapped(say(f"cli.find.{program}"))), f"  {printable(line)}"]
    if unnamed := next((row["item"] for row in rows if row["item"].startswith("#")), ""):
        lines.append(wrapped(say("cli.find.number", item=unnamed)))
    if lines:
        click.echo("\n" + "\n".join(lines))
