# SPDX-License-Identifier: MIT
"""Attacks on what a manifest states: unit, plane, scale, reference system."""

from pathlib import Path

import ezdxf
import numpy as np
import pyogrio
import shapely
from tests.attacks.evidence import IN_SPACE
from tests.attacks.kinds import CLEAR, DXF, TOLD, attack
from tests.tools.offices import FRAMES, METRES, Office

_UNIT = ("checks.unit-contradicted", "features.unit-contradicted")
_PLANE = ("checks.plane-contradicted", "features.plane-contradicted", "checks.plane-doubtful")
MODERN = {**DXF, "version": "R2013"}  #: R12 has no header of units, and no paper
_CODES = {"m": 6, "mm": 4, "cm": 5, "in": 1, "ft": 2}


def _other(unit: str, rng: np.random.Generator, among: tuple[str, ...] = ("m", "mm", "cm", "in", "ft")) -> str:
    return str(rng.choice([name for name in among if name != unit]))


@attack("unit of the table wrong", "evidence.cause-unit", "evidence.cause-unit-axes", office=CLEAR)
def _table(office: Office, rng: np.random.Generator) -> Office:
    other = _other(office.table_unit, rng)
    return office.state("checkpoints", unit=other).state("distances", unit=other)


@attack("unit of the distances wrong", "evidence.distance-factor", office={**CLEAR, "ends_by": "checkpoints"})
def _distances(office: Office, rng: np.random.Generator) -> Office:
    return office.state("distances", unit=_other(office.table_unit, rng))


@attack(
    "unit of distances by name wrong", "evidence.too-long", "evidence.too-short", office={**CLEAR, "ends_by": "names"}
)
def _named_distances(office: Office, _: np.random.Generator) -> Office:
    return office.state("distances", unit="mm" if office.table_unit == "m" else "m")


