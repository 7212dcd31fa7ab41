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


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """How many features of a class are drawn, decided by a person where linework cannot tell."""

    element: str  #: for which it was asked: ``"Q5"``
    feature_class: str
    facade: str  #: ``""``: of a list that names none
    counted: int
    by: str
    reason: str
