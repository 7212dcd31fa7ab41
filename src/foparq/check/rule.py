# SPDX-License-Identifier: MIT
"""The record of a rule and the decorator that makes one.

A rule is a pure function over columns. Its signature is its declaration: positional parameters are inputs, by type;
keyword-only parameters are tolerances, by unit; it returns what is at fault, or differences that it measured.
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from foparq.errors import RuleError
from foparq.findings.hits import Deviations, Hits
from foparq.units import Unit

Check = Callable[..., Hits | Deviations]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A check that foparq can run."""

    code: str  #: ``"TOP021"``, never reused
    name: str  #: ``"undershoot"``: names the fault, reads after "allow ..."
    check: Check
    inputs: tuple[tuple[str, type], ...]  #: name and type, one of ``model.inputs``; hits are told by rows of the first
    tolerances: tuple[tuple[str, str], ...]  #: name and SI unit, in order of the signature
    size_unit: str  #: SI unit of ``Hits.size``: ``"m"``, ``"m2"``, ``"items"``, ``"1"``
    limit: str  #: the tolerance shown beside a finding: what it exceeds, or should have reached; ``""`` if none
    measures: tuple[str, ...]  #: ISO 19157 measure ids this rule can feed
    requires: tuple[str, ...]  #: codes; an item on which one of them found a fault is set aside
    preview: bool  #: reported as a note, cannot reject
    repeats: bool  #: what it finds at fault repeats another item: dependants do not see it
    once: str  #: tolerance within which linework that several layers draw alike is seen once; ``""``: all is seen

    @property
    def subject(self) -> type:
        """Type of the first input."""
        return self.inputs[0][1]

    @property
    def metric(self) -> bool:
        """Whether a tolerance is a length or an area: it means nothing where the unit is unknown."""
        return any(unit in {"m", "m2"} for _, unit in self.tolerances)

    @property
    def fault(self) -> str:
        """The fault in one line: first line of the docstring."""
        return inspect.cleandoc(self.check.__doc__ or "").split("\n", 1)[0]

    @property
    def manual(self) -> str:
        """The docstring: what ``foparq explain`` prints."""
        return inspect.cleandoc(self.check.__doc__ or "")


def rule(
    code: str,
    name: str,
    *,
    size: str = "m",
    limit: str = "",
    measures: tuple[str, ...] = (),
    requires: tuple[str, ...] = (),
    preview: bool = False,
    repeats: bool = False,
    once: str = "",
) -> Callable[[Check], Check]:
    """Declare a function as a rule.

    Parameters
    ----------
    code, name : str
        Three letters and three digits; kebab-case name of the fault.
    size : str
        SI unit of the magnitude of a hit.
    limit : str
        Name of the tolerance that a finding is judged by.
    measures : tuple of str
        ISO 19157 measure ids.
    requires : tuple of str
        Codes of rules whose faulty items this rule does not judge. They stay in its input as neighbours of others.
    preview : bool
        True until the rule was compared over a corpus.
    repeats : bool
        True if a faulty item of this rule only repeats another: rules that require this one do not see it at all.
    once : str
        Name of a tolerance. What only repeats, within it, what another layer draws is not seen: no end meets its own
        copy, whatever layer that is on.

    Returns
    -------
    decorator
        Leaves the function as it is and attaches the record as ``function.rule``.

    Raises
    ------
    RuleError
        If the signature is not inputs followed by keyword-only tolerances without defaults.
    """

    def declare(check: Check) -> Check:
        inputs, tolerances = _read_signature(check, code)
        for used in filter(None, (limit, once)):
            if used not in dict(tolerances):
                raise RuleError("rule.limit", code=code, limit=used)
        record = Rule(
            code=code, name=name, check=check, inputs=inputs, tolerances=tolerances, size_unit=size, limit=limit,
            measures=measures, requires=requires, preview=preview, repeats=repeats, once=once,
        )  # fmt: skip
        check.rule = record  # type: ignore[attr-defined]
        return check

    return declare


Inputs = tuple[tuple[str, type], ...]
Tolerances = tuple[tuple[str, str], ...]


def _read_signature(check: Check, code: str) -> tuple[Inputs, Tolerances]:
    hints: dict[str, Any] = get_type_hints(check, include_extras=True)
    inputs: list[tuple[str, type]] = []
    tolerances: list[tuple[str, str]] = []
    for parameter in inspect.signature(check).parameters.values():
        hint = hints.get(parameter.name)
        if parameter.kind is not inspect.Parameter.KEYWORD_ONLY:
            if not isinstance(hint, type):
                raise RuleError("rule.signature", code=code, parameter=check.__name__)
            inputs.append((parameter.name, hint))
        elif parameter.default is not inspect.Parameter.empty:
            raise RuleError("rule.default", code=code, parameter=parameter.name)
        elif get_origin(hint) is Annotated and isinstance(unit := get_args(hint)[1], Unit):
            tolerances.append((parameter.name, unit.symbol))
        else:
            raise RuleError("rule.no-unit", code=code, parameter=parameter.name)
    if not inputs or hints.get("return") not in (Hits, Deviations):
        raise RuleError("rule.signature", code=code, parameter=check.__name__)
    return tuple(inputs), tuple(tolerances)
