# SPDX-License-Identifier: MIT
"""Where one profile lets more pass than another: both directions of every setting."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.rule_cases import common

from foparq.check.registry import all_rules
from foparq.findings.table import Severity
from foparq.model.inputs import UnitEvidence, areas_of, lines_of, nameless
from foparq.profile.elements import ElementSpec
from foparq.profile.load import load_profile, shipped_profiles
from foparq.profile.looser import TOLERANCES, Looser, Point, looser
from foparq.profile.quantities import LooserWhen
from foparq.profile.schema import Profile

SCALE = 50.0


def mine(folder: Path, text: str) -> Profile:
    path = folder / "mine.toml"
    path.write_text(f'extends = "et-doc-foparq-a"\nname = "mine"\n{text}', encoding="utf-8")
    return load_profile(str(path))


def found(folder: Path, text: str, scale: float = SCALE) -> tuple[Looser, ...]:
    return looser(mine(folder, text), load_profile("et-doc-foparq-a"), scale)


def element(id_: str, kind: str, **keys: str) -> str:
    given = {"required": "true", **keys}
    return "\n".join(["[[element]]", f'id = "{id_}"', f'kind = "{kind}"', *(f"{k} = {v}" for k, v in given.items())])


def check(rule: str, severity: str = "major", **keys: str) -> str:
    return "\n".join(
        [
            "[[check]]",
            f'rule = "{rule}"',
            f'severity = "{severity}"',
            *(f"{key} = {value}" for key, value in keys.items()),
        ]
    )


def q1(limit: str = '"0.3 mm @ scale"', share: str = '"33.3334 %"', fewest: str = "3", **keys: str) -> str:
    return element("Q1", "absolute", limit=limit, reference_share=share, fewest=fewest, **keys)


def undershoot(coincide: str = '"0.01 mm @ scale"', reach: str = '"0.2 mm @ scale"', **keys: str) -> str:
    return check("undershoot", coincide=coincide, reach=reach, **keys)


Q3 = load_profile("et-doc-foparq-a").elements[2].uses
READING = '[reading]\nsagitta = "{}"\nblocks = "{}"\nhidden = "{}"\n'

LOOSER = {
    "a higher limit": (q1('"240 mm @ scale"'), Point.LIMIT, "Q1", (12.0, "m"), (0.015, "m")),
    "a limit off the sheet": (q1('"16 mm"'), Point.LIMIT, "Q1", (0.016, "m"), (0.015, "m")),
    "any reference": (
        element("Q1", "absolute", limit='"0.3 mm @ scale"', fewest="3"), Point.REFERENCE_SHARE, "Q1", "–",
        (0.333334, "1"),
    ),
    "a coarse reference": (q1(share='"90 %"'), Point.REFERENCE_SHARE, "Q1", (0.9, "1"), (0.333334, "1")),
    "fewer points": (q1(fewest="2"), Point.FEWEST, "Q1", 2, 3),
    "a bound that hides": (q1(confidence='"50 %"'), Point.CONFIDENCE, "Q1", (0.5, "1"), (0.95, "1")),
    "a trend that must be surer": (
        element("Q6", "trend", confidence='"99.99 %"', fewest="3"), Point.CONFIDENCE, "Q6", (0.9999, "1"), (0.95, "1"),
    ),
    "not required": (q1(required="false"), Point.NOT_REQUIRED, "", ("Q1",), ""),
    "not applicable": (q1(applicable="false"), Point.NOT_REQUIRED, "", ("Q1",), ""),
    "rules not counted": (
        element("Q3", "faulty-rate", limit='"10 %"', rules='["duplicate"]'), Point.NOT_COUNTED, "Q3",
        tuple(rule for rule in Q3 if rule != "duplicate"), "",
    ),
    "a surplus allowed": (element("Q4", "commission", limit='"1 %"'), Point.LIMIT, "Q4", (0.01, "1"), (0.0, "1")),
    "a lower severity": (undershoot() .replace("major", "note"), Point.SEVERITY, "undershoot", "note", "major"),
    "fewer layers": (undershoot(layers='["EIXO*"]'), Point.LAYERS, "undershoot", ("EIXO*",), ("*",)),
    "no layers": (undershoot(layers="[]"), Point.LAYERS, "undershoot", ("–",), ("*",)),
    "less reach": (undershoot(reach='"0.1 mm @ scale"'), Point.VALUE, "undershoot.reach", (0.005, "m"), (0.01, "m")),
    "more is the same place": (
        undershoot(coincide='"0.1 mm @ scale"'), Point.VALUE, "undershoot.coincide", (0.005, "m"), (0.0005, "m"),
    ),
    "less is the same place": (
        check("duplicate", coincide='"0 mm"'), Point.VALUE, "duplicate.coincide", (0.0, "m"), (0.0005, "m"),
    ),
    "either way, wider": (
        check("line-overlap", coincide='"1 m"'), Point.VALUE, "line-overlap.coincide", (1.0, "m"), (0.0005, "m"),
    ),
    "either way, narrower": (
        check("line-overlap", coincide='"0 m"'), Point.VALUE, "line-overlap.coincide", (0.0, "m"), (0.0005, "m"),
    ),
    "layers together": (
        check("gap", coincide='"0.01 mm @ scale"', most='"100 mm2 @ scale"'), Point.TOGETHER, "gap", "", "",
    ),
    "layers apart": (undershoot(apart="true"), Point.APART, "undershoot", "", ""),
    "blocks passed over": (
        READING.format("0.001 mm @ scale", "skip", "leave"), Point.VALUE, "reading.blocks", "skip", "explode",
    ),
    "hidden layers that thin out": (
        READING.format("0.001 mm @ scale", "explode", "check"), Point.VALUE, "reading.hidden", "check", "leave",
    ),
    "coarse chords": (
        READING.format("1 m", "explode", "leave"), Point.VALUE, "reading.sagitta", (1.0, "m"), (0.00005, "m"),
    ),
    "smaller features count": (
        READING.format("0.05 mm", "explode", "leave") + 'visible = "1 mm"\n', Point.VALUE, "reading.visible",
        (0.001, "m"), (0.01, "m"),
    ),
    "a wider gap": ('[completeness]\ngap = "1 m"\n', Point.VALUE, "completeness.gap", (1.0, "m"), (0.01, "m")),
    "a narrower gap": ('[completeness]\ngap = "1 mm"\n', Point.VALUE, "completeness.gap", (0.001, "m"), (0.01, "m")),
    "fewer findings written": ("[limits]\nwritten = 1\n", Point.VALUE, "limits.written", 1, 100_000),
    "more runs alongside": (
        '[linework]\nalongside = "30 deg"\n', Point.VALUE, "linework.alongside", (np.pi / 6, "rad"),
        (np.pi / 12, "rad"),
    ),
    "a narrower cone": (
        '[linework]\nahead = "45 deg"\n', Point.VALUE, "linework.ahead", (np.pi / 4, "rad"), (np.pi / 3, "rad"),
    ),
    "only ends of very long lines go beyond": (
        '[linework]\nremainder = "3000 %"\n', Point.VALUE, "linework.remainder", (30.0, "1"), (3.0, "1"),
    ),
    "nothing is headed for": (
        '[linework]\nheading = "0.2 mm @ scale"\n', Point.VALUE, "linework.heading", (0.01, "m"), (0.05, "m"),
    ),
    "larger things are symbols": (
        '[linework]\nsymbol = "30 mm @ scale"\n', Point.VALUE, "linework.symbol", (1.5, "m"), (0.15, "m"),
    ),
    "rarer things are symbols": (
        "[linework]\nsymbol_times = 2\n", Point.VALUE, "linework.symbol_times", 2, 3,
    ),
    "a scale of its own": ('scale = "1:50"\n', Point.SCALE, "", "1:50", ""),
}  # fmt: skip

STRICTER = {
    "the same": "",
    "the same in other words": q1('"15 mm"'),
    "a lower limit": q1('"0.1 mm @ scale"'),
    "no limit, which nothing can meet": element("Q1", "absolute", reference_share='"33.3334 %"', fewest="3"),
    "a better reference": q1(share='"10 %"'),
    "more points": q1(fewest="20"),
    "a surer bound": q1(confidence='"99 %"'),
    "a trend told sooner": element("Q6", "trend", confidence='"80 %"', fewest="3"),
    "what was only reported is required": element("Q7", "normality", confidence='"95 %"', fewest="8"),
    "an element more": element("Q9", "found-rate", rules='["gap"]', limit='"0 %"'),
    "a rule more counted": element("Q3", "faulty-rate", limit='"10 %"', rules=str([*Q3, "open-ring"])),
    "a higher severity": undershoot().replace("major", "critical"),
    "nothing is a symbol": '[linework]\nsymbol = "0 mm"\n',
    "only what is often repeated is a symbol": "[linework]\nsymbol_times = 30\n",
    "more reach": undershoot(reach='"1 mm @ scale"'),
    "less is the same place for an end": undershoot(coincide='"0.001 mm @ scale"'),
    "more is the same place for copies": check("duplicate", coincide='"1 mm"'),
    "bound once more, otherwise": undershoot() + "\n" + undershoot(layers='["A*"]', reach='"0.1 mm @ scale"'),
    "more findings written": "[limits]\nwritten = 1000000\n",
    "a scale that is not the one in use": 'scale = "1:20"\n',
    "other norms": 'norms = ["Caderno"]\n',
}


@pytest.mark.parametrize(("text", "point", "subject", "own", "other"), LOOSER.values(), ids=LOOSER.keys())
def test_what_is_looser_is_named_with_both_values(
    tmp_path: Path, text: str, point: Point, subject: str, own: object, other: object
) -> None:
    assert found(tmp_path, text) == (Looser(point=point, subject=subject, own=own, other=other),)


@pytest.mark.parametrize("text", STRICTER.values(), ids=STRICTER.keys())
def test_what_is_stricter_or_the_same_is_not_named(tmp_path: Path, text: str) -> None:
    assert found(tmp_path, text) == ()


def test_another_kind_of_element_is_named() -> None:
    shipped = load_profile("et-doc-foparq-a")
    kinds = {spec.id: spec for spec in shipped.elements}
    other = shipped.model_copy(
        update={"elements": (kinds["Q3-gap"].model_copy(update={"id": "Q4", "required": True}),)}
    )
    named = looser(other, shipped.model_copy(update={"elements": (kinds["Q4"],)}), SCALE)
    assert named == (Looser(point=Point.KIND, subject="Q4", own="found-rate", other="commission"),)


def test_two_bindings_of_which_neither_is_as_strict_do_not_make_up_for_each_other(tmp_path: Path) -> None:
    both = undershoot().replace("major", "note") + "\n" + undershoot(reach='"0.1 mm @ scale"')
    assert len(found(tmp_path, both)) == 1


def test_at_another_scale_the_same_length_is_looser(tmp_path: Path) -> None:
    """15 mm is 0.3 mm on the sheet at 1:50, and more than that at 1:20."""
    assert found(tmp_path, q1('"15 mm"'), 50.0) == ()
    assert [one.point for one in found(tmp_path, q1('"15 mm"'), 20.0)] == [Point.LIMIT]


def test_of_a_profile_that_asks_for_nothing_everything_is_named(tmp_path: Path) -> None:
    path = tmp_path / "bare.toml"
    path.write_text(
        'name = "bare"\nproduct_class = "A"\n[reading]\nsagitta = "0.001 mm @ scale"\n'
        + check("needs-recovery", "minor"),
        encoding="utf-8",
    )
    shipped = load_profile("et-doc-foparq-a")
    points = {one.point: one.own for one in looser(load_profile(str(path)), shipped, SCALE)}
    assert points[Point.ELEMENT_MISSING] == tuple(spec.id for spec in shipped.elements if spec.required)
    assert points[Point.RULE_MISSING] == tuple(spec.rule for spec in shipped.checks if spec.rule != "needs-recovery")


@pytest.mark.parametrize("name", shipped_profiles())
def test_no_profile_is_looser_than_itself(name: str) -> None:
    assert looser(load_profile(name), load_profile(name), SCALE) == ()


def test_the_visual_product_is_looser_in_what_is_metric_only() -> None:
    a, b = load_profile("et-doc-foparq-a"), load_profile("et-doc-foparq-b")
    assert looser(b, a, SCALE) == (Looser(point=Point.NOT_REQUIRED, own=("Q1", "Q2", "Q6")),)
    assert looser(a, b, SCALE) == ()


def test_a_severity_lies_between_its_neighbours(tmp_path: Path) -> None:
    order = [Severity.NOTE, Severity.MINOR, Severity.MAJOR, Severity.CRITICAL]
    for severity in Severity:
        named = found(tmp_path, undershoot().replace("major", severity.value))
        assert bool(named) is (order.index(severity) < order.index(Severity.MAJOR))


def test_every_key_of_every_kind_of_element_has_its_direction() -> None:
    for kind in ElementSpec.KINDS.values():
        keys = set(kind.model_fields) - set(ElementSpec.model_fields) - {"rules"}
        assert keys <= set(kind.LOOSER), f"{kind.KIND}: say in LOOSER which change lets more pass"


@settings(deadline=None)
@given(st.sampled_from(sorted(TOLERANCES)), st.floats(0.01, 100.0))
def test_of_two_tolerances_one_is_looser(key: tuple[str, str], factor: float) -> None:
    """Exactly one of two profiles that differ in one tolerance is looser; of equal ones neither is."""
    before = load_profile("et-doc-foparq-a")
    (spec,) = (one for one in before.checks if one.rule == key[0])
    was = spec.tolerances[key[1]]
    now = replace(was, number=was.number * factor)
    changed = spec.model_copy(update={"tolerances": {**spec.tolerances, key[1]: now}})
    checks = tuple(changed if one is spec else one for one in before.checks)
    after = before.model_copy(update={"checks": checks})
    larger = now.si(SCALE) > was.si(SCALE)
    expected = now.si(SCALE) != was.si(SCALE) and larger is (TOLERANCES[key] is LooserWhen.LARGER)
    assert bool(looser(after, before, SCALE)) is expected
    assert bool(looser(before, after, SCALE)) is (now.si(SCALE) != was.si(SCALE) and not expected)


# --- which change of a tolerance finds less: a drawing for each ------------------------------------------------------

_EDGE = "LINESTRING (0 0, 1 0)"
_ENDS = {"coincide": 0.001, "reach": 0.1}
_SHORT, _LONG = [_EDGE, "LINESTRING (0.5 0.01, 0.5 1)"], [_EDGE, "LINESTRING (0.5 -0.01, 0.5 1)"]
_OPEN = ["LINESTRING (0 0, 1 0, 1 1, 0 0.01)"]
_SQUARES = ["POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))", "POLYGON ((1.5 0, 3 0, 3 1, 1.5 1, 1.5 0))"]


def _around(width: float) -> list[str]:
    """Two areas around a gap of a width, 1 m high."""
    right = 1 + width
    return [
        "POLYGON ((0 0, 3 0, 3 1, 1 1, 1 3, 0 3, 0 0))",
        f"POLYGON ((3 1, 3 3, 1 3, 1 2, {right} 2, {right} 1, 3 1))",
    ]


#: rule, tolerance: its tolerances, its other value, and a drawing of which less is found with that
WITNESSES: dict[tuple[str, str], tuple[Mapping[str, float], float, list[str]]] = {
    ("area-overlap", "least"): ({"least": 0.1}, 1.0, _SQUARES),
    ("duplicate", "coincide"): ({"coincide": 0.01}, 0.001, [_EDGE, "LINESTRING (0 0.005, 1 0.005)"]),
    ("free-end", "coincide"): ({"coincide": 0.01, "reach": 0.2}, 0.1, ["LINESTRING (0 0, 0.05 0)"]),
    ("free-end", "reach"): ({"coincide": 0.001, "reach": 0.005}, 0.1, _SHORT),
    ("gap", "coincide"): ({"coincide": 0.01, "most": 9.0}, 0.2, _around(0.05)),
    ("gap", "most"): ({"coincide": 0.001, "most": 9.0}, 0.1, _around(1.0)),
    ("open-ring", "coincide"): (_ENDS, 0.05, _OPEN),
    ("open-ring", "reach"): (_ENDS, 0.005, _OPEN),
    ("overshoot", "coincide"): (_ENDS, 0.02, _LONG),
    ("overshoot", "reach"): (_ENDS, 0.005, _LONG),
    ("repeated-vertex", "coincide"): ({"coincide": 0.01}, 0.001, ["LINESTRING (0 0, 0.005 0, 1 0)"]),
    ("undershoot", "coincide"): (_ENDS, 0.02, _SHORT),
    ("undershoot", "reach"): (_ENDS, 0.005, _SHORT),
    ("zero-length", "coincide"): ({"coincide": 0.01}, 0.001, ["LINESTRING (0 0, 0.005 0)"]),
}


@pytest.mark.parametrize(("rule", "name"), WITNESSES)
def test_a_tolerance_that_is_looser_finds_less_of_some_drawing(rule: str, name: str) -> None:
    before, changed, drawn = WITNESSES[rule, name]
    after = {**before, name: changed}
    entry = next(one for one in all_rules().values() if one.name == rule)
    make = areas_of if drawn[0].startswith("POLYGON") else lines_of
    counts = [len(entry.check(make(drawn), **{**common(entry), **values})) for values in (before, after)]
    assert counts[1] < counts[0]
    direction = LooserWhen.LARGER if changed > before[name] else LooserWhen.SMALLER
    assert TOLERANCES[rule, name] is direction


@pytest.mark.parametrize(
    ("rule", "wide", "narrow"),
    [
        ("line-overlap", [_EDGE, "LINESTRING (0.5 0.005, 1.5 0.005)"], [_EDGE, "LINESTRING (0.995 0, 2 0)"]),
        (
            "self-intersection", ["LINESTRING (0 0, 1 0, 1 1, 0.5 0.005)"],
            ["LINESTRING (0 0, 1 0, 1.004 0.004, 1 0.004, 1.002 -1)"],
        ),
    ],
)  # fmt: skip
def test_some_tolerances_find_less_either_way(rule: str, wide: list[str], narrow: list[str]) -> None:
    entry = next(one for one in all_rules().values() if one.name == rule)

    def count(drawn: list[str], coincide: float) -> int:
        return len(entry.check(lines_of(drawn), coincide=coincide))

    assert count(wide, 0.001) < count(wide, 0.02)
    assert count(narrow, 0.02) < count(narrow, 0.001)
    assert (rule, "coincide") not in TOLERANCES


def test_a_contradiction_of_units_is_overlooked_by_a_wide_agreement() -> None:
    entry = next(one for one in all_rules().values() if one.name == "unit-contradiction")
    row = UnitEvidence(
        witness=np.array(["header"], dtype=object),
        says=np.array([0.001]), used=np.array([1.0]), weight=np.array([0.0]),
        where=np.array([shapely.Point(0, 0)], dtype=object), **nameless(1),
    )  # fmt: skip
    assert [len(entry.check(row, agree=share)) for share in (0.02, 1.0)] == [1, 0]
    assert TOLERANCES["unit-contradiction", "agree"] is LooserWhen.LARGER


def test_directions_are_of_rules_and_tolerances_that_exist() -> None:
    known = {(rule.name, name) for rule in all_rules().values() for name, _ in rule.tolerances}
    assert set(TOLERANCES) <= known
    assert set(TOLERANCES) == set(WITNESSES) | {("unit-contradiction", "agree")}
