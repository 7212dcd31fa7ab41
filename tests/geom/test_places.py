# SPDX-License-Identifier: MIT
"""The place of a geometry lies on it, and does not depend on how it was drawn."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from foparq.geom.places import place_on
from foparq.geom.ragged import last_not_above, running_sums

U = "POLYGON ((0 0, 9 0, 9 9, 8 9, 8 1, 1 1, 1 9, 0 9, 0 0))"
NAN = float("nan")


def drawn(*geometry: Any) -> NDArray[np.object_]:
    made = np.empty(len(geometry), dtype=object)
    with np.errstate(invalid="ignore"):
        made[:] = [shapely.from_wkt(g) if isinstance(g, str) else g for g in geometry]
    return made


@pytest.mark.parametrize(
    ("geometry", "place"),
    [
        (None, (NAN, NAN, NAN)),
        ("POINT EMPTY", (NAN, NAN, NAN)),
        ("POLYGON EMPTY", (NAN, NAN, NAN)),
        ("MULTILINESTRING EMPTY", (NAN, NAN, NAN)),
        ("GEOMETRYCOLLECTION (POINT EMPTY, LINESTRING EMPTY)", (NAN, NAN, NAN)),
        ("POINT (3 4)", (3, 4, NAN)),
        ("POINT Z (3 4 5)", (3, 4, 5)),
        ("MULTIPOINT (3 4, 2 9, 2 8)", (2, 8, NAN)),
        ("LINESTRING (0 0, 8 0, 8 4)", (6, 0, NAN)),
        ("LINESTRING Z (0 0 1, 8 0 5, 8 4 9)", (6, 0, 4)),
        ("LINESTRING (2 1, 2 1)", (2, 1, NAN)),
        ("LINEARRING (4 0, 4 4, 0 4, 0 0, 4 0)", (0, 0, NAN)),
        ("MULTILINESTRING ((0 0, 1 0), (5 5, 5 9), (7 7, 8 7))", (5, 7, NAN)),
        ("MULTILINESTRING ((7 7, 8 7), (0 0, 1 0))", (0.5, 0, NAN)),
        ("POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))", (2, 1, NAN)),
        ("POLYGON Z ((0 0 0, 4 0 8, 4 2 8, 0 2 0, 0 0 0))", (2, 1, 4)),
        (U, (0.5, 5, NAN)),
        ("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 8, 8 8, 8 1, 1 1))", (0.5, 4.5, NAN)),
        ("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((5 5, 9 5, 9 9, 5 9, 5 5)))", (7, 7, NAN)),
        ("GEOMETRYCOLLECTION (POINT (9 9), LINESTRING (0 0, 90 0), POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0)))", (2, 1, NAN)),
        ("GEOMETRYCOLLECTION (POINT (9 9), GEOMETRYCOLLECTION (LINESTRING (0 0, 2 0)))", (1, 0, NAN)),
        ("POLYGON ((0 0, 4 0, 2 0, 0 0))", (0, 0, NAN)),  # bounds no area
        ("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))", (1, 2, NAN)),  # a bow-tie, lying on its side
        ("LINESTRING (0 0, NaN 1, 2 0)", (1, 0, NAN)),
        ("POINT (NaN 1)", (NAN, NAN, NAN)),
        ("LINESTRING Z (0 0 NaN, 2 0 4)", (1, 0, 4)),
    ],
)
def test_place_of(geometry: str | None, place: tuple[float, float, float]) -> None:
    assert place_on(drawn(geometry))[0].tolist() == pytest.approx(place, nan_ok=True)
    # The same whatever stands beside it.
    crowd = drawn("LINESTRING (-1e300 0, 1e300 7)", geometry, None, U, geometry)
    for n in (1, 4):
        assert place_on(crowd)[n].tolist() == pytest.approx(place, nan_ok=True)


def wandering(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    return np.cumsum(rng.normal(0, 1, (count, 3)), axis=0)


def star_shaped(rng: np.random.Generator, count: int, *, symmetric: bool) -> NDArray[np.float64]:
    angle = np.sort(rng.uniform(0, 2 * np.pi, count))
    radius = rng.uniform(0.5, 3, count)
    half = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    if symmetric:  # equal arms left and right
        half = np.column_stack([np.abs(half[:, 0]) + 0.1, half[:, 1]])
        half = half[np.argsort(half[:, 1])]
        half = np.vstack([half, half[::-1] * [-1, 1]])
    return half


@pytest.mark.parametrize("offset", [0.0, 7.4e6])
@pytest.mark.parametrize("seed", range(20))
def test_a_line_drawn_backwards_has_the_same_place_at_half_its_length(seed: int, offset: float) -> None:
    rng = np.random.default_rng(seed)
    lines = np.array([shapely.LineString(wandering(rng, n) + offset) for n in rng.integers(2, 70, 30)])
    places = place_on(lines)
    middle = shapely.line_interpolate_point(lines, 0.5, normalized=True)
    assert shapely.distance(shapely.points(places), middle).max() < 1e-8
    assert np.array_equal(places, place_on(shapely.reverse(lines)))


@pytest.mark.parametrize("same", [["x"], ["x", "y"]])
def test_so_has_one_whose_ends_lie_behind_or_above_each_other(same: list[str]) -> None:
    rng = np.random.default_rng(5)
    vertex = rng.uniform(0, 1, (400, 3, 3))
    for axis in same:
        vertex[:, -1, "xyz".index(axis)] = vertex[:, 0, "xyz".index(axis)]
    lines = np.array([shapely.LineString(line) for line in vertex])
    assert np.array_equal(place_on(lines), place_on(shapely.reverse(lines)))


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_the_place_of_an_area_lies_within_however_its_ring_is_drawn(seed: int, *, symmetric: bool) -> None:
    rng = np.random.default_rng(seed)
    for n in rng.integers(3, 40, 10):
        ring = star_shaped(rng, n, symmetric=symmetric) + np.array([7.4e6, 0])
        ring = np.column_stack([ring, ring @ [0.3, -2] - 0.3 * 7.4e6])
        areas = [
            shapely.Polygon(np.roll(ring, shift, axis=0)[::way]) for shift in (0, 1, len(ring) // 2) for way in (1, -1)
        ]
        places = place_on(np.array(areas))
        assert areas[0].contains(shapely.Point(places[0])) or not areas[0].is_valid
        assert places[0, 2] == pytest.approx(places[0, :2] @ [0.3, -2] - 0.3 * 7.4e6, abs=1e-6)
        assert np.array_equal(places, np.repeat(places[:1], len(areas), axis=0))


@pytest.mark.parametrize("seed", range(10))
def test_a_ring_may_start_anywhere(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = wandering(rng, 12)
    turned = [np.roll(ring, shift, axis=0)[::way] for shift in range(12) for way in (1, -1)]
    places = place_on(np.array([shapely.LineString(np.vstack([way, way[:1]])) for way in turned]))
    assert np.array_equal(places, np.repeat(places[:1], len(turned), axis=0))


@pytest.mark.parametrize("seed", range(10))
def test_parts_may_stand_in_any_order(seed: int) -> None:
    rng = np.random.default_rng(seed)
    equal = [wandering(rng, 9)[0] + wandering(np.random.default_rng(seed), 9) for _ in range(5)]
    lines = [shapely.LineString(way) for way in equal]
    areas = [shapely.Polygon(star_shaped(rng, 9, symmetric=True) + np.array([10 * n, 0])) for n in range(5)]
    for parts, joined in ((lines, shapely.multilinestrings), (areas, shapely.multipolygons)):
        orders = [rng.permutation(len(parts)) for _ in range(6)]
        places = place_on(np.array([joined([parts[n] for n in order]) for order in orders]))
        assert np.array_equal(places, np.repeat(places[:1], len(orders), axis=0), equal_nan=True)
        assert np.isfinite(places[:, :2]).all()


def test_nothing_has_no_places() -> None:
    assert place_on(drawn()).shape == (0, 3)


@pytest.mark.parametrize("seed", range(5))
def test_sums_and_searches_are_those_of_each_range_alone(seed: int) -> None:
    rng = np.random.default_rng(seed)
    offsets = np.concatenate([[0], np.cumsum(rng.integers(0, 40, 50))])
    value = rng.uniform(0, 1, offsets[-1])
    ranges = [value[low:high] for low, high in pairwise(offsets)]
    sums = running_sums(value, offsets)
    assert sums.tolist() == np.concatenate([np.cumsum(r) for r in ranges]).tolist()
    filled = np.flatnonzero(np.diff(offsets) > 0)
    limit = rng.uniform(-1, 20, len(filled))
    found = last_not_above(sums, offsets[filled], offsets[filled + 1], limit)
    expected = [
        max(np.searchsorted(np.cumsum(ranges[n]), x, side="right") - 1, 0) for n, x in zip(filled, limit, strict=True)
    ]
    assert (found - offsets[filled]).tolist() == expected
