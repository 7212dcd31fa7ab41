# SPDX-License-Identifier: MIT
"""One vertex out of all bounds, or faces without sense, change nothing of the others and stop no kernel."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import plate

from foparq.mesh.borders import borders
from foparq.mesh.collinear import collinear_faces
from foparq.mesh.components import components, vertex_distance
from foparq.mesh.duplicates import duplicate_faces
from foparq.mesh.edges import edges
from foparq.mesh.fans import fans
from foparq.mesh.grouping import joined
from foparq.mesh.holes import border_sizes
from foparq.mesh.orientation import orientation, signed_volumes
from foparq.mesh.shape import area_vectors, flatness, folds, triangle_shapes
from foparq.mesh.spikes import cones
from foparq.mesh.tjunctions import t_junctions
from foparq.mesh.triangulate import triangulate
from foparq.mesh.vectors import lengths
from foparq.mesh.weld import near, welded

MANY = 100


def measured(of: Mesh) -> dict[str, object]:
    """What every kernel says, by face, by edge or by vertex."""
    table = edges(of.corners, of.starts)
    vectors = area_vectors(of.points, of.corners, of.starts)
    with np.errstate(over="ignore", invalid="ignore"):
        area = lengths(vectors)
    pieces = components(of.points, of.corners, of.starts, table, area)
    found = {
        "area": vectors,
        "flat": flatness(of.points, of.corners, of.starts).distance,
        "collinear": collinear_faces(of.points, of.corners, of.starts),
        "fans": fans(of.corners, of.starts, table, count=len(of.points)),
        "opening": cones(of.points, table).opening,
        "fold": folds(table, vectors, of.starts)[1],
        "flipped": orientation(of.starts, table).flipped,
        "volume": signed_volumes(of.points, of.corners, of.starts, pieces.label, count=len(pieces.faces)).volume,
    }
    triangle_shapes(of.points, triangulate(of.points, of.corners, of.starts, most=MANY).triangles)
    duplicate_faces(of.corners, of.starts)
    border_sizes(of.points, borders(of.points, of.corners, of.starts, table))
    near(of.points[np.unique(welded(of.points))], coincide=1e-3, most=MANY)
    t_junctions(of.points, of.corners, of.starts, table, coincide=1e-3)
    if len(pieces.faces):
        vertex_distance(of.points, of.corners, of.starts, pieces, to=pieces.largest)
    return found


@pytest.mark.parametrize("far", [1e100, 1e160, 1.7e308, 1e-320])
def test_a_vertex_out_of_bounds_changes_nothing_of_other_faces(far: float) -> None:
    of = plate(9, 9, [(2, 2), (3, 3)])
    points = of.points.copy()
    rogue = int(of.corners[of.starts[60]])
    points[rogue] = (far, -far, far)
    before, after = measured(of), measured(Mesh(points, of.corners, of.starts))
    face = np.repeat(np.arange(of.faces), np.diff(of.starts))
    sound = np.setdiff1d(np.arange(of.faces), face[of.corners == rogue])
    for name in ("area", "flat", "collinear", "flipped"):
        assert np.array_equal(before[name][sound], after[name][sound])
    table = edges(of.corners, of.starts)
    away = ~np.isin(np.arange(len(of.points)), of.corners[np.isin(face, face[of.corners == rogue])])
    assert np.array_equal(before["opening"][away], after["opening"][away], equal_nan=True)
    ends = np.isin(face[table.sides[table.starts[table.paired]]], sound)
    ends &= np.isin(face[table.sides[table.starts[table.paired] + 1]], sound)
    assert np.array_equal(before["fold"][ends], after["fold"][ends])
    assert np.array_equal(before["fans"], after["fans"])


def test_a_t_junction_is_found_beside_a_vertex_out_of_bounds() -> None:
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0.5, 0), (2, 0, 0), (2, 0.5, 0), (2, 1, 0)]
    for far in (1e100, 1e160, 1.7e308):
        of = mesh([*points, (-far, -far, far)], [[0, 1, 2, 3], [1, 5, 6, 4], [4, 6, 7, 2], [0, 3, 8]])
        found = t_junctions(of.points, of.corners, of.starts, edges(of.corners, of.starts), coincide=1e-3)
        assert found.vertex.tolist() == [4]


@settings(max_examples=60)
@given(
    st.lists(st.tuples(*[st.sampled_from([0.0, 1.0, -1.0, 2.0, 1e200])] * 3), min_size=7, max_size=7),
    st.lists(st.lists(st.integers(0, 6), min_size=3, max_size=6), max_size=9),
)
def test_faces_without_sense_stop_no_kernel(points: list[tuple[float, ...]], faces: list[list[int]]) -> None:
    measured(mesh(points, faces))


@pytest.mark.parametrize("count", [1, 2, 1000, 4096])
def test_long_chains_are_joined(count: int) -> None:
    # In the order of their bits turned round, neighbours are never near in number.
    bits = max(1, (count - 1).bit_length())
    turned = np.array([int(f"{k:0{bits}b}"[::-1], 2) for k in range(2**bits)])
    for way in (np.arange(2**bits), turned, np.random.default_rng(0).permutation(2**bits)):
        assert not joined(2**bits, way[:-1], way[1:]).any()
