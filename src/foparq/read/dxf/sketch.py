# SPDX-License-Identifier: MIT
"""One definition drawn once, and its copies at every place where it is inserted."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from foparq.columns import Flags, Index, Integers, Reals, Texts
from foparq.model.drawing import SkippedReason
from foparq.model.items import Role
from foparq.read.dxf.curves import Sagitta
from foparq.read.dxf.draw import Shape, draw
from foparq.read.dxf.gather import FACE, LINE, PLACE, Chunk, Columns, LayerTable, LeftOut, role_number
from foparq.read.dxf.kinds import FACES, Unseen
from foparq.read.dxf.records import Common, Facts
from foparq.read.dxf.units import Lettered

_LEVELS = 40  #: enlargement beyond 2 ** 40 is no drawing
_SLACK = 1e-9  #: rounding of a unit matrix must not count as enlargement

Entities = Sequence[tuple[Common, Facts]]


@dataclass(slots=True, kw_only=True)
class Placements:
    """c placements of one definition."""

    matrix: Reals | None  #: (c, 3, 4) definition to world; None: one placement, unmoved
    layer: Integers  #: (c,) layer that content of layer 0 takes
    hidden: Flags  #: (c,) hidden altogether
    inserts: Texts  #: (c,) handles of the inserts, each followed by ``/``
    item: Texts  #: (c,) the same with the number of the cell in arrays
    holders: Texts  #: (c,) as in ``Items.holders``

    def __len__(self) -> int:
        return len(self.layer)

    def take(self, rows: Index) -> "Placements":
        """The chosen placements."""
        return Placements(
            matrix=None if self.matrix is None else self.matrix[rows], layer=self.layer[rows], hidden=self.hidden[rows],
            inserts=self.inserts[rows], item=self.item[rows], holders=self.holders[rows],
        )  # fmt: skip


@dataclass(slots=True)
class Builder:
    """Everything that placing needs and gathers."""

    layers: LayerTable
    columns: Columns
    tally: LeftOut
    sagitta: Sagitta
    written: frozenset[str] | None  #: handles that the file holds; None: all of them
    dimensions: list[Lettered] = field(default_factory=list)

    def handle(self, common: Common) -> str:
        """Handle as the file writes it; ``""`` for one that the parser made up."""
        return common.handle if self.written is None or common.handle in self.written else ""

    def effective(self, common: Common, places: Placements) -> Integers:
        """(c,) layer at every place: layer 0 takes that of the insert."""
        number = self.layers.number(common.layer)
        return places.layer if number == 0 else np.full(len(places), number, dtype=np.int32)

    def skip(self, unseen: Unseen, common: Common, places: Placements) -> None:
        """Count an entity as skipped at every place."""
        numbers, counts = np.unique(self.effective(common, places), return_counts=True)
        for number, count in zip(numbers, counts, strict=True):
            self.tally.add(unseen, common.kind, self.layers.names[number], self.handle(common), int(count))

    def place(self, entities: Entities, places: Placements) -> None:
        """Draw the entities of one definition at every place.

        Raises
        ------
        UnsafeError
            If the drawing would hold too many vertices.
        """
        if not entities or not len(places):
            return
        for level, chosen in _by_level(places):
            there = places.take(chosen)
            shapes = [(common, draw(common.kind, facts, self.sagitta.tightened(level))) for common, facts in entities]
            for common, shape in shapes:
                if isinstance(shape, Unseen):
                    self.skip(shape, common, there)
                elif common.kind in FACES:
                    self.skip(Unseen(SkippedReason.SURFACE), common, there)
            drawn = [(n, common, shape) for n, (common, shape) in enumerate(shapes, 1) if isinstance(shape, Shape)]
            if not drawn:
                continue
            sketch = self._sketch(drawn)
            del shapes, drawn  # the vertices are in the sketch now
            _copy(sketch, there, self)

    def _sketch(self, drawn: Sequence[tuple[int, Common, Shape]]) -> Chunk:
        handles = [self.handle(common) for _, common, _ in drawn]
        counts = np.array([len(shape.points) for _, _, shape in drawn], dtype=np.intp)
        self.columns.check(int(counts.sum()))
        return Chunk(
            vertices=np.concatenate([shape.points for _, _, shape in drawn]),
            counts=counts,
            form=np.array([_FORMS.get(shape.role, PLACE) for _, _, shape in drawn], dtype=np.int32),
            kind=texts([common.kind for _, common, _ in drawn]),
            role=np.array([role_number(shape.role) for _, _, shape in drawn], dtype=np.int32),
            layer=np.array([self.layers.number(common.layer) for _, common, _ in drawn], dtype=np.int32),
            handle=texts(handles),
            # A file without handles leaves the position in its definition as the only name.
            item=texts([handle or f"#{n}" for handle, (n, _, _) in zip(handles, drawn, strict=True)]),
            inserts=texts([""] * len(drawn)),
            holders=texts([""] * len(drawn)),
            colour=np.array([common.colour for _, common, _ in drawn], dtype=np.int32),
            closed=np.array([shape.closed for _, _, shape in drawn], dtype=bool),
            visible=np.array([not common.invisible for _, common, _ in drawn], dtype=bool),
        )


_FORMS = {Role.LINE: LINE, Role.SURFACE: FACE}


def texts(values: Sequence[str]) -> Texts:
    """Column of strings."""
    column: Texts = np.empty(len(values), dtype=object)
    column[:] = values
    return column


def _by_level(places: Placements) -> Iterator[tuple[int, Index]]:
    """Placements grouped by the power of two that bounds their enlargement."""
    if places.matrix is None:
        yield 0, np.arange(1)
        return
    linear = np.nan_to_num(places.matrix[:, :, :3], nan=1.0, posinf=1.0, neginf=1.0)
    enlarged = np.clip(np.linalg.norm(linear, ord=2, axis=(1, 2)), 2.0**-_LEVELS, 2.0**_LEVELS)
    levels = np.ceil(np.log2(enlarged) - _SLACK).astype(int)
    for level in np.unique(levels):
        yield int(level), np.flatnonzero(levels == level)


def _copy(sketch: Chunk, places: Placements, builder: Builder) -> None:
    c, n = len(places), len(sketch.counts)
    builder.columns.expect(c * len(sketch.vertices))
    vertices = sketch.vertices
    if places.matrix is not None:
        moved = vertices @ places.matrix[:, :, :3].transpose(0, 2, 1) + places.matrix[:, None, :, 3]
        vertices = moved.reshape(-1, 3)
    layer = np.where(sketch.layer == 0, places.layer[:, None], sketch.layer).ravel()
    shown = (sketch.visible & ~places.hidden[:, None]).ravel()
    builder.columns.add(
        Chunk(
            vertices=vertices,
            counts=np.tile(sketch.counts, c),
            form=np.tile(sketch.form, c),
            kind=np.tile(sketch.kind, c),
            role=np.tile(sketch.role, c),
            layer=layer.astype(np.int32),
            handle=np.tile(sketch.handle, c),
            item=np.repeat(places.item, n) + np.tile(sketch.item, c),
            inserts=np.repeat(texts([chain.rstrip("/") for chain in places.inserts]), n),
            holders=np.repeat(places.holders, n),
            colour=np.tile(sketch.colour, c),
            closed=np.tile(sketch.closed, c),
            visible=shown & ~builder.layers.hidden[layer],
        )
    )
