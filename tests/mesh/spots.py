# SPDX-License-Identifier: MIT
"""Whether places in space are the same: shapely measures in the plane only."""

from typing import Any

import numpy as np
import shapely


def nowhere(place: Any) -> bool:
    """Whether a place is missing."""
    return bool(place.is_empty or np.isnan(shapely.get_coordinates(place, include_z=True)).any())


def lie_together(one: Any, two: Any, within: float) -> bool:
    """Whether two places are of one kind, of one length, and at the same vertices; rings may begin anywhere.

    Parameters
    ----------
    within : float
        How far a vertex may be off.
    """
    if nowhere(one) or nowhere(two):
        return nowhere(one) and nowhere(two)
    here, there = (shapely.get_coordinates(place, include_z=True) for place in (one, two))
    if one.geom_type != two.geom_type or len(here) != len(there):
        return False
    apart = np.linalg.norm(here[:, None] - there[None], axis=2)
    near = bool((apart.min(axis=0) <= within).all() and (apart.min(axis=1) <= within).all())
    return near and abs(_length(here) - _length(there)) <= within * len(here)


def _length(vertices: Any) -> float:
    return float(np.linalg.norm(np.diff(vertices, axis=0), axis=1).sum())
