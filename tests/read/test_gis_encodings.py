# SPDX-License-Identifier: MIT
"""Names in a Shapefile: as its code page states, read right where the bytes prove more, and told where lost."""

from pathlib import Path

import pytest
from tests.read.gis_files import read, write

from foparq.model.drawing import Reading

_HOLD = b"XXXXXXXXXXXXXXXX"  #: place of a name in the table


def _shapefile(folder: Path, name: bytes, cpg: str | None, language: int = 0) -> tuple[str, Reading]:
    """Layer of the one line of a Shapefile whose table holds these bytes, and what was learned of the file."""
    path = write(folder / "a.shp", ["LINESTRING (0 0, 1 0)"], camada=[_HOLD.decode()])
    table = bytearray(path.with_suffix(".dbf").read_bytes())
    at = table.index(_HOLD)
    table[at : at + len(_HOLD)] = name.ljust(len(_HOLD))
    table[29] = language
    path.with_suffix(".dbf").write_bytes(bytes(table))
    if cpg is None:
        path.with_suffix(".cpg").unlink(missing_ok=True)
    else:
        path.with_suffix(".cpg").write_text(cpg, encoding="ascii")
    drawing = read(path)
    return str(drawing.items.layer[0]), drawing.reading


@pytest.mark.parametrize(
    ("cpg", "raw", "name"),
    [
        ("UTF-8", "VÃO".encode(), "VÃO"), ("utf8", "VÃO".encode(), "VÃO"), ("1252", b"V\xc3O", "VÃO"),
        ("ISO-8859-1", b"V\xc3O", "VÃO"), ("88591", b"V\xc3O", "VÃO"), ("ANSI 1252", b"V\xc3O \x80", "VÃO €"),
        ("850", b"V\xc7O", "VÃO"), ("OEM 850", b"V\xc7O", "VÃO"), ("IBM860", b"V\x8eO", "VÃO"),
        ("macintosh", b"V\xccO", "VÃO"), ("ISO-8859-15", b"\xa4", "€"), ("1251", b"\xd1\xd2", "СТ"),
    ],
)  # fmt: skip
def test_the_stated_code_page_is_used(tmp_path: Path, cpg: str, raw: bytes, name: str) -> None:
    layer, reading = _shapefile(tmp_path, raw, cpg)
    assert (layer, reading.bad_names, reading.repairs) == (name, (), ())


@pytest.mark.parametrize("language", [0x02, 0x01, 0x57], ids=hex)
def test_the_code_page_of_the_header_is_used_without_a_cpg(tmp_path: Path, language: int) -> None:
    raw = b"\x82" if language != 0x57 else b"\xe9"  # é in the two pages of DOS, and in that of Windows
    assert _shapefile(tmp_path, raw, None, language)[0] == "é"


def test_utf8_is_proven_by_its_bytes_where_nobody_says_anything(tmp_path: Path) -> None:
    layer, reading = _shapefile(tmp_path, "VÃO_É".encode(), None)
    assert (layer, reading.bad_names, reading.encoding) == ("VÃO_É", (), "UTF-8")


def test_bytes_that_are_no_utf8_prove_nothing(tmp_path: Path) -> None:
    assert _shapefile(tmp_path, b"V\xc3O", None)[0] == "VÃO"  # as GDAL reads it: Latin-1


@pytest.mark.parametrize("cpg", ["1252", "ISO-8859-1", "850", "LDID/87", "ANSI 1252"])
def test_utf8_under_a_code_page_that_lies_is_told(tmp_path: Path, cpg: str) -> None:
    layer, reading = _shapefile(tmp_path, "VÃO".encode(), cpg)
    assert layer != "VÃO"
    assert reading.bad_names == (layer,)


def test_other_bytes_under_utf8_are_told_and_the_file_is_read(tmp_path: Path) -> None:
    layer, reading = _shapefile(tmp_path, b"V\xc3O", "UTF-8")
    assert (layer, reading.bad_names) == ("V\ufffdO", ("V\ufffdO",))


def test_a_code_page_that_nobody_knows_is_told(tmp_path: Path) -> None:
    _, reading = _shapefile(tmp_path, b"V\xc3O", "FOO99")
    assert [(one.code, one.text, one.loses) for one in reading.repairs] == [("code-page-unknown", "FOO99", False)]


def test_names_in_a_geopackage_that_were_encoded_twice_are_told(tmp_path: Path) -> None:
    spoilt = "Vão".encode().decode("latin-1")
    reading = read(write(tmp_path / "a.gpkg", ["POINT (0 0)", "POINT (1 0)"], Layer=[spoilt, "VÃO"])).reading
    assert reading.bad_names == (spoilt,)
