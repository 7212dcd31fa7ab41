# SPDX-License-Identifier: MIT
"""``findings.gpkg``: layers, columns, geometry, reference system and styles, read back by GDAL and SQLite."""

import hashlib
import sqlite3
import xml.etree.ElementTree as ET
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyogrio
import pyproj
import pytest
import shapely
from pyogrio.raw import read

from foparq.findings.table import Findings, join_findings
from foparq.model.drawing import Drawing
from foparq.model.plane import plane_of
from foparq.report import findings_gpkg
from foparq.report.findings_gpkg import write_findings_gpkg
from foparq.report.record import AuditRecord
from foparq.report.sentences import finding_sentences
from foparq.report.words import Words

Plant = Callable[..., Findings]
LAYERS = ("flags_p", "flags_l", "flags_a")
COLUMNS = [
    "reason", "featid", "key", "rule", "name", "severity", "source", "layer", "item", "handle", "inserts", "other",
    "other_layer", "x", "y", "z", "size", "unit", "limit", "message", "waived", "facade",
]  # fmt: skip


def written(record: AuditRecord, folder: Path) -> Path:
    write_findings_gpkg(record, folder / "findings.gpkg")
    return folder / "findings.gpkg"


def layer(path: Path, name: str) -> tuple[dict[str, Any], np.ndarray, dict[str, Any]]:
    meta, _, geometry, columns = read(path, layer=name)
    return dict(zip(meta["fields"], columns, strict=True)), shapely.from_wkb(geometry), meta


def ask(path: Path, question: str) -> list[tuple[Any, ...]]:
    with closing(sqlite3.connect(path)) as database:
        return database.execute(question).fetchall()


def systems(path: Path) -> list[int]:
    return [number for (number,) in ask(path, "SELECT DISTINCT srs_id FROM gpkg_geometry_columns")]


def on_plan(record: AuditRecord, **more: Any) -> AuditRecord:
    """The same record with every drawing in xy."""
    parts = tuple(replace(one, plane=plane_of("xy", one.items.geometry)) for one in record.delivery.drawings)
    return replace(record, delivery=replace(record.delivery, parts=parts), **more)


def test_three_layers_with_the_columns_in_order(rejected: AuditRecord, tmp_path: Path) -> None:
    path = written(rejected, tmp_path)
    for name in LAYERS:
        columns, _, _ = layer(path, name)
        assert list(columns) == COLUMNS


def test_every_finding_is_one_feature_where_it_lies(rejected: AuditRecord, tmp_path: Path) -> None:
    path = written(rejected, tmp_path)
    findings = rejected.findings
    sentences = finding_sentences(Words("pt-BR"), findings, np.arange(len(findings)))
    spots = findings.place
    seen = {}
    for name, dimension in zip(LAYERS, (0, 1, 2), strict=True):
        columns, shapes, _ = layer(path, name)
        for n, key in enumerate(columns["key"]):
            seen[key] = (dimension, shapes[n], {column: values[n] for column, values in columns.items()})
    assert len(seen) == len(findings)
    for n in range(len(findings)):
        dimension, shape, row = seen[findings.key[n]]
        where = findings.where[n]
        if where.is_empty:
            assert (dimension, shape) == (0, None)
            assert np.isnan(row["x"])
        else:
            assert dimension == shapely.get_dimensions(where)
            # The facade stands in xz, in metres: it is seen from the front.
            seen_from_front = shapely.transform(shapely.force_3d(where), lambda c: c[:, [0, 2, 1]], include_z=True)
            assert shapely.equals_exact(shape, shapely.force_2d(seen_from_front), 1e-9)
            assert not shapely.has_z(shape)
            assert np.array_equal([row["x"], row["y"], row["z"]], spots[n], equal_nan=True)
        assert row["reason"] == row["message"] == sentences[n]
        assert row["featid"] == row["item"] == findings.item[n]
        assert row["severity"] == findings.severity[n]
        assert bool(row["waived"]) is False
        assert row["facade"] == ("N" if row["source"] == "fachada.dxf" else "")


