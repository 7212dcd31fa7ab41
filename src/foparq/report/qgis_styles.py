# SPDX-License-Identifier: MIT
"""How QGIS shows the findings: layers by dimension, marks by severity, names of columns."""

import sqlite3
from collections.abc import Sequence
from dataclasses import dataclass

from foparq.findings.table import Severity
from foparq.report.templates import environment
from foparq.report.words import Words

#: severity, shape of its mark in QGIS and colour: red for faults, blue for notes
_MARKS = (
    (Severity.CRITICAL, "diamond", "128,0,0,255"),
    (Severity.MAJOR, "triangle", "200,20,20,255"),
    (Severity.MINOR, "circle", "220,80,20,255"),
    (Severity.NOTE, "square", "30,90,160,255"),
)

_STYLES_TABLE = """
CREATE TABLE layer_styles (
  id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256), f_table_schema TEXT(256),
  f_table_name TEXT(256), f_geometry_column TEXT(256), styleName TEXT(30), styleQML TEXT, styleSLD TEXT,
  useAsDefault BOOLEAN, description TEXT, owner TEXT(30), ui TEXT(30), update_time DATETIME
)"""


@dataclass(frozen=True, slots=True)
class FlagLayer:
    """A layer of findings of one dimension, and how QGIS shows it."""

    name: str
    single: str
    multi: str
    symbol: str  #: QGIS symbol type
    placement: int  #: of labels: around the point, along the line, over the area
    geometry_type: int  #: QGIS geometry type


#: by dimension
LAYERS = (
    FlagLayer("flags_p", "Point", "MultiPoint", "marker", 0, 0),
    FlagLayer("flags_l", "LineString", "MultiLineString", "line", 2, 1),
    FlagLayer("flags_a", "Polygon", "MultiPolygon", "fill", 1, 2),
)


def add_styles(database: sqlite3.Connection, language: str, columns: Sequence[str], moment: str) -> None:
    """Store a style for every layer where QGIS looks for it.

    Parameters
    ----------
    database : sqlite3.Connection
        The GeoPackage.
    language : str
        Of labels and names of columns.
    columns : sequence of str
        Of every layer.
    moment : str
        As GeoPackage writes it.
    """
    words = Words(language)
    template = environment("style").get_template("flags.qml.j2")
    marks = [
        {
            "severity": severity.value,
            "label": words(f"report.severity.{severity.value}"),
            "shape": shape,
            "colour": colour,
        }
        for severity, shape, colour in _MARKS
    ]
    named = [{"name": name, "alias": words(f"report.column.{name}")} for name in columns]
    database.execute(_STYLES_TABLE)
    database.execute(
        "INSERT INTO gpkg_contents (table_name, data_type, identifier, last_change) VALUES (?, 'attributes', ?, ?)",
        ("layer_styles", "layer_styles", moment),
    )
    for layer in LAYERS:
        style = template.render(
            marks=marks,
            kind=layer.symbol,
            columns=named,
            placement=layer.placement,
            geometry_type=layer.geometry_type,
        )
        database.execute(
            "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, styleName,"
            " styleQML, styleSLD, useAsDefault, description, owner, update_time)"
            " VALUES ('', '', ?, 'geom', 'foparq', ?, '', 1, ?, '', ?)",
            (layer.name, style, words("report.gpkg.style"), moment),
        )
