# SPDX-License-Identifier: MIT
"""Sizes that rules give to what stands in space."""

import pytest

from foparq.check.registry import all_rules
from foparq.findings.hits import Hits
from foparq.model.inputs import lines_of


def hits_of(code: str, *lines: str, **tolerances: float) -> Hits:
    found = all_rules()[code].check(lines_of(list(lines)), **tolerances)
    assert isinstance(found, Hits)
    return found


@pytest.mark.parametrize(("depth", "count"), [(0.0003, 1), (0.0005, 1), (0.0006, 0)])
def test_a_line_into_the_depth_is_as_long_as_it_is_deep(depth: float, count: int) -> None:
    found = hits_of("GEO002", f"LINESTRING Z (0 0 0, 0 0 {depth})", coincide=0.0005)
    assert found.size.tolist() == pytest.approx([depth] * count)


def test_a_line_into_the_depth_and_back_is_as_long_as_its_way() -> None:
    found = hits_of("GEO002", "LINESTRING Z (0 0 0, 0 0 0.0002, 0.0001 0 0.0002)", coincide=0.0005)
    assert found.size.tolist() == pytest.approx([0.0003])


@pytest.mark.parametrize("code", ["GEO003", "GEO005"])
def test_vertices_and_openings_are_apart_in_space(code: str) -> None:
    if code == "GEO003":
        found = hits_of(code, "LINESTRING Z (0 0 0, 0.0003 0 0.0004, 1 0 0)", coincide=0.0005)
        assert found.size.tolist() == pytest.approx([0.0005])
        assert not len(hits_of(code, "LINESTRING Z (0 0 0, 0.0003 0 0.0005, 1 0 0)", coincide=0.0005).size)
    else:
        ring = "LINESTRING Z (0 0 0, 1 0 0, 1 1 0, 0.003 0 0.004)"
        assert hits_of(code, ring, coincide=0.0005, reach=0.005).size.tolist() == pytest.approx([0.005])
        assert not len(hits_of(code, ring, coincide=0.0005, reach=0.0049).size)


def test_a_copy_is_as_long_as_it_is_in_space() -> None:
    found = hits_of("TOP001", *["LINESTRING Z (0 0 0, 3 0 4)"] * 2, coincide=0.0005)
    assert (found.row.tolist(), found.size.tolist()) == ([1], [5.0])
