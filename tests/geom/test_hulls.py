# SPDX-License-Identifier: MIT
"""Hulls that lie within no other, and how far hulls reach, against plain loops and known shapes."""

import numpy as np
import pytest
import shapely

from foparq.geom import hulls as kernel
from foparq.geom.hulls import across, hulls_of, outermost


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("first", [1, 3, 1000])
def test_outermost_hulls_are_those_that_a_loop_finds(first: int, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel, "_FIRST", first)
    rng = np.random.default_rng(seed)
    # On a coarse grid many boxes are equal, nested, or share a side; some are lines and points.
    low = rng.integers(0, 6, (80, 2))
    high = low + rng.choice([0, 1, 1, 2, 4], (80, 2))
    boxes = np.array([shapely.convex_hull(shapely.MultiPoint([*low[n : n + 1], *high[n : n + 1]])) for n in range(80)])
    solid = np.all(high > low, axis=1)
    boxes[solid] = shapely.box(*low[solid].T, *high[solid].T)
    boxes[::17] = shapely.Polygon()
    group = rng.integers(0, 3, 80)
    kept = outermost(boxes, group)
    for name in range(3):
        mine = np.flatnonzero((group == name) & ~shapely.is_empty(boxes))
        shapes = {shapely.normalize(boxes[n]).wkb: boxes[n] for n in mine}
        alone = [
            key for key, shape in shapes.items()
            if not any(other.covers(shape) for name, other in shapes.items() if name != key)
        ]  # fmt: skip
        found = [shapely.normalize(boxes[n]).wkb for n in mine if kept[n]]
        assert sorted(found) == sorted(alone)
    assert not kept[shapely.is_empty(boxes)].any()


def test_every_label_has_the_hull_of_its_vertices() -> None:
    shapes = [
        "LINESTRING (0 0, 2 0)", "POINT (9 9)", None, "LINESTRING (2 2, 0 2, 1 1)", "POLYGON EMPTY",
        "LINESTRING (5 5, 7 5)",
    ]  # fmt: skip
    geometry = np.array([None if shape is None else shapely.from_wkt(shape) for shape in shapes], dtype=object)
    found = hulls_of(geometry, np.array([0, 1, 1, 0, 2, 3]))
    known = [
        shapely.box(0, 0, 2, 2),
        shapely.Point(9, 9),
        shapely.GeometryCollection(),
        shapely.LineString([(5, 5), (7, 5)]),
    ]
    assert [shapely.is_empty(hull) for hull in found] == [False, False, True, False]
    assert all(shapely.equals(hull, shape) for hull, shape in zip(found, known, strict=True) if not hull.is_empty)
    assert across(found).tolist() == pytest.approx([np.hypot(2, 2), 0.0, np.nan, 2.0], nan_ok=True)
    assert across(np.array([shapely.box(1, 2, 4, 6)])).tolist() == [5.0]
