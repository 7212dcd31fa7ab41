# SPDX-License-Identifier: MIT
"""Places and items as CAD and QGIS take them."""

import math
import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely

from foparq.evaluate.quality import because, some
from foparq.findings.table import Findings
from foparq.model.drawing import Drawing
from foparq.report.places import cad_line, pasted, qgis_filter
from foparq.report.record import AuditRecord
from foparq.report.rows import finding_rows
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words, language_named

Plant = Callable[..., Findings]


@pytest.mark.parametrize(
    ("place", "metres", "text"),
    [
        ((104.5, 53.5, 0.0), 1.0, "104.5,53.5,0"),
        ((104.5, 53.5, math.nan), 1.0, "104.5,53.5,0"),
        ((104.5, 53.5), None, "104.5,53.5,0"),
        ((-0.00001, 1 / 3, 1000.0), 1.0, "0,0.3333,1000"),
        ((457123.25, 7553000.0, 12.34), 0.001, "457123.2,7553000,12.3"),
        ((math.nan, 1.0, 1.0), 1.0, ""),
        ((1.0, math.inf, 1.0), 1.0, ""),
    ],
)
def test_a_place_is_pasted_with_decimal_points(place: tuple[float, ...], metres: float | None, text: str) -> None:
    assert pasted(place, metres) == text


def test_what_is_pasted_is_the_place_to_a_tenth_of_a_millimetre() -> None:
    rng = np.random.default_rng(7)
    for metres in (1.0, 0.01, 0.001, 0.0254):
        for place in rng.uniform(-1e6, 1e6, (200, 3)):
            back = np.array([float(part) for part in pasted(place, metres).split(",")])
            assert np.abs(back - place).max() * metres <= 0.5e-4 * (1.01 if metres != 0.0254 else 2.6)


def test_lines_for_other_programs() -> None:
    assert cad_line(["A8", "B2"]) == '(command "_.ZOOM" "_O" (handent "A8") (handent "B2") "")'
    assert cad_line([]) == ""
    assert qgis_filter("EntityHandle", ["A8"]) == "\"EntityHandle\" = 'A8'"
    assert qgis_filter("name", ["O'Neil"]) == "\"name\" = 'O''Neil'"
    assert qgis_filter("$id", ["4", "4"]) == "$id = 4"
    assert qgis_filter("$id", []) == ""


@pytest.mark.parametrize(
    ("path", "item", "handle", "inserts", "other", "cad", "qgis"),
    [
        ("a.dxf", "A8", "A8", "", "", ["A8"], "\"EntityHandle\" = 'A8'"),
        ("a.DXF", "3B/38/32", "32", "3B/38", "3D", ["3B", "3D"], "\"EntityHandle\" IN ('3B', '3D')"),
        ("a.dxf", "3B:2/32", "32", "3B", "3B:2/33", ["3B"], "\"EntityHandle\" = '3B'"),
        ("a.dxf", "A8~2", "A8", "", "A8", ["A8"], "\"EntityHandle\" = 'A8'"),
        ("a.dxf", "#5", "", "", "#1", [], ""),
        ("a.dxf", "", "", "", "", [], ""),
        ("a.gpkg", "PAREDE:1.2", "1", "", "PAREDE:4", [], "$id = 1"),
        ("a.shp", "7", "7", "", "", [], "$id = 7"),
        ("a.gpkg", "desenho:12", "2F", "", "", [], "\"EntityHandle\" = '2F'"),
    ],
)
def test_items_are_found_at_top_level(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, path: str, item: str, handle: str, inserts: str, other: str,
    cad: list[str], qgis: str,
) -> None:  # fmt: skip
    made = plant(replace(drawing, path=path), "TOP011", "undershoot", [(item, "0", shapely.Point(1, 2, 3), 0.1)])
    column = {"handle": handle, "inserts": inserts, "other": other, "other_layer": "REBOCO" if other else ""}
    made = replace(made, **{name: np.array([value], dtype=object) for name, value in column.items()})
    (row,) = finding_rows(replace(rejected, findings=made), Words("pt-BR"))
    assert re.findall(r'handent "([^"]+)"', row["cad"]) == cad
    assert row["qgis"] == qgis
    assert row["paste"] == "1,2,3"
    assert row["other_layer"] == ("REBOCO" if other else None)


def test_an_item_is_named_like_the_other_one(rejected: AuditRecord, drawing: Drawing, plant: Plant) -> None:
    made = plant(drawing, "TOP011", "undershoot", [("3B/38/32", "0", shapely.Point(1, 2), 0.1), ("#5", "0", None, 0.1)])
    names = {"handle": ["32", ""], "other": ["3B/38/33", "#1"]}
    made = replace(made, **{name: np.array(values, dtype=object) for name, values in names.items()})
    sentences = [row["message"] for row in finding_rows(replace(rejected, findings=made), Words("en"))]
    assert "item 3B/38/32 " in sentences[0]
    assert "item 3B/38/33" in sentences[0]
    assert "item #5 " in sentences[1]


def test_the_first_of_many_names_say_how_many_more() -> None:
    names = [f"L{n}" for n in range(13)]
    assert some(names[:10]) == names[:10]
    assert some(names, 3, total=40)[-1] == because("list.more", n=37)
    reason = because("features.unmapped", element="Q4", items=99, n=13, layers=some(names))
    assert reason_sentence(Words("en"), reason).endswith("L8, L9 and 3 more.")
    assert reason_sentence(Words("pt-BR"), reason).endswith("L8, L9 e mais 3.")


@pytest.mark.parametrize(
    ("tag", "language"),
    [
        ("pt", "pt-BR"), ("PT_br", "pt-BR"), ("pt_PT.UTF-8", "pt-BR"), ("en-GB", "en"), ("C.UTF-8", "en"),
        ("de", None), ("", None),
    ],
)  # fmt: skip
def test_languages_by_their_tags(tag: str, language: str | None) -> None:
    assert language_named(tag) == language
