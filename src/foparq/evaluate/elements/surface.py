# SPDX-License-Identifier: MIT
"""Logical consistency of meshes: which share of the surface is at fault."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foparq.columns import union
from foparq.evaluate.clouds import compared, of_something_else
from foparq.evaluate.evidence import Evidence, Judgement, element, judged, limit_of, unseen_meshes
from foparq.evaluate.kinds import evaluates
from foparq.evaluate.quality import Element, ElementStatus, Reason, because
from foparq.evaluate.tally import Tally, broken_reasons, tally
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, Status
from foparq.model.mesh import Mesh
from foparq.profile.elements import SurfaceRateSpec

_MEASURE = "foparq:faulty-surface"
_COMPARED = 3  #: surveyed places near a surface, from which on it was compared
_STATED = "stated-rim"
_OPENINGS = "hole"  #: the rule whose sizes are areas that are not there


@dataclass(frozen=True, slots=True)
class _Mesh:
    """What the named rules found on one mesh."""

    path: str
    checked: int  #: faces
    faulty: int  #: faces at fault, or beside an opening
    area: float  #: of all faces that have one, and of the openings
    wrong: float  #: of the faces at fault, and of the openings
    unusable: int  #: faces of which nobody knows where they are
    unit: str  #: of areas

    @property
    def shares(self) -> tuple[float, float]:
        """At fault: of the faces, and of the area."""
        if not self.checked:
            return 0.0, 0.0
        # What cannot be used has no area: by area it weighs as by number.
        lost = self.unusable / self.checked
        return self.faulty / self.checked, max(lost, self.wrong / self.area if self.area else 1.0)


@evaluates(SurfaceRateSpec, measure=_MEASURE)
def surface_rate(spec: SurfaceRateSpec, evidence: Evidence) -> tuple[Element, ...]:
    """The greater of two shares at fault, of the faces and of the area; each mesh must keep the limit by itself.

    How many faces a surface has is its maker's choice: many small ones dilute a count, one large one dilutes an area.
    A mesh passes if neither share exceeds the limit, and fails if both do; else a person must look. The area of an
    opening counts as area at fault. Meshes are never added up, nor are they with drawings.

    The order of decisions:

    1. No mesh was named: there is no such element.
    2. No mesh could be looked at: not assessed.
    3. A rule crashed: undecided.
    4. Both shares of a mesh exceed the limit: it fails, whatever else was not seen.
    5. A rule of the list was not part of the audit: not assessed.
    6. Rules that did not run, things nobody saw, faces that cannot be used, a unit that the format contradicts, a rim
       that nobody states, or one share beyond the limit: undecided.
    7. Otherwise it passes.

    Returns
    -------
    tuple of one Element, or of none
    """
    if not evidence.files("mesh"):
        return ()
    limit, no_limit = limit_of(spec, evidence, "1", spec.id)
    counted = [one for one in evidence.outcomes if one.name in spec.rules and not (one.helper or one.preview)]
    meshes = [_tally(part, counted) for part in evidence.delivery.meshes]
    found = tally(evidence, spec.rules)
    value = max((max(mesh.shares) for mesh in meshes if mesh.checked), default=None)
    if value is None:
        why = broken_reasons(found, spec.id) or (because("surface.nothing", element=spec.id),)
        judgement = judged(ElementStatus.NOT_ASSESSED, *why, *unseen_meshes(evidence, spec.id))
    elif no_limit is not None or limit is None:
        judgement = judged(ElementStatus.UNDECIDED, *filter(None, [no_limit]))
    else:
        judgement = _judge(spec, evidence, meshes, found, limit)
    made = element(
        spec, _MEASURE, judgement, scope=evidence.files("mesh"), n=sum(mesh.checked for mesh in meshes), value=value,
        limit=limit, comparison="<=", parameters=_parameters(meshes), method="directInternal",
        details=found.rules,
    )  # fmt: skip
    return (made,)


def _tally(mesh: Mesh, counted: Sequence[Outcome]) -> _Mesh:
    here = [one for one in counted if one.source == mesh.path]
    ran = [one for one in here if one.status in {Status.CLEAN, Status.FAULTY}]
    rows = union(*(one.faulty for one in here))
    rows = rows[(rows >= 0) & (rows < mesh.features)]
    checked = mesh.features if ran else 0
    open_area = sum(one.total for one in here if one.name == _OPENINGS)
    areas = mesh.areas
    return _Mesh(
        mesh.path, checked, len(rows), float(areas.sum()) + open_area, float(areas[rows].sum()) + open_area,
        int(np.count_nonzero(~mesh.usable)), "m2" if mesh.unit.metres is not None else "u2",
    )  # fmt: skip


def _judge(spec: SurfaceRateSpec, evidence: Evidence, meshes: Sequence[_Mesh], found: Tally, limit: float) -> Judgement:
    name = spec.id
    worst_first = sorted(meshes, key=lambda mesh: -max(mesh.shares))
    told = [_told(name, mesh, limit) for mesh in worst_first if mesh.checked]
    broken = broken_reasons(found, name)
    if any(why is Because.CRASHED for why, _ in found.broken):
        return judged(ElementStatus.UNDECIDED, *broken, *told)
    hidden = unseen_meshes(evidence, name)
    failed = [mesh for mesh in meshes if min(mesh.shares) > limit]
    if failed:
        why = (because("surface.fail", **dict(_told(name, mesh, limit).fields)) for mesh in failed)
        return judged(ElementStatus.FAIL, *why, *broken, *hidden)
    if found.absent:
        absent = because("checks.absent", element=name, rules=list(found.absent))
        return judged(ElementStatus.NOT_ASSESSED, absent, *broken)
    doubts = [*broken, *hidden, *_units(evidence, name), *_rims(evidence, name)]
    doubts += [
        because("surface.unusable", element=name, file=mesh.path, n=mesh.unusable) for mesh in meshes if mesh.unusable
    ]
    doubts += [
        because("surface.one-share", **dict(_told(name, mesh, limit).fields))
        for mesh in meshes
        if max(mesh.shares) > limit
    ]
    stated = _stated(evidence, meshes, name)
    if doubts:
        return judged(ElementStatus.UNDECIDED, *doubts, *told, *stated)
    return judged(ElementStatus.PASS, *told, *stated, *_loose(evidence, name))


def _loose(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Remark on meshes of whose size and place no table says anything."""
    told = of_something_else(evidence, name)
    points, counts = evidence.ties.points if evidence.ties else None, evidence.counts
    held = compared(evidence)
    held |= {path for path, n in counts.places_on if n >= _COMPARED} if counts is not None else set()
    held |= set(points.drawing.tolist()) if points is not None else set()
    held |= {mesh.path for mesh in evidence.ties.beside if len(mesh.ids) >= _COMPARED} if evidence.ties else set()
    loose = [mesh.path for mesh in evidence.delivery.meshes if mesh.path not in held]
    return (because("surface.not-compared", element=name, files=loose), *told) if loose else told


