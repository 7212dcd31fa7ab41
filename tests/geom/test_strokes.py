# SPDX-License-Identifier: MIT
"""Lines no longer than a point: they join what they touch, and hide nothing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tests.geom.aims import AIM
from tests.geom.oracle import Aim as Told
from tests.geom.oracle import classify_all

from foparq.geom.ends import NOBODY, EndKind, classify_ends
from foparq.geom.polylines import Polylines
from foparq.geom.strokes import joints
from foparq.model.inputs import lines_of

COINCIDE, REACH = 0.0005, 0.010
BEAM, POST = "LINESTRING (-1 0, 1 0)", "LINESTRING (0 -0.005, 0 -1)"


def table(*lines: str) -> Polylines:
    return lines_of(lines).polylines


def top_of_the_post(*lines: str) -> tuple[EndKind, float, int]:
    """What the upper end of the second line is."""
    ends = classify_ends(table(*lines), AIM, coincide=COINCIDE, reach=REACH)
    row = int(np.flatnonzero((ends.line == 1) & ends.forward)[0])
    return EndKind(ends.kind[row]), float(ends.size[row]), int(ends.other[row])


@pytest.mark.parametrize(
    "strokes",
    [
        ["LINESTRING (0 -0.005, 0 -0.005)"],
        ["LINESTRING (0 -0.005, 0 -0.0045)"],
        ["LINESTRING (0 -0.005, 0 -0.0046)", "LINESTRING (0 -0.0046, 0 -0.0042)"],
        ["LINESTRING (0 -0.003, 0 -0.0026)"],
    ],
    ids=["a dot on the end", "a stroke on the end", "a chain that leads nowhere", "a stroke on the way"],
)
def test_a_stroke_hides_no_undershoot(strokes: list[str]) -> None:
    assert top_of_the_post(BEAM, POST, *strokes) == (EndKind.UNDERSHOOT, pytest.approx(0.005), 0)


def test_strokes_that_lead_there_join() -> None:
    chain = [f"LINESTRING (0 {-0.0005 * n}, 0 {-0.0005 * (n + 1)})" for n in range(10)]
    assert top_of_the_post(BEAM, POST, *chain) == (EndKind.CONNECTED, 0.0, NOBODY)
    # A piece left out leaves a hole of twice coincide.
    assert top_of_the_post(BEAM, POST, *chain[:4], *chain[6:])[0] is EndKind.UNDERSHOOT


def test_strokes_join_in_depth_as_in_the_plane() -> None:
    high = "LINESTRING Z (0 -0.005 0.1, 0 -0.0045 0.1)"
    chain = [f"LINESTRING Z (0 {-0.0005 * n} 0.1, 0 {-0.0005 * (n + 1)} 0.1)" for n in range(9)]
    assert top_of_the_post(BEAM, POST, high, *chain)[0] is EndKind.UNDERSHOOT


@pytest.mark.parametrize("low", [[], ["LINESTRING Z (0 -0.005 0, 0 -0.0047 0)"]], ids=["over the end", "over a stroke"])
def test_a_stroke_overhead_joins_nothing_below(low: list[str]) -> None:
    overhead = ["LINESTRING Z (-1 -0.005 0.1, 1 -0.005 0.1)", "LINESTRING Z (0 -0.005 0.1, 0 -0.0046 0.1)"]
    deep = ["LINESTRING Z (-1 0 0, 1 0 0)", "LINESTRING Z (0 -0.005 0, 0 -1 0)"]
    assert top_of_the_post(*deep, *overhead, *low) == (EndKind.UNDERSHOOT, pytest.approx(0.005), 0)


def test_a_line_that_comes_back_to_itself_through_strokes_is_no_loose_end() -> None:
    ring = "LINESTRING (0 0, 1 0, 1 1, 0 1, 0 0.001)"
    ends = classify_ends(
        table(ring, "LINESTRING (0 0, 0 0.0005)", "LINESTRING (0 0.0005, 0 0.001)"), AIM, coincide=COINCIDE, reach=REACH
    )
    assert ends.kind.tolist() == [EndKind.CONNECTED] * 2


def test_a_stroke_that_only_touches_the_end_it_lies_on_joins_nothing() -> None:
    ends = classify_ends(table(POST, "LINESTRING (0 -0.005, 0 -0.0048)"), AIM, coincide=COINCIDE, reach=REACH)
    assert ends.kind.tolist() == [EndKind.FREE] * 2


def test_a_heap_of_strokes_is_one_joint() -> None:
    found = joints(table(BEAM, *["LINESTRING (0 0, 0 0.0001)"] * 3000), np.arange(3001) > 0, within=COINCIDE)
    assert set(found.joint.tolist()) == {0}
    assert len(found.segment) == 6000


@pytest.mark.parametrize(("depth", "touched"), [(5.0, 2), (-5.0, 0), (0.0, 0)])
def test_a_stroke_touches_what_lies_in_its_own_depth(depth: float, touched: int) -> None:
    lines = table(f"LINESTRING Z (-1 0 {depth}, 1 0 {depth})", "LINESTRING Z (0 0 5, 0 0.0001 5)")
    assert len(joints(lines, np.array([False, True]), within=COINCIDE).segment) == touched


Way = NDArray[np.float64]


def crowded() -> st.SearchStrategy[list[Way]]:
    """Long lines and strokes on a grid of a tenth of a millimetre, near each other."""
    tenth = st.integers(0, 60)
    long = st.tuples(tenth, tenth, tenth, tenth).map(lambda c: np.array([[c[0], c[1]], [c[2] + 80, c[3]]]) * 1e-4)
    short = st.tuples(tenth, tenth, st.integers(-4, 4), st.integers(-3, 3)).map(
        lambda c: np.array([[c[0], c[1]], [c[0] + c[2], c[1] + c[3]]]) * 1e-4
    )
    return st.tuples(st.lists(long, min_size=1, max_size=4), st.lists(short, max_size=12)).map(
        lambda two: [*two[0], *two[1]]
    )


@settings(max_examples=300, deadline=None, derandomize=True)
@given(crowded())
def test_ends_among_strokes_are_what_the_definitions_say(lines: list[Way]) -> None:
    reach = 0.00305  # no distance on the grid
    coincide = 0.00051
    offsets = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
    ends = classify_ends(Polylines(np.concatenate(lines), offsets), AIM, coincide=coincide, reach=reach)
    expected = classify_all(lines, coincide=coincide, reach=reach, aim=Told(*AIM))
    assert [EndKind(kind).name.lower() for kind in ends.kind] == [want.kind for want in expected]
    assert ends.size.tolist() == pytest.approx([want.size for want in expected], abs=1e-7)
