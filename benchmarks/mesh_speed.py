# SPDX-License-Identifier: MIT
"""Self-intersections of large meshes and distances to them, beside peers.

Run by hand::

    uv run python benchmarks/mesh_speed.py [DIVISIONS] [--peers PYTHON]

Two spheres that cross, divided so many times (8: 2.6 million faces); flat plates; a sphere of 327,680 faces and 200,000
places near it. Compiling is done before. ``PYTHON`` is the interpreter of an environment with what
``benchmarks/mesh_peers.txt`` names; peers take turns with foparq, the median of three is told.
"""

import argparse
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foparq.mesh.bvh import hierarchy
from foparq.mesh.distance import nearest
from foparq.mesh.intersections import intersections
from foparq.mesh.winding import winding

DATA = Path(__file__).with_name("data")
PEERS = Path(__file__).with_name("mesh_peers.py")
UTM = np.array([712345.678, 7456789.123, 812.5])
Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]


def sphere(divisions: int) -> Mesh:
    """Unit sphere: an icosahedron whose faces are divided into four, again and again."""
    golden = (1 + np.sqrt(5)) / 2
    points = np.array([[a, b * golden, 0.0] for b in (1, -1) for a in (-1, 1)])
    points = np.concatenate([points, np.roll(points, 1, axis=1), np.roll(points, 2, axis=1)])
    points /= np.linalg.norm(points, axis=1)[:, None]
    near = np.linalg.norm(points[:, None] - points, axis=2) < 1.2
    corners = np.array(
        [(i, j, k) for i in range(12) for j in range(i) for k in range(j) if near[i, j] and near[j, k] and near[i, k]]
    )
    sides = points[corners]
    inward = np.einsum("ij,ij->i", np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0]), sides[:, 0]) < 0
    corners[inward] = corners[inward][:, ::-1]
    for _ in range(divisions):
        edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        keys, of = np.unique(edges[:, 0] * len(points) + edges[:, 1], return_inverse=True)
        between = points[keys // len(points)] + points[keys % len(points)]
        x, y, z = of.reshape(3, -1) + len(points)
        a, b, c = corners.T
        points = np.concatenate([points, between / np.linalg.norm(between, axis=1)[:, None]])
        corners = np.stack([a, x, z, b, y, x, c, z, y, x, y, z], axis=1).reshape(-1, 3)
    return points, corners


def two_spheres(divisions: int) -> Mesh:
    """Two spheres that cross, the second turned and shifted."""
    points, corners = sphere(divisions)
    turn, _ = np.linalg.qr(np.array([[0.8, 0.3, 0.1], [-0.2, 0.9, 0.4], [0.1, -0.3, 0.7]]))
    other = points @ turn.T + [0.5, 0.013, 0.027]
    return np.concatenate([points, other]), np.concatenate([corners, corners + len(points)])


def plate(n: int) -> Mesh:
    """Square of n by n cells, two triangles each."""
    u, v = (side.ravel() / n for side in np.mgrid[: n + 1, : n + 1])
    cell = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    a, b, c, d = cell, cell + n + 1, cell + n + 2, cell + 1
    return np.stack([u, v, 0 * u], axis=1), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def timed(work: Callable[[], object]) -> tuple[object, float, float]:
    """Result, wall seconds and processor seconds."""
    wall, cpu = time.perf_counter(), time.process_time()
    return work(), time.perf_counter() - wall, time.process_time() - cpu


def tell(name: str, runs: list[tuple[object, float, float]]) -> None:
    """Print the median of some runs."""
    wall, cpu = (statistics.median(run[k] for run in runs) for k in (1, 2))
    print(f"{name:36} {runs[0][0]!s:>22} {wall:8.2f} s {cpu:8.2f} s")


def beside(names: dict[str, Callable[[], object] | None], path: Path, python: str | None) -> None:
    """Run foparq and peers in turns on the same data."""
    runs: dict[str, list[tuple[object, float, float]]] = {name: [] for name in names}
    for _ in range(3):
        for name, work in names.items():
            if work is not None:
                runs[name].append(timed(work))
            elif python:
                done = subprocess.run([python, PEERS, name, path], check=True, capture_output=True, text=True)
                found, wall, cpu = done.stdout.split()[-3:]
                runs[name].append((found, float(wall), float(cpu)))
    for name, done_runs in runs.items():
        if done_runs:
            tell(name, done_runs)


def main() -> None:
    """Print a table: what was asked, what was found, wall time, processor time."""
    reader = argparse.ArgumentParser()
    reader.add_argument("divisions", type=int, nargs="?", default=8)
    reader.add_argument("--peers")
    told = reader.parse_args()
    DATA.mkdir(exist_ok=True)
    small, faces = sphere(2)
    intersections(np.concatenate([small, small + 0.3]), np.concatenate([faces, faces + len(small)]), keep=9)
    winding(small, faces[1:], nearest(small, hierarchy(small, faces), small[:9] * 2).place)
    for name, (points, corners) in {
        "sphere": sphere(7),
        "plate, z = 0": plate(250),
        "plate, x = z": (plate(250)[0][:, [0, 1, 0]], plate(250)[1]),
        "plate, x = z, georeferenced": (plate(250)[0][:, [0, 1, 0]] + UTM, plate(250)[1]),
    }.items():
        runs = [timed(lambda p=points, c=corners: intersections(p, c, keep=10**6).total) for _ in range(3)]
        cpu = statistics.median(run[2] for run in runs)
        print(f"{name:36} {1e6 * cpu / len(corners):.2f} microseconds a face")
    points, corners = sphere(7)
    way = np.random.default_rng(1).normal(size=(200_000, 3))
    asked = way / np.linalg.norm(way, axis=1)[:, None] * np.random.default_rng(2).uniform(0.9, 1.1, (len(way), 1))
    path = DATA / "mesh_places.npz"
    np.savez(path, points=points, corners=corners, asked=asked)
    beside(
        {
            "distances": lambda: float(nearest(points, hierarchy(points, corners), asked).distance.sum()),
            "libigl distances": None,
            "winding numbers": lambda: float((winding(points, corners, asked) > 0.5).sum()),
            "libigl winding numbers": None,
        },
        path, told.peers,
    )  # fmt: skip
    many, those = two_spheres(told.divisions)
    path = DATA / "mesh_spheres.npz"
    np.savez(path, points=many, corners=those, asked=asked[:1])
    print(f"two spheres, {len(those)} faces")
    beside(
        {
            "intersections": lambda: intersections(many, those, keep=10**6).total,
            "pymeshlab": None, "libigl predicates": None, "libigl with CGAL": None,
        },
        path, told.peers,
    )  # fmt: skip
    print(f"peak {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024} MB", file=sys.stderr)


if __name__ == "__main__":
    main()
