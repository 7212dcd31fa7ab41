# SPDX-License-Identifier: MIT
"""How many features of each class were drawn.

A drawing does not say where one feature ends and the next begins, so every count is an interval.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import shapely

from foparq.check.drawn.facts import all_layers
from foparq.check.layers import matches
from foparq.columns import Geometries, Index
from foparq.findings.counts import FeatureCounts
from foparq.geom.clusters import clusters
from foparq.geom.hulls import across, hulls_of, outermost
from foparq.geom.rounding import FARTHEST
from foparq.model.drawing import Drawing
from foparq.model.items import Role, holders_of


class Counted(NamedTuple):
    """Features of one class in one drawing."""

    fewest: int
    most: int
    pieces: int


class _Place(NamedTuple):
    # What the layer of an item and the inserts that hold it say of it.
    feature_class: str  # folded; "" if none
    layer: str  # the layer that gave the class
    feature: tuple[str, ...]  # way to the insert that is the feature; () for loose linework
    innermost: tuple[str, ...]  # way to the insert that holds the item itself
    block: str  # of the insert that is the feature
    stated: bool  # that insert stands on a layer of the class


@dataclass(slots=True)
class _Totals:
    spelling: dict[str, set[str]] = field(default_factory=dict)
    tallies: dict[tuple[str, str], list[Counted]] = field(default_factory=dict)
    unmapped: Counter[str] = field(default_factory=Counter)
    hidden: set[tuple[str, str, str]] = field(default_factory=set)

    def fold(self, name: str) -> str:
        self.spelling.setdefault(name.casefold(), set()).add(name)
        return name.casefold()

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
    long as its pieces lie no farther apart than ``gap`` in the plane of the drawing. Names of classes and facades are
    told apart without regard to case. The three counts read this as follows.

    ``count``: what lies within the convex hull of another feature of its class belongs to it, as the glass to the
    frame. Of drawings that show the same facade, the one with most features counts.

    ``most``: nothing belongs to what surrounds it. A block that is placed only once may hold several features: each
    block within it is one, except those inside the hull of another. Drawings that show the same facade are added.

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
    return FeatureCounts(
        feature_class=np.array([totals.shown(name) for name, _ in ordered], dtype=object),
        facade=np.array([totals.shown(facade) for _, facade in ordered], dtype=object),
        count=np.array([max(tally.fewest for tally in tallies) for tallies in found], dtype=np.intp),
        most=np.array([sum(tally.most for tally in tallies) for tallies in found], dtype=np.intp),
        pieces=np.array([sum(tally.pieces for tally in tallies) for tallies in found], dtype=np.intp),
        unmapped=tuple(sorted(totals.unmapped.items())),
        hidden=tuple(sorted((totals.shown(name), totals.shown(f), layer) for name, f, layer in totals.hidden)),
    )


def _add(totals: _Totals, drawing: Drawing, gap: float) -> None:
    items = drawing.items
    there = ~items.paper & ~(shapely.is_missing(items.geometry) | shapely.is_empty(items.geometry))
    drawn = there & np.isin(items.role, [Role.LINE, Role.AREA])
    named = there & drawing.visible_rows() & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT])
    facade = totals.fold(drawing.facade)
    rows = np.flatnonzero(drawn | named)
    places = _places(drawing, rows)
    of_class: dict[str, list[int]] = {}
    for row, place in zip(rows.tolist(), places, strict=True):
        if place.feature_class:
            of_class.setdefault(place.feature_class, []).append(row)
        elif named[row]:
            totals.unmapped[items.layer[row]] += 1
    place_of = dict(zip(rows.tolist(), places, strict=True))
    bound = _bound_classes(drawing)
    for name in bound:
        totals.tallies.setdefault((totals.fold(name), facade), [])
    for key in sorted({name.casefold() for name in bound}):
        mine = np.array(of_class.get(key, []), dtype=np.intp)
        mine = mine[drawn[mine]]
        shown = items.visible[mine]
        seen, flat = _in_plane(drawing, mine[shown])
        at = [place_of[row] for row in seen.tolist()]
        totals.tallies[key, facade].append(_tally(flat, at, gap))
        # A block has parts that are not shown, in programs that switch its forms; it is drawn all the same.
        drawn_inserts = {place.feature for place in at} - {()}
        veiled = (place_of[row] for row in mine[~shown].tolist())
        totals.hidden |= {(key, facade, place.layer) for place in veiled if place.feature not in drawn_inserts}


def _bound_classes(drawing: Drawing) -> list[str]:
    """Classes with a layer of the drawing; a pattern that no layer matches binds nothing: it may be misspelt."""
    layers = all_layers(drawing)
    return [name for pattern, name in drawing.classes.items() if any(matches(layer, (pattern,)) for layer in layers)]


def _places(drawing: Drawing, rows: Index) -> list[_Place]:
    """What layer and inserts say of every row; each combination is looked at once."""
    classes: dict[str, str] = {}
    known: dict[tuple[str, str], _Place] = {}
    keys = list(zip(drawing.items.layer[rows].tolist(), drawing.items.holders[rows].tolist(), strict=True))
    for key in set(keys):
        known[key] = _place(*key, drawing.classes, classes)
    return [known[key] for key in keys]


def _place(layer: str, holders: str, patterns: Mapping[str, str], known: dict[str, str]) -> _Place:
    def class_of(name: str) -> str:
        if name not in known:
            known[name] = next((c.casefold() for pattern, c in patterns.items() if matches(name, (pattern,))), "")
        return known[name]

    chain = holders_of(holders)
    way = tuple(holder.name for holder in chain)
    layers = [layer, *(holder.layer for holder in chain)]
    giver = next((name for name in layers if class_of(name)), layer)
    feature_class = class_of(giver)
    same = next((n for n, holder in enumerate(chain) if class_of(holder.layer) == feature_class), None)
    at = same or 0
    return _Place(feature_class, giver, way[: at + 1], way, chain[at].block if chain else "", same is not None)


def _in_plane(drawing: Drawing, rows: Index) -> tuple[Index, Geometries]:
    """Rows that lie somewhere, and their geometries in the plane of the drawing, metres."""
    geometry = drawing.items.geometry[rows]
    coordinates, index = shapely.get_coordinates(geometry, include_z=True, return_index=True)
    coordinates[:, 2] = np.nan_to_num(coordinates[:, 2])
    with np.errstate(invalid="ignore", over="ignore"):  # coordinates may be anything
        sheet = drawing.plane.project(coordinates, drawing.unit.metres or 1.0)[:, :2]
    there = np.ones(len(rows), dtype=bool)
    there[index[~(np.abs(sheet) <= FARTHEST).all(axis=1)]] = False
    return rows[there], shapely.set_coordinates(shapely.force_2d(geometry[there]), sheet[there[index]])


def _tally(flat: Geometries, places: Sequence[_Place], gap: float) -> Counted:
    if not len(flat):
        return Counted(0, 0, 0)
    loose = np.array([not place.feature for place in places], dtype=bool)
    near = np.full(len(flat), -1, dtype=np.intp)
    if loose.any():
        near[loose] = clusters(flat[loose], gap=gap)
    alone = hulls_of(flat[loose], near[loose])
    alone = alone[across(alone) > gap]
    hulls, most, pieces = _inserts(flat[~loose], [place for place in places if place.feature], gap)
    every = np.concatenate([alone, hulls])
    count = int(np.count_nonzero(outermost(every, np.zeros(len(every), dtype=np.intp))))
    return Counted(count, len(alone) + most, len(alone) + pieces)


def _inserts(flat: Geometries, places: Sequence[_Place], gap: float) -> tuple[Geometries, int, int]:
    """Hulls of the features that are inserts, and the most features that they may be, after both readings."""
    if not places:
        return flat, 0, 0
    number, feature = _numbered([place.feature for place in places])
    hulls = hulls_of(flat, feature)
    large = across(hulls) > gap
    one = dict(zip(feature.tolist(), places, strict=True))
    times = Counter(place.block for place in one.values() if place.block)
    often = np.array([times[one[n].block] > 1 for n in range(number)], dtype=bool)
    stated = np.array([one[n].stated for n in range(number)], dtype=bool)
    _, innermost = _numbered([place.innermost for place in places])
    blocks = np.where(often, 1, _within(flat, feature, innermost, gap))
    settled = often & stated
    parts = blocks.copy()
    several = np.bincount(feature) > 1
    rows = np.flatnonzero((several & ~settled)[feature])
    if len(rows):
        apart = _within(flat[rows], feature[rows], clusters(flat[rows], gap=gap), gap)
        parts[: len(apart)] = np.maximum(parts[: len(apart)], apart)
    return hulls[large], int(blocks[large].sum()), int(parts[large].sum())


def _within(flat: Geometries, feature: Index, part: Index, gap: float) -> Index:
    """(f,) parts of each feature that can be seen and do not lie within another of its parts; 1 at least."""
    pair, label = np.unique(np.stack([feature, part], axis=1), axis=0, return_inverse=True)
    label = label.reshape(-1)
    several = np.bincount(pair[:, 0])[pair[:, 0]] > 1
    found = np.zeros(len(pair), dtype=bool)
    if several.any():
        rows = several[label]
        hulls = hulls_of(flat[rows], np.unique(label[rows], return_inverse=True)[1].reshape(-1))
        found[several] = (across(hulls) > gap) & outermost(hulls, pair[several, 0])
    counted: Index = np.maximum(1, np.bincount(pair[:, 0], weights=found).astype(np.intp))
    return counted


def _numbered(keys: Sequence[tuple[str, ...]]) -> tuple[int, Index]:
    numbers: dict[tuple[str, ...], int] = {}
    index = np.fromiter((numbers.setdefault(key, len(numbers)) for key in keys), np.intp, len(keys))
    return len(numbers), index
