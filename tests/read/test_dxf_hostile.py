# SPDX-License-Identifier: MIT
"""No bytes whatsoever end in anything but a drawing or a named refusal."""

import os
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from tests.read.drawn import new, read, read_back, skipped

from foparq.errors import InputError, QuantityError, UnreadableError, UnsafeError
from foparq.profile.schema import LimitsSpec
from foparq.report.words import LANGUAGES, Words

SMALL = LimitsSpec(entities=100_000, vertices=1_000_000)


def sample(folder: Path, version: str = "R2010") -> bytes:
    document = new(version)
    space = document.modelspace()
    space.add_line((0, 0), (1, 1), dxfattribs={"layer": "PAREDE"})
    space.add_circle((0, 0), 1)
    space.add_text("ABC")
    if version != "R12":
        space.add_lwpolyline([(0, 0, 0, 0, 1), (1, 0), (1, 1)], close=True)
        space.add_spline([(0, 0, 0), (2, 3, 0), (5, 1, 0), (7, 4, 0)])
        space.add_ellipse((0, 0), (3, 0), 0.5)
        space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
    block = document.blocks.new("LEAF")
    block.add_line((0, 0), (1, 0))
    space.add_blockref("LEAF", (0, 0), dxfattribs={"row_count": 3, "row_spacing": 2})
    space.add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0), text="3,00 m").render()
    document.saveas(folder / "sample.dxf")
    return (folder / "sample.dxf").read_bytes()


def outcome(path: Path, data: bytes) -> str:
    path.write_bytes(data)
    try:
        drawing = read(path, limits=SMALL)
    except InputError as error:
        pickle.loads(pickle.dumps(error))
        for language in LANGUAGES:
            if Words(language).find(f"errors.{error.message}"):
                assert path.name in Words(language).error(error)  # noqa: PT017 - either end is right
        return error.message
    assert len(set(drawing.items.item.tolist())) == len(drawing.items)
    return "recovered" if drawing.reading.repairs else "read"


TOKENS = [b"0", b"-1", b"1e308", b"nan", b"inf", b"9" * 30, b"", b"\x00", b"INSERT", b"SPLINE", b"5", b"70", b"1e-320",
          b"\xff\xfe", b"*X1", b"\\U+D800", b"32767"]  # fmt: skip


def spoil(data: bytes, source: np.random.Generator) -> bytes:
    way = source.integers(5)
    if way == 0:
        return data[: source.integers(len(data))]
    if way == 1:
        spoilt = bytearray(data)
        for place in source.integers(len(data), size=10):
            spoilt[place] ^= 1 << int(source.integers(8))
        return bytes(spoilt)
    lines = data.split(b"\n")
    if way == 2:
        at, n = int(source.integers(len(lines) // 2)) * 2, int(source.integers(1, 20)) * 2
        del lines[at : at + n]
        return b"\n".join(lines)
    for _ in range(20):  # any line, or only values
        at = int(source.integers(len(lines) - 1))
        lines[at | 1 if way == 3 else at] = TOKENS[source.integers(len(TOKENS))]
    return b"\n".join(lines)


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
def test_spoilt_files(tmp_path: Path, version: str) -> None:
    source = np.random.default_rng(20)
    data = sample(tmp_path, version)
    found = {outcome(tmp_path / "spoilt.dxf", spoil(data, source)) for _ in range(80)}
    assert len(found) > 2  # not everything ends alike


def values_of(data: bytes) -> list[int]:
    # Line numbers of values within the section of entities.
    lines = data.split(b"\n")
    start = lines.index(b"ENTITIES")
    return list(range(start + 2, lines.index(b"ENDSEC", start) - 1, 2))


@pytest.mark.parametrize("token", [b"nan", b"inf", b"1e308", b"-1", b"0", b"1e-320"])
def test_no_number_of_an_entity_stops_the_reader(tmp_path: Path, token: bytes) -> None:
    data = sample(tmp_path)
    lines = data.split(b"\n")
    for at in values_of(data)[::3]:
        try:
            float(lines[at])
        except ValueError:
            continue
        outcome(tmp_path / "spoilt.dxf", b"\n".join([*lines[:at], token, *lines[at + 1 :]]))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "read.empty"),
        (b"AC1032\x00\x00\x00\x00" + bytes(200), "read.dwg"),
        (b"Caderno de encargos\nA parede norte ...\n", "read.unknown-format"),
        (b"PK\x03\x04" + bytes(50), "read.archive"),
        (b"SQLite format 3\x00" + bytes(100), "dxf.not-dxf"),
        (b"0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n1.0\n", "dxf.truncated"),
        (bytes(1000), "read.unknown-format"),
        (b"AutoCAD Binary DXF\r\n\x1a\x00" + bytes(300), None),
        (b"0\nSECTION\n" * 500, None),
        (b"0\nSECTION\n2\nENTITIES\n99999999999\nx\n0\nENDSEC\n0\nEOF\n", "read"),
    ],
)
def test_what_is_no_drawing_is_refused_by_name(tmp_path: Path, data: bytes, message: str | None) -> None:
    got = outcome(tmp_path / "fachada.dxf", data)
    assert got == message or (message is None and got != "read")


