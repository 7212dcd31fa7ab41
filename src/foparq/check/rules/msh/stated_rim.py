# SPDX-License-Identifier: MIT
"""MSH009 stated-rim."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH009", "stated-rim", size="m2", requires=("MSH001", "MSH002", "MSH021"))
def stated_rim(surface: Surface) -> Hits:
    """Rim at which the surface ends because somebody states that it should.

    Which borders are rims is the producer's word (``closed`` and ``rims`` of ``[[mesh]]``), and what is a rim is no
    hole. Each is told with the area that would close it, so that nobody accepts an opening without having seen it.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a rim that is stated: place is the rim, size the area of its fill, as of a hole: see MSH011. The item is the
        face at its first edge.

    Notes
    -----
    O(n log n). Information, no fault: the rim of a facade is as large as the facade. Does not tell rims that nobody
    states: see MSH010 open-rim.
    """
    shape = surface.shape
    row = np.flatnonzero(surface.rim & ~surface.doubtful_rim)
    first, _ = shape.faces_along(row)
    return hits(first, surface.borders(row), shape.fills[row] * surface.metres**2)
