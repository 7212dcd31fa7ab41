# SPDX-License-Identifier: MIT
"""Slips that small offices make, each answered with what to write."""

from pathlib import Path

import pytest

from foparq.errors import FoparqError, ManifestError, QuantityError, UnreadableError
from foparq.model.delivery import Source, SourceStatus
from foparq.profile.load import load_manifest
from foparq.profile.manifest import SurveySection
from foparq.profile.terms import Reviewer, terms_of
from foparq.read.guard.sniff import format_of
from foparq.read.intake import identified
from foparq.read.table.names import DISTANCE_COLUMNS, DISTANCE_PHRASES, plain_name
from foparq.read.table.tables import read_checkpoints, read_distances
from foparq.report.words import Words
from foparq.units import LENGTHS, parse_length_unit

SECTION = SurveySection(path="t.csv")


def told(error: FoparqError, language: str = "pt-BR") -> str:
    return Words(language).error(error)


@pytest.mark.parametrize(
    ("word", "unit"),
    [
        ("metros", "m"), ("Metro", "m"), ("MM", "mm"), ("milímetros", "mm"), ("centimetro", "cm"), ("Polegadas", "in"),
        ("pés", "ft"), ("pe", "ft"), ("feet", "ft"), ("quilômetros", "km"), ("m.", "m"),
        ("jardas", "yd"), ("stone", "m"),
    ],
)  # fmt: skip
def test_a_word_for_a_unit_is_answered_with_its_symbol(tmp_path: Path, word: str, unit: str) -> None:
    with pytest.raises(QuantityError) as caught:
        parse_length_unit(word)
    assert caught.value.fields["example"] == unit
    assert set(str(caught.value.fields["known"]).split(", ")) == set(LENGTHS)
    path = tmp_path / "delivery.toml"
    path.write_text(f'[[drawing]]\npath = "a.dxf"\nunit = "{word}"\n', encoding="utf-8")
    with pytest.raises(ManifestError) as wrong:
        load_manifest(path)
    assert wrong.value.fields["line"] == 3
    assert told(wrong.value).endswith(f'Exemplo: unit = "{unit}"')
    assert word == "stone" or f"(conhecidas: {unit}, " in told(wrong.value)


def test_a_missing_scale_is_placed_under_delivery(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    for text, line in (('# a\n\n[delivery]\ntitle = "Casa"\n', 3), ('[[drawing]]\npath = "a.dxf"\n', 1)):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ManifestError) as caught:
            terms_of(load_manifest(path), path, Reviewer())
        assert (caught.value.fields["line"], caught.value.fields["key"]) == (line, "scale")
        assert "[delivery]" in told(caught.value)
        assert "[delivery]" in told(caught.value, "en")


@pytest.mark.parametrize(
    ("measured", "delivered"),
    [
        ("Medida em campo", "Medida no desenho"), ("Medida (campo)", "Medida (desenho)"),
        ("Distância medida (m)", "Distância no desenho (m)"), ("MEDIDA IN LOCO", "MEDIDA NO CAD"),
        ("Comprimento real", "Comprimento desenhado"), ("Medida [campo, m]", "Medida [desenho, m]"),
        ("Measured length", "Length in the drawing"), ("Medida en campo", "Medida en el dibujo"),
        ("medida", "desenho"), ("Trena (m)", "CAD (m)"), ("Valor de campo", "Valor de desenho"),
    ],
)  # fmt: skip
def test_where_a_length_was_taken_names_its_column(tmp_path: Path, measured: str, delivered: str) -> None:
    path = tmp_path / "t.csv"
    path.write_text(f"id;{delivered};{measured}\nD1;2,5;2,75\n", encoding="utf-8")
    table = read_distances(path, SECTION)
    assert (table.measured.tolist(), table.delivered.tolist()) == ([2.75], [2.5])


def test_no_name_means_two_columns() -> None:
    names = {
        column: {plain_name(name) for name in (column, *DISTANCE_COLUMNS[column], *DISTANCE_PHRASES[column])}
        for column in DISTANCE_PHRASES
    }
    assert names["measured"].isdisjoint(names["delivered"])
    others = {plain_name(name) for key, words in DISTANCE_COLUMNS.items() if key not in names for name in (key, *words)}
    assert others.isdisjoint(names["measured"] | names["delivered"])


@pytest.mark.parametrize("header", ["Ponto;X no desenho;Y no desenho;Z no desenho;X levantada;Y levantada;Z levantada"])
def test_coordinates_of_drawing_and_field(tmp_path: Path, header: str) -> None:
    path = tmp_path / "t.csv"
    path.write_text(f"{header}\nP1;1,5;2,5;3,5;4,5;5,5;6,5\n", encoding="utf-8")
    table = read_checkpoints(path, SECTION)
    assert table.surveyed.tolist() == [[4.5, 5.5, 6.5]]
    assert table.delivered.tolist() == [[1.5, 2.5, 3.5]]


def test_headers_that_nobody_knows_are_answered_with_all_that_are_taken(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_text("Marca;Coord 1;Coord 2;Coord 3\nP1;1,5;2,5;3,5\n", encoding="utf-8")
    with pytest.raises(UnreadableError) as caught:
        read_checkpoints(path, SECTION)
    for language in ("en", "pt-BR"):
        text = told(caught.value, language)
        for word in ("Marca", "Coord 3", "id: id, ponto", "x: x, e, este, leste", "z: z, h, cota", "id;x;y;z"):
            assert word in text


@pytest.mark.parametrize("cell", ["#N/D", "#N/A", "#REF!", "#VALOR!"])
def test_a_cell_of_a_formula_that_failed_is_named(tmp_path: Path, cell: str) -> None:
    path = tmp_path / "t.csv"
    path.write_text(f"id;x;y;z\nP1;1,5;2,5;3,5\nP2;1,5;{cell};3,5\n", encoding="utf-8")
    with pytest.raises(UnreadableError) as caught:
        read_checkpoints(path, SECTION)
    text = told(caught.value)
    assert 'linha 3, coluna "y"' in text
    assert cell in text
    assert "fórmula" in text


def test_a_print_is_no_drawing(tmp_path: Path) -> None:
    (tmp_path / "a.pdf").write_bytes(b"%PDF-1.7\n")
    (tmp_path / "a.dwg").write_bytes(b"AC1032\x00\x00\x00\x00\x00")
    for name, words in (("a.pdf", ("PDF", "DXF")), ("a.dwg", ("DWG", "DXF"))):
        with pytest.raises(UnreadableError) as caught:
            format_of(tmp_path / name)
        assert all(word in told(caught.value) for word in (name, *words))


@pytest.mark.parametrize(
    ("named", "like"),
    [
        ("fachada_norte.dxf", "fachada-norte.dxf"),
        ("facada-norte.dxf", "fachada-norte.dxf"),
        ("corte.dxf", None),
        ("fachada-norte.gpkg", None),
    ],
)
def test_a_wrong_path_is_answered_with_the_name_most_like_it(tmp_path: Path, named: str, like: str | None) -> None:
    (tmp_path / "plantas").mkdir()
    for name in ("fachada-norte.dxf", "fachada-norte.csv", "pontos.dxf"):
        (tmp_path / "plantas" / name).write_text("0\nEOF\n")
    path = f"plantas/{named}"
    source = Source(path=path, role="drawing", sha256="", bytes=0, status=SourceStatus.REFUSED)
    found = identified(source, tmp_path / path, 10**6)
    assert found.status is SourceStatus.MISSING
    assert dict(found.fields).get("other") == (f"plantas/{like}" if like else None)
    assert found.error == ("read.missing-near" if like else "read.missing")
