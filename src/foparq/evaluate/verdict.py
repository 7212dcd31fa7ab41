# SPDX-License-Identifier: MIT
"""The verdict on a delivery: no evidence is never a pass."""

from collections.abc import Iterable, Sequence

from foparq.evaluate.decisions import dated
from foparq.evaluate.diagnosis import diagnosis
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.facades import alike_doubts
from foparq.evaluate.left_out import left_out
from foparq.evaluate.quality import Element, ElementStatus, QualityReport, Reason, Verdict, because
from foparq.evaluate.remarks import basis, deciding, remarks_on
from foparq.evaluate.scale import scale_doubts
from foparq.findings.outcome import Status
from foparq.model.delivery import Source, SourceStatus
from foparq.model.drawing import Drawing
from foparq.profile.elements import results_of
from foparq.profile.schema import Profile

_OPEN = set(ElementStatus) - {ElementStatus.PASS, ElementStatus.FAIL}
#: doubts about what the manifest or the file states of itself, on which all others rest
_STATEMENTS = frozenset(
    f"{what}.{why}"
    for what in ("checks", "features")
    for why in ("unit-contradicted", "unit-doubtful", "unit-angle", "crs-unfit", "plane-contradicted", "plane-doubtful")
)
_LOST = {SourceStatus.REFUSED: "verdict.refused", SourceStatus.MISSING: "verdict.missing"}


def decide(profile: Profile, evidence: Evidence, elements: Sequence[Element]) -> QualityReport:
    """Verdict over all elements, with the reasons that decide and, apart from them, what is to be said beside them.

    Rejected: a required element fails. Else undecided: a required element is undecided or not assessed, a file that the
    manifest names could not be read, drawings of two facades are alike, something crashed, or nothing is
    required. Else accepted.
    """
    waived = {name for spec in profile.elements if not spec.applicable for name in results_of(spec.id)}
    required = [element for element in elements if element.required and element.id not in waived]
    failed = [element for element in required if element.status is ElementStatus.FAIL]
    opened = [element for element in required if element.status in _OPEN]
    doubts = _together(deciding(element) for element in opened) + lost_files(evidence) + crashes(evidence)
    doubts += alike_doubts(evidence)
    # What a file that is not there, or a wrong unit or plane, does to the numbers says nothing itself.
    doubts.sort(key=lambda reason: (reason.message not in _LOST.values(), reason.message not in _STATEMENTS))
    if not required:
        doubts.append(because("verdict.nothing-required"))
    beside: list[Sequence[Reason]] = [remarks_on(element, deciding(element)) for element in opened]
    beside += [_confirmed(evidence), left_out(evidence)]
    passed = [remarks_on(element, basis(element)) for element in required if element.status is ElementStatus.PASS]
    doubted, remarked = scale_doubts(profile, evidence)
    if doubted:
        failing = _together(basis(element) for element in failed)
        return _report(Verdict.UNDECIDED, (*doubted, *doubts), [failing, *beside, *passed], elements, evidence)
    if failed:
        rest = [remarks_on(element, basis(element)) for element in failed]
        beside = [diagnosis(profile, evidence, elements), doubts, *rest, *beside, *passed]
        return _report(Verdict.REJECTED, _together(map(basis, failed)), beside, elements, evidence)
    if doubts:
        return _report(Verdict.UNDECIDED, doubts, [*beside, *passed], elements, evidence)
    why = [because("verdict.accepted", elements=[element.id for element in required])]
    # Where most points are drawn nowhere, the acceptance is somebody's word: it begins with the name.
    why[:0] = _together(
        [reason for reason in element.why if reason.message == "evidence.most-confirmed"] for element in required
    )
    why += _together(basis(element) if _tolerated(element) else basis(element)[1:] for element in required)
    if others := [element.id for element in elements if element not in required and element.value is not None]:
        beside.append((because("verdict.not-required", elements=others),))
    beside += [remarked, *passed, _hidden(evidence)]
    return _report(Verdict.ACCEPTED, why, beside, elements, evidence)


