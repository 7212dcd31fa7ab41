# SPDX-License-Identifier: MIT
"""How many features of each class were delivered."""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Self

import numpy as np

from foparq.columns import Geometries, Index, Texts


class Reading(StrEnum):
    """What one outline is taken for where the fewest features are counted."""

    COUNTED = "counted"  #: a feature
    PART = "part"  #: it may be part of another, or of nothing
    COPY = "copy"  #: it stands in the place of another


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundFeatures:
    """Outlines that were taken for features, k rows ordered by class, facade, drawing and item."""

    feature_class: Texts  #: (k,)
    facade: Texts  #: (k,)
    drawing: Texts  #: (k,) path
    layer: Texts  #: (k,) that gave the class
    item: Texts  #: (k,) first item, or first of the insert
    block: Texts  #: (k,) ``""`` for loose linework
    reading: Texts  #: (k,) value of :class:`Reading`
    most: Index  #: (k,) the most features that it may be; 0 for copies
    sheet: Geometries  #: (k,) polygons in the plane of the drawing, metres
    outline: Geometries  #: (k,) the same in coordinates of the file
    lines: Geometries  #: (k,) what is drawn of it, in the plane of the drawing, metres

    def __len__(self) -> int:
        return len(self.item)

    @classmethod
    def none(cls) -> Self:
        """No features."""
        text, number = np.empty(0, dtype=object), _left_out()
        return cls(
            feature_class=text, facade=text, drawing=text, layer=text, item=text, block=text, reading=text,
            most=number, sheet=text, outline=text, lines=text,
        )  # fmt: skip


def _left_out() -> Index:
    return np.empty(0, dtype=np.intp)


class Listed(StrEnum):
    """What stands where a feature of the list is looked for."""

    UNPLACED = ""  #: the list gives no place, or a place for several
    THERE = "there"
    ABSENT = "absent"
    OTHER = "other"  #: a feature of another class
    UNSURE = "unsure"  #: what may be part of another feature, or several features in one


@dataclass(frozen=True, slots=True, kw_only=True)
class Placements:
    """Features of the list on the drawings, n rows as in the list."""

    lies: Texts  #: (n,) value of :class:`Listed`
    row: Index  #: (n,) outline that was assigned, or that of the other class; -1 if none

    @property
    def elsewhere(self) -> bool:
        """Whether fewer than half of the places lie on anything of their class: the list speaks of another drawing."""
        placed = self.lies != Listed.UNPLACED
        return bool(2 * np.count_nonzero(np.isin(self.lies, [Listed.THERE, Listed.UNSURE])) < np.count_nonzero(placed))


@dataclass(frozen=True, slots=True, kw_only=True)
class Unlisted:
    """Surface of a mesh of which the list says nothing."""

    path: str  #: of the mesh
    pieces: int
    area: float  #: of these, square metres
    whole: float  #: area of the mesh, square metres
    where: tuple[float, float, float] | None  #: a place on the largest, in axes of the mesh, metres
    looked: bool = True  #: false: the spacing is too fine for the mesh


@dataclass(frozen=True, slots=True, kw_only=True)
class ListDoubts:
    """What makes a list of places say less of meshes than it seems to."""

    tol: float  #: a wider tolerance tells features from nothing, metres
    coarse: int  #: places with a wider one
    rounded: float  #: what the printed digits of the places may hide, metres
    spacing: float  #: so with the spacing of the list, metres
    sparse: bool  #: it states a wider one
    repeated: int  #: places that repeat one of the same class
    prohibited: int  #: rows of features that must not be there: no surface tells


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureCounts:
    """Delivered features by class and facade, n rows ordered by both.

    Nobody wrote into the drawing where one feature ends and the next begins. ``count`` is the natural reading and the
    fewest features there may be; ``most`` and ``pieces`` are the most.
    """

    feature_class: Texts  #: (n,) ``"window"``
    facade: Texts  #: (n,) ``"N"``; ``""`` if the drawing names none
    count: Index  #: (n,)
    most: Index = field(default_factory=_left_out)  #: (n,) without nesting, every block one; left out: ``count``
    pieces: Index = field(default_factory=_left_out)  #: (n,) blocks that may hold several opened; left out: ``most``
    near: Index = field(default_factory=_left_out)  #: (n,) of ``count``, without what lies astray; left out: ``count``
    unmapped: tuple[tuple[str, int], ...] = ()  #: layers that no class is bound to, with their items: not assessed
    hidden: tuple[tuple[str, str, str], ...] = ()  #: class, facade and layer of items that nobody sees
    found: FoundFeatures = field(default_factory=FoundFeatures.none)  #: of which the counts are made
    placements: Placements | None = None  #: of the list; ``None`` if it gives no places
    on_meshes: bool = False  #: features were looked for on meshes, where nobody can count them
    places_on: tuple[tuple[str, int], ...] = ()  #: meshes, and how many places of the list lie on each
    doubts: ListDoubts | None = None  #: about the list, where features were looked for on meshes
    unlisted: tuple[Unlisted, ...] = ()  #: a mesh each; none if the list does not state how far apart its places are

    def __post_init__(self) -> None:
        for name, instead in (("most", "count"), ("pieces", "most"), ("near", "count")):
            if not len(getattr(self, name)):
                object.__setattr__(self, name, getattr(self, instead))
