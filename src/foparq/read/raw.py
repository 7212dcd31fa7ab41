# SPDX-License-Identifier: MIT
"""What every reader of drawings gives back."""

from dataclasses import dataclass

from foparq.model.drawing import DrawingUnit, Reading
from foparq.model.items import Items


@dataclass(frozen=True, slots=True, kw_only=True)
class RawDrawing:
    """A drawing as read from one file, before the manifest's plane and classes are joined to it."""

    items: Items
    reading: Reading
    unit: DrawingUnit
