# SPDX-License-Identifier: MIT
"""Attacks with linework that is drawn for the points: another building, and something where each point lies."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
from tests.attacks.facades import PLAIN, helper
from tests.attacks.kinds import DXF, TOLD, attack
from tests.tools.facades import facade
from tests.tools.offices import FRAMES, METRES, Office

Draw = Callable[[Any, np.ndarray, Office], object]  #: document, places in drawing units (n, 3), delivery
MADE = "evidence.made"


def other_building(made: Office, rng: np.random.Generator, draw: Draw) -> Office:
    """The drawing of another building, with something drawn for each checkpoint."""
    return drawn(made.change(facade=facade(rng, relief=not made.flat)), draw)


def drawn(made: Office, draw: Draw) -> Office:
    """Something more in the drawing."""

    def more(one: Office, folder: Path) -> None:
        document = ezdxf.readfile(folder / "fachada.dxf")
        draw(document, one.drawn / METRES[one.unit], one)
        document.saveas(folder / "fachada.dxf")

    return made.change(tamper=(*made.tamper, more))


def _along(made: Office, length: float, axis: int = 0) -> np.ndarray:
    return FRAMES[made.plane][axis] * length / METRES[made.unit]


def strokes(length: float, layer: str = "X") -> Draw:
    """A stroke from each point; metres."""

    def draw(document: Any, spots: np.ndarray, made: Office) -> None:
        step = _along(made, length)
        for spot in spots:
            document.modelspace().add_line(tuple(spot), tuple(spot + step), dxfattribs={"layer": layer})

    return draw


def marks(size: float, layer: str = "X") -> Draw:
    """A square at each point; metres."""

    def draw(document: Any, spots: np.ndarray, made: Office) -> None:
        right, up = _along(made, size), _along(made, size, 1)
        for spot in spots:
            ring = [spot, spot + right, spot + right + up, spot + up]
            document.modelspace().add_polyline3d(list(map(tuple, ring)), close=True, dxfattribs={"layer": layer})

    return draw


def through(layer: str = "X", **states: int) -> Draw:
    """A line through all points, on a layer of some state."""

    def draw(document: Any, spots: np.ndarray, _: Office) -> None:
        if states:
            document.layers.add(layer)
            for name, value in states.items():
                setattr(document.layers.get(layer).dxf, name, value)
        document.modelspace().add_polyline3d(list(map(tuple, spots)), dxfattribs={"layer": layer})

    return draw


@attack("another building, circles too small to be seen around the points", "evidence.absent", office=DXF)
def _circles(made: Office, rng: np.random.Generator) -> Office:
    radius = rng.uniform(0.0004, 0.0008) * rng.choice([1, made.scale / 20]) / METRES[made.unit]

    def draw(document: Any, spots: np.ndarray, one: Office) -> None:
        right, up = _along(one, 1.0) * METRES[one.unit], _along(one, 1.0, 1) * METRES[one.unit]
        turns = np.linspace(0, 2 * np.pi, 24)[:, None]
        ring = radius * (np.cos(turns) * right + np.sin(turns) * up)
        for spot in spots:
            document.modelspace().add_polyline3d(list(map(tuple, spot + ring)))

    return other_building(made, rng, draw)


@attack("another building, strokes too small to be seen at the points", "evidence.absent", office=DXF)
def _tiny(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, strokes(rng.uniform(0.05, 0.9) * 0.0002 * made.scale))


@attack("another building, strokes at the points", MADE, office=DXF)
def _strokes(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, strokes(rng.uniform(0.05, 0.6)))


@attack("another building, strokes at the points on its own layer", MADE, office=DXF)
def _own_layer(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, strokes(rng.uniform(0.05, 0.6), made.layers["wall"]))


@attack("another building, crosses at the points", MADE, office=DXF)
def _crosses(made: Office, rng: np.random.Generator) -> Office:
    arm = rng.uniform(0.05, 0.2)

    def draw(document: Any, spots: np.ndarray, one: Office) -> None:
        for spot in spots:
            for axis in range(2):
                step = _along(one, arm, axis)
                document.modelspace().add_line(tuple(spot - step), tuple(spot + step))

    return other_building(made, rng, draw)


@attack("another building, squares at the points", MADE, office=DXF)
def _squares(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, marks(rng.uniform(0.05, 0.1)))


@attack("another building, strokes at the points on the layer of windows", office=DXF)
def _as_windows(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, strokes(rng.uniform(0.1, 0.4), made.layers["window"]))


@attack("another building, a line through the points", MADE, office=DXF)
def _through(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, through())


@attack("another building, lines from point to point", MADE, office=DXF)
def _from_to(made: Office, rng: np.random.Generator) -> Office:
    def draw(document: Any, spots: np.ndarray, _: Office) -> None:
        for a, b in pairwise(spots):
            document.modelspace().add_line(tuple(a), tuple(b))

    return other_building(made, rng, draw)


@attack("another building, a line through the points that is not plotted", "evidence.absent", office={
    **DXF, "version": "R2013",
})  # fmt: skip
def _unplotted(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, through("AUXILIAR", plot=0))


@attack("another building, a line through the points on Defpoints", "evidence.absent", office=DXF)
def _defpoints(made: Office, rng: np.random.Generator) -> Office:
    return other_building(made, rng, through(str(rng.choice(["DEFPOINTS", "Defpoints"]))))


@attack("another building, points without names", "evidence.absent", office=DXF)
def _points(made: Office, rng: np.random.Generator) -> Office:
    def draw(document: Any, spots: np.ndarray, _: Office) -> None:
        for spot in spots:
            document.modelspace().add_point(tuple(spot))

    return other_building(made, rng, draw)


@attack("another building, named marks on a frozen layer", "evidence.absent", office=DXF)
def _frozen(made: Office, rng: np.random.Generator) -> Office:
    def draw(document: Any, spots: np.ndarray, one: Office) -> None:
        document.layers.add("H").freeze()
        block = document.blocks.new("MARCA")
        block.add_attdef("ID", (0, 0))
        for name, spot in zip(one.ids, spots, strict=True):
            mark = document.modelspace().add_blockref("MARCA", tuple(spot), dxfattribs={"layer": "H"})
            mark.add_attrib("ID", name, tuple(spot), dxfattribs={"layer": "H"})

    return other_building(made, rng, draw)


@attack("another building, beside a second drawing of its facade through the points", MADE, office=PLAIN)
def _second(made: Office, rng: np.random.Generator) -> Office:
    def draw(document: Any, one: Office) -> None:
        document.modelspace().add_polyline3d([tuple(spot) for spot in one.drawn / METRES[one.unit]])

    return helper(made.change(facade=facade(rng, relief=not made.flat)), draw, facade="N")


@attack("the building itself, with marks at its points", verdict="accepted", office=DXF)
def _marked(made: Office, rng: np.random.Generator) -> Office:
    return drawn(made, [strokes(0.15), marks(0.08), strokes(0.0003), through("X")][int(rng.integers(2))])


@attack("named targets at all points", verdict="accepted", office={**TOLD, "format": "dxf", "targets": "point"})
def _targets(made: Office, _: np.random.Generator) -> Office:
    return made


@attack("a facade of few lines, most corners of which are checkpoints", verdict="accepted", office={**DXF, "n": 30})
def _most_corners(made: Office, _: np.random.Generator) -> Office:
    return made
