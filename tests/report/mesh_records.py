# SPDX-License-Identifier: MIT
"""Audits of meshes made by hand: a surface, and findings at places that are known."""

import re
import struct
import zlib
from base64 import b64decode
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from tests.mesh import files

from foparq.findings.table import Findings, finding_keys, join_findings
from foparq.geom.places import place_on
from foparq.model.drawing import DrawingUnit, UnitOrigin
from foparq.model.mesh import Mesh, MeshReading
from foparq.report.page.findings import Listing, listing_of
from foparq.report.record import AuditRecord

METRES = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)
UNKNOWN = DrawingUnit(metres=None, name="", origin=UnitOrigin.UNKNOWN)


def mesh_of(surface: files.Mesh, path: str = "busto.ply", *, unit: DrawingUnit = METRES, **stated: Any) -> Mesh:
    """A delivered mesh."""
    return Mesh(
        path=path, points=surface.points, corners=surface.corners, starts=surface.starts,
        group=np.zeros(surface.faces, dtype=np.intp), unit=unit,
        **{"groups": ("",), "reading": MeshReading(version="PLY"), **stated},
    )  # fmt: skip


def findings_at(
    places: Sequence[Any], severity: str = "major", path: str = "busto.ply", rule: str = "MSH012", layer: str = ""
) -> Findings:
    """Findings of one rule, each where it is said."""
    n = len(places)

    def column(value: str) -> np.ndarray:
        return np.full(n, value, dtype=object)

    where = np.empty(n, dtype=object)
    where[:] = places
    item = np.array([f"f{row}" for row in range(n)], dtype=object)
    spots = np.array([_on(shape) for shape in places]).reshape(-1, 3)
    return Findings(
        key=finding_keys(rule, column(layer), item, column(""), spots, 1e-6), rule=column(rule),
        name=column("non-manifold-edge"), severity=column(severity), source=column(path), layer=column(layer),
        item=item, handle=item.copy(), inserts=column(""), other=column(""), other_layer=column(""), where=where,
        sheet=where.copy(), place=spots, size=np.ones(n), unit=column("items"), limit=np.full(n, np.nan),
        told=column(""), waived=np.zeros(n, dtype=bool),
    )  # fmt: skip


def _on(shape: Any) -> np.ndarray:
    if shape is None:
        return np.full(3, np.nan)
    found: np.ndarray = place_on(np.array([shape], dtype=object))[0]
    return found


def record_of(base: AuditRecord, meshes: Sequence[Mesh], *findings: Findings, language: str = "en") -> AuditRecord:
    """The same audit, of meshes."""
    table = join_findings(list(findings))
    delivery = replace(base.delivery, parts=tuple(meshes))
    return replace(base, delivery=delivery, findings=table, outcomes=(), language=language)


def listed(base: AuditRecord, meshes: Sequence[Mesh], *findings: Findings) -> Listing:
    return listing_of(record_of(base, meshes, *findings))


def pixels_of(image: str) -> np.ndarray:
    """Pixels of a PNG with a palette and no filter, by ISO/IEC 15948."""
    data = b64decode(image)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        name, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(name + body)
        chunks[name] = body
        at += 12 + length
    width, height, depth, kind = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    assert (depth, kind) == (8, 3)
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8).reshape(height, width + 1)
    assert not lines[:, 0].any()
    colours: np.ndarray = np.frombuffer(chunks[b"PLTE"], dtype=np.uint8).reshape(-1, 3)[lines[:, 1:]]
    return colours


def data_of(text: str, number: int = 1) -> dict[str, str]:
    """What the page holds of one mesh for its script."""
    found = re.search(rf'<i hidden id="solid-data-{number}"(.*?)></i>', text, re.DOTALL)
    assert found
    return dict(re.findall(r' data-([a-z-]+)="([^"]*)"', found[1]))


def point(*place: float) -> Any:
    return shapely.Point(*place)
