# SPDX-License-Identifier: MIT
"""The element of meshes: two shares, each mesh by itself, and what leaves it open."""

from dataclasses import replace

import numpy as np
import pytest

from foparq.check.run import check_part
from foparq.evaluate.evaluate import evaluate
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Element, ElementStatus
from foparq.findings.outcome import Outcome
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.drawing import DrawingUnit, Repair, UnitOrigin
from foparq.model.mesh import Mesh, MeshReading
from foparq.profile.load import load_profile

PROFILE = load_profile("et-doc-foparq-b")


def grid(columns: int, rows: int, *, size: float = 1.0, path: str = "fachada.ply", lost: int = 0) -> Mesh:
    """Plate of squares with a rim; the last faces name vertices that are not there."""
    across = columns + 1
    first = (np.arange(rows)[:, None] * across + np.arange(columns)).ravel()
    corners = np.stack([first, first + 1, first + 1 + across, first + across], axis=1)
    corners[len(corners) - lost :, 0] = 10**6
    x, y = np.meshgrid(np.arange(across) * size, np.arange(rows + 1) * size)
    return Mesh(
        path=path, points=np.stack([x.ravel(), np.zeros(x.size), y.ravel()], axis=1), corners=corners.ravel(),
        starts=np.arange(0, corners.size + 1, 4), group=np.zeros(len(corners), dtype=np.intp), groups=("",),
        reading=MeshReading(version="PLY"), closed=False,
        unit=DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED),
    )  # fmt: skip


def source(path: str, status: SourceStatus = SourceStatus.READ, role: str = "mesh") -> Source:
    return Source(path=path, role=role, sha256="0" * 64, bytes=1, status=status)


def elements(
    *meshes: Mesh, sources: tuple[Source, ...] = (), outcomes: tuple[Outcome, ...] | None = None
) -> dict[str, Element]:
    own = tuple(source(mesh.path) for mesh in meshes)
    made = tuple(one for mesh in meshes for one in check_part(mesh, PROFILE, 10.0).outcomes)
    delivery = Delivery(title="", sources=(*own, *sources), parts=meshes)
    evidence = Evidence(delivery=delivery, outcomes=made if outcomes is None else outcomes, counts=None, scale=10.0)
    evaluated = evaluate(PROFILE, evidence)
    assert not evaluated.log
    return {one.id: one for one in evaluated.quality.elements}


def messages(element: Element) -> list[str]:
    return [reason.message for reason in element.why]


def test_a_sound_mesh_passes_and_drawings_are_not_asked_for() -> None:
    found = elements(grid(4, 5))
    assert (found["Q3-mesh"].status, found["Q3-mesh"].value, found["Q3-mesh"].n) == (ElementStatus.PASS, 0.0, 20)
    assert {name: value for name, value, _ in found["Q3-mesh"].parameters}["area"] == pytest.approx(20)
    assert (found["Q3"].status, found["Q3"].required) == (ElementStatus.NOT_APPLICABLE, False)


def test_where_no_mesh_is_named_there_is_no_such_element() -> None:
    assert "Q3-mesh" not in elements(sources=(source("fachada.dxf", role="drawing"),))


@pytest.mark.parametrize(("lost", "status"), [(2, ElementStatus.UNDECIDED), (3, ElementStatus.FAIL)])
def test_faces_that_cannot_be_used_weigh_by_number_and_are_never_passed_over(lost: int, status: ElementStatus) -> None:
    # Of 20 faces two are one in ten. What cannot be used has no area that could speak for it.
    found = elements(grid(4, 5, lost=lost))["Q3-mesh"]
    assert (found.value, found.status) == (pytest.approx(lost / 20), status)
    assert ("surface.unusable" in messages(found)) == (status is ElementStatus.UNDECIDED)


def opened(mesh: Mesh, *holes: int) -> Mesh:
    """The plate without some of its faces."""
    kept = np.setdiff1d(np.arange(mesh.features), holes)
    return replace(
        mesh, corners=mesh.corners.reshape(-1, 4)[kept].ravel(), starts=np.arange(0, 4 * len(kept) + 1, 4),
        group=mesh.group[kept],
    )  # fmt: skip


def test_an_opening_counts_with_the_faces_around_it_and_the_area_that_is_not_there() -> None:
    found = elements(opened(grid(10, 10), 55))["Q3-mesh"]
    said = {name: value for name, value, _ in found.parameters}
    assert (said["faulty"], said["checked"]) == (4, 99)
    assert (said["area-faulty"], said["area"]) == (pytest.approx(5), pytest.approx(100))
    assert (found.status, found.value) == (ElementStatus.PASS, pytest.approx(0.05))


