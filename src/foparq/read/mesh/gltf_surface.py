# SPDX-License-Identifier: MIT
"""The surface of a glTF scene as columns, put together node by node."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from foparq.columns import Coordinates, Index
from foparq.errors import UnsafeError
from foparq.model.drawing import Repair, Skipped, SkippedReason
from foparq.model.mesh import MeshReading, RawMesh, Texture
from foparq.read.mesh.gltf_data import Buffers
from foparq.read.mesh.gltf_json import Part
from foparq.read.mesh.gltf_materials import image_of, materials_of
from foparq.read.mesh.gltf_meshes import Meshes, Shape
from foparq.read.mesh.gltf_nodes import Matrix, Placed
from foparq.read.mesh.made import Delivered, every, joined, made, stacked

_MOST_PARTS = 100_000  #: primitives in all nodes
_REASONS = {
    "animation": SkippedReason.NO_SURFACE, "camera": SkippedReason.NO_SURFACE,
    "line": SkippedReason.LINES_AND_POINTS, "point": SkippedReason.LINES_AND_POINTS,
}  # fmt: skip


class Surface:
    """What was put together so far."""

    def __init__(self, delivered: Delivered, document: Part, buffers: Buffers) -> None:
        self._delivered, self._document = delivered, document
        self._materials = materials_of(document)
        self._meshes = Meshes(delivered, document, buffers, self._materials)
        self._points, self._corners, self._uv = list[Coordinates](), list[Index](), list[Index]()
        self._group, self._material = list[tuple[int, int]](), list[tuple[int, int]]()
        self._groups: dict[str, int] = {}
        self._vertices, self._faces, self._parts = 0, 0, 0
        self._odd: Counter[str] = Counter()

    def tell(self, kind: str, count: int = 1) -> None:
        """Count what is not read."""
        self._odd[kind] += count

    def add(self, nodes: Sequence[Placed]) -> None:
        """Put the meshes of nodes where they stand."""
        shown = [placed for placed in nodes if placed.node.has("mesh")]
        left = Counter(placed.node.whole("mesh") for placed in shown)
        shapes: dict[int, Shape] = {}
        for placed in shown:
            number = placed.node.whole("mesh")
            mesh = self._document.at("meshes", number)
            self._parts += len(mesh.list_of("primitives"))
            if self._parts > _MOST_PARTS:
                raise UnsafeError("mesh.gltf-parts", file=mesh.file, limit=_MOST_PARTS)
            shape = shapes[number] if number in shapes else self._meshes.shape(mesh)
            self._place(placed, mesh, shape)
            # A shape is kept while another node shows it.
            left[number] -= 1
            shapes[number] = shape
            if not left[number]:
                del shapes[number]

    def _place(self, placed: Placed, mesh: Part, shape: Shape) -> None:
        name = placed.node.text("name") or mesh.text("name")
        if any(mesh.list_of("weights") + placed.node.list_of("weights")):
            self.tell("morph target")
        self._odd.update(shape.told)
        self._delivered.hold_vertices(self._vertices + len(shape.points))
        self._delivered.hold_faces(self._faces + len(shape.corners))
        points, corners, uv = shape.points, shape.corners, shape.uv
        if placed.matrix is not None:
            points = _moved(points, placed.matrix)
            if _mirrors(placed.matrix):
                corners, uv = corners[:, ::-1], uv[:, ::-1]
        # What is outside stays negative until it is known how many vertices there are in all.
        moved = corners + self._vertices if self._vertices else corners.copy()
        outside = corners < 0
        moved[outside] = corners[outside]
        self._corners.append(moved.reshape(-1))
        self._uv.append(uv.reshape(-1))
        self._points.append(points)
        self._group.append((self._groups.setdefault(name, len(self._groups)), len(corners)))
        self._material += shape.materials
        self._vertices += len(points)
        self._faces += len(corners)

    def made(self, version: str, repairs: tuple[Repair, ...]) -> RawMesh:
        """The mesh.

        Raises
        ------
        UnreadableError
            If there is no face.
        """
        corners = joined(self._corners)
        outside = corners < 0
        corners[outside] = self._vertices - 1 - corners[outside]
        skipped = tuple(
            Skipped(reason=_REASONS.get(kind, SkippedReason.UNKNOWN_ELEMENT), kind=kind, layer="", count=count)
            for kind, count in sorted(self._odd.items())
        )
        images = dict.fromkeys(image_of(image) for image in self._document.parts("images"))
        reading = MeshReading(
            version=version, repairs=repairs, skipped=skipped, unit="m", up="y",
            images=tuple(image for image in images if not image.startswith("data:")),
        )  # fmt: skip
        return made(
            self._delivered, stacked(self._points), corners, every(3, self._faces), reading,
            group=_repeated(self._group), groups=tuple(self._groups) or ("",), texture=self._texture(),
        )  # fmt: skip

    def _texture(self) -> Texture | None:
        if not self._meshes.uvs and not self._materials:
            return None
        return Texture(
            uv=stacked(self._meshes.uv, 2),
            corner=joined(self._uv),
            material=_repeated(self._material),
            materials=tuple((one.name, one.image) for one in self._materials),
        )


def _repeated(runs: list[tuple[int, int]]) -> Index:
    """One value a face, of values and how many faces have each."""
    table = np.array(runs, dtype=np.intp).reshape(-1, 2)
    return np.repeat(table[:, 0], table[:, 1])


def _moved(points: Coordinates, matrix: Matrix) -> Coordinates:
    with np.errstate(over="ignore", invalid="ignore"):
        moved: Coordinates = points @ matrix[:3, :3].T + matrix[:3, 3]
    return moved


def _mirrors(matrix: Matrix) -> bool:
    with np.errstate(over="ignore", invalid="ignore"):
        return bool(np.linalg.det(matrix[:3, :3]) < 0)
