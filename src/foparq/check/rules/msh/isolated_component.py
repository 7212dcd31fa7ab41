# SPDX-License-Identifier: MIT
"""MSH015 isolated-component."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits, no_hits
from foparq.model.surface import Surface
from foparq.units import Ratio


@rule("MSH015", "isolated-component", size="m2", requires=("MSH001", "MSH002"))
def isolated_component(surface: Surface, *, share: Ratio) -> Hits:
    """Small piece of surface that hangs together with nothing.

    Faces joined over shared edges are a *piece*. A piece gets a finding if its area is less than ``share`` of that of
    the piece of most faces: floating fragments of a reconstruction, not the parts of a monument.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.
    share : float
        Part of the area of the piece of most faces.

    Returns
    -------
    Hits
        One a piece: item and place are its first face, size its area, other the first face of the piece of most faces.

    Notes
    -----
    O(n log n). One stray face is no body, however large it is. Does not tell pieces of that share and more: they are
    parts, and how many there are is no fault of the surface.
    """
    if not len(surface):
        return no_hits()
    shape = surface.shape
    pieces = shape.components
    main = pieces.main
    row = np.flatnonzero(pieces.area < share * pieces.area[main])
    row = row[row != main]
    faces = np.flatnonzero(np.isin(pieces.label, row))
    first = shape.first_by_place(pieces.label, faces)
    other = np.full(len(row), pieces.lowest[main])
    return hits(first, surface.faces(first), pieces.area[row] * surface.metres**2, other, also=faces)
