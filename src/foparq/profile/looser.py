# SPDX-License-Identifier: MIT
"""Where one profile lets more pass than another.

A setting is *looser* than another if something passes under it that does not pass under the other: a fault is not
found, weighs less or is not counted, something is not required, a doubt is not raised, or less is shown. Of a number
whose change can do so either way, depending on what is drawn, every difference is looser. A demand so high that it
leaves undecided what the other rejects is not: nothing passes by it.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

from foparq.findings.table import Severity
from foparq.names import folded
from foparq.profile.elements import ElementSpec
from foparq.profile.quantities import LooserWhen
from foparq.profile.schema import CheckSpec, Profile
from foparq.units import Quantity, parse_scale

_LARGER, _SMALLER, _DIFFERENT = LooserWhen.LARGER, LooserWhen.SMALLER, LooserWhen.DIFFERENT

#: of tolerances, by rule and name: which change finds less. Others, such as those of rules that are new, find less in
#: some drawing whichever way they change: a wider ``coincide`` of ``line-overlap`` takes more for the same place, and
#: overlooks the shorter stretches.
TOLERANCES = {
    ("area-overlap", "least"): _LARGER,
    ("duplicate", "coincide"): _SMALLER,
    ("free-end", "coincide"): _LARGER,
    ("free-end", "reach"): _LARGER,
    ("gap", "coincide"): _LARGER,
    ("gap", "most"): _SMALLER,
    ("open-ring", "coincide"): _LARGER,
    ("open-ring", "reach"): _SMALLER,
    ("overshoot", "coincide"): _LARGER,
    ("overshoot", "reach"): _SMALLER,
    ("repeated-vertex", "coincide"): _SMALLER,
    ("undershoot", "coincide"): _LARGER,
    ("undershoot", "reach"): _SMALLER,
    ("unit-contradiction", "agree"): _LARGER,
    ("zero-length", "coincide"): _SMALLER,
}
#: of ``[evidence]``: which change ties more to a drawing, or lets more of it count
_EVIDENCE = {
    "tie": _LARGER, "apart": _SMALLER, "search": _LARGER, "visible": _SMALLER, "finest": _DIFFERENT,
    "coarsest": _DIFFERENT,
}  # fmt: skip
#: of ``[linework]``: which change finds less
_LINEWORK = {
    "ahead": _SMALLER, "alongside": _LARGER, "remainder": _LARGER, "heading": _SMALLER, "symbol": _LARGER,
    "symbol_times": _SMALLER,
}  # fmt: skip
_PATTERNS = 10  #: layer patterns that are named
_WEIGHT = {severity: weight for weight, severity in enumerate(reversed(Severity))}


class Point(StrEnum):
    """Kinds of points in which a profile may be looser."""

    ELEMENT_MISSING = "element-missing"
    NOT_REQUIRED = "not-required"
    KIND = "kind"  #: of an element
    NOT_COUNTED = "not-counted"  #: rules that an element leaves out
    LIMIT = "limit"
    REFERENCE_SHARE = "reference-share"
    CONFIDENCE = "confidence"
    FEWEST = "fewest"
    RULE_MISSING = "rule-missing"
    LAYERS = "layers"  #: that a rule is bound to
    SEVERITY = "severity"
    APART = "apart"  #: a rule looks at every layer by itself
    TOGETHER = "together"  #: a rule looks at all layers together
    VALUE = "value"  #: tolerances and other keys
    SCALE = "scale"


#: keys of elements that have a sentence of their own
_TOLD = {
    "limit": Point.LIMIT, "reference_share": Point.REFERENCE_SHARE, "confidence": Point.CONFIDENCE,
    "fewest": Point.FEWEST,
}  # fmt: skip

#: a quantity in SI units (number, symbol), a whole number, a word of the profile, or words
Value = tuple[float, str] | int | str | tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Looser:
    """One point in which a profile lets more pass than another."""

    point: Point
    subject: str = ""  #: what it is about: ``"Q1"``, ``"undershoot.reach"``
    own: Value = ""
    other: Value = ""


def looser(own: Profile, other: Profile, scale: float) -> tuple[Looser, ...]:
    """Points in which one profile lets more pass than another.

    Parameters
    ----------
    own, other : Profile
    scale : float
        Denominator k of the drawing scale 1:k at which quantities are compared.

    Returns
    -------
    tuple of Looser
        First elements, then rules, then how drawings are read; each in the order of the other profile. Empty if the
        profile is nowhere looser.
    """
    return (
        *_in_elements(own, other, scale),
        *_in_checks(own, other, scale),
        *_in_reading(own, other, scale),
    )


# --- elements --------------------------------------------------------------------------------------------------------


def _in_elements(own: Profile, other: Profile, scale: float) -> Iterator[Looser]:
    mine = {spec.id: spec for spec in own.elements}
    asked = [spec for spec in other.elements if spec.required and spec.applicable]
    missing = tuple(spec.id for spec in asked if spec.id not in mine)
    waived = tuple(
        spec.id for spec in asked if spec.id in mine and not (mine[spec.id].required and mine[spec.id].applicable)
    )
    if missing:
        yield Looser(point=Point.ELEMENT_MISSING, own=missing)
    if waived:
        yield Looser(point=Point.NOT_REQUIRED, own=waived)
    for spec in asked:
        if spec.id in mine and spec.id not in waived:
            yield from _in_element(mine[spec.id], spec, scale)


def _in_element(own: ElementSpec, other: ElementSpec, scale: float) -> Iterator[Looser]:
    if own.kind != other.kind:
        yield Looser(point=Point.KIND, subject=other.id, own=own.kind, other=other.kind)
        return
    for key in type(other).model_fields:
        if key in ElementSpec.model_fields:
            continue
        mine, theirs = getattr(own, key), getattr(other, key)
        if isinstance(theirs, tuple):
            if left := tuple(name for name in theirs if name not in mine):
                yield Looser(point=Point.NOT_COUNTED, subject=other.id, own=left)
        elif _lets_more(mine, theirs, other.LOOSER.get(key, _DIFFERENT), scale, other.ABSENT.get(key, math.nan)):
            point, subject = (_TOLD[key], other.id) if key in _TOLD else (Point.VALUE, f"{other.id}.{key}")
            yield Looser(point=point, subject=subject, own=_value(mine, scale), other=_value(theirs, scale))


# --- rules -----------------------------------------------------------------------------------------------------------


def _in_checks(own: Profile, other: Profile, scale: float) -> Iterator[Looser]:
    bound = {spec.rule for spec in own.checks}
    missing = tuple(dict.fromkeys(spec.rule for spec in other.checks if spec.rule not in bound))
    if missing:
        yield Looser(point=Point.RULE_MISSING, own=missing)
    for spec in other.checks:
        if spec.rule in bound:
            # A rule may be bound several times: one binding that is as strict suffices.
            candidates = [tuple(_in_check(one, spec, scale)) for one in own.checks if one.rule == spec.rule]
            yield from min(candidates, key=len)


def _in_check(own: CheckSpec, other: CheckSpec, scale: float) -> Iterator[Looser]:
    if not _covers(own.layers, other.layers) or own.on != other.on:
        yield Looser(point=Point.LAYERS, subject=other.rule, own=_layers(own), other=_layers(other))
    if _WEIGHT[own.severity] < _WEIGHT[other.severity]:
        yield Looser(point=Point.SEVERITY, subject=other.rule, own=own.severity.value, other=other.severity.value)
    if own.apart != other.apart:
        yield Looser(point=Point.APART if own.apart else Point.TOGETHER, subject=other.rule)
    for name, theirs in other.tolerances.items():
        mine = own.tolerances.get(name)
        if _lets_more(mine, theirs, TOLERANCES.get((other.rule, name), _DIFFERENT), scale):
            subject = f"{other.rule}.{name}"
            yield Looser(point=Point.VALUE, subject=subject, own=_value(mine, scale), other=_value(theirs, scale))


def _covers(own: Sequence[str], other: Sequence[str]) -> bool:
    mine = {folded(pattern) for pattern in own}
    return "*" in mine or {folded(pattern) for pattern in other} <= mine


def _layers(spec: CheckSpec) -> tuple[str, ...]:
    patterns = [*spec.layers, *(f"{name}: {pattern}" for name, several in spec.on.items() for pattern in several)]
    return (*patterns[:_PATTERNS], *([f"+{len(patterns) - _PATTERNS}"] if len(patterns) > _PATTERNS else [])) or ("–",)


# --- how drawings are read -------------------------------------------------------------------------------------------


def _in_reading(own: Profile, other: Profile, scale: float) -> Iterator[Looser]:
    rows: list[tuple[str, object, object, LooserWhen]] = [
        ("reading.sagitta", own.reading.sagitta, other.reading.sagitta, _LARGER),
        # What is hidden and sound thins out the rate of faults.
        ("reading.hidden", own.reading.hidden, other.reading.hidden, _DIFFERENT),
        # Strokes that nobody sees thin it out as well; if nothing is large enough, nothing passes.
        ("reading.visible", own.reading.visible, other.reading.visible, _SMALLER),
        ("limits.written", own.limits.written, other.limits.written, _SMALLER),
    ]
    if own.mesh.weld == "none":
        # By their numbers two shells at one place have nothing in common.
        rows.append(("mesh.weld", own.mesh.weld, other.mesh.weld, _DIFFERENT))
    if own.reading.blocks == "skip":
        rows.append(("reading.blocks", own.reading.blocks, other.reading.blocks, _DIFFERENT))
    if own.completeness and other.completeness:
        # A wider gap hides a surplus, a narrower one an omission. Without any, nothing is counted and nothing passes.
        rows.append(("completeness.gap", own.completeness.gap, other.completeness.gap, _DIFFERENT))
    if own.evidence and other.evidence:
        # Without any, no table is tied to a drawing and nothing passes.
        for name, when in _EVIDENCE.items():
            rows.append((f"evidence.{name}", getattr(own.evidence, name), getattr(other.evidence, name), when))
    for name, when in _LINEWORK.items():
        rows.append((f"linework.{name}", getattr(own.linework, name), getattr(other.linework, name), when))
    for subject, mine, theirs, when in rows:
        if _lets_more(mine, theirs, when, scale):
            yield Looser(point=Point.VALUE, subject=subject, own=_value(mine, scale), other=_value(theirs, scale))
    if own.scale is not None and own.scale != other.scale and parse_scale(own.scale) == scale:
        yield Looser(point=Point.SCALE, own=own.scale)


# --- values ----------------------------------------------------------------------------------------------------------


def _lets_more(own: object, other: object, when: LooserWhen, scale: float, absent: float = math.nan) -> bool:
    """Whether one value lets more pass than another; of numbers that cannot be compared, whether they differ."""
    if own == other:
        return False
    if isinstance(own, Quantity) and isinstance(other, Quantity) and own.symbol != other.symbol:
        return True
    mine, theirs = _number(own, scale, absent), _number(other, scale, absent)
    if mine == theirs:
        return False
    if math.isnan(mine) or math.isnan(theirs) or when is _DIFFERENT:
        return True
    return mine > theirs if when is _LARGER else mine < theirs


def _number(value: object, scale: float, absent: float) -> float:
    if isinstance(value, Quantity):
        return value.si(scale)
    return float(value) if isinstance(value, int | float) else absent if value is None else math.nan


def _value(value: object, scale: float) -> Value:
    if isinstance(value, Quantity):
        return value.si(scale), value.symbol
    if isinstance(value, float):
        return value, "1"
    return value if isinstance(value, int) else "–" if value is None else str(value)
