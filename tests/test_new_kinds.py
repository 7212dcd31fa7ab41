# SPDX-License-Identifier: MIT
"""A kind of part, rules on it and a kind of element that nobody knew, from the check to every report.

Nothing of the engine, the evaluation or the reports is changed for them.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from lxml import etree

from foparq.check import registry, subject
from foparq.check.calls import Patterns
from foparq.check.registry import all_rules
from foparq.check.rule import Rule, rule
from foparq.check.run import Checked, check_part
from foparq.check.subject import NO_DOUBT, Doubt, Places, Subject, Taken
from foparq.columns import Index, Reals, Texts
from foparq.evaluate import kinds
from foparq.evaluate.evaluate import evaluate
from foparq.evaluate.evidence import Evidence
from foparq.evaluate.kinds import Kind
from foparq.evaluate.quality import Element, ElementStatus, Verdict, because
from foparq.findings.hits import Deviations, Hits, hits
from foparq.findings.outcome import Outcome, Status
from foparq.findings.table import Severity
from foparq.model.delivery import Delivery, Source, SourceStatus
from foparq.model.inputs import Named
from foparq.model.part import Part
from foparq.profile.elements import ElementSpec, LimitedSpec
from foparq.profile.load import load_profile
from foparq.profile.schema import CheckSpec, Profile
from foparq.report.files import write_reports
from foparq.report.formats import WRITTEN
from foparq.report.record import AuditRecord
from foparq.report.words import Words
from foparq.units import Metres, parse_quantity


@dataclass(frozen=True, kw_only=True)
class Cloud(Part):
    """Points in space with a name each, on two layers: as delivered and as surveyed."""

    points: Reals  #: (n, 3)
    layers: tuple[str, ...]

    @property
    def features(self) -> int:
        return len(self.points)

    @property
    def vertices(self) -> int:
        return len(self.points)


@dataclass(frozen=True, kw_only=True)
class Marks(Named):
    place: Reals  #: (n, 3)


class CloudSubject(Subject):
    """A cloud as the rules see it."""

    metres = 1.0

    def __init__(self, part: Cloud, _profile: Profile) -> None:
        self.cloud = part

    @property
    def part(self) -> Part:
        return self.cloud

    @classmethod
    def knows(cls, kind: type) -> bool:
        return kind is Marks

    def take(self, kind: type, layers: Patterns) -> Taken:
        assert kind is Marks
        rows = np.array(
            [n for n, name in enumerate(self.cloud.layers) if "*" in layers or name in layers], dtype=np.intp
        )
        layer = np.array(self.cloud.layers, dtype=object)[rows]
        name = np.array([f"P{n}" for n in rows], dtype=object)
        empty = np.full(len(rows), "", dtype=object)
        marks = Marks(layer=layer, item=name, handle=name, inserts=empty, row=rows, place=self.cloud.points[rows])
        return Taken(marks, np.empty(0, dtype=np.intp))

    def alone(self, kind: type, layers: Patterns) -> Sequence[Patterns]:  # noqa: ARG002 - the engine's call
        return []

    def states(self, kind: type) -> bool:  # noqa: ARG002 - the engine's call
        return False

    def examined(self, kind: type) -> bool:  # noqa: ARG002 - the engine's call
        return False

    def doubt(self, outcomes: Sequence[Outcome], visible: float) -> Doubt:  # noqa: ARG002 - the engine's call
        return NO_DOUBT

    def counted(self, rows: Index, faulty: Index) -> int:  # noqa: ARG002 - the engine's call
        return len(rows)

    def named(self, rows: Index) -> tuple[Texts, Texts]:
        return self.take(Marks, ("*",)).rows.item[rows], np.array(self.cloud.layers, dtype=object)[rows]

    def places(self, found: Hits, rows: Named) -> Places:  # noqa: ARG002 - the engine's call
        return Places(found.where, found.where, shapely.get_coordinates(found.where, include_z=True))


@rule("MSH901", "mark-below-ground", limit="ground")
def mark_below_ground(marks: Marks, *, ground: Metres) -> Hits:
    """Mark that lies below the ground."""
    low = np.flatnonzero(marks.place[:, 2] < ground)
    return hits(low, shapely.points(marks.place[low]), ground - marks.place[low, 2])


@rule("MSH902", "mark-off-survey", limit="most", requires=("MSH901",))
def mark_off_survey(delivered: Marks, surveyed: Marks, *, most: Metres) -> Deviations:  # noqa: ARG001 - the limit
    """Mark that lies elsewhere than where it was surveyed."""
    n = min(len(delivered), len(surveyed))
    row = np.arange(n)
    return Deviations(
        row=row, where=shapely.points(delivered.place[:n]), delta=delivered.place[:n] - surveyed.place[:n], other=row
    )


class FarthestSpec(LimitedSpec):
    """The greatest difference of a rule that measures."""

    KIND = "farthest"


ElementSpec.KINDS.pop(FarthestSpec.KIND)  # known to the tests of this file only


def farthest(spec: FarthestSpec, evidence: Evidence) -> tuple[Element, ...]:
    """The greatest difference, in the rule's unit."""
    deltas = [o.deviations.delta for o in evidence.outcomes if o.deviations is not None]
    value = float(np.linalg.norm(np.concatenate(deltas), axis=1).max())
    limit = spec.limit.si() if spec.limit else 0.0
    return (
        Element(
            id=spec.id, element="AbsoluteExternalPositionalAccuracy", measure_id="own:farthest",
            measure_name="greatest difference", scope="", value=value, unit="m", limit=limit, comparison="<",
            n=len(deltas), status=ElementStatus.PASS if value < limit else ElementStatus.FAIL, required=True,
            why=(because("element.crashed", element=spec.id),),
        ),
    )  # fmt: skip


