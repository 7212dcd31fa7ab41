# SPDX-License-Identifier: MIT
"""Real DXF files against the counts of people who had no foparq."""

from collections import Counter
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf import recover
from ezdxf.filemanagement import dxf_file_info
from tests.read.drawn import read, skipped

from foparq.model.items import Role
from foparq.read.dxf.damaged import Depth, set_aside
from foparq.read.dxf.kinds import FACES

pytestmark = pytest.mark.shared

READ, RECOVERED = False, True

#: file: recovered or not, items by (role, kind), skipped by (reason, kind)
NASTY: dict[str, tuple[bool, dict[tuple[str, str], int], dict[tuple[str, str], int]]] = {
    "3d.dxf": (READ, {("line", "CIRCLE"): 1}, {("surface", "3DSOLID"): 3, ("surface", "POLYLINE"): 1}),
    "AC1003_LINE_Example.dxf": (RECOVERED, {("line", "LINE"): 13, ("line", "ARC"): 9}, {}),
    "ASCII_R12.dxf": (READ, {("line", "LINE"): 2, ("annotation", "TEXT"): 1}, {}),
    "LWPOLYLINE-OCS.dxf": (READ, {("line", "LWPOLYLINE"): 7, ("line", "POLYLINE"): 6}, {}),
    "Leica_Disto_S910.dxf": (
        READ,
        {("line", "LINE"): 10, ("point", "POINT"): 11, ("annotation", "TEXT"): 11},
        {},
    ),
    "POLI-ALL210_12.DXF": (READ, {}, {}),
    "array-rotated.dxf": (READ, {("line", "CIRCLE"): 6}, {}),
    "arrayed-holes.dxf": (READ, {("line", "LINE"): 6, ("line", "ARC"): 3, ("line", "CIRCLE"): 14}, {}),
    "assorted.dxf": (
        RECOVERED,
        {("line", "LINE"): 6, ("line", "ELLIPSE"): 2, ("line", "ARC"): 1},
        {("paper-space", "LINE"): 1},
    ),
    "bin_dxf_r2000.dxf": (READ, {("annotation", "TEXT"): 1}, {}),
    "block-hidden-entities.dxf": (READ, {("line", "LINE"): 6}, {}),
    "circle_radius_le_0.dxf": (READ, {}, {("degenerate", "CIRCLE"): 2}),
    "closed_polyline_with_bulge.dxf": (READ, {("line", "LWPOLYLINE"): 1}, {}),
    "dimension_in_nested_blocks.dxf": (READ, {("annotation", "DIMENSION"): 6}, {}),
    "duplicate_handles.dxf": (
        READ,
        {("line", "LINE"): 111, ("annotation", "TEXT"): 19, ("line", "ELLIPSE"): 8, ("annotation", "DIMENSION"): 7},
        {},
    ),
    "dxf_unicode.dxf": (READ, {}, {}),
    "ellipticalarcs.dxf": (READ, {("line", "ELLIPSE"): 9}, {}),
    "empty_handles.dxf": (RECOVERED, {("line", "LINE"): 8}, {}),
    "frozen-off.dxf": (READ, {("line", "LINE"): 84, ("line", "CIRCLE"): 4, ("line", "POLYLINE"): 16}, {}),
    "hatch_as_multipolygon.dxf": (READ, {("hatch", "HATCH"): 1}, {}),
    "hatch_issues.dxf": (READ, {("line", "CIRCLE"): 8, ("hatch", "HATCH"): 4}, {}),
    "houses_of_parliament_georeferenced.dxf": (READ, {("line", "LWPOLYLINE"): 1}, {}),
    "insert-recursive-pair.dxf": (READ, {}, {("block-bomb", "INSERT"): 1}),
    "issue1106.dxf": (RECOVERED, {("line", "LINE"): 5, ("line", "ARC"): 2, ("line", "CIRCLE"): 3}, {}),
    "issue52.dxf": (READ, {("line", "LWPOLYLINE"): 50}, {}),
    "layout_broken_links.dxf": (READ, {}, {}),
    "multi_insert_with_attribs.dxf": (READ, {("annotation", "ATTRIB"): 75, ("line", "CIRCLE"): 25}, {}),
    "polylines.dxf": (READ, {("line", "POLYLINE"): 12}, {}),
    "recover01.dxf": (RECOVERED, {("annotation", "TEXT"): 63, ("line", "LINE"): 1441}, {}),
    "splines.dxf": (READ, {("line", "SPLINE"): 2}, {}),
    "tables.dxf": (RECOVERED, {}, {}),
    "utf-8.dxf": (READ, {("point", "POINT"): 1}, {}),
    "viewport_frozen_layers.dxf": (READ, {("annotation", "TEXT"): 4}, {("paper-space", "TEXT"): 3}),
    "visibility.dxf": (READ, {("annotation", "TEXT"): 4, ("annotation", "MTEXT"): 4}, {}),
    "wipeout_door.dxf": (READ, {("line", "LWPOLYLINE"): 2, ("line", "LINE"): 268}, {("wipeout", "WIPEOUT"): 3}),
    "xclip.dxf": (READ, {("annotation", "MTEXT"): 9}, {("xclip-ignored", "INSERT"): 8}),
}


