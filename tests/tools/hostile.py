# SPDX-License-Identifier: MIT
"""Deliveries that mean harm: to the file system, to the manifest's reader, to the tables' reader."""

import os
import shutil
import sqlite3
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyogrio.raw
import shapely
from drawings import lines_gpkg
from inputs import drawing, line, write_dxf

READ = (0, 1, 3)  #: taken in and judged
REFUSED = (4,)
WRONG = (2,)

# --- companions of a Shapefile --------------------------------------------------------------------------------------


def shapefile(path: Path) -> None:
    wkb = np.array([shapely.to_wkb(shapely.LineString([(0, 0), (1, 0)]))], dtype=object)
    pyogrio.raw.write(path, wkb, [], [], geometry_type="LineString", driver="ESRI Shapefile", crs="EPSG:31982")


def _companion(path: Path, ending: str) -> Path:
    shapefile(path)
    other = path.with_suffix(ending)
    other.unlink(missing_ok=True)
    return other


@drawing(suffix=".shp", exits=REFUSED)
def companion_endless_link(path: Path) -> None:
    """``.prj`` linked to an endless device."""
    _companion(path, ".prj").symlink_to("/dev/zero")


@drawing(suffix=".shp", exits=REFUSED)
def companion_pipe(path: Path) -> None:
    """``.dbf`` is a pipe that nobody writes to."""
    os.mkfifo(_companion(path, ".dbf"))


@drawing(suffix=".shp", exits=REFUSED)
def companion_pipe_encoding(path: Path) -> None:
    """``.cpg`` is a pipe that nobody writes to."""
    os.mkfifo(_companion(path, ".cpg"))


@drawing(suffix=".shp", exits=REFUSED)
def companion_index_pipe(path: Path) -> None:
    """A spatial index that is a pipe."""
    os.mkfifo(_companion(path, ".qix"))


@drawing(suffix=".shp", exits=REFUSED)
def companion_outside(path: Path) -> None:
    """``.prj`` linked to a file outside."""
    _companion(path, ".prj").symlink_to("/etc/hostname")


@drawing(suffix=".shp", exits=REFUSED)
def companion_capitals(path: Path) -> None:
    """``.PRJ`` in capitals, linked to an endless device."""
    _companion(path, ".prj").with_suffix(".PRJ").symlink_to("/dev/zero")


@drawing(suffix=".shp", exits=READ)
def companion_sheet(path: Path) -> None:
    """A companion of a kind that GDAL looks for beside any file, linked to an endless device."""
    shapefile(path)
    path.with_suffix(".shp.xml").symlink_to("/dev/zero")
    path.with_name(path.name + ".aux.xml").symlink_to("/dev/zero")
    path.with_suffix(".idm").symlink_to("/dev/zero")
    path.with_suffix(".ind").symlink_to("/dev/zero")


# --- names ------------------------------------------------------------------------------------------------------------


@drawing(suffix=".gpkg", exits=READ)
def name_with_signs(path: Path) -> Path:
    """Signs that libraries take for syntax."""
    lines_gpkg(path)
    return path.rename(path.with_name("corte 100% #2 & a;b?c=d\"e:f'g!.gpkg"))


@drawing(suffix=".shp", exits=READ)
def shapefile_with_signs(path: Path) -> Path:
    """The same for a Shapefile."""
    odd = path.with_name("corte 100% #2 & a;b?c=d:f!.shp")
    shapefile(path)
    for other in path.parent.glob(f"{path.stem}.*"):
        other.rename(odd.with_suffix(other.suffix))
    return odd


@drawing(exits=(*READ, 4))
def name_not_utf8(path: Path) -> Path:
    """A name in Windows-1252."""
    odd = path.parent / os.fsdecode("sa\xedda.dxf".encode("cp1252"))
    write_dxf(odd, entities=line(0, 0, 1, 0))
    return odd


@drawing(suffix=".gpkg", exits=(*READ, 4))
def package_name_not_utf8(path: Path) -> Path:
    """A GeoPackage whose name is in Windows-1252."""
    lines_gpkg(path)
    odd = path.parent / os.fsdecode("sa\xedda.gpkg".encode("cp1252"))
    path.rename(odd)
    return odd


@drawing(suffix=".gpkg", exits=READ)
def name_with_trailing_blank(path: Path) -> Path:
    """A name that ends in a blank."""
    lines_gpkg(path)
    return path.rename(path.with_name("corte.gpkg "))


@drawing(suffix=".geojson", exits=READ)
def name_into_an_archive(path: Path) -> Path:
    """A folder called like an archive, beside names that GDAL would read from inside one."""
    folder = path.parent / "a.zip"
    folder.mkdir()
    plain = folder / "plano.geojson"
    plain.write_text('{"type":"LineString","coordinates":[[0,0],[1,0]]}', encoding="utf-8")
    return plain


@drawing(suffix=".shp", exits=(*READ, 4))
def archive_with_a_sign(path: Path) -> Path:
    """``a!.shp`` beside an archive ``a`` that holds another drawing."""
    shapefile(path)
    odd = path.with_name("a.shz!b.shp")
    for other in path.parent.glob(f"{path.stem}.*"):
        shutil.copy(other, odd.with_suffix(other.suffix))
    with zipfile.ZipFile(path.with_name("a.shz"), "w") as archive:
        for other in path.parent.glob(f"{path.stem}.*"):
            archive.write(other, f"b{other.suffix}")
    return odd


