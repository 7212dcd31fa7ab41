# SPDX-License-Identifier: MIT
"""Small sound drawings and deliveries, as bytes, from which the fuzz makes its mutants."""

import contextlib
import io
import json
import logging
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import ezdxf
import numpy as np
import pyogrio
import pyogrio.raw
import shapely

from foparq.resources import shipped

METRES = 6  #: code of ``$INSUNITS``
SYSTEM = "EPSG:31982"
_EAST, _NORTH = 500_000.0, 7_500_000.0
_DATE = "2014-03-12T12:00:00.000Z"


@dataclass(frozen=True, slots=True)
class Seed:
    """Files of one input."""

    name: str
    files: dict[str, bytes]
    main: str  #: the file to check; of a delivery, the drawing
    command: str = "check"


# --- DXF --------------------------------------------------------------------------------------------------------------


def _facade(layout: ezdxf.layouts.BaseLayout, *, modern: bool) -> None:
    """Linework without a fault: three gables, an arched window, a clock."""
    for left in (0.0, 2.0, 4.0):
        corners = [(left, 0, 0), (left + 1, 0, 0), (left + 1, 1, 0)]
        for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
            layout.add_line(start, end, dxfattribs={"layer": "PAREDE"})
    window = {"layer": "ESQUADRIA_JANELA"}
    layout.add_line((0, 3), (0, 4), dxfattribs=window)
    layout.add_line((0, 3), (1, 3), dxfattribs=window)
    layout.add_line((1, 3), (1, 4), dxfattribs=window)
    layout.add_arc((0.5, 4), 0.5, 0, 180, dxfattribs=window)
    layout.add_circle((3, 4), 0.4, dxfattribs={"layer": "RELÓGIO"})
    layout.add_polyline3d([(5, 3, 0), (6, 3, 0), (6, 4, 0.5), (5, 4, 0)], close=True, dxfattribs={"layer": "CIMALHA"})
    layout.add_polyline2d(
        [(7, 3, 0, 0, 0.2), (8, 3, 0, 0, 0), (8, 4, 0, 0, 0)], format="xyseb", close=True,
        dxfattribs={"layer": "ORNAMENTO"},
    )  # fmt: skip
    layout.add_text("FACHADA N", height=0.2, dxfattribs={"layer": "TEXTO"}).set_placement((0, 6))
    layout.add_point((1, 6), dxfattribs={"layer": "TEXTO"})
    if modern:
        ring = [(9, 3, 0, 0, 0), (10, 3, 0, 0, 0.5), (10, 4, 0, 0, 0), (9, 4, 0, 0, 0)]
        layout.add_lwpolyline(ring, close=True, dxfattribs={"layer": "ORNAMENTO"})
        layout.add_ellipse((12, 4), (1, 0), 0.5, dxfattribs={"layer": "ORNAMENTO"})
        layout.add_mtext("Casa da estação", dxfattribs={"layer": "TEXTO", "char_height": 0.2, "insert": (4, 6)})


def _blocks(document: ezdxf.document.Drawing) -> None:
    door = document.blocks.new("PORTA")
    for start, end in (((0, 0), (1, 0)), ((1, 0), (1, 2)), ((1, 2), (0, 2)), ((0, 2), (0, 0))):
        door.add_line(start, end, dxfattribs={"layer": "0"})
    pair = document.blocks.new("PAR")
    pair.add_blockref("PORTA", (0, 0))
    pair.add_blockref("PORTA", (2.5, 0), dxfattribs={"xscale": -1.0, "yscale": 2.0})
    model = document.modelspace()
    model.add_blockref("PORTA", (14, 0), dxfattribs={"layer": "ESQUADRIA_PORTA", "rotation": 30.0})
    model.add_blockref("PAR", (18, 0), dxfattribs={"layer": "ESQUADRIA_PORTA"})
    rows = {"layer": "ESQUADRIA_PORTA", "row_count": 2, "column_count": 3, "row_spacing": 3.0, "column_spacing": 2.0}
    model.add_blockref("PORTA", (24, 0), dxfattribs=rows)


