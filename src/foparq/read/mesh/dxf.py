# SPDX-License-Identifier: MIT
"""Surfaces of faces in the model space of a DXF file, and in the blocks that it shows.

A polyface, a MESH or a polygon mesh keeps its common vertices; every 3DFACE has its own. A layer is a group. Solids and
free-form surfaces are not read, and told; lines, points and lettering beside a surface are told as such.
"""

from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Coordinates, Index
from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.mesh import MeshReading, RawMesh
from foparq.names import folded
from foparq.read.dxf.facts import LEAKS, MalformedError
from foparq.read.dxf.kinds import UNSEEN
from foparq.read.dxf.load import load_document
from foparq.read.dxf.structure import Definition, asked, find_definition, model_entities
from foparq.read.dxf.text import readable
from foparq.read.dxf.units import drawing_unit
from foparq.read.mesh.dxf_faces import Faces, faces_of, is_smoothed
from foparq.read.mesh.made import Delivered, joined, made, stacked, starts_of

_MOST_INSERTS = 100_000  #: after taking blocks apart
#: entities that are not read, by why
_REASONS = {
    kind: SkippedReason.UNKNOWN_ELEMENT if reason in (SkippedReason.SURFACE, SkippedReason.PROXY) else reason
    for kind, reason in UNSEEN.items()
    if reason not in (SkippedReason.MULTILINE, SkippedReason.UNDERLAY)
}
_DEEPEST = 64  #: blocks within each other
Matrix = NDArray[np.float64]  #: (4, 4), for places as rows


def read_dxf_mesh(delivered: Delivered) -> RawMesh:
    """Mesh of a DXF file.

    Raises
    ------
    UnreadableError
        If the file is broken beyond mending, or shows no face.
    UnsafeError
        If it holds more vertices, faces or entities than the limits allow, or blocks that never end.

    Notes
    -----
    O(n), some tens of microseconds an entity.
    """
    try:
        return _read(delivered)
    except MalformedError as error:
        raise UnreadableError("dxf.unreadable", file=delivered.name, reason=str(error)) from error
    except MemoryError as error:
        raise UnsafeError("dxf.memory", file=delivered.name) from error


def _read(delivered: Delivered) -> RawMesh:
    loaded = load_document(delivered.path, delivered.limits.bytes)
    document = loaded.document
    surface = _Surface(delivered, document)
    surface.add(model_entities(document), None, "0", ())
    return surface.made(
        MeshReading(
            version=f"DXF {document.loaded_dxfversion or ''}".strip(),
            repairs=loaded.repairs,
            skipped=surface.skipped(),
            unit=drawing_unit(document.header, None).header,
        )
    )


