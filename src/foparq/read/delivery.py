# SPDX-License-Identifier: MIT
"""A delivery as a whole: every file named is read within bounds, every file there is accounted for.

Nothing is ever written below the folder of the delivery. What cannot be read becomes a :class:`Source` that says why;
only a wrong manifest ends the reading.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TypeVar

import numpy as np

from foparq.errors import InputError, ManifestError
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.drawing import Drawing
from foparq.model.items import Items, Role
from foparq.model.plane import Plane, plane_of
from foparq.model.statements import Contract, Decision
from foparq.model.tables import Checkpoints, Distances, FeatureList
from foparq.names import folded
from foparq.profile.manifest import (
    ConfirmedSection,
    ContractSection,
    DrawingSection,
    Manifest,
    MeshSection,
    TableSection,
)
from foparq.profile.schema import Profile
from foparq.read.cloud.take import take_cloud
from foparq.read.guard.parent import guarded
from foparq.read.guard.paths import inside, name_of
from foparq.read.guard.sniff import Format, format_of, holds_mesh
from foparq.read.guard.stage import sweep
from foparq.read.intake import (
    Intake,
    Progress,
    identified,
    refused,
    shown_path,
    take_companions,
    take_manifest,
    take_profile,
    take_unnamed,
    take_unused,
)
from foparq.read.left_out import left_out
from foparq.read.mesh.take import take_mesh
from foparq.read.once import read_once
from foparq.read.raw import RawDrawing
from foparq.read.statements import confirmed, confirms
from foparq.read.table.extent import extent_of
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

T = TypeVar("T", Checkpoints, Distances, FeatureList)


def read_delivery(
    root: Path,
    manifest: Manifest,
    manifest_name: str,
    *,
    profile: Profile,
    scale: float | None,
    unused: Path | None = None,
    progress: Progress | None = None,
) -> tuple[Delivery, tuple[str, ...]]:
    """Everything that a manifest names, and what else lies in the folder.

    Parameters
    ----------
    root : Path
        Folder of the delivery. Nothing outside is opened, nothing is written.
    manifest_name : str
        File name of the manifest in the folder; ``""`` if it was not read from a file there.
    profile : Profile
        Its limits and its way of reading hold.
    scale : float, optional
        Denominator k of the drawing scale 1:k, for a sagitta at scale.
    unused : Path, optional
        Profile that the manifest names and the reviewer's goes before: hashed and listed.
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
    confirmations = confirmed(manifest, manifest_name)
    intake = Intake(profile=profile, scale=scale, progress=progress)
    sweep()
    if manifest_name:
        take_manifest(intake, root, manifest_name)
    take_profile(intake, root)
    if unused is not None:
        take_unused(intake, root, unused)
    for section in manifest.drawing:
        find = partial(inside, root, section.path)
        _drawing(intake, section, shown_path(section.path), find, manifest.confirmed)
    for mesh in manifest.mesh:
        take_mesh(intake, mesh, shown_path(mesh.path), partial(inside, root, mesh.path), manifest.confirmed)
    clouds = [
        take_cloud(intake, section, partial(inside, root, section.path), manifest.mesh)
        for section in manifest.reference
    ]
    drawings = [part for part in intake.parts if isinstance(part, Drawing)]
    extents = tuple(extent for drawing in drawings if (extent := extent_of(drawing)))
    checkpoints = _table(intake, root, "checkpoints", manifest.checkpoints, read_checkpoints, extents)
    distances = _table(intake, root, "distances", manifest.distances, read_distances, extents)
    features = _table(intake, root, "features", manifest.features, read_feature_list)
    if features is not None and manifest.features is not None and manifest.features.spacing is not None:
        features = replace(features, spacing=manifest.features.spacing.si())
    take_unnamed(intake, root)
    delivery = Delivery(
        title=manifest.delivery.title or root.resolve().name, sources=tuple(intake.sources),
        parts=tuple(intake.parts), references=tuple(filter(None, clouds)), checkpoints=checkpoints,
        distances=distances, features=features,
        confirmed=confirmations,
        contract=_contract(manifest.contract),
        crs="" if folded(manifest.delivery.crs) == "local" else manifest.delivery.crs,
        decisions=tuple(Decision(**section.model_dump()) for section in manifest.decision),
    )  # fmt: skip
    return delivery, tuple(intake.crashes)


def _contract(section: ContractSection | None) -> Contract | None:
    if section is None:
        return None
    day = section.date.isoformat() if section.date else ""
    made = Contract(**{**section.model_dump(exclude={"date"}), "date": day})
    return made if made != Contract() else None


