# SPDX-License-Identifier: MIT
"""Tables held against drawings whose every corner is known."""

from typing import Any

import numpy as np
import pytest
import shapely

from foparq.check.drawn.ground import DrawnGround, ground_of
from foparq.check.tables.ground import Nearness
from foparq.check.tables.points import tie_points
from foparq.check.tables.ties import tie_evidence
from foparq.findings.ties import Ends, Lies
from foparq.model.delivery import Delivery
from foparq.model.drawing import Drawing, DrawingUnit, Labels, Reading, UnitOrigin
from foparq.model.items import Items, Role
from foparq.model.plane import plane_of
from foparq.model.tables import Checkpoints, Distances

NEAR = Nearness(tie=0.001, apart=0.05, search=0.05, visible=0.01)
DEPTH = 12.2046
#: four openings of unequal size: corners in metres, right and up
BOXES = [(40.0, 2.0, 41.2, 3.5), (43.1, 2.1, 44.4, 3.7), (47.3, 2.0, 48.2, 4.4), (52.0, 5.0, 53.9, 6.1)]
CORNERS = np.array([(box[0], box[1]) for box in BOXES] + [(box[2], box[3]) for box in BOXES])


def texts(*values: str) -> np.ndarray:
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def drawing(
    *, metres: float = 1.0, plane: str = "xz", depth: float = DEPTH, path: str = "f.dxf",
    names: dict[str, tuple[float, float]] | None = None,
) -> Drawing:  # fmt: skip
    """Openings at a depth, in a facade that stands in space, or flat in xy."""
    lines = []
    for box in BOXES:
        corner = shapely.get_coordinates(shapely.box(*box)) / metres
        right, up, away = corner[:, 0], corner[:, 1], np.full(5, depth / metres)
        columns = {"xz": (right, away, up), "yz": (away, right, up), "xy": (right, up)}[plane]
        lines.append(shapely.LineString(np.column_stack(columns)))
    names = names or {}
    places = np.array([(x / metres, y / metres, 0.0) for x, y in names.values()]).reshape(-1, 3)
    labels = Labels(text=texts(*names), place=places, block=np.ones(len(names), dtype=bool))
    n = len(lines)
    ids = texts(*map(str, range(n)))
    items = Items(
        geometry=np.array(lines, dtype=object), layer=texts(*["VAO"] * n), kind=texts(*["LWPOLYLINE"] * n),
        role=texts(*[str(Role.LINE)] * n), item=ids, handle=ids.copy(), inserts=texts(*[""] * n),
        colour=np.zeros(n, dtype=np.int32), closed=np.ones(n, dtype=bool), visible=np.ones(n, dtype=bool),
        paper=np.zeros(n, dtype=bool),
    )  # fmt: skip
    unit = DrawingUnit(metres=metres, name="", origin=UnitOrigin.STATED)
    return Drawing(
        path=path, items=items, reading=Reading(labels=labels), unit=unit, plane=plane_of(plane, items.geometry)
    )


def in_space(places: np.ndarray, depth: float = DEPTH) -> np.ndarray:
    return np.column_stack([places[:, 0], np.full(len(places), depth), places[:, 1]])


def checkpoints(delivered: np.ndarray, surveyed: np.ndarray | None = None, **changes: Any) -> Checkpoints:
    n = len(delivered)
    return Checkpoints(**{
        "id": texts(*[f"V{n}" for n in range(n)]), "surveyed": delivered + 0.002 if surveyed is None else surveyed,
        "delivered": delivered, "resolution": np.zeros(3), "survey_sd": 0.003, **changes,
    })  # fmt: skip


def ground(made: Drawing) -> DrawnGround:
    found = ground_of(made, NEAR)
    assert found is not None
    return found


def lies(points: Checkpoints, *drawings: Drawing) -> list[str]:
    found: list[str] = tie_points(points, [ground(one) for one in drawings], NEAR).lies.tolist()
    return found