@pytest.mark.parametrize("name", NASTY)
def test_nasty_file(shared: Path, name: str) -> None:
    recovered, items, left_out = NASTY[name]
    drawing = read(shared / "data/drawings/nasty_dxf" / name)
    found = Counter(zip(drawing.items.role.tolist(), drawing.items.kind.tolist(), strict=True))
    assert bool(drawing.reading.repairs) is recovered
    assert {key: found[key] for key in items} == items
    assert {key: skipped(drawing).get(key) for key in left_out} == left_out
    assert len(set(drawing.items.item.tolist())) == len(drawing.items)


def test_every_nasty_file_is_spoken_of(shared: Path) -> None:
    files = {path.name for path in (shared / "data/drawings/nasty_dxf").iterdir() if path.suffix.lower() == ".dxf"}
    assert files == {*NASTY, "blocks.dxf"}


def test_viewports_that_cannot_be_loaded_are_set_aside(shared: Path) -> None:
    path = shared / "data/drawings/nasty_dxf/blocks.dxf"  # blocks alone: no header, no drawing
    drawing = read(path)
    assert len(drawing.items) == 0
    assert len(drawing.reading.repairs) == path.read_bytes().count(b"\nVIEWPORT\n") == 9
    assert all(repair.kind == "VIEWPORT" for repair in drawing.reading.repairs)


def test_no_entity_that_loads_is_set_aside(shared: Path) -> None:
    paths = [shared / "data/drawings/nasty_dxf" / name for name in NASTY]
    texts = [path for path in paths if not path.read_bytes().startswith(b"AutoCAD Binary DXF")]
    assert len(texts) == len(paths) - 1
    for path in texts:
        info = dxf_file_info(path)
        aside = set_aside(path, info.version, info.encoding, Depth.LOADING)
        told = [(repair.handle, repair.text) for repair in aside.repairs] if aside else []
        assert told == ([("47", "256QSW")] if path.name == "assorted.dxf" else []), path.name


def nasty(shared: Path, name: str, **options: Any) -> Any:
    return read(shared / "data/drawings/nasty_dxf" / name, **options)


def test_layer_names_are_as_people_wrote_them(shared: Path) -> None:
    assert "tracé" in nasty(shared, "issue52.dxf").items.layer
    assert "Строения" in nasty(shared, "hatch_as_multipolygon.dxf").items.layer
    assert "ΛΑΓΕΡÄÜÖ" in nasty(shared, "ASCII_R12.dxf").reading.layers
    assert "Tschüss mit ü" in nasty(shared, "dxf_unicode.dxf").reading.layers


def test_doubly_encoded_name_is_kept_and_reported(shared: Path) -> None:
    drawing = nasty(shared, "utf-8.dxf")
    assert drawing.reading.bad_names == ("Ã©ven",)
    assert drawing.items.layer.tolist() == ["Ã©ven"]


def test_same_handle_twice_gives_two_ids(shared: Path) -> None:
    items = nasty(shared, "duplicate_handles.dxf").items
    assert len(set(items.handle.tolist())) < len(items) == len(set(items.item.tolist()))


