# SPDX-License-Identifier: MIT
"""Places and items as other programs take them: coordinates for CAD, a line for AutoCAD, a filter for QGIS."""

import json
import re
from collections.abc import Sequence
from pathlib import PurePosixPath

import numpy as np

from foparq.columns import Index, Reals
from foparq.report.record import AuditRecord

_DECIMALS = 4  #: of a metre: a tenth of a millimetre on the object
_MOST = 8  #: decimals that are written, however large a drawing unit is
_APART = re.compile(r"[/:.~]")  #: what a name adds to a handle: inserts, cells of an array, parts, repetitions
_HANDLE = re.compile(r"[0-9A-Fa-f]{1,16}")


def decimals_of(metres: float | None) -> int:
    """Decimals that show a tenth of a millimetre on the object; as of metres where the unit is unknown."""
    return _DECIMALS if metres is None else int(np.clip(round(_DECIMALS + np.log10(metres)), 0, _MOST))


def pasted(place: Sequence[float] | Reals, metres: float | None = 1.0) -> str:
    """Place as CAD programs take it at the command line: decimal points in every language.

    Parameters
    ----------
    place : (3,)
        In the coordinates of the file. A depth that is no number is nought.
    metres : float or None
        Metres in one drawing unit; ``None`` if unknown.

    Returns
    -------
    str
        ``""`` for what is no place.

    Examples
    --------
    >>> pasted((104.5, 53.5, float("nan")))
    '104.5,53.5,0'
    """
    x, y, *depth = (float(value) for value in place)
    if not np.isfinite([x, y]).all():
        return ""
    z = depth[0] if depth and np.isfinite(depth[0]) else 0.0
    return ",".join(_plain(value, decimals_of(metres)) for value in (x, y, z))


def _plain(value: float, decimals: int) -> str:
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def cad_line(handles: Sequence[str]) -> str:
    """Line for the command line of AutoCAD that shows items and selects nothing: zoom to objects by their handles.

    Examples
    --------
    >>> cad_line(["A8"])
    '(command "_.ZOOM" "_O" (handent "A8") "")'
    """
    found = " ".join(f"(handent {json.dumps(handle)})" for handle in handles)
    return f'(command "_.ZOOM" "_O" {found} "")' if handles else ""


def qgis_filter(field: str, values: Sequence[str]) -> str:
    r"""Expression of QGIS that is true of items.

    Examples
    --------
    >>> qgis_filter("EntityHandle", ["A8", "B2"]), qgis_filter("$id", ["12"])
    ('"EntityHandle" IN (\'A8\', \'B2\')', '$id = 12')
    """
    known = list(dict.fromkeys(values))
    if not known:
        return ""
    name = field if field.startswith("$") else f'"{field}"'
    shown = known if field.startswith("$") else ["'" + value.replace("'", "''") + "'" for value in known]
    return f"{name} = {shown[0]}" if len(shown) == 1 else f"{name} IN ({', '.join(shown)})"


def found_by(record: AuditRecord, rows: Index) -> tuple[list[str], list[str]]:
    """How to find the items of findings in AutoCAD and in QGIS.

    A thing inside a block is reached through the insert at top level: that has a handle of its own in the drawing.

    Parameters
    ----------
    rows : (k,) int
        Rows of the findings.

    Returns
    -------
    cad, qgis : list of str, k
        ``""`` where the file gives its items no handle, or the finding names no item.
    """
    table = record.findings
    cad, qgis = [], []
    meshes = {mesh.path for mesh in record.delivery.meshes}  # numbers of faces: neither program knows them
    columns = (getattr(table, name)[rows].tolist() for name in ("source", "item", "handle", "inserts", "other"))
    for source, item, handle, inserts, other in zip(*columns, strict=True):
        if source in meshes:
            cad.append("")
            qgis.append("")
            continue
        if PurePosixPath(source).suffix.casefold() == ".dxf":
            tops = _tops(item, handle, inserts, other)
            cad.append(cad_line(tops))
            qgis.append(qgis_filter("EntityHandle", tops))
            continue
        own = _APART.split(item.rpartition(":")[2])[0] == handle
        cad.append("")
        named = item and (own or _HANDLE.fullmatch(handle))
        qgis.append(qgis_filter("$id" if own else "EntityHandle", [handle]) if named else "")
    return cad, qgis


def _tops(item: str, handle: str, inserts: str, other: str) -> list[str]:
    """Handles at top level of an item and the other one: what AutoCAD and QGIS can go to."""
    if not handle or not item:
        return []
    tops = [_APART.split(name)[0] for name in (inserts or handle, other)]
    return [top for top in dict.fromkeys(tops) if _HANDLE.fullmatch(top)]
