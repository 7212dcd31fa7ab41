# SPDX-License-Identifier: MIT
"""Meshes that are one mesh."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from foparq.columns import Reals
from foparq.findings.ties import Alike
from foparq.model.mesh import Mesh
from foparq.names import folded

_SAME = 1e-5  #: of the extent: coordinates in single precision, moved, are not known better
_FEWEST = 100  #: vertices: two simple solids may well be equal


def alike_meshes(meshes: Sequence[Mesh]) -> tuple[Alike, ...]:
    """Pairs of meshes whose vertices are the same, moved, turned or mirrored or not.

    Parameters
    ----------
    meshes : sequence of Mesh
        Those of one facade are left out, and those of fewer than a hundred vertices.

    Returns
    -------
    tuple of Alike
        In the order of the meshes. What was scanned twice never has the same vertices twice.

    Notes
    -----
    Vertices are the same if as many of them are as far from their middle, but for a hundred thousandth of the extent.
    O(v log v) a mesh.
    """
    known = [(mesh, _shape(mesh)) for mesh in meshes]
    return tuple(
        Alike(one.path, one.facade, other.path, other.facade, mirrored=False)
        for (one, here), (other, there) in combinations(known, 2)
        if here is not None and there is not None and here.shape == there.shape
        and not (one.facade and folded(one.facade) == folded(other.facade))
        and np.abs(here - there).max() <= _SAME * max(here.max(), there.max())
    )  # fmt: skip


def _shape(mesh: Mesh) -> Reals | None:
    """(v,) distances of the vertices from their middle, sorted; ``None`` of a mesh that is too simple to know again."""
    used = np.zeros(len(mesh.points), dtype=bool)
    used[mesh.corners[mesh.there]] = True
    points = np.unique(mesh.points[used & mesh.finite], axis=0)
    if len(points) < _FEWEST:
        return None
    points = (points - points[0]) * (mesh.unit.metres or 1.0)
    far: Reals = np.sort(np.linalg.norm(points - points.mean(axis=0), axis=1))
    return far
