# SPDX-License-Identifier: MIT
"""Points of texts as people and programs write them, and texts that are none."""

from pathlib import Path

import numpy as np
import pytest
from tests.read.cloud.files import POINTS, read, refused

from foparq.read.mesh import text

ROWS = POINTS.tolist()


def lines(separator: str, *, comma: bool = False, more: str = "", end: str = "\n") -> str:
    rows = [separator.join(repr(part) for part in row) + more for row in ROWS]
    made = end.join([*rows, ""])
    return made.replace(".", ",") if comma else made


@pytest.mark.parametrize(
    "written",
    [
        lines(" "), lines("\t"), lines(","), lines(";"), lines("   "), lines(", "), lines(" ; "),
        lines(" ", end="\r\n"), lines(";", end="\r"), lines(" ").rstrip("\n"), lines(" ") + "\x1a",
        lines(";", comma=True), lines("\t", comma=True), lines(" ", comma=True),
        lines(" ", more=" 255 128 0"), lines(";", more=";wall;;2026-11-30"), lines(",", more=',"a wall"'),
        "\ufeff" + lines(" "), "# a remark\n\n" + lines(" "), "//X Y Z\n" + lines(" "), "  " + lines(" "),
        "x y z\n" + lines(" "), "X;Y;Z\n" + lines(";"), '"x","y","z"\n' + lines(","),
        "x;y;z;classe\n" + lines(";", comma=True, more=";parede"),
    ],
)  # fmt: skip
def test_numbers_are_those_that_are_written(written: str, tmp_path: Path) -> None:
    cloud = read(tmp_path, written)
    assert cloud.points.tolist() == ROWS
    assert (cloud.empty, cloud.version) == (0, "text")


def test_named_columns_count_wherever_they_stand(tmp_path: Path) -> None:
    written = "id;z;note;x;y\n" + "".join(f"P{k};{z};corner of wall;{x};{y}\n" for k, (x, y, z) in enumerate(ROWS))
    assert read(tmp_path, written).points.tolist() == ROWS


def test_a_piece_ends_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(1)
    points = np.round(rng.uniform(-9, 9, (300, 3)), 4)
    written = "x,y,z\n" + "".join(f"{x},{y},{z}\n# remark\n" for x, y, z in points.tolist())
    monkeypatch.setattr(text, "PIECE", 97)
    assert read(tmp_path, written).points.tolist() == points.tolist()


@pytest.mark.parametrize("word", ["nan", "NaN", "-inf", "1.#QNAN", "1e999", "1e300"])
def test_points_without_coordinates_are_counted_and_not_used(word: str, tmp_path: Path) -> None:
    cloud = read(tmp_path, f"0 0 {word}\n1 2 3\n{word} {word} {word}\n")
    assert cloud.points.tolist() == [[1, 2, 3]]
    assert cloud.empty == 2


@pytest.mark.parametrize(
    ("written", "line", "value"),
    [
        ("1 2 3\n4 5\n", 2, "4 5"),
        ("1 2 3\n\n# a\n4 five 6\n", 4, "4 five 6"),
        ("1 2 3\n4 5 6m\n", 2, "4 5 6m"),
        ("1;2;3\n4;;6\n", 2, "4;;6"),
        ("1;2;3\n4 4;;6\n", 2, "4 4;;6"),
        ("x;y;z\n1;2;3\n4;5;\n", 3, "4;5;"),
        ("1;2;3\n4;5 6;7\n", 2, "4;5 6;7"),
        ("0,5;2,5;3,5\n1.234,5;1,5;2,5\n", 2, "1.234,5;1,5;2,5"),
        ("0,5;2,5;3,5\n1.5;1,5;2,5\n", 2, "1.5;1,5;2,5"),
        ("0.5;2.5;3.5\n1,5;1.5;2.5\n", 2, "1,5;1.5;2.5"),
        ("1,2,3\n4,5\n", 2, "4,5"),
        ("P1 1 2 3\nP2 1 2 3\n", 1, "P1 1 2 3"),
    ],
)
def test_a_line_that_is_no_point_is_refused_by_its_number(written: str, line: int, value: str, tmp_path: Path) -> None:
    error = refused(tmp_path, written)
    assert error.message == "mesh.line"
    assert (error.fields["line"], error.fields["value"], error.fields["file"]) == (line, value, "cloud")


@pytest.mark.parametrize("written", ["1,234 2,345 3,456\n", "1,234;5,678;9,012\n"])
def test_a_comma_that_may_part_thousands_is_not_guessed(written: str, tmp_path: Path) -> None:
    assert refused(tmp_path, written).message == "cloud.thousands"


@pytest.mark.parametrize("proof", ["0,500", "12345,678", "1,23"])
def test_one_number_proves_what_commas_are(proof: str, tmp_path: Path) -> None:
    cloud = read(tmp_path, f"1,234;2,345;{proof}\n")
    assert cloud.points.tolist() == [[1.234, 2.345, float(proof.replace(",", "."))]]


@pytest.mark.parametrize("head", ["E N H", "x y", "easting;northing;height", "x x y z", "Relatório do levantamento"])
def test_named_columns_without_each_axis_once_are_refused(head: str, tmp_path: Path) -> None:
    assert refused(tmp_path, f"{head}\n1 2 3\n").message == "cloud.columns"


def test_more_points_than_allowed_are_refused(tmp_path: Path) -> None:
    assert refused(tmp_path, "1 2 3\n" * 4, points=3).message == "cloud.too-many-points"
    assert len(read(tmp_path, "# remark\n\n" + "1 2 3\n" * 3, points=3).points) == 3


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "read.empty"), (b"\n\n", "cloud.no-points"), (b"# x y z\n", "cloud.no-points"),
        (b"nan nan nan\n", "cloud.no-points"), (b"PK\x03\x04...", "read.archive"),
        (b"ASTM-E57...", "cloud.not-a-cloud"), (b"1 2 \x00 3\n", "cloud.not-a-cloud"),
        (b"# .PCD v0.7\n", "cloud.not-a-cloud"), (b"%PDF-1.7\n", "cloud.not-a-cloud"),
        (b"glTF\x02\x00\x00\x00", "cloud.not-a-cloud"), (b"1 2 3\n1 \x07 3\n", "mesh.control"),
        ("1 2 3\n".encode("utf-16"), "mesh.control"),
    ],
)  # fmt: skip
def test_what_is_no_text_of_points_is_refused(data: bytes, message: str, tmp_path: Path) -> None:
    assert refused(tmp_path, data).message == message
