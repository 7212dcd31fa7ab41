# SPDX-License-Identifier: MIT
"""Tables as architects write them in a spreadsheet, and the traps in them."""

from pathlib import Path

import numpy as np
import pytest

from foparq.errors import UnreadableError
from foparq.profile.manifest import SurveySection
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list
from foparq.report.words import LANGUAGES, Words

METRES = SurveySection(path="t.csv")
ENGLISH = b"id,x,y,z,xd,yd,zd\nP1,1.000,2.000,3.000,1.002,2.001,3.00\nP2,4.000,5.000,6.000,4.001,,\n"
QUOTED = (
    b'\n"ID","E (m)","N (m)","H (m)","XD","YD","ZD"\n'
    b'"P1","1,000","2,000","3,000","1,002","2,001","3,00"\nP2,"4,000","5,000","6,000","4,001",,\n'
)
PORTUGUESE = (
    "Ponto;X levantado;Y levantado;Cota;X entregue;Y entregue;Z entregue;Observação\n"
    "P1;1,000;2,000;3,000;1,002;2,001;3,00;ok\nP2;4,000;5,000;6,000;4,001;;;\n"
)


def written(folder: Path, data: bytes | str, encoding: str = "utf-8") -> Path:
    path = folder / "t.csv"
    path.write_bytes(data if isinstance(data, bytes) else data.encode(encoding))
    return path


def fault(path: Path, read: object = read_checkpoints) -> UnreadableError:
    with pytest.raises(UnreadableError) as caught:
        read(path) if read is read_feature_list else read(path, METRES)  # type: ignore[operator]
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value


