# SPDX-License-Identifier: MIT
"""Layers of a drawing that are not checked: because the manifest says so, or because they do not plot."""

from collections import defaultdict

import numpy as np

from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Items, Role
from foparq.model.layers import NEVER_PLOTTED, matches
from foparq.names import folded
from foparq.profile.manifest import DrawingSection
from foparq.read.raw import RawDrawing

_HANDLES = 5  #: of a kind that are named
_DRAWN = (Role.LINE.value, Role.AREA.value, Role.POINT.value)


def left_out(raw: RawDrawing, section: DrawingSection, *, hidden: bool) -> tuple[Skipped, ...]:
    """What is drawn on layers that are not checked, counted by layer and kind; nothing of them is removed.

    Parameters
    ----------
    section : DrawingSection
        ``ignore_layers``. A layer that does not plot is checked all the same if ``classes`` or ``areas`` name it.
    hidden : bool
        True if the profile wants to see what nobody sees: then layers that do not plot are checked too.
    """
    items = raw.items
    drawn = np.isin(items.role, _DRAWN) & ~items.paper & (items.visible | hidden)
    layers = sorted(set(items.layer[drawn].tolist()))
    unplotted = {folded(name) for name in raw.reading.unplotted} | {folded(NEVER_PLOTTED)}
    named = (*section.classes, *section.areas)
    why: dict[str, SkippedReason] = {}
    for layer in layers:
        if matches(layer, section.ignore_layers):
            why[layer] = SkippedReason.IGNORED_LAYER
        elif folded(layer) in unplotted and not hidden and not matches(layer, named):
            why[layer] = SkippedReason.NOT_PLOTTED
    return _counted(items, drawn & np.isin(items.layer, list(why)), why)


def _counted(items: Items, rows: np.ndarray, why: dict[str, SkippedReason]) -> tuple[Skipped, ...]:
    handles: dict[tuple[str, str], list[str]] = defaultdict(list)
    columns = (items.layer[rows].tolist(), items.kind[rows].tolist(), items.item[rows].tolist())
    for layer, kind, handle in zip(*columns, strict=True):
        handles[layer, kind].append(handle)
    return tuple(
        Skipped(
            reason=why[layer], kind=kind, layer=layer, count=len(of),
            handles=tuple(sorted(of)[:_HANDLES]),
        )
        for (layer, kind), of in sorted(handles.items())
    )  # fmt: skip
