# SPDX-License-Identifier: MIT
"""The generated deliveries hold what their truth says, measured without foparq."""

import csv
import json
import math
import sqlite3
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pyogrio
import pytest
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
NAMES = ("station-a", "station-a-draft", "station-a-tape")
FORMATS = ("dxf", "gpkg")
LINEWORK = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE"}
SAGITTA = 5e-5
COINCIDE, REACH = 0.01e-3 * 50, 0.2e-3 * 50  # at 1:50, metres
EXACT = 1e-9
DRAWINGS = [(name, kind) for name in NAMES for kind in FORMATS]


@dataclass(frozen=True)
class Item:
    """One linework item: vertices (n, 3) in file coordinates."""

    layer: str
    key: str  # DXF handle, or feature id
    insert: str  # handle of the outermost insert, "" for none
    vertices: np.ndarray

    @property
    def flat(self) -> shapely.LineString:
        return shapely.LineString(self.vertices[:, [0, 2]])

    @property
    def closed(self) -> bool:
        return bool(np.linalg.norm(self.vertices[0] - self.vertices[-1]) < EXACT)


@cache
def items(name: str, kind: str, root: Path = FIXTURES) -> tuple[Item, ...]:
    path = root / "deliveries" / name / f"fachada.{kind}"
    return tuple(_dxf_items(path) if kind == "dxf" else _gpkg_items(path))


def _dxf_items(path: Path) -> Iterator[Item]:
    for entity in ezdxf.readfile(path).modelspace():
        if entity.dxftype() == "INSERT":
            for inner in entity.virtual_entities():
                layer = entity.dxf.layer if inner.dxf.layer == "0" else inner.dxf.layer
                handle = inner.source_of_copy.dxf.handle if inner.source_of_copy else "?"
                yield Item(layer, handle, entity.dxf.handle, _vertices(inner))
        elif entity.dxftype() in LINEWORK:
            yield Item(entity.dxf.layer, entity.dxf.handle, "", _vertices(entity))


def _vertices(entity: Any) -> np.ndarray:
    kind = entity.dxftype()
    if kind == "LINE":
        points = [entity.dxf.start, entity.dxf.end]
    elif kind == "POLYLINE":
        points = list(entity.points())
        points += points[:1] if entity.is_closed else []
    elif kind == "LWPOLYLINE":
        corners = list(entity.vertices_in_wcs())
        points = corners[:1]
        # An arc of a polyline is stored anticlockwise: it is turned to begin at its own corner.
        for corner, part in zip(corners, entity.virtual_entities(), strict=False):
            along = [part.dxf.start, part.dxf.end] if part.dxftype() == "LINE" else list(part.flattening(SAGITTA))
            points += along[1:] if along[0].isclose(corner, abs_tol=EXACT) else along[-2::-1]
    else:
        points = list(entity.flattening(SAGITTA))
    return np.array([tuple(point) for point in points])


def _gpkg_items(path: Path) -> Iterator[Item]:
    for layer, kind in pyogrio.list_layers(path):
        assert kind == "LineString Z"
        _, fids, geometry, _ = pyogrio.raw.read(path, layer=layer, return_fids=True)
        for fid, line in zip(fids, shapely.from_wkb(geometry), strict=True):
            yield Item(layer, str(fid), "", shapely.get_coordinates(line, include_z=True))


@cache
def truth(name: str) -> Any:
    return json.loads((FIXTURES / "truth" / f"{name}.json").read_text("utf-8"))