def read_loose(
    paths: Sequence[Path],
    *,
    profile: Profile,
    scale: float | None,
    unit: str | None,
    plane: str | None,
    areas: tuple[str, ...] = (),
    bind: tuple[tuple[str, ...], ...] = (),
    ignore_layers: tuple[str, ...] = (),
    closed: bool | None = None,
    rims: int | None = None,
    progress: Progress | None = None,
) -> tuple[Delivery, tuple[str, ...]]:
    """Drawings and meshes without a manifest, named as they are given.

    Parameters
    ----------
    paths : sequence of Path
        Drawings and meshes, anywhere.
    profile, scale, progress
        As for :func:`read_delivery`.
    unit : str or None
        What one drawing unit is in all of them.
    plane : str or None
        ``"xy"``, ``"xz"``, ``"yz"`` or ``"fit"``, for all of them.
    areas : tuple of str
        Patterns of the layers whose closed lines bound areas.
    bind : tuple of tuples of str
        Groups of patterns of the layers that are drawn as one.
    ignore_layers : tuple of str
        Patterns of the layers that are not checked.
    closed : bool or None
        Whether the meshes among them are without a rim; ``None``: nobody states it.
    rims : int or None
        How many rims each of them has.

    Returns
    -------
    delivery, crashes
        As for :func:`read_delivery`; the title is empty.
    """
    intake = Intake(profile=profile, scale=scale, progress=progress)
    sweep()
    for path in paths:
        name = name_of(path.as_posix())
        said = {"unit": unit, "plane": plane, "areas": areas, "bind": bind, "ignore_layers": ignore_layers}
        if holds_mesh(path):
            take_mesh(intake, MeshSection(path=name, unit=unit, closed=closed, rims=rims), name, path.resolve)
            continue
        section = DrawingSection.model_validate({"path": name, **said})
        _drawing(intake, section, name, path.resolve)
    take_profile(intake, Path())
    return Delivery(title="", sources=tuple(intake.sources), parts=tuple(intake.parts)), tuple(intake.crashes)


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


def _drawing(
    intake: Intake, section: DrawingSection, name: str, find: Callable[[], Path],
    confirmed: Sequence[ConfirmedSection] = (),
) -> None:  # fmt: skip
    source = Source(path=name, role="drawing", sha256="", bytes=0, status=SourceStatus.REFUSED)
    sagitta = intake.profile.chord_distance(intake.scale)
    path, source, raw = read_once(intake, source, find, read_drawing, section, intake.profile, sagitta)
    if raw is not None:
        status = SourceStatus.RECOVERED if raw.reading.repairs else SourceStatus.READ
        aside = left_out(raw, section, hidden=intake.profile.reading.hidden == "check")
        raw = replace(raw, reading=replace(raw.reading, skipped=(*raw.reading.skipped, *aside)))
        source = replace(source, status=status, items=len(raw.items), skipped=raw.reading.skipped)
        intake.parts.append(_joined(raw, section, name, confirmed, frozenset(one.layer for one in aside)))
    intake.sources.append(source)
    if path is not None and source.status is not SourceStatus.MISSING:
        take_companions(intake, name, path, intake.profile.limits.bytes)


def _joined(
    raw: RawDrawing, section: DrawingSection, name: str, confirmed: Sequence[ConfirmedSection], ignored: frozenset[str]
) -> Drawing:
    try:
        plane = _plane(raw.items, section)
    except ManifestError as error:
        raise ManifestError(error.message, **{**error.fields, "file": name}) from None
    return Drawing(
        path=name, items=raw.items, reading=raw.reading, unit=raw.unit, plane=plane,
        facade=section.facade, classes=dict(section.classes), areas=section.areas, bind=section.bind, ignored=ignored,
        confirmed=frozenset(one.what for one in confirmed if confirms(one, section)),
    )  # fmt: skip


def _plane(items: Items, section: DrawingSection) -> Plane:
    # What is drawn decides; paper space and lettering may lie anywhere.
    drawn = items.visible & ~items.paper & np.isin(items.role, [Role.LINE.value, Role.AREA.value])
    geometry = items.geometry[drawn] if drawn.any() else items.geometry
    return plane_of(section.plane, geometry)


def _table(
    intake: Intake, root: Path, role: str, section: TableSection | None, read: Callable[..., T], *more: object
) -> T | None:
    if section is None:
        return None
    name = shown_path(section.path)
    intake.tell(name)
    source = Source(path=name, role=role, sha256="", bytes=0, status=SourceStatus.REFUSED)
    try:
        path = inside(root, section.path)
        intake.taken.add(path)
        source = identified(source, path, intake.profile.limits.bytes)
        if source.status is SourceStatus.MISSING:
            intake.sources.append(source)
            return None
        limits = intake.profile.limits
        table = guarded(read, path, section, *more, file=name, seconds=limits.seconds, memory=limits.memory)
    except InputError as error:
        intake.sources.append(refused(source, name, error.message, error.fields))
        return None
    except RuntimeError as error:
        intake.crashes.append(f"{name}\n{error}")
        intake.sources.append(refused(source, name, "read.crashed", {}))
        return None
    intake.sources.append(replace(source, status=SourceStatus.READ, items=len(table.id), skipped=table.skipped))
    return table
