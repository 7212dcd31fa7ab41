# SPDX-License-Identifier: MIT
"""What the readers of workbooks have in common."""

from collections.abc import Iterable, Mapping
from typing import Protocol

from foparq.errors import UnreadableError
from foparq.read.table.cells import Cell, is_empty
from foparq.read.table.sheet import MOST_ROWS, Line


class Book(Protocol):
    """A workbook."""

    sheets: Mapping[str, bool]  #: name of each sheet in order, and whether it is visible

    def lines(self, sheet: str) -> list[Line]:
        """Rows of a sheet that are not empty."""
        ...


def lines_of(file: str, rows: Iterable[tuple[int, list[Cell]]]) -> list[Line]:
    """Lines of rows, empty ones and empty cells at the end left out.

    Raises
    ------
    UnreadableError
        If there are too many.
    """
    lines: list[Line] = []
    for number, cells in rows:
        if all(map(is_empty, cells)):
            continue
        while cells[-1] == "":
            cells.pop()
        lines.append(Line(number, tuple(cells)))
        if len(lines) > MOST_ROWS:
            raise UnreadableError("table.too-many-rows", file=file, limit=MOST_ROWS)
    return lines
