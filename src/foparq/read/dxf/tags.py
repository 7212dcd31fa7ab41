# SPDX-License-Identifier: MIT
"""Lines of a text DXF file as they stand there: group codes and values in turn, cut where an entity begins."""

import math
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import BinaryIO

from ezdxf.entities import factory
from ezdxf.lldxf.types import TYPE_TABLE

HOLDERS = ("ENTITIES", "BLOCKS")  #: sections of entities
STRUCTURE = frozenset({"SECTION", "ENDSEC", "BLOCK", "ENDBLK", "EOF"})
KINDS = frozenset(factory.ENTITY_CLASSES) | STRUCTURE
LINKED = {"POLYLINE": "VERTEX", "INSERT": "ATTRIB"}  #: entities whose parts follow, up to a SEQEND
HANDLE, LAYER = 5, 8  #: group codes that an entity holds once

# Python reads more as a number than the format knows: "nan", "1_0", digits of other scripts.
_WHOLE = re.compile(rb"\s*[+-]?[0-9]{1,20}\s*")
_REAL = re.compile(rb"\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*")
_SHORT = re.compile(rb"\s*[+-]?[0-9]{1,40}(\.[0-9]*)?([eE][+-]?[0-9]{1,2})?\s*")  #: finite for certain
_HANDLE = re.compile("[0-9A-Fa-f]{1,16}")

Pair = tuple[bytes, bytes]


@dataclass(frozen=True, slots=True)
class Entity:
    """Lines from the tag that names the kind to the next of its sort."""

    line: int  #: number of the first, from 1
    lines: list[bytes]  #: group codes and values in turn

    @property
    def kind(self) -> str:
        """``"LINE"``; ``""`` if the lines do not begin with a kind."""
        return text_of(self.lines[1]).upper() if self.lines and _begins(*self.lines[:2]) else ""

    @property
    def handle(self) -> str:
        """Handle as written; ``""`` if there is none, or none that is one."""
        handle = text_of(self.first(HANDLE))
        return handle if _HANDLE.fullmatch(handle) else ""

    @property
    def pairs(self) -> Iterator[Pair]:
        """Group codes with their values."""
        return zip(self.lines[::2], self.lines[1::2], strict=True)

    @property
    def numbered(self) -> Iterator[tuple[int, Pair]]:
        """The same, each with the number of its first line."""
        return ((self.line + 2 * n, pair) for n, pair in enumerate(self.pairs))

    def first(self, code: int) -> bytes:
        """First value of a group code; empty if there is none."""
        return next((value.strip() for found, value in self.pairs if group_code(found) == code), b"")


def entities(stream: BinaryIO) -> Iterator[Entity]:
    """Everything that begins with a kind, structure included."""
    entity = Entity(1, [])
    for number, (code, value) in enumerate(zip(stream, stream, strict=False)):
        if entity.lines and _begins(code, value):
            yield entity
            entity = Entity(2 * number + 1, [])
        entity.lines.extend((code, value))
    yield entity


def chains(parts: Iterable[Entity]) -> Iterator[tuple[list[Entity], str]]:
    """Entities with the parts that follow them, and the kind of what comes next."""
    chain: list[Entity] = []
    for entity in parts:
        part = LINKED.get(chain[0].kind) if chain else None
        if part is not None and chain[-1].kind != "SEQEND" and entity.kind in (part, "SEQEND"):
            chain.append(entity)
            continue
        if chain:
            yield chain, entity.kind
        chain = [entity]
    yield chain, ""


def out_of_step(entity: Entity) -> bool:
    """Whether another entity begins among the values: a line is lost, or one too many."""
    return any(
        group_code(value) == 0 and text_of(code).upper() in KINDS
        for value, code in zip(entity.lines[1::2], entity.lines[2::2], strict=False)
    )


@lru_cache(maxsize=4096)  # a file has few, on half of its lines
def group_code(line: bytes) -> int | None:
    """Group code of a line, or ``None`` if it holds none."""
    return int(line) if _WHOLE.fullmatch(line) else None


def text_of(line: bytes, encoding: str = "utf-8") -> str:
    """Text of a line, for people to read."""
    return line.strip().decode(encoding, "replace")


def is_number(code: int, value: bytes) -> bool:
    """Whether a value is the finite number that its group code asks for; true where it asks for a text.

    A whole number may be written as a real one, ``3.0``, as some programs do.
    """
    wanted = TYPE_TABLE.get(code, str)
    if wanted is str:
        return True
    if wanted is int and _WHOLE.fullmatch(value):
        return True
    if not _REAL.fullmatch(value):
        return False
    number = float(value)
    return number.is_integer() if wanted is int else math.isfinite(number)


def whole_as_real(code: int, value: bytes) -> bool:
    """Whether a whole number is written as a real one."""
    return TYPE_TABLE.get(code, str) is int and not _WHOLE.fullmatch(value) and is_number(code, value)


class Screen(dict[bytes, Callable[[bytes], object]]):
    """What a value must meet, by the line of its group code; costs a fraction of the time that reading takes."""

    def __init__(self) -> None:
        super().__init__()
        self._once: set[int] = set()  # of these, the entity has one

    def passes(self, pairs: Iterable[Pair]) -> bool:
        """Whether every value is for certain the number that is due, and no entity holds two handles or layers."""
        return all(self[code](value) for code, value in pairs)

    def __missing__(self, line: bytes) -> Callable[[bytes], object]:
        code = group_code(line)
        test: Callable[[bytes], object]
        if code is None:
            test = _never
        elif code == 0:
            test = self._begin
        elif code in (HANDLE, LAYER):
            test = self._first_handle if code == HANDLE else self._first_layer
        else:
            wanted = TYPE_TABLE.get(code, str)
            test = _always if wanted is str else (_WHOLE if wanted is int else _SHORT).fullmatch
        self[line] = test
        return test

    def _begin(self, _value: bytes) -> bool:
        self._once.clear()
        return True

    def _first_handle(self, _value: bytes) -> bool:
        return self._first(HANDLE)

    def _first_layer(self, _value: bytes) -> bool:
        return self._first(LAYER)

    def _first(self, code: int) -> bool:
        known = code in self._once
        self._once.add(code)
        return not known


def _always(_value: bytes) -> bool:
    return True


def _never(_value: bytes) -> bool:
    return False


def _begins(code: bytes, value: bytes) -> bool:
    # A name that stands where no group code can be read begins an entity too: nothing else holds it.
    number = group_code(code)
    return number == 0 or (number is None and text_of(value).upper() in KINDS)