class _Surface:
    """What was put together so far."""

    def __init__(self, delivered: Delivered, document: Any) -> None:  # noqa: ANN401
        self._delivered, self._document = delivered, document
        self._points, self._corners, self._counts = list[Coordinates](), list[Index](), list[Index]()
        self._group, self._groups = list[tuple[int, int]](), dict[str, tuple[int, str]]()
        self._vertices, self._faces, self._entities, self._inserts = 0, 0, 0, 0
        self._odd: Counter[tuple[SkippedReason, str, str, str]] = Counter()
        self._known: dict[int, Faces | None] = {}  #: surfaces of entities in blocks
        self._definitions: dict[str, Definition | None] = {}

    def add(self, entities: Sequence[Any], matrix: Matrix | None, layer: str, within: tuple[str, ...]) -> None:
        """Add the entities of model space, or of a block that is shown on a layer, within other blocks."""
        most = self._delivered.limits.entities
        for entity in entities:
            self._entities += 1
            if self._entities > most:
                raise UnsafeError("dxf.too-many-entities", file=self._delivered.name, value=self._entities, limit=most)
            try:
                # What lies on layer 0 of a block takes the layer of its insert.
                own = readable(asked(partial(_layer_of, entity)))
                own = layer if own == "0" else own
                self._add(entity, matrix, own, within)
            except MalformedError:
                self._odd[SkippedReason.MALFORMED, str(entity.dxftype()), layer, ""] += 1

    def _add(self, entity: Any, matrix: Matrix | None, layer: str, within: tuple[str, ...]) -> None:  # noqa: ANN401
        kind = str(entity.dxftype())
        if kind == "INSERT":
            self._add_insert(entity, matrix, layer, within)
            return
        faces = self._faces_of(entity) if within else faces_of(entity)
        if faces is None:
            self._odd[_REASONS.get(kind, SkippedReason.LINES_AND_POINTS), kind, layer, ""] += 1
            return
        if asked(lambda: is_smoothed(entity)):
            self._odd[SkippedReason.UNKNOWN_ELEMENT, f"{kind} (smooth)", layer, ""] += 1
        self._place(faces, matrix, layer)

    def _faces_of(self, entity: Any) -> Faces | None:  # noqa: ANN401
        # A block may be shown many times, and what takes time is reading its entities.
        if id(entity) not in self._known:
            self._known[id(entity)] = faces_of(entity)
        return self._known[id(entity)]

    def _place(self, faces: Faces, matrix: Matrix | None, layer: str) -> None:
        self._delivered.hold_vertices(self._vertices + len(faces.points))
        self._delivered.hold_faces(self._faces + len(faces.counts))
        points, corners = faces.points, faces.corners
        if matrix is not None:
            with np.errstate(over="ignore", invalid="ignore"):
                points = points @ matrix[:3, :3] + matrix[3, :3]
        # What is outside its own vertices may not fall on those of another entity.
        inside = (corners >= 0) & (corners < len(points))
        corners = np.where(inside, corners + self._vertices, np.where(corners < 0, corners, np.iinfo(np.intp).max))
        row, _ = self._groups.setdefault(folded(layer), (len(self._groups), layer))
        self._points.append(points)
        self._corners.append(corners)
        self._counts.append(faces.counts)
        self._group.append((row, len(faces.counts)))
        self._vertices += len(points)
        self._faces += len(faces.counts)

    def _add_insert(self, insert: Any, matrix: Matrix | None, layer: str, within: tuple[str, ...]) -> None:  # noqa: ANN401
        name = asked(lambda: str(insert.dxf.get("name", "")))
        if name not in self._definitions:
            self._definitions[name] = find_definition(self._document, name)
        definition = self._definitions[name]
        if definition is None or (definition.external and not definition.entities):
            reason = SkippedReason.MISSING_BLOCK if definition is None else SkippedReason.EXTERNAL_REFERENCE
            self._odd[reason, "INSERT", layer, readable(name)] += 1
            return
        if folded(name) in within or len(within) >= _DEEPEST:
            raise UnsafeError("mesh.dxf-blocks", file=self._delivered.name, value=readable(name))
        places = _places_of(insert)
        self._inserts += len(places)
        if self._inserts > _MOST_INSERTS:
            raise UnsafeError(
                "dxf.too-many-entities", file=self._delivered.name, value=self._inserts, limit=_MOST_INSERTS
            )
        for own in places:
            above = own if matrix is None else own @ matrix
            self.add(definition.entities, above, layer, (*within, folded(name)))

    def skipped(self) -> tuple[Skipped, ...]:
        """What was not read."""
        return tuple(
            Skipped(reason=reason, kind=kind, layer=layer, name=name, count=count)
            for (reason, kind, layer, name), count in sorted(self._odd.items())
        )

    def made(self, reading: MeshReading) -> RawMesh:
        """The mesh.

        Raises
        ------
        UnreadableError
            If there is no face.
        """
        runs = np.array(self._group, dtype=np.intp).reshape(-1, 2)
        return made(
            self._delivered, stacked(self._points), joined(self._corners),
            starts_of(joined(self._counts)), reading, group=np.repeat(runs[:, 0], runs[:, 1]),
            groups=tuple(name for _, name in self._groups.values()) or ("",),
        )  # fmt: skip


def _layer_of(entity: Any) -> str:  # noqa: ANN401
    return str(entity.dxf.get("layer", "0"))


def _places_of(insert: Any) -> list[Matrix]:  # noqa: ANN401
    """Where an insert puts its block: once, or in every cell of its array."""
    try:
        if insert.mcount > _MOST_INSERTS:
            raise MalformedError(f"INSERT: {insert.mcount}")
        cells = list(insert.multi_insert()) if insert.mcount > 1 else [insert]
        return [np.array(list(cell.matrix44()), dtype=np.float64).reshape(4, 4) for cell in cells]
    except LEAKS as error:
        raise MalformedError(" ".join(str(error).split()) or type(error).__name__) from error
