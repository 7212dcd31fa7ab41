# SPDX-License-Identifier: MIT
"""The run as JSON: ``audit.json``."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from foparq import __version__
from foparq.evaluate.quality import ClassBalance, Element, Reason, Residuals, Verdict
from foparq.findings.counts import FoundFeatures
from foparq.findings.outcome import Outcome
from foparq.model.delivery import Source
from foparq.model.drawing import Repair
from foparq.report.clouds import clouds_json
from foparq.report.harmless import json_lines
from foparq.report.record import AuditRecord
from foparq.report.rows import number, written_rows
from foparq.report.sentences import reason_sentence, repair_sentence, source_sentence
from foparq.report.words import Words

SCHEMA = "foparq-audit/1"
#: of deliveries and of loose files alike
_CONCLUSIONS = {Verdict.ACCEPTED: "clean", Verdict.REJECTED: "faulty", Verdict.UNDECIDED: "open"}


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
    repairs = {path: made[: record.written] for path, made in record.delivery.repairs.items()}
    return {
        "schema": SCHEMA,
        "foparq": __version__,
        "versions": dict(record.versions),
        "started": record.started,
        "command": "check" if record.loose else "audit",
        "title": record.delivery.title,
        "language": record.language,
        "contract": None
        if record.delivery.contract is None
        else {name: value or None for name, value in asdict(record.delivery.contract).items()},
        "verdict": None if record.loose else record.quality.verdict.value,
        "conclusion": _CONCLUSIONS[record.quality.verdict],
        "why": [_reason(words, reason) for reason in record.quality.why],
        "remarks": [_reason(words, reason) for reason in record.quality.remarks],
        "profile": {
            "name": record.profile,
            "sha256": record.profile_sha256,
            "title": record.profile_title or record.profile,
            "shipped": record.profile_shipped,
            "compared_with": record.compared or None,
            "changes": list(record.profile_changes),
        },
        "product_class": record.product_class,
        "scale": f"1:{record.scale:g}" if record.scale else None,
        "inputs": [_source(words, source, repairs.get(source.path, ())) for source in record.delivery.sources],
        "elements": [_element(words, element) for element in record.quality.elements],
        "residuals": [_residuals(element.id, residuals) for element, residuals in record.quality.measured],
        "references": clouds_json(record.quality),
        "completeness": [_balance(balance, record.quality.found) for balance in record.quality.balances],
        "checks": [_outcome(outcome) for outcome in record.outcomes],
        "crashed": list(record.crashed),
        "findings": {
            "total": len(record.findings),
            "written": len(written_rows(record)),
            "by_name": dict(sorted(names.items())),
        },
    }


def audit_json_lines(record: AuditRecord) -> Iterator[str]:
    """``audit.json``, line by line."""
    yield from json_lines(audit_json(record))


def _value(value: object) -> object:
    if isinstance(value, tuple | list):
        return [_value(part) for part in value]
    if isinstance(value, float):
        return number(value)
    if isinstance(value, np.generic):
        return _value(value.item())
    return value if isinstance(value, str | int | bool | None) else str(value)


def _reason(words: Words, reason: Reason) -> dict[str, Any]:
    fields = {name: _field(words, value) for name, value in reason.fields}
    return {"id": reason.message, "text": reason_sentence(words, reason), "fields": fields}


def _field(words: Words, value: object) -> object:
    """Field of a reason; reasons within it are written like reasons."""
    if isinstance(value, Reason):
        return _reason(words, value)
    if isinstance(value, tuple | list) and any(isinstance(part, Reason) for part in value):
        return [_field(words, part) for part in value]
    return _value(value)


def _source(words: Words, source: Source, repairs: Sequence[Repair]) -> dict[str, Any]:
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
        "repairs": [{**asdict(repair), "message": repair_sentence(words, repair)} for repair in repairs],
        "error": {"id": source.error, "text": source_sentence(words, source)} if source.error else None,
    }


def _element(words: Words, element: Element) -> dict[str, Any]:
    return {
        "id": element.id,
        "element": element.element,
        "measure": {"id": element.measure_id, "name": element.measure_name},
        "scope": element.scope,
        "value": None if element.value is None else number(element.value),
        "unit": element.unit,
        "comparison": element.comparison,
        "limit": None if element.limit is None else number(element.limit),
        "n": element.n,
        "required": element.required,
        "status": element.status.value,
        "why": [_reason(words, reason) for reason in element.why],
        "parameters": _parameters(element.parameters),
        "method": element.method,
        "details": [{"name": name, "found": number(found), "of": number(of)} for name, found, of in element.details],
    }


def _residuals(element: str, residuals: Residuals) -> dict[str, Any]:
    return {
        "element": element,
        "axis": residuals.axis,
        "n": residuals.n,
        "rmse": residuals.rmse,
        "rmse_without_outliers": residuals.rest,
        "test": {"name": "generalized ESD", "significance": residuals.significance, "most": residuals.most},
        "rows": [
            {**{key: value for key, value in asdict(row).items() if key != "place"}, "place": _value(row.place)}
            for row in residuals.rows
        ],
    }


def _balance(balance: ClassBalance, found: FoundFeatures) -> dict[str, Any]:
    one = balance.decision
    return {
        "class": balance.feature_class,
        "facade": balance.facade,
        "state": balance.state.value,
        "required": balance.required,
        "optional": balance.optional,
        **{
            name: {"least": least, "most": most}
            for name, (least, most) in (
                ("found", balance.found), ("missing", balance.missing), ("surplus", balance.surplus)
            )
        },
        "only_counted": balance.only_counted,
        "ids": list(balance.ids),
        "absent": list(balance.absent),
        "other_class": list(balance.other),
        "unsure": list(balance.unsure),
        "hidden_layers": list(balance.hidden),
        "decision": None if one is None else {
            "element": one.element, "counted": one.counted, "by": one.by, "reason": one.reason,
            **({"date": one.date} if one.date else {}),
        },
        "items": [
            {
                "drawing": str(found.drawing[row]), "layer": str(found.layer[row]), "item": str(found.item[row]),
                "block": str(found.block[row]), "reading": str(found.reading[row]), "most": int(found.most[row]),
            }
            for row in balance.rows
        ],
    }  # fmt: skip


def _outcome(outcome: Outcome) -> dict[str, Any]:
    return {
        "rule": outcome.rule,
        "name": outcome.name,
        "scope": outcome.scope,
        "status": outcome.status.value,
        "checked": outcome.checked,
        "found": outcome.found,
        "otherwise": {"reading": outcome.otherwise[0], "found": outcome.otherwise[1]} if outcome.otherwise else None,
        "skipped": outcome.skipped,
        "set_aside": [
            {"item": one.item, "layer": one.layer, "rule": one.rule, "told": one.told} for one in outcome.aside
        ],
        "because": outcome.because.value,
        "requires": list(outcome.names),
        "helper": outcome.helper,
        "parameters": _parameters(outcome.parameters),
        "seconds": round(outcome.seconds, 3),
        "preview": outcome.preview,
    }


def _parameters(parameters: tuple[tuple[str, float, str], ...]) -> dict[str, Any]:
    return {name: {"value": number(value), "unit": unit} for name, value, unit in parameters}
