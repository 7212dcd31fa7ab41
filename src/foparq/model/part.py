# SPDX-License-Identifier: MIT
"""A part of a delivery: what rules are run on."""

from abc import ABC, abstractmethod
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Part(ABC):
    """One delivered thing: a drawing, a mesh, a block of cameras. Its kind is its type."""

    path: str  #: relative to the delivery, with ``/``

    @property
    @abstractmethod
    def features(self) -> int:
        """Items that rules may find at fault: no rate has a larger denominator."""

    @property
    @abstractmethod
    def vertices(self) -> int:
        """Size of the part, for bounds of time."""
