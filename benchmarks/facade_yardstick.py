# SPDX-License-Identifier: MIT
"""The plain script against which ``facade.py`` measures: the same faults, as one would look for them with shapely.

It tells undershoots, overshoots, duplicates, overlaps, self-intersections and invalid lines of one GeoPackage, in the
plane, without places, depth, tangents or reports.
"""

import sys
from collections.abc import Mapping

import numpy as np
import pyogrio
import shapely

COINCIDE, REACH = 0.0005, 0.01


def faults(path: str) -> Mapping[str, int]:
    """Count of each fault."""
    lines = shapely.from_wkb(pyogrio.raw.read(path)[2])
    invalid, crossing = ~shapely.is_valid(lines), ~shapely.is_simple(lines)
    _, first = np.unique(shapely.to_wkb(shapely.normalize(lines)), return_index=True)
    duplicates = len(lines) - len(first)
    lines = lines[np.sort(first)]
    tree = shapely.STRtree(lines)

    opened = np.flatnonzero(~shapely.is_closed(lines))
    ends = np.concatenate([shapely.get_point(lines[opened], 0), shapely.get_point(lines[opened], -1)])
    owner = np.concatenate([opened, opened])
    end, other = tree.query(ends, predicate="dwithin", distance=REACH)
    end, other = end[owner[end] != other], other[owner[end] != other]
    near = np.full(len(ends), np.inf)
    np.minimum.at(near, end, shapely.distance(ends[end], lines[other]))

    i, j = tree.query(lines, predicate="intersects")
    i, j = i[i < j], j[i < j]
    common = shapely.intersection(lines[i], lines[j])
    overlaps = int(np.count_nonzero(shapely.length(common) > COINCIDE))
    loose = np.flatnonzero(near > COINCIDE)
    met = shapely.STRtree(common)
    at, place = met.query(ends[loose], predicate="dwithin", distance=REACH)
    over = (i[place] == owner[loose[at]]) | (j[place] == owner[loose[at]])
    overshoots = np.unique(loose[at[over]])
    undershoots = np.setdiff1d(np.flatnonzero((near > COINCIDE) & (near <= REACH)), overshoots)
    return {
        "invalid": int(invalid.sum()), "self-intersection": int(crossing.sum()), "duplicate": duplicates,
        "overlap": overlaps, "overshoot": len(overshoots), "undershoot": len(undershoots),
    }  # fmt: skip


if __name__ == "__main__":
    print(faults(sys.argv[1]))
