# SPDX-License-Identifier: MIT
"""Tables held against a box whose every distance is known."""

from dataclasses import replace

import numpy as np
import pytest

from foparq.check.surfaces.ground import SurfaceGround, surface_ground_of
from foparq.check.tables.distances import tie_distances
from foparq.check.tables.ground import Nearness
from foparq.check.tables.points import tie_points
from foparq.columns import Coordinates
from foparq.findings.ties import Ends, Lies
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh, MeshReading
from foparq.model.tables import Checkpoints, Distances

NEAR = Nearness(tie=0.001, apart=0.05, search=0.05, visible=0.01)
SIZE = np.array([2.0, 3.0, 4.0])
#: a place on each side of the box, in order
ON = np.array([[0, 1, 1], [2, 1, 1], [1, 0, 1], [1, 3, 1], [1, 1, 0], [1, 1, 4]], dtype=float)


def box(metres: float = 1.0, shift: Coordinates | None = None, *, unit: float | None = None, **said: object) -> Mesh:
    corner = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    points = (corner * SIZE + (0 if shift is None else shift)) / metres
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return mesh(points, sides, unit=unit or metres, **said)


def mesh(points: Coordinates, faces: list[tuple[int, ...]], *, unit: float | None = 1.0, **said: object) -> Mesh:
    return Mesh(
        path="busto.ply", points=points, corners=np.array([c for f in faces for c in f], dtype=np.intp),
        starts=np.cumsum([0, *map(len, faces)]).astype(np.intp), group=np.zeros(len(faces), dtype=np.intp),
        groups=("NARIZ",), reading=MeshReading(version="PLY"),
        unit=DrawingUnit(metres=unit, name="", origin=UnitOrigin.STATED), **said,  # type: ignore[arg-type]
    )  # fmt: skip


def ground(of: Mesh) -> SurfaceGround:
    found = surface_ground_of(of)
    assert found is not None
    return found


def texts(values: list[str]) -> np.ndarray:
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def points(delivered: Coordinates, surveyed: Coordinates | None = None, **changes: object) -> Checkpoints:
    made = Checkpoints(
        id=texts([f"V{n}" for n in range(len(delivered))]), delivered=delivered, resolution=np.zeros(3),
        surveyed=delivered if surveyed is None else surveyed, survey_sd=0.001,
    )  # fmt: skip
    return replace(made, **changes)  # type: ignore[arg-type]


def test_places_on_the_six_sides_lie_on_their_faces() -> None:
    ties = tie_points(points(ON), [ground(box())], NEAR)
    assert ties.lies.tolist() == [Lies.SURFACE] * 6
    assert ties.gap.max() <= 1e-12
    assert ties.item.tolist() == ["f0", "f1", "f2", "f3", "f4", "f5"]
    assert set(ties.layer) == {"NARIZ"}
    assert not ties.unchecked.any()


def test_a_corner_is_a_vertex_and_what_is_beside_is_absent_with_its_distance() -> None:
    asked = np.array([[0.0, 0, 0], [-0.5, 1, 1], [2.3, 3.4, 2.0], [1.0, 1.0, 1.0]])
    ties = tie_points(points(asked), [ground(box())], NEAR)
    assert ties.lies.tolist() == [Lies.VERTEX, Lies.ABSENT, Lies.ABSENT, Lies.ABSENT]
    assert ties.gap == pytest.approx([0.0, 0.5, 0.5, 1.0])


@pytest.mark.parametrize("shift", [np.zeros(3), np.array([712345.678, 7456789.123, 812.5])])
@pytest.mark.parametrize("metres", [1.0, 0.001, 0.0254])
def test_the_unit_and_large_coordinates_change_nothing(shift: np.ndarray, metres: float) -> None:
    outside = ON + np.array([0.0, 0.0, 0.02])
    ties = tie_points(points(outside + shift), [ground(box(metres, shift))], NEAR)
    assert ties.lies.tolist() == [Lies.SURFACE] * 4 + [Lies.ABSENT] * 2
    assert ties.gap[4:] == pytest.approx(0.02, abs=1e-8)


def test_digits_that_are_not_printed_are_allowed_along_their_axis_and_no_other() -> None:
    off = np.array([[2.004, 1, 1], [1, 3.004, 1], [1, 1, 4.004]])
    printed = np.array([0.0, 0.005, 0.0])
    ties = tie_points(points(off, printed=printed), [ground(box())], NEAR)
    assert ties.lies.tolist() == [Lies.ABSENT, Lies.SURFACE, Lies.ABSENT]


