# SPDX-License-Identifier: MIT
"""Types of DXF entities, by what the audit makes of them."""

from dataclasses import dataclass

from foparq.model.drawing import SkippedReason


@dataclass(frozen=True, slots=True)
class Unseen:
    """An entity that becomes no item."""

    reason: SkippedReason
    name: str = ""  #: block or reference that is not there


#: entity types that become no item
UNSEEN: dict[str, SkippedReason] = {
    **dict.fromkeys(
        ("3DSOLID", "BODY", "REGION", "MESH", "SURFACE", "EXTRUDEDSURFACE", "LOFTEDSURFACE", "REVOLVEDSURFACE",
         "SWEPTSURFACE", "PLANESURFACE", "NURBSURFACE"),
        SkippedReason.SURFACE,
    ),
    **dict.fromkeys(("PDFUNDERLAY", "DWFUNDERLAY", "DGNUNDERLAY", "PDFREFERENCE"), SkippedReason.UNDERLAY),
    **dict.fromkeys(("RAY", "XLINE"), SkippedReason.INFINITE_LINE),
    **dict.fromkeys(("OLE2FRAME", "OLEFRAME"), SkippedReason.OLE),
    "ACAD_PROXY_ENTITY": SkippedReason.PROXY,
    "IMAGE": SkippedReason.IMAGE,
    "MLINE": SkippedReason.MULTILINE,
    "VIEWPORT": SkippedReason.VIEWPORT,
    "WIPEOUT": SkippedReason.WIPEOUT,
}  # fmt: skip

#: lettering, dimensions and their kin
ANNOTATIONS = frozenset({
    "TEXT", "MTEXT", "ATTRIB", "ATTDEF", "SHAPE", "TOLERANCE", "ACAD_TABLE", "DIMENSION", "ARC_DIMENSION",
    "LARGE_RADIAL_DIMENSION", "LEADER", "MULTILEADER", "MLEADER",
})  # fmt: skip

#: entity types that become items, and whose edges no rule sees; SOLID and TRACE fill the plane, like a hatch
FACES = frozenset({"3DFACE"})
