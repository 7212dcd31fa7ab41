# SPDX-License-Identifier: MIT
"""What columns hold: array types by the kind of their values.

The shape stands where a column is declared: ``(n,)``, ``(n, 3)``.
"""

import numpy as np
from numpy.typing import NDArray

Coordinates = NDArray[np.float64]  #: (n, 2) or (n, 3): places, one a row
Flags = NDArray[np.bool_]
Geometries = NDArray[np.object_]  #: shapely geometries; ``None`` where there is none
Index = NDArray[np.intp]  #: row numbers and counts
Integers = NDArray[np.int32]
Reals = NDArray[np.float64]
Texts = NDArray[np.object_]  #: str
