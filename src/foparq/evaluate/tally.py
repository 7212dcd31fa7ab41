# SPDX-License-Identifier: MIT
"""Counts over the outcomes of named rules: faulty features, found faults, and out of how many."""

import json
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foparq.columns import Index, union
from foparq.evaluate.evidence import Evidence, Judgement, judged, unseen
from foparq.evaluate.measures import measure_counting
from foparq.evaluate.quality import ElementStatus, Reason, because, some
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, Status
from foparq.profile.elements import ElementSpec

#: reasons that speak of a whole file
OF_FILES = frozenset({
    Because.UNIT_UNKNOWN, Because.UNIT_ANGLE, Because.CRS_UNFIT, Because.UNIT_DOUBTFUL, Because.UNIT_CONTRADICTED,
    Because.PLANE_DOUBTFUL, Because.PLANE_CONTRADICTED,
})  # fmt: skip
_ITEMS = 10  #: items that a reason names


@dataclass(frozen=True, slots=True, kw_only=True)
class Tally:
    """What the named rules found, over all drawings. Rules in preview are left out."""

    checked: int  #: features: of each drawing, the most that one of the rules looked at or set aside, less the small
    faulty: int  #: distinct features at fault
    aside: int  #: features that one of the rules did not judge, and none of them found at fault
    found: int  #: faults
    unrun: int  #: features of drawings on which none of the rules ran
    small: int  #: features too small to be seen, and not at fault: no part of the features checked
    again: int  #: features that only repeat what another layer draws, and not at fault: likewise
    extent: (
        tuple[float, float] | None
    )  #: length of what is at fault, and of all linework, metres; ``None`` if it has none
    undeclared: tuple[tuple[str, tuple[str, ...]], ...]  #: path, and layers that look like a coverage nobody declares
    parts: tuple[tuple[str, float, float], ...]  #: path, faulty, checked: of each drawing, where there are several
    rules: tuple[tuple[str, float, float], ...]  #: name, faults, features checked
    absent: tuple[str, ...]  #: named rules that were not part of the audit
    preview: tuple[str, ...]  #: named rules that found something and may not reject yet
    broken: tuple[tuple[Because, tuple[str, ...]], ...]  #: why rules did not run, and where: files, or rules with files
    unjudged: tuple[str, ...]  #: items that were set aside: ``"2A (PAREDE)"``
    unfit: tuple[str, ...]  #: those of them that no rule found at fault


def tally(evidence: Evidence, names: Sequence[str]) -> Tally:
    """Count over the outcomes of some rules.

    A rule may be bound several times to one drawing, to different layers: its numbers are added, but never beyond the
    features of the drawing.

    A feature too small to be seen at the scale counts only if it is at fault: strokes that nobody sees must not dilute
    the rate.

    Parameters
    ----------
    names : sequence of str
        Names of rules.
    """
    named = [outcome for outcome in evidence.outcomes if outcome.name in names and not outcome.helper]
    counted = [outcome for outcome in named if not outcome.preview]
    sources = sorted({outcome.source for outcome in evidence.outcomes})
    sizes = {part.path: part.features for part in evidence.delivery.parts}
    parts = [_of_part(source, counted, sizes.get(source)) for source in sources]
    told = [(source, float(part.faulty), float(part.checked)) for source, part in zip(sources, parts, strict=True)]
    broken: dict[Because, set[str]] = defaultdict(set)
    for outcome in counted:
        if outcome.because.opens:
            broken[outcome.because].add(where_broken(outcome))
    return Tally(
        checked=sum(part.checked for part in parts),
        faulty=sum(part.faulty for part in parts),
        aside=sum(part.aside for part in parts),
        found=sum(outcome.found for outcome in counted),
        unrun=sum(part.unrun for part in parts),
        small=sum(part.small for part in parts),
        again=sum(part.again for part in parts),
        extent=_extent(evidence, counted),
        undeclared=tuple(sorted({(one.source, one.undeclared) for one in counted if one.undeclared})),
        parts=tuple(row for row in told if row[2]) if len(told) > 1 else (),
        rules=tuple(_rule(name, counted, sizes) for name in names if any(outcome.name == name for outcome in counted)),
        absent=tuple(name for name in names if not any(outcome.name == name for outcome in named)),
        preview=tuple(name for name in names if any(o.name == name and o.preview and o.found for o in named)),
        broken=tuple((why, tuple(sorted(broken[why]))) for why in sorted(broken)),
        unjudged=_items(counted, unfit=False),
        unfit=_items(counted, unfit=True),
    )


def where_broken(outcome: Outcome) -> str:
    """What a reason names: the file, and the rule where it is the rule's own matter."""
    names = f" ({', '.join(outcome.names)})" if outcome.names else ""
    if outcome.because in OF_FILES:
        return f"{outcome.source}{names}"
    return f"{outcome.name}{names} · {outcome.source}"


def _items(outcomes: Sequence[Outcome], *, unfit: bool) -> tuple[str, ...]:
    """Items that were set aside, with their layers; of those that rules name."""
    return tuple(
        dict.fromkeys(
            f"{one.item} ({one.layer})" for outcome in outcomes for one in outcome.aside if not unfit or one.open
        )
    )


def broken_reasons(found: Tally, name: str) -> tuple[Reason, ...]:
    """Why rules did not run, as reasons; crashes first."""
    rows = sorted(found.broken, key=lambda row: row[0] is not Because.CRASHED)
    return tuple(because(f"checks.{reason}", element=name, files=list(files)) for reason, files in rows)


