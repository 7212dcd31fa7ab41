# SPDX-License-Identifier: MIT
"""Tables whose cells are separated by blanks, and headers in three languages."""

from pathlib import Path

import pytest
from tests.read.table_files import METRES, fault, written

from foparq.read.table.tables import read_checkpoints, read_distances, read_feature_list

SURVEYED = [[40.0351, 12.2058, 2.0117], [54.0649, 12.2027, 2.0194]]


@pytest.mark.parametrize(
    "text",
    [
        "id x y z\nV01 40.0351 12.2058 2.0117\nV02 54.0649 12.2027 2.0194\n",
        "id       x        y       z\nV01  40.0351  12.2058  2.0117\nV02  54.0649  12.2027  2.0194\n",
        " id      x       y       z\nV01 40.0351 12.2058  2.0117\nV02 54.0649 12.2027  2.0194 \n",
        "id x y z\r\nV01 40,0351 12,2058 2,0117\r\n\r\nV02 54,0649 12,2027 2,0194\r\n",
        '"id" "x" "y" "z"\n"V01" 40.0351 12.2058 2.0117\n"V02" 54.0649 12.2027 2.0194\n',
        "Pontos\n\nid   x (m)    y (m)    z (m)\nV01  40.0351  12.2058  2.0117\nV02  54.0649  12.2027  2.0194\n",
        "ponto  leste    norte    cota\nV01    40,0351  12,2058  2,0117\nV02    54,0649  12,2027  2,0194\n",
    ],
    ids=["single", "aligned", "mixed", "commas", "quoted", "units", "portuguese"],
)
def test_blanks_separate_where_every_row_agrees(tmp_path: Path, text: str) -> None:
    points = read_checkpoints(written(tmp_path, text), METRES)
    assert points.id.tolist() == ["V01", "V02"]
    assert points.surveyed.tolist() == SURVEYED


def test_two_blanks_keep_a_name_of_two_words(tmp_path: Path) -> None:
    text = "id         x levantado  y      z\npeitoril 1  40.5         12.25  2\nBeiral     54.5         12.5   2\n"
    points = read_checkpoints(written(tmp_path, text), METRES)
    assert points.id.tolist() == ["peitoril 1", "Beiral"]
    assert points.surveyed.tolist() == [[40.5, 12.25, 2.0], [54.5, 12.5, 2.0]]


def test_a_quoted_name_of_two_words_is_one_cell(tmp_path: Path) -> None:
    points = read_checkpoints(written(tmp_path, 'id x y z\n"V 1" 40.5 12.25 2\nV2 54.5 12.5 2\n'), METRES)
    assert points.id.tolist() == ["V 1", "V2"]


@pytest.mark.parametrize(
    ("body", "line", "cells"),
    [
        ("V1 1.5 2.5 3.5\nV 2 1.5 2.5 3.5", 3, 5),
        ("V1 1.5 2.5 3.5\nV2 1.5 2.5", 3, 3),
        ("V1 1.5 2.5 3.5 ok\nV2 1.5 2.5 3.5", 2, 5),
        ("V1 1 234.5 2.5 3.5", 2, 5),
    ],
)
def test_a_row_that_does_not_agree_is_refused_as_such(tmp_path: Path, body: str, line: int, cells: int) -> None:
    error = fault(written(tmp_path, f"id x y z\n{body}\n"))
    assert error.message == "table.blanks"
    assert (error.fields["line"], error.fields["value"], error.fields["other"]) == (line, cells, 4)
    assert error.fields["example"] == "id;x;y;z;xd;yd;zd"


def test_a_missing_column_is_named(tmp_path: Path) -> None:
    error = fault(written(tmp_path, "id x y\nV1 1.5 2.5\n"))
    assert (error.message, error.fields["key"]) == ("table.column-missing", "z")


@pytest.mark.parametrize(
    "header",
    [
        "punto;este;norte;cota;x entregado;y entregado;z entregado",
        "Punto;X Levantado;Y Levantado;Elevación;X Dibujo;Y Dibujo;Z Dibujo",
        "NOMBRE;ESTE;NORTE;ALTITUD;X MEDIDO;Y MEDIDO;Z MEDIDO",
        "ponto;este;norte;cota;x entregue;y entregue;z entregue",
        "código;leste;norte;altitude;x_restituído;y_restituído;z_restituído",
        "point;easting;northing;height;x delivered;y delivered;z delivered",
        "Pontos;E (m);N (m);Cotas [m];XD (m);YD (m);ZD (m)",
    ],
)
def test_headers_of_checkpoints_in_three_languages(tmp_path: Path, header: str) -> None:
    points = read_checkpoints(written(tmp_path, f"{header}\nV1;1,5;2,5;3,5;1,25;2,25;3,25\n"), METRES)
    assert points.surveyed.tolist() == [[1.5, 2.5, 3.5]]
    assert points.delivered.tolist() == [[1.25, 2.25, 3.25]]


@pytest.mark.parametrize(
    "header",
    [
        "id;desde;hasta;medida;entregada", "distancia;del punto;al punto;cinta;dibujo",
        "distância;de;até;trena;desenho", "id;from;to;measured;delivered",
    ],
)  # fmt: skip
def test_headers_of_distances_in_three_languages(tmp_path: Path, header: str) -> None:
    rows = read_distances(written(tmp_path, f"{header}\nL1;V1;V2;1,5;1,25\n"), METRES)
    assert (rows.measured.tolist(), rows.delivered.tolist()) == ([1.5], [1.25])


@pytest.mark.parametrize(
    "header",
    [
        "id;clase;fachada;cantidad;uso;omisión aceptada;evidencia",
        "ID;CLASE;ALZADO;CANTIDAD;OBLIGATORIEDAD;MOTIVO DE LA OMISIÓN;PRUEBA",
        "id;classe;fachada;quantidade;exigência;omissão aceita;evidência",
        "id;class;facade;count;use;omission_accepted;evidence",
    ],
)
def test_headers_of_features_in_three_languages(tmp_path: Path, header: str) -> None:
    rows = read_feature_list(written(tmp_path, f"{header}\nV;ventana;N;3;;OCCL;IMG_1\n"))
    assert (rows.feature_class[0], rows.facade[0], rows.count[0]) == ("ventana", "N", 3)
    assert (rows.accepted[0], rows.evidence[0], rows.ignored) == ("OCCL", "IMG_1", ())
