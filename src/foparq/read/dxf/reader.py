# SPDX-License-Identifier: MIT
"""DXF drawings, R12 to R2018, text and binary.

Model space becomes columns of items; what cannot is skipped and counted, never dropped. Blocks are taken apart after
counting them. Paper space is counted only. Curves are flattened; straight vertices stay as delivered, bit by bit.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
import shapely

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Bomb, Dimensions, Reading, SkippedReason
from foparq.model.items import Items
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.blocks import Census, admit
from foparq.read.dxf.content import MODEL, Content, count_contents, read_contents
from foparq.read.dxf.curves import Sagitta
from foparq.read.dxf.facts import MalformedError, common_of
from foparq.read.dxf.gather import Columns, LayerTable, LeftOut
from foparq.read.dxf.items import place_contents
from foparq.read.dxf.kinds import ANNOTATIONS, Unseen
from foparq.read.dxf.labels import labels_of, scales_of
from foparq.read.dxf.load import UTF8_SINCE, load_document
from foparq.read.dxf.sketch import Builder, texts
from foparq.read.dxf.structure import asked, layer_table, paper_entities, unplotted_layers
from foparq.read.dxf.text import readable
from foparq.read.dxf.units import Lettered, drawing_unit
from foparq.read.letters import garbled
from foparq.read.raw import RawDrawing, holds_drawing


def read_dxf(
    path: Path, *, limits: LimitsSpec, sagitta: float, unit: str | None, blocks: Literal["explode", "skip"]
) -> RawDrawing:
    """Read one DXF drawing.

    Parameters
    ----------
    limits : LimitsSpec
        Bounds of bytes, entities and vertices. Time and memory are bounded by the process this runs in.
    sagitta : float, metres
        Greatest distance between a curve and the chords that replace it. If nobody says what a drawing unit is, one
        ten-thousandth of each curve's own size instead.
    unit : str, optional
        Unit that the user states; wins over the header.
    blocks : {"explode", "skip"}
        ``skip``: only what stands in model space itself.

    Raises
    ------
    UnreadableError
        If the file is no DXF file or is broken beyond mending.
    UnsafeError
        If the file is larger than the limits allow.
    QuantityError
        If the stated unit is not known.
    """
    try:
        return _read(path, limits, sagitta, unit, explode=blocks == "explode")
    except MalformedError as error:
        raise UnreadableError("dxf.unreadable", file=path.name, reason=str(error)) from error
    except MemoryError as error:
        raise UnsafeError("dxf.memory", file=path.name) from error


def _read(path: Path, limits: LimitsSpec, sagitta: float, unit: str | None, *, explode: bool) -> RawDrawing:
    loaded = load_document(path, limits.bytes)
    document = loaded.document
    drawn_in = drawing_unit(document.header, unit)
    version = str(document.loaded_dxfversion or "")
    encoding = "utf-8" if version >= UTF8_SINCE else str(document.encoding)
    layers = LayerTable(layer_table(document))
    contents = read_contents(document, explode=explode)
    census = count_contents(contents)
    model = contents[MODEL]
    if len(model.entities) > limits.entities:
        raise UnsafeError("dxf.too-many-entities", file=path.name, value=len(model.entities), limit=limits.entities)
    refused = _refused(model, census, limits.entities - len(model.entities))
    absolute = None if drawn_in.metres is None else sagitta / drawn_in.metres
    builder = Builder(layers, Columns(limits.vertices, path.name), LeftOut(), Sagitta(absolute), loaded.written)
    with np.errstate(all="ignore"):  # coordinates that are no finite numbers are delivered as they come out
        place_contents(contents, census.order, refused.keys(), census.cyclic, builder)
    items = builder.columns.items(layers)
    _count_paper(document, items, builder)
    names = tuple(dict.fromkeys([*layers.table, *layers.names]))
    hidden = tuple(name for name, hidden in zip(layers.names, layers.hidden, strict=True) if hidden)
    off = {name.casefold() for name in unplotted_layers(document)}
    unplotted = tuple(name for name in names if name.casefold() in off)
    reading = Reading(
        version=version,
        encoding=encoding,
        repairs=loaded.repairs,
        skipped=builder.tally.records(),
        bombs=_bombs(model, census, refused, builder),
        bad_names=tuple(name for name in names if garbled(name, encoding)),
        dimensions=_dimensions(builder.dimensions),
        labels=labels_of(document, {*hidden, *unplotted}),
        scales=scales_of(document),
        layers=names,
        hidden_layers=hidden,
        unplotted=unplotted,
    )
    return RawDrawing(items=items, reading=reading, unit=drawn_in)


def _refused(model: Content, census: Census, room: int) -> dict[str, int]:
    wanted: dict[str, int] = {}
    for insert in model.inserts:
        wanted[insert.block] = wanted.get(insert.block, 0) + insert.times
    return admit(wanted, census, room)


def _bombs(model: Content, census: Census, refused: Mapping[str, int], builder: Builder) -> tuple[Bomb, ...]:
    """One for each insert of model space that is not taken apart, or not wholly."""
    bombs = []
    for insert in model.inserts:
        block, layer, handle = insert.block, insert.common.layer, builder.handle(insert.common)
        if refused.get(block, -1) >= 0:
            count = refused[block] * insert.times
            bombs.append(Bomb(block=insert.facts.name, layer=layer, handle=handle, entities=count))
        elif block in census.leads:
            bombs.append(Bomb(block=census.leads[block], layer=layer, handle=handle, entities=-1))
    return tuple(bombs)


def _count_paper(document: Any, items: Items, builder: Builder) -> None:  # noqa: ANN401
    # Linework on the sheet frames the drawing, unless nothing else is drawn.
    frame = SkippedReason.PAPER_SPACE if holds_drawing(items) else SkippedReason.PAPER_SPACE_ONLY
    for entity in paper_entities(document):
        common = asked(partial(common_of, entity))
        layer = builder.layers.names[builder.layers.number(readable(common.layer))]
        lettering = common.kind in ANNOTATIONS or common.kind == "VIEWPORT"
        reason = SkippedReason.PAPER_SPACE if lettering else frame
        builder.tally.add(Unseen(reason), common.kind, layer, builder.handle(common))


def _dimensions(found: Sequence[Lettered]) -> Dimensions | None:
    if not found:
        return None
    points = np.array([dimension.point for dimension in found])
    return Dimensions(
        measured=np.array([dimension.measured for dimension in found]),
        text=texts([dimension.text for dimension in found]),
        handle=texts([dimension.handle for dimension in found]),
        where=shapely.points(points[:, :2] if not points[:, 2].any() else points),
    )
