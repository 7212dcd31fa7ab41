# SPDX-License-Identifier: MIT
"""What one rule found on one scope."""

from dataclasses import dataclass
from enum import StrEnum

from foparq.columns import Index


class Status(StrEnum):
    """How the run of one rule on one scope ended."""

    CLEAN = "clean"
    FAULTY = "faulty"
    NOT_RUN = "not-run"  #: nothing to look at, or a requirement failed
    CRASHED = "crashed"  #: our fault, never the delivery's


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What one bound rule found on one scope."""

    rule: str  #: code, ``"TOP021"``
    name: str  #: ``"undershoot"``
    scope: str  #: ``"fachada.dxf: PAREDE*, PORTA*"``
    source: str  #: path of the drawing
    status: Status
    checked: int  #: items looked at: the denominator of every rate
    found: int  #: hits
    faulty: Index  #: rows of the drawing's items at fault, distinct
    skipped: int = 0  #: items set aside because a required rule failed on them
    because: str = ""  #: id in the ``report`` catalogue under ``because.``
    parameters: tuple[tuple[str, float, str], ...] = ()  #: name, value, SI unit
    seconds: float = 0.0
    preview: bool = False  #: reported, cannot reject
