# SPDX-License-Identifier: MIT
"""Twelve excavation plans that nobody here drew, against counts that nobody here made.

The shelf's README counts ends with a method of its own: the distance to the nearest segment that is not the chain's own
terminal segment or the one next to it. That method is worked out here again and must give the README's table. Then
every end at which foparq says something else must be one of those that ``docs/odagsen.md`` names, and must satisfy the
definition that the document gives as the reason, worked out by ``tests.geom.oracle``.
"""

import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from tests.geom.aims import ANYWHERE
from tests.geom.oracle import Drawing, chained, classify_one

from foparq.check.registry import all_rules
from foparq.findings.hits import Hits
from foparq.geom.ends import EndKind, classify_ends
from foparq.model.inputs import Lines, nameless
from foparq.model.items import Role
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf

pytestmark = pytest.mark.shared

COINCIDE, REACH, SAGITTA = 1e-6, 0.05, 0.0005
BINS = (COINCIDE, 0.001, 0.005, 0.01, REACH)
SHEETS = [
    "ODS1P101", "ODS1P102", "ODS1P106", "ODS1P615", "ODS2P126", "ODS2P429",
    "ODS2P636", "ODS2P734", "ODS4P154", "ODS4P155", "ODS4P366", "OS6P4147",
]  # fmt: skip
NAMED = {"connected": "connected", "undershoot": "near miss", "free": "free"}


class Row(NamedTuple):
    """One line of the README's table; lengths of bins summed."""

    chains: int
    open_ends: int
    touching: int
    near: int
    free: int
    rings: int
    duplicates: int
    not_simple: int


class Chains(NamedTuple):
    """Top-level linework of one sheet, all layers together, in the canonical order."""

    handle: NDArray[np.object_]
    geometry: NDArray[np.object_]

    @property
    def lines(self) -> Lines:
        return Lines(
            geometry=self.geometry, bounds=np.zeros(len(self.geometry), dtype=bool), **nameless(len(self.geometry))
        )


class Difference(NamedTuple):
    sheet: str
    handle: str
    end: str
    readme: str
    foparq: str
    because: str


@cache
def readme(folder: Path, sheet: str) -> Row:
    line = next(
        line for line in (folder / "README.md").read_text("utf-8").splitlines() if line.startswith(f"| {sheet}.DXF")
    )
    cell = [text.strip() for text in line.strip("|").split("|")]
    sums = [sum(map(int, text.split("/"))) if "/" in text else 0 for text in cell]
    whole = [int(text) if text.isdigit() else 0 for text in cell]
    return Row(whole[3], whole[6], whole[7], sums[8], whole[9], sums[11], int(cell[12].split("/")[1]), whole[13])


@cache
def chains(folder: Path, sheet: str) -> Chains:
    items = read_dxf(folder / f"{sheet}.DXF", limits=LimitsSpec(), sagitta=SAGITTA, unit=None, blocks="skip").items
    rows = np.flatnonzero((items.role == Role.LINE) & (shapely.length(items.geometry) > 0))
    rows = rows[np.argsort(items.item[rows].astype(str), kind="stable")]
    return Chains(items.handle[rows], shapely.force_2d(items.geometry[rows]))


def run(name: str, lines: Lines) -> Hits:
    record = next(record for record in all_rules().values() if record.name == name)
    stated = {"coincide": COINCIDE, "reach": REACH, **ANYWHERE._asdict()}
    return record.check(lines, **{key: stated[key] for key, _ in record.tolerances})


def readme_ends(sheet: Chains) -> dict[tuple[int, bool], float]:
    """Distance of every open end by the README's method."""
    drawing = Drawing([shapely.get_coordinates(shape) for shape in sheet.geometry])
    found = {}
    for n, line in enumerate(drawing.lines):
        if np.hypot(*(line[0] - line[-1])[:2]) <= COINCIDE:
            continue
        for last, own in ((False, (0, 1)), (True, (len(line) - 2, len(line) - 3))):
            others = ~((drawing.own == n) & np.isin(drawing.pos, own))
            place = shapely.Point(line[-1 if last else 0, :2])
            found[n, last] = float(shapely.distance(place, drawing.flat[others]).min(initial=np.inf))
    return found


