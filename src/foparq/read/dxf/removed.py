# SPDX-License-Identifier: MIT
"""Entities that stand in a text DXF file and no longer in the document that was mended."""

import re
from collections.abc import Sequence
from typing import Any, BinaryIO

from foparq.model.drawing import Repair
from foparq.read.dxf.tags import HOLDERS, LAYER, STRUCTURE, chains, entities, text_of
from foparq.read.dxf.text import readable

_NAMED = re.compile(r"#([0-9A-Fa-f]+)")  #: how a message of ezdxf names an entity


def removed_entities(
    stream: BinaryIO,
    document: Any,  # noqa: ANN401 - ezdxf.Drawing
    encoding: str,
    told: Sequence[Repair],
) -> tuple[Repair, ...]:
    """Entities of a file that mending has deleted, in their order; a POLYLINE and an INSERT stand for their parts.

    Parameters
    ----------
    stream : binary stream
        The text DXF file.
    encoding : str
        Of its names.
    told : sequence of Repair
        What the reader says of the mending; the words on an entity become those of its removal.

    Returns
    -------
    tuple of Repair
        An entity without a handle, or with one that stands twice, is not told.
    """
    words = {handle_in(repair): repair.detail for repair in reversed(told)}
    left = {int(handle, 16) for handle, entity in document.entitydb.items() if entity.is_alive}
    found, section = [], ""
    for chain, _ in chains(entities(stream)):
        head = chain[0]
        if head.kind in ("SECTION", "ENDSEC"):
            section = text_of(head.first(2))
        handle = head.handle
        if section in HOLDERS and head.kind not in STRUCTURE and handle and int(handle, 16) not in left:
            layer = readable(text_of(head.first(LAYER), encoding)) or "0"
            detail = words.get(handle.upper(), "")
            found.append(
                Repair(code="removed", detail=detail, handle=handle, line=head.line, kind=head.kind, layer=layer)
            )
    return tuple(found)


def handle_in(repair: Repair) -> str:
    """Handle that a message of the reader names first; ``""`` if it names none."""
    if repair.handle:
        return repair.handle.upper()
    named = _NAMED.search(repair.detail)
    return named[1].upper() if named else ""
