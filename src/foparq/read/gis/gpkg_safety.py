# SPDX-License-Identifier: MIT
"""What a GeoPackage holds, learned without letting it run anything.

A GeoPackage is a database and can carry programs: views, virtual tables, computed columns, triggers. A view registered
as a layer can keep a reader busy for ever. The file is therefore looked at first with the strictest settings of SQLite
and a deadline; only plain tables that are registered as layers are handed on.
"""

import math
import os
import re
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.read.gis.columns import GEOMETRY_TYPES, TEXT_COLUMNS
from foparq.read.gis.journal import unsaved

APPLICATION_IDS = {0x47504B47: "GPKG", 0x47503130: "GPKG 1.0", 0x47503131: "GPKG 1.1"}
_STEPS = 1000  #: instructions of SQLite between two looks at the clock
_MOST_TEXT = 100_000_000  #: bytes of all names of layers that rows of one table state
_LONGEST_TEXT = 10_000_000  #: bytes of one value or statement while inspecting
#: triggers that the standard and GDAL write into every file
_USUAL_TRIGGER = re.compile(
    r"^(rtree_|gpkg_|trigger_(insert|delete)_feature_count_)|_(zoom|tile_column|tile_row)(_level)?_(insert|update)$",
    re.IGNORECASE,
)
_PROGRAM = re.compile(r"^\s*CREATE\s+VIRTUAL\b", re.IGNORECASE)
_SMALL = {ord(letter): ord(letter) + 32 for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ"}
_UNDEFINED = (-1, 0)  #: ids of the two reference systems that say nothing
#: what a registered table holds, if it is no layer of features; of anything else nobody knows what it shows
_OTHER_CONTENTS = {
    "attributes": SkippedReason.ATTRIBUTES,
    "aspatial": SkippedReason.ATTRIBUTES,
    "tiles": SkippedReason.RASTER,
    "2d-gridded-coverage": SkippedReason.RASTER,
}
_COMPUTED = (2, 3)  #: ``hidden`` in ``PRAGMA table_xinfo`` of virtual and stored computed columns


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """One plain table of features."""

    name: str
    column: str  #: geometry column
    geometry_type: str  #: ``"MULTILINESTRING"``, as registered
    undefined_crs: bool  #: the reference system is one of the two "undefined" ones
    rows: int  #: counted, not as the file claims


@dataclass(frozen=True, slots=True, kw_only=True)
class Contents:
    """What is in a GeoPackage."""

    version: str
    tables: tuple[Table, ...]
    skipped: tuple[Skipped, ...]
    layers: tuple[str, ...]  #: everything registered, also what is not read


def inspect(path: Path, *, seconds: float) -> Contents:
    """Contents of a GeoPackage.

    Parameters
    ----------
    path : Path
        A file that starts as SQLite files do.
    seconds : float
        Time for the whole inspection.

    Returns
    -------
    Contents
        Tables in the order of their names.

    Raises
    ------
    UnreadableError
        If it is no GeoPackage, is broken, or its last changes lie in a journal beside it.
    UnsafeError
        If looking at it takes too long, or its register is itself a program.
    """
    if (journal := unsaved(path)) is not None:
        raise UnreadableError("read.gpkg-journal", file=path.name, value=journal.name)
    with opened(path, seconds) as connection:
        schema = _schema(path.name, connection)
        if "gpkg_contents" not in schema.objects:
            raise UnreadableError("read.gpkg-no-register", file=path.name)
        programs = [held.name for key, held in schema.objects.items() if key.startswith("gpkg_") and held.is_program]
        if programs:
            raise UnsafeError("read.gpkg-register", file=path.name, value=min(programs))
        tables, skipped = _layers(schema)
        listed = connection.execute("SELECT table_name FROM gpkg_contents ORDER BY table_name")
        layers = tuple(str(name) for (name,) in listed)
        return Contents(
            version=_version(connection),
            tables=tuple(tables),
            skipped=(*skipped, *_unlisted(schema, layers)),
            layers=layers,
        )


@dataclass(frozen=True, slots=True)
class _Object:
    """A table or a view, as the schema names it."""

    name: str
    kind: str
    sql: str

    @property
    def is_program(self) -> bool:
        return self.kind == "view" or _PROGRAM.match(self.sql) is not None


@dataclass(frozen=True, slots=True)
class _Schema:
    """Everything in a database that could be read, and what could run."""

    file: str
    connection: sqlite3.Connection
    objects: dict[str, _Object]  #: tables and views by name in small letters
    triggers: tuple[str, ...]

    def rows(self, table: str, columns: str) -> list[tuple[object, ...]]:
        """Rows of a table of the register; none if it is absent."""
        if table not in self.objects:
            return []
        # Both names are this module's own.
        return self.connection.execute(f"SELECT {columns} FROM {table}").fetchall()  # noqa: S608

    def columns(self, name: str) -> list[tuple[object, ...]]:
        """Description of the columns of a table, computed ones too."""
        return self.connection.execute(f"PRAGMA table_xinfo({quoted(name)})").fetchall()


def _schema(file: str, connection: sqlite3.Connection) -> _Schema:
    # A trigger may have the name of a table: it must not hide it.
    found = connection.execute("SELECT name, type, sql FROM sqlite_master ORDER BY name").fetchall()
    objects = {_small(name): _Object(name, kind, sql or "") for name, kind, sql in found if kind in ("table", "view")}
    return _Schema(file, connection, objects, tuple(name for name, kind, _ in found if kind == "trigger"))


def _small(name: str) -> str:
    # SQLite folds the letters A to Z only: no other letter may pass for one of them.
    return name.translate(_SMALL)


@contextmanager
def opened(path: Path, seconds: float, *, longest: int = _LONGEST_TEXT) -> Iterator[sqlite3.Connection]:
    """Open a database that may mean harm.

    Parameters
    ----------
    seconds : float
        Time until every query is given up.
    longest : int
        Bytes of one value or statement.

    Yields
    ------
    sqlite3.Connection
        Immutable: no lock, no journal and no shared memory file is ever made beside the delivered file.

    Raises
    ------
    UnreadableError
        If the database is broken.
    UnsafeError
        If the time runs out.
    """
    deadline = time.monotonic() + seconds
    try:
        with closing(
            sqlite3.connect(f"file:{quote(os.fsencode(path.resolve()))}?mode=ro&immutable=1", uri=True)
        ) as connection:
            connection.set_progress_handler(lambda: int(time.monotonic() > deadline), _STEPS)
            connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, longest)
            connection.setlimit(sqlite3.SQLITE_LIMIT_ATTACHED, 0)
            connection.text_factory = lambda raw: raw.decode("utf-8", "replace")
            for pragma in ("trusted_schema=OFF", "query_only=ON", "cell_size_check=ON", "mmap_size=0"):
                connection.execute(f"PRAGMA {pragma}")
            yield connection
    except sqlite3.OperationalError as error:
        if "interrupted" in str(error):
            raise UnsafeError("read.gpkg-endless", file=path.name, seconds=int(seconds)) from None
        raise UnreadableError("read.gpkg-broken", file=path.name, value=str(error)) from None
    except (sqlite3.DatabaseError, OverflowError, UnicodeDecodeError) as error:
        raise UnreadableError("read.gpkg-broken", file=path.name, value=str(error)) from None


