# SPDX-License-Identifier: MIT
"""Whatever a drawing holds that no rule sees is named, with its kind, its count, and what is missing."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.read.drawn import new, read, read_back
from tests.read.gis_files import read as read_gis
from tests.read.gis_files import write

from foparq.model.drawing import Skipped, SkippedReason
from foparq.model.items import Role
from foparq.read.raw import RawDrawing

SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))


def parts(drawing: RawDrawing, reason: SkippedReason) -> list[tuple[str, str, int]]:
    return [(part.kind, part.name, part.count) for part in drawing.reading.skipped if part.reason is reason]


@pytest.mark.parametrize(
    ("draw", "kind", "reason"),
    [
        (lambda space: space.add_mline(SQUARE), "MLINE", SkippedReason.MULTILINE),
        (lambda space: space.add_3dface(SQUARE), "3DFACE", SkippedReason.SURFACE),
        (
            lambda space: space.add_polymesh((2, 2)),
            "POLYLINE",
            SkippedReason.SURFACE,
        ),
        (lambda space: space.add_xline((0, 0), (1, 0)), "XLINE", SkippedReason.INFINITE_LINE),
        (lambda space: space.add_wipeout(SQUARE), "WIPEOUT", SkippedReason.WIPEOUT),
        (lambda space: space.new_entity("LIGHT", {}), "LIGHT", SkippedReason.UNSUPPORTED),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_each_kind_is_named_and_counted(
    draw: Callable[[Any], Any], kind: str, reason: SkippedReason, tmp_path: Path
) -> None:
    document = new()
    document.modelspace().add_line((0, 0), (5, 0))
    for _ in range(3):
        draw(document.modelspace())
    assert parts(read_back(document, tmp_path), reason) == [(kind, "", 3)]


def test_faces_stay_items_and_filled_areas_are_seen(tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_3dface(SQUARE)
    document.modelspace().add_solid(SQUARE)
    drawing = read_back(document, tmp_path)
    assert sorted(zip(drawing.items.kind, drawing.items.role, strict=True)) == [
        ("3DFACE", Role.SURFACE), ("SOLID", Role.SURFACE),
    ]  # fmt: skip
    assert [part.kind for part in drawing.reading.skipped] == ["3DFACE"]


def test_an_image_and_an_attached_pdf(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    space.add_image(document.add_image_def("foto.jpg", (100, 100)), (0, 0), (1, 1))
    space.add_underlay(document.add_underlay_def("planta.pdf", "pdf"), (0, 0))
    drawing = read_back(document, tmp_path)
    assert parts(drawing, SkippedReason.IMAGE) == [("IMAGE", "", 1)]
    assert parts(drawing, SkippedReason.UNDERLAY) == [("PDFUNDERLAY", "", 1)]


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("3DSOLID", SkippedReason.SURFACE), ("BODY", SkippedReason.SURFACE), ("REGION", SkippedReason.SURFACE),
        ("SURFACE", SkippedReason.SURFACE), ("OLE2FRAME", SkippedReason.OLE),
        ("ACAD_PROXY_ENTITY", SkippedReason.PROXY), ("AEC_WALL", SkippedReason.UNSUPPORTED),
    ],
)  # fmt: skip
def test_an_entity_of_another_program(kind: str, reason: SkippedReason, tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_line((0, 0), (5, 0))
    path = tmp_path / "drawing.dxf"
    document.saveas(path)
    text = path.read_text(encoding="utf-8")
    entity = f"  0\n{kind}\n  5\nFFA\n100\nAcDbEntity\n  8\nPAREDE\n100\nAcDbOther\n 90\n1\n  0\nLINE\n"
    path.write_text(text.replace("  0\nLINE\n", entity, 1), encoding="utf-8")
    drawing = read(path)
    assert parts(drawing, reason) == [(kind, "", 1)]
    assert [part.layer for part in drawing.reading.skipped] == ["PAREDE"]


def test_a_block_that_the_file_lacks_is_named_wherever_it_is_inserted(tmp_path: Path) -> None:
    document = new()
    space = document.modelspace()
    wall = document.blocks.new("PAREDE_A")
    wall.add_blockref("PORTA_80", (1, 0))
    for x in range(4):
        space.add_blockref("PAREDE_A", (x, 0))
    space.add_blockref("JANELA_120", (9, 0))
    drawing = read_back(document, tmp_path)
    assert parts(drawing, SkippedReason.MISSING_BLOCK) == [("INSERT", "JANELA_120", 1), ("INSERT", "PORTA_80", 4)]


def test_an_external_reference_is_named_with_its_file(tmp_path: Path) -> None:
    document = new()
    document.add_xref_def("plantas/pavimento.dwg", "PAVIMENTO")
    document.modelspace().add_blockref("PAVIMENTO", (0, 0))
    (part,) = read_back(document, tmp_path).reading.skipped
    assert part.reason is SkippedReason.EXTERNAL_REFERENCE
    assert (part.name, part.thing) == ("PAVIMENTO (plantas/pavimento.dwg)", "INSERT PAVIMENTO (plantas/pavimento.dwg)")


def test_the_sheet_beside_a_drawing_is_lettering_and_alone_it_is_the_drawing(tmp_path: Path) -> None:
    document = new()
    document.layout("Layout1").add_line((0, 0), (1, 0))
    document.modelspace().add_text("VER PRANCHA 2")
    alone = read_back(document, tmp_path)
    assert ("LINE", "", 1) in parts(alone, SkippedReason.PAPER_SPACE_ONLY)
    document.modelspace().add_line((0, 0), (5, 0))
    beside = read_back(document, tmp_path)
    assert ("LINE", "", 1) in parts(beside, SkippedReason.PAPER_SPACE)
    assert not parts(beside, SkippedReason.PAPER_SPACE_ONLY)


@pytest.mark.parametrize(("paper", "reason"), [([1, 1], "paper-space-only"), ([0, 1], "paper-space")])
def test_the_sheet_of_an_exported_drawing(paper: list[int], reason: str, tmp_path: Path) -> None:
    lines = ["LINESTRING (0 0, 1 0)", "LINESTRING (0 1, 1 1)"]
    path = write(tmp_path / "folha.gpkg", lines, PaperSpace=paper)
    (part,) = read_gis(path).reading.skipped
    assert (part.reason, part.kind, part.count) == (reason, "LineString", sum(paper))


def test_contents_of_a_kind_that_nobody_knows_leave_the_question_open() -> None:
    assert SkippedReason.UNSUPPORTED.opens
    assert SkippedReason.UNSUPPORTED_LAYER.opens
    assert Skipped(reason=SkippedReason.MULTILINE, kind="MLINE", layer="0", count=1).thing == "MLINE"


def test_what_shows_no_linework_leaves_nothing_open() -> None:
    closed = {reason.value for reason in SkippedReason if not reason.opens}
    assert closed == {
        "above-header", "attributes", "degenerate", "ignored-layer", "image", "infinite-line", "lines-and-points",
        "materials", "no-coordinates", "no-geometry", "no-surface",
        "not-asked", "not-plotted", "ole", "paper-space", "point-symbol", "raster", "trigger", "unlisted-geometry",
        "unlisted-view", "unlisted-virtual-table", "viewport", "wipeout", "xclip-ignored",
    }  # fmt: skip