def readme_says(distance: float) -> str:
    return "connected" if distance <= COINCIDE else "undershoot" if distance <= REACH else "free"


def opening(sheet: Chains) -> NDArray[np.float64]:
    gap: NDArray[np.float64] = shapely.distance(
        shapely.get_point(sheet.geometry, 0), shapely.get_point(sheet.geometry, -1)
    )
    return gap


def undirected(sheet: Chains) -> list[bytes]:
    """Chains rounded to 10 micrometres, as a set of vertices in one of two orders."""
    rounded = [np.round(shapely.get_coordinates(shape) * 1e5).astype(np.int64) for shape in sheet.geometry]
    return [min(way.tobytes(), way[::-1].tobytes()) for way in rounded]


@pytest.fixture(scope="module")
def folder(shared: Path) -> Path:
    return shared / "data" / "drawings" / "odagsen"


@pytest.mark.parametrize("sheet", SHEETS)
def test_the_readme_counts_can_be_made_again(folder: Path, sheet: str) -> None:
    drawn, row = chains(folder, sheet), readme(folder, sheet)
    distances = np.array(list(readme_ends(drawn).values()))
    gap = opening(drawn)
    rings = (gap > COINCIDE) & (gap <= REACH) & (shapely.get_num_coordinates(drawn.geometry) >= 4)
    assert row == Row(
        chains=len(drawn.geometry),
        open_ends=len(distances),
        touching=int(np.count_nonzero(distances <= COINCIDE)),
        near=int(np.histogram(distances, BINS)[0].sum()),
        free=int(np.count_nonzero(distances > REACH)),
        rings=int(np.count_nonzero(rings)),
        duplicates=len(drawn.geometry) - len(set(undirected(drawn))),
        not_simple=int(np.count_nonzero(~shapely.is_simple(drawn.geometry))),
    )


def end_differences(sheet: str, drawn: Chains) -> list[Difference]:
    """Ends of which foparq says something else than the README, each with its reason; fails if there is none."""
    lines = drawn.lines
    kept = np.setdiff1d(np.arange(len(lines)), run("duplicate", lines).row)
    ends = classify_ends(lines.take(kept).polylines, ANYWHERE, coincide=COINCIDE, reach=REACH)
    ours = {
        (int(kept[line]), not forward): (EndKind(kind).name.lower(), float(size))
        for line, forward, kind, size in zip(ends.line, ends.forward, ends.kind, ends.size, strict=True)
    }
    ways = [shapely.get_coordinates(shape) for shape in drawn.geometry[kept]]
    followed = chained(ways, COINCIDE)
    found = []
    for (line, last), distance in readme_ends(drawn).items():
        said = readme_says(distance)
        kind, size = ours.get((line, last), ("set aside", 0.0))
        same = kind == said and (kind != "undershoot" or abs(size - distance) < 1e-7)
        if same:
            continue
        if kind == "set aside":
            reason = "copy"
            assert any(shapely.hausdorff_distance(drawn.geometry[line], drawn.geometry[k]) <= COINCIDE for k in kept)
        else:
            end = int(np.searchsorted(kept, line)), last
            reason = _reason(ways, followed, end, distance=distance, kind=kind, size=size)
        found.append(
            Difference(
                sheet, drawn.handle[line], "last" if last else "first", _said(said, distance), _said(kind, size), reason
            )
        )
    return found


