# SPDX-License-Identifier: MIT
"""Cases of rules give what they say. Run one rule with ``-k TOP011``."""

import pytest
import shapely
from tests.mesh.spots import lie_together
from tests.rule_cases import Case, MeshCase, geometry_cases, mesh_cases

from foparq.columns import union


@pytest.mark.parametrize("case", geometry_cases() + mesh_cases())
def test_case(case: Case) -> None:
    hits = case.run()
    assert hits.row.tolist() == [want["row"] for want in case.find]
    for n, want in enumerate(case.find):
        if "size" in want:
            assert hits.size[n] == pytest.approx(want["size"], rel=want.get("precise", 1e-6), abs=1e-12)
        if "other" in want:
            assert hits.other[n] == want["other"]
        if "where" in want:
            place = shapely.from_wkt(want["where"])
            same = (
                lie_together(place, hits.where[n], 1e-6)
                if isinstance(case, MeshCase)
                else shapely.equals(place, hits.where[n])
                if place.is_empty
                else shapely.hausdorff_distance(place, hits.where[n]) < 1e-6
            )
            assert same, f"found at {hits.where[n]}"
    if case.faulty is not None:
        assert union(hits.row, hits.also).tolist() == case.faulty
