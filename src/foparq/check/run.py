# SPDX-License-Identifier: MIT
"""Run the rules of a profile on one drawing.

A crash of a rule is ours: it becomes an outcome ``crashed`` with its traceback in the log, never a finding.
"""

import math
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from foparq.check.inputs import DrawingInputs, matches
from foparq.check.registry import all_rules, in_order
from foparq.check.rule import Rule
from foparq.columns import Geometries, Index, Reals, Texts
from foparq.findings.hits import NOBODY, Hits
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Findings, Severity, finding_keys, join_findings
from foparq.model.drawing import Drawing, UnitOrigin
from foparq.model.inputs import Named
from foparq.model.items import Role
from foparq.profile.schema import CheckSpec, Profile

_KEY_GRID = 0.001  #: metres: above the noise of coordinates, below the distance of two findings
_UNIT_RULE = "unit-contradiction"

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Checked:
    """What the rules found on one drawing."""

    outcomes: tuple[Outcome, ...]
    findings: Findings
    log: tuple[str, ...]  #: tracebacks of rules that crashed


def check_drawing(drawing: Drawing, profile: Profile, scale: float | None, progress: Progress | None = None) -> Checked:
    """Run every check of the profile on one drawing.

    Parameters
    ----------
    drawing : Drawing
    profile : Profile
        Its checks must be valid, see :func:`foparq.check.validate.validate_checks`.
    scale : float or None
        Denominator of the drawing scale.
    progress : callable, optional
        Told the name of each rule before it runs.

    Returns
    -------
    Checked
        Outcomes in order of rules, findings in their defined order.
    """
    inputs = DrawingInputs(drawing, hidden=profile.reading.hidden == "check")
    rules = all_rules()
    code_of = {rule.name: code for code, rule in rules.items()}
    specs = [(rules[code_of[spec.rule]], spec) for spec in profile.checks]
    order = {code: n for n, code in enumerate(in_order({rule.code for rule, _ in specs}))}
    # Statements about the unit come first: they decide whether tolerances in metres mean anything.
    specs.sort(key=lambda pair: (pair[0].name != _UNIT_RULE, order[pair[0].code]))
    faulty: dict[str, frozenset[int]] = {}
    outcomes: list[Outcome] = []
    tables: list[Findings] = []
    log: list[str] = []
    for rule, spec in specs:
        if progress is not None:
            progress(rule.name)
        without = frozenset[int]().union(*(faulty.get(code, frozenset()) for code in rule.requires))
        for layers in _scopes(spec, rule.subject, inputs):
            call = _Call(rule, spec, layers, without, scale)
            outcome, table, trace = _run(call, inputs, _doubt(inputs, outcomes))
            outcomes.append(outcome)
            log.extend(trace)
            if table is not None:
                tables.append(table)
            faulty[rule.code] = faulty.get(rule.code, frozenset()) | frozenset(outcome.faulty.tolist())
    outcomes.sort(key=lambda outcome: (outcome.rule, outcome.scope))
    return Checked(outcomes=tuple(outcomes), findings=join_findings(tables), log=tuple(log))


@dataclass(frozen=True, slots=True)
class _Call:
    rule: Rule
    spec: CheckSpec
    layers: tuple[str, ...]
    without: frozenset[int]
    scale: float | None

    @property
    def tolerances(self) -> dict[str, float]:
        return {name: self.spec.tolerances[name].si(self.scale) for name, _ in self.rule.tolerances}


def _scopes(spec: CheckSpec, subject: type, inputs: DrawingInputs) -> Sequence[tuple[str, ...]]:
    if not spec.apart:
        return [spec.layers]
    alone = [(_literal(layer),) for layer in inputs.layers() if matches(layer, spec.layers)]
    return [layers for layers in alone if inputs.holds(subject, layers)] or [spec.layers]


def _literal(layer: str) -> str:
    """Pattern that only this layer matches."""
    return "".join(f"[{c}]" if c in "*?[" else c for c in layer)


def _doubt(inputs: DrawingInputs, outcomes: Sequence[Outcome]) -> str:
    """Why tolerances in metres mean nothing on this drawing; empty if they do."""
    unit = inputs.drawing.unit
    if unit.metres is None:
        return "unit-unknown"
    doubted = any(outcome.name == _UNIT_RULE and outcome.status is Status.FAULTY for outcome in outcomes)
    if doubted and unit.origin is not UnitOrigin.STATED:
        return "unit-doubtful"
    return "plane-doubtful" if inputs.seen_edge_on else ""


