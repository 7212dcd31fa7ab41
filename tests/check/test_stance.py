# SPDX-License-Identifier: MIT
"""Whether a plane shows a facade, wherever the facade faces."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.evaluate.deliveries import drawing

from foparq.check.drawn.columns import Columns
from foparq.check.drawn.stance import better_plane
from foparq.model.plane import plane_of


def direction(degrees: float) -> tuple[float, float, float]:
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0.0


def seen_from(facing: float, plane: str | float) -> str:
    """Better plane for twelve windows of 1 m by 2 m in a facade that runs at an angle, degrees; a plane by its own."""
    x, y, _ = direction(facing)
    rings = [[(k, 0), (k + 1, 0), (k + 1, 2), (k, 2), (k, 0)] for k in range(0, 24, 2)]
    geometry = np.array([shapely.LineString([(u * x, u * y, v) for u, v in ring]) for ring in rings])
    stated = plane if isinstance(plane, str) else ((0.0, 0.0, 0.0), direction(plane), (0.0, 0.0, 1.0))
    made = drawing(n=len(rings))
    made = replace(made, items=replace(made.items, geometry=geometry), plane=plane_of(stated, geometry))
    return better_plane(Columns(made, hidden=False))


@pytest.mark.parametrize("facing", [0, 20, 45, 70, 90, 135])
def test_the_plane_of_a_facade_is_never_doubted(facing: float) -> None:
    assert seen_from(facing, facing) == ""
    assert seen_from(facing, "fit") == ""


@pytest.mark.parametrize(("facing", "plane", "better"), [
    (0, 90, "xz"), (90, 0, "yz"), (0, "yz", "xz"), (0, "xy", "xz"), (90, "xz", "yz"), (0, 60, "xz"),
    (45, -45, "fit"), (45, "xy", "fit"), (135, 45, "fit"),
])  # fmt: skip
def test_a_plane_that_shows_a_facade_from_its_edge_is_doubted(facing: float, plane: str | float, better: str) -> None:
    assert seen_from(facing, plane) == better
