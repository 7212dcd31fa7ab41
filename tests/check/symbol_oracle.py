# SPDX-License-Identifier: MIT
"""Point symbols worked out one insert and one end at a time, with shapely: slow, plain, independent."""

from collections import defaultdict
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely

EPS = 1e-8
Way = list[tuple[float, float]]


class Stroke(NamedTuple):
    """A line, and the inserts that hold it, from the outermost inward: name and block."""

    way: Way
    chain: tuple[tuple[str, str], ...] = ()


def symbol_strokes(
    strokes: list[Stroke], *, size: float, times: int, visible: float, clear: float, alongside: float
) -> set[int]:
    """Rows of the strokes that draw symbols."""
    holding: dict[tuple[tuple[str, str], ...], list[int]] = defaultdict(list)
    for n, stroke in enumerate(strokes):
        for depth in range(1, len(stroke.chain) + 1):
            holding[stroke.chain[:depth]].append(n)
    candidates: dict[tuple[tuple[str, str], ...], list[int]] = {}
    for chain in sorted(holding, key=len):
        circle = shapely.minimum_bounding_radius(
            shapely.MultiPoint([p for n in holding[chain] for p in strokes[n].way])
        )
        if 2 * circle <= size + EPS and not any(chain[: len(other)] == other for other in candidates):
            candidates[chain] = holding[chain]
    blocks: dict[str, list[tuple[tuple[str, str], ...]]] = defaultdict(list)
    for chain in candidates:
        blocks[chain[-1][1]].append(chain)
    found: set[int] = set()
    for inserts in blocks.values():
        alike = {n for chain in inserts for n in candidates[chain]}
        ties = [tie(strokes, set(candidates[chain]), alike, visible, alongside) for chain in inserts]
        for chain, (_, rests) in zip(inserts, ties, strict=True):
            if len(inserts) >= times:
                symbol = sum(bound for bound, _ in ties) < len(inserts) / 2 and not rests
            else:
                symbol = stands_alone(strokes, set(candidates[chain]), clear)
            if symbol:
                found |= set(candidates[chain])
    return found


def tie(strokes: list[Stroke], own: set[int], alike: set[int], visible: float, alongside: float) -> tuple[bool, bool]:
    """Whether an insert and other linework end at each other; whether half of its ends are on other linework."""
    one_place = visible / 20 + EPS
    ends = loose_ends(strokes, own, one_place)
    mine = [(n, way) for n, way in ends if n in own]
    theirs = [(n, shapely.Point(way[0])) for n, way in ends if n not in own]
    held = any(
        shapely.LineString(strokes[m].way).distance(place) <= visible + EPS
        for n, place in theirs if n not in alike for m in own
    )  # fmt: skip
    pieces = [piece for n, stroke in enumerate(strokes) if n not in own for piece in pairwise(stroke.way)]
    apart = []
    for _, way in mine:
        end = shapely.Point(way[0])
        across = [shapely.LineString(piece).distance(end) for piece in pieces if between(way, piece) >= alongside]
        apart.append(min([1.0, *across, *(place.distance(end) for _, place in theirs)]))
    near, met = (sum(gap <= far for gap in apart) for far in (visible + EPS, one_place))
    return held or 0 < len(mine) <= 2 * near, 0 < len(mine) <= 2 * met


def loose_ends(strokes: list[Stroke], own: set[int], one_place: float) -> list[tuple[int, Way]]:
    """Ends that meet no other line on their side, of an insert or of all else: row, and the line from the end on."""
    found = []
    for n, stroke in enumerate(strokes):
        if np.hypot(*np.subtract(stroke.way[0], stroke.way[-1])) <= one_place:
            continue
        side = [shapely.LineString(s.way) for m, s in enumerate(strokes) if m != n and (m in own) == (n in own)]
        found += [
            (n, way)
            for way in (stroke.way, stroke.way[::-1])
            if not any(line.distance(shapely.Point(way[0])) <= one_place for line in side)
        ]
    return found


def between(way: Way, piece: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """Angle between the segment at an end and a piece, at most a right one."""
    a, b = np.subtract(way[1], way[0]), np.subtract(piece[1], piece[0])
    return float(np.arctan2(abs(a[0] * b[1] - a[1] * b[0]), abs(a @ b)))


def stands_alone(strokes: list[Stroke], own: set[int], clear: float) -> bool:
    """Whether nothing else lies as near to an insert as that."""
    others = [shapely.LineString(stroke.way) for n, stroke in enumerate(strokes) if n not in own]
    mine = shapely.MultiLineString([strokes[n].way for n in own])
    return not any(mine.distance(other) <= clear + EPS for other in others)
