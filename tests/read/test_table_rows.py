# SPDX-License-Identifier: MIT
"""Every row of a table is a row: none is left out for the sign it begins with."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.read.table_files import METRES, fault, written

from foparq.model.drawing import SkippedReason
from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

SIGNS = "#%!;'/*-~@&$"  #: what begins a comment somewhere


@pytest.mark.parametrize("name", ["#9", "# 9", "#", "//7", "%1", "--", "!x", "'P1", "REM 1", "*"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_an_id_may_begin_with_any_sign(tmp_path: Path, name: str, separator: str) -> None:
    text = f"id;x;y;z\nP1;1.5;2.5;3.5\n{name};4.5;5.5;6.5\n".replace(";", separator)
    points = read_checkpoints(written(tmp_path, text), METRES)
    assert points.id.tolist() == ["P1", name]
    assert points.surveyed.tolist() == [[1.5, 2.5, 3.5], [4.5, 5.5, 6.5]]


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.lists(st.text(st.sampled_from(SIGNS.replace(";", "") + "aP19"), min_size=1, max_size=4), unique=True))
def test_as_many_rows_are_read_as_were_written(tmp_path_factory: pytest.TempPathFactory, ids: list[str]) -> None:
    text = "id;measured\n" + "".join(f"{name};{n + 1}\n" for n, name in enumerate(ids))
    rows = read_distances(written(tmp_path_factory.mktemp("t"), text), METRES)
    assert rows.id.tolist() == ids
    assert rows.measured.tolist() == [n + 1.0 for n in range(len(ids))]
    assert rows.skipped == ()


def test_features_may_be_called_so_too(tmp_path: Path) -> None:
    rows = read_feature_list(written(tmp_path, "id,class\n#1,window\nA,door\n#2,window\n"))
    assert rows.id.tolist() == ["#1", "A", "#2"]


@pytest.mark.parametrize(
    "header", ["#;x;y;z", "# ;X;Y;Z", "#id;x;y;z", "# ponto;x;y;z", "//id;x;y;z", "nº;E;N;H", "N.º;Este;Norte;Cota"]
)
def test_a_column_of_numbers_called_so_holds_the_ids(tmp_path: Path, header: str) -> None:
    points = read_checkpoints(written(tmp_path, f"{header}\n1;1.5;2.5;3.5\n"), METRES)
    assert points.id.tolist() == ["1"]


@pytest.mark.parametrize("remark", ["# exported 2026-03-01", "Levantamento da estação", "#", '"Pontos; lado norte"'])
def test_a_remark_above_the_header_is_told(tmp_path: Path, remark: str) -> None:
    points = read_checkpoints(written(tmp_path, f"{remark}\n\nid;x;y;z\nP1;1.5;2.5;3.5\n"), METRES)
    assert points.id.tolist() == ["P1"]
    (told,) = points.skipped
    assert (told.reason, told.name, told.count) == (SkippedReason.ABOVE_HEADER, remark.strip('"'), 1)


def test_a_remark_with_commas_does_not_tell_the_separator(tmp_path: Path) -> None:
    text = "Estação, fachada norte, levantada em março\nid;x;y;z\nP1;1,5;2,5;3,25\n"
    points = read_checkpoints(written(tmp_path, text), METRES)
    assert points.surveyed.tolist() == [[1.5, 2.5, 3.25]]
    assert [part.name for part in points.skipped] == ["Estação, fachada norte, levantada em março"]


def test_a_row_that_was_sorted_above_the_header_is_not_left_out(tmp_path: Path) -> None:
    error = fault(written(tmp_path, "#9;1.5;2.5;3.5\nid;x;y;z\nP1;1.5;2.5;3.5\n"))
    assert error.message == "table.above-header"
    assert (error.fields["line"], error.fields["value"], error.fields["other"]) == (1, "#9 1.5 2.5 3.5", 2)


def test_a_remark_below_the_header_is_a_row_that_does_not_fit(tmp_path: Path) -> None:
    error = fault(written(tmp_path, "id;x;y;z\n# lado norte\nP1;1.5;2.5;3.5\n"))
    assert (error.message, error.fields["line"]) == ("table.ragged", 2)
    error = fault(written(tmp_path, "id;x;y;z\n# lado norte;;;\nP1;1.5;2.5;3.5\n"))
    assert (error.message, error.fields["line"], error.fields["key"]) == ("table.cell-empty", 2, "x")


def test_a_header_that_lacks_a_column_is_named_by_its_own_line(tmp_path: Path) -> None:
    error = fault(written(tmp_path, "Levantamento\nid;x;y\nP1;1.5;2.5\n"))
    assert (error.message, error.fields["line"], error.fields["key"]) == ("table.column-missing", 2, "z")


@pytest.mark.parametrize("data", [b"\xef\xbb\xbf", b"\xff\xfe", b"\xff\xfe\n\x00", b"\xef\xbb\xbf \r\n"])
def test_a_mark_alone_is_an_empty_file(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "t.csv"
    path.write_bytes(data)
    assert fault(path).message == "read.empty"