def test_the_tolerance_may_be_met_and_not_exceeded() -> None:
    off = np.array([[1, 1, 4 + 0.0009], [1, 1, 4 + 0.0011]])
    assert tie_points(points(off), [ground(box())], NEAR).lies.tolist() == [Lies.SURFACE, Lies.ABSENT]


def test_without_delivered_coordinates_the_nearest_place_is_taken_within_the_radius_of_search() -> None:
    surveyed = np.array([[1, 1, 4.03], [1, 1, 4.06]])
    ties = tie_points(points(np.full((2, 3), np.nan), surveyed), [ground(box())], NEAR)
    assert ties.lies.tolist() == [Lies.TAKEN_SURFACE, Lies.UNTOLD]
    assert ties.delivered[0] == pytest.approx([1, 1, 4])
    assert np.isnan(ties.delivered[1]).all()


def test_points_on_small_pieces_beside_the_surface_show_nothing() -> None:
    whole = box()
    disc = np.array([[5.0, 5, 5], [5.1, 5, 5], [5, 5.1, 5]])
    both = replace(
        whole, points=np.vstack([whole.points, disc]), corners=np.concatenate([whole.corners, [8, 9, 10]]),
        starts=np.append(whole.starts, len(whole.corners) + 3), group=np.zeros(7, dtype=np.intp),
    )  # fmt: skip
    on_disc = np.array([[5.01, 5.01, 5], [5.02, 5.01, 5], [5.01, 5.02, 5]])
    ties = tie_points(points(np.vstack([on_disc, ON[:1]])), [ground(both)], NEAR)
    assert ties.made.tolist() == [True, True, True, False]


@pytest.mark.parametrize(
    ("wrong", "kind", "factor"),
    [(ON[1::2][:, [1, 2, 0]], "axes", 1.0), (ON * 1000, "unit", 0.001), (ON / 0.3048, "unit", 0.3048)],
)
def test_exchanged_axes_and_other_units_are_named(wrong: Coordinates, kind: str, factor: float) -> None:
    cause = tie_points(points(wrong), [ground(box())], NEAR).cause
    assert cause is not None
    assert (cause.kind, cause.factor) == (kind, pytest.approx(factor))


def test_a_mesh_of_unknown_unit_or_without_faces_holds_nothing() -> None:
    unknown = replace(box(), unit=DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN))
    assert surface_ground_of(unknown) is None
    assert surface_ground_of(mesh(np.zeros((3, 3)), [])) is None


def test_a_face_that_cannot_be_used_holds_nothing_and_changes_nothing() -> None:
    whole = box()
    bad = replace(
        whole, points=np.vstack([whole.points, [[np.nan, 0, 0]]]),
        corners=np.concatenate([whole.corners, [0, 1, 8], [0, 1, 99]]),
        starts=np.append(whole.starts, len(whole.corners) + np.array([3, 6])), group=np.zeros(8, dtype=np.intp),
    )  # fmt: skip
    one, other = (tie_points(points(ON), [ground(of)], NEAR) for of in (whole, bad))
    assert one.item.tolist() == other.item.tolist()
    assert one.gap.tolist() == other.gap.tolist()


def test_distances_between_places_of_the_surface_are_measured_on_it() -> None:
    ends = np.array([[ON[0], ON[1]], [ON[2], ON[3]], [ON[4], ON[5] + [0, 0, 0.5]], [ON[0], ON[5]]])
    rows = Distances(
        id=texts(["D0", "D1", "D2", "D3"]), measured=np.array([2.001, 3.002, 4.5, 1.0]),
        delivered=np.array([2.0, np.nan, 4.5, 1.0]), resolution=0.0, survey_sd=0.001, places=ends,
    )  # fmt: skip
    ties = tie_distances(rows, None, None, [ground(box())], tie=NEAR.tie, visible=NEAR.visible)
    assert ties.ends.tolist() == [Ends.POINTS, Ends.POINTS, Ends.ABSENT, Ends.OTHER_LENGTH]
    assert ties.delivered[:2] == pytest.approx([2.0, 3.0])
    assert ties.longest == pytest.approx(float(np.linalg.norm(SIZE)))
