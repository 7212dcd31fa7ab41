# SPDX-License-Identifier: MIT
"""A value of a text DXF that is no number is named with its place, and nothing is judged by what it might mean."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import shapely
from tests.read.drawn import new, read, skipped
from tests.read.test_dxf_damaged import drawn, malformed, read_tags, span, spoilt, tags_of, ten_lines

from foparq.cli.main import run
from foparq.errors import UnreadableError
from foparq.model.drawing import SkippedReason, UnitOrigin
from foparq.report.sentences import repair_sentence
from foparq.report.words import LANGUAGES, Words

MALFORMED = SkippedReason.MALFORMED
#: what programs write, or a hand, or another locale, and what Python alone takes for a number
NO_REALS = [
    b"7,75", b"1,5E3", b"1.#QNAN", b"-1.#IND", b"1.#INF", b"NaN", b"nan", b"inf", b"-Infinity", b"12.3.4", b"8 ,35",
    b"", b"0x10", b"1_0", b"1e999", b"1.0D+3", b"--1", b"1e", b".", "\uff18".encode(), "\u0663".encode(), b"5 m",
]  # fmt: skip
NO_WHOLES = [b"3,0", b"3.5", b"1_0", b"0x7", b"nan", b"", b"256QSW", b"\xef\xbc\x93", b"1e999"]


def line_of(tags: list[Any], value: bytes, after: int = 0) -> int:
    return 2 * next(n for n in range(after, len(tags)) if tags[n][1] == value) + 2


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
@pytest.mark.parametrize("value", NO_REALS)
def test_a_coordinate(tmp_path: Path, version: str, value: bytes) -> None:
    document = ten_lines(version)
    handles = [line.dxf.handle for line in document.modelspace()]
    tags = tags_of(document, tmp_path)
    sound = drawn(read_tags(tags, tmp_path))
    within = span(tags, b"LINE", 5)
    hurt = spoilt(tags, within, b"21", value)
    drawing = read_tags(hurt, tmp_path)
    assert drawn(drawing) == {row for row in sound if row[0] != handles[5]}
    (part,) = malformed(drawing)
    assert (part.kind, part.layer, part.count, part.handles) == ("LINE", "PAREDE", 1, (handles[5],))
    (repair,) = drawing.reading.repairs
    assert (repair.code, repair.group, repair.kind, repair.handle) == ("no-number", 21, "LINE", handles[5])
    assert repair.line == line_of(hurt, value, within[0])
    if value.isascii():
        assert repair.text == value.decode()


@pytest.mark.parametrize("version", ["R12", "R2010"])
@pytest.mark.parametrize("value", NO_WHOLES)
def test_a_whole_number(tmp_path: Path, version: str, value: bytes) -> None:
    document = ten_lines(version)
    for line in document.modelspace():
        line.dxf.color = 3
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 5), b"62", value), tmp_path)
    assert len(drawing.items) == 9
    assert [(repair.group, repair.kind) for repair in drawing.reading.repairs] == [(62, "LINE")]


@pytest.mark.parametrize("value", [b"0", b"-0.0", b"+1.5", b"1.", b".5", b" 1e3 ", b"1E-08", b"1e+300", b"1" * 50])
def test_what_is_a_number_stays(tmp_path: Path, value: bytes) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 5), b"11", value), tmp_path)
    assert drawing.reading.repairs == ()
    ends = shapely.get_coordinates(drawing.items.geometry)[:, 0].tolist()
    assert float(value) in ends


@pytest.mark.parametrize("value", [b"3.0", b"3.", b"+3.000", b"30e-1"])
def test_a_whole_number_that_is_written_as_a_real_one_is_read_and_told(tmp_path: Path, value: bytes) -> None:
    document = ten_lines()
    for line in document.modelspace():
        line.dxf.color = 3
    tags = tags_of(document, tmp_path)
    sound = read_tags(tags, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 5), b"62", value), tmp_path)
    assert drawn(drawing) == drawn(sound)
    assert drawing.items.colour.tolist() == sound.items.colour.tolist()
    (repair,) = drawing.reading.repairs
    assert (repair.code, repair.group, repair.text) == ("whole-as-real", 62, value.decode())


def add_polyline(space: Any) -> None:
    space.add_polyline2d([(0, 0), (1, 0), (1, 1)])


@pytest.mark.parametrize(
    ("add", "part", "kind", "code"),
    [
        (lambda space: space.add_lwpolyline([(0, 0), (1, 0), (1, 1)]), b"LWPOLYLINE", "LWPOLYLINE", b"20"),
        (lambda space: space.add_lwpolyline([(0, 0), (1, 0), (1, 1)]), b"LWPOLYLINE", "LWPOLYLINE", b"90"),
        (add_polyline, b"VERTEX", "POLYLINE", b"10"),
        (lambda space: space.add_spline([(0, 0), (2, 3), (5, 1), (7, 4)]), b"SPLINE", "SPLINE", b"11"),
        (lambda space: space.add_open_spline([(0, 0), (2, 3), (5, 1), (7, 4)]), b"SPLINE", "SPLINE", b"40"),
        (lambda space: space.add_text("Sala", height=0.5), b"TEXT", "TEXT", b"40"),
        (lambda space: space.add_circle((0, 0), 1), b"CIRCLE", "CIRCLE", b"40"),
    ],
)
@pytest.mark.parametrize("value", [b"1,5", b"1.#QNAN", b"inf"])
def test_every_kind_of_entity(
    tmp_path: Path, add: Callable[[Any], Any], part: bytes, kind: str, code: bytes, value: bytes
) -> None:
    document = ten_lines()
    sound = drawn(read_tags(tags_of(document, tmp_path), tmp_path))
    add(document.modelspace())
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, part), code, value), tmp_path)
    assert drawn(drawing) == sound
    assert skipped(drawing) == {(MALFORMED, kind): 1}
    assert [(repair.kind, repair.text) for repair in drawing.reading.repairs] == [(kind, value.decode())]


def test_in_a_block(tmp_path: Path) -> None:
    document = ten_lines()
    block = document.blocks.new("JANELA")
    block.add_line((0, 0), (1, 0))
    block.add_line((0, 0), (0, 2), dxfattribs={"layer": "VAO"})
    for x in (0, 5, 9):
        document.modelspace().add_blockref("JANELA", (x, 0))
    tags = tags_of(document, tmp_path)
    drawing = read_tags(spoilt(tags, span(tags, b"LINE", 1, section=b"BLOCKS"), b"21", b"2,1"), tmp_path)
    assert len(drawing.items) == 10 + 3
    assert [(part.kind, part.layer, part.count) for part in malformed(drawing)] == [("LINE", "VAO", 3)]
    assert len(drawing.reading.repairs) == 1


@pytest.mark.parametrize("damage", ["half", "whole"])
def test_a_point_without_its_y_is_no_vertex_less(tmp_path: Path, damage: str) -> None:
    document = ten_lines()
    sound = drawn(read_tags(tags_of(document, tmp_path), tmp_path))
    document.modelspace().add_lwpolyline([(0, 0), (1, 0), (1, 1), (0, 1)])
    tags = spoilt(t := tags_of(document, tmp_path), span(t, b"LWPOLYLINE"), b"20", None)
    if damage == "whole":  # what only mending reads
        tags = spoilt(tags, span(tags, b"VPORT", section=b"TABLES"), b"20", None)
    drawing = read_tags(tags, tmp_path)
    assert drawn(drawing) == sound
    assert skipped(drawing) == {(MALFORMED, "LWPOLYLINE"): 1}
    assert [(r.code, r.group, r.kind) for r in drawing.reading.repairs if r.line] == [("no-y", 10, "LWPOLYLINE")]


def test_all_x_of_a_line_before_all_y_is_no_damage(tmp_path: Path) -> None:
    tags = tags_of(ten_lines("R12"), tmp_path)
    sound = {row[2] for row in drawn(read_tags(tags, tmp_path))}
    begin, end = span(tags, b"LINE", 5)
    order = sorted(range(begin, end), key=lambda n: tags[n][0].strip() in (b"20", b"21", b"30", b"31"))
    drawing = read_tags([*tags[:begin], *(tags[n] for n in order), *tags[end:]], tmp_path)
    assert {row[2] for row in drawn(drawing)} == sound


@pytest.mark.parametrize("value", [b"6,0", b"abc", b"", b"nan", b"0x6", b"1_0", b"6.5"])
def test_a_unit_that_is_no_number_is_no_unit(tmp_path: Path, value: bytes) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    assert read_tags(tags, tmp_path).unit.name == "m"
    at = tags.index((b"  9", b"$INSUNITS")) + 1
    drawing = read_tags([*tags[:at], (tags[at][0], value), *tags[at + 1 :]], tmp_path)
    assert drawing.unit.origin is UnitOrigin.UNKNOWN
    assert len(drawing.items) == 10
    (repair,) = drawing.reading.repairs
    assert (repair.code, repair.kind, repair.line) == ("header-variable", "$INSUNITS", 2 * at + 2)
    assert (repair.group, repair.text) == (70, value.decode())


@pytest.mark.parametrize("code", [b"62", b"70"])
@pytest.mark.parametrize("value", [b"-7,75", b"1.5", b"nan"])
def test_a_layer_whose_state_nobody_knows_refuses_the_file(tmp_path: Path, code: bytes, value: bytes) -> None:
    document = ten_lines()
    document.layers.add("PAREDE", color=5)
    tags = tags_of(document, tmp_path)
    at = next(n for n, tag in enumerate(tags) if tag == (b"  2", b"PAREDE"))
    begin = max(n for n in range(at) if tags[n][0].strip() == b"0")
    hurt = spoilt(tags, (begin, len(tags)), code, value)
    with pytest.raises(UnreadableError) as caught:
        read_tags(hurt, tmp_path)
    assert caught.value.message == "dxf.unreadable-line"
    assert caught.value.fields["line"] == line_of(hurt, value, begin)
    assert value.decode() in str(caught.value.fields["reason"])


def test_a_number_that_decides_nothing_is_read_as_nought_and_told(tmp_path: Path) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    sound = drawn(read_tags(tags, tmp_path))
    drawing = read_tags(spoilt(tags, span(tags, b"STYLE", section=b"TABLES"), b"41", b"0,8"), tmp_path)
    assert drawn(drawing) == sound
    (repair,) = drawing.reading.repairs
    assert (repair.code, repair.kind, repair.group, repair.text) == ("read-as-zero", "STYLE", 41, "0,8")


@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_two_entities_that_run_together(tmp_path: Path, version: str) -> None:
    document = ten_lines(version)
    handles = [line.dxf.handle for line in document.modelspace()]
    tags = tags_of(document, tmp_path)
    sound = drawn(read_tags(tags, tmp_path))
    at = span(tags, b"LINE", 6)[0]
    drawing = read_tags([*tags[:at], *tags[at + 1 :]], tmp_path)
    assert drawn(drawing) == {row for row in sound if row[0] not in handles[5:7]}
    (repair,) = drawing.reading.repairs
    assert (repair.code, repair.handle, repair.text) == ("run-together", handles[5], handles[6])


def test_without_handles_a_second_layer_tells(tmp_path: Path) -> None:
    tags = tags_of(ten_lines("R12"), tmp_path)
    begin = tags.index((b"  2", b"ENTITIES"))
    tags = [*tags[:begin], *(tag for tag in tags[begin:] if tag[0].strip() != b"5")]
    at = span(tags, b"LINE", 6)[0]
    drawing = read_tags([*tags[:at], *tags[at + 1 :]], tmp_path)
    assert len(drawing.items) == 8
    assert [(repair.code, repair.group) for repair in drawing.reading.repairs] == [("run-together", 8)]


def test_what_mending_deletes_is_told_with_its_handle_once(tmp_path: Path) -> None:
    document = ten_lines()
    dimension = document.modelspace().add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0)).render().dimension
    handle = dimension.dxf.handle
    tags = tags_of(document, tmp_path)
    tags = spoilt(tags, span(tags, b"DIMENSION"), b"2", b"*D99")  # a picture that is not there
    tags = spoilt(tags, span(tags, b"VPORT", section=b"TABLES"), b"20", None)  # what only mending reads
    drawing = read_tags(tags, tmp_path)
    assert "DIMENSION" not in drawing.items.kind.tolist()
    named = [repair for repair in drawing.reading.repairs if handle in (repair.handle, *repair.detail.split("#"))]
    assert [(repair.code, repair.kind, repair.handle) for repair in named] == [("removed", "DIMENSION", handle)]
    assert named[0].line == 2 * span(tags, b"DIMENSION")[0] + 1
    assert sum(handle in repair.detail for repair in drawing.reading.repairs) == 1
    assert len(set(drawing.reading.repairs)) == len(drawing.reading.repairs)


def test_a_file_that_is_cut_off_stays_refused(tmp_path: Path) -> None:
    tags = tags_of(ten_lines(), tmp_path)
    begin = span(tags, b"LINE", 7)[0]
    cut = spoilt(tags, span(tags, b"LINE", 3), b"10", b"7,5")[: begin + 6]
    with pytest.raises(UnreadableError, match=r"dxf\.truncated"):
        read_tags(cut, tmp_path)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("value", [b"8,35", b"1.#QNAN", b"nan"])
def test_the_command_shows_line_entity_tag_and_text(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], language: str, value: bytes
) -> None:
    def output(path: Path, form: str) -> str:
        arguments = ["check", str(path), "--scale", "1:50", "--format", form, "--lang", language]
        assert run(arguments) == 1
        return capsys.readouterr().out

    def told(text: str) -> list[Any]:
        rows = [json.loads(line) for line in text.splitlines()]
        return [(r["name"], r["handle"], r["where"], r["size"]) for r in rows if r["name"] != "needs-recovery"]

    document = new()
    lines = [document.modelspace().add_line((0, n % 9), (4, n % 9)) for n in range(10)]  # the last lies on the first
    handle = lines[4].dxf.handle
    tags = tags_of(document, tmp_path)
    within = span(tags, b"LINE", 4)
    hurt = spoilt(tags, within, b"11", value)
    read_tags(hurt, tmp_path)
    document.modelspace().delete_entity(lines[4])
    (tmp_path / "without").mkdir()
    document.saveas(tmp_path / "without" / "fachada.dxf")

    path = tmp_path / "fachada.dxf"
    found = output(path, "jsonl")
    assert told(found) == told(output(tmp_path / "without" / "fachada.dxf", "jsonl"))
    (repair,) = read(path).reading.repairs
    sentence = repair_sentence(Words(language), repair)
    for word in (str(line_of(hurt, value, within[0])), f"LINE {handle}", "11", value.decode()):
        assert word in sentence
    (row,) = [json.loads(line) for line in found.splitlines() if "needs-recovery" in line]
    assert sentence in row["message"]
    assert (row["handle"], row["layer"]) == (handle, "0")
    text = output(path, "text")
    assert text.count(sentence) == 1
    assert f"1 × LINE ({handle})" in text
    (source,) = json.loads(output(path, "json"))["inputs"]
    assert [repair["message"] for repair in source["repairs"]] == [sentence]
