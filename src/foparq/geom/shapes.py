# SPDX-License-Identifier: MIT
"""One line by itself: its length, its vertices, its ends."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Index, Reals
from foparq.geom.polylines import Polylines


class RepeatedVertices(NamedTuple):
    """Consecutive vertices at one place, k rows in order of lines and vertices."""

    line: Index  #: (k,)
    vertex: Index  #: (k,) the first of the two, row of the coordinates
    distance: Reals  #: (k,) metres, in space
    place: Reals  #: (k, 2) halfway, from the origin of the lines


class OpenRings(NamedTuple):
    """Lines that nearly come back to their start, k rows in order of lines."""

    line: Index  #: (k,)
    gap: Reals  #: (k,) metres, in space
    start: Reals  #: (k, 2) first vertex, from the origin of the lines
    end: Reals  #: (k, 2) last vertex


def point_like(lines: Polylines, *, coincide: float) -> Index:
    """Lines (k,) that are not longer than ``coincide`` in space, all their segments together."""
    return np.flatnonzero(lines.length_in_space <= coincide + lines.slack)


def repeated_vertices(lines: Polylines, *, coincide: float) -> RepeatedVertices:
    """Consecutive vertices not farther apart than ``coincide`` in space.

    Every vertex is compared with the next as delivered: a run of k + 1 vertices at one place gives k rows. The first
    and the last vertex of a ring are not consecutive.
    """
    segment = np.flatnonzero(lines.step_in_space <= coincide + lines.slack)
    vertex = lines.first[segment]
    halfway = (lines.plane[vertex] + lines.plane[vertex + 1]) / 2
    return RepeatedVertices(lines.line[segment], vertex, lines.step_in_space[segment], halfway)


def open_rings(lines: Polylines, *, coincide: float, reach: float) -> OpenRings:
    """Lines of at least four vertices whose ends are apart by more than ``coincide`` and at most ``reach`` in space.

    Does not tell a ring left open from a short line that bends: both have ends near each other.
    """
    nearly = (lines.opening > coincide + lines.slack) & (lines.opening <= reach + lines.slack)
    row = np.flatnonzero(nearly & (np.diff(lines.offsets) >= 4))  # noqa: PLR2004 - a triangle and its closing vertex
    return OpenRings(row, lines.opening[row], lines.plane[lines.heads[row]], lines.plane[lines.tails[row]])
