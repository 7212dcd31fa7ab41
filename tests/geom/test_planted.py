# SPDX-License-Identifier: MIT
"""Two thousand planted near misses are told, each with its size; what lies beside them is not accused."""

from typing import NamedTuple

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from tests.geom.aims import AIM

from foparq.geom.ends import EndKind, Ends, classify_ends
from foparq.geom.heading import heading_ends
from foparq.geom.nodes import short_nodes
from foparq.geom.polylines import Polylines

COINCIDE, REACH, HEADING = 0.0005, 0.01, 0.05
Way = NDArray[np.float64]


class Plant(NamedTuple):
    """Lines around the origin, and their ends that are at fault."""

    lines: list[Way]
    faults: list[tuple[int, bool, EndKind, float]]  #: line, last, kind, size


def towards(angle: float, start: float, end: float) -> Way:
    """A line below the x axis that rises to the origin at an angle, between two distances from it."""
    way = np.array([np.cos(angle), np.sin(angle)])
    return np.array([-way * start, -way * end])


def short_of_a_line(rng: np.random.Generator) -> Plant:
    angle, gap = np.radians(rng.uniform(20, 160)), rng.uniform(0.0006, 0.0099)
    host = np.array([[-0.7, 0], [0.6, 0]])
    return Plant([host, towards(angle, 0.5, gap / np.sin(angle))], [(1, True, EndKind.UNDERSHOOT, gap)])


def beyond_a_line(rng: np.random.Generator) -> Plant:
    angle, over = np.radians(rng.uniform(20, 160)), rng.uniform(0.0016, 0.0099)
    host = np.array([[-0.7, 0], [0.6, 0]])
    return Plant([host, towards(angle, 0.5, -over)], [(1, True, EndKind.OVERSHOOT, over)])


def beyond_on_both_sides(rng: np.random.Generator) -> Plant:
    over, width = rng.uniform(0.0006, 0.0099, 2), rng.uniform(0.1, 0.5)
    hosts = [np.array([[x, -0.4], [x, 0.4]]) for x in (0.0, width)]
    bar = np.array([[-over[0], 0], [width + over[1], 0]])
    return Plant([*hosts, bar], [(2, False, EndKind.OVERSHOOT, over[0]), (2, True, EndKind.OVERSHOOT, over[1])])


def open_corner(rng: np.random.Generator) -> Plant:
    angle = np.radians(rng.uniform(20, 160))
    way = np.array([np.cos(angle), np.sin(angle)])
    gaps = rng.uniform(0.001, 0.008, 2)
    apart = float(np.hypot(*(gaps[1] * way - [-gaps[0], 0])))
    if not 0.0006 < apart < 0.0099:
        return open_corner(rng)
    lines = [np.array([[-0.5, 0], [-gaps[0], 0]]), np.array([gaps[1] * way, 0.5 * way])]
    # To the foot of the perpendicular on the other line, if there is one in the cone of 60 degrees, else to its end.
    sine, cosine = np.sin(angle), np.cos(angle)
    size = [gaps[n] * sine if -cosine * gaps[n] > gaps[1 - n] and sine >= 0.5 else apart for n in (0, 1)]
    return Plant(lines, [(0, True, EndKind.UNDERSHOOT, size[0]), (1, False, EndKind.UNDERSHOOT, size[1])])


def line_to_arc(rng: np.random.Generator) -> Plant:
    radius, gap = rng.uniform(0.3, 0.6), rng.uniform(0.0006, 0.0099)
    turn = np.linspace(0.2 * np.pi, 0.8 * np.pi, 400)
    arc = radius * np.column_stack([np.cos(turn), np.sin(turn)])
    size = float(shapely.distance(shapely.LineString(arc), shapely.Point(0, radius - gap)))
    return Plant([arc, np.array([[0, 0], [0, radius - gap]])], [(1, True, EndKind.UNDERSHOOT, size)])


def arc_to_line(rng: np.random.Generator) -> Plant:
    radius, gap = rng.uniform(0.1, 0.5), rng.uniform(0.0006, 0.0099)
    turn = np.linspace(np.pi / 2, np.pi, 300)
    arc = radius * np.column_stack([np.cos(turn), np.sin(turn)]) + [radius, gap]
    return Plant([np.array([[-0.3, 0], [0.4, 0]]), arc], [(1, True, EndKind.UNDERSHOOT, gap)])


def run_that_jumps(rng: np.random.Generator) -> Plant:
    ahead, aside = rng.uniform(0, 0.006), rng.uniform(0.0006, 0.006)
    size = float(np.hypot(ahead, aside))
    lines = [np.array([[-0.5, 0], [0, 0]]), np.array([[ahead, aside], [0.5, aside]])]
    return Plant(lines, [(0, True, EndKind.UNDERSHOOT, size), (1, False, EndKind.UNDERSHOOT, size)])


def in_pieces(rng: np.random.Generator) -> Plant:
    """Short of a line, drawn as segments of which the last is shorter than reach."""
    gap, piece = rng.uniform(0.0006, 0.0099), rng.uniform(0.0008, 0.009)
    lines = [
        np.array([[-0.5, 0], [0.5, 0]]),
        np.array([[0, gap], [0, gap + piece]]),
        np.array([[0, gap + piece], [0, 0.5]]),
    ]
    return Plant(lines, [(1, False, EndKind.UNDERSHOOT, gap)])


