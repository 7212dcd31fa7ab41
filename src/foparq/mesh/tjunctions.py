# SPDX-License-Identifier: MIT
"""Vertices that lie on the border of another face, where that face has no vertex."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from foparq.columns import Coordinates, Index, Reals, union
from foparq.mesh.edges import Edges
from foparq.mesh.polygons import chosen, face_of
from foparq.mesh.vectors import dot, lengths, overflowing

#: pairs of a vertex and a piece of an edge that are looked at in one step
_PAIRS = 2**20
#: pieces of edges, for each edge, on the whole
_PIECES = 4
_LARGE = 10  #: a part of all edges, that makes a face large
_MANY = 10_000  #: edges, from which a face may be large


class TJunctions(NamedTuple):
    """Vertices inside of boundary edges, by vertex, then by edge."""

    vertex: Index  #: (k,)
    edge: Index  #: (k,) row of the edge table
    distance: Reals  #: (k,) metres, from the edge
    share: Reals  #: (k,) place along the edge, from tail to head


@overflowing
def t_junctions(
    points: Coordinates, corners: Index, starts: Index, edges: Edges, *, coincide: float, vertices: Index | None = None
) -> TJunctions:
    """Vertices strictly inside of a boundary edge.

    A vertex lies inside of an edge if it is not farther from it than ``coincide``, and farther than that from both of
    its ends. Vertices of the face that ends at the edge are not asked: a face thinner than ``coincide`` is a fault of
    another kind.

    Parameters
    ----------
    points : (n, 3) float, metres
    corners : (m,) int
        Of the welded surface: else every seam is full of them.
    starts : (f + 1,) int
    edges : Edges
    coincide : float, metres
    vertices : (q,) int, optional
        The vertices that are asked, each once; by default those of boundary edges, as both sides of a crack are border.

    Returns
    -------
    TJunctions

    Notes
    -----
    Edges are cut in pieces about as long as the middle one, four to an edge on the whole, so that a long edge asks for
    what is near to it only. O((b + q) log q + near pairs); memory is bounded by b and q.
    """
    rows = edges.boundary
    rows = rows[np.isfinite(lengths(points[edges.head[rows]] - points[edges.tail[rows]]))]
    tail, head = edges.tail[rows], edges.head[rows]
    asked = union(tail, head) if vertices is None else vertices
    empty = np.empty(0, dtype=np.intp)
    if not len(rows) or not len(asked):
        return TJunctions(empty, empty, np.empty(0), np.empty(0))
    face = face_of(starts)[edges.sides[edges.starts[rows]]]
    found = [(empty, empty, np.empty(0), np.empty(0))]
    for some, others in _apart(face, corners, starts, asked):
        found += [
            _inside(points, corners, starts, tail[i], head[i], others[j], face[i], rows[i], coincide)
            for i, j in ((some[near], j) for near, j in _near_pieces(points, tail[some], head[some], others, coincide))
        ]
    columns = [np.concatenate([part[k] for part in found]) for k in range(4)]
    order = np.lexsort((columns[1], columns[0]))
    vertex, edge = columns[0][order], columns[1][order]
    # A vertex may be near to two pieces of one edge.
    first = np.ones(len(order), dtype=bool)
    first[1:] = (vertex[1:] != vertex[:-1]) | (edge[1:] != edge[:-1])
    kept = order[first]
    return TJunctions(vertex[first], edge[first], columns[2][kept], columns[3][kept])


def _apart(face: Index, corners: Index, starts: Index, asked: Index) -> Iterator[tuple[Index, Index]]:
    """Places of edges in ``face``, and the vertices that are asked of them.

    A face with a tenth of all edges is asked by itself: its own vertices are near to all of them, and not meant.
    """
    large = np.flatnonzero(_LARGE * np.bincount(face) >= max(len(face), _MANY))
    for owner in large.tolist():
        others = asked[~np.isin(asked, corners[starts[owner] : starts[owner + 1]])]
        if len(others):
            yield np.flatnonzero(face == owner), others
    rest = np.flatnonzero(~np.isin(face, large))
    if len(rest):
        yield rest, asked


def _near_pieces(
    points: Coordinates, tail: Index, head: Index, asked: Index, coincide: float
) -> list[tuple[Index, Index]]:
    """Pairs (edge, place in ``asked``) that may be near, in chunks; a pair may come twice."""
    step = points[head] - points[tail]
    long = lengths(step)
    piece = max(float(np.median(long)), float(long.sum()) / (_PIECES * len(long)))
    count = np.maximum(np.ceil(long / piece if piece > 0 else np.ones_like(long)), 1).astype(np.intp)
    owner = np.repeat(np.arange(len(tail)), count)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    share = (place + 0.5) / count[owner]
    middle = points[tail[owner]] + step[owner] * share[:, None]
    # A little more than half a piece: the middle is rounded, and what is near is measured anew.
    rounded = np.maximum(np.abs(points[tail]), np.abs(points[head])).max(axis=1) * 1e-15
    radius = ((long / count / 2 + coincide) * (1 + 1e-9) + rounded)[owner]
    tree = cKDTree(points[asked])
    # Along the axes: squares of huge coordinates overflow. An end is near to its piece, and seldom anything else.
    gap, _ = tree.query(middle, k=[1, 2, 3], p=np.inf, distance_upper_bound=np.nextafter(radius.max(), np.inf))
    own = (np.isin(tail, asked)[owner] & (place == 0)).astype(np.intp)
    own += np.isin(head, asked)[owner] & (place == count[owner] - 1)
    crowd = np.flatnonzero(gap[np.arange(len(owner)), own] <= radius)
    middle, radius, owner = middle[crowd], radius[crowd], owner[crowd]
    near = tree.query_ball_point(middle, radius, p=np.inf, return_length=True)
    chunks: list[tuple[Index, Index]] = []
    chunk = np.cumsum(near) // _PAIRS
    for start, stop in zip(*_runs(chunk), strict=True):
        lists = tree.query_ball_point(middle[start:stop], radius[start:stop], p=np.inf)
        j = np.concatenate([np.asarray(row, dtype=np.intp) for row in lists])
        i = np.repeat(owner[start:stop], near[start:stop])
        other = (asked[j] != tail[i]) & (asked[j] != head[i])
        chunks.append((i[other], j[other]))
    return chunks


def _runs(value: Index) -> tuple[list[int], list[int]]:
    """Where runs of equal values begin and end."""
    begin = np.flatnonzero(np.diff(value, prepend=-1)).tolist()
    return begin, [*begin, len(value)][1:]


def _inside(
    points: Coordinates, corners: Index, starts: Index, tail: Index, head: Index, vertex: Index, face: Index,
    edge: Index, coincide: float,
) -> tuple[Index, Index, Reals, Reals]:  # fmt: skip
    """Which vertices lie inside of their edges: vertex, edge, distance, share."""
    step, arm = points[head] - points[tail], points[vertex] - points[tail]
    square = dot(step, step)
    share = dot(arm, step) / np.where(square > 0, square, 1.0)
    away = arm - step * np.clip(share, 0.0, 1.0)[:, None]
    distance = lengths(away)
    ends = np.minimum(dot(arm, arm), dot(arm - step, arm - step))
    near = np.flatnonzero((distance <= coincide) & (ends > coincide**2) & (square > 0))
    own, begin = chosen(corners, starts, face[near])
    same = np.zeros(len(near), dtype=bool)
    same[face_of(begin)[own == np.repeat(vertex[near], np.diff(begin))]] = True
    kept = near[~same]
    return vertex[kept], edge[kept], distance[kept], share[kept]
