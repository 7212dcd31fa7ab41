# SPDX-License-Identifier: MIT
"""The plane of a drawing: facades are elevations."""

from dataclasses import dataclass

import numpy as np
import shapely

from foparq.columns import Coordinates, Geometries, Reals
from foparq.errors import ManifestError
from foparq.geom.rounding import EARTH

_NAMED = {
    "xy": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "xz": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "yz": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
}


@dataclass(frozen=True, slots=True)
class Plane:
    """An orthonormal frame: two axes in the plane, the third is depth.

    Parameters
    ----------
    name : str
        ``"xy"``, ``"xz"``, ``"yz"``, ``"fit"`` or ``"given"``; ``"assumed"``: xy, because nobody stated a plane.
    origin : tuple = (x, y, z)
        In file coordinates, drawing units.
    right, up : tuple = (x, y, z)
        Unit vectors: right and up on the sheet.
    """

    name: str
    origin: tuple[float, float, float]
    right: tuple[float, float, float]
    up: tuple[float, float, float]

    @property
    def frame(self) -> Reals:
        """(3, 3) rows: right, up, depth (right-handed)."""
        right, up = np.asarray(self.right), np.asarray(self.up)
        return np.stack([right, up, np.cross(right, up)])

    def project(self, coordinates: Coordinates, metres: float) -> Coordinates:
        """File coordinates to plane coordinates.

        Parameters
        ----------
        coordinates : (n, 3) drawing units
        metres : float
            Metres in one drawing unit.

        Returns
        -------
        (n, 3) metres: right, up, depth
        """
        shifted: Coordinates = (coordinates - np.asarray(self.origin)) @ self.frame.T
        return shifted * metres

    def lift(self, coordinates: Coordinates, metres: float) -> Coordinates:
        """Plane coordinates (n, 3) in metres back to file coordinates (n, 3) in drawing units."""
        lifted: Coordinates = (coordinates / metres) @ self.frame + np.asarray(self.origin)
        return lifted


def plane_of(stated: str | tuple[tuple[float, float, float], ...] | None, geometry: Geometries) -> Plane:
    """Plane as the manifest states it, or fitted to the items.

    Parameters
    ----------
    stated : str, three triples or None
        ``"xy"``, ``"xz"``, ``"yz"``, ``"fit"``, or origin and two axes; ``None`` if nobody says: xy is assumed.
    geometry : (n,) shapely geometries
        The linework, used to choose an origin near it and to fit.

    Returns
    -------
    Plane
        For a named plane the origin is the rounded lower corner of the items, so that large coordinates lose no digits.
        Vertices that lie absurdly far from most others have no say.

    Raises
    ------
    ManifestError
        If the axes are parallel or the items span no plane.

    Notes
    -----
    The fit minimises orthogonal distances (singular value decomposition of the centred vertices); right is kept
    horizontal and up is kept upward.
    """
    points = _vertices(geometry)
    corner = np.floor(points.min(axis=0)) if len(points) else np.zeros(3)
    if stated is None or (isinstance(stated, str) and stated in _NAMED):
        right, up = _NAMED[stated or "xy"]
        depth = np.cross(right, up)
        # Depth is told from zero, as the file has it.
        origin = corner - depth * float(corner @ depth)
        return Plane(stated or "assumed", _triple(origin), right, up)
    if stated == "fit":
        return _fitted(points)
    if isinstance(stated, str):
        raise ManifestError("manifest.plane", value=stated, example='plane = "xz"')
    origin, first, second = (np.asarray(triple, dtype=float) for triple in stated)
    right_axis, up_axis = _orthonormal(first, second)
    return Plane("given", _triple(origin), _triple(right_axis), _triple(up_axis))


def _vertices(geometry: Geometries) -> Coordinates:
    points = shapely.get_coordinates(geometry, include_z=True)
    points[~np.isfinite(points[:, 2]), 2] = 0.0
    finite = np.isfinite(points[:, 0]) & np.isfinite(points[:, 1])
    kept: Coordinates = points if finite.all() else points[finite]
    if not len(kept):
        return kept
    with np.errstate(over="ignore"):  # a difference that is no number is far
        near = (np.abs(kept - np.median(kept, axis=0)) <= EARTH).all(axis=1)
    return kept if near.all() else kept[near]


def _fitted(points: Coordinates) -> Plane:
    if len(points) < 3:  # noqa: PLR2004 - three points span a plane
        raise ManifestError("manifest.plane-fit", value="fit", example='plane = "xz"')
    centre = points.mean(axis=0)
    _, spread, axes = np.linalg.svd(points - centre, full_matrices=False)
    if spread[1] <= 1e-9 * max(spread[0], 1e-300):
        raise ManifestError("manifest.plane-fit", value="fit", example='plane = "xz"')
    normal = axes[2]
    vertical = np.array([0.0, 0.0, 1.0])
    if abs(normal @ vertical) > np.cos(np.radians(10)):  # lies flat: keep the drawing's own x to the right
        normal = normal * np.sign(normal @ vertical)
        right = np.array([1.0, 0.0, 0.0]) - normal * normal[0]
    else:
        right = np.cross(vertical, normal)
        if right[np.argmax(np.abs(right))] < 0:
            right = -right
    right = right / np.linalg.norm(right)
    up = np.cross(normal, right)
    if up[np.argmax(np.abs(up))] < 0:
        up = -up
    return Plane("fit", _triple(centre), _triple(right), _triple(up))


def _orthonormal(first: Coordinates, second: Coordinates) -> tuple[Coordinates, Coordinates]:
    with np.errstate(invalid="ignore"):  # axes that are not finite give a rest that is not
        right = first / np.linalg.norm(first) if np.any(first) else first
        rest = second - right * (second @ right)
        length = np.linalg.norm(rest)
    if not np.isfinite(rest).all() or not np.any(first) or length <= 1e-9 * np.linalg.norm(second):
        raise ManifestError(
            "manifest.plane-axes", value=[first.tolist(), second.tolist()], example="[[0,0,0],[1,0,0],[0,0,1]]"
        )
    return right, rest / length


def _triple(values: Coordinates) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
