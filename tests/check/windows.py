# SPDX-License-Identifier: MIT
"""Facades whose windows anybody can count."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
import shapely.affinity
from ezdxf.document import Drawing as Document
from ezdxf.layouts import BaseLayout
from tests.evaluate.deliveries import drawn, judge, listed, spec

from foparq.check.drawn.features import count_features
from foparq.evaluate.quality import ElementStatus
from foparq.findings.counts import FeatureCounts
from foparq.model.drawing import Drawing, DrawingUnit, Reading, UnitOrigin
from foparq.model.items import Items, Role
from foparq.model.plane import plane_of
from foparq.profile.schema import LimitsSpec
from foparq.read.dxf.reader import read_dxf

PASS, FAIL, UNDECIDED = ElementStatus.PASS, ElementStatus.FAIL, ElementStatus.UNDECIDED
GAP = 0.01
METRES = DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED)
WINDOW = {"JANELA*": "window"}
PLACES = [((n % 10) * 3.0, (n // 10) * 4.0) for n in range(20)]


def frame(x: float, y: float, inset: float = 0.0) -> str:
    return shapely.box(x + inset, y + inset, x + 1 - inset, y + 1.5 - inset).exterior.wkt


def drawing(
    shapes: Sequence[str], *, layer: str | Sequence[str] = "JANELA", role: str = Role.LINE,
    holders: Sequence[str] | None = None, visible: Sequence[bool] | None = None, facade: str = "N",
    classes: dict[str, str] | None = None,
) -> Drawing:  # fmt: skip
    n = len(shapes)

    def column(values: Sequence[str]) -> np.ndarray:
        made = np.empty(n, dtype=object)
        made[:] = values
        return made

    geometry = column([shapely.from_wkt(shape) for shape in shapes])  # type: ignore[misc]
    items = Items(
        geometry=geometry, layer=column([layer] * n if isinstance(layer, str) else layer), kind=column(["LINE"] * n),
        role=column([role] * n), item=column([str(row) for row in range(n)]), handle=column([""] * n),
        inserts=column([""] * n), colour=np.full(n, 256, dtype=np.int32), closed=np.zeros(n, dtype=bool),
        visible=np.array([True] * n if visible is None else visible), paper=np.zeros(n, dtype=bool),
        holders=column(holders or [""] * n),
    )  # fmt: skip
    return Drawing(
        path="a.dxf", items=items, reading=Reading(), unit=METRES, plane=plane_of("xy", geometry), facade=facade,
        classes=WINDOW if classes is None else classes,
    )  # fmt: skip


def counted(*drawings: Drawing) -> FeatureCounts:
    counts = count_features(drawings, gap=GAP)
    assert counts is not None
    return counts


def interval(*drawings: Drawing) -> tuple[int, int, int]:
    counts = counted(*drawings)
    assert counts.feature_class.tolist() == ["window"]
    return int(counts.count[0]), int(counts.most[0]), int(counts.pieces[0])


def verdicts(
    *drawings: Drawing, required: int = 20, feature_class: str = "window", facade: str = "N"
) -> tuple[ElementStatus, ElementStatus]:
    """Commission and omission against a list of windows."""
    delivery = drawn(*drawings, features=listed((feature_class, facade, required)))
    report = judge(spec("commission"), spec("omission"), delivery=delivery, counts=counted(*drawings))
    commission, omission = report.elements
    return commission.status, omission.status


def pane(space: BaseLayout, x: float = 0.0, y: float = 0.0, inset: float = 0.0, layer: str = "0") -> None:
    corners = shapely.from_wkt(frame(x, y, inset)).coords
    space.add_lwpolyline(list(corners)[:-1], close=True, dxfattribs={"layer": layer})


def read(document: Document, place: Path) -> Drawing:
    place /= "a.dxf"
    document.saveas(place)
    raw = read_dxf(place, limits=LimitsSpec(), sagitta=0.001, unit="m", blocks="explode")
    items = raw.items
    return Drawing(
        path="a.dxf", items=items, reading=raw.reading, unit=METRES, plane=plane_of("xy", items.geometry), facade="N",
        classes=WINDOW,
    )  # fmt: skip
