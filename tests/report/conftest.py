# SPDX-License-Identifier: MIT
"""Finished audits made by hand: a small elevation with every kind of thing a report must show."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely

from foparq.evaluate.quality import Element, ElementStatus, QualityReport, Reason, Verdict, because
from foparq.findings.because import Because
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Findings, finding_keys, join_findings
from foparq.geom.places import place_on
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.drawing import Drawing, DrawingUnit, Reading, Repair, Skipped, SkippedReason, UnitOrigin
from foparq.model.items import Items
from foparq.model.plane import plane_of
from foparq.report.record import AuditRecord

HOSTILE = "</script><img src=x onerror=alert(1)>"
REVERSED = "ca\u202emada"
DEPTH = 12.5  #: metres: every line of the elevation lies this far back


class Sketch:
    """Linework of an elevation, drawn with plain calls; x to the right, z up."""

    def __init__(self) -> None:
        self.shapes: list[Any] = []
        self.layers: list[str] = []
        self.roles: list[str] = []
        self.visible: list[bool] = []
        self.paper: list[bool] = []

    def line(
        self, layer: str, *points: tuple[float, float], role: str = "line", visible: bool = True, paper: bool = False
    ) -> str:
        """Draw a polyline and return its item id."""
        self.shapes.append(shapely.LineString([(x, DEPTH, z) for x, z in points]))
        self.layers.append(layer)
        self.roles.append(role)
        self.visible.append(visible and not paper)
        self.paper.append(paper)
        return f"{len(self.shapes) - 1 + 0x2A:X}"

    def box(self, layer: str, x: float, z: float, width: float, height: float, **more: Any) -> str:
        """Draw a closed rectangle."""
        return self.line(layer, (x, z), (x + width, z), (x + width, z + height), (x, z + height), (x, z), **more)

    def items(self) -> Items:
        """The columns."""
        n = len(self.shapes)
        ids = np.array([f"{row + 0x2A:X}" for row in range(n)], dtype=object)
        closed = [shape.is_closed for shape in self.shapes]
        return Items(
            geometry=np.array(self.shapes, dtype=object),
            layer=np.array(self.layers, dtype=object),
            kind=np.full(n, "LWPOLYLINE", dtype=object),
            role=np.array(self.roles, dtype=object),
            item=ids,
            handle=ids.copy(),
            inserts=np.full(n, "", dtype=object),
            colour=np.full(n, 256, dtype=np.int32),
            closed=np.array(closed, dtype=bool),
            visible=np.array(self.visible, dtype=bool),
            paper=np.array(self.paper, dtype=bool),
        )


def station() -> Sketch:
    """A railway station of 1900, in elevation: plinth, wings with windows, a gabled middle with a clock."""
    s = Sketch()
    for x, width, height in ((0.0, 11.0, 5.2), (11.0, 8.0, 7.4), (19.0, 11.0, 5.2)):
        s.box("PAREDE", x, 0.0, width, height)
        s.line("CORNIJA", (x - 0.15, height), (x + width + 0.15, height))
        s.line("CORNIJA", (x - 0.15, height + 0.22), (x + width + 0.15, height + 0.22))
        s.line("EMBASAMENTO", (x, 0.6), (x + width, 0.6))
        for course in np.arange(0.75, height - 0.1, 0.15):
            s.line("TIJOLO", (x + 0.1, course), (x + width - 0.1, course), role="hatch")
    s.line("COBERTURA", (10.7, 7.62), (15.0, 9.6), (19.3, 7.62))
    angle = np.linspace(0, 2 * np.pi, 49)
    s.line("RELOGIO", *zip(15 + 0.55 * np.cos(angle), 8.3 + 0.55 * np.sin(angle), strict=True))
    for x in (*np.arange(1.2, 10, 2.4), *np.arange(20.2, 29, 2.4)):
        arch = np.linspace(0, np.pi, 25)
        frame = [
            (x, 1.4),
            (x, 3.4),
            *zip(x + 0.6 - 0.6 * np.cos(arch), 3.4 + 0.6 * np.sin(arch), strict=True),
            (x + 1.2, 1.4),
            (x, 1.4),
        ]
        s.line("JANELA", *frame)
        s.box("JANELA", x + 0.1, 1.5, 0.48, 1.8)
        s.box("JANELA", x + 0.62, 1.5, 0.48, 1.8)
        for bar in (2.1, 2.7):
            s.line("JANELA", (x + 0.1, bar), (x + 0.58, bar))
            s.line("JANELA", (x + 0.62, bar), (x + 1.1, bar))
    for x in (12.0, 14.3, 16.6):
        s.box("PORTA", x, 0.0, 1.4, 3.1)
        s.line("PORTA", (x + 0.7, 0.0), (x + 0.7, 3.1))
        s.box("PORTA", x, 4.2, 1.4, 1.9)
    s.line("TEXTO", (13.2, 6.7), (16.8, 6.7), role="annotation")
    s.line("APOIO-CAMPO", (-1.0, -0.4), (31.0, -0.4), visible=False)
    s.line("APOIO-CAMPO", (15.0, -0.4), (15.0, 10.0), visible=False)
    s.box("FOLHA", 0.0, 0.0, 0.594, 0.42, paper=True)
    s.line(HOSTILE, (2.0, -0.2), (6.0, -0.2))
    s.line(REVERSED, (22.0, -0.2), (26.0, -0.2))
    return s


def drawing_of(sketch: Sketch, path: str = "fachada.dxf", **reading: Any) -> Drawing:
    """Drawing in the plane xz, in metres."""
    items = sketch.items()
    return Drawing(
        path=path,
        items=items,
        reading=Reading(version="AC1027", layers=tuple(sorted(set(items.layer))), **reading),
        unit=DrawingUnit(metres=1.0, name="m", origin=UnitOrigin.STATED),
        plane=plane_of("xz", items.geometry),
        facade="N",
    )


def findings_of(
    drawing: Drawing,
    rule: str,
    name: str,
    rows: list[tuple[str, str, Any, float]],
    *,
    severity: str = "major",
    unit: str = "m",
    limit: float = 0.0001,
    other: str = "",
) -> Findings:
    """Findings of (item, layer, place in file coordinates, size)."""
    n = len(rows)

    def column(values: list[Any]) -> np.ndarray:
        made = np.empty(n, dtype=object)
        made[:] = values
        return made

    where = column([row[2] for row in rows])
    sheet = shapely.transform(
        where, lambda c: drawing.plane.project(np.nan_to_num(c), drawing.unit.metres or 1.0), include_z=True
    )
    item, layer = column([row[0] for row in rows]), column([row[1] for row in rows])
    keys = finding_keys(rule, layer, item, column([""] * n), place_on(where), 0.001)
    return Findings(
        key=keys,
        rule=column([rule] * n),
        name=column([name] * n),
        severity=column([severity] * n),
        source=column([drawing.path] * n),
        layer=column([row[1] for row in rows]),
        item=column([row[0] for row in rows]),
        handle=column([row[0] for row in rows]),
        inserts=column(["1F/2B" if row[0] == "2C" else "" for row in rows]),
        other=column([other] * n),
        other_layer=column([""] * n),
        where=where,
        sheet=sheet,
        place=place_on(where),
        size=np.array([row[3] for row in rows], dtype=float),
        unit=column([unit] * n),
        limit=np.full(n, limit),
        told=column([""] * n),
        waived=np.zeros(n, dtype=bool),
    )


def at(x: float, z: float) -> shapely.Point:
    """Point of the elevation in file coordinates."""
    return shapely.Point(x, DEPTH, z)


def outcome(rule: str, name: str, status: Status = Status.CLEAN, **more: Any) -> Outcome:
    """Outcome on the facade."""
    given = {
        "scope": "fachada.dxf: *",
        "source": "fachada.dxf",
        "checked": 976,
        "found": 0,
        "faulty": np.empty(0, dtype=np.intp),
    }
    tolerances = (("coincide", 0.0001, "m"), ("reach", 0.01, "m"))
    return Outcome(rule=rule, name=name, status=status, **{"parameters": tolerances, "seconds": 0.03, **given, **more})


def element(
    id_: str, kind: str, value: float | None, limit: float | None, status: ElementStatus, **more: Any
) -> Element:
    """Quality element with plausible surroundings."""
    given = {
        "measure_id": "39",
        "measure_name": "root mean square error",
        "scope": "pontos.csv",
        "unit": "m",
        "comparison": "<",
        "n": 7,
        "required": True,
        "method": "directExternal",
    }
    return Element(id=id_, element=kind, value=value, limit=limit, status=status, **{**given, **more})


def planted(drawing: Drawing) -> Findings:
    """Faults of several kinds on the elevation: points, a line, an area, one without a place, and a note."""
    reach = [("30", "PAREDE", at(11.0, 3.0 + 0.2 * k), 0.004 + 0.001 * k) for k in range(6)]
    over = [("3B", "JANELA", at(1.2 + 2.4 * k, 2.1), 0.006) for k in range(4)] + [("2C", HOSTILE, at(6.0, -0.2), 0.003)]
    twin = [("41", "PORTA", shapely.LineString([(12.7, DEPTH, 0), (12.7, DEPTH, 3.1)]), 3.1)]
    area = [
        (
            "42",
            "PORTA",
            shapely.Polygon([(14.3, DEPTH, 4.2), (15.7, DEPTH, 4.2), (15.7, DEPTH, 6.1), (14.3, DEPTH, 6.1)]),
            0.02,
        )
    ]
    bad = [("55", "RELOGIO", at(15.0, 8.85), 1.0), ("", "", shapely.Point(), 1.0)]
    note = [("", "APOIO-CAMPO", shapely.box(-1, -0.4, 31, 10), 2.0)]
    return join_findings(
        [
            findings_of(drawing, "TOP011", "undershoot", reach, other="31"),
            findings_of(drawing, "TOP012", "overshoot", over),
            findings_of(drawing, "TOP001", "duplicate", twin, severity="minor", other="44"),
            findings_of(drawing, "TOP031", "area-overlap", area, unit="m2", limit=float("nan")),
            findings_of(
                drawing, "GEO001", "invalid-geometry", bad, severity="critical", unit="items", limit=float("nan")
            ),
            findings_of(drawing, "DOM002", "hidden-entities", note, severity="note", unit="items", limit=float("nan")),
        ]
    )


@pytest.fixture
def plant() -> Callable[..., Findings]:
    """Make findings of a drawing, a rule and rows."""
    return findings_of


@pytest.fixture
def hostile() -> str:
    """A layer name that tries to be markup."""
    return HOSTILE


@pytest.fixture
def drawing() -> Drawing:
    """The station's elevation."""
    repairs = (Repair(code="AUDIT", detail="Deleted owner handle 1F of a missing block", handle="9A"),)
    return drawing_of(station(), hidden_layers=("APOIO-CAMPO",), repairs=repairs)