def table(name: str, file: str) -> list[dict[str, str]]:
    with (FIXTURES / "deliveries" / name / file).open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def distance_in_space(point: np.ndarray, vertices: np.ndarray) -> float:
    first, along = vertices[:-1], np.diff(vertices, axis=0)
    share = np.clip(((point - first) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(first + share[:, None] * along - point, axis=1).min())


@cache
def loose_ends(name: str, kind: str) -> tuple[tuple[Item, tuple[float, ...], float], ...]:
    """Ends of open items that meet no other item exactly in space: item, place, distance to the next within 20 mm."""
    every = items(name, kind)
    tree = shapely.STRtree([item.flat for item in every])
    found = []
    for row, item in enumerate(every):
        if item.closed:
            continue
        for end in (item.vertices[0], item.vertices[-1]):
            near = tree.query(shapely.Point(end[[0, 2]]), predicate="dwithin", distance=0.02)
            gap = min((distance_in_space(end, every[n].vertices) for n in near if n != row), default=math.inf)
            if gap > EXACT:
                found.append((item, tuple(end), gap))
    return tuple(found)


@cache
def common_stretches(name: str, kind: str) -> tuple[tuple[Item, Item, float], ...]:
    """Pairs of items with a common stretch of line in the facade, whatever their depth; panels may share edges."""
    every = items(name, kind)
    flat = [item.flat for item in every]
    first, second = shapely.STRtree(flat).query(flat, predicate="intersects")
    found = []
    for a, b in zip(first[first < second], second[first < second], strict=True):
        if every[a].layer == every[b].layer == "REVESTIMENTO":
            continue
        length = shapely.intersection(flat[a], flat[b]).length
        if length > 1e-6:
            found.append((every[a], every[b], length))
    return tuple(found)


# --- the drawings ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "kind"), DRAWINGS)
def test_976_features_on_the_layers_that_the_truth_names(name: str, kind: str) -> None:
    counts = Counter(item.layer for item in items(name, kind))
    assert sum(counts.values()) == truth(name)["features"] == 976
    assert counts == truth(name)["features_by_layer"]


@pytest.mark.parametrize("name", NAMES)
def test_twin_holds_the_same_lines_in_the_same_order(name: str) -> None:
    for layer in truth(name)["features_by_layer"]:
        drawn = [item for item in items(name, "dxf") if item.layer == layer]
        twins = [item for item in items(name, "gpkg") if item.layer == layer]
        assert [item.key for item in twins] == [str(fid) for fid in range(1, len(drawn) + 1)]
        for one, other in zip(drawn, twins, strict=True):
            assert one.closed == other.closed
            assert shapely.hausdorff_distance(one.flat, other.flat, densify=0.2) < 2 * SAGITTA
            assert np.ptp(np.concatenate([one.vertices, other.vertices])[:, 1]) == pytest.approx(
                np.ptp(one.vertices[:, 1])
            )
            ends = {tuple(np.round(item.vertices[n], 9)) for item in (one, other) for n in (0, -1)}
            assert len(ends) == (1 if one.closed else 2) or one.closed


@pytest.mark.parametrize("name", NAMES)
def test_dxf_states_metres_and_holds_every_kind_of_entity(name: str) -> None:
    document = ezdxf.readfile(FIXTURES / "deliveries" / name / "fachada.dxf")
    assert document.header["$INSUNITS"] == 6
    assert document.dxfversion >= "AC1024"
    assert not document.audit().errors
    kinds = Counter(entity.dxftype() for entity in document.modelspace())
    assert kinds.keys() >= LINEWORK | {"INSERT", "TEXT", "DIMENSION", "HATCH"}
    uses = Counter(insert.dxf.name for insert in document.modelspace().query("INSERT"))
    assert uses["JANELA_ARCO"] > 10
    assert any(insert.dxf.xscale < 0 for insert in document.modelspace().query("INSERT"))
    assert {"VÃO", "CALÇADA", "RELÓGIO"} <= {layer.dxf.name for layer in document.layers}
    fronts = {
        tuple(entity.dxf.extrusion) for entity in document.modelspace().query("LWPOLYLINE ARC CIRCLE INSERT TEXT")
    }
    assert fronts == {(0.0, -1.0, 0.0)}


def test_dimensions_are_true() -> None:
    document = ezdxf.readfile(FIXTURES / "deliveries/station-a/fachada.dxf")
    dimensions = document.modelspace().query("DIMENSION")
    for dimension in dimensions:
        axis = 2 if dimension.dxf.angle == 90.0 else 0
        length = abs(dimension.dxf.defpoint2[axis] - dimension.dxf.defpoint3[axis])
        assert length == pytest.approx(float(dimension.dxf.text.replace(",", ".")), abs=0.005)
        assert length == pytest.approx(dimension.dxf.actual_measurement, abs=1e-9)
    assert len(dimensions) == 7


@pytest.mark.parametrize("name", NAMES)
def test_geopackage_is_version_1_3_in_an_undefined_plane(name: str) -> None:
    path = FIXTURES / "deliveries" / name / "fachada.gpkg"
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    try:
        assert database.execute("PRAGMA user_version").fetchone() == (10300,)
        contents = database.execute("SELECT srs_id, last_change FROM gpkg_contents").fetchall()
    finally:
        database.close()
    assert {row[0] for row in contents} == {-1}
    assert len({row[1] for row in contents}) == 1


@pytest.mark.parametrize("name", NAMES)
def test_facade_is_upright_60_m_wide_and_9_m_high(name: str) -> None:
    building = [item for item in items(name, "gpkg") if item.layer in {"PAREDE", "PILASTRA", "ESQUADRIA_PORTA"}]
    points = np.concatenate([item.vertices for item in building])
    assert points.min(axis=0) == pytest.approx([100.0, 49.88, 10.0], abs=1e-6)
    assert points.max(axis=0) == pytest.approx([160.0, 50.2, 19.0], abs=0.01)


# --- topology ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["station-a", "station-a-tape"])
@pytest.mark.parametrize("kind", FORMATS)
def test_every_end_of_the_accepted_drawing_meets_other_linework(name: str, kind: str) -> None:
    assert loose_ends(name, kind) == ()


@pytest.mark.parametrize("kind", FORMATS)
def test_accepted_drawing_has_no_near_miss(kind: str) -> None:
    every = items("station-a", kind)
    flat = np.array([item.flat for item in every], dtype=object)
    pairs = shapely.STRtree(flat).query(flat, predicate="dwithin", distance=2 * REACH)
    gaps = shapely.distance(flat[pairs[0]], flat[pairs[1]])
    assert not np.any(gaps > EXACT)


@pytest.mark.parametrize("kind", FORMATS)
def test_accepted_drawing_has_no_other_fault(kind: str) -> None:
    every = items("station-a", kind)
    assert common_stretches("station-a", kind) == ()
    for item in every:
        assert item.flat.is_simple
        steps = np.linalg.norm(np.diff(item.vertices, axis=0), axis=1)
        assert steps.min() > 2 * COINCIDE
        if not item.closed and len(item.vertices) >= 4:
            assert math.dist(item.vertices[0], item.vertices[-1]) > 2 * REACH
    shapes = {shapely.normalize(item.flat).wkb for item in every}
    assert len(shapes) == 976


@pytest.mark.parametrize(("name", "kind"), DRAWINGS)
def test_panels_cover_without_gap_or_overlap(name: str, kind: str) -> None:
    panels = [shapely.Polygon(item.vertices[:, [0, 2]]) for item in items(name, kind) if item.layer == "REVESTIMENTO"]
    assert len(panels) == 80
    assert shapely.coverage_is_valid(panels)
    whole = shapely.union_all(panels)
    assert whole.area == pytest.approx(sum(panel.area for panel in panels), abs=1e-9)
    assert not any(part.interiors for part in shapely.get_parts(whole))


@pytest.mark.parametrize("kind", FORMATS)
def test_draft_differs_in_exactly_the_66_features_of_the_truth(kind: str) -> None:
    changed = [
        (before.layer, before.key)
        for before, after in zip(items("station-a", kind), items("station-a-draft", kind), strict=True)
        if not np.array_equal(before.vertices, after.vertices)
    ]
    key = "handle" if kind == "dxf" else "fid"
    planted = truth("station-a-draft")["faults"]["list"]
    assert len(planted) == len(changed) == len(set(changed)) == 66
    assert Counter(fault["rule"] for fault in planted) == {"undershoot": 32, "overshoot": 32, "line-overlap": 2}
    assert sorted(changed) == sorted((fault["layer"], str(fault[key])) for fault in planted)


@pytest.mark.parametrize("kind", FORMATS)
def test_planted_faults_lie_where_the_truth_says(kind: str) -> None:
    key = "handle" if kind == "dxf" else "fid"
    named = {(item.layer, item.key): item for item in items("station-a-draft", kind)}
    every = items("station-a-draft", kind)
    tree = shapely.STRtree([item.flat for item in every])
    for fault in truth("station-a-draft")["faults"]["list"]:
        item = named[fault["layer"], str(fault[key])]
        place = np.array(fault["place"])
        met = [named[owner] for owner in named if owner[1] == str(fault[f"other_{key}"])]
        other = min(met, key=lambda candidate: distance_in_space(place, candidate.vertices))
        if fault["rule"] == "line-overlap":
            assert shapely.intersection(item.flat, other.flat).length == pytest.approx(fault["size"], abs=EXACT)
            assert 0.1 <= fault["size"] <= 0.4
            continue
        assert 0.0015 <= fault["size"] <= 0.009
        assert min(math.dist(place, end) for end in item.vertices[[0, -1]]) < EXACT
        assert distance_in_space(place, other.vertices) == pytest.approx(fault["size"], abs=EXACT)
        fixed = max(item.vertices[[0, -1]], key=lambda end: math.dist(place, end))
        last = shapely.LineString([place[[0, 2]], (place + (fixed - place) * 0.5)[[0, 2]]])
        assert last.intersects(other.flat) == (fault["rule"] == "overshoot")
        near = tree.query(shapely.Point(place[[0, 2]]), predicate="dwithin", distance=REACH)
        assert {every[n].key for n in near} == {item.key, other.key}


@pytest.mark.parametrize("kind", FORMATS)
def test_draft_has_no_fault_that_was_not_planted(kind: str) -> None:
    planted = truth("station-a-draft")["faults"]["list"]
    loose = sorted(tuple(np.round(place, 6)) for _, place, _ in loose_ends("station-a-draft", kind))
    assert loose == sorted(tuple(fault["place"]) for fault in planted if fault["rule"] != "line-overlap")
    assert len(common_stretches("station-a-draft", kind)) == 2
    assert all(item.flat.is_simple for item in items("station-a-draft", kind))


# --- completeness ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "kind"), DRAWINGS)
def test_137_of_142_specified_features_are_drawn(name: str, kind: str) -> None:
    manifest = tomllib.loads((FIXTURES / "deliveries" / name / "delivery.toml").read_text("utf-8"))
    classes = manifest["drawing"][0]["classes"]
    drawn = {}
    for word in set(classes.values()):
        mine = [
            item for item in items(name, kind) if any(fnmatchcase(item.layer, p) for p in classes if classes[p] == word)
        ]
        drawn[word] = clusters(mine)
    asked = Counter(row["class"] for row in table(name, "feicoes.csv"))
    known = truth(name)["completeness"]
    assert sum(asked.values()) == known["specified"] == 142
    assert sum(drawn.values()) == known["delivered"] == 137
    assert {word: {"specified": asked[word], "delivered": drawn[word]} for word in asked} == known["classes"]
    assert asked - Counter(drawn) == {"window": 1, "ornament": 4}
    assert not Counter(drawn) - asked
    assert round(100 * (142 - 137) / 142, 2) == 3.52


def clusters(mine: list[Item]) -> int:
    """Features: items of one insert, and items nearer than ``reach``; none may be near to two answers."""
    flat = np.array([item.flat for item in mine], dtype=object)
    first, second = shapely.STRtree(flat).query(flat, predicate="dwithin", distance=3 * REACH)
    gaps = shapely.distance(flat[first], flat[second])
    assert not np.any((gaps > 0.95 * REACH) & (gaps < 3 * REACH))
    joined = gaps < REACH
    labels = {insert: n for n, insert in enumerate({item.insert for item in mine if item.insert})}
    inserts = np.array([labels.get(item.insert, -1) for item in mine])
    same = np.argwhere((inserts[:, None] == inserts[None, :]) & (inserts[:, None] >= 0)).T
    rows, columns = np.concatenate([[first[joined], second[joined]], same], axis=1)
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(len(mine), len(mine)))
    return int(connected_components(graph, directed=False)[0])


def test_omitted_features_are_listed_with_evidence_where_accepted() -> None:
    rows = table("station-a", "feicoes.csv")
    assert len({row["id"] for row in rows}) == len(rows)
    assert {(row["facade"], row["count"], row["use"]) for row in rows} == {("N", "1", "required")}
    omitted = [row for row in rows if row["remark"]]
    assert sorted(row["id"] for row in omitted) == truth("station-a")["completeness"]["omitted"]
    for row in omitted:
        assert row["omission_accepted"] in {"", "OCCL", "RES"}
        assert bool(row["omission_accepted"]) == bool(row["evidence"])
    assert any(row["omission_accepted"] for row in omitted)


@pytest.mark.parametrize(("name", "kind"), DRAWINGS)
def test_delivered_checkpoints_are_corners_of_the_drawing(name: str, kind: str) -> None:
    corners = np.concatenate([item.vertices for item in items(name, kind)])
    for row in table(name, "pontos.csv"):
        point = np.array([float(row[axis]) for axis in ("xd", "yd", "zd")])
        assert np.linalg.norm(corners - point, axis=1).min() < EXACT
