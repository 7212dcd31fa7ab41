# SPDX-License-Identifier: MIT
"""Findings as columns and rows of plain values, with their sentences."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from foparq.columns import Index, Reals
from foparq.findings.table import Findings
from foparq.report.places import found_by, pasted
from foparq.report.record import AuditRecord
from foparq.report.sentences import finding_sentences
from foparq.report.words import Words

#: of ``findings.jsonl`` and of the CSV, in order
COLUMNS = (
    "key", "rule", "name", "severity", "source", "layer", "item", "handle", "inserts", "other", "other_layer", "where",
    "size", "unit", "limit", "message", "waived", "paste", "cad", "qgis",
)  # fmt: skip


def written_rows(record: AuditRecord) -> Index:
    """Rows of the findings that are written in full: at most ``record.written`` of each rule."""
    table = record.findings
    if len(table) <= record.written:
        return np.arange(len(table))
    kept = [np.flatnonzero(table.rule == code)[: record.written] for code in np.unique(table.rule.astype(str))]
    return np.sort(np.concatenate(kept))


def finding_columns(record: AuditRecord, words: Words | None = None) -> dict[str, Sequence[Any]]:
    """Findings as columns of JSON values, those that are written in full.

    Parameters
    ----------
    words : Words, optional
        Language of the sentences; that of the record if left out.

    Returns
    -------
    dict
        ``COLUMNS`` in order. ``where`` is ``[x, y, z]`` in file coordinates; ``None`` for what is not finite. ``paste``
        is the same place as CAD takes it; ``cad`` and ``qgis`` find the item in AutoCAD and QGIS.
    """
    table, rows = record.findings, written_rows(record)
    metres = record.delivery.metres
    sources = table.source[rows].tolist()
    places = zip(table.place[rows].tolist(), sources, strict=True)
    cad, qgis = found_by(record, rows)
    made: dict[str, Sequence[Any]] = {
        "where": _points(table.place[rows]),
        "other": [other or None for other in table.other[rows].tolist()],
        "other_layer": [layer if other else None for other, layer in zip(*_others(table, rows), strict=True)],
        "size": _numbers(table.size[rows]),
        "limit": _numbers(table.limit[rows]),
        "message": finding_sentences(words or Words(record.language), table, rows),
        "paste": [pasted(place, metres.get(source)) for place, source in places],
        "cad": cad,
        "qgis": qgis,
        "waived": table.waived[rows].astype(bool).tolist(),
    }
    return {name: made[name] if name in made else getattr(table, name)[rows].tolist() for name in COLUMNS}


def _others(table: Findings, rows: Index) -> tuple[list[str], list[str]]:
    """Second items and their layers; ``""`` where a finding has none."""
    return table.other[rows].tolist(), table.other_layer[rows].tolist()


def finding_rows(record: AuditRecord, words: Words | None = None) -> Iterator[dict[str, Any]]:
    """The same as rows."""
    columns = finding_columns(record, words)
    return (dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True))


def number(value: float) -> float | None:
    """Number as JSON knows it."""
    return float(value) if math.isfinite(value) else None


def _numbers(column: Reals) -> list[float | None]:
    return [number(value) for value in column.tolist()]


def _points(spots: Reals) -> list[list[float] | None]:
    placed = np.isfinite(spots[:, 0]).tolist()
    return [
        [round(value, 9) for value in spot] if there else None
        for spot, there in zip(np.nan_to_num(spots).tolist(), placed, strict=True)
    ]
