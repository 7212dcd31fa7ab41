# SPDX-License-Identifier: MIT
"""Short letterings of a DXF file: what bears a name, and at which scale the sheet says it is drawn."""

import math
from collections.abc import Collection, Iterator
from typing import Any

import numpy as np

from foparq.model.drawing import Labels, StatedScale
from foparq.read.dxf.facts import LEAKS
from foparq.read.dxf.sketch import texts
from foparq.read.dxf.structure import model_entities, paper_entities
from foparq.read.dxf.text import readable, rendered_text
from foparq.read.lettering import LONGEST_NAME, LONGEST_SCALE, MOST_NAMES, scales_in


def labels_of(document: Any, unseen: Collection[str] = ()) -> Labels:  # noqa: ANN401 - ezdxf publishes no useful types
    """Letterings of model space that may name a point: of texts, and of the attributes of inserts.

    Parameters
    ----------
    unseen : collection of str
        Layers whose letterings name nothing: off, frozen or not plotted.
    """
    layers = {name.casefold() for name in unseen}
    shown = (entity for entity in model_entities(document) if _shown(entity, layers))
    found = [row for entity in shown for row in _labels(entity)][:MOST_NAMES]
    return Labels(
        text=texts([text for text, _, _ in found]),
        place=np.array([place for _, place, _ in found], dtype=float).reshape(-1, 3),
        block=np.array([block for _, _, block in found], dtype=bool),
    )


def scales_of(document: Any) -> tuple[StatedScale, ...]:  # noqa: ANN401
    """Scales that letterings and viewports of the file state, each once, in order."""
    found: set[StatedScale] = set()
    sheet = paper_entities(document)
    for entity in (*model_entities(document), *sheet):
        for text, _, _ in _labels(entity, longest=LONGEST_SCALE):
            found |= scales_in(text)
    for entity in sheet:
        ratio = _viewport(entity)
        if ratio:
            found.add(StatedScale(witness="viewport", ratio=ratio, said=f"VIEWPORT {entity.dxf.handle}"))
    return tuple(sorted(found, key=lambda one: (one.witness, one.said, one.denominator)))


def _labels(entity: Any, longest: int = LONGEST_NAME) -> Iterator[tuple[str, tuple[float, ...], bool]]:  # noqa: ANN401
    """Text, place in the axes of the file, and whether it is the place of an insert."""
    kind = entity.dxftype()
    if kind not in {"TEXT", "MTEXT", "INSERT"}:
        return
    try:
        bearers = entity.attribs if kind == "INSERT" else (entity,)
        for bearer in bearers:
            point = entity.dxf.insert
            if kind != "MTEXT":
                point = entity.ocs().to_wcs(point)
            text = readable(rendered_text(bearer) if bearer.dxftype() != "ATTRIB" else str(bearer.dxf.text)).strip()
            if 0 < len(text) <= longest:
                yield text, tuple(point.xyz), kind == "INSERT"
    except LEAKS:  # a damaged text names nothing; as an item it is told where items are read
        return


def _shown(entity: Any, unseen: Collection[str]) -> bool:  # noqa: ANN401
    try:
        return not entity.dxf.get("invisible", 0) and readable(entity.dxf.layer).casefold() not in unseen
    except LEAKS:
        return False


def _viewport(entity: Any) -> float:  # noqa: ANN401
    """Drawing units on one paper unit; 0 if the entity is no window on the drawing."""
    if entity.dxftype() != "VIEWPORT":
        return 0.0
    try:
        height, shown = float(entity.dxf.get("height", 0.0)), float(entity.dxf.get("view_height", 0.0))
        if int(entity.dxf.get("id", 0)) == 1:  # the sheet itself
            return 0.0
    except LEAKS:
        return 0.0
    ratio = shown / height if height > 0 and shown > 0 else 0.0
    return ratio if math.isfinite(ratio) else 0.0
