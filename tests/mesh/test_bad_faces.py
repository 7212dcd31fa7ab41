# SPDX-License-Identifier: MIT
"""A face that cannot be used changes nothing of what is said of the others."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.mesh.known import marks
from tests.mesh.parts import part_of, profile
from tests.mesh.planted import bases, planted
from tests.rule_cases import MeshCase, mesh_cases

from foparq.check.run import Checked, check_part
from foparq.findings.hits import NOBODY
from foparq.model.mesh import Mesh

ABSENT = 10**6  #: no mesh here has so many vertices
PLACELESS = [[4321.0, np.nan, 8765.0]]
AWAY = [[5000.0, 1.0, 2.0], [5001.0, 1.0, 2.0]]


def with_face(part: Mesh, face: list[int], points: list[list[float]], *, first: bool) -> Mesh:
    """The mesh with one face more, before all others or behind them; new vertices come last."""
    corners = np.array(face, dtype=np.intp)
    count, vertices = len(face), len(part.points)
    # What was no vertex stays none.
    old = np.where(part.corners < vertices, part.corners, part.corners + len(points))
    group = np.concatenate([part.group, [0]])
    points = np.concatenate([part.points, np.array(points, dtype=float).reshape(-1, 3)])
    if first:
        starts = np.concatenate([[0], part.starts + count])
        return replace(part, points=points, corners=np.concatenate([corners, old]), starts=starts, group=group)
    starts = np.append(part.starts, part.starts[-1] + count)
    return replace(part, points=points, corners=np.concatenate([old, corners]), starts=starts, group=group)


def _ends(part: Mesh) -> list[int]:
    """Two vertices that the first face uses."""
    return part.corners[part.there][:2].tolist()


#: what is wrong with the face, and whether it stands among the others
BAD: dict[str, Callable[[Mesh], tuple[list[int], list[list[float]]]]] = {
    "no place, away": lambda part: ([len(part.points) + n for n in range(3)], AWAY + PLACELESS),
    "no vertex, away": lambda part: ([len(part.points), len(part.points) + 1, ABSENT], AWAY),
    "two corners, away": lambda part: ([len(part.points), len(part.points) + 1], AWAY),
    "no place, here": lambda part: ([*_ends(part), len(part.points)], PLACELESS),
    "no vertex, here": lambda part: ([*_ends(part), ABSENT], []),
    "two corners, here": lambda part: (_ends(part), []),
    "no corner": lambda _: ([], []),
}


def told(case: MeshCase, part: Mesh, *, added: int | None = None) -> list[Any]:
    """Hits on all faces but the added one, by their numbers without it."""
    columns = case.seen(part)
    hits = case.run(columns)
    names = _names(part, added)
    found = []
    for row, other, size, where in zip(hits.row, hits.other, hits.size, hits.where, strict=True):
        item = names(columns.row[row])
        if item is not None:
            found.append((item, None if other == NOBODY else names(columns.row[other]), size, where.wkt))
    return [*found, sorted({names(row) for row in columns.row[hits.also].tolist()})]


def _names(part: Mesh, added: int | None) -> Callable[[int], Any]:
    """Names of rows as they are without the added face, which has none."""

    def name(row: int) -> Any:
        if row >= part.features:
            return ("v", int(row) - part.features)
        if row == added:
            return None
        return ("f", int(row) - (added is not None and row > added))

    return name


def pairs() -> list[Any]:
    """Every case with every bad face; where there is no face, none stands among the others."""
    return [
        pytest.param(case, bad, id=f"{of.id}-{bad}", marks=of.marks or marks(f"{of.id}-{bad}"))
        for of in mesh_cases() for case in of.values for bad in BAD
        if "here" not in bad or len(_ends(case.part)) > 1
    ]  # fmt: skip


@pytest.mark.parametrize("first", [False, True], ids=["last", "first"])
@pytest.mark.parametrize(("case", "bad"), pairs())
def test_cases_stay(case: MeshCase, bad: str, first: bool) -> None:  # noqa: FBT001 - a parameter
    face, points = BAD[bad](case.part)
    added = 0 if first else case.part.features
    assert told(case, with_face(case.part, face, points, first=first), added=added) == told(case, case.part)


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("name", bases())
def test_audits_stay(name: str, bad: str) -> None:
    made = planted(name, each=1, seed=7)
    part = part_of(made.mesh, closed=made.closed)
    face, points = BAD[bad](part)
    before = check_part(part, profile(), 50)
    after = check_part(with_face(part, face, points, first=False), profile(), 50)
    assert not before.log + after.log
    code = "MSH002" if "place" in bad else "MSH001"
    assert _found(after) == {rule: n + (rule == code) for rule, n in _found(before).items()}
    assert _keys(after, code) == _keys(before, code)
    told_before, told_after = (_judged(one) for one in (before, after))
    for rule, (checked, faulty) in told_before.items():
        if rule not in {"MSH001", "MSH002", "MSH016", "MSH017"}:
            # It is no face of the surface, and stands in no rate of it.
            assert told_after[rule] == (checked, faulty)


def _found(checked: Checked) -> dict[str, int]:
    return {outcome.rule: outcome.found for outcome in checked.outcomes}


def _keys(checked: Checked, but: str) -> list[str]:
    table = checked.findings
    return sorted(table.key[table.rule != but].tolist())


def _judged(checked: Checked) -> dict[str, tuple[int, int]]:
    return {outcome.rule: (outcome.checked, len(outcome.faulty)) for outcome in checked.outcomes}
