# SPDX-License-Identifier: MIT
"""GIS files made on the spot, and how tests read them."""

import sqlite3
from pathlib import Path

import numpy as np
import pyogrio.raw
import pytest
import shapely

from foparq.errors import FoparqError, UnreadableError
from foparq.profile.schema import LimitsSpec
from foparq.read.gis.reader import read_gis
from foparq.read.raw import RawDrawing
from foparq.report.words import LANGUAGES, Words

WHERE = (500_000.0, 7_500_000.0)  # on the central meridian of a UTM zone of the southern hemisphere


def read(path: Path, *, unit: str | None = None, layers: tuple[str, ...] = (), **limits: int) -> RawDrawing:
    return read_gis(path, limits=LimitsSpec(**limits), sagitta=1e-4, unit=unit, layers=layers)


def write(
    path: Path,
    wkt: list[str | None],
    *,
    kind: str = "Unknown",
    crs: str | None = "EPSG:31982",
    layer: str = "paredes",
    append: bool = False,
    **columns: list[object],
) -> Path:
    driver = {".gpkg": "GPKG", ".shp": "ESRI Shapefile", ".geojson": "GeoJSON"}[path.suffix]
    geometry = np.array(
        [None if text is None else shapely.to_wkb(shapely.from_wkt(text)) for text in wkt], dtype=object
    )
    values = [np.array(column, dtype=object) for column in columns.values()]
    pyogrio.raw.write(
        path, geometry, values, list(columns), geometry_type=kind, driver=driver, crs=crs, layer=layer, append=append,
        promote_to_multi=False,
    )  # fmt: skip
    return path


def refused(path: Path, kind: type[FoparqError] = UnreadableError, **limits: int) -> FoparqError:
    with pytest.raises(kind) as caught:
        read(path, **limits)
    assert caught.value.fields["file"] == path.name
    assert all(Words(language).error(caught.value) for language in LANGUAGES)
    return caught.value


def listing(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def drop_triggers(connection: sqlite3.Connection) -> None:
    for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall():
        connection.execute(f'DROP TRIGGER "{name}"')


def put(path: Path, wkb: dict[int, bytes], *, kind: str = "GEOMETRY", z: int = 0, table: str = "paredes") -> None:
    """Replace geometries of a GeoPackage by well-known binary that no library would write."""
    with sqlite3.connect(path) as connection:
        drop_triggers(connection)
        for fid, data in wkb.items():
            blob = b"GP\x00\x01" + (31982).to_bytes(4, "little") + data
            connection.execute(f'UPDATE "{table}" SET geom = ? WHERE fid = ?', (blob, fid))  # noqa: S608
        connection.execute("UPDATE gpkg_geometry_columns SET geometry_type_name = ?, z = ?", (kind, z))
    connection.close()
