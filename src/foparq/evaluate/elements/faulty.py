# SPDX-License-Identifier: MIT
"""Logical consistency: which share of the features is at fault."""

from foparq.evaluate.evidence import Evidence, Judgement, Parameters, element, judged, limit_of, unseen
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.left_out import left_out_doubts
from foparq.evaluate.quality import Element, ElementStatus, Reason, because, some
from foparq.evaluate.tally import (
    Tally,
    broken_reasons,
    iso_counts,
    judge_nothing,
    tally,
    undeclared_reasons,
    unfit_remark,
)
from foparq.findings.because import Because
from foparq.profile.elements import FaultyRateSpec

_MEASURE = "foparq:faulty-features"


@evaluates(FaultyRateSpec, measure=_MEASURE)
def faulty_rate(spec: FaultyRateSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Distinct faulty features of the named rules over the features checked; the limit may be reached.

    What is too small to be seen at the scale is no feature checked, unless it is at fault. The rate by length, and the
    counts of each of several drawings, stand beside it. The rate by length decides nothing; a drawing whose own rate
    exceeds the limit leaves open what the others would hide.

    The order of decisions:

    0. Meshes and no drawing were named: not applicable, and nothing rests on it.
    1. Nothing checked: not assessed, or undecided if rules could not run.
    2. A rule that crashed is a fault of the program: undecided.
    3. The rate exceeds the limit, even if the drawings on which the rules did not run are free of faults: it fails.
       Whatever was not seen can only add faults to what was.
    4. A rule of the list was not part of the audit: not assessed.
    5. Rules that did not run, parts that nobody saw, and features set aside for other faults that could turn the
       result: undecided. So is a result that one of several drawings would not reach by itself.
    6. Otherwise it passes.

    Returns
    -------
    tuple of one Element
    """
    found = tally(evidence, spec.rules)
    limit, no_limit = limit_of(spec, evidence, "1", spec.id)
    value = found.faulty / found.checked if found.checked else None
    if evidence.meshes_only:
        judgement = judged(ElementStatus.NOT_APPLICABLE, because("faulty.meshes-only", element=spec.id))
    elif value is None:
        judgement = judge_nothing(spec, evidence, found)
    elif no_limit is not None or limit is None:
        judgement = judged(ElementStatus.UNDECIDED, *filter(None, [no_limit]))
    else:
        judgement = _judge(spec, evidence, found, limit)
    parameters = (
        ("faulty", float(found.faulty), "items"), ("checked", float(found.checked), "items"),
        ("set-aside", float(found.aside), "items"), ("not-run-on", float(found.unrun), "items"),
        ("too-small", float(found.small), "items"), ("drawn-again", float(found.again), "items"),
        *_by_length(found), *iso_counts(found),
    )  # fmt: skip
    made = element(
        spec, _MEASURE, judgement, scope=evidence.files("drawing"), n=found.checked, value=value, limit=limit,
        comparison="<=", parameters=parameters, method="directInternal",
        details=(*found.rules, *found.parts), required=spec.required and not evidence.meshes_only,
    )  # fmt: skip
    return (made,)


def _by_length(found: Tally) -> Parameters:
    """The rate by length, for information: the length of what is at fault over that of all linework."""
    if found.extent is None:
        return ()
    faulty, whole = found.extent
    return (("length-faulty", faulty, "m"), ("length", whole, "m"), ("length-rate", faulty / whole, "1"))


def _noted(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Numbers of the notes that a reviewer may want to look at: they are no faults, and count in no rate."""
    found = {
        note: [outcome for outcome in evidence.outcomes if outcome.name == note and outcome.found]
        for note in ("free-end", "probable-undershoot", "shared-edge")
    }
    free, probable, shared = (sum(outcome.found for outcome in outcomes) for outcomes in found.values())
    noted = [because("faulty.free", element=name, n=free)] if free else []
    if heading := found["probable-undershoot"]:
        checked = sum(outcome.checked for outcome in heading)
        far = max(value for outcome in heading for key, value, _ in outcome.parameters if key == "heading")
        noted.append(because("faulty.probable", element=name, n=probable, checked=checked, heading=(far, "m")))
    if shared:
        noted.append(because("faulty.shared", element=name, n=shared))
    return tuple(noted)


def _judge(spec: FaultyRateSpec, evidence: Evidence, found: Tally, limit: float) -> Judgement:
    name, broken = spec.id, broken_reasons(found, spec.id)
    rate = found.faulty / found.checked
    fields = {
        "element": name, "faulty": found.faulty, "checked": found.checked, "value": (rate, "1"), "limit": (limit, "1"),
    }  # fmt: skip
    preview = because("checks.preview", element=name, rules=list(found.preview))
    remarks = (
        *undeclared_reasons(found, name), *unfit_remark(found, name), *((preview,) if found.preview else ()),
        *_noted(evidence, name),
    )  # fmt: skip
    if any(why is Because.CRASHED for why, _ in found.broken):
        return judged(ElementStatus.UNDECIDED, *broken, *remarks)
    hidden = (*unseen(evidence, name), *left_out_doubts(evidence, name))
    if found.faulty / (found.checked + found.unrun) > limit:
        return judged(ElementStatus.FAIL, because("faulty.fail", **fields), *broken, *hidden, *remarks)
    if found.absent:
        absent = because("checks.absent", element=name, rules=list(found.absent))
        return judged(ElementStatus.NOT_ASSESSED, absent, *broken, *remarks)
    doubts = [*broken, *hidden]
    if (found.faulty + found.aside) / found.checked > limit:
        doubts.append(
            because("faulty.aside", aside=found.aside, items=some(found.unjudged, total=found.aside), **fields)
        )
    for path, faulty, counted in found.parts:
        if faulty / counted > limit:
            own = {"faulty": int(faulty), "checked": int(counted), "value": (faulty / counted, "1")}
            doubts.append(because("faulty.one-drawing", element=name, file=path, limit=(limit, "1"), **own))
    if doubts:
        return judged(ElementStatus.UNDECIDED, *doubts, *remarks)
    return judged(ElementStatus.PASS, because("faulty.pass", **fields), *remarks)
