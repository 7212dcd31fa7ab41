# SPDX-License-Identifier: MIT
"""Model space to columns: each block definition is drawn once and placed wherever it is inserted.

A definition is flattened once per level of enlargement and then moved by one array operation per definition, so that
the cost grows with the items made and not with the ways they are nested.
"""

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace

import numpy as np

from foparq.columns import Reals
from foparq.model.drawing import SkippedReason
from foparq.model.items import Holder
from foparq.read.dxf.content import MODEL, Content, Insert
from foparq.read.dxf.curves import axes, cos_sin
from foparq.read.dxf.kinds import Unseen
from foparq.read.dxf.records import InsertFacts
from foparq.read.dxf.sketch import Builder, Placements, texts
from foparq.read.dxf.units import Lettered

_UNIFORM = 1e-6  #: relative difference of scales within which a dimension keeps its meaning


def place_contents(
    contents: Mapping[str, Content],
    order: Sequence[str],
    refused: AbstractSet[str],
    cyclic: AbstractSet[str],
    builder: Builder,
) -> None:
    """Place model space and everything it inserts.

    Parameters
    ----------
    order : sequence of str
        Every definition before those it inserts.
    refused : set of str
        Blocks that are not taken apart where model space inserts them.
    cyclic : set of str
        Blocks that are not taken apart anywhere.
    builder : Builder
        Receives columns, skipped entities and dimensions.
    """
    unmoved = Placements(
        matrix=None, layer=np.zeros(1, dtype=np.int32), hidden=np.zeros(1, dtype=bool),
        inserts=texts([""]), item=texts([""]), holders=texts([""]),
    )  # fmt: skip
    waiting: dict[str, list[Placements]] = {MODEL: [unmoved]}
    for name in order:
        placed = waiting.pop(name, None)
        if placed is None:
            continue
        places = _join(placed)
        content = contents[name]
        builder.place(content.entities, places)
        _place_dimensions(content.dimensions, places, builder)
        for position, insert in enumerate(content.inserts, 1):
            if insert.block in cyclic or (name == MODEL and insert.block in refused):
                builder.skip(Unseen(SkippedReason.BLOCK_BOMB, insert.facts.name), insert.common, places)
                continue
            if insert.facts.clipped:
                builder.skip(Unseen(SkippedReason.XCLIP_IGNORED, insert.facts.name), insert.common, places)
            within = _placed(insert, position, places, contents[insert.block].base, builder)
            waiting.setdefault(insert.block, []).append(within)
            if insert.attributes:
                builder.place(insert.attributes, _beside(insert, places, within))


def _join(placed: list[Placements]) -> Placements:
    if len(placed) == 1:
        return placed[0]
    return Placements(
        matrix=np.concatenate([places.matrix for places in placed if places.matrix is not None]),
        layer=np.concatenate([places.layer for places in placed]),
        hidden=np.concatenate([places.hidden for places in placed]),
        inserts=np.concatenate([places.inserts for places in placed]),
        item=np.concatenate([places.item for places in placed]),
        holders=np.concatenate([places.holders for places in placed]),
    )


def _placed(
    insert: Insert, position: int, outer: Placements, base: tuple[float, float, float], builder: Builder
) -> Placements:
    own, cells = _matrices(insert.facts, base)
    matrix = own if outer.matrix is None else _after(outer.matrix, own)
    effective = builder.effective(insert.common, outer)
    hidden = outer.hidden | insert.common.invisible | builder.layers.frozen[effective]
    handle = builder.handle(insert.common)
    numbers = texts([f"{handle}/"] if cells == 1 else [f"{handle}:{cell + 1}/" for cell in range(cells)])
    # A file without handles leaves the position in the definition as the only name.
    name = handle or f"#{position}"
    names = [name] if cells == 1 else [f"{name}:{cell + 1}" for cell in range(cells)]
    held = [str(Holder(one, builder.layers.names[on], insert.block)) for on in effective.tolist() for one in names]
    return Placements(
        matrix=matrix,
        layer=np.repeat(effective, cells),
        hidden=np.repeat(hidden, cells),
        inserts=np.repeat(outer.inserts + f"{handle}/", cells),
        item=np.repeat(outer.item, cells) + np.tile(numbers, len(outer)),
        holders=np.repeat(outer.holders, cells) + texts(held),
    )


def _matrices(facts: InsertFacts, base: tuple[float, float, float]) -> tuple[Reals, int]:
    """(cells, 3, 4) definition to the space of the insert, row after row of the array; number of cells."""
    system = np.array(axes(facts.extrusion)).T  # columns: axes of the object system
    cos, sin = cos_sin(facts.rotation)
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    linear = system @ turn * np.array(facts.scale)
    down, across = np.divmod(np.arange(facts.rows * facts.columns), facts.columns)
    zero = np.zeros(len(down))
    offsets = np.stack([across * facts.column_spacing, down * facts.row_spacing, zero], axis=1) @ turn.T
    origin = (np.array(facts.point) + offsets) @ system.T - linear @ np.array(base)
    matrix = np.empty((len(down), 3, 4))
    matrix[:, :, :3], matrix[:, :, 3] = linear, origin
    return matrix, len(down)


def _after(outer: Reals, own: Reals) -> Reals:
    """(c * g, 3, 4): the g matrices of an insert, then each of the c placements of the space it stands in."""
    linear = outer[:, None, :, :3] @ own[None, :, :, :3]
    origin = np.einsum("cij,gj->cgi", outer[:, :, :3], own[:, :, 3]) + outer[:, None, :, 3]
    joined = np.concatenate([linear, origin[..., None]], axis=3)
    return joined.reshape(-1, 3, 4)


def _beside(insert: Insert, outer: Placements, within: Placements) -> Placements:
    # Attributes stand in the space of the insert; those of further cells are moved with the cell.
    cells = insert.times
    own = np.zeros((cells, 3, 4))
    own[:, :, :3] = np.eye(3)
    turned, _ = _matrices(insert.facts, (0.0, 0.0, 0.0))
    own[:, :, 3] = turned[:, :, 3] - turned[:1, :, 3]
    matrix = own if outer.matrix is None else _after(outer.matrix, own)
    return replace(within, matrix=matrix)


def _place_dimensions(dimensions: list[Lettered], places: Placements, builder: Builder) -> None:
    if not dimensions or places.matrix is None:
        builder.dimensions.extend(dimensions)
        return
    for matrix, prefix, hidden in zip(places.matrix, places.inserts, places.hidden, strict=True):
        scales = np.linalg.norm(matrix[:, :3], axis=0)
        if hidden or not np.ptp(scales) <= _UNIFORM * scales.max():
            continue
        for dimension in dimensions:
            x, y, z = (float(part) for part in matrix[:, :3] @ np.array(dimension.point) + matrix[:, 3])
            measured = dimension.measured * float(scales[0])
            builder.dimensions.append(Lettered(measured, dimension.text, prefix + dimension.handle, (x, y, z)))
