# SPDX-License-Identifier: MIT
"""The same reasons, in the words of meshes where no drawing was delivered."""

from collections.abc import Sequence
from dataclasses import replace

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason

#: reasons that speak of a drawing; with ``-mesh`` behind they speak of a mesh
TWINS = frozenset({
    "evidence.no-drawing", "evidence.limit", "evidence.crashed", "evidence.absent", "evidence.made",
    "evidence.cause-axes", "evidence.cause-unit", "evidence.cause-unit-axes", "evidence.cause-shift",
    "evidence.cause-scale", "evidence.end-absent", "evidence.other-length", "evidence.too-long",
    "evidence.distance-factor", "evidence.names-only", "evidence.unit-doubted", "features.unbound",
    "features.unit-contradicted", "features.limit", "omission.pass", "omission.fail",
})  # fmt: skip


def of_meshes(reasons: Sequence[Reason], evidence: Evidence) -> tuple[Reason, ...]:
    """Reasons in the words of what was delivered."""
    if not evidence.meshes_only:
        return tuple(reasons)
    return tuple(replace(one, message=f"{one.message}-mesh") if one.message in TWINS else one for one in reasons)
