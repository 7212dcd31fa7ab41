# SPDX-License-Identifier: MIT
"""Counts over the outcomes of named rules: faulty features, found faults, and out of how many."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foparq.columns import Index
from foparq.evaluate.evidence import Evidence, Judgement, judged, unseen
from foparq.evaluate.measures import measure_counting
from foparq.evaluate.quality import ElementStatus, Reason, because
from foparq.findings.outcome import Outcome, Status
from foparq.model.drawing import Drawing
from foparq.model.items import Role
from foparq.profile.schema import ElementSpec

#: why a rule did not run, and its sentence
_BROKEN = {
    "crashed": "checks.crashed", "unit-unknown": "checks.unit-unknown", "unit-doubtful": "checks.unit-doubtful",
    "plane-doubtful": "checks.plane-doubtful",
}  # fmt: skip
NOTHING = "nothing-to-check"  #: the rule has nothing to look at: no fault can hide there


@dataclass(frozen=True, slots=True, kw_only=True)
class Tally:
    """What the named rules found, over all drawings. Rules in preview are left out."""

    checked: int  #: features: of each drawing, the most that one of the rules looked at or set aside
    faulty: int  #: distinct features at fault
    aside: int  #: at most so many features were set aside for faults that the named rules do not count
    found: int  #: faults
    unrun: int  #: features of drawings on which none of the rules ran
    rules: tuple[tuple[str, float, float], ...]  #: name, faults, features checked
    absent: tuple[str, ...]  #: named rules that were not part of the audit
    preview: tuple[str, ...]  #: named rules that found something and may not reject yet
    broken: tuple[tuple[str, tuple[str, ...]], ...]  #: why rules did not run, and the drawings


def tally(evidence: Evidence, names: Sequence[str]) -> Tally:
    """Count over the outcomes of some rules.

    A rule may be bound several times to one drawing, to different layers: its numbers are added, but never beyond the
    features of the drawing.

    Parameters
    ----------
    evidence : Evidence
    names : sequence of str
        Names of rules.

    Returns
    -------
    Tally
    """
    named = [outcome for outcome in evidence.outcomes if outcome.name in names]
    counted = [outcome for outcome in named if not outcome.preview]
    sources = sorted({outcome.source for outcome in evidence.outcomes})
    sizes = {drawing.path: _features(drawing) for drawing in evidence.delivery.drawings}
    parts = [_of_drawing(evidence, source, counted, sizes.get(source)) for source in sources]
    broken: dict[str, set[str]] = defaultdict(set)
    for outcome in counted:
        if outcome.status is Status.CRASHED:
            broken["crashed"].add(f"{outcome.name} ({outcome.source})")
        elif outcome.status is Status.NOT_RUN and outcome.because != NOTHING:
            broken[outcome.because].add(outcome.source)
    return Tally(
        checked=sum(part.checked for part in parts),
        faulty=sum(part.faulty for part in parts),
        aside=sum(part.aside for part in parts),
        found=sum(outcome.found for outcome in counted),
        unrun=sum(part.unrun for part in parts),
        rules=tuple(_rule(name, counted, sizes) for name in names if any(outcome.name == name for outcome in counted)),
        absent=tuple(name for name in names if not any(outcome.name == name for outcome in named)),
        preview=tuple(name for name in names if any(o.name == name and o.preview and o.found for o in named)),
        broken=tuple((why, tuple(sorted(broken[why]))) for why in sorted(broken)),
    )


def broken_reasons(found: Tally, name: str) -> tuple[Reason, ...]:
    """Why rules did not run, as reasons; crashes first."""
    rows = sorted(found.broken, key=lambda row: row[0] != "crashed")
    return tuple(because(_BROKEN.get(why, "checks.not-run"), element=name, files=list(files)) for why, files in rows)


def judge_nothing(spec: ElementSpec, evidence: Evidence, found: Tally) -> Judgement:
    """Status of an element whose rules checked nothing at all: never a pass."""
    if broken := broken_reasons(found, spec.id):
        return judged(ElementStatus.UNDECIDED, *broken)
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


def _of_drawing(evidence: Evidence, source: str, counted: Sequence[Outcome], size: int | None) -> _Part:
    here = [outcome for outcome in counted if outcome.source == source]
    seen: dict[str, int] = defaultdict(int)
    aside: dict[str, int] = defaultdict(int)
    for outcome in here:
        seen[outcome.name] += outcome.checked + outcome.skipped
        aside[outcome.name] += outcome.skipped
    rows = _rows(here)
    checked = max(seen.values(), default=0)
    checked = max(len(rows), checked if size is None else min(checked, size))
    most = max(aside.values(), default=0)
    any_fault = _rows([outcome for outcome in evidence.outcomes if outcome.source == source])
    others = len(np.setdiff1d(any_fault, rows, assume_unique=True))
    # Features set aside were found faulty by a rule that is required, or cannot be held by the input.
    uncounted = min(max(min(most, others), most - len(rows)), checked - len(rows))
    ran = any(outcome.status in {Status.CLEAN, Status.FAULTY} for outcome in here)
    idle = all(outcome.because == NOTHING for outcome in here)
    return _Part(checked, len(rows), uncounted, 0 if ran or idle else max(0, (size or 0) - checked))


def _rows(outcomes: Sequence[Outcome]) -> Index:
    """(k,) distinct rows of a drawing at fault by any of the outcomes."""
    rows = np.unique(np.concatenate([np.empty(0, dtype=np.intp), *(outcome.faulty for outcome in outcomes)]))
    at_fault: Index = rows[rows >= 0]
    return at_fault


def _features(drawing: Drawing) -> int:
    """Items of a drawing that rules may look at."""
    items = drawing.items
    return int(np.count_nonzero(~items.paper & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT])))


def _rule(name: str, counted: Sequence[Outcome], sizes: Mapping[str, int]) -> tuple[str, float, float]:
    mine = [outcome for outcome in counted if outcome.name == name]
    checked = 0
    for source in sorted({outcome.source for outcome in mine}):
        seen = sum(outcome.checked for outcome in mine if outcome.source == source)
        checked += min(seen, sizes.get(source, seen))
    return name, float(sum(outcome.found for outcome in mine)), float(checked)
