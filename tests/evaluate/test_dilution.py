# SPDX-License-Identifier: MIT
"""A rate of faults cannot be diluted with strokes that nobody sees; several drawings are told apart as well."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.evaluate.deliveries import drawing, drawn, one, parameter, spec

from foparq.check.run import check_part
from foparq.evaluate.quality import Element, ElementStatus
from foparq.model.drawing import Drawing
from foparq.profile.adjust import choose
from foparq.profile.load import load_profile

RULES = ("invalid-geometry", "zero-length", "duplicate", "undershoot")
PROFILE = choose(load_profile("et-doc-foparq-a"), RULES, ())
Q3 = spec("faulty-rate", id="Q3", rules=RULES)
SCALE = 50.0  # 0.2 mm on the sheet is 10 mm
Line = Sequence[tuple[float, float]]


def sketch(lines: Sequence[Line], path: str = "a.dxf") -> Drawing:
    """Lines in the plane xz."""
    made = drawing(path, n=len(lines))
    shapes = np.empty(len(lines), dtype=object)
    shapes[:] = [shapely.LineString([(x, 0.0, z) for x, z in line]) for line in lines]
    return replace(made, items=replace(made.items, geometry=shapes))


def rate(*drawings: Drawing) -> Element:
    outcomes = [outcome for part in drawings for outcome in check_part(part, PROFILE, SCALE).outcomes]
    return one(Q3, delivery=drawn(*drawings), outcomes=outcomes, scale=SCALE)


def posts(n: int, gap: float) -> list[Line]:
    """n posts that stop short of a beam, each with a beam of its own 3 m away from the next."""
    made: list[Line] = []
    for k in range(n):
        made += [((3 * k, 0), (3 * k + 2, 0)), ((3 * k + 1, -gap), (3 * k + 1, -1)), ((3 * k, -1), (3 * k + 2, -1))]
    return made


def strokes(n: int, length: float, at: float = 1000.0) -> list[Line]:
    """Strokes far from everything else and from each other."""
    return [((at + k, 7), (at + k + length, 7)) for k in range(n)]


def test_strokes_of_a_millimetre_hide_no_fault() -> None:
    faulty = posts(20, 0.004)
    alone, hidden = rate(sketch(faulty)), rate(sketch([*faulty, *strokes(3000, 0.001)]))
    assert (alone.value, alone.n, alone.status) == (pytest.approx(20 / 60), 60, ElementStatus.FAIL)
    assert (hidden.value, hidden.n, hidden.status) == (alone.value, alone.n, alone.status)
    assert parameter(hidden, "too-small") == 3000.0


@pytest.mark.parametrize(("length", "n"), [(0.0099, 60), (0.010, 100), (0.0101, 100)])
def test_what_is_exactly_as_large_as_visible_is_seen(length: float, n: int) -> None:
    exact = [((1000 + k, 7), (1000 + k, 7 + length)) for k in range(40)]
    assert rate(sketch([*posts(20, 0.004), *[((x, 0.0), (x, length)) for (x, _), _ in exact]])).n == n


def test_small_things_at_fault_count() -> None:
    """Each stroke of a pair drawn twice is 4 mm long: one of them repeats the other."""
    pairs = [line for line in strokes(7, 0.004) for _ in range(2)]
    element = rate(sketch([*posts(20, 0.0), *pairs]))
    assert (parameter(element, "faulty"), element.n) == (7.0, 60 + 7)


def test_only_small_things_are_no_evidence() -> None:
    element = rate(sketch(strokes(50, 0.003)))
    assert (element.status, element.value) == (ElementStatus.NOT_ASSESSED, None)
    assert [reason.message for reason in element.why] == ["checks.too-small"]


def test_the_rate_by_length_is_told_and_decides_nothing() -> None:
    element = rate(sketch(posts(20, 0.004)))
    assert parameter(element, "length") == pytest.approx(20 * (2 + 0.996 + 2))
    assert parameter(element, "length-faulty") == pytest.approx(20 * 0.996)
    assert parameter(element, "length-rate") == pytest.approx(0.996 / 4.996)


def test_several_drawings_are_told_apart_as_well() -> None:
    element = rate(sketch(posts(10, 0.004)), sketch([*posts(30, 0.0), *strokes(9, 0.001)], "b.dxf"))
    assert element.value == pytest.approx(10 / 120)
    apart = {name: (found, of) for name, found, of in element.details if name.endswith(".dxf")}
    assert apart == {"a.dxf": (10.0, 30.0), "b.dxf": (0.0, 90.0)}
    assert not [name for name, _, _ in rate(sketch(posts(10, 0.004))).details if name.endswith(".dxf")]


def test_a_drawing_over_the_limit_is_not_hidden_by_a_clean_one() -> None:
    """10 of 30 is more than a tenth, 10 of 120 is not; 3 of 30 is exactly a tenth, and may be."""
    clean = sketch(posts(30, 0.0), "b.dxf")
    element = rate(sketch(posts(10, 0.004)), clean)
    assert element.status is ElementStatus.UNDECIDED
    said = dict(element.why[0].fields)
    assert element.why[0].message == "faulty.one-drawing"
    assert (said["file"], said["faulty"], said["checked"]) == ("a.dxf", 10, 30)
    touched = rate(sketch([*posts(3, 0.004), *posts(7, 0.0)[3 * 3 :], *strokes(9, 1.5, at=500.0)]), clean)
    assert [row for row in touched.details if row[0] == "a.dxf"] == [("a.dxf", 3.0, 30.0)]
    assert touched.status is ElementStatus.PASS
    assert rate(sketch(posts(10, 0.004)), sketch(posts(3, 0.004), "b.dxf")).status is ElementStatus.FAIL


small = st.tuples(st.integers(0, 200), st.sampled_from([0.0, 0.0004, 0.001, 0.005, 0.0099]), st.booleans())


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 6), st.integers(1, 20), st.lists(small, max_size=60))
def test_small_strokes_never_turn_a_rejection(faulty: int, sound: int, added: list[tuple[int, float, bool]]) -> None:
    """Also strokes at fault by themselves: of no length, or drawn twice."""
    lines = [*posts(faulty, 0.004), *strokes(sound, 1.5, at=-900.0)]
    more: list[Line] = [
        ((1000 + place, 7), (1000 + place + (0 if up else length), 7 + (length if up else 0)))
        for place, length, up in added
    ]
    before, after = rate(sketch(lines)), rate(sketch([*lines, *more]))
    if before.status is ElementStatus.FAIL:
        assert after.status is ElementStatus.FAIL
    assert (after.value or 0.0) >= (before.value or 0.0)
