# SPDX-License-Identifier: MIT
"""Sixty faults planted into an elevation, each of one kind, at a place that is known."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from tests.tools.elevation import Elevation, Stroke


class Planted(NamedTuple):
    """One finding that must be told."""

    rule: str
    where: shapely.Geometry  #: the finding's place lies on it


Random = np.random.Generator
Spot = NDArray[np.float64]


class Hosts:
    """Strokes of an elevation in random order, none given out twice."""

    def __init__(self, made: Elevation, rng: Random) -> None:
        self.made, self.rng, self.taken = made, rng, set[int]()

    def one(self, part: str) -> Stroke:
        """A stroke of a kind."""
        free = [stroke for stroke in self.made.of(part) if id(stroke) not in self.taken]
        chosen = free[int(self.rng.integers(len(free)))]
        self.taken.add(id(chosen))
        return chosen

    def length(self, low: float, high: float) -> float:
        """In metres, to a tenth of a millimetre."""
        return round(float(self.rng.uniform(low, high)), 4)


def plant(made: Elevation, seed: int) -> list[Planted]:
    """Change an elevation; what must be found of it, and nothing else.

    Faults of one window do not touch each other: each takes another kind of part.
    """
    hosts = Hosts(made, np.random.default_rng(seed))
    return [planted for kind, times in FAULTS for _ in range(times) for planted in kind(hosts)]


def rail_short_of_mullion(hosts: Hosts) -> list[Planted]:
    rail, gap = hosts.one("left rail"), hosts.length(0.001, 0.009)
    rail.points[1, 0] -= gap
    return [Planted("undershoot", shapely.Point(rail.points[1]))]


def joint_short_of_extrados(hosts: Hosts) -> list[Planted]:
    joint, gap = hosts.one("voussoir joint"), hosts.length(0.002, 0.009)
    joint.points[1] -= gap * _way(joint)
    return [Planted("undershoot", shapely.Point(joint.points[1]))]


def line_short_of_baluster(hosts: Hosts) -> list[Planted]:
    """A line at half the height of a baluster that stops short of its edge."""
    name, layer, places = hosts.made.places[0]
    edge = hosts.made.blocks[name][1].points + places[int(hosts.rng.integers(len(places)))]
    side = edge[len(edge) // 2] + [hosts.length(0.002, 0.009), 0.0]
    hosts.made.draw(layer, (side[0], side[1]), (side[0] + 0.1, side[1]), part="planted")
    return [Planted("undershoot", shapely.Point(side))]


def open_corner(hosts: Hosts) -> list[Planted]:
    """Two lines that stop short of one corner, in the open above the roof: both ends are told."""
    x, y = 1.5 * len(hosts.made.of("planted corner")), 20.0
    gap, drop = hosts.length(0.001, 0.006), hosts.length(0.001, 0.006)
    hosts.made.draw("FRONTAO", (x, y), (x + 1.0 - gap, y), part="planted corner")
    hosts.made.draw("FRONTAO", (x + 1.0, y - drop), (x + 1.0, y - 1.0), part="planted corner")
    ends = (x + 1.0 - gap, y), (x + 1.0, y - drop)
    return [Planted("undershoot", shapely.Point(end)) for end in ends]


def mullion_beyond_sash(hosts: Hosts) -> list[Planted]:
    mullion, over = hosts.one("mullion"), hosts.length(0.001, 0.009)
    mullion.points[1, 1] += over
    return [Planted("overshoot", shapely.Point(mullion.points[1]))]


def joint_beyond_extrados(hosts: Hosts) -> list[Planted]:
    joint, over = hosts.one("voussoir joint"), hosts.length(0.002, 0.009)
    joint.points[1] += over * _way(joint)
    return [Planted("overshoot", shapely.Point(joint.points[1]))]


def rail_drawn_twice(hosts: Hosts) -> list[Planted]:
    rail = hosts.one("right rail")
    hosts.made.draw(rail.layer, *rail.points[::-1].tolist(), part="planted")
    return [Planted("duplicate", rail.line())]


def frame_drawn_twice(hosts: Hosts) -> list[Planted]:
    """From another corner on."""
    frame = hosts.one("frame")
    hosts.made.draw(frame.layer, *np.roll(frame.points, 1, axis=0).tolist(), closed=True, part="planted")
    return [Planted("duplicate", frame.line())]


def line_on_moulding(hosts: Hosts) -> list[Planted]:
    """A piece of a moulding drawn once more."""
    moulding = hosts.one("moulding")
    (left, y), (right, _) = moulding.points
    a, b = left + 0.2 * (right - left), left + 0.4 * (right - left)
    hosts.made.draw(moulding.layer, (a, y), (b, y), part="planted")
    return [Planted("line-overlap", shapely.LineString([(a, y), (b, y)]))]


def sill_that_crosses_itself(hosts: Hosts) -> list[Planted]:
    sill = hosts.one("sill")
    sill.points[:2] = sill.points[1::-1].copy()
    return [Planted("self-intersection", shapely.Point(sill.points.mean(axis=0)))]


def line_without_length(hosts: Hosts) -> list[Planted]:
    x, y = 36.0 + hosts.length(0.0, 10.0), 19.0 + hosts.length(0.0, 1.0)
    hosts.made.draw("PAREDE", (x, y), (x, y), part="planted")
    return [Planted("zero-length", shapely.Point(x, y))]


def stone_too_narrow(hosts: Hosts) -> list[Planted]:
    stone, gap = hosts.one("stone of course 1"), hosts.length(0.003, 0.02)
    stone.points[1:3, 0] -= gap
    right = stone.points[1, 0]
    return [Planted("gap", shapely.box(right, stone.points[1, 1], right + gap, stone.points[2, 1]))]


def stone_too_wide(hosts: Hosts) -> list[Planted]:
    stone, over = hosts.one("stone of course 3"), hosts.length(0.003, 0.02)
    stone.points[1:3, 0] += over
    right = stone.points[1, 0]
    return [Planted("area-overlap", shapely.box(right - over, stone.points[1, 1], right, stone.points[2, 1]))]


#: kinds and how often: sixty findings
FAULTS: list[tuple[Callable[[Hosts], list[Planted]], int]] = [
    (rail_short_of_mullion, 8), (joint_short_of_extrados, 4), (line_short_of_baluster, 2), (open_corner, 3),
    (mullion_beyond_sash, 7), (joint_beyond_extrados, 3), (rail_drawn_twice, 7), (frame_drawn_twice, 2),
    (line_on_moulding, 6), (sill_that_crosses_itself, 4), (line_without_length, 3), (stone_too_narrow, 4),
    (stone_too_wide, 4),
]  # fmt: skip


def _way(stroke: Stroke) -> Spot:
    along = stroke.points[1] - stroke.points[0]
    return np.asarray(along / np.hypot(*along))
