# SPDX-License-Identifier: MIT
"""A table as rows of cells, whatever kind of file it came from, and the columns that somebody asked for.

The header is the first line that names what must be there. No row below it is ever left out but for empty ones.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from foparq.errors import UnreadableError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.read.table.names import Names, plain_name

MOST_ROWS = 1_000_000
_ABOVE = 20  #: lines among which the header is looked for
_SHOWN = 80  #: letters of a line that a message repeats


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """What is asked of a table."""

    known: Names
    required: tuple[str, ...]  #: our names of the columns that must be there
    example: str  #: a right first line


@dataclass(frozen=True, slots=True)
class Line:
    """A line that is not empty."""

    number: int  #: in the file, from 1
    cells: tuple[str, ...]  #: stripped


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """A table of n rows."""

    file: str
    header: tuple[str, ...]  #: as written
    at: Mapping[str, int]  #: our name of a column to its place
    lines: tuple[int, ...]  #: (n,) line of the file, from 1
    rows: tuple[tuple[str, ...], ...]  #: (n,) cells, stripped
    ignored: tuple[str, ...]  #: columns that nobody asked for, as written
    skipped: tuple[Skipped, ...]  #: remarks above the header

    def texts(self, column: str) -> list[str]:
        """(n,) cells of a column; empty texts if the file has no such column."""
        if column not in self.at:
            return [""] * len(self.rows)
        place = self.at[column]
        return [row[place] for row in self.rows]

    def fault(self, message: str, row: int, column: str, *, example: str, **fields: object) -> UnreadableError:
        """Error that names the cell."""
        return UnreadableError(
            message, file=self.file, line=self.lines[row], key=self.header[self.at[column]],
            value=self.texts(column)[row], example=example, **fields,
        )  # fmt: skip


def sheet_of(file: str, lines: Sequence[Line], asked: Asked, *, separator: str) -> Sheet:
    """Table of lines.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    lines : sequence of Line
        At least one.
    separator : str
        What stands between cells, for messages.

    Raises
    ------
    UnreadableError
        If a column is missing or named twice, a row is ragged, or more than a remark stands above the header.
    """
    top = header_at(lines, asked)
    header = lines[top]
    skipped = _remarks(file, lines[:top], header)
    at, ignored = _columns(file, header, asked)
    width = len(header.cells)
    return Sheet(
        file=file,
        header=header.cells,
        at=at,
        lines=tuple(line.number for line in lines[top + 1 :]),
        rows=tuple(_fitted(file, line, width, separator) for line in lines[top + 1 :]),
        ignored=ignored,
        skipped=skipped,
    )


def header_at(lines: Sequence[Line], asked: Asked) -> int:
    """Which of the first lines names most of the columns; the first of equals."""
    first = lines[:_ABOVE]
    return max(range(len(first)), key=lambda n: (*likeness(first[n], asked), -n))


def likeness(line: Line, asked: Asked) -> tuple[bool, int]:
    """How much a line looks like the header: whether it names all columns that must be there, and how many of all."""
    named = {column for name in line.cells if (column := _ours(asked).get(plain_name(name)))}
    return named.issuperset(asked.required), len(named)


def _ours(asked: Asked) -> dict[str, str]:
    return {plain_name(name): column for column, names in asked.known.items() for name in (column, *names)}


def _remarks(file: str, above: Sequence[Line], header: Line) -> tuple[Skipped, ...]:
    # A title in one cell is a remark, and told; more than that may be a row that somebody sorted upward.
    for line in above:
        if sum(map(bool, line.cells)) > 1:
            raise UnreadableError(
                "table.above-header", file=file, line=line.number, value=_shown(line), other=header.number,
                example=_shown(header),
            )  # fmt: skip
    return tuple(
        Skipped(reason=SkippedReason.ABOVE_HEADER, kind="", layer="", count=1, name=_shown(line)) for line in above
    )


def _shown(line: Line) -> str:
    return " ".join(filter(None, line.cells))[:_SHOWN]


def _columns(file: str, header: Line, asked: Asked) -> tuple[dict[str, int], tuple[str, ...]]:
    ours = _ours(asked)
    at: dict[str, int] = {}
    ignored: list[str] = []
    for place, name in enumerate(header.cells):
        column = ours.get(plain_name(name))
        if column is None:
            if name:
                ignored.append(name)
        elif column in at:
            raise UnreadableError(
                "table.column-twice", file=file, line=header.number, key=column,
                value=f"{header.cells[at[column]]}, {name}", example=asked.example,
            )  # fmt: skip
        else:
            at[column] = place
    for column in asked.required:
        if column not in at:
            raise UnreadableError(
                "table.column-missing", file=file, line=header.number, key=column,
                value=", ".join(header.cells)[:200], example=asked.example,
            )  # fmt: skip
    return at, tuple(ignored)


def _fitted(file: str, line: Line, width: int, separator: str) -> tuple[str, ...]:
    # Spreadsheets drop or add empty cells at the end of a row; anything else is a row that shifted.
    cells = line.cells
    while len(cells) > width and not cells[-1]:
        cells = cells[:-1]
    if len(cells) != width:
        raise UnreadableError(
            "table.ragged", file=file, line=line.number, key=separator, value=len(cells), example=width
        )
    return cells
