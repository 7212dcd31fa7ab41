# SPDX-License-Identifier: MIT
"""A delivery as a whole: every file named is read within bounds, every file there is accounted for.

Nothing is ever written below the folder of the delivery. What cannot be read becomes a :class:`Source` that says why;
only a wrong manifest ends the reading.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path, PurePosixPath
from typing import TypeVar

import numpy as np

from foparq.errors import InputError, ManifestError, UnsafeError
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.drawing import Drawing
from foparq.model.items import Items, Role
from foparq.model.plane import Plane, plane_of
from foparq.model.tables import Checkpoints, Distances, FeatureList
from foparq.profile.manifest import DrawingSection, Manifest, TableSection
from foparq.profile.schema import Profile
from foparq.read.gis.companions import companions
from foparq.read.guard.parent import guarded
from foparq.read.guard.paths import MOST_FILES, files_of, fit_to_read, inside, name_of, sha256_of
from foparq.read.guard.sniff import Format, format_of
from foparq.read.guard.stage import sweep
from foparq.read.raw import RawDrawing
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

Progress = Callable[[str], None]
S = TypeVar("S", bound=TableSection)
T = TypeVar("T", Checkpoints, Distances, FeatureList)

_LONGEST = 300  #: letters of a path that are told
_OUTPUT = frozenset({"audit"})  #: where ``foparq audit`` writes: not part of what was delivered


@dataclass
class _Intake:
    """What was taken in so far."""

    profile: Profile
    scale: float | None
    progress: Progress | None
    sources: list[Source] = field(default_factory=list)
    drawings: list[Drawing] = field(default_factory=list)
    crashes: list[str] = field(default_factory=list)
    taken: set[Path] = field(default_factory=set)  #: files accounted for, links resolved

    def tell(self, name: str) -> None:
        if self.progress is not None:
            self.progress(name)


def read_delivery(
    root: Path,
    manifest: Manifest,
    manifest_name: str,
    *,
    profile: Profile,
    scale: float | None,
    progress: Progress | None = None,
) -> tuple[Delivery, tuple[str, ...]]:
    """Everything that a manifest names, and what else lies in the folder.

    Parameters
    ----------
    root : Path
        Folder of the delivery. Nothing outside is opened, nothing is written.
    manifest : Manifest
    manifest_name : str
        File name of the manifest in the folder; ``""`` if it was not read from a file there.
    profile : Profile
        Its limits and its way of reading hold.
    scale : float, optional
        Denominator k of the drawing scale 1:k, for a sagitta at scale.
    progress : callable, optional
        Told the name of each file before it is read.

    Returns
    -------
    delivery : Delivery
        Sources in the order of the manifest, then the files that it does not name. A file that is absent is
        ``MISSING``, one that cannot be read is ``REFUSED`` with the message that says why.
    crashes : tuple of str
        Tracebacks of readers that crashed, each headed by its file: faults of foparq, not of the delivery.

    Raises
    ------
    ManifestError
        If the manifest asks for what a readable file does not have: a table, a plane.
    QuantityError
        If the profile's sagitta is meant at scale and no scale is given.
    """
    intake = _Intake(profile=profile, scale=scale, progress=progress)
    sweep()
    if manifest_name:
        _manifest(intake, root, manifest_name)
    for section in manifest.drawing:
        _drawing(intake, section, _shown(section.path), partial(inside, root, section.path))
    checkpoints = _table(intake, root, "checkpoints", manifest.checkpoints, read_checkpoints)
    distances = _table(intake, root, "distances", manifest.distances, read_distances)
    features = _table(intake, root, "features", manifest.features, lambda path, _: read_feature_list(path))
    _unnamed(intake, root)
    delivery = Delivery(
        title=manifest.delivery.title or root.resolve().name, sources=tuple(intake.sources),
        parts=tuple(intake.drawings), checkpoints=checkpoints, distances=distances, features=features,
    )  # fmt: skip
    return delivery, tuple(intake.crashes)


def read_loose(
    paths: Sequence[Path],
    *,
    profile: Profile,
    scale: float | None,
    unit: str | None,
    plane: str | None,
    areas: tuple[str, ...] = (),
    progress: Progress | None = None,
) -> tuple[Delivery, tuple[str, ...]]:
    """Drawings without a manifest, named as they are given.

    Parameters
    ----------
    paths : sequence of Path
        Drawings, anywhere.
    profile, scale, progress
        As for :func:`read_delivery`.
    unit : str or None
        What one drawing unit is in all of them.
    plane : str or None
        ``"xy"``, ``"xz"``, ``"yz"`` or ``"fit"``, for all of them.
    areas : tuple of str
        Patterns of the layers whose closed lines bound areas.

    Returns
    -------
    delivery, crashes
        As for :func:`read_delivery`; the title is empty.
    """
    intake = _Intake(profile=profile, scale=scale, progress=progress)
    sweep()
    for path in paths:
        name = name_of(path.as_posix())
        section = DrawingSection.model_validate({"path": name, "unit": unit, "plane": plane, "areas": areas})
        _drawing(intake, section, name, path.resolve)
    return Delivery(title="", sources=tuple(intake.sources), parts=tuple(intake.drawings)), tuple(intake.crashes)


def read_drawing(path: Path, section: DrawingSection, profile: Profile, sagitta: float) -> RawDrawing:
    """Drawing of a file in any known format; runs in the child.

    Parameters
    ----------
    path : Path
        A regular file.
    section : DrawingSection
        Unit, and tables of a GeoPackage.
    profile : Profile
        Limits, and whether blocks are taken apart.
    sagitta : float, metres
        Greatest distance between a curve and its chords.

    Raises
    ------
    FoparqError
        As the reader of the format does.
    """
    # The child imports the reader of its file only.
    if format_of(path) is Format.DXF:
        from foparq.read.dxf.reader import read_dxf  # noqa: PLC0415

        return read_dxf(path, limits=profile.limits, sagitta=sagitta, unit=section.unit, blocks=profile.reading.blocks)
    from foparq.read.gis.reader import read_gis  # noqa: PLC0415

    return read_gis(path, limits=profile.limits, sagitta=sagitta, unit=section.unit, layers=section.layers)


def _shown(named: str) -> str:
    # As the manifest names it, with one kind of slash; a name that no file can have is shortened.
    shown = PurePosixPath(named.replace("\\", "/")).as_posix()
    return shown if len(shown) <= _LONGEST else f"{shown[:_LONGEST]}..."


def _manifest(intake: _Intake, root: Path, name: str) -> None:
    path = root / name
    intake.taken.add(path.resolve())
    intake.sources.append(
        Source(
            path=name,
            role="manifest",
            sha256=sha256_of(path),
            bytes=path.stat().st_size,
            status=SourceStatus.READ,
            items=1,
        )
    )


def _drawing(intake: _Intake, section: DrawingSection, name: str, find: Callable[[], Path]) -> None:
    intake.tell(name)
    source = Source(path=name, role="drawing", sha256="", bytes=0, status=SourceStatus.REFUSED)
    limits = intake.profile.limits
    sagitta = intake.profile.chord_distance(intake.scale)
    path = None
    try:
        path = find()
        _take_once(intake, path, name)
        source = _identified(source, path, limits.bytes)
        if source.status is SourceStatus.MISSING:
            intake.sources.append(source)
            return
        raw = guarded(
            read_drawing,
            path,
            section,
            intake.profile,
            sagitta,
            file=name,
            seconds=limits.seconds,
            memory=limits.memory,
        )
    except InputError as error:
        intake.sources.append(_refused(source, name, error.message, error.fields))
    except RuntimeError as error:
        intake.crashes.append(f"{name}\n{error}")
        intake.sources.append(_refused(source, name, "read.crashed", {}))
    except ManifestError as error:
        raise ManifestError(error.message, **{**error.fields, "file": name}) from None
    else:
        status = SourceStatus.RECOVERED if raw.reading.repairs else SourceStatus.READ
        intake.sources.append(replace(source, status=status, items=len(raw.items), skipped=raw.reading.skipped))
        intake.drawings.append(_joined(raw, section, name))
    if path is not None:
        _companions(intake, name, path, limits.bytes)


def _take_once(intake: _Intake, path: Path, name: str) -> None:
    # Counted twice, what is missing would look complete.
    if path.resolve() in intake.taken:
        raise ManifestError("manifest.drawing-twice", value=name)
    intake.taken.add(path.resolve())


def _companions(intake: _Intake, name: str, path: Path, limit: int) -> None:
    # A Shapefile is several files: what was read with it is hashed with it.
    if path.suffix.casefold() != ".shp" or not path.is_file():
        return
    folder = name.rpartition("/")[0]
    try:
        beside = companions(path, limit)
    except InputError:
        return  # told of the drawing itself
    for other in beside.values():
        intake.taken.add(other.resolve())
        shown = name_of(f"{folder}/{other.name}" if folder else other.name)
        intake.sources.append(
            Source(
                path=shown, role="other", sha256=sha256_of(other), bytes=other.stat().st_size, status=SourceStatus.READ
            )
        )


def _identified(source: Source, path: Path, limit: int) -> Source:
    if not path.exists():
        fields = (("file", source.path),)
        return replace(source, status=SourceStatus.MISSING, error="read.missing", fields=fields)
    try:
        size = fit_to_read(path, limit)
        return replace(source, sha256=sha256_of(path), bytes=size)
    except PermissionError:
        raise UnsafeError("read.no-permission", file=path.name) from None


def _refused(source: Source, name: str, message: str, fields: dict[str, object]) -> Source:
    # The name as the manifest writes it tells more than that of the file alone.
    said = {key: name_of(value) if isinstance(value, str) else value for key, value in fields.items()}
    named = {**said, "file": name}
    return replace(source, status=SourceStatus.REFUSED, error=message, fields=tuple(sorted(named.items())))


def _joined(raw: RawDrawing, section: DrawingSection, name: str) -> Drawing:
    try:
        plane = _plane(raw.items, section)
    except ManifestError as error:
        raise ManifestError(error.message, **{**error.fields, "file": name}) from None
    return Drawing(
        path=name, items=raw.items, reading=raw.reading, unit=raw.unit, plane=plane,
        facade=section.facade, classes=dict(section.classes), areas=section.areas,
    )  # fmt: skip


def _plane(items: Items, section: DrawingSection) -> Plane:
    # What is drawn decides; paper space and lettering may lie anywhere.
    drawn = items.visible & ~items.paper & np.isin(items.role, [Role.LINE.value, Role.AREA.value])
    geometry = items.geometry[drawn] if drawn.any() else items.geometry
    return plane_of(section.plane, geometry)


def _table(intake: _Intake, root: Path, role: str, section: S | None, read: Callable[[Path, S], T]) -> T | None:
    if section is None:
        return None
    name = _shown(section.path)
    intake.tell(name)
    source = Source(path=name, role=role, sha256="", bytes=0, status=SourceStatus.REFUSED)
    try:
        path = inside(root, section.path)
        intake.taken.add(path)
        source = _identified(source, path, intake.profile.limits.bytes)
        if source.status is SourceStatus.MISSING:
            intake.sources.append(source)
            return None
        table = read(path, section)
    except InputError as error:
        intake.sources.append(_refused(source, name, error.message, error.fields))
        return None
    intake.sources.append(replace(source, status=SourceStatus.READ, items=len(table.id)))
    return table


def _unnamed(intake: _Intake, root: Path) -> None:
    named = {source.path for source in intake.sources}
    for count, path in enumerate(files_of(root, _OUTPUT)):
        if count >= MOST_FILES:
            fields = (("file", root.resolve().name), ("limit", MOST_FILES))
            intake.sources.append(
                Source(
                    path=".",
                    role="other",
                    sha256="",
                    bytes=0,
                    status=SourceStatus.REFUSED,
                    error="read.too-many-files",
                    fields=fields,
                )
            )
            return
        name = name_of(path.relative_to(root).as_posix())
        link = path.is_symlink()
        if name in named or (not link and path.resolve() in intake.taken):
            continue
        size = 0 if link or not path.is_file() else path.stat().st_size
        intake.sources.append(Source(path=name, role="other", sha256="", bytes=size, status=SourceStatus.UNNAMED))
