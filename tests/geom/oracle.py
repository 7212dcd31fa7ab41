# SPDX-License-Identifier: MIT
"""Definitions of the rules worked out one end and one pair at a time, with shapely: slow, plain, independent."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

EPS = 1e-8
TURN = 1e-6  #: sine of an angle that rounding may make


class Aim(NamedTuple):
    """Radians, radians, and lengths of the stub."""

    ahead: float
    alongside: float
    remainder: float


#: near things count whatever their direction, and every stub does
ANYWHERE = Aim(np.pi, 0.0, 0.0)


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
        self.piece = self.own  #: the line as it was drawn
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


def chained(lines: list[NDArray[np.float64]], coincide: float) -> tuple[Drawing, dict[tuple[int, bool], int]]:
    """Lines followed on where just two ends meet, and which chain each free end (line, last) ends."""
    deep = Drawing(lines).lines
    strokes = Drawing(lines).strokes(coincide)
    ends = [
        (n, last) for n, line in enumerate(deep) for last in (False, True)
        if n not in strokes and np.linalg.norm(line[0] - line[-1]) > coincide + EPS
    ]  # fmt: skip
    place = {end: deep[end[0]][-1 if end[1] else 0] for end in ends}

    def meeting(end: tuple[int, bool]) -> list[tuple[int, bool]]:
        step = [(other, place[other] - place[end]) for other in ends if other != end]
        return [o for o, d in step if np.hypot(*d[:2]) <= coincide + EPS and abs(d[2]) <= coincide + EPS]

    found = {end: meeting(end) for end in ends}
    mate = {end: met[0] for end, met in found.items() if len(met) == 1 and len(found[met[0]]) == 1}
    chains: list[list[tuple[int, bool]]] = []  # lines of each, and whether it is followed backwards
    used: set[int] = set()
    starts = [end for end in ends if end not in mate] + ends
    for start in [*starts, *((n, False) for n in range(len(lines)))]:
        if start[0] in used:
            continue
        chain, entered = [], start
        while entered[0] not in used:
            chain.append(entered)
            used.add(entered[0])
            entered = mate.get((entered[0], not entered[1]), entered)
        chains.append(chain)
    ways, pieces = [], []
    for chain in chains:
        way = [deep[n][::-1] if backwards else deep[n] for n, backwards in chain]
        joined = np.concatenate(way)
        owner = np.concatenate([np.full(len(part), n) for part, (n, _) in zip(way, chain, strict=True)])
        # Two ends at the very same place are one vertex.
        twice = np.append(np.all(joined[1:] == joined[:-1], axis=1) & (owner[1:] != owner[:-1]), [False])
        ways.append(joined[~twice])
        # The segment behind a vertex that was left out belongs to the line that follows.
        pieces.append(owner[~twice][:-1])
    drawing = Drawing(ways)
    drawing.piece = np.concatenate(pieces)
    of = {(n, last): k for k, chain in enumerate(chains) for n, _ in chain for last in (False, True)}
    free = {end: k for end, k in of.items() if end in ends and end not in mate}
    return drawing, free


class Followed(NamedTuple):
    # One end of a chain: what is known before direction is asked.
    chain: int
    last: bool
    way: NDArray[np.float64]  #: followed from the end
    around: NDArray[np.intp]  #: segments of other linework
    settled: End | None


def classify_all(lines: list[NDArray[np.float64]], *, coincide: float, reach: float, aim: Aim = ANYWHERE) -> list[End]:
    """Every end of every open line, first vertex before last."""
    drawing, free = chained(lines, coincide)
    deep = Drawing(lines).lines
    ways = {end: follow(drawing, chain, deep, end, coincide, reach, aim) for end, chain in free.items()}
    found = []
    for n, line in enumerate(deep):
        if np.linalg.norm(line[0] - line[-1]) <= coincide + EPS:
            continue
        for last in (False, True):
            way = ways.get((n, last))
            if way is None:
                found.append(End(n, last, "connected", 0.0, frozenset()))
            elif way.settled is not None:
                found.append(way.settled._replace(line=n, last=last))
            else:
                found.append(_missed(drawing, (n, last), ways, coincide, reach, aim))
    return found


def classify_one(
    lines: list[NDArray[np.float64]], followed: tuple[Drawing, dict[tuple[int, bool], int]], end: tuple[int, bool],
    *, coincide: float, reach: float,
) -> End:  # fmt: skip
    """What one free end (line, last) is wherever it heads, in a drawing of lines that were followed on."""
    drawing, free = followed
    deep = [lines[end[0]] if n == end[0] else np.zeros((0, 2)) for n in range(end[0] + 1)]
    deep = [np.column_stack([line, np.zeros(len(line))]) if line.shape[1] == 2 else line for line in deep]
    way = follow(drawing, free[end], deep, end, coincide, reach, ANYWHERE)
    if way.settled is not None:
        return way.settled._replace(line=end[0], last=end[1])
    return _missed(drawing, end, {end: way}, coincide, reach, ANYWHERE)


def follow(
    drawing: Drawing, chain: int, deep: list[NDArray[np.float64]], end: tuple[int, bool], coincide: float,
    reach: float, aim: Aim,
) -> Followed:  # fmt: skip
    place = deep[end[0]][-1 if end[1] else 0]
    last = bool(np.any(drawing.lines[chain][0] != place))
    way = drawing.walked(chain, last=last)
    around = drawing.others(chain, last=last, reach=reach, coincide=coincide)
    return Followed(chain, last, way, around, _settled(drawing, chain, last, way, around, coincide, reach, aim))


def _settled(
    drawing: Drawing, chain: int, last: bool, way: NDArray[np.float64], around: NDArray[np.intp],  # noqa: FBT001
    coincide: float, reach: float, aim: Aim,
) -> End | None:  # fmt: skip
    """Connected, or beyond the last meeting."""
    if np.linalg.norm(way[0] - way[-1]) <= coincide + EPS:
        return End(0, last, "connected", 0.0, frozenset())  # both ends meet, and a third one
    place = shapely.Point(way[0, :2])
    back = drawing.others(chain, last=last, reach=coincide, coincide=coincide)
    if _met(drawing, back, place, way[0, 2], coincide):
        return End(0, last, "connected", 0.0, frozenset())
    if any(
        _met(drawing, back, shapely.Point(tip[:2]), tip[2], coincide) for tip in _reached(drawing, way[0], coincide)
    ):
        return End(0, last, "connected", 0.0, frozenset())
    passed, crossed = _last_meeting(drawing, way, around, coincide, reach)
    whole = float(np.hypot(*np.diff(way[:, :2], axis=0).T).sum())
    if coincide + EPS < passed <= reach + EPS and whole - passed >= aim.remainder * passed - EPS:
        return End(0, last, "overshoot", passed, crossed)
    return None


def _missed(
    drawing: Drawing, end: tuple[int, bool], ways: dict[tuple[int, bool], Followed], coincide: float, reach: float,
    aim: Aim,
) -> End:  # fmt: skip
    """Short of something, beside something, or free."""
    one = ways[end]
    place, near = one.way[0], drawing.flat[one.around]
    point = shapely.Point(place[:2])
    share = share_of(near, point)
    drop = np.abs(depth_at(drawing, one.around, share) - place[2])
    missed = np.hypot(shapely.distance(near, point), drop)
    candidates: list[tuple[float, int]] = []
    for n in np.flatnonzero(missed <= reach + EPS):
        start, stop = shapely.get_coordinates(near[n])
        target = start + (stop - start) * np.nan_to_num(share[n])
        if any(
            lies_ahead(u, place[:2], target, start, stop, coincide, reach, aim) for u in aims(one.way, coincide, reach)
        ):
            candidates.append((float(missed[n]), int(drawing.piece[one.around[n]])))
    for other, two in ways.items():
        if other == end or two.settled is not None:
            continue
        if two.chain == one.chain:
            outside = np.hypot(*(one.way[:, :2] - place[:2]).T) > reach + EPS
            if not outside.any():
                continue
        step = two.way[0] - place
        apart = float(np.hypot(np.hypot(*step[:2]), step[2]))
        if apart <= reach + EPS and any(
            _faces(u, v, step[:2], coincide) or closes(u, v, step[:2], reach)
            for u in aims(one.way, coincide, reach) for v in aims(two.way, coincide, reach)
        ):  # fmt: skip
            candidates.append((apart, other[0]))
    for kind, rows in (
        ("undershoot", candidates),
        ("beside", [(float(d), int(drawing.piece[k])) for d, k in zip(missed, one.around, strict=True)]),
    ):
        least = min((distance for distance, _ in rows), default=np.inf)
        if least <= reach + EPS:
            return End(*end, kind, least, frozenset(line for distance, line in rows if distance <= least + EPS))
    return End(*end, "free", reach, frozenset())


def aims(way: NDArray[np.float64], coincide: float, reach: float) -> list[NDArray[np.float64]]:
    """Directions of the last segment and of the chord, as unit vectors."""
    flat = way[:, :2]
    far = np.flatnonzero(np.hypot(*(flat - flat[0]).T) > coincide + EPS)
    last = flat[0] - flat[far[0] if len(far) else -1]
    chord = flat[0] - shapely.get_coordinates(shapely.LineString(flat).interpolate(reach))[0]
    chosen = chord if np.hypot(*chord) > coincide + EPS else last
    return [vector / (np.hypot(*vector) or 1.0) for vector in (last, chosen)]


def cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def lies_ahead(
    u: NDArray[np.float64], place: NDArray[np.float64], target: NDArray[np.float64], start: NDArray[np.float64],
    stop: NDArray[np.float64], coincide: float, reach: float, aim: Aim,
) -> bool:  # fmt: skip
    """Whether an end that heads for u could run into a segment whose nearest place is the target."""
    step, along = target - place, stop - start
    length = float(np.hypot(*along))
    if np.hypot(*step) <= EPS:
        return True
    turned = length > EPS and abs(cross(u, along)) >= np.sin(aim.alongside) * length - EPS
    cone = float(step @ u) >= np.cos(aim.ahead) * np.hypot(*step) - EPS
    on, meets = np.inf, False
    if abs(cross(u, along)) > TURN * length:
        on = cross(start - place, along) / cross(u, along)
        at = cross(start - place, u) / cross(u, along) * length
        meets = on >= 0 and -coincide - EPS <= at <= length + coincide + EPS
    return bool(turned and (cone or meets)) or bool(meets and on <= reach + EPS)


def _faces(u: NDArray[np.float64], v: NDArray[np.float64], step: NDArray[np.float64], coincide: float) -> bool:
    return bool(u @ v < -TURN and min(step @ u, -step @ v) >= -coincide - EPS)


def closes(u: NDArray[np.float64], v: NDArray[np.float64], step: NDArray[np.float64], reach: float) -> bool:
    if abs(cross(u, v)) <= TURN:
        return False
    on, back = cross(step, v) / cross(u, v), cross(step, u) / cross(u, v)
    return min(on, back) >= -EPS and max(on, back) <= reach + EPS


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
    drop = np.abs(depth_at(drawing, rows, share_of(near, place)) - depth)
    return bool(np.any((shapely.distance(near, place) <= coincide + EPS) & (drop <= coincide + EPS)))


def share_of(lines: Any, place: shapely.Point) -> Any:
    with np.errstate(invalid="ignore"):  # a segment without length has no share; some versions of GEOS warn of it
        return shapely.line_locate_point(lines, place, normalized=True)


def depth_at(drawing: Drawing, rows: NDArray[np.intp], share: NDArray[np.float64]) -> NDArray[np.float64]:
    share = np.nan_to_num(share)
    return drawing.z[0, rows] * (1 - share) + drawing.z[1, rows] * share


def _last_meeting(
    drawing: Drawing, way: NDArray[np.float64], around: NDArray[np.intp], coincide: float, reach: float
) -> tuple[float, frozenset[int]]:
    run, found = 0.0, [(np.inf, -1)]
    for start, end in pairwise(way):
        length = float(np.hypot(*(end - start)[:2]))
        beyond = reach + 2 * coincide + EPS
        if run >= beyond:
            break
        share = min(1.0, (beyond - run) / length) if length else 1.0
        stop = start + (end - start) * share
        piece = shapely.LineString([start[:2], stop[:2]])
        for row in around[shapely.distance(drawing.flat[around], piece) <= coincide + EPS]:
            met = _meeting(piece, (start[2], stop[2]), drawing.flat[row], drawing.z[:, row], coincide)
            found.append((run + met, int(drawing.piece[row])))
        run += length
    least = min(found)[0]
    return least, frozenset(line for met, line in found if met <= least + EPS)


def _crossing(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Where two segments cross or touch; of those that are nearly parallel it is not well placed."""
    one, two = a[1] - a[0], b[1] - b[0]
    size = np.hypot(*one), np.hypot(*two)
    if abs(cross(one, two)) <= 1e-3 * size[0] * size[1]:
        return None
    on, back = cross(b[0] - a[0], two) / cross(one, two), cross(b[0] - a[0], one) / cross(one, two)
    touched = all(-EPS <= share * length <= length + EPS for share, length in zip((on, back), size, strict=True))
    return a[0] + one * min(max(on, 0.0), 1.0) if touched else None


def _meeting(
    a: shapely.Geometry, za: tuple[float, float], b: shapely.Geometry, zb: NDArray[np.float64], coincide: float
) -> float:
    """Length along a to the place where it meets b: the crossing, else the nearest end of either; inf if apart."""
    crossing = _crossing(*(shapely.get_coordinates(one) for one in (a, b)))
    ends = [shapely.get_point(a, 0), shapely.get_point(a, 1), shapely.get_point(b, 0), shapely.get_point(b, 1)]
    for candidates in ([shapely.Point(crossing)] if crossing is not None else [], ends):
        places = []
        for place in candidates:
            on_a, on_b = (share_of(line, place) for line in (a, b))
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
