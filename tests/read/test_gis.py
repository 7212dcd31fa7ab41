# SPDX-License-Identifier: MIT
"""GeoPackage, Shapefile and GeoJSON as items: natural files and odd ones."""

import sqlite3
import struct
import warnings
from collections import Counter
from contextlib import closing
from pathlib import Path

import numpy as np
import pyogrio.raw
import pytest
import shapely
from tests.read.gis_files import drop_triggers, listing, read, refused, write

from foparq.errors import ManifestError, UnsafeError
from foparq.model.drawing import UnitOrigin


def test_parts_become_items(tmp_path: Path) -> None:
    path = write(
        tmp_path / "a.gpkg",
        [
            "LINESTRING (0 0, 1 0)",
            "MULTILINESTRING ((0 0, 1 1), (2 2, 3 3, 2 2))",
            "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 0), (5 1, 6 1, 6 2, 5 1)))",
            "GEOMETRYCOLLECTION (POINT (1 2), MULTIPOINT ((3 4), (5 6)), LINESTRING (0 0, 0 1))",
            "MULTILINESTRING EMPTY",
            None,
        ],
    )
    items = read(path).items
    parts = ["1", "2.1", "2.2", "3", "4.1", "4.2", "4.3", "4.4", "5", "6"]
    assert items.item.tolist() == [f"paredes:{part}" for part in parts]
    assert items.handle.tolist() == ["1", "2", "2", "3", "4", "4", "4", "4", "5", "6"]
    kinds = ["LineString", "LineString", "LineString", "Polygon", "Point", "LineString", "Point", "Point", "LineString"]
    assert items.kind[:9].tolist() == kinds
    assert items.role[:9].tolist() == ["line", "line", "line", "area", "point", "line", "point", "point", "line"]
    assert items.closed.tolist() == [False, False, True, True, False, False, False, False, False, False]
    assert set(items.layer) == {"paredes"}
    assert items.geometry[9] is None
    assert shapely.is_empty(items.geometry[8])
    assert len(shapely.get_rings(items.geometry[3])) == 2
    assert items.visible.all()
    assert not items.paper.any()


@pytest.mark.parametrize(
    ("kind", "role"), [("Point", "point"), ("LineString", "line"), ("MultiPolygon", "area"), ("Polygon Z", "area")]
)
def test_a_row_without_geometry_has_the_role_of_its_layer(tmp_path: Path, kind: str, role: str) -> None:
    items = read(write(tmp_path / "a.gpkg", [None], kind=kind)).items
    assert (items.geometry.tolist(), items.role.tolist()) == ([None], [role])


