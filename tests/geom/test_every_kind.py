# SPDX-License-Identifier: MIT
"""Kernels and rules on geometries of every kind: they end, and what they say of the sound ones stays."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import product
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from tests.geom.aims import AIM
from tests.rule_cases import common

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.geom.clusters import clusters
from foparq.geom.coverage import area_overlaps, coverage_gaps
from foparq.geom.crossings import self_meetings
from foparq.geom.duplicates import duplicate_groups
from foparq.geom.ends import classify_ends
from foparq.geom.hulls import across, hulls_of, outermost
from foparq.geom.overlaps import line_overlaps
from foparq.geom.places import place_on
from foparq.geom.polylines import Polylines
from foparq.geom.shapes import open_rings, point_like, repeated_vertices
from foparq.geom.validity import invalid_geometries
from foparq.model.inputs import Areas, Features, Lines, areas_of, features_of, lines_of

Made = NDArray[np.object_]
COINCIDE, REACH = 0.0004, 0.0103

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 0)]
HOLE = [(2, 2), (2, 4), (4, 4), (4, 2), (2, 2)]
#: rings of polygons, by what they are; all lie far from the sound items
RINGS: dict[str, list[list[tuple[float, ...]]]] = {
    "square": [SQUARE],
    "with a hole": [SQUARE, HOLE],
    "with an empty hole": [SQUARE, []],
    "bow-tie": [[(0, 0), (9, 9), (9, 0), (0, 9), (0, 0)]],
    "hole outside": [SQUARE, [(20, 20), (21, 20), (21, 21), (20, 20)]],
    "hole across": [SQUARE, [(8, 2), (8, 4), (12, 4), (12, 2), (8, 2)]],
    "holes nested": [SQUARE, [(1, 1), (1, 8), (8, 8), (8, 1), (1, 1)], HOLE],
    "spike": [[(0, 0), (9, 0), (9, 9), (9, 12), (9, 9), (0, 9), (0, 0)]],
    "flat": [[(0, 0), (9, 0), (4, 0), (0, 0)]],
    "one place": [[(1, 1), (1, 1), (1, 1), (1, 1)]],
    "repeated vertices": [[(0, 0), (9, 0), (9, 0), (9, 9), (0, 9), (0, 9), (0, 0)]],
    "unclosed": [[(0, 0), (9, 0), (9, 9), (0, 9)]],
    "NaN in x": [[(0, 0), (np.nan, 0), (9, 9), (0, 9), (0, 0)]],
    "NaN in y": [[(0, 0), (9, np.nan), (9, 9), (0, 9), (0, 0)]],
    "NaN first": [[(np.nan, 0), (9, 0), (9, 9), (0, 9), (np.nan, 0)]],
    "infinite": [[(0, 0), (np.inf, 0), (9, 9), (0, 9), (0, 0)]],
    "far": [[(0, 0), (1e15, 0), (1e15, 9), (0, 9), (0, 0)]],
    "beyond all": [[(0, 0), (1e300, 0), (1e300, 1e300), (0, 1e300), (0, 0)]],
}
LINES: dict[str, list[tuple[float, ...]]] = {
    "line": [(0, 0), (5, 1)],
    "two equal vertices": [(1, 1), (1, 1)],
    "repeated": [(0, 0), (0, 0), (5, 1), (5, 1), (5, 1)],
    "turning back": [(0, 0), (9, 0), (4, 0)],
    "crossing itself": [(0, 0), (9, 9), (9, 0), (0, 9)],
    "closed": SQUARE,
    "NaN in x": [(0, 0), (np.nan, 1), (5, 1)],
    "NaN in y": [(0, np.nan), (5, 1)],
    "infinite": [(0, 0), (5, -np.inf)],
    "far": [(0, 0), (-1e15, 1e15)],
    "beyond all": [(1e300, 1), (1e300, 1e300), (3e299, 1e300)],
}
#: what a third coordinate may be; None for no depth
DEPTHS: dict[str, Callable[[int], float] | None] = {
    "flat": None,
    "deep": lambda n: 4.7 + n % 2,
    "level": lambda _: 4.7,
    "some NaN": lambda n: np.nan if n % 2 else 4.7,
    "all NaN": lambda _: np.nan,
    "infinite": lambda n: np.inf if n % 2 else 0.0,
}
OFFSET = np.array([500.0, 300.0])


def coordinates(way: list[tuple[float, ...]], depth: Callable[[int], float] | None) -> NDArray[np.float64]:
    flat = np.array(way, dtype=float).reshape(-1, 2) + OFFSET
    return flat if depth is None else np.column_stack([flat, [depth(n) for n in range(len(way))]])


def wkb(kind: int, body: bytes, depth: Callable[[int], float] | None) -> bytes:
    return b"\1" + np.uint32(kind + (0 if depth is None else 0x80000000)).tobytes() + body


def ring(way: list[tuple[float, ...]], depth: Callable[[int], float] | None) -> bytes:
    return np.uint32(len(way)).tobytes() + coordinates(way, depth).tobytes()


def polygon(rings: list[list[tuple[float, ...]]], depth: Callable[[int], float] | None) -> Any:
    """As a file holds it: no constructor looks at it."""
    body = np.uint32(len(rings)).tobytes() + b"".join(ring(way, depth) for way in rings)
    return shapely.from_wkb(wkb(3, body, depth), on_invalid="fix")


def line(way: list[tuple[float, ...]], depth: Callable[[int], float] | None) -> Any:
    return shapely.from_wkb(wkb(2, ring(way, depth), depth))


@contextmanager
def quiet() -> Iterator[None]:
    """Lengths beyond all numbers are reported by numpy; nothing rests on them."""
    with np.errstate(invalid="ignore", over="ignore"):
        yield


def specimens() -> dict[str, Any]:
    found: dict[str, Any] = {"none": None}
    for kind in ("POINT", "LINESTRING", "LINEARRING", "POLYGON", "MULTIPOINT", "MULTILINESTRING", "MULTIPOLYGON"):
        for depth in ("", " Z"):
            found[f"empty {kind}{depth}"] = shapely.from_wkt(f"{kind}{depth} EMPTY")
    found["empty collection"] = shapely.from_wkt("GEOMETRYCOLLECTION EMPTY")
    found["collection of empties"] = shapely.from_wkt("GEOMETRYCOLLECTION (POINT EMPTY, POLYGON EMPTY)")
    with quiet():
        for word, depth in DEPTHS.items():
            lines = {name: line(way, depth) for name, way in LINES.items()}
            areas = {name: polygon(rings, depth) for name, rings in RINGS.items()}
            points = {"point": shapely.Point(coordinates([(1, 1)], depth)[0])}
            points["NaN point"] = shapely.from_wkb(wkb(1, coordinates([(np.nan, 1)], depth).tobytes(), depth))
            many = {
                "points": shapely.MultiPoint([points["point"]] * 2),
                "lines": shapely.MultiLineString([lines["line"], lines["repeated"]]),
                "areas": shapely.MultiPolygon([areas["square"], polygon([SQUARE], depth)]),
                "shells nested": shapely.MultiPolygon([areas["square"], polygon([HOLE], depth)]),
                "empty part": shapely.from_wkt("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), EMPTY)"),
                "empty line": shapely.from_wkt("MULTILINESTRING ((0 0, 1 0), EMPTY)"),
                "NaN part": shapely.MultiPolygon([areas["square"], areas["NaN in x"]]),
                "bow-tie part": shapely.MultiPolygon([areas["bow-tie"]]),
            }
            mixed = {
                "collection": shapely.GeometryCollection([points["point"], lines["line"], areas["bow-tie"]]),
                "nested": shapely.GeometryCollection([many["lines"], shapely.GeometryCollection([many["areas"]])]),
            }
            for kind, made in (("point", points), ("line", lines), ("area", areas), ("multi", many), ("mixed", mixed)):
                found |= {f"{kind} {name}, {word}": shape for name, shape in made.items()}
    return found


def array(*shapes: Any) -> Made:
    made = np.empty(len(shapes), dtype=object)
    made[:] = shapes
    return made


SPECIMENS = specimens()


def is_line(shape: Any) -> bool:
    """What ``Lines`` may hold."""
    return shape is not None and shape.geom_type == "LineString" and len(shape.coords) > 1 and finite(shape)


def is_area(shape: Any) -> bool:
    """What ``Areas`` may hold."""
    return (
        shape is not None and shape.geom_type == "Polygon" and not shape.is_empty and finite(shape) and shape.is_valid
    )


def finite(shape: Any) -> bool:
    return bool(np.isfinite(shapely.get_coordinates(shape)).all())


# Three sound items of each kind, with something to say of each.
GOOD_LINES = array(
    shapely.LineString([(0, 0), (1, 0), (1, 0.0002), (1, 1), (0.5, -1)]),
    shapely.LineString([(0, 0.004), (-1, 0.5)]),
    shapely.LineString([(-1, 0.5), (0, 0.004)]),
)
GOOD_AREAS = array(
    shapely.box(0, 0, 1, 1),
    shapely.Polygon([(0.9, 0), (2, 0), (2, 1), (1.1, 1), (1.05, 0.5)]),
    shapely.box(0, 1, 2, 2),
)
GOOD = array(GOOD_LINES[0], polygon([[(x - 600, y - 300) for x, y in way] for way in RINGS["bow-tie"]], None), None)
GOOD[2] = polygon([[(x - 700, y - 300) for x, y in way] for way in RINGS["hole outside"]], None)


def said_of(value: Any, count: int) -> list[Any]:
    """Rows of a column of geometries or numbers, as things that can be compared."""
    column = np.asarray(value)[:count]
    return [shape.wkt if isinstance(shape, shapely.Geometry) else shape for shape in column.tolist()]


def of_rows(table: Any, rows: Any, count: int) -> list[list[Any]]:
    """Rows of a table of columns that speak of the first items."""
    kept = np.asarray(rows) < count
    return [said_of(np.asarray(column)[kept], len(rows)) for column in table]


def line_kernels(shapes: Made, count: int) -> list[Any]:
    table = Polylines.of(shapes)
    origin = table.origin
    ends = classify_ends(table, AIM, coincide=COINCIDE, reach=REACH)
    crossings = self_meetings(table, coincide=COINCIDE)
    overlaps = line_overlaps(table, np.zeros(len(shapes), dtype=bool), coincide=COINCIDE)
    repeated = repeated_vertices(table, coincide=COINCIDE)
    rings = open_rings(table, coincide=COINCIDE, reach=REACH)
    return [
        of_rows([ends.line, ends.kind, np.round(ends.size, 9), ends.other], ends.line, count),
        of_rows([crossings.line, np.round(crossings.start + origin, 6)], crossings.line, count),
        of_rows([overlaps.line, overlaps.other, np.round(overlaps.length, 6)], overlaps.line, count),
        of_rows([repeated.line, repeated.vertex, np.round(repeated.place + origin, 6)], repeated.line, count),
        of_rows([rings.line, np.round(rings.gap, 6)], rings.line, count),
        said_of(duplicate_groups(table, coincide=COINCIDE), count),
        [row for row in point_like(table, coincide=COINCIDE).tolist() if row < count],
        said_of(np.round(table.length, 9), count),
    ]


def area_kernels(shapes: Made, count: int) -> list[Any]:
    flat = shapely.force_2d(shapes)
    overlaps = area_overlaps(flat, least=1e-6)
    gaps = coverage_gaps(flat, coincide=COINCIDE, most=1.0)
    return [
        of_rows([overlaps.smaller, overlaps.larger, np.round(overlaps.area, 9)], overlaps.smaller, count),
        of_rows([gaps.first, gaps.second, np.round(gaps.area, 9)], gaps.first, count),
    ]


def kernels(shapes: Made, count: int) -> list[Any]:
    invalid = invalid_geometries(shapes)
    near = clusters(shapes, gap=REACH)
    hulls = hulls_of(shapes, near)
    outermost(hulls, np.zeros(len(hulls), dtype=np.intp))
    across(hulls)
    return [
        of_rows([invalid.row, invalid.place], invalid.row, count),
        said_of(near, count),
        said_of(hulls[near], count),
        said_of(np.round(place_on(shapes), 9), count),
    ]


TABLE: dict[str, tuple[Callable[[Made, int], list[Any]], Made, Callable[[Any], bool]]] = {
    "lines": (line_kernels, GOOD_LINES, is_line),
    "areas": (area_kernels, GOOD_AREAS, is_area),
    "all": (kernels, GOOD, lambda _: True),
}


@pytest.mark.parametrize("kind", TABLE)
def test_kernels_end_on_every_specimen_and_say_the_same_of_the_sound(kind: str) -> None:
    run, good, fits = TABLE[kind]
    odd = {name: shape for name, shape in SPECIMENS.items() if fits(shape)}
    assert len(odd) > 15
    with quiet():
        alone = run(good, len(good))
        assert any(alone)
        for name, shape in odd.items():
            run(array(shape), 1)
            assert repr(run(array(*good, shape), len(good))) == repr(alone), name
        assert repr(run(array(*good, *odd.values()), len(good))) == repr(alone)


RULES = [rule for rule in all_rules().values() if rule.subject in {Lines, Areas, Features}]
MADE: dict[type, tuple[Callable[[Any], Any], Made, Callable[[Any], bool]]] = {
    Lines: (lines_of, GOOD_LINES, is_line),
    Areas: (areas_of, GOOD_AREAS, is_area),
    Features: (features_of, GOOD, lambda _: True),
}
TOLERANCES = {"coincide": COINCIDE, "reach": REACH, "least": 1e-6, "most": 1.0}
BY_UNIT = {"m": 0.0203, "m2": 0.00123, "1": 0.1234, "items": 3.0}


def found(rule: Rule, columns: Any, count: int) -> str:
    shared = common(rule)
    own = {name: TOLERANCES.get(name, BY_UNIT[unit]) for name, unit in rule.tolerances if name not in shared}
    hits = rule.check(columns, **own, **shared)
    places = np.round(place_on(hits.where), 6)
    return repr(of_rows([hits.row, hits.other, places, np.round(hits.size, 6)], hits.row, count))


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_rules_end_on_every_specimen_and_say_the_same_of_the_sound(rule: Rule) -> None:
    make, good, fits = MADE[rule.subject]
    odd = {name: shape for name, shape in SPECIMENS.items() if fits(shape)}
    if rule.subject is Areas:
        odd = {name: shapely.force_2d(shape) for name, shape in odd.items()}
    with quiet():
        alone = found(rule, make(good), len(good))
        for name, shape in odd.items():
            found(rule, make([shape]), 1)
            assert found(rule, make([*good, shape]), len(good)) == alone, name
        assert found(rule, make([*good, *odd.values()]), len(good)) == alone


BROKEN = ("hole outside", "hole across", "holes nested", "one place", "NaN", "infinite")
SOUND = ("square", "with a hole", "with an empty hole", "bow-tie", "repeated vertices", "far", "beyond all")


@pytest.mark.parametrize(("name", "depth"), [*product(RINGS, DEPTHS)])
def test_what_is_broken_is_broken_at_every_depth(name: str, depth: str) -> None:
    shape = SPECIMENS[f"area {name}, {depth}"]
    told = invalid_geometries(array(shape))
    if depth == "infinite" or shape is None or name.startswith(BROKEN):
        assert told.row.tolist() == [0]
    elif name in SOUND:
        assert told.row.tolist() == []
    if name == "hole outside":
        place = shapely.get_coordinates(told.place) - OFFSET
        assert place.tolist() in ([[20.0, 20.0]], [[21.0, 20.0]], [[21.0, 21.0]], [])
