# SPDX-License-Identifier: MIT
"""What people state by name, beside the files: they answer for it, and every report prints it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Confirmation:
    """A statement that witnesses contradict, confirmed by a person."""

    what: str  #: ``unit``, ``plane``, ``scale``, ``checkpoints``, ``distances`` or ``facade``
    value: str  #: what is confirmed: ``"mm"``; of ``checkpoints`` and ``distances``: ``"not drawn"``
    by: str
    reason: str
    path: str = ""  #: file it speaks of; ``""``: every file that states the value
    date: str = ""  #: ISO 8601 day on which it was stated; ``""`` if nobody says


@dataclass(frozen=True, slots=True, kw_only=True)
class Contract:
    """Under which contract a delivery was made, as its manifest states it; ``""`` where it states nothing."""

    process: str = ""  #: number of the administrative process
    contract: str = ""  #: number of the contract
    contractor: str = ""  #: who delivers
    responsible: str = ""  #: person who answers for the delivery, with registration
    revision: str = ""
    date: str = ""  #: of delivery, ISO 8601


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """How many features of a class are drawn, decided by a person where linework cannot tell."""

    element: str  #: for which it was asked: ``"Q5"``
    feature_class: str
    facade: str  #: ``""``: of a list that names none
    counted: int
    by: str
    reason: str
    date: str = ""  #: ISO 8601 day of the decision; ``""`` if nobody says
