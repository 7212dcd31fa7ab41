# SPDX-License-Identifier: MIT
"""Sheets of an ODS workbook.

Of the libraries that read ODS under a permissive licence none tells a failed formula or one without value from an empty
cell, so that the table is taken from its XML (OpenDocument 1.3, part 3, section 9).
"""

import zipfile
from collections.abc import Iterator, Mapping
from typing import Any

from lxml import etree

from foparq.errors import UnreadableError
from foparq.read.table.cells import Cell, Odd, OddKind, cell_of
from foparq.read.table.grid import lines_of
from foparq.read.table.sheet import Line

_WIDEST = 16_384  #: columns of a sheet
_OASIS = "urn:oasis:names:tc:opendocument:xmlns:"
_TABLE, _OFFICE, _TEXT, _STYLE = (f"{{{_OASIS}{name}:1.0}}" for name in ("table", "office", "text", "style"))
_CALC = "{urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0}"
_NUMBERS = frozenset({"float", "percentage", "currency"})
_DATES = {"date": f"{_OFFICE}date-value", "time": f"{_OFFICE}time-value"}
_CACHED = "ta_extref"  #: style of the copies that LibreOffice keeps of linked files


class OdsBook:
    """An ODS workbook."""

    sheets: Mapping[str, bool]

    def __init__(self, file: str, archive: zipfile.ZipFile) -> None:
        self._file = file
        parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
        with archive.open("content.xml") as stream:
            root = etree.parse(stream, parser).getroot()
        hidden = {
            style.get(f"{_STYLE}name")
            for style in root.iter(f"{_STYLE}style")
            for properties in style.iter(f"{_STYLE}table-properties")
            if properties.get(f"{_TABLE}display") == "false"
        }
        body = root.find(f"{_OFFICE}body/{_OFFICE}spreadsheet")
        tables = [] if body is None else body.findall(f"{_TABLE}table")
        own = [table for table in tables if table.get(f"{_TABLE}style-name") != _CACHED]
        self._tables = {table.get(f"{_TABLE}name", ""): table for table in own}
        self.sheets = {name: table.get(f"{_TABLE}style-name") not in hidden for name, table in self._tables.items()}

    def lines(self, sheet: str) -> list[Line]:
        """Rows of a sheet that are not empty."""
        return lines_of(self._file, _rows(self._tables[sheet], self._file))


def _rows(table: Any, file: str) -> Iterator[tuple[int, list[Cell]]]:  # noqa: ANN401 - lxml publishes no types
    number = 1
    for row in table.iter(f"{_TABLE}table-row"):
        times = _times(row, "rows")
        cells = _cells(row, file)
        if cells:
            for more in range(times):
                yield number + more, list(cells)
        number += times


def _cells(row: Any, file: str) -> list[Cell]:  # noqa: ANN401
    # Up to the last that holds anything: sheets are filled up with one empty cell, repeated.
    cells: list[Cell] = []
    waiting = 0
    for element in row.iterchildren(f"{_TABLE}table-cell", f"{_TABLE}covered-table-cell"):
        times = _times(element, "columns")
        cell = _cell(element)
        if cell == "":
            waiting += times
            continue
        if len(cells) + waiting + times > _WIDEST:
            raise UnreadableError("table.workbook-broken", file=file, value=f"> {_WIDEST}")
        cells += [""] * waiting + [cell] * times
        waiting = 0
    return cells


def _cell(element: Any) -> Cell:  # noqa: ANN401
    kind = element.get(f"{_OFFICE}value-type")
    said = "\n".join(map(_text, element.iterchildren(f"{_TEXT}p")))
    if odd := _odd(element, kind, said):
        return odd
    if kind in _NUMBERS:
        return cell_of(float(element.get(f"{_OFFICE}value")))
    if kind == "boolean":
        return str(element.get(f"{_OFFICE}boolean-value", "")).upper()
    return cell_of(said or element.get(f"{_OFFICE}string-value"))


def _odd(element: Any, kind: str | None, said: str) -> Odd | None:  # noqa: ANN401
    if element.tag == f"{_TABLE}covered-table-cell":
        return Odd(OddKind.MERGED, "")
    if element.get(f"{_CALC}value-type") == "error":
        return Odd(OddKind.ERROR, said)
    formula = element.get(f"{_TABLE}formula")
    if kind is None and formula is not None:
        return Odd(OddKind.FORMULA, f"={formula.partition(':=')[2] or formula.lstrip('=')}")
    return Odd(OddKind.DATE, element.get(_DATES[kind], "")) if kind in _DATES else None


def _text(element: Any) -> str:  # noqa: ANN401
    said = element.text or ""
    for child in element:
        if child.tag == f"{_TEXT}s":
            said += " " * min(int(child.get(f"{_TEXT}c", "1")), _WIDEST)
        elif child.tag in {f"{_TEXT}tab", f"{_TEXT}line-break"}:
            said += " "
        elif isinstance(child.tag, str) and child.tag != f"{_OFFICE}annotation":
            said += _text(child)
        said += child.tail or ""
    return said


def _times(element: Any, of: str) -> int:  # noqa: ANN401
    return max(1, int(element.get(f"{_TABLE}number-{of}-repeated", "1")))
