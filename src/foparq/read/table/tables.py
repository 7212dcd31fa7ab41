# SPDX-License-Identifier: MIT
"""Checkpoints, distances and the list of specified features. Columns that nobody asked for are left alone."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foparq.columns import Index, Texts
from foparq.errors import UnreadableError
from foparq.model.tables import Checkpoints, Distances, FeatureList
from foparq.profile.manifest import SurveySection
from foparq.read.table.csv_text import read_text
from foparq.read.table.names import CHECKPOINT_COLUMNS, DISTANCE_COLUMNS, FEATURE_COLUMNS, unit_in_header
from foparq.read.table.numbers import lengths_of, number_of
from foparq.read.table.sheet import Asked, Sheet
from foparq.units import parse_length_unit

_USES = {
    "required": ("", "required", "obrigatório", "obrigatória", "exigido", "exigida"),
    "optional": ("optional", "opcional", "facultativo", "facultativa"),
    "prohibited": ("prohibited", "proibido", "proibida", "vedado", "vedada"),
}
OMISSIONS = ("OCCL", "ADJ", "ACCESS", "RES", "DEMOL", "HIDDEN")
_CHECKPOINTS = Asked(known=CHECKPOINT_COLUMNS, required=("id", "x", "y", "z"), example="id;x;y;z;xd;yd;zd")
_DISTANCES = Asked(known=DISTANCE_COLUMNS, required=("id", "measured"), example="id;from;to;measured;delivered")
_FEATURES = Asked(known=FEATURE_COLUMNS, required=("id", "class"), example="id;class;facade;count;use")


def read_checkpoints(path: Path, section: SurveySection) -> Checkpoints:
    """Checkpoints of a CSV table with columns ``id, x, y, z`` (surveyed) and ``xd, yd, zd`` (delivered).

    Parameters
    ----------
    path : Path
        The table.
    section : SurveySection
        Unit of its numbers and standard deviation of the survey, from the manifest.

    Returns
    -------
    Checkpoints
        In metres, in the order of the file. Delivered coordinates may be empty, or their columns left out: NaN. The
        resolution of an axis is half a unit of the last digit of its surveyed numbers plus the same of its delivered
        ones. A column counts as written to its finest digit if two thirds of its numbers show that digit, for
        spreadsheets drop trailing zeros; otherwise as written to its coarsest.

    Raises
    ------
    UnreadableError
        If a cell, a row or a column is wrong; the error names file, line, column and value.
    """
    sheet = read_text(path, _CHECKPOINTS)
    unit = _unit(sheet, section, ("x", "y", "z", "xd", "yd", "zd"))
    ids = _ids(sheet, example="P01")
    surveyed = [lengths_of(sheet, axis, unit, required=True) for axis in ("x", "y", "z")]
    delivered = [lengths_of(sheet, axis, unit, required=False) for axis in ("xd", "yd", "zd")]
    _one_decimal_sign(sheet, ("x", "y", "z", "xd", "yd", "zd"))
    halves = [one + other for (_, one), (_, other) in zip(surveyed, delivered, strict=True)]
    return Checkpoints(
        id=ids,
        surveyed=np.column_stack([values for values, _ in surveyed]),
        delivered=np.column_stack([values for values, _ in delivered]),
        resolution=np.array(halves),
        survey_sd=section.survey_sd.si() if section.survey_sd else None,
        skipped=sheet.skipped,
    )


def read_distances(path: Path, section: SurveySection) -> Distances:
    """Distances of a CSV table with columns ``id, from, to, measured, delivered``.

    Parameters
    ----------
    path : Path
        The table.
    section : SurveySection
        Unit of its numbers and standard deviation of the survey, from the manifest.

    Returns
    -------
    Distances
        In metres, in the order of the file. ``delivered`` may be empty: NaN. ``from`` and ``to`` name the ends for the
        reader's own use.

    Raises
    ------
    UnreadableError
        If a cell, a row or a column is wrong, or a length is not positive.
    """
    sheet = read_text(path, _DISTANCES)
    unit = _unit(sheet, section, ("measured", "delivered"))
    ids = _ids(sheet, example="D01")
    measured, half = lengths_of(sheet, "measured", unit, required=True)
    delivered, other = lengths_of(sheet, "delivered", unit, required=False)
    _one_decimal_sign(sheet, ("measured", "delivered"))
    for column, values in (("measured", measured), ("delivered", delivered)):
        wrong = np.flatnonzero(values <= 0)
        if len(wrong):
            raise sheet.fault("table.not-positive", int(wrong[0]), column, example="2.345")
    return Distances(
        id=ids, measured=measured, delivered=delivered, resolution=half + other,
        survey_sd=section.survey_sd.si() if section.survey_sd else None, skipped=sheet.skipped,
    )  # fmt: skip


def read_feature_list(path: Path) -> FeatureList:
    """Specified features of a CSV table with columns ``id, class, facade, count, use, omission_accepted, evidence``.

    Parameters
    ----------
    path : Path
        The table. ``facade``, ``count`` (1), ``use`` (required), ``omission_accepted`` and ``evidence`` may be left
        out or empty.

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
    sheet = read_text(path, _FEATURES)
    uses = {spelled: use for use, words in _USES.items() for spelled in words}
    use = [uses.get(text.casefold(), "") for text in sheet.texts("use")]
    accepted = [text.upper() for text in sheet.texts("omission_accepted")]
    evidence = sheet.texts("evidence")
    for row, name in enumerate(sheet.texts("class")):
        if not name:
            raise sheet.fault("table.cell-empty", row, "class", example="window")
        if not use[row]:
            raise sheet.fault("table.use-unknown", row, "use", example="required")
        if accepted[row] and accepted[row] not in OMISSIONS:
            raise sheet.fault("table.code-unknown", row, "omission_accepted", example=", ".join(OMISSIONS))
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
    )


