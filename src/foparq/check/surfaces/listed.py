# SPDX-License-Identifier: MIT
"""Features of a list, looked for on meshes; and surface of meshes of which the list says nothing."""

from collections.abc import Sequence

import numpy as np

from foparq.check.surfaces.skin import Skin
from foparq.check.surfaces.unlisted import unlisted
from foparq.columns import Flags, Index, Reals, Texts
from foparq.findings.counts import FeatureCounts, ListDoubts, Listed, Placements, Unlisted
from foparq.match.assign import UNASSIGNED
from foparq.model.mesh import Mesh
from foparq.model.tables import FeatureList
from foparq.names import folded, of_kind

_SAME = 1e-6  #: metres: what is nearer is one place, written twice
_SPARSE = 5.0  #: times the widest tolerance, that places of a list may lie apart, or a surface from what is missing


def count_on_surfaces(meshes: Sequence[Mesh], *, features: FeatureList | None, near: float) -> FeatureCounts | None:
    """Look for the features of a list on the meshes of a delivery.

    A listed feature is *there* if the surface of a mesh of its facade lies within its tolerance of its place, and what
    the printed digits of the list may hide. Nobody can count the features of a surface: classes and facades of which
    one feature has no place are left out.

    Parameters
    ----------
    features : FeatureList or None
        Places in the axes of the meshes, metres. Prohibited features are left out: a surface may lie where they would.
    near : float, metres
        Tolerance where the list states none, and the widest with which a place tells anything. A spacing may be five
        times as wide.

    Returns
    -------
    FeatureCounts or None
        ``None`` without a list, or a mesh whose unit is known. Where the list states its spacing, with the pieces of
        surface that no place of it explains.

    Notes
    -----
    O(n log f) for n places and f faces.
    """
    skins = [skin for mesh in meshes if mesh.unit.metres is not None and len(skin := Skin(mesh))]
    if features is None or not skins:
        return None
    asked = (features.use != "prohibited") & np.isfinite(features.place).all(axis=1) & (features.count == 1)
    tol = np.where(np.isfinite(features.tol) & (features.tol > 0), features.tol, near)
    gap, there = np.full(len(features.id), np.inf), np.zeros(len(features.id), dtype=bool)
    places_on = []
    for skin in skins:
        mine = np.flatnonzero(asked & _of_facade(features.facade, skin.mesh.facade))
        foot = skin.foot(features.place[mine])
        gap[mine] = np.minimum(gap[mine], foot.distance)
        on = foot.distance <= tol[mine] + foot.hidden(features.place[mine], features.printed)
        there[mine] |= on
        places_on.append((skin.mesh.path, int(np.count_nonzero(on))))
    lies = np.where(there, Listed.THERE.value, np.where(asked, Listed.ABSENT.value, Listed.UNPLACED.value))
    names, facades, count = _counts(features, asked, there)
    placements = Placements(lies=lies.astype(object), row=np.full(len(lies), UNASSIGNED, dtype=np.intp))
    return FeatureCounts(
        feature_class=names, facade=facades, count=count, on_meshes=True, placements=placements,
        places_on=tuple(places_on),
        doubts=_doubts(features, asked, near),
        unlisted=() if placements.elsewhere else _beyond(
            skins, features, asked, np.where(there, 0.0, gap), _SPARSE * near
        ),
    )  # fmt: skip


def _doubts(features: FeatureList, asked: Flags, near: float) -> ListDoubts:
    place, spacing = features.place[asked], _SPARSE * near
    kind = np.unique([of_kind(str(name)) for name in features.feature_class[asked]], return_inverse=True)[1]
    distinct = np.unique(np.column_stack([np.round(place / _SAME), kind.reshape(-1)]), axis=0)
    stated = features.spacing
    return ListDoubts(
        tol=near, rounded=float(np.linalg.norm(features.printed)), spacing=spacing,
        coarse=int(np.count_nonzero(features.tol[asked] > near)),
        sparse=stated is not None and stated > spacing, repeated=len(place) - len(distinct),
        prohibited=int(np.count_nonzero(features.use == "prohibited")),
    )  # fmt: skip


def _of_facade(facades: Texts, own: str) -> Flags:
    """(n,) whether a feature may be looked for on a mesh: both name the same facade, or one of them none."""
    side = np.array([folded(str(name)) for name in facades], dtype=object)
    return np.asarray((side == folded(own)) | (side == "") | (not own))


def _counts(features: FeatureList, asked: Flags, there: Flags) -> tuple[Texts, Texts, Index]:
    """Classes and facades whose features all have places, and how many of them are there; prohibited ones have none."""
    keys = [(of_kind(str(c)), folded(str(f))) for c, f in zip(features.feature_class, features.facade, strict=True)]
    needed = features.use != "prohibited"
    loose = {key for key, need, known in zip(keys, needed.tolist(), asked.tolist(), strict=True) if need and not known}
    found: dict[tuple[str, str], tuple[str, str, int]] = {}
    for row, key in enumerate(keys):
        if key not in loose:
            name, facade, n = found.get(key, (str(features.feature_class[row]), str(features.facade[row]), 0))
            found[key] = (name, facade, n + int(there[row]))
    rows = [found[key] for key in sorted(found)]
    names, facades = np.empty(len(rows), dtype=object), np.empty(len(rows), dtype=object)
    names[:], facades[:] = [row[0] for row in rows], [row[1] for row in rows]
    return names, facades, np.array([row[2] for row in rows], dtype=np.intp)


def _beyond(
    skins: Sequence[Skin], features: FeatureList, asked: Flags, gap: Reals, most: float
) -> tuple[Unlisted, ...]:
    """What of each mesh no place of the list explains; nothing where the list states no spacing."""
    if features.spacing is None or not asked.any():
        return ()
    # What lies in place of a missing feature is near its place: a screen a metre behind it is something else.
    more = gap[asked]
    places, more = features.place[asked], np.where(more <= most, more, 0.0)
    return tuple(unlisted(skin, places, more, spacing=features.spacing) for skin in skins)
