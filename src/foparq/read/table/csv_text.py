# SPDX-License-Identifier: MIT
"""A table as text, as a spreadsheet writes it.

Understood: UTF-8 with or without mark, UTF-16 with mark, else Windows-1252; semicolon, tab, comma or blanks between
cells; quoted cells; a first line ``sep=;``; empty lines.
"""

import contextlib
import csv
import io
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from foparq.errors import UnreadableError
from foparq.read.table.sheet import MOST_ROWS, Asked, Line, Sheet, header_at, likeness, sheet_of

MOST_BYTES = 50_000_000
_HEAD = 40  #: lines by which the separator is told
_SEPARATORS = (";", "\t", ",")
_BLANKS = ("  ", " ")  #: two blanks or more between cells, or any number
_CELL = re.compile(r'"([^"]*)"|(\S+)')
_SEPARATOR_LINE = re.compile(r'^"?sep=(.)"?\s*$', re.IGNORECASE)
_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))


def read_text(path: Path, asked: Asked) -> Sheet:
    """Table of a text file.

    Parameters
    ----------
    path : Path
        A regular file.

    Raises
    ------
    UnreadableError
        If the file is no text table, a column is missing or named twice, or a row is ragged.

    Notes
    -----
    Blanks separate cells only where every row then has as many as the header: a name with a blank, or a cell left
    empty, shifts its row. Two blanks or more are tried first, for they keep names of several words together.
    """
    text = _text(path)
    lines = text.splitlines()
    stated = _SEPARATOR_LINE.match(lines[0])
    if stated:
        lines[0] = ""
    separator = stated[1] if stated else _separator(path, lines, asked)
    if separator in _BLANKS:
        return _blank_separated(path, lines, asked)
    rows = _rows(path, lines, separator, asked)
    if not rows:
        raise UnreadableError("table.no-columns", file=path.name, value="", example=asked.example)
    return sheet_of(path.name, rows, asked, separator=separator)


def is_workbook(path: Path) -> bool:
    """Whether a file is an archive, as XLSX and ODS are."""
    with path.open("rb") as stream:
        return stream.read(4) == b"PK\x03\x04"


def _text(path: Path) -> str:
    size = path.stat().st_size
    if size > MOST_BYTES:
        raise UnreadableError("read.too-large", file=path.name, value=size, limit=MOST_BYTES)
    data = path.read_bytes()
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        raise UnreadableError("table.old-workbook", file=path.name, value="XLS")
    if data.startswith(b"%PDF-"):
        raise UnreadableError("table.not-csv", file=path.name, value="PDF")
    encoding = next((name for mark, name in _MARKS if data.startswith(mark)), "utf-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        raise UnreadableError("table.not-csv", file=path.name, value="NUL")
    if not text.strip():
        raise UnreadableError("read.empty", file=path.name)
    return text


def _separator(path: Path, lines: Sequence[str], asked: Asked) -> str:
    # The header tells: with the right separator it names what is asked for.
    best, most = "", (False, 0)
    for separator in (*_SEPARATORS, *_BLANKS):
        if (found := _likeness(lines[:_HEAD], separator, asked)) > most:
            best, most = separator, found
    if best:
        return best
    first = next(line for line in lines if line.strip())
    bare = re.sub(r'"[^"]*"', "", first)
    for separator in _SEPARATORS:
        if separator in bare:
            return separator
    raise UnreadableError("table.no-columns", file=path.name, value=first[:80], example=asked.example)


def _blank_separated(path: Path, lines: Sequence[str], asked: Asked) -> Sheet:
    for separator in _BLANKS:
        rows = _rows(path, lines, separator, asked)
        top = header_at(rows, asked)
        width = len(rows[top].cells)
        odd = next((line for line in rows[top + 1 :] if len(line.cells) != width), None)
        if odd is None and likeness(rows[top], asked)[0]:
            return sheet_of(path.name, rows, asked, separator=separator)
    if odd is None:
        return sheet_of(path.name, rows, asked, separator=separator)  # a column is missing
    raise UnreadableError(
        "table.blanks", file=path.name, line=odd.number, value=len(odd.cells), other=width, example=asked.example
    )


def _likeness(lines: Sequence[str], separator: str, asked: Asked) -> tuple[bool, int]:
    found: list[Line] = []
    with contextlib.suppress(csv.Error):  # quotes that end beyond the first lines, or do not match this separator
        found.extend(line for line in _cells(lines, separator) if len(line.cells) > 1)
    return likeness(found[header_at(found, asked)], asked) if found else (False, 0)


def _rows(path: Path, lines: Sequence[str], separator: str, asked: Asked) -> list[Line]:
    rows: list[Line] = []
    try:
        for line in _cells(lines, separator):
            rows.append(line)
            if len(rows) > MOST_ROWS:
                raise UnreadableError("table.too-many-rows", file=path.name, limit=MOST_ROWS)
    except csv.Error as error:
        number = rows[-1].number + 1 if rows else 1
        raise UnreadableError(
            "table.broken", file=path.name, line=number, value=str(error), example=asked.example
        ) from None
    return rows


def _cells(lines: Sequence[str], separator: str) -> Iterator[Line]:
    # Lines that are not empty. A quoted cell may go over several lines of the file: its row stands in the first.
    if separator in _BLANKS:
        for number, line in enumerate(lines, start=1):
            if line.strip():
                yield Line(number, _between_blanks(line.strip(), separator))
        return
    reader = csv.reader(io.StringIO("\n".join(lines)), delimiter=separator, strict=True)
    number = 1
    for cells in reader:
        stripped = tuple(cell.strip() for cell in cells)
        if any(stripped):
            yield Line(number, stripped)
        number = reader.line_num + 1


def _between_blanks(line: str, separator: str) -> tuple[str, ...]:
    if separator == " ":
        return tuple((quoted or bare).strip() for quoted, bare in _CELL.findall(line))
    return tuple(cell.strip('" ') for cell in re.split(r"\s{2,}", line))
