# SPDX-License-Identifier: MIT
"""``findings.gpkg`` in the plane of the drawings: places, linework and frames, against projections made here."""

import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from pyogrio.raw import read

from foparq.findings.table import Findings, join_findings
from foparq.model.drawing import Drawing
from foparq.model.plane import Plane, plane_of
from foparq.report import drawing_gpkg
from foparq.report.findings_gpkg import write_findings_gpkg
from foparq.report.record import AuditRecord

Plant = Callable[..., Findings]

UTM = np.array([456_000.0, 7_552_000.0, 430.0])
TURNED = np.array([0.8, 0.6, 0.0])  # a facade that faces neither north nor east
GIVEN = (tuple(UTM.tolist()), tuple(TURNED.tolist()), (0.0, 0.0, 1.0))
#: plane as stated; origin, right and up that the manifest's documentation gives it; metres in a unit
PLANES = [
    ("xz", np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), 1.0),
    ("yz", np.zeros(3), np.array([0, 1.0, 0]), np.array([0, 0, 1.0]), 0.001),
    (GIVEN, UTM, TURNED, np.array([0, 0, 1.0]), 1.0),
    ("fit", np.zeros(3), TURNED, np.array([0, 0, 1.0]), 0.01),
]


def written(record: AuditRecord, folder: Path) -> Path:
    write_findings_gpkg(record, folder / "findings.gpkg")
    return folder / "findings.gpkg"


def layer(path: Path, name: str) -> tuple[dict[str, Any], Any]:
    meta, _, geometry, columns = read(path, layer=name)
    return dict(zip(meta["fields"], columns, strict=True)), shapely.from_wkb(geometry)


def standing(drawing: Drawing, stated: Any, metres: float, path: str = "fachada.dxf") -> Drawing:
    """The station on a wall through UTM that runs along TURNED, drawn in the stated plane."""
    flat = [shapely.get_coordinates(shape, include_z=True) for shape in drawing.items.geometry]
    wall = [UTM + c[:, :1] * TURNED + c[:, 2:] * np.array([0, 0, 1.0]) for c in flat]
    geometry = np.array([shapely.LineString(c / metres) for c in wall], dtype=object)
    plane: Plane = plane_of(stated, geometry)
    items = replace(drawing.items, geometry=geometry)
    return replace(
        drawing, path=path, items=items, plane=plane, unit=replace(drawing.unit, metres=metres, name="other")
    )


def of(record: AuditRecord, findings: Findings, *drawings: Drawing) -> AuditRecord:
    return replace(record, findings=findings, delivery=replace(record.delivery, parts=drawings))


def seen(places: Any, origin: Any, right: Any, up: Any, metres: float) -> Any:
    """Orthogonal projection, from the definition: products with the axes, in metres."""
    away = np.asarray(places) - origin
    return np.column_stack([away @ right, away @ up]) * metres


@pytest.mark.parametrize(("stated", "origin", "right", "up", "metres"), PLANES)
def test_findings_and_linework_are_seen_from_the_front(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, tmp_path: Path,
    stated: Any, origin: Any, right: Any, up: Any, metres: float,
) -> None:  # fmt: skip
    facade = standing(drawing, stated, metres)
    if stated == "fit":  # over thousands of kilometres the last digit of a fitted axis shows
        assert np.allclose([facade.plane.right, facade.plane.up], [right, up], rtol=0, atol=1e-9)
        right, up = np.array(facade.plane.right), np.array(facade.plane.up)
    ends = {str(n): shapely.get_coordinates(shape, include_z=True) for n, shape in enumerate(facade.items.geometry)}
    spots = {name: coordinates[0] for name, coordinates in ends.items() if int(name) % 9 == 0}
    rows = [(name, "PAREDE", shapely.Point(spot), 0.004) for name, spot in spots.items()]
    stretch = [("7", "PAREDE", facade.items.geometry[7], 0.2)]
    findings = join_findings(
        [plant(facade, "TOP011", "undershoot", rows), plant(facade, "TOP021", "line-overlap", stretch)]
    )
    path = written(of(rejected, findings, facade), tmp_path)
    columns, shapes = layer(path, "flags_p")
    assert len(shapes) == len(rows)
    for name, shape, *file in zip(columns["item"], shapes, columns["x"], columns["y"], columns["z"], strict=True):
        assert np.allclose(file, spots[name], rtol=1e-12)
        wanted = seen([spots[name]], origin, right, up, metres)
        assert np.allclose(shapely.get_coordinates(shape), wanted, rtol=0, atol=1e-6)
    _, (line,) = layer(path, "flags_l")
    assert np.allclose(shapely.get_coordinates(line), seen(ends["7"], origin, right, up, metres), rtol=0, atol=1e-6)

    columns, shapes = layer(path, "desenho_l")
    drawn = [n for n in range(len(ends)) if not facade.items.paper[n]]
    assert columns["item"].tolist() == facade.items.item[drawn].tolist()
    for name in ("layer", "kind", "role"):
        assert len(set(columns[name])) > (name == "layer")
        assert all(value.isprintable() for value in columns[name])
    assert set(columns["source"]) == {"fachada.dxf"}
    for n, shape in zip(drawn, shapes, strict=True):
        wanted = seen(ends[str(n)], origin, right, up, metres)
        assert np.allclose(shapely.get_coordinates(shape), wanted, rtol=0, atol=1e-6)


