# SPDX-License-Identifier: MIT
"""A mesh as the engine sees it: rows, names, places, two readings, and what one bad face changes."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.check.bounds import Budget, budget_of
from foparq.check.run import Checked, check_part
from foparq.check.subjects.mesh import MeshSubject, points_on
from foparq.findings.outcome import Outcome, Status
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh, MeshReading
from foparq.model.surface import Faces, Surface, Vertices
from foparq.profile.load import load_profile
from foparq.profile.schema import MeshSpec, Profile

METRE = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)
TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]


def mesh(points: list[tuple[float, float, float]], faces: list[tuple[int, ...]], **said: object) -> Mesh:
    stated = {"unit": METRE, "closed": True, **said}
    return Mesh(
        path="busto.ply", points=np.array(points, dtype=float).reshape(-1, 3),
        corners=np.array([corner for face in faces for corner in face], dtype=np.intp),
        starts=np.cumsum([0, *map(len, faces)]).astype(np.intp), group=np.zeros(len(faces), dtype=np.intp),
        groups=("",), reading=MeshReading(version="PLY"), **stated,  # type: ignore[arg-type]
    )  # fmt: skip


def profile(**changes: object) -> Profile:
    return load_profile("et-doc-foparq-b").model_copy(update=changes)


def found(checked: Checked) -> dict[str, int]:
    assert not checked.log
    return {outcome.name: outcome.found for outcome in checked.outcomes if outcome.found}


def outcome(checked: Checked, name: str) -> Outcome:
    return next(one for one in checked.outcomes if one.name == name)


def test_a_closed_tetrahedron_has_no_fault_and_every_rule_looked_at_its_four_faces() -> None:
    checked = check_part(mesh(CORNERS, TETRAHEDRON), profile(), None)
    assert found(checked) == {}
    assert {one.status for one in checked.outcomes} == {Status.CLEAN}
    assert {one.checked for one in checked.outcomes} == {4}


def test_a_missing_face_is_a_hole_where_the_surface_should_be_closed() -> None:
    checked = check_part(mesh(CORNERS, TETRAHEDRON[:3]), profile(), None)
    assert found(checked) == {"hole": 1}
    assert checked.findings.size.tolist() == [pytest.approx(0.5)]  # a right triangle of sides one
    assert outcome(checked, "hole").faulty.tolist() == [0, 1, 2]


def test_the_same_is_a_rim_where_nobody_states_it_and_nothing_where_it_should_end() -> None:
    assert found(check_part(mesh(CORNERS, TETRAHEDRON[:3], closed=None), profile(), None)) == {"open-rim": 1}
    assert found(check_part(mesh(CORNERS, TETRAHEDRON[:3], closed=False), profile(), None)) == {"stated-rim": 1}


def soup() -> Mesh:
    """The tetrahedron as an STL holds it: every face with corners of its own."""
    points = [CORNERS[corner] for face in TETRAHEDRON for corner in face]
    return mesh(points, [(3 * n, 3 * n + 1, 3 * n + 2) for n in range(4)])


def test_vertices_of_the_same_coordinates_are_one_and_the_other_reading_is_told_beside() -> None:
    checked = check_part(soup(), profile(), None)
    assert found(checked) == {"duplicate-vertex": 4}
    assert outcome(checked, "hole").otherwise == ("as-delivered", 4)
    assert outcome(checked, "isolated-component").otherwise == ("as-delivered", 0)
    assert outcome(checked, "duplicate-vertex").otherwise is None


def test_the_profile_says_which_reading_decides() -> None:
    checked = check_part(soup(), profile(mesh=MeshSpec(weld="none")), None)
    assert found(checked) == {"duplicate-vertex": 4, "hole": 4}
    assert outcome(checked, "hole").otherwise == ("welded", 0)


def test_nought_with_either_sign_is_the_same_coordinate() -> None:
    points = [*CORNERS, (-0.0, 0.0, -0.0)]
    checked = check_part(mesh(points, [(4, 2, 1), *TETRAHEDRON[1:]]), profile(), None)
    assert found(checked) == {"duplicate-vertex": 1}


def test_a_mesh_without_repeated_vertices_has_one_reading() -> None:
    assert {one.otherwise for one in check_part(mesh(CORNERS, TETRAHEDRON), profile(), None).outcomes} == {None}


def test_sizes_are_metres_and_in_units_of_the_file_where_nobody_knows_these() -> None:
    millimetres = DrawingUnit(metres=0.001, name="mm", origin=UnitOrigin.STATED)
    for unit, size, symbol in ((millimetres, 0.5e-6, "m2"), (replace(METRE, metres=None), 0.5, "u2")):
        findings = check_part(mesh(CORNERS, TETRAHEDRON[:3], unit=unit), profile(), None).findings
        assert findings.size.tolist() == [pytest.approx(size)]
        assert findings.unit.tolist() == [symbol]


BAD = {
    "a vertex without a place": ((0, 1, 4), "non-finite"),
    "a vertex that is not there": ((0, 1, 99), "bad-index"),
    "a vertex before the first": ((0, 1, -1), "bad-index"),
    "two corners": ((0, 1), "bad-index"),
    "no corner": ((), "bad-index"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_face_that_cannot_be_used_is_told_and_changes_nothing_else(kind: str) -> None:
    face, rule = BAD[kind]
    checked = check_part(mesh([*CORNERS, (np.nan, 0, 0)], [face, *TETRAHEDRON]), profile(), None)
    assert found(checked) == {rule: 1} | ({} if 4 in face else {"unreferenced-vertex": 1})
    assert outcome(checked, rule).faulty.tolist() == [0]
    assert checked.findings.item[checked.findings.name == rule].tolist() == ["f0"]
    others = [
        one for one in checked.outcomes if one.name in {"hole", "surface-self-intersection", "flipped-orientation"}
    ]
    assert all(one.status is Status.CLEAN and one.checked == 4 and one.skipped == 1 for one in others)
    assert [(one.item, one.rule, one.open) for one in others[0].aside] == [("f0", rule, False)]


def test_a_finding_is_known_by_its_place_not_by_numbers_that_any_program_changes() -> None:
    open_box = mesh(CORNERS, [(0, 2, 1), (0, 1, 3)])
    order = np.array([2, 0, 3, 1])
    renumbered = np.empty(4, dtype=np.intp)
    renumbered[order] = np.arange(4)
    other = mesh([CORNERS[n] for n in order], [tuple(renumbered[list(face)]) for face in [(1, 3, 0), (2, 1, 0)]])
    one, two = (check_part(part, profile(), None).findings for part in (open_box, other))
    assert one.key.tolist() == two.key.tolist()
    assert len(one) == 1


def test_groups_are_layers() -> None:
    two = replace(mesh(CORNERS, TETRAHEDRON), group=np.array([0, 0, 1, 1]), groups=("base", "topo"))
    subject = MeshSubject(two, profile())
    assert subject.take(Surface, ("topo",)).rows.row.tolist() == [2, 3]
    assert subject.alone(Surface, ("*",)) == [("base",), ("topo",)]
    assert subject.named(np.array([1, 2, 5]))[0].tolist() == ["f1", "f2", "v1"]
    assert subject.named(np.array([1, 2, 5]))[1].tolist() == ["base", "topo", ""]


def test_inputs_hold_what_the_file_holds() -> None:
    subject = MeshSubject(mesh([*CORNERS, (5, 5, 5)], [*TETRAHEDRON, (0, 7, 1)]), profile())
    faces, vertices = subject.take(Faces, ("*",)).rows, subject.take(Vertices, ("*",)).rows
    assert isinstance(faces, Faces)
    assert isinstance(vertices, Vertices)
    assert faces.absent.tolist() == [0, 0, 0, 0, 1]
    assert faces.place[4].tolist() == [0, 0, 0]
    assert vertices.used.tolist() == [True, True, True, True, False]
    assert vertices.row.tolist() == [5, 6, 7, 8, 9]
    taken = subject.take(Surface, ("*",))
    assert (taken.rows.row.tolist(), taken.unfit.tolist()) == ([0, 1, 2, 3], [4])


@pytest.mark.parametrize("shift", [(0, 0, 0), (712345.678, 7456789.123, 812.5)])
def test_the_point_of_a_place_lies_on_it_whichever_way_it_faces(shift: tuple[float, float, float]) -> None:
    upright = np.array([(0, 0, 0), (2, 0, 0), (0, 0, 1)]) + shift
    where = np.array([
        shapely.polygons(upright), shapely.linestrings(upright[:2]), shapely.points(upright[1]),
        shapely.linestrings(upright), shapely.from_wkt("POINT EMPTY"),
    ])  # fmt: skip
    points = points_on(where) - shift
    assert points[:4] == pytest.approx(np.array([(2 / 3, 0, 1 / 3), (1, 0, 0), (2, 0, 0), (0, 0, 0)]), abs=1e-9)
    assert np.isnan(points[4]).all()


def two_open_boxes() -> tuple[list[tuple[float, float, float]], list[tuple[int, ...]]]:
    """Two tetrahedra without a face each, of which the second is smaller."""
    points = [*CORNERS, *[(3 + x / 2, y / 2, z / 2) for x, y, z in CORNERS]]
    return points, [face for n in (0, 4) for face in [tuple(corner + n for corner in one) for one in TETRAHEDRON[:3]]]


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ({"closed": None}, {"open-rim": 2}),
        ({"closed": False}, {"open-rim": 1, "stated-rim": 1}),
        ({"closed": False, "rims": 2}, {"stated-rim": 2}),
        ({"closed": False, "rims": 1}, {"hole": 1, "stated-rim": 1}),
        ({"closed": True}, {"hole": 2}),
    ],
)
def test_one_rim_is_meant_unless_somebody_states_how_many(said: dict[str, object], told: dict[str, int]) -> None:
    checked = check_part(mesh(*two_open_boxes(), **said), profile(), None)
    assert found(checked) == told
    if set(told.values()) == {1}:
        # The rim of the larger one, near the origin, is what is meant.
        meant = checked.findings.name == "stated-rim"
        assert (checked.findings.place[:, 0] < 2).tolist() == meant.tolist()


def test_rules_on_a_large_mesh_may_use_memory_in_proportion_to_it() -> None:
    small, limits = mesh(CORNERS, TETRAHEDRON), profile().limits
    assert small.held == 4 * 3 * 8 + 12 * 8 + 5 * 8 + 4 * 8
    assert budget_of(small, limits, 0.0).memory == limits.check_memory + 6 * small.held


def test_what_rules_need_is_made_ready_outside_of_their_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiling takes longer than a rule may: it must not cost the first run on a machine its verdict."""
    order: list[str] = []
    monkeypatch.setattr(MeshSubject, "prepare", lambda: order.append("ready"))

    def bounded(function: Callable[..., Iterator[object]], args: tuple[Any, ...], _budget: Budget) -> Iterator[object]:
        order.append("rules")
        yield from function(*args)

    check_part(mesh(CORNERS, TETRAHEDRON), profile(), None, bounded=bounded)
    assert order == ["ready", "rules"]


def test_kernels_that_cannot_be_made_ready_are_told_and_cost_no_other_rule(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise ImportError("planted")

    monkeypatch.setattr(MeshSubject, "prepare", broken)
    checked = check_part(mesh(CORNERS, TETRAHEDRON), profile(), None)
    assert any("planted" in trace for trace in checked.log)
    assert outcome(checked, "hole").status is Status.CLEAN
