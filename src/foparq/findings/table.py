# SPDX-License-Identifier: MIT
"""The one table of all findings, as columns."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import StrEnum
from typing import Any

import numpy as np

from foparq.columns import Flags, Geometries, Reals, Texts
from foparq.geom.packing import pack_geometry, pack_texts, unpack_geometry, unpack_texts


class Severity(StrEnum):
    """How much a finding weighs; the profile decides. A note is information, not a fault."""

    CRITICAL = "critical"
    MAJOR = "major"
    MINOR = "minor"
    NOTE = "note"


@dataclass(frozen=True, kw_only=True)
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
    other_layer: Texts  #: (n,) its layer
    where: Geometries  #: (n,) place in the coordinates and units of the file
    sheet: Geometries  #: (n,) the same place in the drawing's plane, metres
    place: Reals  #: (n, 3) one point to look at, on the fault, in the coordinates of the file; NaN if it has none
    size: Reals  #: (n,) magnitude
    unit: Texts  #: (n,) unit of the magnitude: ``"m"``, ``"m2"``, ``"items"``
    limit: Reals  #: (n,) the tolerance that was exceeded, in the same unit; NaN if none
    told: Texts  #: (n,) what the reader of the file says of it, as JSON: a repair; ``""`` if nothing
    waived: Flags  #: (n,)

    def __len__(self) -> int:
        return len(self.key)

    def __getstate__(self) -> dict[str, Any]:
        # Findings cross process borders: buffers instead of a million objects.
        state = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, column in state.items():
            if name in _GEOMETRIES:
                state[name] = pack_geometry(column)
            elif column.dtype == object:
                state[name] = pack_texts(column)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, column in state.items():
            unpack = unpack_geometry if name in _GEOMETRIES else unpack_texts if isinstance(column, tuple) else None
            object.__setattr__(self, name, unpack(column) if unpack else column)


def no_findings() -> Findings:
    """Findings of an audit that found nothing."""
    columns: dict[str, Any] = {
        field.name: np.empty(0, dtype=_DTYPES.get(field.name, object)) for field in fields(Findings)
    }
    return Findings(**{**columns, "place": np.empty((0, 3))})


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
    columns = {name: column[order] for name, column in columns.items()}
    columns["key"] = _told_apart(columns["key"].tolist())
    return Findings(**columns)


def _told_apart(keys: Sequence[str]) -> Texts:
    """Keys, numbered anew where several findings share one: of one drawing, or of two that are alike."""
    seen: dict[str, int] = {}
    unique = np.empty(len(keys), dtype=object)
    for n, key in enumerate(keys):
        bare = key[:_BARE]
        seen[bare] = seen.get(bare, 0) + 1
        unique[n] = bare if seen[bare] == 1 else f"{bare}-{seen[bare]}"
    return unique


def finding_keys(rule: str, layer: Texts, item: Texts, other: Texts, places: Reals, grid: float) -> Texts:
    """Keys of findings that stay the same between deliveries and orders of items.

    Parameters
    ----------
    rule : str
        Code.
    layer, item, other : (n,) str
        Layer and ids of the items involved; ``""`` for none. Which item is the other does not matter.
    places : (n, 3) float
        Where, in any unit; NaN for nowhere.
    grid : float
        Cell of rounding, in that unit: well above the noise of coordinates, well below the distance of two findings.

    Returns
    -------
    (n,) str
        ``"TOP021-1a2b3c4d5e"``. Findings that share a key are numbered: ``"TOP021-1a2b3c4d5e-2"``.
    """
    # A place absurdly far away is still a place: it stays within what an integer holds.
    # On a drawing in whole cells many a place lies halfway between two: noise must not decide there.
    halves = np.round(np.nan_to_num(places / grid), 3)
    cells = np.clip(np.rint(halves), -(2.0**62), 2.0**62).astype(np.int64).tolist()
    keys = []
    for on, one, two, cell in zip(layer, item, other, cells, strict=True):
        first, second = (two, one) if two < one else (one, two)
        text = f"{rule}\x1f{on}\x1f{first}\x1f{second}\x1f{cell}"
        keys.append(f"{rule}-{hashlib.blake2b(text.encode(), digest_size=5).hexdigest()}")
    return _told_apart(keys)


_BARE = len("TOP021-1a2b3c4d5e")  #: of a key before its number
_GEOMETRIES = frozenset({"where", "sheet"})
_DTYPES: dict[str, type] = {"size": float, "limit": float, "waived": bool}
