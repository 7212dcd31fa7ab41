# SPDX-License-Identifier: MIT
"""DOM001 unit-contradiction."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.inputs import UnitEvidence
from foparq.units import Ratio


@rule("DOM001", "unit-contradiction", measures=("16",))
def unit_contradiction(evidence: UnitEvidence, *, agree: Ratio) -> Hits:
    """Statement in the drawing that contradicts the unit in use.

    The unit in use is the one that the user states, else the one of the file's header. A statement contradicts it if
    abs(says / used - 1) > max(agree, weight), with the metres in one drawing unit by the statement and as used, and the
    relative difference that the statement cannot tell apart. Statements are the header, the lettering of dimensions
    against their measured length, the scale of the projection, and an extent that no building has.

    Parameters
    ----------
    evidence : UnitEvidence, n rows
    agree : float, ratio
        Relative difference up to which two units are one.

    Returns
    -------
    Hits
        One a statement: place is that of the statement if it has any, size the metres in one drawing unit that it says.

    Notes
    -----
    O(n). Does not choose a unit: that is for the user to state. Finds nothing where no unit is in use; then no rule
    that measures is run. Does not doubt a drawing that holds no statement.
    """
    ratio = evidence.says / evidence.used
    row = np.flatnonzero(np.abs(ratio - 1) > np.maximum(agree, evidence.weight))
    return hits(row, evidence.where[row], evidence.says[row])
