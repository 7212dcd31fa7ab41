# SPDX-License-Identifier: MIT
"""Splines that say that they are closed."""

from pathlib import Path

import pytest
import shapely
from tests.read.drawn import new, read_back

LOOP = [(100.0, 100.0, 0.0), (140.0, 100.0, 0.0), (140.0, 130.0, 0.0), (100.0, 130.0, 0.0)]


@pytest.mark.parametrize(("off", "extra"), [(0.0, 0), (1e-9, 0), (1e-7, 1), (1e-3, 1), (5.0, 1)])
def test_a_closed_spline_returns_to_its_start(tmp_path: Path, off: float, extra: int) -> None:
    """An end that misses the start by rounding becomes it; one that lies elsewhere is joined to it."""
    document = new()
    x, y, z = LOOP[0]
    control = [*LOOP, (x + off, y, z)]
    document.modelspace().add_open_spline(control, degree=1)
    spline = document.modelspace().add_open_spline(control, degree=1)
    spline.closed = True
    plain, closed = read_back(document, tmp_path).items.geometry
    assert shapely.get_num_coordinates(plain) == 5
    assert shapely.get_num_coordinates(closed) == 5 + extra
    assert closed.is_closed
    ring = shapely.get_coordinates(closed)
    assert ring[0].tolist() == ring[-1].tolist() == [x, y]
    assert closed.length == pytest.approx(140.0 + off if off < 1 else plain.length + off)
