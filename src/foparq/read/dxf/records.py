# SPDX-License-Identifier: MIT
"""Plain numbers and texts of DXF entities, one record a kind of shape."""

from dataclasses import dataclass
from typing import Any

from foparq.model.items import Role
from foparq.read.dxf.curves import Point
from foparq.read.dxf.kinds import Unseen


@dataclass(frozen=True, slots=True)
class Common:
    """What every entity has."""

    kind: str
    handle: str
    layer: str
    colour: int
    invisible: bool


@dataclass(frozen=True, slots=True)
class LineFacts:
    """Straight, unless bulges say otherwise."""

    points: list[Point]
    bulges: list[float] | None
    closed: bool
    extrusion: Point


@dataclass(frozen=True, slots=True)
class ArcFacts:
    """Arc or circle in its own coordinate system; angles in degrees."""

    centre: Point
    radius: float
    start: float
    end: float
    full: bool
    extrusion: Point


@dataclass(frozen=True, slots=True)
class EllipseFacts:
    """Elliptic arc in world coordinates; parameters in radians."""

    centre: Point
    major: Point
    ratio: float
    start: float
    end: float
    extrusion: Point


@dataclass(frozen=True, slots=True)
class SplineFacts:
    """B-spline; ``knots`` and ``weights`` empty if the file holds none."""

    control: list[Point]
    knots: list[float]
    weights: list[float]
    degree: int
    closed: bool


@dataclass(frozen=True, slots=True)
class FaceFacts:
    """Three or four corners."""

    corners: list[Point]
    extrusion: Point


@dataclass(frozen=True, slots=True)
class PlaceFacts:
    """A position."""

    point: Point
    extrusion: Point
    role: Role | None = None  #: where the entity type does not tell


@dataclass(frozen=True, slots=True)
class InsertFacts:
    """A block reference."""

    name: str
    point: Point
    scale: Point
    rotation: float
    extrusion: Point
    rows: int
    columns: int
    row_spacing: float
    column_spacing: float
    attributes: tuple[Any, ...]
    clipped: bool


Facts = LineFacts | ArcFacts | EllipseFacts | SplineFacts | FaceFacts | PlaceFacts | InsertFacts | Unseen
