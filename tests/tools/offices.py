# SPDX-License-Identifier: MIT
"""Sound deliveries as small offices send them, made from a seed, with everything that is true of them beside.

``office(seed)`` draws a facade, surveys it and fills the tables; ``office_files.write`` makes a folder of it.
Lengths are metres, places in the axes of the file. Delivered coordinates are those of the drawing; the survey differs
from them by the errors of both, drawn from normal distributions, drawn again where the specification's own test of
trend, which rejects one faultless axis in twenty, would reject them.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy import stats
from tests.tools.facades import LAYERS, Facade, facade, lonely

#: right, up, depth in the axes of the file
FRAMES = {
    "xy": np.eye(3),
    "xz": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "yz": np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]]),
}
METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "in": 0.0254, "ft": 0.3048}
_ALPHA = 0.1  #: significance of a trend that is drawn again; the specification rejects at 0.05, of rounded numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """How a spreadsheet writes a table."""

    name: str
    separator: str = ";"
    comma: bool = True  #: decimal sign
    encoding: str = "utf-8"
    quoted: bool = False
    trailing: bool = True  #: zeros at the end of a number are kept


STYLES = (
    Style(name="libreoffice-pt"),
    Style(name="excel-pt", encoding="cp1252", trailing=False),
    Style(name="excel-unicode", separator="\t", encoding="utf-16"),
    Style(name="excel-utf8", encoding="utf-8-sig"),
    Style(name="quoted", separator=",", quoted=True),
    Style(name="sheets-en", separator=",", comma=False),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A mark at a place that bears a name."""

    name: str
    place: np.ndarray  #: (3,)
    block: bool  #: an insert with an attribute; else a point with a text beside it


@dataclass(frozen=True, slots=True, kw_only=True)
class Office:
    """One delivery and the truth about it."""

    seed: int
    facade: Facade
    plane: str  #: ``xy``, ``xz``, ``yz``
    origin: np.ndarray  #: (3,) of the facade's lower left corner
    unit: str  #: of the drawing
    scale: int  #: denominator
    format: str  #: ``dxf`` or ``gpkg``
    version: str  #: ``R12``, ``R2000``, ``R2013``
    blocks: str  #: ``own``, ``scaled``, or ``""`` for loose lines
    layers: dict[str, str]  #: class to layer
    lettering: str  #: unit in which dimensions are lettered; ``""`` without dimensions
    title: bool  #: a title block states the scale
    axes: bool
    ids: list[str]
    surveyed: np.ndarray  #: (n, 3)
    drawn: np.ndarray  #: (n, 3) where the points are in the drawing
    told: bool  #: the table gives the delivered coordinates
    by_id: list[Target]
    ends: list[tuple[str, str]]  #: of the distances
    ends_by: str  #: ``checkpoints`` by id, ``places`` by coordinates, ``names`` only
    rows: list[tuple[int, int]]  #: of the ends among the points; empty if the ends are names only
    measured: np.ndarray  #: (m,)
    lengths: np.ndarray  #: (m,) delivered
    survey_sd: float
    product_sd: float
    distance_sd: float
    style: Style
    table_unit: str
    digits: int
    english: bool
    stated: dict[str, Any] = field(default_factory=dict)  #: of the manifest, where it is not what is true
    tamper: tuple[Any, ...] = ()  #: functions that change the written document
    delivered: np.ndarray | None = None  #: (n, 3) of the table, if not what is drawn
    confirmed: tuple[dict[str, str], ...] = ()
    header: int | None = None  #: $INSUNITS, if not that of the unit
    view_scale: float | None = None  #: of the viewport, if not the stated one
    title_scale: float | None = None
    letter_suffix: str = ""  #: behind the numbers of dimensions

    @property
    def flat(self) -> bool:
        """No depth is drawn."""
        return self.plane == "xy"

    @property
    def columns(self) -> np.ndarray:
        """(n, 3) delivered coordinates that the table states."""
        return self.drawn if self.delivered is None else self.delivered

    def place(self, sheet: np.ndarray) -> np.ndarray:
        """Places (n, 3) of sheet coordinates (n, 3)."""
        return self.origin + np.asarray(sheet, dtype=float) @ FRAMES[self.plane]

    def change(self, **changes: Any) -> "Office":
        """Another delivery."""
        return replace(self, **changes)

    def state(self, section: str, **values: Any) -> "Office":
        """Other statements in a section of the manifest."""
        return replace(self, stated={**self.stated, section: {**self.stated.get(section, {}), **values}})


def office(seed: int, **wanted: Any) -> Office:
    """A sound delivery.

    Parameters
    ----------
    seed : int
        The same seed and wishes give the same delivery.
    **wanted
        ``plane``, ``unit``, ``format``, ``told``, ``table_unit``, ``lettering``, ``n`` (points) ... in place of chance.
    """
    rng = np.random.default_rng([seed, 20])
    chosen = _chosen(rng) | wanted
    scale, flat = chosen["scale"], chosen["plane"] == "xy"
    drawn = facade(rng, relief=not flat)
    origin = np.round(rng.uniform(0, 1, 3) * [120, 120, 25] + [5, 5, 2], 2)
    if flat:
        origin[2] = 0.0
    places = lambda sheet: origin + np.asarray(sheet) @ FRAMES[chosen["plane"]]  # noqa: E731
    limit, fine = 0.0003 * scale, 0.0002 * scale
    product_sd = round(float(rng.uniform(0.1, 0.2) * limit), 5)
    survey_sd = round(float(rng.uniform(0.1, 0.28) * limit), 4)
    distance_sd = round(float(rng.uniform(0.1, 0.25) * fine), 4)
    marks, targets, ids = _points(rng, drawn, places, chosen, scale)
    n = len(marks)
    differences = _no_trend(rng, (n, 3), np.hypot(product_sd, survey_sd))
    at = marks.copy()
    if flat:  # depths are measured in the stereo model and written into the table alone
        at[:, 2] = np.round(rng.uniform(0.0, 0.4, n), 4)
    surveyed = at + differences
    ends, rows, lengths = _distances(rng, drawn, at, ids, chosen, flat=flat)
    measured = lengths + rng.normal(0.0, np.hypot(distance_sd, np.sqrt(2) * product_sd), len(lengths))
    return Office(
        seed=seed, facade=drawn, origin=origin, ids=ids, surveyed=surveyed, drawn=at, by_id=targets, ends=ends,
        rows=rows, measured=measured, lengths=lengths, survey_sd=survey_sd, product_sd=product_sd,
        distance_sd=distance_sd, **{name: value for name, value in chosen.items() if name not in _OF_MAKING},
    )  # fmt: skip