@pytest.fixture(autouse=True)
def known(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the kinds known, as a module in the right folder would."""
    own: list[Rule] = [mark_below_ground.rule, mark_off_survey.rule]  # type: ignore[attr-defined]
    rules = {**all_rules(), **{one.code: one for one in own}}
    monkeypatch.setattr(registry, "all_rules", lambda: rules)
    monkeypatch.setattr("foparq.check.run.all_rules", lambda: rules)
    monkeypatch.setitem(subject.SUBJECTS, Cloud, CloudSubject)
    monkeypatch.setitem(ElementSpec.KINDS, FarthestSpec.KIND, FarthestSpec)
    monkeypatch.setitem(kinds.KINDS, FarthestSpec, Kind(farthest, "39"))


def profile(**changes: object) -> Profile:
    checks = (
        CheckSpec(rule="mark-below-ground", severity=Severity.MAJOR, tolerances={"ground": "0 m"}),
        CheckSpec(
            rule="mark-off-survey", severity=Severity.CRITICAL, tolerances={"most": "10 mm"},
            on={"delivered": ("D",), "surveyed": ("S",)},
        ),
        CheckSpec(rule="undershoot", severity=Severity.MAJOR, tolerances={"coincide": "1 mm", "reach": "10 mm"}),
    )  # fmt: skip
    elements = (FarthestSpec(id="Q90", kind="farthest", required=True, limit=parse_quantity("1 m", "m")),)
    return load_profile("et-doc-foparq-a").model_copy(update={"checks": checks, "elements": elements, **changes})


CLOUD = Cloud(
    path="nuvem.xyz",
    points=np.array([[0, 0, 1], [1, 0, 1], [2, 0, -0.5], [0, 0, 1], [1, 0, 1.03], [2, 0, -0.5]], dtype=float),
    layers=("D", "D", "D", "S", "S", "S"),
)


def check() -> Checked:
    return check_part(CLOUD, profile(), None)


def test_rules_on_a_new_kind_of_part_run_and_others_do_not_concern_it() -> None:
    checked = check()
    assert [outcome.name for outcome in checked.outcomes] == ["mark-below-ground", "mark-off-survey"]
    assert not checked.log


def test_a_rule_with_two_inputs_measures_and_names_both_items() -> None:
    checked = check()
    measured = checked.outcomes[1]
    assert measured.deviations is not None
    assert measured.deviations.delta[1].tolist() == pytest.approx([0, 0, -0.03])
    assert (measured.status, measured.found, measured.faulty.tolist()) == (Status.FAULTY, 1, [1])
    row = np.flatnonzero(checked.findings.name == "mark-off-survey")[0]
    table = checked.findings
    assert (table.item[row], table.layer[row], table.other[row], table.other_layer[row]) == ("P1", "D", "P4", "S")
    assert (table.size[row], table.limit[row]) == (pytest.approx(0.03), 0.01)
    assert measured.scope == "nuvem.xyz: delivered D; surveyed S"


def test_what_a_required_rule_found_at_fault_is_set_aside_in_every_input() -> None:
    measured = check().outcomes[1]
    assert [one.item for one in measured.aside] == ["P2"]
    assert measured.checked == 2


def audited(language: str = "en") -> AuditRecord:
    checked = check()
    source = Source(path="nuvem.xyz", role="drawing", sha256="0" * 64, bytes=1, status=SourceStatus.READ)
    delivery = Delivery(title="Nuvem", sources=(source,), parts=(CLOUD,))
    evidence = Evidence(delivery=delivery, outcomes=checked.outcomes, counts=None, scale=50.0)
    evaluated = evaluate(profile(), evidence)
    assert not evaluated.log
    return AuditRecord(
        delivery=delivery, quality=evaluated.quality, outcomes=checked.outcomes, findings=checked.findings,
        profile="own", profile_title="Own", profile_sha256="0" * 64, product_class="A", scale=50.0, language=language,
    )  # fmt: skip


def test_a_new_kind_of_element_decides() -> None:
    quality = audited().quality
    assert [(one.id, one.status, one.value) for one in quality.elements] == [
        ("Q90", ElementStatus.PASS, pytest.approx(0.03))
    ]
    assert quality.verdict is Verdict.ACCEPTED


@pytest.mark.parametrize("language", ["pt-BR", "en"])
def test_every_report_tells_of_it(language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parts = {"title": "A mark", "finding": "{item} {layer}", "mend": "Move it.", "manual": "A mark."}
    texts = {f"rules.MSH90{n}.{part}": text for n in (1, 2) for part, text in parts.items()}
    find = Words.find
    monkeypatch.setattr(Words, "find", lambda words, message: texts.get(message) or find(words, message))
    written = write_reports(audited(language), (), tmp_path)
    assert not written.log
    told = {path.name: path.read_bytes() for path in written.paths}
    assert set(told) == {form.file for form in WRITTEN}
    for name in set(told) - {"quality.xml"}:
        assert b"mark-off-survey" in told[name], name
    etree.fromstring(told["quality.xml"])
    assert b"greatest difference" in told["quality.xml"]
    measure = json.loads(told["audit.json"])["elements"][0]["measure"]
    assert measure == {"id": "own:farthest", "name": "greatest difference"}


def test_an_evaluation_that_crashes_is_undecided_and_takes_nothing_from_the_others(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def broken(_spec: ElementSpec, _evidence: Evidence) -> tuple[Element, ...]:
        raise ZeroDivisionError("planted")

    elements = (
        *profile().elements, FarthestSpec(id="Q91", kind="farthest", required=False, limit=parse_quantity("2 m", "m")),
    )  # fmt: skip
    evidence = Evidence(delivery=Delivery(title="", sources=()), outcomes=check().outcomes, counts=None, scale=50.0)
    whole = evaluate(profile(elements=elements), evidence)
    assert whole.quality.verdict is Verdict.ACCEPTED
    monkeypatch.setitem(kinds.KINDS, FarthestSpec, Kind(broken, "39"))
    evaluated = evaluate(profile(elements=(*elements, *load_profile("et-doc-foparq-a").elements)), evidence)
    assert [one.status for one in evaluated.quality.elements[:2]] == [ElementStatus.UNDECIDED] * 2
    assert len(evaluated.quality.elements) > 2
    assert evaluated.quality.verdict is Verdict.UNDECIDED
    assert len(evaluated.log) == 2
    assert "planted" in evaluated.log[0]


def test_an_element_of_another_kind_has_no_keys_of_this_one() -> None:
    with pytest.raises(ValueError, match="extra"):
        FarthestSpec(id="Q", kind="farthest", required=True, rules=("gap",))  # type: ignore[call-arg]
    assert replace(CLOUD, layers=()).features == 6
