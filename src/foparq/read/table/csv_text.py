# SPDX-License-Identifier: MIT
"""A table as a spreadsheet writes it: cells with the line they stand in, numbers as they are printed.

Understood: UTF-8 with or without mark, UTF-16 with mark, else Windows-1252; semicolon, tab or comma between cells;
quoted cells; a first line ``sep=;``; decimal point or decimal comma; empty lines, and lines whose first cell starts
with ``#``. Never guessed: a number that could be read in two ways.
"""

import csv
import io
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from foparq.errors import UnreadableError
from foparq.units import LENGTHS

MOST_BYTES = 50_000_000
MOST_ROWS = 1_000_000
_LONGEST_NUMBER = 40
_NUMBER = re.compile(r"^[+-]?(?P<whole>\d+)?(?P<separator>[.,])?(?P<decimals>\d+)?(?:[eE](?P<exponent>[+-]?\d{1,3}))?$")
_SEPARATOR_LINE = re.compile(r'^"?sep=(.)"?\s*$', re.IGNORECASE)
_IN_BRACKETS = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """A table of n rows."""

    file: str
    header: tuple[str, ...]  #: as written
    at: Mapping[str, int]  #: our name of a column to its place
    lines: tuple[int, ...]  #: (n,) line of the file, from 1
    rows: tuple[tuple[str, ...], ...]  #: (n,) cells, stripped
    ignored: tuple[str, ...]  #: columns that nobody asked for, as written

    def texts(self, column: str) -> list[str]:
        """(n,) cells of a column; empty texts if the file has no such column."""
        if column not in self.at:
            return [""] * len(self.rows)
        place = self.at[column]
        return [row[place] for row in self.rows]

    def fault(self, message: str, row: int, column: str, example: str) -> UnreadableError:
        """Error that names the cell."""
        return UnreadableError(
            message, file=self.file, line=self.lines[row], key=self.header[self.at[column]],
            value=self.texts(column)[row], example=example,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Number:
    """A number as printed."""

    value: Decimal
    decimals: int  #: digits after the decimal sign; negative for 1e3


def read_sheet(path: Path, *, known: Mapping[str, Sequence[str]], required: Sequence[str], example: str) -> Sheet:
    """Table of a CSV file.

    Parameters
    ----------
    path : Path
        A regular file.
    known : mapping
        Our name of a column to the names a person may give it. Compared without case, accents, blanks, and a unit in
        brackets at the end.
    required : sequence of str
        Our names of the columns that must be there.
    example : str
        A right first line.

    Raises
    ------
    UnreadableError
        If the file is no text table, a column is missing or named twice, a row is ragged, or both decimal signs occur.
    """
    text = _text(path)
    separator, lines = _separator(path, text, example)
    rows = _rows(path, lines, separator, example)
    first, header = rows[0]
    at, ignored = _columns(path, first, header, known, required, example)
    body = [(line, _fitted(path, line, row, len(header), separator)) for line, row in rows[1:]]
    return Sheet(
        file=path.name,
        header=tuple(header),
        at=at,
        lines=tuple(line for line, _ in body),
        rows=tuple(row for _, row in body),
        ignored=ignored,
    )


def number_of(text: str) -> Number | None:
    """Number as a person printed it, with decimal point or comma; ``None`` if it is none, or could be two.

    ``1.234,5`` and ``1 234`` are ``None``: what separates thousands here separates decimals there.

    Examples
    --------
    >>> number_of("-12,340")
    Number(value=Decimal('-12.340'), decimals=3)
    >>> number_of("1.234,5") is None
    True
    """
    plain = text.strip().replace("\u2212", "-")
    found = _NUMBER.match(plain)
    if (
        found is None
        or len(plain) > _LONGEST_NUMBER
        or not plain.isascii()
        or not (found["whole"] or found["decimals"])
        or (found["separator"] and not found["decimals"])
    ):
        return None
    exponent = int(found["exponent"] or 0)
    return Number(Decimal(plain.replace(",", ".")), len(found["decimals"] or "") - exponent)


def unit_in_header(name: str) -> str:
    """Unit that a column's name carries in brackets: ``"mm"`` of ``"X (mm)"``; ``""`` if none."""
    found = _IN_BRACKETS.search(name)
    return found[1] if found and found[1] in LENGTHS else ""


def _text(path: Path) -> str:
    size = path.stat().st_size
    if size > MOST_BYTES:
        raise UnreadableError("read.too-large", file=path.name, value=size, limit=MOST_BYTES)
    data = path.read_bytes()
    if not data.strip():
        raise UnreadableError("read.empty", file=path.name)
    for magic, name in ((b"PK\x03\x04", "XLSX/ODS"), (b"\xd0\xcf\x11\xe0", "XLS"), (b"%PDF-", "PDF")):
        if data.startswith(magic):
            raise UnreadableError("table.not-csv", file=path.name, value=name)
    encoding = next((name for mark, name in _MARKS if data.startswith(mark)), "utf-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        raise UnreadableError("table.not-csv", file=path.name, value="NUL")
    return text


def _separator(path: Path, text: str, example: str) -> tuple[str, list[str]]:
    # The header decides: it is the line that holds no decimal commas.
    lines = text.splitlines()
    stated = _SEPARATOR_LINE.match(lines[0])
    if stated:
        return stated[1], ["", *lines[1:]]
    header = next((line for line in lines if line.strip() and not line.lstrip('" ').startswith("#")), "")
    bare = re.sub(r'"[^"]*"', "", header)
    for separator in (";", "\t", ","):
        if separator in bare:
            return separator, lines
    raise UnreadableError("table.no-columns", file=path.name, value=header[:80], example=example)


def _rows(path: Path, lines: list[str], separator: str, example: str) -> list[tuple[int, list[str]]]:
    rows: list[tuple[int, list[str]]] = []
    reader = csv.reader(io.StringIO("\n".join(lines)), delimiter=separator, strict=True)
    try:
        start = 1
        for cells in reader:
            stripped = [cell.strip() for cell in cells]
            if any(stripped) and not stripped[0].startswith("#"):
                rows.append((start, stripped))
            start = reader.line_num + 1
            if len(rows) > MOST_ROWS:
                raise UnreadableError("table.too-many-rows", file=path.name, limit=MOST_ROWS)
    except csv.Error as error:
        raise UnreadableError(
            "table.broken", file=path.name, line=reader.line_num, value=str(error), example=example
        ) from None
    if not rows:
        raise UnreadableError("table.no-columns", file=path.name, value="", example=example)
    return rows


def _columns(
    path: Path, line: int, header: list[str], known: Mapping[str, Sequence[str]], required: Sequence[str], example: str
) -> tuple[dict[str, int], tuple[str, ...]]:
    ours = {_plain(name): column for column, names in known.items() for name in (column, *names)}
    at: dict[str, int] = {}
    ignored: list[str] = []
    for place, name in enumerate(header):
        column = ours.get(_plain(name))
        if column is None:
            if name:
                ignored.append(name)
        elif column in at:
            raise UnreadableError(
                "table.column-twice",
                file=path.name,
                line=line,
                key=column,
                value=f"{header[at[column]]}, {name}",
                example=example,
            )
        else:
            at[column] = place
    for column in required:
        if column not in at:
            raise UnreadableError(
                "table.column-missing",
                file=path.name,
                line=line,
                key=column,
                value=", ".join(header)[:200],
                example=example,
            )
    return at, tuple(ignored)


def _plain(name: str) -> str:
    bare = _IN_BRACKETS.sub("", name)
    letters = unicodedata.normalize("NFKD", bare.casefold())
    return re.sub(r"[\s_.\-]+", "", "".join(c for c in letters if not unicodedata.combining(c)))


def _fitted(path: Path, line: int, row: list[str], width: int, separator: str) -> tuple[str, ...]:
    # Spreadsheets drop or add empty cells at the end of a row; anything else is a row that shifted.
    while len(row) > width and not row[-1]:
        row = row[:-1]
    if len(row) != width:
        raise UnreadableError("table.ragged", file=path.name, line=line, key=separator, value=len(row), example=width)
    return tuple(row)