@pytest.mark.parametrize(("holes", "status"), [((22, 77), ElementStatus.PASS), ((22, 55, 77), ElementStatus.FAIL)])
def test_the_share_may_reach_the_limit(holes: tuple[int, ...], status: ElementStatus) -> None:
    # Of 100 squares each hole takes its own and the four around it.
    found = elements(opened(grid(10, 10), *holes))["Q3-mesh"]
    assert (found.value, found.status) == (pytest.approx(0.05 * len(holes)), status)


def test_a_unit_against_that_of_the_format_leaves_it_open_until_somebody_answers_for_it() -> None:
    stated = DrawingUnit(metres=0.001, name="mm", origin=UnitOrigin.STATED, header="m", header_metres=1.0)
    found = elements(replace(grid(4, 5), unit=stated))["Q3-mesh"]
    assert (found.status, messages(found)[0]) == (ElementStatus.UNDECIDED, "surface.unit")
    confirmed = replace(grid(4, 5), unit=stated, confirmed=frozenset({"unit"}))
    assert elements(confirmed)["Q3-mesh"].status is ElementStatus.PASS


def test_an_acceptance_says_on_whose_word_the_surface_ends_and_that_its_place_was_not_compared() -> None:
    assert messages(elements(grid(4, 5))["Q3-mesh"]) == [
        "surface.pass", "surface.stated-rims", "surface.not-compared",
    ]  # fmt: skip


def test_both_shares_beyond_the_limit_reject() -> None:
    found = elements(opened(grid(5, 5), 12))["Q3-mesh"]
    assert (found.status, found.value) == (ElementStatus.FAIL, pytest.approx(5 / 25))
    assert messages(found)[0] == "surface.fail"


def test_many_tiny_faces_do_not_dilute_an_opening() -> None:
    """The same plate with a hole, and beside it 2,500 faces of a millimetre: the shares disagree."""
    plate, dust = opened(grid(5, 5), 12), grid(50, 50, size=0.001)
    both = replace(
        plate, points=np.concatenate([plate.points, dust.points + 100]),
        corners=np.concatenate([plate.corners, dust.corners + len(plate.points)]),
        starts=np.arange(0, 4 * (24 + 2500) + 1, 4), group=np.zeros(24 + 2500, dtype=np.intp),
    )  # fmt: skip
    found = elements(both)["Q3-mesh"]
    assert found.status is ElementStatus.UNDECIDED
    assert "surface.one-share" in messages(found)
    assert found.value is not None
    assert found.value > 0.1


def test_a_good_mesh_does_not_make_up_for_a_bad_one() -> None:
    good, bad = grid(50, 50, path="a.ply"), opened(grid(5, 5, path="b.ply"), 12)
    assert elements(good, bad)["Q3-mesh"].status is ElementStatus.FAIL


def test_a_rim_that_nobody_speaks_of_leaves_it_open() -> None:
    found = elements(replace(grid(4, 5), closed=None))["Q3-mesh"]
    assert (found.status, messages(found)[0]) == (ElementStatus.UNDECIDED, "surface.open-rim")


def test_a_lost_mesh_and_one_that_had_to_be_mended_leave_it_open() -> None:
    lost = elements(grid(4, 5), sources=(source("b.ply", SourceStatus.REFUSED),))["Q3-mesh"]
    assert (lost.status, messages(lost)[0]) == (ElementStatus.UNDECIDED, "unseen.mesh")
    mended = replace(grid(4, 5), reading=MeshReading(version="PLY", repairs=(Repair(code="mesh-other"),)))
    assert messages(elements(mended)["Q3-mesh"])[0] == "unseen.repaired"
    none = elements(sources=(source("b.ply", SourceStatus.REFUSED),))["Q3-mesh"]
    assert (none.status, none.required) == (ElementStatus.NOT_ASSESSED, True)


def test_a_rule_that_is_no_part_of_the_audit_leaves_it_unassessed() -> None:
    mesh = grid(4, 5)
    some = tuple(one for one in check_part(mesh, PROFILE, 10.0).outcomes if one.name != "hole")
    assert elements(mesh, outcomes=some)["Q3-mesh"].status is ElementStatus.NOT_ASSESSED