def _rich(document: ezdxf.document.Drawing) -> None:
    """What is lettering, filling, a surface, or drawn by curves of higher order."""
    model = document.modelspace()
    model.add_spline([(14, 5), (15, 6), (16, 5), (17, 8)], dxfattribs={"layer": "ORNAMENTO"})
    hatch = model.add_hatch(dxfattribs={"layer": "HACHURA"})
    hatch.paths.add_polyline_path([(0, 8), (1, 8), (1, 9), (0, 9)], is_closed=True)
    edges = hatch.paths.add_edge_path()
    edges.add_line((2, 8), (3, 8))
    edges.add_arc((2.5, 8), 0.5, 0, 180)
    model.add_solid([(4, 8), (5, 8), (4, 9), (5, 9)], dxfattribs={"layer": "HACHURA"})
    model.add_3dface([(6, 8, 0), (7, 8, 0), (7, 9, 1), (6, 9, 1)], dxfattribs={"layer": "COBERTURA"})
    model.add_linear_dim(base=(0, -1), p1=(0, 0), p2=(1, 0), dxfattribs={"layer": "COTA"}).render()
    model.add_leader([(0, 10), (1, 11), (2, 11)], dxfattribs={"layer": "COTA"})
    model.add_ray((0, 20), (1, 0))
    insert = model.add_blockref("PORTA", (30, 0), dxfattribs={"layer": "ESQUADRIA_PORTA"})
    insert.add_attrib("NOME", "P1", (30, 1))
    sheet = document.layout("Layout1")
    sheet.add_line((0, 0), (200, 0), dxfattribs={"layer": "FOLHA"})


def dxf_text(version: str, *, blocks: bool = False, rich: bool = False) -> bytes:
    """Drawing in the text form, in metres."""
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = METRES
    document.layers.add("PAREDE", color=7)
    document.layers.add("RELÓGIO", color=2)
    if blocks or rich:
        _blocks(document)
    if rich:
        _rich(document)
    _facade(document.modelspace(), modern=version != "R12")
    # The library keeps the types in a set: registered here in order, they do not change places from run to run.
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    stream = io.StringIO()
    document.write(stream)
    return bytes(document.encode(stream.getvalue()))


# --- GeoPackage, Shapefile, GeoJSON -----------------------------------------------------------------------------------

_LINES = [
    "LINESTRING (0 0, 1 0)", "LINESTRING (1 0, 1 1)", "LINESTRING (1 1, 0 0)", "LINESTRING (2 0, 3 0, 3 1, 2 1, 2 0)",
    "LINESTRING (4 0, 5 0, 5 1, 4 0)", "LINESTRING (6 0, 7 0, 7 1, 6 0)",
]  # fmt: skip
_SPATIAL = ["LINESTRING Z (0 3 0, 1 3 0, 1 4 0.5, 0 3 0)", "LINESTRING Z (2 3 1, 3 3 1, 3 4 1, 2 3 1)"]
_AREAS = [
    "POLYGON ((0 6, 1 6, 1 7, 0 7, 0 6))", "POLYGON ((1 6, 2 6, 2 7, 1 7, 1 6))",
    "POLYGON ((2 6, 6 6, 6 10, 2 10, 2 6), (3 7, 3 8, 4 8, 4 7, 3 7))",
    "MULTIPOLYGON (((7 6, 8 6, 8 7, 7 7, 7 6)), ((9 6, 10 6, 10 7, 9 7, 9 6)))",
]  # fmt: skip


def _wkb(texts: list[str]) -> np.ndarray:
    """Shapes of a town, east and north."""
    shapes = shapely.from_wkt(texts)
    place, row = shapely.get_coordinates(shapes, include_z=True, return_index=True)
    moved = place + np.array([_EAST, _NORTH, 0.0])
    made = [
        shapely.set_coordinates(np.array([shape]), moved[row == n] if shape.has_z else moved[row == n, :2])[0]
        for n, shape in enumerate(shapes)
    ]
    return np.array([shapely.to_wkb(shape, flavor="iso") for shape in made], dtype=object)