def _run(call: _Call, inputs: DrawingInputs, doubt: str) -> tuple[Outcome, Findings | None, list[str]]:
    rule, drawing = call.rule, inputs.drawing
    nothing = np.empty(0, dtype=np.intp)
    outcome = Outcome(
        rule=rule.code, name=rule.name, scope=f"{drawing.path}: {', '.join(call.layers)}", source=drawing.path,
        status=Status.NOT_RUN, checked=0, found=0, faulty=nothing, preview=rule.preview,
    )  # fmt: skip
    if doubt and any(unit in {"m", "m2"} for _, unit in rule.tolerances):
        return replace(outcome, because=doubt), None, []
    tolerances = call.tolerances
    parameters = tuple((name, tolerances[name], unit) for name, unit in rule.tolerances)
    outcome = replace(outcome, parameters=parameters)
    start = time.perf_counter()
    try:
        subject, aside = inputs.get(rule.subject, call.layers, call.without)
        outcome = replace(outcome, skipped=aside)
        if len(subject) == 0 and not inputs.examined(rule.subject):
            return replace(outcome, because="nothing-to-check"), None, []
        found = rule.check(subject, **tolerances)
        table = _table(call, inputs, subject, found)
    except Exception:  # noqa: BLE001 - whatever a rule does wrong is our fault and must not end the audit
        seconds = time.perf_counter() - start
        trace = f"{rule.code} {rule.name} on {drawing.path}\n{traceback.format_exc()}"
        return replace(outcome, status=Status.CRASHED, because="crashed", seconds=seconds), None, [trace]
    rows = subject.row[found.row] if len(found) else nothing
    done = replace(
        outcome,
        status=Status.FAULTY if len(found) else Status.CLEAN,
        checked=_checked(drawing, subject.row, rows),
        found=len(found),
        faulty=np.unique(rows[rows >= 0]),
        seconds=time.perf_counter() - start,
    )
    return done, table, []


def _checked(drawing: Drawing, rows: Index, faulty: Index) -> int:
    """Features looked at, the denominator of rates. A point has no topology: it counts only where it is at fault."""
    rows = rows[rows >= 0]
    if not len(rows):
        return 1  # a statement about the file: the file was checked
    drawn = rows[drawing.items.role[rows] != Role.POINT]
    return len(np.unique(np.concatenate([drawn, faulty[faulty >= 0]])))


def _table(call: _Call, inputs: DrawingInputs, subject: Named, found: Hits) -> Findings | None:
    if not len(found):
        return None
    n = len(found)
    rule, drawing = call.rule, inputs.drawing
    if hasattr(subject, "geometry"):
        sheet = _with_depth(found, subject)
        where = _lift(sheet, inputs)
    else:  # a statement about the file has its place in the coordinates of the file
        where, sheet = found.where, inputs.on_sheet(found.where)
    item = subject.item[found.row]
    other = np.array([subject.item[row] if row != NOBODY else "" for row in found.other], dtype=object)
    layer = subject.layer[found.row]
    limit = call.tolerances[rule.limit] if rule.limit else math.nan
    return Findings(
        key=finding_keys(rule.code, layer, item, other, _places(where, inputs.metres), _KEY_GRID),
        rule=_same(rule.code, n),
        name=_same(rule.name, n),
        # A rule in preview is reported and cannot reject, whatever the profile says.
        severity=_same(Severity.NOTE.value if rule.preview else call.spec.severity.value, n),
        source=_same(drawing.path, n),
        layer=layer,
        item=item,
        handle=subject.handle[found.row],
        inserts=subject.inserts[found.row],
        other=other,
        where=where,
        sheet=sheet,
        size=found.size,
        unit=_same(rule.size_unit, n),
        limit=np.full(n, limit),
        waived=np.zeros(n, dtype=bool),
    )


def _same(value: str, n: int) -> Texts:
    return np.full(n, value, dtype=object)


def _with_depth(found: Hits, subject: Named) -> Geometries:
    """Places with the depth of the item they lie on, where the drawing has depth and the kernel gave none."""
    geometry = getattr(subject, "geometry", None)
    if geometry is None:
        return found.where
    on = geometry[found.row]
    flat = shapely.has_z(on) & ~shapely.has_z(found.where) & ~shapely.is_empty(found.where)
    if not flat.any():
        return found.where
    places = found.where.copy()
    for n in np.flatnonzero(flat):
        at = shapely.line_interpolate_point(on[n], shapely.line_locate_point(on[n], places[n].representative_point()))
        depth = shapely.get_z(at) if at is not None else math.nan
        places[n] = shapely.force_3d(places[n], 0.0 if math.isnan(depth) else depth)
    return places


def _lift(places: Geometries, inputs: DrawingInputs) -> Geometries:
    """Places on the sheet back to coordinates of the file."""
    coordinates = shapely.get_coordinates(places, include_z=True)
    coordinates[:, 2] = np.nan_to_num(coordinates[:, 2])
    lifted: Geometries = shapely.set_coordinates(
        shapely.force_3d(places.copy()), inputs.drawing.plane.lift(coordinates, inputs.metres)
    )
    return lifted


def _places(where: Geometries, metres: float) -> Reals:
    """(n, 3) one place for each finding, metres in the coordinates of the file; NaN where it has none."""
    places = np.full((len(where), 3), np.nan)
    placed = ~shapely.is_empty(where)
    places[placed, :2] = shapely.get_coordinates(shapely.centroid(shapely.force_2d(where[placed])))
    places[:, 2] = _middle_depth(where)
    return places * metres


def _middle_depth(where: Geometries) -> Reals:
    coordinates, index = shapely.get_coordinates(where, include_z=True, return_index=True)
    vertices = np.bincount(index, minlength=len(where))
    total = np.bincount(index, weights=np.nan_to_num(coordinates[:, 2]), minlength=len(where))
    depth: Reals = np.divide(total, vertices, out=np.full(len(where), np.nan), where=vertices > 0)
    return depth
