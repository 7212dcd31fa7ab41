# SPDX-License-Identifier: MIT
"""What lies in a folder: drawings and tables, told by trying to read them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely

from foparq.errors import InputError
from foparq.model.delivery import LOST
from foparq.model.drawing import Drawing
from foparq.model.items import Role
from foparq.model.mesh import Mesh
from foparq.profile.manifest import SurveySection, TableSection
from foparq.profile.schema import LimitsSpec, Profile
from foparq.read.cloud.found import FoundCloud, found_cloud
from foparq.read.delivery import read_loose
from foparq.read.guard.parent import guarded
from foparq.read.guard.paths import files_of
from foparq.read.guard.sniff import format_of, holds_mesh
from foparq.read.table.csv_text import is_workbook
from foparq.read.table.revisions import is_aside, revision_of
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

_TABLES = {".csv", ".txt", ".tsv", ".xlsx", ".xlsm", ".ods"}
_MOST_SHEETS = 10  #: sheets of a workbook that are looked at
Why = tuple[str, str, Mapping[str, object]]  #: role of a table, message of the ``errors`` catalogue, and its fields
_NO_TABLE = frozenset({"table.column-missing", "table.no-columns"})
_REQUIRED = {"checkpoints": 4, "distances": 2, "features": 2}  #: columns that a table of the role must have
#: what a file is that is no drawing, where its owner may have meant it for one
_TELLING = frozenset({"read.dwg", "read.pdf", "read.archive", "read.empty"})
_SCALE = 50.0  #: only decides how finely curves are drawn; nothing is measured here


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundDrawing:
    """A drawing that could be read."""

    path: str  #: relative to the folder
    header: str  #: unit that the file states; ``""`` if silent
    layers: tuple[str, ...]  #: layers that hold anything
    extent: tuple[float, float, float]  #: width in x, y and z, drawing units


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundMesh:
    """A mesh that could be read."""

    path: str  #: relative to the folder
    header: str  #: unit that the format states; ``""`` if silent
    faces: int
    extent: tuple[float, float, float]  #: width in x, y and z, units of the file


@dataclass(frozen=True, slots=True)
class FoundTable:
    """A table whose header names what is asked for."""

    path: str  #: relative to the folder
    sheet: str | None  #: of a workbook, where it is not the first


@dataclass(frozen=True, slots=True)
class Other:
    """A file that is neither drawing nor table, and why, where that can be said."""

    path: str  #: relative to the folder
    role: str = ""  #: of the table that it is most like
    message: str = ""  #: id in the ``errors`` catalogue
    fields: tuple[tuple[str, object], ...] = ()
    aside: bool = False  #: a backup or lock that a program keeps for itself


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """Readable files of a folder by role; paths are relative to it."""

    drawings: tuple[FoundDrawing, ...]
    meshes: tuple[FoundMesh, ...]
    tables: dict[str, tuple[FoundTable, ...]]  #: ``checkpoints``, ``distances``, ``features``; the latest first
    others: tuple[Other, ...]  #: files that are neither, or could not be read
    classes: tuple[str, ...] = ()  #: of the list of features
    facades: tuple[str, ...] = ()  #: likewise
    clouds: tuple[FoundCloud, ...] = ()


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
    meshes: list[FoundMesh] = []
    clouds: list[FoundCloud] = []
    tables: dict[str, list[FoundTable]] = {}
    others: list[Other] = []
    for name in names:
        if is_aside(name) or not (folder / name).is_file():
            others.append(Other(name, aside=is_aside(name)))
            continue
        found, why = _tables_of(folder / name, profile.limits)
        for role, sheet in found:
            tables.setdefault(role, []).append(FoundTable(name, sheet))
        if found:
            continue
        part = _part(folder / name, profile)
        if isinstance(part, Drawing):
            drawings.append(_found(part, name))
        elif isinstance(part, Mesh):
            meshes.append(_found_mesh(part, name))
        elif (cloud := found_cloud(folder / name, name, profile)) is not None:
            clouds.append(cloud)
        else:
            others.append(_other(name, why, part))
    latest = {role: tuple(sorted(found, key=lambda one: -revision_of(one.path).rank)) for role, found in tables.items()}
    classes, facades = _listed(folder, latest.get("features", ()), profile.limits)
    return Survey(
        drawings=tuple(drawings), meshes=tuple(meshes), tables=latest, others=tuple(others), classes=classes,
        facades=facades, clouds=tuple(clouds),
    )  # fmt: skip


def _other(name: str, table: Why | None, drawing: Why | None) -> Other:
    """A file that was taken for nothing; of a table the reason of the table, else what a drawing lacks."""
    role, message, fields = table or drawing or ("", "", {})
    return Other(name, role, message, tuple({**fields, "file": name}.items()) if message else ())


def _listed(folder: Path, found: Sequence[FoundTable], limits: LimitsSpec) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Classes and facades of the list of features, in alphabetical order."""
    if not found:
        return (), ()
    path = folder / found[0].path
    section = TableSection(path=path.name, sheet=found[0].sheet)
    try:
        table = guarded(read_feature_list, path, section, file=path.name, seconds=limits.seconds, memory=limits.memory)
    except (InputError, RuntimeError):
        return (), ()
    return tuple(sorted(set(table.feature_class.tolist()))), tuple(sorted(set(table.facade.tolist()) - {""}))


