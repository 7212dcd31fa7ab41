# SPDX-License-Identifier: MIT
"""How finely a table was written: half the last digit of both columns, axis by axis."""

from pathlib import Path

import numpy as np
import pytest

from foparq.errors import UnreadableError
from foparq.profile.manifest import SurveySection
from foparq.read.table.numbers import _written_decimals, number_of
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

METRES = SurveySection(path="t.csv")


def table(folder: Path, text: str) -> Path:
    path = folder / "t.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_each_axis_has_the_digits_of_its_own_columns(tmp_path: Path) -> None:
    rows = "".join(f"P{n};1,{n}23;2,{n}234;3,{n}2;1,{n}2;2,{n}2345;3,{n}\n" for n in range(1, 7))
    points = read_checkpoints(table(tmp_path, "id;x;y;z;xd;yd;zd\n" + rows), METRES)
    # X: millimetres and centimetres; Y: tenths and hundredths of a millimetre; Z: centimetres and decimetres.
    np.testing.assert_allclose(points.resolution, [0.0055, 0.000055, 0.055], rtol=1e-12)


def test_order_of_columns_is_not_order_of_axes(tmp_path: Path) -> None:
    text = "zd;id;y;xd;x;z;yd\n9,1;P1;2,123;1,25;1,5;9,0;2,12\n"
    points = read_checkpoints(table(tmp_path, text), METRES)
    assert points.surveyed.tolist() == [[1.5, 2.123, 9.0]]
    assert points.delivered.tolist() == [[1.25, 2.12, 9.1]]
    np.testing.assert_allclose(points.resolution, [0.055, 0.0055, 0.1], rtol=1e-12)


@pytest.mark.parametrize(
    ("numbers", "half"),
    [
        (["1.25", "1.37", "1.3"], 0.005),  # two thirds exactly show the finest digit
        (["1.25", "1.37", "1.3", "1.4"], 0.05),  # half of them do
        (["1.251", "1.37", "1.3", "1.4"], 0.05),
        (["1", "2"], 0.5),
        (["1e2"], 50.0),
        (["1.5e-2"], 0.0005),
        (["1.25e1"], 0.05),
    ],
)
def test_the_digits_of_a_column(tmp_path: Path, numbers: list[str], half: float) -> None:
    text = "id,measured\n" + "".join(f"D{n},{number}\n" for n, number in enumerate(numbers))
    rows = read_distances(table(tmp_path, text), METRES)
    assert rows.resolution == pytest.approx(half, rel=1e-12)
    assert np.isnan(rows.delivered).all()


@pytest.mark.parametrize(("unit", "metres"), [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("ft", 0.3048)])
def test_digits_are_in_the_unit_of_the_table(tmp_path: Path, unit: str, metres: float) -> None:
    section = SurveySection(path="t.csv", unit=unit, survey_sd="4 mm")
    path = table(tmp_path, "id;x;y;z;xd;yd;zd\nP1;250,5;8,25;3;250,5;8,5;3\n")
    points = read_checkpoints(path, section)
    assert points.surveyed[0] == pytest.approx(np.array([250.5, 8.25, 3.0]) * metres, rel=1e-15)
    np.testing.assert_allclose(points.resolution, np.array([0.1, 0.055, 1.0]) * metres, rtol=1e-12)
    assert points.survey_sd == 0.004


def test_a_unit_in_the_header_must_be_that_of_the_section(tmp_path: Path) -> None:
    path = table(tmp_path, "id;medida (mm);entregue [m]\nD1;1234;1233\n")
    for unit in ("mm", "m", "cm"):
        with pytest.raises(UnreadableError) as caught:
            read_distances(path, SurveySection(path="t.csv", unit=unit))
        assert caught.value.message == "table.unit"
    with pytest.raises(UnreadableError) as caught:
        read_distances(path, SurveySection(path="t.csv"))
    assert caught.value.message == "table.unit-mixed"
    agreed = table(tmp_path, "id;medida (mm);entregue (folha)\nD1;1234;1233\n")
    assert read_distances(agreed, SurveySection(path="t.csv", unit="mm")).measured.tolist() == [1.234]


