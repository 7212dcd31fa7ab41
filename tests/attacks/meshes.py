# SPDX-License-Identifier: MIT
"""Meshes for attacks: what their surfaces are made of, and how they are written.

A surface is made of numpy arrays alone; nothing here asks the kernels that are under attack.
"""

import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from tests.mesh.files import Mesh, mesh
from tests.mesh.parts import joined

from foparq.columns import Flags, Reals


def write_obj(of: Mesh, path: Path, groups: Sequence[str] = ()) -> Path:
    """Every digit of the coordinates; the groups of the faces, one each, where they are given."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in of.points.tolist()]
    for row, face in enumerate(of.lists()):
        if len(groups) and (row == 0 or groups[row] != groups[row - 1]):
            lines.append(f"g {groups[row]}")
        lines.append("f " + " ".join(str(vertex + 1) for vertex in face))
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path


def write_ply(of: Mesh, path: Path) -> Path:
    """Binary, in double precision; corners may be any number."""
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(of.points)}\nproperty double x\nproperty double y\n"
        f"property double z\nelement face {of.faces}\nproperty list int int vertex_indices\nend_header\n"
    )
    counts = np.diff(of.starts)
    rows = np.insert(of.corners, of.starts[:-1], counts).astype("<i4")
    path.write_bytes(head.encode("ascii") + of.points.astype("<f8").tobytes() + rows.tobytes())
    return path


def write_stl(of: Mesh, path: Path) -> Path:
    """Binary: every face of three corners with places of its own, in single precision."""
    table = np.zeros(of.faces, dtype=[("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("rest", "<u2")])
    table["corner"] = of.points[of.corners.reshape(-1, 3)]
    path.write_bytes(b"\0" * 80 + struct.pack("<I", of.faces) + table.tobytes())
    return path


def triangles(points: Reals, corners: object) -> Mesh:
    """A surface of triangles."""
    rows = np.asarray(corners, dtype=np.intp).reshape(-1, 3)
    return Mesh(np.asarray(points, dtype=float), rows.ravel(), np.arange(0, rows.size + 1, 3, dtype=np.intp))


def ball(rings: int = 40, around: int = 80) -> Mesh:
    """A ball of quadrangles and two caps of triangles, closed, seen from outside."""
    polar = np.pi * np.arange(1, rings) / rings
    turn = 2 * np.pi * np.arange(around) / around
    p, t = np.repeat(polar, around), np.tile(turn, rings - 1)
    points = np.concatenate(
        [np.stack([np.sin(p) * np.cos(t), np.sin(p) * np.sin(t), np.cos(p)], axis=1), [[0, 0, 1], [0, 0, -1]]]
    )
    north, south, last = len(points) - 2, len(points) - 1, (rings - 2) * around
    faces = []
    for k in range(around):
        after = (k + 1) % around
        faces.append([north, k, after])
        faces += [
            [r * around + k, (r + 1) * around + k, (r + 1) * around + after, r * around + after]
            for r in range(rings - 2)
        ]
        faces.append([south, last + after, last + k])
    return mesh(points, faces)


def centres(of: Mesh) -> Reals:
    """Mean of the corners of every face."""
    counts = np.diff(of.starts)
    return np.asarray(np.add.reduceat(of.points[of.corners], of.starts[:-1], axis=0) / counts[:, None])


def only(of: Mesh, kept: Flags) -> Mesh:
    """Some faces, with all vertices."""
    return mesh(of.points, [face for face, keep in zip(of.lists(), kept.tolist(), strict=True) if keep])


def loops(of: Mesh) -> list[list[int]]:
    """Boundary loops of a surface that has no pinched vertex, each run as a lid would: against the faces there."""
    sides = {side for face in of.lists() for side in zip(face, [*face[1:], face[0]], strict=True)}
    after = {b: a for a, b in sides if (b, a) not in sides}
    found = []
    while after:
        first, to = next(iter(after.items()))
        loop = [first]
        while to != first:
            loop.append(to)
            to = after.pop(to)
        after.pop(first)
        found.append(loop)
    return found


def with_faces(of: Mesh, faces: Sequence[Sequence[int]], points: object = ()) -> Mesh:
    """The surface, with further faces, and vertices behind the others."""
    more = np.asarray(points, dtype=float).reshape(-1, 3)
    return mesh(np.concatenate([of.points, more]), [*of.lists(), *map(list, faces)])


def shifted(of: Mesh, shift: Sequence[float] = (0, 0, 0), scale: Sequence[float] | float = 1.0) -> Mesh:
    """Scaled about the origin, then moved."""
    return Mesh(of.points * scale + np.asarray(shift, dtype=float), of.corners, of.starts)


def open_above(of: Mesh, height: float) -> Mesh:
    """What of a ball lies below a height: one rim."""
    return only(of, centres(of)[:, 2] < height)


def tennis(of: Mesh) -> Mesh:
    """Half of a ball, along the seam of a tennis ball: the plane figures of the seam cancel each other."""
    x, y, z = centres(of).T
    turn = np.arctan2(y, x)
    return only(of, z < 0.6 * np.cos(2 * turn) * np.sqrt(1 - np.minimum(z**2, 1)))


def strip(n: int, twist: float) -> Mesh:
    """A band of n quadrangles around an axis that turns over so many half turns: an odd number makes it one-sided."""
    turn = 2 * np.pi * np.arange(n) / n
    lean = twist * turn / 2
    across = np.stack([np.cos(lean) * np.cos(turn), np.cos(lean) * np.sin(turn), np.sin(lean)], axis=1) * 0.2
    middle = np.stack([np.cos(turn), np.sin(turn), np.zeros(n)], axis=1)
    faces = []
    for k in range(n):
        a, b = k, (k + 1) % n
        c, d = (b + n, a + n) if k < n - 1 or twist % 2 == 0 else (b, a + n)
        faces.append([a, b, c, d] if k < n - 1 or twist % 2 == 0 else [a, n, c, d])
    return mesh(np.concatenate([middle + across, middle - across]), faces)


def both(*parts: Mesh) -> Mesh:
    """Surfaces in one file, one behind the other."""
    return joined(list(parts))


def baseball(of: Mesh) -> Mesh:
    """Half of a ball, along a seam whose figure in every plane cancels itself: its area vector is zero."""
    b = 1 / (1 + 3**0.5)
    a, c = 1 - b, 2 * (b * (1 - b)) ** 0.5
    t = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    seam = np.stack([a * np.cos(t) + b * np.cos(3 * t), a * np.sin(t) - b * np.sin(3 * t), c * np.sin(2 * t)], axis=1)
    along = np.roll(seam, -1, axis=0) - np.roll(seam, 1, axis=0)
    at = centres(of)
    at /= np.linalg.norm(at, axis=1, keepdims=True)
    near = np.array([int(np.argmax(seam @ one)) for one in at])
    return only(of, np.einsum("ij,ij->i", np.cross(seam[near], along[near]), at) > 0)


def facade(columns: int, rows: int, openings: Sequence[tuple[int, int]] = (), step: float = 1.0) -> Mesh:
    """Plate of quadrangles in the plane xz that looks along -y; the cells named are openings."""
    across = columns + 1
    faces = [
        [j * across + i, j * across + i + 1, (j + 1) * across + i + 1, (j + 1) * across + i]
        for j in range(rows)
        for i in range(columns)
        if (i, j) not in set(openings)
    ]
    x, z = np.meshgrid(np.arange(across) * step, np.arange(rows + 1) * step)
    return mesh(np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1), faces)


def skirted(of: Mesh, columns: int, rows: int, reach: float) -> Mesh:
    """A facade, with four large faces around its rim: corners of the rim are theirs too."""
    across = columns + 1
    bottom = list(range(across))
    top = [rows * across + i for i in range(across)]
    left, right = [j * across for j in range(rows + 1)], [j * across + columns for j in range(rows + 1)]
    n = len(of.points)
    low, high = of.points.min(axis=0), of.points.max(axis=0)
    outer = [
        [low[0] - reach, 0, low[2] - reach], [high[0] + reach, 0, low[2] - reach],
        [high[0] + reach, 0, high[2] + reach], [low[0] - reach, 0, high[2] + reach],
    ]  # fmt: skip
    more = [
        [n, n + 1, *bottom[::-1]], [n + 1, n + 2, *right[::-1]], [n + 2, n + 3, *top], [n + 3, n, *left],
    ]  # fmt: skip
    return with_faces(of, more, outer)


def refined(of: Mesh, face: int, n: int) -> Mesh:
    """One quadrangle as n by n tiny ones in its middle, and four faces around them: no vertex within an edge."""
    lists = of.lists()
    a, b, c, d = lists.pop(face)
    corner = of.points[[a, b, c, d]]
    across = n + 1
    u, v = np.meshgrid(np.linspace(0.45, 0.55, across), np.linspace(0.45, 0.55, across))
    weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v], axis=-1).reshape(-1, 4)
    k = len(of.points)
    row, last = k + np.arange(across), k + n * across
    tiny = [
        [k + j * across + i, k + j * across + i + 1, k + (j + 1) * across + i + 1, k + (j + 1) * across + i]
        for j in range(n)
        for i in range(n)
    ]
    side = k + np.arange(across) * across
    frame = [
        [a, b, *row[::-1].tolist()], [b, c, *(side + n)[::-1].tolist()],
        [c, d, *(last + np.arange(across)).tolist()], [d, a, *side.tolist()],
    ]  # fmt: skip
    return mesh(np.concatenate([of.points, weights @ corner]), [*lists, *frame, *tiny])


def windows(n: int, *, panes: bool = True) -> Mesh:
    """A wall as one polygon that reaches n by n openings over bridges, and a quadrangle in each opening."""
    wide = 2.0 * n + 1
    points: list[list[float]] = [[0, 0, 0], [wide, 0, 0], [wide, 0, wide], [0, 0, wide]]
    ring, faces = [0], []
    for j in reversed(range(n)):
        there, back = list[int](), list[int]()
        for i in range(n):
            k, x, z = len(points), 2.0 * i + 1, 2.0 * j + 1
            points += [[x, 0, z], [x, 0, z + 1], [x + 1, 0, z + 1], [x + 1, 0, z]]
            there += [k, k + 1, k + 2, k + 3]
            back = [k, *back] if i == n - 1 else [k + 3, k, *back]
            faces.append([k, k + 3, k + 2, k + 1])
        ring += [*there, *back, 0]
    return mesh(points, [*(faces if panes else []), [*ring, 1, 2, 3]])
