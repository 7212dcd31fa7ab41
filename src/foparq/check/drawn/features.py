# SPDX-License-Identifier: MIT
"""How many features of each class were drawn.

A drawing does not say where one feature ends and the next begins, so every count is an interval.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import shapely

from foparq.check.drawn.astray import astray
from foparq.check.drawn.facts import all_layers
from foparq.check.drawn.readings import Place, Readings, read_features
from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.findings.counts import FeatureCounts, FoundFeatures
from foparq.geom.rounding import FARTHEST
from foparq.model.drawing import Drawing, SkippedReason
from foparq.model.items import Role, holders_of
from foparq.model.layers import matches
from foparq.names import folded, of_kind

#: entities that are no linework
_NO_FEATURES = frozenset(
    {"TEXT", "MTEXT", "ATTDEF", "DIMENSION", "LEADER", "MULTILEADER", "VIEWPORT", "POINT", "HATCH", "IMAGE"}
)


class _Outline(NamedTuple):
    key: tuple[str, str]
    drawing: str
    item: str
    layer: str
    block: str
    reading: str
    most: int
    sheet: shapely.Geometry
    outline: shapely.Geometry
    lines: shapely.Geometry


@dataclass(slots=True)
class _Totals:
    spelling: dict[str, set[str]] = field(default_factory=dict)
    tallies: dict[tuple[str, str], list[Readings]] = field(default_factory=dict)
    unmapped: Counter[str] = field(default_factory=Counter)
    hidden: set[tuple[str, str, str]] = field(default_factory=set)
    rows: list[_Outline] = field(default_factory=list)

    def fold(self, name: str, key: Callable[[str], str]) -> str:
        self.spelling.setdefault(key(name), set()).add(name)
        return key(name)

    def shown(self, key: str) -> str:
        return min(self.spelling[key])


def count_features(drawings: Sequence[Drawing], *, gap: float) -> FeatureCounts | None:
    """Count delivered features by class and facade.

    A layer belongs to the class of the first pattern of the manifest that it matches. An item on a layer of no class
    belongs to the class of the layer of the outermost insert that has one. Lines and areas that a person sees in model
    space are counted; hidden and paper-space items, points, text, dimensions and hatches are not. What is not larger
    than ``gap``, measured across its box, cannot be seen at the scale of the drawing and is no feature.

    One feature is all that the outermost insert on a layer of the class holds, each cell of an array for itself; where
    no insert stands on such a layer, all that the outermost insert holds. Other linework of one class is one feature as
    long as its pieces lie no farther apart than ``gap`` in the plane of the drawing. Features whose convex hulls share
    nine tenths of what they cover, or lie nowhere farther apart than ``gap``, stand in one place and are one: copies,
    whatever they are made of. Names of classes and facades are told apart without regard to case, accents
    and number (:mod:`foparq.names`). The three counts read this as follows.

    ``count``: what may be part of another feature of its class is part of it. That is what lies within the hull of the
    other, or more than a tenth within it; loose linework nearer to it than ``gap``; and loose linework of less than a
    tenth of its area, no farther from it than a quarter of its width (twice its area over its girth), as a sill. An
    outline that is out of proportion to its class is part of something too: less than a hundredth of the middle area
    or, where the class is compact as windows are, than a twentieth of it, or more than eight times the middle girth.
    What lies astray of the drawing (:func:`foparq.check.drawn.astray.astray`) is counted, and told as such. Of
    drawings that show the same facade, the one with most features counts.

    ``most``: nothing belongs to what surrounds it. A block that is placed only once may hold several features: each
    block within it is one, except those inside the hull of another. A block that is placed several times may hold as
    many as it has pieces that are like one another and stand apart. Drawings that show the same facade are added.

    ``pieces``: as ``most``, but blocks that are placed only once, or not on a layer of the class, may hold as many
    features as they hold separate pieces that do not surround one another.

    Parameters
    ----------
    gap : float
        Metres.

    Returns
    -------
    FeatureCounts or None
        ``None`` if no drawing binds layers to classes, or none of those has a known unit.

    Notes
    -----
    O(n log n + near pairs).
    """
    bound = [drawing for drawing in drawings if drawing.classes and drawing.unit.metres is not None]
    if not bound:
        return None
    totals = _Totals()
    for drawing in bound:
        _add(totals, drawing, gap)
    ordered = sorted(totals.tallies)
    found = [totals.tallies[key] for key in ordered]
    fewest = [max((tally.fewest for tally in tallies), default=0) for tallies in found]
    near = [max((tally.fewest - tally.astray for tally in tallies), default=0) for tallies in found]
    return FeatureCounts(
        feature_class=np.array([totals.shown(name) for name, _ in ordered], dtype=object),
        facade=np.array([totals.shown(facade) for _, facade in ordered], dtype=object),
        count=np.array(fewest, dtype=np.intp),
        near=np.array(near, dtype=np.intp),
        most=np.array([sum(int(tally.most.sum()) for tally in tallies) for tallies in found], dtype=np.intp),
        pieces=np.array([sum(int(tally.pieces.sum()) for tally in tallies) for tallies in found], dtype=np.intp),
        unmapped=tuple(sorted(totals.unmapped.items())),
        hidden=tuple(sorted((totals.shown(name), totals.shown(f), layer) for name, f, layer in totals.hidden)),
        found=_found(totals),
    )


def _found(totals: _Totals) -> FoundFeatures:
    rows = sorted(totals.rows, key=lambda row: (row.key, row.drawing, row.item))

    def column(values: Iterable[object]) -> Texts:
        made: Texts = np.empty(len(rows), dtype=object)
        made[:] = list(values)
        return made

    return FoundFeatures(
        feature_class=column(totals.shown(row.key[0]) for row in rows),
        facade=column(totals.shown(row.key[1]) for row in rows),
        drawing=column(row.drawing for row in rows), layer=column(row.layer for row in rows),
        item=column(row.item for row in rows), block=column(row.block for row in rows),
        reading=column(row.reading for row in rows), most=np.array([row.most for row in rows], dtype=np.intp),
        sheet=column(row.sheet for row in rows), outline=column(row.outline for row in rows),
        lines=column(row.lines for row in rows),
    )  # fmt: skip


def _add(totals: _Totals, drawing: Drawing, gap: float) -> None:
    items = drawing.items
    there = ~(shapely.is_missing(items.geometry) | shapely.is_empty(items.geometry))
    drawn = there & np.isin(items.role, [Role.LINE, Role.AREA])
    named = there & drawing.visible_rows() & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT])
    facade = totals.fold(drawing.facade, folded)
    rows = np.flatnonzero(drawn | named)
    places = _places(drawing, rows)
    of_class: dict[str, list[int]] = {}
    for row, place in zip(rows.tolist(), places, strict=True):
        if place.feature_class:
            of_class.setdefault(place.feature_class, []).append(row)
        elif named[row]:
            totals.unmapped[items.layer[row]] += 1
    place_of = dict(zip(rows.tolist(), places, strict=True))
    far = _astray(drawing)
    bound = _bound_classes(drawing)
    for name in bound:
        totals.tallies.setdefault((totals.fold(name, of_kind), facade), [])
    for key in sorted({of_kind(name) for name in bound}):
        mine = np.array(of_class.get(key, []), dtype=np.intp)
        mine = mine[drawn[mine]]
        shown = items.visible[mine] & ~items.paper[mine]
        seen, flat, depth = _in_plane(drawing, mine[shown])
        at = [place_of[row] for row in seen.tolist()]
        read = read_features(flat, at, far[seen], gap=gap)
        totals.tallies[key, facade].append(read)
        totals.rows += _outlines((key, facade), drawing, read, seen, at, depth, gap)
        # A block has parts that are not shown, in programs that switch its forms; it is drawn all the same.
        drawn_inserts = {place.feature for place in at} - {()}
        veiled = (place_of[row] for row in mine[~shown].tolist())
        totals.hidden |= {(key, facade, place.layer) for place in veiled if place.feature not in drawn_inserts}
        totals.hidden |= {(key, facade, layer) for layer in _on_paper(drawing, key)}


def _on_paper(drawing: Drawing, key: str) -> set[str]:
    """Layers of a class with what may be features in paper space, which is not read."""
    known: dict[str, str] = {}
    layers = {
        skipped.layer
        for skipped in drawing.reading.skipped
        if skipped.reason is SkippedReason.PAPER_SPACE and skipped.kind not in _NO_FEATURES
    }
    return {layer for layer in layers if _place(layer, "", drawing.classes, known).feature_class == key}


def _bound_classes(drawing: Drawing) -> list[str]:
    """Classes with a layer of the drawing; a pattern that no layer matches binds nothing: it may be misspelt."""
    layers = all_layers(drawing)
    return [name for pattern, name in drawing.classes.items() if any(matches(layer, (pattern,)) for layer in layers)]


def _places(drawing: Drawing, rows: Index) -> list[Place]:
    """What layer and inserts say of every row; each combination is looked at once."""
    classes: dict[str, str] = {}
    known: dict[tuple[str, str], Place] = {}
    keys = list(zip(drawing.items.layer[rows].tolist(), drawing.items.holders[rows].tolist(), strict=True))
    for key in set(keys):
        known[key] = _place(*key, drawing.classes, classes)
    return [known[key] for key in keys]


def _place(layer: str, holders: str, patterns: Mapping[str, str], known: dict[str, str]) -> Place:
    def class_of(name: str) -> str:
        if name not in known:
            known[name] = next((of_kind(c) for pattern, c in patterns.items() if matches(name, (pattern,))), "")
        return known[name]

    chain = holders_of(holders)
    way = tuple(holder.name for holder in chain)
    layers = [layer, *(holder.layer for holder in chain)]
    giver = next((name for name in layers if class_of(name)), layer)
    feature_class = class_of(giver)
    same = next((n for n, holder in enumerate(chain) if class_of(holder.layer) == feature_class), None)
    at = same or 0
    return Place(feature_class, giver, way[: at + 1], way, chain[at].block if chain else "", same is not None)


def _in_plane(drawing: Drawing, rows: Index) -> tuple[Index, Geometries, Reals]:
    """Rows that lie somewhere, their geometries in the plane of the drawing, and their depths, metres."""
    geometry = drawing.items.geometry[rows]
    coordinates, index = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    coordinates[:, 2] = np.nan_to_num(coordinates[:, 2])
    with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
        sheet = drawing.plane.project(coordinates, drawing.unit.metres or 1.0)
    there = np.ones(len(rows), dtype=bool)
    there[index[~(np.abs(sheet) <= FARTHEST).all(axis=1)]] = False
    seen = there[index]
    first = np.unique(index[seen], return_index=True)[1]
    flat = shapely.set_coordinates(shapely.force_2d(geometry[there]), sheet[seen, :2])
    return rows[there], flat, sheet[seen, 2][first]


def _astray(drawing: Drawing) -> Flags:
    """(n,) items that lie astray of all that the drawing shows in model space."""
    items = drawing.items
    far = np.zeros(len(items.geometry), dtype=bool)
    shown = np.flatnonzero(items.visible & ~items.paper & np.isin(items.role, [Role.LINE, Role.AREA]))
    rows, flat, depth = _in_plane(drawing, shown[shapely.get_num_coordinates(items.geometry[shown]) > 0])
    if len(rows):
        box = shapely.bounds(flat)
        low, high = np.column_stack([box[:, :2], depth]), np.column_stack([box[:, 2:], depth])
        far[rows] = astray(low, high, shapely.length(flat))
    return far


def _outlines(
    key: tuple[str, str], drawing: Drawing, read: Readings, rows: Index, places: Sequence[Place], depth: Reals,
    gap: float,
) -> list[_Outline]:  # fmt: skip
    """What was read as a feature, with its place in the file; an outline without width gets that of ``gap``."""
    narrow = shapely.area(read.outline) <= 0
    sheet = np.where(narrow, shapely.buffer(read.outline, gap / 2, quad_segs=2), read.outline)
    corners, owner = shapely.get_coordinates(sheet, return_index=True)
    deep = np.column_stack([corners, depth[read.first][owner]])
    outline = shapely.set_coordinates(shapely.force_3d(sheet), drawing.plane.lift(deep, drawing.unit.metres or 1.0))
    items = drawing.items.item[rows[read.first]]
    return [
        _Outline(key, drawing.path, str(items[n]), places[row].layer, places[row].block, str(read.reading[n]),
                 int(read.most[n]), sheet[n], outline[n], read.lines[n])
        for n, row in enumerate(read.first.tolist())
    ]  # fmt: skip
