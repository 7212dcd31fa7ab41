# SPDX-License-Identifier: MIT
"""What references say beside elements that they do not decide."""

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because
from foparq.findings.clouds import CloudDistances


def compared(evidence: Evidence) -> set[str]:
    """Paths of meshes of which a reference shows where they lie."""
    return {path for one in evidence.clouds if not (one.elsewhere or one.repeats) for path in one.near}


def of_something_else(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Remark on references that lie nowhere near the meshes."""
    return tuple(elsewhere_reason("surface.reference-elsewhere", name, one) for one in evidence.clouds if one.elsewhere)


def uncovered_remarks(evidence: Evidence, name: str) -> tuple[Reason, ...]:
    """Remark on references of which the meshes do not show all; they are no list of features, and enter no rate."""
    if not evidence.meshes_only:
        return ()
    return tuple(
        uncovered_reason("omission.uncovered", "omission.uncovered-at", name, one)
        for one in evidence.clouds
        if one.uncovered.n and not one.elsewhere
    )


def elsewhere_reason(message: str, name: str, one: CloudDistances) -> Reason:
    """That a reference speaks of something else."""
    return because(
        message, element=name, file=one.path, meshes=list(one.meshes), value=(one.median, "m"),
        diagonal=(one.diagonal, "m"),
    )  # fmt: skip


def uncovered_reason(plain: str, placed: str, name: str, one: CloudDistances) -> Reason:
    """That points of a reference have no surface near them, and where most of them are."""
    found = one.uncovered
    fields = {
        "element": name, "file": one.path, "n": found.n, "share": (found.n / one.n, "1"), "search": (one.search, "m"),
        "meshes": list(one.meshes),
    }  # fmt: skip
    if found.place is None:
        return because(plain, **fields)
    x, y, z = found.place
    return because(placed, largest=found.largest, x=(x, "m"), y=(y, "m"), z=(z, "m"), **fields)
