# SPDX-License-Identifier: MIT
"""How QGIS shows the layers of ``findings.gpkg``: marks, labels, map tips, and names of columns and values."""

import sqlite3
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from foparq.findings.counts import Reading
from foparq.findings.table import Severity
from foparq.model.items import Role
from foparq.report import drawing_gpkg, features_gpkg, sheets_gpkg
from foparq.report.drawing_gpkg import MOST_ITEMS, MOST_VERTICES
from foparq.report.templates import environment
from foparq.report.words import Words

_STYLES_TABLE = """
CREATE TABLE layer_styles (
  id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256), f_table_schema TEXT(256),
  f_table_name TEXT(256), f_geometry_column TEXT(256), styleName TEXT(30), styleQML TEXT, styleSLD TEXT,
  useAsDefault BOOLEAN, description TEXT, owner TEXT(30), ui TEXT(30), update_time DATETIME
)"""


@dataclass(frozen=True, slots=True)
class FlagLayer:
    """A layer of findings of one dimension."""

    name: str
    single: str
    multi: str


#: by dimension
FLAGS = (
    FlagLayer("flags_p", "Point", "MultiPoint"),
    FlagLayer("flags_l", "LineString", "MultiLineString"),
    FlagLayer("flags_a", "Polygon", "MultiPolygon"),
)
RESIDUALS = "residuals"


@dataclass(frozen=True, slots=True)
class Mark:
    """How the features of one value look."""

    value: str
    label: str  #: message id
    colour: str  #: red, green, blue, opacity
    shape: str = ""  #: of a marker
    width: float = 0.0  #: of a line, millimetres
    dashes: str = "solid"


@dataclass(frozen=True, slots=True, kw_only=True)
class Look:
    """How QGIS shows one layer."""

    kind: str  #: ``marker``, ``line``, ``stroke`` (a line without halo), ``fill`` (hatched), ``outline`` or ``frame``
    marks: tuple[Mark, ...]
    by: str  #: expression that the marks are values of
    label: str = ""  #: expression; no labels if left out
    tip: tuple[str, ...] = ()  #: columns of the map tip, the first as its heading


#: red for faults, blue for notes; shapes differ for who sees no colours
_SEVERITIES = tuple(
    Mark(severity.value, f"report.severity.{severity.value}", colour, shape)
    for severity, shape, colour in (
        (Severity.CRITICAL, "diamond", "128,0,0,255"),
        (Severity.MAJOR, "triangle", "200,20,20,255"),
        (Severity.MINOR, "circle", "220,80,20,255"),
        (Severity.NOTE, "square", "30,90,160,255"),
    )
)
_TOLD = ("name", "reason", "layer", "item")
_FLAG = 'represent_value("name")'

_LOOKS = {
    "flags_p": Look(kind="marker", marks=_SEVERITIES, by="severity", label=_FLAG, tip=_TOLD),
    "flags_l": Look(kind="line", marks=_SEVERITIES, by="severity", label=_FLAG, tip=_TOLD),
    "flags_a": Look(kind="fill", marks=_SEVERITIES, by="severity", label=_FLAG, tip=_TOLD),
    RESIDUALS: Look(
        kind="marker",
        by="CASE WHEN \"outlier\" THEN 'outlier' WHEN \"counted\" THEN 'counted' ELSE 'aside' END",
        marks=(
            Mark("counted", "report.standing.counted", "20,110,60,255", "cross2"),
            Mark("outlier", "report.standing.outlier", "200,20,20,255", "cross2"),
            Mark("aside", "report.gpkg.aside", "110,110,110,255", "cross2"),
        ),
        label='"id"',
        tip=("id", "dx", "dy", "dz", "lies", "item"),
    ),
    features_gpkg.LAYER: Look(
        kind="outline",
        by="code",
        marks=(
            Mark(Reading.COUNTED.value, "report.balance.code.counted", "20,110,60,160", "", 0.25),
            Mark(Reading.PART.value, "report.balance.code.part", "190,120,0,200", "", 0.35, "dash"),
            Mark(Reading.COPY.value, "report.balance.code.copy", "130,60,150,200", "", 0.35, "dot"),
        ),
        label='represent_value("class")',
        tip=("class", "facade", "reading", "required", "found", "missing"),
    ),
    drawing_gpkg.LAYER: Look(
        kind="stroke",
        by='CASE WHEN "visible" THEN "role" ELSE \'hidden\' END',
        marks=(
            Mark(Role.LINE.value, "report.gpkg.role.line", "60,60,60,255", "", 0.2),
            Mark(Role.AREA.value, "report.gpkg.role.area", "60,60,60,255", "", 0.2),
            Mark(Role.ANNOTATION.value, "report.gpkg.role.annotation", "150,150,150,255", "", 0.15),
            Mark(Role.HATCH.value, "report.gpkg.role.hatch", "200,200,200,255", "", 0.1),
            Mark(Role.SURFACE.value, "report.gpkg.role.surface", "200,200,200,255", "", 0.1),
            Mark("hidden", "report.gpkg.role.hidden", "210,210,210,255", "", 0.15, "dash"),
        ),
        tip=("layer", "item", "kind", "source"),
    ),
    sheets_gpkg.LAYER: Look(
        kind="frame",
        by="CASE WHEN \"drawn\" < \"items\" THEN 'bounded' ELSE 'whole' END",
        marks=(
            Mark("whole", "report.gpkg.whole", "170,170,170,255", "", 0.2),
            Mark("bounded", "report.gpkg.bounded", "190,120,0,255", "", 0.4, "dash"),
        ),
        label="\"source\" || CASE WHEN \"facade\" <> '' THEN ' · ' || \"facade\" ELSE '' END",
        tip=("source", "facade", "plane", "items", "drawn"),
    ),
}

