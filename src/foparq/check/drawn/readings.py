# SPDX-License-Identifier: MIT
"""How many features linework of one class may be: what is a copy, what a part, what several."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index, Reals, Texts
from foparq.findings.counts import Reading
from foparq.geom.clusters import clusters
from foparq.geom.hulls import across, hulls_of, larger_neighbours, leaders, outermost, share_within

#: Share of a hull that lies within another from which it may be part of it. Windows do not overlap.
_OVERLAP = 0.1
#: a piece with a smaller share of the area of a neighbour may be part of it: a sill, a keystone
_PIECE = 0.1
_BESIDE = 0.25  #: share of the width of that neighbour, how far from it such a piece may lie
#: Share of the middle area of the class, below which an outline is out of proportion to a feature. Cornices and other
#: long things have short pieces; windows and doors are more alike.
_SPECK, _SPECK_OF_COMPACT = 0.01, 0.05
_BULK_OF_COMPACT = 8.0  #: times the middle girth of such a class, above which an outline is out of proportion too
_COMPACT = 0.5  #: 4 pi area over the square of the girth: a rectangle four times as long as wide has 0.5, a square 0.79
_ALIKE = 0.25  #: share of the area of the largest piece of a block, from which another may be a feature like it
_APART = 0.04  #: share of the girth of the largest piece, by which features within a block stand apart


class Place(NamedTuple):
    """What the layer of an item and the inserts that hold it say of it."""

    feature_class: str  #: folded; ``""`` if none
    layer: str  #: the layer that gave the class
    feature: tuple[str, ...]  #: way to the insert that is the feature; () for loose linework
    innermost: tuple[str, ...]  #: way to the insert that holds the item itself
    block: str  #: of the insert that is the feature
    stated: bool  #: that insert stands on a layer of the class


@dataclass(frozen=True, slots=True)
class Readings:
    """Outlines of one class in one drawing, k rows."""

    outline: Geometries  #: (k,) convex hulls in the plane, metres
    first: Index  #: (k,) row of the first item of each
    reading: Texts  #: (k,) value of :class:`Reading`
    most: Index  #: (k,) the most features that it may be; 0 for copies
    pieces: Index  #: (k,) the same, blocks that may hold several being opened
    lines: Geometries  #: (k,) collections of what each is made of
    astray: int = 0  #: outlines among the counted that lie astray of the drawing

    @property
    def fewest(self) -> int:
        """The fewest features there may be."""
        return int(np.count_nonzero(self.reading == Reading.COUNTED))


def read_features(flat: Geometries, places: Sequence[Place], far: Flags, *, gap: float) -> Readings:
    """Features of one class, from linework in the plane and what layers and inserts say of it.

    Parameters
    ----------
    flat : (n,) shapely geometries, metres
    places : n Place
    far : (n,) bool
        Linework that lies astray of the drawing; features that have no other are told apart.
    gap : float, metres

    Returns
    -------
    Readings
        What cannot be seen at the scale is left out. See :func:`foparq.check.drawn.features.count_features`.
    """
    loose = np.array([not place.feature for place in places], dtype=bool)
    feature = np.full(len(flat), -1, dtype=np.intp)
    inserts, feature[~loose] = _numbered([place.feature for place in places if place.feature])
    if loose.any():
        feature[loose] = inserts + clusters(flat[loose], gap=gap)
    _, first = np.unique(feature, return_index=True)
    hulls = hulls_of(flat, feature)
    seen = across(hulls) > gap
    lead: Index = np.arange(len(hulls))
    kept = np.flatnonzero(seen)
    lead[kept] = kept[leaders(hulls[kept], np.zeros(len(kept), dtype=np.intp), gap=gap)]
    most, pieces = np.ones((2, len(hulls)), dtype=np.intp)
    own = seen & (lead == np.arange(len(hulls)))
    if inserts:
        held = np.flatnonzero(~loose)
        most[:inserts], pieces[:inserts] = _inserts(
            flat[held], feature[held], [places[row] for row in held.tolist()], first[:inserts], places, own, gap
        )
    reading: Texts = np.full(len(hulls), Reading.COPY.value, dtype=object)
    reading[own] = Reading.COUNTED.value
    rows = np.flatnonzero(own)
    reading[rows[_parts(hulls[rows], rows >= inserts, gap)]] = Reading.PART.value
    near = np.bincount(feature, weights=~far, minlength=len(hulls)) > 0
    lone = int(np.count_nonzero(~near & (reading == Reading.COUNTED)))
    # A copy may hold what its leader does not.
    for number in (most, pieces):
        np.maximum.at(number, lead, number.copy())
        number[~own] = 0
    made: Geometries = np.full(len(hulls), None, dtype=object)
    order = np.argsort(feature, kind="stable")
    shapely.geometrycollections(flat[order], indices=feature[order], out=made)
    return Readings(hulls[seen], first[seen], reading[seen], most[seen], pieces[seen], made[seen], lone)


def _parts(hulls: Geometries, loose: Flags, gap: float) -> Flags:
    """(k,) which hulls may be parts of others, or are out of proportion to a feature."""
    part = ~outermost(hulls, np.zeros(len(hulls), dtype=np.intp))
    area = shapely.area(hulls)
    if len(hulls):
        part |= _out_of_proportion(area, shapely.length(hulls))
    rows = np.flatnonzero(~part)
    # Of a rectangle a little less than its shorter side, however it is turned.
    width = 2 * area / np.maximum(shapely.length(hulls), np.finfo(float).tiny)
    smaller, larger = larger_neighbours(hulls[rows], within=np.maximum(gap, _BESIDE * width[rows]))
    smaller, larger = rows[smaller], rows[larger]
    part[smaller[share_within(hulls[smaller], hulls[larger]) > _OVERLAP]] = True
    beside = loose[smaller] & (area[smaller] < _PIECE * area[larger])
    touching = loose[smaller] & (shapely.distance(hulls[smaller], hulls[larger]) <= gap)
    part[smaller[beside | touching]] = True
    return part


def _out_of_proportion(area: Reals, girth: Reals) -> Flags:
    """(k,) outlines that are too small, or of compact things too large, to be like the others of their class."""
    round_ = 4 * np.pi * area / np.maximum(girth, np.finfo(float).tiny) ** 2
    if not np.median(round_) > _COMPACT:
        small: Flags = area < _SPECK * np.median(area)
        return small
    out: Flags = (area < _SPECK_OF_COMPACT * np.median(area)) | (girth > _BULK_OF_COMPACT * np.median(girth))
    return out


def _inserts(
    flat: Geometries, feature: Index, held: Sequence[Place], first: Index, places: Sequence[Place], own: Flags,
    gap: float,
) -> tuple[Index, Index]:  # fmt: skip
    """The most features that each insert may be, after both readings."""
    one = [places[row] for row in first.tolist()]
    times = Counter(place.block for place, counts in zip(one, own[: len(one)].tolist(), strict=True) if counts)
    often = np.array([bool(place.block) and times[place.block] > 1 for place in one], dtype=bool)
    stated = np.array([place.stated for place in one], dtype=bool)
    _, innermost = _numbered([place.innermost for place in held])
    most = np.where(often, 1, _within(flat, feature, innermost, gap))
    settled = often & stated
    pieces = most.copy()
    several = np.bincount(feature) > 1
    rows = np.flatnonzero((several & ~settled)[feature])
    if len(rows):
        apart = _within(flat[rows], feature[rows], clusters(flat[rows], gap=gap), gap)
        pieces[: len(apart)] = np.maximum(pieces[: len(apart)], apart)
    alike = _alike(flat, feature, [place.block for place in one], often & several, gap)
    return np.maximum(most, alike), np.maximum(pieces, alike)


def _alike(flat: Geometries, feature: Index, blocks: Sequence[str], often: Flags, gap: float) -> Index:
    """(f,) pieces of each block placed several times that are like one another and stand apart; 1 at least.

    A sill below its window, and sashes side by side, are no features of their own; two windows in one block are.
    """
    number = np.ones(len(blocks), dtype=np.intp)
    known: dict[str, int] = {}
    order = np.argsort(feature, kind="stable")
    starts = np.searchsorted(feature[order], np.arange(len(blocks) + 1))
    for n in np.flatnonzero(often).tolist():
        if blocks[n] not in known:
            known[blocks[n]] = _standing_apart(flat[order[starts[n] : starts[n + 1]]], gap)
        number[n] = known[blocks[n]]
    return number


def _standing_apart(flat: Geometries, gap: float) -> int:
    hulls = hulls_of(flat, clusters(flat, gap=gap))
    hulls = hulls[(across(hulls) > gap) & outermost(hulls, np.zeros(len(hulls), dtype=np.intp))]
    area = shapely.area(hulls)
    like = hulls[area >= _ALIKE * area.max(initial=0.0)]
    return int(clusters(like, gap=_APART * float(shapely.length(like).max(initial=0.0))).max(initial=0)) + 1


def _within(flat: Geometries, feature: Index, part: Index, gap: float) -> Index:
    """(f,) parts of each feature that can be seen and do not lie within another of its parts; 1 at least."""
    pair, label = np.unique(np.stack([feature, part], axis=1), axis=0, return_inverse=True)
    label = label.reshape(-1)
    several = np.bincount(pair[:, 0])[pair[:, 0]] > 1
    found = np.zeros(len(pair), dtype=bool)
    if several.any():
        rows = several[label]
        hulls = hulls_of(flat[rows], np.unique(label[rows], return_inverse=True)[1].reshape(-1))
        found[several] = (across(hulls) > gap) & _first_of_copies(hulls, pair[several, 0], gap)
    counted: Index = np.maximum(1, np.bincount(pair[:, 0], weights=found).astype(np.intp))
    return counted


def _first_of_copies(hulls: Geometries, group: Index, gap: float) -> Flags:
    leads = leaders(hulls, group, gap=gap) == np.arange(len(hulls))
    first: Flags = leads & outermost(hulls, group)
    return first


def _numbered(keys: Sequence[tuple[str, ...]]) -> tuple[int, Index]:
    numbers: dict[tuple[str, ...], int] = {}
    index = np.fromiter((numbers.setdefault(key, len(numbers)) for key in keys), np.intp, len(keys))
    return len(numbers), index
