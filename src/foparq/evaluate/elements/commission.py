# SPDX-License-Identifier: MIT
"""Commission: drawn features that the specification does not ask for."""

from collections.abc import Sequence

from foparq.evaluate.balance import Balance, Incomparable, balances
from foparq.evaluate.comparable import (
    doubtful,
    gap_reasons,
    no_balance,
    uncounted,
    unmapped,
)
from foparq.evaluate.decisions import decided, elsewhere, interval
from foparq.evaluate.evidence import Evidence, Judgement, element, judged, limit_of, unseen, unseen_meshes
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.of_meshes import of_meshes
from foparq.evaluate.on_meshes import confirmed_none, surplus_on_meshes, unlisted_doubts, unlisted_told
from foparq.evaluate.quality import Element, ElementStatus, because, some
from foparq.profile.elements import CommissionSpec

_MEASURE = "3"


@evaluates(CommissionSpec, measure=_MEASURE)
def commission(spec: CommissionSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Surplus features over the required ones, measure 3; the limit may be reached.

    The share of the delivered features is given beside it.

    The order of decisions:

    1. No list, or no layer bound to a class: not assessed. A drawing that contradicts its own unit: undecided.
    2. The rate exceeds the limit even with the fewest features that the drawings may hold: it fails. What was not seen
       can only add to the surplus.
    3. The rate exceeds the limit only with the most features: undecided. So are classes that could not be compared, and
       parts of the drawings that nobody saw. Drawn features of a class or facade of which the list says nothing belong
       here: a list that is silent prohibits nothing.
    4. Otherwise it passes. Layers that are bound to no class are not assessed and never count.

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
        return (element(spec, _MEASURE, judgement, scope=scope, limit=limit, comparison="<=", method="directExternal"),)
    every = balances(features, counts, evidence.delivery.decisions)
    known = [row for row in every if row.gap is Incomparable.NONE]
    surplus, required = _surplus(known, evidence), sum(row.required for row in known)
    delivered = sum(row.delivered for row in known)
    if no_limit is not None or limit is None:
        judgement = judged(ElementStatus.UNDECIDED, *filter(None, [no_limit]))
    elif doubts := doubtful(evidence, spec.id):
        judgement = judged(ElementStatus.UNDECIDED, *doubts)
    else:
        judgement = _judge(spec, evidence, every, limit)
    value = surplus / required if required else None if surplus else 0.0
    parameters = [("surplus", float(surplus), "items"), ("delivered", float(delivered), "items")]
    if (most := sum(row.surplus_most for row in known)) > surplus and not counts.on_meshes:
        parameters.append(("surplus-most", float(most), "items"))
        if required:
            parameters.append(("rate-most", most / required, "1"))
    if delivered:
        parameters.append(("share-of-delivered", surplus / delivered, "1"))
    why = of_meshes(judgement.why, evidence)
    remarks = (*decided(every, spec.id), *unmapped(counts, spec.id))
    made = element(
        spec, _MEASURE, judged(judgement.status, *why, *remarks), scope=scope, n=required,
        value=value if known else None, limit=limit, comparison="<=", parameters=parameters, method="directExternal",
        details=tuple((row.label, float(row.surplus), float(row.required + row.optional)) for row in known),
    )  # fmt: skip
    return (made,)


def _judge(spec: CommissionSpec, evidence: Evidence, every: tuple[Balance, ...], limit: float) -> Judgement:
    name = spec.id
    known = [row for row in every if row.gap is Incomparable.NONE]
    surplus, required = _surplus(known, evidence), sum(row.required for row in known)
    gaps = gap_reasons(every, name, (Incomparable.UNLISTED, Incomparable.UNBOUND, Incomparable.FACADE))
    if evidence.counts is not None:
        gaps = (*gaps, *elsewhere(evidence.counts, name))
    worst = sorted((row for row in known if row.surplus), key=lambda row: (-row.surplus, row.label))
    fields: dict[str, object] = {
        "element": name, "surplus": surplus, "required": required, "limit": (limit, "1"),
    }  # fmt: skip
    told = unlisted_told(evidence.counts, name) if evidence.counts is not None else ()
    if _exceeds(surplus, required, limit) and evidence.counts is not None and evidence.counts.on_meshes:
        return judged(ElementStatus.FAIL, because("commission.fail-mesh", **fields), *told, *gaps)
    if _exceeds(surplus, required, limit):
        return judged(
            ElementStatus.FAIL, because("commission.fail", **fields, classes=some([row.label for row in worst])), *gaps
        )
    several = []
    if _exceeds(most := sum(row.surplus_most for row in known), required, limit):
        unclear = [row for row in known if row.surplus_most > row.surplus]
        several.append(interval("commission.interval", name, evidence, unclear, {"most": most, **fields}))
    lost = unseen_meshes(evidence, name) if evidence.meshes_only else ()
    doubts = (*several, *gaps, *unseen(evidence, name), *lost, *unlisted_doubts(evidence, name))
    doubts = (*doubts, *uncounted(evidence, name))
    if doubts:
        return judged(ElementStatus.UNDECIDED, *doubts)
    passed = "commission.pass-mesh" if evidence.counts and evidence.counts.on_meshes else "commission.pass"
    return judged(ElementStatus.PASS, because(passed, **fields), *told, *confirmed_none(evidence, name))


def _surplus(known: Sequence[Balance], evidence: Evidence) -> int:
    on_meshes = evidence.counts if evidence.counts is not None and evidence.counts.on_meshes else None
    return surplus_on_meshes(on_meshes) if on_meshes else sum(row.surplus for row in known)


def _exceeds(surplus: int, required: int, limit: float) -> bool:
    return surplus > 0 and (not required or surplus / required > limit)
