# SPDX-License-Identifier: MIT
"""Less evidence never helps; names and order say nothing."""

import tempfile
import unicodedata
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.attacks import evidence, facades, marks, repetition, statements  # noqa: F401 - enter their attacks
from tests.attacks.kinds import ATTACKS
from tests.tools.offices import Office, office
from tests.tools.sound import audited

from foparq.evaluate.quality import QualityReport

KINDS = {kind.name: kind for kind in ATTACKS}
#: attacks that concern the whole drawing: no choice of rows makes them sound
WHOLE = (
    "drawing exchanged for another office's", "mirrored left to right", "stretched by 2 to 8 %",
    "moved by 20 to 500 mm", "all points 1000 km away", "axes exchanged", "unit of the table wrong",
    "unit of the drawing wrong, against header and tables", "plane wrong", "scale beyond those of the product",
    "title block and viewport at another scale", "two drawings alike in inches and centimetres", "degrees",
    "one mark seven times under seven names", "distances of 500 m",
)  # fmt: skip
FEW = settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def judged(made: Office) -> QualityReport:
    with tempfile.TemporaryDirectory() as folder:
        return audited(made, Path(folder) / "delivery").record.quality


def attacked(name: str, seed: int) -> Office:
    kind, rng = KINDS[name], np.random.default_rng([seed, 77])
    return kind.change(office(1000 + seed, **{"n": int(rng.integers(7, 13)), **kind.office}), rng)


def without_rows(made: Office, points: list[int], lengths: list[int]) -> Office:
    """Only some rows of both tables; distances keep the names of their ends."""
    p, d = np.array(points), np.array(lengths)
    kept = [made.rows[row] for row in lengths] if made.ends_by == "places" and made.rows else []
    if kept:  # the coordinates of ends are those of points
        p = np.unique([*points, *(end for pair in kept for end in pair)])
        kept = [(int(np.searchsorted(p, a)), int(np.searchsorted(p, b))) for a, b in kept]
    return made.change(
        ids=[made.ids[row] for row in p], surveyed=made.surveyed[p], drawn=made.drawn[p],
        delivered=None if made.delivered is None else made.delivered[p], ends=[made.ends[row] for row in lengths],
        rows=kept or made.rows, measured=made.measured[d], lengths=made.lengths[d],
    )  # fmt: skip


@FEW
@given(data=st.data(), name=st.sampled_from(WHOLE), seed=st.integers(0, 9))
def test_less_evidence_never_turns_a_doubt_into_an_acceptance(data: st.DataObject, name: str, seed: int) -> None:
    made = attacked(name, seed)
    points = data.draw(st.sets(st.sampled_from(range(len(made.ids))), min_size=3))
    lengths = data.draw(st.sets(st.sampled_from(range(len(made.lengths))), min_size=3))
    less = without_rows(made, sorted(points), sorted(lengths))
    table = data.draw(st.sampled_from(["", "checkpoints", "distances", "features", "delivered"]))
    if table == "delivered":
        less = less.change(told=False, delivered=None)
    elif table:
        less = less.state(table, path=None)
    assert judged(less).verdict != "accepted"


@pytest.mark.parametrize("table", ["checkpoints", "distances", "features"])
def test_a_sound_delivery_without_a_table_is_undecided(table: str) -> None:
    assert judged(office(3).state(table, path=None)).verdict == "undecided"


def results(quality: QualityReport) -> dict[str, tuple[str, int, float | None]]:
    return {element.id: (str(element.status), element.n, element.value) for element in quality.elements}


def same(one: QualityReport, other: QualityReport) -> None:
    assert one.verdict == other.verdict
    first, second = results(one), results(other)
    assert first.keys() == second.keys()
    for name, (status, n, value) in first.items():
        assert (status, n) == second[name][:2]
        assert second[name][2] == (None if value is None else pytest.approx(value, rel=1e-9, abs=1e-12))


def reordered(made: Office, rng: np.random.Generator) -> Office:
    p, d = rng.permutation(len(made.ids)), rng.permutation(len(made.lengths))
    to = np.argsort(p)
    parts = [made.facade.parts[n] for n in rng.permutation(len(made.facade.parts))]
    return made.change(
        facade=replace(made.facade, parts=parts), ids=[made.ids[n] for n in p], surveyed=made.surveyed[p],
        drawn=made.drawn[p], delivered=None if made.delivered is None else made.delivered[p],
        ends=[made.ends[n] for n in d], rows=[(int(to[a]), int(to[b])) for a, b in (made.rows[n] for n in d)]
        if made.rows else [], measured=made.measured[d], lengths=made.lengths[d],
    )  # fmt: skip


def renamed(made: Office, names: dict[str, str]) -> Office:
    """Points under other names, wherever they are named."""
    targets = [replace(mark, name=names[mark.name]) for mark in made.by_id]
    ends = [(names.get(a, a), names.get(b, b)) for a, b in made.ends]
    return made.change(ids=[names[name] for name in made.ids], by_id=targets, ends=ends)


CASES = st.one_of(
    st.tuples(st.just(""), st.sampled_from([2, 3, 5, 8, 20, 34])), st.tuples(st.sampled_from(WHOLE), st.integers(0, 9))
)


def case(name: str, seed: int) -> Office:
    return attacked(name, seed) if name else office(seed)


@FEW
@given(which=CASES, order=st.integers(0, 99))
def test_order_of_rows_and_items_changes_nothing(which: tuple[str, int], order: int) -> None:
    made = case(*which)
    same(judged(made), judged(reordered(made, np.random.default_rng(order))))


@FEW
@given(which=CASES, shift=st.integers(1, 50))
def test_names_of_points_change_nothing(which: tuple[str, int], shift: int) -> None:
    made = case(*which)
    names = {name: f"Vão {97 * (n + shift) % 1009}" for n, name in enumerate(made.ids)}
    same(judged(made), judged(renamed(made, names)))


@FEW
@given(seed=st.sampled_from([2, 3, 5, 13, 34, 40]), forms=st.tuples(*[st.sampled_from(["NFC", "NFD"])] * 3))
def test_composition_of_accents_changes_nothing(seed: int, forms: tuple[str, str, str]) -> None:
    made = office(seed, version="R2013")
    if made.style.encoding == "cp1252":  # knows no accents that stand alone
        made = made.change(style=replace(made.style, encoding="utf-8"))
    plain = renamed(made, {name: f"Vértice São João {n}" for n, name in enumerate(made.ids)})
    table, drawing, ends = forms
    other = plain.change(
        ids=[unicodedata.normalize(table, name) for name in plain.ids],
        by_id=[replace(mark, name=unicodedata.normalize(drawing, mark.name)) for mark in plain.by_id],
        ends=[tuple(unicodedata.normalize(ends, end) for end in pair) for pair in plain.ends],
    )
    same(judged(plain), judged(other))
