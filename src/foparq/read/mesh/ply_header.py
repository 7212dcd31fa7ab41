# SPDX-License-Identifier: MIT
"""The header of a PLY file: which columns follow, and in which form."""

import re
from dataclasses import dataclass

import numpy as np

from foparq.errors import UnreadableError
from foparq.read.mesh.text import decoded

_LONGEST = 1 << 20  #: bytes of a header
_END = re.compile(rb"(?:^|[\r\n])end_header[ \t]*(?:\r\n|\n|\r)")
_WHOLE = re.compile(r"[0-9]{1,18}")
_MOST = 1_000  #: elements or properties: each costs work in every row
_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float32": "f4", "float64": "f8", "int64": "i8", "uint64": "u8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_TEXTURES = ("texturefile", "texture_file")


@dataclass(frozen=True, slots=True)
class Property:
    """One column of an element."""

    name: str
    type: np.dtype  #: in the byte order of the file
    count: np.dtype | None  #: type of the number of entries, where the column holds a list in each row


@dataclass(frozen=True, slots=True)
class Element:
    """One table of the file."""

    name: str
    rows: int  #: as announced
    properties: tuple[Property, ...]

    @property
    def least(self) -> int:
        """Bytes of a row whose lists are empty, in a binary file."""
        return sum((one.count or one.type).itemsize for one in self.properties)

    @property
    def lists(self) -> bool:
        """Whether some column holds lists."""
        return any(one.count is not None for one in self.properties)


@dataclass(frozen=True, slots=True)
class Header:
    """What the header says."""

    form: str  #: ``"ascii"``, ``"binary_little_endian"``, ``"binary_big_endian"``
    version: str  #: ``"1.0"``
    elements: tuple[Element, ...]
    images: tuple[str, ...]  #: of comments ``TextureFile``
    end: int  #: first byte behind it

    @property
    def text(self) -> bool:
        """Whether the rows are lines of text."""
        return self.form == "ascii"


def read_header(data: bytes, file: str) -> Header:
    """Header of a PLY file.

    Raises
    ------
    UnreadableError
        If it does not end, or a line of it is none of a header.
    """
    end = _END.search(data, 0, _LONGEST)
    if end is None:
        raise UnreadableError("mesh.header-end", file=file, value="end_header")
    lines = decoded(data[: end.start() + 1]).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    work = _Work(file)
    for number, line in enumerate(lines[1:], start=2):
        work.take(number, line.split())
    if not work.form:
        raise UnreadableError("mesh.header-lacks", file=file, value="format", example="format ascii 1.0")
    elements = tuple(Element(name, rows, tuple(properties)) for name, rows, properties in work.elements)
    return Header(work.form, work.version, elements, tuple(work.images), end.end())


class _Work:
    """The lines that were understood so far."""

    def __init__(self, file: str) -> None:
        self._file = file
        self.form, self.version = "", ""
        self.elements: list[tuple[str, int, list[Property]]] = []
        self.images: list[str] = []

    def take(self, number: int, words: list[str]) -> None:
        """Understand one line."""
        match words:
            case [] | ["obj_info", *_]:
                return
            case ["comment", *rest]:
                if len(rest) > 1 and rest[0].lower().rstrip(":") in _TEXTURES:
                    self.images.append(" ".join(rest[1:]))
            case ["format", form, version] if form in _ORDERS and not self.form:
                self.form, self.version = form, version
            case ["element", name, rows] if (
                self.form and _WHOLE.fullmatch(rows) and self._new(name, [e[0] for e in self.elements])
            ):
                self.elements.append((name, int(rows), []))
            case ["property", "list", count, kind, name] if self._fits(name, count, kind) and count[0] not in "df":
                self.elements[-1][2].append(Property(name, self._type(kind), self._type(count)))
            case ["property", kind, name] if self._fits(name, kind):
                self.elements[-1][2].append(Property(name, self._type(kind), None))
            case _:
                line = " ".join(words)
                raise UnreadableError(
                    "mesh.line", file=self._file, line=number, value=line[:80], example="property float x"
                )

    def _fits(self, name: str, *kinds: str) -> bool:
        known = bool(self.form) and bool(self.elements) and all(kind in _TYPES for kind in kinds)
        return known and self._new(name, [one.name for one in self.elements[-1][2]])

    def _new(self, name: str, others: list[str]) -> bool:
        return name not in others and len(others) < _MOST

    def _type(self, kind: str) -> np.dtype:
        return np.dtype((_ORDERS[self.form] or "=") + _TYPES[kind])
