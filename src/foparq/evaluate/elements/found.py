# SPDX-License-Identifier: MIT
"""How many faults of one kind were found, per feature checked."""

from foparq.evaluate.evidence import Evidence, Judgement, element, judged, limit_of, unseen
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.left_out import left_out_doubts
from foparq.evaluate.measures import Measure, measure_counting, measures
from foparq.evaluate.quality import Element, ElementStatus, because, some
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
from foparq.profile.elements import FoundRateSpec


@evaluates(FoundRateSpec, measure="foparq:found-rate")
def found_rate(spec: FoundRateSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Faults of the named rules together over the features checked, or their number where the limit is a number.

    Measures 4, 11, 19, 23, 24 and 26 of ISO 19157 are counts: they name the result only where it is one, for a single
    rule and a limit in items. Beside a rate they stand among the parameters.

    Without a limit the result is a number and no verdict: reported, or undecided where the profile requires it.

    Returns
    -------
    tuple of one Element
    """
    found = tally(evidence, spec.rules)
    counting = spec.limit is not None and spec.limit.symbol == "items"
    measure, kind = _measure(spec, counting=counting)
    limit, no_limit = limit_of(spec, evidence, measure.unit, spec.id)
    rate = found.found / found.checked if found.checked else None
    value = rate if not counting or rate is None else float(found.found)
    if evidence.meshes_only:
        judgement = judged(ElementStatus.NOT_APPLICABLE, because("faulty.meshes-only", element=spec.id))
    elif value is None or rate is None:
        judgement = judge_nothing(spec, evidence, found)
    elif limit is not None:
        judgement = _judge(spec, evidence, found, value, limit, measure.unit)
    elif spec.limit is None:
        reported = because(
            "found.reported", element=spec.id, found=found.found, checked=found.checked, value=(rate, "1")
        )
        doubts = (*broken_reasons(found, spec.id), *unseen(evidence, spec.id))
        status = ElementStatus.UNDECIDED if spec.required else ElementStatus.REPORTED
        judgement = judged(status, *((no_limit,) if spec.required and no_limit else ()), reported, *doubts)
    else:
        judgement = judged(ElementStatus.UNDECIDED, *filter(None, [no_limit]))
    if (undeclared := undeclared_reasons(found, spec.id)) and judgement.status is not ElementStatus.FAIL:
        judgement = judged(ElementStatus.NOT_ASSESSED, *dict.fromkeys([*undeclared, *judgement.why]))
    parameters = (("found", float(found.found), "items"), ("checked", float(found.checked), "items"))
    shown = parameters if rate is None or not counting else (*parameters, ("rate", rate, "1"))
    made = element(
        spec, measure.id, judgement, scope=evidence.files("drawing"), n=found.checked, value=value, limit=limit,
        comparison="<=", parameters=(*shown, *iso_counts(found)), method="directInternal", details=found.rules,
        kind=kind, required=spec.required and not evidence.meshes_only,
    )  # fmt: skip
    return (made,)


def _measure(spec: FoundRateSpec, *, counting: bool) -> tuple[Measure, str | None]:
    """Measure of the result, and the data quality element that the rules speak of."""
    counts = [measure_counting(rule) for rule in spec.rules]
    kinds = {count.element for count in counts if count is not None}
    kind = kinds.pop() if len(kinds) == 1 else None
    if counting and len(counts) == 1 and counts[0] is not None:
        return counts[0], kind
    return measures()["foparq:found-count" if counting else "foparq:found-rate"], kind


def _judge(spec: FoundRateSpec, evidence: Evidence, found: Tally, value: float, limit: float, unit: str) -> Judgement:
    fields = {
        "element": spec.id, "found": found.found, "checked": found.checked, "value": (value, unit),
        "limit": (limit, unit),
    }  # fmt: skip
    broken = broken_reasons(found, spec.id)
    hidden = (*unseen(evidence, spec.id), *left_out_doubts(evidence, spec.id))
    if any(why is Because.CRASHED for why, _ in found.broken):
        return judged(ElementStatus.UNDECIDED, *broken)
    sure = value if unit == "items" else found.found / (found.checked + found.unrun)
    if sure > limit:
        return judged(ElementStatus.FAIL, because("found.fail", **fields), *broken, *hidden)
    if found.absent:
        absent = because("checks.absent", element=spec.id, rules=list(found.absent))
        return judged(ElementStatus.NOT_ASSESSED, absent, *broken)
    doubts = [*broken, *hidden]
    if found.aside and value + (found.aside if unit == "items" else found.aside / found.checked) > limit:
        doubts.append(
            because("found.aside", aside=found.aside, items=some(found.unjudged, total=found.aside), **fields)
        )
    if doubts:
        return judged(ElementStatus.UNDECIDED, *doubts)
    return judged(ElementStatus.PASS, because("found.pass", **fields), *unfit_remark(found, spec.id))
