# SPDX-License-Identifier: MIT
"""Helpers for tests of the DXF reader."""

from pathlib import Path
from typing import Any

import ezdxf

from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf
from foparq.read.raw import RawDrawing

SAGITTA = 1e-4  #: metres


def read(path: Path, **options: Any) -> RawDrawing:
    asked = {"limits": LimitsSpec(), "sagitta": SAGITTA, "unit": None, "blocks": "explode", **options}
    return read_dxf(path, **asked)


def new(version: str = "R2010", insunits: int = 6) -> Any:
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = insunits
    return document


def read_back(document: Any, folder: Path, **options: Any) -> RawDrawing:
    path = folder / "drawing.dxf"
    document.saveas(path)
    return read(path, **options)


def skipped(drawing: RawDrawing) -> dict[tuple[str, str], int]:
    found: dict[tuple[str, str], int] = {}
    for entry in drawing.reading.skipped:
        found[entry.reason, entry.kind] = found.get((entry.reason, entry.kind), 0) + entry.count
    return found
