# SPDX-License-Identifier: MIT
"""A rule on trial reports notes and rejects nothing; order and direction of the linework change no finding."""

from dataclasses import fields, replace

import numpy as np
import pytest
import shapely
from tests.check.test_engine import PROFILE, check, drawing, outcome

from foparq.check import run as engine
from foparq.check.registry import all_rules
from foparq.findings.outcome import Status
from foparq.model.items import Items

FACADE = [
    "LINESTRING (0 0, 4 0)", "LINESTRING (1 0.004, 1 2)", "LINESTRING (2 -0.006, 2 2)", "LINESTRING (3 0, 3 2)",
    "LINESTRING (3 2, 3 0)", "LINESTRING (0.5 3, 3.5 3)", "LINESTRING (1 3, 2 3)", "LINESTRING (5 5, 6 6, 6 5, 5 6)",
    "LINESTRING (7 0, 7 0)", "LINESTRING (8 0, 8 1, 8 1, 9 1)", "LINESTRING (9 4, 10 4, 10 5, 9 5, 9 4.006)",
    "POLYGON ((20 0, 21 0, 21 1, 20 1, 20 0))", "POLYGON ((20.9 0, 22 0, 22 1, 20.9 1, 20.9 0))",
    "POLYGON ((20 1, 20.5 1, 20.5 1.005, 21.5 1.005, 21.5 1, 22 1, 22 2, 20 2, 20 1))",
]  # fmt: skip


def test_a_rule_on_trial_reports_notes_and_the_rest_is_as_before(monkeypatch: pytest.MonkeyPatch) -> None:
    before = check(drawing(FACADE))
    rules = dict(all_rules())
    rules["TOP011"] = replace(rules["TOP011"], preview=True)
    monkeypatch.setattr(engine, "all_rules", lambda: rules)
    after = check(drawing(FACADE))
    assert outcome(after, "undershoot").preview
    assert outcome(after, "undershoot").status is Status.FAULTY
    trial = after.findings.name == "undershoot"
    assert np.count_nonzero(trial) > 0
    assert set(after.findings.severity[trial]) == {"note"}
    assert after.findings.key.tolist() == before.findings.key.tolist()
    assert after.findings.severity[~trial].tolist() == before.findings.severity[~trial].tolist()
    assert not outcome(before, "undershoot").preview
    assert "note" not in before.findings.severity[before.findings.name == "undershoot"]


def test_severities_are_those_of_the_profile() -> None:
    found = check(drawing(FACADE)).findings
    bound = {spec.rule: spec.severity.value for spec in PROFILE.checks}
    assert set(found.name) >= {
        "undershoot", "overshoot", "duplicate", "line-overlap", "self-intersection", "zero-length", "repeated-vertex",
        "open-ring", "area-overlap", "gap",
    }  # fmt: skip
    assert found.severity.tolist() == [bound[name] for name in found.name]


def shuffled(items: Items, order: np.ndarray, *, backwards: bool) -> Items:
    columns = {column.name: getattr(items, column.name)[order] for column in fields(items)}
    if backwards:
        columns["geometry"] = shapely.reverse(columns["geometry"])
    return Items(**columns)


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_order_and_direction_change_no_finding(seed: int, *, backwards: bool) -> None:
    thing = drawing(FACADE)
    order = np.random.default_rng(seed).permutation(len(FACADE))
    other = replace(thing, items=shuffled(thing.items, order, backwards=backwards))
    one, two = check(thing).findings, check(other).findings
    # Of two equal lines the first in the file stays: which of them is at fault depends on the order, nothing else does.
    free = one.name != "duplicate"
    assert sorted(one.key[free]) == sorted(two.key[two.name != "duplicate"])
    assert sorted(one.name) == sorted(two.name)
    by_key = dict(zip(two.key, two.size, strict=True))
    for key, size in zip(one.key[free], one.size[free], strict=True):
        assert by_key[key] == pytest.approx(size, abs=1e-9)


def test_sizes_of_a_facade_are_those_drawn() -> None:
    found = check(drawing(FACADE)).findings
    sizes = {name: sorted(found.size[found.name == name].tolist()) for name in set(found.name)}
    # The post that stops short, and both ends of the ring left open.
    assert sizes["undershoot"] == pytest.approx([0.004, 0.006, 0.006])
    assert sizes["overshoot"] == pytest.approx([0.006])
    assert sizes["duplicate"] == pytest.approx([2.0])
    assert sizes["line-overlap"] == pytest.approx([1.0])
    assert sizes["area-overlap"] == pytest.approx([0.1])
    assert sizes["gap"] == pytest.approx([0.005])
    assert sizes["open-ring"] == pytest.approx([0.006])