def _told(name: str, mesh: _Mesh, limit: float) -> Reason:
    faces, area = mesh.shares
    return because(
        "surface.pass", element=name, file=mesh.path, faulty=mesh.faulty, checked=mesh.checked, value=(faces, "1"),
        wrong=(mesh.wrong, mesh.unit), area=(mesh.area, mesh.unit), share=(area, "1"), limit=(limit, "1"),
    )  # fmt: skip


def _units(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Meshes whose format or size says another unit than is stated of them, until somebody answers for it."""
    header = [
        because("surface.unit", element=name, file=mesh.path, stated=mesh.unit.name, says=mesh.unit.header)
        for mesh in evidence.delivery.meshes
        if mesh.unit.header_metres not in {None, mesh.unit.metres} and "unit" not in mesh.confirmed
    ]
    told = {dict(reason.fields)["file"] for reason in header}
    doubted = {one.source: one for one in evidence.outcomes if one.because is Because.UNIT_CONTRADICTED}
    size = [
        because("surface.size", element=name, file=mesh.path, says=list(doubted[mesh.path].names))
        for mesh in evidence.delivery.meshes
        if mesh.path in doubted and mesh.path not in told
    ]
    return (*header, *size)


def _rims(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Meshes that end in rims that nobody states."""
    return tuple(because("surface.open-rim", element=name, file=file, n=n) for file, n in evidence.open_rims)


def _stated(evidence: Evidence, meshes: Sequence[_Mesh], name: str) -> tuple[Reason, ...]:
    """Where surfaces end because somebody states it: an acceptance rests on that word."""
    units = {mesh.path: mesh.unit for mesh in meshes}
    return tuple(
        because("surface.stated-rims", element=name, file=one.source, n=one.found, area=(one.total, units[one.source]))
        for one in evidence.outcomes
        if one.name == _STATED and one.found
    )


def _parameters(meshes: Sequence[_Mesh]) -> tuple[tuple[str, float, str], ...]:
    totals = np.array([(mesh.faulty, mesh.checked, mesh.wrong, mesh.area) for mesh in meshes], dtype=float)
    if not len(totals):
        return ()
    faulty, checked, wrong, area = totals.sum(axis=0).tolist()
    counts = (("faulty", faulty, "items"), ("checked", checked, "items"))
    units = {mesh.unit for mesh in meshes}
    if len(units) > 1:
        return counts  # areas of which one has no unit add up to nothing
    (unit,) = units
    return (*counts, ("area-faulty", wrong, unit), ("area", area, unit))
