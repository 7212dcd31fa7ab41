# SPDX-License-Identifier: MIT
"""Names in the code page that a DXF file states, on every way of reading."""

import struct
from pathlib import Path

import pytest

from foparq.model.drawing import Reading
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf
from foparq.read.letters import encoding_of

#: a name, and its bytes as the charts of the code pages give them
PAGES = [
    ("dos437", b"GRA\x87A \x82", "GRAçA é"),
    ("dos850", b"V\xc7O_PORT\xc6o", "VÃO_PORTão"),
    ("DOS850", b"V\xc7O_PORT\xc6o", "VÃO_PORTão"),
    ("dos860", b"V\x8eO_PORT\x84o", "VÃO_PORTão"),
    ("dos863", b"\x82tage", "étage"),
    ("macintosh", b"V\xccO_PORT\x8bo", "VÃO_PORTão"),
    ("mac-roman", b"V\xccO_PORT\x8bo", "VÃO_PORTão"),
    ("iso8859-1", b"V\xc3O_PORT\xe3o", "VÃO_PORTão"),
    ("ISO8859-2", b"\xb1le\xbb", "ąleť"),
    ("iso8859-9", b"CEPHE \xfd", "CEPHE ı"),
    ("8859_15", b"\xa4 V\xe3o", "€ Vão"),
    ("ANSI_1252", b"V\xc3O_PORT\xe3o", "VÃO_PORTão"),
    ("ansi_1251", b"\xd1\xd2\xc5\xcd\xc0", "СТЕНА"),
    ("dos866", b"\x91\x92\x85\x8d\x80", "СТЕНА"),
    ("dos864", b"100 \x9d", "100 ﻻ"),
    ("ANSI_1361", b"\x88\x61", "가"),
    ("dos852", b"\x9f\xa0ra", "čára"),
]


def _tags(*pairs: tuple[int, bytes]) -> bytes:
    return b"".join(b"%3d\r\n%s\r\n" % pair for pair in pairs)


def _line(layer: bytes, x: bytes = b"1.0") -> bytes:
    return _tags((0, b"LINE"), (8, layer), (10, b"0.0"), (20, b"0.0"), (11, x), (21, b"0.0"))


def _drawing(page: bytes, *entities: bytes, version: bytes = b"AC1009", end: bool = True) -> bytes:
    header = [(0, b"SECTION"), (2, b"HEADER"), (9, b"$ACADVER"), (1, version)]
    if page:
        header += [(9, b"$DWGCODEPAGE"), (3, page)]
    text = _tags(*header, (0, b"ENDSEC"), (0, b"SECTION"), (2, b"ENTITIES")) + b"".join(entities)
    return text + _tags((0, b"ENDSEC"), (0, b"EOF")) if end else text + _tags((0, b"ENDSEC"))


def _read(path: Path, content: bytes) -> tuple[list[str], Reading]:
    path.write_bytes(content)
    raw = read_dxf(path, limits=LimitsSpec(), sagitta=0.001, unit="m", blocks="explode")
    return sorted(set(raw.items.layer.tolist())), raw.reading


@pytest.mark.parametrize(("page", "raw", "name"), PAGES, ids=[page for page, _, _ in PAGES])
def test_names_are_read_in_the_stated_code_page(tmp_path: Path, page: str, raw: bytes, name: str) -> None:
    layers, reading = _read(tmp_path / "a.dxf", _drawing(page.encode(), _line(raw)))
    assert layers == [name]
    assert reading.repairs == ()
    assert reading.bad_names == ()


def test_names_are_read_in_the_stated_code_page_beside_a_damaged_entity(tmp_path: Path) -> None:
    content = _drawing(b"dos850", _line(b"V\xc7O"), _line(b"PORT\xc6O", x=b"8,35"))
    layers, reading = _read(tmp_path / "a.dxf", content)
    assert layers == ["VÃO"]
    assert [(repair.code, repair.layer) for repair in reading.repairs] == [("no-number", "PORTãO")]


