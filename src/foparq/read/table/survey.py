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
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

_TABLES = {".csv", ".txt", ".tsv", ".xlsx", ".xlsm", ".ods"}
_SCALE = 50.0  #: only decides how finely curves are drawn; nothing is measured here


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundDrawing:
    """A drawing that could be read."""

    path: str  #: relative to the folder
    header: str  #: unit that the file states; ``""`` if silent
    layers: tuple[str, ...]  #: layers that hold anything
    extent: tuple[float, float, float]  #: width in x, y and z, drawing units


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """Readable files of a folder by role; paths are relative to it."""

    drawings: tuple[FoundDrawing, ...]
    tables: dict[str, tuple[str, ...]]  #: ``checkpoints``, ``distances``, ``features``
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
    tables: dict[str, tuple[str, ...]] = {}
    others: list[str] = []
    for name in names:
        if not (folder / name).is_file():
            others.append(name)
            continue
        role = _table_role(folder / name, profile.limits)
        if role:
            tables[role] = (*tables.get(role, ()), name)
        elif drawing := _drawing(folder / name, profile):
            drawings.append(_found(drawing, name))
        else:
            others.append(name)
    return Survey(drawings=tuple(drawings), tables=tables, others=tuple(others))


def _table_role(path: Path, limits: LimitsSpec) -> str:
    if path.suffix.lower() not in _TABLES:
        return ""
    readers: dict[str, Callable[..., object]] = {
        "checkpoints": read_checkpoints,
        "distances": read_distances,
        "features": read_feature_list,
    }
    return next((role for role, reader in readers.items() if _reads(reader, path, limits)), "")


def _reads(reader: Callable[..., object], path: Path, limits: LimitsSpec) -> bool:
    section = SurveySection(path=path.name)
    try:
        guarded(reader, path, section, file=path.name, seconds=limits.seconds, memory=limits.memory)
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
