# SPDX-License-Identifier: MIT
"""Clouds of points that show what a mesh should be: references, never audited themselves."""

from dataclasses import dataclass

from foparq.columns import Coordinates
from foparq.model.drawing import DrawingUnit


@dataclass(frozen=True, slots=True, kw_only=True)
class RawCloud:
    """The points of one file."""

    points: Coordinates  #: (n, 3) as written, all finite; values of single precision are widened exactly
    #: points of the file of which a coordinate is no number, or beyond any object: counted, not among ``points``
    empty: int
    version: str  #: ``"PLY binary_little_endian 1.0"``, ``"text"``, ``"LAS 1.2"``


@dataclass(frozen=True, slots=True, kw_only=True)
class Cloud:
    """One reference, with what the manifest says of it."""

    path: str  #: relative to the delivery, with ``/``
    points: Coordinates  #: (n, 3) in units of the file
    empty: int  #: points without coordinates, which are left out
    unit: DrawingUnit
    survey_sd: float | None  #: how well its points are known: standard deviation, metres; ``None`` if not stated
    mesh: str = ""  #: path of the mesh that it shows; ``""``: every mesh of the delivery together
