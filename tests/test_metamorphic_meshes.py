# SPDX-License-Identifier: MIT
"""Writing a mesh in another order, moving or turning it changes no finding, for every rule over meshes.

The meshes are the rules' own cases, and larger ones with planted faults.
"""

from functools import cache
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import pytest
from tests.mesh.changes import CHANGES, MOVES, ORDERS, Change, reversed_faces, survives
from tests.mesh.files import mesh
from tests.mesh.known import marks
from tests.mesh.made import box, sphere, turn
from tests.mesh.parts import cut, joined, part_of, profile
from tests.mesh.planted import bases, planted
from tests.mesh.spots import lie_together
from tests.rule_cases import MeshCase, mesh_cases

from foparq.check.run import Checked, check_part
from foparq.columns import union
from foparq.findings.hits import Hits
from foparq.model.mesh import Mesh

NEAR = 1e-8  #: metres: what coordinates are rounded to in a national grid, with room
#: rules whose answer is exact on the coordinates as they are: rounding them makes another surface
EXACT = frozenset({"MSH003", "MSH022", "MSH023"})
#: rules that tell many faces by the first of them by x, then y, then z: another one in a turned mesh
BY_ONE_OF_MANY = frozenset({"MSH014", "MSH015"})
#: meshes of which several lines are equally long: the first by x, then y, then z is named
TIED = frozenset({"boxes that cross", "boxes that cross, rounded", "a tube, and nobody states it"})
TELL_LINES = frozenset({"MSH010", "MSH011", "MSH022"})


def crossed(*columns: Any) -> list[Any]:
    """Every combination of rule, change and mesh, but those that rounding decides."""
    return [
        pytest.param(*of, id="-".join(of), marks=marks("-".join(of)))
        for of in product(*columns)
        if of[0] not in EXACT or survives(larger()[of[2]], CHANGES[of[1]])
    ]


class Found(NamedTuple):
    """A hit, with its place brought back to where it was."""

    size: float
    place: Any


def found(hits: Hits, change: Change | None = None) -> list[Found]:
    places = change.back(hits.where) if change and len(hits) else hits.where
    return [Found(*of) for of in zip(hits.size.tolist(), places, strict=True)]


def missed(before: list[Found], after: list[Found]) -> list[Found]:
    """What was found before and has no counterpart after."""
    left, lost = list(after), []
    for hit in before:
        same = (
            n for n, other in enumerate(left)
            if hit.size == pytest.approx(other.size, rel=1e-6, abs=NEAR) and lie_together(hit.place, other.place, NEAR)
        )  # fmt: skip
        partner = next(same, None)
        if partner is None:
            lost.append(hit)
        else:
            del left[partner]
    return lost


def pairs() -> list[Any]:
    """Every case with every change, but those that rounding decides."""
    made = []
    for of in mesh_cases():
        (case,) = of.values
        for name, change in CHANGES.items():
            if case.exact and change.moves and not survives(case.part, change):
                continue
            known = of.marks or marks(f"{of.id}-{name}")
            made.append(pytest.param(case, change, id=f"{of.id}-{name}", marks=known))
    return made


@pytest.mark.parametrize(("case", "change"), pairs())
def test_findings_stay(case: MeshCase, change: Change) -> None:
    before, after = case.run(), case.run(case.seen(change.forth(case.part)))
    if change.reverses and case.reverse is not None:
        # A closed piece that looked inward looks outward, and the other way round.
        assert len(after) == case.reverse
        return
    assert len(after) == len(before)
    assert len(union(after.row, after.also)) == len(union(before.row, before.also))
    if (case.tie and (change.reorders or change.moves)) or (case.rule.code in BY_ONE_OF_MANY and change.moves):
        assert sorted(after.size) == pytest.approx(sorted(before.size))
        return
    lost = missed(found(before), found(after, change))
    assert not lost, f"found instead: {found(after, change)}"


# --- larger meshes, as users get them -------------------------------------------------------------------------------


@cache
def larger() -> dict[str, Mesh]:
    """Meshes with many faults, in parts of a delivery."""
    made = {}
    for name in bases():
        for seed in (0, 1):
            of = planted(name, each=2, seed=seed)
            made[f"{name} {seed}"] = part_of(of.mesh, closed=of.closed)
    half = cut(box(2))
    ball = sphere(2)
    # Two cubes have a cube in common: the lines along its edges are alike, but for rounding where they are thirds.
    for name, step in (("boxes that cross", 0.25), ("boxes that cross, rounded", 1 / 3)):
        made[name] = part_of(joined([half, mesh(half.points + step, half.lists())]), closed=True)
    made["spheres that cross"] = part_of(joined([ball, mesh(ball.points @ turn(1).T + (0.5, 0.1, 0.2), ball.lists())]))
    made["a tube, and nobody states it"] = part_of(
        mesh(half.points, [face for face in half.lists() if np.ptp(half.points[face, 2]) > 0])
    )
    return made


@cache
def looked_at(name: str, change: str) -> Checked:
    part = larger()[name]
    checked = check_part(CHANGES[change].forth(part) if change else part, profile(), 50)
    assert not checked.log
    return checked


RULES = sorted({of.values[0].rule.code for of in mesh_cases()})


def numbers(checked: Checked, rule: str) -> dict[str, tuple[float, ...]]:
    """What rates are made of."""
    return {
        outcome.scope: (outcome.found, outcome.checked, len(outcome.faulty))
        for outcome in checked.outcomes if outcome.rule == rule
    }  # fmt: skip


@pytest.mark.parametrize(("rule", "change", "name"), crossed(RULES, ORDERS, larger()))
def test_keys_stay_in_another_order(rule: str, change: str, name: str) -> None:
    before, after = looked_at(name, ""), looked_at(name, change)
    assert numbers(after, rule) == numbers(before, rule)
    keys = [sorted(one.findings.key[one.findings.rule == rule]) for one in (before, after)]
    assert keys[0] == keys[1]


@pytest.mark.parametrize(("rule", "change", "name"), crossed(RULES, MOVES, larger()))
def test_findings_stay_elsewhere(rule: str, change: str, name: str) -> None:
    before, after = looked_at(name, ""), looked_at(name, change)
    assert numbers(after, rule) == numbers(before, rule)
    rows = [one.findings.rule == rule for one in (before, after)]
    if rule in BY_ONE_OF_MANY or (rule in TELL_LINES and name in TIED):
        sizes = [sorted(one.findings.size[row]) for one, row in zip((before, after), rows, strict=True)]
        assert sizes[1] == pytest.approx(sizes[0])
        return
    here = [Found(*of) for of in zip(before.findings.size[rows[0]], before.findings.where[rows[0]], strict=True)]
    there = MOVES[change].back(after.findings.where[rows[1]])
    assert not missed(here, [Found(*of) for of in zip(after.findings.size[rows[1]], there, strict=True)])


@pytest.mark.parametrize("name", larger())
def test_a_surface_inside_out_has_the_same_faults(name: str) -> None:
    before, after = looked_at(name, ""), check_part(reversed_faces(larger()[name]), profile(), 50)
    for rule in RULES:
        # Which closed pieces look inward is another matter.
        if rule != "MSH014":
            assert numbers(after, rule) == numbers(before, rule)