def _layers(schema: _Schema) -> tuple[list[Table], list[Skipped]]:
    tables: list[Table] = []
    skipped: list[Skipped] = []
    geometry: dict[str, tuple[str, str, int]] = {}
    registered: dict[str, list[str]] = {}
    for row in schema.rows("gpkg_geometry_columns", "table_name, column_name, geometry_type_name, srs_id"):
        key, column = _small(str(row[0])), str(row[1])
        geometry[key] = (column, str(row[2]).upper(), _whole(row[3]))
        registered.setdefault(key, []).append(column)
    systems = {
        _whole(srs): (str(organisation).casefold(), _whole(code))
        for srs, organisation, code in schema.rows(
            "gpkg_spatial_ref_sys", "srs_id, organization, organization_coordsys_id"
        )
    }
    for listed, data_type in schema.rows("gpkg_contents", "table_name, data_type"):
        key = _small(str(listed))
        (column, kind, srs), named = geometry.get(key, ("", "", 0)), ""
        reason, columns = _reason(schema, key, str(data_type), column), registered.get(key, [])
        if not reason and len(columns) > 1:
            reason, named = SkippedReason.SEVERAL_GEOMETRIES, ", ".join(sorted(columns))
        if reason:
            skipped.append(Skipped(reason=reason, kind=str(data_type), layer=str(listed), count=1, name=named))
            continue
        name = schema.objects[key].name
        skipped += _unlisted_columns(schema, name, column)
        count = f"SELECT count(*) FROM {quoted(name)}"  # noqa: S608 - quoted
        organisation, code = systems.get(srs, ("none", srs))
        undefined = srs in _UNDEFINED or (organisation == "none" and code in _UNDEFINED)
        rows = schema.connection.execute(count).fetchone()[0]
        _hold_texts(schema, name)
        tables.append(Table(name=name, column=column, geometry_type=kind, undefined_crs=undefined, rows=rows))
    return sorted(tables, key=lambda table: table.name), sorted(skipped, key=lambda record: record.layer)


