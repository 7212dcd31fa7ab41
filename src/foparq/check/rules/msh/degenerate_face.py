# SPDX-License-Identifier: MIT
"""MSH003 degenerate-face."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH003", "degenerate-face", requires=("MSH001", "MSH002"))
def degenerate_face(surface: Surface) -> Hits:
    """Face without area.

    A face gets a finding if two corners in a row are one vertex or lie at one place, or all of them lie on one line. A
    vertex that comes twice among the corners, and not in a row, is no fault: so a polygon reaches its openings over
    bridges. It is decided exactly, on the coordinates as delivered: a face however thin that has an area is none of
    these.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a face: place is the face, size the length of its longest side.

    Notes
    -----
    O(n): rounding is bounded, and decided in rational numbers only where it could matter. Does not tell a face
    that is thin and has an area.
    """
    shape = surface.shape
    face = shape.degenerate
    return hits(face, surface.outlines(face), shape.longest_sides(face) * surface.metres)
