# SPDX-License-Identifier: MIT
"""The run as JSON: ``audit.json`` and ``findings.jsonl``, and the findings as CSV."""

import csv
import io
import json
import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from foparq import __version__
from foparq.columns import Index
from foparq.evaluate.quality import Element, Reason, Verdict
from foparq.findings.outcome import Outcome
from foparq.model.delivery import Source
from foparq.report.places import places
from foparq.report.record import AuditRecord
from foparq.report.sentences import finding_sentence, reason_sentence, source_sentence
from foparq.report.words import Words

SCHEMA = "foparq-audit/1"
#: of deliveries and of loose files alike
_CONCLUSIONS = {Verdict.ACCEPTED: "clean", Verdict.REJECTED: "faulty", Verdict.UNDECIDED: "open"}

#: columns of ``findings.jsonl`` and of the CSV, in order
COLUMNS = (
    "key", "rule", "name", "severity", "source", "layer", "item", "handle", "inserts", "other", "where", "size", "unit",
    "limit", "message", "waived",
)  # fmt: skip


def audit_json(record: AuditRecord) -> dict[str, Any]:
    """The run, complete, as JSON values.

    Returns
    -------
    dict
        After the shipped schema ``foparq-audit-1.schema.json``. Lengths in metres, areas in square metres, rates as
        shares of one.
    """
    words = Words(record.language)
    names = Counter(record.findings.name.tolist())
    return {
        "schema": SCHEMA,
        "foparq": __version__,
        "versions": dict(record.versions),
        "started": record.started,
        "command": "check" if record.loose else "audit",
        "title": record.delivery.title,
        "language": record.language,
        "verdict": None if record.loose else record.quality.verdict.value,
        "conclusion": _CONCLUSIONS[record.quality.verdict],
        "why": [_reason(words, reason) for reason in record.quality.why],
        "profile": {"name": record.profile, "sha256": record.profile_sha256},
        "product_class": record.product_class,
        "scale": f"1:{record.scale:g}" if record.scale else None,
        "inputs": [_source(words, source) for source in record.delivery.sources],
        "elements": [_element(words, element) for element in record.quality.elements],
        "checks": [_outcome(outcome) for outcome in record.outcomes],
        "findings": {
            "total": len(record.findings),
            "written": len(written_rows(record)),
            "by_name": dict(sorted(names.items())),
        },
    }


def write_audit_json(record: AuditRecord, path: Path) -> None:
    """Write ``audit.json``."""
    path.write_text(json.dumps(audit_json(record), ensure_ascii=False, indent=2) + "\n", encoding="utf-8")


def write_findings_jsonl(record: AuditRecord, path: Path) -> None:
    """Write ``findings.jsonl``: one finding a line."""
    with path.open("w", encoding="utf-8") as stream:
        for line in findings_jsonl(record):
            stream.write(line + "\n")


def findings_jsonl(record: AuditRecord) -> Iterator[str]:
    """Findings as JSON, one a line."""
    for row in findings_rows(record):
        yield json.dumps(row, ensure_ascii=False)


def findings_csv(record: AuditRecord) -> str:
    """Findings as CSV; a text that a spreadsheet would take for a formula is quoted with an apostrophe."""
    stream = io.StringIO()
    columns = [name for name in COLUMNS if name != "where"]
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([*columns[:10], "x", "y", "z", *columns[10:]])
    for row in findings_rows(record):
        place = row["where"] or [None, None, None]
        cells = [row[name] for name in columns]
        writer.writerow([_inert(cell) for cell in [*cells[:10], *place, *cells[10:]]])
    return stream.getvalue()


