# SPDX-License-Identifier: MIT
"""What ends are together, worked out one pair at a time: corners short of a line, rows of dashes, ends that head on."""

from itertools import combinations, product
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from tests.geom import oracle
from tests.geom.oracle import EPS, TURN, Aim, Drawing, Followed, aims, chained, closes, cross, depth_at, share_of

Line = NDArray[np.float64]
FEWEST, ALIKE, LONGEST = 5, 0.2, 12.0


class Told(NamedTuple):
    """One finding: lines that may bear its name, its size, lines that may be the other one."""

    lines: frozenset[int]
    size: float
    others: frozenset[int]


class AmbiguousError(Exception):
    """The definition leaves it open, because two distances are equal."""


def short_corners(lines: list[Line], *, coincide: float, reach: float, aim: Aim) -> list[Told]:
    """Nodes of ends that meet only each other and are no line that goes on, short of a line that does not end there."""
    drawing = Drawing(lines)
    deep = drawing.lines
    ends = [
        (n, last) for n, line in enumerate(deep) for last in (False, True)
        if np.linalg.norm(line[0] - line[-1]) > coincide + EPS
    ]  # fmt: skip
    place = {end: deep[end[0]][-1 if end[1] else 0] for end in ends}
    node = {end: {end} for end in ends}
    for one, two in combinations(ends, 2):
        step = place[one] - place[two]
        if np.hypot(*step[:2]) <= coincide + EPS and abs(step[2]) <= coincide + EPS and node[one] is not node[two]:
            node[one] |= node[two]
            for member in node[two]:
                node[member] = node[one]
    told = []
    for members in {id(group): group for group in node.values() if len(group) > 1}.values():
        third = np.flatnonzero(~np.isin(drawing.own, [line for line, _ in members]))
        first = place[min(members)]
        near = drawing.flat[third]
        flat = shapely.distance(near, shapely.Point(first[:2]))
        drop = np.abs(depth_at(drawing, third, share_of(near, shapely.Point(first[:2]))) - first[2])
        if np.any((flat <= 2 * coincide + EPS) & (drop <= 2 * coincide + EPS)):
            continue
        if len(members) == 2:
            u, v = (aims(drawing.walked(line, last=last), coincide, reach)[0] for line, last in members)
            if -float(u @ v) > np.cos(aim.alongside):
                continue
        missed = [hit for end in members for hit in _before(drawing, end, third, coincide, reach, aim)]
        if missed:
            least = min(missed)[0]
            length = {line: float(np.hypot(*np.diff(deep[line][:, :2], axis=0).T).sum()) for line, _ in members}
            named = frozenset(line for line in length if length[line] >= max(length.values()) - EPS)
            told.append(Told(named, least, frozenset(line for size, line in missed if size <= least + EPS)))
    return told


def _before(
    drawing: Drawing, end: tuple[int, bool], third: NDArray[np.intp], coincide: float, reach: float, aim: Aim
) -> list[tuple[float, int]]:
    way = drawing.walked(end[0], last=end[1])
    at, hits = way[0], []
    for row in third:
        start, stop = shapely.get_coordinates(drawing.flat[row])
        share = np.nan_to_num(share_of(drawing.flat[row], shapely.Point(at[:2])))
        target = start + (stop - start) * share
        drop = drawing.z[0, row] * (1 - share) + drawing.z[1, row] * share - at[2]
        missed = float(np.hypot(np.hypot(*(target - at[:2])), drop))
        heads = aims(way, coincide, reach)
        if missed <= reach + EPS and any(
            oracle.lies_ahead(u, at[:2], target, start, stop, coincide, reach, aim) for u in heads
        ):
            hits.append((missed, int(drawing.own[row])))
    return hits


class _Loose(NamedTuple):
    end: tuple[int, bool]
    way: Followed
    heads: list[NDArray[np.float64]]

    @property
    def place(self) -> NDArray[np.float64]:
        return self.way.way[0]


def _loose(lines: list[Line], coincide: float, reach: float, aim: Aim) -> tuple[Drawing, list[_Loose]]:
    """Ends of chains that are not connected."""
    drawing, free = chained(lines, coincide)
    deep = Drawing(lines).lines
    ways = {end: oracle.follow(drawing, chain, deep, end, coincide, reach, aim) for end, chain in free.items()}
    loose = [
        _Loose(end, way, aims(way.way, coincide, reach)) for end, way in ways.items()
        if way.settled is None or way.settled.kind == "overshoot"
    ]  # fmt: skip
    return drawing, loose