def test_names_are_read_in_the_stated_code_page_where_a_file_is_mended(tmp_path: Path) -> None:
    # A variable after the header and no end mark: only mending reads it.
    stray = _tags((0, b"ENDSEC"), (0, b"ENDSEC"), (0, b"SECTION"), (2, b"ENTITIES"))
    layers, reading = _read(tmp_path / "a.dxf", _drawing(b"dos860", _line(b"V\x8eO"), stray, end=False))
    assert layers == ["VÃO"]
    assert reading.repairs


@pytest.mark.parametrize("wide", [False, True], ids=["R12", "R2000"])
def test_names_of_a_binary_file_are_read_in_the_stated_code_page(tmp_path: Path, *, wide: bool) -> None:
    def code(number: int) -> bytes:
        return number.to_bytes(2 if wide else 1, "little")

    def text(number: int, value: bytes) -> bytes:
        return code(number) + value + b"\x00"

    def real(number: int, value: float) -> bytes:
        return code(number) + struct.pack("<d", value)

    content = b"AutoCAD Binary DXF\r\n\x1a\x00" + b"".join([
        text(0, b"SECTION"), text(2, b"HEADER"), text(9, b"$ACADVER"), text(1, b"AC1015" if wide else b"AC1009"),
        text(9, b"$DWGCODEPAGE"), text(3, b"dos850"), text(0, b"ENDSEC"), text(0, b"SECTION"), text(2, b"ENTITIES"),
        text(0, b"LINE"), text(8, b"V\xc7O"), real(10, 0.0), real(20, 0.0), real(11, 1.0), real(21, 0.0),
        text(0, b"ENDSEC"), text(0, b"EOF"),
    ])  # fmt: skip
    layers, _ = _read(tmp_path / "a.dxf", content)
    assert layers == ["VÃO"]


def test_the_code_page_of_a_newer_file_does_not_matter(tmp_path: Path) -> None:
    content = _drawing(b"dos999", _line("VÃO".encode()), version=b"AC1021")
    layers, reading = _read(tmp_path / "a.dxf", content)
    assert layers == ["VÃO"]
    assert not [repair for repair in reading.repairs if repair.code == "code-page-unknown"]


def test_a_code_page_that_nobody_knows_is_told_once(tmp_path: Path) -> None:
    _, reading = _read(tmp_path / "a.dxf", _drawing(b"dos999", _line(b"PAREDE")))
    assert [(repair.code, repair.text) for repair in reading.repairs] == [("code-page-unknown", "dos999")]
    assert not reading.repairs[0].loses


def test_a_file_that_states_no_code_page_is_not_charged_with_an_unknown_one(tmp_path: Path) -> None:
    layers, reading = _read(tmp_path / "a.dxf", _drawing(b"", _line(b"V\xc3O")))
    assert (layers, reading.repairs) == (["VÃO"], ())


def test_one_file_teaches_nothing_for_the_next(tmp_path: Path) -> None:
    _read(tmp_path / "a.dxf", _drawing(b"dos850", _line(b"V\xc7O")))
    layers, _ = _read(tmp_path / "b.dxf", _drawing(b"ANSI_1252", _line(b"V\xc3O")))
    assert layers == ["VÃO"]


def test_utf8_under_a_dos_code_page_is_told_as_encoded_twice(tmp_path: Path) -> None:
    layers, reading = _read(tmp_path / "a.dxf", _drawing(b"dos850", _line("VÃO".encode())))
    assert reading.bad_names == tuple(layers)


@pytest.mark.parametrize(
    ("page", "version"), [(b"ANSI_1252", b"AC1021"), (b"ascii", b"AC1009")], ids=["R2007", "ascii"]
)
def test_bytes_that_mean_nothing_in_the_encoding_are_told(tmp_path: Path, page: bytes, version: bytes) -> None:
    layers, reading = _read(tmp_path / "a.dxf", _drawing(page, _line(b"V\xc3O"), version=version))
    assert layers == ["V\ufffdO"]
    assert reading.bad_names == ("V\ufffdO",)


@pytest.mark.parametrize("stated", ["dos037", "cp500", "utf-16", "dos999", "rot13", "hex", "", "1e9", "iso8859-12"])
def test_what_is_no_code_page_of_a_drawing_is_unknown(stated: str) -> None:
    assert encoding_of(stated) == ""
