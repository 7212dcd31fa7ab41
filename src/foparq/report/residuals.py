# SPDX-License-Identifier: MIT
"""Differences of checkpoints with their three axes together, and where they lie in the files."""

from collections import defaultdict
from dataclasses import dataclass

from foparq.evaluate.quality import Residual, Residuals, Standing
from foparq.report.record import AuditRecord
from foparq.report.words import Words, printable

_AXES = ("X", "Y", "Z")


@dataclass(frozen=True, slots=True, kw_only=True)
class PointResidual:
    """One checkpoint."""

    id: str
    difference: tuple[float | None, float | None, float | None]  #: delivered minus surveyed, metres
    counted: bool  #: in at least one axis
    outlier: bool  #: in at least one axis
    lies: str
    drawing: str
    item: str
    layer: str
    place: tuple[float, float, float] | None  #: delivered, metres


def point_residuals(record: AuditRecord) -> list[PointResidual]:
    """Checkpoints of the first element that measures coordinates, in order of their ids."""
    axes: dict[str, list[Residual]] = defaultdict(list)
    by_axis: dict[str, Residuals] = {}
    for _, residuals in record.quality.measured:
        if residuals.axis:
            by_axis.setdefault(residuals.axis, residuals)
    for axis in _AXES:
        # Ids may be given twice: the rows of one id keep their order by where they lie.
        for row in sorted(by_axis[axis].rows, key=_ordered) if axis in by_axis else ():
            axes[axis].append(row)
    return [_point(rows) for rows in zip(*(axes[axis] for axis in _AXES if axes[axis]), strict=True)]


def _ordered(row: Residual) -> tuple[str, tuple[float, ...]]:
    return row.id, row.place or ()


def _point(rows: tuple[Residual, ...]) -> PointResidual:
    first = rows[0]
    x, y, z = [row.difference for row in rows] + [None] * (len(_AXES) - len(rows))
    return PointResidual(
        id=first.id, difference=(x, y, z), counted=any(row.standing is Standing.COUNTED for row in rows),
        outlier=any(row.outlier for row in rows), lies=first.lies, drawing=first.drawing, item=first.item,
        layer=first.layer, place=first.place,
    )  # fmt: skip


def standing_words(words: Words, row: Residual) -> str:
    """Whether a difference counts, and whether it is an outlier."""
    told = words(f"report.standing.{row.standing}")
    return f"{told}; {words('report.standing.outlier')}" if row.outlier else told


def tied_words(words: Words, row: Residual) -> str:
    """Where a checkpoint or distance was tied to the drawings, safe to show."""
    if not row.lies:
        return printable(row.ends)
    kind = "lies" if row.place else "ends"
    place = " ".join(printable(part) for part in (row.drawing, row.item, row.layer, row.ends) if part)
    told = words(f"report.{kind}.{row.lies}")
    return f"{place} ({told})" if place else told
