# SPDX-License-Identifier: MIT
"""Attacks on the evidence: tables that speak of something else than the drawing beside them."""

from dataclasses import replace

import numpy as np
import shapely
from tests.attacks.kinds import BY_ID, BY_PLACE, CLEAR, TOLD, attack
from tests.tools.facades import facade
from tests.tools.office_drawings import lines_of
from tests.tools.offices import FRAMES, METRES, Office

IN_SPACE = {**TOLD, "plane": "xz"}


def redrawn(office: Office, move: object) -> Office:
    """The same tables beside a drawing whose sheet coordinates (n, 3) were changed."""

    def spots(some: object) -> tuple[tuple[float, float, float], ...]:
        return tuple(map(tuple, np.round(move(np.array(some, dtype=float)), 6).tolist()))  # type: ignore[operator]

    parts = [replace(p, ring=spots(p.ring), inner=tuple(spots(line) for line in p.inner)) for p in office.facade.parts]
    return office.change(facade=replace(office.facade, parts=parts))


def both(office: Office, rows: np.ndarray, step: np.ndarray) -> Office:
    """Surveyed and delivered coordinates of some points moved alike; steps are right, up, depth."""
    moved = np.zeros_like(office.drawn)
    moved[rows] = np.asarray(step) @ FRAMES[office.plane]
    return office.change(delivered=office.columns + moved, surveyed=office.surveyed + moved)


def beside(office: Office, places: np.ndarray) -> np.ndarray:
    """Distances (n,) of places from what is drawn, in the plane, metres: an oracle of its own."""
    frame, metres = FRAMES[office.plane], METRES[office.unit]
    every = shapely.union_all([
        shapely.LineString((line @ frame.T)[:, :2] * metres)
        for part in office.facade.parts for line in lines_of(office, part)
    ])  # fmt: skip
    return shapely.distance(shapely.points((places @ frame.T)[:, :2]), every)


@attack("drawing exchanged for another office's", "evidence.absent")
def _exchanged(office: Office, rng: np.random.Generator) -> Office:
    return office.change(facade=facade(rng, relief=not office.flat))


@attack(
    "drawing exchanged, coordinates taken from it", "absolute.missing", "absolute.none-delivered",
    office={"told": False, "targets": "", "ends_by": "names"},
)  # fmt: skip
def _exchanged_untold(office: Office, rng: np.random.Generator) -> Office:
    return office.change(facade=facade(rng, relief=not office.flat))


@attack("mirrored left to right", "evidence.cause-mirror-right")
def _mirrored(office: Office, _: np.random.Generator) -> Office:
    width = office.facade.width
    return redrawn(office, lambda spots: np.array([width, 0, 0]) + spots * [-1, 1, 1])


@attack("mirrored top to bottom", "evidence.cause-mirror-up")
def _upside_down(office: Office, _: np.random.Generator) -> Office:
    height = office.facade.height
    return redrawn(office, lambda spots: np.array([0, height, 0]) + spots * [1, -1, 1])


@attack("stretched by 2 to 8 %", "evidence.cause-scale")
def _stretched(office: Office, rng: np.random.Generator) -> Office:
    factor = 1 + rng.uniform(0.02, 0.08) * rng.choice([-1, 1])
    return redrawn(office, lambda spots: spots * factor)


@attack("stretched in width", "evidence.cause-scale-right")
def _widened(office: Office, rng: np.random.Generator) -> Office:
    factor = 1 + rng.uniform(0.02, 0.08) * rng.choice([-1, 1])
    return redrawn(office, lambda spots: spots * [factor, 1, 1])


@attack("stretched in height", "evidence.cause-scale-up")
def _heightened(office: Office, rng: np.random.Generator) -> Office:
    factor = 1 + rng.uniform(0.02, 0.08) * rng.choice([-1, 1])
    return redrawn(office, lambda spots: spots * [1, factor, 1])


