# SPDX-License-Identifier: MIT
"""What a DXF file says of its unit: the header, and the lettering of its dimensions."""

import math
from dataclasses import dataclass
from typing import Any

from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.lettering import lettered_length
from foparq.read.dxf.curves import Point
from foparq.read.dxf.facts import LEAKS, MalformedError
from foparq.read.dxf.text import override_text, rendered_text
from foparq.units import LENGTHS, parse_length_unit

_SURVEY_FOOT = 1200 / 3937

#: $INSUNITS of the DXF reference: name and metres in one unit; 0 says nothing
_INSERT_UNITS: dict[int, tuple[str, float]] = {
    1: ("in", LENGTHS["in"]), 2: ("ft", LENGTHS["ft"]), 3: ("mi", 1609.344), 4: ("mm", 1e-3), 5: ("cm", 1e-2),
    6: ("m", 1.0), 7: ("km", 1e3), 8: ("µin", 2.54e-8), 9: ("mil", 2.54e-5), 10: ("yd", LENGTHS["yd"]),
    11: ("Å", 1e-10), 12: ("nm", 1e-9), 13: ("µm", 1e-6), 14: ("dm", 0.1), 15: ("dam", 10.0), 16: ("hm", 100.0),
    17: ("Gm", 1e9), 18: ("au", 149597870700.0), 19: ("ly", 9460730472580800.0), 20: ("pc", 3.0856775814913673e16),
    21: ("ftUS", _SURVEY_FOOT), 22: ("inUS", _SURVEY_FOOT / 12), 23: ("ydUS", _SURVEY_FOOT * 3),
    24: ("miUS", _SURVEY_FOOT * 5280),
}  # fmt: skip

_LINEAR, _ALIGNED = 0, 1  # dimension types of the DXF reference


@dataclass(frozen=True, slots=True)
class Lettered:
    """A linear dimension whose lettering states a length."""

    measured: float  #: drawing units of the space it stands in
    text: str
    handle: str
    point: Point


def drawing_unit(header: Any, stated: str | None) -> DrawingUnit:  # noqa: ANN401 - ezdxf.HeaderSection
    """Unit as the user states it, else as the header does, else unknown.

    Raises
    ------
    QuantityError
        If the stated unit is not known.
    """
    try:
        code = int(header.get("$INSUNITS", 0))
    except LEAKS:
        code = 0
    name, metres = _INSERT_UNITS.get(code, ("", None))
    if stated is not None:
        return DrawingUnit(
            metres=parse_length_unit(stated),
            name=stated.strip(),
            origin=UnitOrigin.STATED,
            header=name,
            header_metres=metres,
        )
    origin = UnitOrigin.HEADER if metres is not None else UnitOrigin.UNKNOWN
    return DrawingUnit(metres=metres, name=name, origin=origin, header=name, header_metres=metres)


def lettered_dimension(entity: Any, handle: str) -> Lettered | None:  # noqa: ANN401
    """Linear dimension whose lettering states a length of its own; ``None`` for any other.

    Parameters
    ----------
    entity : ezdxf DIMENSION

    Returns
    -------
    Lettered or None
        A lettering that replaces the measured length counts, also a number alone. One that the program made from the
        measured length counts only if it names a unit: feet and inches, metres.

    Raises
    ------
    MalformedError
        If the dimension is damaged.
    """
    try:
        if entity.dimtype not in (_LINEAR, _ALIGNED):
            return None
        x, y, z = entity.dxf.get("text_midpoint", entity.dxf.defpoint).xyz
        measured = entity.dxf.get("actual_measurement")
        if measured is None or not measured > 0:
            measured = entity.get_measurement()
        measured = float(measured)
        override = override_text(entity.dxf.get("text", ""))
        texts = [override] if override else _rendered(entity)
    except LEAKS as error:
        raise MalformedError(str(error)) from error
    if not 0 < measured < math.inf:
        return None
    for text in texts:
        metres, number = lettered_length(text)
        if metres or (override and number):
            return Lettered(measured, text, handle, (float(x), float(y), float(z)))
    return None


def _rendered(entity: Any) -> list[str]:  # noqa: ANN401
    if entity.dxf.get("text", "").strip() not in ("", "<>") and "<>" not in entity.dxf.text:
        return []
    block = entity.get_geometry_block()
    return [rendered_text(part) for part in block or () if part.dxftype() in ("MTEXT", "TEXT")]
