# SPDX-License-Identifier: MIT
"""XLSX and ODS are read like CSV: numbers by value, formulas as last calculated, what failed by its address."""

import datetime as dt
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.read.sheets import ODS, Covered, Day, Failed, Formula, Rows, ods, xlsx

from foparq.errors import InputError, UnreadableError
from foparq.model.drawing import SkippedReason
from foparq.profile.manifest import SurveySection, TableSection
from foparq.read.guard.parent import guarded
from foparq.read.table.survey import tables_in
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list
from foparq.report.words import LANGUAGES, Words

Writer = Callable[..., Path]
METRES = SurveySection(path="t")
WRITERS = pytest.mark.parametrize("write", [xlsx, ods], ids=["xlsx", "ods"])
HEADER = ["id", "x", "y", "z", "xd", "yd", "zd"]


def fault(path: Path, read: Any = read_checkpoints, section: TableSection = METRES) -> InputError:
    with pytest.raises(InputError) as caught:
        read(path, section)
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value


@WRITERS
def test_a_table_of_numbers(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [
        ["Ponto", "E (m)", "N (m)", "Cota", "X entregue", "Y entregue", "Z entregue", "nota"],
        ["P1", 40.037, 12.2046, 2.0158, 40.0351, Formula("B2*2", 12.2058), 2.0117, "a  b"],
        [],
        [7, 54.063, 12.2046, 2.0158, 54.0649, 12.2027, None, Day()],
    ]
    points = read_checkpoints(write(tmp_path / "t", rows), METRES)
    assert points.id.tolist() == ["P1", "7"]
    assert points.surveyed.tolist() == [[40.037, 12.2046, 2.0158], [54.063, 12.2046, 2.0158]]
    np.testing.assert_array_equal(points.delivered, [[40.0351, 12.2058, 2.0117], [54.0649, 12.2027, np.nan]])
    # X: millimetres and tenths of them; Y and Z: tenths in both.
    np.testing.assert_allclose(points.resolution, [0.00055, 0.0001, 0.0001], rtol=1e-12)


@WRITERS
def test_three_decimals_are_no_doubt_where_the_cell_is_a_number(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [["id", "measured"], ["A", 40.037], ["B", 2.016]]
    assert read_distances(write(tmp_path / "t", rows), METRES).measured.tolist() == [40.037, 2.016]
    text: Rows = [["id", "measured"], ["A", "40,037"], ["B", 2.016]]
    error = fault(write(tmp_path / "u", text), read_distances)
    assert (error.message, error.fields["key"]) == ("table.thousands", "measured (B2)")


@WRITERS
def test_noise_of_the_last_binary_digit_is_no_digit(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [["id", "measured"], ["A", 0.1 + 0.2], ["B", 1.1 + 2.2], ["C", 12.3]]
    found = read_distances(write(tmp_path / "t", rows), METRES)
    assert found.measured.tolist() == [0.3, 3.3, 12.3]
    assert found.resolution == pytest.approx(0.05)


@WRITERS
@pytest.mark.parametrize(
    ("cell", "message", "value"),
    [
        (Failed("#N/A"), "table.error-cell", "#N/A"),
        (Failed("#REF!"), "table.error-cell", "#REF!"),
        (Failed("#DIV/0!"), "table.error-cell", "#DIV/0!"),
        (Failed("#GETTING_DATA"), "table.error-cell", "#GETTING_DATA"),
        ("#N/D", "table.error-cell", "#N/D"),
        (Formula("A1*2"), "table.formula-without-value", "=A1*2"),
        (Day(), "table.date", None),
        (Covered(), "table.merged-cell", ""),
        (True, "table.not-a-number", "TRUE"),
        ("1.234,5", "table.not-a-number", "1.234,5"),
    ],
)
@pytest.mark.parametrize(("place", "key"), [(1, "x (B3)"), (5, "yd (F3)")])
def test_what_is_no_number_is_named_by_its_address(
    tmp_path: Path, write: Writer, cell: object, message: str, value: str | None, place: int, key: str
) -> None:
    row: list[object] = ["P2", 1.5, 2.5, 3.5, 1.25, 2.25, 3.25]
    row[place] = cell
    error = fault(write(tmp_path / "t", [HEADER, ["P1", 1.5, 2.5, 3.5, 1.25, 2.25, 3.25], row]))
    assert (error.message, error.fields["line"], error.fields["key"]) == (message, 3, key)
    assert value in {None, error.fields["value"]}


@WRITERS
def test_an_empty_cell_that_is_due_is_named_by_its_address(tmp_path: Path, write: Writer) -> None:
    error = fault(write(tmp_path / "t", [HEADER, ["P1", 1.5, None, 3.5]]))
    assert (error.message, error.fields["key"]) == ("table.cell-empty", "y (C2)")


@WRITERS
def test_an_id_that_became_a_date_is_refused(tmp_path: Path, write: Writer) -> None:
    error = fault(write(tmp_path / "t", [HEADER, [Day(), 1.5, 2.5, 3.5]]))
    assert (error.message, error.fields["key"]) == ("table.date", "id (A2)")


@WRITERS
def test_failures_in_columns_that_nobody_asked_for_are_left_alone(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [[*HEADER, "dif"], ["P1", 1.5, 2.5, 3.5, None, None, None, Failed()], ["P2", 1.5, 2.5, 3.5]]
    assert read_checkpoints(write(tmp_path / "t", rows), METRES).id.tolist() == ["P1", "P2"]


@WRITERS
def test_a_formula_that_gives_an_empty_text_is_an_empty_cell(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [HEADER, ["P1", 1.5, 2.5, 3.5, Formula('""', ""), Formula('""', ""), Formula('""', "")]]
    assert np.isnan(read_checkpoints(write(tmp_path / "t", rows), METRES).delivered).all()


@WRITERS
def test_a_title_above_is_told_and_a_row_above_refused(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [["Pontos de apoio"], [], HEADER, ["#1", 1.5, 2.5, 3.5]]
    points = read_checkpoints(write(tmp_path / "t", rows), METRES)
    assert (points.id.tolist(), [part.name for part in points.skipped]) == (["#1"], ["Pontos de apoio"])
    error = fault(write(tmp_path / "u", [["#9", 1.5, 2.5, 3.5], HEADER, ["#1", 1.5, 2.5, 3.5]]))
    assert (error.message, error.fields["line"]) == ("table.above-header", 1)


@WRITERS
def test_merged_classes_are_not_taken_for_empty_ones(tmp_path: Path, write: Writer) -> None:
    rows: Rows = [["id", "class", "facade"], ["A", "window", "N"], ["B", "window", Covered()]]
    error = fault(write(tmp_path / "t", rows), read_feature_list)
    assert (error.message, error.fields["key"]) == ("table.merged-cell", "facade (C3)")


@WRITERS
def test_the_first_sheet_or_the_stated_one(tmp_path: Path, write: Writer) -> None:
    others: dict[str, Rows] = {"Medições": [["id", "measured"], ["B", 2.5]], "vazia": []}
    path = write(tmp_path / "t", [["id", "measured"], ["A", 1.5]], others=others)
    first = read_distances(path, METRES)
    assert first.id.tolist() == ["A"]
    assert [(part.reason, part.layer) for part in first.skipped] == [
        (SkippedReason.NOT_ASKED, "Medições"), (SkippedReason.NOT_ASKED, "vazia"),
    ]  # fmt: skip
    for name in ("Medições", "MEDIÇÕES", "Medic\u0327o\u0303es"):
        stated = read_distances(path, SurveySection(path="t", sheet=name))
        assert (stated.id.tolist(), stated.skipped) == (["B"], ())
    missing = fault(path, read_distances, SurveySection(path="t", sheet="Medidas"))
    assert (missing.message, missing.fields["known"]) == ("table.sheet-missing", "Medições, vazia, Plan1"), (
        "the nearest first"
    )
    assert fault(path, read_distances, SurveySection(path="t", sheet="vazia")).message == "table.no-columns"


@WRITERS
def test_a_hidden_first_sheet_is_not_what_people_see(tmp_path: Path, write: Writer) -> None:
    others: dict[str, Rows] = {"Medidas": [["id", "measured"], ["B", 2.5]]}
    path = write(tmp_path / "t", [["id", "measured"], ["A", 1.5]], others=others, hidden="Plan1")
    error = fault(path, read_distances)
    assert (error.message, error.fields["example"]) == ("table.sheet-hidden", 'sheet = "Medidas"')
    assert read_distances(path, SurveySection(path="t", sheet="Plan1")).id.tolist() == ["A"]


@WRITERS
def test_a_survey_names_the_sheets_that_are_seen(tmp_path: Path, write: Writer) -> None:
    lengths: Rows = [["id", "measured"], ["A", 1.5]]
    others: dict[str, Rows] = {"Notas": [["nada"]], "Medidas": lengths}
    assert tables_in(write(tmp_path / "t", lengths, others=others))[0] == [
        ("distances", None),
        ("distances", "Medidas"),
    ]
    assert tables_in(write(tmp_path / "u", lengths, others=others, hidden="Plan1"))[0] == [("distances", "Medidas")]


def test_a_text_table_has_no_sheet(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_text("id;measured\nA;1.5\n", encoding="utf-8")
    assert fault(path, read_distances, SurveySection(path="t", sheet="Plan1")).message == "table.sheet-of-text"


def test_repeated_rows_and_cells_of_ods(tmp_path: Path) -> None:
    path = ods(tmp_path / "t", [["id", "measured", "delivered"], ["A", 1.5, 1.5]])
    with zipfile.ZipFile(path) as archive:
        content = archive.read("content.xml").decode()
    twice = '<table:table-cell table:number-columns-repeated="2" office:value-type="float" office:value="1.5"/>'
    one = '<table:table-cell office:value-type="float" office:value="1.5"><text:p>1.50</text:p></table:table-cell>'
    assert content.count(one) == 2
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", ODS)
        archive.writestr("content.xml", content.replace(one, "", 1).replace(one, twice))
    assert read_distances(path, METRES).delivered.tolist() == [1.5]


def test_a_workbook_of_openpyxl(tmp_path: Path) -> None:
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.append(["id", "classe", "fachada", "quantidade", "evidência"])
    sheet.append(["JAN-1", "janela", "N", 3, dt.date(2026, 3, 12)])
    sheet.row_dimensions[2].hidden = True
    book.save(tmp_path / "t.xlsx")
    rows = read_feature_list(tmp_path / "t.xlsx")
    assert (rows.id.tolist(), rows.count.tolist()) == (["JAN-1"], [3])
    assert rows.evidence[0].startswith("2026-03-12")


decimals = st.integers(-999_999, 999_999).map(lambda n: (n * 10 + 1) / 10_000)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.lists(st.tuples(*[decimals] * 6), min_size=1, max_size=6), st.booleans())
def test_the_same_table_from_every_spreadsheet(
    tmp_path_factory: pytest.TempPathFactory,
    values: list[tuple[float, ...]],
    bare: bool,  # noqa: FBT001
) -> None:
    folder = tmp_path_factory.mktemp("t")
    ids = [f"{'' if bare else '#'}{n + 1}" for n in range(len(values))]
    texts = [HEADER, *([name, *(f"{v:.4f}" for v in row)] for name, row in zip(ids, values, strict=True))]
    comma = [texts[0], *([cell.replace(".", ",") for cell in row] for row in texts[1:])]
    plain = {
        separator: "\n".join(separator.join(row) for row in rows) + "\n"
        for separator, rows in ((";", comma), (",", texts), ("\t", comma), ("  ", texts))
    }
    quoted = "\r\n".join(",".join(f'"{cell}"' for cell in row) for row in comma)
    written = [
        *(text.encode() for text in plain.values()), b"\xef\xbb\xbf" + plain[";"].replace("\n", "\r\n").encode(),
        plain["\t"].encode("utf-16"), quoted.encode(), ("sep=;\r\n" + plain[";"]).encode("cp1252"),
    ]  # fmt: skip
    paths = [folder / f"{n}.csv" for n in range(len(written))]
    for path, data in zip(paths, written, strict=True):
        path.write_bytes(data)
    rows = [HEADER, *([name, *row] for name, row in zip(ids, values, strict=True))]
    paths += [xlsx(folder / "a.xlsx", rows), ods(folder / "a.ods", rows)]
    for path in paths:
        points = read_checkpoints(path, METRES)
        assert points.id.tolist() == ids
        np.testing.assert_array_equal(np.hstack([points.surveyed, points.delivered]), values)
        np.testing.assert_allclose(points.resolution, 0.0001, rtol=1e-12)


# --- hostile ---------------------------------------------------------------------------------------------------------


def bounded(path: Path, seconds: float = 60, memory: int = 400_000_000) -> InputError:
    with pytest.raises(InputError) as caught:
        guarded(read_distances, path, METRES, file=path.name, seconds=seconds, memory=memory)
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value


@pytest.mark.parametrize(("data", "message"), [
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 512, "table.old-workbook"),
    (b"PK\x03\x04rest", "table.workbook-broken"),
])  # fmt: skip
def test_what_is_no_workbook(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "t.xlsx"
    path.write_bytes(data)
    assert fault(path).message == message


def test_another_archive_is_no_table(tmp_path: Path) -> None:
    for name, message in (("x.txt", "table.not-csv"), ("xl/workbook.bin", "table.old-workbook")):
        with zipfile.ZipFile(tmp_path / "t.zip", "w") as archive:
            archive.writestr(name, "x")
        assert fault(tmp_path / "t.zip").message == message


@WRITERS
def test_broken_members_are_told(tmp_path: Path, write: Writer) -> None:
    path = write(tmp_path / "t", [["id", "measured"], ["A", 1.5]])
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    needed = {"xl/workbook.xml", "xl/worksheets/sheet0.xml", "[Content_Types].xml", "content.xml"}
    for broken in needed & members.keys():
        with zipfile.ZipFile(path, "w") as archive:
            for name, data in members.items():
                archive.writestr(name, data[: len(data) // 2] if name == broken else data)
        assert isinstance(fault(path, read_distances), UnreadableError)


def test_what_unpacks_to_too_much_is_refused(tmp_path: Path) -> None:
    path = xlsx(tmp_path / "t", [["id", "measured"]])
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive, archive.open("xl/media/x", "w") as member:
        for _ in range(600):
            member.write(bytes(1_000_000))
    assert path.stat().st_size < 2_000_000
    assert bounded(path).message == "read.too-large"


def test_a_stray_cell_far_away_costs_nothing(tmp_path: Path) -> None:
    path = xlsx(tmp_path / "t", [["id", "measured"], ["A", 1.5]])
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name).decode() for name in archive.namelist()}
    far = '<row r="1048576"><c r="A1048576" t="inlineStr"><is><t>B</t></is></c><c r="XFD1048576"><v>2</v></c></row>'
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in members.items():
            archive.writestr(name, text.replace("</sheetData>", f"{far}</sheetData>"))
    error = bounded(path)
    assert (error.message, error.fields["key"]) == ("table.cell-empty", "measured (B1048576)")


@pytest.mark.parametrize(("element", "message"), [("row", "table.too-many-rows"), ("column", "table.workbook-broken")])
def test_cells_repeated_without_end_are_refused(tmp_path: Path, element: str, message: str) -> None:
    path = ods(tmp_path / "t", [["id", "measured"], ["A", 1.5]])
    with zipfile.ZipFile(path) as archive:
        content = archive.read("content.xml").decode()
    cell = "<table:table-cell office"
    before = f"<table:table-row>{cell}" if element == "row" else cell
    after = (
        before.replace("table-row", "table-row {}")
        if element == "row"
        else before.replace("table-cell", "table-cell {}")
    )
    times = f'table:number-{element}s-repeated="2000000000"'
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", ODS)
        archive.writestr("content.xml", content.replace(before, after.format(times)))
    assert bounded(path, memory=1_000_000_000).message == message


@pytest.mark.parametrize("member", ["xl/workbook.xml", "xl/worksheets/sheet0.xml", "content.xml"])
@pytest.mark.parametrize("kind", ["external", "laughs"])
def test_entities_open_nothing_and_do_not_grow(tmp_path: Path, member: str, kind: str) -> None:
    secret = tmp_path / "secret"
    secret.write_text("77.25", encoding="utf-8")
    rows: Rows = [["id", "measured"], ["A", 1.5], ["ENTITY", 2.5]]
    path = (ods if member == "content.xml" else xlsx)(tmp_path / "t", rows)
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name).decode() for name in archive.namelist()}
    laughs = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(9))
    entities = f'<!ENTITY e9 SYSTEM "{secret.as_uri()}">' if kind == "external" else f'<!ENTITY e0 "ha">{laughs}'
    head, _, rest = members[member].partition("?>")
    rest = rest.replace("ENTITY", "&e9;").replace("Plan1", "Plan&e9;")
    members[member] = f"{head}?><!DOCTYPE x [{entities}]>{rest}"
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in members.items():
            archive.writestr(name, text)
    try:
        said = "".join(guarded(read_distances, path, METRES, file="t", seconds=60, memory=400_000_000).id)
    except InputError as error:
        said = str(error.fields)
    assert "77.25" not in said
    assert len(said) < 1000
