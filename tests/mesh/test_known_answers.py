# SPDX-License-Identifier: MIT
"""Surfaces of the shared shelf, whose counts are known."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.mesh.files import Mesh, mesh, read
from tests.mesh.made import GEOREFERENCED, moved

from foparq.mesh.collinear import collinear_faces, null_sides
from foparq.mesh.components import components
from foparq.mesh.duplicates import duplicate_faces
from foparq.mesh.edges import edges
from foparq.mesh.fans import fans
from foparq.mesh.shape import area_vectors, flatness
from foparq.mesh.spikes import cones, edge_lengths, spikes
from foparq.mesh.tjunctions import t_junctions
from foparq.mesh.triangulate import triangulate
from foparq.mesh.vectors import lengths
from foparq.mesh.weld import near, unreferenced, welded

#: names in the files of answers, by what is counted here
SAID = (
    "f", "unref", "edges", "boundary_edges", "nm_edges", "inconsistent_edges", "face_components", "nm_vertices_igl",
    "dup_faces", "zero_area", "topo_degenerate", "euler",
)  # fmt: skip


def answers(shared: Path) -> Iterator[tuple[Path, dict[str, Any]]]:
    """Files of triangles with their answers."""
    for path in sorted((shared / "data" / "mesh").glob("*/expected.json")):
        said = json.loads(path.read_text(encoding="utf-8"))
        if "file" in said:
            said = {said["file"]: {"f": said["faces"], "boundary_edges": said["boundary_edges"],
                                   "nm_edges": said["non_manifold_edges"],
                                   "face_components": said["face_components"]}}  # fmt: skip
        yield from ((path.parent / name, counts) for name, counts in said.items())


def counted(of: Mesh) -> dict[str, int]:
    found = edges(of.corners, of.starts)
    area = lengths(area_vectors(of.points, of.corners, of.starts))
    used = len(np.unique(of.corners))
    return {
        "f": of.faces,
        "unref": len(unreferenced(len(of.points), of.corners)),
        "edges": len(found.tail),
        "boundary_edges": len(found.boundary),
        "nm_edges": len(found.non_manifold),
        "inconsistent_edges": len(found.inconsistent),
        "face_components": len(components(of.points, of.corners, of.starts, found, area).faces),
        "nm_vertices_igl": int(np.count_nonzero(fans(of.corners, of.starts, found, count=len(of.points)) > 1)),
        "dup_faces": len(duplicate_faces(of.corners, of.starts).face),
        "zero_area": int(np.count_nonzero(collinear_faces(of.points, of.corners, of.starts))),
        "topo_degenerate": len(null_sides(of.corners, of.starts)),
        "euler": used - len(found.tail) + of.faces,
    }


def weld(of: Mesh) -> Mesh:
    return Mesh(of.points, welded(of.points)[of.corners], of.starts)


@pytest.mark.shared
def test_counts_are_the_known_ones(shared: Path) -> None:
    seen = 0
    for path, said in answers(shared):
        of = read(path)
        assert np.count_nonzero(welded(of.points) != np.arange(len(of.points))) == {
            "multibody.stl": 76, "scene_mesh_seams.ply": 1079, "not_convex.obj": 244,
        }.get(path.name, 0)  # fmt: skip
        # The answers for STL are those after equal places were merged; for all others, as delivered.
        found = counted(weld(of) if path.suffix == ".stl" else of)
        found["unref"] = len(unreferenced(len(of.points), of.corners))
        assert {key: found[key] for key in SAID if key in said} == {key: said[key] for key in SAID if key in said}, path
        seen += 1
    assert seen == 13


@pytest.mark.shared
def test_the_welded_seams_are_the_surface_before(shared: Path) -> None:
    folder = shared / "data" / "mesh" / "sceaux_openmvs"
    whole, split = counted(read(folder / "scene_mesh.ply")), weld(read(folder / "scene_mesh_seams.ply"))
    lone = unreferenced(len(split.points), split.corners)
    assert len(lone) == 1079
    assert counted(split) == {**whole, "unref": 1079}


@pytest.mark.shared
@pytest.mark.parametrize("seed", range(2))
def test_counts_stay_where_the_surface_is_moved_and_renumbered(shared: Path, seed: int) -> None:
    for name in ("trimesh_small/bunny.ply", "synth_defect_sphere/def5.ply", "sceaux_openmvs/scene_mesh_seams.ply"):
        of = read(shared / "data" / "mesh" / name)
        assert counted(moved(of, seed=seed, shift=GEOREFERENCED)) == counted(of)


@pytest.mark.shared
def test_small_shells(shared: Path) -> None:
    folder = shared / "data" / "mesh" / "val3dity_small"
    names = ("boundary_edges", "nm_edges", "inconsistent_edges", "face_components", "nm_vertices_igl")
    expected = {
        "basecube.obj": (0, 0, 0, 1, 0),
        "302.poly": (4, 0, 0, 1, 0),  # the bottom is missing
        "303.poly": (3, 0, 0, 2, 1),  # a face hangs at one vertex
        "305.poly": (3, 0, 0, 2, 0),
        "307.poly": (0, 0, 4, 1, 0),  # a quadrangle turned over
        "nonmanifold.obj": (6, 0, 0, 1, 1),
        "cube_tol_1.obj": (4, 0, 0, 1, 0),
    }
    for name, counts in expected.items():
        found = counted(read(folder / name))
        assert tuple(found[key] for key in names) == counts, name


@pytest.mark.shared
def test_two_cubes_in_one_place(shared: Path) -> None:
    of = read(shared / "data" / "mesh" / "val3dity_small" / "twocubes.obj")
    fan = [[face[0], *face[k : k + 2]] for face in of.lists() for k in range(1, len(face) - 1)]
    found = counted(mesh(of.points, fan))
    assert (found["dup_faces"], found["nm_edges"], found["boundary_edges"]) == (10, 18, 1)


@pytest.mark.shared
def test_a_roof_that_is_not_plane(shared: Path) -> None:
    folder = shared / "data" / "mesh" / "val3dity_small"
    limit = 0.01  # val3dity's own
    for name, faulty in (("203.poly", True), ("302.poly", False), ("basecube.obj", False)):
        of = read(folder / name)
        assert bool((flatness(of.points, of.corners, of.starts).distance > limit).any()) is faulty


@pytest.mark.shared
def test_a_corner_twice_in_a_row(shared: Path) -> None:
    of = read(shared / "data" / "mesh" / "val3dity_small" / "102.poly")
    assert null_sides(of.corners, of.starts).tolist() == [9]
    assert counted(of)["boundary_edges"] == 0


@pytest.mark.shared
def test_two_cubes_fall_in_triangles(shared: Path) -> None:
    of = read(shared / "data" / "mesh" / "val3dity_small" / "twocubes.obj")
    found = triangulate(of.points, of.corners, of.starts, most=100)
    # The last ring crosses itself.
    assert found.left.tolist() == [11]


@pytest.mark.shared
def test_the_near_vertex_of_a_cube(shared: Path) -> None:
    of = read(shared / "data" / "mesh" / "val3dity_small" / "cube_tol_1.obj")
    assert near(of.points, coincide=1e-3, most=10).total == 1
    assert near(of.points, coincide=1e-5, most=10).total == 0


@pytest.mark.shared
def test_scans_have_neither_spikes_nor_t_junctions(shared: Path) -> None:
    folder = shared / "data" / "mesh"
    for name in ("demosthenes_bust/demosthenes-low-res.obj", "lion_statue/lionstatue.obj"):
        of = read(folder / name)
        table = edges(of.corners, of.starts)
        middle = float(np.median(edge_lengths(of.points, table)))
        assert not len(spikes(cones(of.points, table), opening=np.radians(20), height=5 * middle))
        assert not len(t_junctions(of.points, of.corners, of.starts, table, coincide=middle / 100).vertex)
