# SPDX-License-Identifier: MIT
"""The one table of all findings, as columns."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from foparq.findings.hits import Geometries, Reals

Texts = NDArray[np.object_]
Flags = NDArray[np.bool_]


class Severity(StrEnum):
    """How much a finding weighs; the profile decides. A note is information, not a fault."""

    CRITICAL = "critical"
    MAJOR = "major"
    MINOR = "minor"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Findings:
    """Every finding of one audit, n rows, ordered by (source, rule, layer, item, key)."""

    key: Texts  #: (n,) stable between deliveries: rule, layer, items and rounded place
    rule: Texts  #: (n,) code
    name: Texts  #: (n,)
    severity: Texts  #: (n,) value of :class:`Severity`
    source: Texts  #: (n,) path of the file
    layer: Texts  #: (n,)
    item: Texts  #: (n,) item id in the file; ``""`` if the finding is about the file
    handle: Texts  #: (n,) as written in the file
    inserts: Texts  #: (n,) chain of block inserts
    other: Texts  #: (n,) item id of the second item; ``""`` if none
    where: Geometries  #: (n,) place in the coordinates and units of the file
    sheet: Geometries  #: (n,) the same place in the drawing's plane, metres
    size: Reals  #: (n,) magnitude
    unit: Texts  #: (n,) unit of the magnitude: ``"m"``, ``"m2"``, ``"items"``
    limit: Reals  #: (n,) the tolerance that was exceeded, in the same unit; NaN if none
    waived: Flags  #: (n,)

    def __len__(self) -> int:
        return len(self.key)


def no_findings() -> Findings:
    """Findings of an audit that found nothing."""
    return Findings(**{field.name: np.empty(0, dtype=_DTYPES.get(field.name, object)) for field in fields(Findings)})


def join_findings(tables: Sequence[Findings]) -> Findings:
    """One table of several, in the defined order."""
    if not tables:
        return no_findings()
    columns = {
        field.name: np.concatenate([getattr(table, field.name) for table in tables]) for field in fields(Findings)
    }
    order = sorted(
        range(len(columns["key"])),
        key=lambda n: (
            columns["source"][n],
            columns["rule"][n],
            columns["layer"][n],
            columns["item"][n],
            columns["key"][n],
        ),
    )
    return Findings(**{name: column[order] for name, column in columns.items()})


def finding_key(rule: str, layer: str, items: tuple[str, ...], place: tuple[float, ...], grid: float) -> str:
    """Key of a finding that stays the same between deliveries and orders of items.

    Parameters
    ----------
    rule : str
        Code.
    layer : str
    items : tuple of str
        Ids of the items involved, in any order.
    place : tuple of float
        Where, in any unit.
    grid : float
        Cell of rounding, in that unit: well above the noise of coordinates, well below the distance of two findings.

    Returns
    -------
    str
        ``"TOP021-1a2b3c4d5e"``.
    """
    cells = [round(value / grid) if np.isfinite(value) else 0 for value in place]
    text = "\x1f".join([rule, layer, *sorted(items), *map(str, cells)])
    return f"{rule}-{hashlib.sha256(text.encode()).hexdigest()[:10]}"


_DTYPES: dict[str, type] = {"size": float, "limit": float, "waived": bool}
