# SPDX-License-Identifier: MIT
"""Two thousand random drawings on a grid of a tenth of a millimetre against slow readings of the definitions.

Corners short of a line, rows of dashes, ends that head for a line: what ``tests.geom.groups`` works out one pair at a
time, without a tree or a sorted column. Every kind must occur often, or the drawings would prove nothing.
"""

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from tests.geom import groups
from tests.geom.aims import AIM
from tests.geom.oracle import Aim as Told

from foparq.geom.ends import classify_ends
from foparq.geom.heading import heading_ends
from foparq.geom.nodes import short_nodes
from foparq.geom.polylines import Polylines

TENTH = 1e-4  #: metres
COINCIDE, REACH, HEADING = 5 * TENTH, 100 * TENTH, 500 * TENTH
TOLD = Told(*AIM)
Way = NDArray[np.float64]
Random = np.random.Generator


def table(lines: list[Way]) -> Polylines:
    index = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    return Polylines.of(shapely.linestrings(np.concatenate(lines), indices=index))


def on_grid(lines: list[Way]) -> list[Way]:
    """On the grid; lines that became points are left out."""
    rounded = [np.round(line / TENTH) * TENTH for line in lines]
    return [line for line in rounded if np.all(np.any(np.diff(line, axis=0) != 0, axis=1))]


def turned(line: Way, angle: float) -> Way:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.asarray(line @ np.array([[cosine, sine], [-sine, cosine]]))


def litter(rng: Random, count: int, size: float) -> list[Way]:
    """Lines of two to four vertices anywhere."""
    return [rng.uniform(0, size, (int(rng.integers(2, 5)), 2)) for _ in range(count)]


def corners(rng: Random) -> list[Way]:
    """Stars of two to six lines whose ends meet, near others, and litter."""
    lines = litter(rng, int(rng.integers(1, 4)), 0.03)
    for _ in range(int(rng.integers(1, 4))):
        middle = rng.uniform(0.002, 0.028, 2)
        for angle in rng.uniform(0, 2 * np.pi, int(rng.integers(2, 7))):
            start = middle + rng.integers(-3, 4, 2) * TENTH
            end = middle + rng.uniform(0.001, 0.02) * np.array([np.cos(angle), np.sin(angle)])
            lines.append(np.array([start, end])[:: int(rng.choice([-1, 1]))])
    if rng.random() < 0.5:  # a curve in single segments
        steps = np.cumsum(rng.uniform(-0.3, 0.3, 6)) + rng.uniform(0, 2 * np.pi)
        way = rng.uniform(0, 0.03, 2) + np.cumsum(0.004 * np.column_stack([np.cos(steps), np.sin(steps)]), axis=0)
        lines += [way[n : n + 2] for n in range(5)]
    return on_grid(lines)


def dashed(rng: Random) -> list[Way]:
    """Rows, straight or bent, of one to three lengths in turn, some out of step; litter."""
    lines = litter(rng, int(rng.integers(0, 3)), 0.2)
    for _ in range(int(rng.integers(1, 3))):
        pattern = rng.uniform(0.004, 0.03, int(rng.integers(1, 4)))
        gap, count = rng.uniform(0.002, 0.0098), int(rng.integers(3, 12))
        bend, odd = rng.choice([0.0, 0.05]), rng.choice([0.0, 0.1, 0.3])
        at, angle, step = rng.uniform(0, 0.1, 2), rng.uniform(0, 2 * np.pi), rng.uniform(-bend, bend)
        for n in range(count):
            length = pattern[n % len(pattern)] * (1 + odd * rng.uniform(-1, 1))
            way = np.array([np.cos(angle), np.sin(angle)])
            lines.append(np.array([at, at + length * way])[:: int(rng.choice([-1, 1]))])
            at, angle = at + (length + gap * (1 + 0.5 * odd * rng.uniform(-1, 1))) * way, angle + step
        if rng.random() < 0.4:
            lines += posts(rng, lines[-count:], gap)
    order = rng.permutation(len(lines))
    return on_grid([lines[n] for n in order])


def posts(rng: Random, row: list[Way], gap: float) -> list[Way]:
    """Lines across a row: in its gaps, across its ends, or anywhere."""
    inset, often = rng.choice([-0.5 * gap, 0.001]), rng.choice([0.3, 0.6, 1.0])
    across, made = np.array([[0.0, -0.02], [0.0, 0.02]]), []
    for line in row:
        step = line[1] - line[0]
        length, angle = float(np.hypot(*step)), float(np.arctan2(step[1], step[0]))
        places = (inset, length - inset) if inset > 0 else (length - inset,)
        made += [turned(across, angle) + line[0] + step / length * at for at in places if rng.random() < often]
    return made


