# SPDX-License-Identifier: MIT
"""Kernels compiled before they are needed: the first time on a machine takes seconds, later ones are read from disk."""

from functools import cache

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.mesh.bvh import hierarchy
from foparq.mesh.compiled import is_kept
from foparq.mesh.distance import nearest
from foparq.mesh.intersections import intersections
from foparq.mesh.topology import Topology
from foparq.mesh.trianglepairs import meeting
from foparq.mesh.weld import welded
from foparq.mesh.winding import winding

#: two squares that cross, one that lies on the first, one that touches it: every way to meet
_SQUARES = (
    ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)),
    ((0.5, -1, -1), (0.5, 2, -1), (0.5, 2, 1), (0.5, -1, 1)),
    ((0.2, 0.2, 0), (3, 0.2, 0), (3, 3, 0), (0.2, 3, 0)),
    ((0, 0.3, 0), (0, 0.6, 0), (-1, 0.6, 1), (-1, 0.3, 1)),
)


def cold() -> bool:
    """Whether kernels were never compiled and kept on this machine, so that warming takes seconds."""
    return not is_kept(meeting)


@cache
def warm() -> None:
    """Compile, or load, what rules need; once in a process. Children that are forked have them too."""
    points, corners = _triangles()
    whole = Topology(points, welded(points)[corners.ravel()], np.arange(0, corners.size + 1, 3))
    for _ in (whole.fans, whole.turned, whole.duplicates, whole.rims):
        pass
    intersections(points, corners, keep=len(corners) ** 2)


@cache
def warm_nearest() -> None:
    """The same for the kernels of distances."""
    points, corners = _triangles()
    nearest(points, hierarchy(points, corners), points[:3])


@cache
def warm_winding() -> None:
    """The same for the kernels of winding numbers, of an open mesh."""
    points, corners = _triangles()
    winding(points, corners, points[:3] + 0.1)


def _triangles() -> tuple[Coordinates, Index]:
    points = np.array(_SQUARES, dtype=float).reshape(-1, 3)
    first = np.arange(0, len(points), 4)[:, np.newaxis]
    return points, np.concatenate([first + np.array([0, 1, 2]), first + np.array([0, 2, 3])])
