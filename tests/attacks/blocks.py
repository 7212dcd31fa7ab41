# SPDX-License-Identifier: MIT
"""Attacks with blocks: linework in small ones, so that it passes for symbols, and symbols that cover what is at fault.

Posts stand beside the facade; bars between them stop short on one side or on both, far more than the limit allows.
"""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
from tests.attacks.kinds import DXF, attack
from tests.tools.offices import FRAMES, METRES, Office

BARS = 240
Draw = Callable[[Any, "Ground"], object]


class Ground:
    """Places beside the facade, given in millimetres on the sheet."""

    def __init__(self, document: Any, made: Office) -> None:
        self.document, self.layer = document, made.layers["wall"]
        self._unit = made.scale / 1000 / METRES[made.unit]
        self._right, self._up = FRAMES[made.plane][:2]
        self._corner = made.origin / METRES[made.unit] + self._right * (made.facade.width + 1) / METRES[made.unit]

    def place(self, x: float, y: float) -> tuple[float, ...]:
        """Coordinates in the drawing."""
        return tuple((self._corner + (self._right * x + self._up * y) * self._unit).tolist())

    def line(self, *places: tuple[float, float], into: Any = None) -> None:
        """A line from place to place."""
        into = self.document.modelspace() if into is None else into
        for a, b in pairwise(places):
            into.add_line(self.place(*a), self.place(*b), dxfattribs={"layer": self.layer})

    def block(self, name: str) -> Any:
        """A block whose base lies at the place (0, 0)."""
        return self.document.blocks.new(name, base_point=self.place(0, 0))

    def insert(self, name: str, x: float, y: float) -> None:
        """An insert of it at a place."""
        self.document.modelspace().add_blockref(name, self.place(x, y), dxfattribs={"layer": self.layer})


def beside(made: Office, draw: Draw) -> Office:
    """Something drawn beside the facade."""

    def more(one: Office, folder: Path) -> None:
        document = ezdxf.readfile(folder / "fachada.dxf")
        draw(document, Ground(document, one))
        document.saveas(folder / "fachada.dxf")

    return made.change(tamper=(*made.tamper, more))


def spots() -> list[tuple[float, float]]:
    """Lower left corners of the bars, millimetres on the sheet."""
    return [(n % 20 * 6.0, n // 20 * 6.0) for n in range(BARS)]


def posts(ground: Ground, width: float) -> None:
    """A post on each side of every bar."""
    for x, y in spots():
        ground.line((x, y - 2), (x, y + 2))
        ground.line((x + width, y - 2), (x + width, y + 2))


@attack("bars that stop short, each a block of its own", verdict="rejected", office=DXF, variants=3)
def _own(made: Office, rng: np.random.Generator) -> Office:
    gap = rng.uniform(0.02, 0.18)

    def draw(_: Any, ground: Ground) -> None:
        posts(ground, 2.0)
        for n, (x, y) in enumerate(spots()):
            ground.line((0, 0), (2 - gap, 0), into=ground.block(f"B{n}"))
            ground.insert(f"B{n}", x, y)

    return beside(made, draw)


@attack("bars that stop short, all of one block", verdict="rejected", office=DXF, variants=3)
def _one(made: Office, rng: np.random.Generator) -> Office:
    left, right = rng.uniform(0.02, 0.18, 2) * rng.permutation([rng.integers(0, 2), 1])

    def draw(_: Any, ground: Ground) -> None:
        posts(ground, 2.0)
        ground.line((left, 0), (2 - right, 0), into=ground.block("B"))
        for x, y in spots():
            ground.insert("B", x, y)

    return beside(made, draw)


@attack("bars that stop short on one side, and as many more of the block in the open", verdict="rejected", office=DXF,
        variants=3)  # fmt: skip
def _decoys(made: Office, rng: np.random.Generator) -> Office:
    gap = rng.uniform(0.02, 0.18)

    def draw(_: Any, ground: Ground) -> None:
        posts(ground, 2.0)
        ground.line((0, 0), (2 - gap, 0), into=ground.block("B"))
        for x, y in spots():
            ground.insert("B", x, y)
            ground.insert("B", x + 140, y)
        ground.insert("B", 130, 0)

    return beside(made, draw)


@attack("a symbol on every end that stops short", verdict="rejected", office=DXF, variants=3)
def _covered(made: Office, rng: np.random.Generator) -> Office:
    gap, arm = rng.uniform(0.02, 0.18), rng.uniform(0.3, 1.0)

    def draw(_: Any, ground: Ground) -> None:
        posts(ground, 5.0)
        sign = ground.block("S")
        ground.line((-arm, 0), (arm, 0), into=sign)
        ground.line((0, -arm), (0, arm), into=sign)
        for x, y in spots():
            ground.line((x, y), (x + 5 - gap, y))
            ground.insert("S", x + 5 - gap, y)
            ground.insert("S", x + 140, y)
            ground.insert("S", x + 140, y + 3)

    return beside(made, draw)


@attack("symbols that thin out the rate of faults", verdict="rejected", office=DXF, variants=2)
def _thinned(made: Office, rng: np.random.Generator) -> Office:
    gap = rng.uniform(0.02, 0.18)

    def draw(_: Any, ground: Ground) -> None:
        for x, y in spots():
            ground.line((x, y - 2), (x, y + 2))
            ground.line((x, y), (x + 4 - gap, y))
            ground.line((x + 4, y - 2), (x + 4, y + 2))
        sign = ground.block("S")
        ground.line((-1, 0), (1, 0), into=sign)
        ground.line((0, -1), (0, 1), into=sign)
        for n in range(4000):
            ground.insert("S", 140 + n % 100 * 3.0, n // 100 * 3.0)

    return beside(made, draw)
