# SPDX-License-Identifier: MIT
"""Run the rules of a profile on one part of a delivery, whatever its kind.

A crash of a rule is ours: it becomes an outcome ``crashed`` with its traceback in the log, never a finding.
"""

import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from foparq.check.bounds import Bounded, Broken, budget_of, unbounded
from foparq.check.calls import Call, Judged, calls_of, judged, missing
from foparq.check.registry import all_rules, in_order
from foparq.check.rule import Rule
from foparq.check.subject import Subject, kind_of_subject
from foparq.check.told import findings_of
from foparq.columns import union
from foparq.findings.because import Because
from foparq.findings.hits import NOBODY, Deviations, Hits
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Findings, Severity, join_findings
from foparq.model.part import Part
from foparq.profile.schema import CheckSpec, Profile

Progress = Callable[[str], None]
Check = tuple[Rule, CheckSpec]


@dataclass(frozen=True, slots=True, kw_only=True)
class Checked:
    """What the rules found on one part."""

    outcomes: tuple[Outcome, ...]
    findings: Findings
    log: tuple[str, ...]  #: tracebacks of what crashed


@dataclass(frozen=True, slots=True)
class Begun:
    """A call that is about to run."""

    check: int  #: number of the check in its order
    outcome: Outcome  #: what is known of it before


@dataclass(frozen=True, slots=True)
class Result:
    """What one call came to."""

    check: int
    outcome: Outcome
    findings: Findings | None = None
    trace: str = ""  #: of a crash


def check_part(
    part: Part, profile: Profile, scale: float | None, progress: Progress | None = None, bounded: Bounded = unbounded
) -> Checked:
    """Run every check of the profile on one part.

    Parameters
    ----------
    profile : Profile
        Its checks must be valid, see :func:`foparq.check.validate.validate_checks`.
    scale : float or None
        Denominator of the drawing scale.
    progress : callable, optional
        Told the name of each rule before it runs.
    bounded : Bounded
        Keeps the rules within the bounds of the profile. A rule that exceeds them is not run, the others are.

    Returns
    -------
    Checked
        Outcomes in order of rules, findings in their defined order.
    """
    results: list[Result] = []
    spent = 0.0
    unready = _prepared(part)
    while True:
        budget = budget_of(part, profile.limits, spent)
        begun: Begun | None = None
        broken: Broken | None = Broken(Because.LIMIT) if budget.seconds == 0 else None
        run = bounded(results_of, (part, profile, scale, tuple(results)), budget) if broken is None else ()
        for event in run:
            if isinstance(event, Result):
                results.append(event)
                spent += event.outcome.seconds
                begun = None
            elif isinstance(event, Begun):
                begun = event
                if progress is not None:
                    progress(event.outcome.name)
            else:
                broken = event if isinstance(event, Broken) else broken
        if broken is None:
            break
        spent += budget.at_once
        if begun is None:  # nothing more can be run: not even the inputs could be made
            results.extend(_rest(part, profile, results, broken))
            break
        results.append(Result(begun.check, _broken(begun.outcome, broken), trace=broken.trace))
    return _joined(results, unready)


def _prepared(part: Part) -> str:
    """Make ready what the rules on a part need; the trace of what went wrong, which these rules will meet again."""
    kind = kind_of_subject(part)
    try:
        if kind is not None:
            kind.prepare()
    except Exception:  # noqa: BLE001 - our fault: the rules that need it crash and are told
        return f"{part.path}\n{traceback.format_exc()}"
    return ""


def results_of(part: Part, profile: Profile, scale: float | None, done: Sequence[Result]) -> Iterator[Begun | Result]:
    """Calls of all checks on one part, one after the other, beyond those that are done."""
    rules = all_rules()
    try:
        subject = _subject(part, profile)
    except Exception:  # noqa: BLE001 - whatever goes wrong here is our fault and must not end the audit
        yield from _rest(part, profile, done, Broken(Because.CRASHED, f"{part.path}\n{traceback.format_exc()}"))
        return
    outcomes = [result.outcome for result in done]
    before = len(done)
    for n, (rule, spec) in enumerate(_checks(part, profile)):
        for call in _calls(rule, spec, scale, subject, profile):
            if before:
                before -= 1
                continue
            outcome = _before(call.rule, call.spec, part, call.scope(part.path))
            outcome = replace(outcome, about_file=subject.states(rule.subject))
            yield Begun(n, outcome)
            result = _run(n, call, outcome, subject, outcomes, rules, profile.least_seen(scale))
            outcomes.append(result.outcome)
            yield result


def _subject(part: Part, profile: Profile) -> Subject:
    kind = kind_of_subject(part)
    if kind is None:
        raise TypeError(f"no subject is declared for {type(part).__name__}")
    return kind(part, profile)


def _checks(part: Part, profile: Profile) -> list[Check]:
    """Checks that concern a part: every rule after those it requires, and those that its subject reads first."""
    rules, kind = all_rules(), kind_of_subject(part)
    by_name = {rule.name: rule for rule in rules.values()}
    checks = [(by_name[spec.rule], spec) for spec in profile.checks]
    order = {code: n for n, code in enumerate(in_order({rule.code for rule, _ in checks}))}
    leading = kind.leading if kind else ()
    ordered = sorted(checks, key=lambda check: (check[0].name not in leading, order[check[0].code]))
    return [check for check in ordered if kind is None or kind.knows(check[0].subject)]


def _calls(rule: Rule, spec: CheckSpec, scale: float | None, subject: Subject, profile: Profile) -> list[Call]:
    common = profile.linework.tolerances
    try:
        return calls_of(rule, spec, scale, subject, common)
    except Exception:  # noqa: BLE001 - the call meets the same again, where it is told
        return [Call(rule, spec, (spec.layers,) * len(rule.inputs), scale, common)]


