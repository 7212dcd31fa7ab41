# SPDX-License-Identifier: MIT
"""What rules look at in a mesh: its faces and its vertices as columns, each with its number in the file.

Coordinates and lengths are in units of the file. Rows are in the order of the file: faces and vertices have no names.
"""

from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from foparq.columns import Flags, Geometries, Index, Reals
from foparq.model.inputs import Named

if TYPE_CHECKING:
    from foparq.mesh.topology import Topology


@dataclass(frozen=True, kw_only=True)
class Faces(Named):
    """Every face of the file, one a row, whether it can be used or not."""

    short: Flags  #: (n,) fewer than three corners
    absent: Index  #: (n,) corners at a vertex that the file does not have
    endless: Index  #: (n,) corners at a vertex with a coordinate that is no finite number
    place: Reals  #: (n, 3) of a face that cannot be used, one of its vertices that has a place; NaN if none has


@dataclass(frozen=True, kw_only=True)
class Surface(Named):
    """Faces that can be used, one a row: three corners and more, each at a place.

    Whether vertices with the same coordinates are one is decided before: a rule sees one surface.
    """

    points: Reals  #: (v, 3) of the file; never moved
    corners: Index  #: (m,) vertex of each corner
    starts: Index  #: (n + 1,) row i has the corners ``starts[i]:starts[i + 1]``
    closed: bool | None  #: whether it has no rim; ``None`` if nobody states it
    rims: int | None  #: how many rims it has; ``None`` if nobody states it
    metres: float  #: metres in one unit of the file; 1 where nobody knows it

    def take(self, rows: Index | Flags) -> Self:
        """The chosen faces, in that order."""
        from foparq.mesh.polygons import chosen  # noqa: PLC0415 - a drawing never loads the kernels of meshes

        kept: Index = np.arange(len(self))[rows]
        corners, starts = chosen(self.corners, self.starts, kept)
        named = {one.name: getattr(self, one.name)[kept] for one in fields(Named)}
        return replace(self, **named, corners=corners, starts=starts)

    def faces(self, rows: Index) -> Geometries:
        """Areas (k,) of chosen faces, in space."""
        from foparq.mesh.places import face_areas  # noqa: PLC0415 - as above

        return face_areas(self.points, self.corners, self.starts, rows)

    def outlines(self, rows: Index) -> Geometries:
        """Outlines (k,) of chosen faces."""
        from foparq.mesh.places import face_lines  # noqa: PLC0415 - as above

        return face_lines(self.points, self.corners, self.starts, rows)

    def edges(self, rows: Index) -> Geometries:
        """Segments (k,) of chosen edges."""
        from foparq.mesh.places import edge_lines  # noqa: PLC0415 - as above

        found = self.shape.edges
        return edge_lines(self.points, found.tail[rows], found.head[rows])

    def borders(self, rows: Index) -> Geometries:
        """Lines (k,) along chosen borders; loops come back to their first vertex."""
        from foparq.mesh.places import border_lines  # noqa: PLC0415 - as above

        return border_lines(self.points, self.shape.borders, rows)

    def segments(self, ends: Reals) -> Geometries:
        """Segments (k,) between two places each (k, 2, 3); a place where both are one."""
        from foparq.mesh.places import segments_or_points  # noqa: PLC0415 - as above

        return segments_or_points(ends)

    @cached_property
    def rim(self) -> Flags:
        """(k,) borders that are rims, stated or supposed.

        The widest ones, as many as are stated; else the widest of each piece.
        """
        if self.rims is not None or self.closed:
            return self.shape.widest_borders(0 if self.closed else self.rims or 0)
        return self.shape.rims

    @cached_property
    def doubtful_rim(self) -> Flags:
        """(k,) rims that nobody states: all, or all but the widest where a rim is stated and not how many."""
        if self.rims is not None or self.closed:
            return np.zeros(len(self.rim), dtype=bool)
        return self.rim & ~self.shape.widest_borders(int(self.closed is False))

    @cached_property
    def shape(self) -> "Topology":
        """What its faces have in common, computed once for all rules."""
        from foparq.mesh.topology import Topology  # noqa: PLC0415 - as above

        return Topology(self.points, self.corners, self.starts)


@dataclass(frozen=True, kw_only=True)
class Vertices(Named):
    """Vertices of the file, one a row."""

    points: Reals  #: (n, 3) of the file
    used: Flags  #: (n,) some face has a corner there
    same: Index = field(default_factory=lambda: np.empty(0, dtype=np.intp))  #: (n,) first row with the same coordinates
