# SPDX-License-Identifier: MIT
"""Curves replaced by chords that stay within a stated sagitta. Pure numbers, no file types.

Every function is total: coordinates that are not finite give coordinates that are not finite, and a curve that would
need more than ``MOST_CHORDS`` chords raises :class:`TooFineError`.
"""

import math
from dataclasses import dataclass

import numpy as np

from foparq.columns import Coordinates

Point = tuple[float, float, float]

MOST_CHORDS = 1_000_000  #: of one curve; no drawn curve needs as many
_WIDEST = math.pi / 4  #: chords of a full turn, also of a circle smaller than the sagitta: never fewer than eight
_OWN_SHARE = 1e-4  #: sagitta as a share of the curve's own size where the drawing unit is unknown


_NONE: Coordinates = np.empty((0, 3))


class TooFineError(Exception):
    """A curve is so large against the sagitta that it would need unbounded memory."""


@dataclass(frozen=True, slots=True)
class Sagitta:
    """Greatest distance between a curve and its chords.

    Parameters
    ----------
    absolute : float or None
        In drawing units. ``None`` if nobody knows what a drawing unit is: then each curve may deviate by one
        ten-thousandth of its own size (radius, half axis, extent of its control points).
    """

    absolute: float | None

    def of(self, size: float) -> float:
        """Sagitta for a curve of that size, drawing units."""
        return self.absolute if self.absolute is not None else _OWN_SHARE * size

    def tightened(self, level: int) -> "Sagitta":
        """Sagitta for content that will be enlarged by at most ``2 ** level``."""
        return self if self.absolute is None else Sagitta(math.ldexp(self.absolute, -level))


def count_chords(sweep: float, step: float) -> int:
    """Number of equal chords so that none sweeps more than ``step``.

    Raises
    ------
    TooFineError
        If there would be too many, or the numbers are not numbers.
    """
    count = abs(sweep) / step if step > 0 else math.inf
    if not count <= MOST_CHORDS:
        raise TooFineError
    return max(1, math.ceil(count))


def arc_step(radius: float, sagitta: float) -> float:
    """Greatest sweep of a chord of a circle, radians: sagitta = radius (1 - cos(step / 2))."""
    if not radius > sagitta:
        return _WIDEST
    return min(_WIDEST, 4 * math.asin(math.sqrt(sagitta / (2 * radius))))


def flatten_arc(centre: Point, radius: float, start: float, sweep: float, sagitta: Sagitta) -> Coordinates:
    """Vertices of a circular arc in a plane parallel to xy.

    Parameters
    ----------
    centre : tuple = (x, y, z)
    start, sweep : float
        Radians, counter-clockwise; a sweep of a full turn repeats the first vertex exactly.

    Returns
    -------
    (n + 1, 3) for n chords
    """
    n = count_chords(sweep, arc_step(radius, sagitta.of(radius)))
    angles = start + sweep * np.arange(n + 1) / n
    points = np.full((n + 1, 3), centre, dtype=float)
    points[:, 0] += radius * np.cos(angles)
    points[:, 1] += radius * np.sin(angles)
    if abs(sweep) >= math.tau:
        points[-1] = points[0]
    return points


def flatten_ellipse(
    centre: Point, major: Point, minor: Point, start: float, sweep: float, sagitta: Sagitta
) -> Coordinates:
    """Vertices of an elliptic arc ``centre + major cos t + minor sin t``.

    Notes
    -----
    The second derivative is never longer than the longer half axis a, so a chord over dt stays within a dt^2 / 8.
    """
    longest = max(math.hypot(*major), math.hypot(*minor))
    allowed = sagitta.of(longest)
    step = min(_WIDEST, math.sqrt(8 * allowed / longest)) if longest > 0 else _WIDEST
    n = count_chords(sweep, step)
    t = start + sweep * np.arange(n + 1)[:, None] / n
    points: Coordinates = np.array(centre) + np.array(major) * np.cos(t) + np.array(minor) * np.sin(t)
    if abs(sweep) >= math.tau:
        points[-1] = points[0]
    return points


def flatten_bulge(first: Point, second: Point, bulge: float, sagitta: Sagitta) -> Coordinates:
    """Vertices between two vertices of a polyline that are joined by an arc.

    Parameters
    ----------
    first, second : tuple = (x, y, z)
        The vertices themselves; they are not returned and stay as delivered.
    bulge : float
        Tangent of a quarter of the swept angle; positive counter-clockwise.

    Returns
    -------
    (k, 3)
        Empty if the chord itself stays within the sagitta.

    Notes
    -----
    Points are built from the chord, not from the centre, which lies far away for flat arcs.
    """
    along_x, along_y = second[0] - first[0], second[1] - first[1]
    chord = math.hypot(along_x, along_y)
    if not 0 < chord < math.inf or bulge == 0 or not math.isfinite(bulge):
        return _NONE
    size = abs(bulge)
    sweep = 4 * math.atan(size)
    radius = chord * (1 / size + size) / 4
    allowed = sagitta.of(radius)
    if size * chord / 2 <= allowed:
        return _NONE
    n = count_chords(sweep, arc_step(radius, allowed))
    unit_x, unit_y = along_x / chord, along_y / chord
    side = math.copysign(1.0, bulge)
    middle_x, middle_y = (first[0] + second[0]) / 2, (first[1] + second[1]) / 2
    angle = sweep * (np.arange(1, n) / n - 0.5)
    along = radius * np.sin(angle)
    across = side * 2 * radius * np.sin((sweep / 2 + angle) / 2) * np.sin((sweep / 2 - angle) / 2)
    points = np.full((n - 1, 3), (middle_x, middle_y, first[2]))
    points[:, 0] += along * unit_x + across * unit_y
    points[:, 1] += along * unit_y - across * unit_x
    return points


def to_world(points: Coordinates, extrusion: Point) -> Coordinates:
    """Object coordinates to world coordinates by the arbitrary axis algorithm of the DXF reference.

    Parameters
    ----------
    points : (n, 3)
    extrusion : tuple = (x, y, z)
        Direction of the object's z axis, of any length.

    Returns
    -------
    (n, 3)
        The same, bit by bit, for the usual extrusion (0, 0, 1).
    """
    if extrusion == (0.0, 0.0, 1.0):
        return points
    world: Coordinates = points @ np.array(axes(extrusion))
    return world


def axes(extrusion: Point) -> tuple[Point, Point, Point]:
    """World directions of the axes of an object coordinate system; those of the world for a null extrusion."""
    length = math.hypot(*extrusion)
    if not 0 < length < math.inf:
        return (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    nx, ny, nz = (part / length for part in extrusion)
    near_pole = abs(nx) < 1 / 64 and abs(ny) < 1 / 64
    ax, ay, az = (nz, 0.0, -nx) if near_pole else (-ny, nx, 0.0)  # world y, or world z, crossed with the normal
    scale = math.hypot(ax, ay, az)
    ax, ay, az = ax / scale, ay / scale, az / scale
    return (ax, ay, az), (ny * az - nz * ay, nz * ax - nx * az, nx * ay - ny * ax), (nx, ny, nz)


def cos_sin(degrees: float) -> tuple[float, float]:
    """Cosine and sine of an angle in degrees, exact for quarter turns."""
    turned = math.fmod(degrees, 360.0) if math.isfinite(degrees) else math.nan
    quarter = {0.0: (1.0, 0.0), 90.0: (0.0, 1.0), 180.0: (-1.0, 0.0), 270.0: (0.0, -1.0)}
    exact = quarter.get(turned % 360.0)
    return exact if exact is not None else (math.cos(math.radians(turned)), math.sin(math.radians(turned)))
