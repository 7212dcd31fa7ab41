# SPDX-License-Identifier: MIT
"""Facades of small buildings: shapes on the sheet, metres; right, up, and depth toward who looks at them."""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

Spot = tuple[float, float, float]

#: classes and the layers that two offices draw them on
LAYERS = (
    {"window": "JANELA", "door": "PORTA", "cornice": "CIMALHA", "panel": "PAINEL", "wall": "PAREDE"},
    {"window": "A-ESQ-JANELAS", "door": "A-ESQ-PORTAS", "cornice": "A-CORNIJA", "panel": "A-ALMOFADA", "wall": "A-ALV"},
)


@dataclass(frozen=True, slots=True)
class Part:
    """One feature: a closed line, and lines within it that end on it."""

    kind: str  #: class; ``wall`` is none
    ring: tuple[Spot, ...]
    inner: tuple[tuple[Spot, Spot], ...] = ()


@dataclass(slots=True)
class Facade:
    """What is drawn of a building."""

    width: float
    height: float
    parts: list[Part] = field(default_factory=list)
    columns: list[tuple[float, float]] = field(default_factory=list)  #: left and right edges

    def count(self, kind: str) -> int:
        """Features of one class."""
        return sum(part.kind == kind for part in self.parts)

    def corners(self) -> np.ndarray:
        """(n, 3) corners of everything."""
        return np.array([spot for part in self.parts for spot in part.ring])


def facade(rng: np.random.Generator, *, relief: bool) -> Facade:
    """A facade with 12 to 60 windows of unequal sizes and distances, doors, panels, and a cornice.

    Parameters
    ----------
    relief : bool
        Whether windows, doors and the cornice lie before or behind the wall.
    """
    floors = int(rng.integers(2, 5))
    across = int(rng.integers(-(-12 // floors), 60 // floors + 1))
    doors = int(rng.integers(1, 3))
    wide, gap = rng.uniform(0.8, 1.9, across + doors), rng.uniform(0.6, 2.2, across + doors + 1)
    edges = np.round(np.cumsum(np.ravel(np.column_stack([gap[:-1], wide]))), 4).reshape(-1, 2)
    width = round(float(edges[-1, 1] + gap[-1]), 4)
    is_door = np.zeros(across + doors, dtype=bool)
    is_door[rng.choice(across + doors, doors, replace=False)] = True
    depth = np.round(rng.uniform(0.05, 0.4, 4) * [-1, -1, 1, 1], 3) * relief
    made = Facade(width, 0.0)
    foot = 0.0
    for floor in range(floors):
        sill, high = rng.uniform(0.7, 1.2), rng.uniform(1.2, 2.4)
        for (left, right), door in zip(edges, is_door, strict=True):
            a, b = np.round(rng.uniform(-0.08, 0.08, 2) + np.array([left, right]), 4)
            low, top = np.round(foot + sill + rng.uniform(-0.05, 0.05, 2) + np.array([0.0, high]), 4)
            if door and floor == 0:
                made.parts.append(_opening("door", a, b, 0.06, top, depth[1]))
            elif not door:
                made.parts.append(_opening("window", a, b, low, top, depth[0]))
        foot = round(float(foot + sill + high + rng.uniform(0.5, 1.0)), 4)
    made.columns = [(float(a), float(b)) for a, b in edges]
    for (_, left), (right, _) in pairwise(made.columns):
        if right - left > 1.2:
            inset = rng.uniform(0.25, 0.4, 2)
            made.parts.append(_opening("panel", left + inset[0], right - inset[1], foot + 0.2, foot + 0.7, 0.0, bars=0))
    made.height = round(foot + 1.0, 4)
    made.parts += [_wall(made), _cornice(made, float(depth[2]), rng)]
    return made


def _opening(kind: str, a: float, b: float, low: float, top: float, depth: float, bars: int = 2) -> Part:
    a, b, low, top = (round(float(value), 4) for value in (a, b, low, top))
    middle, rail = round((a + b) / 2, 4), round(low + 0.6 * (top - low), 4)
    d = float(depth)
    ring = ((a, low, d), (b, low, d), (b, top, d), (a, top, d))
    inner = (((middle, low, d), (middle, top, d)), ((a, rail, d), (b, rail, d)))
    return Part(kind, ring, inner[:bars])


def _wall(made: Facade) -> Part:
    w, h = made.width, made.height
    return Part("wall", ((0.0, 0.0, 0.0), (w, 0.0, 0.0), (w, h, 0.0), (0.0, h, 0.0)))


def _cornice(made: Facade, depth: float, rng: np.random.Generator) -> Part:
    w, low = made.width, made.height + 0.15
    steps = np.round(np.cumsum(rng.uniform(0.35, 0.6, 2)), 4)
    out = np.round(np.cumsum(rng.uniform(0.35, 0.6, 1)), 4)[0]
    heights = (low, low + steps[0], low + steps[1])
    low, middle, top = (round(float(value), 4) for value in heights)
    right, left = round(float(w + out), 4), round(float(-out), 4)
    corners = (
        (0.0, low),
        (w, low),
        (w, middle),
        (right, middle),
        (right, top),
        (left, top),
        (left, middle),
        (0.0, middle),
    )
    return Part("cornice", tuple((u, v, depth) for u, v in corners))


def lonely(corners: np.ndarray, radius: float, *, deep: bool) -> np.ndarray:
    """Corners (k, 3) with no other one within a radius."""
    axes = 3 if deep else 2
    apart = np.linalg.norm(corners[:, None, :axes] - corners[None, :, :axes], axis=2)
    return corners[(apart <= radius).sum(axis=1) == 1]
