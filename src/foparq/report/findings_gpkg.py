# SPDX-License-Identifier: MIT
"""``findings.gpkg``: the findings as points, lines and areas over the linework, in its plane, styled for QGIS."""

import errno
import shutil
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pyogrio.errors
import pyogrio.raw
import shapely
from numpy.typing import NDArray

from foparq.columns import Geometries, Index, Texts
from foparq.read.guard.stage import private_folder
from foparq.report.drawing_gpkg import drawing_layer
from foparq.report.features_gpkg import features_layer
from foparq.report.qgis_styles import FLAGS, RESIDUALS, FlagLayer, add_styles
from foparq.report.record import AuditRecord
from foparq.report.residuals import PointResidual, point_residuals
from foparq.report.rows import written_rows
from foparq.report.sentences import class_word, finding_sentences
from foparq.report.sheets_gpkg import UNDEFINED, Layout, layout_of, sheets_layer
from foparq.report.words import Words, printable

_DIMENSION_OF_TYPE = np.array([0, 1, 1, 2, 0, 1, 2], dtype=np.intp)  # by shapely type id, collections apart


def write_findings_gpkg(record: AuditRecord, path: Path) -> None:
    """Write ``findings.gpkg``.

    Parameters
    ----------
    path : Path
        Replaced if it exists.

    Notes
    -----
    Every layer is two-dimensional, as :class:`~foparq.report.sheets_gpkg.Layout` says: on the file where that lies in
    xy, else in the plane of each drawing. The columns ``x``, ``y``, ``z`` hold the place in the coordinates of the
    file. One finding is one feature: a place of several parts is a multi-geometry, and of a mixed place the parts of
    highest dimension are written. A finding without a place stands in ``flags_p`` without geometry. At most
    ``record.written`` findings of each rule are written. The layer ``residuals`` holds the checkpoints with their
    differences in metres, delivered minus surveyed; ``features_a`` what was counted as features; ``desenho_l`` the
    linework, ``desenho_a`` the frame of each drawing.
    """
    # GDAL takes no path with line breaks or undecodable letters: the file is made where the path is plain.
    with private_folder() as plain:
        made = plain / "findings.gpkg"
        try:
            _write_database(record, plain / "layers.gpkg")
            _copy_of_content(plain / "layers.gpkg", made)
        except (pyogrio.errors.DataSourceError, pyogrio.errors.DataLayerError, sqlite3.Error) as error:
            raise OSError(errno.EIO, str(error), str(path)) from error
        shutil.copyfile(made, path)


def _write_database(record: AuditRecord, path: Path) -> None:
    rows, layout = written_rows(record), layout_of(record)
    findings = record.findings
    shapes, dimension = _by_dimension(layout.shown(findings.source[rows], findings.where[rows], findings.sheet[rows]))
    columns = _columns(record, rows, layout)
    layers = []
    for n, layer in enumerate(FLAGS):
        chosen = dimension == n
        own = {name: column[chosen] for name, column in columns.items()}
        layers.append((layer.name, *_of_one_type(shapes[chosen], layer), own))
    if points := point_residuals(record):
        layers.append(_residual_layer(record, points, layout))
    if len(record.quality.found):
        layers.append(features_layer(record, layout))
    linework, drawn = drawing_layer(record, layout)
    layers += [linework, sheets_layer(layout, drawn)]
    try:
        _write_layers(path, layers, layout.crs)
    except (pyogrio.errors.CRSError, UnicodeError):
        # The file names a system that GDAL does not know.
        path.unlink(missing_ok=True)
        _write_layers(path, layers, UNDEFINED)
    with closing(sqlite3.connect(path)) as database:
        names = {name: list(own) for name, _, _, own in layers}
        add_styles(database, record.language, names, _shown_values(record, rows), _moment(record))
        # The moment of the audit, not of writing: the same audit gives the same file.
        database.execute("UPDATE gpkg_contents SET last_change = ?", (_moment(record),))
        database.commit()


def _copy_of_content(database: Path, path: Path) -> None:
    """Write a database anew: the bytes depend on what it holds, not on how many transactions brought it there.

    ``VACUUM`` keeps the change counter of the header (SQLite file format, 1.3.7); ``VACUUM INTO`` starts it again.
    """
    with closing(sqlite3.connect(database)) as source:
        source.execute("VACUUM INTO ?", (str(path),))


def _residual_layer(
    record: AuditRecord, points: Sequence[PointResidual], layout: Layout
) -> tuple[str, Geometries, str, dict[str, NDArray[Any]]]:
    """Checkpoints where they were delivered, with their differences."""
    metres = {drawing.path: drawing.unit.metres or 1.0 for drawing in record.delivery.drawings}
    first = next(iter(metres.values()), 1.0)
    places = np.array([point.place or (np.nan,) * 3 for point in points])
    file = places / np.array([metres.get(point.drawing, first) for point in points])[:, np.newaxis]
    shapes = np.full(len(points), None, dtype=object)
    placed = np.isfinite(file).all(axis=1)
    source = np.array([point.drawing for point in points], dtype=object)
    for n in np.flatnonzero(placed):
        shapes[n] = shapely.points(*layout.flat(source[n], file[n : n + 1]).T)[0]
    deltas = np.array([point.difference for point in points], dtype=float)
    texts = {name: _texts(np.array([getattr(point, name) for point in points], dtype=object)) for name in _TIED}
    columns: dict[str, NDArray[Any]] = {
        "id": texts["id"],
        **{name: deltas[:, axis] for axis, name in enumerate(("dx", "dy", "dz"))},
        "counted": np.array([point.counted for point in points]),
        "outlier": np.array([point.outlier for point in points]),
        **{name: texts[name] for name in _TIED[1:]},
        **{name: file[:, axis] for axis, name in enumerate("xyz")},
        "facade": layout.facades(source),
    }
    return RESIDUALS, shapes, "Point", columns


