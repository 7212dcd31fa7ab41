# SPDX-License-Identifier: MIT
"""What can be said of features that were looked for on meshes."""

import numpy as np

from foparq.evaluate.evidence import Evidence, unseen_meshes
from foparq.evaluate.quality import Reason, because
from foparq.findings.counts import FeatureCounts, Listed, Unlisted

NO_COMMISSION = "none"  #: confirmed: nothing is on the mesh that is not on the object
_MOSTLY = 0.5  #: share of the area of a mesh from which a list says nothing of it


def no_mesh(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Why features were looked for on no mesh though meshes were named."""
    if hidden := unseen_meshes(evidence, name):
        return hidden
    unknown = [mesh.path for mesh in evidence.delivery.meshes if mesh.unit.metres is None]
    return (because("features.unit-unknown-mesh", element=name, files=unknown),) if unknown else ()


def list_doubts(counts: FeatureCounts | None, name: str) -> tuple[Reason, ...]:
    """Why a list of places says nothing of the meshes that were delivered.

    Fewer than half of its places lie on them, tolerances are so wide that anything would, digits are so few that nobody
    knows what does, or places are written twice.
    """
    if counts is None or not counts.on_meshes or counts.placements is None:
        return ()
    why = []
    lies, doubts = counts.placements.lies, counts.doubts
    if counts.placements.elsewhere:
        n, total = int(np.count_nonzero(lies == Listed.THERE)), int(np.count_nonzero(lies != Listed.UNPLACED))
        why.append(because("features.elsewhere-mesh", element=name, n=n, total=total))
    if doubts is not None and doubts.coarse:
        why.append(because("features.coarse-mesh", element=name, n=doubts.coarse, tol=(doubts.tol, "m")))
    if doubts is not None and doubts.rounded > doubts.tol:
        why.append(because("features.rounded-mesh", element=name, off=(doubts.rounded, "m"), tol=(doubts.tol, "m")))
    if doubts is not None and doubts.repeated:
        why.append(because("features.repeated-mesh", element=name, n=doubts.repeated))
    return tuple(why)


def openings(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Remark on openings of meshes: what should be there is missing, whether the list names it or not."""
    if evidence.counts is None or not evidence.counts.on_meshes:
        return ()
    units = {mesh.path: "m2" if mesh.unit.metres is not None else "u2" for mesh in evidence.delivery.meshes}
    return tuple(
        because("omission.openings", element=name, file=one.source, n=one.found, area=(one.total, units[one.source]))
        for one in evidence.outcomes
        if one.name == "hole" and one.found and not (one.helper or one.preview)
    )


def surplus_on_meshes(counts: FeatureCounts) -> int:
    """Pieces of surface of which the list says nothing."""
    return sum(one.pieces for one in counts.unlisted if not _mostly(one))


def unlisted_doubts(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Why nobody knows what is on the meshes beyond the list, and remarks on it."""
    counts = evidence.counts
    if counts is None or not counts.on_meshes:
        return ()
    # A spacing that most of a mesh contradicts is wrong, whoever answers for what is on the mesh.
    wrong = tuple(_told("commission.mostly-unlisted", one, name) for one in counts.unlisted if _mostly(one))
    if evidence.confirmation("commission", NO_COMMISSION) is not None:
        return wrong
    told = _prohibited(counts, name)
    if counts.doubts is not None and counts.doubts.sparse:
        return (*told, because("commission.sparse", element=name, spacing=(counts.doubts.spacing, "m")))
    if not counts.unlisted:
        return (*told, because("commission.no-spacing", element=name))
    fine = (because("commission.too-fine", element=name, file=one.path) for one in counts.unlisted if not one.looked)
    return (*told, *fine, *wrong)


def _prohibited(counts: FeatureCounts, name: str) -> tuple[Reason, ...]:
    n = counts.doubts.prohibited if counts.doubts is not None else 0
    return (because("commission.prohibited-mesh", element=name, n=n),) if n else ()


def unlisted_told(counts: FeatureCounts, name: str) -> tuple[Reason, ...]:
    """The surfaces of which the list says nothing, with a place on the largest."""
    return tuple(_told("commission.unlisted", one, name) for one in counts.unlisted if one.pieces and not _mostly(one))


def confirmed_none(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Who answers for it that nothing is on the meshes that is not on the object."""
    counts, one = evidence.counts, evidence.confirmation("commission", NO_COMMISSION)
    if counts is None or not counts.on_meshes or one is None:
        return ()
    return (because("commission.confirmed", element=name, by=one.by, reason=one.reason),)


def _mostly(one: Unlisted) -> bool:
    return one.area > _MOSTLY * one.whole


def _told(message: str, one: Unlisted, name: str) -> Reason:
    x, y, z = one.where or (np.nan, np.nan, np.nan)
    return because(
        message, element=name, file=one.path, n=one.pieces, area=(one.area, "m2"), share=(one.area / one.whole, "1"),
        x=(x, "m"), y=(y, "m"), z=(z, "m"),
    )  # fmt: skip
