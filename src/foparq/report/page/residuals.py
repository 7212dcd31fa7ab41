# SPDX-License-Identifier: MIT
"""Measured differences on the page: tables with a bar a point, normal plots, and vectors on the drawing."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foparq.evaluate.quality import Element, Residual, Residuals, Standing
from foparq.report.page.drawing import Picture
from foparq.report.record import AuditRecord
from foparq.report.residuals import PointResidual, point_residuals, standing_words, tied_words
from foparq.report.sentences import element_title
from foparq.report.words import Words, printable

ROWS = 200  #: differences of one element that the page lists
_LABELLED = 40  #: points of one drawing up to which all bear their ids
_HALF = 100  #: of a bar's width, and of the width of a normal plot
_LONGEST = 1 / 12  #: of the picture's width: the longest vector


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One difference."""

    id: str
    difference: str
    normalised: str
    bar: tuple[float, float]  #: left end and width, between -100 and 100
    standing: str
    where: str
    place: str  #: delivered coordinates; ``""`` of what has none
    mark: str  #: ``outlier``, ``aside`` (does not count) or ``""``


@dataclass(frozen=True, slots=True, kw_only=True)
class Dot:
    """One difference in the normal plot, between -100 and 100, upward negative."""

    x: float
    y: float
    title: str
    mark: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ResidualsView:
    """The differences of one element."""

    id: str
    title: str
    summary: str
    rows: tuple[Row, ...]
    more: str  #: how many are not listed; ``""`` if all are
    limit: float | None  #: half width of the band within the limit; ``None`` if the limit is beyond the bars
    dots: tuple[Dot, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Vector:
    """A difference on the drawing, cells."""

    x: float
    y: float
    dx: float
    dy: float
    title: str
    turn: float  #: direction of the arrow, degrees clockwise from the right
    label: str  #: id; ``""`` where there are so many that only outliers bear theirs
    mark: str


def residual_views(words: Words, record: AuditRecord, pictures: Sequence[Picture]) -> tuple[ResidualsView, ...]:
    """Differences of every element that measures some.

    Parameters
    ----------
    pictures : sequence of Picture
        They know where on the drawing a point lies.
    """
    by_path = {picture.drawing.path: picture for picture in pictures}
    return tuple(
        _view(words, element, residuals, by_path) for element, residuals in record.quality.measured if residuals.rows
    )


def _view(words: Words, element: Element, residuals: Residuals, pictures: Mapping[str, Picture]) -> ResidualsView:
    largest = max((abs(row.difference or 0.0) for row in residuals.rows), default=0.0) or 1.0
    full = max(largest, element.limit) if element.limit and element.limit < 3 * largest else largest
    left_out = len(residuals.rows) - ROWS
    return ResidualsView(
        id=printable(element.id), title=element_title(words, element), summary=_summary(words, element, residuals),
        rows=_rows(words, residuals.rows[:ROWS], full, pictures), dots=_dots(words, residuals),
        limit=_HALF * element.limit / full if element.limit and element.limit <= full else None,
        more=words("report.residuals.more", count=words.count(left_out)) if left_out > 0 else "",
    )  # fmt: skip


def _summary(words: Words, element: Element, residuals: Residuals) -> str:
    fields = {
        "n": residuals.n, "rmse": _metres(words, residuals.rmse), "rest": _metres(words, residuals.rest),
        "limit": "–" if element.limit is None else words.quantity(element.limit, "m"),
        "significance": (residuals.significance, "1"), "most": residuals.most,
        "ids": [printable(id_) for id_ in residuals.outliers],
    }  # fmt: skip
    return words(f"report.residuals.{'outliers' if residuals.outliers else 'none'}", **fields)


def _metres(words: Words, value: float | None) -> str:
    return "–" if value is None else words.quantity(value, "m")


def _mark(row: Residual) -> str:
    return "outlier" if row.outlier else "" if row.standing is Standing.COUNTED else "aside"


def _rows(words: Words, rows: Sequence[Residual], full: float, pictures: Mapping[str, Picture]) -> tuple[Row, ...]:
    told = words.column([row.difference or 0.0 for row in rows])
    return tuple(_row(words, row, text, full, pictures) for row, text in zip(rows, told, strict=True))


def _row(words: Words, row: Residual, told: str, full: float, pictures: Mapping[str, Picture]) -> Row:
    length = _HALF * (row.difference or 0.0) / full
    return Row(
        id=printable(row.id), difference="–" if row.difference is None else told, standing=standing_words(words, row),
        normalised="–" if row.normalised is None else words.number(row.normalised, 2), mark=_mark(row),
        bar=(round(min(0.0, length), 2), round(abs(length), 2)), where=tied_words(words, row),
        place=_place(words, row, pictures.get(row.drawing)),
    )  # fmt: skip


def _place(words: Words, row: Residual, picture: Picture | None) -> str:
    """Delivered coordinates, and where on the drawing that is."""
    if row.place is None:
        return ""
    told = words("report.residuals.place", **dict(zip("xyz", map(float, row.place), strict=True)))
    metres = None if picture is None else picture.drawing.unit.metres
    if picture is None or metres is None or not (picture.extent[1] > picture.extent[0]).all():
        return told
    spot = picture.drawing.plane.project(np.array([row.place]) / metres, metres)[0, :2]
    right, up = (spot - picture.extent[0]) / (picture.extent[1] - picture.extent[0])
    return words("report.residuals.share", place=told, right=words.count(100 * right), up=words.count(100 * up))


def _dots(words: Words, residuals: Residuals) -> tuple[Dot, ...]:
    rows = [row for row in residuals.rows if row.normalised is not None and row.expected is not None]
    reach = max((abs(v) for row in rows for v in (row.normalised or 0.0, row.expected or 0.0)), default=0.0)
    if not reach:
        return ()
    return tuple(
        Dot(
            x=round(_HALF * (row.expected or 0.0) / reach, 2), y=round(-_HALF * (row.normalised or 0.0) / reach, 2),
            title=f"{printable(row.id)}: {_metres(words, row.difference)}", mark=_mark(row),
        )
        for row in rows
    )  # fmt: skip


def vectors(words: Words, record: AuditRecord, picture: Picture) -> tuple[tuple[Vector, ...], float]:
    """Differences of the checkpoints that lie in a drawing, enlarged, and by how much."""
    drawing, metres = picture.drawing, picture.drawing.unit.metres
    points = [point for point in point_residuals(record) if point.drawing == drawing.path and point.place is not None]
    if not points or metres is None:
        return (), 1.0
    spots = picture.cells(drawing.plane.project(np.array([point.place for point in points]) / metres, metres)[:, :2])
    turned = np.nan_to_num(np.array([point.difference for point in points], dtype=float)) @ drawing.plane.frame.T
    length = float(np.linalg.norm(turned[:, :2], axis=1).max())
    if not length > 0.0:
        return (), 1.0
    factor = _round(picture.width * picture.quantum * _LONGEST / length)
    moved = turned[:, :2] * factor / picture.quantum * (1.0, -1.0)
    return tuple(
        Vector(
            x=float(x), y=float(y), dx=round(float(dx)), dy=round(float(dy)), title=_told(words, point),
            turn=round(math.degrees(math.atan2(dy, dx)), 1),
            label=printable(point.id) if point.outlier or len(points) <= _LABELLED else "",
            mark="outlier" if point.outlier else "" if point.counted else "aside",
        )
        for point, (x, y), (dx, dy) in zip(points, spots, moved, strict=True)
    ), factor  # fmt: skip


def _told(words: Words, point: PointResidual) -> str:
    parts = [f"{axis} {_metres(words, value)}" for axis, value in zip("XYZ", point.difference, strict=True)]
    return f"{printable(point.id)}: {'; '.join(parts)}"


def _round(factor: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is no greater."""
    decade = 10.0 ** math.floor(math.log10(factor))
    return max(step * decade for step in (1, 2, 5) if step * decade <= factor)