@pytest.mark.parametrize(
    "data",
    [
        ENGLISH,
        b"\xef\xbb\xbf" + ENGLISH.replace(b"\n", b"\r\n"),
        ENGLISH.replace(b",", b"\t"),
        QUOTED,
        PORTUGUESE.encode(),
        PORTUGUESE.encode("cp1252"),
        PORTUGUESE.encode("utf-16"),
        b"sep=;\r\n" + ENGLISH.replace(b",", b";").replace(b"\n", b"\r\n"),
        ENGLISH.replace(b",", b";") + b";;;;;;\n\n",
    ],
    ids=["english", "bom-crlf", "tabs", "quoted", "portuguese", "cp1252", "utf-16", "sep-line", "empty-rows"],
)
def test_one_table_in_many_dresses(tmp_path: Path, data: bytes) -> None:
    points = read_checkpoints(written(tmp_path, data), METRES)
    assert points.id.tolist() == ["P1", "P2"]
    np.testing.assert_array_equal(points.surveyed, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_array_equal(points.delivered, [[1.002, 2.001, 3.0], [4.001, np.nan, np.nan]])
    # Half a millimetre of the survey, and half of the delivery's last digit: 0.5 mm, 0.5 mm and 5 mm.
    np.testing.assert_allclose(points.resolution, [0.001, 0.001, 0.0055], rtol=1e-12)
    assert points.survey_sd is None


def test_the_number_with_fewest_decimals_tells_the_resolution(tmp_path: Path) -> None:
    path = written(tmp_path, "id,measured,delivered\nA,1.250,1.2512\nB,1.3,1.3004\n")
    assert read_distances(path, METRES).resolution == pytest.approx(0.05 + 0.00005)


def test_a_trailing_zero_dropped_by_a_spreadsheet_is_no_coarser_survey(tmp_path: Path) -> None:
    path = written(tmp_path, "id,measured,delivered\nA,1.253,1.2512\nB,1.3,1.3004\nC,1.412,1.4115\nD,2.118,2.12\n")
    assert read_distances(path, METRES).resolution == pytest.approx(0.0005 + 0.00005)


def test_millimetres_become_metres_exactly(tmp_path: Path) -> None:
    section = SurveySection(path="t.csv", unit="mm", survey_sd="3 mm")
    rows = read_distances(written(tmp_path, "id;medida (mm);entregue (mm)\nA;1234;1233,9\n"), section)
    assert rows.measured.tolist() == [1.234]
    assert rows.delivered.tolist() == [1.2339]
    assert rows.survey_sd == 0.003
    assert rows.resolution == pytest.approx(0.0005 + 0.00005)


def test_without_a_delivered_column_nothing_is_delivered(tmp_path: Path) -> None:
    points = read_checkpoints(written(tmp_path, "id,x,y,z\nP1,1.0,2.0,3.0\n"), METRES)
    assert np.isnan(points.delivered).all()
    np.testing.assert_allclose(points.resolution, 0.05)


def test_a_table_of_a_header_is_an_empty_table(tmp_path: Path) -> None:
    points = read_checkpoints(written(tmp_path, "id,x,y,z\n"), METRES)
    assert points.surveyed.shape == points.delivered.shape == (0, 3)


CHECKPOINT_TRAPS = [
    ("P1;1.234,5;2;3", "table.not-a-number", 2, "x", "1.234,5"),
    ("P1;1 234,5;2;3", "table.not-a-number", 2, "x", "1 234,5"),
    ("P1;7.400.123;2;3", "table.not-a-number", 2, "x", "7.400.123"),
    ("P1;1,5;2.5;3", "table.two-decimal-signs", 2, "y", "2.5"),
    ("P1;1;2;3\nP2;1.250;2;3\nP3;1;2,5;3", "table.two-decimal-signs", 4, "y", "2,5"),
    ("P1;nan;2;3", "table.not-a-number", 2, "x", "nan"),
    ("P1;1;inf;3", "table.not-a-number", 2, "y", "inf"),
    ("P1;1;2;#REF!", "table.error-cell", 2, "z", "#REF!"),
    ("P1;1;#N/D;3", "table.error-cell", 2, "y", "#N/D"),
    ("P1;#¡VALOR!;2;3", "table.error-cell", 2, "x", "#¡VALOR!"),
    ("P1;1;2;Err:508", "table.error-cell", 2, "z", "Err:508"),
    ("P1;1;2;=A1", "table.not-a-number", 2, "z", "=A1"),
    ("P1;1e400;2;3", "table.not-a-number", 2, "x", "1e400"),
    ("P1;1;2;" + "9" * 400, "table.not-a-number", 2, "z", "9" * 400),
    ("P1;٣;2;3", "table.not-a-number", 2, "x", "٣"),
    ("P1;1;;3", "table.cell-empty", 2, "y", ""),
    (";1;2;3", "table.cell-empty", 2, "id", ""),
    ("P1;1;2;3\nP1;1;2;3", "table.id-twice", 3, "id", "P1"),
    ("P1;1;2", "table.ragged", 2, ";", 3),
    ("P1;1;2;3;4", "table.ragged", 2, ";", 5),
]


@pytest.mark.parametrize(
    ("body", "message", "line", "key", "value"), CHECKPOINT_TRAPS, ids=[trap[0][:20] for trap in CHECKPOINT_TRAPS]
)
def test_what_could_be_misread_is_refused(
    tmp_path: Path, body: str, message: str, line: int, key: str, value: object
) -> None:
    error = fault(written(tmp_path, f"id;x;y;z\n{body}\n"))
    assert error.message == message
    assert error.fields["file"] == "t.csv"
    assert (error.fields["line"], error.fields["key"], error.fields["value"]) == (line, key, value)
    assert error.fields["example"]


def test_a_decimal_comma_between_commas_is_a_ragged_row(tmp_path: Path) -> None:
    error = fault(written(tmp_path, "id,x,y,z\nP1,1,5,2,5,3,5\n"))
    assert (error.message, error.fields["line"]) == ("table.ragged", 2)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "read.empty"),
        (b"  \n \n", "read.empty"),
        (b"PK\x03\x04rest", "table.workbook-broken"),
        (b"\xd0\xcf\x11\xe0rest", "table.old-workbook"),
        (b"%PDF-1.7", "table.not-csv"),
        (b"id;x;y;z\nP1;1;2;3\0\n", "table.not-csv"),
        (b"one column\n1\n", "table.no-columns"),
        (b"id;x;y\nP1;1;2\n", "table.column-missing"),
        (b"id;x;X (m);y;z\nP1;1;1;2;3\n", "table.column-twice"),
        (b'id;x;y;z\nP1;"1;2;3\n', "table.broken"),
        (b"id;x (mm);y;z\nP1;1;2;3\n", "table.unit-mixed"),
    ],
)
def test_what_is_no_such_table_is_refused(tmp_path: Path, data: bytes, message: str) -> None:
    assert fault(written(tmp_path, data)).message == message