def test_heights_are_kept_and_measures_dropped(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    measured = struct.pack("<BII", 1, 3002, 2) + struct.pack("<8d", 0, 0, 5, 99, 1, 0, 6, 98)
    geometry = np.array([measured], dtype=object)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pyogrio.raw.write(
            path, geometry, [], [], geometry_type="LineString Z", driver="GPKG", layer="a", crs="EPSG:31982"
        )
    shape = read(path).items.geometry[0]
    assert shapely.get_coordinates(shape, include_z=True).tolist() == [[0, 0, 5], [1, 0, 6]]
    assert not shapely.has_m(shape)


def test_a_layer_column_names_the_layer(tmp_path: Path) -> None:
    path = write(
        tmp_path / "a.gpkg",
        ["POINT (0 0)", "POINT (1 0)", "POINT (2 0)"],
        layer="entities",
        Layer=["Vãos_Ç", "", None],
        PaperSpace=["1", None, "0"],
    )
    items = read(path).items
    assert items.layer.tolist() == ["Vãos_Ç", "entities", "entities"]
    assert items.paper.tolist() == [True, False, False]
    assert items.visible.tolist() == [False, True, True]


def test_nothing_is_repaired(tmp_path: Path) -> None:
    bow_tie = "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"
    spike = "LINESTRING (0 0, 1 0, 1 0, 0 0)"
    items = read(write(tmp_path / "a.gpkg", [bow_tie, spike])).items
    assert shapely.to_wkt(items.geometry).tolist() == [bow_tie, spike]


def test_features_that_cannot_be_built_stay_as_rows_without_geometry(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POLYGON ((0 0, 1 0, 1 1, 0 0))"] * 2, kind="Polygon")
    open_ring = struct.pack("<BIII", 1, 3, 1, 3) + struct.pack("<6d", 0, 0, 1, 0, 1, 1)
    with sqlite3.connect(path) as connection:
        drop_triggers(connection)
        header = b"GP\x00\x01" + struct.pack("<i", 31982)
        connection.execute("UPDATE paredes SET geom = ? WHERE fid = 2", (header + open_ring,))
    connection.close()
    items = read(path).items
    assert items.item.tolist() == ["paredes:1", "paredes:2"]
    assert items.geometry[1] is None
    assert items.kind[1] == "Polygon"


def test_surfaces_are_skipped_and_counted(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)", "POINT (1 1)", "POINT (2 2)"])
    face = struct.pack("<BIII", 1, 1003, 1, 4) + struct.pack("<12d", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0)
    surface = struct.pack("<BII", 1, 1015, 1) + face
    with sqlite3.connect(path) as connection:
        drop_triggers(connection)
        connection.execute(
            "UPDATE paredes SET geom = ? WHERE fid > 1", (b"GP\x00\x01" + struct.pack("<i", 31982) + surface,)
        )
    connection.close()
    drawing = read(path)
    assert drawing.items.item.tolist() == ["paredes:1"]
    (skipped,) = drawing.reading.skipped
    assert (skipped.reason, skipped.kind, skipped.count, skipped.handles) == (
        "unsupported-geometry",
        "PolyhedralSurface",
        2,
        ("2", "3"),
    )


def test_only_the_tables_asked_for(tmp_path: Path) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)"], layer="um")
    write(path, ["POINT (0 0)", "POINT (1 1)"], layer="dois", append=True)
    drawing = read(path, layers=("DOIS",))
    assert set(drawing.items.layer) == {"dois"}
    assert [(record.reason, record.layer, record.count) for record in drawing.reading.skipped] == [
        ("not-asked", "um", 1)
    ]
    assert drawing.reading.layers == ("dois", "um")
    with pytest.raises(ManifestError) as caught:
        read(path, layers=("tres",))
    assert caught.value.fields["known"] == "dois, um"


@pytest.mark.parametrize(
    "name", ["com espaço.gpkg", "a!b.gpkg", "x.zip.gpkg", 'a"b.gpkg', "um:dois.gpkg", "a?b#c%20d.gpkg"]
)
def test_odd_names_of_files(tmp_path: Path, name: str) -> None:
    plain = write(tmp_path / "plain.gpkg", ["POINT (0 0)"])
    assert len(read(plain.rename(tmp_path / name)).items) == 1


@pytest.mark.parametrize("name", ['a"b', "a'b", "select", "1; DROP TABLE x", "Vãos Ç"])
def test_odd_names_of_tables(tmp_path: Path, name: str) -> None:
    path = write(tmp_path / "a.gpkg", ["POINT (0 0)", "POINT (1 1)"], layer=name)
    assert read(path).items.item.tolist() == [f"{name}:1", f"{name}:2"]


def test_a_shapefile(tmp_path: Path) -> None:
    path = write(
        tmp_path / "eixos.shp",
        ["LINESTRING (0 0, 1 0)", "LINESTRING (2 2, 3 3)"],
        kind="LineString",
        camada=["Vão", None],
    )
    before = listing(tmp_path)
    drawing = read(path)
    assert drawing.items.item.tolist() == ["0", "1"]
    assert drawing.items.layer.tolist() == ["Vão", "eixos"]
    assert (drawing.unit.metres, drawing.reading.encoding, drawing.reading.version) == (1.0, "UTF-8", "ESRI Shapefile")
    assert listing(tmp_path) == before


def test_a_shapefile_without_prj_has_no_unit(tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", ["POINT (0 0)"], kind="Point")
    (tmp_path / "a.prj").unlink()
    assert read(path).unit.origin is UnitOrigin.UNKNOWN


def test_a_shapefile_in_another_encoding(tmp_path: Path) -> None:
    path = tmp_path / "a.shp"
    geometry = shapely.to_wkb(shapely.points([[0, 0]]))
    name = np.array(["Vãos"], dtype=object)
    pyogrio.raw.write(
        path,
        geometry,
        [name],
        ["layer"],
        geometry_type="Point",
        driver="ESRI Shapefile",
        encoding="cp1252",
        crs="EPSG:31982",
    )
    drawing = read(path)
    assert drawing.items.layer.tolist() == ["Vãos"]


@pytest.mark.parametrize("ending", [".dbf", ".shx"])
def test_a_shapefile_without_its_companions_is_refused(tmp_path: Path, ending: str) -> None:
    path = write(tmp_path / "a.shp", ["POINT (0 0)"], kind="Point")
    (tmp_path / f"a{ending}").unlink()
    error = refused(path)
    assert (error.message, error.fields["value"], error.fields["example"]) == (
        "read.shp-incomplete",
        ending,
        f"a{ending}",
    )


@pytest.mark.parametrize("ending", [".shp", ".shx", ".dbf"])
@pytest.mark.parametrize("kept", [0.05, 0.3, 0.98])
def test_a_truncated_shapefile_is_refused(tmp_path: Path, ending: str, kept: float) -> None:
    path = write(tmp_path / "a.shp", [f"LINESTRING (0 {n}, 1 {n})" for n in range(50)], kind="LineString")
    whole = path.with_suffix(ending).read_bytes()
    path.with_suffix(ending).write_bytes(whole[: int(len(whole) * kept)])
    assert refused(path).message in ("read.gis-broken", "read.shp-mismatch", "read.unknown-format")


def test_a_shapefile_whose_index_is_of_another_day_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.shp", [f"POINT (0 {n})" for n in range(50)], kind="Point")
    (tmp_path / "old").mkdir()
    old = write(tmp_path / "old/a.shp", [f"POINT (0 {n})" for n in range(40)], kind="Point")
    path.with_suffix(".shx").write_bytes(old.with_suffix(".shx").read_bytes())
    error = refused(path)
    assert (error.message, error.fields["value"], error.fields["other"]) == ("read.shp-mismatch", 40, 50)


def test_a_companion_that_leads_elsewhere_is_refused(tmp_path: Path) -> None:
    (tmp_path / "entrega").mkdir()
    path = write(tmp_path / "entrega/a.shp", ["POINT (0 0)"], kind="Point")
    path.with_suffix(".dbf").rename(tmp_path / "a.dbf")
    path.with_suffix(".dbf").symlink_to(tmp_path / "a.dbf")
    with pytest.raises(UnsafeError) as caught:
        read(path)
    assert (caught.value.message, caught.value.fields["key"]) == ("read.companion-outside", "a.dbf")


def test_a_geojson(tmp_path: Path) -> None:
    path = write(tmp_path / "a.geojson", ["LINESTRING Z (0 0 1, 1 0 2)", None], crs="EPSG:31982", Layer=["Muro", None])
    drawing = read(path)
    assert drawing.items.item.tolist() == ["0", "1"]
    assert drawing.items.layer.tolist() == ["Muro", "a"]
    assert drawing.items.geometry[1] is None
    assert shapely.has_z(drawing.items.geometry[0])
    assert drawing.unit.metres == 1.0


@pytest.mark.parametrize(
    "text",
    [
        "{",
        '{"type": "FeatureCollection", "features": [{"type": "Feature"',
        '{"a": 1}',
        '{"type": "Topology", "objects": {}, "arcs": []}',
        '{"geometryType": "esriGeometryPoint", "features": [], "fields": []}',
        '{"type": "FeatureCollection", "features": ' + "[" * 100_000,
    ],
    ids=["brace", "cut", "other", "topojson", "esrijson", "deep"],
)
def test_json_that_is_no_geojson_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.geojson"
    path.write_text(text, encoding="utf-8")
    assert refused(path).message == "read.gis-broken"


NASTY = {
    "first_geometry_null.gpkg": (3, 1),
    "huge_feature_count.gpkg": (1, 0),
    "null_geometry.gpkg": (5, 3),
    "poly_non_conformant.gpkg": (1, 0),
    "possibly_invalid_snap.gpkg": (5, 0),
    "v12_bad_attributes.gpkg": (2, 1),
}


@pytest.mark.shared
@pytest.mark.parametrize("name", sorted(NASTY))
def test_nasty_geopackages_are_read(shared: Path, name: str) -> None:
    items = read(shared / "data/drawings/nasty_gpkg" / name).items
    assert (len(items), int(shapely.is_missing(items.geometry).sum())) == NASTY[name]


@pytest.mark.shared
@pytest.mark.parametrize("name", ["empty.gpkg", "uint16.gpkg"])
def test_geopackages_without_vectors_are_refused(shared: Path, name: str) -> None:
    assert refused(shared / "data/drawings/nasty_gpkg" / name).message == "read.gpkg-no-features"


@pytest.mark.shared
def test_layers_of_every_type_are_read_one_by_one(shared: Path) -> None:
    drawing = read(shared / "data/drawings/nasty_gpkg/gdal_sample_v1.2_no_extensions.gpkg")
    assert len(set(drawing.items.layer)) == 15
    reasons = Counter(record.reason for record in drawing.reading.skipped)
    assert reasons == {"attributes": 1, "raster": 2, "unsupported-layer": 1}
    assert [record.layer for record in drawing.reading.skipped if record.reason == "unsupported-layer"] == [
        "geometry3d"
    ]
    assert drawing.unit.origin is UnitOrigin.UNKNOWN


@pytest.mark.shared
def test_sewers(shared: Path) -> None:
    drawing = read(shared / "data/drawings/nasty_gpkg/simple_sewer_features.gpkg")
    assert Counter(drawing.items.layer) == {"foul_sewer": 82, "surface_water_sewer": 21, "s_manhole": 69}
    assert (drawing.unit.metres, drawing.reading.crs) == (1.0, "EPSG:27700")


@pytest.mark.shared
def test_bubenec(shared: Path) -> None:
    drawing = read(shared / "data/drawings/bubenec/bubenec.gpkg")
    items = drawing.items
    assert Counter(items.layer) == {"buildings": 144, "plots": 407, "tessellation": 144, "streets": 35}
    assert set(items.role[items.layer == "streets"]) == {"line"}
    assert set(items.role[items.layer != "streets"]) == {"area"}
    assert drawing.unit.stretch == pytest.approx(1.56, abs=0.005)
    plots = items.geometry[items.layer == "plots"]
    assert shapely.is_valid(plots).all()
    # 84 gaps below 1 m2 and three larger holes, counted independently.
    assert shapely.get_num_interior_rings(shapely.get_parts(shapely.union_all(plots))).sum() == 87


@pytest.mark.parametrize(("number", "said"), [(0, "GPKG"), (10200, "GPKG 1.2"), (10300, "GPKG 1.3")])
def test_the_version_of_a_package_is_that_which_it_states(tmp_path: Path, number: int, said: str) -> None:
    path = write(tmp_path / "a.gpkg", ["LINESTRING (0 0, 1 0)"])
    with closing(sqlite3.connect(path)) as connection:
        connection.execute(f"PRAGMA user_version = {number}")
    assert read(path).reading.version == said
