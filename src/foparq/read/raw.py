# SPDX-License-Identifier: MIT
"""What every reader of drawings gives back."""

from dataclasses import dataclass

import numpy as np

from foparq.model.drawing import DrawingUnit, Reading
from foparq.model.items import Items, Role

_DRAWN = [role.value for role in Role if role is not Role.ANNOTATION]


@dataclass(frozen=True, slots=True, kw_only=True)
class RawDrawing:
    """A drawing as read from one file, before the manifest's plane and classes are joined to it."""

    items: Items
    reading: Reading
    unit: DrawingUnit


def holds_drawing(items: Items) -> bool:
    """Whether model space shows more than lettering."""
    return bool(np.any(np.isin(items.role, _DRAWN) & ~items.paper))