@pytest.mark.parametrize("metres", [1.0, 0.001, 0.0254])
def test_corners_of_the_drawing_lie_in_it_in_any_unit(metres: float) -> None:
    ties = tie_points(checkpoints(in_space(CORNERS)), [ground(drawing(metres=metres))], NEAR)
    assert ties.lies.tolist() == [Lies.VERTEX] * 8
    assert ties.gap.max() <= 1e-9
    assert ties.item.tolist() == ["0", "1", "2", "3"] * 2
    assert not ties.unchecked.any()


def test_a_tolerance_holds_and_printed_digits_are_added() -> None:
    for beside, found in ((0.0009, Lies.VERTEX), (0.0011, Lies.ABSENT)):
        # Below the sills: the jambs lead upward.
        assert lies(checkpoints(in_space(CORNERS[:4] - [0, beside])), drawing()) == [found] * 4
    lower = checkpoints(in_space(CORNERS[:4] - [0, 0.0015]))
    assert lies(lower, drawing()) == [Lies.ABSENT] * 4
    for axis, found in ((2, Lies.VERTEX), (0, Lies.ABSENT), (1, Lies.ABSENT)):
        # Digits that are missing along the facade or its depth hide nothing of the height.
        coarse = checkpoints(lower.delivered, printed=0.0006 * np.eye(3)[axis])
        assert lies(coarse, drawing()) == [found] * 4


def test_digits_missing_of_one_axis_hide_no_shift_of_another() -> None:
    moved = in_space(CORNERS + np.array([0.0, 0.04]))
    for axis, found in ((0, False), (1, False), (2, True)):
        told = lies(checkpoints(moved, printed=0.05 * np.eye(3)[axis]), drawing())
        assert (Lies.VERTEX in told) is found


def test_the_depth_of_a_flat_drawing_hides_no_shift() -> None:
    table = np.column_stack([CORNERS + np.array([0.0, 0.04]), np.zeros(8)])
    assert Lies.VERTEX not in lies(checkpoints(table, printed=np.array([0.0, 0.0, 0.5])), drawing(plane="xy"))


def test_depth_counts_in_space_and_not_on_a_flat_sheet() -> None:
    assert lies(checkpoints(in_space(CORNERS, depth=DEPTH + 1)), drawing()) == [Lies.ABSENT] * 8
    flat = tie_points(checkpoints(np.column_stack([CORNERS, np.full(8, 3.0)])), [ground(drawing(plane="xy"))], NEAR)
    assert flat.lies.tolist() == [Lies.VERTEX] * 8
    assert flat.unchecked.tolist() == [False, False, True]


def test_a_point_of_one_of_two_drawings_is_in_the_delivery() -> None:
    north, east = drawing(path="n.dxf"), drawing(path="l.dxf", plane="yz", depth=3.0)
    places = np.concatenate([in_space(CORNERS[:2]), np.column_stack([np.full(2, 3.0), CORNERS[2:4]])])
    ties = tie_points(checkpoints(places), [ground(north), ground(east)], NEAR)
    assert ties.drawing.tolist() == ["n.dxf", "n.dxf", "l.dxf", "l.dxf"]


def test_without_coordinates_the_only_vertex_near_by_is_taken() -> None:
    surveyed = in_space(CORNERS) + 0.004
    ties = tie_points(checkpoints(np.full((8, 3), np.nan), surveyed), [ground(drawing())], NEAR)
    assert ties.lies.tolist() == [Lies.TAKEN_VERTEX] * 8
    assert ties.delivered == pytest.approx(in_space(CORNERS), abs=1e-9)
    far = tie_points(checkpoints(np.full((8, 3), np.nan), surveyed + 0.06), [ground(drawing())], NEAR)
    assert far.lies.tolist() == [Lies.UNTOLD] * 8


def test_what_bears_the_id_is_taken_before_a_vertex() -> None:
    names = {"v0": (45.0, 5.0), "V1": (46.0, 5.5)}
    points = checkpoints(np.full((3, 3), np.nan), np.column_stack([CORNERS[:3], np.zeros(3)]))
    ties = tie_points(points, [ground(drawing(plane="xy", names=names))], NEAR)
    assert ties.lies.tolist() == [Lies.TAKEN_NAMED, Lies.TAKEN_NAMED, Lies.TAKEN_VERTEX]
    assert ties.delivered[:2, :2].tolist() == [[45.0, 5.0], [46.0, 5.5]]
    assert np.isnan(ties.delivered[:, 2]).all()  # a flat drawing has no depth to deliver
    told = checkpoints(np.array([[45.0, 5.0, 0.0], [46.0, 5.6, 0.0]]))
    assert lies(told, drawing(plane="xy", names=names)) == [Lies.NAMED, Lies.ABSENT]


