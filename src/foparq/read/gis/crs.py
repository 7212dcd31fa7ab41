# SPDX-License-Identifier: MIT
"""What one drawing unit is, told from a coordinate reference system."""

import math
from dataclasses import dataclass

import numpy as np
import pyproj
from pyproj.exceptions import CRSError, ProjError

from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.units import LENGTHS, parse_length_unit

_DEGREES = (180.0, 90.0)  #: farthest from zero that a longitude and a latitude can be
_DEGREE = 6_371_008.8 * math.pi / 180  #: metres of latitude on the mean sphere of GRS 80: against what is stated
_STEP = 100.0  #: metres on the projection: far above rounding, and (step / earth radius)^2 far below any use
_UNDEFINED = "undefined"  #: how GeoPackage names what is no system; any other name says what its axes say


@dataclass(frozen=True, slots=True, kw_only=True)
class _Said:
    """What the file itself says of its unit."""

    header: str = ""
    metres: float | None = None
    name: str = ""
    stretch: float = 1.0
    known: bool = False  #: a unit is said, be it of length or of angle


def unit_of(systems: tuple[str, ...], bounds: tuple[float, float, float, float], stated: str | None) -> DrawingUnit:
    """Unit of a drawing.

    Parameters
    ----------
    systems : tuple of str
        Reference systems of the layers that hold items, distinct: ``"EPSG:31982"`` or well-known text; ``""`` for a
        layer without one.
    bounds : tuple = (xmin, ymin, xmax, ymax)
        Of all items, in drawing units; NaN if there are none.
    stated : str, optional
        Unit as the manifest or ``--unit`` states it. It wins; what the file says is kept beside it.

    Returns
    -------
    DrawingUnit
        Unknown if the layers have different systems, none, or a local one that is called undefined. Degrees are no
        length: ``metres`` is ``None``. Degrees beyond 180 or 90 are not believed.

    Raises
    ------
    QuantityError
        If the stated unit is not known.

    Notes
    -----
    The stretch is the square root of the areal scale factor at the middle of the bounds; for conformal projections
    that is the scale of lengths. It is measured: geodesics on the ellipsoid (Karney 2013, by PROJ) between the images
    of four points 100 m from the middle. PROJ's own factors are not used: for EPSG:3857 they hold on the sphere, and
    differ by up to 0.3 % from the ellipsoid.
    """
    said = (
        _said(systems[0], bounds)
        if len(systems) == 1
        else _Said(header=", ".join(describe(text) for text in systems if text))
    )
    if stated is not None:
        # Layers in different systems lie elsewhere from each other, whatever their unit is.
        metres = parse_length_unit(stated) if len(systems) <= 1 else None
        return DrawingUnit(
            metres=metres, name=stated, origin=UnitOrigin.STATED,
            header=said.header, header_metres=_DEGREE if said.name == "degree" else said.metres, stretch=said.stretch,
        )  # fmt: skip
    return DrawingUnit(
        metres=said.metres, name=said.name, origin=UnitOrigin.HEADER if said.known else UnitOrigin.UNKNOWN,
        header=said.header, header_metres=said.metres, stretch=said.stretch,
    )  # fmt: skip


def describe(text: str) -> str:
    """Short name of a reference system: ``"EPSG:31982"``, else the name in its well-known text."""
    if not text or text.startswith("EPSG:"):
        return text
    try:
        return str(pyproj.CRS.from_user_input(text).name)
    except CRSError:
        return text[:40]


def _said(text: str, bounds: tuple[float, float, float, float]) -> _Said:
    if not text:
        return _Said()
    try:
        system = pyproj.CRS.from_user_input(text)
    except CRSError:
        return _Said(header=text[:40])
    if system.name.casefold().startswith(_UNDEFINED) or not system.axis_info:
        return _Said()
    if not system.axis_info[0].unit_conversion_factor:
        return _Said()
    if system.is_geographic:
        x, y = np.abs(np.nan_to_num(np.array(bounds).reshape(2, 2))).max(axis=0)
        believed = x <= _DEGREES[0] and y <= _DEGREES[1]
        return _Said(header="degree", name="degree" if believed else "", known=bool(believed))
    axis = system.axis_info[0]
    metres = float(axis.unit_conversion_factor)
    return _Said(
        header=describe(text),
        metres=metres,
        name=_name(metres, axis.unit_name),
        stretch=_stretch(system, metres, bounds),
        known=True,
    )


def _name(metres: float, spelled: str) -> str:
    return next((name for name, length in LENGTHS.items() if math.isclose(length, metres, rel_tol=1e-9)), spelled)


def _stretch(system: pyproj.CRS, metres: float, bounds: tuple[float, float, float, float]) -> float:
    if not system.is_projected or system.geodetic_crs is None or not np.isfinite(bounds).all():
        return 1.0
    x, y = (bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2
    step = _STEP / metres
    try:
        to_degrees = pyproj.Transformer.from_crs(system, system.geodetic_crs, always_xy=True)
        longitude, latitude = to_degrees.transform(
            [x - step, x + step, x, x], [y, y, y - step, y + step], errcheck=True
        )
    except (ProjError, CRSError):
        return 1.0
    geod = system.geodetic_crs.get_geod()
    if geod is None or not np.isfinite([*longitude, *latitude]).all():
        return 1.0
    azimuth, _, length = geod.inv(longitude[::2], latitude[::2], longitude[1::2], latitude[1::2])
    right, up = (
        size / (2 * _STEP) * np.exp(1j * np.radians(angle)) for size, angle in zip(length, azimuth, strict=True)
    )
    area = abs((np.conj(right) * up).imag)
    return float(1 / math.sqrt(area)) if area > 0 else 1.0
