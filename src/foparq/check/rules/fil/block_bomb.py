# SPDX-License-Identifier: MIT
"""FIL002 block-bomb."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import Bombs


@rule("FIL002", "block-bomb", size="items", measures=("119", "19"))
def block_bomb(bombs: Bombs) -> Hits:
    """Block that contains itself or expands to more entities than a drawing may hold.

    An insert in model space is at fault if its block, at any depth, inserts itself, or if taking it apart would make
    more entities than the profile's ``limits.entities`` leaves room for. It is not taken apart: nothing of it is
    checked. Where only a block deep inside contains itself, the rest is read.

    Parameters
    ----------
    bombs : Bombs, n rows

    Returns
    -------
    Hits
        One an insert; size is the number of entities it stands for, not a number if it never ends.

    Notes
    -----
    O(n). Blocks are counted, not expanded. Does not report a block that nothing in model space inserts.
    """
    endless = bombs.entities < 0
    return hits(np.arange(len(bombs)), bombs.where, np.where(endless, np.nan, bombs.entities))