@pytest.fixture
def rejected(drawing: Drawing) -> AuditRecord:
    """A delivery with faults, gaps in the evidence and hostile names."""
    findings = planted(drawing)

    def rows(rule: str) -> dict[str, Any]:
        of = findings.rule == rule
        faulty = np.flatnonzero(np.isin(drawing.items.item, list(findings.item[of])))
        return {"status": Status.FAULTY, "found": int(of.sum()), "faulty": faulty, "checked": len(drawing.items)}

    pair = (("mean", 0.0021, "m"), ("sd", 0.0039, "m"), ("p", 0.204, ""), ("confidence", 0.95, "1"))
    quality = QualityReport(
        verdict=Verdict.REJECTED,
        why=(because("page.test-fail", element="Q3", value=(0.137, "1"), limit=(0.10, "1")),),
        elements=(
            element("Q1-X", "AbsoluteExternalPositionalAccuracy", 0.0042, 0.015, ElementStatus.PASS, parameters=pair),
            element(
                "Q2",
                "RelativeInternalPositionalAccuracy",
                0.0098,
                0.010,
                ElementStatus.UNDECIDED,
                n=29,
                parameters=pair,
                why=(because("page.test-poor", value=(0.010, "m"), limit=(0.0033, "m")),),
            ),
            element(
                "Q3",
                "TopologicalConsistency",
                0.137,
                0.10,
                ElementStatus.FAIL,
                unit="1",
                comparison="<=",
                n=976,
                why=(
                    Reason(
                        message="page.test-fail",
                        fields=(("element", "Q3"), ("value", (0.137, "1")), ("limit", (0.1, "1"))),
                    ),
                ),
                details=(("undershoot", 6.0, 117.0), ("overshoot", 5.0, 117.0)),
                method="directInternal",
                scope="fachada.dxf",
            ),
            element(
                "Q5",
                "CompletenessOmission",
                None,
                0.05,
                ElementStatus.NOT_ASSESSED,
                unit="1",
                n=0,
                comparison="<=",
                why=(because("page.test-absent"),),
            ),
        ),
    )
    sources = (
        Source(path="delivery.toml", role="manifest", sha256="0c" * 32, bytes=1204, status=SourceStatus.READ, items=1),
        Source(
            path="fachada.dxf",
            role="drawing",
            sha256="ab" * 32,
            bytes=1_482_331,
            status=SourceStatus.RECOVERED,
            items=117,
            skipped=(
                Skipped(reason=SkippedReason.UNSUPPORTED, kind="3DSOLID", layer="0", count=3, handles=("A1", "A2")),
                Skipped(reason=SkippedReason.NO_GEOMETRY, kind="LWPOLYLINE", layer=HOSTILE, count=1, handles=("B7",)),
            ),
        ),
        Source(path="pontos.csv", role="checkpoints", sha256="cd" * 32, bytes=412, status=SourceStatus.READ, items=7),
        Source(path="anexo.pdf", role="other", sha256="ef" * 32, bytes=90_112, status=SourceStatus.UNNAMED),
        Source(path="feicoes.csv", role="features", sha256="", bytes=0, status=SourceStatus.MISSING),
        Source(
            path=f"{HOSTILE}.dxf",
            role="drawing",
            sha256="12" * 32,
            bytes=77,
            status=SourceStatus.REFUSED,
            error="page.test-refused",
            fields=(("file", f"{HOSTILE}.dxf"),),
        ),
    )
    runs = (
        outcome("GEO001", "invalid-geometry", parameters=(), **rows("GEO001")),
        outcome("TOP011", "undershoot", unjudged=np.arange(2), **rows("TOP011")),
        outcome("TOP012", "overshoot", unjudged=np.arange(2), **rows("TOP012")),
        outcome("TOP001", "duplicate", **rows("TOP001")),
        outcome("TOP031", "area-overlap", parameters=(("smallest", 1e-4, "m2"),), **rows("TOP031")),
        outcome("DOM002", "hidden-entities", parameters=(), **{**rows("DOM002"), "checked": 1}),
        outcome("TOP013", "free-end"),
        outcome("TOP032", "gap", Status.NOT_RUN, because=Because.NOTHING, checked=0),
        outcome("GEO004", "self-intersection", Status.CRASHED, because=Because.CRASHED, checked=0),
    )
    return AuditRecord(
        delivery=Delivery(title="Estação Ferroviária de Presidente Prudente", sources=sources, parts=(drawing,)),
        quality=quality,
        outcomes=runs,
        findings=findings,
        profile="et-doc-foparq-a",
        profile_title="ET/DOC-FOPARQ, classe A",
        profile_sha256="9f" * 32,
        product_class="A",
        scale=50.0,
        language="pt-BR",
        started="2026-03-09T14:05:00+00:00",
        versions={"foparq": "0.1.0", "GEOS": "3.13.1", "GDAL": "3.12.4", "ezdxf": "1.4.2"},
        norms=("ABNT NBR 6492:2021", "ISO 19157:2013"),
    )