def _report(
    verdict: Verdict, why: Sequence[Reason], beside: Iterable[Sequence[Reason]], elements: Sequence[Element],
    evidence: Evidence,
) -> QualityReport:  # fmt: skip
    return QualityReport(
        verdict=verdict, why=tuple(why), remarks=tuple(_together(beside)), elements=tuple(elements),
        refused=evidence.refused,
    )  # fmt: skip


def _tolerated(element: Element) -> bool:
    """Faults were found and the limit allows them: an acceptance must say so."""
    return element.unit == "1" and element.comparison == "<=" and bool(element.value)


def _confirmed(evidence: Evidence) -> list[Reason]:
    """What persons confirmed by name, and in which manifest they state it and what they decided."""
    told = [
        because("verdict.confirmed", what=one.what, value=one.value, by=one.by, when=dated(one), reason=one.reason)
        for one in evidence.delivery.confirmed
    ]
    if evidence.delivery.confirmed or evidence.delivery.decisions:
        told += [
            because("verdict.signed", file=source.path, sha256=source.sha256)
            for source in evidence.delivery.sources
            if source.role == "manifest" and source.sha256
        ]
    return told


def _hidden(evidence: Evidence) -> list[Reason]:
    """What is in the drawings and nobody sees: an acceptance says that it was not checked."""
    layers = [layer for drawing in evidence.delivery.drawings for layer in _hidden_layers(drawing)]
    return [because("verdict.hidden", n=len(layers), layers=sorted(set(layers)))] if layers else []


def _hidden_layers(drawing: Drawing) -> list[str]:
    items = drawing.items
    layers: list[str] = items.layer[~items.visible & ~items.paper].tolist()
    return layers


def _together(groups: Iterable[Sequence[Reason]]) -> list[Reason]:
    """Reasons in order; those that differ in nothing but the element become one that names all of them."""
    made: dict[tuple[str, str], list[str]] = {}
    first: dict[tuple[str, str], Reason] = {}
    for group in groups:
        for reason in group:
            rest = tuple(field for field in reason.fields if field[0] != "element")
            key = (reason.message, repr(rest))
            first.setdefault(key, reason)
            names = made.setdefault(key, [])
            names.extend(str(value) for name, value in reason.fields if name == "element" and value not in names)
    return [_naming(reason, made[key]) for key, reason in first.items()]


def _naming(reason: Reason, names: list[str]) -> Reason:
    if len(names) < 2:  # noqa: PLR2004 - one name stays as it is
        return reason
    return Reason(
        message=reason.message,
        fields=tuple((name, names if name == "element" else value) for name, value in reason.fields),
    )


def lost_files(evidence: Evidence) -> list[Reason]:
    """Files that were named and could not be read."""
    return [
        because(message, files=files)
        for status, message in _LOST.items()
        if (files := _named([source for source in evidence.delivery.sources if source.status is status]))
    ]


def _named(sources: Sequence[Source]) -> Sequence[object]:
    """Paths of files, each with the one in the delivery that is named most like it, where it is not there."""
    likes = [str(dict(source.fields).get("other", "")) for source in sources if source.status is SourceStatus.MISSING]
    if not any(likes):
        return [source.path for source in sources]
    return tuple(
        because("file.like", file=source.path, other=like) if like else because("file.alone", file=source.path)
        for source, like in zip(sources, likes, strict=True)
    )


def crashes(evidence: Evidence) -> list[Reason]:
    """What of the program failed: never a fault of the delivery, and nothing can be accepted without it."""
    rules = sorted({f"{o.name} ({o.source})" for o in evidence.outcomes if o.status is Status.CRASHED})
    why = [because("verdict.crashed-rules", rules=rules)] if rules else []
    return [*why, because("verdict.crashed")] if evidence.crashed else why