def test_truncated_file_names_the_line(tmp_path: Path) -> None:
    data = sample(tmp_path)
    cut = data[: data.index(b"CIRCLE")]
    path = tmp_path / "fachada.dxf"
    path.write_bytes(cut)
    with pytest.raises(UnreadableError) as caught:
        read(path)
    assert caught.value.message == "dxf.truncated"
    assert caught.value.fields == {"file": "fachada.dxf", "line": cut.count(b"\n") + 1}


def test_missing_end_mark_alone_is_mended(tmp_path: Path) -> None:
    data = sample(tmp_path)
    assert outcome(tmp_path / "a.dxf", data[: data.rindex(b"  0\nEOF")]) == "recovered"


def test_folder_missing_file_and_large_file(tmp_path: Path) -> None:
    with pytest.raises(UnreadableError, match=r"dxf\.not-a-file"):
        read(tmp_path)
    with pytest.raises(UnreadableError, match=r"dxf\.not-a-file"):
        read(tmp_path / "nothing.dxf")
    (tmp_path / "large.dxf").write_bytes(b"0\nSECTION\n" * 100)
    with pytest.raises(UnsafeError, match=r"dxf\.too-large"):
        read(tmp_path / "large.dxf", limits=LimitsSpec(bytes=999))


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="needs permissions that can be taken away")
def test_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "closed.dxf"
    path.write_bytes(sample(tmp_path))
    path.chmod(0)
    with pytest.raises(UnreadableError, match=r"dxf\.cannot-open"):
        read(path)


def test_wrong_unit_is_a_fault_of_the_request(tmp_path: Path) -> None:
    with pytest.raises(QuantityError):
        read_back(new(), tmp_path, unit="furlong")


def test_vertices_are_bounded(tmp_path: Path) -> None:
    document = new()
    for n in range(20):
        document.modelspace().add_circle((n, 0), 100)
    with pytest.raises(UnsafeError, match=r"dxf\.too-many-vertices"):
        read_back(document, tmp_path, limits=LimitsSpec(vertices=1000))


def test_one_enormous_circle_is_left_out_and_the_rest_is_read(tmp_path: Path) -> None:
    document = new()
    document.modelspace().add_circle((0, 0), 1e15)
    document.modelspace().add_circle((0, 0), 1)
    drawing = read_back(document, tmp_path)
    assert len(drawing.items) == 1
    assert skipped(drawing) == {("too-many-vertices", "CIRCLE"): 1}


def test_coordinates_that_are_no_numbers_are_delivered(tmp_path: Path) -> None:
    # In a binary file they are what the producer's program held, not what somebody made of a text.
    document = new("R12")
    document.modelspace().add_line((0, 0), (np.nan, 1))
    path = tmp_path / "a.dxf"
    document.saveas(path, fmt="bin")
    drawing = read(path)
    assert np.isnan(shapely.get_coordinates(drawing.items.geometry)).any()
    assert drawing.reading.repairs == ()


@pytest.mark.parametrize("version", ["R12", "R2000", "R2004", "R2007", "R2010", "R2018"])
@pytest.mark.parametrize("binary", [False, True])
def test_accents_survive_every_version(tmp_path: Path, version: str, binary: bool) -> None:  # noqa: FBT001
    document = new(version)
    document.layers.add("Vãos_Ç")
    document.modelspace().add_line((0, 0), (1, 0), dxfattribs={"layer": "Vãos_Ç"})
    path = tmp_path / "a.dxf"
    document.saveas(path, fmt="bin" if binary else "asc")
    drawing = read(path)
    assert drawing.items.layer.tolist() == ["Vãos_Ç"]
    assert drawing.reading.bad_names == ()
    assert drawing.reading.version == document.dxfversion


def test_layers_that_differ_in_case_are_one(tmp_path: Path) -> None:
    document = new()
    document.layers.add("Parede")
    for name in ("PAREDE", "parede", "Parede"):
        document.modelspace().add_line((0, 0), (1, 0), dxfattribs={"layer": name})
    assert set(read_back(document, tmp_path).items.layer) == {"Parede"}


def test_a_drawing_pickles(tmp_path: Path) -> None:
    drawing: Any = pickle.loads(pickle.dumps(read_back(new(), tmp_path)))
    assert len(drawing.items) == 0


def test_reading_twice_gives_the_same(tmp_path: Path) -> None:
    path = tmp_path / "a.dxf"
    path.write_bytes(sample(tmp_path))
    first, second = read(path), read(path)
    assert first.items.item.tolist() == second.items.item.tolist()
    assert first.reading.skipped == second.reading.skipped
    assert shapely.to_wkb(first.items.geometry).tolist() == shapely.to_wkb(second.items.geometry).tolist()
