# SPDX-License-Identifier: MIT
"""A part of a delivery: what rules are run on."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from foparq.columns import Index


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

    @property
    def held(self) -> int:
        """Bytes of its columns, where these may be many: rules may use some times as much beyond their bound."""
        return 0

    @property
    def rows(self) -> Index:
        """Rows of the features in their table."""
        return np.arange(self.features)

    def extent(self, rows: Index) -> float | None:  # noqa: ARG002 - kinds of parts that know sizes use it
        """Size of some of its features together, in SI units; ``None`` if the kind has none."""
        return None
