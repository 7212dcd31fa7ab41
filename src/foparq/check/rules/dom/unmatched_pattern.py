# SPDX-License-Identifier: MIT
"""DOM004 unmatched-pattern."""

import numpy as np
import shapely

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import LayerPatterns


@rule("DOM004", "unmatched-pattern", size="items")
def unmatched_pattern(patterns: LayerPatterns) -> Hits:
    """Layer pattern of the manifest that no layer of the drawing matches.

    A pattern of ``classes`` or ``areas`` is at fault if no layer of the file matches it, letters in any case. What it
    was meant for is then not looked at: features of the class are not counted, areas are not compared.

    Parameters
    ----------
    patterns : LayerPatterns, n rows
        Each pattern once.

    Returns
    -------
    Hits
        One a pattern, without a place; the pattern stands as layer; size is 1.

    Notes
    -----
    O(n) after matching. Does not know whether the pattern is misspelt or the layer was not delivered, and does not look
    at layers that no pattern matches: the report lists them.
    """
    row = np.flatnonzero(~patterns.matched)
    return hits(row, np.full(len(row), shapely.Point(), dtype=object), np.ones(len(row)))