def _before(rule: Rule, spec: CheckSpec, part: Part, scope: str) -> Outcome:
    return Outcome(
        rule=rule.code, name=rule.name, scope=scope, source=part.path, status=Status.NOT_RUN, checked=0, found=0,
        faulty=np.empty(0, dtype=np.intp), preview=rule.preview, helper=spec.helper,
        counts=not (rule.preview or spec.helper or spec.severity is Severity.NOTE),
        layers=tuple(sorted({*spec.layers, *(pattern for layers in spec.on.values() for pattern in layers)})),
    )  # fmt: skip


def _broken(outcome: Outcome, broken: Broken) -> Outcome:
    status = Status.CRASHED if broken.because is Because.CRASHED else Status.NOT_RUN
    return replace(outcome, status=status, because=broken.because)


def _rest(part: Part, profile: Profile, done: Sequence[Result], broken: Broken) -> list[Result]:
    """Every check that was not begun, broken; so is the last one if it may have layers left."""
    last = done[-1].check if done else -1
    return [
        Result(
            n, _broken(_before(rule, spec, part, f"{part.path}: {', '.join(spec.layers)}"), broken), trace=broken.trace
        )
        for n, (rule, spec) in enumerate(_checks(part, profile))
        if n > last or (n == last and spec.apart)
    ]


def _run(
    number: int, call: Call, outcome: Outcome, subject: Subject, outcomes: Sequence[Outcome],
    rules: Mapping[str, Rule], visible: float,
) -> Result:  # fmt: skip
    start = time.process_time()
    try:
        outcome, table = _looked(call, outcome, subject, outcomes, rules, visible)
        trace = ""
    except MemoryError:
        outcome, table, trace = _broken(outcome, Broken(Because.LIMIT)), None, ""
    except Exception:  # noqa: BLE001 - whatever a rule does wrong is our fault and must not end the audit
        outcome, table = _broken(outcome, Broken(Because.CRASHED)), None
        trace = f"{outcome.rule} {outcome.name} on {outcome.source}\n{traceback.format_exc()}"
    return Result(number, replace(outcome, seconds=time.process_time() - start), table, trace)


def _looked(
    call: Call, outcome: Outcome, subject: Subject, outcomes: Sequence[Outcome], rules: Mapping[str, Rule],
    visible: float,
) -> tuple[Outcome, Findings | None]:  # fmt: skip
    """What the rule finds, or why it cannot look."""
    if call.rule.metric and (doubt := subject.doubt(outcomes, visible)).because is not Because.RAN:
        return replace(outcome, because=doubt.because, names=doubt.names), None
    undeclared = subject.undeclared(call.rule.subject, visible)
    outcome = replace(outcome, parameters=call.parameters, undeclared=undeclared)
    seen = judged(call, rules, outcomes, subject)
    small = subject.too_small(union(seen.inputs[0].row, seen.unjudged), visible)
    outcome = replace(outcome, unjudged=seen.unjudged, aside=seen.named, small=small, again=seen.again)
    empty = not any(len(rows) for rows in seen.inputs) and not subject.examined(call.rule.subject)
    if empty and not len(seen.unjudged):
        return replace(outcome, because=Because.NOTHING), None
    if lack := missing(call, rules, outcomes, subject):
        return replace(outcome, because=lack.because, names=lack.names), None
    if empty:
        return replace(outcome, because=Because.ALL_ASIDE), None
    found = call.rule.check(*seen.inputs, **call.tolerances)
    deviations = found if isinstance(found, Deviations) else None
    hits = found.beyond(_limit(call)) if isinstance(found, Deviations) else found
    hits = hits.take(_told(hits, seen))
    rows = seen.inputs[0].row[union(hits.row, hits.also[~seen.aside[0][hits.also]])]
    outcome = replace(
        outcome,
        status=Status.FAULTY if len(hits) else Status.CLEAN,
        checked=subject.counted(seen.inputs[0].row[~seen.aside[0]], rows),
        found=len(hits),
        faulty=union(rows[rows >= 0]),
        deviations=deviations,
        total=float(hits.size.sum()),
        otherwise=_otherwise(call, subject, seen),
    )
    return outcome, findings_of(call, subject, seen.inputs, hits) if len(hits) and not call.spec.helper else None


def _otherwise(call: Call, subject: Subject, seen: Judged) -> tuple[str, int] | None:
    """Faults in the second reading of the input, if the part has one."""
    if len(seen.inputs) > 1 or len(seen.inputs[0]) == 0:
        return None
    second = subject.otherwise(call.rule.subject, call.layers[0])
    return None if second is None else (second[0], len(call.rule.check(second[1], **call.tolerances)))


def _limit(call: Call) -> float:
    return call.tolerances[call.rule.limit] if call.rule.limit else np.inf


def _told(found: Hits, seen: Judged) -> np.ndarray:
    """(k,) hits between items that are judged."""
    told = ~seen.aside[0][found.row]
    named = np.flatnonzero(found.other != NOBODY)
    told[named] &= ~seen.aside[-1][found.other[named]]
    return told


def _joined(results: Sequence[Result], unready: str) -> Checked:
    outcomes = sorted((result.outcome for result in results), key=lambda outcome: (outcome.rule, outcome.scope))
    return Checked(
        outcomes=tuple(outcomes),
        findings=join_findings([result.findings for result in results if result.findings is not None]),
        log=tuple(dict.fromkeys(trace for trace in (unready, *(result.trace for result in results)) if trace)),
    )