def _tables_of(path: Path, limits: LimitsSpec) -> tuple[list[tuple[str, str | None]], Why | None]:
    if path.suffix.lower() not in _TABLES:
        return [], None
    try:
        return guarded(tables_in, path, file=path.name, seconds=limits.seconds, memory=limits.memory)
    except InputError as error:
        return [], ("", error.message, error.fields)


def tables_in(path: Path) -> tuple[list[tuple[str, str | None]], Why | None]:
    """Role of a table, and of every sheet of a workbook that is one; runs in the child.

    Parameters
    ----------
    path : Path
        A regular file.

    Returns
    -------
    found : list of (role, sheet)
        The sheet is ``None`` where it need not be stated.
    why : (role, message, fields), or None
        Why it is no table of the role that it is most like.
    """
    sheets: list[str | None] = [None]
    if is_workbook(path):
        from foparq.read.table.workbook import sheets_of  # noqa: PLC0415 - few tables need openpyxl

        shown = [(n, name) for n, (name, visible) in enumerate(sheets_of(path).items()) if visible]
        sheets = [name if n else None for n, name in shown[:_MOST_SHEETS]]
    tried = [(sheet, *_role(path, sheet)) for sheet in sheets]
    found = [(role, sheet) for sheet, role, _ in tried if role]
    whys = [why for _, _, why in tried if why]
    # Any text names its first line as columns that are not known: that says something of a table only.
    if path.suffix.lower() == ".txt":
        whys = [why for why in whys if why[1] not in _NO_TABLE]
    return found, None if found or not whys else whys[0]


def _role(path: Path, sheet: str | None) -> tuple[str, Why | None]:
    """Role of a sheet, else why it is none of the role that it comes nearest to."""
    section = SurveySection(path=path.name, sheet=sheet)
    readers: dict[str, Callable[..., object]] = {
        "checkpoints": read_checkpoints,
        "distances": read_distances,
        "features": read_feature_list,
    }
    whys: list[Why] = []
    for role, reader in readers.items():
        try:
            reader(path, section)
        except InputError as error:
            if error.message == "table.thousands":  # its drawing may prove what it says
                return role, None
            whys.append((role, error.message, error.fields))
        else:
            return role, None
    return "", min(whys, key=_lacking)


def _lacking(why: Why) -> float:
    """How far a table is from a role: a wrong cell below right headers is nearest, then few that lack."""
    _, message, fields = why
    if message not in _NO_TABLE:
        return 0.0
    lack = str(fields.get("key", "")).count(",") + 1
    return lack / _REQUIRED[why[0]] if message == "table.column-missing" else 2.0


def _part(path: Path, profile: Profile) -> Drawing | Mesh | Why | None:
    try:
        if not holds_mesh(path):
            format_of(path)
    except InputError as error:
        return ("", error.message, error.fields) if error.message in _TELLING else None
    except OSError:
        return None
    delivery, _ = read_loose([path], profile=profile, scale=_SCALE, unit=None, plane=None)
    lost = next((source for source in delivery.sources if source.status in LOST), None)
    if lost is not None:
        return "", lost.error, dict(lost.fields)
    part = next(iter(delivery.parts), None)
    return part if isinstance(part, Drawing | Mesh) else None


def _found_mesh(mesh: Mesh, name: str) -> FoundMesh:
    points = mesh.points[mesh.finite]
    width = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    return FoundMesh(
        path=name, header=mesh.unit.header, faces=mesh.features,
        extent=(float(width[0]), float(width[1]), float(width[2])),
    )  # fmt: skip


def _found(drawing: Drawing, name: str) -> FoundDrawing:
    items = drawing.items
    # What is drawn shows the plane; dimensions, targets and sheets may lie anywhere.
    drawn = items.visible & ~items.paper & np.isin(items.role, [Role.LINE.value, Role.AREA.value])
    points = shapely.get_coordinates(items.geometry[drawn] if drawn.any() else items.geometry, include_z=True)
    points = np.nan_to_num(points[np.isfinite(points[:, :2]).all(axis=1)])
    width = np.ptp(points, axis=0) if len(points) else np.zeros(3)
    return FoundDrawing(
        path=name,
        header=drawing.unit.header,
        layers=tuple(sorted(set(items.layer.tolist()))),
        extent=(float(width[0]), float(width[1]), float(width[2])),
    )
