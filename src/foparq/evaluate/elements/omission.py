# SPDX-License-Identifier: MIT
"""Omission: specified features that are not drawn."""

from dataclasses import replace

from foparq.evaluate.balance import Balance, Incomparable, balances
from foparq.evaluate.clouds import uncovered_remarks
from foparq.evaluate.comparable import (
    doubtful,
    gap_reasons,
    no_balance,
    uncounted,
    unmapped,
)
from foparq.evaluate.decisions import decided, elsewhere, interval, placed
from foparq.evaluate.evidence import Evidence, Judgement, element, judged, limit_of, unseen, unseen_meshes
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.of_meshes import of_meshes
from foparq.evaluate.on_meshes import openings
from foparq.evaluate.quality import Element, ElementStatus, Reason, because, some
from foparq.profile.elements import OmissionSpec

_MEASURE = "7"


@evaluates(OmissionSpec, measure=_MEASURE)
def omission(spec: OmissionSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Missing required features over required ones, measure 7; the limit may be reached.

    Omissions that were accepted with evidence are shown in the net rate beside the gross one; the gross rate decides.

    The order of decisions:

    1. No list, or no layer bound to a class: not assessed. A drawing that contradicts its own unit: undecided.
    2. Parts of the drawings that nobody saw may hold what is missing: a rate above the limit is undecided.
    3. The rate exceeds the limit even with the most features that the drawings may hold, and even if classes that could
       not be compared, or have items on hidden layers, were complete: it fails.
    4. The rate exceeds the limit only with the fewest features, or without what is hidden: undecided.
    5. Classes that could not be compared: undecided, and named. No layer bound to a class is no evidence of omission.
    6. Otherwise it passes.

    Returns
    -------
    tuple of one Element
    """
    scope = ", ".join(filter(None, map(evidence.files, ("features", "mesh" if evidence.meshes_only else "drawing"))))
    limit, no_limit = limit_of(spec, evidence, "1", spec.id)
    features, counts = evidence.delivery.features, evidence.counts
    nothing = no_balance(evidence, spec.id)
    if nothing is not None or features is None or counts is None:
        judgement = nothing or judged(ElementStatus.NOT_ASSESSED, because("features.no-list", element=spec.id))
        judgement = judged(judgement.status, *judgement.why, *uncovered_remarks(evidence, spec.id))
        return (element(spec, _MEASURE, judgement, scope=scope, limit=limit, comparison="<=", method="directExternal"),)
    every = tuple(
        # What lies astray of the facade is a surplus there, and may fill no gap in it.
        row
        for row in balances(features, replace(counts, count=counts.near), evidence.delivery.decisions)
        if row.gap is not Incomparable.UNLISTED
    )
    known = [row for row in every if row.gap is Incomparable.NONE]
    required, missing = sum(row.required for row in known), sum(row.missing for row in known)
    net = sum(row.missing_net for row in known)
    if no_limit is not None or limit is None:
        judgement = judged(ElementStatus.UNDECIDED, *filter(None, [no_limit]))
    elif doubts := doubtful(evidence, spec.id):
        judgement = judged(ElementStatus.UNDECIDED, *doubts)
    else:
        judgement = _judge(spec, evidence, every, limit)
    parameters = [
        ("missing", float(missing), "items"), ("required", float(sum(row.required for row in every)), "items"),
        ("not-compared", float(sum(row.required for row in every) - required), "items"),
        ("missing-net", float(net), "items"), ("accepted", float(sum(row.accepted for row in known)), "items"),
    ]  # fmt: skip
    if (least := sum(row.missing_least for row in known)) < missing:
        parameters += [("missing-least", float(least), "items"), ("rate-least", least / required, "1")]
    if required:
        parameters.append(("net-rate", net / required, "1"))
    remarks = (
        *placed(known, spec.id),
        *openings(evidence, spec.id),
        *uncovered_remarks(evidence, spec.id),
        *decided(every, spec.id),
        *unmapped(counts, spec.id),
    )
    why = of_meshes(judgement.why, evidence)
    made = element(
        spec, _MEASURE, judged(judgement.status, *why, *remarks), scope=scope, n=required,
        value=missing / required if required else None, limit=limit, comparison="<=", parameters=parameters,
        method="directExternal",
        details=tuple((row.label, float(row.missing), float(row.required)) for row in known if row.required),
    )  # fmt: skip
    return (made,)


def _judge(spec: OmissionSpec, evidence: Evidence, every: tuple[Balance, ...], limit: float) -> Judgement:
    name = spec.id
    known = [row for row in every if row.gap is Incomparable.NONE]
    required, total = sum(row.required for row in known), sum(row.required for row in every)
    missing = sum(row.missing for row in known)
    gaps = gap_reasons(tuple(row for row in every if row.required), name, (Incomparable.UNBOUND, Incomparable.FACADE))
    if evidence.counts is not None:
        gaps = (*gaps, *elsewhere(evidence.counts, name))
    if not total:
        return judged(ElementStatus.NOT_ASSESSED, because("omission.nothing-required", element=name))
    if not required:
        return judged(ElementStatus.UNDECIDED, *gaps)
    fields: dict[str, object] = {
        "element": name, "missing": missing, "required": required, "value": (missing / required, "1"),
        "limit": (limit, "1"),
    }  # fmt: skip
    remarks = _accepted(known, name, required, missing)
    lost = unseen_meshes(evidence, name) if evidence.meshes_only else ()
    hidden = (*unseen(evidence, name), *lost, *uncounted(evidence, name))
    if missing / required > limit and hidden:
        return judged(ElementStatus.UNDECIDED, because("omission.hidden", **fields), *hidden, *gaps, *remarks)
    least = sum(row.missing_least for row in known if not row.hidden)
    fields["least"] = least
    if missing / total <= limit and not gaps:
        return judged(ElementStatus.PASS, _within(fields), *remarks)
    if least / total > limit:
        found = because("omission.fail-between" if least < missing else "omission.fail", **fields)
        return judged(ElementStatus.FAIL, found, *gaps, *remarks)
    uncertain = _open(known, evidence, fields) if missing / total > limit else ()
    return judged(ElementStatus.UNDECIDED, *uncertain, *gaps, *remarks)


def _accepted(known: list[Balance], name: str, required: int, missing: int) -> tuple[Reason, ...]:
    """What is said of omissions that somebody accepted."""
    net, unproven = sum(row.missing_net for row in known), sum(row.unproven for row in known)
    told = []
    if net < missing:
        told.append(
            because("omission.net", element=name, missing=net, accepted=missing - net, value=(net / required, "1"))
        )
    if unproven:
        told.append(because("omission.unproven", element=name, n=unproven))
    return tuple(told)


def _within(fields: dict[str, object]) -> Reason:
    """That the rate is within the limit; what may be drawn is not said to be missing."""
    if not fields["missing"]:
        return because("omission.none", **fields)
    return because("omission.pass" if fields["least"] == fields["missing"] else "omission.pass-between", **fields)


def _open(known: list[Balance], evidence: Evidence, fields: dict[str, object]) -> tuple[Reason, ...]:
    """Why features that were not counted may be drawn all the same."""
    short = [row for row in known if row.missing]
    why = []
    if several := [row for row in short if row.missing_least < row.missing]:
        told = {**fields, "least": sum(row.missing_least for row in known)}
        why.append(interval("omission.interval", str(fields["element"]), evidence, several, told))
    if layers := sorted({layer for row in short for layer in row.hidden}):
        why.append(because("omission.hidden-layers", layers=some(layers), n=len(layers), **fields))
    return tuple(why)
