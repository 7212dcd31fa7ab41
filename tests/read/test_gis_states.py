# SPDX-License-Identifier: MIT
"""States in which a GeoPackage may be delivered: journals beside it, and tables with several columns of geometry."""

import shutil
import sqlite3
from pathlib import Path

import pytest
from tests.read.gis_files import drop_triggers, read, refused, write


def opened(path: Path, mode: str) -> sqlite3.Connection:
    """The file of one line with feature id 1, open in a mode of journal."""
    write(path, ["LINESTRING (0 0, 1 0)"])
    connection = sqlite3.connect(path)
    drop_triggers(connection)
    connection.commit()
    assert connection.execute(f"PRAGMA journal_mode={mode}").fetchone() == (mode.lower(),)
    return connection


def delivered(path: Path, folder: Path, *endings: str) -> Path:
    """A copy as it would be sent while the program has the file open."""
    folder.mkdir()
    for ending in ("", *endings):
        shutil.copy(f"{path}{ending}", folder / f"{path.name}{ending}")
    return folder / path.name


def items(path: Path) -> list[str]:
    return read(path).items.item.tolist()


def test_a_log_with_changes_is_told(tmp_path: Path) -> None:
    connection = opened(tmp_path / "a.gpkg", "WAL")
    connection.execute("UPDATE paredes SET fid = 5")
    connection.commit()
    sent = delivered(tmp_path / "a.gpkg", tmp_path / "b", "-wal", "-shm")
    assert refused(sent).message == "read.gpkg-journal"
    connection.close()


def test_a_log_that_was_written_back_says_nothing_new(tmp_path: Path) -> None:
    connection = opened(tmp_path / "a.gpkg", "WAL")
    connection.execute("UPDATE paredes SET fid = 5")
    connection.commit()
    connection.execute("PRAGMA wal_checkpoint(PASSIVE)")
    assert (tmp_path / "a.gpkg-wal").stat().st_size > 0
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "b", "-wal", "-shm")) == ["paredes:5"]
    # One change more, and it does.
    connection.execute("UPDATE paredes SET fid = 6")
    connection.commit()
    assert refused(delivered(tmp_path / "a.gpkg", tmp_path / "c", "-wal", "-shm")).message == "read.gpkg-journal"
    connection.close()


def test_changes_that_were_never_committed_do_not_count(tmp_path: Path) -> None:
    connection = opened(tmp_path / "a.gpkg", "WAL")
    connection.execute("CREATE TABLE other (x)")
    connection.execute("UPDATE paredes SET fid = 5")
    connection.commit()
    connection.execute("PRAGMA wal_checkpoint(PASSIVE)")
    connection.execute("PRAGMA cache_size = 1")
    connection.executemany("INSERT INTO other VALUES (?)", [("x" * 4000,)] * 50)
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "b", "-wal", "-shm")) == ["paredes:5"]
    connection.close()


@pytest.mark.parametrize("checkpoint", ["TRUNCATE", "RESTART"])
def test_a_file_in_the_mode_of_logs_is_read(tmp_path: Path, checkpoint: str) -> None:
    connection = opened(tmp_path / "a.gpkg", "WAL")
    connection.execute("UPDATE paredes SET fid = 5")
    connection.commit()
    connection.execute(f"PRAGMA wal_checkpoint({checkpoint})")
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "b", "-wal", "-shm")) == ["paredes:5"]
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "c")) == ["paredes:5"]
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "d", "-shm")) == ["paredes:5"]
    connection.close()


@pytest.mark.parametrize("mode", ["PERSIST", "TRUNCATE"])
def test_a_journal_that_is_done_with_is_none(tmp_path: Path, mode: str) -> None:
    connection = opened(tmp_path / "a.gpkg", mode)
    connection.execute("UPDATE paredes SET fid = 5")
    connection.commit()
    assert (tmp_path / "a.gpkg-journal").exists()
    assert items(delivered(tmp_path / "a.gpkg", tmp_path / "b", "-journal")) == ["paredes:5"]
    connection.close()


def test_a_journal_of_a_change_under_way_is_told(tmp_path: Path) -> None:
    connection = opened(tmp_path / "a.gpkg", "PERSIST")
    connection.execute("PRAGMA cache_size = 1")
    connection.execute("CREATE TABLE other (x)")
    connection.commit()
    connection.executemany("INSERT INTO other VALUES (?)", [("x" * 4000,)] * 50)
    sent = delivered(tmp_path / "a.gpkg", tmp_path / "b", "-journal")
    assert refused(sent).message == "read.gpkg-journal"
    connection.close()


def test_a_log_that_is_no_file_is_told(tmp_path: Path) -> None:
    write(tmp_path / "a.gpkg", ["LINESTRING (0 0, 1 0)"])
    (tmp_path / "a.gpkg-wal").mkdir()
    assert refused(tmp_path / "a.gpkg").message == "read.gpkg-journal"


def doubled(path: Path, *, registered: bool) -> Path:
    """A table with a second column of geometry."""
    write(path, ["LINESTRING (0 0, 1 0)"], append=path.exists())
    connection = sqlite3.connect(path)
    drop_triggers(connection)
    connection.execute("ALTER TABLE paredes ADD COLUMN eixo LINESTRING")
    connection.execute("UPDATE paredes SET eixo = geom")
    if registered:
        connection.execute("ALTER TABLE gpkg_geometry_columns RENAME TO strict")
        connection.execute("CREATE TABLE gpkg_geometry_columns AS SELECT * FROM strict")
        connection.execute(
            "INSERT INTO gpkg_geometry_columns SELECT table_name, 'eixo', geometry_type_name, srs_id, z, m FROM strict "
            "WHERE table_name = 'paredes'"
        )
        connection.execute("DROP TABLE strict")
    connection.commit()
    connection.close()
    return path


def test_two_registered_columns_of_geometry_are_named(tmp_path: Path) -> None:
    error = refused(doubled(tmp_path / "a.gpkg", registered=True))
    assert error.message == "read.gpkg-several-geometries"
    assert (error.fields["key"], error.fields["value"]) == ("paredes", "eixo, geom")


def test_a_table_beside_one_with_two_columns_is_read_and_the_question_stays_open(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    write(path, ["POINT (0 0)"], layer="pontos")
    doubled(path, registered=True)
    drawing = read(path)
    assert drawing.items.item.tolist() == ["pontos:1"]
    (told,) = drawing.reading.skipped
    assert (told.reason, told.layer, told.name, told.reason.opens) == (
        "several-geometries",
        "paredes",
        "eixo, geom",
        True,
    )


def test_a_column_that_the_register_does_not_know_is_named(tmp_path: Path) -> None:
    drawing = read(doubled(tmp_path / "a.gpkg", registered=False))
    assert drawing.items.item.tolist() == ["paredes:1"]
    (told,) = drawing.reading.skipped
    assert (told.reason, told.kind, told.name, told.reason.opens) == ("unlisted-geometry", "LINESTRING", "eixo", False)
