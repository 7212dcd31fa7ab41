# SPDX-License-Identifier: MIT
"""Facts of one entity to vertices in world coordinates. Total: no facts make it raise."""

import math
from dataclasses import dataclass

import numpy as np

from foparq.columns import Coordinates
from foparq.model.drawing import SkippedReason
from foparq.model.items import Role
from foparq.read.dxf.curves import Point, Sagitta, TooFineError, flatten_arc, flatten_bulge, flatten_ellipse, to_world
from foparq.read.dxf.kinds import ANNOTATIONS, Unseen
from foparq.read.dxf.records import ArcFacts, EllipseFacts, FaceFacts, Facts, LineFacts, PlaceFacts, SplineFacts
from foparq.read.dxf.spline import flatten_spline, open_uniform

_CLOSING = 1e-9  #: share of the extent within which the ends of a closed spline differ by rounding alone
_CORNERS = 3  #: fewest corners of a face


@dataclass(frozen=True, slots=True)
class Shape:
    """One item: vertices of a line, ring of a face, or one point."""

    role: Role
    points: Coordinates  #: (n, 3)
    closed: bool = False


def draw(kind: str, facts: Facts, sagitta: Sagitta) -> Shape | Unseen:  # noqa: PLR0911 - one for each kind of facts
    """Shape of an entity, or why it has none.

    Parameters
    ----------
    kind : str
        Entity type.
    facts : Facts
        As read; what is unseen stays so.

    Returns
    -------
    Shape or Unseen
        Vertices of straight pieces are those of the file, bit by bit. A line has at least two vertices: a polyline of
        a single vertex repeats it and so has no length. A closed flag repeats the first vertex unless the file does.
    """
    try:
        match facts:
            case LineFacts():
                return _line(facts, sagitta)
            case ArcFacts():
                return _arc(facts, sagitta)
            case EllipseFacts():
                return _ellipse(facts, sagitta)
            case SplineFacts():
                return _spline(facts, sagitta)
            case FaceFacts():
                return _face(facts)
            case PlaceFacts():
                return Shape(facts.role or _role(kind), to_world(np.array([facts.point]), facts.extrusion))
            case Unseen():
                return facts
            case _:
                return Unseen(SkippedReason.UNSUPPORTED)
    except TooFineError:
        return Unseen(SkippedReason.TOO_MANY_VERTICES)


def _role(kind: str) -> Role:
    if kind in ANNOTATIONS:
        return Role.ANNOTATION
    return Role.POINT if kind == "POINT" else Role.HATCH


def _line(facts: LineFacts, sagitta: Sagitta) -> Shape | Unseen:
    points = facts.points
    if not points:
        return Unseen(SkippedReason.NO_GEOMETRY)
    bulges = facts.bulges
    if facts.closed and (points[-1] != points[0] or (bulges is not None and len(points) == 1)):
        points = [*points, points[0]]
    elif len(points) == 1:
        points = points * 2
    vertices = np.array(points, dtype=float) if bulges is None else _bent(points, bulges, sagitta)
    return Shape(Role.LINE, to_world(vertices, facts.extrusion), facts.closed)


def _bent(points: list[Point], bulges: list[float], sagitta: Sagitta) -> Coordinates:
    pieces = [np.array(points[:1], dtype=float)]
    for first, second, bulge in zip(points, points[1:], bulges, strict=False):
        if bulge:
            pieces.append(flatten_bulge(first, second, bulge, sagitta))
        pieces.append(np.array([second], dtype=float))
    return np.concatenate(pieces)


def _arc(facts: ArcFacts, sagitta: Sagitta) -> Shape | Unseen:
    if not 0 < facts.radius < math.inf:
        return Unseen(SkippedReason.DEGENERATE)
    sweep = math.tau
    if not facts.full:
        if not math.isfinite(facts.end - facts.start) or facts.end == facts.start:
            return Unseen(SkippedReason.DEGENERATE)
        turn = (facts.end - facts.start) % 360.0
        sweep = math.radians(turn) if turn else math.tau
    points = flatten_arc(facts.centre, facts.radius, math.radians(facts.start), sweep, sagitta)
    return Shape(Role.LINE, to_world(points, facts.extrusion), sweep >= math.tau)


def _ellipse(facts: EllipseFacts, sagitta: Sagitta) -> Shape | Unseen:
    length = math.hypot(*facts.major)
    size = math.hypot(*facts.extrusion)
    span = facts.end - facts.start
    if not 0 < length < math.inf or not 0 < size < math.inf or not math.isfinite(span) or span == 0:
        return Unseen(SkippedReason.DEGENERATE)
    (ax, ay, az), (nx, ny, nz) = facts.major, (part / size for part in facts.extrusion)
    r = facts.ratio
    minor = ((ny * az - nz * ay) * r, (nz * ax - nx * az) * r, (nx * ay - ny * ax) * r)
    sweep = span % math.tau
    if sweep < _CLOSING or math.tau - sweep < _CLOSING:  # a full turn, up to the digits a file keeps
        sweep = math.tau
    points = flatten_ellipse(facts.centre, facts.major, minor, facts.start, sweep, sagitta)
    return Shape(Role.LINE, points, sweep >= math.tau)


def _spline(facts: SplineFacts, sagitta: Sagitta) -> Shape | Unseen:
    control = np.array(facts.control, dtype=float)
    degree = facts.degree
    if not 1 <= degree < len(control):
        return Unseen(SkippedReason.MALFORMED)
    knots = np.array(facts.knots, dtype=float) if facts.knots else open_uniform(len(control), degree)
    weights = np.array(facts.weights, dtype=float) if facts.weights else None
    vertices = flatten_spline(control, knots, degree, weights, sagitta)
    if vertices is None:
        return Unseen(SkippedReason.MALFORMED)
    gap = float(np.linalg.norm(vertices[0] - vertices[-1]))
    if facts.closed and gap > 0:
        near = gap <= _CLOSING * float(np.ptp(vertices, axis=0).max())
        vertices = np.concatenate([vertices[:-1] if near else vertices, vertices[:1]])
    return Shape(Role.LINE, vertices, facts.closed)


def _face(facts: FaceFacts) -> Shape | Unseen:
    if len(facts.corners) < _CORNERS:
        return Unseen(SkippedReason.NO_GEOMETRY)
    corners = to_world(np.array([*facts.corners, facts.corners[0]], dtype=float), facts.extrusion)
    return Shape(Role.SURFACE, corners) if np.isfinite(corners).all() else Unseen(SkippedReason.MALFORMED)