def test_lines_are_counted_as_the_file_has_them(tmp_path: Path) -> None:
    error = fault(written(tmp_path, 'id;x;y;z;nota\n\nP1;1;2;3;"duas\nlinhas"\n\nP2;1;?;3;\n'))
    assert error.fields["line"] == 6


@pytest.mark.parametrize("length", ["0", "-1.5"])
def test_a_distance_is_positive(tmp_path: Path, length: str) -> None:
    error = fault(written(tmp_path, f"id,measured\nA,{length}\n"), read_distances)
    assert (error.message, error.fields["value"]) == ("table.not-positive", length)


def test_a_feature_list(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "id;classe;fachada;qtd;exigência;omissão aceita;evidência;largura\n"
        "JAN-N-1;janela;N;;;;;1,20\nPOR-N;porta;N;3;Obrigatório;occl;IMG_0412.jpg;\nBRA;brasão;;0;proibido;;;\nORN;ornato;S;2,0;opcional;;;\n",
    )
    rows = read_feature_list(path)
    assert rows.id.tolist() == ["JAN-N-1", "POR-N", "BRA", "ORN"]
    assert rows.feature_class.tolist() == ["janela", "porta", "brasão", "ornato"]
    assert rows.facade.tolist() == ["N", "N", "", "S"]
    assert rows.count.tolist() == [1, 3, 0, 2]
    assert rows.use.tolist() == ["required", "required", "prohibited", "optional"]
    assert rows.accepted.tolist() == ["", "OCCL", "", ""]
    assert rows.evidence.tolist() == ["", "IMG_0412.jpg", "", ""]
    assert rows.ignored == ("largura",)
    assert rows.required().tolist() == [True, True, False, False]


def test_left_out_columns_have_their_defaults(tmp_path: Path) -> None:
    rows = read_feature_list(written(tmp_path, "id,class\nA,window\n"))
    assert (rows.count.tolist(), rows.use.tolist(), rows.facade.tolist()) == ([1], ["required"], [""])


@pytest.mark.parametrize(
    ("row", "message", "key"),
    [
        ("A;window;12.000;;;", "table.not-a-count", "count"),
        ("A;window;-1;;;", "table.not-a-count", "count"),
        ("A;window;1.5;;;", "table.not-a-count", "count"),
        ("A;window;many;;;", "table.not-a-count", "count"),
        ("A;;1;;;", "table.cell-empty", "class"),
        ("A;window;1;perhaps;;", "table.use-unknown", "use"),
        ("A;window;1;;TREE;IMG_1", "table.code-unknown", "omission_accepted"),
        ("A;window;1;;OCCL;", "table.no-evidence", "omission_accepted"),
        ("A;window;1;;;\nA;door;1;;;", "table.id-twice", "id"),
    ],
)
def test_faults_of_a_feature_list(tmp_path: Path, row: str, message: str, key: str) -> None:
    error = fault(written(tmp_path, f"id;class;count;use;omission_accepted;evidence\n{row}\n"), read_feature_list)
    assert (error.message, error.fields["key"]) == (message, key)


@pytest.mark.shared
def test_published_checkpoints_with_other_headers_name_the_missing_columns(shared: Path) -> None:
    error = fault(shared / "data/accuracy/abdullah2014_checkpoints.csv")
    assert (error.message, error.fields["key"], error.fields["line"]) == ("table.column-missing", "x, y, z", 1)
    assert "x: x, e, este, leste, easting" in str(error.fields["known"]), "every name that would be taken"
