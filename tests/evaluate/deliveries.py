# SPDX-License-Identifier: MIT
"""Small deliveries made by hand, and the evaluation of them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely

from foparq.evaluate.evaluate import evaluate
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.quality import Element, QualityReport
from foparq.findings.because import Because
from foparq.findings.counts import FeatureCounts
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Severity
from foparq.findings.ties import DistanceTies, Ends, Lies, PointTies, Ties
from foparq.match.repeats import repeats
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.drawing import Bomb, Drawing, DrawingUnit, Reading, Skipped, UnitOrigin
from foparq.model.items import Items, Role
from foparq.model.plane import Plane
from foparq.model.tables import Checkpoints, Distances, FeatureList
from foparq.profile.elements import ElementSpec
from foparq.profile.schema import CheckSpec, Profile, ReadingSpec
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words
from foparq.units import parse_quantity

MM = 0.001
LIMITS = {
    "absolute": ("0.3 mm @ scale", "m"), "relative": ("0.2 mm @ scale", "m"), "faulty-rate": ("10 %", "1"),
    "omission": ("5 %", "1"), "commission": ("0 %", "1"),
}  # fmt: skip


def spec(kind: str, **changes: Any) -> ElementSpec:
    """Element of the specification, as in ET/DOC-FOPARQ."""
    given: dict[str, Any] = {"id": "Q", "kind": kind, "required": True}
    if kind in LIMITS:
        given["limit"] = parse_quantity(*LIMITS[kind])
    if kind in {"absolute", "relative"}:
        given |= {"reference_share": 1 / 3, "fewest": 3}
    return ElementSpec.KINDS[kind](**{**given, **changes})


def profile(*elements: ElementSpec) -> Profile:
    return Profile(
        name="test", title={"en": "test"}, product_class="A", reading=ReadingSpec(sagitta="1 mm"),
        checks=(CheckSpec(rule="gap", severity=Severity.MAJOR),), elements=elements,
    )  # fmt: skip


def judge(
    *elements: ElementSpec, delivery: Delivery, outcomes: Sequence[Outcome] = (), counts: FeatureCounts | None = None,
    crashed: bool = False, scale: float | None = 50.0, ties: Ties | None = None,
) -> QualityReport:  # fmt: skip
    """Evaluate, and make every sentence in both languages: a reason without one is an error."""
    evidence = Evidence(
        delivery=delivery, outcomes=outcomes, counts=counts, scale=scale, crashed=crashed, ties=ties or tied(delivery)
    )
    evaluated = evaluate(profile(*elements), evidence)
    assert not evaluated.log
    report = evaluated.quality
    for language in ("en", "pt-BR"):
        words = Words(language)
        for reason in (
            *report.why,
            *report.remarks,
            *(reason for element in report.elements for reason in element.why),
        ):
            assert "{" not in reason_sentence(words, reason)
        for element in report.elements:
            assert words.find(f"evaluate.measure.{element.measure_id}")
            names = [name for name, _, _ in element.parameters if not name.startswith("measure-")]
            assert all(words.find(f"report.parameter.{name}") for name in names)
            assert len(dict.fromkeys(name for name, _, _ in element.parameters)) == len(element.parameters)
    return report


def tied(delivery: Delivery) -> Ties:
    """Every point lies on a vertex, every distance runs between two of them, none repeats another."""
    points, lengths = delivery.checkpoints, delivery.distances
    here = None if points is None else point_ties(points)
    there = None
    if lengths is not None:
        n = len(lengths.id)
        there = DistanceTies(
            ends=np.full(n, str(Ends.POINTS), dtype=object), between=lengths.delivered, delivered=lengths.delivered,
            group=np.arange(n), longest=10.0,
        )  # fmt: skip
    return Ties(points=here, distances=there, drawings=1)


def point_ties(points: Checkpoints, **changes: Any) -> PointTies:
    """Every point on a vertex of one drawing, unless changed."""
    n = len(points.id)
    same = {name: np.full(n, name, dtype=object) for name in ("drawing", "item", "layer")}
    return PointTies(**{
        "lies": np.full(n, str(Lies.VERTEX), dtype=object), "gap": np.zeros(n), **same, "delivered": points.delivered,
        "group": repeats(points.surveyed, apart=0.001), "unchecked": np.zeros(3, dtype=bool), **changes,
    })  # fmt: skip


def one(element: ElementSpec, **given: Any) -> Element:
    """The one result of one element."""
    (result,) = judge(element, **given).elements
    return result


def messages(element: Element) -> list[str]:
    return [reason.message for reason in element.why]


def parameter(element: Element, name: str) -> float:
    (value,) = (value for known, value, _ in element.parameters if known == name)
    return value


def source(path: str, role: str = "drawing", status: SourceStatus = SourceStatus.READ) -> Source:
    return Source(path=path, role=role, sha256="", bytes=1, status=status)


def checkpoints(
    differences: Any, *, resolution: float = 0.05 * MM, survey_sd: float | None = 3 * MM, at: float = 100.0
) -> Checkpoints:
    """Checkpoints whose delivered coordinates differ by these, metres; one column counts for all three axes."""
    d = np.asarray(differences, dtype=float)
    d = np.stack([d] * 3, axis=1) if d.ndim == 1 else d
    ids = np.array([f"P{n}" for n in range(len(d))], dtype=object)
    # A quarter of a metre apart, which binary numbers hold exactly.
    surveyed = np.full(d.shape, at) + np.arange(len(d))[:, np.newaxis] / 4
    return Checkpoints(
        id=ids, surveyed=surveyed, delivered=surveyed + d, resolution=np.full(3, resolution), survey_sd=survey_sd
    )


def distances(differences: Any, *, resolution: float = 0.05 * MM, survey_sd: float | None = 3 * MM) -> Distances:
    """Distances whose delivered lengths differ by these, metres."""
    d = np.asarray(differences, dtype=float)
    ids = np.array([f"D{n}" for n in range(len(d))], dtype=object)
    measured = np.linspace(0.5, 3.0, len(d))
    return Distances(id=ids, measured=measured, delivered=measured + d, resolution=resolution, survey_sd=survey_sd)


def surveyed(points: Checkpoints | None = None, lengths: Distances | None = None, **given: Any) -> Delivery:
    """Delivery of tables."""
    sources = (source("pontos.csv", "checkpoints"), source("distancias.csv", "distances"))
    return Delivery(**{"title": "t", "sources": sources, "checkpoints": points, "distances": lengths, **given})


def drawing(
    path: str = "a.dxf", *, n: int = 1000, classes: dict[str, str] | None = None, facade: str = "N",
    metres: float | None = 1.0, bombs: tuple[Bomb, ...] = (), skipped: tuple[Skipped, ...] = (),
) -> Drawing:  # fmt: skip
    """Drawing of n lines."""

    def same(value: object) -> np.ndarray:
        return np.full(n, value, dtype=object)

    names = np.array([str(row) for row in range(n)], dtype=object)
    items = Items(
        geometry=np.full(n, shapely.from_wkt("LINESTRING (0 0, 1 1)"), dtype=object), layer=same("0"),
        kind=same("LINE"), role=same(Role.LINE.value), item=names, handle=names.copy(), inserts=same(""),
        colour=np.zeros(n, dtype=np.int32), closed=np.zeros(n, dtype=bool), visible=np.ones(n, dtype=bool),
        paper=np.zeros(n, dtype=bool),
    )  # fmt: skip
    return Drawing(
        path=path, items=items, reading=Reading(bombs=bombs, skipped=skipped),
        unit=DrawingUnit(metres=metres, name="m", origin=UnitOrigin.STATED),
        plane=Plane("xz", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), facade=facade, classes=classes or {},
    )  # fmt: skip


def drawn(*drawings: Drawing, features: FeatureList | None = None, lost: Sequence[str] = ()) -> Delivery:
    """Delivery of drawings."""
    sources = [source(part.path) for part in drawings]
    sources += [source(path, status=SourceStatus.REFUSED) for path in lost]
    sources += [source("feicoes.csv", "features")] if features is not None else []
    return Delivery(title="t", sources=tuple(sources), parts=drawings, features=features)


def outcome(
    name: str, faulty: Sequence[int] = (), *, checked: int = 0, source: str = "a.dxf", found: int | None = None,
    status: Status | None = None, unjudged: Sequence[int] = (), **changes: Any,
) -> Outcome:  # fmt: skip
    """Outcome of a rule on rows of a drawing."""
    found = len(faulty) if found is None else found
    status = status or (Status.FAULTY if found else Status.CLEAN)
    return Outcome(
        rule=name[:3].upper(), name=name, scope=f"{source}: *", source=source, status=status, checked=checked,
        found=found, faulty=np.array(faulty, dtype=np.intp), unjudged=np.array(unjudged, dtype=np.intp), **changes,
    )  # fmt: skip


def not_run(name: str, because: Because, source: str = "a.dxf") -> Outcome:
    status = Status.CRASHED if because is Because.CRASHED else Status.NOT_RUN
    return outcome(name, status=status, because=because, source=source)


def listed(*rows: tuple[Any, ...]) -> FeatureList:
    """List of (class, facade, count[, use[, accepted[, evidence]]])."""
    full = [(*row, *("required", "", "")[len(row) - 3 :]) for row in rows]
    columns = list(zip(*full, strict=True)) if full else [()] * 6
    texts = [np.array(column, dtype=object) for column in columns]
    return FeatureList(
        id=np.array([f"F{n}" for n in range(len(rows))], dtype=object), feature_class=texts[0], facade=texts[1],
        count=np.array(columns[2], dtype=np.intp), use=texts[3], accepted=texts[4], evidence=texts[5],
    )  # fmt: skip


def counted(*rows: tuple[str, str, int], unmapped: tuple[tuple[str, int], ...] = ()) -> FeatureCounts:
    """Counts of (class, facade, count)."""
    return FeatureCounts(
        feature_class=np.array([row[0] for row in rows], dtype=object),
        facade=np.array([row[1] for row in rows], dtype=object),
        count=np.array([row[2] for row in rows], dtype=np.intp), unmapped=unmapped,
    )  # fmt: skip
