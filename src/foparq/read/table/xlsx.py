# SPDX-License-Identifier: MIT
"""Sheets of an XLSX workbook, through openpyxl."""

import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from openpyxl import load_workbook
from openpyxl.cell.cell import MergedCell

from foparq.read.table.cells import Cell, Odd, OddKind, cell_of
from foparq.read.table.grid import lines_of
from foparq.read.table.sheet import Line


class XlsxBook:
    """An XLSX workbook, read twice: values as last calculated, and which of them are formulas."""

    sheets: Mapping[str, bool]

    def __init__(self, path: Path) -> None:
        self._file = path.name
        self._values, self._formulas = (_loaded(path, data_only=only) for only in (True, False))
        self.sheets = {sheet.title: sheet.sheet_state == "visible" for sheet in self._values.worksheets}

    def lines(self, sheet: str) -> list[Line]:
        """Rows of a sheet that are not empty."""
        return lines_of(self._file, _rows(self._values[sheet], self._formulas[sheet]))


def _loaded(path: Path, *, data_only: bool) -> Any:  # noqa: ANN401 - openpyxl publishes no types
    with warnings.catch_warnings(), path.open("rb") as stream:
        warnings.simplefilter("ignore")  # of styles and extensions that a table does not need
        return load_workbook(stream, data_only=data_only, keep_links=False)


def _rows(values: Any, formulas: Any) -> Iterator[tuple[int, list[Cell]]]:  # noqa: ANN401
    # The cells that the file has: between them and a stray one far away lie millions that it has not.
    cells: list[Cell] = []
    row = 0
    for place in sorted(values._cells):  # noqa: SLF001 - iter_rows makes the cells that are not there
        if place[0] != row:
            if cells:
                yield row, cells
            row, cells = place[0], []
        cells += [""] * (place[1] - 1 - len(cells))
        cells.append(_cell(values._cells[place], formulas._cells.get(place)))  # noqa: SLF001
    if cells:
        yield row, cells


def _cell(value: Any, formula: Any) -> Cell:  # noqa: ANN401
    if isinstance(value, MergedCell):
        return Odd(OddKind.MERGED, "")
    # A formula that gives an empty text is stored with type str and no value.
    if value.value is None and value.data_type != "str" and formula is not None and formula.data_type == "f":
        text = formula.value
        return Odd(OddKind.FORMULA, text if isinstance(text, str) else f"={text.text}")
    if value.data_type == "e":
        return Odd(OddKind.ERROR, str(value.value))
    return cell_of(value.value)
