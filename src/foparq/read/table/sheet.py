# SPDX-License-Identifier: MIT
"""A table as rows of cells, whatever kind of file it came from, and the columns that somebody asked for.

The header is the first line that names what must be there. No row below it is ever left out but for empty ones.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from foparq.errors import UnreadableError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.read.table.cells import Cell, Odd, OddKind, column_letters, is_empty, is_failed, shown
from foparq.read.table.names import Names, column_of, plain_name

MOST_ROWS = 1_000_000
_ABOVE = 20  #: lines among which the header is looked for
_SHOWN = 80  #: letters of a line that a message repeats


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """What is asked of a table."""

    known: Names
    required: tuple[str, ...]  #: our names of the columns that must be there
    example: str  #: a right first line
    phrases: Names = field(default_factory=dict)  #: further names, too many to be told


@dataclass(frozen=True, slots=True)
class Line:
    """A line that is not empty."""

    number: int  #: in the file, from 1
    cells: tuple[Cell, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sheet:
    """A table of n rows."""

    file: str
    header: tuple[str, ...]  #: as written
    at: Mapping[str, int]  #: our name of a column to its place
    lines: tuple[int, ...]  #: (n,) line of the file, from 1
    rows: tuple[tuple[Cell, ...], ...]  #: (n,)
    ignored: tuple[str, ...]  #: columns that nobody asked for, as written
    skipped: tuple[Skipped, ...]  #: remarks above the header, and sheets that nobody asked for
    addressed: bool  #: its cells have addresses: it is a sheet of a workbook

    def cells(self, column: str) -> list[Cell]:
        """(n,) cells of a column; empty if the file has no such column."""
        if column not in self.at:
            return [""] * len(self.rows)
        place = self.at[column]
        return [row[place] for row in self.rows]

    def texts(self, column: str) -> list[str]:
        """(n,) cells of a column as text."""
        return [shown(cell) for cell in self.cells(column)]

    def key(self, row: int, column: str) -> str:
        """Name of a column for messages, with the address of the cell where it has one: ``"x (B7)"``."""
        place = self.at[column]
        address = f" ({column_letters(place)}{self.lines[row]})" if self.addressed else ""
        return f"{self.header[place]}{address}"

    def fault(self, message: str, row: int, column: str, *, example: str, **fields: object) -> UnreadableError:
        """Error that names the cell."""
        return UnreadableError(
            message, file=self.file, line=self.lines[row], key=self.key(row, column),
            value=shown(self.rows[row][self.at[column]]), example=example, **fields,
        )  # fmt: skip


def sheet_of(
    file: str, lines: Sequence[Line], asked: Asked, *, separator: str = "", skipped: Sequence[Skipped] = ()
) -> Sheet:
    """Table of lines.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    lines : sequence of Line
        At least one.
    separator : str
        What stands between cells; ``""``: they are those of a workbook, and have addresses.
    skipped : sequence of Skipped
        What of the file was left out already.

    Raises
    ------
    UnreadableError
        If a column is missing or named twice, a row is ragged, more than a remark stands above the header, or a cell
        that is asked for holds a formula that failed or has no value, or is covered by its neighbour.
    """
    top = header_at(lines, asked)
    header = lines[top]
    at, ignored = _columns(file, header, asked)
    width = len(header.cells)
    sheet = Sheet(
        file=file,
        header=tuple(map(shown, header.cells)),
        at=at,
        lines=tuple(line.number for line in lines[top + 1 :]),
        rows=tuple(_fitted(file, line, width, separator) for line in lines[top + 1 :]),
        ignored=ignored,
        skipped=(*skipped, *_remarks(file, lines[:top], header)),
        addressed=not separator,
    )
    _refuse_odd(sheet)
    return sheet


def _refuse_odd(sheet: Sheet) -> None:
    faults = {OddKind.FORMULA: "table.formula-without-value", OddKind.MERGED: "table.merged-cell"}
    for column in sorted(sheet.at, key=lambda name: sheet.at[name]):
        for row, cell in enumerate(sheet.cells(column)):
            if isinstance(cell, Odd) and cell.kind in faults:
                raise sheet.fault(faults[cell.kind], row, column, example="8.35")
            if is_failed(cell):
                raise sheet.fault("table.error-cell", row, column, example="8.35")


def header_at(lines: Sequence[Line], asked: Asked) -> int:
    """Which of the first lines names most of the columns; the first of equals."""
    first = lines[:_ABOVE]
    return max(range(len(first)), key=lambda n: (*likeness(first[n], asked), -n))


def likeness(line: Line, asked: Asked) -> tuple[bool, int]:
    """How much a line looks like the header: whether it names all columns that must be there, and how many of all."""
    ours = _ours(asked)
    named = {column for cell in line.cells if (column := column_of(shown(cell), ours))}
    return named.issuperset(asked.required), len(named)


def _ours(asked: Asked) -> dict[str, str]:
    every = [*asked.phrases.items(), *((column, (column, *names)) for column, names in asked.known.items())]
    return {plain_name(name): column for column, names in every for name in names}


def _remarks(file: str, above: Sequence[Line], header: Line) -> tuple[Skipped, ...]:
    # A title in one cell is a remark, and told; more than that may be a row that somebody sorted upward.
    for line in above:
        if sum(not is_empty(cell) for cell in line.cells) > 1:
            raise UnreadableError(
                "table.above-header", file=file, line=line.number, value=_shown(line), other=header.number,
                example=_shown(header),
            )  # fmt: skip
    return tuple(
        Skipped(reason=SkippedReason.ABOVE_HEADER, kind="", layer="", count=1, name=_shown(line)) for line in above
    )


def _shown(line: Line) -> str:
    return " ".join(shown(cell) for cell in line.cells if not is_empty(cell))[:_SHOWN]


def _columns(file: str, header: Line, asked: Asked) -> tuple[dict[str, int], tuple[str, ...]]:
    ours = _ours(asked)
    at: dict[str, int] = {}
    ignored: list[str] = []
    names = [shown(cell) for cell in header.cells]
    for place, name in enumerate(names):
        column = column_of(name, ours)
        if column is None:
            if name:
                ignored.append(name)
        elif column in at:
            raise UnreadableError(
                "table.column-twice", file=file, line=header.number, key=column,
                value=f"{names[at[column]]}, {name}", example=asked.example,
            )  # fmt: skip
        else:
            at[column] = place
    if missing := [column for column in asked.required if column not in at]:
        known = "; ".join(f"{column}: {', '.join((column, *asked.known[column]))}" for column in missing)
        raise UnreadableError(
            "table.column-missing", file=file, line=header.number, key=", ".join(missing),
            value=", ".join(filter(None, names))[:200], known=known, example=asked.example,
        )  # fmt: skip
    return at, tuple(ignored)


def _fitted(file: str, line: Line, width: int, separator: str) -> tuple[Cell, ...]:
    cells = line.cells
    if not separator:
        return (*cells[:width], *[""] * (width - len(cells)))
    # Spreadsheets drop or add empty cells at the end of a row; anything else is a row that shifted.
    while len(cells) > width and not cells[-1]:
        cells = cells[:-1]
    if len(cells) != width:
        raise UnreadableError(
            "table.ragged", file=file, line=line.number, key=separator, value=len(cells), example=width
        )
    return cells
