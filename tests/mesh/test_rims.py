# SPDX-License-Identifier: MIT
"""Which border is the rim does not depend on the numbers of vertices, also where it runs along several pieces."""

import numpy as np
import pytest
from tests.mesh.changes import renumbered
from tests.mesh.made import plate
from tests.mesh.parts import part_of, profile

from foparq.check.run import check_part


def test_pieces_that_touch_around_an_opening_have_one_rim() -> None:
    # Four cells in a cross around an opening, which touch at its corners: one border outside, one within.
    cross = part_of(plate(3, 3, [(0, 0), (2, 0), (0, 2), (2, 2), (1, 1)]))
    for seed in range(20):
        order = np.random.default_rng(seed).permutation(len(cross.points))
        table = check_part(renumbered(cross, order), profile(), 50).findings
        rims, holes = (table.size[table.rule == code] for code in ("MSH010", "MSH011"))
        assert rims.tolist() == pytest.approx([2 * (0.5 + 0.4 + 0.4) + 2 * (0.4 + 0.5 + 0.5)])
        assert holes.tolist() == pytest.approx([0.5 * 0.4])
