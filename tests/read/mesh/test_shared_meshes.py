# SPDX-License-Identifier: MIT
"""Real meshes: what is counted in them is what those who published them say."""

import json
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from foparq.errors import UnreadableError
from foparq.model.mesh import RawMesh
from foparq.profile.schema import LimitsSpec
from foparq.read.mesh.reader import read_mesh

FILES = (
    "demosthenes_bust/demosthenes-low-res.obj",
    "lion_statue/lionstatue.obj",
    "manifold_selfintersect/self_intersectA.obj",
    "sceaux_openmvs/scene_mesh.ply",
    "sceaux_openmvs/scene_mesh_seams.ply",
    "sceaux_openmvs/scene_mesh_texture.ply",
    "synth_defect_sphere/def5.ply",
    "synth_two_spheres/two5.ply",
    "trimesh_small/bunny.ply",
    "trimesh_small/soup.stl",
    "trimesh_small/joined_tetrahedra.obj",
    "trimesh_small/multibody.stl",
    "trimesh_small/not_convex.obj",
)


def take(shared: Path, named: str) -> RawMesh:
    return read_mesh(shared / "data" / "mesh" / named, limits=LimitsSpec())


def said(shared: Path, named: str) -> dict[str, Any]:
    path = shared / "data" / "mesh" / named
    found = json.loads(path.with_name("expected.json").read_text(encoding="utf-8"))
    if path.name in found:
        return dict(found[path.name])
    return {"v": found["vertices"], "f": found["faces"], "boundary_edges": found["boundary_edges"], "nm_edges": 0}


@pytest.mark.shared
@pytest.mark.parametrize("named", FILES)
def test_counts(shared: Path, named: str) -> None:
    mesh, expected = take(shared, named), said(shared, named)
    corners = mesh.corners
    points = mesh.points
    if named.endswith(".stl"):
        # What is known of them was counted after equal corners were merged.
        assert len(points) == 3 * mesh.faces
        points, corners = np.unique(points, axis=0, return_inverse=True)
    assert (len(points), mesh.faces) == (expected["v"], expected["f"])
    edges: Counter[tuple[int, int]] = Counter()
    for begin, end in pairwise(mesh.starts.tolist()):
        ring = corners[begin:end].tolist()
        edges.update((min(a, b), max(a, b)) for a, b in zip(ring, ring[1:] + ring[:1], strict=True))
    assert sum(count == 1 for count in edges.values()) == expected["boundary_edges"]
    assert sum(count > 2 for count in edges.values()) == expected["nm_edges"]
    assert len(points) - len(np.unique(corners)) == expected.get("unref", 0)
    extent = np.ptp(points, axis=0)
    np.testing.assert_allclose(extent, expected.get("bbox", extent), atol=5e-5)
    repeated = len(points) - len(np.unique(points, axis=0))
    assert repeated == expected.get("dup_vertices_exact", 0)
    assert mesh.reading.repairs == ()


@pytest.mark.shared
@pytest.mark.parametrize(
    ("named", "vertices", "polygons"),
    [
        ("basecube.obj", 8, [4] * 6),
        ("cube_tol_1.obj", 9, [4] * 6),
        ("nonmanifold.obj", 9, [3] * 12),
        ("twocubes.obj", 8, [4] * 12),
    ],
)
def test_small_shells(shared: Path, named: str, vertices: int, polygons: list[int]) -> None:
    mesh = take(shared, f"val3dity_small/{named}")
    assert len(mesh.points) == vertices
    text = (shared / "data" / "mesh" / "val3dity_small" / named).read_text(encoding="utf-8")
    counted = [len(line.split()) - 1 for line in text.splitlines() if line.split()[:1] == ["f"]]
    assert np.diff(mesh.starts).tolist() == counted
    assert len(counted) == len(polygons)


@pytest.mark.shared
def test_texture_of_a_facade(shared: Path) -> None:
    mesh, plain = take(shared, "sceaux_openmvs/scene_mesh_texture.ply"), take(shared, "sceaux_openmvs/scene_mesh.ply")
    assert mesh.reading.images == ("scene_mesh_texture0.png",)
    assert mesh.corners.tolist() == plain.corners.tolist()
    assert mesh.points.tolist() == plain.points.tolist()
    assert mesh.texture is not None
    assert mesh.texture.corner.tolist() == list(range(3 * 14_709))
    assert ((mesh.texture.uv >= 0) & (mesh.texture.uv <= 1)).all()


@pytest.mark.shared
def test_a_cloud_is_no_surface(shared: Path) -> None:
    with pytest.raises(UnreadableError) as caught:
        take(shared, "sceaux_openmvs/Sparse.ply")
    assert (caught.value.message, caught.value.fields["value"]) == ("mesh.no-surface", 12_683)


@pytest.mark.shared
def test_solids_of_a_file(shared: Path) -> None:
    mesh = take(shared, "trimesh_small/multibody.stl")
    assert sorted(mesh.groups) == ["bodyA", "bodyB"]
    assert len(np.unique(mesh.points, axis=0)) == 20
