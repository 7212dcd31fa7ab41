# SPDX-License-Identifier: MIT
"""Lettered lengths and names."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foparq.model.lettering import lettered_length
from foparq.read.dxf.text import override_text, plain_lettering, readable
from foparq.read.letters import doubly_encoded

INCH = 0.0254


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("3'-1\"", 37 * INCH),
        ("16'-0\"", 192 * INCH),
        ("12'-6 1/2\"", 150.5 * INCH),
        ("9'-11 15/16\"", 119.9375 * INCH),
        ("5'", 60 * INCH),
        ("5′ 3″", 63 * INCH),
        ('6"', 6 * INCH),
        ('1/2"', INCH / 2),
        ('3-1/2"', 3.5 * INCH),
        ("5 ft 3 in", 63 * INCH),
        ("2.50 m", 2.5),
        ("2,50m", 2.5),
        ("1.20m", 1.2),
        ("120 cm", 1.2),
        ("1200mm", 1.2),
        ("1.234,5 mm", 1.2345),
        ("≈ 2,5 m", 2.5),
        ("2,50 m (typ.)", 2.5),
    ],
)
def test_lettering_with_a_unit(text: str, metres: float) -> None:
    assert lettered_length(text) == (pytest.approx(metres, rel=1e-9), None)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("2,50", 2.5),
        ("350", 350.0),
        ("2.500", 2.5),
        ("1.234,50", 1234.5),
        ("1,234.50", 1234.5),
        ("1.234.567", 1234567.0),
    ],
)
def test_number_alone(text: str, number: float) -> None:
    assert lettered_length(text) == (None, number)


@pytest.mark.parametrize(
    "text",
    ["", " ", "<>", "VAR", "R5", "Ø 20", "1:50", "2.50m²", "h=2.50", "45°", "-", "..", "1,2,3", "6'-101/2\"", '1/0"',
     "m", "ver detalhe 3'-1\" no desenho anexo, prancha 12 de 40"],
)  # fmt: skip
def test_texts_that_state_no_length(text: str) -> None:
    assert lettered_length(text) == (None, None)


@given(st.text(max_size=60))
def test_any_text_is_answered(text: str) -> None:
    metres, number = lettered_length(text)
    assert metres is None or number is None


@given(st.integers(0, 200), st.integers(0, 11), st.integers(0, 15))
def test_architectural_lettering_reads_back(feet: int, inches: int, sixteenths: int) -> None:
    fraction = f" {sixteenths}/16" if sixteenths else ""
    stated, _ = lettered_length(f"{feet}'-{inches}{fraction}\"")
    assert stated == pytest.approx((feet * 12 + inches + sixteenths / 16) * INCH, abs=1e-8)


@pytest.mark.parametrize(("text", "shown"), [
    ("", ""), ("<>", ""), (" ", ""), ("<> m", ""),  # repeats the measured length
    ("\\A1;3'-1\"", "3'-1\""),
    ("6'-10\\S1#2;\"", "6'-10 1/2\""),
    ("{\\H0.7x;2,50}", "2,50"),
    ("2,50\\S+0.01^-0.01;", "2,50"),
])  # fmt: skip
def test_override_of_a_dimension(text: str, shown: str) -> None:
    assert override_text(text) == shown


def test_formatting_is_left_out() -> None:
    assert plain_lettering("\\pxqc;{\\fArial|b0;2,50 m}") == "2,50 m"


@pytest.mark.parametrize(("name", "shown"), [
    ("PAREDE", "PAREDE"),
    ("V\\U+00E3os", "Vãos"),
    ("\\M+18CA", "\\M+18CA"),  # not a whole escape
    ("\\M+1836A", "ニ"),
    ("a\udce9b", "a\ufffdb"),  # a byte that the encoding does not know
    ("\\U+D800", "\ufffd"),
])  # fmt: skip
def test_readable_names(name: str, shown: str) -> None:
    assert readable(name) == shown


@given(st.text(min_size=1, max_size=12))
def test_readable_names_can_be_written(name: str) -> None:
    readable(name).encode("utf-8")


@pytest.mark.parametrize("name", ["Vãos", "ESQUADRIA_Ç", "Строения", "Ê", "éven", "Ångström", "ÁREA ÚMIDA", "Côté"])
def test_sound_names(name: str) -> None:
    assert not doubly_encoded(name, "cp1252")
    assert not doubly_encoded(name, "cp1251")


@pytest.mark.parametrize("name", ["Vãos", "VÃO Ç", "éven", "Строения", "ÁREA"])
def test_names_read_in_the_wrong_encoding(name: str) -> None:
    spoilt = "".join(
        bytes([byte]).decode("cp1252") if byte not in {0x81, 0x8D, 0x8F, 0x90, 0x9D} else chr(byte)
        for byte in name.encode()
    )
    assert doubly_encoded(spoilt, "cp1252")
    assert doubly_encoded(spoilt, "utf-8")


@pytest.mark.parametrize("text", ["{" * 10**6, r"\S1" * 300_000, "1" + " " * 10**6 + "x", r"\M+1" * 250_000])
def test_a_lettering_without_end_is_read_from_its_beginning_only(text: str) -> None:
    assert len(plain_lettering(text)) <= 2_000
    assert lettered_length(text) == (None, None)