def findings_rows(record: AuditRecord, words: Words | None = None) -> Iterator[dict[str, Any]]:
    """Findings as JSON values, those that are written in full; sentences in the language of the record or as given."""
    words = words or Words(record.language)
    table = record.findings
    points = places(table.where)
    for n in written_rows(record).tolist():
        place = points[n]
        yield {
            "key": table.key[n],
            "rule": table.rule[n],
            "name": table.name[n],
            "severity": table.severity[n],
            "source": table.source[n],
            "layer": table.layer[n],
            "item": table.item[n],
            "handle": table.handle[n],
            "inserts": table.inserts[n],
            "other": table.other[n] or None,
            "where": None if math.isnan(place[0]) else [round(float(value), 9) for value in np.nan_to_num(place)],
            "size": _number(table.size[n]),
            "unit": table.unit[n],
            "limit": _number(table.limit[n]),
            "message": finding_sentence(words, table, n),
            "waived": bool(table.waived[n]),
        }


def written_rows(record: AuditRecord) -> Index:
    """Rows of the findings that are written in full: at most ``record.written`` of each rule."""
    table = record.findings
    if len(table) <= record.written:
        return np.arange(len(table))
    kept = [np.flatnonzero(table.rule == code)[: record.written] for code in np.unique(table.rule.astype(str))]
    return np.sort(np.concatenate(kept))


def _inert(cell: object) -> object:
    if isinstance(cell, str) and cell.startswith(("=", "+", "-", "@", "\t", "\r")):
        return f"'{cell}"
    return cell


def _number(value: float) -> float | None:
    return None if math.isnan(value) or math.isinf(value) else float(value)


def _value(value: object) -> object:
    if isinstance(value, tuple | list):
        return [_value(part) for part in value]
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, np.generic):
        return _value(value.item())
    return value if isinstance(value, str | int | bool | None) else str(value)


def _reason(words: Words, reason: Reason) -> dict[str, Any]:
    fields = {name: _value(value) for name, value in reason.fields}
    return {"id": reason.message, "text": reason_sentence(words, reason), "fields": fields}


def _source(words: Words, source: Source) -> dict[str, Any]:
    return {
        "path": source.path,
        "role": source.role,
        "sha256": source.sha256,
        "bytes": source.bytes,
        "status": source.status.value,
        "items": source.items,
        "skipped": [
            {
                "reason": part.reason.value,
                "kind": part.kind,
                "layer": part.layer,
                "name": part.name,
                "count": part.count,
                "handles": list(part.handles),
            }
            for part in source.skipped
        ],
        "error": {"id": source.error, "text": source_sentence(words, source)} if source.error else None,
    }


def _element(words: Words, element: Element) -> dict[str, Any]:
    return {
        "id": element.id,
        "element": element.element,
        "measure": {"id": element.measure_id, "name": element.measure_name},
        "scope": element.scope,
        "value": None if element.value is None else _number(element.value),
        "unit": element.unit,
        "comparison": element.comparison,
        "limit": None if element.limit is None else _number(element.limit),
        "n": element.n,
        "required": element.required,
        "status": element.status.value,
        "why": [_reason(words, reason) for reason in element.why],
        "parameters": _parameters(element.parameters),
        "method": element.method,
        "details": [{"name": name, "found": _number(found), "of": _number(of)} for name, found, of in element.details],
    }


def _outcome(outcome: Outcome) -> dict[str, Any]:
    return {
        "rule": outcome.rule,
        "name": outcome.name,
        "scope": outcome.scope,
        "status": outcome.status.value,
        "checked": outcome.checked,
        "found": outcome.found,
        "skipped": outcome.skipped,
        "set_aside": [{"item": one.item, "layer": one.layer, "rule": one.rule} for one in outcome.aside],
        "because": outcome.because.value,
        "requires": list(outcome.names),
        "helper": outcome.helper,
        "parameters": _parameters(outcome.parameters),
        "seconds": round(outcome.seconds, 3),
        "preview": outcome.preview,
    }


def _parameters(parameters: tuple[tuple[str, float, str], ...]) -> dict[str, Any]:
    return {name: {"value": _number(value), "unit": unit} for name, value, unit in parameters}
