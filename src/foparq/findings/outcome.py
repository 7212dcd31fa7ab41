# SPDX-License-Identifier: MIT
"""What one rule found on one scope."""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from foparq.columns import Index
from foparq.findings.because import Because
from foparq.findings.hits import Deviations


class Status(StrEnum):
    """How the run of one rule on one scope ended."""

    CLEAN = "clean"
    FAULTY = "faulty"
    NOT_RUN = "not-run"  #: nothing to look at, or a requirement failed
    CRASHED = "crashed"  #: our fault, never the delivery's


@dataclass(frozen=True, slots=True, kw_only=True)
class SetAside:
    """One item that a rule did not judge. It stays in the drawing: others may meet it."""

    item: str
    layer: str
    rule: str  #: name of the required rule that found it at fault; ``""``: the rule cannot work with it
    told: bool = True  #: that rule tells it as a fault, or what it repeats is judged: nothing hides behind it

    @property
    def open(self) -> bool:
        """Whether a fault of it may hide that no rule told."""
        return not (self.rule and self.told)


def _nothing() -> Index:
    return np.empty(0, dtype=np.intp)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What one bound rule found on one scope."""

    rule: str  #: code, ``"TOP021"``
    name: str  #: ``"undershoot"``
    scope: str  #: ``"fachada.dxf: PAREDE*, PORTA*"``
    layers: tuple[str, ...] = ("*",)  #: patterns of all inputs
    source: str  #: path of the part
    status: Status
    checked: int  #: items judged: the denominator of every rate
    found: int  #: hits
    #: name of a second reading of the part, and hits in it, which decide nothing; ``None``: it has none
    otherwise: tuple[str, int] | None = None
    faulty: Index  #: rows of the part's items at fault, distinct
    total: float = 0.0  #: sum of the sizes of all hits, in the rule's unit
    unjudged: Index = field(default_factory=_nothing)  #: rows of the part's items that were set aside, distinct
    small: Index = field(default_factory=_nothing)  #: rows of the part's items it concerns, too small to be seen
    again: Index = field(default_factory=_nothing)  #: rows of the part's items that only repeat others: judged once
    aside: tuple[SetAside, ...] = ()  #: the first of them, those that the rule cannot work with before others
    because: Because = Because.RAN
    names: tuple[str, ...] = ()  #: what ``because`` speaks of: required rules
    undeclared: tuple[
        str, ...
    ] = ()  #: patterns of layers that look like what the rule looks at and are not declared so
    parameters: tuple[tuple[str, float, str], ...] = ()  #: name, value, SI unit
    seconds: float = 0.0  #: of the processor
    about_file: bool = False  #: the rule looks at statements of the file, not at items
    preview: bool = False  #: reported, cannot reject
    counts: bool = True  #: what it finds is told as a fault: it is no helper, no note, and not in preview
    helper: bool = False  #: runs only because chosen rules require it: nothing of it is told
    deviations: Deviations | None = None  #: of a rule that measures

    @property
    def skipped(self) -> int:
        """Items that were not judged."""
        return len(self.unjudged)

    @property
    def opens(self) -> bool:
        """Whether faults may hide here that no rule told."""
        return self.status is Status.CRASHED or self.because.opens or any(one.open for one in self.aside)
