# SPDX-License-Identifier: MIT
"""Libraries see links of plain names only; nothing is written beside the delivery, nothing stays behind."""

import os
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest
from tests.read.gis_files import listing, read, write

from foparq.errors import UnreadableError, UnsafeError, WriteError
from foparq.read.gis import gpkg_safety
from foparq.read.guard.stage import mark, private_folder, staged, sweep
from foparq.report.words import LANGUAGES, Words

LINE = ["LINESTRING (0 0, 1 0)"]


@pytest.mark.parametrize("ending", [".gpkg", ".geojson", ".shp"])
@pytest.mark.parametrize("stem", ["100% #2 & a;b?c=d:e'f!", "a.zip!b", "sa\udceda", " "])
def test_no_sign_of_a_name_is_taken_for_syntax(stem: str, ending: str, tmp_path: Path) -> None:
    path = write(tmp_path / f"plain{ending}", LINE)
    for other in tmp_path.iterdir():
        other.rename(other.with_name(f"{stem}{other.suffix}"))
    drawing = read(path.with_name(f"{stem}{ending}"), unit="m")
    assert len(drawing.items) == 1
    assert not any("\ud800" <= letter <= "\udfff" for name in drawing.reading.layers for letter in name)


def test_a_name_that_ends_in_a_blank(tmp_path: Path) -> None:
    path = write(tmp_path / "corte.gpkg", LINE)
    assert len(read(path.rename(tmp_path / "corte.gpkg ")).items) == 1


@pytest.mark.parametrize("ending", [".prj", ".PRJ", ".cpg", ".dbf", ".qix"])
@pytest.mark.parametrize("target", ["/dev/zero", "/etc/passwd", "nowhere"])
def test_a_companion_that_is_a_link_is_refused_and_named(target: str, ending: str, tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", LINE)
    other = path.with_suffix(ending)
    other.unlink(missing_ok=True)
    other.symlink_to(target)
    with pytest.raises((UnsafeError, UnreadableError)) as caught:
        read(path)
    assert caught.value.fields["key"] == other.name
    assert all(other.name in Words(language).error(caught.value) for language in LANGUAGES)


@pytest.mark.parametrize("ending", [".prj", ".cpg", ".dbf", ".qix"])
def test_a_companion_that_is_a_pipe_is_refused_and_named(ending: str, tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", LINE)
    path.with_suffix(ending).unlink(missing_ok=True)
    os.mkfifo(path.with_suffix(ending))
    with pytest.raises(UnreadableError) as caught:
        read(path)
    assert (caught.value.message, caught.value.fields["key"]) == ("read.companion-odd", f"a{ending}")


def test_a_reference_system_of_a_megabyte_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", LINE)
    path.with_suffix(".prj").write_bytes(b" " * 1_000_000)
    with pytest.raises(UnsafeError) as caught:
        read(path)
    assert caught.value.message == "read.companion-large"


def test_files_that_nobody_asked_for_are_not_opened(tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", LINE)
    for name in ("a.idm", "a.ind", "a.shp.aux.xml", "a.shp.xml"):
        (tmp_path / name).symlink_to("/dev/zero")
    assert len(read(path).items) == 1


def test_an_empty_log_beside_a_database_leaves_no_trace(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", LINE)
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("CREATE TABLE notes (text TEXT)")
    connection.close()
    (tmp_path / "a.gpkg-wal").touch()
    before = listing(tmp_path)
    assert len(read(path).items) == 1
    assert listing(tmp_path) == before


def test_a_link_leads_to_the_file_and_is_gone_afterwards(tmp_path: Path) -> None:
    file = tmp_path / "a?b.txt"
    file.write_text("x", encoding="utf-8")
    with staged({"plain.txt": file}) as link:
        assert link.name == "plain.txt"
        assert link.read_text(encoding="utf-8") == "x"
        assert [other.name for other in link.parent.iterdir()] == ["plain.txt"]
    assert not link.parent.exists()


def test_what_a_killed_run_left_is_removed_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    killed = "import os; from foparq.read.guard.stage import _made; print(_made(), flush=True); os._exit(1)"
    done = subprocess.run([sys.executable, "-c", killed], capture_output=True, text=True, check=False)
    left = done.stdout.strip()
    assert Path(left).parent == tmp_path
    (Path(left) / "drawing.gpkg").symlink_to("/etc/hostname")
    kept = tmp_path / "foparq-crash-1.log"
    kept.touch()
    stranger = tmp_path / mark().replace(f"-{os.getpid()}-", "-x-")
    stranger.mkdir()
    with private_folder() as own:
        sweep()
        assert not Path(left).exists()
        assert own.exists()
    assert kept.exists()
    assert stranger.exists()
    assert Path("/etc/hostname").exists()


def test_a_temporary_folder_that_cannot_be_used_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(**_: object) -> str:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tempfile.mkdtemp", full)
    with pytest.raises(WriteError) as caught, private_folder():
        pass
    for language in LANGUAGES:
        assert "No space left on device" in Words(language).error(caught.value)


def test_texts_that_name_layers_are_bounded(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", LINE, camada=["x"])
    with sqlite3.connect(path) as connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
            connection.execute(f'DROP TRIGGER "{name}"')
        connection.execute("UPDATE paredes SET camada = CAST(? AS TEXT)", (b"x" * 20_000_000,))
    connection.close()
    with pytest.raises(UnsafeError) as caught:
        read(path)
    assert caught.value.message == "read.cell-too-large"


@pytest.mark.parametrize(("name", "refused"), [("xxxxxxxxxx", False), ("xxxxxxxxxxx", True)])
def test_as_much_text_as_may_be_names_layers(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    name: str,
    refused: bool,  # noqa: FBT001
) -> None:
    monkeypatch.setattr(gpkg_safety, "_MOST_TEXT", 20)
    path = write(tmp_path / "a.gpkg", [*LINE, *LINE], camada=["yyyyyyyyyy", name])
    if refused:
        with pytest.raises(UnsafeError, match=r"read\.cell-too-large"):
            read(path)
    else:
        assert set(read(path).items.layer.tolist()) == {"yyyyyyyyyy", name}


@pytest.mark.parametrize(("count", "refused"), [(2_000, False), (2_001, True)])
def test_columns_are_bounded(count: int, refused: bool, tmp_path: Path) -> None:  # noqa: FBT001
    # "type", "properties", "geometry" and "coordinates" are names too.
    properties = ",".join(f'"p{n}":{n}' for n in range(count - 4))
    path = tmp_path / "a.geojson"
    geometry = '{"type":"LineString","coordinates":[[0,0],[1,0]]}'
    path.write_text(f'{{"type":"Feature","properties":{{{properties}}},"geometry":{geometry}}}', encoding="utf-8")
    if not refused:
        assert len(read(path).items) == 1
        return
    with pytest.raises(UnsafeError) as caught:
        read(path)
    assert caught.value.message == "read.too-many-columns"
