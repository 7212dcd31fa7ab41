# SPDX-License-Identifier: MIT
"""What every reader of clouds does alike."""

import numpy as np

from foparq.columns import Coordinates
from foparq.errors import UnreadableError, UnsafeError
from foparq.model.cloud import RawCloud
from foparq.profile.schema import LimitsSpec

_FARTHEST = 1e12  #: units from the origin: no object lies there, whatever the unit


def hold_points(file: str, count: int, limits: LimitsSpec) -> None:
    """Refuse more points than the limits allow.

    Raises
    ------
    UnsafeError
    """
    if count > limits.points:
        raise UnsafeError("cloud.too-many-points", file=file, value=count, limit=limits.points)


def cloud_of(file: str, points: Coordinates, version: str) -> RawCloud:
    """The cloud, if it has a point at all; points without coordinates, or beyond any object, are counted and left out.

    Raises
    ------
    UnreadableError
        If no point has coordinates.
    """
    good = (np.abs(points) <= _FARTHEST).all(axis=1)
    empty = int(len(points) - np.count_nonzero(good))
    if empty == len(points):
        raise UnreadableError("cloud.no-points", file=file, value=empty)
    return RawCloud(points=points[good] if empty else points, empty=empty, version=version)
