# SPDX-License-Identifier: MIT
"""Time that peers take for what ``benchmarks/mesh_speed.py`` asks, in an environment of their own.

Run by ``mesh_speed.py``; it needs only what ``benchmarks/mesh_peers.txt`` names.
"""

import sys
import time

import igl
import igl.copyleft.cgal
import igl.predicates
import numpy as np
import pymeshlab


def main() -> None:
    """Print what was found, wall seconds and processor seconds of one tool."""
    tool, path = sys.argv[1:]
    data = np.load(path)
    points, corners, asked = data["points"], data["corners"].astype(np.int64), data["asked"]
    if tool == "pymeshlab":
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(points, corners))
    wall, cpu = time.perf_counter(), time.process_time()
    if tool == "pymeshlab":
        meshes.compute_selection_by_self_intersections_per_face()
        found = meshes.current_mesh().selected_face_number()
    elif tool == "libigl predicates":
        found = len(igl.predicates.find_self_intersections(points, corners)[1])
    elif tool == "libigl with CGAL":
        found = len(igl.copyleft.cgal.remesh_self_intersections(points, corners, detect_only=True)[2])
    elif tool == "libigl distances":
        found = float(np.sqrt(igl.point_mesh_squared_distance(asked, points, corners)[0]).sum())
    else:
        found = float((igl.fast_winding_number(points, corners, asked) > 0.5).sum())
    print(found, time.perf_counter() - wall, time.process_time() - cpu)


if __name__ == "__main__":
    main()
