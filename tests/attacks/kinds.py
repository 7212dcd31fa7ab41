# SPDX-License-Identifier: MIT
"""What an attack on a delivery is, and what the audit must answer."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from tests.tools.offices import Office

Change = Callable[[Office, np.random.Generator], Office]

#: drawings in space or flat whose table gives the delivered coordinates, all of corners
TOLD: Mapping[str, Any] = {"told": True, "targets": ""}
BY_ID: Mapping[str, Any] = {**TOLD, "ends_by": "checkpoints"}
#: numbers that nobody takes for thousands: with three digits behind the sign only the drawing says what they are
CLEAR: Mapping[str, Any] = {**TOLD, "digits": 4}
BY_PLACE: Mapping[str, Any] = {**TOLD, "ends_by": "places"}
BY_NAME: Mapping[str, Any] = {**TOLD, "ends_by": "names"}
DXF: Mapping[str, Any] = {**TOLD, "format": "dxf"}


@dataclass(frozen=True, kw_only=True)
class Attack:
    """A change of a sound delivery."""

    name: str
    change: Change
    verdict: str = "undecided"  #: or ``accepted``, ``rejected``
    says: tuple[str, ...] = ()  #: messages one of which must be among the reasons
    office: Mapping[str, Any] = field(default_factory=lambda: TOLD)  #: wishes for the delivery that is attacked
    variants: int = 10


ATTACKS: list[Attack] = []


def attack(name: str, *says: str, **given: Any) -> Callable[[Change], Change]:
    """Enter a change as an attack."""

    def enter(change: Change) -> Change:
        ATTACKS.append(Attack(name=name, change=change, says=says, **given))
        return change

    return enter
