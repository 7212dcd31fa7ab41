# SPDX-License-Identifier: MIT
"""Specified against delivered features, by class and facade.

Counts cannot tell which feature is missing: as many optional features as are drawn may stand for required ones. A
deficit on one facade is never made good by a surplus on another. Delivered features are counted as an interval: what
decides is what holds for the fewest and for the most there may be.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np

from foparq.columns import Flags, Texts
from foparq.findings.counts import FeatureCounts, Listed, Placements
from foparq.model.statements import Decision
from foparq.model.tables import FeatureList
from foparq.names import folded, of_kind


class Incomparable(StrEnum):
    """Why specified and delivered features cannot be compared."""

    NONE = ""
    UNBOUND = "unbound"  #: no layer of a drawing of that facade is bound to the class: no evidence of omission
    FACADE = "facade"  #: list or drawings name no facade, the other side does
    UNLISTED = "unlisted"  #: drawn, but the list says nothing of the class, or nothing of the facade


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """Features of the list that were looked for where they are listed."""

    required: int = 0
    optional: int = 0
    there: int = 0  #: required and optional ones that are there
    absent: tuple[str, ...] = ()  #: ids of required ones that are not
    other: tuple[str, ...] = ()  #: those of them in whose place another class is drawn
    unsure: tuple[str, ...] = ()  #: ids of required ones of which linework does not decide


@dataclass(frozen=True, slots=True, kw_only=True)
class Balance:
    """Features of one class on one facade."""

    feature_class: str
    facade: str  #: ``""`` if the list states none
    required: int = 0
    optional: int = 0
    delivered: int = 0  #: the fewest there may be; 0 if not comparable
    most: int = 0  #: the most there may be, every block being one
    pieces: int = 0  #: the most there may be, blocks that may hold several being opened
    accepted: int = 0  #: required ones whose omission is accepted, with evidence
    unproven: int = 0  #: required ones whose omission is said to be accepted, without evidence
    gap: Incomparable = Incomparable.NONE
    hidden: tuple[str, ...] = ()  #: layers of the class with items that nobody sees
    ids: tuple[str, ...] = ()  #: of the list, sorted
    decision: Decision | None = None  #: by which a person settled how many are drawn
    counted: tuple[int, int] = (0, 0)  #: the fewest and the most by linework alone
    placed: Placed = Placed()  #: the rest is compared by count

    @property
    def label(self) -> str:
        """``"window / N"``."""
        return f"{self.feature_class} / {self.facade}" if self.facade else self.feature_class

    @property
    def deciding(self) -> tuple[int, int]:
        """Numbers of drawn features between which a person may decide."""
        return self.delivered, max(self.delivered, self.most, self.pieces)

    @property
    def missing(self) -> int:
        """Required features that are not drawn."""
        absent = len(self.placed.absent) + len(self.placed.unsure)
        return absent + max(0, self.required - self.placed.required - self._others(self.delivered))

    @property
    def missing_least(self) -> int:
        """Required features that are not drawn even if every piece is a feature."""
        most = self._others(max(self.delivered, self.pieces)) - len(self.placed.unsure)
        return len(self.placed.absent) + max(0, self.required - self.placed.required - most)

    @property
    def missing_net(self) -> int:
        """Required features that are not drawn, without those whose omission is accepted with evidence."""
        return max(0, self.missing - self.accepted)

    @property
    def surplus(self) -> int:
        """Drawn features that the list does not allow; of a prohibited class, all."""
        return max(0, self._others(self.delivered) - self._loosely - len(self.placed.unsure))

    @property
    def surplus_most(self) -> int:
        """The same if nothing belongs to what surrounds it."""
        return max(0, self._others(max(self.delivered, self.most)) - self._loosely)

    @property
    def _loosely(self) -> int:
        # Features of the list that are compared by count.
        return self.required + self.optional - self.placed.required - self.placed.optional

    def _others(self, drawn: int) -> int:
        # Drawn features beside those that are there where they are listed.
        return max(0, drawn - self.placed.there)


@dataclass(slots=True)
class _Drawn:
    # Features of one class on one facade, as in ``FeatureCounts``.
    delivered: int = 0
    most: int = 0
    pieces: int = 0
    hidden: set[str] = field(default_factory=set)

    def add(self, other: "_Drawn") -> None:
        self.delivered += other.delivered
        self.most += other.most
        self.pieces += other.pieces
        self.hidden |= other.hidden

    def row(self) -> dict[str, Any]:
        return {
            "delivered": self.delivered, "most": self.most, "pieces": self.pieces, "hidden": tuple(sorted(self.hidden)),
        }  # fmt: skip


def balances(features: FeatureList, counts: FeatureCounts, decisions: Sequence[Decision] = ()) -> tuple[Balance, ...]:
    """Balance of every class and facade, ordered by both.

    Parameters
    ----------
    features : FeatureList
        If all rows of a class state no facade, its drawn features are added over all facades.
    counts : FeatureCounts
        A class and facade that is there with a count of 0 has a layer bound to it.
    decisions : sequence of Decision
        What a person counted stands for the interval where it lies within, and for what nobody sees.

    Names are told apart without regard to case, those of classes without regard to accents and number; the spelling of
    the list is shown.

    Returns
    -------
    tuple of Balance
        A class that is drawn on a facade where the list has none of it is a surplus, as long as the list speaks of both
        the class and the facade, and of no other facade for the class that no drawing shows: "Norte" may be how the
        list calls "N". Else it is ``Incomparable.UNLISTED``.
    """
    spelt = _Spelling((features.feature_class, counts.feature_class), (features.facade, counts.facade))
    features = replace(
        features, feature_class=spelt.classes(features.feature_class), facade=spelt.facades(features.facade)
    )
    drawn = _drawn(counts, spelt)
    listed: dict[str, set[str]] = defaultdict(set)
    for name, facade in zip(features.feature_class, features.facade, strict=True):
        listed[name].add(facade)
    spoken = {facade for facades in listed.values() for facade in facades}
    shown = {facade for facades in drawn.values() for facade in facades}
    made: list[Balance] = []
    for name in sorted({*listed, *drawn}):
        own = listed.get(name, set())
        known = spoken if own <= shown else set()
        made.extend(_of_class(features, name, own, drawn.get(name, {}), known, counts.placements))
    return tuple(_settled(row, decisions) for row in made)


def decision_on(row: Balance, decisions: Sequence[Decision]) -> Decision | None:
    """What a person decided of a class on a facade, if anything."""
    name, facade = of_kind(row.feature_class), folded(row.facade)
    of_row = (one for one in decisions if (of_kind(one.feature_class), folded(one.facade)) == (name, facade))
    return next(of_row, None)


def _settled(row: Balance, decisions: Sequence[Decision]) -> Balance:
    low, high = row.deciding
    row = replace(row, counted=(low, high))
    decision = decision_on(row, decisions)
    if decision is None or row.gap is not Incomparable.NONE or not low <= decision.counted <= high:
        return row
    n = decision.counted
    placed = replace(row.placed, required=row.placed.required - len(row.placed.unsure), unsure=())
    return replace(row, delivered=n, most=n, pieces=n, hidden=(), decision=decision, placed=placed)


class _Spelling:
    """One spelling of every name: the first in order, of the list if it is there."""

    def __init__(self, classes: tuple[Texts, Texts], facades: tuple[Texts, Texts]) -> None:
        self._class, self._facade = _first(*classes, of_kind), _first(*facades, folded)

    def classes(self, names: Texts) -> Texts:
        return _renamed(names, self._class, of_kind)

    def facades(self, names: Texts) -> Texts:
        return _renamed(names, self._facade, folded)


def _first(listed: Texts, drawn: Texts, key: Callable[[str], str]) -> dict[str, str]:
    spelling: dict[str, str] = {}
    for name in (*sorted(set(listed.tolist())), *sorted(set(drawn.tolist()))):
        spelling.setdefault(key(name), name)
    return spelling


def _renamed(names: Texts, spelling: Mapping[str, str], key: Callable[[str], str]) -> Texts:
    renamed: Texts = np.empty(len(names), dtype=object)
    renamed[:] = [spelling.get(key(name), name) for name in names.tolist()]
    return renamed


def _drawn(counts: FeatureCounts, spelt: _Spelling) -> dict[str, dict[str, _Drawn]]:
    drawn: dict[str, dict[str, _Drawn]] = defaultdict(lambda: defaultdict(_Drawn))
    columns = (spelt.classes(counts.feature_class), spelt.facades(counts.facade))
    for name, facade, count, most, pieces in zip(*columns, counts.count, counts.most, counts.pieces, strict=True):
        drawn[name][facade].add(_Drawn(int(count), int(most), int(pieces)))
    told = [np.array([row[part] for row in counts.hidden], dtype=object) for part in range(3)]
    for name, facade, layer in zip(spelt.classes(told[0]), spelt.facades(told[1]), told[2], strict=True):
        if facade in drawn.get(name, {}):
            drawn[name][facade].hidden.add(layer)
    return drawn


def _of_class(
    features: FeatureList, name: str, listed: set[str], drawn: Mapping[str, _Drawn], spoken: set[str],
    places: Placements | None,
) -> list[Balance]:  # fmt: skip
    if not listed:
        rows = [
            Balance(feature_class=name, facade=f, gap=Incomparable.UNLISTED, **n.row())
            for f, n in sorted(drawn.items())
        ]
        return [row for row in rows if row.delivered]
    vague = ("" in listed and len(listed) > 1) or ("" not in listed and "" in drawn and drawn[""].delivered > 0)
    made = []
    for facade in sorted(listed):
        if listed == {""}:
            delivered, gap = _Drawn(), Incomparable.NONE if drawn else Incomparable.UNBOUND
            for one in drawn.values():
                delivered.add(one)
        elif vague:
            delivered, gap = _Drawn(), Incomparable.FACADE
        else:
            delivered, gap = drawn.get(facade, _Drawn()), Incomparable.NONE if facade in drawn else Incomparable.UNBOUND
        made.append(_listed(features, name, facade, delivered, gap, places))
    if not vague and listed != {""}:
        for facade in sorted(set(drawn) - listed):
            gap = Incomparable.NONE if facade in spoken else Incomparable.UNLISTED
            made.append(Balance(feature_class=name, facade=facade, gap=gap, **drawn[facade].row()))
    return [row for row in made if row.facade in listed or row.delivered]


def _listed(
    features: FeatureList, name: str, facade: str, delivered: _Drawn, gap: Incomparable, places: Placements | None
) -> Balance:
    rows = (features.feature_class == name) & (features.facade == facade)
    required = rows & (features.use == "required")
    excused = required & (features.accepted != "")
    proven = excused & (features.evidence != "")
    total = {
        "required": required, "optional": rows & (features.use == "optional"),
        "accepted": proven, "unproven": excused & ~proven,
    }  # fmt: skip
    counted: dict[str, Any] = {
        key: int(features.count[np.asarray(mask, dtype=bool)].sum()) for key, mask in total.items()
    }
    ids = tuple(sorted(features.id[np.asarray(rows, dtype=bool)].tolist()))
    return Balance(
        feature_class=name, facade=facade, gap=gap, ids=ids, placed=_placed(features, rows, places),
        **delivered.row(), **counted,
    )  # fmt: skip


def _placed(features: FeatureList, rows: Flags, places: Placements | None) -> Placed:
    if places is None or places.elsewhere:
        return Placed()
    lies, required, optional = places.lies, features.use == "required", features.use == "optional"
    mine = rows & (lies != Listed.UNPLACED)

    def ids(*states: Listed) -> tuple[str, ...]:
        asked = mine & required & np.isin(lies, states)
        return tuple(sorted(features.id[np.asarray(asked, dtype=bool)].tolist()))

    return Placed(
        required=int(np.count_nonzero(mine & required)), optional=int(np.count_nonzero(mine & optional)),
        there=int(np.count_nonzero(mine & (lies == Listed.THERE))), absent=ids(Listed.ABSENT, Listed.OTHER),
        other=ids(Listed.OTHER), unsure=ids(Listed.UNSURE),
    )  # fmt: skip