@pytest.fixture
def accepted(rejected: AuditRecord) -> AuditRecord:
    """The same delivery without a fault."""
    good = tuple(replace(one, status=ElementStatus.PASS, value=0.001, why=()) for one in rejected.quality.elements)
    clean = tuple(
        replace(run, status=Status.CLEAN, found=0, faulty=np.empty(0, dtype=np.intp), because=Because.RAN)
        for run in rejected.outcomes
    )
    read = tuple(replace(source, skipped=()) for source in rejected.delivery.sources[:3])
    return replace(
        rejected,
        quality=QualityReport(verdict=Verdict.ACCEPTED, why=(because("page.test-met"),), elements=good),
        outcomes=clean,
        findings=join_findings([]),
        delivery=replace(rejected.delivery, sources=read),
        language="en",
    )


@pytest.fixture(autouse=True)
def spoken(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sentences for the reasons that only these records use."""
    from foparq.report.words import Words

    find: Callable[[Words, str], str | None] = Words.find
    monkeypatch.setattr(Words, "find", lambda words, message: find(words, message) or _SPOKEN.get(message))


_SPOKEN = {
    "evaluate.page.test-fail": "{element}: {value} de itens com falha; o limite é {limit}.",
    "evaluate.page.test-poor": "A referência ({value}) é mais pobre que um terço do limite ({limit}).",
    "evaluate.page.test-absent": "A entrega não traz lista de feições.",
    "evaluate.page.test-met": "Every required element is met.",
    "errors.page.test-refused": "{file}: o arquivo não é um DXF.",
}