def test_an_audit_without_findings_has_all_layers(accepted: AuditRecord, tmp_path: Path) -> None:
    path = written(accepted, tmp_path)
    kinds = dict(pyogrio.list_layers(path))
    assert {name: kinds[name] for name in LAYERS} == {"flags_p": "Point", "flags_l": "LineString", "flags_a": "Polygon"}
    assert [layer(path, name)[2]["fields"].tolist() for name in LAYERS] == [COLUMNS] * 3


def test_mixed_and_multiple_places_stay_one_feature(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, tmp_path: Path
) -> None:
    area, line, point = shapely.box(0, 0, 1, 1), shapely.LineString([(0, 0), (3, 3)]), shapely.Point(9, 9)
    shapes = [
        shapely.GeometryCollection([point, shapely.GeometryCollection([line, area])]),
        shapely.GeometryCollection([point, line]),
        shapely.MultiPoint([(0, 0), (1, 1)]),
        shapely.LinearRing([(0, 0), (1, 0), (1, 1)]),
        shapely.GeometryCollection(),
        shapely.Point(1, 2, 3),
    ]
    findings = plant(drawing, "TOP011", "undershoot", [(str(n), "0", shape, 0.1) for n, shape in enumerate(shapes)])
    path = written(on_plan(rejected, findings=join_findings([findings])), tmp_path)
    found = {}
    for name in LAYERS:
        columns, geometry, meta = layer(path, name)
        found |= {item: (name, shape) for item, shape in zip(columns["item"], geometry, strict=True)}
        assert len({shapely.get_type_id(shape) for shape in geometry if shape is not None}) <= 1, meta
    assert {item: name for item, (name, _) in found.items()} == {
        "0": "flags_a", "1": "flags_l", "2": "flags_p", "3": "flags_l", "4": "flags_p", "5": "flags_p",
    }  # fmt: skip
    assert found["0"][1].normalize().equals(shapely.MultiPolygon([area]))
    assert found["1"][1].equals(line)
    assert found["5"][1].equals(shapely.MultiPoint([(1, 2)]))
    assert found["4"][1] is None


@pytest.mark.parametrize(("crs", "srs"), [("EPSG:31982", 31982), ("", -1), ("local", -1), ("EPSG:99999999", -1)])
def test_reference_system_is_that_of_the_drawing(
    rejected: AuditRecord, drawing: Drawing, crs: str, srs: int, tmp_path: Path
) -> None:
    placed = replace(drawing, reading=replace(drawing.reading, crs=crs))
    facade = replace(rejected, delivery=replace(rejected.delivery, parts=(placed,)))
    assert systems(written(facade, tmp_path)) == [-1]  # an elevation has no place on the map
    assert systems(written(on_plan(facade), tmp_path)) == [srs]


@pytest.mark.parametrize(("metres", "srs"), [(1.0, 31982), (0.001, -1)])
def test_the_manifest_states_the_system_of_a_file_that_has_none(
    rejected: AuditRecord, drawing: Drawing, metres: float, srs: int, tmp_path: Path
) -> None:
    part = replace(drawing, unit=replace(drawing.unit, metres=metres))
    stated = replace(rejected, delivery=replace(rejected.delivery, parts=(part,), crs="EPSG:31982"))
    assert systems(written(on_plan(stated), tmp_path)) == [srs]


def test_a_system_that_is_called_like_a_file_opens_none(
    rejected: AuditRecord, drawing: Drawing, tmp_path: Path
) -> None:
    """GDAL takes names of files and addresses for systems; a delivery names its system as it likes."""
    (tmp_path / "system.wkt").write_text(pyproj.CRS.from_epsg(31982).to_wkt("WKT1_GDAL"), encoding="utf-8")
    named = replace(drawing, reading=replace(drawing.reading, crs=str(tmp_path / "system.wkt")))
    delivery = replace(rejected.delivery, parts=(named,), crs="EPSG:31982")
    assert systems(written(on_plan(replace(rejected, delivery=delivery)), tmp_path)) == [-1]


