# SPDX-License-Identifier: MIT
"""The surface that is shown of a mesh: triangles in a frame of its own, fewer where there are too many."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.model.mesh import Mesh
from foparq.report.page.meshes.clusters import clustered

STEPS = 65_535  #: steps of the longest side: what 16 bits hold
_CUT = 20_000  #: polygons up to which ears are cut; beyond, each is a fan from its first corner
_MOST = 200  #: corners of a polygon that is cut
_TRIANGLE = 3
_FAR = 5.0  #: times the extent of most vertices: farther away is astray
_LARGEST = 1e300  #: extents beyond would overflow


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """Triangles of one mesh. The frame begins at ``origin``; its unit is the longest side of the surface."""

    origin: Reals  #: (3,) units of the file
    size: float  #: longest side, units of the file
    steps: NDArray[np.uint16]  #: (v, 3) vertices, from the origin, in steps of ``size / STEPS``
    triangles: Index  #: (t, 3) rows of ``steps``
    cell: float  #: no vertex was moved farther along an axis, of ``size``; 0 where none was but by rounding to steps
    faces: int  #: usable faces of the mesh
    strays: int  #: faces that lie absurdly far from the rest: not shown
    thinned: bool  #: only some of the faces are shown, evenly chosen

    @property
    def vertices(self) -> Reals:
        """(v, 3) in the frame."""
        return self.steps / float(STEPS)

    @property
    def extent(self) -> Reals:
        """(3,) upper corner in the frame; the lower one is its origin."""
        upper: Reals = self.vertices.max(axis=0, initial=0.0)
        return upper

    def placed(self, points: Coordinates) -> Reals:
        """Points (n, 3) of the file in the frame; subtracted in double precision."""
        return (points - self.origin) / self.size


def shown_of(mesh: Mesh, most: int) -> Shown:
    """Surface that is shown of a mesh.

    Parameters
    ----------
    most : int
        Triangles. A mesh of no more is shown as it is, to a step; of others vertices are united by the cells of a grid,
        see :func:`clustered`.

    Returns
    -------
    Shown
        Without triangles where no face can be used, or the extent is beyond all sense.
    """
    faces, triangles = _triangles(mesh)
    used, triangles = _compact(triangles, len(mesh.points))
    points = mesh.points[used]
    near = _near(points)
    kept = near[triangles].all(axis=1)
    strays = len(np.unique(faces[~kept]))
    used, triangles = _compact(triangles[kept], len(points))
    points = points[used]
    low = points.min(axis=0) if len(points) else np.zeros(3)
    size = float((points.max(axis=0) - low).max()) if len(points) else 1.0
    if not np.isfinite(low).all() or not 0.0 < size < _LARGEST:
        points, triangles, low, size = points[:0], triangles[:0], np.zeros(3), 1.0
    placed = (points - low) / size
    cell, thinned = 0.0, False
    if len(triangles) > most:
        made = clustered(placed, triangles, most)
        placed, triangles, cell, thinned = made.points, made.triangles, made.cell, made.thinned
    steps, triangles = _stepped(placed, triangles)
    return Shown(
        origin=low, size=size, steps=steps, triangles=triangles, cell=cell, faces=int(np.count_nonzero(mesh.usable)),
        strays=strays, thinned=thinned,
    )  # fmt: skip


def _triangles(mesh: Mesh) -> tuple[Index, Index]:
    """Face (t,) and corners (t, 3) of the triangles of all usable faces."""
    rows = np.flatnonzero(mesh.usable)
    count = np.diff(mesh.starts)[rows]
    if not len(rows):
        return rows, np.empty((0, 3), dtype=np.intp)
    if bool((count == _TRIANGLE).all()):
        return rows, mesh.corners[mesh.starts[rows][:, np.newaxis] + np.arange(_TRIANGLE)]
    if np.count_nonzero(count > _TRIANGLE) <= _CUT:
        from foparq.mesh.polygons import chosen  # noqa: PLC0415 - a drawing never loads the kernels of meshes
        from foparq.mesh.triangulate import triangulate  # noqa: PLC0415 - as above

        cut = triangulate(mesh.points, *chosen(mesh.corners, mesh.starts, rows), most=_MOST)
        fans = _fans(mesh, rows[cut.left], count[cut.left])
        return np.concatenate([rows[cut.face], fans[0]]), np.concatenate([cut.triangles, fans[1]])
    return _fans(mesh, rows, count)


def _fans(mesh: Mesh, rows: Index, count: Index) -> tuple[Index, Index]:
    face = np.repeat(np.arange(len(rows)), count - 2)
    first = np.cumsum(count - 2) - (count - 2)
    turn = np.arange(len(face)) - first[face]
    corner = mesh.starts[rows][face]
    return rows[face], mesh.corners[np.stack([corner, corner + turn + 1, corner + turn + 2], axis=1)]


def _compact(triangles: Index, number: int) -> tuple[Index, Index]:
    """Vertices that triangles use, and the triangles in their numbering."""
    there = np.zeros(number, dtype=bool)
    there[triangles.ravel()] = True
    return np.flatnonzero(there), (np.cumsum(there) - 1)[triangles]


def _near(points: Coordinates) -> Flags:
    """Vertices that do not lie absurdly far from most: one of them would make the surface a dot."""
    if not len(points):
        return np.ones(0, dtype=bool)
    low, high = np.quantile(points, [0.01, 0.99], axis=0)
    reach = _FAR * max(float((high - low).max()), np.finfo(float).tiny)
    near: Flags = ((points >= low - reach) & (points <= high + reach)).all(axis=1)
    return near if near.any() else ~near


def _stepped(placed: Reals, triangles: Index) -> tuple[NDArray[np.uint16], Index]:
    """Vertices in whole steps, identical ones once, and the triangles that are left with three corners."""
    steps = np.rint(placed * STEPS).astype(np.int64)
    _, first, of = np.unique(
        (steps[:, 0] << 32) | (steps[:, 1] << 16) | steps[:, 2], return_index=True, return_inverse=True
    )
    triangles = of.ravel()[triangles]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    used, triangles = _compact(triangles, len(first))
    return steps[first[used]].astype(np.uint16), triangles
