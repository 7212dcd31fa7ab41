# SPDX-License-Identifier: MIT
"""Meshes of tests as parts of a delivery, and as the rules see them."""

import re
from collections.abc import Callable, Mapping
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from tests.mesh.files import Mesh, mesh
from tests.mesh.made import box, plate, sphere

from foparq.check.subjects.mesh import MeshSubject
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.inputs import Named
from foparq.model.mesh import Mesh as Part
from foparq.model.mesh import MeshReading
from foparq.profile.load import load_profile
from foparq.profile.schema import Profile

METRES = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)


@cache
def profile(weld: str = "identical") -> Profile:
    """The shipped profile, that takes vertices with the same coordinates for one or not."""
    shipped = load_profile("et-doc-foparq-a")
    return shipped.model_copy(update={"mesh": shipped.mesh.model_copy(update={"weld": weld})})


def part_of(surface: Mesh, *, closed: bool | None = None, rims: int | None = None) -> Part:
    """A surface in metres as it would be delivered, in one group without a name."""
    group = np.zeros(surface.faces, dtype=np.intp)
    return Part(
        path="made.ply", points=surface.points, corners=surface.corners, starts=surface.starts, group=group,
        groups=("",), reading=MeshReading(version="made"), unit=METRES, closed=closed, rims=rims,
    )  # fmt: skip


def surface_of(part: Part) -> Mesh:
    """Vertices and faces of a part."""
    return Mesh(part.points, part.corners, part.starts)


def input_of(kind: type, part: Part, *, weld: str = "identical") -> Named:
    """What a rule over faces, surfaces or vertices gets of a part."""
    return MeshSubject(part, profile(weld)).take(kind, ("*",)).rows


def given_surface(given: Mapping[str, Any]) -> Mesh:
    """The surface that a case describes.

    ``made`` is a shorthand, as ``"box 2"``, ``"sphere 1"``, ``"plate 4 3 openings (1,1) (2,1)"``: the makers of
    ``made.py``. ``cut`` makes triangles of it, ``inward`` turns it inside out, ``times s`` and ``at (x,y,z)`` move it;
    several are joined by ``+``. ``points`` and ``faces`` come behind it, and faces count vertices from the first one
    made. ``without`` names faces of ``made`` that are left out, ``turned`` faces of the whole that run the other way
    round. ``apart``: every face has vertices of its own.
    """
    made = joined([_made(text) for text in given["made"].split("+")]) if "made" in given else mesh([], [])
    kept = [face for row, face in enumerate(made.lists()) if row not in given.get("without", [])]
    faces = kept + [list(face) for face in given.get("faces", [])]
    turned = set(given.get("turned", []))
    faces = [face[::-1] if row in turned else face for row, face in enumerate(faces)]
    points = np.concatenate([made.points, np.array(given.get("points", []), dtype=float).reshape(-1, 3)])
    found = mesh(points, faces)
    if not given.get("apart"):
        return found
    return Mesh(points[found.corners], np.arange(len(found.corners), dtype=np.intp), found.starts)


def joined(parts: list[Mesh]) -> Mesh:
    """Surfaces one behind the other."""
    faces: list[list[int]] = []
    count = 0
    for part in parts:
        faces += [[vertex + count for vertex in face] for face in part.lists()]
        count += len(part.points)
    return mesh(np.concatenate([part.points for part in parts]), faces)


def cut(of: Mesh) -> Mesh:
    """The same surface as triangles: every face as a fan from its first corner."""
    return mesh(of.points, [[face[0], *pair] for face in of.lists() for pair in pairwise(face[1:])])


def inside_out(of: Mesh) -> Mesh:
    """The same surface, every face the other way round."""
    return mesh(of.points, [face[::-1] for face in of.lists()])


def _made(text: str) -> Mesh:
    words = re.sub(r"\([^)]*\)", "", text).split()
    places = [tuple(float(n) for n in place.split(",")) for place in re.findall(r"\(([^)]*)\)", text)]
    makers: dict[str, Callable[[], Mesh]] = {
        "box": lambda: box(int(words[1])),
        "sphere": lambda: sphere(int(words[1])),
        "plate": lambda: plate(int(words[1]), int(words[2]), [(int(p[0]), int(p[1])) for p in places if len(p) == 2]),
    }
    found = makers[words[0]]()
    if "cut" in words:
        found = cut(found)
    if "inward" in words:
        found = inside_out(found)
    points = found.points * (float(words[words.index("times") + 1]) if "times" in words else 1.0)
    shift = next((place for place in places if len(place) == 3), (0.0, 0.0, 0.0))
    return Mesh(points + shift, found.corners, found.starts)
