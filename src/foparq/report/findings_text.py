# SPDX-License-Identifier: MIT
"""Findings one a line: as JSON (``findings.jsonl``) and as a table for spreadsheets (CSV)."""

import csv
from collections.abc import Iterator
from typing import Any

from foparq.report.harmless import cell, json_line
from foparq.report.record import AuditRecord
from foparq.report.rows import finding_columns, finding_rows

_AXES = ("x", "y", "z")  #: columns of the CSV in place of ``where``


def findings_jsonl(record: AuditRecord) -> Iterator[str]:
    """Findings as JSON, one a line."""
    return map(json_line, finding_rows(record))


def findings_csv(record: AuditRecord) -> Iterator[str]:
    """Findings as CSV, a header first.

    Texts are quoted, because some spreadsheets take a semicolon for the end of a cell too, and hold no formula.
    """
    columns: dict[str, Any] = {}
    for name, column in finding_columns(record).items():
        if name == "where":
            columns |= {axis: [spot and spot[n] for spot in column] for n, axis in enumerate(_AXES)}
        else:
            columns[name] = [cell(value) for value in column]
    # The writer returns what its stream returns: here the line itself.
    line = csv.writer(_Line(), lineterminator="", quoting=csv.QUOTE_NONNUMERIC).writerow
    yield line(columns)
    yield from map(line, zip(*columns.values(), strict=True))


class _Line:
    def write(self, text: str) -> str:
        return text
