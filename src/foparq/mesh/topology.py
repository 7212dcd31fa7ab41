# SPDX-License-Identifier: MIT
"""What the faces of a surface have in common, each thing computed when it is first asked for."""

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals, union
from foparq.mesh.borders import Borders, borders
from foparq.mesh.by_place import by_place, first_of_each
from foparq.mesh.collinear import collinear_faces
from foparq.mesh.components import Components, components
from foparq.mesh.duplicates import Duplicates, duplicate_faces
from foparq.mesh.edges import Edges, edges
from foparq.mesh.fans import fans
from foparq.mesh.grouping import joined
from foparq.mesh.holes import BorderSizes, border_sizes, fill_areas
from foparq.mesh.orientation import Orientation, orientation
from foparq.mesh.polygons import chosen, face_of, following, members
from foparq.mesh.shape import Sizes, flatness, sizes, triangle_shapes
from foparq.mesh.spikes import cones, edge_lengths, spikes
from foparq.mesh.tjunctions import TJunctions, t_junctions
from foparq.mesh.triangulate import Triangulation, triangulate
from foparq.mesh.turned import Turned, turned
from foparq.mesh.vectors import lengths, overflowing
from foparq.mesh.widths import by_width

if TYPE_CHECKING:
    from foparq.mesh.crossing_groups import Groups, Overlaps
    from foparq.mesh.intersections import Intersections

_MOST_CORNERS = 5_000  #: of a polygon that is cut into triangles: that takes a step for each corner and each ear
_TRIANGLE = 3
_ROUNDING = 1e-14  #: of the span of a face, that its area may be off for each corner
_KEPT = 2_000_000  #: pairs of faces that intersect; beyond, nothing is told of any


