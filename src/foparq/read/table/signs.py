# SPDX-License-Identifier: MIT
"""Whether the sign in the numbers of a table separates decimals or thousands."""

import re
from collections.abc import Mapping, Sequence

import numpy as np

from foparq.columns import Flags
from foparq.errors import UnreadableError
from foparq.read.table.sheet import Sheet

#: what a separator of thousands can look like: one to three digits that do not begin with zero, and three more
_GROUPED = re.compile(r"^[+\-\u2212]?[1-9]\d{0,2}[.,]\d{3}$")


def is_grouped(text: str) -> bool:
    """Whether a number can be read in two ways: 12.345, twelve and a bit or twelve thousand."""
    return _GROUPED.match(text) is not None


def one_decimal_sign(sheet: Sheet, columns: Sequence[str]) -> None:
    """Refuse a table with both signs: 1.234 beside 1,5, one of the two separates thousands, and nobody can say which.

    Raises
    ------
    UnreadableError
        If both decimal signs occur; the error names the first cell with the second of them.
    """
    seen: dict[str, tuple[int, str]] = {}
    present = sorted((column for column in columns if column in sheet.at), key=lambda column: sheet.at[column])
    for row, cells in enumerate(sheet.rows):
        for column in present:
            for sign in ",.":
                cell = cells[sheet.at[column]]
                if isinstance(cell, str) and sign in cell:
                    seen.setdefault(sign, (row, column))
        if len(seen) == 2:  # noqa: PLR2004 - both signs
            _, (row_of, column_of) = seen.popitem()
            raise sheet.fault("table.two-decimal-signs", row_of, column_of, example="1234.5")


def doubtful_cells(sheet: Sheet, columns: Sequence[str]) -> dict[str, Flags]:
    """Numbers that can be read in two ways: 12.345, twelve and a bit or twelve thousand.

    Parameters
    ----------
    columns : sequence of str
        Our names of the columns of numbers, which share one decimal sign.

    Returns
    -------
    dict of str to (n,) bool
        By column that has any. Empty if another number proves the sign decimal: a zero in front (0,812), more than
        three digits in front, or other than three behind. A number without a sign (812) proves nothing, nor does a
        cell of a workbook that holds a number: its value is one anyway.
    """
    doubtful: dict[str, Flags] = {}
    for column in columns:
        texts = [cell if isinstance(cell, str) else "" for cell in sheet.cells(column)]
        flags = np.array([is_grouped(text) for text in texts], dtype=bool)
        if any(("." in text or "," in text) and not flag for text, flag in zip(texts, flags, strict=True)):
            return {}
        if flags.any():
            doubtful[column] = flags
    return doubtful


def thousands_fault(sheet: Sheet, doubtful: Mapping[str, Flags], unit: str) -> UnreadableError:
    """Error that names the first doubtful cell and shows both readings.

    Parameters
    ----------
    doubtful : mapping of str to (n,) bool
        As :func:`doubtful_cells` gives it, not empty.
    unit : str
        Unit of the table, as stated.
    """
    column = min(doubtful, key=lambda name: (int(np.argmax(doubtful[name])), sheet.at[name]))
    row = int(np.argmax(doubtful[column]))
    text = sheet.texts(column)[row]
    whole = re.sub("[.,]", "", text)
    # A fourth decimal leaves one reading only.
    return sheet.fault(
        "table.thousands", row, column, decimal=f"{text}0 {unit}", thousands=f"{whole} {unit}", example=f"{text}0",
        other=whole,
    )  # fmt: skip
