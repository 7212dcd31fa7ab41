# SPDX-License-Identifier: MIT
"""Numbers of a table as a person prints them. Never guessed: a number that could be read in two ways."""

import re
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

import numpy as np

from foparq.columns import Reals
from foparq.read.table.cells import Odd
from foparq.read.table.sheet import Sheet

_LONGEST = 40  #: letters of a number
_MOST_DIGITS = 30  #: decimals or powers of ten beyond any length
_NUMBER = re.compile(r"^[+-]?(?P<whole>\d+)?(?P<separator>[.,])?(?P<decimals>\d+)?(?:[eE](?P<exponent>[+-]?\d{1,3}))?$")


@dataclass(frozen=True, slots=True)
class Number:
    """A number as printed."""

    value: Decimal
    decimals: int  #: digits after the decimal sign; negative for 1e3


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
        or len(plain) > _LONGEST
        or not plain.isascii()
        or not (found["whole"] or found["decimals"])
        or (found["separator"] and not found["decimals"])
    ):
        return None
    exponent = int(found["exponent"] or 0)
    return Number(Decimal(plain.replace(",", ".")), len(found["decimals"] or "") - exponent)


def lengths_of(sheet: Sheet, column: str, unit: float, *, required: bool) -> tuple[Reals, float]:
    """Lengths of a column, and how finely it is written.

    Parameters
    ----------
    unit : float
        Metres in one unit of the table.
    required : bool
        No cell may be empty.

    Returns
    -------
    values : (n,) metres; NaN where empty
    half : float, metres
        Half a unit of the last digit; 0 if the column is empty.

    Raises
    ------
    UnreadableError
        If a cell is empty though required, or no number that can be read in only one way.
    """
    values: Reals = np.full(len(sheet.rows), np.nan)
    factor = Fraction(repr(unit))
    decimals: list[int] = []
    for row, cell in enumerate(sheet.cells(column)):
        if cell == "":
            if required:
                raise sheet.fault("table.cell-empty", row, column, example="8.35")
            continue
        if isinstance(cell, Odd):
            raise sheet.fault("table.date", row, column, example="8.35")
        number = number_of(cell) if isinstance(cell, str) else _by_value(cell)
        if number is None or abs(number.decimals) > _MOST_DIGITS:
            raise sheet.fault("table.not-a-number", row, column, example="1234.5")
        values[row] = float(number.value if factor == 1 else Fraction(number.value) * factor)
        decimals.append(number.decimals)
    if not decimals:
        return values, 0.0
    return values, float(Fraction(1, 2) * Fraction(10) ** -_written_decimals(decimals) * factor)


def _by_value(value: Decimal) -> Number:
    exponent = value.as_tuple().exponent
    return Number(value, -exponent if isinstance(exponent, int) else 0)


def _written_decimals(decimals: list[int]) -> int:
    """Decimals to which a column was written: those that two thirds of its numbers show, or more of them.

    Spreadsheets drop trailing zeros: of numbers written alike one in ten lacks a digit, one in a hundred two.
    """
    return sorted(decimals, reverse=True)[-(-2 * len(decimals) // 3) - 1]