def test_causes_are_told_where_they_explain_all() -> None:
    sheet = in_space(CORNERS)
    for kind, table in {
        "axes": sheet[:, [0, 2, 1]], "unit": sheet * 1000, "shift": sheet + np.array([0.1, 0, 0.02]),
        "mirror": sheet * [-1, 1, 1] + [90, 0, 0], "scale": sheet * [1.05, 1, 1],
    }.items():  # fmt: skip
        cause = tie_points(checkpoints(table), [ground(drawing())], NEAR).cause
        assert cause is not None
        assert cause.kind == kind
    three = sheet.copy()
    three[:3] += 5.0
    assert tie_points(checkpoints(three), [ground(drawing())], NEAR).cause is None


# --- distances -------------------------------------------------------------------------------------------------------


def distances(pairs: list[tuple[str, str]], delivered: Any, **changes: Any) -> Distances:
    n = len(pairs)
    return Distances(**{
        "id": texts(*[f"D{n}" for n in range(n)]), "measured": np.asarray(delivered, dtype=float) + 0.001,
        "delivered": np.asarray(delivered, dtype=float), "resolution": 0.0, "survey_sd": 0.003,
        "start": texts(*[a for a, _ in pairs]), "end": texts(*[b for _, b in pairs]), **changes,
    })  # fmt: skip


def ends(lengths: Distances, points: Checkpoints | None = None, **changes: Any) -> Any:
    delivery = Delivery(title="", sources=(), parts=(drawing(**changes),), checkpoints=points, distances=lengths)
    return tie_evidence(delivery, NEAR).distances


def between(a: int, b: int) -> float:
    return float(np.hypot(*(CORNERS[a] - CORNERS[b])))


def test_ends_that_are_checkpoints_must_lie_as_far_apart() -> None:
    points = checkpoints(in_space(CORNERS))
    pairs = [("V0", "V1"), ("v2", "V3"), ("V4", "V6")]
    right = [between(0, 1), between(2, 3), between(4, 6) + 0.003]
    found = ends(distances(pairs, right), points)
    assert found.ends.tolist() == [Ends.POINTS, Ends.POINTS, Ends.OTHER_LENGTH]
    assert found.between == pytest.approx([between(0, 1), between(2, 3), between(4, 6)], abs=1e-9)
    taken = ends(distances(pairs, [np.nan] * 3, measured=np.array(right)), points)
    assert taken.delivered == pytest.approx(found.between, abs=1e-12)


def test_ends_that_are_not_in_the_drawing() -> None:
    beside = in_space(CORNERS)
    beside[0] += 0.5
    found = ends(distances([("V0", "V1"), ("V1", "V2")], [between(0, 1), between(1, 2)]), checkpoints(beside))
    assert found.ends.tolist() == [Ends.ABSENT, Ends.POINTS]
    places = np.stack([in_space(CORNERS[:2]), in_space(CORNERS[:2]) + np.array([[0, 0, 0], [0, 1.0, 0]])])
    given = ends(distances([("", ""), ("", "")], [between(0, 1)] * 2, places=places))
    assert given.ends.tolist() == [Ends.POINTS, Ends.ABSENT]


def test_lengths_between_names_must_fit() -> None:
    corners = np.array([[box[0], box[1]] for box in BOXES] + [[box[2], box[3]] for box in BOXES])
    diagonal = float(np.hypot(*np.ptp(corners, axis=0)))
    lengths = [diagonal, diagonal + 0.002, 0.01, 0.0099]
    found = ends(distances([(f"a{n}", f"b{n}") for n in range(4)], lengths))
    assert found.longest == pytest.approx(diagonal, abs=1e-12)
    assert found.ends.tolist() == [Ends.NAMES, Ends.TOO_LONG, Ends.NAMES, Ends.TOO_SHORT]


