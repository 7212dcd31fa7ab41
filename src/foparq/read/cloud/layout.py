# SPDX-License-Identifier: MIT
"""How a text of points is written: what separates its cells, which of them are x, y and z, and the decimal sign."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from foparq.errors import UnreadableError
from foparq.read.mesh.numbers import real
from foparq.read.mesh.text import decoded

EXAMPLE = "1.250 0.375 2.000"
_HEAD = 1 << 16  #: bytes by which it is told
_AXES = ("x", "y", "z")
_REMARK = re.compile(r"^(?://|#)\s*")
_TRIMMED = " \t\r\n\v\f\"'"
#: a number whose commas may part thousands
_THOUSANDS = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+")
_WITH_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")


@dataclass(frozen=True, slots=True)
class Layout:
    """How the lines of a text are to be read."""

    separator: str  #: ``";"``, ``"\\t"``, ``","``, or ``""`` for blanks
    columns: tuple[int, int, int]  #: cells of x, y and z, from 0
    comma: bool  #: decimals stand behind a comma
    begin: int  #: first byte of the points


def layout_of(data: bytes, file: str) -> Layout:
    """Layout of a text, told by its first lines.

    Raises
    ------
    UnreadableError
        If its columns are named and none is x, y or z, or its commas may be decimal or part thousands.
    """
    begin = 3 if data.startswith(b"\xef\xbb\xbf") else 0
    lines = decoded(data[begin:_HEAD]).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    lines = lines[:-1] if len(data) > _HEAD else lines
    points = [line for line in lines if line.strip() and not _REMARK.match(line.strip())]
    named, head = _header(lines)
    body = points[1:] if named and points and points[0] == head else points
    separator = _separator(body or points)
    columns = (0, 1, 2)
    if named:
        columns = _columns(head, separator, file)
        if body is not points:
            begin += _behind(data[begin:], head)
    cells = [cells_of(line, separator) for line in body]
    chosen = [row[k] for row in cells for k in columns if k < len(row)]
    return Layout(separator, columns, _comma(chosen, separator, file), begin)


def cells_of(line: str, separator: str) -> list[str]:
    """Cells of a line, without blanks and quotes around."""
    return [cell.strip(_TRIMMED) for cell in (line.split(separator) if separator else line.split())]


def _header(lines: Sequence[str]) -> tuple[bool, str]:
    """Whether a line before the points names columns, and that line."""
    remark = ""
    for line in lines:
        bare = line.strip()
        if not bare:
            continue
        if _REMARK.match(bare):
            if _named(_REMARK.sub("", bare)):
                remark = line
            continue
        words = [word.strip(_TRIMMED) for word in re.split(r"[;,\t ]+", bare) if word.strip(_TRIMMED)]
        if words and not any(_number(word) for word in words):
            return True, line
        break
    return bool(remark), remark


def _named(text: str) -> bool:
    return set(_AXES) <= {word.strip(_TRIMMED).casefold() for word in re.split(r"[;,\t ]+", text)}


def _number(word: str) -> bool:
    return real(word) is not None or bool(_WITH_COMMA.fullmatch(word))


def _columns(head: str, separator: str, file: str) -> tuple[int, int, int]:
    bare = _REMARK.sub("", head.strip())
    tried = (separator, *(sign for sign in (";", "\t", ",", "") if sign != separator and (not sign or sign in bare)))
    for sign in tried:
        names = [name.casefold() for name in cells_of(bare, sign)]
        if all(names.count(axis) == 1 for axis in _AXES):
            x, y, z = (names.index(axis) for axis in _AXES)
            return x, y, z
    raise UnreadableError("cloud.columns", file=file, value=bare[:80], example="x y z")


def _separator(lines: Sequence[str]) -> str:
    """What parts the cells of most lines; blanks where nothing else does."""
    for sign in (";", "\t"):
        if lines and sum(sign in line for line in lines) * 2 > len(lines):
            return sign
    # A comma within words that stand three and more in a line, apart, is decimal; else it separates.
    commas = [line for line in lines if "," in line]
    if len(commas) * 2 > len(lines):
        apart = [line.split() for line in commas]
        if not all(len(words) >= len(_AXES) and not any(w.endswith(",") or w == "," for w in words) for words in apart):
            return ","
    return ""


def _comma(words: Sequence[str], separator: str, file: str) -> bool:
    """Whether decimals stand behind a comma."""
    if separator == ",":
        return False
    commas = [word for word in words if "," in word]
    # The first number with a sign tells; one that is written otherwise is refused by its line.
    if not commas or "," not in next(word for word in words if "," in word or "." in word):
        return False
    if all(_THOUSANDS.fullmatch(word) for word in commas):
        raise UnreadableError("cloud.thousands", file=file, value=commas[0][:40], example="1234.567")
    return True


def _behind(data: bytes, head: str) -> int:
    """First byte behind the line that names the columns."""
    at = 0
    while at < len(data):
        ends = [end for sign in (b"\n", b"\r") if (end := data.find(sign, at, _HEAD)) >= 0]
        end = min(ends) + 1 if ends else len(data)
        if decoded(data[at:end]).strip() == head.strip():
            return end
        at = end
    return at
