# SPDX-License-Identifier: MIT
"""How many features of each class were drawn."""

from collections.abc import Sequence

import numpy as np
import shapely

from foparq.check.inputs import matches
from foparq.findings.counts import FeatureCounts
from foparq.geom.clusters import clusters
from foparq.model.drawing import Drawing
from foparq.model.items import Flags, Role


def count_features(drawings: Sequence[Drawing], *, gap: float) -> FeatureCounts | None:
    """Count delivered features by class and facade.

    A layer belongs to the class of the first pattern of the manifest that it matches. All items of one block insert
    at top level are one feature. Other linework of one class is one feature as long as its pieces lie no farther
    apart than ``gap`` in the plane of the drawing. Hidden and paper-space items, text, dimensions and hatches are
    not counted.

    Parameters
    ----------
    drawings : sequence of Drawing
    gap : float
        Metres.

    Returns
    -------
    FeatureCounts or None
        ``None`` if no drawing binds layers to classes, or none of those has a known unit.
    """
    counted: dict[tuple[str, str], int] = {}
    unmapped: dict[str, int] = {}
    bound = [drawing for drawing in drawings if drawing.classes and drawing.unit.metres is not None]
    if not bound:
        return None
    for drawing in bound:
        items = drawing.items
        seen = drawing.visible_rows() & np.isin(items.role, [Role.LINE, Role.AREA, Role.POINT])
        seen &= ~(shapely.is_missing(items.geometry) | shapely.is_empty(items.geometry))
        named = {layer: _class_of(layer, drawing) for layer in set(items.layer[seen].tolist())}
        of_row = np.array([named.get(layer, "") for layer in items.layer], dtype=object)
        for layer, feature_class in named.items():
            if not feature_class:
                unmapped[layer] = unmapped.get(layer, 0) + int(np.count_nonzero(seen & (items.layer == layer)))
        for feature_class in drawing.classes.values():
            counted.setdefault((feature_class, drawing.facade), 0)
        for feature_class in sorted(set(named.values()) - {""}):
            counted[feature_class, drawing.facade] += _features(drawing, seen & (of_row == feature_class), gap)
    ordered = sorted(counted)
    return FeatureCounts(
        feature_class=np.array([name for name, _ in ordered], dtype=object),
        facade=np.array([facade for _, facade in ordered], dtype=object),
        count=np.array([counted[key] for key in ordered], dtype=np.intp),
        unmapped=tuple(sorted(unmapped.items())),
    )


def _class_of(layer: str, drawing: Drawing) -> str:
    return next((name for pattern, name in drawing.classes.items() if matches(layer, (pattern,))), "")


def _features(drawing: Drawing, rows: Flags, gap: float) -> int:
    items = drawing.items
    outermost = np.array([chain.split("/", 1)[0] for chain in items.inserts[rows]], dtype=object)
    inserts = set(outermost.tolist()) - {""}
    loose = np.flatnonzero(rows)[outermost == ""]
    if not len(loose):
        return len(inserts)
    metres = drawing.unit.metres or 1.0
    coordinates = shapely.get_coordinates(items.geometry[loose], include_z=True)
    coordinates[:, 2] = np.nan_to_num(coordinates[:, 2])
    sheet = drawing.plane.project(coordinates, metres)[:, :2]
    flat = shapely.set_coordinates(shapely.force_2d(items.geometry[loose].copy()), sheet)
    return len(inserts) + len(np.unique(clusters(flat, gap=gap)))
