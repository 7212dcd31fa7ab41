# SPDX-License-Identifier: MIT
"""Single vertices that rise out of a surface like needles."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.mesh.edges import Edges
from foparq.mesh.vectors import dot, lengths, overflowing

#: edges looked at in one step
_CHUNK = 2**16


class Cones(NamedTuple):
    """The cone of edges at every vertex."""

    opening: Reals  #: (n,) radians
    height: Reals  #: (n,) metres
    inner: Flags  #: (n,) True for a vertex of some face that no boundary edge ends at; else both numbers are NaN


@overflowing
def cones(points: Coordinates, edges: Edges, asked: Flags | None = None) -> Cones:
    """Opening and height of the cone of edges at vertices.

    The axis of the cone is the mean direction of the edges of the vertex. ``opening`` is twice the greatest angle
    between an edge and the axis: 180 degrees or more on a plane, 109.5 degrees at the corner of a cube, a few degrees
    at the tip of a needle. ``height`` is how far the tip rises above its lowest neighbour, along the axis: the least
    length of an edge along it.

    Parameters
    ----------
    points : (n, 3) float, metres
    edges : Edges
    asked : (n,) bool, optional
        Vertices that are asked for; all if left out.

    Returns
    -------
    Cones
        Of vertices that are not asked for nothing is told, as of those at a boundary.

    Notes
    -----
    Where edges lie in a plane all around, the axis vanishes or is what rounding leaves of it: the opening is 180
    degrees at least. O(edges).
    """
    count = len(points)
    asked = np.ones(count, dtype=bool) if asked is None else asked
    rows = np.flatnonzero(asked[edges.tail] | asked[edges.head])
    ends = edges.tail[rows], edges.head[rows]
    axis = np.zeros((count, 3))
    for tail, head, unit, _ in _steps(points, *ends):
        for k in range(3):
            np.add.at(axis[:, k], tail, unit[:, k])
            np.subtract.at(axis[:, k], head, unit[:, k])
    size = lengths(axis)
    axis /= np.where(size > 0, size, 1.0)[:, None]
    least, rise = np.full(count, np.inf), np.full(count, np.inf)
    for tail, head, unit, long in _steps(points, *ends):
        for end, cosine in ((tail, dot(unit, axis[tail])), (head, -dot(unit, axis[head]))):
            np.minimum.at(least, end, cosine)
            np.minimum.at(rise, end, cosine * long)
    inner = np.isfinite(least) & asked
    rows = edges.boundary
    inner[edges.tail[rows]] = inner[edges.head[rows]] = False
    opening = np.where(inner, 2 * np.arccos(np.clip(least, -1.0, 1.0)), np.nan)
    return Cones(opening, np.where(inner, rise, np.nan), inner)


def _steps(points: Coordinates, tails: Index, heads: Index) -> Iterator[tuple[Index, Index, Reals, Reals]]:
    """Edges in chunks: tail, head, direction and length."""
    for first in range(0, len(tails), _CHUNK):
        tail, head = tails[first : first + _CHUNK], heads[first : first + _CHUNK]
        step = points[head] - points[tail]
        long = lengths(step)
        step /= np.where(long > 0, long, 1.0)[:, None]
        yield tail, head, step, long


def spikes(found: Cones, *, opening: float, height: float) -> Index:
    """Vertices whose cone is narrow and high.

    Parameters
    ----------
    found : Cones
    opening : float, radians
        Greatest opening of a spike.
    height : float, metres
        Least height of a spike, as a rule a multiple of the median edge, see :func:`edge_lengths`: a slender spire that
        is as coarse as the rest of its building is none.

    Returns
    -------
    (k,) int
        Rising.

    Notes
    -----
    A spike of several vertices has one tip; a needle that is finely divided up to its tip is not found.
    """
    return np.flatnonzero(found.inner & (found.opening <= opening) & (found.height >= height))


@overflowing
def edge_lengths(points: Coordinates, edges: Edges) -> Reals:
    """Lengths (e,) of edges."""
    length = np.empty(len(edges.tail))
    for first in range(0, len(length), _CHUNK):
        part = slice(first, first + _CHUNK)
        length[part] = lengths(points.take(edges.head[part], axis=0) - points.take(edges.tail[part], axis=0))
    return length
