# SPDX-License-Identifier: MIT
"""GeoPackage: plain tables of features, one by one."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from pyogrio.errors import GeometryError

from foparq.errors import ManifestError, UnreadableError
from foparq.model.drawing import Skipped, SkippedReason
from foparq.names import folded, nearest
from foparq.profile.schema import LimitsSpec
from foparq.read.gis.crs import unit_of
from foparq.read.gis.gpkg_curves import STRAIGHT, chords_of
from foparq.read.gis.gpkg_safety import Contents, Table, inspect
from foparq.read.gis.items import LayerRows, Piece, items_of
from foparq.read.gis.layers import GDAL_ERRORS, Taken, first_line, hold, read_layer
from foparq.read.guard.stage import staged

_INSPECTION = 30.0  #: seconds to look at the register, far more than any honest one needs
#: GDAL names its placeholder for "no table of features at all" so
_PLACEHOLDER = "ogr_empty_table"
_NOWHERE = (np.nan, np.nan, np.nan, np.nan)


def read_gpkg(path: Path, *, limits: LimitsSpec, sagitta: float, unit: str | None, wanted: tuple[str, ...]) -> Taken:
    """Tables of features of a GeoPackage.

    Parameters
    ----------
    path : Path
        A file that starts as SQLite files do.
    limits : LimitsSpec
        Features, vertices and seconds.
    sagitta : float, metres
        Greatest distance between an arc and its chords.
    unit : str or None
        Unit as stated by the user.
    wanted : tuple of str
        Tables to read, in any case of letters; all if empty.

    Returns
    -------
    Taken
        Tables in the order of their names, rows in the order of their ids.

    Raises
    ------
    UnreadableError
        If the file is broken, or holds no table of features.
    UnsafeError
        If it holds more than the limits allow, or its register is a program.
    ManifestError
        If a table is wanted that is not there.
    """
    contents = inspect(path, seconds=min(_INSPECTION, limits.seconds))
    tables = _wanted(path, contents, wanted)
    hold(path, "read.too-many-items", sum(table.rows for table in tables), limits.entities)
    asked = {table.name for table in tables}
    skipped = list(contents.skipped)
    skipped += [
        Skipped(reason=SkippedReason.NOT_ASKED, kind=table.geometry_type, layer=table.name, count=table.rows)
        for table in contents.tables
        if table.name not in asked and table.name != _PLACEHOLDER
    ]
    pieces: list[Piece] = []
    # With its prefix, GDAL opens a GeoPackage as such or not at all.
    with staged({"drawing.gpkg": path}) as link:
        name = f"GPKG:{link}"
        for table in tables:
            if table.rows == 0:
                continue
            layer = _layer(path, name, table)
            if layer is None:
                skipped.append(_unsupported(table))
                continue
            # The handles of a single drawing need no name of a table before them.
            prefix = "" if layer.cad is not None and len(tables) == 1 else f"{table.name}:"
            piece = items_of(_straight(path, table, layer, limits, sagitta, unit), prefix=prefix)
            pieces.append(piece)
            skipped += piece.skipped
    return Taken(
        pieces=tuple(pieces), version=contents.version, encoding="UTF-8", skipped=tuple(skipped), layers=contents.layers
    )  # fmt: skip


def _unsupported(table: Table) -> Skipped:
    return Skipped(reason=SkippedReason.UNSUPPORTED_LAYER, kind=table.geometry_type, layer=table.name, count=table.rows)


def _layer(path: Path, name: str, table: Table) -> LayerRows | None:
    # None if the table is declared of a type that is no simple feature.
    try:
        layer = read_layer(name, table.name, table.rows, undefined=table.undefined_crs)
    except GeometryError:
        return None
    except GDAL_ERRORS as error:
        raise UnreadableError("read.gpkg-broken", file=path.name, value=first_line(error)) from None
    if len(layer.fid) != table.rows:
        raise UnreadableError(
            "read.rows-lost", file=path.name, key=table.name, value=len(layer.fid), example=table.rows
        )
    return layer


def _straight(
    path: Path, table: Table, layer: LayerRows, limits: LimitsSpec, sagitta: float, unit: str | None
) -> LayerRows:
    if table.geometry_type in STRAIGHT:
        return layer
    metres = unit_of((layer.system,), _NOWHERE, unit).metres
    in_units = None if metres is None else sagitta / metres
    chords = chords_of(path, table, sagitta=in_units, vertices=limits.vertices, seconds=limits.seconds)
    if not chords:
        return layer
    wkb = layer.wkb.copy()
    row = {fid: number for number, fid in enumerate(layer.fid.tolist())}
    for fid, straight in chords.items():
        if fid in row:
            wkb[row[fid]] = straight
    return replace(layer, wkb=wkb)


def _wanted(path: Path, contents: Contents, wanted: tuple[str, ...]) -> list[Table]:
    readable = [table for table in contents.tables if table.name != _PLACEHOLDER]
    several = [record for record in contents.skipped if record.reason is SkippedReason.SEVERAL_GEOMETRIES]
    if not readable and several:
        example = several[0].name.split(", ")[0]
        raise UnreadableError(
            "read.gpkg-several-geometries", file=path.name, key=several[0].layer, value=several[0].name, example=example
        )
    if not readable:
        found = ", ".join(f"{record.layer} ({record.reason})" for record in contents.skipped) or "-"
        raise UnreadableError("read.gpkg-no-features", file=path.name, value=found)
    if not wanted:
        return readable
    # Two tables may differ in nothing but the composition of an accent.
    by_name: dict[str, list[Table]] = {}
    for table in readable:
        by_name.setdefault(folded(table.name), []).append(table)
    for name in wanted:
        if folded(name) not in by_name:
            near = nearest(name, [table.name for table in readable])
            known = ", ".join(near)
            raise ManifestError(
                "manifest.layer-unknown",
                file=path.name,
                value=name,
                known=known,
                example=f'layers = ["{near[0]}"]',
            )
    return [table for key in sorted({folded(name) for name in wanted}) for table in by_name[key]]
