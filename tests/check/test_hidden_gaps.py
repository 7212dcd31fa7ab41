# SPDX-License-Identifier: MIT
"""Deliveries that try to hide a missing window: twelve are specified, nine are drawn, and something stands for three.

What cannot be a window must not make up for one: the omission fails or stays undecided, it never passes.
"""

from collections.abc import Callable
from pathlib import Path

import ezdxf
import pytest
from ezdxf.document import Drawing as Document
from ezdxf.layouts import BaseLayout
from tests.check.windows import FAIL, PASS, UNDECIDED, pane, read, verdicts

from foparq.evaluate.quality import ElementStatus

PLACES = [((n % 6) * 2.0, (n // 6) * 3.0) for n in range(12)]
LAYER = {"layer": "JANELA"}


def window(space: BaseLayout, x: float = 0.0, y: float = 0.0, layer: str = "0") -> None:
    pane(space, x, y, layer=layer)
    space.add_line((x + 0.5, y), (x + 0.5, y + 1.5), dxfattribs={"layer": layer})


def nine(loose: bool) -> Document:  # noqa: FBT001 - blocks, or the same linework loose
    document = ezdxf.new(units=6)
    document.layers.add("JANELA")
    window(document.blocks.new("J"))
    for x, y in PLACES[:9]:
        if loose:
            window(document.modelspace(), x, y, "JANELA")
        else:
            document.modelspace().add_blockref("J", (x, y), dxfattribs=LAYER)
    return document


def again(document: Document, aside: float = 0.0) -> None:
    for x, y in PLACES[:3]:
        document.modelspace().add_blockref("J", (x + aside, y), dxfattribs=LAYER)


def renamed(document: Document) -> None:
    window(document.blocks.new("OUTRA"))
    for place in PLACES[:3]:
        document.modelspace().add_blockref("OUTRA", place, dxfattribs=LAYER)


def mirrored(document: Document) -> None:
    for x, y in PLACES[:3]:
        document.modelspace().add_blockref("J", (x + 1, y), dxfattribs={**LAYER, "xscale": -1})


def turned(document: Document) -> None:
    for x, y in PLACES[:3]:
        document.modelspace().add_blockref("J", (x + 1, y + 1.5), dxfattribs={**LAYER, "rotation": 180})


def in_depth(document: Document) -> None:
    for x, y in PLACES[:3]:
        document.modelspace().add_blockref("J", (x, y, 0.05), dxfattribs=LAYER)


def as_array(document: Document) -> None:
    x, y = PLACES[0]
    array = {"column_count": 4, "column_spacing": 0.004}
    document.modelspace().add_blockref("J", (x, y), dxfattribs={**LAYER, **array})


def nested(document: Document) -> None:
    outer = document.blocks.new("CONJUNTO")
    for place in PLACES[:3]:
        outer.add_blockref("J", place, dxfattribs=LAYER)
    document.modelspace().add_blockref("CONJUNTO", (0.001, 0), dxfattribs={"layer": "0"})


def loose_over(document: Document) -> None:
    for x, y in PLACES[:3]:
        window(document.modelspace(), x + 0.003, y - 0.002, "JANELA")


def smaller(document: Document) -> None:
    for x, y in PLACES[:3]:
        scaled = {"xscale": 0.97, "yscale": 0.97}
        document.modelspace().add_blockref("J", (x + 0.015, y + 0.02), dxfattribs={**LAYER, **scaled})


def sills(document: Document) -> None:
    for x, y in PLACES[:3]:
        corners = [(x - 0.05, y - 0.1), (x + 1.05, y - 0.1), (x + 1.05, y - 0.03), (x - 0.05, y - 0.03)]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs=LAYER)


def strokes(document: Document) -> None:
    for n in range(3):
        document.modelspace().add_line((20, n), (20.4, n), dxfattribs=LAYER)


def specks_as_blocks(document: Document) -> None:
    document.blocks.new("P").add_circle((0, 0), 0.03)
    for n in range(3):
        document.modelspace().add_blockref("P", (20, n), dxfattribs=LAYER)


def panes(document: Document) -> None:
    for x, y in PLACES[:3]:
        corners = [(x + 0.1, y + 0.1), (x + 0.4, y + 0.1), (x + 0.4, y + 1.4), (x + 0.1, y + 1.4)]
        document.modelspace().add_lwpolyline(corners, close=True, dxfattribs=LAYER)


def half_over(document: Document) -> None:
    again(document, aside=0.5)


def in_paper(document: Document) -> None:
    for place in PLACES[9:]:
        document.layout("Layout1").add_blockref("J", place, dxfattribs=LAYER)


def texts_and_points(document: Document) -> None:
    for x, y in PLACES[9:]:
        document.modelspace().add_text("JANELA", dxfattribs={**LAYER, "insert": (x, y)})
        document.modelspace().add_point((x, y), dxfattribs=LAYER)
        document.layout("Layout1").add_text("JANELA", dxfattribs={**LAYER, "insert": (x, y)})


def one_over_another(document: Document) -> None:
    again(document)
    again(document, aside=0.002)
    again(document, aside=0.004)


PROVEN: list[Callable[[Document], None]] = [
    again, renamed, mirrored, turned, in_depth, as_array, nested, loose_over, smaller, texts_and_points,
    one_over_another,
]  # fmt: skip
DOUBTED: list[Callable[[Document], None]] = [sills, strokes, specks_as_blocks, panes, half_over, in_paper]


#: what repeats a window makes up for none; what may be part of one decides nothing
TRICKS = [(trick, FAIL) for trick in PROVEN] + [(trick, UNDECIDED) for trick in DOUBTED]


@pytest.mark.parametrize("loose", [False, True])
@pytest.mark.parametrize(("trick", "omission"), TRICKS, ids=[trick.__name__ for trick, _ in TRICKS])
def test_no_trick_makes_up_for_a_missing_window(
    tmp_path: Path,
    trick: Callable[[Document], None],
    omission: ElementStatus,
    loose: bool,  # noqa: FBT001 - a parameter of the test
) -> None:
    document = nine(loose)
    trick(document)
    assert verdicts(read(document, tmp_path), required=12) == (PASS, omission)


@pytest.mark.parametrize("loose", [False, True])
def test_the_three_windows_themselves_are_found(tmp_path: Path, loose: bool) -> None:  # noqa: FBT001
    document = nine(loose)
    for place in PLACES[9:]:
        document.modelspace().add_blockref("J", place, dxfattribs=LAYER)
    assert verdicts(read(document, tmp_path), required=12) == (PASS, PASS)
