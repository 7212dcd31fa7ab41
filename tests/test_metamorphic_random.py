# SPDX-License-Identifier: MIT
"""Moving, turning, reversing or reordering a large drawing changes no finding, for every rule over geometry.

Drawings are seeded and random, on a millimetre grid, with faults of many kinds planted in them. A rule whose fault they
do not show is looked after by its own cases: ``test_metamorphic.py``.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from tests.changes import CHANGES
from tests.rule_cases import common

from foparq.check.registry import all_rules
from foparq.check.rule import Rule
from foparq.columns import Coordinates, Geometries
from foparq.findings.hits import NOBODY, Hits
from foparq.findings.table import finding_keys
from foparq.model.inputs import Areas, Features, Lines, Named, areas_of, features_of, lines_of

RULES = [rule for rule in all_rules().values() if rule.subject in {Lines, Areas, Features}]
# No two places of the grid are exactly this far apart, and no two areas this large.
TOLERANCES = {"coincide": 0.0004, "reach": 0.0103, "least": 1.23e-5, "most": 0.01234}
#: for tolerances of other names, by unit: no distance of the millimetre grid equals it
OFF_GRID = {"m": 0.0203, "m2": 0.00123, "1": 0.1234, "items": 3.0}


def linework(seed: int) -> list[Any]:
    """Random walks over a square of 0.4 m, some of them at a depth of 0.3 m, with planted faults."""
    rng = np.random.default_rng(seed)
    walks: list[Coordinates] = []
    for _ in range(60):
        flat = np.cumsum(np.vstack([rng.integers(0, 400, 2), rng.integers(-60, 60, (rng.integers(1, 7), 2))]), axis=0)
        flat = flat[np.concatenate([[True], np.any(np.diff(flat, axis=0) != 0, axis=1)])]
        walks.append(np.column_stack([flat, np.full(len(flat), 300 * (rng.random() < 0.2))]) / 1000)
    walks = [walk for walk in walks if len(walk) > 1]
    planted = []
    for host in rng.permutation(len(walks))[:30]:
        start, end = walks[host][:2]
        aside = np.array([start[1] - end[1], end[0] - start[0], 0])
        middle, unit = (start + end) / 2, aside / np.linalg.norm(aside)
        planted.append(np.array([middle + unit * rng.choice([-0.004, 0.0, 0.0002, 0.006]), middle + unit * 0.05]))
    planted += [walks[n][::-1] for n in (1, 4, 9)]
    planted += [walks[n][:2] for n in (2, 5)]
    planted += [np.insert(walks[n], 1, walks[n][1] + [0.0002, 0, 0], axis=0) for n in (3, 6)]
    planted += [np.array([[0.5, 0.5, 0], [0.5, 0.5001, 0]]), np.array([[1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 0.005, 0]])]
    planted += [np.array([[3, 0, 0], [5, 0, 0], [4, 0, 0]]), np.array([[6, 0, 0], [7, 0, 0], [7, 1, 0], [6, 0, 0]])]
    planted += [np.array([[7, 0, 0], [7, 1, 0], [6, 0, 0], [7, 0, 0]])]
    return [shapely.LineString(walk) for walk in (*walks, *planted)]


def coverage(seed: int) -> list[Any]:
    """Plots of a grid with corners moved by some millimetres each for itself, so that they overlap and gape."""
    rng = np.random.default_rng(seed)
    plots = []
    for x in range(6):
        for y in range(6):
            corners = np.array([[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]])
            moved = corners * 100 + rng.choice([0, 0, 0, -3, 4], (4, 2))
            plots.append(shapely.Polygon(moved / 1000))
    return plots


def shapes(seed: int) -> list[Any]:
    """Sound areas, and one of every way to be broken."""
    broken = [
        None, shapely.Polygon(), "LINESTRING (0 0, NaN 1)",
        "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (20 20, 21 20, 21 21, 20 20))",
        "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (3 1, 6 1, 6 2, 3 2, 3 1))", "POLYGON ((0 0, 1 1, 0 0, 0 0))",
        "POLYGON ((0 0, 4 0, 8 0, 8 8, 4 8, 0 8, 0 0), (4 0, 2 4, 4 8, 6 4, 4 0))",
        "POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))",
        "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0)), ((2 2, 6 2, 6 6, 2 6, 2 2)))",
    ]  # fmt: skip
    with np.errstate(invalid="ignore"):
        return [*coverage(seed), *[shapely.from_wkt(shape) if isinstance(shape, str) else shape for shape in broken]]


MAKERS: dict[type, tuple[Callable[[int], list[Any]], Callable[[Any], Any]]] = {
    Lines: (linework, lines_of),
    Areas: (coverage, areas_of),
    Features: (shapes, features_of),
}


MOVES = ("shifted", "turned", "turned and shifted", "reversed")


def given(rule: Rule, seed: int) -> Any:
    draw, make = MAKERS[rule.subject]
    return make(draw(seed))


def run(rule: Rule, columns: Any) -> Hits:
    tolerances = {name: TOLERANCES.get(name, OFF_GRID.get(unit, 0.0)) for name, unit in rule.tolerances} | common(rule)
    with np.errstate(invalid="ignore"):
        return rule.check(columns, **tolerances)


def keys(rule: Rule, columns: Named, hits: Hits, back: Callable[[Geometries], Geometries]) -> list[str]:
    """Keys of the findings, with the place brought back to where it was drawn."""
    place = np.full((len(hits), 3), np.nan)
    named = ~shapely.is_empty(hits.where)
    # Off the grid, so that no place lies on the border of two cells of rounding.
    place[named, :2] = shapely.get_coordinates(shapely.centroid(back(hits.where[named]))) + 0.00037
    layer, item = columns.layer[hits.row], columns.item[hits.row]
    other = np.array([columns.item[row] if row != NOBODY else "" for row in hits.other], dtype=object)
    return sorted(finding_keys(rule.code, layer, item, other, place, 0.001).tolist())


@pytest.mark.parametrize("subject", MAKERS, ids=lambda subject: subject.__name__)
def test_drawings_show_most_faults(subject: type) -> None:
    rules = [rule for rule in RULES if rule.subject is subject]
    shown = [rule.name for rule in rules if len(run(rule, given(rule, 0)))]
    assert len(shown) > len(rules) / 2, f"of {len(rules)} rules only {shown} find anything"


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("change", MOVES)
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_findings_stay(rule: Rule, change: str, seed: int) -> None:
    columns = given(rule, seed)
    changed = CHANGES[change].forth(columns)
    before, after = run(rule, columns), run(rule, changed)
    if rule.subject is Features and change.startswith("turned"):
        # Of the corners of one fault the first by x, then y, is named: another one in another frame.
        assert after.row.tolist() == before.row.tolist()
        return
    assert keys(rule, changed, after, CHANGES[change].back) == keys(rule, columns, before, lambda g: g)
    assert np.sort(after.size) == pytest.approx(np.sort(before.size), abs=1e-6)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_order_of_the_file_changes_nothing(rule: Rule, seed: int) -> None:
    columns = given(rule, seed)
    shuffled = columns.take(np.random.default_rng(seed).permutation(len(columns)))
    before, unordered = run(rule, columns), run(rule, shuffled)
    assert len(unordered) == len(before)
    # What audits files orders rows by item first.
    ordered = shuffled.take(np.argsort([int(item) for item in shuffled.item], kind="stable"))
    assert keys(rule, ordered, run(rule, ordered), lambda g: g) == keys(rule, columns, before, lambda g: g)
