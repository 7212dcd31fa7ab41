# SPDX-License-Identifier: MIT
"""Planted faults are found, each of them and no other, where they are: at the origin and in a national grid."""

from typing import Any

import numpy as np
import pytest
import shapely
from tests.mesh.files import Mesh
from tests.mesh.made import GEOREFERENCED
from tests.mesh.parts import part_of, profile
from tests.mesh.planted import Planted, bases, planted
from tests.mesh.spots import lie_together

from foparq.check.run import Checked, check_part
from foparq.findings.outcome import Status

#: metres: what coordinates are rounded to in a national grid, with room
NEAR = 1e-8


def run(made: Planted, shift: tuple[float, float, float]) -> Checked:
    surface = made.mesh
    return check_part(
        part_of(Mesh(surface.points + shift, surface.corners, surface.starts), closed=made.closed), profile(), 50
    )


def same(known: Any, found: Any) -> bool:
    """Whether a place is the known one; of several faces the place may be any."""
    if known.geom_type == "MultiPoint":
        corners = shapely.get_coordinates(found, include_z=True)
        all_of = shapely.get_coordinates(known, include_z=True)
        return bool((np.linalg.norm(corners[:, None] - all_of[None], axis=2).min(axis=1) < NEAR).all())
    return lie_together(known, found, NEAR)


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), GEOREFERENCED], ids=["at the origin", "georeferenced"])
@pytest.mark.parametrize("name", bases())
@pytest.mark.parametrize("seed", range(3))
def test_every_fault_is_found_and_no_other(name: str, seed: int, shift: tuple[float, float, float]) -> None:
    made = planted(name, each=2, seed=seed)
    checked = run(made, shift)
    assert not checked.log
    counts = {outcome.rule: outcome.found for outcome in checked.outcomes if outcome.found}
    stated = {} if made.closed else {"MSH009": 1}
    assert counts == stated | {code: len(known) for code, known in made.known.items()}
    table = checked.findings
    where = shapely.transform(table.where, lambda p: p - shift, include_z=True)
    for code, known in made.known.items():
        left = [(where[n], table.size[n]) for n in np.flatnonzero(table.rule == code).tolist()]
        for place, size in known:
            hit = next((n for n, (at, much) in enumerate(left) if same(place, at)
                        and (size is None or much == pytest.approx(size, rel=1e-6, abs=1e-9))), None)  # fmt: skip
            assert hit is not None, f"{code} is not told at {place}, of size {size}: {left}"
            del left[hit]


@pytest.mark.parametrize("name", bases())
def test_sound_surfaces_are_clean(name: str) -> None:
    base, closed = bases()[name]
    checked = check_part(part_of(base, closed=closed), profile(), 50)
    # The two openings of the facade are holes.
    wrong = {outcome.rule: outcome.found for outcome in checked.outcomes if outcome.status is not Status.CLEAN}
    assert wrong == ({} if closed else {"MSH009": 1, "MSH011": 2})


@pytest.mark.parametrize("each", [1, 2])
def test_the_rim_of_the_facade_is_told_where_nobody_states_it(each: int) -> None:
    made = planted("facade", each=each, seed=each)
    checked = check_part(part_of(made.mesh), profile(), 50)
    counts = {outcome.rule: outcome.found for outcome in checked.outcomes if outcome.found}
    # Fragments are told by MSH015, and nobody is asked about their rims.
    assert counts == {"MSH010": 1} | {code: len(known) for code, known in made.known.items()}
    rims = checked.findings.size[checked.findings.rule == "MSH010"]
    assert rims.max() == pytest.approx(2 * (24 * 0.5 + 18 * 0.4))
