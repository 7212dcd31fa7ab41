# SPDX-License-Identifier: MIT
"""How far clouds of reference are from the meshes that they show."""

from dataclasses import dataclass
from enum import StrEnum

from foparq.columns import Index, Reals

Place = tuple[float, float, float]
_LEVEL = 1.96  #: standard deviations: 95 % of what the survey alone does to a distance is less


class Signs(StrEnum):
    """Whether distances have a sign; each is an id in the ``report`` catalogue under ``clouds.signs.``."""

    CLOSED = "closed"  #: the surface is closed: the sign is exact
    NEARLY = "nearly"  #: it is open, and goes around nearly every place near it or does not
    OPEN = "open"  #: it is open, and has no inside that could be told: distances without sign


@dataclass(frozen=True, slots=True)
class Far:
    """A place of a reference far from the surface."""

    place: Place  #: metres
    distance: float  #: metres, with its sign where there is one
    mesh: str  #: path of the nearest mesh
    face: int  #: of the file, from 0


@dataclass(frozen=True, slots=True)
class Uncovered:
    """Points of a reference that no surface is near to."""

    n: int
    place: Place | None = None  #: of the largest cluster, the point that is farthest from the surface, metres
    largest: int = 0  #: points of that cluster


@dataclass(frozen=True, slots=True, kw_only=True)
class CloudDistances:
    """Distances of the n points of one reference from the nearest place of the meshes that it shows, metres.

    Negative where a point lies within the mesh, positive outside; without sign where ``signs`` is ``OPEN``.
    """

    path: str
    meshes: tuple[str, ...]  #: that it was held against
    near: tuple[str, ...]  #: of these, with three points and more nearest to them and within ``search``
    n: int
    signs: Signs
    mean: float
    median: float
    sd: float  #: around the mean; divisor n - 1; NaN of one point
    rms: float
    quantile: float  #: 95 % of the distances without sign are not larger
    largest: float  #: without sign
    limit: float | None  #: beyond which points are counted
    beyond: int  #: points farther than ``limit``
    search: float  #: beyond which a point is not covered
    uncovered: Uncovered
    survey_sd: float | None
    diagonal: float  #: of the largest mesh
    elsewhere: bool  #: half of the points and more are farther than a tenth of ``diagonal``
    repeats: bool  #: more than half of the points are vertices of the meshes
    worst: tuple[Far, ...]  #: worst first, each ``search`` and more from those before
    edges: Reals  #: (k + 1,) of the histogram
    counts: Index  #: (k,) points in each class; the outer ones have all beyond


def detectable(survey_sd: float | None) -> float | None:
    """Level of detection, metres: what is nearer may be the survey's own error. ``None`` where nobody knows that."""
    return None if survey_sd is None else _LEVEL * survey_sd