def _reason(
    ways: list[NDArray[np.float64]], followed: tuple[Drawing, dict[tuple[int, bool], int]], end: tuple[int, bool], *,
    distance: float, kind: str, size: float,
) -> str:  # fmt: skip
    """Why an end differs, told from the definitions alone."""
    true = classify_one(ways, followed, end, coincide=COINCIDE, reach=REACH)
    single, line = followed[0], followed[1][end]
    place = ways[end[0]][-1 if end[1] else 0]
    last = bool(np.any(single.lines[line][0][:2] != place))
    assert (true.kind, pytest.approx(true.size, abs=1e-7)) == (kind, size), "foparq departs from its own definition"
    place = shapely.Point(single.walked(line, last=last)[0, :2])
    others = single.others(line, last=last, reach=REACH, coincide=COINCIDE)
    clear = float(shapely.distance(place, single.flat[others]).min(initial=np.inf))
    own = np.setdiff1d(np.flatnonzero(single.own == line), others)
    if clear > distance + 1e-9:
        # The README's nearest segment belongs to the chain itself, which has not left the circle of 5 cm before it.
        assert float(shapely.distance(place, single.flat[own]).min()) <= distance + 1e-9
        return "own part" if kind != "overshoot" else "own part, crossing"
    assert kind == "overshoot"
    return "crossing"


def _said(kind: str, size: float) -> str:
    text = NAMED.get(kind, kind)
    return f"{text} {size * 1000:.3f} mm" if kind in {"undershoot", "overshoot"} else text


def documented(repository: Path) -> set[Difference]:
    lines = (repository / "docs" / "odagsen.md").read_text("utf-8").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if re.match(r"\| O", line)]
    return {Difference(*cell) for cell in cells if len(cell) == len(Difference._fields)}


@pytest.mark.parametrize("sheet", SHEETS)
def test_every_end_that_differs_is_named_and_explained(folder: Path, repository: Path, sheet: str) -> None:
    found = end_differences(sheet, chains(folder, sheet))
    assert set(found) == {row for row in documented(repository) if row.sheet == sheet and row.end in {"first", "last"}}


@pytest.mark.parametrize("sheet", SHEETS)
def test_undershoots_and_free_ends_are_the_readmes_but_for_those_ends(folder: Path, sheet: str) -> None:
    drawn, row = chains(folder, sheet), readme(folder, sheet)
    lines = drawn.lines
    single = lines.take(np.setdiff1d(np.arange(len(lines)), run("duplicate", lines).row))
    moved = end_differences(sheet, drawn)
    for name, count, word in (("undershoot", row.near, "near miss"), ("free-end", row.free, "free")):
        gone = sum(difference.readme.startswith(word) for difference in moved)
        come = sum(difference.foparq.startswith(word) for difference in moved)
        assert len(run(name, single)) == count - gone + come


@pytest.mark.parametrize("sheet", SHEETS)
def test_rings_duplicates_and_self_intersections(folder: Path, repository: Path, sheet: str) -> None:
    drawn, row = chains(folder, sheet), readme(folder, sheet)
    more = [difference for difference in documented(repository) if difference.sheet == sheet]

    rings = run("open-ring", drawn.lines)
    exact = {difference.handle for difference in more if difference.because == "exactly at reach"}
    assert len(rings) == row.rings + len(exact)
    for n in np.flatnonzero(np.isin(drawn.handle[rings.row], sorted(exact))):
        assert REACH < opening(drawn)[rings.row[n]] < REACH + 1e-12

    copies = run("duplicate", drawn.lines)
    turned = {difference.handle for difference in more if difference.because == "ring from another start"}
    assert len(copies) == row.duplicates + len(turned)
    for n in np.flatnonzero(np.isin(drawn.handle[copies.row], sorted(turned))):
        pair = drawn.geometry[[copies.row[n], copies.other[n]]]
        # The same set of points and the same length, not the same sequence of vertices.
        assert shapely.equals(*pair)
        assert undirected(drawn)[copies.row[n]] != undirected(drawn)[copies.other[n]]

    crossed = set(run("self-intersection", drawn.lines).row.tolist())
    assert crossed == set(np.flatnonzero(~shapely.is_simple(drawn.geometry)).tolist())
    assert len(crossed) == row.not_simple
