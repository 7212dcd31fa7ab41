# SPDX-License-Identifier: MIT
"""How many features of each class were delivered."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True)
class FeatureCounts:
    """Delivered features by class and facade, n rows ordered by both."""

    feature_class: NDArray[np.object_]  #: (n,) ``"window"``
    facade: NDArray[np.object_]  #: (n,) ``"N"``; ``""`` if the drawing names none
    count: NDArray[np.intp]  #: (n,)
    unmapped: tuple[tuple[str, int], ...] = ()  #: layers that no class is bound to, with their items: not assessed