#: values of columns that are codes: by column, the codes and the message of each
_CODES: dict[str, tuple[Sequence[str], str]] = {
    "severity": (tuple(Severity), "report.severity.{}"),
    "unit": (("m", "m2", "1", "items", "rad"), "report.gpkg.unit.{}"),
    "code": (tuple(Reading), "report.balance.code.{}"),
    "role": (tuple(Role), "report.gpkg.role.{}"),
    "lies": (
        ("vertex", "linework", "surface", "named", "taken-named", "taken-vertex", "taken-surface", "absent", "untold"),
        "report.lies.{}",
    ),
    "plane": (("xy", "xz", "yz", "fit", "given", "assumed"), "report.gpkg.plane.{}"),
}


def add_styles(
    database: sqlite3.Connection,
    language: str,
    layers: Mapping[str, Sequence[str]],
    shown: Mapping[str, Mapping[str, str]],
    moment: str,
) -> None:
    """Store a style for every layer where QGIS looks for it, and say of each what it holds.

    Parameters
    ----------
    database : sqlite3.Connection
        The GeoPackage.
    language : str
        Of labels, names of columns and values.
    layers : dict
        Columns of every layer.
    shown : dict
        By column: words of its values, where these are not words already.
    moment : str
        As GeoPackage writes it.
    """
    words = Words(language)
    template = environment("style").get_template("layer.qml.j2")
    database.execute(_STYLES_TABLE)
    database.execute(
        "INSERT INTO gpkg_contents (table_name, data_type, identifier, last_change) VALUES (?, 'attributes', ?, ?)",
        ("layer_styles", "layer_styles", moment),
    )
    for name, columns in layers.items():
        look = _LOOKS[name]
        named = [
            {"name": column, "alias": words(f"report.column.{column}"), "values": _values(words, column, shown)}
            for column in columns
        ]
        style = template.render(
            look=look,
            marks=[(mark, words(mark.label)) for mark in look.marks],
            columns=named,
            aliases={column["name"]: column["alias"] for column in named},
        )
        told = words(f"report.gpkg.layer.{name}", items=words.count(MOST_ITEMS), vertices=words.count(MOST_VERTICES))
        database.execute("UPDATE gpkg_contents SET description = ? WHERE table_name = ?", (told, name))
        database.execute(
            "INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column, styleName,"
            " styleQML, styleSLD, useAsDefault, description, owner, update_time)"
            " VALUES ('', '', ?, 'geom', 'foparq', ?, '', 1, ?, '', ?)",
            (name, style, told, moment),
        )


def _values(words: Words, column: str, shown: Mapping[str, Mapping[str, str]]) -> list[tuple[str, str]]:
    """Values of a column that are codes, with their words."""
    if column in shown:
        return sorted(shown[column].items())
    codes, message = _CODES.get(column, ((), ""))
    return [(str(code), words(message.format(code))) for code in codes]