FAULTS = [
    short_of_a_line, beyond_a_line, beyond_on_both_sides, open_corner, line_to_arc, arc_to_line, run_that_jumps,
    in_pieces,
]  # fmt: skip


def mouldings(rng: np.random.Generator) -> Plant:
    """Edges side by side, cut at one break line or a little past it."""
    y = np.cumsum(rng.uniform(0.001, 0.009, rng.integers(2, 9)))
    return Plant([np.array([[-0.5, at], [rng.uniform(0, 0.002), at]]) for at in y], [])


def cross(rng: np.random.Generator) -> Plant:
    arm = rng.uniform(0.002, 0.009)
    return Plant([np.array([[-arm, 0], [arm, 0]]), np.array([[0, -arm], [0, arm]])], [])


def fillet(rng: np.random.Generator) -> Plant:
    """Two parallel edges with both ends open."""
    gap = rng.uniform(0.001, 0.0095)
    return Plant([np.array([[0, 0], [0.6, 0]]), np.array([[0, gap], [0.6, gap]])], [])


SOUND = [mouldings, cross, fillet]


def sheet(
    plants: list[Plant], rng: np.random.Generator
) -> tuple[list[Way], dict[tuple[int, bool], tuple[EndKind, float]]]:
    """Plants turned, and two metres apart; lines drawn either way, in any order."""
    lines: list[Way] = []
    faults: dict[tuple[int, bool], tuple[EndKind, float]] = {}
    for number, plant in enumerate(plants):
        turn = rng.uniform(0, 2 * np.pi)
        frame = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
        back = rng.random(len(plant.lines)) < 0.5
        for line, last, kind, size in plant.faults:
            faults[len(lines) + line, last != back[line]] = (kind, size)
        moved = [way @ frame + [2.0 * (number % 50), 2.0 * (number // 50)] for way in plant.lines]
        lines += [way[::-1] if flip else way for way, flip in zip(moved, back, strict=True)]
    return lines, faults


def table(lines: list[Way]) -> Polylines:
    return Polylines.of(np.array([shapely.LineString(way) for way in lines], dtype=object))


def told(ends: Ends) -> dict[tuple[int, bool], tuple[EndKind, float]]:
    rows = np.flatnonzero(np.isin(ends.kind, [EndKind.UNDERSHOOT, EndKind.OVERSHOOT]))
    return {
        (int(ends.line[n]), not ends.forward[n]): (EndKind(ends.kind[n]), float(ends.size[n])) for n in rows.tolist()
    }


@pytest.mark.parametrize("kind", FAULTS, ids=lambda kind: kind.__name__)
def test_every_planted_fault_is_told_and_nothing_else(kind) -> None:  # noqa: ANN001
    rng = np.random.default_rng(7)
    lines, faults = sheet([kind(rng) for _ in range(250)], rng)
    found = told(classify_ends(table(lines), AIM, coincide=COINCIDE, reach=REACH))
    assert found.keys() == faults.keys()
    for end, (what, size) in faults.items():
        assert found[end][0] is what
        assert found[end][1] == pytest.approx(size, abs=1e-6)


@pytest.mark.parametrize("kind", SOUND, ids=lambda kind: kind.__name__)
def test_what_lies_side_by_side_misses_nothing(kind) -> None:  # noqa: ANN001
    rng = np.random.default_rng(8)
    lines, _ = sheet([kind(rng) for _ in range(150)], rng)
    drawn = table(lines)
    assert told(classify_ends(drawn, AIM, coincide=COINCIDE, reach=REACH)) == {}
    assert not len(short_nodes(drawn, AIM, coincide=COINCIDE, reach=REACH).line)


def test_what_is_drawn_as_polylines_or_as_segments_is_the_same() -> None:
    rng = np.random.default_rng(9)
    ways = []
    for _ in range(300):
        turn, length = rng.uniform(0, 2 * np.pi, 6), rng.uniform(0.001, 0.06, 6)
        steps = (length * [np.cos(turn), np.sin(turn)]).T[: rng.integers(1, 7)]
        ways.append(np.cumsum(np.vstack([rng.uniform(0, 1, 2), steps]), axis=0))
    pieces = [way[n : n + 2][:: rng.choice([-1, 1])] for way in ways for n in range(len(way) - 1)]
    pieces = [pieces[n] for n in rng.permutation(len(pieces))]

    def places(lines: list[Way]) -> set[tuple[float, ...]]:
        drawn = table(lines)
        ends = classify_ends(drawn, AIM, coincide=COINCIDE, reach=REACH)
        rows = np.flatnonzero(ends.kind != EndKind.CONNECTED)
        found = np.column_stack([drawn.coordinates[ends.vertex[rows]], ends.kind[rows], ends.size[rows]])
        heading = heading_ends(drawn, AIM, coincide=COINCIDE, reach=REACH, heading=HEADING)
        farther = np.column_stack([drawn.coordinates[heading.vertex], np.full(len(heading.line), 9), heading.size])
        return {tuple(row) for row in np.round(np.vstack([found, farther]), 7).tolist()}

    assert places(pieces) == places(ways)
    assert {kind for _, _, kind, _ in places(ways)} == {1, 2, 3, 4, 9}
