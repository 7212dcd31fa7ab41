# SPDX-License-Identifier: MIT
"""Specified against drawn features on the page: the table, and the outlines on the drawing."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from foparq.columns import Geometries, Reals
from foparq.evaluate.quality import QualityReport
from foparq.findings.counts import Reading
from foparq.names import folded, of_kind
from foparq.report.balances import BalanceRow, balance_note, balance_rows, may_differ
from foparq.report.words import Words

TONES = 6  #: colours of outlines; further classes begin again
_OUTLINES = 5_000  #: outlines of one drawing that are shown
_NUMBERED = 200  #: features of one class that are numbered for a person to count


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
    path: str  #: path data of what is drawn of them, in cells
    decided: str = ""  #: how many there are, where a person decided it


def completeness_view(words: Words, quality: QualityReport) -> CompletenessView | None:
    """The section on completeness; none where nothing was compared."""
    rows = balance_rows(words, quality)
    return CompletenessView(rows=rows, note=balance_note(words, quality)) if rows else None


def outline_paths(drawing: str, quality: QualityReport, path: Callable[[Geometries], str]) -> tuple[OutlinePath, ...]:
    """What is drawn of the features found in one drawing, by class.

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
                        path=path(found.lines[rows]), decided=_decided(quality, kind),
                    )
                )  # fmt: skip
    return tuple(made)


def _decided(quality: QualityReport, kind: str) -> str:
    """How many features persons decided that there are of a class; ``""`` where nobody did of every facade."""
    of_kind_ = [one.decision for one in quality.balances if of_kind(one.feature_class) == kind]
    counted = [one.counted for one in of_kind_ if one is not None]
    return str(sum(counted)) if counted and len(counted) == len(of_kind_) else ""


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureNumber:
    """Number of one feature of a class that is to be counted by a person, cells."""

    x: float
    y: float
    text: str
    reading: str  #: as of :class:`OutlinePath`


def feature_numbers(drawing: str, quality: QualityReport, cells: Callable[[Reals], Reals]) -> tuple[FeatureNumber, ...]:
    """Numbers of the features of those classes that a person has to count, from left to right; parts after the rest.

    Parameters
    ----------
    cells : callable
        Cells (n, 2) of points on the sheet, metres.
    """
    found, made = quality.found, []
    for balance in (one for one in quality.balances if may_differ(one)):
        rows = np.array([row for row in balance.rows if found.drawing[row] == drawing], dtype=np.intp)
        if not 0 < len(rows) <= _NUMBERED:
            continue
        boxes = shapely.bounds(found.sheet[rows])
        counted = found.reading[rows] == Reading.COUNTED
        # Of a part below on the right, where the number of what holds it does not stand.
        corner = np.where(counted[:, np.newaxis], boxes[:, [0, 3]], boxes[:, [2, 1]])
        order = np.lexsort((boxes[:, 1], np.round(boxes[:, 0], 2), ~counted))
        for n, row in enumerate(order.tolist(), start=1):
            x, y = cells(corner[row : row + 1])[0]
            reading = "counted" if counted[row] else "open"
            made.append(FeatureNumber(x=float(x), y=float(y), text=str(n), reading=reading))
    return tuple(made)
