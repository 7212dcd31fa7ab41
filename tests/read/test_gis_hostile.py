# SPDX-License-Identifier: MIT
"""Files that mean harm: programs in databases, disguises, lies, damage."""

import contextlib
import json
import os
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.read.gis_files import listing, read, refused, write

from foparq.errors import FoparqError, UnreadableError, UnsafeError
from foparq.read.gis.gpkg_safety import opened

VRT = (
    """<OGRVRTDataSource><OGRVRTLayer name="other"><SrcDataSource>{}</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>"""
)


@pytest.mark.parametrize("name", ["a.gpkg", "a.geojson", "a.shp"])
def test_a_virtual_file_under_another_name_is_refused(tmp_path: Path, name: str) -> None:
    secret = write(tmp_path / "secret.geojson", ["POINT (0 0)"])
    path = tmp_path / name
    path.write_text(VRT.format(secret), encoding="utf-8")
    error = refused(path)
    assert (error.message, error.fields["value"]) == ("read.not-a-drawing", "XML")


def test_a_virtual_file_behind_the_magic_of_a_database_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    path.write_bytes(b"SQLite format 3\x00" + VRT.format("/etc/passwd").encode())
    assert refused(path).message == "read.gpkg-broken"


def test_a_link_to_a_service_in_json_is_not_followed(tmp_path: Path) -> None:
    path = tmp_path / "a.geojson"
    link = {"rel": "next", "href": "http://127.0.0.1:9/next", "type": "application/geo+json"}
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature], "links": [link]}), encoding="utf-8")
    assert len(read(path).items) == 1


def with_view(path: Path) -> Path:
    name = "hostil"
    write(path, ["POINT (0 0)"], kind="Point", layer="paredes")
    endless = (
        "CREATE VIEW hostil AS WITH RECURSIVE n(fid) AS (SELECT 1 UNION ALL SELECT fid + 1 FROM n)"
        " SELECT fid, geom FROM n, (SELECT geom FROM paredes LIMIT 1)"
    )
    with sqlite3.connect(path) as connection:
        connection.execute(endless)
        connection.execute(
            "INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES (?, 'features', ?, 31982)",
            (name, name),
        )
        connection.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'geom', 'POINT', 31982, 0, 0)", (name,))
    connection.close()
    return path


def test_an_endless_view_is_skipped_and_the_tables_are_read(tmp_path: Path) -> None:
    drawing = read(with_view(tmp_path / "a.gpkg"))
    assert drawing.items.item.tolist() == ["paredes:1"]
    assert [(record.reason, record.layer) for record in drawing.reading.skipped] == [("view", "hostil")]


def test_a_register_that_is_an_endless_view_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    with sqlite3.connect(path) as connection:
        connection.execute("DROP TABLE gpkg_contents")
        connection.execute(
            "CREATE VIEW gpkg_contents AS WITH RECURSIVE n(table_name) AS"
            " (SELECT 1 UNION ALL SELECT table_name + 1 FROM n) SELECT table_name, 'features' AS data_type FROM n"
        )
    connection.close()
    error = refused(path, UnsafeError)
    assert (error.message, error.fields["value"]) == ("read.gpkg-register", "gpkg_contents")


