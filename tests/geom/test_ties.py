# SPDX-License-Identifier: MIT
"""Where pieces, neighbours or places tie, the shape decides: not the way of drawing, nor order or names.

Drawings on a coarse grid are full of ties.
"""

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from tests.rule_cases import common

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.findings.hits import NOBODY
from foparq.findings.table import finding_keys
from foparq.geom import boxtree, duplicates, runtree
from foparq.geom.overlaps import line_overlaps
from foparq.geom.places import place_on
from foparq.geom.polylines import Polylines
from foparq.model.inputs import Areas, Features, Lines, areas_of, features_of, lines_of
from foparq.model.layers import bonds

Drawing = list[Any]
TOLERANCES = {"coincide": 0.0004, "reach": 0.0103, "least": 1.23e-5, "most": 0.01234}
BY_UNIT = {"m": 0.0203, "m2": 0.00123, "1": 0.1234, "items": 3.0}
RULES = [rule for rule in all_rules().values() if rule.subject in {Lines, Areas, Features}]


def layered(drawing: "Drawing") -> Lines:
    """Lines on three layers: rings, and others by their lengths, which no way of drawing changes."""
    made = lines_of(drawing)
    steps = np.round(shapely.length(made.geometry) / 0.004).astype(int)
    layer = np.where(shapely.is_closed(made.geometry), "RINGS", np.where(steps % 2, "ODD", "EVEN")).astype(object)
    return replace(made, layer=layer, bond=bonds(layer, {}, ()))


MADE = {Lines: layered, Areas: areas_of, Features: features_of}


def linework(rng: np.random.Generator) -> Drawing:
    """Short walks on a grid of 4 mm: most ends have several nearest neighbours, most lines a twin of equal length."""
    walks = []
    while len(walks) < 40:
        way = np.vstack([rng.integers(0, 12, 2), rng.choice([-2, -1, 0, 0, 1, 2], (rng.integers(1, 6), 2))]).cumsum(
            axis=0
        )
        way = way[np.concatenate([[True], np.any(np.diff(way, axis=0) != 0, axis=1)])]
        if len(way) > 1:
            walks.append(shapely.LineString(way * 0.004))
    rings = [
        shapely.LineString(shapely.box(x, y, x + 0.008, y + 0.008).exterior)
        for x, y in rng.integers(0, 12, (4, 2)) * 0.004
    ]
    crumbs = [
        shapely.LineString([(x, y), (x + 0.0002, y), (x + 0.0003, y)]) for x, y in rng.integers(0, 12, (3, 2)) * 0.004
    ]
    doubled = [shapely.LineString([(x, y), (x, y), (x + 0.004, y)]) for x, y in rng.integers(0, 12, (3, 2)) * 0.004]
    gaps = [
        shapely.LineString([(x, y), (x + 0.04, y), (x + 0.04, y + 0.04), (x, y + 0.004)])
        for x, y in rng.integers(0, 12, (2, 2)) * 0.004
    ]
    lone = shapely.LineString([(1, 1), (2, 1)])
    dashes = [shapely.LineString([(1 + 0.028 * n, 2), (1.02 + 0.028 * n, 2)]) for n in range(7)]
    bars = [shapely.LineString([(1, y), (2, y)]) for y in (3, 4)] + [shapely.LineString([(2.02, 2), (2.02, 6)])]
    stones = [shapely.LineString(shapely.box(x, y, x + 0.3, y + 0.2).exterior) for x in (3, 3.3) for y in (0, 0.2, 0.4)]
    return [*walks, *rings, *crumbs, *doubled, *gaps, lone, *dashes, *bars, *stones, walks[0], walks[1]]


def areas(rng: np.random.Generator) -> Drawing:
    """Boxes of a grid of 8 mm, equal in size, some moved by a part of it, so that they overlap and enclose gaps."""
    corners = np.stack(np.meshgrid(np.arange(6), np.arange(6)), axis=-1).reshape(-1, 2) * 0.032
    corners = corners + rng.choice([0, 0, 0, 0.008, -0.008], corners.shape)
    pinwheel = [(2.0, 0.008), (2.008, 0.04), (2.04, 0.032), (2.032, 0.0)]  # four around a gap of 8 mm
    return [shapely.box(x, y, x + 0.032, y + 0.032) for x, y in (*corners, *pinwheel)]


