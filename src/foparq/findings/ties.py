# SPDX-License-Identifier: MIT
"""How tables of evidence belong to the drawings and meshes beside them."""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from foparq.columns import Flags, Index, Reals, Texts
from foparq.findings.because import Because
from foparq.match.causes import Cause

NOBODY = -1  #: the end of a distance is no checkpoint


def _untold() -> Reals:
    return np.empty(0)


def _placeless() -> Reals:
    return np.empty((0, 2, 3))


def _nowhere() -> Index:
    return np.empty((0, 2), dtype=np.intp)


def _none() -> Flags:
    return np.zeros(0, dtype=bool)


def _unasked() -> Flags:
    return np.zeros((0, 0), dtype=bool)


class Alike(NamedTuple):
    """Two drawings of two facades whose linework is the same, or two meshes with the same vertices."""

    path: str
    facade: str
    other: str  #: path of the other one
    other_facade: str
    mirrored: bool


def _unnumbered() -> Index:
    return np.empty(0, dtype=np.intp)


class Lies(StrEnum):
    """Where a checkpoint lies in the drawings; each is an id in the ``report`` catalogue under ``lies.``."""

    VERTEX = "vertex"
    LINEWORK = "linework"
    SURFACE = "surface"  #: on a mesh, between its vertices
    NAMED = "named"  #: at a point, block or lettering that bears its id
    TAKEN_NAMED = "taken-named"  #: its coordinates were taken from what bears its id
    TAKEN_VERTEX = "taken-vertex"  #: its coordinates were taken from the only vertex near by
    TAKEN_SURFACE = "taken-surface"  #: its coordinates are the nearest place of a mesh
    ABSENT = "absent"  #: on no linework or surface: not in what was delivered
    UNTOLD = "untold"  #: no coordinates were delivered, and none could be taken


class Ends(StrEnum):
    """What is known of the ends of a distance; each is an id in the ``report`` catalogue under ``ends.``."""

    POINTS = "points"  #: both are points of a drawing, and the delivered length is theirs
    NAMES = "names"  #: names only; the length fits into the drawings
    OTHER_LENGTH = "other-length"  #: both are points of a drawing, and their distance is another
    ABSENT = "absent"  #: one of them has a place, and no drawing has it there
    TOO_LONG = "too-long"  #: names only; no drawing holds so long a line
    TOO_SHORT = "too-short"  #: names only; cannot be seen at the scale of the drawing
    UNTOLD = "untold"  #: no length was delivered, and none could be taken


@dataclass(frozen=True, slots=True, kw_only=True)
class PointTies:
    """Checkpoints in the drawings, n rows as in the table."""

    lies: Texts  #: (n,) value of :class:`Lies`
    gap: Reals  #: (n,) to the nearest linework, metres, in the axes that were compared; infinite without any
    drawing: Texts  #: (n,) path of the drawing it lies in; ``""`` if absent
    item: Texts  #: (n,) item it lies on
    layer: Texts  #: (n,) layer of that item
    delivered: Reals  #: (n, 3) coordinates that count, metres: of the table, else of the drawing; NaN if untold
    group: Index  #: (n,) points that stand for one place have one number
    unchecked: Flags  #: (3,) axes in which no drawing could be compared: it is flat
    corner: Reals = field(default_factory=_untold)  #: (n,) to its vertex, else infinite; empty: untold
    cause: Cause | None = None  #: what would put all of them on the drawing
    near: str = ""  #: path of the drawing of which the cause speaks
    files: tuple[str, ...] = ()  #: paths of d drawings; empty: untold
    facades: tuple[str, ...] = ()  #: of these; ``""`` where the manifest names none
    made: Flags = field(default_factory=_none)  #: (n,) on linework that shows nothing else, as most of its drawing are
    held: Flags = field(default_factory=_unasked)  #: (n, d) the point lies in the drawing
    beside: Flags = field(default_factory=_unasked)  #: (n, d) absent, and nearest to it, not beyond its own diagonal


@dataclass(frozen=True, slots=True, kw_only=True)
class DistanceTies:
    """Distances in the drawings, n rows as in the table."""

    ends: Texts  #: (n,) value of :class:`Ends`
    between: Reals  #: (n,) distance of the ends in the drawing, metres; NaN if they are names
    delivered: Reals  #: (n,) length that counts, metres: of the table, else of the drawing; NaN if untold
    group: Index  #: (n,) rows that repeat one measurement have one number
    longest: float  #: greatest length that a drawing holds, metres; NaN without a drawing
    factor: float = 1.0  #: with which all lengths would be those between the ends: another unit
    places: Reals = field(default_factory=_placeless)  #: (n, 2, 3) the ends, metres, NaN if unknown; empty: untold
    at: Index = field(default_factory=_nowhere)  #: (n, 2) row of the checkpoint that the end is, or -1; empty: untold
    alike: Index = field(default_factory=_unnumbered)  #: (n,) lengths that cannot be seen to differ; empty: untold


class Beside(NamedTuple):
    """A mesh beside drawings, and the surveyed places of the checkpoints."""

    path: str
    facade: str
    ids: tuple[str, ...]  #: of points near its surface, the farthest first
    distance: tuple[float, ...]  #: of these to the surface, metres


@dataclass(frozen=True, slots=True, kw_only=True)
class Ties:
    """What of the tables belongs to the drawings."""

    points: PointTies | None = None
    distances: DistanceTies | None = None
    alike: tuple[Alike, ...] = ()  #: parts of the delivery that are one
    beside: tuple[Beside, ...] = ()  #: meshes, where drawings were delivered too
    drawings: int = 0  #: drawings with a known unit, to which anything could be tied
    broken: Because = Because.RAN  #: why the search broke off: ``LIMIT`` or ``CRASHED``