def test_drawings_that_differ_in_reference_system_share_none(
    rejected: AuditRecord, drawing: Drawing, tmp_path: Path
) -> None:
    drawings = tuple(
        replace(drawing, path=f"{n}.dxf", reading=replace(drawing.reading, crs=crs))
        for n, crs in enumerate(("EPSG:31982", "EPSG:31983"))
    )
    plan = on_plan(replace(rejected, delivery=replace(rejected.delivery, parts=drawings)))
    assert systems(written(plan, tmp_path)) == [-1]


def test_it_is_geopackage_1_3_of_the_moment_of_the_audit(rejected: AuditRecord, tmp_path: Path) -> None:
    path = written(rejected, tmp_path)
    assert ask(path, "PRAGMA user_version") == [(10300,)]
    assert ask(path, "PRAGMA integrity_check") == [("ok",)]
    assert ask(path, "SELECT DISTINCT last_change FROM gpkg_contents") == [("2026-03-09T14:05:00.000Z",)]


def test_the_same_audit_gives_the_same_bytes(rejected: AuditRecord, tmp_path: Path) -> None:
    first = written(rejected, tmp_path).read_bytes()
    second = written(rejected, tmp_path).read_bytes()
    assert len(first) == len(second)
    assert [n for n, pair in enumerate(zip(first, second, strict=True)) if pair[0] != pair[1]] == []


def test_the_bytes_do_not_tell_how_many_transactions_it_took(
    rejected: AuditRecord, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = written(rejected, tmp_path).read_bytes()
    layers = findings_gpkg._write_layers

    def in_more_transactions(path: Path, *rest: Any) -> None:
        layers(path, *rest)
        with closing(sqlite3.connect(path)) as database:
            for moment in ("2001-01-01T00:00:00.000Z", "2002-02-02T00:00:00.000Z"):
                database.execute("UPDATE gpkg_contents SET last_change = ?", (moment,))
                database.commit()

    monkeypatch.setattr(findings_gpkg, "_write_layers", in_more_transactions)
    assert hashlib.sha256(written(rejected, tmp_path).read_bytes()).digest() == hashlib.sha256(first).digest()


def test_findings_are_written_up_to_the_bound_of_the_profile(rejected: AuditRecord, tmp_path: Path) -> None:
    path = written(replace(rejected, written=2), tmp_path)
    rules = [rule for name in LAYERS for rule in layer(path, name)[0]["rule"]]
    assert all(
        rules.count(rule) == min(2, int(np.sum(rejected.findings.rule == rule))) for rule in set(rejected.findings.rule)
    )


@pytest.mark.parametrize(("language", "label"), [("pt-BR", "grave"), ("en", "major")])
def test_every_layer_of_findings_has_a_style_for_every_severity(
    rejected: AuditRecord, tmp_path: Path, language: str, label: str
) -> None:
    path = written(replace(rejected, language=language), tmp_path)
    styles = dict(ask(path, "SELECT f_table_name, styleQML FROM layer_styles WHERE useAsDefault = 1"))
    for number, name in enumerate(LAYERS):
        style = styles[name]
        root = ET.fromstring(style)
        categories = root.findall("renderer-v2/categories/category")
        assert [part.get("value") for part in categories] == ["critical", "major", "minor", "note"]
        assert categories[1].get("label") == label
        symbols = {part.get("name"): part for part in root.findall("renderer-v2/symbols/symbol")}
        assert {part.get("symbol") for part in categories} == set(symbols)
        assert root.findtext("layerGeometryType") == str(number)
        assert root.find("labeling/settings/text-style").get("fieldName") == 'represent_value("name")'
        assert [part.get("field") for part in root.findall("aliases/alias")] == COLUMNS


def test_hostile_names_are_values(rejected: AuditRecord, hostile: str, tmp_path: Path) -> None:
    path = written(rejected, tmp_path)
    columns, _, _ = layer(path, "flags_p")
    assert hostile in columns["layer"]
    assert all(hostile not in style for (style,) in ask(path, "SELECT styleQML FROM layer_styles"))
