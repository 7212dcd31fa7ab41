# SPDX-License-Identifier: MIT
"""One damaged entity is set aside and named; all others are read as without it."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from tests.read.drawn import new, read, skipped

from foparq.cli.main import run
from foparq.errors import UnreadableError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.read.raw import RawDrawing

MALFORMED = SkippedReason.MALFORMED
Tag = tuple[bytes, bytes]


def ten_lines(version: str = "R2010") -> Any:
    document = new(version)
    for n in range(10):
        document.modelspace().add_line((0, n), (n + 1, n), dxfattribs={"layer": "PAREDE"})
    return document


def tags_of(document: Any, folder: Path) -> list[Tag]:
    path = folder / "sound.dxf"
    document.saveas(path)
    lines = path.read_bytes().split(b"\n")
    return list(zip(lines[::2], lines[1::2], strict=False))


def span(tags: list[Tag], kind: bytes, number: int = 0, section: bytes = b"ENTITIES") -> tuple[int, int]:
    """First tag of an entity of a section, and the first after it."""
    begin = tags.index((b"  2", section))
    starts = [n for n, (code, _) in enumerate(tags) if code == b"  0" and n > begin]
    of_kind = [n for n in starts if tags[n][1] == kind]
    return of_kind[number], next(n for n in starts if n > of_kind[number])


def spoilt(tags: list[Tag], within: tuple[int, int], code: bytes, value: bytes | None) -> list[Tag]:
    """Tags with another value for the first tag of a code in an entity, or without that tag."""
    at = next(n for n in range(*within) if tags[n][0].strip() == code)
    return [*tags[:at], *([] if value is None else [(tags[at][0], value)]), *tags[at + 1 :]]


def read_tags(tags: list[Tag], folder: Path) -> RawDrawing:
    path = folder / "fachada.dxf"
    path.write_bytes(b"\n".join(line for tag in tags for line in tag) + b"\n")
    return read(path)


def malformed(drawing: RawDrawing) -> list[Skipped]:
    return [part for part in drawing.reading.skipped if part.reason is MALFORMED]


def drawn(drawing: RawDrawing) -> set[tuple[str, str, str]]:
    items = drawing.items
    return set(zip(items.item.tolist(), items.layer.tolist(), shapely.to_wkt(items.geometry).tolist(), strict=True))


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
@pytest.mark.parametrize("number", [0, 4, 9])
@pytest.mark.parametrize("code", [b"10", b"21", b"62"])
def test_letters_instead_of_a_number_cost_that_line_alone(
    tmp_path: Path, version: str, number: int, code: bytes
) -> None:
    document = ten_lines(version)
    handles = []
    for line in document.modelspace():
        line.dxf.color = 3
        handles.append(line.dxf.handle)
    tags = tags_of(document, tmp_path)
    sound = drawn(read_tags(tags, tmp_path))
    hurt = spoilt(tags, span(tags, b"LINE", number), code, b"abc")
    drawing = read_tags(hurt, tmp_path)
    assert drawn(drawing) == {row for row in sound if row[0] != handles[number]}
    assert len(drawing.items) == 9
    (part,) = malformed(drawing)
    assert (part.kind, part.layer, part.count, part.handles) == ("LINE", "PAREDE", 1, (handles[number],))
    assert part.reason.opens
    (repair,) = drawing.reading.repairs
    line = 2 * hurt.index(next(tag for tag in hurt if tag[1] == b"abc")) + 2
    assert (repair.line, repair.kind, repair.handle, repair.layer) == (line, "LINE", handles[number], "PAREDE")
    assert (repair.code, repair.group, repair.text) == ("no-number", int(code), "abc")


@pytest.mark.parametrize("value", [b"", b"-", b"\xc3\xa7\xc3\xa3o", b"\xff\xfe\x80", b"nought" * 1000])
def test_whatever_stands_there_is_told_in_bounds(tmp_path: Path, value: bytes) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 3), b"10", value), tmp_path)
    assert len(drawing.items) == 9
    told = drawing.reading.repairs[0].text
    assert len(told.encode()) < 200  # no surrogates either


def add_mesh(space: Any) -> None:
    mesh = space.add_mesh(dxfattribs={"layer": "OBJETO"})
    with mesh.edit_data() as data:
        data.vertices, data.faces = [(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)]


@pytest.mark.parametrize(
    ("add", "kind", "code"),
    [
        (add_mesh, "MESH", b"92"),
        (lambda space: space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)]), "HATCH", b"91"),
        (lambda space: space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)]), "HATCH", b"92"),
    ],
    ids=["MESH", "HATCH without number of paths", "HATCH without type of path"],
)
def test_a_tag_that_a_type_needs(tmp_path: Path, add: Callable[[Any], Any], kind: str, code: bytes) -> None:
    document = ten_lines()
    sound = drawn(read_tags(tags_of(document, tmp_path), tmp_path))
    add(document.modelspace())
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, kind.encode()), code, None), tmp_path)
    assert drawn(drawing) == sound
    assert skipped(drawing) == {(MALFORMED, kind): 1}


@pytest.mark.parametrize(
    ("part", "code", "value"),
    [
        (b"POLYLINE", b"70", b"open"),
        (b"VERTEX", b"20", b"abc"),
        (b"SEQEND", b"62", b"abc"),
        (b"SEQEND", b"0", b"LINE"),
    ],
)
@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_a_polyline_goes_with_all_its_vertices(
    tmp_path: Path, version: str, part: bytes, code: bytes, value: bytes
) -> None:
    document = ten_lines(version)
    polyline = document.modelspace().add_polyline2d([(0, 0), (1, 0), (1, 1)], dxfattribs={"layer": "PISO"})
    polyline.seqend.dxf.color = 1
    document.modelspace().add_circle((0, 0), 1)
    tags = tags_of(document, tmp_path)
    sound = {row for row in drawn(read_tags(tags, tmp_path)) if row[1] != "PISO"}
    assert len(sound) == 11
    drawing = read_tags(spoilt(tags, span(tags, part), code, value), tmp_path)
    assert drawn(drawing) == sound
    lost = next(lost for lost in malformed(drawing) if lost.kind == "POLYLINE")
    assert (lost.layer, lost.count, lost.handles) == ("PISO", 1, (polyline.dxf.handle,))


def test_an_insert_goes_with_its_attributes(tmp_path: Path) -> None:
    document = ten_lines()
    document.blocks.new("PORTA").add_line((0, 0), (0, 2))
    document.modelspace().add_blockref("PORTA", (20, 0)).add_attrib("N", "P1", (20, 0))
    document.modelspace().add_blockref("PORTA", (30, 0)).add_attrib("N", "P2", (30, 0))
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"ATTRIB"), b"40", b"abc"), tmp_path)
    assert skipped(drawing) == {(MALFORMED, "INSERT"): 1}
    assert (drawing.items.kind == "ATTRIB").sum() == 1
    assert (drawing.items.kind == "LINE").sum() == 11


def test_an_insert_whose_attributes_do_not_end_is_told(tmp_path: Path) -> None:
    document = ten_lines()
    document.blocks.new("PORTA").add_line((0, 0), (0, 2))
    document.modelspace().add_blockref("PORTA", (20, 0)).add_attrib("N", "P1", (20, 0))
    document.modelspace().add_circle((0, 0), 1)
    tags = tags_of(document, tmp_path)
    first, stop = span(tags, b"SEQEND")
    drawing = read_tags([*tags[:first], *tags[stop:]], tmp_path)
    assert skipped(drawing) == {(MALFORMED, "INSERT"): 1}
    assert (drawing.items.kind == "CIRCLE").sum() == 1


def test_in_a_block_it_counts_at_every_insert_and_on_its_layer(tmp_path: Path) -> None:
    document = ten_lines()
    block = document.blocks.new("JANELA")
    block.add_line((0, 0), (1, 0))
    block.add_circle((0, 0), 1)  # on layer 0: takes that of the insert
    document.modelspace().add_blockref("JANELA", (0, 0), dxfattribs={"layer": "NORTE"})
    document.modelspace().add_blockref("JANELA", (5, 0), dxfattribs={"layer": "SUL", "row_count": 2, "row_spacing": 9})
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"CIRCLE", section=b"BLOCKS"), b"40", b"raio"), tmp_path)
    assert [(part.kind, part.layer, part.count) for part in malformed(drawing)] == [
        ("CIRCLE", "NORTE", 1), ("CIRCLE", "SUL", 2),
    ]  # fmt: skip
    assert len(drawing.items) == 13
    assert len(drawing.reading.repairs) == 1


@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_on_a_sheet_it_is_no_part_of_model_space(tmp_path: Path, version: str) -> None:
    document = ten_lines(version)
    document.layout("Layout1").add_circle((0, 0), 1)
    tags = tags_of(document, tmp_path)
    sound = read_tags(tags, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"CIRCLE"), b"40", b"raio"), tmp_path)
    assert drawn(drawing) == drawn(sound)
    assert skipped(drawing) == skipped(sound)
    assert len(drawing.reading.repairs) == 1


def test_items_without_handles_keep_their_numbers(tmp_path: Path) -> None:
    tags = tags_of(ten_lines("R12"), tmp_path)
    begin = tags.index((b"  2", b"ENTITIES"))
    tags = [*tags[:begin], *(tag for tag in tags[begin:] if tag[0].strip() != b"5")]
    sound = drawn(read_tags(tags, tmp_path))
    assert "#4" in {row[0] for row in sound}
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 3), b"10", b"abc"), tmp_path)
    assert drawn(drawing) == {row for row in sound if row[0] != "#4"}


def test_two_ways_of_damage_that_need_two_ways_of_reading(tmp_path: Path) -> None:
    # Only mending reads a table with half a point, and mending wants extended data well formed.
    document = ten_lines()
    lines = list(document.modelspace())
    document.appids.add("DETALHE")
    lines[2].set_xdata("DETALHE", [(1002, "{"), (1070, 1), (1002, "}")])
    tags = tags_of(document, tmp_path)
    tags = spoilt(tags, span(tags, b"LINE", 6), b"10", b"abc")
    tags = spoilt(tags, span(tags, b"LINE", 2), b"1002", None)
    alone = read_tags(tags, tmp_path)
    assert len(alone.items) == 9
    drawing = read_tags(spoilt(tags, span(tags, b"VPORT", section=b"TABLES"), b"20", None), tmp_path)
    assert len(drawing.items) == 8
    assert skipped(drawing) == {(MALFORMED, "LINE"): 2}


def test_letters_instead_of_a_group_code(tmp_path: Path) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    sound = drawn(read_tags(tags, tmp_path))
    begin, end = span(tags, b"LINE", 5)
    for at in range(begin, end, 3):
        drawing = read_tags([*tags[:at], (b"xyz", tags[at][1]), *tags[at + 1 :]], tmp_path)
        assert len(drawn(drawing) & sound) == 9
        assert skipped(drawing) == {(MALFORMED, "LINE"): 1}


def test_where_a_line_is_lost_nobody_knows_what_is_an_entity(tmp_path: Path) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    lines = [line for tag in tags for line in tag]
    begin, end = span(tags, b"LINE", 2)
    again = span(tags, b"LINE", 6)[0]
    path = tmp_path / "fachada.dxf"
    for at in range(2 * begin + 2, 2 * end, 7):
        path.write_bytes(b"\n".join([*lines[:at], *lines[at + 1 :]]))
        with pytest.raises(UnreadableError, match=r"dxf\.unreadable"):
            read(path)
        # A second one lost brings the rest back into step: between them, four entities look like one.
        path.write_bytes(b"\n".join([*lines[:at], *lines[at + 1 : 2 * again + 5], *lines[2 * again + 6 :]]))
        with pytest.raises(UnreadableError, match=r"dxf\.unreadable"):
            read(path)


@pytest.mark.parametrize(
    ("section", "kind", "code"),
    [(b"TABLES", b"LAYER", b"70"), (b"BLOCKS", b"BLOCK", b"70"), (b"OBJECTS", b"DICTIONARY", b"281")],
)
def test_what_holds_the_entities_together_is_not_cut(tmp_path: Path, section: bytes, kind: bytes, code: bytes) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    hurt = spoilt(tags, span(tags, kind, section=section), code, b"abc")
    with pytest.raises(UnreadableError) as caught:
        read_tags(hurt, tmp_path)
    assert caught.value.message == "dxf.unreadable-line"
    assert "abc" in str(caught.value.fields["reason"])
    with pytest.raises(UnreadableError):  # nor if an entity is damaged as well
        read_tags(spoilt(hurt, span(hurt, b"LINE", 4), b"10", b"abc"), tmp_path)


def test_all_of_many(tmp_path: Path) -> None:
    document = ten_lines()
    for n in range(2000):
        document.modelspace().add_circle((n, 50), 1)
    tags = tags_of(document, tmp_path)
    sound = {row for row in drawn(read_tags(tags, tmp_path)) if row[1] == "PAREDE"}
    begin, end = span(tags, b"CIRCLE")[0], span(tags, b"ENDSEC")[0]
    tags[begin:end] = [(code, b"raio" if code == b" 40" else value) for code, value in tags[begin:end]]
    drawing = read_tags(tags, tmp_path)
    assert drawn(drawing) == sound
    assert skipped(drawing) == {(MALFORMED, "CIRCLE"): 2000}
    assert len(drawing.reading.repairs) == 2000


def gallery() -> Any:
    """Ten lines, and one of every kind of entity whose reading ezdxf makes conditions for."""
    document = ten_lines()
    space = document.modelspace()
    document.blocks.new("B").add_line((0, 0), (1, 0))
    add_mesh(space)
    space.add_text("1")
    space.add_mtext("Planta" * 100)
    space.add_polyline3d([(0, 0, 0), (1, 0, 0), (1, 1, 1)])
    space.add_lwpolyline([(0, 0, 0, 0, 1), (1, 0), (1, 1)])
    space.add_spline([(0, 0, 0), (2, 3, 0), (5, 1, 0), (7, 4, 0)])
    space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
    edges = space.add_hatch().paths.add_edge_path()
    edges.add_line((0, 0), (1, 0))
    edges.add_ellipse((0, 0), (1, 0), 0.5)
    space.add_mpolygon().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
    space.add_mline([(0, 0), (1, 0), (1, 1)])
    space.add_leader([(0, 0), (1, 1), (2, 2)])
    space.add_image(document.add_image_def("a.png", (10, 10)), (0, 0), (1, 1))
    space.add_wipeout([(0, 0), (1, 1)])
    space.add_underlay(document.add_underlay_def("a.pdf"))
    space.add_blockref("B", (1, 1)).add_attrib("T", "v", (0, 0))
    space.add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0)).render()
    return document


@pytest.mark.parametrize("value", [None, b"abc", b""], ids=["dropped", "letters", "empty"])
def test_no_tag_of_any_entity_costs_the_lines(tmp_path: Path, value: bytes | None) -> None:
    tags = tags_of(gallery(), tmp_path)
    sound = {row for row in drawn(read_tags(tags, tmp_path)) if row[1] == "PAREDE"}
    assert len(sound) == 10
    begin = span(tags, b"MESH")[0]
    end = next(n for n in range(begin, len(tags)) if tags[n][1] == b"ENDSEC")
    chosen = [n for n in range(begin, end) if tags[n][0].strip() != b"0"]  # kinds and so limits of entities stay
    for at in np.random.default_rng(3).choice(chosen, 15, replace=False).tolist():
        new_tags = [*tags[:at], *([] if value is None else [(tags[at][0], value)]), *tags[at + 1 :]]
        assert sound <= drawn(read_tags(new_tags, tmp_path)), tags[at]


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_the_command_finds_what_it_finds_without_the_damaged_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str
) -> None:
    def findings(path: Path) -> tuple[int, list[dict[str, Any]]]:
        arguments = ["check", str(path), "--scale", "1:50", "--format", "jsonl", "--lang", language]
        code = run(arguments)
        return code, [json.loads(line) for line in capsys.readouterr().out.splitlines()]

    def told(rows: list[dict[str, Any]]) -> list[Any]:
        return [
            (row["name"], row["handle"], row["where"], row["size"]) for row in rows if row["name"] != "needs-recovery"
        ]

    document = new()
    lines = [document.modelspace().add_line((0, n % 9), (4, n % 9)) for n in range(10)]  # the last lies on the first
    tags = tags_of(document, tmp_path)
    hurt = spoilt(tags, span(tags, b"LINE", 4), b"10", b"abc")
    read_tags(hurt, tmp_path)
    document.modelspace().delete_entity(lines[4])
    (tmp_path / "without").mkdir()
    document.saveas(tmp_path / "without" / "fachada.dxf")
    code, rows = findings(tmp_path / "fachada.dxf")
    _, fewer = findings(tmp_path / "without" / "fachada.dxf")
    assert code == 1
    assert told(rows) == told(fewer)
    assert [row["name"] for row in rows].count("duplicate") == 1