_OF_MAKING = {"n", "targets"}


def _chosen(rng: np.random.Generator) -> dict[str, Any]:
    """What an office does by habit."""
    pick = lambda *values: values[int(rng.integers(len(values)))]  # noqa: E731
    made: dict[str, Any] = {
        "plane": pick("xy", "xz", "xz", "yz"), "unit": pick("m", "m", "cm", "mm"), "format": pick("dxf", "dxf", "gpkg"),
        "version": pick("R12", "R2000", "R2013"), "blocks": pick("own", "scaled", ""),
        "layers": LAYERS[int(rng.integers(2))], "lettering": pick("", "m", "cm", "mm"), "title": bool(pick(0, 1, 1)),
        "axes": bool(pick(0, 1)), "scale": pick(20, 25, 50, 50, 75, 100), "told": bool(pick(0, 1, 1)),
        "style": STYLES[int(rng.integers(len(STYLES)))], "table_unit": pick("m", "m", "m", "mm", "cm"),
        "english": bool(pick(0, 0, 1)), "n": int(rng.integers(7, 31)), "targets": pick("", "", "point", "block"),
        "ends_by": pick("checkpoints", "places", "names"),
    }  # fmt: skip
    made["digits"] = {"m": pick(3, 4, 4), "cm": 2, "mm": 1}[made["table_unit"]]
    if made["format"] == "gpkg":
        made |= {"blocks": "", "targets": ""}
    if made["plane"] == "xy" and not pick(0, 0, 0, 0, 1):
        made["told"] = True  # a flat drawing delivers no depth: few forget to state it
    return made


def _points(
    rng: np.random.Generator, drawn: Facade, places: Any, chosen: dict[str, Any], scale: int
) -> tuple[np.ndarray, list[Target], list[str]]:
    """Places of checkpoints in the drawing, the marks among them, and their ids."""
    alone = places(lonely(drawn.corners(), 0.0025 * scale, deep=chosen["plane"] != "xy"))
    n = min(chosen["n"], len(alone))
    at = np.round(alone[np.sort(rng.choice(len(alone), n, replace=False))], 4)
    form = ("P{:02d}", "{}", "JAN-N-{:02d}.PE", "V{:03d}")[int(rng.integers(4))]
    ids = [form.format(number + 1) for number in range(n)]
    if not chosen["targets"]:
        return at, [], ids
    # Marks on the wall between two columns, where nothing is drawn.
    free = [(b + a) / 2 + 0.07 for (_, b), (a, _) in zip(drawn.columns, drawn.columns[1:], strict=False)]
    count = min(n, len(free)) if chosen["told"] else min(n // 2, len(free))
    spots = np.array([(u, 0.9 + 0.13 * k, 0.0) for k, u in enumerate(free[:count])]).reshape(-1, 3)
    at[:count] = np.round(places(spots), 4)
    targets = [Target(name=ids[k], place=at[k], block=chosen["targets"] == "block") for k in range(count)]
    return at, targets, ids


def _no_trend(rng: np.random.Generator, shape: tuple[int, int], sd: float) -> np.ndarray:
    """Normal errors (n, 3) in which no axis has a significant mean."""
    columns = []
    while len(columns) < shape[1]:
        column = rng.normal(0.0, sd, shape[0])
        if stats.ttest_1samp(column, 0.0).pvalue > _ALPHA and np.sqrt(np.mean(column**2)) < 1.3 * sd:
            columns.append(column)
    return np.column_stack(columns)


def _distances(
    rng: np.random.Generator, drawn: Facade, at: np.ndarray, ids: list[str], chosen: dict[str, Any], *, flat: bool
) -> tuple[list[tuple[str, str]], list[tuple[int, int]], np.ndarray]:
    """Names of the ends, rows of the ends among the points, and lengths in the drawing."""
    n, count = len(at), int(rng.integers(5, 13))
    pairs = [(a, b) for a in range(n) for b in range(a + 1, n)]
    step = np.array([at[b] - at[a] for a, b in pairs])
    length = np.linalg.norm(step[:, :2] if flat else step, axis=1)
    usable = np.flatnonzero(length > 0.5)
    if chosen["ends_by"] == "names":  # widths of openings, by tape
        wide = [part.ring[1][0] - part.ring[0][0] for part in drawn.parts if part.kind in {"window", "door"}]
        rows = rng.choice(len(wide), min(count, len(wide)), replace=False)
        names = [(f"J{row:02d} esq.", f"J{row:02d} dir.") for row in rows.tolist()]
        return names, [], np.array(wide)[rows]
    rows = usable[np.sort(rng.choice(len(usable), min(count, len(usable)), replace=False))]
    chosen_pairs = [pairs[row] for row in rows.tolist()]
    return [(ids[a], ids[b]) for a, b in chosen_pairs], chosen_pairs, length[rows]