@pytest.mark.parametrize("head", ["(mm)", "[MM]", "(em mm)", "(desenho, mm)", "(milímetros)", "(mm, desenho)"])
def test_a_table_is_in_the_unit_of_its_header_where_the_manifest_states_none(tmp_path: Path, head: str) -> None:
    path = table(tmp_path, f"id;medida (mm);entregue {head}\nD1;1234;1233\n")
    for section in (SurveySection(path="t.csv"), SurveySection(path="t.csv", unit="mm")):
        found = read_distances(path, section)
        assert (found.measured.tolist(), found.delivered.tolist()) == ([1.234], [1.233])


def test_a_table_without_a_unit_is_in_metres(tmp_path: Path) -> None:
    path = table(tmp_path, "id;medida (in loco);entregue (folha)\nD1;1.25;1.24\n")
    assert read_distances(path, SurveySection(path="t.csv")).measured.tolist() == [1.25]


@pytest.mark.parametrize(
    ("text", "value", "decimals"),
    [
        ("1", "1", 0), ("-1,50", "-1.50", 2), ("+.5", "0.5", 1), ("\u22122.25", "-2.25", 2), (" 7 ", "7", 0),
        ("1e3", "1E+3", -3), ("1.25E-2", "0.0125", 4), ("0.000", "0.000", 3),
        ("1" * 40, "1" * 40, 0),
    ],
)  # fmt: skip
def test_numbers_as_printed(text: str, value: str, decimals: int) -> None:
    number = number_of(text)
    assert number is not None
    assert (str(number.value), number.decimals) == (value, decimals)


@pytest.mark.parametrize(
    "text", ["", "-", ".", ",", "1.", "1,", "1..2", "1,2,3", "1 2", "0x1", "1e", "1e9999", "nan", "1" * 41, "½", "1_0"]
)
def test_what_is_no_number_is_none(text: str) -> None:
    assert number_of(text) is None


@pytest.mark.parametrize(("text", "fine"), [("1e30", True), ("1e31", False), ("1e-30", True), ("1e-31", False)])
def test_powers_of_ten_beyond_any_length_are_no_numbers(tmp_path: Path, text: str, fine: bool) -> None:  # noqa: FBT001
    path = table(tmp_path, f"id,measured\nA,{text}\n")
    if fine:
        assert read_distances(path, METRES).measured.tolist() == [float(text)]
    else:
        with pytest.raises(UnreadableError, match=r"table\.not-a-number"):
            read_distances(path, METRES)


@pytest.mark.parametrize(("count", "known"), [("0", 0), ("999999999", 999_999_999), ("1e2", 100), ("", 1)])
def test_counts_of_features(tmp_path: Path, count: str, known: int) -> None:
    assert read_feature_list(table(tmp_path, f"id;class;count\nA;window;{count}\n")).count.tolist() == [known]


def test_a_count_beyond_a_thousand_million_is_none(tmp_path: Path) -> None:
    with pytest.raises(UnreadableError, match=r"table\.not-a-count"):
        read_feature_list(table(tmp_path, "id;class;count\nA;window;1000000000\n"))


def test_the_second_sign_is_blamed_whichever_comes_first(tmp_path: Path) -> None:
    for first, second in ((",", "."), (".", ",")):
        path = table(tmp_path, f"id;measured;delivered\nA;1{first}5;1\nB;1;1{second}5\n")
        with pytest.raises(UnreadableError) as caught:
            read_distances(path, METRES)
        fields = caught.value.fields
        assert (fields["line"], fields["key"], fields["value"]) == (3, "delivered", f"1{second}5")


def test_an_id_used_twice_names_both_lines(tmp_path: Path) -> None:
    with pytest.raises(UnreadableError) as caught:
        read_distances(table(tmp_path, "id,measured\nA,1\n\nB,2\nA,3\n"), METRES)
    assert (caught.value.fields["line"], caught.value.fields["other"]) == (5, 2)


@pytest.mark.parametrize(
    ("decimals", "written"),
    [([4] * 8, 4), ([4, 4, 4, 4, 4, 4, 3, 0], 4), ([4, 4, 4, 4, 4, 3, 3, 0], 3), ([3, 3, 0], 3), ([4, 0, 0], 0),
     ([5, 4, 3], 4), ([2], 2), ([0, 3, 3], 3), ([3, 0], 0)],
)  # fmt: skip
def test_a_column_is_written_to_the_digit_that_two_thirds_show(decimals: list[int], written: int) -> None:
    assert _written_decimals(decimals) == written
