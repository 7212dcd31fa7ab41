# SPDX-License-Identifier: MIT
"""A delivery as a whole: every file accounted for, nothing outside opened, nothing written."""

import hashlib
import os
import shutil
import sqlite3
import threading
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import ezdxf
import numpy as np
import pyogrio.raw
import pytest
import shapely

from foparq.errors import ManifestError, UnsafeError
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.profile.manifest import Manifest
from foparq.profile.schema import LimitsSpec, Profile, ReadingSpec
from foparq.read.delivery import read_delivery, read_loose
from foparq.read.guard import paths
from foparq.read.guard.paths import inside
from foparq.report.words import LANGUAGES, Words

pytestmark = pytest.mark.usefixtures("alone")
POINTS = "id;x;y;z;xd;yd;zd\nP1;1,0000;2,0000;3,0000;1,0020;2,0010;3,0000\n"


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """No thread of another test decides how the child is started: a fresh one would not know what is patched here."""
    monkeypatch.setattr(threading, "active_count", lambda: 1)


def profile(**limits: int) -> Profile:
    return Profile(
        name="t", title={"en": "t"}, product_class="A", reading=ReadingSpec(sagitta="0.02 mm @ scale"), checks=(),
        limits=LimitsSpec(**limits),
    )  # fmt: skip


def geopackage(path: Path, wkt: tuple[str, ...] = ("LINESTRING (0 0, 1 0)",), layer: str = "paredes") -> Path:
    geometry = shapely.to_wkb(shapely.from_wkt(list(wkt)))
    pyogrio.raw.write(path, geometry, [], [], geometry_type="Unknown", driver="GPKG", layer=layer, crs="EPSG:31982")
    return path


def drawing(path: Path) -> Path:
    document = ezdxf.new("R2018", units=6)
    document.modelspace().add_line((0, 0, 0), (3, 0, 4))
    document.modelspace().add_circle((0, 0, 0), 1)
    document.saveas(path)
    return path


def station(folder: Path) -> Manifest:
    drawing(folder / "fachada.dxf")
    geopackage(folder / "planta.gpkg")
    (folder / "pontos.csv").write_text(POINTS, encoding="utf-8")
    (folder / "distancias.csv").write_text("id,measured,delivered\nD1,1.250,1.252\n", encoding="utf-8")
    (folder / "feicoes.csv").write_text("id,class\nJAN-1,window\nPOR-1,door\n", encoding="utf-8")
    (folder / "delivery.toml").write_text("# manifest", encoding="utf-8")
    facade = {"path": "fachada.dxf", "plane": "xz", "facade": "N", "classes": {"0": "window"}, "areas": ["P*"]}
    return manifest(
        drawing=[facade, {"path": "planta.gpkg"}],
        checkpoints={"path": "pontos.csv", "survey_sd": "3 mm"},
        distances={"path": "distancias.csv"},
        features={"path": "feicoes.csv"},
    )  # fmt: skip


def manifest(**sections: object) -> Manifest:
    return Manifest.model_validate({"delivery": {"title": "Estação"}, **sections})


def take(folder: Path, stated: Manifest, name: str = "", **limits: int) -> Delivery:
    delivered, crashes = read_delivery(folder, stated, name, profile=profile(**limits), scale=50)
    assert crashes == ()
    for source in delivered.sources:
        if source.error:
            assert all(Words(language)(f"errors.{source.error}", **dict(source.fields)) for language in LANGUAGES)
    return delivered


def only(delivered: Delivery) -> Source:
    (source,) = delivered.sources
    return source


