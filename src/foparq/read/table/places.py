# SPDX-License-Identifier: MIT
"""Where a feature list says that its features are."""

import numpy as np

from foparq.columns import Reals
from foparq.read.table.names import unit_in_header
from foparq.read.table.numbers import lengths_of
from foparq.read.table.sheet import Sheet
from foparq.read.table.signs import one_decimal_sign
from foparq.units import parse_length_unit

_AXES = ("x", "y", "z")
_COLUMNS = (*_AXES, "tol")


def places_of(sheet: Sheet) -> tuple[Reals, Reals, Reals]:
    """Places of features and how far from them these may lie.

    Returns
    -------
    place : (n, 3) metres
        In axes of the drawing; NaN where not given.
    tol : (n,) metres
        NaN where not given.
    printed : (3,) metres
        Half the last printed digit of the places, by axis; of an axis along which all are alike, that of the finest
        one: spreadsheets drop the zeros of a plane at 0.000.

    Raises
    ------
    UnreadableError
        If a cell is no number, both decimal signs occur, or a tolerance is not positive.

    Notes
    -----
    In metres, unless the name of a column carries another unit in brackets. Numbers with one sign and three digits are
    taken for decimals: places that were meant in thousands lie on nothing, and prove nothing.
    """
    found, half = {}, {}
    for column in _COLUMNS:
        said = unit_in_header(sheet.header[sheet.at[column]]) if column in sheet.at else ""
        found[column], half[column] = lengths_of(sheet, column, parse_length_unit(said or "m"), required=False)
    one_decimal_sign(sheet, _COLUMNS)
    wrong = np.flatnonzero(found["tol"] <= 0)
    if len(wrong):
        raise sheet.fault("table.not-positive", int(wrong[0]), "tol", example="0.01")
    place = np.column_stack([found[axis] for axis in _AXES])
    printed = np.array([half[axis] for axis in _AXES])
    alike = np.array([len(set(found[axis][np.isfinite(found[axis])].tolist())) <= 1 for axis in _AXES])
    printed[alike] = printed[~alike].min(initial=printed.max())
    return place, found["tol"], printed
