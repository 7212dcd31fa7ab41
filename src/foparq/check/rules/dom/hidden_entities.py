# SPDX-License-Identifier: MIT
"""DOM002 hidden-entities."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import HiddenItems


@rule("DOM002", "hidden-entities", size="items", measures=("16",))
def hidden_entities(hidden: HiddenItems) -> Hits:
    """Layer with entities that nobody sees.

    A layer is at fault if model space holds at least one entity on it that is hidden: the layer is off or frozen, the
    entity is marked invisible, or it belongs to a block whose insert is invisible or lies on a frozen layer. Content of
    a block on layer 0 counts on the layer of the insert.

    Parameters
    ----------
    hidden : HiddenItems, n rows
        One a layer.

    Returns
    -------
    Hits
        One a layer: place is the box around its hidden entities, size their number.

    Notes
    -----
    O(n). Does not report empty layers, layers that are only locked or not plotted, layers frozen in a single viewport,
    and paper space. Whether hidden entities are checked otherwise is decided by the profile.
    """
    row = np.flatnonzero(hidden.count > 0)
    return hits(row, hidden.where[row], hidden.count[row])
