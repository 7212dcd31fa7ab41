# SPDX-License-Identifier: MIT
"""Lines that bind or do not, on random drawings of the 0.1 mm grid, against a slow computation that knows no kernel."""

from itertools import combinations
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.check.rules.top.duplicate import duplicate
from foparq.check.rules.top.line_overlap import line_overlap
from foparq.check.rules.top.shared_edge import shared_edge
from foparq.findings.hits import Hits
from foparq.geom.repeats import drawn_again
from foparq.model.inputs import Lines, nameless
from foparq.model.layers import bonds

GRID = 0.0001
COINCIDE = GRID / 10  #: only what lies on the same cells is the same place, also where three segments may lack so much
LAYERS = ["PAREDE", "parede", "VAO_1", "VAO_2", "REBOCO"]
CLASSES = {"VAO_*": "janela"}
#: written down by hand: the first two have one name, the next two one class
BONDS = {"PAREDE": 1, "parede": 1, "VAO_1": 2, "VAO_2": 2, "REBOCO": 3}
BOUND = {**BONDS, "REBOCO": 1}


def ways(random: np.random.Generator) -> list[np.ndarray]:
    """Open lines of one to three steps along the axes, none of which meets itself."""
    made: list[np.ndarray] = []
    while len(made) < 14:
        steps = random.integers(1, 5, size=random.integers(1, 4)) * random.choice([-1, 1])
        axis = np.arange(len(steps)) + random.integers(2)
        vertices = np.cumsum(np.vstack([random.integers(0, 5, 2), np.eye(2, dtype=int)[axis % 2] * steps[:, None]]), 0)
        if shapely.LineString(vertices).is_simple:
            made.append(vertices)
        if made and random.random() < 0.3:
            made.append(made[random.integers(len(made))][:: random.choice([-1, 1])])
    return made


def columns(lines: list[np.ndarray], layers: list[str], bind: tuple[tuple[str, ...], ...]) -> Lines:
    shapes = np.empty(len(lines), dtype=object)
    shapes[:] = [shapely.LineString(way * GRID) for way in lines]
    named = {**nameless(len(lines)), "layer": np.array(layers, dtype=object)}
    bond = bonds(named["layer"], CLASSES, bind)
    return Lines(geometry=shapes, bounds=np.zeros(len(lines), dtype=bool), bond=bond, **named)


def truth(lines: list[np.ndarray], layers: list[str], bond: dict[str, int]) -> tuple[set[int], Any, Any]:
    """Copies, and pairs that share a length, within what binds and beyond: by unit edges of whole cells."""
    edges = []
    for way in lines:
        mine = set()
        for (x0, y0), (x1, y1) in zip(way[:-1].tolist(), way[1:].tolist(), strict=True):
            n = abs(x1 - x0) + abs(y1 - y0)
            dx, dy = (x1 - x0) // n, (y1 - y0) // n
            mine |= {frozenset({(x0 + k * dx, y0 + k * dy), (x0 + (k + 1) * dx, y0 + (k + 1) * dy)}) for k in range(n)}
        edges.append(frozenset(mine))
    seen: dict[Any, int] = {}
    copies = {n for n in range(len(lines)) if seen.setdefault((edges[n], bond[layers[n]]), n) != n}
    within, beyond = {}, {}
    for one, two in combinations([n for n in range(len(lines)) if n not in copies], 2):
        if common := len(edges[one] & edges[two]):
            pairs = within if bond[layers[one]] == bond[layers[two]] else beyond
            pairs[frozenset({one, two})] = common
    return copies, within, beyond


def pairs_of(hits: Hits, rows: np.ndarray) -> dict[frozenset[int], int]:
    named = [frozenset({int(rows[a]), int(rows[b])}) for a, b in zip(hits.row, hits.other, strict=True)]
    assert len(set(named)) == len(named), "a pair is told once"
    return dict(zip(named, np.rint(hits.size / GRID).astype(int).tolist(), strict=True))


@pytest.mark.parametrize("bind", [(), (("PAREDE", "REBOCO"),)], ids=["by default", "bound"])
@pytest.mark.parametrize("block", range(4))
def test_every_pair_is_told_as_it_should(block: int, bind: tuple[tuple[str, ...], ...]) -> None:
    for seed in range(100 * block, 100 * block + 100):
        random = np.random.default_rng(seed)
        lines = ways(random)
        layers = random.choice(LAYERS[: random.integers(2, 6)], len(lines)).tolist()
        table = columns(lines, layers, bind)
        copies, within, beyond = truth(lines, layers, BOUND if bind else BONDS)
        assert set(duplicate(table, coincide=COINCIDE).row.tolist()) == copies, seed
        rows = np.setdiff1d(np.arange(len(lines)), sorted(copies))
        kept = table.take(rows)
        assert pairs_of(line_overlap(kept, coincide=COINCIDE), rows) == within, seed
        shared = shared_edge(kept, coincide=COINCIDE)
        assert pairs_of(shared, rows) == beyond, seed
        length = shapely.length(kept.geometry)
        assert (length[shared.row] <= length[shared.other] + 1e-9).all(), "the shorter is named first"


@pytest.mark.parametrize("block", range(2))
def test_what_is_not_seen_is_drawn_by_what_stays(block: int) -> None:
    """Each line that is left out lies on lines of other layers that stay; none that lies on nothing is left out."""
    left = 0
    for seed in range(100 * block, 100 * block + 100):
        random = np.random.default_rng(seed)
        lines = ways(random)
        layers = random.choice(LAYERS, len(lines)).tolist()
        table = columns(lines, layers, ())
        kept = table.take(np.setdiff1d(np.arange(len(lines)), duplicate(table, coincide=COINCIDE).row))
        again = drawn_again(kept.polylines, kept.bounds, kept.bond, coincide=COINCIDE)
        whole, part = shapely.union_all(kept.geometry), shapely.union_all(kept.geometry[~again])
        assert abs(whole.length - part.length) < 1e-9, seed
        for n in np.flatnonzero(~again):
            others = [m for m in np.flatnonzero(~again) if kept.bond[m] != kept.bond[n]]
            covered = [shapely.covered_by(kept.geometry[n], kept.geometry[m].buffer(GRID / 10)) for m in others]
            assert not any(covered), seed
        left += int(again.sum())
    assert left > 40


def test_names_and_order_of_layers_change_no_count() -> None:
    for seed in range(100):
        random = np.random.default_rng(seed)
        lines = ways(random)
        layers = random.choice(LAYERS, len(lines)).tolist()
        renamed = [{"PAREDE": "ZZ", "parede": "zz", "REBOCO": "AA"}.get(name, name) for name in layers]
        order = random.permutation(len(lines))
        told = []
        for some, names in ((lines, layers), ([lines[n] for n in order], [renamed[n] for n in order])):
            table = columns(some, names, ())
            copies = duplicate(table, coincide=COINCIDE)
            kept = table.take(np.setdiff1d(np.arange(len(some)), copies.row))
            told.append([sorted(np.rint(hits.size / GRID).tolist()) for hits in (
                copies, line_overlap(kept, coincide=COINCIDE), shared_edge(kept, coincide=COINCIDE)
            )])  # fmt: skip
        assert told[0] == told[1], seed
