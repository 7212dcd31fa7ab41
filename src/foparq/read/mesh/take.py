# SPDX-License-Identifier: MIT
"""Meshes taken in: read in the guarded child, joined with what the manifest states of them."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from foparq.model.delivery import Source, SourceStatus
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh, MeshReading, RawMesh
from foparq.profile.manifest import ConfirmedSection, MeshSection
from foparq.profile.schema import Profile
from foparq.read.intake import Intake
from foparq.read.once import read_once
from foparq.read.statements import confirms
from foparq.units import parse_length_unit


def take_mesh(
    intake: Intake,
    section: MeshSection,
    name: str,
    find: Callable[[], Path],
    confirmed: Sequence[ConfirmedSection] = (),
) -> None:
    """Take in one mesh: a part if it can be read, and its source.

    Parameters
    ----------
    section : MeshSection
        What the manifest states of it.
    name : str
        Its path as the delivery names it.
    find : callable
        Finds the file.
    confirmed : sequence of ConfirmedSection
        What persons confirmed.
    """
    source = Source(path=name, role="mesh", sha256="", bytes=0, status=SourceStatus.REFUSED)
    _, source, raw = read_once(intake, source, find, read_raw, intake.profile)
    if raw is not None:
        status = SourceStatus.RECOVERED if raw.reading.repairs else SourceStatus.READ
        source = replace(source, status=status, items=raw.faces, skipped=raw.reading.skipped)
        intake.parts.append(
            Mesh(
                path=name, points=raw.points, corners=raw.corners, starts=raw.starts, group=raw.group,
                groups=raw.groups, texture=raw.texture, reading=raw.reading, unit=_unit(raw.reading, section.unit),
                closed=False if section.rims else section.closed, rims=section.rims, facade=section.facade,
                up=section.up or "", confirmed=frozenset(one.what for one in confirmed if confirms(one, section)),
            )
        )  # fmt: skip
    intake.sources.append(source)


def read_raw(path: Path, profile: Profile) -> RawMesh:
    """Mesh of a file in any known format; runs in the child.

    Raises
    ------
    FoparqError
        As the reader of the format does.
    """
    from foparq.read.mesh.reader import read_mesh  # noqa: PLC0415 - the child imports the reader of its file only

    return read_mesh(path, limits=profile.limits)


def _unit(reading: MeshReading, stated: str | None) -> DrawingUnit:
    says = parse_length_unit(reading.unit) if reading.unit else None
    if stated is not None:
        return DrawingUnit(
            metres=parse_length_unit(stated), name=stated, origin=UnitOrigin.STATED, header=reading.unit,
            header_metres=says,
        )  # fmt: skip
    origin = UnitOrigin.HEADER if says is not None else UnitOrigin.UNKNOWN
    return DrawingUnit(metres=says, name=reading.unit, origin=origin, header=reading.unit, header_metres=says)
