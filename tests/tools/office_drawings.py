# SPDX-License-Identifier: MIT
"""The drawing of an office as DXF or GeoPackage."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pyogrio
import shapely
from tests.tools.facades import Part
from tests.tools.offices import FRAMES, METRES, Office

_HEADER = {"m": 6, "mm": 4, "cm": 5, "in": 1, "ft": 2, "km": 7}
_AXES = "EIXO"


def lines_of(office: Office, part: Part) -> list[np.ndarray]:
    """Lines (k, 3) of a feature in drawing units; the first is closed."""
    ring = np.array([*part.ring, part.ring[0]])
    return [_units(office, spots) for spots in (ring, *part.inner)]


def write_gpkg(office: Office, path: Path) -> None:
    """One table a layer, every line a feature; closed lines stay lines."""
    pyogrio.set_gdal_config_options({"OGR_SQLITE_SYNCHRONOUS": "OFF"})  # nothing is lost if a test folder is
    rows = [(office.layers[part.kind], line) for part in office.facade.parts for line in lines_of(office, part)]
    rows += [(_AXES, line) for line, _, _ in _grid(office)]
    for layer in dict.fromkeys(layer for layer, _ in rows):
        lines = np.array([shapely.LineString(line[:, : 2 + (not office.flat)]) for name, line in rows if name == layer])
        pyogrio.raw.write(
            path, shapely.to_wkb(lines, output_dimension=2 if office.flat else 3, flavor="iso"),
            [np.arange(len(lines))], ["n"], layer=layer, driver="GPKG",
            geometry_type="LineString" if office.flat else "LineString Z", crs='LOCAL_CS["Undefined Cartesian SRS"]',
            append=path.exists(),
        )  # fmt: skip


def write_dxf(office: Office, path: Path) -> None:
    """Model space with the facade, dimensions, axes, marks; paper space with title block and viewport."""
    document = ezdxf.new(office.version)
    if office.version == "R12":  # which has none
        document.header["$INSUNITS"] = 0
    else:
        document.header["$INSUNITS"] = _HEADER[office.unit] if office.header is None else office.header
    model = document.modelspace()
    for number, part in enumerate(office.facade.parts):
        _feature(office, document, model, part, number)
    for line, name, at in _grid(office):
        model.add_line(line[0], line[1], dxfattribs={"layer": _AXES})
        model.add_text(name, dxfattribs={"layer": _AXES, "height": 0.2 / METRES[office.unit], "insert": at})
    _marks(office, document, model)
    if office.lettering:
        _dimensions(office, model)
    _sheet(office, document)
    document.saveas(path)


def _units(office: Office, sheet: Any) -> np.ndarray:
    return np.round(office.place(np.asarray(sheet)) / METRES[office.unit], 9)


def _feature(office: Office, document: Any, model: Any, part: Part, number: int) -> None:
    lines, attributes = lines_of(office, part), {"layer": office.layers[part.kind]}
    if not office.blocks or part.kind not in {"window", "door"}:
        for line in lines:
            _draw(office, model, line, attributes)
        return
    base, size = lines[0][0], lines[0][2] - lines[0][0]
    if office.blocks == "own":
        block = document.blocks.new(f"{part.kind.upper()}_{number}")
        for line in lines:
            _draw(office, block, line - base, {"layer": "0"})
        model.add_blockref(block.name, base, dxfattribs=attributes)
        return
    name = f"{part.kind.upper()}_1X1"
    across = np.where(np.abs(size) > 0, size, 1.0)  # the facade has no extent along its depth
    if name not in document.blocks:
        block = document.blocks.new(name)
        for spots in (np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]), [(0.5, 0), (0.5, 1)], [(0, 0.6), (1, 0.6)]):
            flat = np.column_stack([np.asarray(spots, dtype=float), np.zeros(len(spots))])
            _draw(office, block, np.abs(flat @ FRAMES[office.plane]), {"layer": "0"})
    scales = dict(zip(("xscale", "yscale", "zscale"), across.tolist(), strict=True))
    model.add_blockref(name, base, dxfattribs={**attributes, **scales})


def _draw(office: Office, where: Any, line: np.ndarray, attributes: dict[str, Any]) -> None:
    closed = len(line) > 2
    if not closed:
        where.add_line(line[0], line[1], dxfattribs=attributes)
    elif not office.flat:
        where.add_polyline3d(line[:-1], close=True, dxfattribs=attributes)
    elif office.version == "R12":
        where.add_polyline2d(line[:-1, :2], close=True, dxfattribs=attributes)
    else:
        where.add_lwpolyline(line[:-1, :2], close=True, dxfattribs=attributes)


def _grid(office: Office) -> list[tuple[np.ndarray, str, np.ndarray]]:
    """Axes between columns of windows, with the places of their names."""
    if not office.axes:
        return []
    columns, top = office.facade.columns, office.facade.height + 2.5
    middles = [(b + a) / 2 for (_, b), (a, _) in pairwise(columns)][::2]
    return [
        (_units(office, [(u, -1.2, 0), (u, top, 0)]), str(n + 1), _units(office, [(u, -1.6, 0)])[0])
        for n, u in enumerate(middles)
    ]


def _marks(office: Office, document: Any, model: Any) -> None:
    metre = 1.0 / METRES[office.unit]
    for mark in office.by_id:
        at = np.round(mark.place * metre, 9)
        if mark.block:
            if "ALVO" not in document.blocks:
                block = document.blocks.new("ALVO")
                block.add_circle((0, 0), 0.03 * metre)
                block.add_attdef("ID", (0.05 * metre, 0), dxfattribs={"height": 0.05 * metre})
            target = model.add_blockref("ALVO", at, dxfattribs={"layer": "ALVOS"})
            target.add_attrib("ID", mark.name, at + 0.05 * metre, dxfattribs={"height": 0.05 * metre})
        else:
            model.add_point(at, dxfattribs={"layer": "ALVOS"})
            beside = at + np.array([0.04, 0.03, 0.0]) @ FRAMES[office.plane] * metre
            model.add_text(mark.name, dxfattribs={"layer": "ALVOS", "height": 0.05 * metre, "insert": beside})


def _dimensions(office: Office, model: Any) -> None:
    """Widths of the openings of the ground floor and of the whole, lettered in the office's unit."""
    ucs = ezdxf.math.UCS(ux=FRAMES[office.plane][0], uy=FRAMES[office.plane][1])
    for a, b in [*office.facade.columns, (0.0, office.facade.width)]:
        first, second, base = (
            ucs.from_wcs(ezdxf.math.Vec3(spot)) for spot in _units(office, [(a, 0, 0), (b, 0, 0), (a, -0.8, 0)])
        )
        length = (b - a) / METRES[office.lettering]
        text = f"{length:.2f}".replace(".", ",") if office.lettering == "m" else f"{length:.0f}"
        text += office.letter_suffix
        style = {"dimtxt": 0.1 / METRES[office.unit], "dimasz": 0.1 / METRES[office.unit]}
        # CAD writes what it measured; ezdxf does not, and measures zero across the x axis.
        attributes = {"layer": "COTAS", "actual_measurement": (b - a) / METRES[office.unit]}
        model.add_linear_dim(
            base=base, p1=first, p2=second, text=text, override=style, dxfattribs=attributes
        ).render(ucs=ucs)  # fmt: skip


def _sheet(office: Office, document: Any) -> None:
    """Paper in millimetres: title block, and the window on the facade."""
    stated = office.scale
    if office.version == "R12":
        if office.title:
            spot = _units(office, [(0, -3.5, 0)])[0]
            document.modelspace().add_text(
                f"FACHADA - ESC. 1:{office.title_scale or stated:g}",
                dxfattribs={"layer": "CARIMBO", "height": 0.2 / METRES[office.unit], "insert": spot},
            )
        return
    paper = document.paperspace()
    if office.title:
        paper.add_lwpolyline([(10, 10), (190, 10), (190, 60), (10, 60)], close=True, dxfattribs={"layer": "CARIMBO"})
        text = f"ESCALA 1:{office.title_scale or stated:g}"
        paper.add_text(text, dxfattribs={"layer": "CARIMBO", "height": 3, "insert": (20, 20)})
    high = (office.facade.height + 4) / (office.view_scale or stated) * 1000
    paper.add_viewport(
        center=(400, 300), size=(2 * high, high), view_center_point=(0, 0),
        view_height=(office.facade.height + 4) / METRES[office.unit],
    )  # fmt: skip