def test_linework_is_that_of_the_drawing(rejected: AuditRecord, drawing: Drawing, tmp_path: Path) -> None:
    """Areas are their boundaries, parts stay one item; points, nothing and paper space are no lines."""
    hole = shapely.Polygon([(0, 0, 0), (9, 0, 0), (9, 0, 9), (0, 0, 9)], [[(2, 0, 2), (4, 0, 2), (4, 0, 4)]])
    two = shapely.MultiLineString([[(0, 0, 0), (1, 0, 1)], [(5, 0, 5), (6, 0, 5)]])
    mixed = shapely.GeometryCollection([shapely.Point(3, 0, 3), shapely.LineString([(7, 0, 7), (8, 0, 8)])])
    with np.errstate(invalid="ignore"):
        odd = shapely.LineString([(np.nan, 0, 0), (1, 0, 1)])
    geometry = drawing.items.geometry.copy()
    geometry[:7] = [hole, two, mixed, shapely.Point(1, 0, 1), None, shapely.LineString(), odd]
    changed = replace(drawing, items=replace(drawing.items, geometry=geometry))
    path = written(replace(rejected, delivery=replace(rejected.delivery, parts=(changed,))), tmp_path)
    columns, shapes = layer(path, "desenho_l")
    by_item = dict(zip(columns["item"], shapes, strict=True))
    items = changed.items.item
    assert set(by_item) == set(items[~changed.items.paper]) - set(items[3:7])
    assert by_item[items[0]].length == pytest.approx(36 + 2 + 2 + 8**0.5)
    assert by_item[items[1]].equals(shapely.MultiLineString([[(0, 0), (1, 1)], [(5, 5), (6, 5)]]))
    assert by_item[items[2]].equals(shapely.LineString([(7, 7), (8, 8)]))
    frame, _ = layer(path, "desenho_a")
    # An empty line and one without numbers have no place: they are missed, and that is told.
    assert frame["items"].tolist() == [len(by_item) + 2]
    assert frame["drawn"].tolist() == [len(by_item)]


def test_a_drawing_in_xy_lies_on_its_file(rejected: AuditRecord, drawing: Drawing, tmp_path: Path) -> None:
    """QGIS shows findings over the delivered file: same coordinates, same units."""
    geometry = np.array(
        [shapely.LineString([(x * 1000, z * 1000) for x, _, z in shape.coords]) for shape in drawing.items.geometry]
    )
    plan = replace(
        drawing, items=replace(drawing.items, geometry=geometry), plane=plane_of(None, geometry),
        unit=replace(drawing.unit, metres=0.001, name="mm"),
    )  # fmt: skip
    path = written(replace(rejected, delivery=replace(rejected.delivery, parts=(plan,))), tmp_path)
    _, shapes = layer(path, "desenho_l")
    drawn = geometry[~plan.items.paper]
    assert all(shape.geoms[0].equals_exact(line, 0.0) for shape, line in zip(shapes, drawn, strict=True))


