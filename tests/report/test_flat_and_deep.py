# SPDX-License-Identifier: MIT
"""Depth of places in ``findings.gpkg``, which is flat, and strokes of fractional length in a toned picture."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyogrio
import pytest
import shapely

from foparq.findings.table import Findings
from foparq.model.drawing import Drawing
from foparq.report.findings_gpkg import write_findings_gpkg
from foparq.report.page.paths import Strokes, density
from foparq.report.record import AuditRecord

Plant = Callable[..., Findings]


@pytest.mark.parametrize(
    ("places", "kind"),
    [
        ([shapely.Point(1, 2)], "Point"), ([shapely.Point(1, 2, 3)], "Point"),
        ([shapely.Point(1, 2), shapely.Point(1, 2, 3)], "Point"),
        ([shapely.Point(1, 2), shapely.MultiPoint([(1, 2), (3, 4)])], "MultiPoint"),
    ],
)  # fmt: skip
def test_depth_is_a_column(
    rejected: AuditRecord, drawing: Drawing, plant: Plant, tmp_path: Path, places: list[shapely.Geometry], kind: str
) -> None:
    findings = plant(drawing, "TOP011", "undershoot", [(str(n), "0", place, 0.1) for n, place in enumerate(places)])
    write_findings_gpkg(replace(rejected, findings=findings), tmp_path / "findings.gpkg")
    assert dict(pyogrio.list_layers(tmp_path / "findings.gpkg"))["flags_p"] == kind


@pytest.mark.parametrize("length", [0.4, 1.5, 2.9, 3.0, 7.4])
def test_a_stroke_of_any_length_leaves_no_pixel_out(length: float) -> None:
    tone = density(Strokes(np.array([[0.0, 1.0], [length, 1.0]]), np.zeros(2, dtype=np.intp), np.arange(1)), 10, 3)
    dark = np.flatnonzero(tone[1] < 255)
    assert dark.tolist() == list(range(round(length) + 1))
