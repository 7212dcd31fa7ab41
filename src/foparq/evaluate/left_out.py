# SPDX-License-Identifier: MIT
"""Layers and symbols that are not checked, and what may be concluded without them.

A person may leave out axes and dimensions, and point symbols are no linework. Nobody may leave out the drawing: where
most of the linework, or a layer that the manifest itself calls a feature or a coverage, is not checked, nothing is
accepted.
"""

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because
from foparq.model.drawing import Drawing, SkippedReason
from foparq.model.items import Role
from foparq.model.layers import class_of, matches
from foparq.model.symbols import SymbolBlock

_MOST = 0.5  #: of the items or of their length
_LAYERS = 10  #: that a reason names; and blocks
#: what hides a feature, and what leaves out most of the linework
_DOUBTS = {
    "element": ("unseen.ignored-feature", "unseen.ignored-most", "unseen.symbols-most"),
    "files": ("files.ignored-feature", "files.ignored-most", "files.symbols-most"),
}
_REMARKS = {SkippedReason.IGNORED_LAYER: "verdict.ignored", SkippedReason.NOT_PLOTTED: "verdict.not-plotted"}


def left_out(evidence: Evidence) -> tuple[Reason, ...]:
    """Layers and symbols that were not checked, with what they hold: said beside every verdict."""
    layers = tuple(
        because(
            message, file=drawing.path, layers=_told(layers), n=sum(layers.values()),
            share=(_share(drawing, tuple(layers)), "1"),
        )
        for drawing in evidence.delivery.drawings
        for reason, message in _REMARKS.items()
        if (layers := _layers(drawing, reason))
    )  # fmt: skip
    return (*layers, *(_symbols(drawing) for drawing in evidence.delivery.drawings if drawing.symbols.blocks))


def _symbols(drawing: Drawing) -> Reason:
    blocks = drawing.symbols.blocks
    names = [_block(block) for block in sorted(blocks, key=lambda block: -block.inserts)]
    near = sum(block.near for block in blocks)
    return because(
        "verdict.symbols-near" if near else "verdict.symbols", file=drawing.path, blocks=_first(names),
        n=drawing.symbols.inserts, items=len(drawing.symbols.rows), near=near, share=(_share(drawing, ()), "1"),
    )  # fmt: skip


def _block(block: SymbolBlock) -> str:
    """``"CRUZ × 12 (PONTOS)"``; a block that the file does not name by its first insert, ``"2F … × 12 (PONTOS)"``."""
    layers = _first([layer for layer, _ in block.layers])
    return f"{block.name or f'{block.handles[0]} …'} × {block.inserts} ({', '.join(layers)})"


def left_out_doubts(evidence: Evidence, name: str = "") -> tuple[Reason, ...]:
    """Why nothing can be concluded without the layers that were left out, and the symbols.

    Parameters
    ----------
    name : str
        Id of the element that is left open; ``""`` for loose files.
    """
    (feature, most, symbols), fields = (_DOUBTS["element"], {"element": name}) if name else (_DOUBTS["files"], {})
    why: list[Reason] = []
    for drawing in evidence.delivery.drawings:
        asked = _layers(drawing, SkippedReason.IGNORED_LAYER)
        every = (*asked, *_layers(drawing, SkippedReason.NOT_PLOTTED))
        if meant := [layer for layer in asked if _meant(drawing, layer)]:
            why.append(because(feature, file=drawing.path, layers=meant[:_LAYERS], **fields))
        if not (every or drawing.symbols.blocks) or (share := _share(drawing, every)) <= _MOST:
            continue
        told = {**fields, "file": drawing.path, "share": (share, "1")}
        if drawing.symbols.blocks:
            blocks = _first([_block(block) for block in drawing.symbols.blocks])
            why.append(because(symbols, parts=[*sorted(every)[:_LAYERS], *blocks], **told))
        else:
            why.append(because(most, layers=sorted(every)[:_LAYERS], **told))
    return tuple(why)


def _layers(drawing: Drawing, reason: SkippedReason) -> dict[str, int]:
    """Layers left out for a reason, with their items."""
    found: dict[str, int] = defaultdict(int)
    for skipped in drawing.reading.skipped:
        if skipped.reason is reason:
            found[skipped.layer] += skipped.count
    return dict(sorted(found.items()))


def _told(layers: dict[str, int]) -> list[str]:
    return _first([f"{layer} ({n})" for layer, n in layers.items()])


def _first(names: Sequence[str]) -> list[str]:
    return [*names[:_LAYERS], *([f"+{len(names) - _LAYERS}"] if len(names) > _LAYERS else [])]


def _meant(drawing: Drawing, layer: str) -> bool:
    """Whether the manifest itself says that a layer shows features or a coverage."""
    return bool(class_of(layer, drawing.classes)) or matches(layer, drawing.areas)


def _share(drawing: Drawing, layers: Sequence[str]) -> float:
    """Share of the linework that lies on some layers or draws symbols.

    By length; or of the items that lie on the layers, whichever is more: symbols are many and small.
    """
    items = drawing.items
    seen = ~items.paper & np.isin(items.role, [Role.LINE, Role.AREA]) & drawing.visible_rows()
    on = np.isin(items.layer, list(layers))
    either = on.copy()
    either[drawing.symbols.rows] = True
    every = np.flatnonzero(seen)
    length = drawing.extent(every)
    by_length = drawing.extent(np.flatnonzero(seen & either)) / length if length > 0 else 0.0
    return max(by_length, np.count_nonzero(seen & on) / len(every) if len(every) else 0.0)