def _unit(sheet: Sheet, section: SurveySection, columns: Sequence[str]) -> float:
    # Metres in one unit of the table. A unit in the header that says otherwise is a contradiction, not a correction.
    stated = parse_length_unit(section.unit)
    for column in columns:
        if column in sheet.at:
            name = sheet.header[sheet.at[column]]
            said = unit_in_header(name)
            if said and not math.isclose(parse_length_unit(said), stated):
                raise UnreadableError(
                    "table.unit", file=sheet.file, key=name, value=section.unit, example=f'unit = "{said}"'
                )
    return stated


def _ids(sheet: Sheet, *, example: str) -> Texts:
    first: dict[str, int] = {}
    for row, name in enumerate(sheet.texts("id")):
        if not name:
            raise sheet.fault("table.cell-empty", row, "id", example=example)
        if name in first:
            raise UnreadableError(
                "table.id-twice", file=sheet.file, line=sheet.lines[row], key=sheet.header[sheet.at["id"]], value=name,
                other=sheet.lines[first[name]], example=example,
            )  # fmt: skip
        first[name] = row
    return _column(list(first))


def _one_decimal_sign(sheet: Sheet, columns: Sequence[str]) -> None:
    # 1.234 and 1,5 in one table: one of the two separates thousands, and nobody can say which.
    seen: dict[str, tuple[int, str]] = {}
    present = sorted((column for column in columns if column in sheet.at), key=lambda column: sheet.at[column])
    for row, cells in enumerate(sheet.rows):
        for column in present:
            for sign in ",.":
                if sign in cells[sheet.at[column]]:
                    seen.setdefault(sign, (row, column))
        if len(seen) == 2:  # noqa: PLR2004 - both signs
            _, (row_of, column_of) = seen.popitem()
            raise sheet.fault("table.two-decimal-signs", row_of, column_of, example="1234.5")


def _counts(sheet: Sheet) -> Index:
    counts = np.ones(len(sheet.rows), dtype=np.intp)
    for row, text in enumerate(sheet.texts("count")):
        if not text:
            continue
        number = number_of(text)
        if number is None or number.value != number.value.to_integral_value() or not 0 <= number.value < 10**9:
            raise sheet.fault("table.not-a-count", row, "count", example="3")
        counts[row] = int(number.value)
    return counts


def _column(values: list[str]) -> Texts:
    column: Texts = np.empty(len(values), dtype=object)
    column[:] = values
    return column
