# SPDX-License-Identifier: MIT
"""An elevation of some 3,000 items without a fault: what draughtsmen draw that looks like one, and is none.

Ashlar that adjoins, sills under windows, mouldings cut side by side at one break line, dashes of an exploded line
type, bars that end on frames and arcs, balusters and survey marks in blocks, axes that cross everything. Lengths in
metres, to be drawn at 1:50.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pyogrio
import shapely
from ezdxf.math import bulge_to_arc
from numpy.typing import NDArray

Points = NDArray[np.float64]

WIDTH, HEIGHT = 48.0, 15.0
COLUMNS, FLOORS = 24, 3
SAGITTA = 0.00005  #: of arcs written as chords
ASHLAR = "CANTARIA"
JOINT = 0.4  #: width and height of a stone


@dataclass(slots=True)
class Stroke:
    """One line: straight, of several vertices, or an arc between two."""

    layer: str
    points: Points
    closed: bool = False
    bulge: float = 0.0  #: of the only segment, as DXF has it
    part: str = ""  #: what it is of the building

    def line(self) -> shapely.LineString:
        """As chords not farther than ``SAGITTA`` from the arc."""
        if self.bulge:
            return shapely.LineString(_chords(self.points, self.bulge))
        return shapely.LineString([*self.points, *self.points[:1]] if self.closed else self.points)


@dataclass(slots=True)
class Elevation:
    """Strokes, and the blocks that are placed among them."""

    strokes: list[Stroke] = field(default_factory=list)
    blocks: dict[str, list[Stroke]] = field(default_factory=dict)
    places: list[tuple[str, str, Points]] = field(default_factory=list)  #: block, layer, places (n, 2)

    def draw(
        self, layer: str, *points: tuple[float, float], part: str = "", closed: bool = False, bulge: float = 0.0
    ) -> None:
        """Add a stroke."""
        self.strokes.append(Stroke(layer, np.array(points, dtype=float), closed, bulge, part))

    def of(self, part: str) -> list[Stroke]:
        """Strokes of one kind."""
        return [stroke for stroke in self.strokes if stroke.part == part]

    def placed(self) -> Iterator[tuple[str, list[shapely.LineString]]]:
        """Layer and lines of every block that is placed."""
        for name, layer, places in self.places:
            for at in places:
                yield layer, [shapely.transform(stroke.line(), lambda c, at=at: c + at) for stroke in self.blocks[name]]

    def __len__(self) -> int:
        return len(self.strokes) + sum(len(self.blocks[name]) * len(places) for name, _, places in self.places)


def elevation(seed: int) -> Elevation:
    """The elevation, its measures taken at random."""
    rng = np.random.default_rng(seed)
    made = Elevation()
    made.draw("PAREDE", (0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT), closed=True)
    _ashlar(made, 4)
    for floor in range(FLOORS):
        for column in range(COLUMNS):
            _window(made, 0.5 + 2.0 * column, 2.2 + 4.2 * floor, rng)
    for floor in (1, 2):
        _mouldings(made, 1.75 + 4.2 * floor, rng)
    for row in range(8):
        _dashes(made, 1.68 + 0.04 * row, 80)
    _pediment(made)
    _balustrade(made)
    _marks(made, rng)
    for number in range(0, COLUMNS, 3):
        x = 2.0 + 2.0 * number
        made.draw("EIXO", (x, -1.5), (x, HEIGHT + 4.0))
    return made


def _ashlar(made: Elevation, courses: int) -> None:
    """Stones in running bond from the ground up."""
    for course in range(courses):
        y = course * JOINT
        edges = np.arange(0.0, WIDTH + 1e-9, JOINT)
        if course % 2:
            edges = np.concatenate([[0.0], edges[:-1] + JOINT / 2, [WIDTH]])
        for left, right in pairwise(edges.tolist()):
            inside = left > 0 and right < WIDTH
            box(made, ASHLAR, left, y, right - left, JOINT, part=f"stone of course {course}" if inside else "end stone")


def _window(made: Elevation, x: float, y: float, rng: np.random.Generator) -> None:
    width, height = 1.0, round(float(rng.uniform(1.5, 1.8)), 4)
    box(made, "JANELA", x, y, width, height, part="frame")
    sash = round(float(rng.uniform(0.05, 0.07)), 4)
    left, right, low, top = x + sash, x + width - sash, y + sash, y + height - sash
    box(made, "JANELA", left, low, right - left, top - low, part="sash")
    middle = x + width / 2
    made.draw("JANELA", (middle, low), (middle, top), part="mullion")
    for rail in low + (top - low) * np.array([0.25, 0.5, 0.75]):
        made.draw("JANELA", (left, rail), (middle, rail), part="left rail")
        made.draw("JANELA", (middle, rail), (right, rail), part="right rail")
    box(made, "PEITORIL", x - 0.1, y - 0.12, width + 0.2, 0.12, part="sill")
    _arch(made, middle, y + height, width / 2, 0.14)


def _arch(made: Elevation, x: float, y: float, radius: float, thick: float) -> None:
    """Two half circles and the joints between their stones."""
    outer = radius + thick
    made.draw("VERGA", (x + radius, y), (x - radius, y), bulge=1.0, part="intrados")
    made.draw("VERGA", (x + outer, y), (x - outer, y), bulge=1.0, part="extrados")
    for side in (-1, 1):
        made.draw("VERGA", (x + side * radius, y), (x + side * outer, y), part="springing")
    for angle in np.radians([30, 60, 90, 120, 150]):
        way = np.array([np.cos(angle), np.sin(angle)])
        made.draw("VERGA", *(tuple(np.array([x, y]) + way * r) for r in (radius, outer)), part="voussoir joint")


def _mouldings(made: Elevation, y: float, rng: np.random.Generator) -> None:
    """Edges 6 to 20 mm apart, cut at break lines left and right of every pier."""
    heights = y + np.cumsum(rng.uniform(0.006, 0.02, 10))
    for pier in range(6):
        left, right = 8.0 * pier + 0.3, 8.0 * pier + 7.7
        for height in np.round(heights, 5):
            made.draw("CIMALHA", (left, height), (right, height), part="moulding")


def _dashes(made: Elevation, y: float, count: int) -> None:
    """20 mm drawn, 8 mm left out."""
    for number in range(count):
        x = round(3.0 + 0.028 * number, 4)
        made.draw("PROJECAO", (x, y), (round(x + 0.02, 4), y), part="dash")


def _pediment(made: Elevation) -> None:
    left, right, apex = (16.0, HEIGHT), (32.0, HEIGHT), (24.0, HEIGHT + 3.2)
    made.draw("FRONTAO", left, apex, part="rake")
    made.draw("FRONTAO", apex, right, part="rake")
    _arch(made, 24.0, HEIGHT + 1.0, 0.45, 0.15)


def _balustrade(made: Elevation) -> None:
    """Two rails and, in a block, the two edges of a baluster that stand on them."""
    low, top = HEIGHT + 0.2, HEIGHT + 0.9
    for left, right in ((0.0, 14.0), (34.0, WIDTH)):
        for y in (low, top):
            made.draw("BALAUSTRADA", (left, y), (right, y), part="rail of the balustrade")
    swell = 0.03 * np.sin(np.linspace(0, np.pi, 15))
    edge = np.column_stack([0.06 + swell, np.linspace(0, top - low, 15)])
    made.blocks["BALAUSTRE"] = [Stroke("0", edge * [side, 1.0]) for side in (-1, 1)]
    xs = np.concatenate([np.arange(0.3, 13.8, 0.35), np.arange(34.3, WIDTH - 0.2, 0.35)])
    made.places.append(("BALAUSTRE", "BALAUSTRADA", np.column_stack([xs, np.full(len(xs), low)])))


def _marks(made: Elevation, rng: np.random.Generator) -> None:
    """Survey marks on the wall: crosses, and targets whose arms reach beyond their ring."""
    arm = 0.03
    cross = [Stroke("0", np.array([[-arm, 0.0], [arm, 0.0]])), Stroke("0", np.array([[0.0, -arm], [0.0, arm]]))]
    ring = [Stroke("0", np.array([[side * 0.02, 0.0], [-side * 0.02, 0.0]]), bulge=1.0) for side in (-1, 1)]
    made.blocks["CRUZ"] = cross
    made.blocks["ALVO"] = [*cross, *ring]
    grid = [(2.0 * column, 4.2 * floor) for column in range(COLUMNS) for floor in range(FLOORS)]
    spots = np.array(grid) + [0.15, 2.5] + rng.uniform(0, 0.05, (len(grid), 2)) * [1.0, 0.0]
    made.places.append(("CRUZ", "APOIO", spots[::2]))
    made.places.append(("ALVO", "APOIO", spots[1::2]))


def box(made: Elevation, layer: str, x: float, y: float, width: float, height: float, part: str) -> None:
    """A closed rectangle."""
    made.draw(layer, (x, y), (x + width, y), (x + width, y + height), (x, y + height), closed=True, part=part)


def write_dxf(made: Elevation, path: Path) -> Path:
    """With hatches, dimensions, lettering and a title block, as it is delivered."""
    document = ezdxf.new("R2013", setup=True)
    document.header["$INSUNITS"] = 6
    model = document.modelspace()
    for name, strokes in made.blocks.items():
        block = document.blocks.new(name)
        for stroke in strokes:
            _add(block, stroke)
    for stroke in made.strokes:
        _add(model, stroke)
    for name, layer, places in made.places:
        for at in places:
            model.add_blockref(name, at, dxfattribs={"layer": layer})
    for stroke in made.of("frame")[::5]:
        model.add_hatch(dxfattribs={"layer": "HACHURA"}).paths.add_polyline_path(stroke.points, is_closed=True)
        a, b = stroke.points[:2]
        model.add_linear_dim(
            base=a - [0, 0.3], p1=a, p2=b, override={"dimtxt": 0.1}, dxfattribs={"layer": "COTAS"}
        ).render()
    model.add_text("FACHADA PRINCIPAL", dxfattribs={"layer": "TEXTO", "height": 0.3, "insert": (0, -2.5)})
    document.saveas(path)
    return path


def write_gpkg(made: Elevation, path: Path) -> Path:
    """One table a layer; a block that is placed is one feature of several lines."""
    rows = [(stroke.layer, stroke.line()) for stroke in made.strokes]
    rows += [(layer, shapely.multilinestrings(lines)) for layer, lines in made.placed()]
    for layer in dict.fromkeys(layer for layer, _ in rows):
        lines = np.array([line for name, line in rows if name == layer])
        many = bool((shapely.get_type_id(lines) == shapely.GeometryType.MULTILINESTRING).any())
        pyogrio.raw.write(
            path, shapely.to_wkb(lines), [np.arange(len(lines))], ["n"],
            layer=layer, driver="GPKG", append=path.exists(),
            geometry_type="MultiLineString" if many else "LineString", promote_to_multi=many,
            crs='LOCAL_CS["Undefined Cartesian SRS"]',
        )  # fmt: skip
    return path


def _add(where: Any, stroke: Stroke) -> None:
    own = {"layer": stroke.layer}
    if stroke.bulge:
        centre, start, end, radius = bulge_to_arc(*stroke.points, stroke.bulge)
        where.add_arc(centre, radius, np.degrees(start), np.degrees(end), dxfattribs=own)
    elif stroke.closed or len(stroke.points) > 2:
        where.add_lwpolyline(stroke.points, close=stroke.closed, dxfattribs=own)
    else:
        where.add_line(*stroke.points, dxfattribs=own)


def _chords(points: Points, bulge: float) -> Points:
    centre, start, end, radius = bulge_to_arc(*points, bulge)
    sweep = (end - start) % (2 * np.pi)
    count = int(np.ceil(sweep / (2 * np.arccos(1 - SAGITTA / radius))))
    turn = start + sweep * np.linspace(0, 1, count + 1)
    return np.array(centre) + radius * np.column_stack([np.cos(turn), np.sin(turn)])