@attack("moved by 20 to 500 mm", "evidence.cause-shift")
def _moved(office: Office, rng: np.random.Generator) -> Office:
    turn, length = rng.uniform(0.1, 1.4) + rng.integers(4) * np.pi / 2, rng.uniform(0.02, 0.5)
    step = length * np.array([np.cos(turn), np.sin(turn), 0.0])
    return redrawn(office, lambda spots: spots + step)


@attack("moved to one side by 20 to 500 mm", "evidence.absent")
def _moved_aside(office: Office, rng: np.random.Generator) -> Office:
    step = np.zeros(3)
    step[rng.integers(2)] = rng.uniform(0.02, 0.5) * rng.choice([-1, 1])
    return redrawn(office, lambda spots: spots + step)


@attack("moved in depth by 20 to 500 mm", "evidence.cause-shift", office=IN_SPACE)
def _moved_back(office: Office, rng: np.random.Generator) -> Office:
    step = np.array([0, 0, rng.uniform(0.02, 0.5) * rng.choice([-1, 1])])
    return redrawn(office, lambda spots: spots + step)


@attack("one to three points beside the linework by 5 to 50 mm", "evidence.absent")
def _beside(office: Office, rng: np.random.Generator) -> Office:
    rows = rng.choice(len(office.ids), int(rng.integers(1, 4)), replace=False)
    for _ in range(100):
        turn, length = rng.uniform(0, 2 * np.pi, len(rows)), rng.uniform(0.007, 0.05, len(rows))
        moved = both(office, rows, np.column_stack([np.cos(turn), np.sin(turn), np.zeros(len(rows))]) * length[:, None])
        if beside(moved, moved.columns[rows]).min() > 0.005:
            return moved
    raise AssertionError("no such place")


@attack("points before the facade by 5 to 50 mm", "evidence.absent", office=IN_SPACE)
def _before(office: Office, rng: np.random.Generator) -> Office:
    rows = rng.choice(len(office.ids), int(rng.integers(1, 4)), replace=False)
    return both(office, rows, [0, 0, rng.uniform(0.005, 0.05)])


@attack("points 20 m above the roof", "evidence.absent")
def _above(office: Office, rng: np.random.Generator) -> Office:
    rows = rng.choice(len(office.ids), 3, replace=False)
    return both(office, rows, [0, 20 + rng.uniform(0, 5), 0])


@attack("all points 1000 km away", "evidence.cause-shift")
def _far(office: Office, rng: np.random.Generator) -> Office:
    return both(office, np.arange(len(office.ids)), np.array([[1e6, 0, 0], [0, 1e6, 0]])[rng.integers(2)])


@attack("one point 1000 km away", "evidence.absent")
def _one_far(office: Office, rng: np.random.Generator) -> Office:
    return both(office, rng.choice(len(office.ids), 1), [1e6, 0, 0])


def _columns(office: Office, order: list[int]) -> Office:
    return office.change(delivered=office.columns[:, order], surveyed=office.surveyed[:, order])


@attack("axes exchanged", "evidence.cause-axes")
def _axes(office: Office, rng: np.random.Generator) -> Office:
    orders = [[0, 2, 1], [2, 1, 0], [1, 2, 0], [2, 0, 1]]
    return _columns(office, orders[int(rng.integers(len(orders)))])


@attack("northing and easting exchanged", "evidence.cause-axes")
def _north(office: Office, _: np.random.Generator) -> Office:
    return _columns(office, [1, 0, 2])


@attack("distances of 500 m", "evidence.too-long", office={**CLEAR, "ends_by": "names"})
def _long(office: Office, rng: np.random.Generator) -> Office:
    longer = 500 + rng.uniform(0, 20, len(office.lengths))
    return office.change(measured=office.measured + longer, lengths=office.lengths + longer)


@attack("lengths that are not those between their ends", "evidence.other-length", office=BY_ID)
def _other_lengths(office: Office, rng: np.random.Generator) -> Office:
    other = rng.uniform(0.05, 3.0, len(office.lengths))
    return office.change(measured=office.measured + other, lengths=office.lengths + other)


@attack("lengths that are not those between their places", "evidence.other-length", office=BY_PLACE)
def _other_places(office: Office, rng: np.random.Generator) -> Office:
    return _other_lengths(office, rng)
