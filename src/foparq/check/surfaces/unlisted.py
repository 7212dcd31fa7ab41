# SPDX-License-Identifier: MIT
"""Surface of a mesh of which a list of places says nothing."""

import numpy as np

from foparq.check.surfaces.clusters import clusters
from foparq.check.surfaces.skin import Skin
from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.findings.counts import Unlisted
from foparq.mesh.grouping import joined
from foparq.mesh.polygons import chosen
from foparq.mesh.topology import Topology
from foparq.mesh.vectors import lengths

_MOST = 20_000_000  #: triangles that large faces may be cut into
_NEIGHBOURS = 8
_FAR = 2.0  #: times the spacing: what is farther is no border of what the list covers
_PER_SQUARE = 8  #: about so many are cut for each square of the spacing


def unlisted(skin: Skin, places: Coordinates, more: Reals, *, spacing: float) -> Unlisted:
    """Pieces of a surface that no place of a list explains.

    Parameters
    ----------
    skin : Skin
    places : (n, 3) metres
        One at least.
    more : (n,) metres
        How far the surface is from each, where nothing is there; else 0. A place explains what is no farther than
        ``spacing`` and this: what lies in place of a feature that is missing is no other feature.
    spacing : float, metres
        How far from a listed place the surface may be.

    Returns
    -------
    Unlisted
        Faces are cut until no side is longer than ``spacing``, and judged by the middles of their parts. Pieces whose
        unexplained area is less than the square of ``spacing`` are left out. Pieces that are farther than twice
        ``spacing`` from every place, and near each other, count as one.

    Notes
    -----
    O(t log n) for t parts of faces.
    """
    parts, owner = _cut(skin, spacing)
    if parts is None:
        return Unlisted(path=skin.mesh.path, pieces=0, area=0.0, whole=0.0, where=None, looked=False)
    size = lengths(np.cross(parts[:, 1] - parts[:, 0], parts[:, 2] - parts[:, 0])) / 2
    apart = _beyond(parts.mean(axis=1), places, more)
    strange: Flags = apart > spacing
    area = np.bincount(owner[strange], weights=size[strange], minlength=len(skin.rows))
    faces = np.flatnonzero(area > 0)
    piece = _pieces(skin, faces)
    far = strange & (apart > _FAR * spacing) & (area[owner] > 0)
    piece = _as_one(piece, faces, parts[far].mean(axis=1), owner[far], spacing)
    of_piece = np.bincount(piece, weights=area[faces])
    kept = of_piece >= spacing**2
    where = None
    if kept.any():
        # The middle of the part of the largest piece that is farthest from all places.
        largest = faces[piece == np.argmax(np.where(kept, of_piece, 0.0))]
        mine = np.flatnonzero(strange & np.isin(owner, largest))
        where = tuple(parts[mine[np.argmax(apart[mine])]].mean(axis=0).tolist())
    return Unlisted(
        path=skin.mesh.path, pieces=int(kept.sum()), area=float(of_piece[kept].sum()), whole=float(size.sum()),
        where=where,
    )  # fmt: skip


def _beyond(spots: Coordinates, places: Coordinates, more: Reals) -> Reals:
    """(m,) how far spots are from places, less what each explains beyond."""
    from scipy.spatial import cKDTree  # noqa: PLC0415 - slow to load; only lists with a spacing need it

    apart: Reals = cKDTree(places).query(spots)[0]
    # Few places are away from the surface; the nearest of them explains most, or one of its neighbours.
    away = np.flatnonzero(more > 0)
    if len(away):
        near, row = cKDTree(places[away]).query(spots, k=min(_NEIGHBOURS, len(away)))
        less = near - more[away][row]
        apart = np.minimum(apart, less if less.ndim == 1 else less.min(axis=1))
    return apart


def _cut(skin: Skin, longest: float) -> tuple[Coordinates | None, Index]:
    """Triangles (t, 3, 3) with no side longer than asked, and the face of each; none if they would be too many."""
    parts, owner = skin.points[skin.shape.triangulation.triangles], skin.shape.triangulation.face
    if not skin.shape.areas.sum() / longest**2 < _MOST / _PER_SQUARE:
        return None, owner
    done, of = [], []
    while len(parts):
        sides = np.linalg.norm(np.roll(parts, -1, axis=1) - parts, axis=2)
        long = sides.max(axis=1) > longest
        done.append(parts[~long])
        of.append(owner[~long])
        if sum(map(len, done)) + 2 * np.count_nonzero(long) > _MOST:
            return None, owner
        parts, owner = _halves(parts[long], sides[long]), np.tile(owner[long], 2)
    return np.concatenate(done), np.concatenate(of)


def _halves(parts: Coordinates, sides: Reals) -> Coordinates:
    """Triangles (2 k, 3, 3): each of k cut at the middle of its longest side."""
    first = np.argmax(sides, axis=1)
    rows = np.arange(len(parts))
    a, b, c = (parts[rows, (first + k) % 3] for k in range(3))
    middle = a / 2 + b / 2
    halves: Coordinates = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
    return halves


def _pieces(skin: Skin, faces: Index) -> Index:
    """(k,) number of the piece of each of some faces, joined over edges."""
    if not len(faces):
        return faces
    return Topology(skin.points, *chosen(skin.shape.corners, skin.shape.starts, faces)).components.label


def _as_one(piece: Index, faces: Index, far: Coordinates, owner: Index, spacing: float) -> Index:
    """(k,) pieces of faces, those that are near each other as one: places of them that are far from the list are."""
    if not len(far):
        return piece
    near = clusters(far, spacing)
    of = piece[np.searchsorted(faces, owner)]
    count = int(piece.max()) + 1
    # A piece may reach into several clusters, and a cluster may hold parts of several pieces.
    together = joined(count + int(near.max()) + 1, of, count + near)
    numbers: Index = np.unique(together[piece], return_inverse=True)[1]
    return numbers