def broken(rng: np.random.Generator) -> Drawing:
    """Areas with holes outside or across."""
    found = areas(rng)[:4]
    for x, y in rng.integers(0, 9, (8, 2)) * 0.5:
        shell = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]) + np.array([x, y])
        found.append(shapely.Polygon(shell, [shell[:4] + np.array([rng.choice([2.0, 0.5]), 0.5])]))
    return found


DRAWN = {Lines: linework, Areas: areas, Features: broken}


def backwards(shape: Any, rng: np.random.Generator) -> Any:
    """The same shape: drawn the other way, a ring from another vertex."""
    if shape.geom_type == "Polygon":
        shell, *holes = (_turned(ring, rng) for ring in shapely.get_rings(shape))
        return shapely.Polygon(shell, holes)
    return _turned(shape, rng) if shape.is_ring else shapely.reverse(shape)


def _turned(ring: Any, rng: np.random.Generator) -> Any:
    way = np.roll(shapely.get_coordinates(ring)[:-1], rng.integers(9), axis=0)[:: rng.choice([-1, 1])]
    return shapely.LineString(np.vstack([way, way[:1]]))


def said(rule: Rule, drawing: Drawing) -> Counter[tuple[Any, ...]]:
    """Findings with items named by their shape: equal shapes may stand for each other."""
    columns = MADE[rule.subject](drawing)
    hits = rule.check(
        columns,
        **common(rule)
        | {name: TOLERANCES.get(name, BY_UNIT[unit]) for name, unit in rule.tolerances if name not in common(rule)},
    )
    shape = [shapely.normalize(item).wkt for item in columns.geometry]
    nothing = np.full(len(hits), "", dtype=object)
    keys = finding_keys(rule.code, nothing, nothing, nothing, place_on(hits.where), 0.001)
    return Counter(
        (shape[row], shape[other] if other != NOBODY else "", key[:17], round(size, 7))
        for row, other, key, size in zip(hits.row.tolist(), hits.other.tolist(), keys, hits.size.tolist(), strict=True)
    )


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_way_of_drawing_and_order_change_nothing(rule: Rule, seed: int) -> None:
    rng = np.random.default_rng(seed)
    drawing = DRAWN[rule.subject](rng)
    before = said(rule, drawing)
    assert before, "a drawing without the fault shows nothing"
    assert said(rule, [backwards(shape, rng) for shape in drawing]) == before
    some = [backwards(shape, rng) if rng.random() < 0.5 else shape for shape in drawing]
    assert said(rule, some) == before
    if rule.name != "duplicate":  # of equal lines the first one stays
        assert said(rule, [some[n] for n in rng.permutation(len(some))]) == before


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_a_right_angle_changes_no_count_and_no_size(rule: Rule, seed: int) -> None:
    rng = np.random.default_rng(seed)
    drawing = DRAWN[rule.subject](rng)
    turned = [shapely.transform(shape, lambda way: way[:, ::-1] * [-1, 1]) for shape in drawing]
    sizes = [Counter(size for *_, size in said(rule, shapes).elements()) for shapes in (drawing, turned)]
    assert sizes[0] == sizes[1]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("rule", [rule for rule in RULES if rule.subject is Lines], ids=lambda rule: rule.name)
def test_looking_in_small_steps_changes_nothing(rule: Rule, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    drawing = linework(np.random.default_rng(seed))
    before = said(rule, drawing)
    for module in (boxtree, runtree, duplicates):
        monkeypatch.setattr(module, "_CHUNK", 64)
    assert said(rule, drawing) == before


def comb(*, mirrored: bool) -> list[NDArray[np.float64]]:
    """A line that lies on a base in two pieces of equal length, each as near to an end of it as the other."""
    tooth = np.array([(1, 0), (2, 0), (2, 1), (6, 1), (6, 0), (7, 0)], dtype=float)
    return [np.array([(0, 0), (8, 0)], dtype=float), tooth[::-1] if mirrored else tooth]


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_comb_on_a_base_is_placed_on_its_left_tooth(*, mirrored: bool, swapped: bool) -> None:
    lines = comb(mirrored=mirrored)[:: -1 if swapped else 1]
    table = Polylines.of(np.array([shapely.LineString(way) for way in lines]))
    found = line_overlaps(table, np.zeros(2, dtype=bool), coincide=1e-4)
    assert found.length == pytest.approx([2.0])
    assert (found.start + found.end) / 2 + table.origin == pytest.approx(np.array([[1.5, 0]]))