def _write(path: Path, texts: list[str], kind: str, *, driver: str, layer: str, **options: object) -> None:
    names = np.array([("PAREDE", "JANELA", "RELÓGIO")[n % 3] for n in range(len(texts))], dtype=object)
    columns = {"layer": names, "cota": np.arange(len(texts), dtype=float)}
    pyogrio.raw.write(
        path, _wkb(texts), list(columns.values()), list(columns), geometry_type=kind, driver=driver, crs=SYSTEM,
        layer=layer, promote_to_multi=False, **options,
    )  # fmt: skip


@contextlib.contextmanager
def _settings() -> Iterator[None]:
    wanted = {"OGR_CURRENT_DATE": _DATE, "OGR_SQLITE_PRAGMA": "page_size=1024"}
    before = {name: pyogrio.get_gdal_config_option(name) for name in wanted}
    pyogrio.set_gdal_config_options(wanted)
    try:
        yield
    finally:
        pyogrio.set_gdal_config_options(before)


def _files_of(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def gpkg(*, index: bool) -> dict[str, bytes]:
    """GeoPackage with lines, lines in space and areas."""
    with tempfile.TemporaryDirectory() as name, _settings():
        path = Path(name) / "a.gpkg"
        indexed = {"SPATIAL_INDEX": "YES" if index else "NO"}
        for layer, texts, kind in (
            ("paredes", _LINES, "LineString"),
            ("cimalhas", _SPATIAL, "LineString Z"),
            ("pisos", _AREAS, "Unknown"),
        ):
            _write(path, texts, kind, driver="GPKG", layer=layer, append=path.exists(), layer_options=indexed)
        return _files_of(Path(name))


def shapefile(texts: list[str], kind: str) -> dict[str, bytes]:
    """Shapefile with its companions."""
    with tempfile.TemporaryDirectory() as name, _settings():
        _write(Path(name) / "a.shp", texts, kind, driver="ESRI Shapefile", layer="a", encoding="UTF-8")
        return _files_of(Path(name))


def geojson() -> dict[str, bytes]:
    """GeoJSON with lines and areas."""
    shapes = shapely.from_wkb(_wkb([*_LINES, *_SPATIAL, *_AREAS]))
    features = [
        {
            "type": "Feature",
            "properties": {"layer": ("PAREDE", "RELÓGIO")[n % 2], "cota": n},
            "geometry": json.loads(shapely.to_geojson(shape)),
        }
        for n, shape in enumerate(shapes)
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::31982"}}
    whole = {"type": "FeatureCollection", "crs": crs, "features": features}
    return {"a.geojson": json.dumps(whole, ensure_ascii=False).encode()}


# --- deliveries -------------------------------------------------------------------------------------------------------

MANIFEST = """\
[delivery]
title = "Estação de prova"
profile = "{profile}"
scale = "1:50"
crs = "local"
language = "pt-BR"

[[drawing]]
path = "a.dxf"
unit = "m"
plane = "xy"
facade = "N"
areas = ["CIMALHA"]

[drawing.classes]
"ESQUADRIA_JANELA" = "window"
"RELÓGIO" = "clock"
"ORNA*" = "ornament"
"CIMALHA" = "cornice"
"PAREDE" = "wall"
"TEXTO" = "lettering"

[features]
path = "feicoes.csv"

[checkpoints]
path = "pontos.csv"
survey_sd = "3 mm"
unit = "m"

[distances]
path = "distancias.csv"
survey_sd = "3 mm"
"""
_FEATURES = """\
id,class,facade,count,use,omission_accepted,evidence
JAN-N-01,window,N,1,required,,
REL-N-01,clock,N,1,required,,
ORN-N-01,ornament,N,1,required,,
CIM-N-01,cornice,N,1,required,,
PAR-N-01,wall,N,3,required,,
TEX-N-01,lettering,N,1,optional,,
JAN-N-02,window,N,1,optional,OCCL,IMG_0412.jpg
"""
_OFFSETS = (0.002, -0.003, 0.001, -0.001, 0.003, -0.002, 0.002, -0.001, 0.0, -0.001)
_CORNERS = ((0, 0), (1, 0), (1, 1), (2, 0), (3, 0), (3, 1), (4, 0), (5, 0), (5, 1), (0, 3))


def _tables() -> dict[str, bytes]:
    points, distances = ["id,x,y,z,xd,yd,zd"], ["id,from,to,measured,delivered"]
    for n, ((x, y), off) in enumerate(zip(_CORNERS, _OFFSETS, strict=True), start=1):
        points.append(f"P{n:02},{x + off:.4f},{y - off:.4f},{off / 2:.4f},{x:.4f},{y:.4f},0.0000")
        distances.append(f"D{n:02},P{n:02},P{n % 10 + 1:02},{n + off:.4f},{n:.4f}")
    return {
        "feicoes.csv": _FEATURES.encode(),
        "pontos.csv": "\n".join([*points, ""]).encode(),
        "distancias.csv": "\n".join([*distances, ""]).encode(),
    }


def _delivery(name: str, *, profile: str = "et-doc-foparq-a", **more: bytes) -> Seed:
    files = {"a.dxf": dxf_text("R12"), **_tables(), **{key.replace("_", "."): value for key, value in more.items()}}
    files["delivery.toml"] = MANIFEST.format(profile=profile).encode()
    return Seed(name, files, "a.dxf", "audit")


def _own_profile() -> bytes:
    shipped_one = (shipped("rules") / "profiles" / "et-doc-foparq-a.toml").read_text(encoding="utf-8")
    return shipped_one.replace('name = "et-doc-foparq-a"', 'name = "contrato"').encode()


_EXTENDING = b"""\
extends = "et-doc-foparq-a"
name = "contrato"
product_class = "A"

[title]
pt-BR = "Contrato"
en = "Contract"

[[check]]
rule = "undershoot"
severity = "critical"
layers = ["PAREDE*", "ESQUADRIA*"]
coincide = "0.02 mm @ scale"
reach = "0.3 mm @ scale"

[[element]]
id = "Q3"
kind = "faulty-rate"
required = true
limit = "5 %"
rules = ["invalid-geometry", "undershoot", "overshoot"]

[limits]
entities = 100000
"""


def _of(name: str, data: bytes) -> Seed:
    return Seed(name, {"a.dxf": data}, "a.dxf")


def _dxf(version: str) -> list[Seed]:
    made = [_of("plain", dxf_text(version)), _of("blocks", dxf_text(version, blocks=True))]
    return made if version == "R12" else [*made, _of("rich", dxf_text(version, rich=True))]


def _gis() -> list[Seed]:
    return [
        Seed("lines", shapefile(_LINES, "LineString"), "a.shp"),
        Seed("space", shapefile(_SPATIAL, "LineString Z"), "a.shp"),
        Seed("areas", shapefile(_AREAS, "Polygon"), "a.shp"),
    ]


_MAKERS: dict[str, Callable[[], list[Seed]]] = {
    "dxf-r12": lambda: _dxf("R12"),
    "dxf-r2000": lambda: _dxf("R2000"),
    "dxf-r2018": lambda: _dxf("R2018"),
    "dxf-binary": lambda: _dxf("R2000"),
    "gpkg": lambda: [Seed("plain", gpkg(index=False), "a.gpkg"), Seed("indexed", gpkg(index=True), "a.gpkg")],
    "shapefile": _gis,
    "geojson": lambda: [Seed("plain", geojson(), "a.geojson")],
    "tables": lambda: [_delivery("plain")],
    "manifest": lambda: [_delivery("plain")],
    "profile": lambda: [
        _delivery("whole", profile="perfil.toml", perfil_toml=_own_profile()),
        _delivery("extending", profile="perfil.toml", perfil_toml=_EXTENDING),
    ],
}
KINDS = tuple(_MAKERS)


@cache
def seeds(kind: str) -> tuple[Seed, ...]:
    """Seeds of a kind, the same bytes in every run."""
    logger = logging.getLogger("ezdxf")
    before = ezdxf.options.write_fixed_meta_data_for_testing, logger.disabled
    ezdxf.options.write_fixed_meta_data_for_testing, logger.disabled = True, True
    try:
        return tuple(_MAKERS[kind]())
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing, logger.disabled = before
