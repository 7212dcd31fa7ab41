# SPDX-License-Identifier: MIT
"""What findings of a mesh lie on: points, lines and triangles from their own coordinates, never from the picture's."""

from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Geometries, Index, Reals, Texts
from foparq.findings.table import Findings
from foparq.geom.parts import single_parts
from foparq.report.page.findings import RANK
from foparq.report.page.meshes.surface import Shown

FINDINGS = 5_000  #: findings of one mesh that are drawn, the gravest first
PIECES = 30_000  #: segments and triangles that are drawn of them
_AREA = shapely.GeometryType.POLYGON
_POINT = shapely.GeometryType.POINT
_CORNERS = 4  #: coordinates of the ring of a triangle


class Pieces(NamedTuple):
    """What is drawn of findings, in the frame of the surface; the gravest first, rank 0 is gravest."""

    points: Reals  #: (a, 3)
    point_rank: Index  #: (a,)
    lines: Reals  #: (b, 2, 3)
    line_rank: Index  #: (b,)
    faces: Reals  #: (c, 3, 3)
    face_rank: Index  #: (c,)
    drawn: int  #: findings that are drawn
    found: int  #: findings in the table
    cut: int  #: findings of which only a part of the outline is drawn


def pieces_of(findings: Findings, path: str, shown: Shown) -> Pieces:
    """What is drawn of the findings of one mesh.

    Notes
    -----
    A point is drawn where a finding is one; lines are drawn along lines and around areas; a triangle is filled. What
    has no finite place is not drawn.
    """
    mine = np.flatnonzero(findings.source == path)
    rank = ranks(findings.severity[mine])
    mine = mine[np.argsort(rank, kind="stable")]
    placed = mine[~shapely.is_empty(findings.where[mine]) & ~shapely.is_missing(findings.where[mine])]
    drawn = placed[:FINDINGS]
    rank = ranks(findings.severity[drawn])
    parts, owner = single_parts(findings.where[drawn])
    kind = shapely.get_type_id(parts)
    spots = np.flatnonzero(kind == _POINT)
    at, point_owner = _coordinates(parts[spots], shown)
    lines, line_of = _segments(parts, np.flatnonzero(kind != _POINT), shown)
    faces, face_of = _triangles(parts, np.flatnonzero(kind == _AREA), shown)
    point_rank, line_rank, face_rank = rank[owner[spots[point_owner]]], rank[owner[line_of]], rank[owner[face_of]]
    last = np.array([len(lines), len(faces)])
    kept = np.minimum(last, PIECES)
    cut = len(np.unique(np.concatenate([owner[line_of[kept[0] :]], owner[face_of[kept[1] :]]])))
    return Pieces(
        at, point_rank, lines[: kept[0]], line_rank[: kept[0]], faces[: kept[1]], face_rank[: kept[1]],
        len(drawn), len(placed), cut,
    )  # fmt: skip


def ranks(severity: Texts) -> Index:
    """Rank (n,) of severities, 0 for the gravest."""
    return np.fromiter((RANK[value] for value in severity), dtype=np.intp, count=len(severity))


def _coordinates(parts: Geometries, shown: Shown) -> tuple[Reals, Index]:
    """Finite vertices (k, 3) in the frame and the part of each."""
    points, part = shapely.get_coordinates(parts, include_z=True, return_index=True)
    placed = shown.placed(points)
    finite = np.isfinite(placed.astype(np.float32)).all(axis=1)  # the page holds single precision
    return placed[finite], part[finite]


def _segments(parts: Geometries, rows: Index, shown: Shown) -> tuple[Reals, Index]:
    """Segments (k, 2, 3) of lines and outlines, and the row of the part of each."""
    points, part = _coordinates(parts[rows], shown)
    joined = np.flatnonzero(part[1:] == part[:-1])
    return np.stack([points[joined], points[joined + 1]], axis=1), rows[part[joined]]


def _triangles(parts: Geometries, rows: Index, shown: Shown) -> tuple[Reals, Index]:
    """Triangles (k, 3, 3) among areas, and the row of the part of each."""
    rows = rows[shapely.get_num_coordinates(parts[rows]) == _CORNERS]
    points, part = _coordinates(parts[rows], shown)
    whole = np.flatnonzero(np.bincount(part, minlength=len(rows)) == _CORNERS)
    kept = np.isin(part, whole)
    corners: Reals = points[kept].reshape(-1, _CORNERS, 3)[:, :3]
    return corners, rows[whole]