def dash_rows(lines: list[Line], *, coincide: float, reach: float, aim: Aim) -> set[frozenset[int]]:
    """Chains, by the lines they are made of, that are rows of dashes."""
    drawing, loose = _loose(lines, coincide, reach, aim)
    candidates: dict[int, list[tuple[float, int]]] = {n: [] for n in range(len(loose))}
    for i, j in combinations(range(len(loose)), 2):
        one, two = loose[i], loose[j]
        if one.way.chain != two.way.chain and (apart := _heads(one, two, coincide, reach, aim)) is not None:
            candidates[i].append((apart, j))
            candidates[j].append((apart, i))
    nearest = {}
    for i, found in candidates.items():
        least = min(found, default=None)
        if least is not None and sum(apart <= least[0] + EPS for apart, _ in found) > 1:
            raise AmbiguousError
        nearest[i] = least
    length = {one.way.chain: float(np.hypot(*np.diff(one.way.way[:, :2], axis=0).T).sum()) for one in loose}
    chain = [one.way.chain for one in loose]
    joined = {
        (i, least[1]): least[0] for i, least in nearest.items()
        if least is not None and nearest[least[1]] is not None and nearest[least[1]][1] == i
        and max(length[chain[i]], length[chain[least[1]]]) <= LONGEST * least[0] + EPS
    }  # fmt: skip
    for row in _rows(joined, chain):
        gaps = sorted(gap for (i, j), gap in joined.items() if chain[i] in row)
        usual = gaps[len(gaps) // 2] if gaps else 0.0
        for pair in [pair for pair, gap in joined.items() if chain[pair[0]] in row]:
            if abs(joined[pair] - usual) > ALIKE * usual:
                del joined[pair]
    found = set()
    for row in _rows(joined, chain):
        inner = [length[one] for one in row[1:-1]]
        for period in (1, 2, 3):
            alike = all(abs(a - b) <= ALIKE * max(a, b) for a, b in zip(inner, inner[period:], strict=False))
            if alike and len(row) >= max(FEWEST, 2 * period + 2) and not _cut(drawing, row, joined, loose, coincide):
                owners = [drawing.piece[drawing.own == one] for one in row]
                found.add(frozenset(np.concatenate(owners).tolist()))
    return found


def _cut(
    drawing: Drawing, row: list[int], joined: dict[tuple[int, int], float], loose: list[_Loose], coincide: float
) -> bool:
    """Whether other linework cuts the row: in most of its gaps and at few of its dashes, or most ends go beyond."""
    gaps = [(i, j) for i, j in joined if loose[i].way.chain in row]
    over = sum(loose[i].way.settled is not None for i, _ in gaps)
    held = 0
    for gap in gaps:
        between = shapely.LineString([loose[n].place[:2] for n in gap])
        held += _is_met(drawing, between, {loose[n].way.chain for n in gap}, coincide)
    met = sum(_is_met(drawing, shapely.LineString(drawing.lines[one][:, :2]), {one}, coincide) for one in row)
    return 2 * over > len(gaps) or (2 * held > len(gaps) and 2 * met < len(row))


def _is_met(drawing: Drawing, way: shapely.LineString, own: set[int], coincide: float) -> bool:
    other = ~np.isin(drawing.own, [*own, *drawing.strokes(coincide)])
    return bool(np.any(shapely.distance(drawing.flat[other], way) <= coincide + EPS))


def _heads(one: _Loose, two: _Loose, coincide: float, reach: float, aim: Aim) -> float | None:
    """Distance of two ends that head for each other."""
    step = two.place - one.place
    flat = float(np.hypot(*step[:2]))
    apart = float(np.hypot(flat, step[2]))
    if apart > reach + EPS:
        return None
    for u, v in product(one.heads, two.heads):
        before = min(float(step[:2] @ u), float(-step[:2] @ v))
        facing = u @ v < -TURN and before >= -coincide - EPS
        in_line = max(abs(cross(u, step[:2])), abs(cross(v, step[:2]))) <= coincide + EPS
        if facing and u @ v <= -np.cos(aim.alongside) and (before >= np.cos(aim.alongside) * flat or in_line):
            return apart
    return None


def _rows(joined: dict[tuple[int, int], float], chain: list[int]) -> list[list[int]]:
    """Chains in order, row by row; rings of dashes come last and begin at their lowest chain."""
    ends: dict[int, list[int]] = {}
    for i, one in enumerate(chain):
        ends.setdefault(one, []).append(i)
    mate = dict(joined.keys())
    rows, used = [], set()
    starts = [(one, i) for one, own in ends.items() for i in own if i not in mate]
    for one, free in [*starts, *((one, own[0]) for one, own in sorted(ends.items()))]:
        row, here, entered = [], one, free
        while here not in used:
            row.append(here)
            used.add(here)
            leaving = [i for i in ends[here] if i != entered and i in mate]
            if not leaving:
                break
            entered = mate[leaving[0]]
            here = chain[entered]
        if row:
            rows.append(row)
    return rows


def heads(
    lines: list[Line], *, coincide: float, reach: float, heading: float, aim: Aim
) -> dict[tuple[int, bool], Told]:
    """Free ends that meet a line if drawn on, or close a corner with another free end."""
    drawing, loose = _loose(lines, coincide, reach, aim)
    kinds = {
        (end.line, end.last): end.kind for end in oracle.classify_all(lines, coincide=coincide, reach=reach, aim=aim)
    }
    free = [one for one in loose if kinds[one.end] in ("free", "beside")]
    told = {}
    for one in free:
        hits = [hit for u in one.heads for hit in _met(drawing, one, u, coincide, heading, aim)]
        for two in free:
            step = two.place - one.place
            if two.way.chain != one.way.chain and abs(step[2]) <= heading + EPS:
                hits += [
                    (cross(step[:2], v) / cross(u, v), two.end[0])
                    for u, v in product(one.heads, two.heads) if closes(u, v, step[:2], heading)
                ]  # fmt: skip
        least = min(hits, default=(np.inf, 0))[0]
        if hits and least <= min(_in_line(drawing, one, u, coincide, aim) for u in one.heads) + EPS:
            own = one.way.way
            gap, length = float(np.linalg.norm(own[0] - own[-1])), float(np.hypot(*np.diff(own[:, :2], axis=0).T).sum())
            if gap < least and length >= aim.remainder * gap - EPS:
                ends_of_chain = np.flatnonzero(drawing.own == one.way.chain)[[0, -1]]
                least, hits = gap, [(gap, int(drawing.piece[ends_of_chain[0 if one.way.last else -1]]))]
            told[one.end] = Told(frozenset([one.end[0]]), least, frozenset(n for on, n in hits if on <= least + EPS))
    return told


def _in_line(drawing: Drawing, one: _Loose, u: NDArray[np.float64], coincide: float, aim: Aim) -> float:
    """Distance to the first segment that goes the same way and whose nearest place lies straight ahead."""
    found = [np.inf]
    for row in one.way.around:
        start, stop = shapely.get_coordinates(drawing.flat[row])
        target = start + (stop - start) * np.nan_to_num(share_of(drawing.flat[row], shapely.Point(one.place[:2])))
        step = target - one.place[:2]
        turned = abs(cross(u, stop - start)) >= np.sin(aim.alongside) * np.hypot(*(stop - start))
        if not turned and step @ u > 0 and abs(cross(u, step)) <= coincide + EPS:
            found.append(float(step @ u))
    return min(found)


def _met(
    drawing: Drawing, one: _Loose, u: NDArray[np.float64], coincide: float, heading: float, aim: Aim
) -> list[tuple[float, int]]:
    hits = []
    for row in one.way.around:
        start, stop = shapely.get_coordinates(drawing.flat[row])
        along, between = stop - start, start - one.place[:2]
        length = float(np.hypot(*along))
        turned = cross(u, along)
        if length <= EPS or abs(turned) < max(np.sin(aim.alongside) * length - EPS, TURN * length):
            continue
        on, at = cross(between, along) / turned, cross(between, u) / turned * length
        if 0 <= on <= heading + EPS and -coincide - EPS <= at <= length + coincide + EPS:
            share = min(max(at / length, 0.0), 1.0)
            drop = abs(drawing.z[0, row] * (1 - share) + drawing.z[1, row] * share - one.place[2])
            if drop <= heading + EPS:
                hits.append((on, int(drawing.piece[row])))
    return hits
