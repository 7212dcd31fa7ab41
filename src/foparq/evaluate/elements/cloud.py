# SPDX-License-Identifier: MIT
"""Distances of references from meshes, told and not judged."""

from foparq.evaluate.clouds import elsewhere_reason, uncovered_reason
from foparq.evaluate.evidence import Evidence, Parameters, element, judged
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, Reason, because
from foparq.findings.because import Because
from foparq.findings.clouds import CloudDistances, Signs, detectable
from foparq.profile.elements import SurfaceDistanceSpec

_MEASURE = "foparq:cloud-to-mesh"
_BROKEN = {Because.LIMIT: "cloud.limit", Because.CRASHED: "cloud.crashed"}
_SIGNS = {
    Signs.CLOSED: "cloud.signs-closed",
    Signs.NEARLY: "cloud.signs-nearly",
    Signs.OPEN: "cloud.signs-open",
}


@evaluates(SurfaceDistanceSpec, measure=_MEASURE)
def surface_distance(spec: SurfaceDistanceSpec, evidence: Evidence) -> tuple[Element, ...]:
    """Root mean square distance of all points of a reference from the meshes that it shows; of several, the greatest.

    The order of decisions:

    1. No reference was named: there is no such element.
    2. A reference could not be read, has no unit, or was not compared; it speaks of something else, or repeats the
       vertices of the mesh: undecided.
    3. Otherwise it is reported.

    Returns
    -------
    tuple of one Element, or of none
    """
    if not evidence.files("reference"):
        return ()
    worst_first = sorted(evidence.clouds, key=lambda one: -one.rms)
    told = [reason for one in worst_first for reason in _told(spec.id, one)]
    doubts = _doubts(spec.id, evidence)
    status = ElementStatus.UNDECIDED if doubts or spec.required else ElementStatus.REPORTED
    worst = worst_first[0] if worst_first else None
    made = element(
        spec, _MEASURE, judged(status, *doubts, *told), scope=evidence.files("reference"),
        n=worst.n if worst else 0, value=worst.rms if worst else None, comparison="",
        parameters=_parameters(worst) if worst else (), method="directExternal",
    )  # fmt: skip
    return (made,)


def _doubts(name: str, evidence: Evidence) -> list[Reason]:
    """Why nothing is known of a reference."""
    why = [because("cloud.lost", element=name, files=lost)] if (lost := evidence.lost("reference")) else []
    if evidence.uncompared is not Because.RAN:
        return [*why, because(_BROKEN[evidence.uncompared], element=name)]
    held = {one.path for one in evidence.clouds}
    for cloud in evidence.delivery.references:
        if cloud.unit.metres is None:
            why.append(because("cloud.no-unit", element=name, file=cloud.path))
        elif cloud.path not in held:
            why.append(because("cloud.no-mesh", element=name, file=cloud.path))
    for one in evidence.clouds:
        if one.elsewhere:
            why.append(elsewhere_reason("cloud.elsewhere", name, one))
        elif one.repeats:
            why.append(because("cloud.repeats", element=name, file=one.path, meshes=list(one.meshes)))
    return why


def _told(name: str, one: CloudDistances) -> list[Reason]:
    fields = {"element": name, "file": one.path}
    told = [
        because(
            "cloud.distances", meshes=list(one.meshes), n=one.n, value=(one.rms, "m"), quantile=(one.quantile, "m"),
            largest=(one.largest, "m"), **fields,
        ),
        because(_SIGNS[one.signs], mean=(one.mean, "m"), median=(one.median, "m"), **fields),
    ]  # fmt: skip
    if one.limit is not None:
        kind = "cloud.within" if one.rms < one.limit else "cloud.reaches"
        share = (one.beyond / one.n, "1")
        told.append(because(kind, value=(one.rms, "m"), limit=(one.limit, "m"), share=share, **fields))
    least = detectable(one.survey_sd)
    if least is None:
        told.append(because("cloud.no-survey-sd", **fields))
    elif one.limit is not None and least >= one.limit:
        told.append(because("cloud.coarse", least=(least, "m"), limit=(one.limit, "m"), **fields))
    if one.uncovered.n:
        told.append(uncovered_reason("cloud.uncovered", "cloud.uncovered-at", name, one))
    return told


def _parameters(one: CloudDistances) -> Parameters:
    least = detectable(one.survey_sd)
    rows: list[tuple[str, float | None, str]] = [
        ("mean", one.mean, "m"), ("median", one.median, "m"), ("sd", one.sd, "m"), ("rms", one.rms, "m"),
        ("quantile-95", one.quantile, "m"), ("largest-distance", one.largest, "m"),
        ("beyond", one.limit, "m"), ("share-beyond", None if one.limit is None else one.beyond / one.n, "1"),
        ("search", one.search, "m"), ("share-uncovered", one.uncovered.n / one.n, "1"),
        ("survey-sd", one.survey_sd, "m"), ("detectable", least, "m"),
        ("signed", float(one.signs is not Signs.OPEN), ""),
    ]  # fmt: skip
    return tuple((name, value, unit) for name, value, unit in rows if value is not None)
