# SPDX-License-Identifier: MIT
"""What a text DXF file holds and cannot mean: exchanged in memory, so that all else is read, and nothing is made up.

An entity gives way to a stand-in: a text with its handle, layer and space, which is counted where the entity was drawn,
in every insert of a block, and moves no other entity from its place in the file. A header variable is left out. In a
table or an object, nought stands for a value that decides nothing; where it decides something, the file is refused.
"""

from dataclasses import dataclass
from enum import IntEnum
from io import BytesIO
from itertools import pairwise
from pathlib import Path

from ezdxf.entities import factory
from ezdxf.filemanagement import new
from ezdxf.lldxf.extendedtags import ExtendedTags
from ezdxf.lldxf.tags import Tags
from ezdxf.lldxf.types import POINT_CODES
from ezdxf.lldxf.validator import entity_structure_validator
from ezdxf.recover import safe_tag_loader

from foparq.errors import UnreadableError
from foparq.model.drawing import Repair
from foparq.read.dxf.facts import LEAKS, STAND_IN
from foparq.read.dxf.tags import (
    HANDLE,
    HOLDERS,
    KINDS,
    LAYER,
    LINKED,
    STRUCTURE,
    Entity,
    Screen,
    chains,
    entities,
    group_code,
    is_number,
    out_of_step,
    text_of,
    whole_as_real,
)
from foparq.read.dxf.text import readable

#: whose numbers decide what is seen, and where: layer state, base point, clipping; and what leads to all others
_DECIDING = frozenset({"LAYER", "BLOCK", "SPATIAL_FILTER", "DICTIONARY"})
_LONGEST = 60  #: characters of a damaged value that are told
_R12 = "AC1009"
_SUBCLASS, _EMBEDDED = 100, 101  #: group codes of markers
_EOF = b"0\nEOF\n"


class Depth(IntEnum):
    """How closely entities are looked at; each looks at all that those before it do."""

    NUMBERS = 0  #: what is no number; what no way of reading tells: two entities in one
    POINTS = 1  #: a point without its y, which mending drops without a word
    LOADING = 2  #: whatever keeps the entity from being loaded
    STRUCTURE = 3  #: also groups of applications and extended data, which mending wants well formed


@dataclass(frozen=True, slots=True)
class Aside:
    """A text DXF file without what is damaged."""

    text: bytes
    repairs: tuple[Repair, ...]  #: one for each thing that was exchanged or left out


@dataclass(frozen=True, slots=True)
class _Fault:
    """What is wrong with an entity; the fields are those of a repair."""

    code: str
    line: int
    group: int = -1
    text: str = ""
    detail: str = ""


def set_aside(path: Path, version: str, encoding: str, depth: Depth) -> Aside | None:
    """Exchange what is damaged, in one pass over the file.

    Parameters
    ----------
    path : Path
        Text DXF file.
    version : str
        As in its header: ``"AC1027"``.
    encoding : str
        Of its names.
    depth : Depth
        How closely entities are looked at.

    Returns
    -------
    Aside or None
        ``None`` if nothing is damaged, or, where entities are loaded, if a line is lost or too many, so that nobody
        knows where they begin.

    Raises
    ------
    UnreadableError
        If a value that is no number decides what the drawing shows.
    """
    work = _Work(path.name, encoding, depth, old=version <= _R12)
    section = ""
    with path.open("rb") as stream:
        for chain, following in chains(entities(stream)):
            head = chain[0]
            if head.kind in ("SECTION", "ENDSEC"):
                section = text_of(head.first(2))
            if section in HOLDERS and head.kind not in STRUCTURE:
                if depth >= Depth.LOADING and any(map(out_of_step, chain)):
                    return None
                work.entity(chain, following)
            elif section == "HEADER":
                work.header(head)
            else:
                for part in chain:
                    work.others(part)
    return Aside(work.text.getvalue(), tuple(work.repairs)) if work.repairs else None


