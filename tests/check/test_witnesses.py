# SPDX-License-Identifier: MIT
"""What drawings of one delivery say of each other's units, and from where a drawing is meant to be seen."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import shapely
from tests.check.test_ties import drawing

from foparq.check.drawn.columns import Columns
from foparq.check.drawn.stance import better_plane
from foparq.check.drawn.witnesses import with_witnesses
from foparq.columns import Geometries
from foparq.model.delivery import Delivery
from foparq.model.drawing import Drawing
from foparq.model.plane import plane_of


def showing(lines: Geometries | Sequence[shapely.LineString], *, path: str = "a.dxf", metres: float = 1.0) -> Drawing:
    """Drawing of four lines or more, in drawing units."""
    one = drawing(path=path)
    geometry = np.array(list(lines), dtype=object)
    rows = np.arange(len(geometry)) % len(one.items)
    items = replace(one.items.take(rows), geometry=geometry, item=rows.astype(str).astype(object))
    return replace(one, items=items, plane=plane_of("xy", geometry), unit=replace(one.unit, metres=metres))


def box(width: float) -> list[shapely.LineString]:
    return [shapely.LineString([(0, 0), (width, 0), (width, 10), (0, 10)])] * 4


def heard(*drawings: Drawing) -> list[list[tuple[str, float]]]:
    made = with_witnesses(Delivery(title="", sources=(), parts=drawings), None)
    return [[(one.path, one.says) for one in part.heard] for part in made.drawings]


def test_two_drawings_with_the_same_coordinates_in_other_units_speak_against_each_other() -> None:
    inches, centimetres = showing(box(1400), metres=0.0254), showing(box(1400), path="b.dxf", metres=0.01)
    assert heard(inches, centimetres) == [[("b.dxf", 0.01)], [("a.dxf", 0.0254)]]
    assert heard(inches, replace(centimetres, unit=inches.unit)) == [[], []]


@pytest.mark.parametrize(("width", "alike"), [(900, True), (899, False), (1000, True)])
def test_nine_tenths_of_the_joint_box_make_them_alike(width: float, alike: bool) -> None:  # noqa: FBT001
    pair = heard(showing(box(1000), metres=1.0), showing(box(width), path="b.dxf", metres=0.01))
    assert [bool(one) for one in pair] == [alike, alike]


def facade(level: int, upright: int) -> list[shapely.LineString]:
    """Lines of one metre in the plane of x and z, at a depth."""
    along = [shapely.LineString([(n, 3, n), (n + 1, 3, n)]) for n in range(level)]
    return along + [shapely.LineString([(n, 3, n), (n, 3, n + 1)]) for n in range(upright)]


@pytest.mark.parametrize(
    ("level", "upright", "better"), [(17, 3, "xz"), (18, 2, ""), (10, 10, "xz"), (0, 20, "xz"), (20, 0, "")]
)
def test_a_plane_that_shows_fifteen_hundredths_less_is_not_that_of_the_drawing(
    level: int, upright: int, better: str
) -> None:
    made = showing(facade(level, upright))
    assert better_plane(Columns(made, hidden=False)) == better
    assert better_plane(Columns(replace(made, plane=plane_of("xz", made.items.geometry)), hidden=False)) == ""


def test_no_plane_is_better_where_none_shows_nine_tenths() -> None:
    house = facade(6, 6) + [shapely.LineString([(n, 3, n), (n, 4, n)]) for n in range(6)]
    made = showing(house)
    assert all(
        better_plane(Columns(replace(made, plane=plane_of(name, made.items.geometry)), hidden=False)) == ""
        for name in ("xy", "xz", "yz")
    )


@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
def test_one_line_across_the_world_does_not_speak_for_a_facade_of_any_size(size: float) -> None:
    # It counts as ten of the two hundred others, and lies in the plane of x and y.
    across = shapely.LineString([(0, 3, 0), (0, 5000, 0)])
    lines = [shapely.transform(line, lambda way: way * size, include_z=True) for line in (*facade(100, 100), across)]
    assert better_plane(Columns(showing(lines), hidden=False)) == "xz"
