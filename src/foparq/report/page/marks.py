# SPDX-License-Identifier: MIT
"""Marks on the drawing, one a listed finding, joined to its row in the list."""

from dataclasses import dataclass

import numpy as np

from foparq.findings.table import Findings
from foparq.report.page.drawing import Picture
from foparq.report.page.findings import RANK, Listing
from foparq.report.sentences import finding_sentences
from foparq.report.words import Words


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkView:
    """One mark on one drawing in one language."""

    anchor: str
    row: str  #: anchor of the row in the list
    number: int
    severity: str
    x: int  #: cells
    y: int
    window: int  #: half the width of the view that shows it well, cells
    title: str


def mark_views(words: Words, listing: Listing, picture: Picture, suffix: str) -> tuple[MarkView, ...]:
    """Marks of one drawing, notes first so that faults lie on top."""
    findings = listing.findings
    numbered = [(group.first + n, row) for group in listing.groups for n, row in enumerate(group.shown.tolist())]
    mine = [(number, row) for number, row in numbered if _has_mark(listing, picture, row)]
    rows = np.array([row for _, row in mine], dtype=np.intp)
    sentences = dict(zip(rows.tolist(), finding_sentences(words, findings, rows), strict=True))
    marks = []
    for number, row in sorted(mine, key=lambda pair: (-RANK[findings.severity[pair[1]]], pair[0])):
        x, y = picture.cells(listing.sheet[row : row + 1])[0]
        name = listing.names[row]
        title = words(
            "report.drawing.mark",
            number=words.count(number),
            rule=words(f"rules.{findings.rule[row]}.title"),
            layer=findings.layer[row] or "–",
            sentence=sentences[row],
        )
        marks.append(
            MarkView(
                anchor=f"m-{name}{suffix}",
                row=f"f-{name}{suffix}",
                number=number,
                severity=str(findings.severity[row]),
                x=int(x),
                y=int(y),
                window=_window(findings, picture, row),
                title=title,
            )
        )
    return tuple(marks)


def _has_mark(listing: Listing, picture: Picture, row: int) -> bool:
    return listing.findings.source[row] == picture.drawing.path and bool(np.isfinite(listing.sheet[row]).all())


def _window(findings: Findings, picture: Picture, row: int) -> int:
    left, low, right, high = findings.sheet[row].bounds
    size = float(findings.size[row]) if findings.unit[row] == "m" and np.isfinite(findings.size[row]) else 0.0
    half = max(1.5 * max(right - left, high - low), 25 * size, picture.width * picture.quantum / 400)
    return min(int(np.ceil(half / picture.quantum)), picture.width // 2)