@attack("unit of the drawing wrong, against header and extent", *_UNIT, office={**MODERN, "unit": "m", "lettering": ""})
def _extent(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", unit=str(rng.choice(["mm", "km"])))


@attack("unit of the drawing wrong, against header and tables", *_UNIT, office={**MODERN, "lettering": ""})
def _against_tables(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", unit=_other(office.unit, rng))


@attack(
    "unit of the drawing wrong, against lettering and tables", *_UNIT,
    office={**MODERN, "unit": "m", "lettering": "cm", "header": 0},
)  # fmt: skip
def _against_lettering(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", unit=_other(office.unit, rng))


@attack(
    "unit of the drawing wrong, against the tables alone", *_UNIT,
    office={**MODERN, "lettering": "", "header": 0, "digits": 4},
)  # fmt: skip
def _tables_alone(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", unit=_other(office.unit, rng, ("m", "cm", "in", "ft")))


@attack("header alone against all", verdict="accepted", office=MODERN)
def _header(office: Office, rng: np.random.Generator) -> Office:
    return office.change(header=_CODES[_other(office.unit, rng)])


def _stray(office: Office, folder: Path) -> None:
    document = ezdxf.readfile(folder / "fachada.dxf")
    start = office.place([0, 0, 0]) / METRES[office.unit]
    document.modelspace().add_line(start + 250.0, start + 250.3)
    document.saveas(folder / "fachada.dxf")


@attack(
    "a stray line 250 units away, and a wrong unit", *_UNIT,
    office={**MODERN, "unit": "m", "lettering": ""},
)  # fmt: skip
def _with_stray(office: Office, _: np.random.Generator) -> Office:
    # Without the table its word is missing: extent and header are left.
    return office.change(tamper=(_stray,)).state("drawing", unit="mm").state("checkpoints", path=None)


@attack(
    "distances of 150 m beside a stray line",
    "evidence.too-long",
    office={**DXF, "unit": "m", "ends_by": "names", "digits": 4},
)
def _long_with_stray(office: Office, rng: np.random.Generator) -> Office:
    # Of three digits throughout nothing here proves that they are decimals: lengths in m and in mm are both too long.
    longer = 150 + rng.uniform(0, 20, len(office.lengths))
    return office.change(measured=office.measured + longer, lengths=office.lengths + longer, tamper=(_stray,))


@attack("plane wrong", *_PLANE, office=IN_SPACE)
def _plane(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", plane=str(rng.choice(["xy", "yz"])))


@attack("plane wrong, side facade", *_PLANE, office={**TOLD, "plane": "yz"})
def _side_plane(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", plane=str(rng.choice(["xy", "xz"])))


def _turned(office: Office, degrees: float) -> list[list[float]]:
    """A plane by its axes, turned about the upright one."""
    right, up, depth = FRAMES[office.plane]
    turn = np.radians(degrees)
    return [office.origin.tolist(), (right * np.cos(turn) + depth * np.sin(turn)).tolist(), up.tolist()]


@attack("plane by its axes wrong", *_PLANE, office=IN_SPACE)
def _plane_by_axes(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", plane=_turned(office, float(rng.choice([-1, 1]) * rng.uniform(55, 125))))


@attack("plane by its axes right", verdict="accepted", office=IN_SPACE)
def _right_axes(office: Office, _: np.random.Generator) -> Office:
    return office.state("drawing", plane=_turned(office, 0.0))


@attack("flat drawing stated as an elevation", *_PLANE, office={**TOLD, "plane": "xy"})
def _flat_plane(office: Office, rng: np.random.Generator) -> Office:
    return office.state("drawing", plane=str(rng.choice(["xz", "yz"])))


@attack("scale beyond those of the product", "scale.unusual", office=DXF)
def _scale(office: Office, rng: np.random.Generator) -> Office:
    scale = float(rng.choice([0.5, 250, 500, 1000]))
    return office.change(title_scale=scale, view_scale=scale).state("delivery", scale=f"1:{scale:g}")


@attack("title block and viewport at another scale", "scale.contradicted", office={**MODERN, "title": True})
def _other_scale(office: Office, rng: np.random.Generator) -> Office:
    other = float(rng.choice([scale for scale in (10, 20, 50, 100, 200) if scale != office.scale]))
    return office.change(title_scale=other, view_scale=other)


@attack(
    "title block alone at another scale", "scale.contradicted", verdict="accepted", office={**MODERN, "title": True}
)
def _title(office: Office, _: np.random.Generator) -> Office:
    return office.change(title_scale=500.0)


@attack("two drawings alike in inches and centimetres", *_UNIT, office={**DXF, "unit": "cm", "lettering": ""})
def _inches(office: Office, _: np.random.Generator) -> Office:
    def copied(_: Office, folder: Path) -> None:
        (folder / "andar2.dxf").write_bytes((folder / "fachada.dxf").read_bytes())

    second = {"path": "andar2.dxf", "unit": "in", "plane": office.plane, "facade": "S"}
    return office.change(header=0, tamper=(copied,)).state("drawings", second=second)


def _geographic(move: np.ndarray, spread: float) -> object:
    def rewritten(_: Office, folder: Path) -> None:
        path = folder / "fachada.gpkg"
        for layer in pyogrio.list_layers(path)[:, 0]:
            _, _, geometry, _ = pyogrio.raw.read(path, layer=layer)
            lines = shapely.transform(shapely.from_wkb(geometry), lambda xy: xy * spread + move)
            new = folder / "nova.gpkg"
            pyogrio.raw.write(
                new, shapely.to_wkb(lines), [np.arange(len(lines))], ["n"], layer=layer, driver="GPKG",
                geometry_type="LineString", crs="EPSG:4326", append=new.exists(),
            )  # fmt: skip
        (folder / "nova.gpkg").replace(path)

    return rewritten


FLAT_MAP = {**TOLD, "plane": "xy", "format": "gpkg", "unit": "m"}


@attack("EPSG:4326 with x = 1389", "checks.crs-unfit", "features.crs-unfit", office=FLAT_MAP)
def _unfit(office: Office, _: np.random.Generator) -> Office:
    return office.change(tamper=(_geographic(np.array([1389.0, 500.0]), 1.0),)).state("drawing", unit=None)


@attack("degrees", "checks.unit-angle", "features.unit-angle", office=FLAT_MAP)
def _degrees(office: Office, _: np.random.Generator) -> Office:
    return office.change(tamper=(_geographic(np.array([-46.6, -23.5]), 1e-5),)).state("drawing", unit=None)


@attack("degrees, stated in metres", *_UNIT, office=FLAT_MAP)
def _stated_degrees(office: Office, _: np.random.Generator) -> Office:
    return office.change(tamper=(_geographic(np.array([-46.6, -23.5]), 1e-5),))


@attack("metres under a system of degrees, as a program set it by default", verdict="accepted", office=FLAT_MAP)
def _default(office: Office, _: np.random.Generator) -> Office:
    return office.change(tamper=(_geographic(np.zeros(2), 1.0),))