def bars(rng: Random) -> list[Way]:
    """Bars that stop up to 60 mm short of hosts and of corners, outlines left open, and litter."""
    lines = litter(rng, int(rng.integers(0, 3)), 0.3)
    for _ in range(int(rng.integers(1, 4))):
        host = turned(np.array([[-0.1, 0.0], [0.1, 0.0]]), rng.uniform(0, np.pi)) + rng.uniform(0.05, 0.25, 2)
        angle, gap = rng.uniform(0, 2 * np.pi), rng.uniform(0.0, 0.06)
        way = np.array([np.cos(angle), np.sin(angle)])
        middle = host.mean(axis=0)
        near, far = middle + gap * way, middle + (gap + rng.uniform(0.02, 0.1)) * way
        lines += [host, np.array([near, far])]
        if rng.random() < 0.3:  # what goes on in line
            lines.append(np.array([far + rng.uniform(0.011, 0.04) * way, far + 0.06 * way]))
        if rng.random() < 0.3:  # an outline left open before a host
            turn = np.linspace(0.0, 2 * np.pi * rng.uniform(0.6, 0.97), int(rng.integers(4, 12)))
            around = rng.uniform(0.01, 0.03) * np.column_stack([np.cos(turn), np.sin(turn)])
            lines.append(turned(around, rng.uniform(0, 2 * np.pi)) + middle + rng.uniform(-0.05, 0.05, 2))
    return on_grid(lines)


def random_drawings(make: Callable[[Random], list[Way]], seed: int, count: int) -> list[list[Way]]:
    rng = np.random.default_rng(seed)
    return [lines for lines in (make(rng) for _ in range(count)) if len(lines) > 1]


@pytest.mark.parametrize("seed", range(4))
def test_corners_short_of_a_line(seed: int) -> None:
    often = 0
    for lines in random_drawings(corners, seed, 200):
        found = short_nodes(table(lines), AIM, coincide=COINCIDE, reach=REACH)
        expected = groups.short_corners(lines, coincide=COINCIDE, reach=REACH, aim=TOLD)
        assert len(found.line) == len(expected), lines
        for line, size, other in zip(found.line.tolist(), found.size, found.other.tolist(), strict=True):
            fits = [
                told for told in expected
                if line in told.lines and other in told.others and abs(size - told.size) < 1e-7
            ]  # fmt: skip
            assert fits, (lines, line, size, other, expected)
        often += bool(expected)
    assert often > 60


@pytest.mark.parametrize("seed", range(4))
def test_rows_of_dashes(seed: int) -> None:
    often = without = doubtful = 0
    for lines in random_drawings(dashed, seed, 150):
        try:
            expected = groups.dash_rows(lines, coincide=COINCIDE, reach=REACH, aim=TOLD)
        except groups.AmbiguousError:
            doubtful += 1
            continue
        ends = classify_ends(table(lines), AIM, coincide=COINCIDE, reach=REACH)
        found = {frozenset(ends.dash[ends.row == row].tolist()) for row in np.unique(ends.row)}
        assert found == expected, lines
        often += bool(expected)
        without += not expected
    assert often > 40
    assert without > 20
    assert doubtful < 15


@pytest.mark.parametrize("seed", range(4))
def test_ends_that_head_for_a_line(seed: int) -> None:
    often = 0
    for lines in random_drawings(bars, seed, 150):
        made = table(lines)
        found = heading_ends(made, AIM, coincide=COINCIDE, reach=REACH, heading=HEADING)
        expected = groups.heads(lines, coincide=COINCIDE, reach=REACH, heading=HEADING, aim=TOLD)
        heads = {(n, int(made.heads[n])): (n, False) for n in range(len(lines))}
        tails = {(n, int(made.tails[n])): (n, True) for n in range(len(lines))}
        told = {
            (heads | tails)[line, vertex]: (size, other)
            for line, vertex, size, other in zip(
                found.line.tolist(), found.vertex.tolist(), found.size, found.other.tolist(), strict=True
            )
        }
        assert set(told) == set(expected), lines
        for end, (size, other) in told.items():
            assert size == pytest.approx(expected[end].size, abs=1e-7)
            assert other in expected[end].others
        often += bool(expected)
    assert often > 60
