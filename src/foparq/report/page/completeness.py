# SPDX-License-Identifier: MIT
"""Specified against drawn features on the page: the table, and the outlines on the drawing."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from foparq.columns import Geometries
from foparq.evaluate.quality import QualityReport
from foparq.findings.counts import Reading
from foparq.names import folded, of_kind
from foparq.report.balances import BalanceRow, balance_note, balance_rows
from foparq.report.words import Words

TONES = 6  #: colours of outlines; further classes begin again
_OUTLINES = 5_000  #: outlines of one drawing that are shown


@dataclass(frozen=True, slots=True, kw_only=True)
class CompletenessView:
    """The section on completeness in one language."""

    rows: tuple[BalanceRow, ...]
    note: str


@dataclass(frozen=True, slots=True, kw_only=True)
class OutlinePath:
    """Outlines of one class on one drawing, of one reading."""

    label: str  #: class, as the list spells it
    tone: int  #: from 0
    reading: str  #: ``counted`` or ``open``: a part, or a copy
    count: int
    path: str  #: path data, in cells


def completeness_view(words: Words, quality: QualityReport) -> CompletenessView | None:
    """The section on completeness; none where nothing was compared."""
    rows = balance_rows(words, quality)
    return CompletenessView(rows=rows, note=balance_note(words, quality)) if rows else None


def outline_paths(drawing: str, quality: QualityReport, path: Callable[[Geometries], str]) -> tuple[OutlinePath, ...]:
    """Outlines of the features found in one drawing, by class.

    Parameters
    ----------
    drawing : str
        Its path.
    path : callable
        Path data of geometries on the sheet, metres.
    """
    found = quality.found
    mine = np.flatnonzero(found.drawing == drawing)[:_OUTLINES]
    kinds = [of_kind(str(name)) for name in found.feature_class[mine]]
    order = sorted({of_kind(str(name)) for name in found.feature_class})
    shown = {of_kind(one.feature_class): one.feature_class for one in reversed(quality.balances)}
    made = []
    for kind in sorted(set(kinds), key=folded):
        of = mine[np.array([other == kind for other in kinds], dtype=bool)]
        counted = found.reading[of] == Reading.COUNTED
        for reading, rows in (("counted", of[counted]), ("open", of[~counted])):
            if len(rows):
                label = shown.get(kind, str(found.feature_class[rows[0]]))
                made.append(
                    OutlinePath(
                        label=label, tone=order.index(kind) % TONES, reading=reading, count=len(rows),
                        path=path(found.sheet[rows]),
                    )
                )  # fmt: skip
    return tuple(made)
