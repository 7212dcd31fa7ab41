# SPDX-License-Identifier: MIT
"""Moving, turning, redrawing or reordering a drawing changes no finding, for every rule over geometry.

The drawings are the rule's own cases; those that are seeded and random are in ``test_metamorphic_random.py``.
"""

from typing import Any, NamedTuple

import pytest
import shapely
from tests.changes import CHANGES, Change
from tests.rule_cases import Case, geometry_cases

from foparq.columns import Geometries
from foparq.findings.hits import NOBODY, Hits
from foparq.model.inputs import Features, Lines, Named

SAME = 1e-6  #: metres: what rounding at UTM size may move a place by, with room
NOTHING = "nothing"  #: in the place of a second item


class Found(NamedTuple):
    """A hit, named by the items and the place as they were drawn."""

    item: str
    other: str
    size: float
    place: Any


def found(columns: Named, hits: Hits, change: Change | None = None) -> list[Found]:
    places: Geometries = change.back(hits.where) if change and len(hits) else hits.where
    items = [NOTHING if row == NOBODY else columns.item[row] for row in hits.other]
    return [Found(*of) for of in zip(columns.item[hits.row], items, hits.size, places, strict=True)]


def lie_together(one: Any, two: Any, within: float) -> bool:
    if one.is_empty or two.is_empty:
        return bool(one.is_empty and two.is_empty)
    if one.area:
        # What differs is no more than a strip along the boundary.
        return bool(one.symmetric_difference(two).area <= within * one.length)
    return bool(shapely.hausdorff_distance(one, two) <= within)


def groups(hits: list[Found]) -> dict[str, set[str]]:
    """Items that hits join, each with all those it is joined to, also by way of others."""
    group: dict[str, set[str]] = {}
    for hit in hits:
        if hit.other != NOTHING:
            joined = group.get(hit.item, {hit.item}) | group.get(hit.other, {hit.other})
            group.update(dict.fromkeys(joined, joined))
    return group


def match(case: Case, change: Change, before: list[Found], after: list[Found]) -> list[Found]:
    """What was found before and has no counterpart after."""
    within = SAME if not (change.rounds or change.redraws) else SAME + case.tolerances.get("coincide", 0.0)
    tied = case.tie and change.turns
    # GEOS names one corner of a fault of many.
    placeless = case.rule.subject is Features or tied
    group = groups(before)

    def same(one: Found, two: Found) -> bool:
        if one.size != pytest.approx(two.size, abs=SAME):
            return False
        there = placeless or lie_together(one.place, two.place, within)
        if (change.reorders or tied) and NOTHING not in (one.other, two.other):
            # One of equals is named: other rows of the same group, or the same place between others.
            return there or two.item in group[one.item]
        return there and (one.item, one.other) == (two.item, two.other)

    left, lost = list(after), []
    for hit in before:
        partner = next((n for n, other in enumerate(left) if same(hit, other)), None)
        if partner is None:
            lost.append(hit)
        else:
            del left[partner]
    return lost


def pairs() -> list[Any]:
    """Every case with every change, but those that rounding decides."""
    made = []
    for of in geometry_cases():
        (case,) = of.values
        # Polygons meet exactly, or do not once they are rounded; lines have a slack for that.
        exact = "exactly" in case.name and case.rule.subject is not Lines
        made += [
            pytest.param(case, change, id=f"{of.id}-{name}")
            for name, change in CHANGES.items()
            if not (exact and change.rounds)
        ]
    return made


@pytest.mark.parametrize(("case", "change"), pairs())
def test_findings_stay(case: Case, change: Change) -> None:
    changed = change.forth(case.given)
    before, after = found(case.given, case.run()), found(changed, case.run(changed), change)
    assert len(after) == len(before)
    assert not match(case, change, before, after), f"found instead: {after}"
