# SPDX-License-Identifier: MIT
"""DOM003 doubly-encoded-name."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import LayerNames


@rule("DOM003", "doubly-encoded-name", size="items", measures=("16",))
def doubly_encoded_name(names: LayerNames) -> Hits:
    """Layer whose name was encoded twice, so that accents read as pairs of strange letters, or in another encoding.

    A name is at fault if its letters, taken as bytes of the Windows code page or of the one that the file states, are a
    longer UTF-8 text read wrongly: ``Ã©ven`` for ``éven``; or if it holds bytes that mean nothing in the encoding that
    the file states, shown as U+FFFD. Such a name matches no pattern of the manifest that is written rightly.

    Parameters
    ----------
    names : LayerNames, n rows
        Every layer of the file, once.

    Returns
    -------
    Hits
        One a layer, without a place; size is the number of items on it.

    Notes
    -----
    O(n). Does not look at texts inside the drawing, and does not know names that were encoded wrongly in another way.
    """
    row = np.flatnonzero(names.doubly_encoded)
    return hits(row, np.full(len(row), shapely.Point(), dtype=object), names.count[row])
