# SPDX-License-Identifier: MIT
"""Clouds of reference taken in: read in the guarded child, joined with what the manifest states of them."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from foparq.errors import ManifestError
from foparq.model.cloud import Cloud, RawCloud
from foparq.model.delivery import Source, SourceStatus
from foparq.model.drawing import DrawingUnit, Skipped, SkippedReason, UnitOrigin
from foparq.names import folded
from foparq.profile.manifest import MeshSection, ReferenceSection
from foparq.profile.schema import Profile
from foparq.read.intake import Intake, shown_path
from foparq.read.once import read_once
from foparq.units import parse_length_unit


def take_cloud(
    intake: Intake, section: ReferenceSection, find: Callable[[], Path], meshes: Sequence[MeshSection]
) -> Cloud | None:
    """Take in one cloud: its source, and the cloud if it can be read.

    Parameters
    ----------
    section : ReferenceSection
        What the manifest states of it.
    find : callable
        Finds the file.
    meshes : sequence of MeshSection
        Those of the manifest.

    Raises
    ------
    ManifestError
        If it is said to show a mesh that the manifest does not name.
    """
    shown = _mesh_of(section, meshes)
    source = Source(path=shown_path(section.path), role="reference", sha256="", bytes=0, status=SourceStatus.REFUSED)
    _, source, raw = read_once(intake, source, find, read_raw_cloud, intake.profile)
    cloud = None
    if raw is not None:
        cloud = Cloud(
            path=source.path, points=raw.points, empty=raw.empty, unit=_unit(section.unit),
            survey_sd=None if section.survey_sd is None else section.survey_sd.si(), mesh=shown,
        )  # fmt: skip
        source = replace(source, items=len(raw.points), skipped=_skipped(raw))
    intake.sources.append(source)
    return cloud


def read_raw_cloud(path: Path, profile: Profile) -> RawCloud:
    """Cloud of a file in any known format; runs in the child.

    Raises
    ------
    FoparqError
        As the reader of the format does.
    """
    from foparq.read.cloud.reader import read_cloud  # noqa: PLC0415 - the child imports the reader of its file only

    return read_cloud(path, limits=profile.limits)


def _mesh_of(section: ReferenceSection, meshes: Sequence[MeshSection]) -> str:
    """Path of the mesh that a cloud shows, as the delivery names it; ``""`` for every one."""
    if not section.mesh:
        return ""
    named = {folded(path): path for path in (shown_path(mesh.path) for mesh in meshes)}
    wanted = folded(shown_path(section.mesh))
    if wanted not in named:
        example = ", ".join(f'mesh = "{path}"' for path in named.values()) or "[[mesh]]"
        raise ManifestError("manifest.no-such-mesh", file=section.path, key="mesh", value=section.mesh, example=example)
    return named[wanted]


def _skipped(raw: RawCloud) -> tuple[Skipped, ...]:
    if not raw.empty:
        return ()
    return (Skipped(reason=SkippedReason.NO_COORDINATES, kind="point", layer="", count=raw.empty),)


def _unit(stated: str | None) -> DrawingUnit:
    if stated is None:
        return DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN, header="", header_metres=None)
    return DrawingUnit(
        metres=parse_length_unit(stated), name=stated, origin=UnitOrigin.STATED, header="", header_metres=None
    )
