# SPDX-License-Identifier: MIT
"""A fault of many faces is told at one of them: which one may change as a mesh is moved, but it stays one of them."""

import numpy as np
import pytest
import shapely
from tests.mesh.changes import MOVES
from tests.mesh.made import box
from tests.mesh.parts import cut, inside_out, joined, part_of, profile
from tests.mesh.planted import FAR
from tests.mesh.spots import lie_together

from foparq.check.run import check_part
from foparq.mesh.places import face_areas


@pytest.mark.parametrize("change", MOVES)
def test_the_place_of_a_patch_is_one_of_its_faces(change: str) -> None:
    """A patch turned over on a large box, and a small box far away that looks inward: a piece of its own."""
    large, small = cut(box(8)), cut(inside_out(box(2, (0.05, 0.05, 0.05))))
    middle = large.points[large.corners.reshape(-1, 3)].mean(axis=1)
    # Four by four cells amid the top, two triangles each.
    patch = np.flatnonzero((middle[:, 2] == 1.0) & (np.abs(middle[:, :2] - 0.5) < 0.25).all(axis=1))
    assert len(patch) == 32
    faces = [face[::-1] if row in set(patch.tolist()) else face for row, face in enumerate(large.lists())]
    corners = np.array(faces).ravel()
    whole = joined([large._replace(corners=corners), small._replace(points=small.points + FAR)])
    part = part_of(whole, closed=True)
    fragment = np.arange(large.faces, whole.faces)
    area = 6 * 0.05**2
    known = {"MSH014": [(len(patch), patch), (len(fragment), fragment)], "MSH015": [(area, fragment)]}
    moved = MOVES[change].forth(part)
    table = check_part(moved, profile(), 50).findings
    assert sorted(set(table.rule)) == sorted(known)
    for rule, faults in known.items():
        rows = table.rule == rule
        assert sorted(table.size[rows]) == pytest.approx(sorted(size for size, _ in faults))
        for size, members in faults:
            (place,) = table.where[rows & np.isclose(table.size, size, rtol=1e-6)]
            mine = face_areas(moved.points, moved.corners, moved.starts, members)
            assert any(lie_together(shapely.normalize(place), shapely.normalize(one), 0.0) for one in mine)
