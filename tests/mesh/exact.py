# SPDX-License-Identifier: MIT
"""How triangles meet, by rational arithmetic: slow, plain, and built otherwise than the code under test.

The common points of two triangles are worked out as a convex polygon: the first triangle is cut off by the plane of the
second, from both sides, and by the three planes that stand on its edges. The triangles intersect if a corner of what is
left lies outside of what they share.
"""

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

Number = Fraction | int
Place = tuple[Number, Number, Number]
NONE, TRANSVERSAL, COPLANAR, CONTACT, FOLD = range(5)


def places(points: NDArray[np.float64]) -> tuple[list[Place], int]:
    """Points as whole numbers of a unit in which all are whole, and how many of it make one."""
    ratios = [[float(value).as_integer_ratio() for value in point] for point in points]
    unit = max((below for point in ratios for _, below in point), default=1)
    whole = [[above * (unit // below) for above, below in point] for point in ratios]
    return [(x, y, z) for x, y, z in whole], unit


def minus(a: Place, b: Place) -> Place:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a: Place, b: Place) -> Place:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Place, b: Place) -> Number:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normal(triangle: list[Place]) -> Place:
    return cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))


def degenerate(triangle: list[Place]) -> bool:
    return not any(normal(triangle))


def cut(polygon: list[Place], base: Place, outward: Place) -> list[Place]:
    """What of a convex polygon lies on the plane through ``base`` or behind it."""
    left: list[Place] = []
    height = [dot(minus(corner, base), outward) for corner in polygon]
    for k, corner in enumerate(polygon):
        before, h = polygon[k - 1], height[k - 1]
        if h * height[k] < 0:
            share = Fraction(h, h - height[k])
            step = minus(corner, before)
            left.append((before[0] + share * step[0], before[1] + share * step[1], before[2] + share * step[2]))
        if height[k] <= 0:
            left.append(corner)
    return left


def common(one: list[Place], two: list[Place]) -> list[Place]:
    """Corners of the convex set that two triangles have in common, each once."""
    up = normal(two)
    down = minus((0, 0, 0), up)
    left = cut(cut(one, two[0], up), two[0], down)
    for k in range(3):
        left = cut(left, two[k], cross(minus(two[(k + 1) % 3], two[k]), up))
    return list(dict.fromkeys(left))


def inside(point: Place, triangle: list[Place]) -> bool:
    """Whether a point of the plane of a triangle lies within it, not on its border."""
    up = normal(triangle)
    return all(
        dot(cross(minus(triangle[(k + 1) % 3], triangle[k]), minus(point, triangle[k])), up) > 0 for k in range(3)
    )


def on_segment(point: Place, start: Place, end: Place) -> bool:
    along, step = minus(end, start), minus(point, start)
    return not any(cross(along, step)) and 0 <= dot(step, along) <= dot(along, along)


def meeting(one: list[Place], two: list[Place]) -> tuple[int, list[Place]]:
    """Why two triangles with area intersect beyond what they share, and the corners of what they have in common."""
    met = common(one, two)
    shared = [corner for corner in one if corner in two]
    if len(shared) == 3 or not met:
        return NONE, []
    if len(shared) == 1 and met == shared:
        return NONE, []
    if len(shared) == 2 and all(on_segment(corner, *shared) for corner in met):
        return NONE, []
    if any(any(cross(minus(b, a), minus(c, a))) for a, b, c in zip(met, met[1:], met[2:], strict=False)):
        return (FOLD if len(shared) == 2 else COPLANAR), met
    if len(met) == 1:
        return CONTACT, met
    a, b = met[0], met[-1]
    half = Fraction(1, 2)
    middle = (half * (a[0] + b[0]), half * (a[1] + b[1]), half * (a[2] + b[2]))
    return (TRANSVERSAL if inside(middle, one) and inside(middle, two) else CONTACT), met


def all_pairs(
    points: NDArray[np.float64], corners: NDArray[np.intp]
) -> dict[tuple[int, int], tuple[int, NDArray[np.float64]]]:
    """Every pair of triangles that intersect, with the corners of what they have in common, as doubles.

    Triangles without area take no part.
    """
    whole, unit = places(points)
    triangles = [[whole[k] for k in row] for row in corners.tolist()]
    low, high = points[corners].min(axis=1), points[corners].max(axis=1)
    sound = np.array([not degenerate(triangle) for triangle in triangles], dtype=bool)
    found = {}
    for i in range(len(triangles)):
        rest = slice(i + 1, None)
        near = ((low[i] <= high[rest]) & (low[rest] <= high[i])).all(axis=1) & sound[rest] & sound[i]
        for j in (np.flatnonzero(near) + i + 1).tolist():
            if same_side(triangles[i], triangles[j]) or same_side(triangles[j], triangles[i]):
                continue
            kind, met = meeting(triangles[i], triangles[j])
            if kind:
                found[i, j] = kind, np.array([[float(Fraction(value) / unit) for value in corner] for corner in met])
    return found


def same_side(one: list[Place], two: list[Place]) -> bool:
    """Whether all of the second lies on one side of the plane of the first; only to save time."""
    up = normal(one)
    height = [dot(minus(corner, one[0]), up) for corner in two]
    return min(height) > 0 or max(height) < 0
