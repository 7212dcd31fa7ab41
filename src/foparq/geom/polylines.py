# SPDX-License-Identifier: MIT
"""Polylines as coordinate columns, with the spatial index that every kernel shares.

Glossary: a *vertex* is a row of the coordinates, a *segment* joins two consecutive vertices of one line, a *line* is
a run of segments. Distances are planar unless a sentence says "in space"; depth is the third coordinate.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals
from foparq.geom.boxtree import BoxTree
from foparq.geom.ragged import running_sums
from foparq.geom.rounding import origin_of, slack_of

T = TypeVar("T")


class Segments(NamedTuple):
    """k straight segments: ends in the plane and their depth."""

    start: Reals  #: (k, 2)
    end: Reals  #: (k, 2)
    z0: Reals  #: (k,) depth at the start
    z1: Reals  #: (k,) depth at the end

    def take(self, rows: Index | Flags) -> "Segments":
        """The chosen segments, in that order."""
        return Segments(self.start[rows], self.end[rows], self.z0[rows], self.z1[rows])


def summed(label: Index, value: Reals, count: int) -> Reals:
    """Sums (count,) of values (k,) by label (k,)."""
    sums: Reals = np.bincount(label, weights=value, minlength=count).astype(np.float64)
    return sums


@dataclass(frozen=True, eq=False)
class Polylines:
    """n polylines with m vertices and s segments in all.

    Parameters
    ----------
    coordinates : (m, 2) or (m, 3) metres
        Vertices of all lines, one line after the other.
    offsets : (n + 1,) int
        Line i owns vertices ``offsets[i]:offsets[i + 1]``.
    """

    coordinates: Reals
    offsets: Index
    _kept: dict[tuple[Any, ...], Any] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, geometry: Geometries) -> "Polylines":
        """Polylines of shapely ``LineString`` geometries (n,)."""
        flat: Any = shapely.has_z(geometry)
        coordinates, index = shapely.get_coordinates(geometry, include_z=bool(np.any(flat)), return_index=True)
        offsets = np.searchsorted(index, np.arange(len(geometry) + 1))
        return cls(coordinates, offsets.astype(np.intp))

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def kept(self, key: tuple[Any, ...], make: Callable[[], T]) -> T:
        """What ``make`` gives, computed once a key: kernels share results that several rules ask for."""
        if key not in self._kept:
            self._kept[key] = make()
        value: T = self._kept[key]
        return value

    @cached_property
    def origin(self) -> Reals:
        """(2,) whole metres amidst the linework: computing near zero loses no digits at 7.4e6."""
        return origin_of(self.coordinates)

    @cached_property
    def plane(self) -> Reals:
        """(m, 2) vertices in the plane, from ``origin``."""
        return np.ascontiguousarray(self.coordinates[:, :2] - self.origin)

    @cached_property
    def depth(self) -> Reals:
        """(m,) depth; zero where the drawing has none."""
        if self.coordinates.shape[1] == 2:  # noqa: PLR2004 - two coordinates
            return np.zeros(len(self.coordinates))
        depth = self.coordinates[:, 2]
        return np.where(np.isfinite(depth), depth, 0.0)

    @cached_property
    def slack(self) -> float:
        """Metres by which a distance may be off because coordinates are rounded; added to every tolerance."""
        return slack_of(self.coordinates)

    @cached_property
    def first(self) -> Index:
        """(s,) vertex at which each segment starts; it ends at the next."""
        inner = np.ones(len(self.coordinates), dtype=bool)
        inner[self.offsets[1:][self.offsets[1:] > self.offsets[:-1]] - 1] = False
        return np.flatnonzero(inner)

    @cached_property
    def line(self) -> Index:
        """(s,) line of each segment."""
        return self.line_of_vertex[self.first]

    @cached_property
    def line_of_vertex(self) -> Index:
        """(m,) line of each vertex."""
        return np.repeat(np.arange(len(self)), np.diff(self.offsets))

    @cached_property
    def segment_offsets(self) -> Index:
        """(n + 1,) line i owns segments ``segment_offsets[i]:segment_offsets[i + 1]``."""
        return np.concatenate([[0], np.cumsum(np.maximum(np.diff(self.offsets) - 1, 0))]).astype(np.intp)

    @cached_property
    def way(self) -> Reals:
        """(s, 2) from the start to the end of each segment."""
        step: Reals = self.plane[self.first + 1] - self.plane[self.first]
        return step

    @cached_property
    def step(self) -> Reals:
        """(s,) planar length of each segment."""
        length: Reals = np.hypot(*self.way.T)
        return length

    @cached_property
    def step_in_space(self) -> Reals:
        """(s,) length of each segment in space."""
        length: Reals = np.hypot(self.step, self.depth[self.first + 1] - self.depth[self.first])
        return length

    @cached_property
    def along(self) -> Reals:
        """(m,) planar length from the first vertex of the line to each vertex."""
        step = np.zeros(len(self.coordinates))
        step[self.first + 1] = self.step
        return running_sums(step, self.offsets)

    @cached_property
    def heads(self) -> Index:
        """(n,) first vertex of each line; lines without vertices share a neighbour's."""
        return np.minimum(self.offsets[:-1], max(len(self.coordinates) - 1, 0))

    @cached_property
    def tails(self) -> Index:
        """(n,) last vertex of each line; lines without vertices share a neighbour's."""
        return np.maximum(self.offsets[1:] - 1, 0)

    @cached_property
    def length(self) -> Reals:
        """(n,) planar length of each line."""
        return summed(self.line, self.step, len(self))

    @cached_property
    def length_in_space(self) -> Reals:
        """(n,) length of each line in space."""
        return summed(self.line, self.step_in_space, len(self))

    @cached_property
    def opening(self) -> Reals:
        """(n,) distance in space between the two ends of each line; zero for a line without vertices."""
        if not len(self.coordinates):
            return np.zeros(len(self))
        planar = np.hypot(*(self.plane[self.tails] - self.plane[self.heads]).T)
        apart = np.hypot(planar, self.depth[self.tails] - self.depth[self.heads])
        return np.where(np.diff(self.offsets) > 0, apart, 0.0)

    def segments(self, rows: Index) -> Segments:
        """The chosen segments."""
        at = self.first[rows]
        return Segments(self.plane[at], self.plane[at + 1], self.depth[at], self.depth[at + 1])

    @cached_property
    def turn(self) -> Reals:
        """(2, 2) rotation to the prevailing direction of the linework, modulo a right angle.

        Boxes around segments are thin in this frame: a hatch drawn askew costs no more than an upright one.
        """
        step = self.way
        long = np.flatnonzero((self.step > 0) & (self.step < np.inf))
        if not len(long):
            return np.eye(2)
        # The fourth power folds the four directions of a right angle into one; weighted by length, up to a bound: one
        # line from here to the Moon says nothing of the others.
        size = self.step[long]
        unit = (step[long, 0] + 1j * step[long, 1]) / size
        angle = float(np.angle(np.sum(unit**4 * np.minimum(size, 100 * np.median(size))))) / 4
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, -s], [s, c]])

    @cached_property
    def tree(self) -> BoxTree:
        """Index over the boxes of all segments, in the frame of ``turn``."""
        turned = self.plane @ self.turn
        start, end = turned[self.first], turned[self.first + 1]
        return BoxTree(np.minimum(start, end), np.maximum(start, end))

    def points(self, plane: Reals) -> Geometries:
        """Shapely points (k,) of plane coordinates (k, 2) from ``origin``."""
        made: Geometries = shapely.points(plane + self.origin)
        return made

    def chords(self, start: Reals, end: Reals) -> Geometries:
        """Shapely lines (k,) of two vertices each, from plane coordinates (k, 2)."""
        made: Geometries = shapely.linestrings(np.stack([start, end], axis=1) + self.origin)
        return made