def _reason(schema: _Schema, key: str, data_type: str, column: str) -> SkippedReason | None:
    # Why a registered layer is not read; None if it is.
    if data_type != "features":
        return _OTHER_CONTENTS.get(data_type, SkippedReason.UNSUPPORTED_LAYER)
    held = schema.objects.get(key)
    if held is None:
        return SkippedReason.TABLE_MISSING
    if held.is_program:
        return SkippedReason.VIEW if held.kind == "view" else SkippedReason.VIRTUAL_TABLE
    columns = schema.columns(held.name)
    if any(row[6] in _COMPUTED for row in columns):
        return SkippedReason.COMPUTED_TABLE
    known = {_small(str(row[1])) for row in columns}
    return None if _small(column) in known else SkippedReason.NO_GEOMETRY_COLUMN


def _unlisted_columns(schema: _Schema, table: str, column: str) -> list[Skipped]:
    # Columns declared as geometry that the register does not know: no program shows them.
    others = [
        (str(row[1]), str(row[2]).upper()) for row in schema.columns(table) if _small(str(row[1])) != _small(column)
    ]
    reason = SkippedReason.UNLISTED_GEOMETRY
    named = [(name, kind) for name, kind in others if kind in GEOMETRY_TYPES]
    return [Skipped(reason=reason, kind=kind, layer=table, count=1, name=name) for name, kind in named]


def _hold_texts(schema: _Schema, table: str) -> None:
    # The text that names a layer is held in memory several times. A longer value than one may be is an error of SQLite.
    for column in {str(row[1]) for row in schema.columns(table)} & set(TEXT_COLUMNS):
        query = f"SELECT total(length({quoted(column)})) FROM {quoted(table)}"  # noqa: S608 - quoted
        try:
            (total,) = schema.connection.execute(query).fetchone()
        except sqlite3.DataError:
            total = math.inf
        if total > _MOST_TEXT:
            raise UnsafeError("read.cell-too-large", file=schema.file, key=f"{table}.{column}", limit=_MOST_TEXT)


def _unlisted(schema: _Schema, layers: tuple[str, ...]) -> list[Skipped]:
    # Views, virtual tables and triggers that are no layers: never run, but told.
    listed = {_small(name) for name in layers}
    found = [(SkippedReason.TRIGGER, name) for name in schema.triggers if not _USUAL_TRIGGER.search(name)]
    found += [
        (SkippedReason.UNLISTED_VIEW if held.kind == "view" else SkippedReason.UNLISTED_VIRTUAL_TABLE, held.name)
        for key, held in schema.objects.items()
        if held.is_program and key not in listed and not (key.startswith("rtree_") and held.kind == "table")
    ]
    return [Skipped(reason=reason, kind=reason.value, layer=name, count=1) for reason, name in sorted(found)]


def quoted(name: str) -> str:
    """Name of a table or column as SQLite reads it back, whatever it contains."""
    return '"' + name.replace('"', '""') + '"'


def _whole(value: object) -> int:
    try:
        return int(str(value))
    except ValueError:
        return 0


def _version(connection: sqlite3.Connection) -> str:
    (application,) = connection.execute("PRAGMA application_id").fetchone()
    (number,) = connection.execute("PRAGMA user_version").fetchone()
    known = APPLICATION_IDS.get(application, "GPKG")
    return f"GPKG {number // 10000}.{number // 100 % 100}" if known == "GPKG" and number else known
