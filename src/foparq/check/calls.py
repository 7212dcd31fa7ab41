# SPDX-License-Identifier: MIT
"""Calls of rules: which rule, on which layers, with which tolerances, and what it may not judge."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from foparq.check.rule import Rule
from foparq.check.subject import Patterns, Subject
from foparq.columns import Flags, Index, union
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, SetAside, Status
from foparq.model.inputs import Named
from foparq.profile.schema import CheckSpec
from foparq.units import Quantity

_NAMED = 20  #: items set aside that are named; all are counted


@dataclass(frozen=True, slots=True)
class Call:
    """One rule on one scope of one part."""

    rule: Rule
    spec: CheckSpec
    layers: tuple[Patterns, ...]  #: of each input
    scale: float | None
    common: Mapping[str, Quantity] = field(default_factory=dict)  #: tolerances that the check does not state itself

    @property
    def tolerances(self) -> dict[str, float]:
        """Tolerances in SI units, by name."""
        stated = {**self.common, **self.spec.tolerances}
        return {name: stated[name].si(self.scale) for name, _ in self.rule.tolerances}

    @property
    def parameters(self) -> tuple[tuple[str, float, str], ...]:
        """Tolerances with their units, as outcomes tell them."""
        values = self.tolerances
        return tuple((name, values[name], unit) for name, unit in self.rule.tolerances)

    def scope(self, source: str) -> str:
        """``"fachada.dxf: PAREDE*"``; of several inputs ``"fachada.dxf: lines PAREDE*; reference EIXO*"``."""
        texts = [", ".join(patterns) for patterns in self.layers]
        if len(set(texts)) > 1:
            texts = [f"{name} {text}" for (name, _), text in zip(self.rule.inputs, texts, strict=True)]
            return f"{source}: {'; '.join(texts)}"
        return f"{source}: {texts[0]}"


def calls_of(
    rule: Rule, spec: CheckSpec, scale: float | None, subject: Subject, common: Mapping[str, Quantity]
) -> list[Call]:
    """Calls of one check of the profile on one part: one, or one a layer if the profile wants layers apart."""
    if spec.apart:
        alone = [
            Call(rule, spec, (layer,) * len(rule.inputs), scale, common)
            for layer in subject.alone(rule.subject, spec.layers)
        ]
        if alone:
            return alone
    return [Call(rule, spec, tuple(spec.on.get(name, spec.layers) for name, _ in rule.inputs), scale, common)]


@dataclass(frozen=True, slots=True)
class Missing:
    """Why a rule cannot rely on what it requires."""

    because: Because
    names: tuple[str, ...]  #: of the required rules


def missing(call: Call, rules: Mapping[str, Rule], outcomes: Sequence[Outcome], subject: Subject) -> Missing | None:
    """Whether every required rule looked at the items of a call.

    Parameters
    ----------
    rules : mapping of code to Rule
    outcomes : sequence of Outcome
        Of the rules that ran on this part so far.

    Returns
    -------
    Missing or None
        The gravest reason: crashed, not run, not bound. A rule that had nothing to look at is no lack.
    """
    lacks: dict[Because, list[str]] = {}
    for code in call.rule.requires:
        found = [outcome for outcome in outcomes if outcome.rule == code]
        if any(outcome.status is Status.CRASHED for outcome in found):
            lacks.setdefault(Because.REQUIRED_CRASHED, []).append(rules[code].name)
        elif any(outcome.because.opens for outcome in found):
            lacks.setdefault(Because.REQUIRED_NOT_RUN, []).append(rules[code].name)
        elif not found or not _covered(call, found, subject):
            lacks.setdefault(Because.REQUIRED_UNBOUND, []).append(rules[code].name)
    for because in (Because.REQUIRED_CRASHED, Because.REQUIRED_NOT_RUN, Because.REQUIRED_UNBOUND):
        if because in lacks:
            return Missing(because, tuple(lacks[because]))
    return None


def _covered(call: Call, found: Sequence[Outcome], subject: Subject) -> bool:
    """Whether the layers of a required rule hold every item of the call."""
    bound = {pattern for outcome in found for pattern in outcome.layers}
    if "*" in bound:
        return True
    seen = subject.take(call.rule.subject, tuple(sorted(bound))).rows.row
    return all(
        bool(np.isin(subject.take(kind, layers).rows.row, seen).all())
        for (_, kind), layers in zip(call.rule.inputs, call.layers, strict=True)
    )


@dataclass(frozen=True, slots=True)
class Judged:
    """Inputs of a call, and what of them is not judged."""

    inputs: tuple[Named, ...]
    aside: tuple[Flags, ...]  #: for each input: rows that stay as neighbours of others and are not judged
    unjudged: Index  #: rows of the part's items that are of the kind and not judged, distinct
    again: Index  #: rows of the part's items that only repeat what others draw, distinct
    named: tuple[SetAside, ...]


def judged(call: Call, rules: Mapping[str, Rule], outcomes: Sequence[Outcome], subject: Subject) -> Judged:
    """Inputs of a call: without repetitions, with what required rules found at fault set aside from judgement."""
    blamed = {code: _faulty(outcomes, code) for code in call.rule.requires}
    repeated = union(*(rows for code, rows in blamed.items() if rules[code].repeats))
    again = repeated[:0]
    if call.rule.once:
        within = call.tolerances[call.rule.once]
        again = subject.drawn_again(call.rule.subject, call.layers[0], repeated, within)
    at_fault = union(*(rows for code, rows in blamed.items() if not rules[code].repeats))
    inputs: list[Named] = []
    aside: list[Flags] = []
    for (_, kind), layers in zip(call.rule.inputs, call.layers, strict=True):
        rows = subject.without(kind, layers, union(repeated, again))
        inputs.append(rows)
        aside.append(np.isin(rows.row, at_fault))
    first = subject.take(call.rule.subject, call.layers[0])
    unfit = first.unfit
    blamed_here = union(*blamed.values())
    blamed_here = blamed_here[np.isin(blamed_here, first.rows.row)]
    unjudged = union(unfit, blamed_here)
    named = _named(subject, unfit, blamed, blamed_here, _telling(call, rules, outcomes))
    return Judged(tuple(inputs), tuple(aside), unjudged, again, named)


def _faulty(outcomes: Sequence[Outcome], code: str) -> Index:
    return union(*(outcome.faulty for outcome in outcomes if outcome.rule == code))


def _telling(call: Call, rules: Mapping[str, Rule], outcomes: Sequence[Outcome]) -> dict[str, tuple[str, bool]]:
    """Name of every required rule, and whether it tells what it finds at fault, or what that repeats is judged."""
    silent = {outcome.rule for outcome in outcomes if not outcome.counts}
    return {code: (rules[code].name, rules[code].repeats or code not in silent) for code in call.rule.requires}


def _named(
    subject: Subject, unfit: Index, blamed: Mapping[str, Index], here: Index, rules: Mapping[str, tuple[str, bool]]
) -> tuple[SetAside, ...]:
    """The first items that are not judged; those of which nothing else tells come first."""
    why: dict[int, tuple[str, bool]] = {}
    # The first rule that tells of an item names it, else the first that does not.
    for code in sorted(blamed, key=lambda code: not rules[code][1]):
        for row in blamed[code].tolist():
            why.setdefault(row, rules[code])
    rows = [*unfit.tolist(), *np.setdiff1d(here, unfit, assume_unique=True).tolist()]
    nobody = ("", False)
    rows = sorted(rows, key=lambda row: why.get(row, nobody)[1])[:_NAMED]
    items, layers = subject.named(np.array(rows, dtype=np.intp))
    return tuple(
        SetAside(item=str(item), layer=str(layer), rule=why.get(row, nobody)[0], told=why.get(row, nobody)[1])
        for row, item, layer in zip(rows, items, layers, strict=True)
    )
