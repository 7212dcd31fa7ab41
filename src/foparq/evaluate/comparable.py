# SPDX-License-Identifier: MIT
"""Why specified and delivered features cannot be compared, in reasons."""

from foparq.evaluate.balance import Balance, Incomparable
from foparq.evaluate.evidence import Evidence, Judgement, judged
from foparq.evaluate.of_meshes import of_meshes
from foparq.evaluate.on_meshes import list_doubts, no_mesh
from foparq.evaluate.quality import ElementStatus, Reason, because, some
from foparq.evaluate.tally import where_broken
from foparq.findings.because import Because
from foparq.findings.counts import FeatureCounts


def gap_reasons(rows: tuple[Balance, ...], name: str, gaps: tuple[Incomparable, ...]) -> tuple[Reason, ...]:
    """Reasons for the classes that could not be compared."""
    labels = {gap: [row.label for row in rows if row.gap is gap] for gap in gaps}
    return tuple(
        because(f"features.{gap.value}", element=name, classes=some(known), n=len(known))
        for gap, known in labels.items()
        if known
    )


_BROKEN_OFF = {Because.LIMIT: "features.limit", Because.CRASHED: "features.crashed"}


def no_balance(evidence: Evidence, name: str) -> Judgement | None:
    """Why features cannot be compared at all; ``None`` if they can."""
    features, drawings = evidence.delivery.features, evidence.delivery.drawings
    if features is None or not len(features.id):
        if evidence.lost("features"):
            return judged(ElementStatus.UNDECIDED, because("features.lost", element=name))
        return judged(ElementStatus.NOT_ASSESSED, because("features.no-list", element=name))
    if evidence.counts is not None:
        return None
    if evidence.uncounted.opens:
        broken = of_meshes([because(_BROKEN_OFF[evidence.uncounted], element=name)], evidence)
    else:
        broken = ()
    lost = evidence.lost("drawing")
    unread = (because("unseen.file", element=name, files=lost),) if lost else uncounted(evidence, name)
    if why := unread or broken or (no_mesh(evidence, name) if evidence.meshes_only else ()):
        return judged(ElementStatus.UNDECIDED, *why)
    bound = any(drawing.classes for drawing in drawings)
    case = "features.not-counted" if bound else "features.no-classes" if drawings else "checks.no-drawing"
    return judged(ElementStatus.NOT_ASSESSED, because(case, element=name))


def uncounted(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Drawings with classes whose features were not counted because nobody knows their unit."""
    drawings = [drawing for drawing in evidence.delivery.drawings if drawing.classes and drawing.unit.metres is None]
    return (because("features.unit-unknown", element=name, files=[d.path for d in drawings]),) if drawings else ()


#: why rules with lengths did not run on a drawing, and what that means for its features
_DOUBTS = {
    Because.UNIT_DOUBTFUL: "features.unit-doubtful", Because.UNIT_CONTRADICTED: "features.unit-contradicted",
    Because.PLANE_DOUBTFUL: "features.plane-doubtful", Because.PLANE_CONTRADICTED: "features.plane-contradicted",
}  # fmt: skip


def doubtful(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Drawings whose unit or plane is in doubt: what counts as one feature depends on both, so counts say nothing."""
    why = []
    for doubt, message in _DOUBTS.items():
        doubted = {outcome.source: where_broken(outcome) for outcome in evidence.outcomes if outcome.because is doubt}
        bound = [drawing.path for drawing in evidence.delivery.drawings if drawing.classes]
        bound += [mesh.path for mesh in evidence.delivery.meshes] if evidence.meshes_only else []
        files = [doubted[path] for path in bound if path in doubted]
        if files:
            why.append(because(message, element=name, files=files))
    return (*of_meshes(why, evidence), *list_doubts(evidence.counts, name))


def unit_doubts(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Drawings of doubtful unit: a table that was held against one in that unit shares its doubt."""
    doubts = (Because.UNIT_DOUBTFUL, Because.UNIT_CONTRADICTED)
    doubted = {outcome.source: where_broken(outcome) for outcome in evidence.outcomes if outcome.because in doubts}
    return (because("evidence.unit-doubted", element=name, files=list(doubted.values())),) if doubted else ()


def unmapped(counts: FeatureCounts, name: str) -> tuple[Reason, ...]:
    """Layers that no class is bound to, as a remark: not assessed, never commission."""
    if not counts.unmapped:
        return ()
    layers = [layer for layer, _ in counts.unmapped]
    items = sum(count for _, count in counts.unmapped)
    return (because("features.unmapped", element=name, layers=some(layers), n=len(layers), items=items),)
