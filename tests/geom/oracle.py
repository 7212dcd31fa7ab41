# SPDX-License-Identifier: MIT
"""Definitions of the rules worked out one end and one pair at a time, with shapely: slow, plain, independent."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

EPS = 1e-8


class End(NamedTuple):
    line: int
    last: bool
    kind: str
    size: float
    others: frozenset[int]


class Drawing:
    """Lines as coordinate arrays (k, 2) or (k, 3), and all their segments."""

    def __init__(self, lines: list[NDArray[np.float64]]) -> None:
        self.lines = [np.column_stack([line, np.zeros(len(line))]) if line.shape[1] == 2 else line for line in lines]
        start = np.concatenate([line[:-1] for line in self.lines])
        end = np.concatenate([line[1:] for line in self.lines])
        self.own = np.repeat(np.arange(len(lines)), [len(line) - 1 for line in lines])
        self.pos = np.concatenate([np.arange(len(line) - 1) for line in lines])
        self.flat = shapely.linestrings(np.stack([start[:, :2], end[:, :2]], axis=1))
        self.z = np.stack([start[:, 2], end[:, 2]])

    def strokes(self, coincide: float) -> list[int]:
        """Lines that are no longer than a point."""
        steps = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in self.lines]
        return [n for n, length in enumerate(steps) if length <= coincide + EPS]

    def walked(self, line: int, *, last: bool) -> NDArray[np.float64]:
        return self.lines[line][::-1] if last else self.lines[line]

    def others(self, line: int, *, last: bool, reach: float, coincide: float) -> NDArray[np.intp]:
        """Segments of other lines, and those of the line after it has left the circle around its end; no strokes."""
        way = self.walked(line, last=last)
        outside = np.flatnonzero(np.hypot(*(way[:, :2] - way[0, :2]).T) > reach + EPS)
        left = outside[0] if len(outside) else len(way)
        step = len(way) - 2 - self.pos if last else self.pos
        return np.flatnonzero(((self.own != line) | (step >= left)) & ~np.isin(self.own, self.strokes(coincide)))


def classify(drawing: Drawing, line: int, *, last: bool, coincide: float, reach: float) -> End | None:
    """What one end is; ``None`` if the line is closed."""
    way = drawing.walked(line, last=last)
    if np.linalg.norm(way[0] - way[-1]) <= coincide + EPS:
        return None
    around = drawing.others(line, last=last, reach=reach, coincide=coincide)
    near = drawing.flat[around]
    place = shapely.Point(way[0, :2])
    gap = shapely.distance(near, place)
    drop = np.abs(_depth(drawing, around, _share(near, place)) - way[0, 2])
    back = drawing.others(line, last=last, reach=coincide, coincide=coincide)
    if _met(drawing, back, place, way[0, 2], coincide):
        return End(line, last, "connected", 0.0, frozenset())
    if any(
        _met(drawing, back, shapely.Point(tip[:2]), tip[2], coincide) for tip in _reached(drawing, way[0], coincide)
    ):
        return End(line, last, "connected", 0.0, frozenset())
    passed, crossed = _last_meeting(drawing, way, around, coincide, reach)
    if coincide + EPS < passed < np.inf:
        return End(line, last, "overshoot", passed, crossed)
    missed = np.hypot(gap, drop)
    least = missed.min(initial=np.inf)
    if least <= reach + EPS:
        return End(
            line, last, "undershoot", float(least), frozenset(drawing.own[around[missed <= least + EPS]].tolist())
        )
    return End(line, last, "free", reach, frozenset())


def _reached(drawing: Drawing, place: NDArray[np.float64], coincide: float) -> list[NDArray[np.float64]]:
    """Ends of all strokes that lead on from a place, from end to end."""
    waiting = [(drawing.lines[n][0], drawing.lines[n][-1]) for n in drawing.strokes(coincide)]
    reached = [place]
    for here in reached:
        for tips in list(waiting):
            if any(
                np.hypot(*(tip - here)[:2]) <= coincide + EPS and abs((tip - here)[2]) <= coincide + EPS for tip in tips
            ):
                waiting = [other for other in waiting if other is not tips]
                reached += tips
    return reached[1:]


def _met(drawing: Drawing, rows: NDArray[np.intp], place: shapely.Point, depth: float, coincide: float) -> bool:
    near = drawing.flat[rows]
    drop = np.abs(_depth(drawing, rows, _share(near, place)) - depth)
    return bool(np.any((shapely.distance(near, place) <= coincide + EPS) & (drop <= coincide + EPS)))


def _share(lines: Any, place: shapely.Point) -> Any:
    with np.errstate(invalid="ignore"):  # a segment without length has no share; some versions of GEOS warn of it
        return shapely.line_locate_point(lines, place, normalized=True)


def _depth(drawing: Drawing, rows: NDArray[np.intp], share: NDArray[np.float64]) -> NDArray[np.float64]:
    share = np.nan_to_num(share)
    return drawing.z[0, rows] * (1 - share) + drawing.z[1, rows] * share


def _last_meeting(
    drawing: Drawing, way: NDArray[np.float64], around: NDArray[np.intp], coincide: float, reach: float
) -> tuple[float, frozenset[int]]:
    run, found = 0.0, [(np.inf, -1)]
    for start, end in pairwise(way):
        length = float(np.hypot(*(end - start)[:2]))
        if run >= reach + EPS:
            break
        share = min(1.0, (reach + EPS - run) / length) if length else 1.0
        stop = start + (end - start) * share
        piece = shapely.LineString([start[:2], stop[:2]])
        for row in around[shapely.distance(drawing.flat[around], piece) <= coincide + EPS]:
            met = _meeting(piece, (start[2], stop[2]), drawing.flat[row], drawing.z[:, row], coincide)
            found.append((run + met, int(drawing.own[row])))
        run += length
    least = min(found)[0]
    return least, frozenset(line for met, line in found if met <= least + EPS)


def _meeting(
    a: shapely.Geometry, za: tuple[float, float], b: shapely.Geometry, zb: NDArray[np.float64], coincide: float
) -> float:
    """Length along a to the place where it meets b: the crossing, else the nearest end of either; inf if apart."""
    crossing = shapely.intersection(a, b)
    ends = [shapely.get_point(a, 0), shapely.get_point(a, 1), shapely.get_point(b, 0), shapely.get_point(b, 1)]
    for candidates in ([crossing] if crossing.geom_type == "Point" else [], ends):
        places = []
        for place in candidates:
            on_a, on_b = (_share(line, place) for line in (a, b))
            apart = shapely.distance(
                shapely.line_interpolate_point(a, on_a, normalized=True),
                shapely.line_interpolate_point(b, on_b, normalized=True),
            )
            drop = abs(za[0] + (za[1] - za[0]) * on_a - zb[0] - (zb[1] - zb[0]) * on_b)
            if apart <= coincide + EPS and drop <= coincide + EPS:
                places.append(on_a * a.length)
        if places:
            return float(min(places))
    return np.inf


def classify_all(lines: list[NDArray[np.float64]], *, coincide: float, reach: float) -> list[End]:
    """Every end of every open line, first vertex before last."""
    drawing = Drawing(lines)
    found = [
        classify(drawing, line, last=last, coincide=coincide, reach=reach)
        for line in range(len(lines))
        for last in (False, True)
    ]
    return [end for end in found if end is not None]
