# SPDX-License-Identifier: MIT
"""Quantities at the edges of what is taken, and every unit against its definition."""

import pytest

from foparq.errors import QuantityError
from foparq.units import LENGTHS, Quantity, parse_any_quantity, parse_length_unit, parse_quantity, parse_scale

METRES = {
    "km": 1000.0, "m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 0.001, "um": 1e-6, "in": 0.0254, "ft": 0.3048, "yd": 0.9144,
}  # fmt: skip


def test_units_of_length_are_those_of_their_definitions() -> None:
    assert METRES == LENGTHS


@pytest.mark.parametrize(("unit", "metres"), METRES.items())
def test_a_unit_of_length_and_its_square(unit: str, metres: float) -> None:
    assert parse_quantity(f"1 {unit}", "m").si() == metres
    assert parse_quantity(f"1 {unit}2", "m2").si() == pytest.approx(metres**2, rel=1e-15)
    assert parse_length_unit(unit) == metres


@pytest.mark.parametrize(
    ("text", "si"),
    [("1 μm", 1e-6), ("1 µm", 1e-6), ('1 "', 0.0254), ("1 '", 0.3048), ("1 inch", 0.0254), ("1 metre", 1.0)],
)
def test_other_spellings_of_a_length(text: str, si: float) -> None:
    assert parse_quantity(text, "m").si() == si
    assert parse_any_quantity(text).si() == si


@pytest.mark.parametrize(("text", "si"), [("2 m²", 2.0), ("2 mm²", 2e-6), ("2 cm²", 2e-4), ("2 m2", 2.0)])
def test_spellings_of_an_area(text: str, si: float) -> None:
    assert parse_quantity(text, "m2").si() == pytest.approx(si, rel=1e-15)
    assert parse_any_quantity(text).symbol == "m2"


def test_ratios_and_counts() -> None:
    assert parse_quantity("12.5 %", "1").si() == 0.125
    assert Quantity(0.25, "1").si() == 0.25
    assert parse_quantity("7 items", "items").si() == 7.0


@pytest.mark.parametrize(("text", "scale", "si"), [("0.2 mm @ scale", 25.0, 0.005), ("2 mm2 @ scale", 10.0, 2e-4)])
def test_at_scale_a_length_grows_by_it_and_an_area_by_its_square(text: str, scale: float, si: float) -> None:
    quantity = parse_any_quantity(text)
    assert quantity.at_scale
    assert quantity.si(scale) == pytest.approx(si, rel=1e-15)


def test_without_at_scale_the_scale_changes_nothing() -> None:
    assert parse_quantity("3 mm", "m").si(50.0) == 0.003


@pytest.mark.parametrize(
    ("quantity", "text"), [(Quantity(0.2, "mm", True), "0.2 mm @ scale"), (Quantity(5, "%"), "5 %")]
)
def test_a_quantity_is_written_as_it_is_read(quantity: Quantity, text: str) -> None:
    assert str(quantity) == text
    assert parse_any_quantity(str(quantity)) == quantity


@pytest.mark.parametrize(
    ("text", "metres"), [("0.000000001 m", 1e-9), ("1000 km", 1e6), (" mm ", 0.001), ("25,4 mm", 0.0254)]
)
def test_drawing_units_up_to_their_bounds(text: str, metres: float) -> None:
    assert parse_length_unit(text) == metres


@pytest.mark.parametrize("text", ["0.00000000099 m", "1001 km", "1 m @ scale", "1 m2"])
def test_drawing_units_beyond_their_bounds(text: str) -> None:
    with pytest.raises(QuantityError) as caught:
        parse_length_unit(text)
    assert caught.value.message == "quantity.unknown-unit"
    assert caught.value.fields["known"] == ", ".join(METRES)


@pytest.mark.parametrize(("text", "scale"), [("1:50", 50.0), ("1 / 20", 20.0), (" 1:0,5 ", 0.5), ("1:2.5", 2.5)])
def test_scales(text: str, scale: float) -> None:
    assert parse_scale(text) == scale


@pytest.mark.parametrize(("text", "symbol", "message"), [
    (5, "m", "quantity.bare-number"), ("5", "m", "quantity.not-understood"),
    ("1e999 m", "m", "quantity.not-understood"),
    ("5 kg", "m", "quantity.wrong-unit"), ("5 %", "m2", "quantity.wrong-unit"), ("5 m", "items", "quantity.wrong-unit"),
])  # fmt: skip
def test_what_is_wrong_is_named_with_an_example_of_its_kind(text: object, symbol: str, message: str) -> None:
    with pytest.raises(QuantityError) as caught:
        parse_quantity(text, symbol)
    assert caught.value.message == message
    assert parse_quantity(caught.value.fields["example"], symbol).symbol == symbol
