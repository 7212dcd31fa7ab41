# SPDX-License-Identifier: MIT
"""Whether meshes beside drawings lie where the checkpoints were surveyed."""

import math

from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because, some
from foparq.evaluate.tied import Tied

_SHOWN = 10  #: ids that a reason names


def with_meshes(tied: Tied, evidence: Evidence, name: str, *, limit: float | None, fewest: int) -> Tied:
    """Differences of checkpoints in the light of the meshes that were delivered beside the drawings.

    The delivered coordinates are those of drawings. Of a mesh it is seen how far its surface is from the surveyed
    places: a root mean square of distances that reaches the limit of one axis leaves the element undecided. So does a
    mesh of a named facade that fewer places are near than an element asks for.

    Parameters
    ----------
    name : str
        Id of the element, for the reasons.
    limit : float or None, metres
        Of the root mean square error of one axis.
    fewest : int
        Places that a facade must have.
    """
    doubts: list[Reason] = []
    for mesh in evidence.ties.beside if evidence.ties else ():
        n = len(mesh.ids)
        said = {"element": name, "file": mesh.path, "n": n, "fewest": fewest}
        if n < fewest:
            if mesh.facade:
                doubts.append(because("evidence.mesh-facade", facade=mesh.facade, **said))
        elif limit is not None and (found := math.sqrt(sum(d**2 for d in mesh.distance) / n)) >= limit:
            shown = some(list(mesh.ids[:_SHOWN]), _SHOWN, n)
            told = {"value": (found, "m"), "limit": (limit, "m"), "most": (mesh.distance[0], "m")}
            doubts.append(because("evidence.mesh-off", ids=shown, **told, **said))
    return tied._replace(doubts=(*tied.doubts, *doubts))
