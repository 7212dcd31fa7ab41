# SPDX-License-Identifier: MIT
"""Each of several facades is judged by points of its own."""

from typing import Any

import numpy as np
import pytest
from tests.check.test_ties import texts

from foparq.evaluate.facades import facade_doubts, unnamed_remark
from foparq.findings.ties import Lies, PointTies

N = 9


def ties(*facades: str, group: np.ndarray | None = None) -> PointTies:
    none = texts(*[""] * N)
    return PointTies(
        lies=texts(*[str(Lies.VERTEX)] * N), gap=np.zeros(N), drawing=none, item=none, layer=none,
        delivered=np.zeros((N, 3)), group=np.arange(N) if group is None else group, unchecked=np.zeros(3, dtype=bool),
        files=tuple(f"{k}.dxf" for k in range(len(facades))), facades=facades,
    )  # fmt: skip


def held(*rows: range) -> np.ndarray:
    found = np.zeros((N, len(rows)), dtype=bool)
    for column, own in enumerate(rows):
        found[list(own), column] = True
    return found


def said(made: PointTies, counted: np.ndarray, fewest: int = 3) -> list[dict[str, Any]]:
    return [dict(reason.fields) for reason in facade_doubts(made, counted, "Q1-X", fewest)]


@pytest.mark.parametrize(("n", "doubts"), [(0, 1), (2, 1), (3, 0)])
def test_a_facade_has_as_many_points_as_an_element_asks_for(n: int, doubts: int) -> None:
    found = said(ties("N", "S"), held(range(6), range(6, 6 + n)))
    assert len(found) == doubts
    if found:
        assert (found[0]["facade"], found[0]["files"], found[0]["n"], found[0]["fewest"]) == ("S", ["1.dxf"], n, 3)


def test_points_at_one_place_are_one() -> None:
    group = np.array([0, 1, 2, 3, 4, 5, 6, 6, 6])
    assert [row["n"] for row in said(ties("N", "S", group=group), held(range(6), range(6, 9)))] == [1]


def test_drawings_of_one_facade_are_one() -> None:
    assert not said(ties("N", "n"), held(range(9), range(0)))
    assert not said(ties("Norte", "Sul", "SUL"), held(range(4), range(4, 6), range(6, 7)))


def test_one_drawing_is_the_whole() -> None:
    assert not said(ties("N"), held(range(1)))
    assert not unnamed_remark(ties(""), held(range(0)), "Q1-X")


def test_a_drawing_without_a_name_is_told_if_no_point_lies_on_it() -> None:
    made = ties("N", "", "")
    assert not said(made, held(range(8), range(0), range(8, 9)))
    (remark,) = unnamed_remark(made, held(range(8), range(0), range(8, 9)), "Q1-X")
    assert (remark.message, dict(remark.fields)["files"]) == ("evidence.unnamed", ["1.dxf"])
