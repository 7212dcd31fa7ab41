# SPDX-License-Identifier: MIT
"""Layers that are not checked, and what may be concluded without them.

A person may leave out axes and dimensions. Nobody may leave out the drawing: where most of the linework, or a layer
that the manifest itself calls a feature or a coverage, is not checked, nothing is accepted.
"""

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because
from foparq.model.drawing import Drawing, SkippedReason
from foparq.model.items import Role
from foparq.model.layers import class_of, matches

_MOST = 0.5  #: of the items or of their length
_LAYERS = 10  #: that a reason names
#: what hides a feature, and what leaves out most of the linework
_DOUBTS = {
    "element": ("unseen.ignored-feature", "unseen.ignored-most"),
    "files": ("files.ignored-feature", "files.ignored-most"),
}
_REMARKS = {SkippedReason.IGNORED_LAYER: "verdict.ignored", SkippedReason.NOT_PLOTTED: "verdict.not-plotted"}


def left_out(evidence: Evidence) -> tuple[Reason, ...]:
    """Layers that were not checked, with what lies on them: said beside every verdict."""
    return tuple(
        because(
            message, file=drawing.path, layers=_told(layers), n=sum(layers.values()),
            share=(_share(drawing, tuple(layers)), "1"),
        )
        for drawing in evidence.delivery.drawings
        for reason, message in _REMARKS.items()
        if (layers := _layers(drawing, reason))
    )  # fmt: skip


def left_out_doubts(evidence: Evidence, name: str = "") -> tuple[Reason, ...]:
    """Why nothing can be concluded without the layers that were left out.

    Parameters
    ----------
    name : str
        Id of the element that is left open; ``""`` for loose files.
    """
    (feature, most), fields = (_DOUBTS["element"], {"element": name}) if name else (_DOUBTS["files"], {})
    why: list[Reason] = []
    for drawing in evidence.delivery.drawings:
        asked = _layers(drawing, SkippedReason.IGNORED_LAYER)
        every = (*asked, *_layers(drawing, SkippedReason.NOT_PLOTTED))
        if meant := [layer for layer in asked if _meant(drawing, layer)]:
            why.append(because(feature, file=drawing.path, layers=meant[:_LAYERS], **fields))
        if every and (share := _share(drawing, every)) > _MOST:
            told = sorted(every)[:_LAYERS]
            why.append(because(most, file=drawing.path, layers=told, share=(share, "1"), **fields))
    return tuple(why)


def _layers(drawing: Drawing, reason: SkippedReason) -> dict[str, int]:
    """Layers left out for a reason, with their items."""
    found: dict[str, int] = defaultdict(int)
    for skipped in drawing.reading.skipped:
        if skipped.reason is reason:
            found[skipped.layer] += skipped.count
    return dict(sorted(found.items()))


def _told(layers: dict[str, int]) -> list[str]:
    names = [f"{layer} ({n})" for layer, n in layers.items()]
    return [*names[:_LAYERS], *(["…"] if len(names) > _LAYERS else [])]


def _meant(drawing: Drawing, layer: str) -> bool:
    """Whether the manifest itself says that a layer shows features or a coverage."""
    return bool(class_of(layer, drawing.classes)) or matches(layer, drawing.areas)


def _share(drawing: Drawing, layers: Sequence[str]) -> float:
    """Share of the linework that lies on some layers: of the items or of their length, whichever is more."""
    items = drawing.items
    seen = ~items.paper & np.isin(items.role, [Role.LINE, Role.AREA]) & drawing.visible_rows()
    on = np.isin(items.layer, list(layers))
    some, every = np.flatnonzero(seen & on), np.flatnonzero(seen)
    length = drawing.extent(every)
    by_length = drawing.extent(some) / length if length > 0 else 0.0
    return max(by_length, len(some) / len(every) if len(every) else 0.0)