# --- journals ---------------------------------------------------------------------------------------------------------


@drawing(suffix=".gpkg", exits=(*READ, 4))
def write_ahead_log(path: Path) -> None:
    """A GeoPackage with its last changes in a write-ahead log beside it."""
    lines_gpkg(path)
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("CREATE TABLE notes (text TEXT)")
    connection.commit()
    for ending in ("", "-wal"):
        shutil.copy(f"{path}{ending}", f"{path}{ending}.kept")
    connection.close()
    for ending in ("", "-wal"):
        Path(f"{path}{ending}.kept").rename(f"{path}{ending}")


# --- manifests --------------------------------------------------------------------------------------------------------


def manifest(name: str, text: str | bytes, exits: tuple[int, ...]) -> None:
    """Register a delivery of one drawing with a manifest."""

    def write(path: Path) -> Path:
        folder = path.with_suffix("")
        folder.mkdir()
        write_dxf(folder / "a.dxf", entities=line(0, 0, 1, 0))
        (folder / "delivery.toml").write_bytes(text.encode() if isinstance(text, str) else text)
        return folder

    write.__name__ = f"manifest_{name}"
    drawing(command="audit", exits=exits)(write)


def _drawn(more: str) -> str:
    return f'[delivery]\nscale = "1:50"\n\n[[drawing]]\npath = "a.dxf"\nunit = "m"\n{more}\n'


manifest("long_path", _drawn("").replace("a.dxf", "x" * 5_000), (2, 4))
manifest("many_folders", _drawn("").replace("a.dxf", "x/" * 2_500 + "a.dxf"), (2, 4))
manifest("brackets", "[delivery]\ntitle = " + "[" * 100_000, WRONG)
manifest("closed_brackets", "[record]\na = " + "[" * 100_000 + "]" * 100_000, WRONG)
manifest("tables_within", "[record" + ".a" * 100_000 + "]\n", WRONG)
manifest("inline_tables", "[record]\na = " + "{a=" * 50_000 + "1" + "}" * 50_000, WRONG)
manifest("long_integer", "[record]\na = " + "9" * 6_000, WRONG)
manifest("long_scale", _drawn("").replace("1:50", "1:" + "9" * 5_000), WRONG)
manifest("long_scale_fraction", _drawn("").replace("1:50", "1:0." + "9" * 5_000), (2, *READ))
manifest("plane_nan", _drawn("plane = [[nan,0,0],[1,0,0],[0,0,1]]"), WRONG)
manifest("plane_inf", _drawn("plane = [[0,0,0],[inf,0,0],[0,0,1]]"), WRONG)
manifest("plane_large", _drawn("plane = [[0,0,0],[1e308,1e308,0],[0,0,1e308]]"), (2, *READ))
manifest("plane_null", _drawn("plane = [[0,0,0],[0,0,0],[0,0,0]]"), WRONG)
manifest("nul", b'[delivery]\ntitle = "a\x00b"\n', WRONG)
manifest("nul_path", _drawn("").replace("a.dxf", "a\\u0000.dxf"), (2, 4))
manifest("utf16", _drawn("").encode("utf-16"), WRONG)
manifest("not_utf8", _drawn("").encode() + b'title = "\xff"\n', WRONG)
manifest("mark", b"\xef\xbb\xbf" + _drawn("").encode(), READ)
manifest("survey_sd_huge", _drawn('[checkpoints]\npath = "p.csv"\nsurvey_sd = "' + "9" * 5_000 + ' mm"'), (2, 4))
manifest("long_profile", _drawn("").replace("scale", 'profile = "' + "x" * 5_000 + '"\nscale'), WRONG)
manifest("folder", _drawn("").replace("a.dxf", "."), (2, 4))
manifest("empty", "", (*READ, 2))

# --- tables -------------------------------------------------------------------------------------------------------


def table(name: str, text: Callable[[], bytes], exits: tuple[int, ...] = (3, 4)) -> None:
    """Register a delivery whose list of features is what a function answers."""

    def write(path: Path) -> Path:
        folder = path.with_suffix("")
        folder.mkdir()
        write_dxf(folder / "a.dxf", entities=line(0, 0, 1, 0))
        (folder / "t.csv").write_bytes(text())
        (folder / "delivery.toml").write_text(_drawn('[features]\npath = "t.csv"'), encoding="utf-8")
        return folder

    write.__name__ = f"table_{name}"
    drawing(command="audit", exits=exits)(write)


table("long_cell", lambda: b"id;class\n1;" + b"x" * 300_000_000)
table("long_line", lambda: b"id;class\n" + b"1;window\n" * 100 + b'"' + b"x" * 49_000_000)
table("many_columns", lambda: b";".join(b"c%d" % n for n in range(500_000)) + b"\nid;class\n")
table("many_rows", lambda: b"id;class\n" + b"".join(b"%d;window\n" % n for n in range(2_000_000)))
table("long_number", lambda: b"id;class;count\n1;window;" + b"9" * 1_000_000)
table("large_exponent", lambda: b"id;class;count\n1;window;1e999\n")
