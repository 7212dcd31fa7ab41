# SPDX-License-Identifier: MIT
"""Closed lines that mostly share borders, as the areas of a coverage do."""

import numpy as np
import shapely

from foparq.columns import Flags, Geometries, Index
from foparq.geom.overlaps import shared_runs
from foparq.geom.polylines import Polylines

_RING_VERTICES = 4
_FEWEST = 3  #: closed lines of a layer
_LAYERS = 100  #: layers that are looked at, those with the most closed lines
_SHARED = 0.25  #: of its length that a closed line shares with others: half of two sides of a square


def adjoining(lines: Polylines, geometry: Geometries, layer: Index, exempt: Flags, *, coincide: float) -> Flags:
    """Closed lines of the layers whose closed lines mostly share borders.

    At least half of the closed lines of such a layer, and at least three, share a quarter of their length with others
    of the layer. Lines that lie in one another are not asked: a frame and what it holds.

    Parameters
    ----------
    lines : Polylines, n lines
    geometry : (n,) shapely geometries
        The same lines.
    layer : (n,) int
        Layer of each line.
    exempt : (n,) bool
        True for boundaries of areas that are known as such: they are left out.
    coincide : float, metres
        Distance up to which two places are one.

    Returns
    -------
    (n,) bool

    Notes
    -----
    O(s log s + meetings). At most a hundred layers are looked at, those with the most closed lines.
    """
    found = np.zeros(len(lines), dtype=bool)
    # A line of no extent counts as a ring too, and bounds nothing.
    rings = np.flatnonzero(~exempt & (shapely.get_num_points(geometry) >= _RING_VERTICES))
    rings = rings[shapely.is_ring(geometry[rings])]
    _, number, count = np.unique(layer[rings], return_inverse=True, return_counts=True)
    crowded = np.argsort(-count, kind="stable")[:_LAYERS]
    crowded = crowded[count[crowded] >= _FEWEST]
    if not len(crowded):
        return found
    beside = np.zeros(len(lines), dtype=bool)
    of_layer = np.split(rings[np.argsort(number, kind="stable")], np.cumsum(count)[:-1])
    for n in crowded.tolist():
        beside[of_layer[n]] = _beside_each_other(geometry[of_layer[n]])
    # Of no other line is asked with whom it shares what: there may be thousands of them in one place.
    asked = np.flatnonzero(beside)
    rows = Polylines.of(geometry[asked])
    runs = shared_runs(rows, np.zeros(len(rows), dtype=bool), coincide=coincide)
    runs = runs.take(layer[asked[runs.one]] == layer[asked[runs.two]])
    shared = np.zeros(len(lines))
    for side in (runs.one, runs.two):
        np.add.at(shared, asked[side], runs.length)
    # Each vertex may be off by the rounding of coordinates: a quarter stays one at UTM size.
    shares = shared >= _SHARED * lines.length - lines.slack * np.diff(lines.offsets)
    for n in crowded.tolist():
        alone = of_layer[n][beside[of_layer[n]]]
        if len(alone) >= _FEWEST and 2 * np.count_nonzero(shares[alone]) >= len(alone):
            found[of_layer[n]] = True
    return found


def _beside_each_other(rings: Geometries) -> Flags:
    """(n,) closed lines that lie in no other one, and hold none."""
    points, of_ring = shapely.get_coordinates(rings, return_index=True)
    faces = shapely.polygons(shapely.linearrings(points, indices=of_ring))
    inner, outer = shapely.STRtree(faces).query(shapely.point_on_surface(faces), predicate="within")
    nested = inner != outer
    beside = np.ones(len(rings), dtype=bool)
    beside[inner[nested]] = beside[outer[nested]] = False
    return beside
