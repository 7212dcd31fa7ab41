# SPDX-License-Identifier: MIT
"""Clouds of points in a folder, told by trying to read them."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foparq.errors import InputError
from foparq.profile.schema import LimitsSpec, Profile
from foparq.read.cloud.take import read_raw_cloud
from foparq.read.guard.parent import guarded
from foparq.read.guard.sniff import CloudFormat, cloud_format_of

_TEXTS = frozenset({".xyz", ".asc", ".pts"})  #: names that a text of points has
_TABLES = frozenset({".txt", ".csv"})
_MANY = 1000  #: points from which on a text that may be any table is a cloud


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundCloud:
    """A cloud that could be read."""

    path: str  #: relative to the folder
    points: int
    extent: tuple[float, float, float]  #: width in x, y and z, units of the file


def found_cloud(path: Path, name: str, profile: Profile) -> FoundCloud | None:
    """The cloud that a file is; ``None`` if it is none, or cannot be read.

    Parameters
    ----------
    name : str
        Relative to the folder.
    """
    try:
        kind, suffix = cloud_format_of(path), path.suffix.casefold()
        if kind is CloudFormat.TEXT and suffix not in _TEXTS | _TABLES:
            return None
        limits: LimitsSpec = profile.limits
        raw = guarded(read_raw_cloud, path, profile, file=name, seconds=limits.seconds, memory=limits.memory)
    except (InputError, OSError, RuntimeError):
        return None
    if kind is CloudFormat.TEXT and suffix in _TABLES and len(raw.points) < _MANY:
        return None
    x, y, z = np.ptp(raw.points, axis=0).tolist()
    return FoundCloud(path=name, points=len(raw.points), extent=(x, y, z))
