# SPDX-License-Identifier: MIT
"""What lies inside a delivery, and what only looks like it."""

import hashlib
import os
from pathlib import Path

import pytest

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.delivery import Source, SourceStatus
from foparq.read.guard import paths
from foparq.read.guard.paths import files_of, fit_to_read, inside, sha256_of
from foparq.read.intake import identified


@pytest.fixture
def station(tmp_path: Path) -> Path:
    root = tmp_path / "station-a"
    (root / "desenhos").mkdir(parents=True)
    (root / "desenhos" / "fachada.dxf").write_text("x")
    return root


@pytest.mark.parametrize("sibling", ["station-a2", "station-a.bak", "station-a b", "station-aa"])
def test_a_sibling_whose_name_begins_alike_lies_outside(station: Path, sibling: str) -> None:
    folder = station.parent / sibling
    folder.mkdir()
    (folder / "fachada.dxf").write_text("x")
    for named in (f"../{sibling}/fachada.dxf", f"desenhos/../../{sibling}/fachada.dxf", f"..\\{sibling}\\fachada.dxf"):
        with pytest.raises(UnsafeError) as caught:
            inside(station, named)
        assert (caught.value.message, caught.value.fields["file"]) == ("read.path-outside", named)
    (station / "elo").symlink_to(folder)
    with pytest.raises(UnsafeError, match=r"read\.path-outside"):
        inside(station, "elo/fachada.dxf")


@pytest.mark.parametrize(
    "named", ["desenhos/fachada.dxf", "./desenhos/fachada.dxf", "desenhos/../desenhos/fachada.dxf",
              "../station-a/desenhos/fachada.dxf", "desenhos\\fachada.dxf"],
)  # fmt: skip
def test_ways_to_a_file_inside(station: Path, named: str) -> None:
    assert inside(station, named) == (station / "desenhos" / "fachada.dxf").resolve()


def test_a_delivery_reached_through_a_link_is_the_same_delivery(station: Path) -> None:
    (station.parent / "elo").symlink_to(station)
    assert inside(station.parent / "elo", "desenhos/fachada.dxf") == (station / "desenhos" / "fachada.dxf").resolve()


def test_a_file_inside_need_not_exist(station: Path) -> None:
    assert inside(station, "nada.dxf") == station.resolve() / "nada.dxf"


@pytest.mark.parametrize(
    ("named", "message"),
    [
        ("", "read.path-odd"), ("  ", "read.path-odd"), ("a\x1fb.dxf", "read.path-odd"), ("a\nb.dxf", "read.path-odd"),
        ("http://x/y.dxf", "read.path-address"), ("file:///x", "read.path-address"), ("C:x.dxf", "read.path-address"),
        ("/vsizip/x.zip", "read.path-address"), ("<xml>", "read.path-address"),
        ("/etc/passwd", "read.path-absolute"), ("\\\\server\\x", "read.path-absolute"), ("\\x", "read.path-absolute"),
        ("..", "read.path-outside"), ("../x.dxf", "read.path-outside"),
    ],
)  # fmt: skip
def test_names_that_are_no_place_inside(station: Path, named: str, message: str) -> None:
    with pytest.raises(UnsafeError) as caught:
        inside(station, named)
    assert caught.value.message == message


def test_a_blank_is_a_letter_of_a_name(station: Path) -> None:
    assert inside(station, "planta baixa.dxf").name == "planta baixa.dxf"


def test_a_file_of_exactly_the_limit_is_read(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_bytes(b"12345")
    assert fit_to_read(path, 5) == 5
    with pytest.raises(UnsafeError) as caught:
        fit_to_read(path, 4)
    assert (caught.value.message, caught.value.fields["value"]) == ("read.too-large", 5)


def test_only_a_regular_file_is_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "pipe"):
        with pytest.raises(UnreadableError) as caught:
            fit_to_read(path, 5)
        assert caught.value.message == "read.not-a-file"


def test_the_hash_is_that_of_the_bytes(tmp_path: Path) -> None:
    path = tmp_path / "x"
    path.write_bytes(b"foparq\r\n\0" * 300_000)
    assert sha256_of(path) == hashlib.sha256(path.read_bytes()).hexdigest()


def test_files_in_order_without_hidden_left_and_linked_ones(tmp_path: Path) -> None:
    for name in ("b/2.dxf", "b/1.dxf", "b/audit/x.dxf", "a.dxf", "c.dxf", ".git/x", "b/.x", "audit/page.html"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x")
    (tmp_path / "elo").symlink_to(tmp_path / "b")
    found = [path.relative_to(tmp_path).as_posix() for path in files_of(tmp_path, frozenset({"audit"}))]
    # A link to a folder is named and not followed; a folder named like what is left out is looked into when deeper.
    assert found == ["a.dxf", "c.dxf", "elo", "b/1.dxf", "b/2.dxf", "b/audit/x.dxf"]


def test_one_file_more_than_the_most_shows_that_there_are_too_many(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(paths, "MOST_FILES", 3)
    for n in range(6):
        (tmp_path / f"{n}.dxf").write_text("x")
    assert len(list(files_of(tmp_path, frozenset()))) == 4


COMPOSED, DECOMPOSED = "Fachada S\u00e3o Jo\u00e3o.dxf", "Fachada Sa\u0303o Joa\u0303o.dxf"


@pytest.mark.parametrize(("written", "there"), [(COMPOSED, DECOMPOSED), (DECOMPOSED, COMPOSED)])
def test_accents_are_found_however_they_are_composed(tmp_path: Path, written: str, there: str) -> None:
    folder = tmp_path / "elevac\u0327o\u0303es"
    folder.mkdir()
    (folder / there).write_text("")
    assert inside(tmp_path, f"eleva\u00e7\u00f5es/{written}") == (folder / there).resolve()


def test_a_name_in_another_composition_leads_nowhere_else(tmp_path: Path) -> None:
    home = tmp_path / "a"
    home.mkdir()
    (tmp_path / "b.dxf").write_text("")
    (home / "o\u0301.dxf").symlink_to(tmp_path / "b.dxf")
    with pytest.raises(UnsafeError):
        inside(home, "\u00f3.dxf")
    (home / "B.dxf").symlink_to(tmp_path / "b.dxf")
    with pytest.raises(UnsafeError):
        inside(home, "b.dxf")
    (home / "u\u0301.dxf").symlink_to(home / "nowhere.dxf")
    assert not inside(home, "\u00fa.dxf").exists()
    assert not inside(home, "u\u0301.dxf").exists()


def test_a_file_whose_name_differs_in_case_is_taken_if_it_is_the_only_one(tmp_path: Path) -> None:
    (tmp_path / "desenhos").mkdir()
    (tmp_path / "desenhos" / "fachada.dxf").write_text("")
    source = Source(path="Desenhos/Fachada.DXF", role="drawing", sha256="", bytes=0, status=SourceStatus.REFUSED)
    assert inside(tmp_path, source.path) == (tmp_path / "desenhos" / "fachada.dxf").resolve()
    # Named without a folder of a delivery, it is told and not taken.
    told = identified(source, tmp_path / source.path, 1000)
    assert (told.status, told.error) == (SourceStatus.MISSING, "read.missing-like")
    assert dict(told.fields)["other"] == "desenhos/fachada.dxf"
    (tmp_path / "desenhos" / "FACHADA.dxf").write_text("")
    assert identified(source, inside(tmp_path, source.path), 1000).error == "read.missing"
