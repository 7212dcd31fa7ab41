# SPDX-License-Identifier: MIT
"""Quantities as people write them."""

import pytest

from foparq.errors import QuantityError
from foparq.units import parse_any_quantity, parse_length_unit, parse_quantity, parse_scale


@pytest.mark.parametrize(
    ("text", "symbol", "scale", "si"),
    [
        ("0.2 mm @ scale", "m", 50, 0.010),
        ("0.3 mm @ scale", "m", 50, 0.015),
        ("0.3 mm @ scale", "m", 10, 0.003),
        ("0,2 mm @ scale", "m", 50, 0.010),
        ("10mm", "m", None, 0.010),
        ("1 um", "m", None, 1e-6),
        ("1 µm", "m", None, 1e-6),
        ("5 cm", "m", None, 0.05),
        ("1 in", "m", None, 0.0254),
        ("0.04 mm2 @ scale", "m2", 50, 1e-4),
        ("1 m²", "m2", None, 1.0),
        ("10 %", "1", None, 0.1),
        ("1e-6 m", "m", None, 1e-6),
    ],
)
def test_quantity_in_si(text: str, symbol: str, scale: float | None, si: float) -> None:
    assert parse_quantity(text, symbol).si(scale) == si


@pytest.mark.parametrize(
    "text", [10, 0.2, "10", "mm", "", "10 furlongs", "10 mm @ skala", "1.234,5 mm", "nan m", "inf m", None]
)
def test_what_is_no_length(text: object) -> None:
    with pytest.raises(QuantityError) as error:
        parse_quantity(text, "m")
    assert error.value.fields["example"]


@pytest.mark.parametrize("number", ["1.500", "3,000", "12.000", "1.234.567", "100,250"])
def test_a_number_with_three_digits_behind_its_sign_is_no_quantity(number: str) -> None:
    with pytest.raises(QuantityError, match="thousands"):
        parse_quantity(f"{number} mm", "m")
    with pytest.raises(QuantityError, match="thousands"):
        parse_scale(f"1:{number}")


@pytest.mark.parametrize(
    ("number", "metres"), [("0.500", 0.5), ("1.5", 1.5), ("1,50", 1.5), ("1.5000", 1.5), ("1500", 1500)]
)
def test_any_other_number_is_one(number: str, metres: float) -> None:
    assert parse_quantity(f"{number} m", "m").si() == metres
    assert parse_scale(f"1:{number}") == metres


def test_an_area_is_no_length() -> None:
    with pytest.raises(QuantityError, match="wrong-unit"):
        parse_quantity("1 m2", "m")


def test_a_length_at_scale_needs_the_scale() -> None:
    with pytest.raises(QuantityError, match="no-scale"):
        parse_quantity("0.2 mm @ scale", "m").si()


def test_kind_is_told_by_the_unit() -> None:
    assert [parse_any_quantity(text).symbol for text in ("1 mm", "1 m2", "5 %", "3 items")] == ["m", "m2", "1", "items"]


@pytest.mark.parametrize(
    ("text", "metres"), [("mm", 0.001), ("in", 0.0254), ('"', 0.0254), ("0.641 m", 0.641), ("m", 1.0)]
)
def test_drawing_units(text: str, metres: float) -> None:
    assert parse_length_unit(text) == metres


@pytest.mark.parametrize("text", ["", "5", "kg", "1:50", "0 m", "-1 m", "0.2 mm @ scale"])
def test_what_is_no_drawing_unit(text: str) -> None:
    with pytest.raises(QuantityError):
        parse_length_unit(text)


@pytest.mark.parametrize("text", ["50", "1:0", "1:-5", "2:1", "", None, 50, "1:x"])
def test_what_is_no_scale(text: object) -> None:
    with pytest.raises(QuantityError):
        parse_scale(text)
