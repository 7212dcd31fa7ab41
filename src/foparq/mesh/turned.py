# SPDX-License-Identifier: MIT
"""Patches of a surface that look to the wrong side."""

from typing import NamedTuple

import numpy as np

from foparq.columns import Coordinates, Flags, Index, Reals, union
from foparq.mesh.by_place import by_place, first_of_each
from foparq.mesh.components import Components
from foparq.mesh.edges import Edges
from foparq.mesh.grouping import joined
from foparq.mesh.orientation import Orientation, closed_components, signed_volumes
from foparq.mesh.polygons import blocks, face_of, following
from foparq.mesh.vectors import dot, overflowing

_CHUNK = 2**16  #: faces looked at in one step
_HALF = 0.5  #: a winding number is 1 within a closed surface and 0 outside


class Turned(NamedTuple):
    """Patches that look to the other side than they should."""

    first: Index  #: (k,) a face of each: the first by place
    size: Index  #: (k,) number of faces
    faces: Index  #: (m,) all of their faces, rising


def turned(
    points: Coordinates, corners: Index, starts: Index, edges: Edges, pieces: Components, found: Orientation,
    vectors: Reals,
) -> Turned:  # fmt: skip
    """Patches against their neighbours, and closed pieces that look inward.

    Parameters
    ----------
    points : (n, 3) float
    corners : (m,) int
    starts : (f + 1,) int
    edges : Edges
    pieces : Components
    found : Orientation
    vectors : (f, 3) float
        Area vectors. All of this surface.

    Returns
    -------
    Turned
        Faces of a sheet that cannot be oriented are told where two sides meet against
        each other: each of these edges by its first face, with two faces.

    Notes
    -----
    A closed piece, consistent in itself, that encloses a negative volume looks inward; one that lies within another
    closed piece is the wall of a cavity, and may. Whether it lies there is told by the winding number of the other
    around one of its vertices. O(m log m), and for each piece that looks inward O(m) of those that may hold it.
    """
    inward = np.flatnonzero(_inward(points, corners, starts, edges, pieces, vectors))
    wrong = found.flipped.copy()
    # A piece that looks inward where its smaller part does not: the larger part is what is wrong.
    whole = np.isin(pieces.label, inward)
    wrong[whole] = ~wrong[whole]
    faces = np.flatnonzero(wrong)
    label = _patches(starts, edges, wrong) if len(faces) else pieces.label
    _, size = np.unique(label[faces], return_counts=True)
    first = first_of_each(label, by_place(points, corners, starts, faces))
    seam = _seams(points, corners, starts, edges, found)
    return Turned(
        np.concatenate([first, seam]), np.concatenate([size, np.full(len(seam), 2)]).astype(np.intp),
        union(faces, seam),
    )  # fmt: skip


def _patches(starts: Index, edges: Edges, wrong: Flags) -> Index:
    """Label (f,) of faces joined over edges at which two wrong faces meet."""
    face = face_of(starts)
    at = edges.starts[edges.paired]
    one, two = face[edges.sides[at]], face[edges.sides[at + 1]]
    both = wrong[one] & wrong[two]
    return joined(len(starts) - 1, one[both], two[both])


def _seams(points: Coordinates, corners: Index, starts: Index, edges: Edges, found: Orientation) -> Index:
    """First face (k,) by place of every edge at which two sides of a sheet meet that cannot be oriented."""
    at = edges.starts[edges.inconsistent]
    face = face_of(starts)
    pair = np.stack([face[edges.sides[at]], face[edges.sides[at + 1]]], axis=1)
    pair = pair[~found.orientable[found.sheet[pair[:, 0]]]]
    rank = np.zeros(len(starts) - 1, dtype=np.intp)
    ordered = by_place(points, corners, starts, union(pair.ravel()))
    rank[ordered] = np.arange(len(ordered))
    seams: Index = np.where(rank[pair[:, 0]] <= rank[pair[:, 1]], pair[:, 0], pair[:, 1])
    return seams


def _inward(
    points: Coordinates, corners: Index, starts: Index, edges: Edges, pieces: Components, vectors: Reals
) -> Flags:
    """Pieces (k,) that are closed, consistent, look inward and lie within no other closed one."""
    count = len(pieces.faces)
    ends = closed_components(starts, edges, pieces.label, count=count)
    sound = ends.closed & ends.consistent
    inward = np.zeros(count, dtype=bool)
    # Only what may be below zero is computed with its bounds of error.
    if not (sound & ~(_volumes(points, corners, starts, pieces, vectors) > 0)).any():
        return inward
    volume = signed_volumes(points, corners, starts, pieces.label, count=count)
    inward = sound & (volume.volume < -volume.doubt)
    for piece in np.flatnonzero(inward).tolist():
        low, high = pieces.low[piece], pieces.high[piece]
        around = sound & (pieces.low < low).all(axis=1) & (pieces.high > high).all(axis=1)
        vertex = points[corners[starts[pieces.lowest[piece]]]]
        faces = np.flatnonzero(around[pieces.label])
        if len(faces) and _within(vertex, points, corners, starts, faces, pieces.label):
            inward[piece] = False
    return inward


@overflowing
def _volumes(points: Coordinates, corners: Index, starts: Index, pieces: Components, vectors: Reals) -> Reals:
    """(k,) three times the volumes of pieces, about a corner of each; rounded."""
    base = points[corners[starts[pieces.lowest]]]
    volume = np.zeros(len(base))
    for first in range(0, len(vectors), _CHUNK):
        label = pieces.label[first : first + _CHUNK]
        arm = points.take(corners[starts[first : first + len(label)]], axis=0) - base[label]
        volume += np.bincount(label, dot(arm, vectors[first : first + _CHUNK]), minlength=len(base))
    return volume


def _within(place: Reals, points: Coordinates, corners: Index, starts: Index, faces: Index, label: Index) -> bool:
    """Whether a place lies within an odd number of the closed pieces that some faces make."""
    inside: dict[int, float] = {}
    for first, stop in blocks(starts):
        mine = faces[(faces >= first) & (faces < stop)]
        if not len(mine):
            continue
        at = starts[first : stop + 1] - starts[first]
        spoke = points[corners[starts[first] : starts[stop]]] - place
        owner = face_of(at)
        base, to = spoke[at[:-1]][owner], spoke[following(at)]
        angle = np.add.reduceat(_solid_angles(base, spoke, to), at[:-1])
        for piece in np.unique(label[mine]).tolist():
            inside[piece] = inside.get(piece, 0.0) + float(angle[mine[label[mine] == piece] - first].sum())
    return sum(abs(angle) / (4 * np.pi) > _HALF for angle in inside.values()) % 2 == 1


def _solid_angles(a: Reals, b: Reals, c: Reals) -> Reals:
    """Signed solid angles (k,) of triangles as seen from the origin (van Oosterom and Strackee 1983)."""
    x, y, z = (np.sqrt(np.einsum("ij,ij->i", v, v)) for v in (a, b, c))
    top = np.einsum("ij,ij->i", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("ij,ij->i", v, w) for v, w in ((a, b), (b, c), (c, a)))
    angle: Reals = 2 * np.arctan2(top, x * y * z + ab * z + bc * x + ca * y)
    return angle
