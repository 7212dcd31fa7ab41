# SPDX-License-Identifier: MIT
"""Checkpoints, distances and the list of specified features. Columns that nobody asked for are left alone."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from foparq.columns import Flags, Index, Reals, Texts
from foparq.errors import UnreadableError
from foparq.model.tables import Checkpoints, Distances, FeatureList
from foparq.names import nearest
from foparq.profile.manifest import SurveySection, TableSection
from foparq.read.table.cells import Odd, shown
from foparq.read.table.csv_text import is_workbook, read_text
from foparq.read.table.extent import Extent, lengths_are_decimal, points_are_decimal
from foparq.read.table.names import (
    CHECKPOINT_COLUMNS,
    CHECKPOINT_PHRASES,
    DISTANCE_COLUMNS,
    DISTANCE_PHRASES,
    FEATURE_COLUMNS,
    unit_in_header,
    use_of,
)
from foparq.read.table.numbers import lengths_of, number_of
from foparq.read.table.places import places_of
from foparq.read.table.sheet import Asked, Sheet
from foparq.read.table.signs import doubtful_cells, is_grouped, one_decimal_sign, thousands_fault
from foparq.units import parse_length_unit

_SURVEYED, _DELIVERED = ("x", "y", "z"), ("xd", "yd", "zd")
_LENGTHS = ("measured", "delivered")
_ENDS = ("x1", "y1", "z1", "x2", "y2", "z2")  #: delivered coordinates of both ends
OMISSIONS = ("OCCL", "ADJ", "ACCESS", "RES", "DEMOL", "HIDDEN")
_CHECKPOINTS = Asked(
    known=CHECKPOINT_COLUMNS,
    required=("id", "x", "y", "z"),
    example="id;x;y;z;xd;yd;zd",
    phrases=CHECKPOINT_PHRASES,
)
_DISTANCES = Asked(
    known=DISTANCE_COLUMNS,
    required=("id", "measured"),
    example="id;from;to;measured;delivered",
    phrases=DISTANCE_PHRASES,
)
_FEATURES = Asked(known=FEATURE_COLUMNS, required=("id", "class"), example="id;class;facade;count;use")


def read_checkpoints(path: Path, section: SurveySection, extents: Sequence[Extent] = ()) -> Checkpoints:
    """Checkpoints of a table with columns ``id, x, y, z`` (surveyed) and ``xd, yd, zd`` (delivered).

    Parameters
    ----------
    path : Path
        CSV, XLSX or ODS.
    section : SurveySection
        Unit of its numbers and standard deviation of the survey, from the manifest.
    extents : sequence of Extent
        Of the drawings: they may prove that 12.345 is twelve and a bit.

    Returns
    -------
    Checkpoints
        In metres, in the order of the file. Delivered coordinates may be empty, or their columns left out: NaN. The
        resolution of an axis is half a unit of the last digit of its surveyed numbers plus the same of its delivered
        ones. A column counts as written to the digit that two thirds of its numbers show, for spreadsheets drop
        trailing zeros.

    Raises
    ------
    UnreadableError
        If a cell, a row or a column is wrong, or numbers could be decimals or thousands; the error names file, line,
        column and value.
    """
    sheet = _sheet(path, _CHECKPOINTS, section)
    unit = _unit(sheet, section, (*_SURVEYED, *_DELIVERED))
    ids = _ids(sheet, example="P01")
    values, halves = _lengths(sheet, (*_SURVEYED, *_DELIVERED), unit, required=_SURVEYED)
    doubtful = doubtful_cells(sheet, (*_SURVEYED, *_DELIVERED))
    axes = [_doubtful(values, doubtful, pair) for pair in zip(_SURVEYED, _DELIVERED, strict=True)]
    if doubtful and not points_are_decimal(axes, extents):
        raise thousands_fault(sheet, doubtful, unit)
    return Checkpoints(
        id=ids,
        surveyed=np.column_stack([values[axis] for axis in _SURVEYED]),
        delivered=np.column_stack([values[axis] for axis in _DELIVERED]),
        resolution=np.array([halves[x] + halves[xd] for x, xd in zip(_SURVEYED, _DELIVERED, strict=True)]),
        survey_sd=section.survey_sd.si() if section.survey_sd else None,
        printed=np.array([halves[axis] for axis in _DELIVERED]),
        skipped=sheet.skipped,
    )


def read_distances(path: Path, section: SurveySection, extents: Sequence[Extent] = ()) -> Distances:
    """Distances of a table with columns ``id, from, to, measured, delivered``.

    Parameters
    ----------
    path : Path
        CSV, XLSX or ODS.
    section : SurveySection
        Unit of its numbers and standard deviation of the survey, from the manifest.
    extents : sequence of Extent
        Of the drawings: they may prove that 12.345 is twelve and a bit.

    Returns
    -------
    Distances
        In metres, in the order of the file. ``delivered`` may be empty: NaN. ``from`` and ``to`` name the ends;
        ``x1, y1, z1, x2, y2, z2`` are their delivered coordinates, a depth may be left out.

    Raises
    ------
    UnreadableError
        If a cell, a row or a column is wrong, numbers could be decimals or thousands, or a length is not positive.
    """
    sheet = _sheet(path, _DISTANCES, section)
    unit = _unit(sheet, section, (*_LENGTHS, *_ENDS))
    ids = _ids(sheet, example="D01")
    values, halves = _lengths(sheet, (*_LENGTHS, *_ENDS), unit, required=("measured",))
    doubtful = doubtful_cells(sheet, (*_LENGTHS, *_ENDS))
    if doubtful and not lengths_are_decimal(_doubtful(values, doubtful, _LENGTHS), extents):
        raise thousands_fault(sheet, doubtful, unit)
    for column in _LENGTHS:
        wrong = np.flatnonzero(values[column] <= 0)
        if len(wrong):
            raise sheet.fault("table.not-positive", int(wrong[0]), column, example="2.345")
    return Distances(
        id=ids, measured=values["measured"], delivered=values["delivered"],
        resolution=halves["measured"] + halves["delivered"],
        survey_sd=section.survey_sd.si() if section.survey_sd else None, start=_column(sheet.texts("from")),
        end=_column(sheet.texts("to")), places=np.stack([values[one] for one in _ENDS], axis=1).reshape(-1, 2, 3),
        places_printed=np.array([max(halves[f"{axis}1"], halves[f"{axis}2"]) for axis in "xyz"]),
        printed=halves["delivered"], skipped=sheet.skipped,
    )  # fmt: skip


def read_feature_list(path: Path, section: TableSection | None = None) -> FeatureList:
    """Specified features of a table with columns ``id, class, facade, count, use, omission_accepted, evidence``.

    Places are in ``x, y, z, tol``: metres, in axes of the drawing.

    Parameters
    ----------
    path : Path
        CSV, XLSX or ODS. ``facade``, ``count`` (1), ``use`` (required), ``omission_accepted`` and ``evidence`` may
        be left out or empty.
    section : TableSection, optional
        Which sheet of a workbook, from the manifest; the first if left out.

    Returns
    -------
    FeatureList
        In the order of the file.

    Raises
    ------
    UnreadableError
        If an id is missing or used twice, a class is missing, a count is no whole number from 0, a use or a code is
        unknown, or an accepted omission names no evidence.
    """
    sheet = _sheet(path, _FEATURES, section)
    place, tol, printed = places_of(sheet)
    use = [use_of(text) for text in sheet.texts("use")]
    accepted = [text.upper() for text in sheet.texts("omission_accepted")]
    evidence = sheet.texts("evidence")
    for row, name in enumerate(sheet.texts("class")):
        if not name:
            raise sheet.fault("table.cell-empty", row, "class", example="window")
        if not use[row]:
            raise sheet.fault("table.use-unknown", row, "use", example="required")
        if accepted[row] and accepted[row] not in OMISSIONS:
            raise sheet.fault(
                "table.code-unknown", row, "omission_accepted", example=", ".join(nearest(accepted[row], OMISSIONS))
            )
        if accepted[row] and not evidence[row]:
            raise sheet.fault("table.no-evidence", row, "omission_accepted", example="IMG_0412.jpg")
    return FeatureList(
        id=_ids(sheet, example="JAN-N-012"),
        feature_class=_column(sheet.texts("class")),
        facade=_column(sheet.texts("facade")),
        count=_counts(sheet),
        use=_column(use),
        accepted=_column(accepted),
        evidence=_column(evidence),
        ignored=sheet.ignored,
        skipped=sheet.skipped,
        place=place,
        tol=tol,
        printed=printed,
    )


def _sheet(path: Path, asked: Asked, section: TableSection | None) -> Sheet:
    stated = section.sheet if section else None
    if is_workbook(path):
        # openpyxl takes a while to load, and few tables need it.
        from foparq.read.table.workbook import read_workbook  # noqa: PLC0415

        return read_workbook(path, asked, stated)
    if stated is not None:
        raise UnreadableError("table.sheet-of-text", file=path.name, value=stated)
    return read_text(path, asked)


def _unit(sheet: Sheet, section: SurveySection, columns: Sequence[str]) -> str:
    # Unit of the table. A header that says otherwise than the manifest is a contradiction, not a correction.
    heads = [sheet.header[sheet.at[column]] for column in columns if column in sheet.at]
    said = {name: unit for name in heads if (unit := unit_in_header(name))}
    if section.unit is None and len({said.get(name, "m") for name in heads}) > 1:
        raise UnreadableError("table.unit-mixed", file=sheet.file, value=", ".join(heads), example='unit = "m"')
    stated = section.unit or next(iter(said.values()), "m")
    for name, unit in said.items():
        if not math.isclose(parse_length_unit(unit), parse_length_unit(stated)):
            raise UnreadableError("table.unit", file=sheet.file, key=name, value=stated, example=f'unit = "{unit}"')
    return stated


def _ids(sheet: Sheet, *, example: str) -> Texts:
    first: dict[str, int] = {}
    for row, name in enumerate(sheet.texts("id")):
        if not name:
            raise sheet.fault("table.cell-empty", row, "id", example=example)
        if isinstance(sheet.rows[row][sheet.at["id"]], Odd):
            raise sheet.fault("table.date", row, "id", example=example)
        if name in first:
            raise UnreadableError(
                "table.id-twice", file=sheet.file, line=sheet.lines[row], key=sheet.key(row, "id"), value=name,
                other=sheet.lines[first[name]], example=example,
            )  # fmt: skip
        first[name] = row
    return _column(list(first))


def _lengths(
    sheet: Sheet, columns: Sequence[str], unit: str, required: Sequence[str]
) -> tuple[dict[str, Reals], dict[str, float]]:
    # Values of each column in metres, and half a unit of its last digit.
    found = {
        column: lengths_of(sheet, column, parse_length_unit(unit), required=column in required) for column in columns
    }
    one_decimal_sign(sheet, columns)
    return {name: values for name, (values, _) in found.items()}, {name: half for name, (_, half) in found.items()}


def _doubtful(values: Mapping[str, Reals], doubtful: Mapping[str, Flags], columns: Sequence[str]) -> Reals:
    return np.concatenate([np.empty(0), *(values[name][doubtful[name]] for name in columns if name in doubtful)])


def _counts(sheet: Sheet) -> Index:
    counts = np.ones(len(sheet.rows), dtype=np.intp)
    for row, cell in enumerate(sheet.cells("count")):
        if not (text := shown(cell)):
            continue
        number = None if isinstance(cell, Odd) or (isinstance(cell, str) and is_grouped(cell)) else number_of(text)
        if number is None or number.value != number.value.to_integral_value() or not 0 <= number.value < 10**9:
            raise sheet.fault("table.not-a-count", row, "count", example="3")
        counts[row] = int(number.value)
    return counts


def _column(values: list[str]) -> Texts:
    column: Texts = np.empty(len(values), dtype=object)
    column[:] = values
    return column
