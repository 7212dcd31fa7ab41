# SPDX-License-Identifier: MIT
"""MSH021 duplicate-face."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH021", "duplicate-face", size="m2", requires=("MSH001", "MSH002"), repeats=True)
def duplicate_face(surface: Surface) -> Hits:
    """Face that is in the file twice.

    Two faces are one if they run around the same vertices in the same order, from whichever they begin and in either
    direction.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a copy: item and place are the copy, size its area, other the first face of its kind.

    Notes
    -----
    O(n log n). Does not tell faces that cover the same place with other corners: see MSH023 coplanar-overlap.
    """
    shape = surface.shape
    face = shape.duplicates.face
    return hits(face, surface.faces(face), shape.areas[face] * surface.metres**2, shape.duplicates.original)