def test_handles_that_the_file_does_not_hold_are_not_made_up(shared: Path) -> None:
    items = nasty(shared, "empty_handles.dxf").items
    assert set(items.handle.tolist()) == {""}
    assert items.item.tolist() == [f"#{n}" for n in range(1, 9)]


def test_z_of_a_laser_distance_meter_is_kept(shared: Path) -> None:
    items = nasty(shared, "Leica_Disto_S910.dxf").items
    assert shapely.has_z(items.geometry[items.role == Role.LINE]).all()


def test_closing_segment_has_its_bulge(shared: Path) -> None:
    # drawings.md: exact extent to x 40585366.71
    box = shapely.total_bounds(nasty(shared, "closed_polyline_with_bulge.dxf").items.geometry)
    assert box[2] == pytest.approx(40585366.71, abs=0.005)


def test_hidden_as_autocad_hides(shared: Path) -> None:
    # Insert of a frozen layer hides all; of an off layer only what takes its layer; 4 lines and 4 inserts of 25 each.
    drawing = nasty(shared, "frozen-off.dxf")
    top = drawing.items.inserts == ""
    on_hidden = np.isin(drawing.items.layer, drawing.reading.hidden_layers)
    assert top.sum() == 4
    assert (~drawing.items.visible[on_hidden]).all()
    assert drawing.items.visible[top].tolist() == (~on_hidden[top]).tolist()


def test_polyline_in_every_direction_lies_where_gdal_and_ezdxf_put_it(shared: Path) -> None:
    path = shared / "data/drawings/nasty_dxf/LWPOLYLINE-OCS.dxf"
    drawing = read(path)
    for entity, geometry in zip(ezdxf.readfile(path).modelspace(), drawing.items.geometry, strict=True):
        ends = shapely.get_coordinates(geometry, include_z=True)[0]
        expected = next(iter(entity.vertices_in_wcs() if entity.dxftype() == "LWPOLYLINE" else entity.points_in_wcs()))
        assert np.nan_to_num(ends).tolist() == pytest.approx([*expected.xyz], abs=1e-9)


def all_files(shared: Path) -> list[Path]:
    folders = [shared / "data/drawings" / name for name in ("nasty_dxf", "odagsen", "bishop_overland")]
    return [path for folder in folders for path in sorted(folder.iterdir()) if path.suffix.lower() == ".dxf"]


def reference(path: Path) -> Any:
    try:
        return ezdxf.readfile(path)
    except (ezdxf.DXFError, ValueError, AttributeError):
        return recover.readfile(path)[0]


def test_every_entity_of_model_space_is_accounted_for(shared: Path) -> None:
    for path in all_files(shared):
        if path.name == "blocks.dxf":
            continue
        drawing = read(path, blocks="skip")
        asides = ("paper-space", "paper-space-only", "xclip-ignored")
        entries = [entry for entry in drawing.reading.skipped if entry.reason not in asides]
        counted = sum(entry.count for entry in entries if entry.kind not in FACES)  # faces stay items
        attributes = np.count_nonzero(drawing.items.kind == "ATTRIB")
        assert (drawing.items.inserts == "").all()
        deleted = 3 if path.name == "assorted.dxf" else 0  # dimensions that the reference mends away
        named = sum(1 for _ in reference(path).modelspace()) + deleted
        assert len(drawing.items) - attributes + counted == named, path.name


#: chains as the README has them, and one more where a polyline has no length
ODAGSEN = {
    "ODS1P101": 15, "ODS1P102": 428, "ODS1P106": 17, "ODS1P615": 214, "ODS2P126": 70, "ODS2P429": 799,
    "ODS2P636": 22, "ODS2P734": 95, "ODS4P154": 76, "ODS4P155": 289, "ODS4P366": 216, "OS6P4147": 267,
}  # fmt: skip


@pytest.mark.parametrize("name", ODAGSEN)
def test_odagsen_sheet(shared: Path, name: str) -> None:
    path = shared / "data/drawings/odagsen" / f"{name}.DXF"
    drawing = read(path, blocks="skip")
    lines = drawing.items.role == Role.LINE
    assert lines.sum() == ODAGSEN[name]
    hatches = sum(1 for insert in reference(path).modelspace().query("INSERT") if insert.dxf.name.startswith("*X"))
    assert (drawing.items.role == Role.HATCH).sum() == hatches
    assert drawing.unit.metres == 1.0
    assert drawing.reading.version == "AC1027"


