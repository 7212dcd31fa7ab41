# SPDX-License-Identifier: MIT
"""Entities that cannot be loaded, exchanged in memory for stand-ins, so that all others are read.

A stand-in is a text with the handle, layer and space of the entity it stands for: it is counted where that was drawn,
in every insert of a block, and moves no other entity from its place in the file.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

from ezdxf.entities import factory
from ezdxf.filemanagement import new
from ezdxf.lldxf.extendedtags import ExtendedTags
from ezdxf.lldxf.tags import Tags
from ezdxf.lldxf.types import TYPE_TABLE
from ezdxf.lldxf.validator import entity_structure_validator
from ezdxf.recover import safe_tag_loader

from foparq.model.drawing import Repair
from foparq.read.dxf.facts import LEAKS, STAND_IN

_HOLDERS = ("ENTITIES", "BLOCKS")  #: sections of entities
_STRUCTURE = frozenset({"SECTION", "ENDSEC", "BLOCK", "ENDBLK", "EOF"})
_KINDS = frozenset(factory.ENTITY_CLASSES) | _STRUCTURE
_LINKED = {"POLYLINE": "VERTEX", "INSERT": "ATTRIB"}  #: entities whose parts follow, up to a SEQEND
_LONGEST = 60  #: characters of a damaged value that are told
_R12 = "AC1009"
_SUBCLASS = 100  #: group code of a marker that files of R12 must not hold
_HANDLE = re.compile("[0-9A-Fa-f]{1,16}")
_EOF = b"0\nEOF\n"


@dataclass(frozen=True, slots=True)
class Aside:
    """A text DXF file without its damaged entities."""

    text: bytes  #: stand-ins in their place
    repairs: tuple[Repair, ...]  #: one a stand-in


@dataclass(frozen=True, slots=True)
class _Entity:
    """Lines from the tag that names the kind to the next of its sort."""

    line: int  #: number of the first, from 1
    lines: list[bytes]  #: group codes and values in turn

    @property
    def kind(self) -> str:
        return _text(self.lines[1]).upper() if self.lines and _begins(*self.lines[:2]) else ""

    @property
    def pairs(self) -> Iterator[tuple[bytes, bytes]]:
        return zip(self.lines[::2], self.lines[1::2], strict=True)

    def first(self, code: int) -> bytes:
        """First value of a group code; empty if there is none."""
        return next((value.strip() for found, value in self.pairs if _number(found) == code), b"")


def set_aside(path: Path, version: str, *, structure: bool) -> Aside | None:
    """Exchange the entities that cannot be loaded, in one pass over the file.

    Parameters
    ----------
    path : Path
        Text DXF file.
    version : str
        As in its header: ``"AC1027"``.
    structure : bool
        Whether groups of applications and extended data must be well formed too, as they must for ``ezdxf.recover``.

    Returns
    -------
    Aside or None
        ``None`` if no entity is damaged, or if a line is lost or too many, so that nobody knows where entities begin.
    """
    # What loads a single entity looks at nothing of the document but whether it is one of R12.
    old = version <= _R12
    document = new("R12" if old else "R2010")
    text, repairs, section = BytesIO(), [], ""
    with path.open("rb") as stream:
        for chain, following in _chains(_entities(stream)):
            head = chain[0]
            if head.kind in ("SECTION", "ENDSEC"):
                section = _text(head.first(2))
            fault = ""
            if section in _HOLDERS and head.kind not in _STRUCTURE:
                if any(_shifted(entity) for entity in chain):
                    return None
                fault = _fault(chain, following, document, structure=structure)
            if fault:
                repairs.append(Repair(code="ENTITY_SET_ASIDE", detail=fault, handle=_handle(head)))
                text.write(_stand_in(head, subclasses=not old))
            else:
                text.writelines(line for entity in chain for line in entity.lines)
    return Aside(text.getvalue(), tuple(repairs)) if repairs else None


def _entities(stream: BinaryIO) -> Iterator[_Entity]:
    entity = _Entity(1, [])
    for number, (code, value) in enumerate(zip(stream, stream, strict=False)):
        if entity.lines and _begins(code, value):
            yield entity
            entity = _Entity(2 * number + 1, [])
        entity.lines.extend((code, value))
    yield entity


def _chains(entities: Iterator[_Entity]) -> Iterator[tuple[list[_Entity], str]]:
    """Entities with the parts that follow them, and the kind of what comes next."""
    chain: list[_Entity] = []
    for entity in entities:
        part = _LINKED.get(chain[0].kind) if chain else None
        if part is not None and chain[-1].kind != "SEQEND" and entity.kind in (part, "SEQEND"):
            chain.append(entity)
            continue
        if chain:
            yield chain, entity.kind
        chain = [entity]
    yield chain, ""


def _shifted(entity: _Entity) -> bool:
    # The beginning of an entity among the values: the lines of several entities, out of step.
    return any(
        _number(value) == 0 and _text(code).upper() in _KINDS
        for value, code in zip(entity.lines[1::2], entity.lines[2::2], strict=False)
    )


def _fault(chain: list[_Entity], following: str, document: Any, *, structure: bool) -> str:  # noqa: ANN401
    """What keeps an entity or a part of it from being loaded; ``""`` if nothing does."""
    open_ended = chain[0].kind == "POLYLINE" or chain[0].first(66) not in (b"", b"0")
    for entity in chain:
        misplaced = next((line for line, (code, _) in _numbered(entity) if _number(code) is None), None)
        if misplaced is not None:
            return _words(entity, misplaced, f'"{_told(entity, misplaced)}" is no group code')
        reason = _refusal(entity, document, structure=structure)
        if reason:
            return _misfit(entity) or _words(entity, entity.line, reason)
    if chain[0].kind in _LINKED and open_ended and chain[-1].kind != "SEQEND" and following != "ENDSEC":
        return _words(chain[0], chain[0].line, f"{following} follows instead of SEQEND")
    return ""


def _refusal(entity: _Entity, document: Any, *, structure: bool) -> str:  # noqa: ANN401
    try:
        tags = Tags(safe_tag_loader(BytesIO(b"".join(entity.lines) + _EOF)))
        tags.pop()
        if structure:
            tags = Tags(entity_structure_validator(tags))
            if document.dxfversion == _R12:
                tags.remove_tags((_SUBCLASS,))
        factory.load(ExtendedTags(tags), document)
    except LEAKS as error:
        return " ".join(str(error).split()) or type(error).__name__
    return ""


def _misfit(entity: _Entity) -> str:
    """Line and value of the first tag that holds no number and should; ``""`` if there is none."""
    for line, (code, value) in _numbered(entity):
        number = int(code)
        wanted = TYPE_TABLE.get(number, str)
        if wanted is str:
            continue
        try:
            wanted(float(value))
        except (ValueError, OverflowError):
            return _words(entity, line + 1, f'"{_told(entity, line + 1)}" of group code {number} is no number')
    return ""


def _words(entity: _Entity, line: int, fault: str) -> str:
    return f"line {line}, {entity.kind}: {fault}"


def _numbered(entity: _Entity) -> Iterator[tuple[int, tuple[bytes, bytes]]]:
    return ((entity.line + 2 * n, pair) for n, pair in enumerate(entity.pairs))


def _told(entity: _Entity, line: int) -> str:
    return _text(entity.lines[line - entity.line])[:_LONGEST]


def _stand_in(entity: _Entity, *, subclasses: bool) -> bytes:
    handle = _handle(entity).encode()
    lines = [b"0", b"TEXT"]
    if handle:
        lines += [b"5", handle]
    if subclasses:
        lines += [b"100", b"AcDbEntity"]
    if entity.first(67) == b"1":
        lines += [b"67", b"1"]
    lines += [b"8", entity.first(8) or b"0"]
    if subclasses:
        lines += [b"100", b"AcDbText"]
    lines += [b"10", b"0.0", b"20", b"0.0", b"40", b"1.0", b"1", (STAND_IN + entity.kind).encode("ascii", "replace")]
    return b"\n".join([*lines, b""])


def _handle(entity: _Entity) -> str:
    handle = _text(entity.first(5))
    return handle if _HANDLE.fullmatch(handle) else ""


def _begins(code: bytes, value: bytes) -> bool:
    # A name that stands where no group code can be read begins an entity too: nothing else holds it.
    return _number(code) == 0 or (_number(code) is None and _text(value).upper() in _KINDS)


def _number(line: bytes) -> int | None:
    try:
        return int(line)
    except ValueError:
        return None


def _text(line: bytes) -> str:
    return line.strip().decode("utf-8", "replace")