def listing(folder: Path) -> dict[str, tuple[str, int]]:
    return {
        str(path.relative_to(folder)): (hashlib.sha256(path.read_bytes()).hexdigest(), path.stat().st_mtime_ns)
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_everything_named_is_read(tmp_path: Path) -> None:
    told: list[str] = []
    stated = station(tmp_path)
    delivered, crashes = read_delivery(
        tmp_path, stated, "delivery.toml", profile=profile(), scale=50, progress=told.append
    )
    assert crashes == ()
    assert [(source.path, source.role, source.status.value, source.items) for source in delivered.sources] == [
        ("delivery.toml", "manifest", "read", 1),
        ("fachada.dxf", "drawing", "read", 2),
        ("planta.gpkg", "drawing", "read", 1),
        ("pontos.csv", "checkpoints", "read", 1),
        ("distancias.csv", "distances", "read", 1),
        ("feicoes.csv", "features", "read", 2),
    ]
    for source in delivered.sources:
        data = (tmp_path / source.path).read_bytes()
        assert (source.sha256, source.bytes) == (hashlib.sha256(data).hexdigest(), len(data))
    assert told == ["fachada.dxf", "planta.gpkg", "pontos.csv", "distancias.csv", "feicoes.csv"]
    facade, plan = delivered.drawings
    assert (facade.path, facade.facade, facade.classes, facade.areas) == ("fachada.dxf", "N", {"0": "window"}, ("P*",))
    assert (facade.plane.name, plan.plane.name) == ("xz", "assumed")
    assert (facade.unit.metres, plan.unit.metres) == (1.0, 1.0)
    assert delivered.title == "Estação"
    assert delivered.checkpoints is not None
    assert delivered.checkpoints.survey_sd == 0.003
    assert delivered.distances is not None
    assert delivered.features is not None


def test_reading_leaves_no_trace(tmp_path: Path) -> None:
    stated = station(tmp_path)
    connection = sqlite3.connect(tmp_path / "planta.gpkg")
    connection.execute("PRAGMA journal_mode=WAL")
    connection.close()
    before = listing(tmp_path)
    for path in tmp_path.iterdir():
        path.chmod(0o444)
    tmp_path.chmod(0o555)
    try:
        delivered = take(tmp_path, stated, "delivery.toml")
    finally:
        tmp_path.chmod(0o755)
    assert {source.status for source in delivered.sources} == {SourceStatus.READ}
    assert listing(tmp_path) == before


def test_a_curve_is_flattened_with_the_sagitta_of_the_profile(tmp_path: Path) -> None:
    drawing(tmp_path / "a.dxf")
    circle = take(tmp_path, manifest(drawing=[{"path": "a.dxf"}])).drawings[0].items.geometry[1]
    points = shapely.get_coordinates(circle)
    middles = (points[1:] + points[:-1]) / 2
    sagitta = 1 - np.hypot(*middles.T)
    assert sagitta.max() <= 0.001 + 1e-12
    # Coarser at a larger scale: the chords follow the scale.
    coarse, _ = read_delivery(tmp_path, manifest(drawing=[{"path": "a.dxf"}]), "", profile=profile(), scale=500)
    assert shapely.get_num_coordinates(coarse.drawings[0].items.geometry[1]) < len(points)


def test_what_is_absent_is_missing(tmp_path: Path) -> None:
    delivered = take(tmp_path, manifest(drawing=[{"path": "a.dxf"}], checkpoints={"path": "b.csv"}))
    assert [(source.path, source.role, source.status, source.error) for source in delivered.sources] == [
        ("a.dxf", "drawing", SourceStatus.MISSING, "read.missing"),
        ("b.csv", "checkpoints", SourceStatus.MISSING, "read.missing"),
    ]
    assert delivered.drawings == ()
    assert delivered.checkpoints is None


def test_files_that_nobody_named(tmp_path: Path) -> None:
    geopackage(tmp_path / "planta.gpkg")
    pyogrio.raw.write(
        tmp_path / "eixos.shp", shapely.to_wkb(shapely.points([[0, 0]])), [], [], geometry_type="Point",
        driver="ESRI Shapefile", crs="EPSG:31982",
    )  # fmt: skip
    for name in (
        "fotos/b.jpg",
        "fotos/a.jpg",
        "audit/report.html",
        ".git/config",
        ".hidden",
        "outra/audit/x",
        "leia-me.txt",
        "solto.dbf",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(b"123")
    (tmp_path / "anel").symlink_to(tmp_path, target_is_directory=True)
    delivered = take(tmp_path, manifest(drawing=[{"path": "./planta.gpkg"}, {"path": "eixos.shp"}]))
    read = [source.path for source in delivered.sources if source.status is SourceStatus.READ]
    unnamed = [(source.path, source.bytes) for source in delivered.sources if source.status is SourceStatus.UNNAMED]
    assert read == ["planta.gpkg", "eixos.shp", "eixos.cpg", "eixos.dbf", "eixos.prj", "eixos.shx"]
    assert unnamed == [
        ("anel", 0),
        ("leia-me.txt", 3),
        ("solto.dbf", 3),
        ("fotos/a.jpg", 3),
        ("fotos/b.jpg", 3),
        ("outra/audit/x", 3),
    ]


def test_the_list_of_files_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number in range(12):
        (tmp_path / f"{number:02}.jpg").touch()
    monkeypatch.setattr(paths, "MOST_FILES", 10)
    monkeypatch.setattr("foparq.read.intake.MOST_FILES", 10)
    delivered = take(tmp_path, manifest())
    assert [source.status for source in delivered.sources[:10]] == [SourceStatus.UNNAMED] * 10
    assert (delivered.sources[10].error, len(delivered.sources)) == ("read.too-many-files", 11)


@pytest.mark.parametrize(
    ("named", "message"),
    [
        ("../outside.dxf", "read.path-outside"),
        ("a/../../outside.dxf", "read.path-outside"),
        ("..\\outside.dxf", "read.path-outside"),
        ("link.dxf", "read.path-outside"),
        ("folder/outside.dxf", "read.path-outside"),
        ("/etc/passwd", "read.path-absolute"),
        ("C:/x.dxf", "read.path-address"),
        ("\\\\server\\share\\x.dxf", "read.path-absolute"),
        ("/vsicurl/http://example.org/x.gpkg", "read.path-address"),
        ("/vsizip/x.zip/x.shp", "read.path-address"),
        ("http://example.org/x.gpkg", "read.path-address"),
        ("file:///etc/passwd", "read.path-address"),
        ("GPKG:x.gpkg", "read.path-address"),
        ("PG:dbname=x", "read.path-address"),
        ("<OGRVRTDataSource/>", "read.path-address"),
        ("", "read.path-odd"),
        ("a\0b.dxf", "read.path-odd"),
        ("a\nb.dxf", "read.path-odd"),
    ],
)
def test_paths_that_lead_elsewhere_are_refused(tmp_path: Path, named: str, message: str) -> None:
    drawing(tmp_path / "outside.dxf")
    root = tmp_path / "entrega"
    root.mkdir()
    (root / "link.dxf").symlink_to(tmp_path / "outside.dxf")
    (root / "folder").symlink_to(tmp_path, target_is_directory=True)
    with pytest.raises(UnsafeError) as caught:
        inside(root, named)
    assert caught.value.message == message
    for section in ({"drawing": [{"path": named}]}, {"checkpoints": {"path": named}}):
        delivered = take(root, manifest(**section))
        assert (delivered.sources[0].status, delivered.sources[0].error) == (SourceStatus.REFUSED, message)
        assert delivered.sources[0].sha256 == ""
        assert delivered.drawings == ()


def test_links_within_the_delivery_are_followed(tmp_path: Path) -> None:
    geopackage(tmp_path / "planta.gpkg")
    (tmp_path / "atual.gpkg").symlink_to("planta.gpkg")
    delivered = take(tmp_path, manifest(drawing=[{"path": "atual.gpkg"}]))
    assert [(source.path, source.status.value) for source in delivered.sources] == [("atual.gpkg", "read")]


def test_a_ring_of_links_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.dxf").symlink_to("b.dxf")
    (tmp_path / "b.dxf").symlink_to("a.dxf")
    first = take(tmp_path, manifest(drawing=[{"path": "a.dxf"}])).sources[0]
    assert first.status in (SourceStatus.REFUSED, SourceStatus.MISSING)


def test_a_folder_and_a_pipe_are_no_files(tmp_path: Path) -> None:
    (tmp_path / "a.dxf").mkdir()
    os.mkfifo(tmp_path / "b.csv")
    delivered = take(tmp_path, manifest(drawing=[{"path": "a.dxf"}], checkpoints={"path": "b.csv"}))
    assert [source.error for source in delivered.sources] == ["read.not-a-file"] * 2


def test_bad_files_are_refused_and_the_rest_is_read(tmp_path: Path) -> None:
    station(tmp_path)
    (tmp_path / "a.gpkg").write_bytes(b"PK\x03\x04zip")
    (tmp_path / "b.dxf").write_text("a letter", encoding="utf-8")
    (tmp_path / "c.csv").write_text("id,x,y,z\nP1,1,2\n", encoding="utf-8")
    stated = manifest(
        drawing=[{"path": name} for name in ("a.gpkg", "b.dxf", "planta.gpkg")], checkpoints={"path": "c.csv"}
    )
    delivered = take(tmp_path, stated)
    found = {source.path: (source.status.value, source.error) for source in delivered.sources if source.role != "other"}
    assert found == {
        "a.gpkg": ("refused", "read.archive"),
        "b.dxf": ("refused", "read.unknown-format"),
        "planta.gpkg": ("read", ""),
        "c.csv": ("refused", "table.ragged"),
    }
    table = next(source for source in delivered.sources if source.path == "c.csv")
    assert dict(table.fields) == {"file": "c.csv", "line": 2, "key": ",", "value": 3, "example": 4}
    assert len(table.sha256) == 64


def test_the_extension_decides_nothing(tmp_path: Path) -> None:
    drawing(tmp_path / "a.dxf").rename(tmp_path / "a.gpkg")
    geopackage(tmp_path / "b.gpkg").rename(tmp_path / "b.dxf")
    delivered = take(tmp_path, manifest(drawing=[{"path": "a.gpkg"}, {"path": "b.dxf"}]))
    assert [source.items for source in delivered.sources] == [2, 1]


def test_a_file_beyond_the_limit_is_not_read(tmp_path: Path) -> None:
    size = geopackage(tmp_path / "a.gpkg").stat().st_size
    source = only(take(tmp_path, manifest(drawing=[{"path": "a.gpkg"}]), bytes=size - 1))
    assert (source.error, dict(source.fields)["limit"]) == ("read.too-large", size - 1)
    assert only(take(tmp_path, manifest(drawing=[{"path": "a.gpkg"}]), bytes=size)).status is SourceStatus.READ


def endless(*_: object, **__: object) -> NoReturn:
    while True:
        pass


def crashing(*_: object, **__: object) -> NoReturn:
    message = "our own mistake"
    raise ZeroDivisionError(message)


def test_a_reader_without_end_is_a_refused_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    geopackage(tmp_path / "a.gpkg")
    monkeypatch.setattr("foparq.read.gis.reader.read_gis", endless)
    source = only(take(tmp_path, manifest(drawing=[{"path": "a.gpkg"}]), seconds=1))
    assert (source.status, source.error, dict(source.fields)["seconds"]) == (SourceStatus.REFUSED, "read.too-slow", 1)


@pytest.mark.parametrize(("reader", "error"), [(endless, "read.too-slow"), (crashing, "read.crashed")])
def test_tables_are_read_within_bounds_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reader: Callable[..., None], error: str
) -> None:
    (tmp_path / "p.csv").write_text(POINTS, encoding="utf-8")
    roles = ("checkpoints", "distances", "features")
    stated = manifest(**{role: {"path": "p.csv"} for role in roles})
    monkeypatch.setattr("foparq.read.table.tables.read_text", reader)
    delivered, crashes = read_delivery(tmp_path, stated, "", profile=profile(seconds=1), scale=50)
    told = {source.role: source.error for source in delivered.sources}
    assert told == dict.fromkeys(roles, error)
    assert len(crashes) == (3 if reader is crashing else 0)
    assert (delivered.checkpoints, delivered.distances, delivered.features) == (None, None, None)


def test_a_crash_of_a_reader_is_told_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    geopackage(tmp_path / "a.gpkg")
    drawing(tmp_path / "b.dxf")
    monkeypatch.setattr("foparq.read.gis.reader.read_gis", crashing)
    stated = manifest(drawing=[{"path": "a.gpkg"}, {"path": "b.dxf"}])
    delivered, crashes = read_delivery(tmp_path, stated, "", profile=profile(), scale=50)
    assert [(source.status.value, source.error) for source in delivered.sources] == [
        ("refused", "read.crashed"),
        ("read", ""),
    ]
    (crash,) = crashes
    assert crash.startswith("a.gpkg\n")
    assert "ZeroDivisionError: our own mistake" in crash


def test_a_manifest_that_asks_for_what_is_not_there_is_wrong(tmp_path: Path) -> None:
    geopackage(tmp_path / "a.gpkg")
    with pytest.raises(ManifestError) as caught:
        take(tmp_path, manifest(drawing=[{"path": "a.gpkg", "layers": ["janelas"]}]))
    assert (caught.value.message, caught.value.fields["file"]) == ("manifest.layer-unknown", "a.gpkg")
    with pytest.raises(ManifestError) as caught:
        take(tmp_path, manifest(drawing=[{"path": "a.gpkg", "plane": "fit"}]))
    assert (caught.value.message, caught.value.fields["file"]) == ("manifest.plane-fit", "a.gpkg")


def test_the_plane_is_fitted_to_what_is_drawn(tmp_path: Path) -> None:
    # A facade at 30 degrees; a stray point far away and out of the plane.
    across = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
    corners = [k * across + [0, 0, h] for k, h in ((0, 0), (8, 0), (8, 5), (0, 5), (0, 0))]
    outline = shapely.to_wkt(shapely.linestrings(np.array(corners)), rounding_precision=15)
    geopackage(tmp_path / "a.gpkg", (outline, "POINT Z (50 -70 900)"))
    (fitted,) = take(tmp_path, manifest(drawing=[{"path": "a.gpkg", "plane": "fit"}])).drawings
    np.testing.assert_allclose(fitted.plane.up, [0, 0, 1], atol=1e-9)
    np.testing.assert_allclose(fitted.plane.right, across, atol=1e-9)


def test_loose_files_are_named_as_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawing(tmp_path / "a.dxf")
    geopackage(tmp_path / "b.gpkg")
    monkeypatch.chdir(tmp_path)
    given = [Path("a.dxf"), tmp_path / "b.gpkg", Path("c.dxf")]
    delivered, crashes = read_loose(given, profile=profile(), scale=50, unit="mm", plane="xz", areas=("A*",))
    assert crashes == ()
    assert [(source.path, source.status.value) for source in delivered.sources] == [
        ("a.dxf", "read"),
        ((tmp_path / "b.gpkg").as_posix(), "read"),
        ("c.dxf", "missing"),
    ]
    assert {drawn.unit.metres for drawn in delivered.drawings} == {0.001}
    assert {drawn.plane.name for drawn in delivered.drawings} == {"xz"}
    assert {drawn.areas for drawn in delivered.drawings} == {("A*",)}
    assert delivered.title == ""


def test_the_same_delivery_twice_is_the_same(tmp_path: Path) -> None:
    stated = station(tmp_path)
    one, two = (take(tmp_path, stated, "delivery.toml") for _ in range(2))
    assert one.sources == two.sources
    for first, second in zip(one.drawings, two.drawings, strict=True):
        assert first.items.item.tolist() == second.items.item.tolist()
        assert shapely.equals_identical(first.items.geometry, second.items.geometry).all()


@pytest.mark.shared
@pytest.mark.parametrize("folder", ["nasty_gpkg", "nasty_dxf"])
def test_nasty_files_end_in_a_state(shared: Path, folder: str) -> None:
    files = [
        path
        for path in sorted((shared / "data/drawings" / folder).iterdir())
        if path.suffix.lower() in (".dxf", ".gpkg")
    ]
    delivered, crashes = read_loose(files, profile=profile(seconds=20), scale=50, unit=None, plane="xy")
    assert crashes == ()
    assert len(delivered.sources) == len(files)
    for source in delivered.sources:
        assert (source.error != "") == (source.status is SourceStatus.REFUSED), source.path
        assert source.error not in ("read.too-slow", "read.too-much-memory", "read.died"), source.path


@pytest.mark.shared
def test_a_delivery_of_real_files_is_left_as_it_was(shared: Path, tmp_path: Path) -> None:
    shutil.copytree(shared / "data/drawings/nasty_gpkg", tmp_path / "d", copy_function=shutil.copyfile)
    before = listing(tmp_path)
    names = sorted(path.name for path in (tmp_path / "d").glob("*.gpkg"))
    delivered = take(tmp_path / "d", manifest(drawing=[{"path": name} for name in names]))
    refused = [source.path for source in delivered.sources if source.status is SourceStatus.REFUSED]
    assert refused == ["empty.gpkg", "uint16.gpkg"]
    assert listing(tmp_path) == before


def test_the_origin_is_that_of_the_linework_and_lettering_may_lie_anywhere(tmp_path: Path) -> None:
    document = ezdxf.new()
    space = document.modelspace()
    space.add_text("north", dxfattribs={"insert": (-5000.5, -5000.5)})
    space.add_line((40.5, 30.25), (41.5, 33))
    document.saveas(tmp_path / "both.dxf")
    space.delete_entity(space.query("LINE")[0])
    document.saveas(tmp_path / "lettered.dxf")
    files = [tmp_path / "both.dxf", tmp_path / "lettered.dxf"]
    delivered, _ = read_loose(files, profile=profile(), scale=50, unit=None, plane="xy")
    assert [drawing.plane.origin for drawing in delivered.drawings] == [(40.0, 30.0, 0.0), (-5001.0, -5001.0, 0.0)]


@pytest.mark.parametrize(("stated", "taken"), [({}, ""), ({"crs": "Local"}, ""), ({"crs": "EPSG:31982"}, "EPSG:31982")])
def test_the_stated_reference_system_is_the_delivery_s(tmp_path: Path, stated: dict[str, str], taken: str) -> None:
    drawing(tmp_path / "planta.dxf")
    plan = Manifest.model_validate({"delivery": {"title": "Planta", **stated}, "drawing": [{"path": "planta.dxf"}]})
    assert take(tmp_path, plan).crs == taken