class _Work:
    """The text that is made, and what it took."""

    def __init__(self, file: str, encoding: str, depth: Depth, *, old: bool) -> None:
        self.text, self.repairs = BytesIO(), list[Repair]()
        self._screen = Screen()
        self._file, self._encoding, self._depth, self._old = file, encoding, depth, old
        # What loads a single entity looks at nothing of the document but whether it is one of R12.
        self._document = new("R12" if old else "R2010") if depth >= Depth.LOADING else None

    def entity(self, chain: list[Entity], following: str) -> None:
        head = chain[0]
        fault = self._fault(chain, following)
        if fault is None:
            for part in chain:
                self.others(part)
            return
        if any(map(out_of_step, chain)):
            raise self._refusal(head, fault)
        layer = readable(self._told(head.first(LAYER))) or "0"
        self.repairs.append(self._repair(head, fault, head.kind, layer))
        self.text.write(_stand_in(head, subclasses=not self._old))

    def header(self, head: Entity) -> None:
        """Variables but those that hold what is no number."""
        variable: list[tuple[int, tuple[bytes, bytes]]] = []
        for numbered in head.numbered:
            if group_code(numbered[1][0]) == 9:  # noqa: PLR2004 - group code of the name of a variable
                self._variable(head, variable)
                variable = []
            variable.append(numbered)
        self._variable(head, variable)

    def others(self, part: Entity) -> None:
        """The lines as they are, but for numbers that are none or written otherwise."""
        if self._screen.passes(part.pairs):
            self.text.writelines(part.lines)
            return
        for line, (code, value) in part.numbered:
            number = group_code(code)
            if number is not None and not is_number(number, value):
                fault = self._value("read-as-zero", line, number, value)
                if part.kind in _DECIDING:
                    raise self._refusal(part, fault)
                self._tell(part, fault)
                self.text.write(code + b"0\n")
            else:
                self._write(part, line, code, value)

    def _variable(self, head: Entity, variable: list[tuple[int, tuple[bytes, bytes]]]) -> None:
        for line, (code, value) in variable:
            number = group_code(code)
            if number is not None and not is_number(number, value):
                name = text_of(variable[0][1][1])[:_LONGEST]
                fault = self._value("header-variable", line, number, value)
                self.repairs.append(self._repair(head, fault, name))
                return
        for line, (code, value) in variable:
            self._write(head, line, code, value)

    def _write(self, part: Entity, line: int, code: bytes, value: bytes) -> None:
        number = group_code(code)
        if number is not None and whole_as_real(number, value):
            self._tell(part, self._value("whole-as-real", line, number, value))
            value = b"%d\n" % int(float(value))
        self.text.write(code + value)

    def _fault(self, chain: list[Entity], following: str) -> _Fault | None:
        for part in chain:
            sound = self._screen.passes(part.pairs)
            fault = None if sound else self._misfit(part) or _run_together(part)
            if fault is None and self._depth >= Depth.POINTS:
                fault = _half_point(part)
            if fault is None and self._depth >= Depth.LOADING:
                fault = self._unloadable(part)
            if fault is not None:
                return fault
        head = chain[0]
        open_ended = head.kind == "POLYLINE" or head.first(66) not in (b"", b"0")
        ends = chain[-1].kind == "SEQEND" or following == "ENDSEC"
        if self._depth >= Depth.LOADING and head.kind in LINKED and open_ended and not ends:
            return _Fault("no-seqend", head.line, text=following)
        return None

    def _misfit(self, part: Entity) -> _Fault | None:
        """The first line that holds no group code, or no number and should."""
        for line, (code, value) in part.numbered:
            number = group_code(code)
            if number is None:
                return _Fault("no-group-code", line, text=self._told(code))
            if not is_number(number, value):
                return self._value("no-number", line, number, value)
        return None

    def _unloadable(self, part: Entity) -> _Fault | None:
        try:
            tags = Tags(safe_tag_loader(BytesIO(b"".join(part.lines) + _EOF)))
            tags.pop()
            if self._depth >= Depth.STRUCTURE:
                tags = Tags(entity_structure_validator(tags))
                if self._old:
                    tags.remove_tags((_SUBCLASS,))
            factory.load(ExtendedTags(tags), self._document)
        except LEAKS as error:
            return _Fault("unloadable", part.line, detail=" ".join(str(error).split()) or type(error).__name__)
        return None

    def _value(self, code: str, line: int, group: int, value: bytes) -> _Fault:
        return _Fault(code, line + 1, group, self._told(value))

    def _told(self, value: bytes) -> str:
        return text_of(value, self._encoding)[:_LONGEST]

    def _tell(self, head: Entity, fault: _Fault) -> None:
        self.repairs.append(self._repair(head, fault, head.kind))

    def _repair(self, head: Entity, fault: _Fault, kind: str, layer: str = "") -> Repair:
        return Repair(
            code=fault.code, detail=fault.detail, handle=head.handle, line=fault.line, kind=kind, layer=layer,
            group=fault.group, text=fault.text,
        )  # fmt: skip

    def _refusal(self, part: Entity, fault: _Fault) -> UnreadableError:
        reason = f"{part.kind}: {fault.group} = {fault.text!r}"
        return UnreadableError("dxf.unreadable-line", file=self._file, line=fault.line, reason=reason)


def _run_together(part: Entity) -> _Fault | None:
    """A second handle or layer: the line that names the kind of the next entity is lost, and two look like one."""
    if part.kind not in KINDS:  # of an application: what it holds twice is its own affair
        return None
    known = set()
    for line, (code, value) in part.numbered:
        number = group_code(code)
        if number == _EMBEDDED:
            break
        if number in (HANDLE, LAYER):
            if number in known:
                return _Fault("run-together", line + 1, number, text_of(value)[:_LONGEST])
            known.add(number)
    return None


def _half_point(part: Entity) -> _Fault | None:
    """A point without its y. A LINE may give all its x before all its y."""
    codes = [group_code(code) for code in part.lines[::2]]
    for n, (code, following) in enumerate(pairwise([*codes, None])):
        if code in POINT_CODES and following != code + 10 and not (part.kind == "LINE" and code + 10 in codes):
            return _Fault("no-y", part.line + 2 * n, code)
    return None


def _stand_in(entity: Entity, *, subclasses: bool) -> bytes:
    lines = [b"0", b"TEXT"]
    if handle := entity.handle.encode():
        lines += [b"5", handle]
    if subclasses:
        lines += [b"100", b"AcDbEntity"]
    if entity.first(67) == b"1":
        lines += [b"67", b"1"]
    lines += [b"8", entity.first(LAYER) or b"0"]
    if subclasses:
        lines += [b"100", b"AcDbText"]
    lines += [b"10", b"0.0", b"20", b"0.0", b"40", b"1.0", b"1", (STAND_IN + entity.kind).encode("ascii", "replace")]
    return b"\n".join([*lines, b""])
