# SPDX-License-Identifier: MIT
"""FIL001 needs-recovery."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import Repairs


@rule("FIL001", "needs-recovery", size="items", measures=("119", "19"))
def needs_recovery(repairs: Repairs) -> Hits:
    """File that can be read only after mending it in memory.

    A file is at fault once for each thing that had to be mended, added or left out before its content made sense. The
    delivered bytes stay as they are; what was checked is the mended reading, which may hold less than was drawn.

    Parameters
    ----------
    repairs : Repairs, n rows

    Returns
    -------
    Hits
        One a repair, without a place; size is 1.

    Notes
    -----
    O(n). Does not tell whether another program would read the file otherwise, and not what the damage took away. A file
    that cannot be mended, or that ends in the middle of its content, is refused before any rule runs.
    """
    n = len(repairs)
    return hits(np.arange(n), np.full(n, shapely.Point(), dtype=object), np.ones(n))
