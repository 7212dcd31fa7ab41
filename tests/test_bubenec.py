# SPDX-License-Identifier: MIT
"""Cadastral plots of Prague-Bubenec with natural slivers, against counts that nobody here made."""

from pathlib import Path

import numpy as np
import pyogrio
import pytest
import shapely
from numpy.typing import NDArray

from foparq.check.registry import all_rules
from foparq.model.inputs import areas_of

pytestmark = pytest.mark.shared


@pytest.fixture(scope="module")
def plots(shared: Path) -> NDArray[np.object_]:
    _, _, geometry, _ = pyogrio.raw.read(shared / "data" / "drawings" / "bubenec" / "bubenec.gpkg", layer="plots")
    read: NDArray[np.object_] = shapely.from_wkb(geometry)
    return read


def test_no_plot_is_invalid(plots: NDArray[np.object_]) -> None:
    assert shapely.is_valid(plots).all()


def test_overlaps_of_more_than_a_square_centimetre(plots: NDArray[np.object_]) -> None:
    hits = all_rules()["TOP031"].check(areas_of(plots), least=1e-4)
    assert len(hits) == 23
    assert hits.size.sum() == pytest.approx(0.3093, abs=5e-5)
    assert np.count_nonzero(hits.size > 0.01) == 15
    assert hits.size.max() < 1


@pytest.mark.parametrize("coincide", [1e-6, 1e-4])
def test_gaps_of_less_than_a_square_metre(plots: NDArray[np.object_], coincide: float) -> None:
    hits = all_rules()["TOP032"].check(areas_of(plots), coincide=coincide, most=1.0)
    assert len(hits) == 84
    # An independent reading: holes of the union, without any growing.
    parts = shapely.get_parts(shapely.union_all(plots))
    holes = np.array([shapely.Polygon(ring).area for part in parts for ring in part.interiors])
    assert len(holes) == 87
    assert np.sort(hits.size) == pytest.approx(np.sort(holes[holes < 1]), abs=1e-4)


def test_gaps_narrower_than_coincide_are_none(plots: NDArray[np.object_]) -> None:
    hits = all_rules()["TOP032"].check(areas_of(plots), coincide=0.001, most=1.0)
    radius = [shapely.length(shapely.maximum_inscribed_circle(place)) for place in hits.where]
    assert len(hits) < 84
    # The circle is found to a thousandth of the size of the gap.
    assert min(radius) > 0.0004
