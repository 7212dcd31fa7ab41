# SPDX-License-Identifier: MIT
"""The surface of one mesh, where places are looked for: its nearest place, face and vertex."""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Index, Reals
from foparq.mesh.bvh import Hierarchy, hierarchy
from foparq.mesh.components import Components
from foparq.mesh.distance import nearest
from foparq.mesh.polygons import chosen
from foparq.mesh.predicates import safe
from foparq.mesh.topology import Topology
from foparq.mesh.weld import welded
from foparq.model.mesh import Mesh

_NOWHERE = -1
_FARTHEST = 1e12  #: metres from the origin: no object lies there


class Foot(NamedTuple):
    """Nearest places of a surface to n places; metres."""

    distance: Reals  #: (n,) NaN where the place has no coordinates
    face: Index  #: (n,) of the file; -1 where there is no distance
    place: Coordinates  #: (n, 3)
    normal: Coordinates  #: (n, 3) of the triangle, of length one; NaN where it has none
    vertex: Reals  #: (n,) from the place asked to the nearest vertex of that triangle

    def hidden(self, places: Coordinates, printed: Reals) -> Reals:
        """How much of the distances (n,) of places (n, 3) their printed digits may make, metres.

        Parameters
        ----------
        printed : (3,) metres
            Half the last printed digit of each axis: a place may be anywhere in a box of these half sides, and lies on
            the plane through its nearest place if the box reaches it.
        """
        way = np.abs(np.nan_to_num(self.place - places))
        return np.divide(way @ printed, self.distance, out=np.zeros(len(way)), where=way.any(axis=1))


class Skin:
    """Faces of a mesh that can be used, as triangles in metres.

    Parameters
    ----------
    mesh : Mesh
        Its unit is known. Polygons that cannot be cut into triangles are left out, and faces beyond any object.

    Notes
    -----
    Vertices with identical coordinates are one, whatever the profile says: a piece of the texture is no piece of the
    object. Where the surface lies is the same.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self.points = mesh.points * (mesh.unit.metres or 1.0)
        good = mesh.usable.copy()
        unsafe = ~safe(self.points) | (np.abs(self.points) > _FARTHEST).any(axis=1)
        if unsafe.any():
            corner = np.zeros(len(mesh.corners), dtype=bool)
            corner[mesh.there] = unsafe[mesh.corners[mesh.there]]
            good[np.repeat(np.arange(mesh.features), np.diff(mesh.starts))[corner]] = False
        self.rows = np.flatnonzero(good)  #: (k,) faces of the file that it is made of
        corners, starts = chosen(mesh.corners, mesh.starts, self.rows)
        self.shape = Topology(self.points, welded(self.points)[corners], starts)

    def __len__(self) -> int:
        return len(self.shape.triangulation.triangles)

    @cached_property
    def _tree(self) -> Hierarchy:
        return hierarchy(self.points, self.shape.triangulation.triangles)

    @cached_property
    def pieces(self) -> Components:
        """Pieces of it that share no edge."""
        return self.shape.components

    def foot(self, places: Coordinates) -> Foot:
        """Nearest places of the surface to places (n, 3), metres; there must be a triangle."""
        found = nearest(self.points, self._tree, places)
        corners = self.points[self.shape.triangulation.triangles[found.row]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        unit = np.divide(normal, length, out=np.full_like(normal, np.nan), where=length > 0)
        vertex = np.linalg.norm(corners - places[:, np.newaxis], axis=2).min(axis=1)
        lost = found.row < 0
        face = self.rows[self.shape.triangulation.face[found.row]]
        return Foot(
            found.distance, np.where(lost, _NOWHERE, face), found.place,
            np.where(lost[:, np.newaxis], np.nan, unit), np.where(lost, np.inf, vertex),
        )  # fmt: skip

    def piece_of(self, face: Index) -> Index:
        """(n,) piece of faces of the file, all of which are among :attr:`rows`."""
        piece: Index = self.pieces.label[np.searchsorted(self.rows, face)]
        return piece
