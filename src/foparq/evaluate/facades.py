# SPDX-License-Identifier: MIT
"""What a table of checkpoints says of each of several drawings."""

from collections.abc import Collection

import numpy as np

from foparq.columns import Flags
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Reason, because
from foparq.findings.ties import Alike, PointTies
from foparq.names import folded


def facade_doubts(ties: PointTies, counted: Flags, name: str, fewest: int) -> tuple[Reason, ...]:
    """Facades on which fewer checkpoints lie than an element asks for: points of one facade say nothing of another.

    Parameters
    ----------
    counted : (n, d) bool
        The point speaks of the drawing.
    name : str
        Id of the element.
    fewest : int
        Places that a facade must have.
    """
    if len(ties.files) < 2:  # noqa: PLR2004 - one drawing is the whole
        return ()
    why = []
    for facade in _named(ties):
        rows = [row for row, own in enumerate(ties.facades) if folded(own) == facade]
        there: Flags = np.any(counted[:, rows], axis=1)
        n = len(np.unique(ties.group[there]))
        if n < fewest:
            files = [ties.files[row] for row in rows]
            said = {"facade": ties.facades[rows[0]], "files": files, "n": n, "total": len(there), "fewest": fewest}
            why.append(because("evidence.facade", element=name, **said))
    return tuple(why)


def unnamed_remark(ties: PointTies, counted: Flags, name: str) -> tuple[Reason, ...]:
    """Remark on drawings of no named facade, of which no checkpoint speaks."""
    if len(ties.files) < 2:  # noqa: PLR2004 - one drawing is the whole
        return ()
    silent: Flags = np.all(~counted, axis=0)
    files = [path for path, facade, none in zip(ties.files, ties.facades, silent, strict=True) if none and not facade]
    return (because("evidence.unnamed", element=name, files=files),) if files else ()


def alike_doubts(evidence: Evidence) -> list[Reason]:
    """Drawings of two facades with the same linework, and meshes with the same vertices.

    Not those of which a person confirms one facade by name.
    """
    if evidence.ties is None:
        return []
    sure = {folded(one.value) for one in evidence.delivery.confirmed if one.what == "facade"}
    meshes = {mesh.path for mesh in evidence.delivery.meshes}
    return [
        because(_alike(one, meshes), files=[one.path, one.other], facade=one.facade, other=one.other_facade)
        for one in evidence.ties.alike
        if not {folded(one.facade), folded(one.other_facade)} & sure
    ]


def _alike(one: Alike, meshes: Collection[str]) -> str:
    if one.path in meshes:
        return "verdict.alike-meshes" if one.facade and one.other_facade else "verdict.one-mesh"
    return "verdict.alike-mirrored" if one.mirrored else "verdict.alike"


def _named(ties: PointTies) -> list[str]:
    """Facades, each once, in the order of the drawings."""
    return list(dict.fromkeys(folded(facade) for facade in ties.facades if facade))
