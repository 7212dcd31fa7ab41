# SPDX-License-Identifier: MIT
"""What a cell of a table holds."""

import datetime as dt
import math
import re
from dataclasses import dataclass
from decimal import Decimal
from enum import StrEnum

_DIGITS = 15  #: significant digits that every spreadsheet keeps
#: what a spreadsheet shows for a formula that failed, in English, Portuguese and Spanish
_FAILED = re.compile(
    r"#(N/[AD]|¡?REF!|¡?DIV/0!|¡?VALOR!|VALUE!|NOME\?|NAME\?|¿NOMBRE\?|¡?N[UÚ]M!|¡?NULO!|NULL!|SPILL!|CALC!|ERRO!)|Err:[0-9]{3}",
    re.IGNORECASE,
)


class OddKind(StrEnum):
    """Why a cell of a workbook holds nothing that can be taken as it is."""

    DATE = "date"
    ERROR = "error"  #: what a formula gives that failed
    FORMULA = "formula"  #: whose value was not stored
    MERGED = "merged"  #: covered by its neighbour


@dataclass(frozen=True, slots=True)
class Odd:
    """A cell that is neither text nor number."""

    kind: OddKind
    text: str  #: as it can be shown

    def __str__(self) -> str:
        return self.text


Cell = str | Decimal | Odd  #: text, stripped; a number by its value; anything else


def cell_of(value: object) -> Cell:
    """Cell of the value that a library gives.

    A number is what a spreadsheet keeps of it: 15 significant digits, so that 0.1 + 0.2 is 0.3.

    Examples
    --------
    >>> cell_of(0.1 + 0.2), cell_of(7.0), cell_of(" P1 "), cell_of(None)
    (Decimal('0.3'), Decimal('7'), 'P1', '')
    """
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, int | float):
        return Decimal(f"{value:.{_DIGITS}g}") if math.isfinite(value) else str(value)
    if isinstance(value, dt.date | dt.time | dt.timedelta):
        return Odd(OddKind.DATE, str(value))
    return str(value).strip()


def is_failed(cell: Cell) -> bool:
    """Whether a cell shows that a formula failed: ``#N/D``, ``#REF!``."""
    if isinstance(cell, Odd):
        return cell.kind is OddKind.ERROR
    return isinstance(cell, str) and _FAILED.fullmatch(cell) is not None


def is_empty(cell: Cell) -> bool:
    """Whether a cell holds nothing: covered cells hold nothing of their own."""
    return cell == "" or (isinstance(cell, Odd) and cell.kind is OddKind.MERGED)


def shown(cell: Cell) -> str:
    """Cell as text, numbers with a decimal point.

    Examples
    --------
    >>> shown(Decimal("1E+3"))
    '1000'
    """
    return format(cell, "f") if isinstance(cell, Decimal) else str(cell)


def column_letters(place: int) -> str:
    """Name of a column of a workbook.

    Examples
    --------
    >>> column_letters(0), column_letters(25), column_letters(26)
    ('A', 'Z', 'AA')
    """
    letters = ""
    number = place + 1
    while number:
        number, rest = divmod(number - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return letters