class Topology:
    """A surface of n vertices and f polygons of m corners.

    Parameters
    ----------
    points : (n, 3) float
        In one unit; lengths and areas are in the same.
    corners : (m,) int
        Vertex of every corner; each exists and has a place.
    starts : (f + 1,) int
        Face i has the corners ``corners[starts[i]:starts[i + 1]]``, three and more.

    Examples
    --------
    >>> surface = Topology(np.eye(4, 3), np.array([0, 1, 2, 2, 1, 3]), np.array([0, 3, 6]))
    >>> len(surface.edges.boundary), surface.components.faces.tolist()
    (4, [2])
    """

    def __init__(self, points: Coordinates, corners: Index, starts: Index) -> None:
        self.points = points
        self.corners = corners
        self.starts = starts

    @cached_property
    def edges(self) -> Edges:
        """Edges, with the sides of faces along them."""
        return edges(self.corners, self.starts)

    @cached_property
    def sizes(self) -> Sizes:
        """Area vectors of the faces, and their spans."""
        return sizes(self.points, self.corners, self.starts)

    @cached_property
    def areas(self) -> Reals:
        """(f,) areas."""
        return lengths(self.sizes.vectors)

    @overflowing
    def thin(self, share: float) -> Index:
        """Faces (k,) whose area is not greater than a share of their span, whatever rounding does."""
        large = self.areas > (share + _ROUNDING * np.diff(self.starts)) * self.sizes.span
        return np.flatnonzero(~large)

    @cached_property
    def fans(self) -> Index:
        """(n,) fans of faces around each vertex."""
        return fans(self.corners, self.starts, self.edges, count=len(self.points))

    @cached_property
    def components(self) -> Components:
        """Pieces of faces joined over edges."""
        return components(self.points, self.corners, self.starts, self.edges, self.areas)

    @cached_property
    def duplicates(self) -> Duplicates:
        """Faces that repeat an earlier one."""
        return duplicate_faces(self.corners, self.starts)

    @cached_property
    def borders(self) -> Borders:
        """Boundary edges as loops and chains."""
        return borders(self.points, self.corners, self.starts, self.edges)

    @cached_property
    def border_sizes(self) -> BorderSizes:
        """Lengths and areas of the borders."""
        return border_sizes(self.points, self.borders)

    @cached_property
    def fills(self) -> Reals:
        """(k,) areas of what would close the borders."""
        return fill_areas(self.points, self.borders, self.border_sizes)

    @cached_property
    def border_faces(self) -> Index:
        """(b,) face along every edge of the borders."""
        return self.boundary_faces(self.borders.edges)

    @cached_property
    def rims(self) -> Flags:
        """(k,) borders that are the widest of their piece.

        Pieces that touch along one border count as one there.
        """
        found, label = self.borders, self.components.label
        edge = label[self.border_faces]
        start = label[self.border_faces[found.starts[:-1]]]
        together = joined(len(self.components.faces), np.repeat(start, np.diff(found.starts)), edge)
        piece = together[start]
        rims = np.zeros(len(piece), dtype=bool)
        order = self._by_width
        order = order[np.argsort(piece[order], kind="stable")]
        rims[order[np.diff(piece[order], prepend=-1) > 0]] = True
        return rims

    def widest_borders(self, count: int) -> Flags:
        """(k,) the widest borders."""
        widest = np.zeros(len(self._by_width), dtype=bool)
        widest[self._by_width[:count]] = True
        return widest

    @cached_property
    def _by_width(self) -> Index:
        """(k,) borders, wider ones first."""
        return by_width(self.points, self.borders, self.border_sizes)

    @cached_property
    def orientation(self) -> Orientation:
        """Faces that look to another side than most of their sheet."""
        return orientation(self.starts, self.edges)

    @cached_property
    def turned(self) -> Turned:
        """Patches against their neighbours, and closed pieces that look inward."""
        return turned(
            self.points, self.corners, self.starts, self.edges, self.components, self.orientation, self.sizes.vectors
        )

    @cached_property
    def triangulation(self) -> Triangulation:
        """Faces as triangles."""
        return triangulate(self.points, self.corners, self.starts, most=_MOST_CORNERS)

    @cached_property
    def degenerate(self) -> Index:
        """Faces (k,) all of whose corners lie on one line, exactly; or with two corners in a row at one place."""
        asked = self.thin(0.0)  # two corners of a triangle at one place make a line
        line = asked[collinear_faces(self.points, *chosen(self.corners, self.starts, asked))]
        polygons = np.flatnonzero(np.diff(self.starts) > _TRIANGLE)
        corners, starts = chosen(self.corners, self.starts, polygons)
        here = self.points[corners]
        twice = face_of(starts)[(here == here[following(starts)]).all(axis=1)]
        return union(line, polygons[twice])

    @cached_property
    def crossing_groups(self) -> "Groups":
        """Faces that cross or touch where they share nothing, in groups."""
        from foparq.mesh.crossing_groups import crossing_groups  # noqa: PLC0415 - as above

        return crossing_groups(self.intersections, self.triangulation.face, self.triangulation.triangles)

    @cached_property
    def overlaps(self) -> "Overlaps":
        """Faces that lie on each other in one plane."""
        from foparq.mesh.crossing_groups import overlaps  # noqa: PLC0415 - as above

        rank = np.zeros(len(self.starts) - 1, dtype=np.intp)
        found = self.intersections
        involved = union(self.triangulation.face[found.first], self.triangulation.face[found.second])
        rank[by_place(self.points, self.corners, self.starts, involved)] = np.arange(len(involved))
        return overlaps(found, self.triangulation.face, self.areas, rank)

    @cached_property
    def intersections(self) -> "Intersections":
        """Pairs of triangles that intersect."""
        from foparq.mesh.intersections import intersections  # noqa: PLC0415 - as above

        found = intersections(self.points, self.triangulation.triangles, keep=_KEPT)
        if found.total > len(found.first):
            raise MemoryError  # more pairs than can be told: the rule ends at its bound, and says so
        return found

    @cached_property
    def face(self) -> Index:
        """(m,) face of every corner."""
        return face_of(self.starts)

    def t_junctions(self, coincide: float) -> TJunctions:
        """Vertices inside of boundary edges; ``coincide`` is in the unit of the points."""
        return t_junctions(self.points, self.corners, self.starts, self.edges, coincide=coincide)

    def unevenness(self) -> Reals:
        """(f,) greatest distance of a corner of each face from the plane that fits it best."""
        return flatness(self.points, self.corners, self.starts).distance

    def slivers(self, needle: float, cap: float) -> tuple[Index, Reals]:
        """Triangles (k,) with an area that are needles or caps, and their heights (k,) above their longest sides.

        Parameters
        ----------
        needle : float
            Part of the longest side that the shortest one of a needle does not reach.
        cap : float
            Cosine that an angle of a cap does not reach.
        """
        # By the sine of the angle at the shortest side, or of the greatest angle.
        rows = self.thin(max(needle / 2, np.sqrt(1 - min(cap, 0.0) ** 2) / 4))
        rows = rows[np.diff(self.starts)[rows] == _TRIANGLE]
        triangles = self.corners[self.starts[rows, None] + np.arange(_TRIANGLE)]
        found = triangle_shapes(self.points, triangles)
        thin = (found.shortest < needle * found.longest) | (found.cosine < cap)
        thin[np.isin(rows, self.degenerate)] = False
        return rows[thin], 2 * self.areas[rows[thin]] / found.longest[thin]

    def spikes(self, opening: float, rise: float) -> tuple[Index, Reals]:
        """Vertices (k,) whose cone is narrow and ``rise`` median edges high, and their heights (k,)."""
        length = edge_lengths(self.points, self.edges)
        height = rise * (float(np.median(length)) if len(length) else 0.0)
        # No edge of a spike is shorter than it is high.
        short = np.flatnonzero(length < height)
        asked = np.ones(len(self.points), dtype=bool)
        asked[self.edges.tail[short]] = asked[self.edges.head[short]] = False
        found = cones(self.points, self.edges, asked)
        vertex = spikes(found, opening=opening, height=height)
        return vertex, found.height[vertex]

    def boundary_faces(self, edge: Index) -> Index:
        """The face (k,) along each of some boundary edges."""
        faces: Index = self.face[self.edges.sides[self.edges.starts[edge]]]
        return faces

    def faces_at(self, edge: Index) -> tuple[Index, Index]:
        """First two faces (k,) along edges that have two sides and more."""
        at = self.edges.starts[edge]
        return self.face[self.edges.sides[at]], self.face[self.edges.sides[at + 1]]

    def all_faces_at(self, edge: Index) -> Index:
        """Every face (m,) along some edges."""
        _, member = members(self.edges.starts, edge)
        faces: Index = self.face[self.edges.sides[member]]
        return faces

    def faces_along(self, border: Index) -> tuple[Index, Index]:
        """First face (k,) of each of some borders, and all of their faces (m,)."""
        _, member = members(self.borders.starts, border)
        return self.border_faces[self.borders.starts[border]], self.border_faces[member]

    def edge_lengths(self, edge: Index) -> Reals:
        """Lengths (k,) of edges."""
        return lengths(self.points[self.edges.head[edge]] - self.points[self.edges.tail[edge]])

    def longest_sides(self, faces: Index) -> Reals:
        """Lengths (k,) of the longest sides of chosen faces."""
        some, begin = chosen(self.corners, self.starts, faces)
        step = lengths(self.points[some[following(begin)]] - self.points[some])
        return np.maximum.reduceat(step, begin[:-1]) if len(faces) else np.zeros(0)

    def first_by_place(self, label: Index, faces: Index) -> Index:
        """The first face (k,) by place of every group of faces, in the order of the labels.

        Parameters
        ----------
        label : (f,) int
            Group of every face.
        faces : (c,) int
            Those of the groups that are asked for.
        """
        return first_of_each(label, by_place(self.points, self.corners, self.starts, faces))

    def faces_around(self, vertex: Index) -> Index:
        """Every face (m,) at some vertices."""
        asked = np.zeros(len(self.points), dtype=bool)
        asked[vertex] = True
        return union(self.face[asked[self.corners]])

    def first_faces(self, vertex: Index) -> Index:
        """First face (k,) at each of some vertices that faces use."""
        first = np.full(len(self.points), -1, dtype=np.intp)
        first[self.corners[::-1]] = self.face[::-1]  # the first of them is written last
        return first[vertex]
