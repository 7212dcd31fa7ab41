# SPDX-License-Identifier: MIT
"""Which block inserts are point symbols, and which are linework of the drawing."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
import shapely.affinity
from tests.check.symbol_oracle import Stroke, Way, symbol_strokes
from tests.check.windows import drawing

from foparq.check.drawn.symbols import Measures, symbols_of
from foparq.model.drawing import Drawing
from foparq.model.items import Holder
from foparq.model.symbols import Symbols

#: of the shipped specification, at 1:50
SHIPPED = Measures(size=0.15, times=3, visible=0.01, clear=0.05, alongside=np.radians(15))
ARM = 0.05
CROSS = ["LINESTRING (-0.05 0, 0.05 0)", "LINESTRING (0 -0.05, 0 0.05)"]
TARGET = [*CROSS, shapely.Point(0, 0).buffer(0.03).exterior.wkt]
TREE = [f"LINESTRING (0 0, {0.07 * np.cos(turn)} {0.07 * np.sin(turn)})" for turn in np.arange(0, 6.2, 0.4)]
WALL = "LINESTRING (-5 0, 5 0)"


class Sheet:
    """Lines of a drawing under construction."""

    def __init__(self, *lines: str, layer: str = "PAREDE") -> None:
        self.shapes = list(lines)
        self.holders = [""] * len(lines)
        self.layers = [layer] * len(lines)

    def insert(
        self, block: str, strokes: list[str], *places: tuple[float, float], scale: float = 1.0, turn: float = 0.0,
        layer: str = "PONTOS", within: str = "",
    ) -> "Sheet":  # fmt: skip
        for x, y in places:
            name = f"I{len(self.shapes)}"
            for stroke in strokes:
                shape = shapely.affinity.scale(shapely.from_wkt(stroke), scale, scale, origin=(0, 0))
                shape = shapely.affinity.rotate(shape, turn, origin=(0, 0))
                self.shapes.append(shapely.affinity.translate(shape, x, y).wkt)
                self.holders.append(within + str(Holder(name, layer, block)))
                self.layers.append(layer)
        return self

    def drawing(self, **more: object) -> Drawing:
        made = drawing(self.shapes, layer=self.layers, holders=self.holders, classes={})
        return replace(made, **more) if more else made

    def symbols(self, measures: Measures = SHIPPED, kinds: frozenset[str] = frozenset(), **more: object) -> Symbols:
        return symbols_of(self.drawing(**more), measures, kinds, hidden=False)


def told(symbols: Symbols) -> dict[str, int]:
    return {block.name: block.inserts for block in symbols.blocks}


FREE = [(-3.0, 2.0), (0.0, 2.0), (3.0, 2.0), (-3.0, 4.0)]


@pytest.mark.parametrize("strokes", [CROSS, TARGET, TREE], ids=["cross", "target", "tree"])
def test_a_sign_that_is_repeated_is_a_symbol(strokes: list[str]) -> None:
    """On a corner, across a wall, with an arm along it and in the open."""
    sheet = Sheet(WALL, "LINESTRING (-5 0, -5 4)").insert("S", strokes, (-5, 0), (1, 0), (2, 0.023), *FREE[:1])
    symbols = sheet.symbols()
    assert told(symbols) == {"S": 4}
    assert symbols.rows.tolist() == list(range(2, 2 + 4 * len(strokes)))
    (block,) = symbols.blocks
    assert block.layers == (("PONTOS", 4),)
    assert len(block.handles) == 4


@pytest.mark.parametrize(("scale", "found"), [(1.0, 3), (1.49, 3), (1.5, 3), (1.51, 0), (10.0, 0)])
def test_the_circle_is_met_exactly(scale: float, found: int) -> None:
    """Arms of 50 mm: at one and a half times, 150 mm from end to end."""
    symbols = Sheet(WALL).insert("S", CROSS, *FREE[:3], scale=scale).symbols()
    assert symbols.inserts == found


def test_only_inserts_that_are_small_count() -> None:
    sheet = Sheet(WALL).insert("S", CROSS, (0, 0.01), (1, 0.01)).insert("S", CROSS, (3, 2), scale=5.0)
    assert sheet.symbols().inserts == 0
    assert sheet.insert("S", CROSS, (2, 0.01)).symbols().inserts == 3


@pytest.mark.parametrize(("gap", "found"), [(0.051, 2), (0.05, 0), (0.0, 0)])
def test_a_sign_that_is_not_repeated_stands_alone(gap: float, found: int) -> None:
    """One north arrow and one target; a wall comes as near to both as a millimetre on the sheet."""
    arrow = ["LINESTRING (0 -0.06, 0 0.06)", "LINESTRING (-0.02 0.02, 0 0.06, 0.02 0.02)"]
    sheet = Sheet(WALL, f"LINESTRING (3.05 2, {3.05 + ARM} 2)").insert("N", arrow, (0, 0.06 + gap))
    sheet.insert("N", arrow, (3, -0.06 - gap))
    assert sheet.symbols().inserts == found


@pytest.mark.parametrize("resting", range(4))
def test_a_block_that_rails_end_on_is_linework(resting: int) -> None:
    """A baluster is one if rails end at half of its inserts."""
    rails = [f"LINESTRING ({x + 0.05} {y}, {x + 1} {y})" for x, y in FREE[:resting]]
    sheet = Sheet(*rails).insert("BALAUSTRE", [shapely.box(-0.05, -0.05, 0.05, 0.05).exterior.wkt], *FREE)
    symbols = sheet.symbols()
    assert symbols.inserts == (4 if resting < 2 else 0)
    assert sum(block.near for block in symbols.blocks) == (resting if resting < 2 else 0)


@pytest.mark.parametrize("gap", [0.0, 0.004, 0.01, 0.011])
def test_a_hinge_that_is_missed_or_misses_is_linework(gap: float) -> None:
    """As far as can be told from resting on the sheet: the rail would be accused, and so would the hinge."""
    hinge = ["LINESTRING (0 0, 0.06 0, 0.06 0.03)"]
    ended = Sheet(*(f"LINESTRING ({-1} {y}, {-gap} {y})" for y in (1, 2, 3))).insert("H", hinge, (0, 1), (0, 2), (0, 3))
    ending = Sheet("LINESTRING (0 0, 0 5)").insert("H", hinge, (gap, 1), (gap, 2), (gap, 3))
    found = 3 if gap > 0.01 else 0
    assert (ended.symbols().inserts, ending.symbols().inserts) == (found, found)


def test_ends_that_meet_each_other_rest_on_no_symbol() -> None:
    """Crosses at the corners of a frame, drawn as one ring or as four lines: the same."""
    corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
    sides = [f"LINESTRING ({a[0]} {a[1]}, {b[0]} {b[1]})" for a, b in pairwise([*corners, corners[0]])]
    ring = shapely.LinearRing(corners).wkt.replace("LINEARRING", "LINESTRING")
    for lines in (sides, [ring]):
        assert told(Sheet(*lines).insert("S", CROSS, *corners).symbols()) == {"S": 4}


def test_an_end_that_meets_a_wall_rests_on_no_symbol() -> None:
    """Crosses where posts stand on a wall; the posts would stand there without them."""
    spots = [(float(x), 0.0) for x in range(4)]
    standing = [f"LINESTRING ({x} 0, {x} 1)" for x, _ in spots]
    assert told(Sheet(WALL, *standing).insert("S", CROSS, *spots).symbols()) == {"S": 4}
    assert told(Sheet(*standing).insert("S", CROSS, *spots).symbols()) == {}


def test_an_insert_that_ends_on_a_line_is_linework_whatever_its_block() -> None:
    """A glazing bar among signs that were made of it."""
    bar = ["LINESTRING (0 0, 0.1 0)"]
    sheet = Sheet("LINESTRING (0 0, 0 5)").insert("B", bar, (0, 1), *((x + 0.5, y) for x, y in FREE))
    symbols = sheet.symbols()
    assert told(symbols) == {"B": 4}
    assert 1 not in symbols.rows


@pytest.mark.parametrize(("named", "found"), [
    ({"classes": {"PONTOS": "gancho"}}, 0), ({"classes": {"pon*": "gancho"}}, 0), ({"areas": ("PONTOS",)}, 0),
    ({"classes": {"GANCHO*": "x"}}, 0), ({"classes": {"PAREDE": "ganchos"}}, 0), ({"kinds": frozenset({"gancho"})}, 0),
    ({"classes": {"PAREDE": "wall"}, "kinds": frozenset({"wall"})}, 4),
])  # fmt: skip
def test_what_shows_a_feature_is_no_symbol(named: dict[str, object], found: int) -> None:
    assert Sheet(WALL).insert("GANCHO_2", CROSS, *FREE).symbols(**named).inserts == found  # type: ignore[arg-type]


def test_a_part_of_a_feature_is_no_symbol() -> None:
    held = [str(Holder(name, "JANELA", "J")) for name in "ABC"]
    sheet = Sheet(WALL)
    for holder, place in zip(held, FREE, strict=False):
        sheet.insert("S", CROSS, place, within=holder)
        sheet.insert("BIG", [shapely.box(-1, -1, 1, 1).exterior.wkt], place, layer="JANELA", within=holder)
    assert told(sheet.symbols()) == {"S": 3}
    assert sheet.symbols(classes={"JANELA": "window"}).inserts == 0


def test_of_inserts_within_each_other_the_outermost_that_fits_is_told() -> None:
    facade = str(Holder("F", "0", "FACHADA"))
    sheet = Sheet(WALL).insert("BIG", [WALL], (0, 9), within=facade)
    for n, place in enumerate(FREE):
        outer = facade + str(Holder(f"T{n}", "PONTOS", "ALVO"))
        sheet.insert("CRUZ", CROSS, place, within=outer).insert("CIRCULO", TARGET[2:], place, within=outer)
    symbols = sheet.symbols()
    assert told(symbols) == {"ALVO": 4}
    assert symbols.blocks[0].handles[0] == "F/T0"


def test_blocks_without_a_name_are_told_by_their_form() -> None:
    """Forms of a dynamic block, and a CAD export, which does not tell blocks."""
    for names in (["", "", "", ""], ["*U1", "*U2", "*U3", "*U4"]):
        sheet = Sheet(WALL)
        for name, (x, _) in zip(names, FREE, strict=True):
            sheet.insert(name, CROSS, (x + len(sheet.shapes) / 10, 0.01))
        assert sheet.symbols().inserts == 4
        sheet.insert("", TREE, (4, 0.01))
        assert sheet.symbols().inserts == 4, "another form, and it stands on the wall"


# --- attacks: linework as blocks -------------------------------------------------------------------------------------


def window(block: bool, *, one: bool, gap: float) -> Sheet:  # noqa: FBT001 - a kind of test
    """A frame of a hundred pieces of 60 mm, each an insert, with a gap after each."""
    sheet = Sheet(WALL)
    for n in range(100):
        piece = [f"LINESTRING (0 0, {0.06 - gap} 0)"]
        sheet.insert("P" if one else f"P{n}", piece, ((n % 25) * 0.06, 1 + (n // 25) * 0.4))
        if n % 5 == 0 and block:
            sheet.insert(
                "Q" if one else f"Q{n}",
                [f"LINESTRING (0 {gap}, 0 {0.1 - gap})"],
                ((n % 25) * 0.06, 1 + (n // 25) * 0.4),
            )
    return sheet


@pytest.mark.parametrize("one", [True, False], ids=["one block", "a block each"])
@pytest.mark.parametrize("gap", [0.0, 0.003, 0.009])
def test_a_window_in_a_hundred_small_blocks_is_linework(gap: float, one: bool) -> None:  # noqa: FBT001
    """Wherever its pieces meet or miss each other by what is judged as a miss."""
    assert window(block=True, one=one, gap=gap).symbols().inserts == 0


@pytest.mark.parametrize("gap", [0.02, 0.045])
def test_pieces_that_head_for_each_other_are_linework_where_each_has_its_block(gap: float) -> None:
    assert window(block=False, one=False, gap=gap).symbols().inserts == 0


@pytest.mark.parametrize("gap", [0.0, 0.004, 0.009])
@pytest.mark.parametrize("one", [True, False], ids=["one block", "a block each"])
def test_short_strokes_that_stop_short_are_linework(gap: float, one: bool) -> None:  # noqa: FBT001
    sheet = Sheet(WALL)
    for n in range(8):
        sheet.insert("T" if one else f"T{n}", ["LINESTRING (0 0, 0 0.1)"], (n - 4, gap))
    assert sheet.symbols().inserts == 0


def test_decoys_do_not_hide_what_meets_and_are_counted_where_they_hide_what_misses() -> None:
    """Ten bars, and eleven more in the open: a bar that rests at one end stays linework, one in mid-air is told."""
    bar = ["LINESTRING (0 0, 0.1 0)"]
    posts = [f"LINESTRING (0 {y}, 0 {y + 0.5}, 0.104 {y + 0.5}, 0.104 {y})" for y in range(10)]
    open_air = [(3.0 + n % 4, n // 4 + 0.5) for n in range(11)]
    resting = Sheet(*posts).insert("B", bar, *((0, y + 0.25) for y in range(10)), *open_air).symbols()
    assert (resting.inserts, sum(block.near for block in resting.blocks)) == (11, 0)
    hanging = Sheet(*posts).insert("B", bar, *((0.002, y + 0.25) for y in range(10)), *open_air).symbols()
    assert (hanging.inserts, sum(block.near for block in hanging.blocks)) == (21, 10)


# --- against the definition ------------------------------------------------------------------------------------------

TENTH = 1e-4
GRID = {"size": 20 * TENTH, "times": 3, "visible": 4 * TENTH, "clear": 8 * TENTH, "alongside": np.radians(15)}


def random_strokes(seed: int) -> list[Stroke]:
    """Loose lines, and inserts of up to three small blocks, some of them within others."""
    rng = np.random.default_rng([seed, 7])

    def walk(most: int) -> Way:
        while True:
            way = [(float(x) * TENTH, float(y) * TENTH) for x, y in rng.integers(0, most, (int(rng.integers(2, 4)), 2))]
            if all(a != b for a, b in pairwise(way)):
                return way

    strokes = [Stroke(walk(120)) for _ in range(int(rng.integers(0, 4)))]
    for block in "ABC"[: int(rng.integers(1, 4))]:
        content = [walk(int(rng.choice([8, 15, 20]))) for _ in range(int(rng.integers(1, 4)))]
        for n in range(int(rng.integers(1, 6))):
            shift = rng.integers(0, 120, 2) * TENTH
            around = [((f"{block}{n}o", "OUTER"),), ()][int(rng.random() > 0.3)]
            for way in content:
                moved = [(x + float(shift[0]), y + float(shift[1])) for x, y in way]
                strokes.append(Stroke(moved, (*around, (f"{block}{n}", block))))
            if around and rng.random() < 0.5:
                strokes.append(Stroke([(x + float(shift[0]), y) for x, y in walk(25)], around))
    return strokes


def symbol_rows(strokes: list[Stroke], change: np.ndarray | None = None) -> set[int]:
    turn = np.eye(3) if change is None else change
    ways = [np.column_stack([stroke.way, np.ones(len(stroke.way))]) @ turn.T for stroke in strokes]
    holders = ["".join(str(Holder(name, "L", block)) for name, block in stroke.chain) for stroke in strokes]
    made = drawing([shapely.LineString(way[:, :2]).wkt for way in ways], holders=holders, classes={})
    return set(symbols_of(made, Measures(**GRID), hidden=False).rows.tolist())


def test_symbols_are_what_the_definition_says() -> None:
    kinds = {"some": 0, "none": 0, "all": 0}
    for seed in range(300):
        strokes = random_strokes(seed)
        expected = symbol_strokes(strokes, **GRID)
        assert symbol_rows(strokes) == expected, seed
        held = {n for n, stroke in enumerate(strokes) if stroke.chain}
        kinds["none" if not expected else "all" if expected == held else "some"] += 1
    assert min(kinds.values()) >= 30, kinds


@pytest.mark.parametrize("seed", range(0, 60, 3))
def test_moving_turning_and_reordering_change_no_symbol(seed: int) -> None:
    strokes = random_strokes(seed)
    before = symbol_rows(strokes)
    cos, sin = np.cos(0.3), np.sin(0.3)
    for change in ([[1, 0, 250_000.0], [0, 1, 7_400_000.0]], [[cos, -sin, 5], [sin, cos, 3]], [[-1, 0, 0], [0, 1, 0]]):
        assert symbol_rows(strokes, np.array([*change, [0, 0, 1]], dtype=float)) == before
    order = np.random.default_rng(seed).permutation(len(strokes))
    assert {int(order[n]) for n in symbol_rows([strokes[n] for n in order])} == before
    assert symbol_rows([Stroke(stroke.way[::-1], stroke.chain) for stroke in strokes]) == before


@pytest.mark.parametrize("seed", range(1, 60, 3))
def test_splitting_polylines_changes_no_symbol(seed: int) -> None:
    strokes = random_strokes(seed)
    pieces = [
        (n, Stroke(list(pair), stroke.chain)) for n, stroke in enumerate(strokes) for pair in pairwise(stroke.way)
    ]
    before = symbol_rows(strokes)
    after = {pieces[row][0] for row in symbol_rows([piece for _, piece in pieces])}
    assert after == before
