# SPDX-License-Identifier: MIT
"""What the files of a delivery say of each other's units."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from foparq.check.drawn.unit_evidence import against, unit_evidence
from foparq.columns import Reals
from foparq.findings.ties import Ties
from foparq.model.delivery import Delivery
from foparq.model.drawing import Drawing, Heard, UnitOrigin
from foparq.model.items import Role

_SAME_BOX = 0.9  #: share of the joint box that two drawings of one thing have in common
_OTHER_UNIT = 0.02  #: relative difference up to which two units are one


def with_witnesses(delivery: Delivery, ties: Ties | None) -> Delivery:
    """Delivery whose drawings know what other files say of their units.

    Two drawings with the same coordinates in different units cannot both be right: floors and facades of one building
    repeat its measures. A table that would lie on a drawing in another unit speaks against that of the drawing beside
    another witness, and where neither header nor lettering bears the drawing out: one of the two statements is wrong,
    and nobody knows which. Against them it is in the wrong unit itself.

    Parameters
    ----------
    ties : Ties or None
        What of the tables belongs to the drawings.
    """
    drawings = delivery.drawings
    heard = {
        drawing.path: [*_by_table(delivery, drawing, ties), *_by_drawings(drawing, drawings)] for drawing in drawings
    }
    parts = tuple(
        replace(part, heard=tuple(heard[part.path])) if isinstance(part, Drawing) and heard[part.path] else part
        for part in delivery.parts
    )
    return replace(delivery, parts=parts)


def _by_table(delivery: Delivery, drawing: Drawing, ties: Ties | None) -> list[Heard]:
    cause = ties.points.cause if ties and ties.points and ties.points.near == drawing.path else None
    if cause is None or cause.kind != "unit" or drawing.unit.metres is None:
        return []
    if _borne_out(drawing) and not against(drawing, _OTHER_UNIT):
        return []
    path = next((source.path for source in delivery.sources if source.role == "checkpoints"), "")
    return [Heard(witness="tables", path=path, says=drawing.unit.metres / cause.factor)]


def _borne_out(drawing: Drawing) -> bool:
    """Whether the file itself says the unit in use, by its header or its lettering."""
    if drawing.unit.origin is UnitOrigin.HEADER:
        return True
    evidence = unit_evidence(drawing)
    agrees = np.abs(evidence.says / evidence.used - 1) <= np.maximum(_OTHER_UNIT, evidence.weight)
    return bool(np.any(agrees & np.isin(evidence.witness, ["header", "lettering"])))


def _by_drawings(drawing: Drawing, drawings: Sequence[Drawing]) -> list[Heard]:
    mine, metres = _box(drawing), drawing.unit.metres
    if mine is None or metres is None:
        return []
    return [
        Heard(witness="drawing", path=other.path, says=other.unit.metres)
        for other in drawings
        if other is not drawing and other.unit.metres is not None
        and abs(other.unit.metres / metres - 1) > _OTHER_UNIT and (box := _box(other)) is not None
        and _alike(mine, box)
    ]  # fmt: skip


def _box(drawing: Drawing) -> Reals | None:
    """(4,) bounds of what is drawn, drawing units; ``None`` without extent."""
    items = drawing.items
    seen = drawing.visible_rows() & np.isin(items.role, [Role.LINE, Role.AREA])
    bounds = shapely.bounds(items.geometry[seen])
    bounds = bounds[np.isfinite(bounds).all(axis=1)]
    if not len(bounds):
        return None
    box: Reals = np.concatenate([bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)])
    return box if (box[2:] > box[:2]).all() else None


def _alike(one: Reals, other: Reals) -> bool:
    low, high = np.maximum(one[:2], other[:2]), np.minimum(one[2:], other[2:])
    common = np.prod(np.clip(high - low, 0.0, None))
    together = np.prod(np.maximum(one[2:], other[2:]) - np.minimum(one[:2], other[:2]))
    return bool(common >= _SAME_BOX * together)
