# SPDX-License-Identifier: MIT
"""Findings as the page lists them: by rule, numbered, with anchors that join list and drawing."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from foparq.columns import Index, Reals
from foparq.findings.outcome import Outcome
from foparq.findings.table import Findings, Severity
from foparq.model.drawing import Drawing
from foparq.report.page.drawing import marks_at
from foparq.report.places import found_by, pasted
from foparq.report.record import AuditRecord
from foparq.report.sentences import finding_sentences, outcome_scope, parameters_sentence, rule_meaning
from foparq.report.words import Words, printable

WRITTEN = 500  #: findings of one rule that the page lists
FIRST = 20  #: findings of one rule that stand unfolded, and that are printed unless all are asked for
IN_ALL = 3000  #: findings that the page lists before every rule gets less
RANK = {severity.value: rank for rank, severity in enumerate(Severity)}  #: 0 is gravest


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """All findings of one rule."""

    rule: str
    name: str
    severity: str  #: the gravest of its findings
    rows: Index  #: rows of the findings, gravest first
    shown: Index  #: those that are listed
    first: int  #: number of the first one listed
    outcomes: tuple[Outcome, ...]

    @property
    def found(self) -> int:
        """Findings counted; never less than those in the table."""
        return max(sum(outcome.found for outcome in self.outcomes), len(self.rows))


@dataclass(frozen=True, slots=True, kw_only=True)
class RowView:
    """One listed finding in one language."""

    number: int
    anchor: str
    mark: str  #: anchor of its mark in the drawing, or of the figure of its mesh; ``""`` if it has no place
    solid: int  #: number of the figure of its mesh; 0 if it is of a drawing, or its mesh is not shown
    plate: str  #: number of the plate that bears its number; ``""`` if none does
    place: str
    source: str
    layer: str
    handle: str
    inserts: tuple[str, ...]
    other: str
    size: str
    severity: str
    sentence: str
    waived: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class GroupView:
    """One rule with its findings in one language."""

    code: str
    name: str
    anchor: str
    severity: str
    title: str
    meaning: str
    mend: str
    found: str
    counted: int
    tallies: tuple[str, ...]
    tolerances: str
    preview: bool
    rows: tuple[RowView, ...]
    ways: tuple[tuple[str, str], ...]  #: how to get to the first item, in AutoCAD and in QGIS
    unlisted: str  #: how many are not listed; ``""`` if all are
    columns: frozenset[str]  #: columns that hold anything


def group_findings(record: AuditRecord) -> tuple[Group, ...]:
    """Findings by rule: faults before notes, the gravest and most frequent first."""
    findings = record.findings
    rank = np.fromiter((RANK[value] for value in findings.severity), dtype=np.intp, count=len(findings))
    by_rule = {code: np.flatnonzero(findings.rule == code) for code in sorted(set(findings.rule))}
    ordered = sorted(by_rule, key=lambda code: (rank[by_rule[code]].min(), -len(by_rule[code]), code))
    each = WRITTEN if len(findings) <= IN_ALL else min(WRITTEN, max(50, IN_ALL // len(ordered)))
    groups: list[Group] = []
    first = 1
    for code in ordered:
        rows = by_rule[code][np.argsort(rank[by_rule[code]], kind="stable")]
        shown = rows[:each]
        groups.append(
            Group(
                rule=code,
                name=str(findings.name[rows[0]]),
                severity=str(findings.severity[rows[0]]),
                rows=rows,
                shown=shown,
                first=first,
                outcomes=tuple(run for run in record.outcomes if run.rule == code),
            )
        )
        first += len(shown)
    return tuple(groups)


def shown_rows(groups: Sequence[Group]) -> Index:
    """Rows of the findings that the page lists, in the order of their numbers."""
    return np.concatenate([np.empty(0, dtype=np.intp), *(group.shown for group in groups)])


def anchors(findings: Findings, shown: Index) -> dict[int, str]:
    """Anchor of every listed finding: its key; a key that comes again gets an ordinal."""
    seen: dict[str, int] = {}
    named: dict[int, str] = {}
    for row in shown.tolist():
        key = "".join(c if c.isalnum() or c in "-_" else "-" for c in str(findings.key[row]))
        seen[key] = seen.get(key, 0) + 1
        named[row] = key if seen[key] == 1 else f"{key}-{seen[key]}"
    return named


@dataclass(frozen=True, slots=True, kw_only=True)
class Listing:
    """What the views of findings share between languages."""

    findings: Findings
    groups: tuple[Group, ...]
    names: dict[int, str]  #: row to anchor
    spots: Reals  #: (n, 3) place in file coordinates
    sheet: Reals  #: (n, 2) place of the mark, metres on the sheet
    drawings: dict[str, Drawing]
    ways: Callable[[Index], tuple[list[str], list[str]]]  #: how to find the items of some rows
    on_plate: Mapping[int, int] = field(default_factory=dict)  #: row to the plate that bears its number
    solids: Mapping[str, int] = field(default_factory=dict)  #: path of a mesh that is shown to the number of its figure


def listing_of(record: AuditRecord) -> Listing:
    """Findings grouped, numbered and placed."""
    groups = group_findings(record)
    findings = record.findings
    return Listing(
        findings=findings,
        groups=groups,
        names=anchors(findings, shown_rows(groups)),
        spots=findings.place,
        sheet=marks_at(findings.sheet),
        drawings={drawing.path: drawing for drawing in record.delivery.drawings},
        ways=partial(found_by, record),
    )


def group_view(words: Words, listing: Listing, group: Group, suffix: str) -> GroupView:
    """One rule and its findings for the page.

    Parameters
    ----------
    suffix : str
        What distinguishes the anchors of this language.
    """
    sentences = finding_sentences(words, listing.findings, group.shown)
    rows = tuple(
        _row_view(words, listing, row, group.first + n, suffix, sentences[n])
        for n, row in enumerate(group.shown.tolist())
    )
    many_files = len({row.source for row in rows}) > 1
    held = {name for name in ("place", "layer", "handle", "other") if any(getattr(row, name) for row in rows)}
    if many_files:
        held.add("source")
    # Where the size of all is the tolerance itself, nothing was measured: no end of a line is near.
    measured = np.any(listing.findings.size[group.shown] != listing.findings.limit[group.shown])
    if measured and any(row.size for row in rows):
        held.add("size")
    found = group.found
    unlisted = found - len(rows)
    return GroupView(
        code=group.rule,
        name=group.name,
        anchor=f"r-{group.rule}{suffix}",
        severity=group.severity,
        title=words(f"rules.{group.rule}.title"),
        meaning=rule_meaning(words, group.rule),
        mend=words(f"rules.{group.rule}.mend"),
        found=words.count(found),
        counted=found,
        tallies=tuple(tally(words, run, note=group.severity == Severity.NOTE) for run in group.outcomes if run.found),
        tolerances="; ".join(dict.fromkeys(parameters_sentence(words, run.parameters) for run in group.outcomes)),
        preview=any(run.preview for run in group.outcomes),
        rows=rows,
        ways=_ways(words, listing, group),
        unlisted=words("report.findings.unlisted", shown=words.count(len(rows)), total=words.count(found))
        if unlisted
        else "",
        columns=frozenset(held),
    )


def _ways(words: Words, listing: Listing, group: Group) -> tuple[tuple[str, str], ...]:
    ways = dict(
        zip(("cad", "qgis"), (next(filter(None, lines), "") for lines in listing.ways(group.shown)), strict=True)
    )
    return tuple((words(f"report.findings.find-{name}"), printable(line)) for name, line in ways.items() if line)


def tally(words: Words, run: Outcome, *, note: bool = False) -> str:
    """Findings over items checked, of one run: ``"fachada.dxf: 12 on 10 of 976 items (1.02 %)"``."""
    return words(
        f"report.findings.tally{'-note' if note else ''}"
        if run.checked and len(run.faulty)
        else "report.findings.tally-file",
        scope=outcome_scope(words, run),
        found=words.count(run.found),
        faulty=words.count(len(run.faulty)),
        checked=words.count(run.checked),
        rate=(len(run.faulty) / run.checked if run.checked else 0.0, "1"),
    )


def _row_view(words: Words, listing: Listing, row: int, number: int, suffix: str, sentence: str) -> RowView:
    findings = listing.findings
    name = listing.names[row]
    marked = bool(np.isfinite(listing.sheet[row]).all()) and findings.source[row] in listing.drawings
    solid = listing.solids.get(str(findings.source[row]), 0) if np.isfinite(listing.spots[row]).all() else 0
    mark = f"solid-{solid}{suffix}" if solid else f"m-{name}{suffix}" if marked else ""
    size = float(findings.size[row])
    counted_once = findings.unit[row] == "items" and size == 1
    return RowView(
        number=number,
        anchor=f"f-{name}{suffix}",
        mark=mark,
        solid=solid,
        plate=str(listing.on_plate.get(row, "")),
        place=_place(listing, row),
        source=printable(str(findings.source[row])),
        layer=printable(str(findings.layer[row])),
        handle=printable(str(findings.item[row] or findings.handle[row])),
        inserts=tuple(printable(part) for part in str(findings.inserts[row]).split("/") if part),
        other=_named(str(findings.other[row]), str(findings.other_layer[row])),
        size="" if counted_once or not np.isfinite(size) else words.quantity(size, str(findings.unit[row])),
        severity=str(findings.severity[row]),
        sentence=sentence,
        waived=bool(findings.waived[row]),
    )


def _named(item: str, layer: str) -> str:
    """An item with its layer: ``"175 (REBOCO)"``; ``""`` for none."""
    return f"{printable(item)} ({printable(layer)})" if item and layer else printable(item)


def _place(listing: Listing, row: int) -> str:
    drawing = listing.drawings.get(str(listing.findings.source[row]))
    return pasted(listing.spots[row], drawing.unit.metres if drawing is not None else None)