def test_one_measurement_counts_once() -> None:
    points = checkpoints(in_space(CORNERS))
    same = ends(distances([("V0", "V1"), ("V1", "V0"), ("V1", "V2")], [between(0, 1)] * 2 + [between(1, 2)]), points)
    assert same.group.tolist() == [0, 0, 2]
    names = ends(distances([("p", "q"), ("Q", "P"), ("p", "r")], [1.0, 1.0019, 1.0]))
    assert names.group.tolist() == [0, 0, 2]
    # No two points are one metre apart and two: names that every opening bears say where an end is, not which.
    sides = ends(distances([("left", "right")] * 3, [1.0, 1.0021, 2.0]))
    assert sides.group.tolist() == [0, 1, 2]
    untold = ends(distances([("left", "right")] * 3, [np.nan] * 3, measured=np.array([1.0, 1.001, 2.0])))
    assert untold.group.tolist() == [0, 0, 2]
    thrice = ends(distances([("", "")] * 4, [1.0, 1.0, 1.0, 2.0]))
    assert thrice.group.tolist() == [0, 0, 0, 3]
    twice = ends(distances([("", "")] * 3, [1.0, 1.0, 2.0]))
    assert twice.group.tolist() == [0, 1, 2]


def test_another_unit_of_the_distances_is_told() -> None:
    points = checkpoints(in_space(CORNERS))
    pairs = [("V0", "V1"), ("V2", "V3"), ("V4", "V6")]
    right = np.array([between(0, 1), between(2, 3), between(4, 6)])
    assert ends(distances(pairs, right / 1000), points).factor == pytest.approx(1000, rel=1e-6)
    assert ends(distances(pairs, right * 1.02), points).factor == 1.0


def test_nothing_is_tied_without_a_known_unit() -> None:
    made = drawing()
    unknown = Drawing(
        path="f.dxf", items=made.items, reading=made.reading, plane=made.plane,
        unit=DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN),
    )  # fmt: skip
    delivery = Delivery(title="", sources=(), parts=(unknown,), checkpoints=checkpoints(in_space(CORNERS)))
    found = tie_evidence(delivery, NEAR)
    assert (found.points, found.drawings) == (None, 0)


def test_an_end_is_a_checkpoint_by_id_or_by_place() -> None:
    """D0 names its ends, D1 gives their places, D2 one place at a point and one at none, D3 names no point."""
    points = checkpoints(in_space(CORNERS[:4]))
    corners = in_space(CORNERS)
    places = np.full((4, 2, 3), np.nan)
    places[1] = corners[[3, 2]] + 0.0004
    places[2] = corners[[1, 6]]
    lengths = distances([("v0", "V2"), ("", ""), ("", ""), ("X", "V1")], [1.0] * 4, places=places)
    assert ends(lengths, points).at.tolist() == [[0, 2], [3, 2], [1, -1], [-1, 1]]
    assert ends(lengths).at.tolist() == [[-1, -1]] * 4


def test_a_place_that_two_checkpoints_share_names_neither() -> None:
    points = checkpoints(in_space(CORNERS[[0, 0, 1]]))
    places = in_space(CORNERS[[0, 1]])[np.newaxis]
    assert ends(distances([("", "")], [1.0], places=places), points).at.tolist() == [[-1, 2]]


@pytest.mark.parametrize(("half", "known"), [(0.005, Ends.POINTS), (0.0, Ends.ABSENT)])
def test_ends_are_as_exact_as_their_own_digits_and_no_more(half: float, known: Ends) -> None:
    """Lengths to a tenth of a millimetre between ends to a centimetre: these are corners all the same."""
    corners = np.stack([in_space(CORNERS[:3]), in_space(CORNERS[1:4])], axis=1)
    given = distances(
        [("", "")] * 3, [between(0, 1), between(1, 2), between(2, 3)], places=corners + 0.004, printed=5e-5,
        places_printed=np.full(3, half),
    )  # fmt: skip
    assert ends(given).ends.tolist() == [known] * 3