@pytest.mark.parametrize("name", ODAGSEN)
def test_odagsen_hatches_are_never_taken_apart(shared: Path, name: str) -> None:
    path = shared / "data/drawings/odagsen" / f"{name}.DXF"
    items = read(path).items
    anonymous = {i.dxf.handle for i in reference(path).modelspace().query("INSERT") if i.dxf.name.startswith("*X")}
    assert not anonymous & {chain.split("/")[0] for chain in items.inserts}
    assert np.count_nonzero(items.kind == "LINE") == (40 if name == "ODS2P126" else 0)


@pytest.mark.parametrize(("name", "handle"), [("ODS2P429", "421A"), ("ODS4P366", "1097"), ("OS6P4147", "1F6B")])
def test_odagsen_polyline_that_is_no_chain_has_no_length(shared: Path, name: str, handle: str) -> None:
    # The README counts 799 polylines and 798 chains, and so on: one polyline has two vertices at the same place.
    items = read(shared / "data/drawings/odagsen" / f"{name}.DXF", blocks="skip").items
    point_like = (items.role == Role.LINE) & (shapely.length(items.geometry) == 0)
    assert items.handle[point_like].tolist() == [handle]


def test_odagsen_rings_close_by_coincidence(shared: Path) -> None:
    items = read(shared / "data/drawings/odagsen/ODS2P429.DXF", blocks="skip").items
    lines = items.role == Role.LINE
    rings = shapely.is_closed(items.geometry) & (shapely.length(items.geometry) > 0) & lines
    assert (rings & ~items.closed).sum() == 591


def test_odagsen_hidden_layers(shared: Path) -> None:
    drawing = read(shared / "data/drawings/odagsen/ODS4P154.DXF")
    hidden = ~drawing.items.visible
    assert (hidden.sum(), len(drawing.items)) == (38, 83)
    assert len(set(drawing.items.layer[hidden].tolist())) == 2
    assert set(drawing.items.layer[hidden].tolist()) <= set(drawing.reading.hidden_layers)


def test_vertices_are_those_of_the_file_bit_by_bit(shared: Path) -> None:
    path = shared / "data/drawings/odagsen/ODS1P102.DXF"
    items = read(path, blocks="skip").items
    by_handle = dict(zip(items.handle.tolist(), items.geometry.tolist(), strict=True))
    for entity in reference(path).modelspace().query("LWPOLYLINE"):
        vertices = [tuple(point) for point in entity.get_points("xy")]
        if entity.closed and vertices[0] != vertices[-1]:
            vertices.append(vertices[0])
        assert list(by_handle[entity.dxf.handle].coords) == vertices


def test_bishop_counts(shared: Path) -> None:
    drawing = read(shared / "data/drawings/bishop_overland/floorplan.dxf", blocks="skip")
    kinds = Counter(drawing.items.kind.tolist())
    expected = {
        "LINE": 624,
        "LWPOLYLINE": 124,
        "TEXT": 89,
        "DIMENSION": 63,
        "ARC": 20,
        "HATCH": 13,
        "CIRCLE": 9,
        "MTEXT": 9,
    }
    assert {kind: kinds[kind] for kind in expected} == expected
    assert kinds["LEADER"] == 6
    assert skipped(drawing)["blocks-skipped", "INSERT"] == 10
    assert sum(entry.count for entry in drawing.reading.skipped if entry.reason == "paper-space") == 3
    assert len(set(drawing.items.layer.tolist())) <= 17


def test_bishop_dimensions_are_lettered_in_feet_and_inches(shared: Path) -> None:
    drawing = read(shared / "data/drawings/bishop_overland/floorplan.dxf")
    dimensions = drawing.reading.dimensions
    assert dimensions is not None
    assert len(dimensions.text) == 63
    texts = dict(zip(dimensions.measured.tolist(), dimensions.text.tolist(), strict=True))
    assert (texts[37.0], texts[192.0], texts[150.0]) == ("3'-1\"", "16'-0\"", "12'-6\"")
    assert texts[82.5] == "6'-10 1/2\""
    assert (drawing.unit.name, drawing.unit.header_metres) == ("mm", 0.001)