@pytest.mark.parametrize("kind", ["elevations", "plans"])
def test_drawings_stand_side_by_side_and_the_frame_leads_back(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, tmp_path: Path, kind: str
) -> None:
    if kind == "plans":  # three plans, each about its own nought
        plans = [
            replace(drawing, path=f"{n}.dxf", facade=f"F{n}", plane=plane_of("xy", drawing.items.geometry))
            for n in range(3)
        ]
    else:  # elevations of one wall, and a plan far away
        plans = [
            standing(drawing, "xz", 1.0, "0.dxf"), standing(drawing, GIVEN, 0.01, "1.dxf"),
            standing(drawing, "yz", 0.001, "2.dxf"), standing(drawing, "xy", 1.0, "3.dxf"),
        ]  # fmt: skip
    rows = [("7", "PAREDE", shapely.Point(shapely.get_coordinates(plans[0].items.geometry[7], include_z=True)[0]), 0.1)]
    path = written(of(rejected, plant(plans[0], "TOP011", "undershoot", rows), *plans), tmp_path)
    with closing(sqlite3.connect(path)) as database:
        assert database.execute("SELECT DISTINCT srs_id FROM gpkg_geometry_columns").fetchall() == [(-1,)]
    frames, outlines = layer(path, "desenho_a")
    assert frames["source"].tolist() == [one.path for one in plans]
    assert frames["facade"].tolist() == [one.facade for one in plans]
    for n, one in enumerate(outlines):
        assert not any(one.intersects(other) for other in outlines[:n])
    width = max(one.bounds[2] for one in outlines) - min(one.bounds[0] for one in outlines)
    assert width < 3 * sum(one.bounds[2] - one.bounds[0] for one in outlines), "no drawing is a speck far away"
    tallest = max(one.bounds[3] - one.bounds[1] for one in outlines)
    assert max(one.bounds[3] for one in outlines) - min(one.bounds[1] for one in outlines) < 3 * tallest

    lines, shapes = layer(path, "desenho_l")
    for n, one in enumerate(plans):
        own = shapes[lines["source"] == one.path]
        assert shapely.contains(outlines[n], own[one.visible_rows()[~one.items.paper]]).all()
        right, up, origin = (np.array(frames[name][n].split(), dtype=float) for name in ("right", "up", "origin"))
        shift, metres = np.array([frames["shift_r"][n], frames["shift_u"][n]]), frames["metres"][n]
        shown = shapely.get_coordinates(own) - shift
        back = origin + (shown[:, :1] * right + shown[:, 1:] * up) / metres
        file = shapely.get_coordinates(one.items.geometry[~one.items.paper], include_z=True)
        depth = np.cross(right, up)
        away = np.nan_to_num(file) - back
        assert np.abs(away - (away @ depth)[:, None] * depth).max() * metres < 1e-6
    # Heights are heights where elevations share any.
    if kind == "elevations":
        assert frames["shift_u"].tolist()[0] == frames["shift_u"].tolist()[2] == 0.0


def test_plans_of_one_system_stay_where_they_are(rejected: AuditRecord, drawing: Drawing, tmp_path: Path) -> None:
    plan = replace(
        drawing, plane=plane_of("xy", drawing.items.geometry), reading=replace(drawing.reading, crs="EPSG:31982")
    )
    path = written(of(rejected, rejected.findings, plan, replace(plan, path="outra.dxf")), tmp_path)
    frames, outlines = layer(path, "desenho_a")
    assert outlines[0].equals(outlines[1])
    assert not np.any([frames["shift_r"], frames["shift_u"]])


def test_what_is_left_out_of_the_linework_is_told(
    rejected: AuditRecord, drawing: Drawing, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drawing_gpkg, "MOST_ITEMS", 40)
    path = written(rejected, tmp_path)
    columns, _ = layer(path, "desenho_l")
    frame, _ = layer(path, "desenho_a")
    assert (frame["items"].tolist(), frame["drawn"].tolist()) == ([int(np.sum(~drawing.items.paper))], [40])
    named = {*rejected.findings.item, *rejected.findings.other} & set(drawing.items.item)
    assert named <= set(columns["item"])
    others = [role for item, role in zip(columns["item"], columns["role"], strict=True) if item not in named]
    assert set(others) == {"line"}, "visible linework goes before hatches and lettering"


def test_one_enormous_item_leaves_the_others_in(
    rejected: AuditRecord, drawing: Drawing, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drawing_gpkg, "MOST_VERTICES", 5000)
    geometry = drawing.items.geometry.copy()
    geometry[0] = shapely.LineString(np.column_stack([np.arange(5001.0) / 200, np.zeros(5001), np.zeros(5001)]))
    changed = replace(drawing, items=replace(drawing.items, geometry=geometry))
    columns, _ = layer(written(of(rejected, rejected.findings, changed), tmp_path), "desenho_l")
    assert set(columns["item"]) == set(changed.items.item[~changed.items.paper]) - {changed.items.item[0]}


def test_a_delivery_without_drawings_has_the_layers(accepted: AuditRecord, tmp_path: Path) -> None:
    path = written(replace(accepted, delivery=replace(accepted.delivery, parts=())), tmp_path)
    assert [len(layer(path, name)[1]) for name in ("flags_p", "desenho_l", "desenho_a")] == [0, 0, 0]


@pytest.mark.parametrize("far", [1e12, 1e300, -1.7e308])
def test_absurd_coordinates_stay_one_drawing_s_affair(
    rejected: AuditRecord, drawing: Drawing, tmp_path: Path, far: float
) -> None:
    geometry = drawing.items.geometry.copy()
    geometry[:] = shapely.LineString([(far, 0, far), (-far, 0, 1)])
    absurd = replace(drawing, path="b.dxf", items=replace(drawing.items, geometry=geometry))
    path = written(of(rejected, rejected.findings, drawing, absurd), tmp_path)
    frames, outlines = layer(path, "desenho_a")
    assert np.isfinite(shapely.get_coordinates(outlines)).all()
    assert (frames["shift_r"][0], frames["shift_u"][0]) == (0, 0)
    assert frames["drawn"].tolist() == frames["items"].tolist()