def _shown_values(record: AuditRecord, rows: Index) -> dict[str, dict[str, str]]:
    """Names of rules and classes of features in words of the language."""
    words, table = Words(record.language), record.findings
    named = dict(zip(table.name[rows].tolist(), table.rule[rows].tolist(), strict=True))
    classes = {str(name) for name in record.quality.found.feature_class}
    return {
        "name": {name: words(f"rules.{code}.title") for name, code in named.items()},
        "class": {printable(name): class_word(words, name) for name in classes},
    }


_TIED = ("id", "lies", "drawing", "item", "layer")


def _columns(record: AuditRecord, rows: Index, layout: Layout) -> dict[str, NDArray[Any]]:
    words = Words(record.language)
    findings = record.findings
    spots = findings.place[rows]
    sentences = np.array(finding_sentences(words, findings, rows), dtype=object)
    return {
        "reason": sentences,
        "featid": _texts(findings.item[rows]),
        **{name: _texts(getattr(findings, name)[rows]) for name in _TEXT_COLUMNS},
        "x": spots[:, 0],
        "y": spots[:, 1],
        "z": spots[:, 2],
        "size": findings.size[rows].astype(float),
        "unit": _texts(findings.unit[rows]),
        "limit": findings.limit[rows].astype(float),
        "message": sentences,
        "waived": findings.waived[rows].astype(bool),
        "facade": layout.facades(findings.source[rows]),
    }


_TEXT_COLUMNS = (
    "key", "rule", "name", "severity", "source", "layer", "item", "handle", "inserts", "other", "other_layer",
)  # fmt: skip


def _texts(column: Texts) -> Texts:
    texts = np.empty(len(column), dtype=object)
    texts[:] = [printable(str(value)) for value in column]
    return texts


def _by_dimension(geometry: Geometries) -> tuple[Geometries, Index]:
    """Geometries without empties and collections, and the dimension of each: 0, 1 or 2."""
    shapes = geometry.copy()
    shapes[shapely.is_empty(shapes)] = None
    for n in np.flatnonzero(shapely.get_type_id(shapes) == _COLLECTION):
        shapes[n] = _highest(shapes[n])
    kind = shapely.get_type_id(shapes)
    for n in np.flatnonzero(kind == _RING):
        shapes[n] = shapely.linestrings(shapely.get_coordinates(shapes[n]))
    return shapes, np.where(kind < 0, 0, _DIMENSION_OF_TYPE[kind])


_RING, _COLLECTION = 2, 7


def _highest(collection: shapely.Geometry) -> shapely.Geometry | None:
    parts = shapely.get_parts([collection])
    while np.any(shapely.get_type_id(parts) >= 4):  # noqa: PLR2004 - multi-geometries and collections
        parts = shapely.get_parts(parts)
    parts = parts[~shapely.is_empty(parts)]
    if not len(parts):
        return None
    dimension = shapely.get_dimensions(parts)
    best = parts[dimension == dimension.max()]
    return (shapely.multipoints, shapely.multilinestrings, shapely.multipolygons)[dimension.max()](best)


def _of_one_type(shapes: Geometries, layer: FlagLayer) -> tuple[Geometries, str]:
    """Geometries all single or all multi, and the name of that type."""
    many = bool((shapely.get_type_id(shapes) >= 4).any())  # noqa: PLR2004 - multi-geometries
    result = shapes.copy()
    if many:
        gather = {
            "Point": shapely.multipoints,
            "LineString": shapely.multilinestrings,
            "Polygon": shapely.multipolygons,
        }[layer.single]
        for n, shape in enumerate(shapes):
            if shape is not None and shapely.get_type_id(shape) < 4:  # noqa: PLR2004
                result[n] = gather([shape])
    return result, layer.multi if many else layer.single


def _write_layers(path: Path, layers: Sequence[tuple[str, Geometries, str, dict[str, NDArray[Any]]]], crs: str) -> None:
    for name, geometry, geometry_type, columns in layers:
        pyogrio.raw.write(
            path,
            shapely.to_wkb(geometry, output_dimension=2),
            list(columns.values()),
            list(columns),
            layer=name,
            driver="GPKG",
            geometry_type=geometry_type,
            crs=crs,
            append=path.exists(),
            # Later versions of the format are only partly understood by the QGIS of Debian 12.
            dataset_options=None if path.exists() else {"VERSION": "1.3"},
            layer_options={"FID": "fid", "GEOMETRY_NAME": "geom", "SPATIAL_INDEX": "YES"},
        )


def _moment(record: AuditRecord) -> str:
    """Time of the audit as GeoPackage writes it."""
    return (record.started[:19] or "1970-01-01T00:00:00") + ".000Z"
