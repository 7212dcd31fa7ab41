# SPDX-License-Identifier: MIT
"""Features on the picture: what is drawn of them, and numbers where a person has to count; which way one looks."""

import re
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from tests.check.windows import PLACES, counted, drawing, frame, pane

from foparq.audit import audit_to
from foparq.findings.counts import Reading
from foparq.model.plane import plane_of
from foparq.report.files import Written
from foparq.report.page.completeness import feature_numbers
from foparq.report.page.page import facing
from foparq.report.sentences import class_word, label_text
from foparq.report.words import Words

EN, PT = Words("en"), Words("pt-BR")
MANIFEST = """
[delivery]
scale = "1:50"
[[drawing]]
path = "a.dxf"
unit = "m"
plane = "xy"
facade = "N"
classes = { JANELA = "window" }
[features]
path = "f.csv"
"""
DECISION = """
[[decision]]
element = "Q5"
class = "window"
facade = "N"
counted = 4
by = "A. Souza"
reason = "frames"
"""


def deliver(folder: Path, more: str = "") -> Written:
    """Four windows in a row, each with a frame within."""
    document = ezdxf.new(units=6)
    for x in (9.0, 0.0, 6.0, 3.0):
        for inset in (0.0, 0.06):
            pane(document.modelspace(), x, 3.0, inset=inset, layer="JANELA")
    document.saveas(folder / "a.dxf")
    (folder / "f.csv").write_text("id;class;facade;count\nJ;window;N;6\n")
    (folder / "delivery.toml").write_text(MANIFEST + more)
    return audit_to(folder, folder / "out")


def test_what_is_drawn_of_a_feature_is_its_linework_and_no_hull() -> None:
    """A stepped cornice: its hull cuts both ends, its linework does not."""
    stepped = "LINESTRING (0 1, 1 1, 1 1.5, 9 1.5, 9 1, 10 1, 10 0, 0 0, 0 1)"
    found = counted(drawing([stepped])).found
    (drawn,) = found.lines
    assert shapely.equals(drawn.geoms[0], shapely.from_wkt(stepped))
    assert not shapely.equals(shapely.boundary(found.sheet[0]), shapely.from_wkt(stepped))


def test_every_feature_has_its_own_linework() -> None:
    found = counted(drawing([frame(*place, inset) for place in PLACES for inset in (0.0, 0.06)])).found
    assert len(found) == 40
    for lines, hull in zip(found.lines, found.sheet, strict=True):
        assert shapely.equals(shapely.convex_hull(lines), hull)


def test_features_to_be_counted_are_numbered_from_left_to_right(tmp_path: Path) -> None:
    quality = deliver(tmp_path).record.quality
    numbers = feature_numbers("a.dxf", quality, lambda points: points)
    assert [one.text for one in numbers] == [str(n) for n in range(1, 9)]
    assert [one.reading for one in numbers] == ["counted"] * 4 + ["open"] * 4
    assert [one.x for one in numbers[:4]] == pytest.approx([0.0, 3.0, 6.0, 9.0], abs=0.01)
    assert feature_numbers("other.dxf", quality, lambda points: points) == ()


def test_what_is_decided_needs_no_numbers_and_the_legend_says_it(tmp_path: Path) -> None:
    quality = deliver(tmp_path, DECISION).record.quality
    assert feature_numbers("a.dxf", quality, lambda points: points) == ()
    text = (tmp_path / "out" / "report.html").read_text()
    assert text.count("decided count: 4") == text.count("contagem decidida: 4") == 2
    assert sorted(quality.found.reading) == sorted([Reading.COUNTED] * 4 + [Reading.PART] * 4)


def test_every_reference_to_a_section_names_its_number(tmp_path: Path) -> None:
    deliver(tmp_path)
    text = (tmp_path / "out" / "report.html").read_text()
    english = text[text.index('<main lang="en"') :]
    titles = re.findall(r"<h2 id=\"([a-z]+)(?:--en)?\">(\d+)\. ", english)
    assert [int(number) for _, number in titles] == list(range(1, len(titles) + 1))
    numbers = dict(titles)
    assert f"(section {numbers['completeness']})" in english
    assert f"(section {numbers['coverage']})" in english


@pytest.mark.parametrize(
    ("plane", "right", "up", "away"),
    [("xz", "+x", "+z", "+y"), ("yz", "+y", "+z", "\N{MINUS SIGN}x"), ("xy", "+x", "+y", "\N{MINUS SIGN}z")],
)
def test_which_way_one_looks(plane: str, right: str, up: str, away: str) -> None:
    """In front of an elevation in xz, x to the right and z up, one looks along y; on a plan downward."""
    told = facing(EN, plane_of(plane, np.array([shapely.Point(0, 0, 0)], dtype=object)))
    assert told == EN("report.drawing.facing", right=right, up=up, away=away)


def test_a_slanting_direction_is_told_in_parts() -> None:
    plane = plane_of("xz", np.array([shapely.Point(0, 0, 0)], dtype=object))
    slanting = replace(plane, right=(0.6, 0.8, 0.0))
    assert "(0.60; 0.80; 0.00)" in facing(EN, slanting)
    assert "(0,60; 0,80; 0,00)" in facing(PT, slanting)


def test_classes_are_named_in_the_language_of_the_reader_where_it_is_known() -> None:
    assert (class_word(PT, "Windows"), class_word(EN, "window")) == ("janela", "window")
    assert class_word(PT, "<b>cunhal</b>") == "<b>cunhal</b>"
    assert label_text(PT, "window / N: 24–48") == "janela (fachada N): 24–48"
    assert label_text(EN, "door") == "door"
    assert label_text(PT, "a\u202eb / N") == "a\\u202eb (fachada N)"


def test_lengths_of_a_column_share_unit_and_decimals() -> None:
    assert EN.column([0.0011, -0.000038]) == ["1.10 mm", "\N{MINUS SIGN}0.04 mm"]
    assert PT.column([2.5, 0.0011]) == ["2,500 m", "0,001 m"]
    assert EN.column([0.0, -1e-9]) == ["0.00 µm", "0.00 µm"]
