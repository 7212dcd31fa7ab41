# SPDX-License-Identifier: MIT
"""Distances of clouds of reference from meshes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from foparq.check.surfaces.sides import Sides, sides_of
from foparq.check.surfaces.skin import Skin
from foparq.check.surfaces.uncovered import first_of, place_of, uncovered
from foparq.columns import Coordinates, Flags, Index, Reals
from foparq.findings.clouds import CloudDistances, Far, Signs
from foparq.model.cloud import Cloud
from foparq.model.delivery import Delivery

_NEAR = 3  #: points near a mesh, from which on it was compared
_WORST = 10  #: places that are told
_CLASSES = 40  #: of the histogram
_INNER = 0.99  #: of the points lie within the classes
_ELSEWHERE = 0.1  #: of the diagonal of the mesh
_SAME = 1e-6  #: of the diagonal: a point that is a vertex, written in single precision
_PART = 1 << 20  #: points that are asked at once: what is known of each takes much more than its coordinates


class _Foot(NamedTuple):
    distance: Reals  #: (n,) to the nearest of all meshes
    face: Index  #: (n,) of its file
    which: Index  #: (n,) of the meshes
    vertex: Flags  #: (n,) at a vertex


def compare_clouds(delivery: Delivery, *, search: float, beyond: float | None) -> tuple[CloudDistances, ...]:
    """Hold the references of a delivery against the meshes that they show.

    Parameters
    ----------
    search : float, metres
        What is farther from every surface is not covered.
    beyond : float or None, metres
        What is farther from the surface is counted.

    Returns
    -------
    tuple of CloudDistances
        In the order of the references. One whose unit nobody states is left out, as are meshes of unknown unit or
        without a surface, and a reference for which no mesh is left.

    Notes
    -----
    O(n log f) for n points and f faces, and as much for the sign. All numbers are of all points, whatever their order.
    """
    skins = {mesh.path: skin for mesh in delivery.meshes if mesh.unit.metres is not None and len(skin := Skin(mesh))}
    told = []
    for cloud in delivery.references:
        mine = [skin for path, skin in skins.items() if cloud.mesh in {"", path}]
        if cloud.unit.metres is not None and mine:
            told.append(_compared(cloud, mine, cloud.unit.metres, search=search, beyond=beyond))
    return tuple(told)


def _compared(
    cloud: Cloud, skins: Sequence[Skin], metres: float, *, search: float, beyond: float | None
) -> CloudDistances:
    points = cloud.points * metres
    diagonal = max(map(_diagonal, skins))
    foot = _feet(skins, points, _SAME * diagonal)
    sides = [sides_of(skin, points, foot.distance, foot.which == row, search) for row, skin in enumerate(skins)]
    signs = _signs([one for row, one in enumerate(sides) if (foot.which == row).any()])
    signed = foot.distance.copy()
    if signs is not Signs.OPEN:
        for one in sides:
            signed[one.inside] *= -1
    away = foot.distance > search
    elsewhere = bool(np.median(foot.distance) > _ELSEWHERE * diagonal)
    # Sums of sorted numbers do not depend on the order of the points.
    ordered, size = np.sort(signed), np.sort(foot.distance)
    edges, counts = _histogram(ordered, size, search)
    n = len(points)
    near = [int(np.count_nonzero((foot.which == row) & ~away)) for row in range(len(skins))]
    return CloudDistances(
        path=cloud.path, meshes=tuple(skin.mesh.path for skin in skins),
        near=tuple(skin.mesh.path for skin, count in zip(skins, near, strict=True) if count >= _NEAR),
        n=n, signs=signs, mean=float(ordered.mean()), median=float(np.median(ordered)),
        sd=float(ordered.std(ddof=1)) if n > 1 else np.nan, rms=float(np.sqrt(np.mean(size**2))),
        quantile=float(np.quantile(size, 0.95)), largest=float(size[-1]), limit=beyond,
        beyond=0 if beyond is None else int(np.count_nonzero(size > beyond)), search=search,
        uncovered=uncovered(points, foot.distance, away, search, grouped=not elsewhere), survey_sd=cloud.survey_sd,
        diagonal=diagonal, elsewhere=elsewhere, repeats=bool(np.count_nonzero(foot.vertex) * 2 > n),
        worst=_worst(points, foot, signed, [skin.mesh.path for skin in skins], search), edges=edges, counts=counts,
    )  # fmt: skip


def _diagonal(skin: Skin) -> float:
    used = skin.points[skin.shape.triangulation.triangles.ravel()]
    return float(np.linalg.norm(np.ptp(used, axis=0)))


def _feet(skins: Sequence[Skin], points: Coordinates, same: float) -> _Foot:
    distance, face = np.full(len(points), np.inf), np.full(len(points), -1, dtype=np.intp)
    which, vertex = np.zeros(len(points), dtype=np.intp), np.zeros(len(points), dtype=bool)
    for start in range(0, len(points), _PART):
        part = slice(start, start + _PART)
        for row, skin in enumerate(skins):
            foot = skin.foot(points[part])
            vertex[part] |= foot.vertex <= same
            better = foot.distance < distance[part]
            distance[part][better], face[part][better] = foot.distance[better], foot.face[better]
            which[part][better] = row
    return _Foot(distance, face, which, vertex)


def _signs(sides: Sequence[Sides]) -> Signs:
    told = {one.signs for one in sides}
    return next(signs for signs in (Signs.OPEN, Signs.NEARLY, Signs.CLOSED) if signs in told)


def _histogram(ordered: Reals, size: Reals, search: float) -> tuple[Reals, Index]:
    """Classes of one width; those beyond either end are counted in the outer ones."""
    reach = min(float(np.quantile(size, _INNER)), search) or float(size[-1]) or 1.0
    edges = np.linspace(-reach if ordered[0] < 0 else 0.0, reach, _CLASSES + 1)
    inner = np.searchsorted(ordered, edges[1:-1], side="left")
    counts: Index = np.diff(np.concatenate([[0], inner, [len(ordered)]])).astype(np.intp)
    return edges, counts


def _worst(points: Coordinates, foot: _Foot, signed: Reals, paths: Sequence[str], apart: float) -> tuple[Far, ...]:
    """The farthest points, one of each neighbourhood."""
    left = foot.distance.copy()
    told: list[Far] = []
    while len(told) < _WORST and (most := float(left.max())) > 0:
        row = first_of(points, np.flatnonzero(left == most))
        told.append(Far(place_of(points, row), float(signed[row]), paths[foot.which[row]], int(foot.face[row])))
        left[np.linalg.norm(points - points[row], axis=1) <= apart] = 0.0
    return tuple(told)
