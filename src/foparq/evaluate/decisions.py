# SPDX-License-Identifier: MIT
"""How many features are drawn, where a person decided it: within what the linework allows, and by name."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from foparq.evaluate.balance import Balance, Incomparable, balances, decision_on
from foparq.evaluate.comparable import doubtful
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because, some
from foparq.findings.counts import FeatureCounts, Listed
from foparq.model.statements import Confirmation, Decision
from foparq.names import folded, nearest, of_kind
from foparq.profile.elements import CommissionSpec, OmissionSpec
from foparq.profile.schema import Profile


@dataclass(frozen=True, slots=True)
class WrongDecision:
    """A decision that decides nothing, and why; the sentence is ``decision.KIND`` in the ``errors`` catalogue."""

    kind: str  #: ``element``, ``twice``, ``unknown`` or ``outside``
    fields: Mapping[str, object]


def wrong_decision(profile: Profile, evidence: Evidence) -> WrongDecision | None:
    """The first decision of the manifest that decides nothing, if any.

    It names an element that is none of completeness, a class and facade that another decision names or that list and
    drawings do not share, or a number that the linework rules out.
    """
    decisions, features = evidence.delivery.decisions, evidence.delivery.features
    known = [spec.id for spec in profile.elements if isinstance(spec, OmissionSpec | CommissionSpec)]
    seen: set[tuple[str, str]] = set()
    for one in decisions:
        if one.element not in known:
            return WrongDecision(
                "element", {"value": one.element, "known": ", ".join(nearest(one.element, known)) or "–"}
            )
        key = (of_kind(one.feature_class), folded(one.facade))
        if key in seen:
            return WrongDecision("twice", {"key": _label(one)})
        seen.add(key)
    # Without counts, or with doubtful ones, the elements say what is to be done first.
    if not decisions or features is None or evidence.counts is None or doubtful(evidence, ""):
        return None
    rows = [row for row in balances(features, evidence.counts) if row.gap is Incomparable.NONE]
    for one in decisions:
        row = next((row for row in rows if decision_on(row, [one]) is not None), None)
        if row is None:
            labels = "; ".join(nearest(_label(one), [row.label for row in rows]))
            return WrongDecision("unknown", {"key": _label(one), "known": labels or "–"})
        low, high = row.deciding
        if not low <= one.counted <= high:
            said = {"key": row.label, "value": one.counted, "low": low, "high": high, "example": f"counted = {low}"}
            return WrongDecision("outside", said)
    return None


def decided(rows: Iterable[Balance], name: str) -> tuple[Reason, ...]:
    """What persons decided, as remarks beside an element that rests on it."""
    return tuple(
        because(
            "features.decided", element=name, label=row.label, counted=one.counted, low=row.counted[0],
            high=row.counted[1], by=one.by, when=dated(one), reason=one.reason,
        )
        for row in rows
        if (one := row.decision) is not None
    )  # fmt: skip


def dated(one: Decision | Confirmation) -> Reason | str:
    """The day of a statement, to stand behind a name; nothing where nobody gives one."""
    return because("statement.date", date=one.date) if one.date else ""


def interval(
    message: str, name: str, evidence: Evidence, rows: Sequence[Balance], said: Mapping[str, object]
) -> Reason:
    """Reason that names what was counted, and the one decision that settles it for all elements, to be filled in.

    Parameters
    ----------
    name : str
        Id of the element.
    rows : sequence of Balance
        Classes of which linework alone does not say how many features are drawn.
    said
        Further fields.
    """
    named = [f"{row.label}: {row.counted[0]}–{row.counted[1]}" for row in rows]
    asking = evidence.completeness or (name,)
    readings = tuple(
        because("reading.counts", label=row.label, low=row.counted[0], high=row.counted[1], listed=row.required)
        for row in rows[:10]
    )
    fields = {"classes": some(named), "n": len(named), "readings": readings, "elements": list(asking)}
    return because(message, **fields, ask=_asked(rows[0], asking[-1]), **said)


def placed(rows: Iterable[Balance], name: str) -> tuple[Reason, ...]:
    """What is said of features that were looked for where they are listed, as remarks."""
    absent = [id_ for row in rows for id_ in row.placed.absent]
    return (because("features.absent", element=name, ids=some(absent, 20), n=len(absent)),) if absent else ()


def elsewhere(counts: FeatureCounts, name: str) -> tuple[Reason, ...]:
    """Doubt that places of the list are those of another drawing: too few of them lie on anything."""
    places = counts.placements
    if places is None or not places.elsewhere:
        return ()
    known = places.lies != Listed.UNPLACED
    n = int(np.count_nonzero(np.isin(places.lies, [Listed.THERE, Listed.UNSURE])))
    return (because("features.elsewhere", element=name, n=n, total=int(np.count_nonzero(known))),)


def _asked(row: Balance, element: str) -> str:
    """Decision on a class on a facade, in words of the manifest on one line."""
    facade = f"facade = {quoted(row.facade)}, " if row.facade else ""
    named = f"element = {quoted(element)}, class = {quoted(row.feature_class)}"
    return f"[[decision]] {named}, {facade}counted, by, reason"


def quoted(text: str) -> str:
    """A text as TOML writes it."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _label(one: Decision) -> str:
    return f"{one.feature_class} / {one.facade}" if one.facade else one.feature_class
