# SPDX-License-Identifier: MIT
"""MSH014 flipped-orientation."""

from foparq.check.rule import rule
from foparq.findings.hits import Hits, hits
from foparq.model.surface import Surface


@rule("MSH014", "flipped-orientation", size="items", requires=("MSH001", "MSH002", "MSH021"))
def flipped_orientation(surface: Surface) -> Hits:
    """Patch of faces that look to the other side than their neighbours, or closed piece that looks inward.

    Two faces that share an edge look to the same side if they run along it in opposite directions. Faces joined over
    edges at which just two faces meet and agree make a *patch*. Where patches that meet at such edges disagree, the
    side with more faces is taken for right, of two sides with as many the one with the lowest face; every patch of the
    other side gets a finding.

    A piece that is closed, whose patches agree and whose signed volume is negative looks inward, and gets a finding;
    unless it lies within another closed piece, as the wall of a cavity does.

    Parameters
    ----------
    surface : Surface, n rows
        Faces that can be used, with vertices at the same coordinates taken for one where the profile says so.

    Returns
    -------
    Hits
        One a patch or piece: the item is its first face, the place is that face, the size the number of faces.

    Notes
    -----
    O(n log n). On a surface that cannot be oriented, as a Moebius strip, no choice of sides agrees: the edges at which
    two sides meet against each other are told, one finding an edge of size 2. Does not look across an edge at which
    more than two faces meet: see MSH012 non-manifold-edge; nor at copies of a face.
    """
    shape = surface.shape
    found = shape.turned
    return hits(found.first, surface.faces(found.first), found.size.astype(float), also=found.faces)