@pytest.mark.parametrize("decoy", ["trigger", "kelvin"])
def test_a_decoy_does_not_hide_the_program(tmp_path: Path, decoy: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    with sqlite3.connect(path) as connection:
        connection.execute("DROP TABLE gpkg_contents")
        connection.execute("CREATE VIEW GPKG_contents AS SELECT 'paredes' AS table_name, 'features' AS data_type")
        if decoy == "trigger":
            connection.execute("CREATE TRIGGER gpkg_contents AFTER INSERT ON paredes BEGIN SELECT 1; END")
        else:
            # The sign of the kelvin becomes k in small letters, but not for SQLite.
            connection.execute('CREATE TABLE "gp\u212ag_contents" (table_name, data_type)')
    connection.close()
    assert refused(path, UnsafeError).message == "read.gpkg-register"


def test_programs_in_a_database_are_told(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    with sqlite3.connect(path) as connection:
        connection.execute("CREATE VIEW espia AS SELECT 1")
        connection.execute("CREATE VIRTUAL TABLE busca USING fts5(texto)")
        connection.execute("CREATE TRIGGER apaga AFTER INSERT ON paredes BEGIN DELETE FROM paredes; END")
    connection.close()
    reasons = {(record.reason, record.layer) for record in read(path).reading.skipped}
    assert {("unlisted-view", "espia"), ("unlisted-virtual-table", "busca"), ("trigger", "apaga")} <= reasons


def test_a_computed_column_is_not_run(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"], layer="um")
    write(path, ["POINT (0 0)"], layer="dois", append=True)
    with sqlite3.connect(path) as connection:
        connection.execute("ALTER TABLE dois ADD COLUMN pesado BLOB GENERATED ALWAYS AS (zeroblob(900000000)) VIRTUAL")
    connection.close()
    drawing = read(path)
    assert set(drawing.items.layer) == {"um"}
    assert ("computed-table", "dois") in {(record.reason, record.layer) for record in drawing.reading.skipped}


def test_looking_has_a_deadline(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    endless = "WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n) SELECT max(k) FROM n"
    with pytest.raises(UnsafeError) as caught, opened(path, 0.1) as connection:
        connection.execute(endless).fetchall()
    assert caught.value.message == "read.gpkg-endless"


@pytest.mark.parametrize("count", [1, 10**9, 2**62])
def test_a_feature_count_that_lies_loses_nothing(tmp_path: Path, count: int) -> None:
    path = write(tmp_path / "a.gpkg", [f"POINT ({n} 0)" for n in range(100)])
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE gpkg_ogr_contents SET feature_count = ?", (count,))
    connection.close()
    assert len(read(path).items) == 100


def test_truncated_files_never_pass(tmp_path: Path) -> None:
    whole = write(tmp_path / "whole.gpkg", [f"LINESTRING (0 {n}, 1 {n})" for n in range(2000)]).read_bytes()
    for share in (0.001, 0.1, 0.5, 0.9, 0.99):
        path = tmp_path / "cut.gpkg"
        path.write_bytes(whole[: int(len(whole) * share)])
        try:
            items = read(path).items
        except UnreadableError:
            continue
        assert len(items) == 2000, share


def test_flipped_bytes_never_crash(tmp_path: Path) -> None:
    whole = write(tmp_path / "whole.gpkg", [f"LINESTRING (0 {n}, 1 {n})" for n in range(200)]).read_bytes()
    random = np.random.default_rng(20151218)
    path = tmp_path / "hurt.gpkg"
    for _ in range(60):
        hurt = bytearray(whole)
        for place in random.integers(16, len(whole), 40):
            hurt[place] = random.integers(256)
        path.write_bytes(hurt)
        with contextlib.suppress(FoparqError):
            read(path)


@pytest.mark.parametrize("ending", ["-wal", "-journal"])
def test_changes_left_in_a_journal_are_told(tmp_path: Path, ending: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    journal = tmp_path / f"a.gpkg{ending}"
    journal.write_bytes(b"")
    assert len(read(path).items) == 1
    journal.write_bytes(b"x" * 100)
    error = refused(path)
    assert (error.message, error.fields["value"]) == ("read.gpkg-journal", journal.name)


def test_a_database_in_write_ahead_mode_is_read_without_a_trace(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"])
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA journal_mode=WAL")
    connection.close()
    before = listing(tmp_path)
    assert len(read(path).items) == 1
    assert listing(tmp_path) == before


def test_too_many_features_or_vertices(tmp_path: Path) -> None:
    wkt = [f"LINESTRING (0 {n}, 1 {n})" for n in range(30)]
    for path in (write(tmp_path / "a.gpkg", wkt), write(tmp_path / "a.geojson", wkt)):
        assert len(read(path, entities=30, vertices=60).items) == 30
        assert refused(path, UnsafeError, entities=29).message == "read.too-many-items"
        assert refused(path, UnsafeError, vertices=59).message == "read.too-many-vertices"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "read.empty"),
        (b"PK\x03\x04....", "read.archive"),
        (b"AC1027......", "read.dwg"),
        (b"%PDF-1.7", "read.pdf"),
        (b"just some text", "read.unknown-format"),
        (b"\x00" * 200, "read.unknown-format"),
    ],
)
def test_what_a_file_is_decides_and_not_its_name(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "a.gpkg"
    path.write_bytes(data)
    assert refused(path).message == message


def test_a_plain_database_is_no_geopackage(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE notes (text)")
    connection.commit()
    connection.close()
    assert refused(path).message == "read.gpkg-no-register"


def test_a_fresh_process_has_only_the_drivers_it_needs() -> None:
    code = "import foparq.read.gis.reader, pyogrio; print(*sorted(pyogrio.list_drivers()))"
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OGR_", "CPL_"))}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    assert set(done.stdout.split()) >= {"GPKG", "GeoJSON"}
    assert not {"OGR_VRT", "CSV", "WFS", "OAPIF", "SQLite", "DXF", "HTTP"} & set(done.stdout.split())
    assert done.stderr == ""
