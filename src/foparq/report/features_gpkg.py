# SPDX-License-Identifier: MIT
"""``features_a`` of ``findings.gpkg``: what was counted as features, as outlines."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Geometries, Texts
from foparq.evaluate.quality import ClassBalance
from foparq.report.record import AuditRecord
from foparq.report.sheets_gpkg import Layout
from foparq.report.words import Words, printable

LAYER = "features_a"


def features_layer(record: AuditRecord, layout: Layout) -> tuple[str, Geometries, str, dict[str, NDArray[Any]]]:
    """Name, outlines, type of geometry and columns of the layer.

    Columns are ``class``, ``facade``, ``reading`` in words, ``code`` (counted, part or copy), ``most`` features that
    the outline may be, ``featid``, ``layer``, ``block``, ``source``, and of its class and facade ``required``,
    ``found``, ``missing`` and ``ids``.
    """
    words, found = Words(record.language), record.quality.found
    of_row = {row: balance for balance in record.quality.balances for row in balance.rows}
    balances = [of_row.get(row) for row in range(len(found))]
    readings = {code: words(f"report.balance.code.{code}") for code in set(found.reading.tolist())}
    columns: dict[str, NDArray[Any]] = {
        "class": _texts(found.feature_class),
        "facade": _texts(found.facade),
        "reading": _texts([readings[code] for code in found.reading]),
        "code": _texts(found.reading),
        "most": found.most.astype(np.int64),
        "featid": _texts(found.item),
        "layer": _texts(found.layer),
        "block": _texts(found.block),
        "source": _texts(found.drawing),
        "required": np.array([one.required if one else 0 for one in balances], dtype=np.int64),
        "found": _texts([_range(one, "found") for one in balances]),
        "missing": _texts([_range(one, "missing") for one in balances]),
        "ids": _texts([", ".join(one.ids) if one else "" for one in balances]),
    }
    return LAYER, layout.shown(found.drawing, found.outline, found.sheet), "Polygon", columns


def _range(balance: ClassBalance | None, name: str) -> str:
    if balance is None:
        return ""
    least, most = getattr(balance, name)
    return f"{least}" if least == most else f"{least}–{most}"


def _texts(column: Texts | list[str]) -> Texts:
    texts: Texts = np.empty(len(column), dtype=object)
    texts[:] = [printable(str(value)) for value in column]
    return texts
