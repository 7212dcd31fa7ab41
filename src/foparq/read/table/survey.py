# SPDX-License-Identifier: MIT
"""What lies in a folder: drawings and tables, told by trying to read them."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from foparq.errors import InputError
from foparq.model.delivery import LOST
from foparq.model.drawing import Drawing
from foparq.profile.manifest import SurveySection
from foparq.profile.schema import LimitsSpec, Profile
from foparq.read.delivery import read_loose
from foparq.read.guard.parent import guarded
from foparq.read.guard.paths import files_of
from foparq.read.guard.sniff import format_of
from foparq.read.table.csv_text import is_workbook
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

_TABLES = {".csv", ".txt", ".tsv", ".xlsx", ".xlsm", ".ods"}
_MOST_SHEETS = 10  #: sheets of a workbook that are looked at
_SCALE = 50.0  #: only decides how finely curves are drawn; nothing is measured here


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundDrawing:
    """A drawing that could be read."""

    path: str  #: relative to the folder
    header: str  #: unit that the file states; ``""`` if silent
    layers: tuple[str, ...]  #: layers that hold anything
    extent: tuple[float, float, float]  #: width in x, y and z, drawing units


@dataclass(frozen=True, slots=True)
class FoundTable:
    """A table whose header names what is asked for."""

    path: str  #: relative to the folder
    sheet: str | None  #: of a workbook, where it is not the first


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """Readable files of a folder by role; paths are relative to it."""

    drawings: tuple[FoundDrawing, ...]
    tables: dict[str, tuple[FoundTable, ...]]  #: ``checkpoints``, ``distances``, ``features``
    others: tuple[str, ...]  #: files that are neither, or could not be read


def survey_folder(folder: Path, profile: Profile) -> Survey:
    """Look at every file of a folder.

    Parameters
    ----------
    profile : Profile
        Its limits hold.

    Returns
    -------
    Survey
        In order of paths.
    """
    names = sorted(path.relative_to(folder).as_posix() for path in files_of(folder, frozenset({"audit"})))
    drawings: list[FoundDrawing] = []
    tables: dict[str, tuple[FoundTable, ...]] = {}
    others: list[str] = []
    for name in names:
        if not (folder / name).is_file():
            others.append(name)
            continue
        found = _tables_of(folder / name, profile.limits)
        for role, sheet in found:
            tables[role] = (*tables.get(role, ()), FoundTable(name, sheet))
        if found:
            continue
        if drawing := _drawing(folder / name, profile):
            drawings.append(_found(drawing, name))
        else:
            others.append(name)
    return Survey(drawings=tuple(drawings), tables=tables, others=tuple(others))


def _tables_of(path: Path, limits: LimitsSpec) -> list[tuple[str, str | None]]:
    if path.suffix.lower() not in _TABLES:
        return []
    try:
        return guarded(tables_in, path, file=path.name, seconds=limits.seconds, memory=limits.memory)
    except InputError:
        return []


def tables_in(path: Path) -> list[tuple[str, str | None]]:
    """Role of a table, and of every sheet of a workbook that is one; runs in the child.

    Parameters
    ----------
    path : Path
        A regular file.

    Returns
    -------
    list of (role, sheet)
        The sheet is ``None`` where it need not be stated.
    """
    sheets: list[str | None] = [None]
    if is_workbook(path):
        from foparq.read.table.workbook import sheets_of  # noqa: PLC0415 - few tables need openpyxl

        shown = [(n, name) for n, (name, visible) in enumerate(sheets_of(path).items()) if visible]
        sheets = [name if n else None for n, name in shown[:_MOST_SHEETS]]
    return [(role, sheet) for sheet in sheets if (role := _role(path, sheet))]


def _role(path: Path, sheet: str | None) -> str:
    section = SurveySection(path=path.name, sheet=sheet)
    readers: dict[str, Callable[..., object]] = {
        "checkpoints": read_checkpoints,
        "distances": read_distances,
        "features": read_feature_list,
    }
    return next((role for role, reader in readers.items() if _reads(reader, path, section)), "")


def _reads(reader: Callable[..., object], path: Path, section: SurveySection) -> bool:
    try:
        reader(path, section)
    except InputError as error:
        return error.message == "table.thousands"  # its drawing may prove what it says
    return True


def _drawing(path: Path, profile: Profile) -> Drawing | None:
    try:
        format_of(path)
    except (InputError, OSError):
        return None
    delivery, _ = read_loose([path], profile=profile, scale=_SCALE, unit=None, plane=None)
    if any(source.status in LOST for source in delivery.sources) or not delivery.drawings:
        return None
    return delivery.drawings[0]


def _found(drawing: Drawing, name: str) -> FoundDrawing:
    items = drawing.items
    points = shapely.get_coordinates(items.geometry, include_z=True)
    points = np.nan_to_num(points[np.isfinite(points[:, :2]).all(axis=1)])
    width = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    return FoundDrawing(
        path=name,
        header=drawing.unit.header,
        layers=tuple(sorted(set(items.layer.tolist()))),
        extent=(float(width[0]), float(width[1]), float(width[2])),
    )