def unfit_remark(found: Tally, name: str) -> tuple[Reason, ...]:
    """Items that the rules could not work with and nobody found at fault, as a remark."""
    if not found.unfit:
        return ()
    return (because("checks.unfit", element=name, items=some(found.unfit, _ITEMS), n=len(found.unfit)),)


def undeclared_reasons(found: Tally, name: str) -> tuple[Reason, ...]:
    """Layers that look like a coverage and are not declared as one, with the line of the manifest that does."""
    return tuple(
        because("checks.undeclared", element=name, file=path, line=f"areas = {json.dumps(layers, ensure_ascii=False)}")
        for path, layers in found.undeclared
    )


def judge_nothing(spec: ElementSpec, evidence: Evidence, found: Tally) -> Judgement:
    """Status of an element whose rules checked nothing at all: never a pass."""
    if broken := broken_reasons(found, spec.id):
        return judged(ElementStatus.UNDECIDED, *broken)
    if undeclared := undeclared_reasons(found, spec.id):
        return judged(ElementStatus.NOT_ASSESSED, *undeclared, *unseen(evidence, spec.id))
    if found.small:
        small = because("checks.too-small", element=spec.id, n=found.small)
        return judged(ElementStatus.NOT_ASSESSED, small, *unseen(evidence, spec.id))
    if not evidence.outcomes:
        why = because("checks.no-drawing", element=spec.id)
    elif found.absent and not found.rules:
        why = because("checks.absent", element=spec.id, rules=list(found.absent))
    else:
        why = because("checks.nothing", element=spec.id)
    return judged(ElementStatus.NOT_ASSESSED, why, *unseen(evidence, spec.id))


def iso_counts(found: Tally) -> tuple[tuple[str, float, str], ...]:
    """Parameters ``measure-23`` ...: counts that have a measure of their own in ISO 19157."""
    rows = []
    for name, faults, _ in found.rules:
        measure = measure_counting(name)
        if measure is not None:
            rows.append((f"measure-{measure.id}", faults, "items"))
    return tuple(rows)


@dataclass(frozen=True, slots=True)
class _Part:
    checked: int
    faulty: int
    aside: int
    unrun: int
    small: int
    again: int


def _of_part(source: str, counted: Sequence[Outcome], size: int | None) -> _Part:
    here = [outcome for outcome in counted if outcome.source == source]
    rows = _distinct(outcome.faulty for outcome in here)
    small = _sound(rows, here)
    again = np.setdiff1d(_distinct(outcome.again for outcome in here), union(rows, small), assume_unique=True)
    seen = max(
        (_seen([one for one in here if one.name == name], rows) for name in {one.name for one in here}), default=0
    )
    checked = max(len(rows), (seen if size is None else min(seen, size - len(small))) - len(again))
    unjudged = np.setdiff1d(_distinct(outcome.unjudged for outcome in here), rows, assume_unique=True)
    ran = any(outcome.status in {Status.CLEAN, Status.FAULTY} for outcome in here)
    idle = all(outcome.because is Because.NOTHING for outcome in here)
    unrun = 0 if ran or idle else max(0, (size or 0) - checked)
    return _Part(checked, len(rows), len(unjudged), unrun, len(small), len(again))


def _seen(mine: Sequence[Outcome], faulty: Index) -> int:
    """Features that one rule looked at, knew by a copy or set aside, without those that nobody can see."""
    return sum(outcome.checked + len(outcome.again) + outcome.skipped for outcome in mine) - len(_sound(faulty, mine))


def _sound(faulty: Index, outcomes: Sequence[Outcome]) -> Index:
    """(k,) rows too small to be seen that are not at fault."""
    small: Index = np.setdiff1d(_distinct(outcome.small for outcome in outcomes), faulty, assume_unique=True)
    return small


def _extent(evidence: Evidence, counted: Sequence[Outcome]) -> tuple[float, float] | None:
    """Length at fault and in all, of the drawings on which one of the rules ran."""
    faulty = whole = 0.0
    for part in evidence.delivery.parts:
        here = [one for one in counted if one.source == part.path and one.status in {Status.CLEAN, Status.FAULTY}]
        size = part.extent(part.rows) if here else None
        if size is not None:
            whole += size
            faulty += part.extent(_distinct(outcome.faulty for outcome in here)) or 0.0
    return (faulty, whole) if whole else None


def _distinct(columns: Iterable[Index]) -> Index:
    """(k,) distinct rows of a part's items."""
    rows = union(*columns)
    items: Index = rows[rows >= 0]
    return items


def _rule(name: str, counted: Sequence[Outcome], sizes: Mapping[str, int]) -> tuple[str, float, float]:
    mine = [outcome for outcome in counted if outcome.name == name]
    checked = 0
    for source in sorted({outcome.source for outcome in mine}):
        here = [outcome for outcome in mine if outcome.source == source]
        seen = sum(outcome.checked for outcome in here)
        small = _sound(_distinct(outcome.faulty for outcome in here), here)
        seen -= len(np.setdiff1d(small, _distinct(outcome.unjudged for outcome in here), assume_unique=True))
        checked += min(seen, sizes.get(source, seen))
    return name, float(sum(outcome.found for outcome in mine)), float(checked)
