# SPDX-License-Identifier: MIT
"""MSH010 open-rim."""

import numpy as np

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH010", "open-rim", requires=("MSH001", "MSH002", "MSH015", "MSH021"))
def open_rim(surface: Surface) -> Hits:
    """Rim of a surface that nobody states.

    The rim of a piece of faces joined over edges is its widest boundary loop: see MSH011 hole. Whether a surface should
    end there, as the scan of a bust at its base, or be closed, is no matter of the file: the manifest states it
    (``closed`` and ``rims`` of ``[[mesh]]``), or ``--closed``, ``--open`` and ``--rims``. ``closed = false`` states one
    rim, the widest; one more piece that ends somewhere may be a part, or a crack that runs through the whole surface.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a rim where nobody states it, none otherwise: place is the rim, size its length, item the face at its first
        edge. An open chain has a length too, though it bounds no area.

    Notes
    -----
    O(n log n). As long as a rim is told nothing is concluded: it may be the edge of the work, or a hole.
    Copies of a face are not seen, and fragments that MSH015 isolated-component tells are not asked about. Does not tell
    the other openings of a piece: see MSH011 hole.
    """
    shape = surface.shape
    row = np.flatnonzero(surface.doubtful_rim)
    first, _ = shape.faces_along(row)
    return hits(first, surface.borders(row), shape.border_sizes.length[row] * surface.metres)
